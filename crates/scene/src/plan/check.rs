//! From the words of a plan file to a plan. Every complaint is made here, before any work starts.

use cases::{Axis, Cases, CasesError, Design, Distribution, Sampling};
use geometry::TOLERANCE_CLASSES;
use toml::Spanned;

use super::{
    PitchTolerance, Plan, PlanAxis, PlanOutput, PlanTake, classed,
    raw::{RawOutput, RawPlan, RawVary},
    tolerance::is_pitch,
    word,
};
use crate::{SceneError, Setting, Source, Word, study::Take};

type Checked<T> = Result<T, SceneError>;

/// Designs by their words; the first one where none is written.
pub(crate) const DESIGNS: [(&str, Design); 3] =
    [("latin-hypercube", Design::LatinHypercube), ("sobol", Design::Sobol), ("random", Design::Random)];
/// Samples where none are stated, and most of them.
pub(super) const SAMPLES: [u32; 2] = [100, 10_000_000];
/// Seed where none is stated.
pub(crate) const SEED: u32 = 1;
/// What a tolerance class is of.
pub(super) const CLASSED: &str =
    "it has of profile_slope_um, profile_crowning_um, lead_slope_um, lead_crowning_um and pitch_errors_um of a gear";
/// Mesh harmonics at the most.
const ORDERS: u32 = 1000;
/// Word for a mesh harmonic among what may be taken of a column.
const HARMONIC: &str = "harmonic";

pub(super) fn check(s: &Source<'_>, raw: &RawPlan, more: &[Setting]) -> Checked<Plan> {
    let nothing = |what: &str, advice: &str| s.conflict(&(0..0), what, advice);
    let scene = raw.scene.as_ref().ok_or_else(|| nothing("a plan without `scene`", "give the path of a scene file"))?;
    if raw.vary.is_empty() {
        return Err(nothing(
            "a plan that varies nothing",
            "name a key: [[vary]] with `key` and `values`, or `from` and `to`",
        ));
    }
    if raw.output.is_empty() {
        let advice = "name a number: [[output]] with `headline = \"peak_to_peak_ste_um\"`, or `column` and `take`";
        return Err(nothing("a plan that asks for nothing", advice));
    }
    let document = s.named(scene, "plan file")?;
    let mut settings = raw.set.iter().map(|word| setting(s, word)).collect::<Checked<Vec<_>>>()?;
    settings.extend_from_slice(more);
    let sampling = Sampling {
        design: s.choice("design", &raw.design, &DESIGNS)?,
        samples: s.whole("samples", &raw.samples, SAMPLES[0], 1, SAMPLES[1])?,
        seed: u64::from(s.whole("seed", &raw.seed, SEED, 0, u32::MAX)?),
    };
    let (mut axes, mut kinds) = (Vec::new(), Vec::new());
    let known = document.machine(&settings).ok();
    for table in &raw.vary {
        let tolerance = |key: &str, class: u32| {
            let known = known.as_ref()?.pair()?;
            classed(known, key, class, known.number_at(key))
        };
        let (own, kind) = vary(s, table, "[[vary]]", tolerance)?;
        axes.push(own);
        kinds.push(kind);
    }
    let cases = Cases::new(kinds, &sampling).map_err(|e| {
        let table = match e {
            CasesError::NoValues { axis } | CasesError::NoDistribution { axis, .. } => raw.vary.get(axis),
            CasesError::TooMany { .. } => None,
        };
        s.conflict(&table.map_or(0..0, Spanned::span), fault(&e), "see [[vary]] in docs/scene.md")
    })?;
    let outputs = raw.output.iter().map(|table| output(s, table)).collect::<Checked<Vec<_>>>()?;
    let name = raw.name.clone().unwrap_or_else(|| {
        s.file.file_stem().map_or_else(|| "plan".into(), |stem| stem.to_string_lossy().into_owned())
    });
    let file = s.file.to_owned();
    finish(Plan { name, file, document, settings, axes, sampling, cases, outputs })
}

