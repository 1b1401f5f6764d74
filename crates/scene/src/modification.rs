//! Micro-geometry of a scene: its keys, their checks, and the depths in the geometry that they stand for.
//!
//! A new kind of modification is a row of `flank_tables!` and a line of [`FlankScene::in_geometry`] here, and its
//! formula in [`geometry::modification`].

use std::path::PathBuf;

use geometry::FlankModification;
use geometry::modification::{DataFileError, EndRelief, ProfilePlace, Relief, ReliefShape, Topography};
use serde::Serialize;

use crate::inputs::named;
use crate::schema::{INF, Key, Table, bare, table, text, word};
use crate::source::Source;
use crate::spanned::{Number, Word};
use crate::{Scene, SceneError};

type Checked<T> = Result<T, SceneError>;

/// What is ground off the flanks that the torque presses, and off the others.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct ModificationScene {
    /// Flanks that the torque presses.
    #[serde(skip_serializing_if = "FlankScene::is_none")]
    pub drive: FlankScene,
    /// Flanks behind them.
    #[serde(skip_serializing_if = "FlankScene::is_none")]
    pub coast: FlankScene,
}

choices! {
    /// How a relief grows from its start.
    pub enum Shape {
        /// With the distance.
        Linear = "linear",
        /// With its square.
        Parabolic = "parabolic",
    }
}

/// Largest amount of any modification, um: a millimetre is no micro-geometry.
const LARGEST: f64 = 1000.0;

/// An amount, um.
const fn um(name: &'static str, about: &'static str) -> Key {
    bare(name, -LARGEST, LARGEST, about)
}

/// A diameter on the flank, mm.
const fn diameter(name: &'static str, about: &'static str) -> Key {
    bare(name, 0.01, 1e5, about)
}

/// A roll angle, degrees.
const fn roll(name: &'static str, about: &'static str) -> Key {
    bare(name, 0.0, 360.0, about)
}

/// A length up to the face width, mm.
const fn length(name: &'static str, about: &'static str) -> Key {
    bare(name, 1e-3, INF, about)
}

/// How a relief grows.
const fn shape(name: &'static str, about: &'static str) -> Key {
    word(name, Shape::WORDS, about)
}

/// A file.
const fn path(name: &'static str, about: &'static str) -> Key {
    text(name, about)
}

/// What a key of a flank is when it is checked.
macro_rules! flank_value {
    (shape) => {
        Shape
    };
    (path) => {
        PathBuf
    };
    ($number:ident) => {
        f64
    };
}

/// The checked value of a key of a flank.
macro_rules! flank_read {
    (shape, $s:ident, $raw:ident.$name:ident, $face_width:ident) => {
        $raw.$name.as_ref().map(|word| $s.meaning_of(stringify!($name), word)).transpose()?
    };
    (path, $s:ident, $raw:ident.$name:ident, $face_width:ident) => {
        $raw.$name.as_ref().map(|word| named($s, stringify!($name), word)).transpose()?
    };
    ($number:ident, $s:ident, $raw:ident.$name:ident, $face_width:ident) => {
        $s.optional_up_to(&MODIFICATION, stringify!($name), &$raw.$name, $face_width)?
    };
}

/// The keys of a flank once for the three tables that they stand in, and for the struct of what they mean. (Unknown
/// keys are refused, which serde cannot do for tables put together of two.)
macro_rules! flank_tables {
    ($($name:ident: $kind:ident, $about:literal;)*) => {
        const FLANK_KEYS: &[Key] = &[$($kind(stringify!($name), $about)),*];

        /// `[pinion.modification]`
        pub(crate) static MODIFICATION: Table = Table {
            about: "micro-geometry of both flanks of every tooth: material removed, normal to the flank",
            keys: &[
                $($kind(stringify!($name), $about),)*
                table("drive", &DRIVE_FLANK),
                table("coast", &COAST_FLANK),
            ],
            needed: &[],
        };

        raw_table! { RawFlank { $($name: $kind(), $about;)* } }
        raw_table! {
            RawModification {
                $($name: $kind(), $about;)*
                drive: always(DRIVE_FLANK: RawFlank);
                coast: always(COAST_FLANK: RawFlank);
            }
        }

        /// Modification of one flank; `None`: not modified in this way. Terms and signs: [`geometry::modification`].
        #[derive(Debug, Clone, Default, PartialEq, Serialize)]
        pub struct FlankScene {
            $(
                #[doc = concat!($about, ".")]
                #[serde(skip_serializing_if = "Option::is_none")]
                pub $name: Option<flank_value!($kind)>,
            )*
        }

        impl RawModification {
            /// Keys of one flank: its own, and where it has none those of both.
            fn over(&self, own: &RawFlank) -> RawFlank {
                let mut all = RawFlank { $($name: own.$name.clone().or_else(|| self.$name.clone()),)* };
                // A start is one thing, whichever way it is given.
                if own.tip_relief_start_diameter_mm.is_some() || own.tip_relief_start_roll_deg.is_some() {
                    all.tip_relief_start_diameter_mm = own.tip_relief_start_diameter_mm.clone();
                    all.tip_relief_start_roll_deg = own.tip_relief_start_roll_deg.clone();
                }
                if own.root_relief_start_diameter_mm.is_some() || own.root_relief_start_roll_deg.is_some() {
                    all.root_relief_start_diameter_mm = own.root_relief_start_diameter_mm.clone();
                    all.root_relief_start_roll_deg = own.root_relief_start_roll_deg.clone();
                }
                all
            }
        }

        impl FlankScene {
            /// Each key within its range; lengths end at the face width, mm.
            fn read(s: &Source<'_>, raw: &RawFlank, face_width: f64) -> Checked<Self> {
                reliefs(s, raw)?;
                Ok(Self { $($name: flank_read!($kind, s, raw.$name, face_width),)* })
            }
        }
    };
}

