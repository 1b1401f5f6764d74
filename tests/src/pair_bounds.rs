//! Bounds of the committed laws for measured pairs, beside their true errors: no run is needed.

use analysis::accuracy::{CalibratedMesh, Calibration, Quantity, QuantityLaws, together};

use crate::measured_pair::{LEAST_ERROR, MeasuredPair, RUNGS};

/// Numbers of positions.
const OF_POSITIONS: [u32; 3] = [8, 16, 32];

/// Bound of a number on a mesh with some positions, in the unit of the number.
#[derive(Debug, Clone, Copy)]
pub struct PairBound {
    /// Exact value less that of the run.
    error: f64,
    /// Known part of it, and the bound of the rest.
    known: f64,
    within: f64,
    scale: f64,
}

impl PairBound {
    /// Whether the exact value lies inside.
    pub fn holds(&self) -> bool {
        (self.error - self.known).abs() <= self.within
    }

    /// Bound over error.
    pub fn sharpness(&self) -> f64 {
        (self.known.abs() + self.within) / self.error.abs().max(LEAST_ERROR * self.scale.abs())
    }
}

/// Bounds of a number on every calibrated mesh with every number of positions; those that a pair lacks are left out.
pub fn pair_bounds(pair: &MeasuredPair, q: Quantity) -> Vec<PairBound> {
    let meshes = RUNGS.into_iter().map(CalibratedMesh::Rung).chain([CalibratedMesh::Default]);
    let all = meshes.flat_map(|mesh| OF_POSITIONS.map(|positions| (mesh, positions)));
    let Some(laws) = Calibration::committed().of(q) else { return Vec::new() };
    all.filter_map(|(mesh, positions)| pair_bound((pair, q), laws, mesh, positions)).collect()
}

/// How many times the bounds of these laws for external pairs the errors of a pair are, on every mesh with every number of
/// positions.
pub fn ratios(pair: &MeasuredPair, q: Quantity, laws: &QuantityLaws) -> Vec<f64> {
    let meshes = RUNGS.into_iter().map(CalibratedMesh::Rung).chain([CalibratedMesh::Default]);
    let all = meshes.flat_map(|mesh| OF_POSITIONS.map(|positions| (mesh, positions)));
    let bounds = all.filter_map(|(mesh, positions)| pair_bound((pair, q), laws, mesh, positions));
    bounds.map(|bound| (bound.error - bound.known).abs() / bound.within).collect()
}

fn pair_bound(
    (pair, q): (&MeasuredPair, Quantity),
    laws: &QuantityLaws,
    mesh: CalibratedMesh,
    positions: u32,
) -> Option<PairBound> {
    let (sample, features) = (pair.sample(mesh)?, pair.features(mesh)?);
    let (own, scale) = (sample.get(q)?, sample.scale(q)?);
    let number = pair.number(q, own);
    let of_mesh = laws.of_mesh(mesh)?.law.of(&features, &number, scale);
    let of_slices = laws.slices.of(&features, &number, scale);
    let (at, seen) = (pair.of_positions(positions)?, pair.seen(positions, q)?);
    let of_positions = laws.of_positions(positions)?.of(&pair.features_of_positions(positions)?, &seen, at.scale(q)?);
    let error = pair.mesh_error(mesh, q)? + pair.slices_error(q)? + pair.positions_error(positions, q)?;
    let all = [of_mesh, of_slices, of_positions];
    let known = all.iter().map(|[known, _]| known).sum();
    let own = if pair.scene.wheel.is_internal() { laws.internal } else { 1.0 };
    Some(PairBound { error, known, within: own * together(&all.map(|[_, within]| within)), scale })
}
