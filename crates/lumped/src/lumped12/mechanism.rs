//! The model as a mechanism: any integrator of the workspace runs it. Theory (49a).

use std::convert::Infallible;

use geometry::Vec3;
use integrate::{Forces, Mechanism, equilibrium};
use nalgebra::{DMatrix, DVector, SVector};

use super::{Lumped12, MeshVectors};
use crate::{
    HistoryRow, LumpedError, LumpedModel, LumpedPair, MeshClock,
    history::{MeshState, STANDING, row_of, scale},
    modes::{Mode, undamped_modes},
    terms::{add_load, add_support, slope_in_time},
};

/// The model in motion.
#[derive(Debug, Clone)]
pub struct Motion12 {
    parameters: Lumped12,
    mass: DMatrix<f64>,
    stiffness: [f64; 12],
}

/// A spring of the mesh with the damper beside it.
struct Spring {
    vector: SVector<f64, 12>,
    /// mu times the friction vector.
    rubbing: SVector<f64, 12>,
    stiffness: f64,
    damping: f64,
    error: [f64; 2],
}

impl Spring {
    /// Elastic and viscous force (or moment), and the rate of the spring's own coordinate.
    fn at(&self, q: &DVector<f64>, v: &DVector<f64>) -> [f64; 3] {
        let (stretch, rate) = (self.vector.dot(q), self.vector.dot(v));
        [self.stiffness * (stretch - self.error[0]), self.damping * (rate - self.error[1]), rate]
    }
}

impl Lumped12 {
    /// The mechanism.
    ///
    /// # Errors
    /// [`LumpedError`] for what has no meaning.
    pub fn motion(&self) -> Result<Motion12, LumpedError> {
        Motion12::new(self.clone())
    }
}

impl Motion12 {
    /// Checks the parameters and sets up mass and supports.
    ///
    /// # Errors
    /// [`LumpedError`] for what has no meaning.
    pub fn new(parameters: Lumped12) -> Result<Self, LumpedError> {
        parameters.check()?;
        let bodies = parameters.pair.bodies;
        let mass = DVector::from_iterator(
            12,
            bodies
                .iter()
                .flat_map(|b| [b.mass, b.mass, b.mass, b.transverse_inertia, b.transverse_inertia, b.polar_inertia]),
        );
        let stiffness = std::array::from_fn(|i| parameters.supports[i / 6].stiffness[i % 6]);
        Ok(Self { parameters, mass: DMatrix::from_diagonal(&mass), stiffness })
    }

    /// Parameters of the model.
    pub fn parameters(&self) -> &Lumped12 {
        &self.parameters
    }

    fn springs(&self, t: f64) -> [Spring; 2] {
        let pair = &self.parameters.pair;
        let [k, e, rate] = pair.excitation(t);
        let vectors = MeshVectors::of(pair, pair.clock.cycles(t));
        let cos = pair.frame.base_helix_angle.cos();
        let k = k / (cos * cos);
        let b = self.parameters.rayleigh[1];
        [
            Spring {
                vector: vectors.normal,
                rubbing: pair.friction * vectors.friction,
                stiffness: k,
                damping: b * k,
                error: [e * cos, rate * cos],
            },
            Spring {
                vector: vectors.tilt,
                rubbing: pair.friction * vectors.tilt_friction,
                stiffness: k * vectors.spread,
                damping: b * k * vectors.spread,
                error: [0.0; 2],
            },
        ]
    }

    fn energy(&self, t: f64, q: &DVector<f64>) -> f64 {
        let supports: f64 = self.stiffness.iter().zip(q.iter()).map(|(k, q)| 0.5 * k * q * q).sum();
        let mesh: f64 =
            self.springs(t).iter().map(|s| 0.5 * s.stiffness * (s.vector.dot(q) - s.error[0]).powi(2)).sum();
        supports + mesh
    }

    /// Stiffness matrix at `cycles` mesh cycles, N/mm, N, N mm; not symmetric with friction.
    pub fn stiffness_at(&self, cycles: f64) -> DMatrix<f64> {
        let standing = self.standing(cycles);
        let mut k = DMatrix::from_diagonal(&DVector::from_row_slice(&self.stiffness));
        for spring in standing.springs(0.0) {
            k += spring.stiffness * (spring.vector - spring.rubbing) * spring.vector.transpose();
        }
        k
    }

