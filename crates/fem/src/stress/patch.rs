//! Patch recovery on a surface: a polynomial through the most accurate points of the faces around a corner.
//!
//! If stress is extrapolated to the nodes face by face, it overshoots at every maximum. The line through two Gauss
//! points h/sqrt 3 apart is kappa h^2 / 12 above a maximum of curvature kappa at the end of the face. This holds on
//! both sides of the maximum, so averaging does not remove the error. A polynomial of second order through the points
//! of all faces around a corner has no such error.
//!
//! ```text
//! sigma(x) = sum_t c_t p_t(alpha, beta),    p = 1, alpha, beta, alpha beta, alpha^2, beta^2 (order 2);  1 (order 1)
//! min_c sum_q (sigma(x_q) - sigma_q)^2      over the points q of the faces about the corner
//! sigma_i = sum_c N_c(xi_i) sigma^c(x_i)    at a node of a face, N_c the (bi)linear shape functions of its corners
//! ```
//! alpha and beta are measured along the edges of one face at the corner, lengths along the surface. Components are in
//! the frame of the corner, which rotates with the normal. A corner on the edge of the surface has too few points; it
//! uses the polynomials of the neighbouring corners.
//!
//! Source: Zienkiewicz and Zhu, IJNME 33, 1992, 1331-1364.

use std::collections::BTreeMap;

use mesh::{Face, FaceKind};
use nalgebra::DMatrix;

use super::surface::{Frame, Plane, SurfaceStress, dot, in_space, turned};
use crate::Material;

/// A term that the others leave less than this of, as a share of its norm, is not to be told from them and is left out.
const INDEPENDENT: f64 = 0.1;

/// Stress at nodes of a surface as a linear map of its displacement.
pub(super) struct Patches<'a> {
    positions: &'a [[f64; 3]],
    faces: &'a [Face],
    kernels: [SurfaceStress; 5],
    /// Faces about each corner.
    about: BTreeMap<u32, Vec<usize>>,
    fits: BTreeMap<u32, Fit>,
}

/// The polynomial about one corner.
struct Fit {
    chart: Chart,
    /// Whether no term had to be left out.
    whole: bool,
    /// By term of [`terms`], zero for those left out: stress 11, 22, 12 in the corner's frame for a unit move of a
    /// node.
    coefficients: BTreeMap<u32, Vec<Plane>>,
}

/// Coordinates on the surface about a corner.
#[derive(Clone, Copy)]
struct Chart {
    origin: [f64; 3],
    frame: Frame,
    /// |a_1|, a_2 t_1, a_2 t_2 of the tangents along the edges of a face.
    axes: [f64; 3],
}

impl Chart {
    /// Normal to the mean of the faces' normals, so that nothing but the direction of the axes depends on which face
    /// comes first.
    fn new(origin: [f64; 3], faces: &[(Frame, [f64; 3])]) -> Option<Self> {
        let &(first, [length, shear, height]) = faces.first()?;
        let mut sum = [0.0; 3];
        for (frame, _) in faces {
            let sign = if dot(frame[2], first[2]) < 0.0 { -1.0 } else { 1.0 };
            (0..3).for_each(|k| sum[k] += sign * frame[2][k]);
        }
        let size = dot(sum, sum).sqrt();
        // Nearer than a right angle to the first: nothing can be turned onto its opposite.
        let frame = (size > 0.0).then(|| turned(&first, sum.map(|c| c / size)))?;
        let a = [first[0].map(|c| length * c), [0, 1, 2].map(|k| shear * first[0][k] + height * first[1][k])];
        let second = dot(a[1], frame[1]);
        (second != 0.0).then_some(Self { origin, frame, axes: [dot(a[0], frame[0]), dot(a[1], frame[0]), second] })
    }

    /// alpha, beta of a point, in half edges.
    fn of(&self, x: [f64; 3]) -> [f64; 2] {
        let d = [0, 1, 2].map(|k| x[k] - self.origin[k]);
        let [u, v] = [0, 1].map(|k| dot(d, self.frame[k]));
        // The chord's length is nearer to that along the surface than its shadow's.
        let stretch = if u == 0.0 && v == 0.0 { 0.0 } else { (dot(d, d) / (u * u + v * v)).sqrt() };
        let [length, shear, height] = self.axes;
        let beta = stretch * v / height;
        [(stretch * u - shear * beta) / length, beta]
    }
}

