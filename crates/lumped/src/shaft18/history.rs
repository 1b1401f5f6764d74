//! A motion of shafts as rows of results.

use dynamics::motion::{Integrator, MotionError, Scheme, State, StepControl};
use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use super::ShaftMechanism;
use crate::LumpedError;

/// One instant of one mesh.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ShaftRow {
    /// Time, s.
    pub time: f64,
    /// Phase of the mesh, 0 .. 1.
    pub mesh_phase: f64,
    /// Dynamic transmission error on the transverse line of action, um: from the turns of the gears, positive when the driven gear lags.
    pub transmission_error_um: f64,
    /// Compression of the mesh along the normal, mm: everything that moves the flanks against each other.
    pub compression: f64,
    /// Its rate, mm/s.
    pub compression_rate: f64,
    /// Mesh stiffness along the normal, N/mm.
    pub stiffness: f64,
    /// Normal force, N; below zero on the coast flanks, or where oil in the clearance holds the flanks together.
    pub normal_force: f64,
    /// Forces x, y, z (N) and moments about x, y, z (N mm) of the mesh on gear 1 and gear 2, about their centres.
    pub wrench: [[f64; 6]; 2],
}

/// What is to be run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShaftRun {
    /// Method.
    pub scheme: Scheme,
    /// Steps.
    pub control: StepControl,
    /// Time that passes before rows are kept, s.
    pub settle: f64,
    /// Time over which rows are kept, s.
    pub duration: f64,
    /// Every how many steps a row is kept; 0 counts as 1.
    pub every: u64,
}

impl ShaftMechanism {
    /// Rows of mesh `mesh` at one state.
    pub fn row(&self, mesh: usize, time: f64, q: &DVector<f64>, v: &DVector<f64>) -> Option<ShaftRow> {
        let live = self.meshes.get(mesh)?;
        let state = live.state(time, q, v);
        let normal_force = state.stiffness[0] * state.beyond.value + live.damping * state.compression[1];
        let phase = live.rate * time / std::f64::consts::TAU;
        Some(ShaftRow {
            time,
            mesh_phase: phase - phase.floor(),
            transmission_error_um: 1e3 * live.turns.dot(q) / live.line.cos_base_helix,
            compression: state.compression[0],
            compression_rate: state.compression[1],
            stiffness: state.stiffness[0],
            normal_force,
            wrench: live.line.levers.map(|h| std::array::from_fn(|i| -normal_force * h[i])),
        })
    }

    /// What counts as a large motion of each coordinate, for an integrator: a millimetre, or the turn that moves a flank by one.
    pub fn scale(&self) -> DVector<f64> {
        let radius = self.meshes.iter().flat_map(|m| m.line.base_radii).fold(1.0, f64::max);
        let all = self.coordinates();
        DVector::from_fn(all.len(), |i, _| if all[i].2 < 3 { 1.0 } else { 1.0 / radius })
    }

    /// Runs from the static equilibrium and returns rows of mesh `mesh` and the state at the end.
    ///
    /// # Errors
    /// [`LumpedError::NoMesh`], those of [`ShaftMechanism::static_state`], and [`LumpedError::Motion`].
    pub fn history(&mut self, mesh: usize, run: &ShaftRun) -> Result<(Vec<ShaftRow>, State), LumpedError> {
        if mesh >= self.meshes.len() {
            return Err(LumpedError::NoMesh { mesh, count: self.meshes.len() });
        }
        let q = self.static_state(0.0)?;
        let n = q.len();
        let mut state = State::new(0.0, q, DVector::zeros(n));
        let mut integrator = Integrator::new(run.scheme, run.control, self.scale());
        let (mut rows, mut count) = (Vec::new(), 0);
        let every = run.every.max(1);
        let failed = |e: MotionError<std::convert::Infallible>| LumpedError::Motion(e.to_string());
        integrator.advance(self, &mut state, run.settle, |_, _| ()).map_err(failed)?;
        let end = run.settle + run.duration;
        integrator
            .advance(self, &mut state, end, |system, seen| {
                count += 1;
                if count % every == 0 {
                    rows.extend(system.row(mesh, seen.state.time, &seen.state.q, &seen.state.v));
                }
            })
            .map_err(failed)?;
        Ok((rows, state))
    }
}
