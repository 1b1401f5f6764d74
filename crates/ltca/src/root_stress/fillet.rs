//! The nodes of one fillet, their neighbours, and the peak of a stress on them.

use std::collections::BTreeMap;

use geometry::{Gear, Side};
use mesh::{Face, Mesh, RootFillets};

use super::turn::Coarseness;

/// One fillet of a window.
#[derive(Debug)]
pub(super) struct Fillet {
    /// Tooth number in the matrices' frame.
    pub tooth: u32,
    pub side: Side,
    /// Places of its nodes among those of the window.
    places: Vec<usize>,
    /// Places with which each of them shares a face.
    neighbours: Vec<Vec<usize>>,
    /// Whether a node is in the uppermost row: no neighbour is farther from the axis.
    uppermost: Vec<bool>,
    /// Whether a node is in the lowest row: no neighbour is nearer to the axis.
    lowest: Vec<bool>,
    /// Whether a node is below the [`FALLBACK_TANGENT`].
    below: Vec<bool>,
    /// How coarse the gear's fillets are.
    pub coarseness: Coarseness,
}

/// Where stress is looked at in a fillet on which it has no peak: below this tangent, rad (25 deg).
const FALLBACK_TANGENT: f64 = 25.0 * std::f64::consts::PI / 180.0;
/// Nodes of the neck of a generated mesh lie on that circle, modules.
const ON_CIRCLE_MODULES: f64 = 0.01;

/// Radius of the [`FALLBACK_TANGENT`] of a gear, mm; negative of a ring.
pub(super) fn fallback_radius(gear: &Gear) -> f64 {
    let profile = gear.profile();
    let (radius, _) = profile.fillet(profile.fillet_at_tangent(FALLBACK_TANGENT));
    radius + ON_CIRCLE_MODULES * gear.data().normal_module
}

/// Neighbours of the fillets' nodes.
pub(super) struct Surroundings<'a> {
    mesh: &'a Mesh,
    faces: Vec<Face>,
    /// Faces by node.
    about: BTreeMap<u32, Vec<usize>>,
    coarseness: Coarseness,
    fallback: f64,
}

impl<'a> Surroundings<'a> {
    pub fn new(found: &'a RootFillets, mesh: &'a Mesh, fallback: f64) -> Self {
        let mut about: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        let faces = found.faces().concat();
        for (i, face) in faces.iter().enumerate() {
            face.nodes().iter().for_each(|&n| about.entry(n).or_default().push(i));
        }
        Self { mesh, faces, about, coarseness: Coarseness::of(mesh, found.faces()), fallback }
    }

    /// The fillet with these nodes (ascending), whose positions in the window's list start at `first`.
    pub fn fillet(&self, tooth: u32, side: Side, nodes: &[u32], first: usize) -> Fillet {
        // Negative of a ring, as the radius to compare with is: larger towards the tip.
        let radius = |node: u32| {
            let [x, y, _] = self.mesh.nodes[node as usize];
            x.hypot(y).copysign(self.fallback)
        };
        let beside = |node: &u32| -> Vec<usize> {
            let faces = self.about.get(node).into_iter().flatten().flat_map(|&i| self.faces[i].nodes());
            let own = faces.filter(|other| *other != node).filter_map(|other| nodes.binary_search(other).ok());
            let mut beside: Vec<usize> = own.collect();
            beside.sort_unstable();
            beside.dedup();
            beside
        };
        let neighbours: Vec<Vec<usize>> = nodes.iter().map(beside).collect();
        let farther = |node: u32, other: usize| radius(nodes[other]) > radius(node) + 1e-9 * self.fallback.abs();
        let nearer = |node: u32, other: usize| radius(nodes[other]) < radius(node) - 1e-9 * self.fallback.abs();
        Fillet {
            tooth,
            side,
            places: (first..first + nodes.len()).collect(),
            uppermost: nodes.iter().zip(&neighbours).map(|(&n, of)| !of.iter().any(|&m| farther(n, m))).collect(),
            lowest: nodes.iter().zip(&neighbours).map(|(&n, of)| !of.iter().any(|&m| nearer(n, m))).collect(),
            below: nodes.iter().map(|&n| radius(n) <= self.fallback).collect(),
            coarseness: self.coarseness,
            neighbours: neighbours.into_iter().map(|of| of.into_iter().map(|m| first + m).collect()).collect(),
        }
    }
}

impl Fillet {
    /// Positions of its nodes in the window's list.
    pub fn places(&self) -> impl Iterator<Item = usize> + '_ {
        self.places.iter().copied()
    }

    /// Largest value of `sign` times a measure over all nodes; returned as a value of the measure.
    pub fn largest(&self, value: impl Fn(usize) -> f64, sign: f64) -> Option<f64> {
        self.places.iter().map(|&at| value(at)).reduce(|best, v| if sign * v > sign * best { v } else { best })
    }

    /// Largest value of `sign` times a measure at a node and at the nodes that share a face with it; returned as a
    /// value of the measure.
    pub fn beside(&self, at: usize, value: impl Fn(usize) -> f64, sign: f64) -> f64 {
        let near = self.places.binary_search(&at).ok().into_iter().flat_map(|i| self.neighbours[i].iter().copied());
        near.map(&value).fold(value(at), |best, v| if sign * v > sign * best { v } else { best })
    }

    /// Position of the peak of `sign` times a measure, from two recoveries of it. Of the peaks of the first recovery
    /// it is the one at which the smaller of both recoveries is largest. If all peaks are in the lowest row, it is the
    /// largest value below the [`FALLBACK_TANGENT`] and below the uppermost row; if only the lowest row lies there, the
    /// largest value of all nodes.
    ///
    /// A peak is a node whose value no neighbour exceeds and that is not in the uppermost row. Stress that increases up
    /// to the uppermost row is the stress of the contact next to it, which has no limit under mesh refinement. Both
    /// recoveries give the same bending stress of a tooth; within an element of a force at its corner the first one
    /// gives up to twice as much.
    pub fn peak(&self, first: impl Fn(usize) -> f64, second: impl Fn(usize) -> f64, sign: f64) -> Option<usize> {
        // Peaks may have one value beside them in common: of these the larger by itself.
        let rank = |at: usize| {
            let own = sign * first(at);
            (own.min(sign * self.beside(at, &second, sign)), own)
        };
        let largest = |counts: &dyn Fn(usize) -> bool| {
            let values = (0..self.places.len()).filter(|&i| counts(i)).map(|i| (self.places[i], rank(self.places[i])));
            // The first of equals, so that nothing depends on how the nodes are gone through.
            values.reduce(|best, v| if v.1 > best.1 { v } else { best }).map(|best| best.0)
        };
        let peak = |i: usize| {
            let own = sign * first(self.places[i]);
            !self.uppermost[i] && self.neighbours[i].iter().all(|&other| sign * first(other) <= own)
        };
        // A peak of the lowest row alone may be one along the face only, its top in rows that the mesh does not have.
        let inside = |at: &usize| self.places.binary_search(at).is_ok_and(|i| !self.lowest[i]);
        // Where the first row is below that tangent already, it has the stress of contact all the same.
        let free = |i: usize| self.below[i] && !self.uppermost[i];
        let rows = (0..self.places.len()).any(|i| free(i) && !self.lowest[i]);
        let below = || rows.then(|| largest(&free)).flatten();
        largest(&peak).filter(inside).or_else(below).or_else(|| largest(&|_| true))
    }
}
