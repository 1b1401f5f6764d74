//! Words of a scene in the units and terms of the solvers.

use contact::{GapSource, Law};
use dynamics::{Misalignment, Offset, StaticOptions};
use geometry::GearPair;

use crate::scene::{Driver, Flanks, Gap, Method, Rotation, Scene};

/// What a scene asks of the analysis.
pub(crate) fn options(scene: &Scene, pair: &GearPair) -> StaticOptions {
    let defaults = StaticOptions::new(scene.operation.torque(), pair);
    let m = scene.pair.misalignment;
    let misalignment = Misalignment {
        deviation: 1e-3 * m.deviation_um,
        inclination: 1e-3 * m.inclination_um,
        in_plane_of_action: 1e-3 * m.in_plane_of_action_um,
        across_plane_of_action: 1e-3 * m.across_plane_of_action_um,
    };
    StaticOptions {
        offsets: [Offset::default(), misalignment.wheel_offset(pair, scene.side())],
        driver: match scene.operation.driver {
            Driver::Pinion => dynamics::Driver::Pinion,
            Driver::Wheel => dynamics::Driver::Wheel,
        },
        sense: match scene.operation.rotation {
            Rotation::Ccw => ale::Sense::Ccw,
            Rotation::Cw => ale::Sense::Cw,
        },
        method: match scene.contact.method {
            Method::Slice => dynamics::Method::Slice,
            Method::Nodal => dynamics::Method::Nodal,
        },
        slices: scene.contact.slices.map_or(defaults.slices, |n| n as usize),
        corner_contact: scene.contact.corner_contact.unwrap_or(defaults.corner_contact),
        friction: scene.contact.friction,
        law: scene.contact.penalty_mpa_per_mm.map_or(Law::Exact, Law::Penalty),
        gap: match scene.contact.gap {
            Some(Gap::Facet) => GapSource::Facet,
            Some(Gap::Smooth) | None => GapSource::Smooth,
        },
        points_per_face_edge: scene.contact.points_per_face_edge.map_or(defaults.points_per_face_edge, |n| n as usize),
        both_flanks: scene.contact.flanks == Flanks::Both,
        window: scene.analysis.window_teeth.map(|w| w as usize),
        root_stress: scene.output.root_stress,
        ..defaults
    }
}
