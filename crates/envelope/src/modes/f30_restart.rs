//! F30: runs that are cut and go on.

use analysis::{
    NoObserver, SinkResult,
    motion::{MotionAnalysis, MotionCheckpoint, MotionResult, MotionRow, MotionSink},
};
use answer::RowStore;

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, largest},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 30,
    name: "restart that differs",
    file: "F30-restart",
    scene: scene_text!("F30-restart"),
    fails: "A checkpoint without the method's own state (accelerations, warm starts, window): the run that goes on is another one.",
    does: "A checkpoint holds all of the state, with digests of it and of every input; the run goes on to the same bytes.",
    naive: &[],
    look,
};

/// Keeps rows and the last state.
#[derive(Default)]
struct Kept {
    rows: Vec<MotionRow>,
    state: Option<MotionCheckpoint>,
}

impl MotionSink for Kept {
    fn row(&mut self, row: &MotionRow) -> SinkResult {
        self.rows.push(row.clone());
        Ok(())
    }

    fn checkpoint(&mut self, state: MotionCheckpoint) -> SinkResult {
        self.state = Some(state);
        Ok(())
    }
}

/// Rows that differ in any bit, and the largest difference of the transmission error over its peak to peak.
fn apart(a: &MotionResult, b: &MotionResult) -> Result<[f64; 2], EnvelopeError> {
    let [rows, others] = [&a.rows, &b.rows].map(|rows| rows.part(0..rows.len()));
    let (rows, others) = (rows?, others?);
    let both = || rows.iter().zip(&others);
    let differ = both().filter(|(x, y)| x != y).count() + rows.len().abs_diff(others.len());
    let most = largest(both().map(|(x, y)| (x.dte_um - y.dte_um).abs()));
    Ok([differ as f64, most / a.headline.peak_to_peak_dte_um])
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let scene = bench.scene(&AS_IT_IS)?;
    let whole = bench.in_motion(&AS_IT_IS)?;
    let mut first = Kept::default();
    MotionAnalysis::new(&scene).stop_after(Some(8)).solve_into(&mut NoObserver, &mut first)?;
    let state = first.state.ok_or_else(|| EnvelopeError::piece("restart", "a stop leaves no state"))?;
    let mut naive = state.clone();
    naive.motion.state.a.fill(0.0);
    naive.motion.state.averaged.fill(0.0);
    let resumed = MotionAnalysis::new(&scene).resume(state, RowStore::of(first.rows.clone())?).solve()?;
    let without = MotionAnalysis::new(&scene).resume(naive, RowStore::of(first.rows)?).solve()?;
    let [differ, _] = apart(&whole, &resumed)?;
    let [naive_differ, naive_most] = apart(&whole, &without)?;
    Ok(vec![
        Figure::new(
            format!("rows of {} that differ after a stop at a third; naive: without accelerations", whole.rows.len()),
            Shown::at_most(differ, 0.0),
        )
        .beside(Shown::at_least(naive_differ, 1.0)),
        Figure::new(
            "naive restart: transmission error off, parts of its peak to peak",
            Shown::at_least(naive_most, 1e-12),
        ),
    ])
}
