//! The model as a mechanism: any integrator of the workspace runs it.

use std::convert::Infallible;

use geometry::Vec3;
use integrate::{Forces, Mechanism, equilibrium};
use nalgebra::{DMatrix, DVector};

use super::{
    Lumped8, MeshLaw,
    mesh_law::{Spring, SpringForce},
};
use crate::{
    DeadZone, HistoryRow, LineMeans, LumpedError, LumpedModel, LumpedPair, MeshClock,
    history::{MeshState, STANDING, places, row_of, scale},
    terms::{add_load, add_support, slope_in_time},
};

/// The model in motion. Coordinates: x_p, y_p, z_p (mm), theta_p (rad), x_g, y_g, z_g, theta_g.
#[derive(Debug, Clone)]
pub struct Motion8 {
    parameters: Lumped8,
    mass: DMatrix<f64>,
    /// Diagonals of the supports.
    stiffness: [f64; 8],
    damping: [f64; 8],
}

/// Forces of the mesh at a state.
struct Mesh {
    springs: [Option<(Spring, SpringForce)>; 2],
    /// F_N, N: what friction goes by; signed.
    normal: f64,
    lines: LineMeans,
}

impl Lumped8 {
    /// The mechanism.
    ///
    /// # Errors
    /// [`LumpedError`] for what has no meaning.
    pub fn motion(&self) -> Result<Motion8, LumpedError> {
        Motion8::new(self.clone())
    }
}

impl Motion8 {
    /// Checks the parameters and sets up mass and supports.
    ///
    /// # Errors
    /// [`LumpedError`] for what has no meaning.
    pub fn new(parameters: Lumped8) -> Result<Self, LumpedError> {
        parameters.check()?;
        let diagonal = |of: &dyn Fn(usize) -> [f64; 4]| {
            let ([a, b, c, d], [e, f, g, h]) = (of(0), of(1));
            [a, b, c, d, e, f, g, h]
        };
        let mass = diagonal(&|i| {
            let body = parameters.pair.bodies[i];
            [body.mass, body.mass, body.mass, body.polar_inertia]
        });
        let stiffness = diagonal(&|i| {
            let s = parameters.supports[i];
            [s.stiffness[0], s.stiffness[1], s.stiffness[2], s.turning_stiffness]
        });
        let damping = diagonal(&|i| {
            let s = parameters.supports[i];
            [s.damping[0], s.damping[1], s.damping[2], s.turning_damping]
        });
        let mass = DMatrix::from_diagonal(&DVector::from_row_slice(&mass));
        Ok(Self { parameters, mass, stiffness, damping })
    }

    /// Parameters of the model.
    pub fn parameters(&self) -> &Lumped8 {
        &self.parameters
    }

    /// delta_y.
    fn transverse(&self) -> [f64; 8] {
        let [r, big_r] = self.parameters.pair.base_radii;
        [0.0, 1.0, 0.0, r, 0.0, -1.0, 0.0, big_r]
    }

    /// Springs of the mesh at time `t`; the first is the one whose force friction goes by.
    fn springs(&self, t: f64) -> [Option<Spring>; 2] {
        let p = &self.parameters;
        let [k, e, rate] = p.pair.excitation(t);
        let helix = p.pair.frame.local_helix();
        let (sin, cos) = helix.sin_cos();
        let transverse = self.transverse();
        let axial = [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0, 0.0];
        let mixed = |a: f64, b: f64| std::array::from_fn(|i| a * transverse[i] + b * axial[i]);
        match p.law {
            MeshLaw::Normal => {
                let jacobian = mixed(cos, -sin);
                let spring = Spring {
                    jacobian,
                    action: jacobian,
                    stiffness: k / (cos * cos),
                    damping: p.mesh_damping / (cos * cos),
                    error: [e * cos, rate * cos],
                    zone: DeadZone::new(p.half_backlash),
                };
                [Some(spring), None]
            }
            MeshLaw::Projected => {
                let tan = helix.tan();
                let along = Spring {
                    jacobian: transverse,
                    action: transverse,
                    stiffness: k,
                    damping: p.mesh_damping,
                    error: [e, rate],
                    zone: DeadZone::new(p.half_backlash * cos),
                };
                let across = Spring {
                    jacobian: mixed(-tan, 1.0),
                    action: axial,
                    stiffness: k * tan.abs(),
                    damping: p.mesh_damping * tan.abs(),
                    error: [-e * tan, -rate * tan],
                    zone: DeadZone::new(p.half_backlash * sin.abs()),
                };
                [Some(along), Some(across)]
            }
        }
    }

    fn mesh(&self, t: f64, q: &[f64], v: &[f64]) -> Mesh {
        let springs = self.springs(t).map(|s| s.map(|s| (s, s.at(q, v))));
        let normal = self.normal_share() * springs[0].map_or(0.0, |(_, f)| f.total());
        let pair = &self.parameters.pair;
        let lines = if pair.friction == 0.0 { LineMeans::default() } else { pair.plane.at(pair.clock.cycles(t)) };
        Mesh { springs, normal, lines }
    }

    /// Generalised friction force for |F_N| = 1: mu L_F across the line of action, -mu L_pT and mu L_gT about the axes.
    fn friction(&self, lines: &LineMeans) -> [f64; 8] {
        let pair = &self.parameters.pair;
        let [s, s_xi, _] = lines.split.map(|x| pair.friction * x);
        [s, 0.0, 0.0, -s_xi, -s, 0.0, 0.0, s_xi - pair.plane.tangent_length * s]
    }

