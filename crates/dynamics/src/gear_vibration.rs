//! Normal modes of a gear that move in addition to its rigid body.

use std::sync::Arc;

use reduction::GearModes;

/// Normal modes of a gear with their damping.
#[derive(Debug, Clone)]
pub struct GearVibration {
    /// Shapes and frequencies with bore held and flanks free ([`reduction::GearReducer::modes`]), or those of its
    /// Craig-Bampton model ([`reduction::GearReducer::craig_bampton_modes`]).
    pub modes: Arc<GearModes>,
    /// Damping ratio of every mode, 0 .. 1; steel alone has about 0.001.
    pub damping_ratio: f64,
}
