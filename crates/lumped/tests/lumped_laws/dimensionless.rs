//! Equations (16) to (19) of seed 004: time by omega_n, lengths by b_n.

use std::convert::Infallible;

use integrate::{Forces, Mechanism, State};
use lumped::{Beyond, DeadZone, lumped8::Lumped8};
use nalgebra::{DMatrix, DVector};

/// The model in dimensionless coordinates p_1 .. p_8 over tau, written row by row as (18), with its misprints put
/// right:
///
/// * eta_py p_1, eta_pz p_1 stand for p_2 and p_3;
/// * xi_gmy p_11 in the rows of p_5 and p_8 stands for its derivative;
/// * g = 2 T / (b_n M omega_n^2) lacks a radius below the line: it is a length, not a number;
/// * 2 eta, 2 xi of the turning rows hold for J = M r_b^2 / 2 alone, and 2 (2 xi) for xi then: here both are multiplied
///   by kappa;
/// * m_e, and the signs of the driven gear's turn, as in [`lumped::lumped8`].
///
/// It is an implementation of its own, not the dimensional one in other units: that both agree says that neither
/// dropped a term. It is written for `MeshLaw::Projected`, the printed law.
#[derive(Debug, Clone)]
pub struct Dimensionless {
    equations: Equations18,
    model: Lumped8,
    omega: f64,
    /// M / m_e of every row: with it the rows are forces and the mesh has a potential.
    mass: DMatrix<f64>,
}

/// Varying coefficients of (18).
struct Coefficients {
    /// K(t) / K_m.
    stiffness: f64,
    /// (e_y, e_z) / b_n and rates.
    error: [[f64; 2]; 2],
    /// L_1; L_2, L_3.
    lines: [f64; 3],
    /// g_p, g_g.
    torque: [f64; 2],
}

/// p_11 or p_12 at a state.
struct Relative {
    /// Derivatives of the relative displacement with respect to p_1 .. p_8.
    gradient: [f64; 8],
    /// f(p).
    beyond: Beyond,
    /// p', less the rate of the error.
    slip: f64,
    /// K(t) / K_m.
    stiffness: f64,
}

impl Dimensionless {
    /// Dimensionless form of a model with backlash, its unit of length, and the printed law.
    pub fn of(model: &Lumped8) -> Self {
        let equations = Equations18::of(model);
        let rows = DVector::from_fn(8, |i, _| {
            let gear = i / 4;
            equations.mass_ratio[gear] / if i % 4 == 3 { equations.kappa[gear] } else { 1.0 }
        });
        let omega = model.pair.natural_frequency();
        Self { equations, model: model.clone(), omega, mass: DMatrix::from_diagonal(&rows) }
    }

    /// omega_n, rad/s: the unit of time is its inverse.
    pub fn omega(&self) -> f64 {
        self.omega
    }

    /// Dimensionless state of a dimensional one.
    pub fn state_of(&self, state: &State) -> State {
        let units = self.units();
        let q = state.q.component_div(&units);
        State::new(state.time * self.omega, q, state.v.component_div(&units) / self.omega)
    }

    /// Coordinates (mm, rad) and velocities of a dimensionless state.
    pub fn dimensional(&self, state: &State) -> [DVector<f64>; 2] {
        let units = self.units();
        [state.q.component_mul(&units), state.v.component_mul(&units) * self.omega]
    }

    /// Unit of each coordinate: b_n, and b_n / r_b for rotations.
    fn units(&self) -> DVector<f64> {
        let length = self.model.half_backlash;
        let radii = self.model.pair.base_radii;
        DVector::from_fn(8, |i, _| if i % 4 == 3 { length / radii[i / 4] } else { length })
    }

    fn at(&self, tau: f64) -> Coefficients {
        let (pair, length) = (&self.model.pair, self.model.half_backlash);
        let t = tau / self.omega;
        let [k, e, rate] = pair.excitation(t);
        let tan = pair.frame.local_helix().tan();
        let cos = pair.frame.base_helix_angle.cos();
        let [s, s_xi, _] = if pair.friction == 0.0 {
            [0.0; 3]
        } else {
            pair.plane.at(pair.clock.cycles(t)).split.map(|x| pair.friction * x / cos)
        };
        let [r, big_r] = pair.base_radii;
        let torque = [0, 1].map(|i| {
            let mean = pair.torques[i].mean();
            // g over its mean; where that is zero the unit is taken directly.
            let unit = pair.base_radii[i] * length * pair.bodies[i].mass * self.omega * self.omega;
            if mean == 0.0 {
                self.equations.kappa[i] * pair.torques[i].at(t) / unit
            } else {
                self.equations.torque[i] * pair.torques[i].at(t) / mean
            }
        });
        Coefficients {
            stiffness: k / pair.cycle.stiffness.mean,
            error: [1.0, -tan].map(|share| [share * e / length, share * rate / (length * self.omega)]),
            lines: [s, s_xi / r, (s_xi - pair.plane.tangent_length * s) / big_r],
            torque,
        }
    }

