//! Transverse section of one tooth: involute, fillet as cut by the tool's tip, root land.

use std::f64::consts::{FRAC_PI_2, PI};

use serde::Serialize;

use crate::rack::RackTip;
use crate::roots::bisect;
use crate::shaper::Cutter;
use crate::{GearData, GeometryError, involute};

/// Half of the transverse tooth section, from the tip down to the middle of the tooth space.
///
/// All angles are measured from the tooth's centre line; the other half is the mirror image. Radii, angles and half
/// pitch of an internal gear are negative: (r cos angle, r sin angle) is then the section of a tooth on the side of -x.
/// Source: ISO 21771. The fillet is the envelope of the rounding of the tool's tip. The rounding of a rack is a circle
/// in the normal section, hence an ellipse (stretched by 1/cos beta) in the transverse one; that of a shaper is a
/// circle in the transverse section.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TransverseProfile {
    base_radius: f64,
    reference_radius: f64,
    base_half_angle: f64,
    half_pitch: f64,
    roll_form: f64,
    roll_tip: f64,
    undercut: bool,
    tool: Tool,
    fillet_end: f64,
}

/// The tool whose tip makes the fillet.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
enum Tool {
    Rack(RackTip),
    Shaper(Cutter),
}

impl Tool {
    /// Radius (mm) and angle from the middle of the tooth space (rad) of the fillet's point that the tool's point at `theta` makes, 0 at its tip.
    fn generated(&self, theta: f64, reference_radius: f64) -> (f64, f64) {
        match self {
            Self::Rack(rack) => rack.generated(theta, reference_radius),
            Self::Shaper(cutter) => cutter.generated(theta),
        }
    }

    /// Angle (rad) of the fillet's tangent there against the middle of the tooth space.
    fn tangent(&self, theta: f64, reference_radius: f64) -> f64 {
        match self {
            Self::Rack(rack) => rack.tangent(theta, reference_radius),
            Self::Shaper(cutter) => cutter.tangent(theta),
        }
    }
}

/// Share of the base radius by which a place may lie below the base circle and count as on it: the digits of files, some
/// of which have seven.
pub(crate) const LAST_DIGITS: f64 = 1e-6;
/// Roll angle, rad, at which every tooth of an internal gear has thickness.
const FULL_TEETH: f64 = 10.0;
/// Roll angle, rad, below zero down to which a rack that reaches too deep takes away half as much of the involute; where it
/// is more their crossing is looked for.
const SLIGHT_UNDERCUT: f64 = 1e-4;

/// Roll angle at a radius of an involute, u = sqrt((r/r_b)^2 - 1), rad; 0 on the base circle and [`LAST_DIGITS`] below it,
/// `None` where there is no involute.
pub(crate) fn roll_angle(radius: f64, base_radius: f64) -> Option<f64> {
    let square = (radius / base_radius).powi(2) - 1.0;
    (square >= -2.0 * LAST_DIGITS).then(|| square.max(0.0).sqrt())
}

