//! Depth of a modified flank with its derivatives. Theory (25).

use super::interpolation::Bicubic;
use super::relief::Ramp;
use super::{FlankModification, ProfileAxis, ProfilePlace, Topography};
use crate::GeometryError;

/// Depth at a place of a flank, normal to it, positive where material is removed.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Depth {
    /// mm.
    pub value: f64,
    /// Derivative by roll angle, mm.
    pub by_roll: f64,
    /// Derivative by height, mm/mm.
    pub by_z: f64,
}

/// A [`FlankModification`] on a gear of known size.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthField {
    /// Middle of the evaluation range of the profile, roll angle, and 1 over half of the range.
    middle: f64,
    per_roll: f64,
    /// 2/b, 1/mm.
    per_height: f64,
    profile_crowning: f64,
    profile_slope: f64,
    lead_crowning: f64,
    lead_slope: f64,
    bias: f64,
    along_profile: [Option<Ramp>; 2],
    along_lead: [Option<Ramp>; 2],
    grid: Option<Bicubic>,
    least: f64,
    band: f64,
}

/// Half of a usual band of contact over the normal module.
const BANDS_A_MODULE: f64 = 30.0;

/// Places along the profile and along the face at which the least depth is looked for.
const LEAST: [usize; 2] = [33, 17];

/// Size of the flank that a modification is put on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FlankSize {
    /// Roll angles at the root form circle and at the tip circle.
    pub roll: [f64; 2],
    /// b/2, mm.
    pub half_width: f64,
    /// r_b, mm.
    pub base_radius: f64,
    /// m_n, mm.
    pub normal_module: f64,
}

impl FlankSize {
    /// Roll angle of a place between root form circle and tip circle.
    fn roll_of(&self, name: &'static str, place: ProfilePlace) -> Result<f64, GeometryError> {
        let roll = place.roll(self.base_radius);
        // Below the base circle the roll angle is no number, and no number is below the tip.
        if roll < self.roll[1] && roll >= self.roll[0] * (1.0 - 1e-9) {
            return Ok(roll);
        }
        Err(self.off_flank(name, place))
    }

    fn off_flank(&self, name: &'static str, place: ProfilePlace) -> GeometryError {
        match place {
            ProfilePlace::Roll(value) => GeometryError::OffFlank {
                name,
                value: value.to_degrees(),
                unit: "deg of roll",
                low: self.roll[0].to_degrees(),
                high: self.roll[1].to_degrees(),
            },
            ProfilePlace::Diameter(value) => {
                let [low, high] = self.roll.map(|u| 2.0 * self.base_radius * u.hypot(1.0));
                GeometryError::OffFlank { name, value, unit: "mm of diameter", low, high }
            }
        }
    }
}

impl DepthField {
    /// # Errors
    /// [`GeometryError::OutOfRange`], [`GeometryError::OffFlank`], [`GeometryError::GridOffFlank`].
    pub(crate) fn new(m: &FlankModification, size: FlankSize) -> Result<Self, GeometryError> {
        // A millimetre of relief is no micro-geometry any more: the first-order foot point would not hold.
        let amounts = [
            ("profile crowning [mm]", m.profile_crowning),
            ("profile slope [mm]", m.profile_slope),
            ("lead crowning [mm]", m.lead_crowning),
            ("lead slope [mm]", m.lead_slope),
            ("bias [mm]", m.bias),
            ("tip relief [mm]", m.tip_relief.map_or(0.0, |r| r.amount)),
            ("root relief [mm]", m.root_relief.map_or(0.0, |r| r.amount)),
            ("end relief at z = -b/2 [mm]", m.end_relief[0].map_or(0.0, |r| r.amount)),
            ("end relief at z = +b/2 [mm]", m.end_relief[1].map_or(0.0, |r| r.amount)),
        ];
        for (name, value) in amounts {
            check_amount(name, value)?;
        }
        let [form, tip] = size.roll;
        let from = match m.evaluation_start {
            Some(place) => size.roll_of("start of the evaluation range", place)?,
            None => form,
        };
        let tip_relief = match m.tip_relief {
            None => None,
            Some(r) => {
                let start = size.roll_of("start of tip relief", r.start)?;
                Some(Ramp::new(r.amount, r.shape, start, tip - start))
            }
        };
        let root_relief = match m.root_relief {
            None => None,
            Some(r) => {
                let start = size.roll_of("start of root relief", r.start)?;
                if start <= form {
                    return Err(GeometryError::OutOfRange {
                        name: "length of root relief",
                        value: start - form,
                        expected: "above 0: it starts above the root form circle",
                    });
                }
                Some(Ramp::new(r.amount, r.shape, start, form - start))
            }
        };
        let mut along_lead = [None; 2];
        for (end, (ramp, relief)) in along_lead.iter_mut().zip(m.end_relief).enumerate() {
            let Some(r) = relief else { continue };
            if !(r.length > 0.0 && r.length <= 2.0 * size.half_width) {
                return Err(GeometryError::OutOfRange {
                    name: "length of end relief [mm]",
                    value: r.length,
                    expected: "above 0, at most the face width",
                });
            }
            let sign = if end == 0 { -1.0 } else { 1.0 };
            let start = sign * (size.half_width - r.length);
            *ramp = Some(Ramp::new(r.amount, r.shape, start, sign * r.length));
        }
        let mut field = Self {
            middle: 0.5 * (from + tip),
            per_roll: 2.0 / (tip - from),
            per_height: 1.0 / size.half_width,
            profile_crowning: m.profile_crowning,
            profile_slope: m.profile_slope,
            lead_crowning: m.lead_crowning,
            lead_slope: m.lead_slope,
            bias: m.bias,
            along_profile: [root_relief, tip_relief],
            along_lead,
            grid: m.topography.as_ref().map(|t| grid(t, size)).transpose()?,
            least: 0.0,
            band: size.normal_module / BANDS_A_MODULE,
        };
        let place = |i: usize, count: usize| i as f64 / (count - 1) as f64;
        let [along, across] = LEAST;
        let places = (0..along * across).map(|i| {
            let (p, q) = (place(i % along, along), place(i / along, across));
            field.at(form + p * (tip - form), size.half_width * (2.0 * q - 1.0)).value
        });
        field.least = places.fold(f64::INFINITY, f64::min);
        Ok(field)
    }

