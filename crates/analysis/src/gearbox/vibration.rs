//! Computes the vibration of a gearbox about its equilibrium.

use std::{f64::consts::TAU, sync::Arc};

use dynamics::RigidBody;
use gearbox::{
    GearMesh, GearboxError, Held, MeanMesh, MeshElement, MeshExcitation, MeshSample, Operation, OrderForces, SpeedRms,
    StaticGearbox, Structure, Train, Vibration, WhirlModes, elastic_gears, own_cycle, turn_levers,
};
use rayon::prelude::*;
use reduction::GearModes;
use scene::gearbox::{Gearbox, GearboxDrive, GearboxMotion, GearboxVibration};

use super::{
    inertia,
    meshes::ReducedMesh,
    orders::ORDERS,
    swings::{GearModesOfDiscs, GearboxCampbell, VibrationResult, gear_frequencies},
};
use crate::{
    AnalysisError, Observer, PhaseWork, Progress,
    motion::{CAMPBELL_BEYOND, RPM, kept_modes},
    run_phase, unless_cancelled,
};

/// A gearbox as its solvers take it.
#[derive(Clone, Copy)]
pub(super) struct Parts<'a> {
    pub file: &'a Gearbox,
    pub structure: &'a Structure,
    pub meshes: &'a [GearMesh],
    pub train: &'a Train,
    pub operation: &'a Operation,
}

/// Speeds of the Campbell diagram at the most: between them modes are straight.
const DRAWN: u32 = 21;
/// Positions of a mesh cycle at the least, and of one period of its highest order.
const POSITIONS: u32 = 16;
const PER_PERIOD: u32 = 4;
/// Modes at rest are kept up to so many times the highest frequency of excitation, and of the natural frequencies that
/// are asked for.
const BEYOND: f64 = 2.0;
const BEYOND_MODES: f64 = 1.5;
/// Natural frequencies in the diagram of a run-up.
const DRAWN_MODES: u32 = 20;

impl Parts<'_> {
    fn failed(&self, source: GearboxError) -> AnalysisError {
        AnalysisError::from(source).in_file(&self.file.file)
    }

    /// Every mesh through its own cycle while the others are linear about what they did in `samples`.
    fn excitations(
        &self,
        asked: &GearboxVibration,
        (reduced, modes): (&[ReducedMesh], &[Option<Arc<GearModes>>]),
        samples: &[Vec<MeshSample>],
        observer: &mut dyn Observer,
    ) -> Result<Vec<MeshExcitation>, AnalysisError> {
        let positions = self.file.positions_per_cycle.max(POSITIONS).max(PER_PERIOD * asked.orders);
        let means: Vec<MeanMesh> = samples.iter().filter_map(|own| MeanMesh::of(own)).collect();
        let steps = u64::from(positions) * self.meshes.len() as u64;
        run_phase(observer, "mesh cycles", PhaseWork::Steps(steps), |progress| {
            let mut common = Vec::new();
            let one = |own: usize| {
                let (structure, meshes) = (self.structure.clone(), self.meshes.to_vec());
                let made = StaticGearbox::new(structure, meshes, self.operation.clone(), |i, mesh, _| {
                    match means.get(i).filter(|_| i != own) {
                        Some(mean) => Ok(Box::new(mean.clone()) as Box<dyn MeshElement>),
                        None => match mesh.discs.map(|disc| modes.get(disc).cloned().flatten()) {
                            [Some(a), Some(b)] => reduced[i].with_modes(mesh, [a, b]),
                            _ => reduced[i].element(mesh, &mut common),
                        },
                    }
                });
                let mut gearbox = made.map_err(|e| self.failed(e))?;
                let cycle = own_cycle(&mut gearbox, own, positions as usize, || progress.tick());
                let (samples, errors) = cycle.map_err(|e| self.failed(e))?;
                unless_cancelled(progress)?;
                let nothing = || GearboxError::Count { what: "positions", found: 0, wanted: positions as usize };
                let turns = turn_levers(&self.meshes[own], &self.train.meshing()[own]).map_err(|e| self.failed(e))?;
                let found = MeshExcitation::new(&samples, &errors, asked.orders as usize, turns);
                found.ok_or_else(|| self.failed(nothing()))
            };
            (0..self.meshes.len()).map(one).collect()
        })
    }
}