flank_tables! {
    tip_relief_um: um, "tip relief C_alpha_a: depth at the tip circle, um";
    tip_relief_start_diameter_mm: diameter, "where the tip relief starts: diameter, mm";
    tip_relief_start_roll_deg: roll, "or roll angle, degrees";
    tip_relief_shape: shape, "how the tip relief grows";
    root_relief_um: um, "root relief C_alpha_f: depth at the root form circle, um";
    root_relief_start_diameter_mm: diameter, "where the root relief starts: diameter, mm";
    root_relief_start_roll_deg: roll, "or roll angle, degrees";
    root_relief_shape: shape, "how the root relief grows";
    profile_crowning_um: um, "profile crowning C_alpha, um at both ends of the range";
    profile_slope_um: um, "profile slope C_Halpha, um more at the tip than at the start of the range";
    lead_crowning_um: um, "lead crowning C_beta, um at both ends of the face";
    lead_slope_um: um, "lead slope C_Hbeta, um more at z = +b/2 than at z = -b/2";
    end_relief_lower_um: um, "end relief C_beta_I: depth at z = -b/2, um";
    end_relief_lower_length_mm: length, "its length, mm, up to the face width";
    end_relief_upper_um: um, "end relief C_beta_II: depth at z = +b/2, um";
    end_relief_upper_length_mm: length, "its length, mm, up to the face width";
    end_relief_shape: shape, "how the end reliefs grow";
    bias_um: um, "bias S_alpha, um: profile slope at z = +b/2 less that at z = -b/2";
    topography: path, "file of measured depths";
    evaluation_start_diameter_mm: diameter, "where the evaluation range of profile crowning, slope and bias starts, mm; default: the root form circle";
}

static DRIVE_FLANK: Table = Table {
    about: "micro-geometry of the flanks that the torque presses, in place of both",
    keys: FLANK_KEYS,
    needed: &[],
};
static COAST_FLANK: Table =
    Table { about: "micro-geometry of the flanks behind them, in place of both", keys: FLANK_KEYS, needed: &[] };

impl FlankScene {
    /// Whether nothing is said.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// The largest amount either way that is stated, um, with its key; `None` where a file says all, or nothing does.
    pub fn largest_amount(&self) -> Option<(&'static str, f64)> {
        let all = [
            ("tip_relief_um", self.tip_relief_um),
            ("root_relief_um", self.root_relief_um),
            ("profile_crowning_um", self.profile_crowning_um),
            ("profile_slope_um", self.profile_slope_um),
            ("lead_crowning_um", self.lead_crowning_um),
            ("lead_slope_um", self.lead_slope_um),
            ("end_relief_lower_um", self.end_relief_lower_um),
            ("end_relief_upper_um", self.end_relief_upper_um),
            ("bias_um", self.bias_um),
        ];
        let stated = all.into_iter().filter_map(|(key, amount)| Some((key, amount?)));
        stated.reduce(|a, b| if b.1.abs() > a.1.abs() { b } else { a })
    }

