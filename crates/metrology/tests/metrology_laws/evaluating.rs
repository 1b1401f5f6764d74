//! Evaluation of traces with known deviations.

use std::f64::consts::TAU;

use geometry::Side;
use metrology::{MetrologyError, TraceKind, evaluate, evaluate_trace, low_pass};

use crate::made::{gear, header, measured, trace};

/// Slope and crowning of a straight and of a parabolic trace, form and total of none.
#[test]
fn known_slopes_are_found() {
    let header = header(&gear());
    let [from, to] = header.profile_evaluation.unwrap().map(|d| header.roll_length(d));
    let t = |x: f64| (2.0 * x - from - to) / (to - from);
    let line = trace(&header, TraceKind::Profile(0.0), (0, Side::Left), |x| 1.5 + 0.5 * 4.25 * t(x));
    let found = evaluate_trace(&header, &line).unwrap();
    assert!((found.slope_um - 4.25).abs() < 1e-9, "{found:?}");
    assert!(found.form_um.abs() < 1e-9 && found.crowning_um.abs() < 1e-9, "{found:?}");
    // A straight line rises by its slope over the points that lie in the range.
    assert!((found.total_um - 4.25).abs() < 0.02, "{found:?}");
    let bent = trace(&header, TraceKind::Helix(95.0), (0, Side::Right), |z| {
        let [from, to] = header.helix_evaluation.unwrap();
        let t = (2.0 * z - from - to) / (to - from);
        -3.0 * t * t - 0.5 * 2.0 * t
    });
    let found = evaluate_trace(&header, &bent).unwrap();
    assert!((found.crowning_um - 3.0).abs() < 1e-9 && (found.slope_um + 2.0).abs() < 1e-9, "{found:?}");
}

/// The low pass lets half of a wave at its cut-off through, nothing of a short one, and lines as they are.
#[test]
fn the_low_pass_halves_a_wave_at_its_cut_off() {
    let wave = |length: f64| -> Vec<[f64; 2]> {
        (0..4000).map(|i| f64::from(i) * 0.005).map(|x| [x, (TAU * x / length).cos()]).collect()
    };
    let middle = |points: &[[f64; 2]]| -> f64 {
        let filtered = low_pass(points, 0.8);
        let amplitude = |of: &dyn Fn(usize) -> f64| (1000..3000).map(|i| of(i).powi(2)).sum::<f64>().sqrt();
        amplitude(&|i| filtered[i]) / amplitude(&|i| points[i][1])
    };
    assert!((middle(&wave(0.8)) - 0.5).abs() < 1e-6, "{}", middle(&wave(0.8)));
    assert!(middle(&wave(0.2)) < 1e-4 && middle(&wave(8.0)) > 0.99);
    let line: Vec<[f64; 2]> = (0..100).map(|i| f64::from(i).powf(1.1)).map(|x| [x, 3.0 - 0.25 * x]).collect();
    assert!(low_pass(&line, 12.0).iter().zip(&line).all(|(a, b)| (a - b[1]).abs() < 1e-12));
}

/// Pitch, thickness, twist and classes of a gear with known ones; another gear is told.
#[test]
fn a_gear_is_evaluated() {
    let gear = gear();
    let mut all = measured(|_, _| 0.0);
    all.pitch[0].index_um = (0..30).map(|k| if k == 7 { 5.0 } else { 0.0 }).collect();
    all.pitch[1].index_um = vec![0.0; 30];
    let [from, to] = all.header.profile_evaluation.unwrap().map(|d| all.header.roll_length(d));
    for (z, slope) in [(-8.0, -2.0), (0.0, 0.0), (8.0, 2.0)] {
        let t = |x: f64| (2.0 * x - from - to) / (to - from);
        all.traces.push(trace(&all.header, TraceKind::Profile(z), (3, Side::Right), |x| 0.5 * slope * t(x)));
    }
    let found = evaluate(&all, &gear).unwrap();
    assert_eq!((found.pitch[0].single_um, found.pitch[0].total_um), (5.0, 5.0));
    assert_eq!(found.thickness_variation_um, Some(5.0));
    let [(tooth, side, twist)] = found.twist_um[..] else { panic!("{:?}", found.twist_um) };
    assert_eq!((tooth, side), (3, Side::Right));
    assert!((twist - 4.0 * 20.0 / 16.0).abs() < 1e-9, "{twist}");
    let class = |name: &str| found.classes.iter().find(|c| c.0 == name).unwrap().2;
    // f_pT of class 5: 0.001 d + 0.4 m_n + 5 = 6.3 um; of class 4 4.45 um.
    assert_eq!(class("f_p"), Some(5));
    // f_HaT of class 3: (0.4 m_n + 0.001 d + 4)/2 = 2.65 um, of class 2 1.87 um.
    assert_eq!(class("f_Halpha"), Some(3));
    let mut other = all.clone();
    other.header.teeth = 31;
    let refused = evaluate(&other, &gear).unwrap_err();
    assert!(matches!(refused, MetrologyError::OtherGear { name: "teeth", .. }), "{refused}");
}
