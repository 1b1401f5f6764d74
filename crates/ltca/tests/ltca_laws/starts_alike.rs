//! A position has one answer, wherever its solution starts.

use ale::Station;
use fem::ElementOptions;
use ltca::{StaticModel, StaticPosition};
use testing::Case;

/// Numbers of a position with their names and how far round-off of poses moves them.
fn numbers(p: &StaticPosition) -> Vec<(String, f64, f64)> {
    let mut all = vec![
        ("transmission error, mm".to_owned(), p.transmission_error, 1e-10),
        ("tangent stiffness, N/mm".to_owned(), p.tangent_stiffness, 1e-9),
        ("contact line, mm".to_owned(), p.contact_line_length, 1e-8),
        // Next to an edge a slice feels where on the flank it stands, which is that of the last pose.
        ("largest pressure, MPa".to_owned(), p.max_pressure, 2e-8),
        ("strain energy, N mm".to_owned(), p.strain_energy, 1e-9),
    ];
    for pair in p.pairs.iter().filter(|pair| pair.normal_force > 0.0) {
        all.push((format!("force of pair {}, N", pair.pair), pair.normal_force, 1e-9));
        let of_slice = pair.slices.iter().map(|s| (format!("line load at {}, N/mm", s.z), s.line_load, 1e-7));
        all.extend(of_slice);
    }
    all
}

/// Solved along the mesh cycle, each position from the ones before, a position is what it is when it is solved alone.
#[test]
fn a_position_is_the_same_from_any_start() {
    let case = Case::read("coarse_hex20_pinion.msh", "coarse_hex20_wheel.msh", ElementOptions::default());
    let mut model = case.reduced(case.slice_options());
    let along = model.run(16, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{e}")).positions;
    let gears = model.into_gears();
    for (i, found) in along.iter().enumerate().step_by(3) {
        let mut alone = StaticModel::new(case.pair.clone(), std::sync::Arc::clone(&gears), case.slice_options())
            .unwrap_or_else(|e| panic!("{e}"));
        let station = Station { cycle: 0, phase: i as f64 / 16.0 };
        let single = alone.advance(station, |_| ()).unwrap_or_else(|e| panic!("{e}"));
        let pairs = numbers(found).into_iter().zip(numbers(&single));
        for ((name, a, tolerance), (other, b, _)) in pairs {
            assert_eq!(name, other, "position {i}");
            let off = (a - b).abs() / a.abs().max(b.abs()).max(f64::MIN_POSITIVE);
            assert!(off <= tolerance, "position {i}: {name} is {a} along the cycle and {b} alone: {off:.1e}");
        }
    }
}
