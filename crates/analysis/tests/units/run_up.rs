//! Laws of what `run_up` keeps to itself.

use super::*;

/// The torque is J times the largest acceleration of the ramp itself.
#[test]
fn the_torque_of_a_ramp_is_its_largest_acceleration_on_the_inertia() {
    let speed = Speed::Ramp { from: 50.0, to: 250.0, start: 0.5, duration: 4.0 };
    let torque = RunUpTorque::new(speed, (3.0, -0.5), 700.0).unwrap();
    let steepest = (0..=800).map(|i| speed.acceleration(0.5 + 0.005 * f64::from(i))).fold(0.0, f64::max);
    assert!((torque.inertia / (3.0 * 0.5 * steepest) - 1.0).abs() < 1e-12, "{torque:?}, not {steepest}");
    assert!(torque.remark("the input", "wait").is_some());
    assert_eq!(RunUpTorque { load: 1e4, ..torque }.remark("the input", "wait"), None);
    assert_eq!(RunUpTorque::new(Speed::Constant(50.0), (3.0, 1.0), 700.0), None);
}
