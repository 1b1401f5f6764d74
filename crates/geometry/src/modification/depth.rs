//! Depth of a modified flank with its derivatives. Theory (25).

use std::sync::Arc;

use super::flank_size::FlankSize;
use super::interpolation::Bicubic;
use super::relief::Ramp;
use super::split::{Split, Splits};
use super::{FlankModification, ProfileAxis, ProfilePlace, TopographyGrid};
use crate::GeometryError;

/// Depth at a point of a flank, normal to the flank, positive where material is removed.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Depth {
    /// Depth, mm.
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
    splits: Splits,
    size: FlankSize,
    least: f64,
    /// Least of what is the same at all heights.
    least_of_profile: f64,
}

/// Places along the profile and along the face at which the least depth is looked for.
const LEAST: [usize; 2] = [33, 17];

impl DepthField {
    /// # Errors
    /// [`GeometryError::OutOfRange`], [`GeometryError::OffFlank`], [`GeometryError::GridOffFlank`].
    pub(crate) fn new(
        m: &FlankModification,
        topography: Option<&TopographyGrid>,
        size: FlankSize,
    ) -> Result<Self, GeometryError> {
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
                if (start - form) * (tip - form) <= 0.0 {
                    return Err(GeometryError::OutOfRange {
                        name: "length of root relief",
                        value: (start - form) * (tip - form).signum(),
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
            grid: topography.map(|t| grid(t, size)).transpose()?,
            splits: Splits::default(),
            size,
            least: 0.0,
            least_of_profile: 0.0,
        };
        field.least_of_profile = field.rolls().map(|u| field.of_profile(u)).fold(f64::INFINITY, f64::min);
        field.least = field.least_of(|u, z| field.at(u, z));
        Ok(field)
    }

    /// What grows from the first of three fields to the last, over `step`; `None` where they do not differ in amounts alone.
    pub(super) fn rate([less, here, more]: [&Self; 3], step: f64) -> Option<Self> {
        let alike = |a: &Self, b: &Self| {
            let [a_axes, b_axes] = [a, b].map(|f| [f.middle, f.per_roll, f.per_height]);
            a_axes == b_axes && a.size == b.size && a.grid == b.grid
        };
        let ramps = |of: fn(&Self) -> &[Option<Ramp>; 2]| {
            let one = |i: usize| {
                // The one in the middle starts where the others do.
                Ramp::rate([of(less)[i], of(here)[i]], step)?;
                Ramp::rate([of(less)[i], of(more)[i]], step)
            };
            Some([one(0)?, one(1)?])
        };
        let by = |of: fn(&Self) -> f64| (of(more) - of(less)) / step;
        let linear = alike(less, here) && alike(here, more);
        Some(Self {
            profile_crowning: by(|f| f.profile_crowning),
            profile_slope: by(|f| f.profile_slope),
            lead_crowning: by(|f| f.lead_crowning),
            lead_slope: by(|f| f.lead_slope),
            bias: by(|f| f.bias),
            along_profile: ramps(|f| &f.along_profile)?,
            along_lead: ramps(|f| &f.along_lead)?,
            grid: None,
            splits: Splits::default(),
            least: 0.0,
            least_of_profile: 0.0,
            ..*less
        })
        .filter(|_| linear)
    }

    /// Roll angles at which the least depth is looked for.
    fn rolls(&self) -> impl Iterator<Item = f64> {
        let ([form, tip], [along, _]) = (self.size.roll, LEAST);
        (0..along).map(move |i| form + i as f64 / (along - 1) as f64 * (tip - form))
    }

    /// The least value over the flank.
    fn least_of(&self, depth: impl Fn(f64, f64) -> Depth) -> f64 {
        let [_, across] = LEAST;
        let heights = (0..across).map(|i| self.size.half_width * (2.0 * (i as f64 / (across - 1) as f64) - 1.0));
        let depth = &depth;
        let all = heights.flat_map(|z| self.rolls().map(move |u| depth(u, z).value));
        all.fold(f64::INFINITY, f64::min)
    }

    /// Smooth part of the depth and the deviation of the measured flank from it, averaged over slices of axial length
    /// `slice` (mm; 0: points). `None` if the flank was not measured; then the whole depth is smooth.
    pub fn split(field: &Arc<Self>, slice: f64) -> Option<SplitDepth> {
        let grid = field.grid.as_ref()?;
        let split = field.splits.of(grid, &field.size, slice);
        let mut own = SplitDepth { field: Arc::clone(field), split, least: 0.0 };
        own.least = field.least_of(|u, z| own.smooth(u, z));
        Some(own)
    }

    /// Least depth over the flank from root form circle to tip, mm, sampled at 33 points along the profile and 17 along
    /// the face.
    pub fn least(&self) -> f64 {
        self.least
    }

    /// Roll angles at which profiles have kinks.
    pub(crate) fn kinks(&self) -> [Option<f64>; 2] {
        self.along_profile.map(|ramp| ramp.and_then(|ramp| ramp.kink()))
    }

    /// Least depth at a height (mm), mm; not below [`DepthField::least`] if the flank was not measured.
    pub fn least_at(&self, z: f64) -> f64 {
        if self.grid.is_some() {
            return self.least;
        }
        let q = self.per_height * z;
        let twisted = self.size.roll.map(|u| (self.per_roll * (u - self.middle)).abs()).into_iter().fold(0.0, f64::max);
        let along_lead: f64 = self.along_lead.iter().flatten().map(|ramp| ramp.at(z).0).sum();
        self.least_of_profile + self.lead_crowning * q * q + 0.5 * self.lead_slope * q + along_lead
            - (0.25 * self.bias * q).abs() * twisted
    }

    /// What of the depth is the same at all heights, mm.
    fn of_profile(&self, u: f64) -> f64 {
        let reliefs: f64 = self.along_profile.iter().flatten().map(|ramp| ramp.at(u).0).sum();
        let p = self.per_roll * (u - self.middle);
        self.profile_crowning * p * p + 0.5 * self.profile_slope * p + reliefs
    }

    /// Half of a typical contact band, mm. Curvatures of the depth are averaged over it, because no curvature exists at
    /// the kink where a linear relief starts. It is a thirtieth of the normal module: under the same stress, a gear of
    /// twice the size has a band of twice the width.
    pub fn band(&self) -> f64 {
        self.size.band()
    }

    /// Depth at roll angle `u` and height `z` (mm), with first derivatives.
    ///
    /// ```text
    /// C_alpha p^2 + C_Halpha p / 2 + C_beta q^2 + C_Hbeta q / 2 + S_alpha p q / 4 + reliefs + grid
    /// ```
    pub fn at(&self, u: f64, z: f64) -> Depth {
        self.with(self.grid.as_ref().map(|grid| grid.at(u, z)), u, z)
    }

    /// Depths at places, their roll angles and heights (mm), mm: the values of [`DepthField::at`], bit by bit.
    pub(crate) fn at_places(&self, places: [&[f64]; 2], depths: &mut [f64]) {
        self.with_at_places(self.grid.as_ref().map(|grid| |u: f64, z: f64| grid.at(u, z)[0]), places, depths);
    }

    /// The stated modifications at places, and what of the grid is given.
    fn with_at_places(
        &self,
        grid: Option<impl Fn(f64, f64) -> f64>,
        [rolls, heights]: [&[f64]; 2],
        depths: &mut [f64],
    ) {
        for ((depth, &u), &z) in depths.iter_mut().zip(rolls).zip(heights) {
            let [p, q] = [self.per_roll * (u - self.middle), self.per_height * z];
            *depth = self.formula(p, q);
        }
        for ramp in self.along_profile.iter().flatten() {
            ramp.add_to(depths, rolls);
        }
        for ramp in self.along_lead.iter().flatten() {
            ramp.add_to(depths, heights);
        }
        if let Some(grid) = grid {
            depths.iter_mut().zip(rolls).zip(heights).for_each(|((depth, &u), &z)| *depth += grid(u, z));
        }
    }

    /// Depth of crownings, slopes and bias, mm.
    #[inline]
    fn formula(&self, p: f64, q: f64) -> f64 {
        self.profile_crowning * p * p
            + 0.5 * self.profile_slope * p
            + self.lead_crowning * q * q
            + 0.5 * self.lead_slope * q
            + 0.25 * self.bias * p * q
    }

    /// The stated modifications and what of the grid is given.
    fn with(&self, grid: Option<[f64; 3]>, u: f64, z: f64) -> Depth {
        let [dp, dq] = [self.per_roll, self.per_height];
        let [p, q] = [dp * (u - self.middle), dq * z];
        let mut depth = Depth {
            value: self.formula(p, q),
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
        if let Some([value, by_roll, by_z]) = grid {
            depth.value += value;
            depth.by_roll += by_roll;
            depth.by_z += by_z;
        }
        depth
    }
}

/// A [`DepthField`] split into its smooth part, which includes all specified modifications, and the deviation of the
/// measured flank from it.
#[derive(Debug, Clone)]
pub struct SplitDepth {
    field: Arc<DepthField>,
    split: Arc<Split>,
    least: f64,
}

/// One is made from its field alone.
impl PartialEq for SplitDepth {
    fn eq(&self, other: &Self) -> bool {
        self.field == other.field
    }
}

impl SplitDepth {
    /// The smooth part at roll angle `u` and height `z` (mm).
    pub fn smooth(&self, u: f64, z: f64) -> Depth {
        self.field.with(Some(self.split.smooth(u, z)), u, z)
    }

    /// The smooth part at places, mm: the values of [`SplitDepth::smooth`], bit by bit.
    pub(crate) fn smooth_at_places(&self, places: [&[f64]; 2], depths: &mut [f64]) {
        self.field.with_at_places(Some(|u: f64, z: f64| self.split.smooth(u, z)[0]), places, depths);
    }

    /// The smooth part of the measured form alone at roll angle `u` and height `z` (mm): depth (mm) and its derivatives by
    /// both.
    pub(crate) fn smooth_form(&self, u: f64, z: f64) -> [f64; 3] {
        self.split.smooth(u, z)
    }

    /// The roll angle of the profile that is nearest to one.
    pub(crate) fn within(&self, u: f64) -> f64 {
        let [form, tip] = self.field.size.roll;
        u.clamp(form, tip)
    }

    /// Depth of the flank below the smooth part, mm.
    pub fn deviation(&self, u: f64, z: f64) -> f64 {
        self.field.grid.as_ref().map_or(0.0, |grid| self.split.deviation(grid, u, z))
    }

    /// Largest magnitude of the deviation, mm.
    pub fn largest_deviation(&self) -> f64 {
        self.split.largest()
    }

    /// Least depth of the smooth part over the flank, mm.
    pub fn least(&self) -> f64 {
        self.least
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
fn grid(t: &TopographyGrid, size: FlankSize) -> Result<Bicubic, GeometryError> {
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
        ("along the profile", covers(&rolls, size.roll[0].min(size.roll[1]), size.roll[0].max(size.roll[1]))),
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
