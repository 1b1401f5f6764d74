//! How each value of a plan starts, and the interval between points of a section.

use crate::Scene;

choices! {
    /// How the next value of a plan starts.
    pub enum Start {
        /// Alone.
        Each = "each",
        /// From the state of the last one.
        Carry = "carry",
        /// From its neighbours on the branch of periodic motions.
        Branch = "branch",
        /// From a state of its own: a displacement and a rate.
        Basin = "basin",
    }
}

choices! {
    /// How often the section of a motion has a point.
    pub enum SectionEvery {
        /// Once a mesh cycle.
        MeshCycle = "mesh-cycle",
        /// Once a turn of the pinion.
        PinionTurn = "pinion-turn",
        /// Once a turn of the wheel.
        WheelTurn = "wheel-turn",
    }
}

impl SectionEvery {
    /// Number of mesh cycles between points of a section.
    pub fn cycles(self, scene: &Scene) -> u32 {
        match self {
            Self::MeshCycle => 1,
            Self::PinionTurn => scene.pinion.teeth,
            Self::WheelTurn => scene.wheel.teeth,
        }
    }
}
