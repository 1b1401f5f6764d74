//! A motion of shafts as rows of results.

use integrate::{Integrator, Scheme, State, StepControl};
use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use super::ShaftMechanism;
use crate::{LumpedError, Recorded, Recording, error::finite, recording::record};

/// One instant of one mesh.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ShaftRow {
    /// Time, s.
    pub time: f64,
    /// Phase of the mesh, 0 .. 1.
    pub mesh_phase: f64,
    /// Dynamic transmission error on the transverse line of action, um: from the turns of the gears, positive when the
    /// driven gear lags; 0 where the driving flanks of the error-free, unloaded pair touch, half the backlash off the
    /// middle of the clearance.
    pub transmission_error_um: f64,
    /// Compression of the mesh along the normal, mm: everything that moves the flanks against each other.
    pub compression: f64,
    /// Rate of the compression, mm/s.
    pub compression_rate: f64,
    /// Mesh stiffness along the normal, N/mm.
    pub stiffness: f64,
    /// Normal force, N; below zero on the coast flanks, or where oil in the clearance holds the flanks together.
    pub normal_force: f64,
    /// Forces x, y, z (N) and moments about x, y, z (N mm) of the mesh on gear 1 and gear 2, about their centres.
    pub wrench: [[f64; 6]; 2],
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
            transmission_error_um: 1e3 * (live.turns.dot(q) - live.zone.half_width) / live.line.cos_base_helix,
            compression: state.compression[0],
            compression_rate: state.compression[1],
            stiffness: state.stiffness[0],
            normal_force,
            wrench: live.line.levers.map(|h| std::array::from_fn(|i| -normal_force * h[i])),
        })
    }

    /// What counts as a large motion of each coordinate, for an integrator: a fiftieth of the largest base radius, or the
    /// turn that moves a flank by as much; a millimetre where there is no mesh.
    pub fn scale(&self) -> DVector<f64> {
        let largest = self.meshes.iter().flat_map(|m| m.line.base_radii).reduce(f64::max);
        let [length, radius] = largest.map_or([1.0; 2], |radius| [radius / 50.0, radius]);
        let all = self.coordinates();
        DVector::from_fn(all.len(), |i, _| if all[i].2 < 3 { length } else { length / radius })
    }

    /// Period of mesh `mesh`, s; infinite at rest, `None` where there is no such mesh.
    pub fn mesh_period(&self, mesh: usize) -> Option<f64> {
        self.meshes.get(mesh).map(|m| std::f64::consts::TAU / m.rate)
    }

    /// Carries a state that stands at a whole number of periods of mesh `mesh` on by one, in `steps` fixed steps, and
    /// returns what is there: a stroboscopic section, for bifurcation diagrams and Lyapunov exponents.
    ///
    /// # Errors
    /// [`LumpedError::NoMesh`], [`LumpedError::NotFinite`] at rest, [`LumpedError::Motion`].
    pub fn strobe(
        &mut self,
        mesh: usize,
        scheme: Scheme,
        steps: u32,
        state: &mut State,
    ) -> Result<ShaftRow, LumpedError> {
        let none = LumpedError::NoMesh { mesh, count: self.meshes.len() };
        let period = self.mesh_period(mesh).ok_or(none.clone())?;
        finite("period of the mesh, s", period)?;
        let until = ((state.time / period).round() + 1.0) * period;
        let control = StepControl::Fixed(period / f64::from(steps.max(1)));
        let mut integrator = Integrator::new(scheme, control, self.scale());
        integrator.advance(self, state, until, |_, _| ())?;
        self.row(mesh, state.time, &state.q, &state.v).ok_or(none)
    }

    /// Runs from the static equilibrium at t = 0 and keeps rows of mesh `mesh`.
    ///
    /// # Errors
    /// [`LumpedError::NoMesh`], those of [`ShaftMechanism::static_state`], and [`LumpedError::Motion`].
    pub fn history(&mut self, mesh: usize, plan: &Recording) -> Result<Recorded<ShaftRow>, LumpedError> {
        let q = self.static_state(0.0)?;
        let n = q.len();
        let still = DVector::zeros(n);
        let first = self.row(mesh, 0.0, &q, &still).ok_or(LumpedError::NoMesh { mesh, count: self.meshes.len() })?;
        let scale = self.scale();
        Ok(record(self, State::new(0.0, q, still), scale, plan, |system, state| {
            system.row(mesh, state.time, &state.q, &state.v).unwrap_or(first)
        })?)
    }
}