/// Terms of the polynomial that faces of this order bear: those of order 1 have one point each, and a slope through few
/// of them runs wild at the rim of a coarse mesh.
fn terms(order: usize, [a, b]: [f64; 2]) -> Vec<f64> {
    if order == 1 { vec![1.0] } else { vec![1.0, a, b, a * b, a * a, b * b] }
}

impl<'a> Patches<'a> {
    /// Patch recovery on `faces`, whose nodes must all exist.
    pub fn new(positions: &'a [[f64; 3]], faces: &'a [Face], material: &Material) -> Self {
        let mut about: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (i, face) in faces.iter().enumerate() {
            face.corners().iter().for_each(|&corner| about.entry(corner).or_default().push(i));
        }
        let kernels = FaceKind::ALL.map(|kind| SurfaceStress::new(kind, material));
        Self { positions, faces, kernels, about, fits: BTreeMap::new() }
    }

    /// Blocks (6 x 3, row-major, MPa/mm) of the stress at node `i` of a face, one per node on which the stress depends.
    /// Empty if the faces around it have degenerated to lines.
    pub fn at_node(&mut self, face: usize, i: usize) -> Vec<(u32, [f64; 18])> {
        let Face { kind, .. } = self.faces[face];
        let xi = kind.reference_nodes()[i];
        let x = self.positions[self.faces[face].nodes()[i] as usize];
        let Some((frame, _)) = self.kernel(kind).at(xi, &self.coordinates(face)) else { return Vec::new() };
        let mut shares = [0.0; 9];
        let corner_kind = if kind.corner_count() == 3 { FaceKind::Tri3 } else { FaceKind::Quad4 };
        corner_kind.shape(xi, &mut shares);
        let mut sum: BTreeMap<u32, [f64; 18]> = BTreeMap::new();
        for (k, &share) in shares[..kind.corner_count()].iter().enumerate().filter(|(_, share)| **share != 0.0) {
            let owners = self.owners(self.faces[face].corners()[k]);
            let share = share / owners.len() as f64;
            for owner in owners {
                let Some(fit) = self.fits.get(&owner) else { continue };
                let there = turned(&fit.chart.frame, frame[2]);
                let weights = terms(kind.order(), fit.chart.of(x));
                for (&node, of_terms) in &fit.coefficients {
                    let mut plane = [[0.0; 3]; 3];
                    for (w, own) in weights.iter().zip(of_terms) {
                        (0..3).for_each(|axis| (0..3).for_each(|c| plane[axis][c] += w * own[axis][c]));
                    }
                    let block = sum.entry(node).or_insert([0.0; 18]);
                    block.iter_mut().zip(in_space(&there, &plane)).for_each(|(s, b)| *s += share * b);
                }
            }
        }
        sum.into_iter().collect()
    }

    fn coordinates(&self, face: usize) -> Vec<[f64; 3]> {
        self.faces[face].nodes().iter().map(|&n| self.positions[n as usize]).collect()
    }

    fn kernel(&self, kind: FaceKind) -> &SurfaceStress {
        &self.kernels[FaceKind::ALL.iter().position(|k| *k == kind).unwrap_or_default()]
    }

    /// Corners whose polynomials hold at a corner: its own, or on a rim those one edge from it, one face from it, again
    /// its own.
    fn owners(&mut self, corner: u32) -> Vec<u32> {
        if self.whole(corner) {
            return vec![corner];
        }
        let faces = self.about.get(&corner).cloned().unwrap_or_default();
        let (mut beside, mut across) = (Vec::new(), Vec::new());
        for face in faces.into_iter().map(|f| self.faces[f]) {
            let corners = face.corners();
            let n = corners.len();
            let own = corners.iter().position(|c| *c == corner).unwrap_or_default();
            beside.extend([corners[(own + 1) % n], corners[(own + n - 1) % n]]);
            across.extend_from_slice(corners);
        }
        for mut set in [beside, across] {
            set.sort_unstable();
            set.dedup();
            set.retain(|&other| self.whole(other));
            if !set.is_empty() {
                return set;
            }
        }
        vec![corner]
    }

