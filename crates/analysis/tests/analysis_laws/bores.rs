//! Bores on springs: what they give is told where it counts.

use analysis::StaticAnalysis;
use scene::SceneBuilder;

use crate::jammed::small;

/// A gear on springs gives as a rigid body on them does, beside what it gave before, and hears so; one on stiff springs, and one
/// on none, hears nothing.
#[test]
fn a_gear_that_gives_on_its_springs_is_told() {
    let solved = |springs: Option<f64>| {
        let on = |scene: SceneBuilder, stiffness: f64| {
            let keys = ["radial_n_per_mm3", "tangential_n_per_mm3", "axial_n_per_mm3"];
            let scene = scene.set("wheel.bore.coupling", "elastic");
            keys.iter().fold(scene, |scene, key| scene.set(&format!("wheel.bore.{key}"), stiffness))
        };
        let scene = springs.map_or_else(small, |stiffness| on(small(), stiffness)).build();
        let scene = scene.unwrap_or_else(|e| panic!("{e}"));
        let history = StaticAnalysis::new(&scene).solve().unwrap_or_else(|e| panic!("{e}")).history;
        let count = history.positions.len() as f64;
        let mean = 1e3 * history.positions.iter().map(|p| p.transmission_error).sum::<f64>() / count;
        let told = history.remarks.iter().find(|w| w.code() == "bore_gives").map(|w| w.to_string());
        (mean, told)
    };
    let (rigid, silent) = solved(None);
    assert_eq!((silent, solved(Some(1e7)).1), (None, None));
    let (soft, told) = solved(Some(100.0));
    let told = told.expect("soft springs give");
    let given: f64 = told.split("by ").nth(1).and_then(|s| s.split(' ').next()).and_then(|s| s.parse().ok()).unwrap();
    assert!(told.contains("[wheel.bore]"), "{told}");
    // Springs let the body deform too.
    let more = soft - rigid;
    assert!((given / more - 1.0).abs() < 0.08, "{given} um told, {more} um more: {told}");
}
