//! From the words of an optimisation file to what they mean.

use std::path::Path;

use cases::{Axis, Cases, CasesError, Sampling};
use design::{Goal, Measure, Over};
use toml::Spanned;

use super::{
    DesignParameter, Optimisation, TorqueWeight,
    file::TORQUE,
    raw::{RawOptimisation, RawParameter},
};
use crate::{
    Scene, SceneError, Setting, Source, nearest,
    plan::{DESIGNS, SEED, classed, setting, vary},
};

type Checked<T> = Result<T, SceneError>;

/// Evaluations where none are stated, and the most.
pub(super) const EVALUATIONS: [u32; 2] = [20, 10_000];
/// Limits of a pressure, MPa.
pub(super) const PRESSURES: [f64; 2] = [1.0, 1e6];
/// Points of the front at the most.
pub(super) const FRONT: u32 = 100;
/// Samples of the tolerances where none are stated.
const SAMPLES: u32 = 20;

pub(super) fn check(s: &Source<'_>, raw: &RawOptimisation, more: &[Setting]) -> Checked<Optimisation> {
    let nothing = |what: &str, advice: &str| s.conflict(&(0..0), what, advice);
    let scene = raw
        .scene
        .as_ref()
        .ok_or_else(|| nothing("an optimisation without `scene`", "give the path of a scene file"))?;
    let document = s.named(scene, "optimisation file")?;
    let mut settings = raw.set.iter().map(|word| setting(s, word)).collect::<Checked<Vec<_>>>()?;
    settings.extend_from_slice(more);
    let own = document.scene(&settings)?;
    let mut parameters = Vec::new();
    for table in &raw.parameter {
        parameters.push(parameter(s, table, |key| own.number_at(key))?);
    }
    if parameters.is_empty() {
        parameters = default_parameters(&own)?;
    }
    let torques = torques(s, raw, own.operation.torque_nm)?;
    let sampling = Sampling {
        design: s.choice("design", &raw.design, &DESIGNS)?,
        samples: s.whole("samples", &raw.samples, SAMPLES, 1, 1_000_000)?,
        seed: u64::from(s.whole("seed", &raw.seed, SEED, 0, u32::MAX)?),
    };
    let (mut tolerances, mut kinds) = (Vec::new(), Vec::new());
    for table in &raw.tolerance {
        let (axis, kind) = vary(s, table, "[[tolerance]]", |key, class| classed(&own, key, class, Some(0.0)))?;
        if matches!(kind, Axis::Each(_)) {
            let advice = "give `mean` and `deviation`, or `from` and `to` without `count`";
            return Err(s.conflict(&table.span(), "a tolerance is drawn", advice));
        }
        tolerances.push(axis);
        kinds.push(kind);
    }
    let samples = Cases::new(kinds, &sampling).map_err(|e| {
        let table = match e {
            CasesError::NoValues { axis } | CasesError::NoDistribution { axis, .. } => raw.tolerance.get(axis),
            CasesError::TooMany { .. } => None,
        };
        s.conflict(&table.map_or(0..0, Spanned::span), e.to_string(), "see [[tolerance]] in docs/scene.md")
    })?;
    let limit = |key, value: &crate::Number| match value {
        Some(_) => s.number(key, value, 0.0, PRESSURES[0], PRESSURES[1]).map(Some),
        None => Ok(None),
    };
    let max_pressure_mpa = limit("max_pressure_mpa", &raw.max_pressure_mpa)?;
    let max_edge_pressure_mpa = limit("max_edge_pressure_mpa", &raw.max_edge_pressure_mpa)?;
    let name = raw.name.clone().unwrap_or_else(|| stem(s.file));
    finish(Optimisation {
        name,
        file: s.file.to_owned(),
        document,
        drawn: own,
        settings,
        parameters,
        torques,
        goal: goal(s, raw)?,
        max_pressure_mpa,
        max_edge_pressure_mpa,
        evaluations: s.whole("evaluations", &raw.evaluations, EVALUATIONS[0], 1, EVALUATIONS[1])?,
        front: s.whole("front", &raw.front, 0, 0, FRONT)?,
        slices: None,
        tolerances,
        sampling,
        samples,
    })
}

pub(super) fn stem(file: &Path) -> String {
    file.file_stem().map_or_else(|| "optimum".into(), |stem| stem.to_string_lossy().into_owned())
}

