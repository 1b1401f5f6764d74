//! Where a motion begins: in equilibrium, moving on as the equilibrium moves.

use fem::natural_modes;
use integrate::{Forces, Mechanism, State, equilibrium, quasi_static};
use nalgebra::{DMatrix, DVector};

use super::GearboxMechanism;
use crate::{
    GearboxError,
    equilibrium::Norms,
    even_mesh::{guessed_lever, guessed_stiffness},
};

/// Share of a cycle of the fastest mesh either way over which velocities are taken.
const SPAN: f64 = 1e-3;
/// Size of a coordinate that the equilibrium does not move, over the largest of its kind.
const LEAST: f64 = 1e-3;

/// Where no search ends.
const NOWHERE: GearboxError = GearboxError::NoEquilibrium { iterations: 0, step: f64::INFINITY };

impl GearboxMechanism {
    /// State at t = 0 in equilibrium, with the rates at which it changes as the train turns slowly; and modal damping
    /// about it from now on.
    ///
    /// ```text
    /// C += M Phi diag(2 zeta omega) Phi' M,   (K - df_mesh/dz) Phi = M Phi omega^2
    /// ```
    /// # Errors
    /// [`GearboxError`] where there is no equilibrium.
    pub fn start(&mut self, modal_damping: f64) -> Result<State, GearboxError> {
        // A ramp accelerates on one side of its beginning alone.
        let drive = std::mem::replace(&mut self.drive, self.drive.steady());
        let found = self.standing_on();
        self.drive = drive;
        let mut state = found?;
        if let Some(i) = self.free.turn {
            state.v[i] = self.input_speed();
        }
        if modal_damping > 0.0 {
            let k = self.tangent(&state.q)?;
            let modes = natural_modes(&k, &self.mass)?;
            // A tangent has round-off: what turns the whole train is no elastic mode.
            let turning = usize::from(self.free.turn.is_some());
            for (i, omega) in modes.frequencies.iter().enumerate().skip(turning) {
                let heavy = &self.mass * modes.shapes.column(i);
                self.damping.ger(2.0 * modal_damping * omega, &heavy, &heavy, 1.0);
            }
            if let Some(i) = self.free.turn {
                self.damping.row_mut(i).fill(0.0);
                self.damping.column_mut(i).fill(0.0);
            }
        }
        self.forget();
        Ok(state)
    }

    /// Sizes of the coordinates: what deflections and turns are at `state`.
    pub fn scale(&self, state: &State) -> DVector<f64> {
        let of = |turns: bool| {
            let own = state.q.iter().zip(&self.free.turns).filter(|(_, t)| **t == turns).map(|(x, _)| x.abs());
            own.fold(0.0, f64::max)
        };
        let sizes = [of(false).max(1e-6), of(true).max(1e-9)];
        let one = |(x, turns): (&f64, &bool)| x.abs().max(LEAST * sizes[usize::from(*turns)]);
        let mut scale = DVector::from_iterator(state.q.len(), state.q.iter().zip(&self.free.turns).map(one));
        if let Some(i) = self.free.turn {
            scale[i] = sizes[1];
        }
        scale
    }

    /// The state at t = 0 in equilibrium at the speed that the input begins with.
    fn standing_on(&mut self) -> Result<State, GearboxError> {
        let guess = self.guess()?;
        let near = self.standing(0.0, 0.0, guess)?;
        // Teeth near places that were looked at before are known less well: the search ends from its own end on.
        self.forget();
        let fastest = self.live.iter().map(|m| m.cycles_per_turn.abs()).fold(0.0, f64::max);
        let speed = self.input_speed();
        let span = if speed == 0.0 { 0.0 } else { SPAN / (fastest * speed.abs()) };
        quasi_static(self, 0.0, span, near, |own, t, z| own.standing(t, speed * t, z))
    }

    /// Where forces balance at a time with the input turned by an angle (rad about +z).
    fn standing(&mut self, t: f64, angle: f64, mut from: DVector<f64>) -> Result<DVector<f64>, GearboxError> {
        let turn = self.free.turn;
        turn.into_iter().for_each(|i| from[i] = angle);
        let scale = self.scale(&State::new(t, from.clone(), from.clone()));
        let held: Vec<usize> = turn.into_iter().collect();
        let mut found = equilibrium(self, t, &from, &held, &scale)?.ok_or(NOWHERE)?;
        turn.into_iter().for_each(|i| found[i] = 0.0);
        Ok(found)
    }

    /// Coordinates that the loads press the gears to, about.
    fn guess(&self) -> Result<DVector<f64>, GearboxError> {
        // The turn of the whole train comes last, if it is one.
        let count = self.count();
        let n = count - usize::from(self.free.turn.is_some());
        let mut stiffness = self.stiffness.view((0, 0), (n, n)).into_owned();
        for (live, (mesh, meshing)) in self.live.iter().zip(self.meshes.iter().zip(self.train.meshing())) {
            let lever = live.to_gears.tr_mul(&guessed_lever(mesh, meshing)?);
            let lever = lever.rows(0, n).into_owned();
            stiffness.ger(guessed_stiffness(&mesh.pair), &lever, &lever, 1.0);
        }
        // What a torque gives to the turn itself is left out.
        let load = (&self.loads[0] + &self.loads[1]).rows(0, n).into_owned();
        Ok(Norms::new(stiffness)?.displacements(&load).resize_vertically(count, 0.0))
    }

    /// K - df_mesh/dz at a place, symmetric.
    fn tangent(&mut self, z: &DVector<f64>) -> Result<DMatrix<f64>, GearboxError> {
        let mut forces = Forces::zeros(z.len());
        self.forces(0.0, z, &DVector::zeros(z.len()), &mut forces)?;
        let k = forces.stiffness;
        Ok(0.5 * (&k + k.transpose()))
    }
}