impl TransverseProfile {
    /// The section of a gear.
    ///
    /// # Errors
    /// [`GeometryError::Thickness`], [`GeometryError::PointedTooth`], [`GeometryError::RootRadius`].
    pub(crate) fn new(data: &GearData) -> Result<Self, GeometryError> {
        let (m, z, x) = (data.normal_module, data.signed_teeth(), data.profile_shift);
        let sign = data.sign();
        let (alpha, beta) = (data.normal_pressure_angle, data.helix_angle);
        let alpha_t = (alpha.tan() / beta.cos()).atan();
        let reference_radius = 0.5 * m * z / beta.cos();
        let base_radius = reference_radius * alpha_t.cos();
        let thickness = 0.5 * PI * m + 2.0 * x * m * alpha.tan() - data.thickness_allowance;
        if thickness <= 0.0 {
            return Err(GeometryError::Thickness { thickness_mm: thickness });
        }
        let base_half_angle = thickness / (m * z) + involute(alpha_t);
        let tip_radius = match data.tip_diameter {
            Some(d) => 0.5 * d,
            None => reference_radius + m * (data.addendum_coefficient + x),
        };
        let roll_tip = roll_angle(tip_radius, base_radius).unwrap_or(0.0);
        if tip_radius.abs() <= base_radius.abs() {
            return Err(GeometryError::OutOfRange {
                name: "tip diameter",
                value: 2.0 * tip_radius,
                expected: "above the base diameter",
            });
        }
        if sign * base_half_angle <= sign * (roll_tip - roll_tip.atan()) {
            let thick = if data.is_internal() { FULL_TEETH } else { 0.0 };
            let pointed = bisect(thick, roll_tip, |u| sign * (base_half_angle - (u - u.atan())));
            return Err(GeometryError::PointedTooth {
                tip_diameter_mm: 2.0 * tip_radius,
                pointed_diameter_mm: 2.0 * base_radius * (1.0 + pointed * pointed).sqrt(),
            });
        }
        let with = |tool: Tool, roll_form: f64, fillet_end: f64| Self {
            base_radius,
            reference_radius,
            base_half_angle,
            half_pitch: PI / z,
            roll_form,
            roll_tip,
            undercut: false,
            tool,
            fillet_end,
        };
        if let Some(shaper) = data.shaper {
            let cutter = Cutter::new(data, shaper)?;
            let (roll_form, fillet_end) = cutter.end_of_fillet()?;
            let profile = with(Tool::Shaper(cutter), roll_form, fillet_end);
            return if roll_form > roll_tip { Ok(profile) } else { Err(profile.no_involute()) };
        }
        let rho = data.root_radius_coefficient * m;
        let depth = data.dedendum_coefficient * m - rho;
        let half_rack = 0.25 * PI * m + 0.5 * data.thickness_allowance - depth * alpha.tan();
        let rack =
            RackTip { centre: [half_rack - rho / alpha.cos(), x * m - depth], radius: rho, cos_helix: beta.cos() };
        if rack.centre[0] < 0.0 {
            let largest = data.largest_root_radius_coefficient();
            return Err(GeometryError::RootRadius { coefficient: data.root_radius_coefficient, largest });
        }
        let mut profile = with(Tool::Rack(rack), 0.0, FRAC_PI_2 - alpha);
        profile.join_fillet(x * m - depth - rho * alpha.sin(), alpha_t)?;
        Ok(profile)
    }

    /// Finds where the fillet ends and the involute starts; `y_end` (mm) is the height of the last point of the
    /// rack's straight flank, whose path crosses the line of action at roll angle tan(alpha_t) + y / (r_b sin ...).
    fn join_fillet(&mut self, y_end: f64, alpha_t: f64) -> Result<(), GeometryError> {
        let roll_end = alpha_t.tan() + y_end / (self.base_radius * alpha_t.sin());
        if roll_end >= 0.0 {
            self.roll_form = roll_end;
        } else if roll_end > -SLIGHT_UNDERCUT {
            // Both curves touch here rather than cross, and the involute that is lost is half of what the rack is too deep.
            self.undercut = roll_end < -LAST_DIGITS;
            self.roll_form = -0.5 * roll_end;
        } else {
            // Undercut: the rack's tip cuts into the involute; both curves cross at one radius above the base.
            self.undercut = true;
            let excess = |theta: f64| {
                let (r, space) = self.tool.generated(theta, self.reference_radius);
                let u = roll_angle(r, self.base_radius).unwrap_or(0.0);
                (r, space - (self.half_pitch - self.half_angle(u)))
            };
            // Only what the rack cuts above the base circle counts; a slight undercut ends close to it.
            let above = bisect(0.0, self.fillet_end, |t| self.base_radius - excess(t).0);
            let samples = 4000;
            let at = |i: usize| above + (self.fillet_end - above) * i as f64 / f64::from(samples as u32);
            let crossing = (1..=samples).find(|&i| {
                let ((r0, e0), (r1, e1)) = (excess(at(i - 1)), excess(at(i)));
                r1 > r0 && e0 > 0.0 && e1 <= 0.0
            });
            let crossing = crossing.ok_or(GeometryError::OutOfRange {
                name: "dedendum with this few teeth",
                value: -y_end,
                expected: "small enough that the undercut leaves an involute",
            })?;
            let theta = bisect(at(crossing - 1), at(crossing), |t| excess(t).1);
            self.roll_form = roll_angle(excess(theta).0, self.base_radius).unwrap_or(0.0);
            self.fillet_end = theta;
        }
        if self.roll_form >= self.roll_tip {
            return Err(self.no_involute());
        }
        Ok(())
    }