    /// Friction follows |F_N|: its tangents are those of the first spring.
    fn add_friction(&self, mesh: &Mesh, v: &[f64], out: &mut Forces) {
        let shape = self.friction(&mesh.lines);
        let slope = self.normal_share() * mesh.normal.signum();
        for i in 0..8 {
            add_load(out, i, shape[i] * mesh.normal.abs(), v[i]);
            if let Some((spring, at)) = &mesh.springs[0] {
                for j in 0..8 {
                    out.stiffness[(i, j)] -= shape[i] * slope * at.slope * spring.jacobian[j];
                    out.damping[(i, j)] -= shape[i] * slope * spring.damping * spring.jacobian[j];
                }
            }
        }
    }

    /// F_N over the force of the first spring.
    fn normal_share(&self) -> f64 {
        match self.parameters.law {
            MeshLaw::Normal => 1.0,
            MeshLaw::Projected => 1.0 / self.parameters.pair.frame.base_helix_angle.cos(),
        }
    }

    /// Elastic energy.
    fn energy(&self, t: f64, q: &[f64]) -> f64 {
        let supports: f64 = self.stiffness.iter().zip(q).map(|(k, q)| 0.5 * k * q * q).sum();
        let springs = self.springs(t);
        let mesh: f64 =
            springs.iter().flatten().filter(|s| s.is_reciprocal()).map(|s| s.at(q, &[0.0; 8]).potential).sum();
        supports + mesh
    }
}

impl Mechanism for Motion8 {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        let (q, v) = (q.as_slice(), v.as_slice());
        let mesh = self.mesh(t, q, v);
        for i in 0..8 {
            add_support(out, i, [self.stiffness[i], self.damping[i]], [q[i], v[i]]);
        }
        for (spring, force) in mesh.springs.iter().flatten() {
            spring.add(force, v, out);
        }
        if self.parameters.pair.friction != 0.0 {
            self.add_friction(&mesh, v, out);
        }
        for (i, torque) in [3, 7].into_iter().zip(&self.parameters.pair.torques) {
            add_load(out, i, torque.at(t), v[i]);
        }
        if !out.tangents {
            out.parametric = slope_in_time(|t| self.energy(t, q), t, self.parameters.pair.clock.mesh_frequency());
        }
        Ok(())
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        Ok(self.energy(t, q.as_slice()))
    }

    fn events(&self) -> usize {
        if self.parameters.half_backlash > 0.0 { 2 } else { 0 }
    }

    /// Driving flanks touching, coast flanks touching: above zero.
    fn event_values(&mut self, t: f64, q: &DVector<f64>, _: &DVector<f64>, out: &mut [f64]) -> Result<(), Infallible> {
        if let [Some(spring), _] = self.springs(t) {
            let x = spring.jacobian.iter().zip(q.iter()).map(|(j, q)| j * q).sum::<f64>() - spring.error[0];
            let b = spring.zone.half_width;
            for (value, at) in out.iter_mut().zip([x - b, -x - b]) {
                *value = at;
            }
        }
        Ok(())
    }
}

impl LumpedModel for Motion8 {
    fn pair(&self) -> &LumpedPair {
        &self.parameters.pair
    }

    fn row(&self, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> HistoryRow {
        let pair = &self.parameters.pair;
        let mesh = self.mesh(t, q.as_slice(), v.as_slice());
        let lines = pair.plane.at(pair.clock.cycles(t));
        let [r, big_r] = pair.base_radii;
        let te = r * q[3] + big_r * q[7] - self.parameters.clearance();
        let friction = mesh.normal.abs() * pair.friction;
        let (across, along) = (pair.frame.across(), pair.frame.along());
        // Force of the springs on the driven gear.
        let mut pushed = Vec3::zeros();
        for (spring, force) in mesh.springs.iter().flatten() {
            pushed -= force.total() * (spring.action[5] * along + spring.action[6] * Vec3::z());
        }
        let rubbed = friction * lines.split[0] * across;
        let at = places(&pair.frame, pair.base_radii, pair.plane.tangent_length, lines.centre);
        let [s, s_xi, s_z] = lines.split.map(|x| friction * x);
        let lever = |xi: f64| (xi * along + s_z * Vec3::z()).cross(&across);
        let touching = mesh.springs[0].is_some_and(|(_, f)| f.touching);
        let state = MeshState {
            te,
            deflection: te + q[1] - q[5],
            normal_force: mesh.normal,
            friction_force: friction * lines.split[0],
            touching,
            on_gears: [
                (rubbed - pushed, at[0].cross(&-pushed) + lever(s_xi)),
                (pushed - rubbed, at[1].cross(&pushed) - lever(s_xi - pair.plane.tangent_length * s)),
            ],
        };
        row_of(pair, t, &state, q, v)
    }

    fn quasi_static(&self, cycles: f64) -> Option<DVector<f64>> {
        let mut standing = self.clone();
        let clock = &mut standing.parameters.pair.clock;
        *clock = MeshClock { start: cycles, ..MeshClock::steady(clock.driver_teeth, STANDING) };
        // Flanks just touching under the load: Newton's method does not find contact from within the clearance.
        let pair = &self.parameters.pair;
        let [_, e, _] = standing.parameters.pair.excitation(0.0);
        let k = pair.cycle.stiffness.mean;
        let mut start = DVector::zeros(8);
        start[7] = (self.parameters.clearance() + e + pair.mean_force() / k) / pair.base_radii[1];
        let scale = self.scale();
        equilibrium(&mut standing, 0.0, &start, &[3], &scale).unwrap_or(None)
    }

    fn scale(&self) -> DVector<f64> {
        scale(&self.parameters.pair, self.parameters.half_backlash, 8, &[3, 7])
    }
}
