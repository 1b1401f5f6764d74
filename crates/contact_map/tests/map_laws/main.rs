//! What must hold of a map of the contact, shown with a contact that is known in closed form.

mod pairs;
mod synthetic;

use std::convert::Infallible;

use contact_map::{ContactMap, MapError, MapPlan, Wanted};
use synthetic::{MEAN_FORCE, Row};

fn plan(tolerance: f64) -> MapPlan {
    MapPlan {
        mean_force: MEAN_FORCE,
        largest_force: 4.0 * MEAN_FORCE,
        tilt: None,
        width: 20.0,
        half_path: None,
        tolerance,
        worst: tolerance,
    }
}

fn map(plan: &MapPlan) -> ContactMap {
    ContactMap::build(plan, &|_| {}, |phase| Ok::<_, Infallible>(Row::at(phase))).unwrap_or_else(|e| panic!("{e}"))
}

fn tilted() -> ContactMap {
    map(&MapPlan { tilt: Some([-1e-4, 1.5e-4]), ..plan(2e-3) })
}

const ALL: Wanted = Wanted { energy: true, phase_rate: true };

/// Between its places the map has the forces of the contact, to the error in its certificate.
#[test]
fn the_certificate_tells_the_error() {
    for tolerance in [1e-2, 1e-3, 1e-4] {
        let map = map(&plan(tolerance));
        let c = map.certificate();
        assert!(c.rms_error_mm <= tolerance * c.deflection_mm, "asked for {tolerance:e}: {c:?}");
        let mut squares = 0.0;
        for i in 0..200 {
            let (phase, share) = (0.0817 * f64::from(i), 0.3 + 0.007 * f64::from(i));
            let approach = map.approach(phase, 0.0, share * MEAN_FORCE);
            squares += (Row::at(phase).approach_under(share * MEAN_FORCE, 0.0) - approach).powi(2);
        }
        let rms = (squares / 200.0).sqrt();
        assert!(rms < 2.0 * c.rms_error_mm + 1e-12, "off by {rms:e} mm, the certificate says {:e}", c.rms_error_mm);
    }
}

/// Force, moment and the change with phase are the derivatives of the energy, and the stiffness is theirs: symmetric,
/// and right by differences, with load and with a tilt.
#[test]
fn forces_are_derivatives_of_the_energy() {
    let map = tilted();
    for (phase, force, tilt) in [
        (0.11, 0.4, 2e-5),
        (0.52, 1.0, -6e-5),
        (0.77, 2.3, 9e-5),
        (0.3, 5.0, 0.0),
        (0.3, 1.0, 1.7e-4),
        (0.6, 2.0, 9e-4),
        (0.9, 0.5, -1.2e-3),
    ] {
        let x = map.approach(phase, tilt, force * MEAN_FORCE);
        let at = |dp: f64, dx: f64, dt: f64| map.at(phase + dp, x + dx, tilt + dt, ALL);
        let here = at(0.0, 0.0, 0.0);
        let place = format!("at phase {phase}, {} N, tilt {tilt:e}", here.force);
        let slope = |of: &dyn Fn(f64) -> f64, h: f64| (of(h) - of(-h)) / (2.0 * h);
        let near = |a: f64, b: f64, scale: f64, what: &str| {
            assert!((a - b).abs() < 1e-6 * scale, "{place}: {what} is {a:e}, by differences {b:e}");
        };
        let (hx, ht, hp) = (1e-6, 1e-8, 1e-5);
        let energy = here.energy;
        near(here.force, slope(&|h| at(0.0, h, 0.0).energy, hx), here.force, "force");
        near(here.moment, -slope(&|h| at(0.0, 0.0, h).energy, ht), 20.0 * here.force, "moment");
        near(here.phase_rate, slope(&|h| at(h, 0.0, 0.0).energy, hp), 10.0 * energy, "change with phase");
        let [[xx, xt], [tx, tt]] = here.stiffness;
        near(xx, slope(&|h| at(0.0, h, 0.0).force, hx), xx, "stiffness");
        near(xt, slope(&|h| at(0.0, 0.0, h).force, ht), 20.0 * xx, "force over tilt");
        near(tt, -slope(&|h| at(0.0, 0.0, h).moment, ht), 400.0 * xx, "moment over tilt");
        assert_eq!(xt, tx, "{place}: the stiffness is not symmetric");
    }
}

