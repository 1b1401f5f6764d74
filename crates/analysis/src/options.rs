//! Settings of a scene in the units and types of the solvers.

use contact::{Misalignment, Offset, complementarity::Law, flank::GapSource};
use geometry::GearPair;
use ltca::StaticOptions;

use scene::{Flanks, Gap, Method, Scene};

/// Options of the static analysis of a scene.
pub fn options(scene: &Scene, pair: &GearPair) -> StaticOptions {
    let defaults = StaticOptions::new(scene.operation.torque(), pair);
    let [deviation, inclination, in_plane_of_action, across_plane_of_action] = scene.pair.misalignment.in_mm();
    let misalignment = Misalignment { deviation, inclination, in_plane_of_action, across_plane_of_action };
    StaticOptions {
        window: scene.analysis.window_teeth.map(|w| w as usize),
        root_stress: scene.output.root_stress,
        gap_rates: scene.output.flank_orders,
        ..defaults
    }
    .with_contact(|c| {
        c.offsets = [Offset::default(), misalignment.wheel_offset(pair, scene.side())];
        (c.driver, c.sense) = (scene.operation.driver, scene.operation.rotation);
        c.method = match scene.contact.method {
            Method::Slice => contact::Method::Slice,
            Method::Nodal => contact::Method::Nodal,
        };
        c.slices = scene.contact.slices.map_or(c.slices, |n| n as usize);
        c.corner_contact = scene.contact.corner_contact.unwrap_or(c.corner_contact);
        c.friction = scene.contact.friction;
        c.law = scene.contact.penalty_mpa_per_mm.map_or(Law::Exact, Law::Penalty);
        c.gap = match scene.contact.gap {
            Some(Gap::Facet) => GapSource::Facet,
            Some(Gap::Smooth) | None => GapSource::Smooth,
        };
        c.points_per_face_edge = scene.contact.points_per_face_edge.map_or(c.points_per_face_edge, |n| n as usize);
        c.both_flanks = scene.contact.flanks == Flanks::Both;
    })
}
