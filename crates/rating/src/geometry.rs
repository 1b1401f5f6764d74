//! The numbers of a pair that ratings need.

use std::f64::consts::PI;

use crate::{RatingError, error::positive};

/// Geometry of a pair; of each array the first is the pinion's, the second the wheel's. Lengths in mm, angles in rad. Diameters of an internal
/// wheel and its centre distance are negative, as in ISO 21771.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairGeometry {
    /// Numbers of teeth z.
    pub teeth: [u32; 2],
    /// Normal module m_n.
    pub normal_module: f64,
    /// Size of the helix angle beta at the reference cylinder.
    pub helix_angle: f64,
    /// Size of the base helix angle beta_b.
    pub base_helix_angle: f64,
    /// Normal pressure angle alpha_n.
    pub normal_pressure_angle: f64,
    /// Transverse pressure angle alpha_t.
    pub transverse_pressure_angle: f64,
    /// Working transverse pressure angle alpha_wt.
    pub working_pressure_angle: f64,
    /// Centre distance a.
    pub centre_distance: f64,
    /// Common face width b.
    pub face_width: f64,
    /// Reference diameters d.
    pub reference_diameter: [f64; 2],
    /// Base diameters d_b.
    pub base_diameter: [f64; 2],
    /// Tip diameters d_a.
    pub tip_diameter: [f64; 2],
    /// Root diameters d_f.
    pub root_diameter: [f64; 2],
    /// Diameters of the bores d_i.
    pub bore_diameter: [f64; 2],
    /// Transverse radii of curvature of the pinion at the ends of the path of contact, A at the tip of the wheel and E at that of the pinion.
    pub path_of_contact: [f64; 2],
    /// Transverse contact ratio eps_alpha.
    pub eps_alpha: f64,
    /// Overlap ratio eps_beta.
    pub eps_beta: f64,
}

impl PairGeometry {
    /// This geometry where every number has a meaning.
    ///
    /// # Errors
    /// [`RatingError::OutOfRange`].
    pub fn checked(self) -> Result<Self, RatingError> {
        const CLAUSE: &str = "ISO 21771";
        for (quantity, value) in [
            ("the normal module in mm", self.normal_module),
            ("the centre distance in mm", self.sign() * self.centre_distance),
            ("the face width in mm", self.face_width),
            ("the working pressure angle in rad", self.working_pressure_angle),
            ("the transverse contact ratio", self.eps_alpha),
        ] {
            positive(quantity, value, CLAUSE)?;
        }
        for (i, sign) in [1.0, self.sign()].into_iter().enumerate() {
            positive("a number of teeth", f64::from(self.teeth[i]), CLAUSE)?;
            positive("a base diameter in mm", sign * self.base_diameter[i], CLAUSE)?;
            positive("a reference diameter in mm", sign * self.reference_diameter[i], CLAUSE)?;
            positive("a tooth height in mm", self.tooth_height(i), CLAUSE)?;
        }
        Ok(self)
    }

    /// -1 for an internal pair, else 1.
    pub fn sign(&self) -> f64 {
        1f64.copysign(self.centre_distance)
    }

    /// Gear ratio z_2/z_1, negative of an internal pair.
    pub fn ratio(&self) -> f64 {
        self.sign() * f64::from(self.teeth[1]) / f64::from(self.teeth[0])
    }

    /// Total contact ratio eps_gamma.
    pub fn eps_gamma(&self) -> f64 {
        self.eps_alpha + self.eps_beta
    }

    /// Tooth height h = (d_a - d_f)/2 of a gear, mm.
    pub fn tooth_height(&self, gear: usize) -> f64 {
        0.5 * (self.tip_diameter[gear] - self.root_diameter[gear])
    }

    /// Working pitch diameters d_w, mm; that of an internal wheel is negative.
    pub fn working_diameter(&self) -> [f64; 2] {
        let u = self.ratio();
        [2.0 * self.centre_distance / (u + 1.0), 2.0 * self.centre_distance * u / (u + 1.0)]
    }

    /// Transverse radii of curvature at the pitch point, mm: `rho_i = d_bi tan(alpha_wt)/2`, negative where the flank is hollow.
    pub fn pitch_radii(&self) -> [f64; 2] {
        self.base_diameter.map(|d| 0.5 * d * self.working_pressure_angle.tan())
    }

    /// Transverse radius of relative curvature at the pitch point, mm.
    pub fn pitch_relative_radius(&self) -> f64 {
        let [one, two] = self.pitch_radii();
        one * two / (one + two)
    }

    /// Mass of a gear on its base circle over its width, kg/mm: `m* = J/(b r_b^2)` of a disc from the bore to the mean diameter d_m = (d_a + d_f)/2, of a ring from there to its outside.
    ///
    /// ```text
    /// m* = (pi/8) rho d_m^4 |1 - (d_i/d_m)^4| / d_b^2
    /// ```
    /// `density` rho in kg/m^3. Source: ISO 6336-1, clause 6 (moments of inertia), without the approximation d_m2/d_b2 = d_m1/d_b1 of its formula 30 (2006).
    pub fn relative_mass(&self, gear: usize, density: f64) -> f64 {
        let mean = 0.5 * (self.tip_diameter[gear] + self.root_diameter[gear]);
        let hollow = (self.bore_diameter[gear] / mean).powi(4);
        1e-9 * density * PI / 8.0 * mean.powi(4) * (1.0 - hollow).abs() / self.base_diameter[gear].powi(2)
    }
}
