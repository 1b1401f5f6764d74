//! Equations of motion of a system of shafts. Theory (54).

use std::convert::Infallible;

use fem::{Modes, beam::BeamTheory, natural_modes};
use integrate::{Forces, Mechanism};
use nalgebra::{Cholesky, DMatrix, DVector};

use super::{LumpedShaft, Mesh, MeshLine, RunOut, ShaftSystem};
use crate::{
    DeadZone, Fourier, LumpedError,
    modes::{Mode, damped_modes, undamped_modes},
};

/// A system of lumped shafts as an integrator sees it: deviations q from the steady turn of all shafts in the ratios of
/// their teeth.
///
/// ```text
/// M q'' + (C + G) q' + K q + sum over meshes of h F = f
/// F = k(phi) g(delta) + c delta',   delta = h . q + e(t),   phi = z_1 |Omega_1| t
/// c = 2 xi sqrt(k_s / (1/m_1 + 1/m_2)),   m_i = J_i / (r_bi cos b_b)^2
/// ```
/// g the dead zone of half-width b_n, e error and run-out of the teeth, f torques and weight, C Rayleigh's damping and
/// that of the supports, G gyroscopic moments. As the seed has it, mesh damping acts in the clearance as well (oil
/// between the flanks); there F may be below zero.
#[derive(Debug, Clone)]
pub struct ShaftMechanism {
    pub(super) shafts: Vec<LumpedShaft>,
    mass: DMatrix<f64>,
    pub(super) stiffness: DMatrix<f64>,
    /// Damping of shafts and supports, and gyroscopic forces.
    damping: DMatrix<f64>,
    gyroscopic: DMatrix<f64>,
    pub(super) load: DVector<f64>,
    pub(super) meshes: Vec<LiveMesh>,
    /// Power that the torques leave over, N mm/s, of the largest among them.
    pub(super) imbalance: [f64; 2],
    pub(super) held: bool,
}

/// A mesh in the coordinates of the system.
#[derive(Debug, Clone)]
pub(super) struct LiveMesh {
    pub line: MeshLine,
    /// h in all coordinates.
    pub lever: DVector<f64>,
    /// Part of h by turns about the gears' own axes.
    pub turns: DVector<f64>,
    pub stiffness: Fourier,
    pub damping: f64,
    pub zone: DeadZone,
    error: Fourier,
    run_out: [RunOut; 2],
    /// Speeds of both gears, rad/s, without sign.
    speeds: [f64; 2],
    /// dphi/dt, rad/s.
    pub rate: f64,
}

/// A mesh at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MeshState {
    /// k and dk/dt.
    pub stiffness: [f64; 2],
    /// delta and delta'.
    pub compression: [f64; 2],
    /// e'.
    pub error_rate: f64,
    /// g(delta) and its slope.
    pub beyond: crate::Beyond,
}

impl LiveMesh {
    fn new(mesh: &Mesh, shafts: &[LumpedShaft], first: &[usize], speeds: &[f64]) -> Result<Self, LumpedError> {
        let line = mesh.geometry.line()?;
        let n = first[shafts.len()];
        let (mut lever, mut turns) = (DVector::zeros(n), DVector::zeros(n));
        let mut inverse_mass = 0.0;
        for (i, place) in mesh.gears.iter().enumerate() {
            let shaft = &shafts[place.shaft];
            let mut own = lever.rows_mut(first[place.shaft], shaft.kept.len());
            own += shaft.stations.rows(6 * place.station, 6).transpose() * line.levers[i];
            let mut own = turns.rows_mut(first[place.shaft], shaft.kept.len());
            own += line.levers[i][5] * shaft.stations.row(6 * place.station + 5).transpose();
            let radius = line.base_radii[i] * line.cos_base_helix;
            inverse_mass += radius * radius / shaft.polar_inertia[place.station];
        }
        if !(inverse_mass.is_finite() && inverse_mass > 0.0) {
            return Err(LumpedError::NotPositive { quantity: "polar inertia of a gear, t mm^2", value: 0.0 });
        }
        let speeds = mesh.gears.map(|g| speeds[g.shaft].abs());
        Ok(Self {
            line,
            lever,
            turns,
            damping: 2.0 * mesh.damping_ratio * (mesh.stiffness.mean / inverse_mass).sqrt(),
            stiffness: mesh.stiffness.clone(),
            zone: DeadZone::new(mesh.half_backlash),
            error: mesh.error.clone(),
            run_out: mesh.run_out,
            speeds,
            rate: f64::from(mesh.geometry.teeth[0]) * speeds[0],
        })
    }

