//! Pitting: which contact stress a flank bears. ISO 6336-2.

use serde::Serialize;

use crate::{Material, MaterialGroup, StressLife};

/// Factors of the nominal contact stress.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlankFactors {
    /// Z_H, zone factor.
    pub zone: f64,
    /// Z_E, elasticity factor, sqrt(MPa).
    pub elasticity: f64,
    /// Z_eps, contact ratio factor.
    pub contact_ratio: f64,
    /// Z_beta, helix angle factor.
    pub helix: f64,
    /// Z_B and Z_D, single pair contact factors.
    pub single_contact: [f64; 2],
}

/// What the bearable contact stress depends on beside the material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlankSurface {
    /// nu_40, kinematic viscosity of the oil at 40 C, mm^2/s.
    pub viscosity_40c: f64,
    /// v, line speed on the reference circle, m/s.
    pub speed: f64,
    /// R_z of the flanks of both gears as run in, um.
    pub roughness_um: [f64; 2],
    /// rho_red at the pitch point, transverse, mm.
    pub relative_radius: f64,
    /// Gear ratio z_2/z_1 by the gear with fewer teeth, 1 or more.
    pub ratio: f64,
}

described::described! {
    /// Factors of the bearable contact stress.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct PittingFactors {
        /// Z_L
        pub lubricant_factor: f64,
        /// Z_V
        pub velocity_factor: f64,
        /// Z_R
        pub roughness_factor: f64,
        /// Z_W
        pub work_hardening_factor: f64,
    }
}

impl PittingFactors {
    /// Z_L Z_V Z_R Z_W; Z_X is 1.
    pub fn product(&self) -> f64 {
        self.lubricant_factor * self.velocity_factor * self.roughness_factor * self.work_hardening_factor
    }
}

/// Z_L, Z_V, Z_R and Z_W of gear `gear` (0, 1), method B.
///
/// ```text
/// C_ZL = 0.83 up to sigma_Hlim = 850 MPa, sigma_Hlim/4375 + 0.6357 up to 1200 MPa, else 0.91      (the softer gear)
/// Z_L  = C_ZL + 4 (1 - C_ZL)/(1.2 + 134/nu_40)^2
/// Z_V  = C_ZV + 2 (1 - C_ZV)/sqrt(0.8 + 32/v),   C_ZV = C_ZL + 0.02
/// Z_R  = (3/R_z10)^C_ZR,   R_z10 = (R_z1 + R_z2)/2 (10/rho_red)^(1/3),   C_ZR = 0.15, 0.32 - 0.0002 sigma_Hlim, 0.08
/// ```
/// Z_W differs from 1 for a through-hardened wheel with a surface-hardened or harder pinion (`work_hardening`). Source: ISO 6336-2, clause 12 (Z_L, Z_V, Z_R, method B).
pub fn pitting_factors(surface: &FlankSurface, materials: [&Material; 2], gear: usize) -> PittingFactors {
    let softer = materials[0].contact_limit_mpa.min(materials[1].contact_limit_mpa);
    let limit = softer.clamp(850.0, 1200.0);
    let c_zl = if limit <= 850.0 {
        0.83
    } else if limit < 1200.0 {
        limit / 4375.0 + 0.6357
    } else {
        0.91
    };
    let c_zv = c_zl + 0.02;
    let mean = 0.5 * (surface.roughness_um[0] + surface.roughness_um[1]);
    let relative = mean * (10.0 / surface.relative_radius).cbrt();
    PittingFactors {
        lubricant_factor: c_zl + 4.0 * (1.0 - c_zl) / (1.2 + 134.0 / surface.viscosity_40c).powi(2),
        velocity_factor: c_zv + 2.0 * (1.0 - c_zv) / (0.8 + 32.0 / surface.speed).sqrt(),
        roughness_factor: (3.0 / relative).powf(0.32 - 2e-4 * limit),
        work_hardening_factor: work_hardening(surface, materials, gear),
    }
}

/// Z_W of gear `gear`.
///
/// ```text
/// surface-hardened against St, V:    Z_W = [1.2 - (HB - 130)/1700] (3/R_zH)^0.15,   130 <= HB <= 470 of the soft gear, [..] 1.2 below, 1 above
///     R_zH = R_z1 (10/rho_red)^0.33 (R_z1/R_z2)^0.66 / (v nu_40/1500)^0.33     (3 .. 16 um; 1: the hard gear)
/// V against V:                       Z_W = 1 + (0.00898 HB_1/HB_2 - 0.00829) (u - 1),   1.2 <= HB_1/HB_2 <= 1.7, u <= 20
/// ```
/// Z_W is a factor of the soft gear alone. Source: ISO 6336-2, clause 13. HB is taken as HV/1.05.
fn work_hardening(surface: &FlankSurface, materials: [&Material; 2], gear: usize) -> f64 {
    let soft = |m: &Material| matches!(m.group, MaterialGroup::Structural | MaterialGroup::ThroughHardened);
    let (own, other) = (materials[gear], materials[1 - gear]);
    let brinell = |m: &Material| m.surface_hardness_hv / 1.05;
    if !soft(own) {
        return 1.0;
    }
    if other.group.is_surface_hardened() {
        let [hard_um, soft_um] = [surface.roughness_um[1 - gear], surface.roughness_um[gear]];
        let film = (surface.speed * surface.viscosity_40c / 1500.0).powf(0.33);
        let relative = hard_um * (10.0 / surface.relative_radius).powf(0.33) * (hard_um / soft_um).powf(0.66) / film;
        let by_hardness = 1.2 - (brinell(own).clamp(130.0, 470.0) - 130.0) / 1700.0;
        return by_hardness * (3.0 / relative.clamp(3.0, 16.0)).powf(0.15);
    }
    let harder = brinell(other) / brinell(own);
    if !soft(other) || harder < 1.2 {
        return 1.0;
    }
    let slope = 0.00898 * harder.min(1.7) - 0.00829;
    1.0 + slope * (surface.ratio.min(20.0) - 1.0)
}

/// Bearable contact stress sigma_HG over load cycles.
///
/// ```text
/// sigma_HG = sigma_Hlim Z_NT Z_L Z_V Z_R Z_W Z_X
/// ```
/// At the number of cycles of static strength Z_L = Z_V = Z_R = 1; between it and the reference number the line is straight in logarithms. `limited_pitting`: some pits are allowed, which moves the lines of steels to longer lives. `long_life` Z_NT at 1e10 cycles, 0.85 to 1. Source: ISO 6336-2, table 2 and clause 11 (Z_NT).
pub fn pitting_curve(
    material: &Material,
    factors: &PittingFactors,
    limited_pitting: bool,
    long_life: f64,
) -> Option<StressLife> {
    let reference = material.contact_limit_mpa * factors.product();
    let fixed = material.contact_limit_mpa * factors.work_hardening_factor;
    let (static_cycles, static_factor, middle, reference_cycles) = match material.group {
        MaterialGroup::CastIron | MaterialGroup::Nitrided => (1e5, 1.3, None, 2e6),
        MaterialGroup::Nitrocarburised => (1e5, 1.1, None, 2e6),
        _ if limited_pitting => (6e5, 1.6, Some([1e7, 1.3 * reference]), 1e9),
        _ => (1e5, 1.6, None, 5e7),
    };
    let static_stress = (static_factor * fixed).max(reference);
    let start = [static_cycles, middle.map_or(static_stress, |[_, stress]| static_stress.max(stress))];
    let points =
        std::iter::once(start).chain(middle).chain([[reference_cycles, reference], [1e10, long_life * reference]]);
    StressLife::new(points.collect())
}
