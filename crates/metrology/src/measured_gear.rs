//! One measured gear: its header, traces and pitch.

use std::f64::consts::PI;
use std::path::Path;

use geometry::Side;
use serde::Serialize;

use crate::MetrologyError;

/// Largest deviation that a flank may have, in normal modules: more is a number that stands for no value.
const LARGEST: f64 = 0.25;
/// Largest deviation of a topography, um.
const LARGEST_UM: f64 = 1000.0;

/// A range of a trace, from and to; diameters (mm) of profiles, heights (mm) of helices.
pub type Range = [f64; 2];

/// What the header of a file says of the gear.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct GearHeader {
    /// Number of teeth z.
    pub teeth: u32,
    /// Normal module m_n, mm.
    pub normal_module: f64,
    /// Helix angle beta, rad, right hand positive.
    pub helix_angle: f64,
    /// Normal pressure angle alpha_n, rad.
    pub pressure_angle: f64,
    /// Profile shift coefficient x, where it is known.
    pub profile_shift: Option<f64>,
    /// Face width b, mm, where it is known.
    pub face_width: Option<f64>,
    /// Range of the profile that is evaluated, diameters, mm.
    pub profile_evaluation: Option<Range>,
    /// Range over which profiles were measured, diameters, mm.
    pub profile_measured: Option<Range>,
    /// Range of the helix that is evaluated, heights, mm.
    pub helix_evaluation: Option<Range>,
    /// Range over which helices were measured, heights, mm.
    pub helix_measured: Option<Range>,
}

/// Which way a trace runs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum TraceKind {
    /// Profile at a height, mm.
    Profile(f64),
    /// Helix on a circle, diameter in mm.
    Helix(f64),
}

/// Deviations along one trace.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Trace {
    /// Which way it runs, and where.
    pub kind: TraceKind,
    /// Tooth, from 0.
    pub tooth: u32,
    /// Side of the tooth.
    pub side: Side,
    /// Deviations, um, positive where the flank stands proud; `None` where there is no value. Evenly spaced over the
    /// measured range: of a profile in roll length, of a helix in height.
    pub deviations_um: Vec<Option<f64>>,
}

/// Pitch deviations on one side of all teeth, um.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Pitch {
    /// Side of the teeth.
    pub side: Side,
    /// Index deviation of each tooth, tooth 0 first, um of arc, positive: too far in the direction in which teeth are
    /// numbered.
    pub index_um: Vec<f64>,
}

/// A measured gear.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasuredGear {
    /// Data of the gear.
    pub header: GearHeader,
    /// Traces in the order of the file.
    pub traces: Vec<Trace>,
    /// Pitch, of one side, both or none.
    pub pitch: Vec<Pitch>,
}

impl GearHeader {
    /// Transverse pressure angle: tan a_t = tan a_n / cos b.
    pub fn transverse_pressure_angle(&self) -> f64 {
        (self.pressure_angle.tan() / self.helix_angle.cos()).atan()
    }

    /// Reference diameter, mm.
    pub fn reference_diameter(&self) -> f64 {
        self.normal_module * f64::from(self.teeth) / self.helix_angle.cos()
    }

    /// Base diameter, mm.
    pub fn base_diameter(&self) -> f64 {
        self.reference_diameter() * self.transverse_pressure_angle().cos()
    }

    /// Roll length r_b u of a diameter, mm: L = sqrt(d^2 - d_b^2)/2; NaN below the base circle.
    pub fn roll_length(&self, diameter: f64) -> f64 {
        0.5 * (diameter * diameter - self.base_diameter().powi(2)).sqrt()
    }

