//! Internal geometry of a rolling bearing, as on drawings.

use std::f64::consts::{FRAC_PI_2, PI};

use super::{PointContact, RollingBearingError};

/// Balls of a row and their grooves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BallGeometry {
    /// Number of elements Z in one row.
    pub elements: usize,
    /// Ball diameter D, mm.
    pub diameter: f64,
    /// Pitch diameter of the balls, mm.
    pub pitch_diameter: f64,
    /// Nominal contact angle, rad; 0 for deep grooves, in which clearance and load determine the angle.
    pub contact_angle: f64,
    /// Groove radius divided by D: inner ring, outer ring.
    pub conformity: [f64; 2],
}

/// Rollers of a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollerGeometry {
    /// Number of elements Z in one row.
    pub elements: usize,
    /// Roller diameter D, mm; for a tapered roller at its middle.
    pub diameter: f64,
    /// Effective length in contact, mm.
    pub length: f64,
    /// Pitch diameter of the rollers, mm.
    pub pitch_diameter: f64,
    /// Contact angle, rad; 0 for cylindrical rollers.
    pub contact_angle: f64,
    /// Relief of the rollers towards their ends.
    pub profile: RollerProfile,
}

/// Relief of a roller towards its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RollerProfile {
    /// The logarithmic profile of ISO/TS 16281.
    Logarithmic,
    /// Straight rollers without relief.
    Straight,
}

/// Rolling elements of a bearing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RollingElements {
    /// Balls.
    Balls(BallGeometry),
    /// Rollers.
    Rollers(RollerGeometry),
}

/// A row of rolling elements.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Axial position of the row relative to the middle of the bearing, mm along +z.
    pub position: f64,
    /// Direction of the shaft thrust that the row takes: +z (+1) or -z (-1); not used at a contact angle of 0.
    pub thrust: f64,
}

/// Axial setting of the rings relative to each other without load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AxialSetting {
    /// Axial distance of the shaft, in the direction of the row's thrust, until contact, mm; negative: preloaded by
    /// this distance.
    Clearance(f64),
    /// Preload force of each row, N.
    Preload(f64),
}

/// Pressure at which a ball bearing has its static load rating, MPa.
const STATIC_PRESSURE: f64 = 4200.0;
/// Rolling elements of a row at the most.
pub(super) const MOST_ELEMENTS: usize = 500;

fn within(
    quantity: &'static str,
    value: f64,
    [least, most]: [f64; 2],
    wanted: &'static str,
) -> Result<(), RollingBearingError> {
    if (least..=most).contains(&value) {
        Ok(())
    } else {
        Err(RollingBearingError::OutOfRange { quantity, value, wanted })
    }
}

/// Elements that have room on their circle.
fn room(elements: usize, diameter: f64, pitch_diameter: f64) -> Result<(), RollingBearingError> {
    within("rolling elements", elements as f64, [3.0, MOST_ELEMENTS as f64], "a whole number of 3 to 500")?;
    within("diameter of the elements, mm", diameter, [1e-3, 1e5], "0.001 to 100000")?;
    within("pitch diameter, mm", pitch_diameter, [1e-3, 1e6], "0.001 to 1000000")?;
    let half = if diameter < pitch_diameter { (diameter / pitch_diameter).asin() } else { FRAC_PI_2 };
    // Digits of a drawing are no overlap.
    if elements as f64 * half <= PI * (1.0 + 1e-6) {
        return Ok(());
    }
    Err(RollingBearingError::Crowded { elements, diameter_mm: diameter, pitch_diameter_mm: pitch_diameter })
}

impl BallGeometry {
    pub(super) fn check(&self) -> Result<(), RollingBearingError> {
        room(self.elements, self.diameter, self.pitch_diameter)?;
        within("contact angle, rad", self.contact_angle, [0.0, 1.4], "0 to 1.4 (80 degrees)")?;
        for c in self.conformity {
            within("groove radius over ball diameter", c, [0.502, 1.0], "0.502 to 1: half the ball is no groove")?;
        }
        Ok(())
    }