    /// p_11 and p_12 without their errors, for coordinates or velocities.
    fn relative(&self, p: &[f64]) -> [f64; 2] {
        let along = p[1] + p[3] - (p[5] - p[7]);
        [along, p[2] - p[6] - self.model.pair.frame.local_helix().tan() * along]
    }

    /// p_11 and p_12 with all that (18) makes of them.
    fn relatives(&self, now: &Coefficients, p: &[f64], v: &[f64]) -> [Relative; 2] {
        let tan = self.model.pair.frame.local_helix().tan();
        let along = [0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 1.0];
        let axial = [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0, 0.0];
        let gradients = [along, std::array::from_fn(|i| axial[i] - tan * along[i])];
        let (x, dx) = (self.relative(p), self.relative(v));
        [0, 1].map(|k| Relative {
            gradient: gradients[k],
            beyond: DeadZone::new(self.equations.clearances[k]).at(x[k] - now.error[k][0]),
            slip: dx[k] - now.error[k][1],
            stiffness: now.stiffness,
        })
    }

    fn add_supports(&self, gear: usize, p: &[f64], v: &[f64], out: &mut Forces) {
        let eq = &self.equations;
        for axis in 0..4 {
            let i = 4 * gear + axis;
            let [xi, eta] = match axis {
                3 => eq.turning[gear],
                _ => [eq.support_damping[gear][axis], eq.support_stiffness[gear][axis]],
            };
            let mass = self.mass[(i, i)];
            add_support(out, i, [mass * eta, mass * 2.0 * xi], [p[i], v[i]]);
        }
    }

    /// eta f(p) + 2 xi p' of p_11 in the rows of y and turn, of p_12 in that of z.
    fn add_mesh(&self, gear: usize, relative: &[Relative; 2], v: &[f64], out: &mut Forces) {
        let (first, mass) = (4 * gear, self.equations.mass_ratio[gear]);
        let side = if gear == 0 { 1.0 } else { -1.0 };
        for (k, row, share) in [(0, first + 1, side), (0, first + 3, 1.0), (1, first + 2, side)] {
            let at = &relative[k];
            let [eta, xi] = self.mesh(gear, k, at);
            let (elastic, viscous) = (share * mass * eta * at.beyond.value, share * mass * 2.0 * xi * at.slip);
            if k == 0 {
                out.conservative[row] -= elastic;
                add_load(out, row, -viscous, v[row]);
            } else {
                add_load(out, row, -elastic - viscous, v[row]);
            }
            self.add_tangents(row, share * mass, [eta, xi], at, out);
        }
    }

    /// L_1, L_2, L_3 times the size of the bracket of p_11, in the rows of x and turn.
    fn add_friction(&self, gear: usize, now: &Coefficients, at: &Relative, v: &[f64], out: &mut Forces) {
        let mass = self.equations.mass_ratio[gear];
        let [eta, xi] = self.mesh(gear, 0, at);
        let bracket = mass * (eta * at.beyond.value + 2.0 * xi * at.slip);
        let rows = match gear {
            0 => [(0, now.lines[0]), (3, -now.lines[1])],
            _ => [(4, -now.lines[0]), (7, now.lines[2])],
        };
        for (row, lever) in rows {
            add_load(out, row, lever * bracket.abs(), v[row]);
            self.add_tangents(row, -lever * bracket.signum() * mass, [eta, xi], at, out);
        }
    }

    /// eta and xi of the mesh now.
    fn mesh(&self, gear: usize, k: usize, at: &Relative) -> [f64; 2] {
        [self.equations.mesh_stiffness[gear][k] * at.stiffness, self.equations.mesh_damping[gear][k]]
    }

    fn add_tangents(&self, row: usize, share: f64, [eta, xi]: [f64; 2], at: &Relative, out: &mut Forces) {
        for (j, gradient) in at.gradient.iter().enumerate() {
            out.stiffness[(row, j)] += share * eta * at.beyond.slope * gradient;
            out.damping[(row, j)] += share * 2.0 * xi * gradient;
        }
    }

    /// Elastic energy of supports and the transverse spring, in m_e b_n^2 omega_n^2.
    fn energy(&self, tau: f64, p: &[f64]) -> f64 {
        let (eq, now) = (&self.equations, self.at(tau));
        let mut sum = 0.0;
        for gear in 0..2 {
            for axis in 0..3 {
                sum += 0.5 * eq.mass_ratio[gear] * eq.support_stiffness[gear][axis] * p[4 * gear + axis].powi(2);
            }
            let inertia = eq.mass_ratio[gear] / eq.kappa[gear];
            sum += 0.5 * inertia * eq.turning[gear][1] * p[4 * gear + 3].powi(2);
        }
        let beyond = DeadZone::new(eq.clearances[0]).at(self.relative(p)[0] - now.error[0][0]);
        sum + eq.mass_ratio[0] * eq.mesh_stiffness[0][0] * now.stiffness * beyond.potential()
    }
}

