//! The analysis and its model.

use crate::schema::{Analysis, Model, Reduction};

impl Analysis {
    /// Mesh cycles as a scene file states them: none where they follow from a duration or a ramp.
    pub(crate) fn written_cycles(&self) -> Option<u32> {
        Some(self.cycles).filter(|cycles| *cycles > 0)
    }

    /// Whether gears are condensed without using the symmetry of their teeth.
    pub fn is_general(&self) -> bool {
        self.reduction == Some(Reduction::General)
    }
}

impl Model {
    /// Whether gears are reduced to their flanks, with contact solved between them.
    pub fn is_reduced(self) -> bool {
        matches!(self, Self::Reduced | Self::ReducedModes)
    }

    /// Whether the model is based on gears reduced to their flanks: these themselves, or a map of their contact.
    pub fn has_reduced_gears(self) -> bool {
        self.is_reduced() || self == Self::Mapped
    }
}
