//! Remarks about a gearbox in motion; every mesh gets the remarks of a single pair.

use std::f64::consts::TAU;

use answer::{Remark, RowStore, TableError};
use gearbox::motion::GearboxInstant;
use integrate::SteadySteps;
use scene::gearbox::{GearboxDrive, GearboxMotion, MeshModel};

use super::{at_rest::AtRest, moved::GearboxMotionResult, swings::few_modes};
use crate::{
    in_motion::{
        MeshInMotion, MeshRecord, Parting, Resolved, Settled, StepKeys, coarse_steps, no_backlash, speed_changed,
        steps_of_cycle, work_open,
    },
    motion::{Elasticity, Pace, StepDemand, Vibration},
    remark,
};

/// What shows a resonance better over the speed.
const CUT: &str = "a longer run-up (`cycles`, `duration_s`) or fewer `waterfall_cycles` show it better";

/// A gearbox in motion that is judged.
#[derive(Clone, Copy)]
pub(super) struct Judged<'a> {
    pub rest: &'a AtRest<'a>,
    pub asked: &'a GearboxMotion,
    /// What the elasticity of the gears of each mesh leaves out.
    pub elasticity: &'a [Elasticity],
    pub moved: &'a GearboxMotionResult,
}

impl Judged<'_> {
    /// Keys that set the step length.
    pub fn step_keys(&self) -> StepKeys {
        StepKeys::GEARBOX.by(self.asked.error_tolerance)
    }

    /// Whether the coast flanks of a mesh are there to press.
    fn has_coast_flanks(&self, mesh: usize) -> bool {
        self.asked.mesh == MeshModel::Spring || self.rest.reduced[mesh].has_coast_flanks()
    }

    /// A mesh in the form that checks and remarks need.
    pub fn mesh(&self, i: usize) -> MeshInMotion<'_> {
        let reached = &self.moved.reached.meshes[i];
        MeshInMotion {
            scene: &self.rest.reduced[i].scene,
            pair: &self.rest.meshes[i].pair,
            flanks: &self.moved.flanks[i],
            has_coast_flanks: self.has_coast_flanks(i),
            errors_um: [reached.dte_um.least, reached.dte_um.largest],
            peak_to_peak_um: reached.peak_to_peak_dte_um,
            force_n: reached.normal_force.largest.max(reached.coast_normal_force),
            pressure_mpa: (self.asked.mesh == MeshModel::Exact).then_some(reached.max_pressure),
        }
    }

    /// Remarks for the user; meshes are given by name. `resolved` tells how well rows and steps resolve each mesh.
    pub fn remarks(&self, resolved: &[Resolved]) -> Vec<Remark> {
        let Self { rest, asked, moved, .. } = *self;
        let mut said: Vec<Remark> =
            self.settled().into_iter().chain(work_open(moved.ledger_residual_over_work)).collect();
        if asked.drive == GearboxDrive::Torque {
            said.extend(speed_changed(moved.reached.mean_input_speed * 60.0 / TAU, asked.speed_rpm));
        }
        said.extend(
            moved
                .run_up
                .and_then(|run_up| run_up.remark("the input", "a longer one (`cycles`, `duration_s`) is gentler")),
        );
        // A motion that a torque drives has no given speed at which it could come back.
        let alone = moved.common_period.is_none() && asked.drive != GearboxDrive::Torque;
        said.extend(alone.then(remark::no_common_period));
        let fastest = self.mesh_hz().into_iter().map(|[_, most]| most).fold(0.0, f64::max);
        said.extend(few_modes(rest.file, &moved.gear_modes, fastest));
        for (i, mesh) in rest.meshes.iter().enumerate() {
            said.extend(self.of_mesh(i, &resolved[i]).into_iter().map(|own| own.about(&mesh.name)));
        }
        said
    }

    /// What is said of a mesh.
    fn of_mesh(&self, i: usize, resolved: &Resolved) -> Vec<Remark> {
        let Self { rest, asked, moved, .. } = *self;
        let parting = if self.has_coast_flanks(i) { Parting::CoastFlanks } else { Parting::End };
        let mut said: Vec<Remark> = no_backlash(&rest.meshes[i].pair, parting).into_iter().collect();
        if asked.to_speed_rpm.is_none() {
            let resonance = moved.resonances[i].hz;
            let in_period = 1.0 / (moved.step * resonance);
            let of_resonance = || coarse_steps(in_period, ("mesh resonance", resonance), (StepKeys::GEARBOX, ""));
            said.extend(asked.error_tolerance.is_none().then(of_resonance).flatten());
        }
        said.extend(resolved.remarks.iter().cloned());
        said.extend(moved.run_ups.get(i).and_then(|own| own.coarse_cut(CUT)));
        said.extend(self.mesh(i).remarks());
        let found = self.vibration(i);
        said.extend(self.elasticity[i].warning(&found, &self.demand(), Pace { step_s: None }));
        said.extend(self.elasticity[i].rotation_warning(&found));
        said
    }

    /// Results of a mesh that are compared with the elastic frequencies of its gears.
    pub fn vibration(&self, i: usize) -> Vibration {
        Vibration {
            mesh_hz: self.mesh_hz()[i],
            resonance: self.moved.resonances[i],
            peak_to_peak_um: self.moved.reached.meshes[i].peak_to_peak_dte_um,
        }
    }

    /// Least and highest frequency of each mesh, Hz: of the speeds that are given, or that came of a torque.
    fn mesh_hz(&self) -> Vec<[f64; 2]> {
        let from = self.asked.speed_rpm * TAU / 60.0;
        let to = self.asked.to_speed_rpm.map_or(from, |rpm| rpm * TAU / 60.0);
        let reached = self.moved.reached.input_speed;
        let speeds = match self.asked.drive {
            GearboxDrive::Torque => [reached.least.min(from), reached.largest.max(from)],
            GearboxDrive::Speed | GearboxDrive::Balanced => [from.min(to), from.max(to)],
        };
        self.rest.cycles_per_turn().into_iter().map(|cycles| speeds.map(|speed| cycles * speed)).collect()
    }

    /// Steps of a longer analysis.
    fn demand(&self) -> StepDemand {
        let [_, mesh_hz] = self.mesh_hz().into_iter().fold([0.0; 2], |[l, h]: [f64; 2], [a, b]| [l.max(a), h.max(b)]);
        let cycles = f64::from(self.asked.cycles) + self.moved.warm_up_cycles as f64;
        StepDemand::of_gearbox((self.rest.file, self.asked), cycles, mesh_hz)
    }

    /// How well rows and steps resolve a mesh: its own orders and its own resonance. Not for a speed ramp.
    ///
    /// # Errors
    /// [`TableError::Kept`] if rows cannot be read back.
    pub fn resolved(&self, i: usize) -> Result<Resolved, TableError> {
        let Self { asked, moved, .. } = *self;
        // The first row is the start, and the last one may be no whole row behind the one before.
        let count = moved.even_rows.max(1) - 1;
        let whole = moved.reached.meshes[i].cycles * count as f64 / (moved.rows.len().max(2) - 1) as f64;
        let cycles = (whole + 1e-6).floor();
        if cycles < 1.0 || asked.to_speed_rpm.is_some() {
            return Ok(Resolved::default());
        }
        let samples = errors_um(&moved.rows, i, count)?;
        let per_cycle = count as f64 / whole;
        let used = ((cycles * per_cycle).round() as usize).min(count);
        let resonance = moved.resonances[i];
        // A slower mesh has as many more of them in its cycle.
        let fastest = moved.mesh_frequencies.iter().fold(0.0, |most: f64, hz| most.max(hz.abs()));
        let of_mean = |steps: f64| steps * fastest / moved.mesh_frequencies[i].abs();
        let (equal, mean) = (per_cycle * f64::from(asked.steps_per_row), moved.steps_per_cycle.map(of_mean));
        let steps = steps_of_cycle(asked.scheme, asked.error_tolerance, (equal, mean)).map(|per_period| SteadySteps {
            per_period,
            scheme: asked.scheme,
            resonance: resonance.hz / moved.mesh_frequencies[i],
            damping: resonance.damping,
        });
        let record = MeshRecord {
            samples: &samples[count - used..],
            cycles,
            steps,
            comes_back: moved.comes_back,
            keys: self.step_keys(),
        };
        Ok(record.resolved())
    }

    /// What a user should hear of a motion that was to settle.
    fn settled(&self) -> Option<Remark> {
        let Self { asked, moved, .. } = *self;
        let (tolerance, most) = asked.settle?;
        let settled = Settled {
            tolerance,
            found: moved.periodicity?,
            waited: moved.warm_up_cycles,
            most: u64::from(most),
            common: moved.common_period.map_or(usize::MAX, |period| period as usize),
            why: "it may be chaotic, have pitch errors, or need more `warm_up_cycles`",
        };
        settled.remark()
    }
}

/// Transmission error of a mesh at so many rows behind the first, um.
fn errors_um(rows: &RowStore<GearboxInstant>, mesh: usize, count: usize) -> Result<Vec<f64>, TableError> {
    rows.series(1..count + 1, |row| 1e3 * row.meshes[mesh].transmission_error)
}
