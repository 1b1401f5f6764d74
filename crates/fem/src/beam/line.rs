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

/// A free stepped shaft from z = 0 on, cut into beam elements.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamLine {
    positions: Vec<f64>,
    /// Stiffness of all nodes' coordinates, six a node.
    pub stiffness: DMatrix<f64>,
    /// Consistent mass of the same.
    pub mass: DMatrix<f64>,
    /// Gyroscopic matrix of the same for a spin of 1 rad/s about +z ([`beam_gyroscopic`]).
    pub gyroscopic: DMatrix<f64>,
}

impl BeamLine {
    /// Pieces one after the other, with nodes at their ends and at `places` (mm), elements no longer than `longest`
    /// (mm).
    ///
    /// # Errors
    /// [`FemError::Length`] where a length is not positive or a place is not on the shaft.
    pub fn new(pieces: &[BeamPiece], places: &[f64], longest: f64, theory: BeamTheory) -> Result<Self, FemError> {
        let bad = |length_mm: f64| FemError::Length { length_mm };
        let total: f64 = pieces.iter().map(|p| p.length).sum();
        if !(total > 0.0 && total.is_finite()) {
            return Err(bad(total));
        }
        // Places nearer than this are one.
        let near = 1e-9 * total;
        if longest.is_nan() || longest <= near {
            return Err(bad(longest));
        }
        if let Some(&place) = places.iter().find(|p| !(-near..=total + near).contains(*p)) {
            return Err(bad(place));
        }
        let (mut positions, mut elements, mut start) = (vec![0.0], Vec::new(), 0.0);
        for piece in pieces {
            if piece.length.is_nan() || piece.length <= near {
                return Err(bad(piece.length));
            }
            let end = start + piece.length;
            let mut cuts: Vec<f64> = places.iter().copied().filter(|&p| p > start + near && p < end - near).collect();
            cuts.push(end);
            cuts.sort_by(f64::total_cmp);
            for cut in cuts {
                let from = positions[positions.len() - 1];
                if cut - from <= near {
                    continue;
                }
                let count = ((cut - from) / longest * (1.0 - 1e-9)).ceil().clamp(1.0, 1e4);
                for i in 1..=count as u32 {
                    positions.push(from + (cut - from) * f64::from(i) / count);
                    elements.push(((cut - from) / count, piece.section));
                }
            }
            start = end;
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
