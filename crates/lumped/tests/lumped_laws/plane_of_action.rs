//! Contact lines of the lumped models against exact geometry, published lengths, and closed forms.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use geometry::{Driver, Sense, Side};
use lumped::{LineSharing, MeshFrame, PlaneOfAction};

use crate::common::{gears_003, gears_004, pair_003};

/// The total length is that of `geometry` at every phase, whichever gear drives and whichever way; friction's split is
/// that of the lines.
#[test]
fn lines_are_those_of_the_geometry() {
    for gears in [gears_004(), gears_003(30.25), gears_003(-30.25)] {
        for driver in [Driver::Pinion, Driver::Wheel] {
            for sense in [Sense::Ccw, Sense::Cw] {
                let frame = MeshFrame::of_pair(&gears, driver, sense);
                let plane = PlaneOfAction::of_pair(&gears, driver, &frame);
                // The pinion turns with or against the driver; xi of geometry runs from the pinion's tangent point.
                let pinion_drives = driver == Driver::Pinion;
                let turn = frame.sign() * if pinion_drives { 1.0 } else { -1.0 };
                let side: Side = frame.side();
                let pitch = gears.pinion.base_radius() * gears.working_pressure_angle().tan();
                for k in 0..29 {
                    let phase = f64::from(k) / 29.0;
                    let angle = gears.middle_angle(side) + turn * phase * gears.pinion.pitch_angle();
                    let lines = gears.contact_lines(side, angle);
                    let (mut length, mut split, mut centre) = (0.0, 0.0, [0.0; 2]);
                    for line in &lines {
                        length += line.length;
                        // Fine sums along the line: an implementation of its own.
                        let n = 2000;
                        for i in 0..n {
                            let z = line.z[0] + (line.z[1] - line.z[0]) * (f64::from(i) + 0.5) / f64::from(n);
                            let xi = gears.path_coordinate(side, angle, line.tooth, z);
                            let part = line.length / f64::from(n);
                            let (own, after) = if pinion_drives {
                                (xi, xi > pitch)
                            } else {
                                (gears.tangent_length() - xi, xi < pitch)
                            };
                            split += if after { part } else { -part };
                            centre[0] += part * own;
                            centre[1] += part * z;
                        }
                    }
                    let means = plane.at(phase);
                    let place = format!("{driver:?} drives {sense:?}, phase {phase:.3}");
                    assert!((means.length / length - 1.0).abs() < 1e-12, "{place}: {} mm, not {length}", means.length);
                    assert!(
                        (means.split[0] - split / length).abs() < 2e-3,
                        "{place}: split {} not {}",
                        means.split[0],
                        split / length
                    );
                    for (a, b) in means.centre.iter().zip(centre) {
                        assert!((a - b / length).abs() < 1e-6, "{place}: centre {a}, not {}", b / length);
                    }
                }
            }
        }
    }
}

/// Seed 003's printed lengths, with the parameters of the validation notes: longest line 21.51 mm, total 62.05 .. 62.08
/// mm; within 0.01 mm.
#[test]
fn seed_003_has_its_printed_lengths() {
    let plane = pair_003(30.25, Sense::Ccw, 0.0).plane;
    let all: Vec<_> = (0..2000).map(|k| plane.at(f64::from(k) / 2000.0)).collect();
    let longest = all.iter().map(|m| m.longest).fold(0.0, f64::max);
    let [low, high] = [f64::min, f64::max].map(|f| all.iter().map(|m| m.length).reduce(f).unwrap());
    println!(
        "eps_alpha {:.4}, eps_beta {:.4}; longest {longest:.4} mm, total {low:.3} .. {high:.3} mm",
        plane.transverse_contact_ratio(),
        plane.overlap_ratio()
    );
    assert!((longest - 21.51).abs() < 0.01, "longest {longest} mm");
    assert!((low - 62.05).abs() < 0.01 && (high - 62.08).abs() < 0.01, "total {low} .. {high} mm");
    assert!((plane.overlap_ratio() - 2.885).abs() < 1e-3);
}

/// Seed 004 (validation notes): L mean 103.9, min 99.8, max 105.6 mm, eps_alpha 1.708, eps_beta 1.106; the last printed
/// digit.
#[test]
fn seed_004_has_the_lengths_of_the_notes() {
    let gears = gears_004();
    let frame = MeshFrame::of_pair(&gears, Driver::Pinion, Sense::Ccw);
    let plane = PlaneOfAction::of_pair(&gears, Driver::Pinion, &frame);
    let all: Vec<f64> = (0..2000).map(|k| plane.at(f64::from(k) / 2000.0).length).collect();
    let mean = all.iter().sum::<f64>() / 2000.0;
    let [low, high] = [f64::min, f64::max].map(|f| all.iter().copied().reduce(f).unwrap());
    for (found, wanted) in [(mean, 103.9), (low, 99.8), (high, 105.6), (plane.mean_length(), 103.9)] {
        assert!((found - wanted).abs() < 0.06, "{found} mm, not {wanted}");
    }
    assert!((plane.transverse_contact_ratio() - 1.708).abs() < 6e-4 && (plane.overlap_ratio() - 1.106).abs() < 6e-4);
}

/// A wide pair of whole overlap ratio has one line's worth everywhere: the tilt spread of a single line of length l is
/// l^2 / 12.
#[test]
fn spread_of_one_line_is_that_of_a_bar() {
    let plane = PlaneOfAction {
        path: [10.0, 20.0],
        pitch_point: 15.0,
        tangent_length: 30.0,
        face_width: 24.0,
        helix: 0.0,
        base_pitch: 9.999,
        sharing: LineSharing::ByLength,
    };
    let means = plane.at(0.0);
    assert!((means.length - 24.0).abs() < 1e-12 && (means.spread - 48.0).abs() < 1e-10, "{means:?}");
    assert_eq!(plane.at(0.1).split[0], 1.0, "after the pitch point");
    for base_pitch in [0.0, 1e-300, f64::NAN] {
        let nonsense = PlaneOfAction { base_pitch, ..plane };
        assert_eq!(nonsense.at(0.3).length, 0.0, "base pitch {base_pitch}");
    }
}
