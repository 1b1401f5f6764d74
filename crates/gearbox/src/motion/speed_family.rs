//! A gearbox over the speed of its input, in the form that the search for periodic motions needs: a linear machine, and
//! meshes that depend on few of its displacements. Theory (71a).

use std::f64::consts::TAU;

use dynamics::ElasticDisplacement;
use integrate::{Forces, State};
use nalgebra::{DMatrix, DVector, Dyn, OMatrix, U12};
use periodic::{CondensedFamily, LinearMachine};

use super::{Drive, GearboxMechanism};
use crate::{GearboxError, Vector12};

/// Angular speed (rad/s) of a turn a minute.
const RPM: f64 = TAU / 60.0;

/// Harmonics of a period at the most, of all cycles in it.
const HARMONICS: u64 = 1000;

/// Frequency of the modes that move when a motion is disturbed, over the highest that shafts must show.
const BEYOND: f64 = 2.0;

/// The meshes of a gearbox, each by the levers that it sees.
pub(super) struct SpeedFamily<'a> {
    mechanism: &'a mut GearboxMechanism,
    seen: Vec<Seen>,
    /// Turn of the input in a common period of all meshes, rad.
    turn: f64,
    scale: DVector<f64>,
}

/// What a mesh sees of the displacements of its gears.
struct Seen {
    /// First of its coordinates s.
    first: usize,
    /// S^+, 12 x m: displacements d = S^+ s, forces along s = (S^+)' f.
    inverse: OMatrix<f64, U12, Dyn>,
}

impl Seen {
    fn new(levers: &[Vector12], first: usize) -> Option<Self> {
        let rows = OMatrix::<f64, U12, Dyn>::from_columns(levers);
        let inverse = &rows * (rows.tr_mul(&rows)).try_inverse()?;
        Some(Self { first, inverse })
    }

    fn count(&self) -> usize {
        self.inverse.ncols()
    }

    /// Displacements, or their rates, by s.
    fn displacements(&self, s: &DVector<f64>) -> Vector12 {
        let d = &self.inverse * s.rows(self.first, self.count());
        Vector12::from_fn(|i, _| d[i])
    }
}

impl<'a> SpeedFamily<'a> {
    /// The meshes of a gearbox, and the machine between them, about an equilibrium and with its current modal damping.
    /// A period has several common periods of all meshes, counted in cycles of the fastest mesh.
    ///
    /// # Errors
    /// [`GearboxError::NoBranch`] if the input does not have a given speed or a mesh has no levers;
    /// [`GearboxError::LongPeriod`] if the meshes have no common period of up to 1000 harmonics, with `per_cycle`
    /// harmonics per cycle of the fastest mesh; the errors of the meshes.
    pub fn new(
        mechanism: &'a mut GearboxMechanism,
        rest: &State,
        (periods, per_cycle): (u64, u64),
    ) -> Result<(Self, LinearMachine, u64), GearboxError> {
        let refuse = |what| Err(GearboxError::NoBranch { what });
        if !matches!(mechanism.drive, Drive::Speed(_)) {
            return refuse("whose input does not keep its speed");
        }
        let period = mechanism.common_period().map(|cycles| periods.max(1).saturating_mul(cycles));
        let most = HARMONICS / per_cycle.max(1);
        let Some(cycles) = period.filter(|c| *c <= most) else {
            let per_cycle = period.map_or(0, |cycles| HARMONICS / cycles);
            return Err(GearboxError::LongPeriod { period, most, per_cycle });
        };
        let (mut seen, mut columns): (Vec<Seen>, Vec<DVector<f64>>) = Default::default();
        for live in &mut mechanism.live {
            let Some(levers) = live.element().levers() else {
                return refuse("with exact contact: all displacements of its flanks count");
            };
            let Some(own) = Seen::new(&levers, columns.len()) else {
                return refuse("with a mesh whose levers are not independent");
            };
            columns.extend(levers.iter().map(|lever| live.to_gears.tr_mul(lever)));
            seen.push(own);
        }
        let levers = DMatrix::from_fn(mechanism.count(), columns.len(), |i, j| columns[j][i]);
        let turn = cycles as f64 / mechanism.fastest();
        let mut family = Self { mechanism, seen, turn, scale: DVector::zeros(columns.len()) };
        let s = levers.tr_mul(&rest.q);
        let mut out = Forces::zeros(s.len());
        family.forces(0.0, 1.0, &s, &DVector::zeros(s.len()), &mut out)?;
        let reference = 0.5 * (&out.stiffness + out.stiffness.transpose());
        family.scale = family.sizes(&s, &reference);
        let own = &*family.mechanism;
        let sense = own.operation.sense.sign() as f64;
        let machine = LinearMachine {
            mass: own.mass.clone(),
            stiffness: own.stiffness.clone(),
            damping: own.damping.clone(),
            gyroscopic: &own.gyroscopic * (sense * turn / TAU),
            load: own.loads[0].clone(),
            levers,
            reference,
            highest: BEYOND * own.bodies.certificate().limit,
        };
        Ok((family, machine, cycles))
    }

