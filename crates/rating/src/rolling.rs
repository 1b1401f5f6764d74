//! Rolling and sliding of two flanks on the path of contact.

use std::f64::consts::PI;

use crate::PairGeometry;

/// Two flanks that roll and slide on each other; lengths in mm, speeds in m/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rolling {
    /// cos of the base helix angle.
    cos_base_helix: f64,
    /// -1 for an internal pair, else 1.
    sign: f64,
    /// Speeds of pinion and wheel, rad/s.
    turning: [f64; 2],
    /// a sin(alpha_wt): distance of the points where the line of action touches the base circles; negative of an internal pair.
    line_of_action: f64,
    /// Transverse radii at the pitch point, without sign.
    pitch: [f64; 2],
}

/// A place on the path of contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingPlace {
    /// rho_n, normal radius of relative curvature, mm.
    pub relative_radius: f64,
    /// Speeds of both surfaces along the profile, m/s.
    pub speeds: [f64; 2],
}

impl RollingPlace {
    /// v_Sigma, sum of both speeds, m/s.
    pub fn rolling_speed(&self) -> f64 {
        self.speeds[0] + self.speeds[1]
    }

    /// v_g, sliding speed, m/s.
    pub fn sliding_speed(&self) -> f64 {
        (self.speeds[0] - self.speeds[1]).abs()
    }
}

impl Rolling {
    /// Flanks of a pair at a speed of the pinion, 1/min.
    pub fn new(geometry: &PairGeometry, pinion_speed_rpm: f64) -> Self {
        let turning = PI / 30.0 * pinion_speed_rpm;
        Self {
            cos_base_helix: geometry.base_helix_angle.cos(),
            sign: geometry.sign(),
            turning: [turning, turning / geometry.ratio().abs()],
            line_of_action: geometry.centre_distance * geometry.working_pressure_angle.sin(),
            pitch: geometry.pitch_radii().map(f64::abs),
        }
    }

    /// The place of two transverse radii of curvature without sign, mm.
    ///
    /// ```text
    /// rho_n = rho_1 rho_2/(rho_2 + rho_1)/cos(beta_b),   v_i = omega_i rho_i        rho_2 - rho_1 for a hollow flank 2
    /// ```
    /// `None` where a flank has no curvature, and where a hollow one is not the flatter one. Source: ISO/TS 6336-22, clause on the radius of relative curvature.
    pub fn at(&self, radii: [f64; 2]) -> Option<RollingPlace> {
        let [one, two] = radii;
        let apart = two + self.sign * one;
        (one > 0.0 && two > 0.0 && apart > 0.0).then(|| RollingPlace {
            relative_radius: one * two / apart / self.cos_base_helix,
            speeds: [1e-3 * self.turning[0] * one, 1e-3 * self.turning[1] * two],
        })
    }

    /// The place at which the pinion has a transverse radius of curvature, mm without sign, on the line of action.
    pub fn at_pinion(&self, radius: f64) -> Option<RollingPlace> {
        self.at([radius, self.sign * (self.line_of_action - radius)])
    }

    /// The place at which the wheel has a transverse radius of curvature, mm without sign, on the line of action.
    pub fn at_wheel(&self, radius: f64) -> Option<RollingPlace> {
        self.at([self.line_of_action - self.sign * radius, radius])
    }

    /// The pitch point.
    pub fn pitch(&self) -> Option<RollingPlace> {
        self.at(self.pitch)
    }
}