/// What the whole of a plan must be: keys and outputs are there once, and the scene is one.
///
/// # Errors
/// [`SceneError`].
pub(super) fn finish(plan: Plan) -> Checked<Plan> {
    let mut keys: Vec<&str> = plan.axes.iter().flat_map(|axis| &axis.keys).map(String::as_str).collect();
    keys.sort_unstable();
    if let Some(twice) = keys.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(SceneError::Twice {
            file: plan.file,
            what: format!("`{}` is varied", twice[0]),
            advice: format!("name each key once, with all its values: `--vary {}=50,100,200`", twice[0]),
        });
    }
    let mut names: Vec<String> = plan.outputs.iter().map(PlanOutput::name).collect();
    names.sort_unstable();
    if let Some(twice) = names.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(SceneError::Twice {
            file: plan.file,
            what: format!("`{}` is asked for", twice[0]),
            advice: "ask for each number once".to_owned(),
        });
    }
    // A key that is none, or a scene that is wrong in all cases, is told before any work; values may be wrong in some
    // cases alone.
    match plan.machine(0) {
        Ok(_) | Err(SceneError::OutOfRange { .. } | SceneError::Geometry { .. }) => Ok(plan),
        Err(e) => {
            plan.document.machine(&plan.settings)?;
            Err(e)
        }
    }
}

/// Without the number of the axis, which the place of the complaint tells.
fn fault(e: &CasesError) -> String {
    match e {
        CasesError::NoValues { .. } => "no values".into(),
        CasesError::NoDistribution { what, .. } => (*what).into(),
        CasesError::TooMany { .. } => e.to_string(),
    }
}

pub(crate) fn setting(s: &Source<'_>, word: &Spanned<String>) -> Checked<Setting> {
    let place = s.place(&word.span());
    match Setting::parse(word.get_ref()) {
        Err(SceneError::Setting { what, .. }) => Err(SceneError::Setting { label: format!("{place}: set"), what }),
        other => other,
    }
}

