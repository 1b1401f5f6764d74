//! Micro-geometry: deviations of the flank from the involute helicoid.
//!
//! Every modification is a **depth** in mm as a function of roll angle u and height z, normal to the flank and positive
//! where material is removed. Names follow ISO 21771, evaluation ranges follow ISO 1328-1:
//!
//! ```text
//! p = (2 u - u_1 - u_2) / (u_2 - u_1)    -1 .. 1 from the start of the evaluation range to the tip circle
//! q = 2 z / b                            -1 .. 1 over the face width
//! ```
//!
//! u_1 is the root form circle unless [`FlankModification::evaluation_start`] is given. Every function is continued
//! beyond its range: there is no flank there, but a foot point may lie there.
//!
//! | modification | symbol | depth |
//! |---|---|---|
//! | profile crowning | C_alpha | C p^2: none in the middle, the amount at both ends |
//! | profile slope | C_Halpha | C p / 2: none in the middle, the amount more at the tip than at the start |
//! | lead crowning | C_beta | C q^2: none at mid-face, the amount at both ends |
//! | lead slope | C_Hbeta | C q / 2: none at mid-face, the amount more at z = +b/2 than at z = -b/2 |
//! | bias (twist of the profile) | S_alpha | S p q / 4: the profile slope at z = +b/2 exceeds that at z = -b/2 by S |
//! | tip relief | C_alpha a | C t or C t^2, t from 0 at its start to 1 at the tip circle |
//! | root relief | C_alpha f | the same from its start down to the root form circle |
//! | end relief | C_beta I, II | the same from its start to the end face; I: z = -b/2, II: z = +b/2 |
//! | topography | | measured grid, see [`Topography`] |
//!
//! ISO 1328-1 counts slope deviations with the opposite sign: f_Halpha > 0 where the flank has extra material at the
//! tip. Depths add up. A pitch error rotates a whole tooth about the gear's axis ([`GearModifications::pitch_errors`]).

mod data_file;
mod depth;
mod depth_rate;
mod flank_size;
mod interpolation;
mod modified_flank;
mod pitch;
mod relief;
mod split;
mod topography;

use serde::Serialize;

pub use data_file::DataFileError;
pub use depth::{Depth, DepthField, SplitDepth};
pub use depth_rate::DepthRate;
pub(crate) use flank_size::FlankSize;
pub use modified_flank::ModifiedFlank;
pub use pitch::parse_pitch_errors;
pub use relief::{EndRelief, ProfilePlace, Relief, ReliefShape};
pub use topography::{ProfileAxis, Topography, TopographyGrid};

use crate::Side;

/// Modification of one flank, equal on every tooth; amounts in mm, positive where material is removed.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct FlankModification {
    /// Tip relief C_alpha a.
    pub tip_relief: Option<Relief>,
    /// Root relief C_alpha f.
    pub root_relief: Option<Relief>,
    /// Profile crowning C_alpha, mm.
    pub profile_crowning: f64,
    /// Profile slope C_Halpha, mm.
    pub profile_slope: f64,
    /// Lead crowning C_beta, mm.
    pub lead_crowning: f64,
    /// Lead slope C_Hbeta, mm.
    pub lead_slope: f64,
    /// End relief C_beta I at z = -b/2 and C_beta II at z = +b/2.
    pub end_relief: [Option<EndRelief>; 2],
    /// Bias S_alpha, mm.
    pub bias: f64,
    /// Measured depths.
    pub topography: Option<Topography>,
    /// Start of the evaluation range of profile crowning, profile slope and bias (profile control circle of ISO
    /// 1328-1); `None`: the root form circle.
    pub evaluation_start: Option<ProfilePlace>,
}

/// Micro-geometry of a gear.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct GearModifications {
    /// Modification of the left flanks.
    pub left: FlankModification,
    /// Modification of the right flanks.
    pub right: FlankModification,
    /// Cumulative pitch deviation (index deviation) of each tooth, mm of arc on the reference circle in the transverse
    /// plane. Positive: the whole tooth is displaced in the direction in which teeth are numbered (counter-clockwise;
    /// clockwise for an internal gear). Empty, or one value per tooth.
    pub pitch_errors: Vec<f64>,
}

impl FlankModification {
    /// Whether the flank has no modification.
    pub fn is_none(&self) -> bool {
        // Where the evaluation range starts changes nothing by itself.
        *self == Self { evaluation_start: self.evaluation_start, ..Self::default() }
    }
}

impl GearModifications {
    /// The same modification on both sides of every tooth, no pitch errors.
    pub fn both(flank: FlankModification) -> Self {
        Self { left: flank.clone(), right: flank, pitch_errors: Vec::new() }
    }

    /// Modification of the flanks on `side`.
    pub fn on(&self, side: Side) -> &FlankModification {
        match side {
            Side::Left => &self.left,
            Side::Right => &self.right,
        }
    }

    /// Whether the gear has no modification and no pitch error.
    pub fn is_none(&self) -> bool {
        self.left.is_none() && self.right.is_none() && !self.has_pitch_errors()
    }

    /// Whether any tooth has a pitch error.
    pub fn has_pitch_errors(&self) -> bool {
        self.pitch_errors.iter().any(|e| *e != 0.0)
    }
}