    /// Least depth over the flank from root form circle to tip, mm, to what lies between 33 places along the profile and
    /// 17 along the face.
    pub fn least(&self) -> f64 {
        self.least
    }

    /// Half of a usual band of contact, mm: curvatures of the depth are as it sees them, since where a relief starts with
    /// a kink there is none to be had at a point. A thirtieth of the normal module: a gear of twice the size, under the
    /// same stress, has twice the band.
    pub fn band(&self) -> f64 {
        self.band
    }

    /// Depth at roll angle `u` and height `z` (mm), with first derivatives.
    ///
    /// ```text
    /// C_alpha p^2 + C_Halpha p / 2 + C_beta q^2 + C_Hbeta q / 2 + S_alpha p q / 4 + reliefs + grid
    /// ```
    pub fn at(&self, u: f64, z: f64) -> Depth {
        let [dp, dq] = [self.per_roll, self.per_height];
        let [p, q] = [dp * (u - self.middle), dq * z];
        let mut depth = Depth {
            value: self.profile_crowning * p * p
                + 0.5 * self.profile_slope * p
                + self.lead_crowning * q * q
                + 0.5 * self.lead_slope * q
                + 0.25 * self.bias * p * q,
            by_roll: dp * (2.0 * self.profile_crowning * p + 0.5 * self.profile_slope + 0.25 * self.bias * q),
            by_z: dq * (2.0 * self.lead_crowning * q + 0.5 * self.lead_slope + 0.25 * self.bias * p),
        };
        for ramp in self.along_profile.iter().flatten() {
            let (value, slope) = ramp.at(u);
            depth.value += value;
            depth.by_roll += slope;
        }
        for ramp in self.along_lead.iter().flatten() {
            let (value, slope) = ramp.at(z);
            depth.value += value;
            depth.by_z += slope;
        }
        if let Some(grid) = &self.grid {
            let [value, by_roll, by_z] = grid.at(u, z);
            depth.value += value;
            depth.by_roll += by_roll;
            depth.by_z += by_z;
        }
        depth
    }
}

fn check_amount(name: &'static str, value: f64) -> Result<(), GeometryError> {
    if value.abs() <= 1.0 {
        return Ok(());
    }
    Err(GeometryError::OutOfRange { name, value, expected: "-1 mm to 1 mm" })
}

/// The grid over roll angle and height. It must cover at least half of the flank either way: less is a wrong unit
/// (radius for diameter, degrees for mm) rather than a measurement.
fn grid(t: &Topography, size: FlankSize) -> Result<Bicubic, GeometryError> {
    let rolls = match t.profile() {
        ProfileAxis::Roll(rolls) => rolls.clone(),
        ProfileAxis::Diameter(d) => d.iter().map(|&d| ProfilePlace::Diameter(d).roll(size.base_radius)).collect(),
    };
    if let (ProfileAxis::Diameter(d), Some(below)) = (t.profile(), rolls.iter().position(|u| u.is_nan())) {
        let value = d.get(below).copied().unwrap_or(f64::NAN);
        return Err(size.off_flank("topography", ProfilePlace::Diameter(value)));
    }
    let covers = |axis: &[f64], low: f64, high: f64| {
        let (first, last) = (axis.first().copied().unwrap_or(f64::NAN), axis.last().copied().unwrap_or(f64::NAN));
        last.min(high) - first.max(low) >= 0.5 * (high - low)
    };
    let z = t.heights();
    let fine = [
        ("along the profile", covers(&rolls, size.roll[0], size.roll[1])),
        ("across the face", covers(z, -size.half_width, size.half_width)),
    ];
    if let Some((direction, _)) = fine.iter().find(|(_, covered)| !covered) {
        return Err(GeometryError::GridOffFlank { direction });
    }
    for &value in t.depths() {
        check_amount("depth in the topography [mm]", value)?;
    }
    Ok(Bicubic::new(rolls, z.to_vec(), t.depths().to_vec()))
}
