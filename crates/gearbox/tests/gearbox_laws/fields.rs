//! Fields in motion: the loads on the flanks that a row hands on bend the teeth as they do at rest.

use ale::Station;
use testing::moving::started;

use crate::pair_course::bench;

/// Gears that creep stand as at rest: boundary displacements under the loads of a row are those of the static position,
/// and the loads carry the torque.
#[test]
fn slow_gears_bend_as_gears_at_rest() {
    let bench = bench();
    let (mut system, start) = started(&bench.system(1e-3, |_| ()), 0.0);
    system.pair_instant(&start).unwrap_or_else(|e| panic!("{e}"));
    let sides = system.loads(0);
    let [driving] = &sides[..] else { panic!("{} sides press", sides.len()) };
    let moving = driving.displacements().unwrap();
    let mut model = bench.case.reduced(bench.contact.clone());
    model.solve(Station { cycle: 0, phase: 0.0 }).unwrap_or_else(|e| panic!("{e}"));
    let still = model.last().unwrap().displacements_on(model.contact_set());
    for (gear, (a, b)) in ["pinion", "wheel"].into_iter().zip(moving.iter().zip(&still)) {
        let largest = b.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let off = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert_eq!(a.len(), b.len());
        assert!(off <= 1e-4 * largest, "{gear}: {off:e} mm of {largest:e} mm");
    }
    let base_radius = bench.case.pair.wheel.base_radius();
    let along = bench.case.pair.base_helix_angle().cos();
    let torque = base_radius * along * driving.forces.iter().sum::<f64>();
    assert!((torque / bench.contact.torque - 1.0).abs() < 1e-4, "{torque} N mm, not {}", bench.contact.torque);
}
