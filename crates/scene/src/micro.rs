//! Micro-geometry, pitch errors and misalignment of a scene.

use std::path::PathBuf;

use serde::Serialize;

use super::error::SceneError;
use super::inputs::named;
use super::raw::{Number, RawFlank, RawGear, RawMisalignment, RawModification, Word};
use super::schema;
use super::source::Source;

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

/// Modification of one flank; `None`: not modified in this way. Terms and signs: [`geometry::modification`].
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct FlankScene {
    /// Depth at the tip circle, um.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tip_relief_um: Option<f64>,
    /// Where it starts: diameter, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tip_relief_start_diameter_mm: Option<f64>,
    /// Or roll angle, degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tip_relief_start_roll_deg: Option<f64>,
    /// How it grows.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tip_relief_shape: Option<Shape>,
    /// Depth at the root form circle, um.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub root_relief_um: Option<f64>,
    /// Where it starts: diameter, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub root_relief_start_diameter_mm: Option<f64>,
    /// Or roll angle, degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub root_relief_start_roll_deg: Option<f64>,
    /// How it grows.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub root_relief_shape: Option<Shape>,
    /// Profile crowning C_alpha, um.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub profile_crowning_um: Option<f64>,
    /// Profile slope C_Halpha, um.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub profile_slope_um: Option<f64>,
    /// Lead crowning C_beta, um.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lead_crowning_um: Option<f64>,
    /// Lead slope C_Hbeta, um.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lead_slope_um: Option<f64>,
    /// Depth at z = -b/2, um.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end_relief_lower_um: Option<f64>,
    /// Its length, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end_relief_lower_length_mm: Option<f64>,
    /// Depth at z = +b/2, um.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end_relief_upper_um: Option<f64>,
    /// Its length, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end_relief_upper_length_mm: Option<f64>,
    /// How both grow.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end_relief_shape: Option<Shape>,
    /// Bias S_alpha, um.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bias_um: Option<f64>,
    /// File of measured depths, as written in the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub topography: Option<PathBuf>,
    /// Start of the evaluation range of profile crowning, profile slope and bias: diameter, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub evaluation_start_diameter_mm: Option<f64>,
}

/// How a relief grows from its start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Shape {
    /// With the distance.
    Linear,
    /// With its square.
    Parabolic,
}

/// Deviation of the wheel's axis, um over the face width. Terms and signs: `docs/scene.md`, `[pair.misalignment]`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct MisalignmentScene {
    /// f_Sigma_beta, across the plane of axes.
    pub deviation_um: f64,
    /// f_Sigma_delta, in the plane of axes.
    pub inclination_um: f64,
    /// In the plane of action of the driving flanks.
    pub in_plane_of_action_um: f64,
    /// Across it.
    pub across_plane_of_action_um: f64,
}

impl FlankScene {
    /// Whether nothing is said.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }
}

impl ModificationScene {
    /// Whether nothing is said.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }
}

impl MisalignmentScene {
    /// Whether the axes are parallel.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }
}

const SHAPES: [(&str, Shape); 2] = [("linear", Shape::Linear), ("parabolic", Shape::Parabolic)];
/// Largest pitch error, um: a millimetre is another gear.
const LARGEST: f64 = 1000.0;

/// Both flanks of a gear.
pub(super) fn modification(s: &Source<'_>, raw: &RawModification, face_width: f64) -> Checked<ModificationScene> {
    Ok(ModificationScene {
        drive: flank(s, &raw.over(&raw.drive), face_width)?,
        coast: flank(s, &raw.over(&raw.coast), face_width)?,
    })
}

