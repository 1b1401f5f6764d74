//! The answer about an optimisation: the scene of the optimum, its search, and what it is worth.

mod numbers;
mod page;
mod tables;

pub use numbers::{NumberOptimumResult, number_optimum_answer, write_number_optimum};

use std::collections::BTreeMap;

use analysis::{
    optimum::{Influence, Optimised, Optimum, TorqueLine},
    remark::{self, Remark},
};
use answer::{Answer, Cost, Table};
use described::Key;
use design::Stop;
use scene::{Scene, optimum::DesignParameter};
use serde::Serialize;
use serde_json::{Value, json};

use crate::{ReportError, Written, write_result};
use store::folder::ResultDirectory;

/// What files of an optimisation are made of.
#[derive(Debug, Clone, Copy)]
pub struct OptimumResult<'a> {
    /// The optimum.
    pub optimum: &'a Optimum,
    /// What is reported of it.
    pub summary: &'a Optimised,
    /// The scene of the optimum.
    pub scene: &'a Scene,
    /// The command that makes it again.
    pub again: &'a str,
}

described::described! {
    /// Headline of an optimisation of reliefs.
    #[derive(Serialize)]
    struct OptimumHeadline<'a> {
        /// goal at the start
        goal_start_um: f64,
        /// goal where the search ended
        goal_found_um: f64,
        /// goal with values that a machine can be set to
        goal_optimum_um: f64,
        /// evaluations of the search
        evaluations: usize,
        /// end of the search: `converged` (no step gains half a per cent to first order) or `evaluations`
        stop: Stop,
        /// share by which a limit is passed at the optimum
        over_limits: f64,
        /// torques that count, without tolerances, every position solved anew with slices of its own number
        torques: &'a [TorqueLine],
        /// parameters by their keys, as the rows of `influences.csv`
        parameters: BTreeMap<&'a str, &'a Influence>,
        /// samples of the tolerances
        samples: usize,
    }

    /// What an optimisation of reliefs is about.
    #[derive(Serialize)]
    struct OptimumInputs {
        /// scene at the start
        scene: Value,
        /// quantity that shall be small: `measure`, and `over` the torques: `mean`, or `worst_beyond` a share of the samples
        goal: Value,
    }
}

/// Objects of the summaries of optimisations with their keys.
pub(crate) const OBJECTS: [(&str, &[Key]); 4] = [
    ("headline, an optimisation of reliefs", OptimumHeadline::KEYS),
    ("inputs, an optimisation of reliefs", OptimumInputs::KEYS),
    ("headline, an optimisation of numbers", numbers::NumberHeadline::KEYS),
    ("parameters, an optimisation of numbers", numbers::NumberParameter::KEYS),
];

/// The goal along the way, um.
#[derive(Debug, Clone, Copy)]
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
    let OptimumResult { optimum, summary, .. } = *of;
    let plan = &optimum.plan;
    let mut tables = vec![
        tables::steps(&plan.parameters, &optimum.found.steps, "goal_um"),
        tables::torques(&summary.torques),
        tables::harris(&summary.harris),
        tables::influences(&summary.influences),
    ];
    if !optimum.front.is_empty() {
        tables.push(tables::front(&plan.parameters, &optimum.front));
    }
    let goals = Goals::of(optimum);
    Answer {
        kind: "optimum",
        name: plan.name.clone(),
        inputs: json!(OptimumInputs { scene: json!(plan.scene_file()), goal: json!(plan.goal) }),
        tables,
        headline: json!(OptimumHeadline {
            goal_start_um: goals.goal_start_um,
            goal_found_um: goals.goal_found_um,
            goal_optimum_um: goals.goal_optimum_um,
            evaluations: optimum.found.steps.len(),
            stop: optimum.found.stop,
            over_limits: optimum.evaluation.over_limits(),
            torques: &summary.torques,
            parameters: summary.influences.iter().map(|i| (&*i.key, i)).collect(),
            samples: plan.samples(),
        }),
        remarks: passed_limits(optimum).into_iter().collect(),
        cost,
        ..Answer::default()
    }
}

/// Tables of optimisations without rows, for `docs/outputs.md`.
pub(crate) fn documented() -> Vec<(&'static str, Table)> {
    let parameter =
        DesignParameter { keys: vec!["<key>".to_owned()], bounds: [0.0; 2], start: 0.0, outside: None, grain: 0.0 };
    let parameters = [parameter];
    vec![
        ("steps, reliefs", tables::steps(&parameters, &[], "goal_um")),
        ("steps, numbers", tables::steps(&parameters, &[], "goal")),
        ("torques", tables::torques(&[])),
        ("harris", tables::harris(&[])),
        ("influences", tables::influences(&[])),
        ("front", tables::front(&parameters, &[])),
        ("numbers", numbers::table(&[])),
    ]
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
