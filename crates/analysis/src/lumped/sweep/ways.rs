//! Runs a sweep value by value.

use std::{ops::ControlFlow, sync::Arc};

use integrate::{State, SweepDirection};
use scene::SweepWay;

use super::{super::LumpedInputs, SweepPoint, point::SettledPoint};
use crate::{AnalysisError, motion::direction};

/// A value with all that its model is made of, or why there is none.
pub(super) struct SweepValue {
    pub value: f64,
    pub inputs: Result<LumpedInputs, Arc<AnalysisError>>,
}

/// A point with the number of its value, or why there is none.
type NumberedPoint = (usize, Result<SweepPoint, Arc<AnalysisError>>);

/// All values every way, one list a way in ascending order. Upwards and downwards each begins at rest under the load at its
/// first value; a value without a motion has its reason.
pub(super) fn all_ways(
    ways: &[SweepWay],
    values: &[SweepValue],
    at: impl Fn(&SweepValue, Option<&State>) -> Result<SettledPoint, Arc<AnalysisError>> + Sync,
    tick: &(dyn Fn() + Sync),
) -> Vec<Vec<SweepPoint>> {
    let directions: Vec<SweepDirection> = ways.iter().map(|way| direction(*way)).collect();
    let settle =
        |_, value: &SweepValue, from: Option<&State>| at(value, from).map(|SettledPoint { point, end }| (point, end));
    let told = |_: &SweepValue, _: &Result<SweepPoint, Arc<AnalysisError>>| {
        tick();
        ControlFlow::Continue(())
    };
    let all = integrate::sweep(values, &directions, settle, |_| false, told);
    let of_way = |(way, mut answers): (&SweepWay, Vec<NumberedPoint>)| {
        answers.sort_by_key(|(i, _)| *i);
        let point = |(i, answer): (usize, Result<SweepPoint, _>)| match answer {
            Ok(point) => SweepPoint { way: *way, ..point },
            Err(error) => SweepPoint::missing(*way, values[i].value, error),
        };
        answers.into_iter().map(point).collect()
    };
    ways.iter().zip(all).map(of_way).collect()
}
