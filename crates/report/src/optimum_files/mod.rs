//! The answer about an optimisation: the scene of the optimum, its search, and what it is worth.

mod numbers;
mod page;
mod tables;

pub use numbers::{NumberOptimumResult, number_optimum_answer, write_number_optimum};

use analysis::{
    optimum::{Optimised, Optimum},
    remark::{self, Remark},
};
use answer::{Answer, Cost};
use scene::Scene;
use serde::Serialize;
use serde_json::{Map, json};

use crate::{ReportError, Written, write_result};
use store::folder::ResultDirectory;

/// What files of an optimisation are made of.
#[derive(Debug, Clone, Copy)]
pub struct OptimumResult<'a> {
    /// The optimum.
    pub optimum: &'a Optimum,
    /// What is told of it.
    pub told: &'a Optimised,
    /// The scene of the optimum.
    pub scene: &'a Scene,
    /// The command that makes it again.
    pub again: &'a str,
}

/// The goal along the way, um.
#[derive(Debug, Clone, Copy, Serialize)]
struct Goals {
    goal_start_um: f64,
    goal_found_um: f64,
    goal_optimum_um: f64,
}

impl Goals {
    fn of(optimum: &Optimum) -> Self {
        let goal = &optimum.plan.goal;
        let start = optimum.found.steps.first().and_then(|step| step.goal);
        Self {
            goal_start_um: start.unwrap_or(f64::NAN),
            goal_found_um: goal.value(&optimum.found.evaluation.curves),
            goal_optimum_um: goal.value(&optimum.evaluation.curves),
        }
    }
}

/// The answer: `steps`, `torques`, `harris`, `influences`, and `front` where a trade-off was asked for.
pub fn optimum_answer(of: &OptimumResult<'_>, cost: Cost) -> Answer {
    let OptimumResult { optimum, told, .. } = *of;
    let plan = &optimum.plan;
    let mut tables = vec![
        tables::steps(&plan.parameters, &optimum.found.steps, "goal_um"),
        tables::torques(&told.torques),
        tables::harris(&told.harris),
        tables::influences(&told.influences),
    ];
    if !optimum.front.is_empty() {
        tables.push(tables::front(optimum));
    }
    let goals = Goals::of(optimum);
    Answer {
        kind: "optimum",
        name: plan.name.clone(),
        inputs: json!({ "scene": plan.scene_file(), "goal": plan.goal }),
        tables,
        headline: json!({
            "goal_start_um": goals.goal_start_um,
            "goal_found_um": goals.goal_found_um,
            "goal_optimum_um": goals.goal_optimum_um,
            "evaluations": optimum.found.steps.len(),
            "stop": optimum.found.stop,
            "over_limits": optimum.evaluation.over_limits(),
            "torques": told.torques,
            "parameters": told.influences.iter().map(|i| (i.key.clone(), json!(i))).collect::<Map<_, _>>(),
            "samples": plan.samples(),
        }),
        remarks: passed_limits(optimum).into_iter().collect(),
        cost,
        ..Answer::default()
    }
}

/// Writes `optimum.toml` and the answer; what comes back is the closing table.
///
/// # Errors
/// When the system refuses.
pub fn write_optimum(of: &OptimumResult<'_>, cost: Cost, results: &ResultDirectory) -> Result<Written, ReportError> {
    results.write("optimum.toml", of.scene.to_toml().as_bytes())?;
    let answer = optimum_answer(of, cost);
    let page = page::page(of, &answer);
    write_result(answer, &page, of.scene.output.parquet, results)
}

/// Which limits the optimum passes, and by how much; `None` where it holds them.
pub fn passed_limits(optimum: &Optimum) -> Option<Remark> {
    let over = optimum.evaluation.over_limits();
    let limits = [(optimum.plan.max_pressure_mpa, ""), (optimum.plan.max_edge_pressure_mpa, " at edges")];
    let limits: Vec<String> =
        limits.iter().filter_map(|(limit, place)| Some(format!("{} MPa{place}", (*limit)?))).collect();
    // Twice a limit and more is a multiple of it.
    let by =
        if over < 1.0 { format!("passed by {:.1} %", 100.0 * over) } else { format!("passed {:.1}-fold", 1.0 + over) };
    let limits = limits.join(" and ");
    (over > HELD).then(|| remark::pressure_limit_passed(limits, by))
}

/// Share by which a limit may be passed.
const HELD: f64 = 2e-3;
