//! One door for a scene of any kind: what comes out is what the analysis of its kind gives.

use analysis::{
    Context, Ending, NoObserver, Solved, StaticAnalysis,
    in_time::{TimeAnswer, is_one_motion},
    lumped::LumpedAnalysis,
    results::static_headline,
    solve,
};
use scene::{Scene, SceneBuilder};

use super::continuation::lumped8;

fn built(scene: SceneBuilder) -> Scene {
    scene.build().unwrap_or_else(|e| panic!("{e}"))
}

fn solved(scene: &Scene) -> Solved {
    let solved = solve(scene, Context::new(&mut NoObserver)).and_then(Ending::finished);
    let solved = solved.unwrap_or_else(|e| panic!("{e}"));
    solved.verdict().unwrap_or_else(|e| panic!("{e}"));
    solved
}

/// At rest and in time: headline, certificate and remarks are those of the analysis that the scene asks for.
#[test]
fn one_door_gives_what_each_analysis_gives() {
    let base = Scene::builder().pinion(24, 15.0).wheel(31).normal_module_mm(3.0).face_width_mm(20.0).torque_nm(100.0);
    let rest = built(base.set("analysis.model", "iso"));
    let (door, own) = (solved(&rest), StaticAnalysis::new(&rest).solve().unwrap());
    let headline = static_headline(&rest, &own.history).unwrap();
    assert_eq!(door.headline().unwrap(), serde_json::to_value(headline).unwrap());
    assert_eq!(door.facts().unwrap().geometry, own.facts.geometry);
    assert_eq!(door.remarks(), own.history.remarks);

    let moving = built(lumped8().set("motion.run", "span").set("analysis.cycles", 3));
    let (door, own) = (solved(&moving), LumpedAnalysis::new(&moving).solve().unwrap());
    assert_eq!(door.headline().unwrap(), serde_json::to_value(&own.headline).unwrap());
    assert_eq!(door.facts().unwrap().certificate, own.facts.certificate);
    assert_eq!(door.remarks(), own.remarks);
    let Solved::InTime(door) = door else { panic!("a motion at rest") };
    let TimeAnswer::Lumped(result) = door.answer else { panic!("another analysis") };
    assert_eq!(result.rows.len(), own.rows.len());
    assert!(result.rows.to_vec().unwrap() == own.rows.to_vec().unwrap());
}

/// A sweep is the door's as well; a scene at rest is no motion, and only one motion of reduced gears stops on its way.
#[test]
fn the_door_tells_kinds_apart() {
    let sweep = ["from_rpm", "to_rpm"].into_iter().zip([3000.0, 4000.0]);
    let sweep =
        sweep.fold(lumped8().set("motion.run", "sweep"), |s, (key, rpm)| s.set(&format!("motion.sweep.{key}"), rpm));
    let sweep = built(sweep.set("motion.sweep.speeds", 2).set("motion.warm_up_cycles", 50).set("analysis.cycles", 2));
    let Solved::InTime(door) = solved(&sweep) else { panic!("a sweep at rest") };
    let TimeAnswer::LumpedSpeeds { options, found } = &door.answer else { panic!("another analysis") };
    assert_eq!((options.quantity.name.as_str(), found.points.len()), ("dte_um", 4), "two speeds, up and down");
    let base = Scene::builder().pinion(24, 15.0).wheel(31).normal_module_mm(3.0).face_width_mm(20.0).torque_nm(100.0);
    let rest = built(base);
    assert!(!is_one_motion(&sweep) && !is_one_motion(&rest));
    for wrong in [&sweep, &rest] {
        let said = solve(wrong, Context::new(&mut NoObserver).stop_after(Some(1))).unwrap_err().to_string();
        assert!(said.contains("motion"), "{said}");
    }
}
