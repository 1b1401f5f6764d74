//! Any total contact ratio: from a spur pair with 1.2 to one with more than 5, the window sized by the program.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::time::Instant;

use geometry::GearData;
use mesh::Extent;
use testing::{Case, quadratic};

/// A spur pair of stubbed teeth.
fn low() -> Case {
    let data = GearData {
        teeth: 18,
        helix_angle: 0.0,
        addendum_coefficient: 0.75,
        face_width: 20.0,
        bore_diameter: 30.0,
        ..GearData::default()
    };
    quadratic([data.clone(), data], None, 60e3, [2, 2, 2, 3, 1], Extent::Whole)
}

/// The pair of seed 003: z 86/82, m_n 1.5057, alpha_n 15 deg, beta 30.25 deg; `face` mm wide.
fn seed_003(face: f64, torque: f64) -> Case {
    let data = GearData {
        teeth: 86,
        normal_module: 1.5057,
        normal_pressure_angle: 15f64.to_radians(),
        helix_angle: 30.25f64.to_radians(),
        // eps_alpha 2.00, as the published contact-line lengths ask for.
        addendum_coefficient: 1.15,
        dedendum_coefficient: 1.4,
        face_width: face,
        thickness_allowance: 0.02,
        bore_diameter: 110.0,
        ..GearData::default()
    };
    let wheel = GearData { teeth: 82, helix_angle: -data.helix_angle, bore_diameter: 105.0, ..data.clone() };
    quadratic([data, wheel], None, torque, [2, 2, 2, 4, 1], Extent::Whole)
}

/// Runs three mesh cycles; every one like the first, no step of STE over `steepest(mean, p-p)` (um).
fn runs(name: &str, case: &Case, positions: usize, steepest: impl Fn(f64, f64) -> f64) {
    let eps = case.pair.total_contact_ratio();
    let started = Instant::now();
    let mut options = case.slice_options();
    let mut model = case.reduced(options.clone());
    let mut reduced = started.elapsed().as_secs_f64();
    let mut started = Instant::now();
    // Corner contact may reach past floor(eps_gamma) + 1 teeth: one more, as the command does.
    let history = loop {
        match model.run(positions, 3, |_, _, _| ()) {
            Ok(history) => break history,
            Err(error) if error.is_starved() && options.window.is_none() => {
                options.window = Some(options.window_teeth(&case.pair) + 1);
                started = Instant::now();
                model = case.reduced(options.clone());
                reduced = started.elapsed().as_secs_f64();
                started = Instant::now();
            }
            Err(e) => panic!("{name}: {e}"),
        }
    };
    let each = started.elapsed().as_secs_f64() / (3 * positions) as f64;
    let te: Vec<f64> = history.positions.iter().map(|p| 1e3 * p.transmission_error).collect();
    let (mean, swing) = testing::mean_and_peak_to_peak(te.iter().copied());
    let drift = (positions..3 * positions).map(|i| (te[i] / te[i % positions] - 1.0).abs()).fold(0.0, f64::max);
    let step = te.windows(2).map(|w| (w[1] - w[0]).abs()).fold(0.0, f64::max);
    let most = history.positions.iter().map(|p| p.pairs.iter().filter(|q| q.normal_force > 0.0).count()).max().unwrap();
    let changes = history.positions.last().unwrap().tooth_changes;
    println!(
        "{name}: eps_gamma {eps:.3}, window {}, up to {most} pairs loaded, {changes} tooth changes; STE {mean:.3} um, p-p {swing:.4}, largest \
         step {step:.4}, cycles equal within {drift:.1e}; reduction {reduced:.1} s, {:.0} ms a position",
        model.options().window_teeth(&case.pair),
        1e3 * each
    );
    assert!(changes >= 2, "{name}: {changes} tooth changes");
    assert!(drift < 1e-8, "{name}: cycles differ by {drift:e}");
    assert!(history.positions.iter().all(|p| p.certificate.torque_residual < 1e-8), "{name}: torque");
    assert!(step < steepest(mean, swing), "{name}: STE steps by {step} um, p-p {swing} um");
    // Four times as many positions, smaller steps: STE has no jump, however steep it is.
    let fine = model.run(4 * positions, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{name}: {e}"));
    let finer: Vec<f64> = fine.positions.iter().map(|p| 1e3 * p.transmission_error).collect();
    let fine_step = finer.windows(2).map(|w| (w[1] - w[0]).abs()).fold(0.0, f64::max);
    println!("   with four times the positions the largest step is {fine_step:.4} um");
    assert!(fine_step < 0.6 * step, "{name}: steps of {step} um shrink to {fine_step} um only");
}

#[test]
fn spur_pair_of_1_2() {
    let case = low();
    let eps = case.pair.total_contact_ratio();
    assert!((1.15..1.3).contains(&eps), "{eps}");
    // A second pair takes over within a fraction of a step; `corner_contact` shows that STE has no jump there.
    runs("spur", &case, 24, |_, swing| 0.7 * swing);
}

#[test]
fn seed_003_of_4_9() {
    let case = seed_003(27.09, 100e3);
    let eps = case.pair.total_contact_ratio();
    assert!((4.8..5.0).contains(&eps), "{eps}");
    runs("seed 003", &case, 16, |mean, _| 0.01 * mean);
}

#[test]
fn seed_003_made_wider_of_5_2() {
    let case = seed_003(30.0, 100e3);
    assert!((5.1..5.4).contains(&case.pair.total_contact_ratio()));
    runs("seed 003, b 30", &case, 16, |mean, _| 0.01 * mean);
}

/// A window of seven teeth of a gear of eight reaches to its far side: what lies there is no contact, and changes
/// nothing.
#[test]
fn teeth_on_the_far_side_do_not_touch() {
    let data = GearData {
        teeth: 10,
        normal_module: 0.5,
        helix_angle: (-7.7f64).to_radians(),
        profile_shift: 0.47,
        thickness_allowance: 0.02,
        face_width: 2.0,
        bore_diameter: 1.5,
        ..GearData::default()
    };
    let wheel = GearData {
        teeth: 8,
        profile_shift: 0.07,
        helix_angle: -data.helix_angle,
        thickness_allowance: 0.0,
        bore_diameter: 1.0,
        ..data.clone()
    };
    let case = quadratic([data, wheel], None, 25.0, [2, 2, 1, 2, 1], Extent::Whole);
    let [near, all] = [3, 7].map(|teeth| {
        let mut options = case.slice_options();
        options.window = Some(teeth);
        let history = case.reduced(options).run(4, 1, |_, _, _| ());
        history.unwrap_or_else(|e| panic!("window of {teeth} teeth: {e}")).positions
    });
    for (a, b) in near.iter().zip(&all) {
        let off = (b.transmission_error / a.transmission_error - 1.0).abs();
        assert!(off < 1e-8, "phase {}: {} and {} mm", a.mesh_phase, a.transmission_error, b.transmission_error);
    }
}
