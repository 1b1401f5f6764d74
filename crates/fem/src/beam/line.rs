//! A stepped shaft as a row of beams.

use nalgebra::DMatrix;

use super::{BeamSection, BeamTheory, NODE_COORDINATES, beam_gyroscopic, beam_mass, beam_stiffness};
use crate::FemError;

/// A piece of shaft with a constant section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamPiece {
    /// Length, mm, > 0.
    pub length: f64,
    /// Section of the piece.
    pub section: BeamSection,
}

/// Places beyond the ends of a shaft by this share of its length are on it: digits of files.
const FAR_OFF: f64 = 1e-9;
/// Largest share of a shaft's length that two places may lie apart and count as one, however slender it is.
const LARGEST_MERGED: f64 = 1e-4;

/// Distance (mm) below which two positions on a shaft are treated as one. At this distance, moving a part causes as
/// small an error as the round-off of an element of this length.
///
/// ```text
/// t = 10 sqrt(eps) L max(L/D, 1), at the most 1e-4 L      L: length of the shaft, D: its least outer diameter, mm
/// ```
/// An element of length t is stiffer in shear than the shaft in bending by about L^3/(t D^2), so its round-off is eps
/// L^3/(t D^2) of the shaft's own stiffness. Moving a part by t changes that stiffness by t/L. Without
/// the factor 10 both errors are sqrt(eps) L/D. The factor makes the second one larger, because its effect on a result
/// is smooth, while a resonance multiplies round-off. For usual shafts t/L is 1e-6. The distance is proportional to the
/// size of the shaft.
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

/// A free stepped shaft that starts at z = 0, divided into beam elements.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamLine {
    positions: Vec<f64>,
    /// Stiffness in the coordinates of all nodes, six per node.
    pub stiffness: DMatrix<f64>,
    /// Consistent mass in the same coordinates.
    pub mass: DMatrix<f64>,
    /// Gyroscopic matrix in the same coordinates for a spin of 1 rad/s about +z (`beam_gyroscopic`).
    pub gyroscopic: DMatrix<f64>,
}

impl BeamLine {
    /// Joins pieces in order. Nodes lie at the ends of the pieces and at `places` (mm); elements are at most `longest`
    /// (mm). Positions closer than [`coincidence`] share a node, because a shorter element would cost more accuracy
    /// than moving the position.
    ///
    /// # Errors
    /// [`FemError::Length`] if a length is not positive or a place is not on the shaft.
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

    /// A shaft without length, mass and stiffness: a single node at z = 0.
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
