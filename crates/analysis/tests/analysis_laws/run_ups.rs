//! What is largest over the speed of a ramp, and where.

use analysis::motion::{MotionSeries, PeakOverSpeed, RPM, RunUp};
use dynamics::Speed;

/// Series of a pair of 30 teeth that runs up from 1000 to 3000/min in a second: order 1 has its largest amplitude,
/// 3 um, at 2000/min, order 2 is 0.5 um everywhere.
fn series() -> (MotionSeries, Speed) {
    let law = Speed::Ramp { from: 1000.0 * RPM, to: 3000.0 * RPM, start: 0.0, duration: 1.0 };
    let mut series = MotionSeries { pair_normal_force_n: Some(Vec::new()), ..MotionSeries::default() };
    let pitch = std::f64::consts::TAU / 30.0;
    let cycles = (law.angle(1.0) / pitch).floor() as u32;
    for row in 1..=cycles * 16 {
        let phase = f64::from(row) / 16.0;
        let time = law.time_at(phase * pitch).unwrap();
        let speed = law.at(time) / RPM;
        let size = 3.0 / (1.0 + ((speed - 2000.0) / 200.0).powi(2));
        let turn = std::f64::consts::TAU * phase;
        let dte = 5.0 + size * turn.cos() + 0.5 * (2.0 * turn).sin();
        series.time_s.push(time);
        series.pinion_speed_rpm.push(speed);
        series.dte_um.push(dte);
        series.normal_force_n.push(1000.0 * (1.0 + 0.2 * size));
        series.coast_normal_force_n.push(0.0);
        series.pair_normal_force_n.as_mut().unwrap().push(600.0 * (1.0 + 0.2 * size));
    }
    (series, law)
}

/// What is largest is found with its speed, however small the mean over the ramp is.
#[test]
fn the_largest_of_a_ramp_is_found_where_it_is() {
    let (series, law) = series();
    let lines = series.waterfall(16, 8, 30).unwrap();
    let run_up = RunUp::of(&series, 16, (law, 30), 1000.0, &lines).unwrap();
    let h = run_up.headline().unwrap();
    let near = |l: &PeakOverSpeed, value: f64| {
        assert!((l.driver_speed_rpm - 2000.0).abs() < 30.0, "{l:?}");
        assert!((l.mesh_frequency_hz / l.driver_speed_rpm - 0.5).abs() < 1e-12, "{l:?}");
        assert!((l.value / value - 1.0).abs() < 0.02, "{l:?}, not {value}");
    };
    // cos + sin of the double angle: 6 + what order 2 adds at both ends, 0.13.
    near(&h.peak_to_peak_dte_um, 6.16);
    near(&h.dte_harmonics_um[0], 3.0);
    near(&h.normal_force_n, 1600.0);
    near(&h.pair_normal_force_n.unwrap(), 960.0);
    near(&h.dynamic_factor.unwrap(), 1.6);
    assert!((h.dte_harmonics_um[1].value - 0.5).abs() < 0.05, "{:?}", h.dte_harmonics_um[1]);
    assert!(h.mean_peak_to_peak_dte_um < 0.5 * h.peak_to_peak_dte_um.value, "{h:?}");
}

/// Each mesh cycle has its place, and the speeds there go with the frequencies.
#[test]
fn every_cycle_has_speed_and_frequency() {
    let (series, law) = series();
    let lines = series.waterfall(16, 8, 30).unwrap();
    let run_up = RunUp::of(&series, 16, (law, 30), 1000.0, &lines).unwrap();
    let cycles = run_up.cycles.iter().map(|c| (c.driver_speed_rpm, c.mesh_frequency_hz));
    let both = cycles.chain(run_up.cuts.iter().map(|c| (c.driver_speed_rpm, c.mesh_frequency_hz)));
    both.for_each(|(n, f)| assert!((n * 0.5 - f).abs() < 1e-9 * f, "{n}/min, {f} Hz"));
    assert_eq!(run_up.cycles.len() * 16, series.len());
    assert!(run_up.cuts.len() > 50, "{} cuts", run_up.cuts.len());
}
