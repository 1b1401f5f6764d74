//! Headline values of a branch.

use serde::Serialize;

use crate::branch::{BranchFigures, BranchPoint};

described::described! {
    /// What a continuation is made for; units are in the names.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct ContinuationHeadline {
        /// key that is varied
        pub key: &'static str,
        /// natural frequency of the mesh
        pub mesh_resonance_hz: f64,
        /// motion with the largest peak to peak
        pub largest: BranchPoint,
        /// figures of the branch
        #[serde(flatten)]
        pub figures: BranchFigures,
    }
}
