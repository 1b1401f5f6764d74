//! How unevenly the load lies: over the face (K_Fbeta from K_Hbeta) and over the pairs in mesh (K_Halpha, K_Falpha). ISO 6336-1, clauses 7 and 8.

/// K_Fbeta of the root from K_Hbeta of the flank.
///
/// ```text
/// K_Fbeta = K_Hbeta^N_F,   N_F = (b/h)^2 / (1 + b/h + (b/h)^2),   b/h the smaller one of both gears and at least 3
/// ```
/// `heights` tooth heights h of both gears, mm. Source: ISO 6336-1, clause 7, K_Fbeta.
pub fn face_load_factor_bending(face_load_factor: f64, face_width: f64, heights: [f64; 2]) -> f64 {
    let slender = (face_width / heights[0].max(heights[1])).max(3.0);
    let exponent = slender * slender / (1.0 + slender + slender * slender);
    face_load_factor.powf(exponent)
}

/// What the transverse load factors depend on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TransverseLoad {
    /// Transverse contact ratio.
    pub eps_alpha: f64,
    /// Total contact ratio.
    pub eps_gamma: f64,
    /// c_gamma_alpha, N/(mm um).
    pub mesh_stiffness: f64,
    /// The larger one of f_pb and f_falpha, less y_alpha, um.
    pub deviation_um: f64,
    /// F_tH/b = F_t K_A K_V K_Hbeta / b, N/mm.
    pub line_load: f64,
    /// Z_eps.
    pub contact_ratio_factor: f64,
}

/// K_Halpha and K_Falpha after method B.
///
/// ```text
/// q = c_gamma_alpha (f - y_alpha) b / F_tH
/// eps_gamma <= 2:  K = eps_gamma/2 (0.9 + 0.4 q)
/// eps_gamma > 2:   K = 0.9 + 0.4 sqrt(2 (eps_gamma - 1)/eps_gamma) q
/// 1 <= K_Halpha <= eps_gamma/(eps_alpha Z_eps^2),   1 <= K_Falpha <= eps_gamma/(0.25 eps_alpha + 0.75)
/// ```
/// f is the larger one of base pitch and profile form deviation: the form deviation takes the place of the pitch deviation where it is larger, as in DIN 3990-1. Source: ISO 6336-1:2006, formulas 73 to 76.
pub fn transverse_load_factors(load: &TransverseLoad) -> [f64; 2] {
    let q = load.mesh_stiffness * load.deviation_um / load.line_load;
    let eps = load.eps_gamma;
    let raw = if eps <= 2.0 { 0.5 * eps * (0.9 + 0.4 * q) } else { 0.9 + 0.4 * (2.0 * (eps - 1.0) / eps).sqrt() * q };
    let flank = eps / (load.eps_alpha * load.contact_ratio_factor.powi(2));
    let root = eps / (0.25 * load.eps_alpha + 0.75);
    [flank, root].map(|most| raw.min(most).max(1.0))
}
