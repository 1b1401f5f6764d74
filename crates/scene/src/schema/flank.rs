//! Micro-geometry of a gear: the keys of a flank, and the checked values.
//!
//! A new kind of modification is a row of `flank_tables!` here, a line of `FlankScene::in_geometry`, and its formula in
//! [`geometry::modification`].

use geometry::modification::{ReliefShape, Topography};
use serde::Serialize;

use crate::data_file::DataFile;
use crate::error::SceneError;
use crate::source::Source;
use crate::table::{Choice, INF, Key, Table, bare, table, text, word};

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
    word(name, ReliefShape::WORDS, about)
}

/// A file of measured depths.
const fn path(name: &'static str, about: &'static str) -> Key {
    text(name, about)
}

/// What a key of a flank is when it is checked.
macro_rules! flank_value {
    (shape) => {
        ReliefShape
    };
    (path) => {
        DataFile<Topography>
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
        $raw.$name.as_ref().map(|word| crate::inputs::named($s, stringify!($name), word)).transpose()?
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
            pub(crate) fn over(&self, own: &RawFlank) -> RawFlank {
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
            pub(crate) fn read(s: &Source<'_>, raw: &RawFlank, face_width: f64) -> Result<Self, SceneError> {
                Ok(Self { $($name: flank_read!($kind, s, raw.$name, face_width),)* })
            }
        }
    };
}

flank_tables! {
    tip_relief_um: um, "tip relief C_alpha_a: depth at the tip circle, um; 0 where it starts";
    tip_relief_start_diameter_mm: diameter, "where the tip relief starts: diameter d_Ca, mm";
    tip_relief_start_roll_deg: roll, "where the tip relief starts: roll angle tan(alpha), degrees, in place of the diameter";
    tip_relief_shape: shape, "how the tip relief grows";
    root_relief_um: um, "root relief C_alpha_f: depth at the root form circle, um; 0 where it starts";
    root_relief_start_diameter_mm: diameter, "where the root relief starts: diameter d_Cf, mm";
    root_relief_start_roll_deg: roll, "where the root relief starts: roll angle tan(alpha), degrees, in place of the diameter";
    root_relief_shape: shape, "how the root relief grows";
    profile_crowning_um: um, "profile crowning C_alpha, um at both ends of the evaluation range: C p^2";
    profile_slope_um: um, "profile slope C_Halpha, um more at the tip than at the start of the range: C p / 2; the pressure angle grows";
    lead_crowning_um: um, "lead crowning C_beta, um at both ends of the face. C q^2 about the gear's mid-face, over its own face width";
    lead_slope_um: um, "lead slope C_Hbeta, um more at z = +b/2 than at z = -b/2: C q / 2";
    end_relief_lower_um: um, "end relief C_beta_I: depth at z = -b/2, um; 0 where it starts";
    end_relief_lower_length_mm: length, "length of the end relief C_beta_I, mm, up to the face width";
    end_relief_upper_um: um, "end relief C_beta_II: depth at z = +b/2, um; 0 where it starts";
    end_relief_upper_length_mm: length, "length of the end relief C_beta_II, mm, up to the face width";
    end_relief_shape: shape, "how both end reliefs grow";
    bias_um: um, "flank twist (bias) S_alpha, um: profile slope at z = +b/2 less that at z = -b/2; S p q / 4";
    topography: path, "file of measured depths, see below";
    evaluation_start_diameter_mm: diameter, "where the evaluation range of profile crowning, slope and bias starts: diameter d_Cf, mm; default: the root form circle";
}

static DRIVE_FLANK: Table = Table {
    about: "micro-geometry of the flanks that the torque presses, in place of both",
    keys: FLANK_KEYS,
    needed: &[],
};
static COAST_FLANK: Table =
    Table { about: "micro-geometry of the flanks behind them, in place of both", keys: FLANK_KEYS, needed: &[] };

/// Modification of the flanks that the torque loads, and of the opposite flanks.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct ModificationScene {
    /// Flanks loaded by the torque.
    #[serde(skip_serializing_if = "FlankScene::is_none")]
    pub drive: FlankScene,
    /// The opposite flanks.
    #[serde(skip_serializing_if = "FlankScene::is_none")]
    pub coast: FlankScene,
}
