//! What is computed, with which model.

use crate::schema::{Analysis, Model, Reduction};

impl Analysis {
    /// Mesh cycles as a scene file states them: none where they follow from a duration or a ramp.
    pub(crate) fn written_cycles(&self) -> Option<u32> {
        Some(self.cycles).filter(|cycles| *cycles > 0)
    }

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
