//! Evaluates a design at all its torques and for all its samples.

use design::{Curve, Evaluation, Limited};
use scene::{Scene, optimum::Optimisation};

use crate::{
    AnalysisError, RemarksAtRest, RestRequest, SharedModels, VariedScene, parallel_map,
    resolution::with_slices,
    shared_solutions::{Rates, SolvedWithRates},
};

/// Slices that serve all designs, so that none jumps to another number: as many as the start and the middle of all
/// bounds ask for.
pub(super) fn slices(plan: &Optimisation) -> Option<u32> {
    let middle: Vec<f64> = plan.parameters.iter().map(|p| 0.5 * (p.bounds[0] + p.bounds[1])).collect();
    let most = plan.torques.iter().map(|t| t.torque_nm).fold(0.0, f64::max);
    let of = |values: &[f64]| with_slices(plan.scene(values, most, None).ok()?).contact.slices;
    of(&plan.start()).into_iter().chain(of(&middle)).max()
}

/// Limits of the contact pressure, MPa; `None`: it is not looked at.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct PressureLimits {
    /// Limit of all slices.
    pub anywhere: Option<f64>,
    /// Limit of the slices at end faces and tip edges.
    pub at_edges: Option<f64>,
}

/// Curves of the transmission error (um) at all torques and in all samples, and largest pressures where they are
/// limited, with their derivatives.
pub(super) fn evaluate(
    models: &SharedModels<'_>,
    plan: &Optimisation,
    values: &[f64],
    limits: PressureLimits,
) -> Result<Evaluation, AnalysisError> {
    let torques = plan.torques.len();
    let solved = parallel_map(torques * plan.samples(), |i| {
        let (sample, torque) = (i / torques, plan.torques[i % torques].torque_nm);
        // Nobody looks at ratings.
        let at = |values: &[f64]| plan.scene(values, torque, Some(sample)).map(|scene| Scene { rating: None, ..scene });
        let rates = Rates { of: &varied(plan, values, at)?, of_unloaded: false };
        models.solve(&at(values)?, rates, RestRequest::to_the_end(RemarksAtRest::Skipped).without_line_lengths())
    });
    let mut evaluation = Evaluation::default();
    for (i, solved) in solved.into_iter().enumerate() {
        let SolvedWithRates { history, rates, .. } = solved?;
        let rates: Vec<Vec<_>> = rates.iter().map(|of| of.iter().map(|s| s.rates()).collect()).collect();
        evaluation.curves.push(Curve {
            sample: i / torques,
            weight: plan.torques[i % torques].weight,
            values: history.positions.iter().map(|p| 1e3 * p.transmission_error).collect(),
            rates: rates.iter().map(|of| of.iter().map(|r| 1e3 * r.transmission_error).collect()).collect(),
        });
        let positions = || history.positions.iter().zip(&rates);
        if let Some(limit) = limits.anywhere {
            evaluation.limited.extend(positions().map(|(position, rates)| Limited {
                value: position.max_pressure,
                rates: rates.iter().map(|r| r.max_pressure).collect(),
                limit,
            }));
        }
        if let Some(limit) = limits.at_edges {
            evaluation.limited.extend(positions().map(|(position, rates)| Limited {
                value: position.max_edge_pressure(),
                rates: rates.iter().map(|r| r.max_edge_pressure).collect(),
                limit,
            }));
        }
    }
    Ok(evaluation)
}

/// The neighbours of a design along each parameter.
fn varied(
    plan: &Optimisation,
    values: &[f64],
    at: impl Fn(&[f64]) -> Result<Scene, scene::SceneError>,
) -> Result<Vec<VariedScene>, AnalysisError> {
    let of_one = |k: usize| {
        let step = plan.parameters[k].step();
        let moved = |by: f64| {
            let mut values = values.to_vec();
            values[k] += by;
            at(&values)
        };
        Ok(VariedScene { sides: [moved(-step)?, moved(step)?], steps: [step; 2] })
    };
    (0..values.len()).map(of_one).collect()
}
