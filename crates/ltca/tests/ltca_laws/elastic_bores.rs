//! Pairs whose bores stand on springs.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use ale::Station;
use mesh::{BoreCoupling, Extent, Foundation, MeshedGear};
use testing::{Case, default_data, planet_in_ring, quadratic};

/// The case with both bores on springs, N/mm^3; the outside of a ring.
fn on_springs(mut case: Case, stiffness: [f64; 3]) -> Case {
    let coupling = BoreCoupling::Elastic(Foundation::new(stiffness, None).unwrap());
    case.meshes = case.meshes.map(|gear: MeshedGear| gear.coupled(coupling));
    case
}

/// All degrees of freedom kept, one factor, one sector: the same answer, for external pairs and for a ring.
#[test]
fn reduced_gears_on_springs_are_the_full_ones() {
    let springs = [3e3, 1e3, 5e2];
    for (name, data, torque) in [("external", default_data(20.0), 150e3), ("ring", planet_in_ring(15.0), 300e3)] {
        let case = |extent| on_springs(quadratic(data.clone(), None, torque, [2, 2, 2, 2, 1], extent), springs);
        let station = Station { cycle: 0, phase: 0.3 };
        let te =
            |mut model: ltca::StaticModel| model.solve(station).unwrap_or_else(|e| panic!("{e}")).transmission_error;
        let [sector, whole] = [Extent::Periodic, Extent::Whole].map(case);
        let options = whole.slice_options();
        let [full, one_sector, one_factor] =
            [whole.full(options.clone()), sector.reduced(options.clone()), whole.reduced(options)].map(te);
        println!("{name}: {full} mm with all, {one_sector} by one sector, {one_factor} by the whole mesh");
        for (what, found) in [("one sector", one_sector), ("the whole mesh", one_factor)] {
            assert!((found / full - 1.0).abs() < 1e-8, "{name}: {found} mm by {what}, {full} mm with all");
        }
    }
}

/// On springs a pair lags by what the rigid bodies give besides: the turn of both, as the torque asks, and their way along the line
/// of action and askew, which soft springs along the circumference make small beside it.
///
/// ```text
/// lag by turns = sum of r_b^2 F / (A r^2 k_t)
/// ```
#[test]
fn soft_springs_give_by_the_torque() {
    let data = default_data(0.0);
    let lag = |springs: Option<[f64; 3]>| {
        let case = quadratic(data.clone(), None, 150e3, [2, 2, 2, 2, 1], Extent::Periodic);
        let case = match springs {
            Some(k) => on_springs(case, k),
            None => case,
        };
        let mut model = case.reduced(case.slice_options());
        model.solve(Station { cycle: 0, phase: 0.5 }).unwrap_or_else(|e| panic!("{e}")).transmission_error
    };
    let tangential = 50.0;
    let more = lag(Some([1e9, tangential, 1e9])) - lag(None);
    let case = quadratic(data.clone(), None, 150e3, [2, 2, 2, 2, 1], Extent::Periodic);
    let turns = [&case.pair.pinion, &case.pair.wheel].map(|gear| {
        let (r, b) = (0.5 * gear.data().bore_diameter, gear.data().face_width);
        let force = case.torque / case.pair.wheel.base_radius();
        gear.base_radius().powi(2) * force / (2.0 * std::f64::consts::PI * r.powi(3) * b * tangential)
    });
    let wanted: f64 = turns.iter().sum();
    println!("lags by {more} mm more, turns {wanted} mm");
    // Springs that let the bore slide let the body shear and bend too.
    assert!((more / wanted - 1.0).abs() < 0.1, "{more} mm more, turns {wanted} mm");
}
