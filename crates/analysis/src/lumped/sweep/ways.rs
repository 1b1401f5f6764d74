//! Value after value.

use std::sync::Arc;

use integrate::State;
use rayon::prelude::*;
use scene::SweepWay;

use super::{super::LumpedInputs, SweepPoint, point::SettledPoint};
use crate::AnalysisError;

/// A value with all that its model is made of, or why there is none.
pub(super) struct SweepValue {
    pub value: f64,
    pub inputs: Result<LumpedInputs, Arc<AnalysisError>>,
}

/// All values one way, in ascending order. Upwards and downwards each begins at rest under the load at its first
/// value and goes on from the last state; a value that does not get through from there begins at rest again, and
/// where that fails too it has its reason, and the next goes on from the last that has a motion.
pub(super) fn one_way(
    way: SweepWay,
    values: &[SweepValue],
    at: impl Fn(&SweepValue, Option<&State>) -> Result<SettledPoint, Arc<AnalysisError>> + Sync,
    tick: &(dyn Fn() + Sync),
) -> Vec<SweepPoint> {
    let settle = |value: &SweepValue, state: Option<&State>| {
        let carried = state.and_then(|state| at(value, Some(state)).ok());
        let settled = carried.map_or_else(|| at(value, None), Ok);
        tick();
        match settled {
            Ok(SettledPoint { point, end }) => (SweepPoint { way, ..point }, Some(end)),
            Err(error) => (SweepPoint::missing(way, value.value, error), None),
        }
    };
    let mut along: Vec<&SweepValue> = values.iter().collect();
    match way {
        SweepWay::Apart => return along.par_iter().map(|value| settle(value, None).0).collect(),
        SweepWay::Down => along.reverse(),
        SweepWay::Up => (),
    }
    let mut state = None;
    let mut points = Vec::with_capacity(along.len());
    for value in along {
        let (point, end) = settle(value, state.as_ref());
        state = end.or(state);
        points.push(point);
    }
    points.sort_by(|a, b| a.value.total_cmp(&b.value));
    points
}