    /// The depths that are ground off, in mm and rad; files are read.
    pub(crate) fn in_geometry(&self, scene: &Scene) -> Result<FlankModification, DataFileError> {
        let mm = |um: Option<f64>| 1e-3 * um.unwrap_or(0.0);
        let grows = |shape: Option<Shape>| match shape {
            None | Some(Shape::Linear) => ReliefShape::Linear,
            Some(Shape::Parabolic) => ReliefShape::Parabolic,
        };
        let relief = |amount: Option<f64>, diameter: Option<f64>, roll_deg: Option<f64>, shape| {
            let start = diameter.map(ProfilePlace::Diameter).or(roll_deg.map(|u| ProfilePlace::Roll(u.to_radians())))?;
            Some(Relief { amount: 1e-3 * amount?, start, shape: grows(shape) })
        };
        let end = |amount: Option<f64>, length: Option<f64>| {
            Some(EndRelief { amount: 1e-3 * amount?, length: length?, shape: grows(self.end_relief_shape) })
        };
        Ok(FlankModification {
            tip_relief: relief(
                self.tip_relief_um,
                self.tip_relief_start_diameter_mm,
                self.tip_relief_start_roll_deg,
                self.tip_relief_shape,
            ),
            root_relief: relief(
                self.root_relief_um,
                self.root_relief_start_diameter_mm,
                self.root_relief_start_roll_deg,
                self.root_relief_shape,
            ),
            profile_crowning: mm(self.profile_crowning_um),
            profile_slope: mm(self.profile_slope_um),
            lead_crowning: mm(self.lead_crowning_um),
            lead_slope: mm(self.lead_slope_um),
            end_relief: [
                end(self.end_relief_lower_um, self.end_relief_lower_length_mm),
                end(self.end_relief_upper_um, self.end_relief_upper_length_mm),
            ],
            bias: mm(self.bias_um),
            topography: self.topography.as_ref().map(|path| Topography::read(&scene.resolve(path))).transpose()?,
            evaluation_start: self.evaluation_start_diameter_mm.map(ProfilePlace::Diameter),
        })
    }
}

impl ModificationScene {
    /// Whether nothing is said.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Both flanks of a gear.
    pub(crate) fn read(s: &Source<'_>, raw: &RawModification, face_width: f64) -> Checked<Self> {
        Ok(Self {
            drive: FlankScene::read(s, &raw.over(&raw.drive), face_width)?,
            coast: FlankScene::read(s, &raw.over(&raw.coast), face_width)?,
        })
    }
}

/// Every relief says how deep it is and where it begins, once.
fn reliefs(s: &Source<'_>, raw: &RawFlank) -> Checked<()> {
    let start_of = |what: &str, amount: &Number, starts: [(&str, &Number); 2], word: &Word| {
        let given: Vec<_> = starts.iter().filter_map(|(key, v)| v.as_ref().map(|v| (*key, v.span()))).collect();
        let advice = format!("a relief is `{what}_um` with `{}` or `{}`", starts[0].0, starts[1].0);
        let wrong = |span: std::ops::Range<usize>, what: String| Err(s.conflict(&span, what, advice.clone()));
        match (amount, given.as_slice()) {
            (Some(amount), []) => wrong(amount.span(), format!("`{what}_um` has no start")),
            (_, [(a, _), (b, span)]) => wrong(span.clone(), format!("`{a}` and `{b}` both say where it starts")),
            (None, [(key, span), ..]) => wrong(span.clone(), format!("`{key}` has no `{what}_um`")),
            (None, []) => match word {
                Some(word) => wrong(word.span(), format!("`{what}_shape` has no `{what}_um`")),
                None => Ok(()),
            },
            (Some(_), _) => Ok(()),
        }
    };
    start_of(
        "tip_relief",
        &raw.tip_relief_um,
        [
            ("tip_relief_start_diameter_mm", &raw.tip_relief_start_diameter_mm),
            ("tip_relief_start_roll_deg", &raw.tip_relief_start_roll_deg),
        ],
        &raw.tip_relief_shape,
    )?;
    start_of(
        "root_relief",
        &raw.root_relief_um,
        [
            ("root_relief_start_diameter_mm", &raw.root_relief_start_diameter_mm),
            ("root_relief_start_roll_deg", &raw.root_relief_start_roll_deg),
        ],
        &raw.root_relief_shape,
    )?;
    let ends = [
        ("end_relief_lower", &raw.end_relief_lower_um, &raw.end_relief_lower_length_mm),
        ("end_relief_upper", &raw.end_relief_upper_um, &raw.end_relief_upper_length_mm),
    ];
    for (what, amount, length) in ends {
        together(s, (&format!("{what}_um"), amount), (&format!("{what}_length_mm"), length))?;
    }
    if let (Some(word), None, None) = (&raw.end_relief_shape, &raw.end_relief_lower_um, &raw.end_relief_upper_um) {
        return Err(s.conflict(
            &word.span(),
            "`end_relief_shape` has no end relief",
            "add `end_relief_lower_um` or `end_relief_upper_um`, each with its length",
        ));
    }
    Ok(())
}

/// Two keys that mean nothing without each other.
fn together(s: &Source<'_>, a: (&str, &Number), b: (&str, &Number)) -> Checked<()> {
    let (alone, other) = match (a.1, b.1) {
        (Some(value), None) => ((a.0, value), b.0),
        (None, Some(value)) => ((b.0, value), a.0),
        _ => return Ok(()),
    };
    Err(s.conflict(
        &alone.1.span(),
        format!("`{}` has no `{other}`", alone.0),
        format!("give both `{}` and `{}`, or neither", a.0, b.0),
    ))
}
