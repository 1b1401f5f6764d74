//! A scene in time, from the analysis that it asks for to the files of its result.

use analysis::{
    AnalysisError, GearCache, Observer,
    accuracy::motion::{AccurateMotion, MotionAnswer, MotionTold},
    lumped::{BasinAnalysis, ContinuationAnalysis, KeySweep, LumpedAnalysis, NoLumpedSink, SweepOptions, is_lumped},
    motion::{MotionAnalysis, MotionOutcome, SweepAnalysis},
};
use mesh::Mesh;
use scene::{MotionScene, Scene};

use crate::{
    Cost, ReportError,
    columns::{lumped_history::DTE, lumped_quantity},
    folder::ResultDirectory,
    motion_files::MotionFileSink,
    write_basin_result, write_continuation_result, write_key_sweep_result, write_lumped_result, write_motion_result,
    write_sweep_result,
};

/// Hears of the phases, and knows what they cost.
pub trait Recorder: Observer {
    /// What it all cost so far.
    fn cost(&self) -> Cost;
}

/// The closing table of a result whose files stand, and whether it holds.
pub type Told = (String, Result<(), AnalysisError>);

impl From<ReportError> for Unwritten {
    fn from(error: ReportError) -> Self {
        Self(AnalysisError::Sink(Box::new(error)))
    }
}

impl From<AnalysisError> for Unwritten {
    fn from(error: AnalysisError) -> Self {
        Self(error)
    }
}

/// Why there is no result; what files say against it comes as [`AnalysisError::Sink`] with a [`ReportError`].
struct Unwritten(AnalysisError);

/// Runs the motion that a scene asks for, in one piece, and writes all files of the result; `meshes` of pinion and wheel
/// take the place of the scene's where reduced gears move by themselves.
///
/// # Errors
/// [`AnalysisError`]; of files as [`AnalysisError::Sink`] with a [`ReportError`]. [`AnalysisError::OtherAnalysis`] for a
/// scene at rest.
pub fn solve_in_time(
    scene: &Scene,
    meshes: Option<[&Mesh; 2]>,
    recorder: &mut dyn Recorder,
    results: &ResultDirectory,
    cache: &dyn GearCache,
) -> Result<Told, AnalysisError> {
    let Some(words) = &scene.motion else {
        let file = scene.file.display().to_string();
        return Err(AnalysisError::OtherAnalysis { file, wanted: "motion" });
    };
    if is_lumped(scene) {
        return solve_lumped(scene, words, recorder, results, cache);
    }
    if words.continuation.is_some() || words.basins.is_some() {
        return solve_many_motions(scene, words, recorder, results, cache);
    }
    if words.sweep.is_some() {
        return solve_sweep(scene, recorder, results, cache);
    }
    if !scene.accuracy.is_none() {
        return solve_accurate(scene, recorder, results, cache);
    }
    solve_motion(scene, meshes, recorder, results, cache).map_err(|e| e.0)
}

fn solve_motion(
    scene: &Scene,
    meshes: Option<[&Mesh; 2]>,
    recorder: &mut dyn Recorder,
    results: &ResultDirectory,
    cache: &dyn GearCache,
) -> Result<Told, Unwritten> {
    let mut sink = MotionFileSink::new(scene, results.folder(), None, None).with_fields(results);
    let analysis = MotionAnalysis::new(scene).with_cache(cache);
    let analysis = match meshes {
        Some(meshes) => analysis.with_meshes(meshes),
        None => analysis,
    };
    match analysis.solve_into(recorder, &mut sink)? {
        // Nobody asked it to stop on the way.
        MotionOutcome::Stopped { .. } => Err(AnalysisError::Cancelled.into()),
        MotionOutcome::Finished(result) => {
            let table = write_motion_result(scene, &result, &recorder.cost(), sink.view.as_ref(), results)?;
            Ok((table, result.facts.verdict(scene)))
        }
    }
}

