//! Headline values of basins.

use scene::BasinScene;
use serde::Serialize;

use super::{Attractor, BasinStart};

described::described! {
    /// What basins are looked for; units are in the names.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct BasinHeadline {
        /// starts of the plane
        pub starts: usize,
        /// smallest and largest initial DTE, relative to rest under the load
        pub initial_dte_um: [f64; 2],
        /// smallest and largest initial rate of the DTE, relative to rest
        pub initial_dte_rate_mm_s: [f64; 2],
        /// coordinates of the model
        pub coordinates: usize,
        /// natural frequency of the mesh
        pub mesh_resonance_hz: f64,
        /// motions in which starts end
        pub attractors: Vec<Attractor>,
        /// starts from which the motion does not come back
        pub not_periodic: usize,
        /// starts without a motion
        pub failed: usize,
    }
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
    pub(super) fn remarks(&self, starts: &[BasinStart]) -> Vec<answer::Remark> {
        let failed = starts
            .iter()
            .find_map(|s| s.failed.as_ref())
            .map(|why| crate::remark::starts_unsolved(self.failed, self.starts, why.to_string()));
        let lost = (self.not_periodic > 0).then(|| crate::remark::starts_not_periodic(self.not_periodic, self.starts));
        failed.into_iter().chain(lost).collect()
    }
}
