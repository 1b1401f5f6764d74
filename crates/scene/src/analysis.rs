//! What is computed, with which model.

use serde::Serialize;

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

choices! {
    /// Which way gears are condensed.
    pub enum Reduction {
        /// One sector where the gear is cyclic, else the whole gear.
        Auto = "auto",
        /// The whole gear in one factor.
        General = "general",
    }
}

choices! {
    /// Quasi-static or in time.
    pub enum Kind {
        /// Equilibrium at every position.
        Static = "static",
        /// Motion in time.
        Dynamic = "dynamic",
    }
}

choices! {
    /// A model of the pair.
    pub enum Model {
        /// Flanks of the tooth window.
        Reduced = "reduced",
        /// The cheapest that is as exact as `[accuracy]` asks.
        Auto = "auto",
        /// The same with normal modes of both gears, in time.
        ReducedModes = "reduced+modes",
        /// A map of the contact of the reduced gears, in time.
        Mapped = "mapped",
        /// Every degree of freedom of both meshes.
        Full = "full",
        /// ISO 6336-1 stiffness and analytic contact lines; no mesh.
        Iso = "iso",
        /// Eight coordinates, mesh stiffness, backlash and friction.
        Lumped8 = "lumped8",
        /// Twelve coordinates.
        Lumped12 = "lumped12",
        /// Two lumped shafts with the mesh between them.
        Shaft18 = "shaft18",
        /// Rigid gears, force by overlap of their true flanks.
        Impact = "impact",
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
