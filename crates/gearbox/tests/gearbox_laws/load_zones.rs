//! Load zones of rolling bearings: which elements carry, and how much.

use gearbox::rolling_bearing::{ElementLoad, RollerGeometry, RollerProfile, RollingElements};
use nalgebra::Vector5;

use crate::rolling::{MIDDLE, PLAYLESS, all_kinds, made, places, rollers};

/// The load zone is what the reply counts and presses hardest; rollers across the axis hold the radial force by it. Without
/// play half of the turn carries, under a preload all of it, with play less.
#[test]
fn load_zones_are_what_bearings_carry_by() {
    for (name, bearing) in all_kinds() {
        for place in places() {
            let (zone, reply) = (bearing.load_zone(&place), bearing.evaluate(&place));
            let largest = zone.iter().map(|own| own.force).fold(0.0, f64::max);
            assert!((largest - reply.element_force).abs() <= 1e-12 * largest, "{name}: {largest} N");
            assert_eq!(zone.iter().filter(|own| own.force > 0.0).count(), reply.loaded, "{name}");
            if name.starts_with("cylindrical") {
                let sum = |of: fn(f64) -> f64| -> f64 { zone.iter().map(|own| own.force * of(own.angle)).sum() };
                let off = (sum(f64::cos) + reply.force[0]).hypot(sum(f64::sin) + reply.force[1]);
                assert!(off < 1e-12 * largest * zone.len() as f64, "{name}: off by {off} N");
            }
        }
    }
    let geometry = RollerGeometry { elements: 90, diameter: 1.5, ..rollers(0.0, RollerProfile::Straight) };
    let arc = |clearance: f64| {
        let bearing = made(RollingElements::Rollers(geometry), &MIDDLE, clearance, PLAYLESS);
        ElementLoad::zone(&bearing.load_zone(&Vector5::new(0.02, 0.0, 0.0, 0.0, 0.0))).to_degrees()
    };
    // Loaded where d cos(psi) > clearance/2; elements are 4 degrees apart, the two at right angles carry nothing.
    for (clearance, wanted) in [(0.0, 176.0), (0.02, 120.0), (-0.1, 360.0), (0.05, 0.0)] {
        assert!((arc(clearance) - wanted).abs() <= 8.0, "{} for {wanted} degrees", arc(clearance));
    }
}