    /// Why no trace has places: what its measuring range lacks.
    pub(crate) fn no_range(&self) -> &'static str {
        let below = |d: f64| self.roll_length(d).is_nan();
        match (self.profile_measured, self.helix_measured) {
            (None, None) => {
                "no measuring range is stated: profiles from `da` to `de` (diameters), helices from `ba` to `be` (heights)"
            }
            (None, Some(_)) => "profiles have no measuring range, from `da` to `de` (diameters)",
            (Some([from, to]), _) if from >= to => {
                "the measuring range of profiles does not ascend: `da` is the smaller diameter"
            }
            (Some([from, _]), _) if below(from) => "the measuring range of profiles begins below the base circle",
            (_, Some([from, to])) if from >= to => {
                "the measuring range of helices does not ascend: `ba` is the lower height"
            }
            _ => "no trace has two values in a measuring range",
        }
    }

    /// Roll angle of the rotation of one tooth, 2 pi/z.
    pub fn pitch_angle(&self) -> f64 {
        2.0 * PI / f64::from(self.teeth)
    }
}

impl Trace {
    /// Where its values stand, mm: roll lengths of a profile, heights of a helix; `None` where the header has no range for
    /// it, or its trace fewer than two values.
    pub fn places(&self, header: &GearHeader) -> Option<Vec<f64>> {
        let [from, to] = match self.kind {
            TraceKind::Profile(_) => header.profile_measured?.map(|d| header.roll_length(d)),
            TraceKind::Helix(_) => header.helix_measured?,
        };
        let last = self.deviations_um.len().checked_sub(1).filter(|last| *last > 0)? as f64;
        let usable = from.is_finite() && to.is_finite() && from < to;
        usable.then(|| (0..self.deviations_um.len()).map(|i| from + (to - from) * i as f64 / last).collect())
    }

    /// Values of the trace with their places (mm), those without a value left out.
    pub fn points(&self, header: &GearHeader) -> Option<Vec<[f64; 2]>> {
        let places = self.places(header)?;
        Some(places.iter().zip(&self.deviations_um).filter_map(|(x, f)| Some([*x, (*f)?])).collect())
    }
}

impl MeasuredGear {
    /// The gear, unless a deviation of a trace or of the pitch is above a quarter of the normal module; `path` is what the
    /// message names.
    ///
    /// # Errors
    /// [`MetrologyError::Deviation`].
    pub(crate) fn checked(self, path: &Path) -> Result<Self, MetrologyError> {
        let most_um = (1e3 * LARGEST * self.header.normal_module).min(LARGEST_UM);
        let of_traces = self.traces.iter().flat_map(|trace| {
            let what = match trace.kind {
                TraceKind::Profile(_) => "profile",
                TraceKind::Helix(_) => "helix",
            };
            trace.deviations_um.iter().flatten().map(move |um| (what, trace.tooth, trace.side, *um))
        });
        let of_pitch = self.pitch.iter().flat_map(|pitch| {
            pitch.index_um.iter().zip(0..).map(|(um, tooth)| ("index deviation", tooth, pitch.side, *um))
        });
        let worst = of_traces.chain(of_pitch).find(|(.., um)| um.abs() > most_um);
        match worst {
            None => Ok(self),
            Some((what, tooth, side, um)) => {
                let path = path.to_owned();
                Err(MetrologyError::Deviation { path, what, tooth: tooth + 1, side: side.name(), um, most_um })
            }
        }
    }

    /// The gear with the last of traces, and of tables of pitch, that were measured again.
    #[must_use]
    pub fn last_of_each(mut self) -> Self {
        let again = self.again();
        let mut each = again.iter();
        self.traces.retain(|_| each.next() == Some(&false));
        let sides: Vec<Side> = self.pitch.iter().map(|own| own.side).collect();
        let mut each = (0..sides.len()).map(|i| !sides[i + 1..].contains(&sides[i]));
        self.pitch.retain(|_| each.next() == Some(true));
        self
    }

    /// Whether each trace was measured again later.
    fn again(&self) -> Vec<bool> {
        let same = |a: &Trace, b: &Trace| a.tooth == b.tooth && a.side == b.side && a.kind == b.kind;
        let again = |(i, trace): (usize, &Trace)| self.traces[i + 1..].iter().any(|later| same(trace, later));
        self.traces.iter().enumerate().map(again).collect()
    }

    /// How many traces were measured again at the same place of the same tooth: the last of them counts.
    pub fn repeated_traces(&self) -> usize {
        self.again().into_iter().filter(|again| *again).count()
    }
}