impl Mechanism for Dimensionless {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, tau: f64, p: &DVector<f64>, rate: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        let (p, v) = (p.as_slice(), rate.as_slice());
        let now = self.at(tau);
        let relative = self.relatives(&now, p, v);
        for gear in 0..2 {
            self.add_supports(gear, p, v, out);
            let turn = 4 * gear + 3;
            add_load(out, turn, self.mass[(turn, turn)] * now.torque[gear], v[turn]);
            self.add_mesh(gear, &relative, v, out);
            self.add_friction(gear, &now, &relative[0], v, out);
        }
        // The mesh damper takes its force times the slip; the rest of its work goes to the error's motion.
        let taken = self.equations.mass_ratio[0] * 2.0 * self.equations.mesh_damping[0][0] * relative[0].slip.powi(2);
        out.dissipated += taken;
        out.supplied += taken;
        if !out.tangents {
            let h = 1e-6 * self.omega / self.model.pair.clock.mesh_frequency();
            out.parametric = (self.energy(tau + h, p) - self.energy(tau - h, p)) / (2.0 * h);
        }
        Ok(())
    }

    fn potential(&mut self, tau: f64, p: &DVector<f64>) -> Result<f64, Infallible> {
        Ok(self.energy(tau, p.as_slice()))
    }
}

/// A spring and a damper from coordinate `i` to the nominal motion.
fn add_support(out: &mut Forces, i: usize, [stiffness, damping]: [f64; 2], [q, v]: [f64; 2]) {
    out.conservative[i] -= stiffness * q;
    out.other[i] -= damping * v;
    out.dissipated += damping * v * v;
    out.stiffness[(i, i)] += stiffness;
    out.damping[(i, i)] += damping;
}

/// A force of drive or load on coordinate `i`.
fn add_load(out: &mut Forces, i: usize, force: f64, v: f64) {
    out.other[i] += force;
    out.supplied += force * v;
}

/// Coefficients of (18), by gear (p, g).
///
/// ```text
/// tau = omega_n t,   p = (x_p, y_p, z_p, r_b theta_p, x_g, y_g, z_g, R_b theta_g) / b_n,   omega_n = sqrt(K_m / m_e)
/// xi = C / (2 M omega_n),   eta = K / (M omega_n^2),   g = kappa T / (r_b b_n M omega_n^2),   kappa = M r_b^2 / J
/// ```
#[derive(Debug, Clone)]
struct Equations18 {
    /// xi_x, xi_y, xi_z of the supports.
    support_damping: [[f64; 3]; 2],
    /// eta_x, eta_y, eta_z of the supports.
    support_stiffness: [[f64; 3]; 2],
    /// xi and eta of what holds the turn, with J for M.
    turning: [[f64; 2]; 2],
    /// xi_my, xi_mz of the mesh.
    mesh_damping: [[f64; 2]; 2],
    /// Mean of eta_my, eta_mz of the mesh.
    mesh_stiffness: [[f64; 2]; 2],
    /// kappa = M r_b^2 / J: the 2 of the printed equations is that of a disc whose radius is the base radius.
    kappa: [f64; 2],
    /// Mean of g_p, g_g.
    torque: [f64; 2],
    /// M_p / m_e, M_g / m_e.
    mass_ratio: [f64; 2],
    /// b_t / b_n, b_a / b_n.
    clearances: [f64; 2],
}

impl Equations18 {
    fn of(model: &Lumped8) -> Self {
        let pair = &model.pair;
        let (omega, length, reduced) = (pair.natural_frequency(), model.half_backlash, pair.reduced_mass());
        let tan = pair.frame.local_helix().tan().abs();
        let k = pair.cycle.stiffness.mean;
        let by_gear = |of: &dyn Fn(usize) -> f64| [of(0), of(1)];
        let mass = by_gear(&|i| pair.bodies[i].mass);
        let inertia = by_gear(&|i| pair.bodies[i].polar_inertia);
        let kappa = by_gear(&|i| mass[i] * pair.base_radii[i].powi(2) / inertia[i]);
        let xi = |c: f64, m: f64| c / (2.0 * m * omega);
        let eta = |k: f64, m: f64| k / (m * omega * omega);
        let each = |i: usize| model.supports[i];
        let force = |i: usize| pair.base_radii[i] * length * mass[i] * omega * omega;
        Self {
            support_damping: [0, 1].map(|i| each(i).damping.map(|c| xi(c, mass[i]))),
            support_stiffness: [0, 1].map(|i| each(i).stiffness.map(|k| eta(k, mass[i]))),
            turning: [0, 1]
                .map(|i| [xi(each(i).turning_damping, inertia[i]), eta(each(i).turning_stiffness, inertia[i])]),
            mesh_damping: mass.map(|m| [model.mesh_damping, model.mesh_damping * tan].map(|c| xi(c, m))),
            mesh_stiffness: mass.map(|m| [k, k * tan].map(|k| eta(k, m))),
            kappa,
            torque: by_gear(&|i| kappa[i] * pair.torques[i].mean() / force(i)),
            mass_ratio: mass.map(|m| m / reduced),
            clearances: [pair.frame.base_helix_angle.cos(), pair.frame.base_helix_angle.sin().abs()],
        }
    }
}
