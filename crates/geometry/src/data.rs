//! What the user says of one gear.

use serde::Serialize;

/// Shaper cutter that makes the teeth of an internal gear.
///
/// The cutter's teeth have the ring's module, pressure angle and helix, are thicker than the profile shift says by the ring's thickness allowance, and are as high as the ring's root diameter asks. The rounding of its tip edges, of radius `root_radius_coefficient` m_n of the ring, is a circle in the transverse section.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Shaper {
    /// Number of teeth z_0.
    pub teeth: u32,
    /// Profile shift coefficient x_0.
    pub profile_shift: f64,
}

/// Data of one cylindrical gear, in ISO 21771 terms: diameters of an internal gear are negative.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GearData {
    /// Number of teeth, without the sign that an internal gear has.
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
    /// Tip diameter, mm; without it d + 2 m_n (h_a + x). Negative for an internal gear.
    pub tip_diameter: Option<f64>,
    /// Radius of the arc that rounds the tip edges, mm; 0: sharp.
    pub tip_edge_radius: f64,
    /// Diameter of the cylinder that holds the gear, mm: the bore; of an internal gear its outside, negative.
    pub bore_diameter: f64,
    /// The tool of an internal gear; `None`: an external gear, made by a rack.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shaper: Option<Shaper>,
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
            shaper: None,
        }
    }
}

impl GearData {
    /// Whether the teeth point inwards.
    pub fn is_internal(&self) -> bool {
        self.shaper.is_some()
    }

    /// +1 of an external gear, -1 of an internal one: the sign of z and of all diameters.
    pub fn sign(&self) -> f64 {
        if self.is_internal() { -1.0 } else { 1.0 }
    }

    /// Number of teeth z after ISO 21771, negative of an internal gear.
    pub fn signed_teeth(&self) -> f64 {
        self.sign() * f64::from(self.teeth)
    }
}