    /// gamma = D cos(alpha)/d_pw.
    pub fn gamma(&self) -> f64 {
        self.diameter * self.contact_angle.cos() / self.pitch_diameter
    }

    /// Distance A = r_i + r_o - D of the centres of curvature of both grooves, mm.
    pub fn groove_distance(&self) -> f64 {
        (self.conformity[0] + self.conformity[1] - 1.0) * self.diameter
    }

    /// C_0 with a number of balls that need not be whole, N.
    ///
    /// ```text
    /// C_0 = i Z Q cos(alpha)/5,   Q: force of a ball at 4200 MPa on either ring
    /// ```
    /// ISO 76, f_0 Z D_w^2 cos(alpha), by its own definition: the table of f_0 comes out of it.
    pub(super) fn static_rating(&self, count: f64, rows: usize) -> f64 {
        let force = |c: PointContact| c.force(STATIC_PRESSURE);
        let least = self.contacts().map_or(0.0, |[i, o]| force(i).min(force(o)));
        rows as f64 * count * least * self.contact_angle.cos() / 5.0
    }

    /// Contact with the inner and the outer ring; `None` if it is not a point contact.
    ///
    /// ```text
    /// across the groove: 2/D - 1/r
    /// along it: 2/D + 2 gamma/(D (1 - gamma)) inside, 2/D - 2 gamma/(D (1 + gamma)) outside
    /// ```
    pub fn contacts(&self) -> Option<[PointContact; 2]> {
        let (ball, gamma) = (2.0 / self.diameter, self.gamma());
        let race = [ball * gamma / (1.0 - gamma), -ball * gamma / (1.0 + gamma)];
        let of = |i: usize| PointContact::new([[ball, race[i]], [ball, -1.0 / (self.conformity[i] * self.diameter)]]);
        Some([of(0)?, of(1)?])
    }
}

impl RollingElements {
    /// C_0 of a bearing with a number of rows: its basic static radial load rating after ISO 76, N; 0 for balls without
    /// point contact.
    pub fn static_rating(&self, rows: usize) -> f64 {
        match self {
            Self::Balls(own) => own.static_rating(own.elements as f64, rows),
            Self::Rollers(own) => own.static_rating_per_length(rows) * own.length,
        }
    }

    /// Nominal contact angle, rad.
    pub fn contact_angle(&self) -> f64 {
        match self {
            Self::Balls(own) => own.contact_angle,
            Self::Rollers(own) => own.contact_angle,
        }
    }

    /// Pitch diameter of the rolling elements, mm.
    pub fn pitch_diameter(&self) -> f64 {
        match self {
            Self::Balls(own) => own.pitch_diameter,
            Self::Rollers(own) => own.pitch_diameter,
        }
    }
}

impl RollerGeometry {
    pub(super) fn check(&self) -> Result<(), RollingBearingError> {
        room(self.elements, self.diameter, self.pitch_diameter)?;
        within("contact angle, rad", self.contact_angle, [0.0, 1.4], "0 to 1.4 (80 degrees)")?;
        within("length of the rollers, mm", self.length, [1e-3, 1e5], "0.001 to 100000")?;
        let slender = self.length / self.diameter;
        within("length over diameter of the rollers", slender, [0.1, 50.0], "0.1 to 50")
    }

    /// C_0 over the length of the rollers, N/mm: 44 (1 - gamma) i Z D cos(alpha). Source: ISO 76.
    pub(super) fn static_rating_per_length(&self, rows: usize) -> f64 {
        44.0 * (1.0 - self.gamma()) * rows as f64 * self.elements as f64 * self.diameter * self.contact_angle.cos()
    }

    /// gamma = D cos(alpha)/d_pw.
    pub fn gamma(&self) -> f64 {
        self.diameter * self.contact_angle.cos() / self.pitch_diameter
    }
}