/// Elastic modes of all gears in mesh, where the file keeps some; else none.
pub(super) fn elastic_modes(
    (file, structure, meshes): (&Gearbox, &Structure, &[GearMesh]),
    reduced: &[ReducedMesh],
    observer: &mut dyn Observer,
) -> Result<GearModesOfDiscs, AnalysisError> {
    let Some(asked) = &file.modes else { return Ok(Vec::new()) };
    let gears: Vec<_> = reduced.iter().map(ReducedMesh::gears).collect();
    run_phase(observer, "modes", PhaseWork::Steps(file.gears.len() as u64), |progress| {
        let found = elastic_gears(structure, meshes, &gears, |reducer| {
            let own = kept_modes(reducer, asked);
            progress.tick();
            own
        });
        found.map_err(|e| AnalysisError::from(e).in_file(&file.file))
    })
}

/// A gearbox that swings, and its natural motions over speed.
struct Swinging {
    vibration: Vibration,
    /// Frequency at rest (rad/s) up to which no mode is left out.
    limit: f64,
    /// Natural motions at the speeds of the diagram.
    modes: Vec<WhirlModes>,
    campbell: GearboxCampbell,
}

impl Swinging {
    /// With so many speeds of the input (rad/s) between the first and the last one that are asked for.
    fn new(
        parts: &Parts<'_>,
        asked: &GearboxVibration,
        (excitations, gears, modes): (Vec<MeshExcitation>, &[RigidBody], &GearModesOfDiscs),
        progress: &dyn Progress,
    ) -> Result<Self, AnalysisError> {
        let failed = |source: GearboxError| parts.failed(source);
        let held = Held {
            shafts: parts.operation.held.clone(),
            turns: if asked.held_input { vec![parts.operation.input] } else { Vec::new() },
        };
        let structure = inertia::heavy(parts.file, parts.structure, parts.operation, gears);
        let train = (parts.meshes, parts.train, parts.operation.sense);
        let whole = Vibration::with_modes(structure, train, excitations, modes, &held).map_err(failed)?;
        let limit = limit(&whole, asked, RPM * asked.speeds_rpm[1]);
        let vibration = whole.reduced(limit).map_err(failed)?;
        drop(whole);
        let at_speed = |speed: &f64| {
            let found = unless_cancelled(progress)
                .and_then(|()| vibration.rotors().whirl_modes(&vibration.speeds(*speed)).map_err(failed));
            progress.tick();
            // The lowest of all natural motions.
            found.map(|mut found| {
                found.modes.truncate(asked.modes as usize);
                found
            })
        };
        let drawn = speeds(asked, drawn(asked));
        // All of them before the first complaint: it is the same for any number of threads.
        let modes: Vec<Result<WhirlModes, AnalysisError>> = drawn.par_iter().map(at_speed).collect();
        let modes = modes.into_iter().collect::<Result<Vec<_>, _>>()?;
        let lines = vibration.lines(parts.train.ratios(), asked.orders);
        let diagram = diagram(&drawn, &modes, &lines.iter().map(|l| l.order).collect::<Vec<_>>())?;
        Ok(Self { vibration, limit, modes, campbell: GearboxCampbell { diagram, lines } })
    }
}

/// Speeds of the Campbell diagram.
fn drawn(asked: &GearboxVibration) -> u32 {
    asked.speeds.min(DRAWN)
}

/// So many speeds of the input, evenly spaced, rad/s.
fn speeds(asked: &GearboxVibration, count: u32) -> Vec<f64> {
    let [from, to] = asked.speeds_rpm.map(|rpm| RPM * rpm);
    (0..count).map(|i| from + (to - from) * f64::from(i) / f64::from(count - 1)).collect()
}