/// What the whole of an optimisation must be: keys are there once, and its start is a scene at rest.
///
/// # Errors
/// [`SceneError`].
pub(super) fn finish(all: Optimisation) -> Checked<Optimisation> {
    let wrong = |what: String| SceneError::Setting { label: all.file.display().to_string(), what };
    let mut keys: Vec<&str> = all.parameters.iter().flat_map(|p| &p.keys).map(String::as_str).collect();
    keys.sort_unstable();
    if let Some(twice) = keys.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(wrong(format!("changes `{}` twice", twice[0])));
    }
    let tolerated = all.tolerances.iter().flat_map(|axis| &axis.keys).map(String::as_str);
    if keys.iter().copied().chain(tolerated).any(|key| key == TORQUE) {
        return Err(wrong(format!("changes `{TORQUE}`: name torques in `torques_nm`")));
    }
    let scene = all.scene(&all.start(), all.torques[0].torque_nm, None)?;
    if scene.motion.is_some() || scene.analysis.model != crate::Model::Reduced || !scene.accuracy.is_none() {
        let what = "optimises a scene that is not one at rest with `model = \"reduced\"`";
        return Err(wrong(format!("{what}: no other model has derivatives")));
    }
    if scene.contact.method != crate::Method::Slice {
        return Err(wrong("optimises contact of points: only that of slices has derivatives".into()));
    }
    if let Some(out) = keys.iter().find(|key| !Scene::is_design_key(key)) {
        return Err(wrong(format!("changes `{out}`: micro-geometry and misalignment may change")));
    }
    for (k, parameter) in all.parameters.iter().enumerate() {
        let mut values = all.start();
        values[k] = if values[k] == parameter.bounds[0] { parameter.bounds[1] } else { parameter.bounds[0] };
        let moved = all.scene(&values, all.torques[0].torque_nm, None)?;
        if (Scene { set: Vec::new(), ..moved }) == (Scene { set: Vec::new(), ..scene.clone() }) {
            let what = format!("changes `{}`, which changes nothing: does the scene have", parameter.name());
            return Err(wrong(format!("{what} a `drive` or `coast` of its own for it?")));
        }
    }
    let numbers = all.tolerances.iter().filter(|axis| axis.pitch.is_none()).flat_map(|axis| &axis.keys);
    if let Some(key) = numbers.into_iter().find(|key| scene.number_at(key).is_none()) {
        return Err(wrong(format!("has a tolerance for `{key}`, which has no number in the scene")));
    }
    Ok(all)
}

fn parameter(
    s: &Source<'_>,
    table: &Spanned<RawParameter>,
    known: impl Fn(&str) -> Option<f64>,
) -> Checked<DesignParameter> {
    let raw = table.get_ref();
    let conflict = |what: &str, advice: &str| s.conflict(&table.span(), what, advice);
    let key = raw.key.as_ref().ok_or_else(|| conflict("[[parameter]] has no `key`", "name the key that may change"))?;
    let needed = |name: &str, value: &crate::Number| {
        value.as_ref().ok_or_else(|| conflict(&format!("[[parameter]] has no `{name}`"), "give both bounds"))?;
        s.number(name, value, 0.0, -1e300, 1e300)
    };
    let bounds = [needed("from", &raw.from)?, needed("to", &raw.to)?];
    if bounds[1] <= bounds[0] {
        return Err(conflict("`to` is not above `from`", "give a lower and a higher bound"));
    }
    let keys: Vec<String> = [key].into_iter().chain(&raw.also).map(|word| word.get_ref().clone()).collect();
    let own = known(&keys[0]).unwrap_or_else(|| if bounds[0] <= 0.0 { 0.0 } else { 0.5 * (bounds[0] + bounds[1]) });
    let start = s.number("start", &raw.start, own.clamp(bounds[0], bounds[1]), bounds[0], bounds[1])?;
    let grain = s.number("round", &raw.round, grain(&keys[0]), 0.0, 1e300)?;
    Ok(DesignParameter { keys, bounds, start, grain })
}

/// What a machine is set to.
pub(super) fn grain(key: &str) -> f64 {
    let of = [("_um", 1.0), ("_deg", 0.1), ("_mm", 0.01)];
    of.into_iter().find(|(ending, _)| key.ends_with(ending)).map_or(0.0, |(_, grain)| grain)
}