/// A varied key; `called`: the name of its table.
///
/// `tolerance(key, class)`: how it deviates in a class of ISO 1328-1.
pub(crate) fn vary(
    s: &Source<'_>,
    table: &Spanned<RawVary>,
    called: &str,
    tolerance: impl Fn(&str, u32) -> Option<(Option<PitchTolerance>, Axis)>,
) -> Checked<(PlanAxis, Axis)> {
    let raw = table.get_ref();
    let conflict = |what: &str, advice: &str| s.conflict(&table.span(), what, advice);
    let key =
        raw.key.as_ref().ok_or_else(|| conflict(&format!("{called} has no `key`"), "name the key that is varied"))?;
    let pitch_errors = [key].into_iter().chain(&raw.also).any(|word| is_pitch(word.get_ref()));
    if pitch_errors && (raw.iso_1328_class.is_none() || !raw.also.is_empty()) {
        let advice = "give `iso_1328_class`, and each gear a table of its own";
        return Err(conflict("pitch errors of a gear are drawn together, within a tolerance class", advice));
    }
    let keys = [key].into_iter().chain(&raw.also).map(|word| word.get_ref().clone()).collect();
    let logarithmic = s.choice("scale", &raw.scale, &[("linear", false), ("log", true)])?;
    let (drawn, ends, list) =
        (raw.mean.is_some() || raw.deviation.is_some(), raw.from.is_some() || raw.to.is_some(), raw.values.is_some());
    let classed = raw.iso_1328_class.is_some();
    if usize::from(drawn) + usize::from(ends) + usize::from(list) + usize::from(classed) != 1 {
        let advice = "give `values`, or `from` and `to`, or `mean` and `deviation`, or `iso_1328_class`";
        return Err(conflict(&format!("{called} says in one way what values there are"), advice));
    }
    let beside = |is: bool, what: &str, advice: &str| if is { Err(conflict(what, advice)) } else { Ok(()) };
    beside(raw.count.is_some() && !ends, "`count` goes with `from` and `to`", "leave it out")?;
    beside(raw.scale.is_some() && !ends, "`scale` goes with `from` and `to`", "leave it out")?;
    let limited = raw.least.is_some() || raw.largest.is_some();
    beside(limited && !drawn, "`least` and `largest` go with `mean` and `deviation`", "leave them out")?;
    let number = |key: &str, value: &crate::Number, default: f64| s.number(key, value, default, -1e300, 1e300);
    let needed = |key: &str, value: &crate::Number| {
        value.as_ref().ok_or_else(|| conflict(&format!("{called} has no `{key}`"), "give both numbers"))?;
        number(key, value, 0.0)
    };
    let mut pitch = None;
    let axis = if let Some(values) = &raw.values {
        if let Some(bad) = values.get_ref().iter().find(|x| !x.is_finite()) {
            return Err(s.conflict(&values.span(), format!("`values` holds {bad}"), "give numbers"));
        }
        Axis::Each(values.get_ref().clone())
    } else if classed {
        let class =
            s.whole("iso_1328_class", &raw.iso_1328_class, 6, *TOLERANCE_CLASSES.start(), *TOLERANCE_CLASSES.end())?;
        let (own, axis) = tolerance(key.get_ref(), class).ok_or_else(|| {
            let what = format!("ISO 1328 has no tolerance for `{}`", key.get_ref());
            conflict(&what, CLASSED)
        })?;
        pitch = own;
        axis
    } else if drawn {
        let limit = |key: &str, value: &crate::Number, none: f64| match value {
            Some(_) => number(key, value, 0.0),
            None => Ok(none),
        };
        let limits = [limit("least", &raw.least, f64::NEG_INFINITY)?, limit("largest", &raw.largest, f64::INFINITY)?];
        word::normal(needed("mean", &raw.mean)?, needed("deviation", &raw.deviation)?, limits)
    } else {
        let (from, to) = (needed("from", &raw.from)?, needed("to", &raw.to)?);
        match &raw.count {
            Some(_) => {
                let count = s.whole("count", &raw.count, 1, 1, 10_000_000)?;
                word::grid([from, to], count, logarithmic).map_err(|what| conflict(&what, "see `scale`"))?
            }
            None if logarithmic => Axis::Drawn(Distribution::LogUniform { from, to }),
            None => Axis::Drawn(Distribution::Uniform { from, to }),
        }
    };
    Ok((PlanAxis { keys, pitch }, axis))
}

fn output(s: &Source<'_>, table: &Spanned<RawOutput>) -> Checked<PlanOutput> {
    let raw = table.get_ref();
    let conflict = |what: &str, advice: &str| Err(s.conflict(&table.span(), what, advice));
    let named = |word: &Word| word.as_ref().map(|w| w.get_ref().clone());
    match (named(&raw.headline), named(&raw.column)) {
        (Some(_), None) if raw.take.is_some() || raw.order.is_some() => {
            conflict("`take` and `order` go with `column`", "leave them out, or name a `column`")
        }
        (Some(key), None) => Ok(PlanOutput::Headline(key)),
        (None, Some(column)) => {
            let harmonic = raw.take.as_ref().is_some_and(|word| word.get_ref() == HARMONIC);
            if raw.order.is_some() && !harmonic {
                return conflict("`order` goes with `take = \"harmonic\"`", "leave it out");
            }
            let mut takes: Vec<(&str, PlanTake)> = Take::ALL.map(|t| (t.word(), PlanTake::Of(t))).to_vec();
            takes.push((HARMONIC, PlanTake::Harmonic(s.whole("order", &raw.order, 1, 1, ORDERS)?)));
            Ok(PlanOutput::Column { column, take: s.choice("take", &raw.take, &takes)? })
        }
        _ => conflict("[[output]] names one number", "give `headline`, or `column` and `take`"),
    }
}
