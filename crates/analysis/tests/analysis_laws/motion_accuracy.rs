//! Laws of bounds of motions: what they hold, which model is taken, what is refused.

use analysis::{
    Blame, NoCache, NoObserver,
    accuracy::{
        Bound, Cause, GearMemo, Quantity,
        motion::{AccurateMotion, AccurateMotionResult, MotionAnswer, MotionCalibration, MotionModel, UsualBound},
    },
    motion::MotionAnalysis,
};
use scene::{Model, Scene, SceneBuilder, SceneError};

fn pair() -> SceneBuilder {
    Scene::builder().pinion(24, 15.0).wheel(31).normal_module_mm(3.0).face_width_mm(10.0).torque_nm(150.0)
}

/// In motion, slow beside its resonance of some kHz.
fn slow() -> SceneBuilder {
    pair()
        .set("analysis.kind", "dynamic")
        .set("analysis.cycles", 1)
        .set("operation.speed_rpm", 600.0)
        .set("contact.slices", 8)
        .set("contact.flanks", "driving")
        .set("motion.periodic_tolerance", 1e-3)
}

fn solved(builder: SceneBuilder) -> AccurateMotionResult {
    AccurateMotion::new(&builder.build().unwrap()).solve().unwrap_or_else(|e| panic!("{e}"))
}

fn bound(result: &AccurateMotionResult, quantity: Quantity) -> Bound {
    let all = &result.answer.facts().accuracy.as_ref().unwrap().bounds;
    all.iter().find(|b| b.quantity == quantity).unwrap_or_else(|| panic!("no bound of {}", quantity.key())).clone()
}

/// A slow pair needs no more than twelve coordinates where much is allowed; what is taken comes last and is not left, all
/// before it are, and each bound says what it is made of.
#[test]
fn a_slow_pair_needs_twelve_coordinates() {
    let result = solved(slow().set("accuracy.peak_to_peak_dte", "40 %").set("accuracy.rms_dte", "40 %"));
    let accuracy = result.answer.facts().accuracy.as_ref().unwrap();
    let (last, before) = accuracy.models.split_last().unwrap();
    assert!(accuracy.is_met() && last.left_because.is_none(), "{accuracy:?}");
    assert!(before.iter().all(|t| t.left_because.is_some()), "{before:?}");
    assert_eq!((last.model, result.scene.analysis.model), (MotionModel::Lumped12, Model::Lumped12));
    for quantity in Quantity::OF_MOTION {
        let causes: Vec<Cause> = bound(&result, quantity).terms.iter().map(|t| t.cause).collect();
        let all = [Cause::Mesh, Cause::Step, Cause::QuasiStaticElasticity, Cause::Model, Cause::Settling];
        assert_eq!(causes, all);
    }
}

/// Bounds of a model that the scene names are estimated, and hold the answer with normal modes and fine steps.
#[test]
fn bounds_of_a_reduced_motion_hold_that_with_modes() {
    let own = slow().set("analysis.model", "reduced").set("operation.speed_rpm", 2500.0);
    let counts = [("profile", 2), ("fillet", 2), ("thickness", 2), ("face", 4), ("rim", 3)];
    let own = counts.into_iter().fold(own, |own, (key, n)| {
        ["pinion", "wheel"].into_iter().fold(own, |own, gear| own.set(&format!("{gear}.mesher.elements_{key}"), n))
    });
    let result = solved(own.clone().set("accuracy.peak_to_peak_dte", "0.001 %"));
    assert!(result.answer.facts().accuracy.as_ref().unwrap().models.is_empty());
    assert!(result.answer.facts().verdict(&result.scene).unwrap_err().blame() == Blame::Inexact);
    let fine = own.set("analysis.model", "reduced+modes").set("modes.count", 4).set("motion.steps_per_resonance", 8);
    let fine = MotionAnswer::quietly(&fine.build().unwrap(), &GearMemo::new(&NoCache), &mut NoObserver).unwrap();
    for quantity in Quantity::OF_MOTION {
        let b = bound(&result, quantity);
        let exact = fine.sample().get(quantity);
        assert!((b.value - b.below..=b.value + b.above).contains(&exact), "{exact} is outside of {}", b.words());
    }
}

/// Laws are there for every number of a motion; in every stratum the dearest model is usually known best, so that a
/// smaller tolerance takes a dearer one.
#[test]
fn the_dearest_model_is_known_best() {
    let table = MotionCalibration::committed();
    assert!(table.coverage >= 0.95 && table.motions >= 30, "{} motions", table.motions);
    for quantity in Quantity::OF_MOTION {
        let laws = table.of(quantity).unwrap();
        assert_eq!(laws.lumped12.len(), MotionCalibration::SPEEDS.len());
        for u in laws.usual.iter().filter(|u| u.model == MotionModel::Lumped12.name()) {
            let of = |model: MotionModel| {
                let same = |v: &&UsualBound| (v.speed_to, v.elastic_to) == (u.speed_to, u.elastic_to);
                laws.usual.iter().filter(same).find(|v| v.model == model.name()).unwrap().share
            };
            let [cheap, middle, dear] = MotionModel::ALL.map(of);
            assert!(cheap.min(middle) > dear && dear > 0.0, "{u:?}: {cheap} {middle} {dear}");
        }
    }
}

/// What has no bounds is refused, with a hint.
#[test]
fn what_has_no_bounds_is_refused_with_a_hint() {
    let refused = |builder: SceneBuilder| {
        let error = builder.build().err().unwrap_or_else(|| panic!("a scene that has no bounds"));
        assert!(matches!(error, SceneError::NotYet { .. } | SceneError::Conflict { .. }), "{error:?}");
        (error.to_string(), error.hint().unwrap_or_default())
    };
    let with = || slow().set("accuracy.rms_dte", "5 %");
    for (builder, says) in [
        (slow().set("accuracy.mean_ste", "1 %"), "`mean_ste`"),
        (with().set("analysis.kind", "static"), "belongs to"),
        (with().set("motion.run", "shooting"), "shooting"),
        (with().set("motion.error_tolerance", 1e-4), "error_tolerance"),
        (with().set("load.amplitude_nm", 10.0).set("load.frequency_hz", 100.0), "[load]"),
        (with().set("motion.checkpoint_every_cycles", 3), "checkpoint"),
        (pair().set("analysis.model", "impact").set("accuracy.rms_dte", "5 %"), "bounds of this model"),
    ] {
        let (message, hint) = refused(builder);
        assert!(message.contains(says) && !hint.is_empty(), "{message}: {hint}");
    }
    let (message, _) = refused(pair().set("accuracy.rms_dte", "5 %"));
    assert!(message.contains("`rms_dte`"), "{message}");
    // A library that does not see the bounds does not pass over them.
    let scene = with().set("analysis.model", "reduced").build().unwrap();
    let error = MotionAnalysis::new(&scene).solve().unwrap_err();
    assert!(error.to_string().ends_with("an accuracy is asked for") && error.hint().is_some(), "{error}");
}
