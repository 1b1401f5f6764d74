//! What says that two plans, or two studies, have the same cases.

use scene::{Machine, Setting, optimum::NumberOptimisation, plan::Plan, study::Study};
use store::checkpoint::InputDigests;

/// What says that two plans have the same cases: scene, files that it names, axes, samples, outputs, program.
pub fn plan_digest(plan: &Plan) -> String {
    let mut hasher = blake3::Hasher::new();
    let mut take = |text: &str| {
        hasher.update(text.as_bytes());
        hasher.update(&[0]);
    };
    take(env!("CARGO_PKG_VERSION"));
    take(&plan.document.blake3());
    plan.settings.iter().for_each(|setting| take(&setting.word()));
    take(&format!("{:?} {:?} {:?} {:?}", plan.axes, plan.cases.axes(), plan.sampling, plan.outputs));
    // Files of a case may be varied as little as their names: those of the first stand for all.
    take(&inputs(plan.machine(0).ok()));
    hasher.finalize().to_hex().to_string()
}

/// What says that two searches have the same designs in the same order.
pub fn numbers_digest(plan: &NumberOptimisation) -> String {
    let NumberOptimisation { document, settings, parameters, goals, limits, loads, evaluations, .. } = plan;
    let mut hasher = blake3::Hasher::new();
    let words: Vec<String> = settings.iter().map(Setting::word).collect();
    let inputs = inputs(plan.machine(&plan.start()).ok());
    let loads: Vec<f64> = loads.iter().map(|load| load.torque_nm).collect();
    let all =
        format!("{} {words:?} {parameters:?} {goals:?} {limits:?} {loads:?} {evaluations} {inputs}", document.blake3());
    hasher.update(env!("CARGO_PKG_VERSION").as_bytes()).update(all.as_bytes());
    hasher.finalize().to_hex().to_string()
}

/// What a case is made of, files that it names included.
fn inputs(machine: Option<Machine>) -> String {
    machine.map_or_else(String::new, |machine| match machine {
        Machine::Pair(scene) => format!("{:?}", InputDigests::of(&*scene)),
        Machine::Gearbox(file) => format!("{:?}", InputDigests::of(&*file)),
    })
}

/// What says that two studies have the same cases: scenes, files that they name, program; and whether cases have
/// reports.
pub fn study_digest(study: &Study, reports: bool) -> String {
    let mut hasher = blake3::Hasher::new();
    hasher.update(format!("{} {reports}", env!("CARGO_PKG_VERSION")).as_bytes());
    for case in &study.cases {
        let digests = InputDigests::of(&case.scene);
        // A motion that is made longer goes on from its checkpoint; a case that is done does not.
        let cycles = case.scene.analysis.cycles;
        hasher.update(format!("{} {digests:?} {cycles}\n", case.label).as_bytes());
    }
    hasher.finalize().to_hex().to_string()
}
