//! Micro-geometry of a scene: combinations of flank keys, and the corresponding depths in the geometry.

use geometry::FlankModification;
use geometry::modification::{EndRelief, ProfilePlace, Relief, ReliefShape};

use crate::error::SceneError;
use crate::schema::{FlankScene, ModificationScene, RawFlank, RawModification};
use crate::source::Source;
use crate::spanned::{Number, Word};

type Checked<T> = Result<T, SceneError>;

impl FlankScene {
    /// Whether nothing is given.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// The largest magnitude given, um, with its key; `None` if a file gives the whole flank, or if nothing is given.
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

    /// The depths that are ground off, in mm and rad.
    pub(crate) fn in_geometry(&self) -> FlankModification {
        let mm = |um: Option<f64>| 1e-3 * um.unwrap_or(0.0);
        let relief = |amount: Option<f64>, diameter: Option<f64>, roll_deg: Option<f64>, shape: Option<ReliefShape>| {
            let start = diameter.map(ProfilePlace::Diameter).or(roll_deg.map(|u| ProfilePlace::Roll(u.to_radians())))?;
            Some(Relief { amount: 1e-3 * amount?, start, shape: shape.unwrap_or_default() })
        };
        let end = |amount: Option<f64>, length: Option<f64>| {
            Some(EndRelief {
                amount: 1e-3 * amount?,
                length: length?,
                shape: self.end_relief_shape.unwrap_or_default(),
            })
        };
        FlankModification {
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
            topography: self.topography.as_ref().map(|file| file.values().clone()),
            evaluation_start: self.evaluation_start_diameter_mm.map(ProfilePlace::Diameter),
        }
    }
}

impl ModificationScene {
    /// Whether nothing is given.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Both flanks of a gear.
    pub(crate) fn read(s: &Source<'_>, raw: &RawModification, face_width: f64) -> Checked<Self> {
        let flank = |own: &RawFlank| {
            let said = raw.over(own);
            reliefs(s, &said)?;
            FlankScene::read(s, &said, face_width)
        };
        Ok(Self { drive: flank(&raw.drive)?, coast: flank(&raw.coast)? })
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
