//! Tooth root bending: which stress a root bears. ISO 6336-3.

use serde::Serialize;

use crate::{Edition, Material, MaterialGroup, RatingError, StressLife};

/// The root of a gear's tooth after method B, and the factors that differ between editions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RootFactors {
    /// Y_F without the load share f_eps.
    pub form: f64,
    /// f_eps, factor of the load share along the lines of contact (2019).
    pub load_share: f64,
    /// Y_S, stress correction factor.
    pub stress_correction: f64,
    /// q_s = s_Fn/(2 rho_F), notch parameter.
    pub notch: f64,
    /// Y_B, rim thickness factor.
    pub rim: f64,
    /// Y_DT, deep tooth factor.
    pub deep_tooth: f64,
}

impl RootFactors {
    /// Y_F of an edition: the one of 2019 has the load share in it.
    pub fn form_factor(&self, edition: Edition) -> f64 {
        match edition {
            Edition::Iso2006 => self.form,
            Edition::Iso2019 => self.form * self.load_share,
        }
    }
}

/// Y_beta of an edition.
///
/// ```text
/// 2006:  Y_beta = 1 - eps_beta beta/120 deg
/// 2019:  Y_beta = (1 - eps_beta beta/120 deg)/cos^3 beta
/// ```
/// eps_beta counts up to 1, beta up to 30 degrees. Source: ISO 6336-3, clause on the helix angle factor, of either edition.
pub(crate) fn helix_factor(edition: Edition, helix_angle: f64, eps_beta: f64) -> f64 {
    let beta = helix_angle.abs().min(30f64.to_radians());
    let plain = 1.0 - eps_beta.min(1.0) * beta.to_degrees() / 120.0;
    match edition {
        Edition::Iso2006 => plain,
        Edition::Iso2019 => plain / beta.cos().powi(3),
    }
}

described::described! {
    /// Factors of the bearable root stress.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct BendingFactors {
        /// Y_delta rel T, relative notch sensitivity factor at the reference number of cycles
        pub notch_sensitivity_factor: f64,
        /// Y_R rel T, relative surface factor
        pub surface_factor: f64,
        /// Y_X, size factor
        pub size_factor: f64,
        /// Y_M, mean stress factor
        pub mean_stress_factor: f64,
    }
}

/// Y_ST, stress correction factor of the reference gears.
const REFERENCE_STRESS_CORRECTION: f64 = 2.0;
/// q_s of the reference gears.
const REFERENCE_NOTCH: f64 = 2.5;
const CLAUSE: &str = "ISO 6336-3";

impl BendingFactors {
    /// Factors of a gear's root.
    ///
    /// ```text
    /// Y_delta rel T = [1 + sqrt(rho' chi)]/[1 + sqrt(rho' chi_T)],   chi = 0.2 (1 + 2 q_s),   chi_T = 1.2,   rho' by material
    /// Y_R rel T     = 1.674 - 0.529 (R_z + 1)^0.1     V, GGG (perlitic), Eh
    ///                 5.306 - 4.203 (R_z + 1)^0.01    St
    ///                 4.299 - 3.259 (R_z + 1)^0.0058  GG, GGG (ferritic), NT, NV        (below R_z = 1 um: 1.12, 1.07, 1.025)
    /// Y_X           = 1.03 - 0.006 m_n (5 .. 30)      St, V, GGG (perlitic)
    ///                 1.05 - 0.01 m_n (5 .. 25)       Eh, IF, NT, NV
    ///                 1.075 - 0.015 m_n (5 .. 25)     GG, GGG (ferritic)
    /// ```
    /// `roughness_um` R_z of the root, up to 40 um. Source: ISO 6336-3, clauses 13 (Y_delta rel T), 14 (Y_R rel T) and 15 (Y_X), method B.
    ///
    /// # Errors
    /// [`RatingError::MaterialLacks`] where the slip layer thickness rho' depends on a yield stress that the material does not state.
    pub fn new(
        material: &Material,
        notch: f64,
        roughness_um: f64,
        normal_module: f64,
        mean_stress_factor: f64,
    ) -> Result<Self, RatingError> {
        let slip = slip_layer(material)?;
        let gradient = |q: f64| 1.0 + (slip * 0.2 * (1.0 + 2.0 * q)).sqrt();
        Ok(Self {
            notch_sensitivity_factor: gradient(notch) / gradient(REFERENCE_NOTCH),
            surface_factor: surface_factor(material.group, roughness_um),
            size_factor: size_factor(material.group, normal_module),
            mean_stress_factor,
        })
    }

    /// Y_delta rel T Y_R rel T Y_X Y_M.
    pub fn product(&self) -> f64 {
        self.notch_sensitivity_factor * self.surface_factor * self.size_factor * self.mean_stress_factor
    }
}

