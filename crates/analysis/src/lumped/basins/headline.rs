//! What is read off basins.

use scene::BasinScene;
use serde::Serialize;

use super::{Attractor, BasinStart};

/// What basins are looked for; units are in the names.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs)] // the names say what they are, `docs/outputs.md` how they are formed
pub struct BasinHeadline {
    pub starts: usize,
    /// Of the plane, lowest and highest.
    pub initial_dte_um: [f64; 2],
    pub initial_dte_rate_mm_s: [f64; 2],
    pub coordinates: usize,
    pub mesh_resonance_hz: f64,
    pub attractors: Vec<Attractor>,
    /// Starts from which the motion does not come back.
    pub not_periodic: usize,
    /// Starts that no motion came out of.
    pub failed: usize,
}

impl BasinHeadline {
    pub(super) fn new(
        words: &BasinScene,
        (coordinates, mesh_resonance_hz): (usize, f64),
        starts: &[BasinStart],
        attractors: &[Attractor],
    ) -> Self {
        Self {
            starts: starts.len(),
            initial_dte_um: [words.from_um, words.to_um],
            initial_dte_rate_mm_s: [words.from_mm_s, words.to_mm_s],
            coordinates,
            mesh_resonance_hz,
            attractors: attractors.to_vec(),
            not_periodic: attractors.iter().filter(|a| a.period_cycles.is_none()).map(|a| a.starts).sum(),
            failed: starts.iter().filter(|s| s.attractor.is_none()).count(),
        }
    }

    /// What a user should hear.
    pub(super) fn warnings(&self, starts: &[BasinStart]) -> Vec<answer::Remark> {
        let failed = starts
            .iter()
            .find_map(|s| s.failed.as_ref())
            .map(|why| crate::remark::starts_unsolved(self.failed, self.starts, why.to_string()));
        let lost = (self.not_periodic > 0).then(|| crate::remark::starts_not_periodic(self.not_periodic, self.starts));
        failed.into_iter().chain(lost).collect()
    }
}