    /// Error and run-out and their rates, mm and mm/s.
    pub fn excess(&self, t: f64) -> [f64; 2] {
        let [mut e, slope] = self.error.with_slope(self.rate * t);
        let mut rate = slope * self.rate;
        for (r, omega) in self.run_out.iter().zip(self.speeds) {
            let amplitude = r.eccentricity * self.line.cos_base_helix;
            let (sin, cos) = (omega * t + r.phase).sin_cos();
            e += amplitude * sin;
            rate += amplitude * omega * cos;
        }
        [e, rate]
    }

    pub fn state(&self, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> MeshState {
        let [k, slope] = self.stiffness.with_slope(self.rate * t);
        let [e, error_rate] = self.excess(t);
        let compression = [self.lever.dot(q) + e, self.lever.dot(v) + error_rate];
        let beyond = self.zone.at(compression[0]);
        MeshState { stiffness: [k, slope * self.rate], compression, error_rate, beyond }
    }
}

/// Torques and weight on the coordinates; power that the torques leave over by speed ratios, and the largest of a
/// single one.
fn loads(system: &ShaftSystem, shafts: &[LumpedShaft], first: &[usize], speeds: &[f64]) -> (DVector<f64>, [f64; 2]) {
    let mut load = DVector::zeros(first[shafts.len()]);
    for (s, shaft) in shafts.iter().enumerate() {
        let mut own = load.rows_mut(first[s], shaft.kept.len());
        own += &shaft.gravity * DVector::from_row_slice(&system.gravity);
    }
    let mut imbalance = [0.0, 0.0f64];
    for t in &system.torques {
        let s = t.place.shaft;
        let mut own = load.rows_mut(first[s], shafts[s].kept.len());
        own += t.torque * shafts[s].stations.row(6 * t.place.station + 5).transpose();
        // By ratios rather than by speeds: a system at rest is in balance or not as well.
        let power = t.torque * if system.speed == 0.0 { 1.0 } else { speeds[s] / system.speed };
        imbalance = [imbalance[0] + power, imbalance[1].max(power.abs())];
    }
    (load, imbalance)
}

impl ShaftMechanism {
    /// Mechanism of stated parameters; shafts bend with shear.
    ///
    /// # Errors
    /// [`LumpedError`] when data have no meaning, do not fit together, or leave nothing to move.
    pub fn new(system: &ShaftSystem) -> Result<Self, LumpedError> {
        system.check()?;
        system.check_held()?;
        let speeds = system.speeds()?;
        let mut shafts = Vec::new();
        for (number, shaft) in system.shafts.iter().enumerate() {
            shafts.push(LumpedShaft::new(shaft, BeamTheory::Timoshenko, number)?);
        }
        let mut first = vec![0];
        for shaft in &shafts {
            first.push(first[first.len() - 1] + shaft.kept.len());
        }
        let n = first[shafts.len()];
        if n == 0 {
            return Err(LumpedError::Empty { quantity: "kept coordinates" });
        }
        let diagonal = |of: &dyn Fn(usize) -> DMatrix<f64>| {
            let mut all = DMatrix::zeros(n, n);
            for (s, &at) in first[..shafts.len()].iter().enumerate() {
                let own = of(s);
                all.view_mut((at, at), own.shape()).copy_from(&own);
            }
            all
        };
        let mass = diagonal(&|s| shafts[s].mass.clone());
        let stiffness = diagonal(&|s| shafts[s].stiffness.clone());
        let supports = diagonal(&|s| shafts[s].damping.clone());
        let gyroscopic = diagonal(&|s| speeds[s] * &shafts[s].gyroscopic);
        let damping = supports + system.mass_damping * &mass + system.stiffness_damping * &stiffness;
        if Cholesky::new(mass.clone()).is_none() {
            let quantity = "mass or inertia of every kept coordinate, t or t mm^2";
            return Err(LumpedError::NotPositive { quantity, value: 0.0 });
        }
        let (load, imbalance) = loads(system, &shafts, &first, &speeds);
        let held = system.shafts.iter().any(|s| s.supports.iter().any(|b| b.stiffness[5] > 0.0));
        let mut meshes = Vec::new();
        for mesh in &system.meshes {
            meshes.push(LiveMesh::new(mesh, &shafts, &first, &speeds)?);
        }
        Ok(Self { shafts, mass, stiffness, damping, gyroscopic, load, meshes, imbalance, held })
    }