    /// Undamped modes at `cycles` mesh cycles, frozen there, with friction as it is in the parameters.
    ///
    /// Without friction the matrix is symmetric: all motions are bounded. With it, friction in x feeds on the
    /// deflection along the line of action: when a mode across the line of action comes close to one along it, the two
    /// merge and grow (flutter; [`Mode::flutters`]). How close is what [`Mode::growth`] and the frequencies over mu
    /// tell. `None` only if mass or stiffness hold no numbers.
    pub fn modes(&self, cycles: f64) -> Option<Vec<Mode>> {
        undamped_modes(&self.mass, &self.stiffness_at(cycles))
    }

    /// A copy of the model whose pair stands at `cycles` mesh cycles.
    fn standing(&self, cycles: f64) -> Self {
        let mut standing = self.clone();
        let clock = &mut standing.parameters.pair.clock;
        *clock = MeshClock { start: cycles, ..MeshClock::steady(clock.driver_teeth, STANDING) };
        standing
    }
}

impl Mechanism for Motion12 {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        let [a, b] = self.parameters.rayleigh;
        for i in 0..12 {
            let k = self.stiffness[i];
            add_support(out, i, [k, a * self.mass[(i, i)] + b * k], [q[i], v[i]]);
        }
        for spring in self.springs(t) {
            let [elastic, viscous, rate] = spring.at(q, v);
            let rubbed = (elastic + viscous) * spring.rubbing.dot(v);
            for i in 0..12 {
                let (along, rubbing) = (spring.vector[i], spring.rubbing[i]);
                out.conservative[i] -= elastic * along;
                out.other[i] += (elastic + viscous) * rubbing - viscous * along;
                for j in 0..12 {
                    let acting = (along - rubbing) * spring.vector[j];
                    out.stiffness[(i, j)] += spring.stiffness * acting;
                    out.damping[(i, j)] += spring.damping * acting;
                }
            }
            out.dissipated += viscous * (rate - spring.error[1]);
            out.supplied += rubbed - viscous * spring.error[1];
        }
        let sign = self.parameters.pair.frame.sign();
        for (i, torque) in [5, 11].into_iter().zip(&self.parameters.pair.torques) {
            // Both about +z in the driver's sense: the load turns the driven gear back.
            add_load(out, i, sign * torque.at(t), v[i]);
        }
        if !out.tangents {
            out.parametric = slope_in_time(|t| self.energy(t, q), t, self.parameters.pair.clock.mesh_frequency());
        }
        Ok(())
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        Ok(self.energy(t, q))
    }
}

impl LumpedModel for Motion12 {
    fn pair(&self) -> &LumpedPair {
        &self.parameters.pair
    }

    fn row(&self, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> HistoryRow {
        let pair = &self.parameters.pair;
        let mut on_both = SVector::<f64, 12>::zeros();
        let springs = self.springs(t);
        let mut forces = [0.0; 2];
        for (spring, force) in springs.iter().zip(&mut forces) {
            let [elastic, viscous, _] = spring.at(q, v);
            *force = elastic + viscous;
            on_both += *force * (spring.rubbing - spring.vector);
        }
        let part = |i: usize| Vec3::new(on_both[i], on_both[i + 1], on_both[i + 2]);
        let [r, big_r] = pair.base_radii;
        let te = pair.frame.sign() * (r * q[5] + big_r * q[11]);
        let cos = pair.frame.base_helix_angle.cos();
        let rubbed: f64 =
            springs.iter().zip(forces).map(|(s, f)| f * s.rubbing.fixed_rows::<3>(0).dot(&pair.frame.across())).sum();
        let state = MeshState {
            te,
            deflection: springs[0].vector.dot(q) / cos,
            normal_force: forces[0],
            friction_force: rubbed,
            touching: true,
            on_gears: [(part(0), part(3)), (part(6), part(9))],
        };
        row_of(pair, t, &state, q, v)
    }

    fn quasi_static(&self, cycles: f64) -> Option<DVector<f64>> {
        let scale = self.scale();
        equilibrium(&mut self.standing(cycles), 0.0, &DVector::zeros(12), &[5], &scale).unwrap_or(None)
    }

    fn scale(&self) -> DVector<f64> {
        scale(&self.parameters.pair, 0.0, 12, &[3, 4, 5, 9, 10, 11])
    }
}
