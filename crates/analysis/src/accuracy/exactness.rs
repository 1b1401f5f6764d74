//! Accuracy of a result, and the settings tried for it.

use serde::Serialize;

use super::{Bound, motion::MotionModel};
use crate::refused::{Blame, Refusal};

described::described! {
    /// How exact a result is, and how that is known.
    #[derive(Debug, Clone, Default, PartialEq, Serialize)]
    pub struct Accuracy {
        /// share of the random pairs of the calibration whose error lies within the bound
        pub coverage: f64,
        /// number of these pairs
        pub calibrated_on_pairs: usize,
        /// what the run was compared with
        pub held_against: String,
        /// bounds of all headline numbers that the run has
        pub bounds: Vec<Bound>,
        /// rungs of the ladder that were tried, in their order; missing where the scene says what is taken
        #[serde(skip_serializing_if = "Vec::is_empty")]
        pub rungs: Vec<TriedRung>,
        /// models of a motion that were tried, in their order; missing at rest and where the scene says what is taken
        #[serde(skip_serializing_if = "Vec::is_empty")]
        pub models: Vec<TriedModel>,
        /// settings of a gearbox that were tried, in their order; missing for a pair
        #[serde(skip_serializing_if = "Vec::is_empty")]
        pub settings: Vec<TriedSettings>,
        /// errors that the bounds do not cover
        pub not_covered: Vec<String>,
        /// whether a pair is like those of the calibration
        #[serde(skip)]
        pub is_calibrated: bool,
    }
}

impl Accuracy {
    /// Whether all requested accuracies are met.
    pub fn is_met(&self) -> bool {
        self.bounds.iter().all(|b| b.met != Some(false))
    }

    /// Requested accuracies that are not met.
    pub fn missed(&self) -> impl Iterator<Item = &Bound> {
        self.bounds.iter().filter(|b| b.met == Some(false))
    }

    /// Whether everything that is asked is kept.
    ///
    /// # Errors
    /// [`Refusal`] of numbers that are less exact than asked.
    pub(crate) fn verdict(&self) -> Result<(), Refusal> {
        let missed: Vec<String> = self
            .missed()
            .map(|b| format!("{} is {}, within {} is asked", b.name(), b.words(), b.asked_words()))
            .collect();
        if missed.is_empty() {
            return Ok(());
        }
        let what = format!("the accuracy asked for is not kept: {}", missed.join(", "));
        let hint = Some("ask for less, or see `accuracy` in summary.json for what the bounds are made of".to_owned());
        Err(Refusal { what, hint, blame: Blame::Inexact })
    }

    /// The bound that is most times larger than what is asked; `None` where everything is kept.
    pub(crate) fn worst(&self) -> Option<&Bound> {
        self.missed().max_by(|a, b| a.over().total_cmp(&b.over()))
    }

    /// What is asked and not kept, in words.
    pub(crate) fn shortfall(&self) -> String {
        self.missed().map(Bound::shortfall).collect::<Vec<_>>().join("; ")
    }
}

described::described! {
    /// A rung that was tried.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct TriedRung {
        /// elements along the profile, all other directions in proportion; missing for meshes of the scene
        #[serde(skip_serializing_if = "Option::is_none")]
        pub elements_profile: Option<u32>,
        /// slices over the face width
        pub slices: Option<u32>,
        /// positions of the mesh cycle
        pub positions_per_cycle: u32,
        /// reason why the rung was left; missing for the one that was taken
        #[serde(skip_serializing_if = "Option::is_none")]
        pub left_because: Option<String>,
    }
}

described::described! {
    /// A model that was tried.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct TriedModel {
        /// model of the motion
        pub model: MotionModel,
        /// elements along the profile, all other directions in proportion; missing for meshes of the scene
        #[serde(skip_serializing_if = "Option::is_none")]
        pub elements_profile: Option<u32>,
        /// slices over the face width
        pub slices: Option<u32>,
        /// steps in a period of the fastest motion, at least
        pub steps_per_resonance: u32,
        /// reason why the model was left; missing for the one that was taken
        #[serde(skip_serializing_if = "Option::is_none")]
        pub left_because: Option<String>,
    }
}

described::described! {
    /// Settings of a gearbox that were tried.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct TriedSettings {
        /// elements along the profile, all other directions in proportion, of the meshes that the program makes; missing where the scenes of all pairs state theirs
        #[serde(skip_serializing_if = "Option::is_none")]
        pub elements_profile: Option<u32>,
        /// slices over the face width of every mesh
        pub slices: Vec<u32>,
        /// positions in a cycle of the first mesh
        pub positions_per_cycle: u32,
        /// elements along every shaft, at least
        pub shaft_elements: u32,
        /// reason why the settings were left; missing for those that were taken
        #[serde(skip_serializing_if = "Option::is_none")]
        pub left_because: Option<String>,
    }
}