/// Natural frequencies over speed, and the answer to all mesh orders.
pub(super) fn vibration(
    parts: &Parts<'_>,
    asked: &GearboxVibration,
    (reduced, modes_of_gears): (&[ReducedMesh], &GearModesOfDiscs),
    samples: &[Vec<MeshSample>],
    observer: &mut dyn Observer,
) -> Result<VibrationResult, AnalysisError> {
    let failed = |source: GearboxError| parts.failed(source);
    let excitations = parts.excitations(asked, (reduced, modes_of_gears), samples, observer)?;
    let gears = inertia::gears(parts.file, reduced)?;
    let speeds = speeds(asked, asked.speeds);
    let work = PhaseWork::Steps(u64::from(drawn(asked)) + speeds.len() as u64);
    run_phase(observer, "vibrate", work, |progress| {
        let Swinging { vibration, limit, modes, campbell } =
            Swinging::new(parts, asked, (excitations, &gears, modes_of_gears), progress)?;
        let answer = |speed: &f64| {
            let found = unless_cancelled(progress)
                .and_then(|()| vibration.harmonics(*speed, asked.damping_ratio).map_err(failed));
            progress.tick();
            found.map(|all| all.iter().map(OrderForces::of).collect::<Vec<_>>())
        };
        let orders: Vec<Result<Vec<OrderForces>, AnalysisError>> = speeds.par_iter().map(answer).collect();
        let orders = orders.into_iter().collect::<Result<Vec<_>, _>>()?;
        Ok(VibrationResult {
            gear_modes: gear_frequencies(gears.len(), modes_of_gears),
            gears,
            mesh_stiffness: vibration.mesh_stiffness(),
            transmission_error: vibration
                .excitations()
                .map(|e| e.transmission_error.iter().map(|x| x.norm()).collect())
                .collect(),
            modes_kept: vibration.rotors().modes_at_rest().frequencies.len(),
            modes_up_to_hz: limit / TAU,
            modes,
            campbell,
            speeds,
            rms: orders.iter().map(|own| SpeedRms::of(own)).collect(),
            orders,
        })
    })
}

/// Natural frequencies from standstill to a little beyond the highest speed of a run-up.
pub(super) fn campbell(
    parts: &Parts<'_>,
    asked: &GearboxMotion,
    (reduced, modes_of_gears): (&[ReducedMesh], &GearModesOfDiscs),
    samples: &[Vec<MeshSample>],
    observer: &mut dyn Observer,
) -> Result<GearboxCampbell, AnalysisError> {
    let asked = GearboxVibration {
        speeds_rpm: [0.0, CAMPBELL_BEYOND * asked.speed_rpm.max(asked.to_speed_rpm.unwrap_or(0.0))],
        speeds: DRAWN,
        orders: ORDERS as u32,
        damping_ratio: asked.modal_damping_ratio,
        modes: DRAWN_MODES,
        held_input: asked.drive == GearboxDrive::Speed,
    };
    let excitations = parts.excitations(&asked, (reduced, modes_of_gears), samples, observer)?;
    let gears = inertia::gears(parts.file, reduced)?;
    run_phase(observer, "modes over speed", PhaseWork::Steps(u64::from(DRAWN)), |progress| {
        Ok(Swinging::new(parts, &asked, (excitations, &gears, modes_of_gears), progress)?.campbell)
    })
}

/// Frequency at rest (rad/s) up to which no mode is left out.
fn limit(whole: &Vibration, asked: &GearboxVibration, fastest: f64) -> f64 {
    let highest = whole.mesh_orders().into_iter().fold(0.0, f64::max) * f64::from(asked.orders) * fastest;
    let rest = &whole.rotors().modes_at_rest().frequencies;
    let told = rest.iter().filter(|w| **w > 0.0).nth(asked.modes as usize);
    (BEYOND * highest).max(BEYOND_MODES * told.copied().unwrap_or(f64::INFINITY))
}

fn diagram(speeds: &[f64], modes: &[WhirlModes], orders: &[f64]) -> Result<study::Campbell, AnalysisError> {
    // As many at each speed: motions that gyroscopic moments alone make are not there at every one.
    let count = modes.iter().map(|m| m.modes.len()).min().unwrap_or(0);
    let mut each = modes.iter();
    let in_hz: Vec<f64> = speeds.iter().map(|s| s / TAU).collect();
    let found = study::campbell(&in_hz, orders, |_| {
        each.next().map_or_else(Vec::new, |m| m.modes.iter().take(count).map(|m| m.frequency / TAU).collect())
    });
    found.map_err(AnalysisError::from)
}