    /// Number of coordinates.
    pub fn count(&self) -> usize {
        self.load.len()
    }

    /// Shaft, station and axis (x, y, z, turns about x, y, z) of each coordinate.
    pub fn coordinates(&self) -> Vec<(usize, usize, usize)> {
        let of = |(s, shaft): (usize, &LumpedShaft)| shaft.kept.iter().map(move |&(i, axis)| (s, i, axis)).collect();
        self.shafts.iter().enumerate().flat_map(|x| -> Vec<_> { of(x) }).collect()
    }

    /// Matrices of one shaft.
    pub fn shafts(&self) -> &[LumpedShaft] {
        &self.shafts
    }

    /// Mesh frequencies, Hz.
    pub fn mesh_frequencies(&self) -> Vec<f64> {
        self.meshes.iter().map(|m| m.rate / std::f64::consts::TAU).collect()
    }

    /// Stiffness with every mesh in contact at its mean.
    pub fn mean_stiffness(&self) -> DMatrix<f64> {
        let mut k = self.stiffness.clone();
        self.meshes.iter().for_each(|m| k.ger(m.stiffness.mean, &m.lever, &m.lever, 1.0));
        k
    }

    /// Undamped modes of the shafts that turn at `share` of their speed, every mesh in contact at its mean stiffness,
    /// ascending in frequency; gyroscopic moments part the whirls. Shafts that turn freely have one at about 0. `None`
    /// only if the matrices hold no numbers.
    pub fn whirl(&self, share: f64) -> Option<Vec<Mode>> {
        let k = self.mean_stiffness();
        if share == 0.0 {
            undamped_modes(&self.mass, &k)
        } else {
            damped_modes(&self.mass, &(share * &self.gyroscopic), &k)
        }
    }

    /// Undamped natural frequencies and shapes at rest, every mesh in contact at its mean stiffness; shafts that turn
    /// freely have one at 0.
    ///
    /// # Errors
    /// [`LumpedError::Beam`] when the matrices are none.
    pub fn modes(&self) -> Result<Modes, LumpedError> {
        Ok(natural_modes(&self.mean_stiffness(), &self.mass)?)
    }
}

impl Mechanism for ShaftMechanism {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        out.conservative.gemv(-1.0, &self.stiffness, q, 0.0);
        out.other.gemv(-1.0, &self.damping, v, 0.0);
        out.dissipated = -out.other.dot(v);
        out.other.gemv(-1.0, &self.gyroscopic, v, 1.0);
        out.other += &self.load;
        out.supplied = self.load.dot(v);
        if out.tangents {
            out.stiffness += &self.stiffness;
            out.damping += &self.damping;
            out.damping += &self.gyroscopic;
        }
        for mesh in &self.meshes {
            let state = mesh.state(t, q, v);
            let ([k, k_rate], beyond) = (state.stiffness, state.beyond);
            let damped = mesh.damping * state.compression[1];
            out.conservative.axpy(-k * beyond.value, &mesh.lever, 1.0);
            out.other.axpy(-damped, &mesh.lever, 1.0);
            // The teeth's error moves as well: what the damper takes of that comes from the drive.
            out.dissipated += damped * state.compression[1];
            out.supplied += damped * state.error_rate;
            out.parametric += k_rate * beyond.potential() + k * beyond.value * state.error_rate;
            if out.tangents {
                out.stiffness.ger(k * beyond.slope, &mesh.lever, &mesh.lever, 1.0);
                out.damping.ger(mesh.damping, &mesh.lever, &mesh.lever, 1.0);
            }
        }
        Ok(())
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        let mut v = 0.5 * q.dot(&(&self.stiffness * q));
        for mesh in &self.meshes {
            let compression = mesh.lever.dot(q) + mesh.excess(t)[0];
            v += mesh.stiffness.at(mesh.rate * t) * mesh.zone.at(compression).potential();
        }
        Ok(v)
    }

    /// Contact gained or lost on either flank of each mesh.
    fn events(&self) -> usize {
        2 * self.meshes.len()
    }

    fn event_values(&mut self, t: f64, q: &DVector<f64>, _: &DVector<f64>, out: &mut [f64]) -> Result<(), Infallible> {
        for (mesh, values) in self.meshes.iter().zip(out.chunks_mut(2)) {
            let compression = mesh.lever.dot(q) + mesh.excess(t)[0];
            values[0] = compression - mesh.zone.half_width;
            values[1] = -compression - mesh.zone.half_width;
        }
        Ok(())
    }
}
