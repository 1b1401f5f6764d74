//! How exact a result is, and what was tried for it.

use serde::Serialize;

use super::{Bound, motion::MotionModel};

/// How exact a result is, and how that is known.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Accuracy {
    /// Share of the pairs of the calibration that lie within their bounds, by cause.
    pub coverage: f64,
    /// Pairs that the calibration was made of.
    pub calibrated_on_pairs: usize,
    /// What the run was held against.
    pub held_against: String,
    /// Bounds of all headline numbers that the run has.
    pub bounds: Vec<Bound>,
    /// Rungs of the ladder that were tried, in their order; empty where the scene says what is taken.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rungs: Vec<TriedRung>,
    /// Models of a motion that were tried, in their order; empty where the scene says what is taken, and at rest.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub models: Vec<TriedModel>,
    /// What the bounds do not cover.
    pub not_covered: Vec<String>,
}

impl Accuracy {
    /// Whether everything that is asked is kept.
    pub fn is_met(&self) -> bool {
        self.bounds.iter().all(|b| b.met != Some(false))
    }

    /// What is asked and not kept.
    pub fn missed(&self) -> impl Iterator<Item = &Bound> {
        self.bounds.iter().filter(|b| b.met == Some(false))
    }
}

/// A rung that was tried.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TriedRung {
    /// Elements along the profile, as many in proportion in all other directions; `None` for meshes of the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elements_profile: Option<u32>,
    /// Slices over the face width.
    pub slices: Option<u32>,
    /// Positions of the mesh cycle.
    pub positions_per_cycle: u32,
    /// Why it was left; `None` for the one that was taken.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_because: Option<String>,
}

/// A model that was tried.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TriedModel {
    /// Which.
    pub model: MotionModel,
    /// Elements along the profile, as many in proportion in all other directions; `None` for meshes of the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elements_profile: Option<u32>,
    /// Slices over the face width.
    pub slices: Option<u32>,
    /// Steps in a period of the fastest motion, at least.
    pub steps_per_resonance: u32,
    /// Why it was left; `None` for the one that was taken.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_because: Option<String>,
}
