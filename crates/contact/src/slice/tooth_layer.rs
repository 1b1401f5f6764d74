//! Tooth layer: the half of a tooth behind a flank, bounded by the tooth's centre surface.

use geometry::Flank;
use reduction::LayerProfile;

use crate::local::{EndFace, LocalBody};

/// The half tooth behind a flank.
#[derive(Debug, Clone, PartialEq)]
pub struct ToothLayer {
    flank: Flank,
    cos_base_helix: f64,
    young: f64,
    poisson: f64,
    profile: LayerProfile,
    overshoot: f64,
    edge_radius: f64,
}

impl ToothLayer {
    /// The layer behind `flank`, of a material with Young's modulus `young` (MPa) and Poisson's ratio `poisson`,
    /// clamped `overshoot` (mm) beyond the centre surface; `profile` is its layer constant. The tip edge is rounded by
    /// `edge_radius` (mm), or sharp (0).
    pub fn new(
        flank: Flank,
        young: f64,
        poisson: f64,
        overshoot: f64,
        profile: LayerProfile,
        edge_radius: f64,
    ) -> Self {
        let cos_base_helix = flank.base_helix_angle.cos();
        Self { flank, cos_base_helix, young, poisson, profile, overshoot, edge_radius }
    }

    /// Radius of the rounded tip edge, mm; 0: sharp edge.
    pub fn edge_radius(&self) -> f64 {
        self.edge_radius
    }

    /// The layer at surface coordinates (roll angle, z).
    ///
    /// ```text
    /// t = (r sin(psi) + overshoot) cos(b_b),   psi = sigma - (u - atan u),   d = r_b (u_a^2 - u^2) / 2
    /// r sin(psi) = r_b [sin(sigma - u) + u cos(sigma - u)]
    /// ```
    pub fn body(&self, [u, z]: [f64; 2]) -> LocalBody {
        let f = &self.flank;
        let (sin, cos) = (f.base_half_angle - u).sin_cos();
        let depth = (f.base_radius * (sin + u * cos) + self.overshoot) * self.cos_base_helix;
        LocalBody {
            young: self.young,
            poisson: self.poisson,
            layer: self.profile.constant(u),
            // A pointed tip has no depth.
            depth: depth.max(1e-3 * f.base_radius.abs()),
            tip_distance: (0.5 * f.base_radius * (f.roll_tip * f.roll_tip - u * u)).max(0.0),
            tip_angle: self.profile.tip_angle(),
            tip_gradient: self.profile.tip_gradient(),
            edge_radius: self.edge_radius,
            ends: [1.0, -1.0].map(|end| EndFace {
                distance: (f.half_width - end * z).max(0.0) / self.cos_base_helix,
                // The flank's outward normal has -s sin(b_b) along z: it turns away from one face and towards the
                // other.
                lean: end * f.side.sign() * f.base_helix_angle,
            }),
        }
    }
}