/// Far beyond its tilts a map goes on: a force that grows with the approach, with a moment at the end of the line.
#[test]
fn a_map_goes_on_beyond_its_tilts() {
    let map = tilted();
    for i in 0..100 {
        let (phase, tilt) = (0.13 * f64::from(i), [-1e-4, 1.5e-4][i as usize % 2] * (1.0 + 0.2 * f64::from(i)));
        let touch = map.first_touch(&map.place(phase, tilt));
        let mut last = 0.0;
        for step in 1..40 {
            let here = map.at(phase, touch + 5e-4 * f64::from(step), tilt, ALL);
            assert!(here.force > last && here.energy > 0.0, "tilt {tilt:e}: {} N after {last} N", here.force);
            // The end of the line that tilts nearer presses.
            let lever = -here.moment / here.force * tilt.signum();
            assert!(lever > 0.0 && lever < 15.0, "tilt {tilt:e}: {lever} mm");
            last = here.force;
        }
    }
}

/// Flanks that do not touch give exactly nothing, and touch where the undeformed ones do.
#[test]
fn free_flight_is_exact() {
    let map = tilted();
    for i in 0..40 {
        let phase = f64::from(i) / 64.0;
        let touch = Row::at(phase).approach_under(0.0, 0.0);
        let apart = map.at(phase, touch - 1e-3, 0.0, ALL);
        assert_eq!((apart.force, apart.energy, apart.stiffness), (0.0, 0.0, [[0.0; 2]; 2]), "phase {phase}");
        let off = map.approach(phase, 0.0, 0.0) - touch;
        assert!(off.abs() < 1e-5, "phase {phase}: touches {off:e} mm off");
    }
}

/// The phase of a whole cycle later is the same phase, to the last bit where whole numbers are exact.
#[test]
fn a_cycle_later_is_the_same() {
    let map = map(&plan(1e-3));
    for i in 0..8 {
        let phase = f64::from(i) / 8.0;
        assert_eq!(map.at(phase, 0.02, 0.0, ALL), map.at(phase + 3.0, 0.02, 0.0, ALL), "phase {phase}");
        assert_eq!(map.at(phase, 0.02, 0.0, ALL), map.at(phase - 2.0, 0.02, 0.0, ALL), "phase {phase}");
    }
}

/// Dampers on the loaded slices, each held to the force there: the sum over the slices, and its slopes.
#[test]
fn damping_is_the_sum_over_the_slices() {
    let map = map(&plan(1e-4));
    for (phase, share, w) in [(0.0, 1.0, 1.0), (0.25, 0.6, 20.0), (0.5, 2.0, 60.0), (0.5, 1.0, -30.0)] {
        let force = share * MEAN_FORCE;
        let x = map.approach(phase, 0.0, force);
        let place = map.place(phase, 0.0);
        let of = |x: f64, rate: f64| {
            let contact = map.contact(&place, x, Wanted::default());
            map.damping(&place, &contact, [rate, 0.0], 1.0)
        };
        let here = of(x, w);
        let slices = Row::at(phase).loaded(x, 0.0);
        let sum: f64 = slices.iter().map(|s| (w * s.length).clamp(-s.force, s.force)).sum();
        assert!((here.force[0] - sum).abs() < 0.02 * sum.abs(), "phase {phase}: {} N, not {sum}", here.force[0]);
        let by_rate = (of(x, w + 1e-5).force[0] - of(x, w - 1e-5).force[0]) / 2e-5;
        let off = (here.rate_slope[0][0] - by_rate).abs();
        assert!(
            off < 1e-5 * by_rate.abs().max(1.0),
            "phase {phase}: slope {:e}, by differences {by_rate:e}",
            here.rate_slope[0][0]
        );
        let by_approach = (of(x + 1e-7, w).force[0] - of(x - 1e-7, w).force[0]) / 2e-7;
        let off = (here.approach_slope - by_approach).abs();
        assert!(
            off < 1e-4 * (here.force[0] / x).abs(),
            "phase {phase}: {:e} N/mm, by differences {by_approach:e}",
            here.approach_slope
        );
    }
}

/// What cannot be mapped to the tolerance is refused with what is left, and requests without meaning by their name.
#[test]
fn what_cannot_be_is_refused() {
    let refused = |plan: MapPlan| {
        ContactMap::build(&plan, &|_| {}, |phase| Ok::<_, Infallible>(Row::at(phase)))
            .expect_err("no map is as good as that")
    };
    match refused(plan(1e-12)) {
        MapError::Coarse { error, allowed, .. } => assert!(error > allowed && error < 1e-3, "{error:e}"),
        other => panic!("{other}"),
    }
    for wrong in [
        MapPlan { mean_force: f64::NAN, ..plan(1e-3) },
        MapPlan { largest_force: 0.0, ..plan(1e-3) },
        MapPlan { tilt: Some([1.0, -1.0]), ..plan(1e-3) },
    ] {
        let error = refused(wrong);
        assert!(matches!(error, MapError::OutOfRange { .. }), "{error}");
    }
}
