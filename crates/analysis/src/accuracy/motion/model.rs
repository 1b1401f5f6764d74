//! Models of a motion, cheapest first, each for the same scene.

use scene::{Model, Scene};
use serde::Serialize;

/// A model of the ladder in motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub enum MotionModel {
    /// Twelve coordinates, linear, with the mesh cycle of the static reduced model.
    #[serde(rename = "lumped12")]
    Lumped12,
    /// Flanks of the tooth window, with quasi-static elasticity.
    #[serde(rename = "reduced")]
    Reduced,
    /// Reduced gears with normal modes of both.
    #[serde(rename = "reduced+modes")]
    ReducedModes,
}

impl MotionModel {
    /// All models of the ladder, cheapest first.
    pub const ALL: [Self; 3] = [Self::Lumped12, Self::Reduced, Self::ReducedModes];

    /// Model of a scene that names it; `None` for `auto`, and for models without error bounds.
    pub fn of(scene: &Scene) -> Option<Self> {
        match scene.analysis.model {
            Model::Reduced => Some(Self::Reduced),
            Model::ReducedModes => Some(Self::ReducedModes),
            _ => None,
        }
    }

    /// Name as in `[analysis]`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Lumped12 => "lumped12",
            Self::Reduced => "reduced",
            Self::ReducedModes => "reduced+modes",
        }
    }

    /// The next more expensive model.
    pub fn finer(self) -> Option<Self> {
        Self::ALL.iter().find(|m| **m > self).copied()
    }

    /// Steps in a period of its fastest motion that it begins with, where a model without modes takes so many in one of
    /// the resonance: its highest mode need not be shown as well.
    pub(super) fn first_steps(self, of_resonance: u32) -> u32 {
        if self == Self::ReducedModes { (of_resonance / 2).max(4) } else { of_resonance }
    }

    /// Whether the model is valid for a scene; twelve coordinates need no friction and gears on fixed axes.
    pub fn knows(self, scene: &Scene) -> bool {
        let fixed = |gear: &&scene::GearScene| gear.body.as_ref().is_none_or(|b| b.free.is_empty());
        self != Self::Lumped12 || (scene.gears().iter().all(fixed) && scene.contact.friction == 0.0)
    }
}
