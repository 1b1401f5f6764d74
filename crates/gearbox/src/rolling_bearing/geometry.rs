//! Internal geometry of a rolling bearing, as drawings have it.

use std::f64::consts::{FRAC_PI_2, PI};

use super::{PointContact, RollingBearingError};

/// Balls of a row and their grooves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BallGeometry {
    /// Z, in one row.
    pub elements: usize,
    /// D, mm.
    pub diameter: f64,
    /// Diameter of the circle of the balls' centres, mm.
    pub pitch_diameter: f64,
    /// Nominal contact angle, rad; 0 for deep grooves, whose angle the clearance and the load make.
    pub contact_angle: f64,
    /// Radius of the groove over D: inner ring, outer ring.
    pub conformity: [f64; 2],
}

/// Rollers of a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollerGeometry {
    /// Z, in one row.
    pub elements: usize,
    /// D (of a tapered roller in its middle), mm.
    pub diameter: f64,
    /// Length that presses, mm.
    pub length: f64,
    /// Diameter of the circle of the rollers' centres, mm.
    pub pitch_diameter: f64,
    /// Contact angle, rad; 0 for cylindrical rollers.
    pub contact_angle: f64,
    /// Relief of the rollers to their ends.
    pub profile: RollerProfile,
}

/// Relief of a roller towards its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RollerProfile {
    /// The logarithmic one of ISO/TS 16281.
    Logarithmic,
    /// None.
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
    /// Middle of the row beside that of the bearing, mm along +z.
    pub position: f64,
    /// Whether it takes a thrust of the shaft towards +z (+1) or -z (-1); without meaning at a contact angle of 0.
    pub thrust: f64,
}

/// How the rings stand against each other along the axis before any load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AxialSetting {
    /// Way of the shaft into the direction of the row's thrust until it touches, mm; below 0: pressed by as much.
    Clearance(f64),
    /// Force with which each row is pressed, N.
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

    /// A = r_i + r_o - D: distance of the centres of curvature of both grooves, mm.
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

    /// Contact with the inner and the outer ring; `None` where it is none at a point.
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
    /// C_0 of a bearing of so many rows: its basic static radial load rating after ISO 76, N; 0 of balls without a point of contact.
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

    /// Diameter of the circle of their centres, mm.
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