    /// The fillet reaches the tip.
    fn no_involute(&self) -> GeometryError {
        GeometryError::OutOfRange {
            name: "tip diameter",
            value: 2.0 * self.radius(self.roll_tip),
            expected: "above the root form diameter",
        }
    }

    /// Radius at roll angle `u`: r = r_b sqrt(1 + u^2), mm.
    pub fn radius(&self, u: f64) -> f64 {
        self.base_radius * (1.0 + u * u).sqrt()
    }

    /// Half tooth angle at roll angle `u`: sigma - (u - atan u), rad.
    pub fn half_angle(&self, u: f64) -> f64 {
        self.base_half_angle - (u - u.atan())
    }

    /// Half tooth angle at the base circle, sigma, rad.
    pub fn base_half_angle(&self) -> f64 {
        self.base_half_angle
    }

    /// Roll angle at the root form circle, where the fillet ends.
    pub fn roll_form(&self) -> f64 {
        self.roll_form
    }

    /// Roll angle at the tip circle.
    pub fn roll_tip(&self) -> f64 {
        self.roll_tip
    }

    /// The cutter of an internal gear.
    pub(crate) fn cutter(&self) -> Option<&Cutter> {
        match &self.tool {
            Tool::Rack(_) => None,
            Tool::Shaper(cutter) => Some(cutter),
        }
    }

    /// Whether the rack's tip cuts away involute above the base circle.
    pub fn is_undercut(&self) -> bool {
        self.undercut
    }

    /// Point of the fillet: radius (mm) and angle from the tooth's centre line (rad);
    /// `t` = 0 at the root land, 1 at the root form circle.
    pub fn fillet(&self, t: f64) -> (f64, f64) {
        let (r, space) = self.tool.generated(t * self.fillet_end, self.reference_radius);
        (r, self.half_pitch - space)
    }

    /// Angle (rad) between the fillet's tangent at `t` and the tooth's centre line; it decreases from nearly pi/2 at
    /// the root land.
    pub fn fillet_tangent(&self, t: f64) -> f64 {
        self.tool.tangent(t * self.fillet_end, self.reference_radius) - self.half_pitch
    }

    /// Parameter on the fillet, 0 .. 1, at which the tangent makes `angle` (rad) with the tooth's centre line; 1 if the
    /// tangent angle is larger everywhere.
    pub fn fillet_at_tangent(&self, angle: f64) -> f64 {
        if self.fillet_tangent(1.0) >= angle { 1.0 } else { bisect(0.0, 1.0, |t| self.fillet_tangent(t) - angle) }
    }

    /// Angle between the tooth's centre line and the start of the root land, rad; the land ends at pi/z.
    pub fn root_land_start(&self) -> f64 {
        self.fillet(0.0).1
    }
}

impl GearData {
    /// Largest coefficient rho / m_n of tip rounding that fits the tool: the value at which its tip is fully rounded.
    ///
    /// For a rack:
    /// ```text
    /// rho_fP/m_n = [pi/4 + A_s/(2 m_n) - (h_fP/m_n) tan a_n] cos a_n / (1 - sin a_n)
    /// ```
    /// A_s is the thinning. The result is zero or negative where the rack ends in a point above h_fP. For a shaper it
    /// is the rounding at which both sides meet, found by bisection; 0 if the cutter cannot generate the gear.
    pub fn largest_root_radius_coefficient(&self) -> f64 {
        if let Some(shaper) = self.shaper {
            return Cutter::new(self, shaper).map_or(0.0, |cutter| cutter.largest_rounding());
        }
        let (sin, cos) = self.normal_pressure_angle.sin_cos();
        let thinning = 0.5 * self.thickness_allowance / self.normal_module;
        let tip = std::f64::consts::FRAC_PI_4 + thinning - self.dedendum_coefficient * sin / cos;
        tip * cos / (1.0 - sin)
    }
}
