//! A stepped shaft as a row of beams.

use nalgebra::DMatrix;

use super::{BeamSection, BeamTheory, NODE_COORDINATES, beam_gyroscopic, beam_mass, beam_stiffness};
use crate::FemError;

/// A length of shaft with one section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamPiece {
    /// Length, mm, > 0.
    pub length: f64,
    /// Section.
    pub section: BeamSection,
}

/// Places beyond the ends of a shaft by this share of its length are on it: digits of files.
const FAR_OFF: f64 = 1e-9;
/// Largest share of a shaft's length that two places may lie apart and count as one, however slender it is.
const LARGEST_MERGED: f64 = 1e-4;

/// Distance (mm) up to which two places on a shaft are one: where moving a part by it is as small an error as the
/// round-off of an element so short.
///
/// ```text
/// t = 10 sqrt(eps) L max(L/D, 1), at the most 1e-4 L      L: length of the shaft, D: its least outer diameter, mm
/// ```
/// An element of length t is stiffer in shear than the shaft in bending by some L^3/(t D^2), so that its round-off is
/// eps L^3/(t D^2) of the shaft's own stiffness; moving a part by t changes that by t/L. Both are sqrt(eps) L/D without the
/// factor, which gives more to the second: what it does to a result is smooth, and a resonance multiplies round-off. For
/// usual shafts t/L is 1e-6. Lengths all twice as large make it twice as large.
pub fn coincidence(length: f64, diameter: f64) -> f64 {
    (10.0 * f64::EPSILON.sqrt() * (length / diameter).max(1.0)).min(LARGEST_MERGED) * length
}

/// Ends of the pieces (mm), and where nodes have to be beside z = 0, ascending: ends of pieces first, then places that
/// no node is near.
fn ends_and_nodes(pieces: &[BeamPiece], places: &[f64], near: f64) -> (Vec<f64>, Vec<f64>) {
    let mut ends = Vec::with_capacity(pieces.len());
    let mut end = 0.0;
    for piece in pieces {
        end += piece.length;
        ends.push(end);
    }
    let is_new = |nodes: &[f64], z: f64| z > near && z < end - near && nodes.iter().all(|n| (n - z).abs() > near);
    let mut nodes: Vec<f64> = Vec::new();
    for &z in ends.iter().chain(places) {
        if is_new(&nodes, z) {
            nodes.push(z);
        }
    }
    nodes.push(end);
    nodes.sort_by(f64::total_cmp);
    (ends, nodes)
}

/// A free stepped shaft from z = 0 on, cut into beam elements.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamLine {
    positions: Vec<f64>,
    /// Stiffness of all nodes' coordinates, six a node.
    pub stiffness: DMatrix<f64>,
    /// Consistent mass of the same.
    pub mass: DMatrix<f64>,
    /// Gyroscopic matrix of the same for a spin of 1 rad/s about +z (`beam_gyroscopic`).
    pub gyroscopic: DMatrix<f64>,
}

impl BeamLine {
    /// Pieces one after the other, with nodes at their ends and at `places` (mm), elements no longer than `longest`
    /// (mm). What lies nearer together than [`coincidence`] shares a node: an element that short would cost more digits
    /// than it moves.
    ///
    /// # Errors
    /// [`FemError::Length`] where a length is not positive or a place is not on the shaft.
    pub fn new(pieces: &[BeamPiece], places: &[f64], longest: f64, theory: BeamTheory) -> Result<Self, FemError> {
        let bad = |length_mm: f64| FemError::Length { length_mm };
        let total: f64 = pieces.iter().map(|p| p.length).sum();
        if !(total > 0.0 && total.is_finite()) {
            return Err(bad(total));
        }
        if let Some(piece) = pieces.iter().find(|p| p.length.is_nan() || p.length <= 0.0) {
            return Err(bad(piece.length));
        }
        let thinnest = pieces.iter().map(|p| p.section.outer()).fold(f64::INFINITY, f64::min);
        let near = coincidence(total, thinnest);
        if longest.is_nan() || longest <= near {
            return Err(bad(longest));
        }
        let off = FAR_OFF * total;
        if let Some(&place) = places.iter().find(|p| !(-off..=total + off).contains(*p)) {
            return Err(bad(place));
        }
        let (ends, nodes) = ends_and_nodes(pieces, places, near);
        let (mut positions, mut elements) = (vec![0.0], Vec::new());
        for cut in nodes {
            let from = positions[positions.len() - 1];
            let middle = 0.5 * (from + cut);
            let own = ends.iter().position(|end| *end > middle).unwrap_or(pieces.len() - 1);
            let count = ((cut - from) / longest * (1.0 - 1e-9)).ceil().clamp(1.0, 1e4);
            for i in 1..=count as u32 {
                positions.push(from + (cut - from) * f64::from(i) / count);
                elements.push(((cut - from) / count, pieces[own].section));
            }
        }
        let n = NODE_COORDINATES * positions.len();
        let [mut stiffness, mut mass, mut gyroscopic] = [0; 3].map(|_| DMatrix::zeros(n, n));
        for (i, (length, section)) in elements.iter().enumerate() {
            let at = NODE_COORDINATES * i;
            let size = 2 * NODE_COORDINATES;
            let mut block = stiffness.view_mut((at, at), (size, size));
            block += beam_stiffness(section, *length, theory);
            let mut block = mass.view_mut((at, at), (size, size));
            block += beam_mass(section, *length, theory);
            let mut block = gyroscopic.view_mut((at, at), (size, size));
            block += beam_gyroscopic(section, *length, theory);
        }
        Ok(Self { positions, stiffness, mass, gyroscopic })
    }

    /// A shaft without length, mass and stiffness: one node at z = 0.
    pub fn point() -> Self {
        let [stiffness, mass, gyroscopic] = [0; 3].map(|_| DMatrix::zeros(NODE_COORDINATES, NODE_COORDINATES));
        Self { positions: vec![0.0], stiffness, mass, gyroscopic }
    }

    /// Positions of the nodes, mm, ascending.
    pub fn positions(&self) -> &[f64] {
        &self.positions
    }

    /// The node nearest to `z` (mm).
    pub fn node_at(&self, z: f64) -> usize {
        let off = |i: &usize| (self.positions[*i] - z).abs();
        (0..self.positions.len()).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(0)
    }
}
