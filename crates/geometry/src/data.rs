//! What the user says of one gear.

use serde::Serialize;

/// Data of one external cylindrical gear, in ISO 21771 terms.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GearData {
    /// Number of teeth z.
    pub teeth: u32,
    /// Normal module m_n, mm.
    pub normal_module: f64,
    /// Normal pressure angle alpha_n, rad.
    pub normal_pressure_angle: f64,
    /// Helix angle beta at the reference cylinder, rad; right hand positive.
    pub helix_angle: f64,
    /// Face width b, mm.
    pub face_width: f64,
    /// Profile shift coefficient x.
    pub profile_shift: f64,
    /// Normal tooth thinning at the reference cylinder, mm.
    pub thickness_allowance: f64,
    /// Addendum coefficient h_a / m_n.
    pub addendum_coefficient: f64,
    /// Dedendum coefficient h_f / m_n.
    pub dedendum_coefficient: f64,
    /// Tip radius of the generating rack rho_fP / m_n, a circle in the normal section.
    pub root_radius_coefficient: f64,
    /// Tip diameter, mm; without it d + 2 m_n (h_a + x).
    pub tip_diameter: Option<f64>,
    /// Radius of the arc that rounds the tip edges, mm; 0: sharp.
    pub tip_edge_radius: f64,
    /// Bore diameter, mm.
    pub bore_diameter: f64,
}

impl Default for GearData {
    /// The pinion of the default pair: z 30, m_n 3 mm, 20 deg, beta 20 deg right hand, b 20 mm, bore 60 mm.
    fn default() -> Self {
        Self {
            teeth: 30,
            normal_module: 3.0,
            normal_pressure_angle: 20f64.to_radians(),
            helix_angle: 20f64.to_radians(),
            face_width: 20.0,
            profile_shift: 0.0,
            thickness_allowance: 0.05,
            addendum_coefficient: 1.0,
            dedendum_coefficient: 1.25,
            root_radius_coefficient: 0.38,
            tip_diameter: None,
            tip_edge_radius: 0.0,
            bore_diameter: 60.0,
        }
    }
}

impl GearData {
    /// Largest coefficient rho_fP / m_n that the rack has room for: a full rounding of its tip.
    ///
    /// ```text
    /// rho_fP/m_n = [pi/4 + A_s/(2 m_n) - (h_fP/m_n) tan a_n] cos a_n / (1 - sin a_n)
    /// ```
    /// A_s is the thinning. Zero or below where the rack ends in a point above h_fP.
    pub fn largest_root_radius_coefficient(&self) -> f64 {
        let (sin, cos) = self.normal_pressure_angle.sin_cos();
        let thinning = 0.5 * self.thickness_allowance / self.normal_module;
        let tip = std::f64::consts::FRAC_PI_4 + thinning - self.dedendum_coefficient * sin / cos;
        tip * cos / (1.0 - sin)
    }
}
