//! What files of an optimisation are made of.

use analysis::optimum::{Optimised, Optimum};
use scene::Scene;
use serde::Serialize;

use crate::Cost;

/// What files of an optimisation are made of.
#[derive(Debug, Clone, Copy)]
pub struct OptimumResult<'a> {
    /// The optimum.
    pub optimum: &'a Optimum,
    /// What is told of it.
    pub told: &'a Optimised,
    /// The scene of the optimum.
    pub scene: &'a Scene,
    /// The goal along the way.
    pub goals: &'a Goals,
    /// What it took.
    pub cost: &'a Cost,
    /// What a user should hear.
    pub warnings: &'a [String],
    /// The command that makes it again.
    pub again: &'a str,
}

/// The goal along the way, um.
#[derive(Debug, Clone, Serialize)]
#[allow(missing_docs)]
pub struct Goals {
    pub start_um: f64,
    pub found_um: f64,
    pub optimum_um: f64,
}

impl Goals {
    /// Of an optimum.
    pub fn of(optimum: &Optimum) -> Self {
        let goal = &optimum.plan.goal;
        let start = optimum.found.steps.first().and_then(|step| step.goal);
        Self {
            start_um: start.unwrap_or(f64::NAN),
            found_um: goal.value(&optimum.found.evaluation.curves),
            optimum_um: goal.value(&optimum.evaluation.curves),
        }
    }
}