/// rho', slip layer thickness, mm; of steels and irons that are not surface-hardened by yield stress, linear between the rows of the table. Source: ISO 6336-3, table of slip layer thicknesses.
fn slip_layer(material: &Material) -> Result<f64, RatingError> {
    let by_yield = |rows: &[[f64; 2]]| {
        let lacks = RatingError::MaterialLacks {
            material: material.name.clone(),
            key: "yield_stress_mpa",
            clause: "the slip layer thickness of ISO 6336-3",
        };
        let at = material.yield_stress_mpa.ok_or(lacks)?;
        let at = at.clamp(rows[0][0], rows[rows.len() - 1][0]);
        let line = rows.windows(2).find(|w| at <= w[1][0]).unwrap_or(&rows[rows.len() - 2..]);
        Ok(line[0][1] + (line[1][1] - line[0][1]) * (at - line[0][0]) / (line[1][0] - line[0][0]))
    };
    match material.group {
        MaterialGroup::CastIron => by_yield(&[[150.0, 0.3124], [300.0, 0.3095]]),
        MaterialGroup::Nitrided | MaterialGroup::Nitrocarburised => Ok(0.1005),
        MaterialGroup::Structural => by_yield(&[[300.0, 0.0833], [400.0, 0.0445]]),
        MaterialGroup::ThroughHardened | MaterialGroup::NodularIron => {
            by_yield(&[[500.0, 0.0281], [600.0, 0.0194], [800.0, 0.0064], [1000.0, 0.0014]])
        }
        MaterialGroup::CaseHardened | MaterialGroup::InductionHardened => Ok(0.0030),
    }
}

fn surface_factor(group: MaterialGroup, roughness_um: f64) -> f64 {
    let rz = roughness_um.min(40.0) + 1.0;
    let [smooth, a, b, exponent] = match group {
        MaterialGroup::Structural => [1.07, 5.306, 4.203, 0.01],
        MaterialGroup::CastIron | MaterialGroup::Nitrided | MaterialGroup::Nitrocarburised => {
            [1.025, 4.299, 3.259, 0.0058]
        }
        _ => [1.12, 1.674, 0.529, 0.1],
    };
    if roughness_um < 1.0 { smooth } else { a - b * rz.powf(exponent) }
}

fn size_factor(group: MaterialGroup, module: f64) -> f64 {
    match group {
        MaterialGroup::Structural | MaterialGroup::ThroughHardened | MaterialGroup::NodularIron => {
            1.03 - 0.006 * module.clamp(5.0, 30.0)
        }
        MaterialGroup::CastIron => 1.075 - 0.015 * module.clamp(5.0, 25.0),
        _ => 1.05 - 0.01 * module.clamp(5.0, 25.0),
    }
}

/// Y_M of teeth that are loaded on both flanks in turn, such as those of idlers and planets.
///
/// ```text
/// Y_M = 1/[1 - R (1 - M)/(1 + M)],   R = -1.2 f
/// M = 0.8 - 0.15 Y_S (Eh), 0.4 (Eh shot-peened, IF), 0.3 (NT, NV; St, V), 0.4 (cast steel and iron)
/// ```
/// `reversed_load_ratio` f: load on the flank that is loaded less over that of the other, 0 (one side) to 1. At endurance. Source: ISO 6336-3, annex B.
pub fn mean_stress_factor(material: &Material, stress_correction: f64, reversed_load_ratio: f64) -> f64 {
    let m = match material.group {
        MaterialGroup::CaseHardened if material.is_shot_peened => 0.4,
        MaterialGroup::CaseHardened => 0.8 - 0.15 * stress_correction,
        MaterialGroup::InductionHardened | MaterialGroup::CastIron | MaterialGroup::NodularIron => 0.4,
        _ => 0.3,
    };
    1.0 / (1.0 + 1.2 * reversed_load_ratio * (1.0 - m) / (1.0 + m))
}

/// Bearable root stress sigma_FG over load cycles.
///
/// ```text
/// sigma_FG = sigma_Flim Y_ST Y_NT Y_delta rel T Y_R rel T Y_X Y_M,   Y_ST = 2
/// ```
/// At the number of cycles of static strength Y_R rel T = Y_X = 1 and Y_delta rel T is that of the same stress gradient. `long_life` Y_NT at 1e10 cycles, 0.85 to 1. Source: ISO 6336-3, clause 12 (Y_NT).
///
/// # Errors
/// [`RatingError::OutOfRange`] where static strength would be below endurance, which no material of the standard has.
pub fn bending_curve(material: &Material, factors: &BendingFactors, long_life: f64) -> Result<StressLife, RatingError> {
    let limit = REFERENCE_STRESS_CORRECTION * material.root_limit_mpa;
    let reference = limit * factors.product();
    let (cycles, factor) = match material.group {
        MaterialGroup::Structural | MaterialGroup::ThroughHardened | MaterialGroup::NodularIron => (1e4, 2.5),
        MaterialGroup::CaseHardened | MaterialGroup::InductionHardened => (1e3, 2.5),
        MaterialGroup::CastIron | MaterialGroup::Nitrided => (1e3, 1.6),
        MaterialGroup::Nitrocarburised => (1e3, 1.1),
    };
    let at_rest = (limit * factor * factors.notch_sensitivity_factor * factors.mean_stress_factor).max(reference);
    StressLife::new(vec![[cycles, at_rest], [3e6, reference], [1e10, long_life * reference]]).ok_or(
        RatingError::OutOfRange {
            quantity: "the bearable root stress in MPa",
            value: reference,
            clause: CLAUSE,
            allowed: "a positive number",
        },
    )
}
