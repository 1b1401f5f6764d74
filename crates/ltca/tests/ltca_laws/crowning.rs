//! Lead crowning: pressure ends before the edge of the face; unmodified flanks press up to it.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::sync::Arc;

use geometry::{FlankModification, GearModifications};
use ltca::StaticModel;
use mesh::Extent;
use testing::{default_data, modified, quadratic};

#[test]
fn crowned_flanks_end_their_pressure_before_the_edge() {
    let case = quadratic(default_data(20.0), None, 150e3, [3, 2, 2, 4, 1], Extent::Sector(5));
    let options = case.slice_options();
    let mut gears = Arc::new(case.reduced_gears(&options));
    let outermost = 0.5 * case.pair.face_width() * (1.0 - 1.0 / options.contact.slices as f64);
    let mut spans = Vec::new();
    for crowning in [0.0, 0.03, 0.06, 0.12] {
        let crowned = GearModifications::both(FlankModification { lead_crowning: crowning, ..Default::default() });
        let pair = modified(&case.pair, [crowned, Default::default()]);
        let mut model = StaticModel::new(pair, gears, options.clone()).unwrap();
        let positions = model.run(8, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{e}")).positions;
        let loaded = positions.iter().flat_map(|p| &p.pairs).flat_map(|q| &q.slices);
        let span = loaded.clone().map(|s| s.z.abs()).fold(0.0, f64::max);
        let pressure = loaded.map(|s| s.pressure).fold(0.0, f64::max);
        let ends: Vec<f64> = positions
            .iter()
            .flat_map(|p| &p.pairs)
            .filter(|q| q.slices.len() > 2)
            .map(|q| {
                let most = q.slices.iter().map(|s| s.line_load).fold(0.0, f64::max);
                q.slices[0].line_load.min(q.slices[q.slices.len() - 1].line_load) / most
            })
            .collect();
        let end = ends.iter().copied().fold(1.0, f64::min);
        println!(
            "crowning {:.0} um: outermost loaded slice at {span:.2} mm of {outermost:.2}, p0 {pressure:.0} MPa, least end load {:.1} % of the largest",
            1e3 * crowning,
            100.0 * end
        );
        spans.push(span);
        gears = model.into_gears();
    }
    assert!((spans[0] - outermost).abs() < 1e-9, "unmodified flanks press up to the edge, not to {}", spans[0]);
    assert!(spans[3] < 0.9 * outermost, "120 um of crowning: pressed up to {} mm", spans[3]);
    assert!(spans.windows(2).all(|w| w[1] <= w[0]), "more crowning, shorter lines: {spans:?}");
}

/// Flanks that just touch do so where the crown is within a nanometre of its top: on
///
/// ```text
/// l = b sqrt(1 nm / C) / cos b_b     of a crown C over the face width b
/// ```
/// of a pair whose line passes the middle of the face, however the stations of the search lie about it; less where the
/// line ends there.
#[test]
fn unloaded_crowns_touch_on_the_length_of_a_nanometre() {
    const TOUCHING_MM: f64 = 1e-6;
    for (beta_deg, crowning) in [(0.0, 0.05), (20.0, 4e-5), (20.0, 0.05), (20.0, 0.8)] {
        let case = quadratic(default_data(beta_deg), None, 0.0, [1, 2, 1, 2, 1], Extent::Sector(5));
        let crowned = GearModifications::both(FlankModification { lead_crowning: crowning, ..Default::default() });
        let options = case.slice_options();
        let pair = modified(&case.pair, [crowned, Default::default()]);
        let expected = case.pair.face_width() * (TOUCHING_MM / crowning).sqrt() / pair.base_helix_angle().cos();
        let mut model = StaticModel::new(pair, case.reduced_gears(&options), options).unwrap();
        let positions = model.run(8, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{e}")).positions;
        for position in &positions {
            let lengths: Vec<f64> =
                position.pairs.iter().map(|p| p.contact_line_length).filter(|length| *length > 0.0).collect();
            let longest = lengths.iter().fold(0.0, |m: f64, length| m.max(*length));
            assert!(
                (longest / expected - 1.0).abs() < 0.01,
                "beta {beta_deg}, crown {crowning} mm, phase {}: lines of {lengths:?} mm, expected {expected}",
                position.mesh_phase
            );
        }
    }
}
