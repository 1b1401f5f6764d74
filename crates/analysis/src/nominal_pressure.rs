//! Nominal flank pressure: Hertz at the inner points of single contact and at the pitch point, and according to ISO
//! 6336-2.

use contact::line::hertz;
use geometry::{GearPair, Side};
use lumped::iso::IsoFlank;
use serde::Serialize;

use crate::loaded_pair::LoadedPair;

/// Where the numbers come from; said wherever they are handed on.
const METHOD: &str = "Hertz pressure of nominal involutes under the torque of the scene, spread evenly over the contact lines of the position \
     in which one of them passes the point at mid-face; ISO 6336-2:2019 without load factors K and f_ZCa";

described::described! {
    /// Nominal pressures of a pair; units are in the names.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct NominalPressure {
        /// source of the numbers
        pub method: &'static str,
        /// F_bn, normal force of the mesh
        pub normal_force_n: f64,
        /// F_t, force on the reference circle
        pub tangential_force_n: f64,
        /// sigma_H0 of ISO 6336-2:2019 at the pitch point, without load factors ([theory](theory.md), equation 23c)
        pub iso_contact_stress_mpa: f64,
        /// Z_H
        pub zone_factor: f64,
        /// Z_E, in sqrt(MPa)
        pub elasticity_factor: f64,
        /// Z_eps
        pub contact_ratio_factor: f64,
        /// Z_beta
        pub helix_angle_factor: f64,
        /// Z_B and Z_D, to the inner points of single contact, without f_ZCa; `null` unless between one and two pairs mesh
        pub single_contact_factors: Option<[f64; 2]>,
        /// Hertz pressure at the points B, C and D; C alone unless between one and two pairs mesh
        pub hertz: Vec<PointPressure>,
    }
}

described::described! {
    /// Hertz pressure at a point of the path of contact.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct PointPressure {
        /// `B`, `C` or `D`
        pub name: char,
        /// analytic length of all contact lines while one of them passes the point at mid-face; of a spur pair the face width
        pub line_length_mm: f64,
        /// relative radius of curvature in the normal section
        pub relative_radius_mm: f64,
        /// Hertz pressure of nominal involutes, the load spread evenly over the contact lines
        pub pressure_mpa: f64,
    }
}

/// Nominal pressure of a pair under its torque.
///
/// ```text
/// p = sqrt(F_bn E* / (pi L rho_n)),   rho_n = xi (T - xi) / (T cos b_b),   F_bn = T_driven / (r_b cos b_b)
/// ```
/// L is the total length of the analytic contact lines when one of them passes xi at mid-face: of a spur pair at B and
/// D the face width, for one pair of teeth carries all on the inner side of these points.
pub(crate) fn nominal_pressure(loaded: &LoadedPair<'_>) -> NominalPressure {
    let (pair, force, tangential) = (loaded.pair, loaded.base_force(), loaded.tangential_force());
    let normal = force / pair.base_helix_angle().cos();
    let iso = IsoFlank::new(pair, loaded.young(), loaded.poisson());
    let modulus = loaded.effective_modulus();
    let hertz = points(pair)
        .map(|(name, xi)| {
            let line_length_mm = length_at(pair, xi);
            let whole = pair.tangent_length();
            let relative_radius_mm = xi * (whole - xi) / (whole * pair.base_helix_angle().cos());
            let pressure_mpa = hertz::line_pressure(normal / line_length_mm, relative_radius_mm, modulus);
            PointPressure { name, line_length_mm, relative_radius_mm, pressure_mpa }
        })
        .collect();
    NominalPressure {
        method: METHOD,
        normal_force_n: normal,
        tangential_force_n: tangential,
        iso_contact_stress_mpa: iso.nominal_stress(pair, tangential),
        zone_factor: iso.zone,
        elasticity_factor: iso.elasticity,
        contact_ratio_factor: iso.contact_ratio,
        helix_angle_factor: iso.helix,
        single_contact_factors: iso.single_contact,
        hertz,
    }
}

/// Points with their path coordinates, mm; B and D a little to the inner side, where one pair of a spur gear carries
/// all.
fn points(pair: &GearPair) -> impl Iterator<Item = (char, f64)> {
    let ([start, end], pitch) = (pair.path_of_contact(), pair.transverse_base_pitch());
    let one_pair = (1.0..2.0).contains(&pair.transverse_contact_ratio());
    let little = 1e-9 * pitch;
    let pitch_point = pair.pinion.base_radius() * pair.working_pressure_angle().tan();
    let single = |xi: f64| one_pair.then_some(xi);
    [('B', single(end - pitch + little)), ('C', Some(pitch_point)), ('D', single(start + pitch - little))]
        .into_iter()
        .filter_map(|(name, xi)| Some((name, xi?)))
}

/// Total length of the contact lines when that of a pair passes `xi` in the middle of the common face, mm.
fn length_at(pair: &GearPair, xi: f64) -> f64 {
    let side = Side::Left;
    let angle =
        (xi - pair.path_coordinate(side, 0.0, 0, pair.common_middle()[0])) / (side.sign() * pair.pinion.base_radius());
    pair.contact_line_length(side, angle)
}
