//! The branch of a gearbox of held shafts is the curve of its pair.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use analysis::{Context, Ending, NoObserver, gearbox::GearboxBranchResult, solve};
use scene::{
    Scene,
    gearbox::{Gearbox, gearbox_of_moving_pair},
};

use crate::continuation::{followed, pair};

/// From above the resonance of the wheel alone to below it, 1/min.
const RANGE: [f64; 2] = [11_800.0, 8_600.0];
/// Phases of a mesh cycle at which forces are taken.
const PHASES: i64 = 256;

/// The branch of the gearbox of two held shafts that has the pair of a scene.
fn as_gearbox(scene: &Scene) -> GearboxBranchResult {
    let text = gearbox_of_moving_pair(scene, 1).unwrap().unwrap();
    let (before, _) = text.split_once("\n[motion]").unwrap();
    let motion = format!(
        "\n[motion]\nrun = \"continuation\"\nspeed_rpm = {:?}\nto_speed_rpm = {:?}\nmesh = \"mapped\"\n\
         mesh_damping_ratio = 0.04\nmodal_damping_ratio = 0.0\nmap_overload = 6.0\nmap_tolerance = 3e-5\n\
         steps_per_cycle = 256\n[motion.continuation]\nphases = {PHASES}\ntime_points = 1\n",
        RANGE[0], RANGE[1]
    );
    let folder = tempfile::tempdir().unwrap();
    let file = Gearbox::parse(&(before.to_owned() + &motion), &folder.path().join("held.toml"));
    let file = file.unwrap_or_else(|e| panic!("{e}\n{text}"));
    let found = solve(&file, Context::new(&mut NoObserver)).and_then(Ending::finished);
    found.unwrap_or_else(|e| panic!("{e}")).branch.unwrap()
}

/// On maps of the same contact a pair whose driver keeps its speed and the gearbox of its held shafts fold at the same speeds,
/// and have the same largest motion and the same ends; the one searches with all coordinates, the other with what its mesh
/// sees.
#[test]
fn held_shafts_have_the_curve_of_their_pair() {
    let scene = pair("mapped", (15.0, 12)).set("drive.by", "speed").set("contact.flanks", "driving");
    let (_, curve) = followed(scene.clone().set("motion.continuation.phases", PHASES), RANGE);
    let at_once = scene.set("motion.run", "span").build().unwrap_or_else(|e| panic!("{e}"));
    let found = as_gearbox(&at_once);
    let [a, b] = [&found.figures, &curve.headline.figures].map(|f| f.folds.clone());
    println!("folds at {a:.3?} of the gearbox, {b:.3?} of the pair");
    assert!(a.len() >= 2 && a.len() == b.len(), "folds at {a:?}, of the pair {b:?}");
    assert!(a.iter().zip(&b).all(|(a, b)| (a / b - 1.0).abs() < 2e-4), "folds at {a:?}, of the pair {b:?}");
    let largest = [found.largest(0).unwrap(), &curve.headline.largest].map(|p| p.peak_to_peak_dte_um);
    let points: Vec<_> = found.points.iter().map(|of| &of[0]).collect();
    let ends = |of: [f64; 2]| println!("{of:?} um");
    ends(largest);
    assert!((largest[0] / largest[1] - 1.0).abs() < 2e-3, "largest {largest:?} um");
    for (own, wanted) in [(points[0], &curve.points[0]), (points[points.len() - 1], curve.points.last().unwrap())] {
        let both = [own, wanted].map(|p| p.peak_to_peak_dte_um);
        ends(both);
        assert!((both[0] / both[1] - 1.0).abs() < 1e-4, "{both:?} um at {} 1/min", own.value);
    }
    assert!(found.figures.unstable > 0 && found.figures.parting > 0, "{:?}", found.figures);
    let off = found.figures.difference_in_time.unwrap();
    assert!(off < 1e-2, "a motion in time is off by {off}");
}
