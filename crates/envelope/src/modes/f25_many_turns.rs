//! F25: angles after many turns.

use std::{f64::consts::TAU, sync::Arc};

use ale::Station;
use analysis::options;
use dynamics::{Bearing, Drive, MeshDamping, MotionOptions, RigidBody, Speed, Torque};
use gearbox::motion::PairModel;
use integrate::State;
use nalgebra::DVector;
use scene::Scene;

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, largest, mean},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 25,
    name: "lost digits after many turns",
    file: "F25-many-turns",
    scene: scene_text!("F25-many-turns"),
    fails: "An angle that is added up step by step, or that grows with the turns, loses the digits in which teeth deflect.",
    does: "Teeth are counted in whole numbers; the angle is that within the mesh cycle.",
    naive: &[],
    look,
};

/// Turns of the pinion before the second look.
const TURNS: f64 = 1e6;
/// Steps that the naive clock adds up.
const STEPS: u64 = 1 << 27;
const PHASES: usize = 8;

/// Normal force of the pair at eight phases of a mesh cycle, N, the gears held at the same lag, `start` cycles on.
fn forces(bench: &Bench, start: f64) -> Result<Vec<f64>, EnvelopeError> {
    let piece = "pair in motion";
    let scene = bench.scene(&AS_IT_IS)?;
    let solved = bench.at_rest(&AS_IT_IS)?;
    let lag = 1e-3 * mean(&crate::bench::errors_um(&solved));
    let missing = || EnvelopeError::piece(piece, "no model");
    let pair = solved.pair.clone();
    let stiffness = solved.history.positions.iter().map(|p| p.tangent_stiffness).sum::<f64>() / 8.0;
    let length = solved.history.positions.iter().map(|p| p.contact_line_length).sum::<f64>() / 8.0;
    let gears = solved.model.ok_or_else(missing)?.into_gears();
    let body = RigidBody { mass: 1e-3, transverse_inertia: 0.5, polar_inertia: 1.0 };
    let statics = options(&scene, &pair);
    let load = Torque::Constant(statics.torque);
    let speed = pair.pinion.pitch_angle();
    let asked = MotionOptions {
        statics,
        bodies: [body; 2],
        bearings: [Bearing::default(); 2],
        free: [[false; 6]; 2],
        drive: Drive::Speed(Speed::Constant(speed)),
        load,
        damping: MeshDamping::Ratio(0.0),
        start_cycles: start,
    };
    let model = PairModel::new(pair, Arc::clone(&gears), None, asked, [stiffness, length]);
    let mut system = model.and_then(|model| model.machine()).map_err(EnvelopeError::of(piece))?;
    let mut all = Vec::new();
    for k in 0..PHASES {
        // The lag is the one coordinate that is free.
        let state = State::new(k as f64 / PHASES as f64, DVector::from_element(1, lag), DVector::zeros(1));
        let instant = system.pair_instant(&state).map_err(EnvelopeError::of(piece))?;
        all.push(instant.normal_forces()[0]);
    }
    Ok(all)
}

/// How far the angle after [`STEPS`] steps of 1920 a turn is off, on the pinion's base circle, um: the station at that
/// time, and the steps added up.
fn drifts(scene: &Scene) -> Result<[f64; 2], EnvelopeError> {
    let pair = scene.gear_pair()?;
    let per_radian = 1e3 * pair.pinion.base_radius();
    // A turn a second.
    let turned = Speed::Constant(TAU).angle(STEPS as f64 / 1920.0);
    let station = Station::at_cycles(turned / pair.pinion.pitch_angle());
    let teeth = u64::from(pair.pinion.teeth());
    let (whole, part) = (STEPS * teeth / 1920, (STEPS * teeth % 1920) as f64 / 1920.0);
    let cycles = (station.cycle - whole as i64) as f64 + (station.phase - part);
    let summed = (0..STEPS).fold(0.0, |angle, _| angle + TAU / 1920.0);
    let exact = (STEPS / 1920) as f64 * TAU + (STEPS % 1920) as f64 * (TAU / 1920.0);
    Ok([per_radian * pair.pinion.pitch_angle() * cycles.abs(), per_radian * (summed - exact).abs()])
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let first = forces(bench, 0.0)?;
    let later = forces(bench, 30.0 * TURNS)?;
    let off = largest(first.iter().zip(&later).map(|(a, b)| (a / b - 1.0).abs()));
    let [drift, summed] = drifts(&bench.scene(&AS_IT_IS)?)?;
    Ok(vec![
        Figure::new(
            "force of the pair at eight phases, now and a million turns later, parts off",
            Shown::at_most(off, 1e-6),
        ),
        Figure::new(
            "drift of the angle after 70 000 turns, on the base circle, um; naive: 1920 steps a turn added up",
            Shown::at_most(drift, 1e-4),
        )
        .beside(Shown::at_least(summed, 1e-4)),
    ])
}
