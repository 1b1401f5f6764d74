//! What is computed, with which model.

use serde::Serialize;

use crate::schema::{Kind, Model, Reduction};

fn is_zero(value: &u32) -> bool {
    *value == 0
}

/// What is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Analysis {
    /// Quasi-static or in time.
    pub kind: Kind,
    /// Which rung of the ladder of models.
    pub model: Model,
    /// Which way gears are condensed; only the reduced model has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reduction: Option<Reduction>,
    /// Positions in one mesh cycle, the end point left out.
    pub positions_per_cycle: u32,
    /// Mesh cycles; 0 where they follow from a duration or a ramp.
    #[serde(skip_serializing_if = "is_zero")]
    pub cycles: u32,
    /// Teeth in the window; `None`: floor(eps_gamma) + 1, at least 3.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub window_teeth: Option<u32>,
}

impl Analysis {
    /// Whether gears are to be condensed without the symmetry of their teeth.
    pub fn is_general(&self) -> bool {
        self.reduction == Some(Reduction::General)
    }
}

impl Model {
    /// Whether gears are known from their flanks, and contact is solved between them.
    pub fn is_reduced(self) -> bool {
        matches!(self, Self::Reduced | Self::ReducedModes)
    }

    /// Whether it is made of gears that are known from their flanks: these, or a map of their contact.
    pub fn has_reduced_gears(self) -> bool {
        self.is_reduced() || self == Self::Mapped
    }
}
