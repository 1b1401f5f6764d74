//! Which keys the headline of a scene will have, before any work.

use described::Key;
use scene::Scene;

use crate::{
    lumped::{LumpedHeadline, is_lumped},
    motion::MotionHeadline,
    results::StaticHeadline,
};

/// Keys of the headline of a scene's `summary.json`, those that a run may leave out included.
pub fn headline_keys(scene: &Scene) -> &'static [Key] {
    match &scene.motion {
        None => StaticHeadline::KEYS,
        Some(_) if is_lumped(scene) => LumpedHeadline::KEYS,
        Some(_) => MotionHeadline::KEYS,
    }
}
