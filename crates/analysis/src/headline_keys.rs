//! Keys of a scene's headline before the solution.

use described::Key;
use scene::Scene;

use crate::{
    lumped::{LumpedHeadline, is_lumped},
    motion::MotionHeadline,
    results::StaticHeadline,
};

/// Keys of the headline of a scene's `summary.json`, including those that a run may omit.
pub fn headline_keys(scene: &Scene) -> &'static [Key] {
    match &scene.motion {
        None => StaticHeadline::KEYS,
        Some(_) if is_lumped(scene) => LumpedHeadline::KEYS,
        Some(_) => MotionHeadline::KEYS,
    }
}
