//! Contact at tip edges off the line of action, at three times the torque of the default pair.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use geometry::GearPair;
use ltca::{StaticModel, StaticOptions, StaticPosition};
use mesh::Extent;
use testing::{Case, default_data, quadratic};

const TORQUE: f64 = 450e3;

fn case(beta_deg: f64, edge_radius: f64) -> Case {
    let data = default_data(beta_deg).map(|d| geometry::GearData { tip_edge_radius: edge_radius, ..d });
    quadratic(data, None, TORQUE, [3, 2, 2, 3, 1], Extent::Sector(5))
}

fn cycle(model: &mut StaticModel, positions: usize) -> Vec<StaticPosition> {
    model.run(positions, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{e}")).positions
}

/// How far (in base pitches) a pair stands before the start of its path, all over the face; negative when it is in it.
fn early(pair: &GearPair, options: &StaticOptions, phase: f64, number: i64) -> f64 {
    let side = options.side();
    let theta = pair.middle_angle(side) + (phase - 0.5) * pair.pinion.pitch_angle();
    let half = 0.5 * pair.face_width();
    let foremost =
        [-half, half].map(|z| pair.path_coordinate(side, theta, number, z)).into_iter().fold(f64::MIN, f64::max);
    (pair.path_of_contact()[0] - foremost) / pair.transverse_base_pitch()
}

/// Largest difference between neighbours of a whole cycle, um.
fn largest_step(positions: &[StaticPosition]) -> f64 {
    let te = |i: usize| 1e3 * positions[i % positions.len()].transmission_error;
    (0..positions.len()).map(|i| (te(i + 1) - te(i)).abs()).fold(0.0, f64::max)
}

/// Load comes in before the geometric start of contact; STE is continuous: four times finer steps are four times
/// smaller ones. Without corner contact the step stays.
#[test]
fn load_comes_in_at_the_edge() {
    for (beta, edge_radius) in [(0.0, 0.0), (5.0, 0.0), (5.0, 0.1)] {
        let case = case(beta, edge_radius);
        let on = case.slice_options();
        let mut model = case.reduced(on.clone());
        let coarse = largest_step(&cycle(&mut model, 32));
        let fine_cycle = cycle(&mut model, 128);
        let fine = largest_step(&fine_cycle);
        let ahead = fine_cycle
            .iter()
            .flat_map(|p| p.pairs.iter().map(move |q| (p, q)))
            .filter(|(_, q)| q.normal_force > 0.0)
            .map(|(p, q)| (early(&case.pair, &on, p.mesh_phase, q.pair), q.normal_force, p))
            .filter(|(e, _, _)| *e > 0.0)
            .collect::<Vec<_>>();
        let first = ahead.iter().map(|a| a.0).fold(0.0, f64::max);
        let at_start = ahead.iter().min_by(|a, b| a.0.total_cmp(&b.0));
        let share = at_start.map_or(0.0, |(_, f, p)| f / p.pairs.iter().map(|q| q.normal_force).sum::<f64>());
        let gears = model.into_gears();
        let off = on.clone().with_contact(|c| c.corner_contact = false);
        let mut model = StaticModel::new(case.pair.clone(), gears, off).unwrap();
        let cut = [32, 128].map(|n| largest_step(&cycle(&mut model, n)));
        println!(
            "beta {beta}, edge radius {edge_radius} mm: load from {first:.4} p_bt before the start of contact, {:.1} % of it at the start; \
             largest step of STE {coarse:.3} um at 32 a cycle, {fine:.3} at 128 ({:.1} um a pitch); cut off: {:.3}, {:.3} um",
            100.0 * share,
            128.0 * fine,
            cut[0],
            cut[1]
        );
        assert!(first > 0.005 && share > 0.01, "beta {beta}: first load {first} p_bt early, share {share}");
        assert!(fine < 0.4 * coarse, "beta {beta}: steps of {coarse} um at 32 positions, {fine} um at 128");
        assert!(cut[1] > 3.0 * fine, "beta {beta}: without corner contact steps of {cut:?} um");
        if beta == 0.0 {
            assert!(cut[1] > 0.7 * cut[0], "a step that refinement shrinks from {} to {} um", cut[0], cut[1]);
        }
    }
}