fn torques(s: &Source<'_>, raw: &RawOptimisation, own: f64) -> Checked<Vec<TorqueWeight>> {
    let list = raw.torques_nm.as_ref().map_or_else(|| vec![own], |list| list.get_ref().clone());
    let span = raw.torques_nm.as_ref().map_or(0..0, Spanned::span);
    if list.is_empty() || list.iter().any(|t| !(t.is_finite() && *t > 0.0)) {
        return Err(s.conflict(&span, "`torques_nm` holds what is no torque above 0", "give torques in N m"));
    }
    let weights = raw.weights.as_ref().map_or_else(|| vec![1.0; list.len()], |w| w.get_ref().clone());
    if weights.len() != list.len() || weights.iter().any(|w| !(w.is_finite() && *w > 0.0)) {
        let span = raw.weights.as_ref().map_or(span, Spanned::span);
        return Err(s.conflict(&span, "`weights` is not one number above 0 for each torque", "give as many weights"));
    }
    Ok(list.into_iter().zip(weights).map(|(torque_nm, weight)| TorqueWeight { torque_nm, weight }).collect())
}

/// Measures by their words.
pub(super) const MEASURES: [(&str, Measure); 3] =
    [("peak-to-peak", Measure::PeakToPeak), ("rms", Measure::Rms), ("harmonics", Measure::Harmonics(Vec::new()))];

fn goal(s: &Source<'_>, raw: &RawOptimisation) -> Checked<Goal> {
    let words: Vec<(&str, usize)> = MEASURES.iter().enumerate().map(|(i, (word, _))| (*word, i)).collect();
    let mut measure = MEASURES[s.choice("measure", &raw.measure, &words)?].1.clone();
    if let Measure::Harmonics(orders) = &mut measure {
        *orders = raw.harmonics.as_ref().map_or_else(|| vec![1], |list| list.get_ref().clone());
        let span = raw.harmonics.as_ref().map_or(0..0, Spanned::span);
        if orders.is_empty() || orders.iter().any(|&order| !(1..=1000).contains(&order)) {
            return Err(s.conflict(&span, "`harmonics` holds no orders, 1 to 1000", "as `harmonics = [1, 2]`"));
        }
    } else if let Some(list) = &raw.harmonics {
        return Err(s.conflict(&list.span(), "`harmonics` goes with `measure = \"harmonics\"`", "leave it out"));
    }
    let over = match &raw.quantile {
        None => Over::Mean,
        Some(_) if measure != Measure::PeakToPeak || raw.tolerance.is_empty() => {
            let what = "`quantile` goes with `measure = \"peak-to-peak\"` and [[tolerance]]";
            return Err(s.conflict(&(0..0), what, "leave it out"));
        }
        Some(_) => Over::WorstBeyond(s.number("quantile", &raw.quantile, 0.9, 0.0, 0.999)?),
    };
    Ok(Goal { measure, over })
}

/// Where nothing is named: tip reliefs of both gears, where they begin, and lead crowning.
pub(super) fn default_parameters(scene: &Scene) -> Checked<Vec<DesignParameter>> {
    let pair = scene.gear_pair()?;
    let module = pair.pinion.data().normal_module;
    let mut all = Vec::new();
    for (name, gear) in [("pinion", &pair.pinion), ("wheel", &pair.wheel)] {
        let key = |what: &str| vec![format!("{name}.modification.{what}")];
        all.push(DesignParameter { keys: key("tip_relief_um"), bounds: [0.0, 15.0 * module], start: 0.0, grain: 1.0 });
        let profile = gear.profile();
        let roll = |share: f64| (profile.roll_form() + share * (profile.roll_tip() - profile.roll_form())).to_degrees();
        all.push(DesignParameter {
            keys: key("tip_relief_start_roll_deg"),
            bounds: [roll(0.4), roll(0.9)],
            start: roll(0.6),
            grain: 0.1,
        });
    }
    all.push(DesignParameter {
        keys: vec!["pinion.modification.lead_crowning_um".into()],
        bounds: [0.0, 5.0 * module],
        start: 0.0,
        grain: 1.0,
    });
    Ok(all)
}

/// A measure by its word.
pub(super) fn measure(word: &str) -> Result<Measure, String> {
    let names = MEASURES.each_ref().map(|(name, _)| *name);
    let known = MEASURES.iter().find(|(name, _)| *name == word).map(|(_, measure)| measure.clone());
    known.ok_or_else(|| format!("is none; did you mean `{}`?", nearest(word, &names).unwrap_or(names[0])))
}
