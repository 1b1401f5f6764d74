//! Nominal contact stress after ISO 6336-2: Hertz pressure at the pitch point of the load spread over a mean length of
//! the contact lines. Theory (23c).

use std::f64::consts::PI;

use geometry::GearPair;
use serde::Serialize;

/// Factors of the nominal contact stress of a pair after ISO 6336-2.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct IsoFlank {
    /// Z_H, zone factor.
    pub zone: f64,
    /// Z_E, elasticity factor, sqrt(MPa).
    pub elasticity: f64,
    /// Z_eps, contact ratio factor.
    pub contact_ratio: f64,
    /// Z_beta, helix angle factor.
    pub helix: f64,
    /// Z_B and Z_D: to the inner points of single contact B of the pinion and D of the wheel, 1 for an internal wheel; `None` unless between one
    /// and two pairs mesh.
    pub single_contact: Option<[f64; 2]>,
}

impl IsoFlank {
    /// Factors of a pair whose gears have Young's moduli `young` (MPa) and Poisson's ratios `poisson`.
    ///
    /// ```text
    /// Z_H   = sqrt(2 cos beta_b cos a_wt / (cos^2 a_t sin a_wt)),   Z_E = sqrt(1 / (pi sum (1 - nu^2)/E))
    /// Z_eps = sqrt((4 - eps_alpha)/3 (1 - e) + e/eps_alpha),   e = min(eps_beta, 1),   Z_beta = 1/sqrt(cos beta)
    /// M_1   = tan a_wt / sqrt{[u_a1 - 2 pi/z_1] [u_a2 - (eps_alpha - 1) 2 pi/z_2]},   u_a = sqrt(d_a^2/d_b^2 - 1)
    /// Z_B   = max(1, M_1 - e (M_1 - 1)),   Z_D likewise with the gears exchanged, 1 for an internal wheel
    /// ```
    /// Source: ISO 6336-2:2019, clauses 6 to 9; f_ZCa of helical gears without modified flanks, which raises Z_B and
    /// Z_D for lack of experience, is left out.
    pub fn new(pair: &GearPair, young: [f64; 2], poisson: [f64; 2]) -> Self {
        let (pinion, wheel) = (&pair.pinion, &pair.wheel);
        let (a_t, a_wt) = (pinion.transverse_pressure_angle(), pair.working_pressure_angle());
        let (eps, overlap) = (pair.transverse_contact_ratio(), pair.overlap_ratio().min(1.0));
        let compliance: f64 = young.iter().zip(poisson).map(|(e, nu)| (1.0 - nu * nu) / e).sum();
        // Roll angles where the path of contact ends on either gear, and of one pitch.
        let [start, end] = pair.path_of_contact();
        let ends = [end / pinion.base_radius(), (pair.tangent_length() - start) / wheel.base_radius()];
        let pitches = [pinion.pitch_angle(), wheel.pitch_angle()];
        let single = |own: usize, other: usize| {
            let product = (ends[own] - pitches[own]) * (ends[other] - (eps - 1.0) * pitches[other]);
            let m = a_wt.tan() / product.sqrt();
            (m - overlap * (m - 1.0)).max(1.0)
        };
        Self {
            zone: (2.0 * pair.base_helix_angle().cos() * a_wt.cos() / (a_t.cos().powi(2) * a_wt.sin())).sqrt(),
            elasticity: 1.0 / (PI * compliance).sqrt(),
            contact_ratio: ((4.0 - eps) / 3.0 * (1.0 - overlap) + overlap / eps).sqrt(),
            helix: 1.0 / pinion.data().helix_angle.cos().sqrt(),
            single_contact: (1.0..2.0)
                .contains(&eps)
                .then(|| [single(0, 1), if pair.is_internal() { 1.0 } else { single(1, 0) }]),
        }
    }

    /// Nominal contact stress at the pitch point, MPa, without any of the load factors K.
    ///
    /// ```text
    /// sigma_H0 = Z_H Z_E Z_eps Z_beta sqrt(F_t / (d_1 b) (u + 1)/u)        u = z_2/z_1, negative of an internal pair
    /// ```
    /// `tangential_force` F_t = T / r on the reference circle, N.
    pub fn nominal_stress(&self, pair: &GearPair, tangential_force: f64) -> f64 {
        let u = pair.wheel.signed_teeth() / pair.pinion.signed_teeth();
        let load = tangential_force / (2.0 * pair.pinion.reference_radius() * pair.face_width()) * (u + 1.0) / u;
        self.zone * self.elasticity * self.contact_ratio * self.helix * load.sqrt()
    }
}
