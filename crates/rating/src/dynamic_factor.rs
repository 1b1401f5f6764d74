//! K_V: by how much vibration at tooth frequency raises the load. ISO 6336-1, clause 6, method B.

use std::f64::consts::PI;

use serde::Serialize;

/// What the dynamic factor depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DynamicLoad {
    /// Teeth of the gear that `speed_rpm` is of.
    pub teeth: u32,
    /// Speed of the gear with `teeth` teeth, 1/min.
    pub speed_rpm: f64,
    /// F_t K_A / b, N/mm.
    pub line_load: f64,
    /// Total contact ratio eps_gamma.
    pub eps_gamma: f64,
    /// c', single stiffness, N/(mm um).
    pub single_stiffness: f64,
    /// c_gamma_alpha, mesh stiffness, N/(mm um).
    pub mesh_stiffness: f64,
    /// m_red, reduced mass of both gears on the path of contact over the face width, kg/mm.
    pub reduced_mass: f64,
    /// f_pb - y_p, um.
    pub base_pitch_um: f64,
    /// f_falpha - y_f, um.
    pub profile_form_um: f64,
    /// C_a, tip relief that counts, um; `None`: flanks of tolerance class 6 and above, where it does not (B_k = 1).
    pub tip_relief_um: Option<f64>,
}

described::described! {
    /// Dynamic factor with what it follows from.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct DynamicFactor {
        /// K_V
        pub dynamic_factor: f64,
        /// N, speed over the resonance speed of the pair
        pub resonance_ratio: f64,
        /// n_E1, resonance speed of the gear whose speed was given, 1/min
        pub resonance_speed_rpm: f64,
    }
}

/// Line load below which the resonance range begins earlier, N/mm.
const LIGHT_LOAD: f64 = 100.0;

/// K_V after method B.
///
/// ```text
/// n_E1 = 30000/(pi z_1) sqrt(c_gamma_alpha/m_red),   N = n_1/n_E1
/// N_S  = 0.5 + 0.35 sqrt(w/100) below w = F_t K_A/b = 100 N/mm, else 0.85
/// B_p  = c' f_pb,eff/w,   B_f = c' f_fa,eff/w,   B_k = |1 - c' C_a/w|
/// N <= N_S:          K_V = 1 + N (C_v1 B_p + C_v2 B_f + C_v3 B_k)
/// N_S < N <= 1.15:   K_V = 1 + C_v1 B_p + C_v2 B_f + C_v4 B_k
/// N >= 1.5:          K_V = C_v5 B_p + C_v6 B_f + C_v7
/// between:           straight from N = 1.15 to 1.5
/// ```
/// C_v1 .. C_v7 by the total contact ratio. Source: ISO 6336-1:2006, formulas 6, 9, 11 to 17 and 20 to 22, table 8; the edition of 2019 has the same.
pub fn dynamic_factor(load: &DynamicLoad) -> DynamicFactor {
    let resonance = 30_000.0 / (PI * f64::from(load.teeth)) * (load.mesh_stiffness / load.reduced_mass).sqrt();
    let ratio = load.speed_rpm / resonance;
    let begins = if load.line_load < LIGHT_LOAD { 0.5 + 0.35 * (load.line_load / LIGHT_LOAD).sqrt() } else { 0.85 };
    let over_load = load.single_stiffness / load.line_load;
    let (b_p, b_f) = (over_load * load.base_pitch_um, over_load * load.profile_form_um);
    let b_k = load.tip_relief_um.map_or(1.0, |relief| (1.0 - over_load * relief).abs());
    let [c1, c2, c3, c4, c5, c6, c7] = coefficients(load.eps_gamma);
    let main = 1.0 + c1 * b_p + c2 * b_f + c4 * b_k;
    let beyond = c5 * b_p + c6 * b_f + c7;
    let dynamic_factor = match ratio {
        n if n <= begins => 1.0 + n * (c1 * b_p + c2 * b_f + c3 * b_k),
        n if n <= 1.15 => main,
        n if n < 1.5 => beyond + (main - beyond) * (1.5 - n) / 0.35,
        _ => beyond,
    };
    DynamicFactor { dynamic_factor, resonance_ratio: ratio, resonance_speed_rpm: resonance }
}

fn coefficients(eps: f64) -> [f64; 7] {
    let [c2, c3, c4, c6] = if eps <= 2.0 {
        [0.34, 0.23, 0.90, 0.47]
    } else {
        [0.57 / (eps - 0.3), 0.096 / (eps - 1.56), (0.57 - 0.05 * eps) / (eps - 1.44), 0.12 / (eps - 1.74)]
    };
    let c7 = match eps {
        e if e <= 1.5 => 0.75,
        e if e <= 2.5 => 0.125 * (PI * (e - 2.0)).sin() + 0.875,
        _ => 1.0,
    };
    [0.32, c2, c3, c4, 0.47, c6, c7]
}
