//! A mesh of the chart solved by CalculiX.

use ale::ToothWindow;
use geometry::{GearPair, Side};
use ltca::StaticOptions;
use scene::{MisalignmentScene, ModificationScene, Scene, Sense};
use study::{
    Answer, Work,
    calculix::{Body, Calculix, Deck},
};

use super::{
    Point,
    measured::{ChartTools, Measured, point_meshes},
    plan::PENALTY,
};
use crate::{AnalysisError, elastic_gears::material, options, refused::Refusal};

/// The driven gear is turned into contact by about this much on the line of action, mm: a few um are what steel gears
/// yield under load.
const CLOSING: f64 = 5e-3;

/// Runs the positions of a point by CalculiX.
///
/// # Errors
/// When CalculiX is not installed, cannot model the scene, or gives no result.
pub(super) fn measure(point: &Point, tools: ChartTools<'_>) -> Result<Measured, AnalysisError> {
    let scene = &point.scene;
    let calculix = Calculix::find(rayon::current_num_threads())?;
    beyond_calculix(scene)?;
    let pair = scene.gear_pair()?;
    let meshes = point_meshes(scene)?;
    let options = options(scene, &pair);
    let materials = [material(scene, 0)?, material(scene, 1)?];
    let scratch = tools.scratch.ok_or_else(|| Refusal::no_result("no folder for the files of CalculiX", None))?;
    let side = scene.side();
    let driven = options.driven();
    let base_radius = [pair.pinion.base_radius(), pair.wheel.base_radius()][driven].abs();
    let mut work = Work {
        offline_s: 0.0,
        cycle_s: 0.0,
        further_cycle_s: None,
        positions_run: point.positions as usize,
        positions_asked: point.positions_asked as usize,
        peak_memory_mb: None,
        dof_before: meshes.iter().map(|g| 3 * (g.mesh().nodes.len() - g.bore_nodes().len())).sum(),
        dof_after: 0,
    };
    work.dof_after = work.dof_before;
    let mut answer = Answer { ste_um: Vec::new(), line_length_mm: Vec::new() };
    let teeth = [pair.pinion.teeth(), pair.wheel.teeth()];
    for i in 0..point.positions {
        let phase = f64::from(i) / f64::from(point.positions);
        let angle = pinion_angle(scene, &pair, side, phase);
        let angles = [angle, pair.wheel_angle(side, angle)];
        let pairs = pairs_near(&pair, &options, scene.operation.rotation, phase, teeth)?;
        let body = |i: usize| Body {
            gear: &meshes[i],
            material: &materials[i],
            angle: angles[i],
            centre: [[0.0, 0.0], [pair.centre_distance(), pair.mid_face_offset()]][i],
        };
        let deck = Deck {
            bodies: [body(0), body(1)],
            driven,
            side,
            pairs: &pairs,
            torque: scene.operation.torque(),
            closing: CLOSING / base_radius,
            penalty: PENALTY,
        };
        let run = calculix.run(&deck, scratch)?;
        work.cycle_s += run.wall_s * f64::from(point.positions_asked) / f64::from(point.positions);
        work.peak_memory_mb = work.peak_memory_mb.into_iter().chain(run.peak_memory_mb).reduce(f64::max);
        answer.ste_um.push(1e3 * base_radius * run.result.rotation);
    }
    let accuracy = Err("no bounds of other programs".into());
    Ok(Measured { work, answer, note: calculix.version().unwrap_or_default(), accuracy })
}

/// Angle of the pinion at a phase of the first cycle, rad.
fn pinion_angle(scene: &Scene, pair: &GearPair, side: Side, phase: f64) -> f64 {
    pair.middle_angle(side) + scene.operation.rotation.sign() as f64 * (phase - 0.5) * pair.pinion.pitch_angle()
}

/// Teeth of the pairs of the window that stands at a phase of the first cycle.
fn pairs_near(
    pair: &GearPair,
    options: &StaticOptions,
    rotation: Sense,
    phase: f64,
    teeth: [u32; 2],
) -> Result<Vec<[u32; 2]>, AnalysisError> {
    let count = options.window_teeth(pair);
    let first = ToothWindow::nominal_first(-(rotation.sign() as f64) * (phase - 0.5), count);
    let window = ToothWindow::new(first, count, teeth)?;
    Ok(window.pairs().map(|running| window.teeth_of(running)).collect())
}

/// Says what of a scene the deck does not carry.
fn beyond_calculix(scene: &Scene) -> Result<(), AnalysisError> {
    let modified = scene.gears().iter().any(|g| {
        !ModificationScene::is_none(&g.modification) || !g.pitch_errors_um.is_empty() || g.pitch_errors_file.is_some()
    });
    let what = [
        (modified, "micro-geometry: meshes have nominal flanks"),
        (!MisalignmentScene::is_none(&scene.pair.misalignment), "misaligned axes"),
        (scene.contact.friction != 0.0, "friction"),
        (scene.operation.torque_nm == 0.0, "gears without torque"),
    ];
    let named = what.into_iter().find_map(|(there, name)| there.then_some(name));
    let refused = |what| Refusal::no_result(format!("the deck for CalculiX has no {what}"), None);
    named.map_or(Ok(()), |what| Err(refused(what).into()))
}
