//! Driving and coast flanks in one contact at rest, and loads that no tooth stands.

use contact::Method;
use geometry::{Driver, GearModifications, Sense};
use ltca::{StaticError, StaticOptions};
use testing::{Case, generated, modified};

const SENSES: [(Driver, Sense); 4] = [
    (Driver::Pinion, Sense::Ccw),
    (Driver::Pinion, Sense::Cw),
    (Driver::Wheel, Sense::Ccw),
    (Driver::Wheel, Sense::Cw),
];

fn small() -> Case {
    generated(20.0, [2, 2, 2, 4, 1])
}

/// With backlash the coast flanks stay apart: the transmission error is that of the driving flanks alone, whichever
/// gear drives whichever way.
#[test]
fn coast_flanks_that_stay_apart_change_nothing() {
    let case = small();
    for method in [Method::Slice, Method::Nodal] {
        for (driver, sense) in SENSES {
            let options = case.slice_options().with_contact(|c| {
                c.driver = driver;
                c.sense = sense;
                c.method = method
            });
            let [one, both] = [false, true].map(|both_flanks| {
                let mut model = case.reduced(options.clone().with_contact(|c| c.both_flanks = both_flanks));
                model.run(2, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{method:?} {driver:?} {sense:?}: {e}"))
            });
            for (a, b) in one.positions.iter().zip(&both.positions) {
                let off = (b.transmission_error / a.transmission_error - 1.0).abs();
                assert!(off < 1e-8, "{method:?} {driver:?} {sense:?}, phase {}: STE off by {off:e}", a.mesh_phase);
            }
        }
    }
}

/// A tooth of the wheel that stands back by more than the backlash wedges the pinion's tooth before it: coast flanks
/// press, driving flanks press the more, and the torque balances all the same.
#[test]
fn a_wedged_tooth_is_pressed_from_both_sides() {
    let mut case = small();
    let backlash = case.pair.backlash();
    let none = vec![0.0; case.pair.wheel.teeth() as usize];
    let mut wedged = GearModifications { pitch_errors: none, ..Default::default() };
    let normal_sum = |case: &Case, both_flanks: bool| {
        let options = case.slice_options().with_contact(|c| c.both_flanks = both_flanks);
        let history = case.reduced(options).run(4, 4, |_, _, _| ()).unwrap_or_else(|e| panic!("{e}"));
        for p in &history.positions {
            let off = p.certificate.torque_residual;
            assert!(off < 1e-8, "pinion at {} rad: torque residual {off:e}", p.pinion_angle);
        }
        let sum = |p: &ltca::StaticPosition| p.pairs.iter().map(|q| q.normal_force).sum::<f64>();
        history.positions.iter().map(sum).fold(0.0, f64::max)
    };
    // Either sign: one of the tooth's neighbours closes.
    let pressed = [-1.0, 1.0].map(|sign| {
        wedged.pitch_errors[0] = sign * (1.5 * backlash + 0.03);
        case.pair = modified(&testing::default_pair(), [GearModifications::default(), wedged.clone()]);
        normal_sum(&case, true) / normal_sum(&case, false)
    });
    assert!(pressed.iter().all(|&p| p > 1.1), "normal forces over those of the driving flanks alone: {pressed:?}");
}

/// A load under which teeth would bend by their own height is told as such, with the torque, and not as flanks that are
/// missing.
#[test]
fn a_load_that_no_tooth_stands_is_told() {
    let case = small();
    for torque_nm in [1e6, 1e9] {
        let options = StaticOptions { torque: 1e3 * torque_nm, ..case.slice_options() };
        let told = case.reduced(options).run(1, 1, |_, _, _| ()).err();
        assert!(
            matches!(told, Some(StaticError::Overloaded { torque_nm: t, .. }) if (t / torque_nm - 1.0).abs() < 1e-12),
            "{torque_nm} N m: {told:?}"
        );
    }
}
