//! Laws of bounds: what they hold, what they refuse, and when the ladder is left.

use analysis::{
    AnalysisError, Blame, StaticAnalysis, StaticResult,
    accuracy::{Bound, CalibratedMesh, Calibration, Cause, Quantity, Rung},
    meshes::generated,
};
use scene::{Scene, SceneBuilder};

fn pair() -> SceneBuilder {
    let base = Scene::builder().pinion(24, 15.0).wheel(31).normal_module_mm(3.0).face_width_mm(15.0);
    base.torque_nm(200.0)
}

/// With meshes that are coarse: how finely makes no difference to what is refused.
fn coarse(scene: SceneBuilder) -> SceneBuilder {
    let counts = [("profile", 2), ("fillet", 2), ("thickness", 2), ("face", 4), ("rim", 2)];
    ["pinion", "wheel"].iter().fold(scene, |scene, gear| {
        counts.iter().fold(scene, |scene, (key, n)| scene.set(&format!("{gear}.mesher.elements_{key}"), *n))
    })
}

fn solved(scene: &Scene) -> StaticResult {
    StaticAnalysis::new(scene).solve().unwrap_or_else(|e| panic!("{e}"))
}

fn bound(result: &StaticResult, quantity: Quantity) -> Bound {
    let all = &result.facts.accuracy.as_ref().unwrap().bounds;
    all.iter().find(|b| b.quantity == quantity).unwrap_or_else(|| panic!("no bound of {}", quantity.key())).clone()
}

/// What is asked is kept on a coarse rung, its bounds hold the values of a rung of twice as many elements, and they are
/// made of their terms.
#[test]
fn the_ladder_is_left_as_soon_as_the_bounds_keep_what_is_asked() {
    let coarse = solved(&pair().set("accuracy.mean_ste", "10 %").build().unwrap());
    assert_eq!(Rung::of(&coarse.scene).map(|r| r.elements_profile), Some(2));
    let fine = solved(&pair().set("accuracy.mean_ste", "0.4 %").build().unwrap());
    let rung = Rung::of(&fine.scene).unwrap().elements_profile;
    assert!(rung > 2 && fine.facts.accuracy.as_ref().unwrap().is_met(), "rung {rung}");
    for quantity in [Quantity::MeanSte, Quantity::MeshStiffness, Quantity::MaxPressure] {
        let [coarse, fine] = [&coarse, &fine].map(|r| bound(r, quantity));
        let Bound { value, below, above, .. } = coarse;
        let key = quantity.key();
        assert!(
            (value - below..=value + above).contains(&fine.corrected),
            "{key}: {} is outside of {}",
            fine.corrected,
            coarse.words()
        );
        let terms: f64 = coarse.terms.iter().map(|t| t.amount).sum();
        assert!((terms / coarse.corrected_within - 1.0).abs() < 1e-12, "{key}: {terms}");
        assert!(coarse.terms.iter().any(|t| t.cause == Cause::Mesh && t.amount > 0.0), "{key}: {coarse:?}");
    }
}

/// A mesh that is fine where it does not matter and coarse in the rim is caught: it is held against another mesh.
#[test]
fn one_element_in_a_thin_rim_is_caught() {
    let of = |rim: i64| {
        let mut builder = pair().set("accuracy.mean_ste", "1 %").set("analysis.model", "reduced");
        for gear in ["pinion", "wheel"] {
            builder = builder
                .set(&format!("{gear}.mesher.elements_rim"), rim)
                .set(&format!("{gear}.mesher.elements_profile"), 8)
                .set(&format!("{gear}.mesher.elements_fillet"), 2);
        }
        solved(&builder.set("analysis.positions_per_cycle", 16).build().unwrap())
    };
    let [one, six] = [of(1), of(6)].map(|r| bound(&r, Quantity::MeanSte));
    assert!(one.value < six.value, "fewer elements are stiffer: {} and {} um", one.value, six.value);
    assert!(one.value + one.above >= six.value, "{} um is beyond {}", six.value, one.words());
    assert!(one.above > six.above, "{} and {}", one.words(), six.words());
}