fn flank(s: &Source<'_>, raw: &RawFlank, face_width: f64) -> Checked<FlankScene> {
    let number = |key, value: &Number| s.optional_of(&schema::MODIFICATION, key, value);
    let length = |key, value: &Number| {
        let (least, _, _) = schema::MODIFICATION.number(key);
        value.as_ref().map(|_| s.number(key, value, 0.0, least, face_width)).transpose()
    };
    let shape = |key, word: &Word| word.as_ref().map(|w| s.one_of(key, w, &SHAPES)).transpose();
    reliefs(s, raw)?;
    Ok(FlankScene {
        tip_relief_um: number("tip_relief_um", &raw.tip_relief_um)?,
        tip_relief_start_diameter_mm: number("tip_relief_start_diameter_mm", &raw.tip_relief_start_diameter_mm)?,
        tip_relief_start_roll_deg: number("tip_relief_start_roll_deg", &raw.tip_relief_start_roll_deg)?,
        tip_relief_shape: shape("tip_relief_shape", &raw.tip_relief_shape)?,
        root_relief_um: number("root_relief_um", &raw.root_relief_um)?,
        root_relief_start_diameter_mm: number("root_relief_start_diameter_mm", &raw.root_relief_start_diameter_mm)?,
        root_relief_start_roll_deg: number("root_relief_start_roll_deg", &raw.root_relief_start_roll_deg)?,
        root_relief_shape: shape("root_relief_shape", &raw.root_relief_shape)?,
        profile_crowning_um: number("profile_crowning_um", &raw.profile_crowning_um)?,
        profile_slope_um: number("profile_slope_um", &raw.profile_slope_um)?,
        lead_crowning_um: number("lead_crowning_um", &raw.lead_crowning_um)?,
        lead_slope_um: number("lead_slope_um", &raw.lead_slope_um)?,
        end_relief_lower_um: number("end_relief_lower_um", &raw.end_relief_lower_um)?,
        end_relief_lower_length_mm: length("end_relief_lower_length_mm", &raw.end_relief_lower_length_mm)?,
        end_relief_upper_um: number("end_relief_upper_um", &raw.end_relief_upper_um)?,
        end_relief_upper_length_mm: length("end_relief_upper_length_mm", &raw.end_relief_upper_length_mm)?,
        end_relief_shape: shape("end_relief_shape", &raw.end_relief_shape)?,
        bias_um: number("bias_um", &raw.bias_um)?,
        topography: raw.topography.as_ref().map(|word| named(s, "topography", word)).transpose()?,
        evaluation_start_diameter_mm: number("evaluation_start_diameter_mm", &raw.evaluation_start_diameter_mm)?,
    })
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

/// Pitch errors: a list, or a file.
pub(super) fn pitch_errors(s: &Source<'_>, raw: &RawGear, teeth: u32) -> Checked<(Vec<f64>, Option<PathBuf>)> {
    let in_file = raw.pitch_errors_file.as_ref().map(|word| named(s, "pitch_errors_file", word)).transpose()?;
    let Some(list) = &raw.pitch_errors_um else { return Ok((Vec::new(), in_file)) };
    if in_file.is_some() {
        let what = "a gear has both `pitch_errors_um` and `pitch_errors_file`";
        return Err(s.conflict(&list.span(), what, "keep the one or the other"));
    }
    let given = list.get_ref().len();
    if given != teeth as usize {
        let what = format!("`pitch_errors_um` has {given} values, but the gear has {teeth} teeth");
        return Err(s.conflict(&list.span(), what, "give one value a tooth, tooth 0 first"));
    }
    let values = list.get_ref().iter().map(|v| s.number("pitch_errors_um", &Some(v.clone()), 0.0, -LARGEST, LARGEST));
    Ok((values.collect::<Checked<_>>()?, None))
}

/// Deviations of the axes.
pub(super) fn misalignment(s: &Source<'_>, raw: &RawMisalignment, face_width: f64) -> Checked<MisalignmentScene> {
    // Each alone at most 0.01 rad: more than that is no misalignment but another gear drive.
    let limit = 10.0 * face_width;
    let um = |key, value: &Number| s.number(key, value, 0.0, -limit, limit);
    Ok(MisalignmentScene {
        deviation_um: um("deviation_um", &raw.deviation_um)?,
        inclination_um: um("inclination_um", &raw.inclination_um)?,
        in_plane_of_action_um: um("in_plane_of_action_um", &raw.in_plane_of_action_um)?,
        across_plane_of_action_um: um("across_plane_of_action_um", &raw.across_plane_of_action_um)?,
    })
}
