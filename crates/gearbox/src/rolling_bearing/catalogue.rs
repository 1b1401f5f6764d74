//! Rolling elements estimated from catalogue data. Theory (100).

use std::f64::consts::{PI, TAU};

use super::{BallGeometry, RollerGeometry, RollerProfile, RollingBearingError, geometry::MOST_ELEMENTS};

/// Catalogue data of a bearing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Catalogue {
    /// Bore, mm.
    pub bore: f64,
    /// Outer diameter, mm.
    pub outer_diameter: f64,
    /// C_0 of the whole bearing: its basic static radial load rating, N.
    pub static_rating: f64,
    /// Number of rows that share it.
    pub rows: usize,
}

/// Filling: how rolling elements are inserted between the rings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Filling {
    /// The rings are displaced until they touch, as for deep groove bearings: balls on 190 degrees.
    Eccentric,
    /// Elements around the whole circumference, with a cage.
    Around,
}

/// Angle of the pitch circle from the first to the last ball of an eccentric filling, rad.
const FILLED: f64 = 190.0 * TAU / 360.0;
/// Pitch of elements in a cage over their diameter.
pub(super) const CAGED: f64 = 1.15;
pub(super) const CAGED_CYLINDERS: f64 = 1.25;
/// Diameter of rollers over the height from bore to outer diameter.
pub(super) const CYLINDERS: f64 = 0.55;
pub(super) const CONES: f64 = 0.47;
/// Diameter of balls over the height from bore to outer diameter: least and largest.
const BALLS: [f64; 2] = [0.15, 0.95];
const HALVINGS: usize = 100;

impl Catalogue {
    fn check(&self) -> Result<(), RollingBearingError> {
        let positive = |quantity, value: f64| {
            let wrong = RollingBearingError::OutOfRange { quantity, value, wanted: "a number above 0" };
            if value.is_finite() && value > 0.0 { Ok(()) } else { Err(wrong) }
        };
        positive("bore, mm", self.bore)?;
        positive("outer diameter over bore, mm", self.outer_diameter - self.bore)?;
        positive("static load rating, N", self.static_rating)?;
        positive("rows", self.rows as f64)
    }

    fn pitch_diameter(&self) -> f64 {
        0.5 * (self.bore + self.outer_diameter)
    }

    fn height(&self) -> f64 {
        0.5 * (self.outer_diameter - self.bore)
    }

    /// Balls that give the bearing its static load rating.
    ///
    /// ```text
    /// C_0 = i Z Q cos(alpha)/5,   Q: force of a ball at 4200 MPa on either ring,   d_pw = (d + D)/2
    /// Z = 1 + 190 deg/(2 asin(D_w/d_pw)) filled eccentrically,   Z = pi d_pw/(1.15 D_w) around
    /// ```
    /// The first equation is ISO 76, f_0 Z D_w^2 cos(alpha), by its own definition, from which the table of f_0
    /// follows.
    ///
    /// # Errors
    /// [`RollingBearingError`] if no balls give this rating.
    pub fn balls(
        &self,
        filling: Filling,
        contact_angle: f64,
        conformity: [f64; 2],
    ) -> Result<BallGeometry, RollingBearingError> {
        self.check()?;
        let pitch_diameter = self.pitch_diameter();
        let of = |diameter: f64, elements: usize| BallGeometry {
            elements,
            diameter,
            pitch_diameter,
            contact_angle,
            conformity,
        };
        let room = |d: f64| filled(filling, d, pitch_diameter);
        let rating = |d: f64, count: f64| of(d, 3).static_rating(count, self.rows);
        let ends = BALLS.map(|share| share * self.height());
        of(ends[1], 3).check()?;
        let wanted = self.static_rating;
        let [least_n, most_n] = ends.map(|d| rating(d, room(d)));
        if !(least_n..=most_n).contains(&wanted) {
            return Err(RollingBearingError::Rating { rating_n: wanted, least_n, most_n });
        }
        let rough = halve(ends, |d| rating(d, room(d)) < wanted);
        let elements = room(rough).round().clamp(3.0, MOST_ELEMENTS as f64) as usize;
        // A whole number of balls of the diameter that the rating then asks for.
        let diameter = halve([0.5 * ends[0], 2.0 * ends[1]], |d| rating(d, elements as f64) < wanted);
        let found = of(diameter, elements);
        found.check()?;
        Ok(found)
    }

    /// Rollers that give the bearing its static load rating.
    ///
    /// ```text
    /// C_0 = 44 (1 - gamma) i Z L D cos(alpha),   D = 0.55 h, Z = pi d_pw/(1.25 D) cylindrical,   0.47 h, 1.15 tapered
    /// ```
    /// h is half of outer diameter minus bore. Source of the first equation: ISO 76. The shares of h and of the pitch
    /// are those of usual series (2 and 3 of NU, 302, 320), to about 10 %.
    ///
    /// # Errors
    /// [`RollingBearingError`] if no rollers give this rating.
    pub fn rollers(&self, contact_angle: f64, profile: RollerProfile) -> Result<RollerGeometry, RollingBearingError> {
        self.check()?;
        let pitch_diameter = self.pitch_diameter();
        let (share, pitch) = if contact_angle > 0.0 { (CONES, CAGED) } else { (CYLINDERS, CAGED_CYLINDERS) };
        let diameter = share * self.height();
        let room = (PI * pitch_diameter / (pitch * diameter)).round();
        let elements = room.clamp(3.0, MOST_ELEMENTS as f64) as usize;
        let of = |length: f64| RollerGeometry { elements, diameter, length, pitch_diameter, contact_angle, profile };
        let a_mm = of(1.0).static_rating_per_length(self.rows);
        let length = self.static_rating / a_mm;
        let [least, most] = [0.3 * diameter, 8.0 * diameter];
        if !(least..=most).contains(&length) {
            let [least_n, most_n] = [least * a_mm, most * a_mm];
            return Err(RollingBearingError::Rating { rating_n: self.static_rating, least_n, most_n });
        }
        let found = of(length);
        found.check()?;
        Ok(found)
    }
}

/// Balls of a diameter that a filling lets in, not a whole number.
pub(super) fn filled(filling: Filling, diameter: f64, pitch_diameter: f64) -> f64 {
    match filling {
        Filling::Eccentric => 1.0 + FILLED / (2.0 * (diameter / pitch_diameter).asin()),
        Filling::Around => PI * pitch_diameter / (CAGED * diameter),
    }
}

/// Place between two ends at which a condition stops to hold.
fn halve([mut low, mut high]: [f64; 2], is_below: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if is_below(middle) { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}