    /// Whether a corner has a polynomial of its own in which no term is missing.
    fn whole(&mut self, corner: u32) -> bool {
        if !self.fits.contains_key(&corner)
            && let Some(fit) = self.fit(corner)
        {
            self.fits.insert(corner, fit);
        }
        self.fits.get(&corner).is_some_and(|fit| fit.whole)
    }

    /// Frame and tangents of a face at one of its corners.
    fn tangents(&self, face: usize, corner: u32) -> Option<(Frame, [f64; 3])> {
        let kind = self.faces[face].kind;
        let own = self.faces[face].corners().iter().position(|c| *c == corner)?;
        let found = self.kernel(kind).tangents(kind.reference_nodes()[own], &self.coordinates(face));
        found.map(|(frame, axes, _)| (frame, axes))
    }

    fn fit(&self, corner: u32) -> Option<Fit> {
        let faces = self.about.get(&corner)?;
        let order = faces.iter().map(|&f| self.faces[f].kind.order()).max()?;
        let tangents: Vec<(Frame, [f64; 3])> = faces.iter().filter_map(|&face| self.tangents(face, corner)).collect();
        let chart = Chart::new(self.positions[corner as usize], &tangents)?;
        // By point: its row of terms, the nodes it depends on and its stress in the corner's frame.
        let mut rows = Vec::new();
        let mut points = Vec::new();
        for &face in faces {
            let (kind, x) = (self.faces[face].kind, self.coordinates(face));
            let kernel = self.kernel(kind);
            for &xi in kernel.points() {
                let Some((frame, own)) = kernel.at(xi, &x) else { continue };
                rows.push(terms(order, chart.of(kernel.position(xi, &x))));
                points.push((face, seen_from(&chart.frame, &frame, own)));
            }
        }
        let kept = independent(&rows);
        let matrix = DMatrix::from_fn(rows.len(), kept.len(), |q, k| rows[q][kept[k]]);
        let inverse = matrix.pseudo_inverse(1e-12).ok()?;
        let count = terms(order, [0.0; 2]).len();
        let mut coefficients: BTreeMap<u32, Vec<Plane>> = BTreeMap::new();
        for (q, (face, own)) in points.iter().enumerate() {
            for (&node, own) in self.faces[*face].nodes().iter().zip(own) {
                let of_terms = coefficients.entry(node).or_insert_with(|| vec![[[0.0; 3]; 3]; count]);
                for (k, &term) in kept.iter().enumerate() {
                    let w = inverse[(k, q)];
                    (0..3).for_each(|axis| (0..3).for_each(|c| of_terms[term][axis][c] += w * own[axis][c]));
                }
            }
        }
        Some(Fit { chart, whole: kept.len() == count, coefficients })
    }
}

/// Plane stress of a point, by node, in the frame `of` turned to the point's normal.
fn seen_from(of: &Frame, at: &Frame, own: Vec<Plane>) -> Vec<Plane> {
    let [first, second, _] = turned(of, at[2]);
    let [e, f] = [first, second].map(|v| [dot(v, at[0]), dot(v, at[1])]);
    let part = |s: &[f64; 3], a: [f64; 2], b: [f64; 2]| {
        a[0] * b[0] * s[0] + a[1] * b[1] * s[1] + (a[0] * b[1] + a[1] * b[0]) * s[2]
    };
    own.into_iter().map(|plane| plane.map(|s| [part(&s, e, e), part(&s, f, f), part(&s, e, f)])).collect()
}

/// Which terms the points can tell from those before them.
fn independent(rows: &[Vec<f64>]) -> Vec<usize> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let mut kept = Vec::new();
    for term in 0..rows.first().map_or(0, Vec::len) {
        let mut column: Vec<f64> = rows.iter().map(|row| row[term]).collect();
        let norm = |v: &[f64]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
        let before = norm(&column);
        for unit in &basis {
            let along: f64 = unit.iter().zip(&column).map(|(u, c)| u * c).sum();
            column.iter_mut().zip(unit).for_each(|(c, u)| *c -= along * u);
        }
        let left = norm(&column);
        if left > INDEPENDENT * before {
            column.iter_mut().for_each(|c| *c /= left);
            basis.push(column);
            kept.push(term);
        }
    }
    kept
}