    /// Number of cycles of each mesh in a period.
    pub fn mesh_cycles(&self) -> Vec<u64> {
        self.mechanism.live.iter().map(|m| (m.cycles_per_turn * self.turn).abs().round() as u64).collect()
    }

    /// Sizes of s: those that store as much energy as the approach of their mesh at rest, s_j^2 k_jj = s_0^2 k_00.
    fn sizes(&self, s: &DVector<f64>, stiffness: &DMatrix<f64>) -> DVector<f64> {
        let mut all = DVector::zeros(s.len());
        for own in &self.seen {
            let (size, k) = (s[own.first].abs().max(1e-6), stiffness[(own.first, own.first)]);
            for j in own.first..own.first + own.count() {
                let ratio = if stiffness[(j, j)] > 0.0 { (k / stiffness[(j, j)]).sqrt() } else { 1.0 };
                all[j] = size * ratio;
            }
        }
        all
    }
}

impl CondensedFamily for SpeedFamily<'_> {
    type Error = GearboxError;

    /// w = 2 pi Omega / turn.
    fn frequency_slope(&self) -> f64 {
        RPM * TAU / self.turn
    }

    fn scale(&self) -> DVector<f64> {
        self.scale.clone()
    }

    fn forces(
        &mut self,
        share: f64,
        frequency: f64,
        s: &DVector<f64>,
        rate: &DVector<f64>,
        out: &mut Forces,
    ) -> Result<(), GearboxError> {
        let sense = self.mechanism.operation.sense.sign() as f64;
        let [angle, speed] = [share, frequency / TAU].map(|x| sense * self.turn * x);
        for (i, own) in self.seen.iter().enumerate() {
            let (d, rates) = (own.displacements(s), own.displacements(rate));
            let cycles = self.mechanism.cycles(i, angle);
            let live = &mut self.mechanism.live[i];
            let at = ElasticDisplacement::rigid(d);
            let reply = live.reply(&self.mechanism.meshes[i], cycles, &at, out.tangents)?.clone();
            let passing = live.cycles_per_turn * speed;
            let losses = live.element().losses(&rates, passing);
            let along = own.inverse.tr_mul(&(reply.force + losses.force));
            let mut other = out.other.rows_mut(own.first, own.count());
            other += along;
            if out.tangents {
                let at = (own.first, own.first);
                let of = |m: nalgebra::SMatrix<f64, 12, 12>| own.inverse.tr_mul(&(m * &own.inverse));
                let size = (own.count(), own.count());
                out.stiffness.view_mut(at, size).copy_from(&of(losses.slope - reply.tangent));
                out.damping.view_mut(at, size).copy_from(&of(losses.rate_slope));
            }
        }
        Ok(())
    }
}