/// The laws of bounds are those of meshes that the program makes or reads: meshes in memory get none, and who asks for
/// bounds of them is refused.
#[test]
fn meshes_in_memory_have_no_bounds() {
    let alone = coarse(pair()).set("analysis.positions_per_cycle", 8).build().unwrap();
    let exact = alone.gear_pair().unwrap();
    let of = |name: &str, gear, exact| generated(&alone, name, gear, exact).unwrap();
    let meshes = [of("pinion", &alone.pinion, &exact.pinion), of("wheel", &alone.wheel, &exact.wheel)];
    let held = |scene: &Scene| StaticAnalysis::new(scene).with_meshes([&meshes[0], &meshes[1]]).solve();
    assert!(held(&alone).unwrap().facts.accuracy.is_none());
    let refused = held(&pair().set("accuracy.mean_ste", "1 %").build().unwrap()).unwrap_err();
    assert!(refused.to_string().ends_with("there are no bounds of meshes in memory"), "{refused}");
    assert!(refused.hint().is_some() && refused.blame() == Blame::Input, "{refused}");
}

/// Every quantity has its laws on the same rungs, and every bound is above zero.
#[test]
fn the_calibration_is_whole() {
    let all = Calibration::committed();
    assert!(all.pairs >= 60 && all.coverage >= 0.95, "{} pairs, {}", all.pairs, all.coverage);
    for quantity in Quantity::ALL.iter().filter(|q| !q.is_of_motion()) {
        let laws = all.of(*quantity).unwrap_or_else(|| panic!("no laws of {}", quantity.key()));
        for mesh in [2, 3, 4, 6].map(CalibratedMesh::Rung).into_iter().chain([CalibratedMesh::Default]) {
            assert!(laws.of_mesh(mesh).is_some(), "{}: {mesh:?}", quantity.key());
        }
        let of_mesh = laws.mesh.iter().map(|mesh| &mesh.law);
        for law in of_mesh.chain([&laws.slices]).chain(laws.positions.iter().map(|p| &p.law)) {
            assert!(law.factor > 0.0 && law.is_whole(), "{}: {law:?}", quantity.key());
        }
    }
}

/// A pinion in a ring gets its mesh and its bounds as other pairs do; a ring unlike those that the laws were checked on is told of.
#[test]
fn rings_have_bounds() {
    let ring = |teeth: i64| {
        let pair = pair().pinion(20, 15.0).set("wheel.teeth", -teeth).set("pair.addendum_coefficient", 0.85);
        let pair = pair.set("pinion.profile_shift", 0.3).set("wheel.profile_shift", -0.1).torque_nm(600.0);
        solved(
            &pair
                .set("pair.face_width_mm", 12.0)
                .set("accuracy.mean_ste", "2 %")
                .build()
                .unwrap_or_else(|e| panic!("{e}")),
        )
    };
    let near = ring(52);
    let mean = bound(&near, Quantity::MeanSte);
    assert_eq!(mean.met, Some(true), "{mean:?}");
    let not_covered = |result: &StaticResult| result.facts.accuracy.as_ref().unwrap().not_covered.clone();
    assert_eq!(not_covered(&near).len(), 1, "{:?}", not_covered(&near));
    let large = not_covered(&ring(170));
    assert!(large.iter().any(|said| said.starts_with("teeth of the wheel of 170")), "{large:?}");
}

/// A rung that the calibration does not know has bounds as any other mesh, a number without a bound is an error, and a
/// load beyond the calibration is told.
#[test]
fn nothing_that_is_asked_is_passed_over() {
    let mut by_hand = pair().set("accuracy.mean_ste", "5 %").set("analysis.model", "reduced").build().unwrap();
    let mesher = Rung::ALL[4].mesher(&by_hand);
    by_hand.analysis.positions_per_cycle = 8;
    for gear in [&mut by_hand.pinion, &mut by_hand.wheel] {
        gear.mesher = Some(mesher);
    }
    assert_eq!(bound(&solved(&by_hand), Quantity::MeanSte).met, Some(true));
    let few = coarse(pair()).set("accuracy.third_ste_harmonic", "5 %").set("analysis.model", "reduced");
    let few = few.set("analysis.positions_per_cycle", 2).build().unwrap();
    let refused = StaticAnalysis::new(&few).solve().map(|_| ()).unwrap_err();
    assert!(
        {
            let is_unbounded = refused.to_string().contains("there is no bound of");
            is_unbounded || matches!(refused, AnalysisError::Statistics(_))
        },
        "{refused}"
    );
    let tiny = solved(&pair().torque_nm(0.1).set("accuracy.mean_ste", "90 %").build().unwrap());
    let not_covered = &tiny.facts.accuracy.as_ref().unwrap().not_covered;
    assert!(not_covered.iter().any(|said| said.starts_with("a Hertz pressure")), "{not_covered:?}");
}