/// A cheaper model: one motion, or many.
///
/// # Errors
/// As [`solve_in_time`].
pub fn solve_lumped(
    scene: &Scene,
    motion: &MotionScene,
    recorder: &mut dyn Recorder,
    results: &ResultDirectory,
    cache: &dyn GearCache,
) -> Result<Told, AnalysisError> {
    let mut solve = || -> Result<Told, Unwritten> {
        if let Some(speeds) = &motion.sweep {
            let quantity = lumped_quantity(scene, DTE.name).ok_or(AnalysisError::NoValues)?;
            let (scenes, options) = SweepOptions::over_speed(scene, speeds, quantity);
            let found = KeySweep::new(&scenes, &options).with_cache(cache).solve_with(recorder)?;
            return Ok((write_key_sweep_result(&options, &found, None, &recorder.cost(), results)?, Ok(())));
        }
        if motion.continuation.is_some() || motion.basins.is_some() {
            return Ok(solve_many_motions(scene, motion, recorder, results, cache)?);
        }
        let result = LumpedAnalysis::new(scene).with_cache(cache).solve_into(recorder, &mut NoLumpedSink)?;
        let table = write_lumped_result(scene, &result, &recorder.cost(), results)?;
        Ok((table, result.facts.verdict(scene)))
    };
    solve().map_err(|e| e.0)
}

/// Periodic motions along a key, or basins of attraction.
///
/// # Errors
/// As [`solve_in_time`].
pub fn solve_many_motions(
    scene: &Scene,
    motion: &MotionScene,
    recorder: &mut dyn Recorder,
    results: &ResultDirectory,
    cache: &dyn GearCache,
) -> Result<Told, AnalysisError> {
    let mut solve = || -> Result<Told, Unwritten> {
        if motion.basins.is_some() {
            let found = BasinAnalysis::new(scene).with_cache(cache).solve_with(recorder)?;
            let table = write_basin_result(scene, &found, &recorder.cost(), results)?;
            return Ok((table, found.facts.verdict(scene)));
        }
        let found = ContinuationAnalysis::new(scene).with_cache(cache).solve_with(recorder)?;
        let table = write_continuation_result(scene, &found, &recorder.cost(), results)?;
        Ok((table, found.facts.verdict(scene)))
    };
    solve().map_err(|e| e.0)
}

/// With bounds; the model is the scene's, or the cheapest that is as exact as it asks.
///
/// # Errors
/// As [`solve_in_time`].
pub fn solve_accurate(
    scene: &Scene,
    recorder: &mut dyn Recorder,
    results: &ResultDirectory,
    cache: &dyn GearCache,
) -> Result<Told, AnalysisError> {
    let mut solve = || -> Result<Told, Unwritten> {
        let mut sink = MotionFileSink::new(scene, results.folder(), None, None);
        let told = &mut MotionTold { motion: &mut sink, lumped: &mut NoLumpedSink };
        let solved = AccurateMotion::new(scene).with_cache(cache).solve_into(recorder, told)?;
        let (scene, cost) = (&solved.scene, recorder.cost());
        let table = match &solved.answer {
            MotionAnswer::Lumped(result) => write_lumped_result(scene, result, &cost, results)?,
            MotionAnswer::Reduced(result) => write_motion_result(scene, result, &cost, sink.view.as_ref(), results)?,
        };
        Ok((table, solved.answer.facts().verdict(&solved.scene)))
    };
    solve().map_err(|e| e.0)
}

/// Steady states of reduced gears over speed.
///
/// # Errors
/// As [`solve_in_time`].
pub fn solve_sweep(
    scene: &Scene,
    recorder: &mut dyn Recorder,
    results: &ResultDirectory,
    cache: &dyn GearCache,
) -> Result<Told, AnalysisError> {
    let mut solve = || -> Result<Told, Unwritten> {
        let mut sink = MotionFileSink::new(scene, results.folder(), None, None);
        let result = SweepAnalysis::new(scene).with_cache(cache).solve_into(recorder, &mut sink)?;
        let table = write_sweep_result(scene, &result, &recorder.cost(), sink.view.as_ref(), results)?;
        Ok((table, result.verdict(scene)))
    };
    solve().map_err(|e| e.0)
}
