//! Coefficients of the dimensionless equations (18) of seed 004.

use super::Lumped8;

/// Coefficients of (18), by gear (p, g).
///
/// ```text
/// tau = omega_n t,   p = (x_p, y_p, z_p, r_b theta_p, x_g, y_g, z_g, R_b theta_g) / b_n,   omega_n = sqrt(K_m / m_e)
/// xi = C / (2 M omega_n),   eta = K / (M omega_n^2),   g = kappa T / (r_b b_n M omega_n^2),   kappa = M r_b^2 / J
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Equations18 {
    /// xi_x, xi_y, xi_z of the supports.
    pub support_damping: [[f64; 3]; 2],
    /// eta_x, eta_y, eta_z of the supports.
    pub support_stiffness: [[f64; 3]; 2],
    /// xi and eta of what holds the turn, with J for M.
    pub turning: [[f64; 2]; 2],
    /// xi_my, xi_mz of the mesh.
    pub mesh_damping: [[f64; 2]; 2],
    /// Mean of eta_my, eta_mz of the mesh.
    pub mesh_stiffness: [[f64; 2]; 2],
    /// kappa = M r_b^2 / J: the 2 of the printed equations is that of a disc whose radius is the base radius.
    pub kappa: [f64; 2],
    /// Mean of g_p, g_g.
    pub torque: [f64; 2],
    /// M_p / m_e, M_g / m_e.
    pub mass_ratio: [f64; 2],
    /// b_t / b_n, b_a / b_n.
    pub clearances: [f64; 2],
}

impl Equations18 {
    /// Coefficients of a model whose parameters have been checked and whose backlash is not zero.
    pub(super) fn of(model: &Lumped8) -> Self {
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
