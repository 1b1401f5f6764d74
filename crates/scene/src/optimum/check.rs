//! Checks raw values of an optimisation file.

use cases::{Axis, Cases, Sampling};
use design::{Goal, Measure, Over};
use toml::Spanned;

use super::{
    DesignParameter, Optimisation, TorqueWeight,
    file::TORQUE,
    schema::{EVALUATIONS, FRONT, PRESSURES, RawOptimisation, RawOptimise, SAMPLES},
    words::parameter,
};
use crate::{
    Document, Scene, SceneError, Setting, Source, nearest,
    plan::{DESIGNS, PlanAxis, SEED, axes, classed, setting, unfit},
};

type Checked<T> = Result<T, SceneError>;

pub(super) fn check(
    s: &Source<'_>,
    raw: &RawOptimisation,
    (document, more): (Document, &[Setting]),
) -> Checked<Optimisation> {
    let asked = &raw.optimise;
    if let Some(limit) = words(&asked.limit).first() {
        let advice = "name a `goal`, a number of the headline, or use `max_pressure_mpa`";
        return Err(s.conflict(&limit.span(), "`limit` goes with `goal`", advice));
    }
    let settings = settings(s, raw, more)?;
    let own = document.scene(&settings)?;
    let mut parameters = parameters(s, asked, |key| own.number_at(key))?;
    if parameters.is_empty() {
        parameters = default_parameters(&own)?;
    }
    let torques = torques(s, asked, own.operation.torque_nm)?;
    let sampling = Sampling {
        design: s.choice("design", &asked.design, &DESIGNS)?,
        samples: s.whole("samples", &asked.samples, SAMPLES[0], 1, SAMPLES[1])?,
        seed: u64::from(s.whole("seed", &asked.seed, SEED, 0, u32::MAX)?),
    };
    let (tolerances, kinds) = axes(s, words(&asked.tolerances), |key, class| classed(&own, key, class, Some(0.0)))?;
    let given = |(axis, kind): (&PlanAxis, &Axis)| matches!(kind, Axis::Each(_)) && axis.words.is_empty();
    if let Some(k) = tolerances.iter().zip(&kinds).position(given) {
        return Err(s.conflict(
            &words(&asked.tolerances)[k].span(),
            "a tolerance is drawn",
            "as `KEY~normal:0:5`, `KEY~-5:5`; files of measured gears are listed, as `KEY=a.csv,b.csv`",
        ));
    }
    let samples = Cases::new(kinds, &sampling).map_err(|e| unfit(s, words(&asked.tolerances), &e))?;
    let limit = |key, value: &crate::Number| match value {
        Some(_) => s.number(key, value, 0.0, PRESSURES[0], PRESSURES[1]).map(Some),
        None => Ok(None),
    };
    let max_pressure_mpa = limit("max_pressure_mpa", &asked.max_pressure_mpa)?;
    let max_edge_pressure_mpa = limit("max_edge_pressure_mpa", &asked.max_edge_pressure_mpa)?;
    let name = s.title(&raw.name)?;
    finish(Optimisation {
        name,
        file: s.file.to_owned(),
        document,
        drawn: own,
        settings,
        parameters,
        torques,
        goal: goal(s, asked)?,
        max_pressure_mpa,
        max_edge_pressure_mpa,
        evaluations: s.whole("evaluations", &asked.evaluations, EVALUATIONS[0], 1, EVALUATIONS[1])?,
        front: s.whole("front", &asked.front, 0, 0, FRONT)?,
        slices: None,
        tolerances,
        sampling,
        samples,
    })
}

/// What the whole of an optimisation must be: keys are there once, and its start is a scene at rest.
///
/// # Errors
/// [`SceneError`].
pub(super) fn finish(all: Optimisation) -> Checked<Optimisation> {
    let wrong =
        |what: String, advice: &str| SceneError::Asked { file: all.file.clone(), what, advice: advice.to_owned() };
    let mut keys: Vec<&str> = all.parameters.iter().flat_map(|p| &p.keys).map(String::as_str).collect();
    keys.sort_unstable();
    if let Some(twice) = keys.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(wrong(format!("changes `{}` twice", twice[0]), "name each key once, with one pair of bounds"));
    }
    let tolerated = all.tolerances.iter().flat_map(|axis| &axis.keys).map(String::as_str);
    if keys.iter().copied().chain(tolerated).any(|key| key == TORQUE) {
        let advice = "list the torques that count: `--torques 75,150,225`, or `torques_nm` in [optimise]";
        return Err(wrong(format!("changes `{TORQUE}`"), advice));
    }
    let scene = all.scene(&all.start(), all.torques[0].torque_nm, None)?;
    if scene.motion.is_some() || scene.analysis.model != crate::Model::Reduced || !scene.accuracy.is_none() {
        let what = "optimises a scene that is not one at rest with `model = \"reduced\"`";
        let advice = "leave [motion] and [accuracy] out and say `model = \"reduced\"`; numbers of any other model are optimised \
                      with `--goal`, as `--goal peak_to_peak_ste_um`";
        return Err(wrong(format!("{what}: no other model has derivatives"), advice));
    }
    if scene.contact.method != crate::Method::Slice {
        let what = "optimises contact of points: only that of slices has derivatives";
        return Err(wrong(what.into(), "say `method = \"slice\"` in [contact]"));
    }
    if let Some(out) = keys.iter().find(|key| !Scene::is_design_key(key)) {
        let advice = format!(
            "add a goal of the headline, as `--goal peak_to_peak_ste_um`: then any key of a real number may change; values of a \
             whole number are listed: `ale-gear vary {} --out DIR --vary {out}=A,B,C`",
            all.file.display()
        );
        let what = "without `--goal` micro-geometry and misalignment alone may change";
        return Err(wrong(format!("changes `{out}`: {what}"), &advice));
    }
    for (k, parameter) in all.parameters.iter().enumerate() {
        let mut values = all.start();
        values[k] = if values[k] == parameter.bounds[0] { parameter.bounds[1] } else { parameter.bounds[0] };
        let moved = all.scene(&values, all.torques[0].torque_nm, None)?;
        if (Scene { set: Vec::new(), ..moved }) == (Scene { set: Vec::new(), ..scene.clone() }) {
            let advice =
                "name a key that acts: a modification of a `drive` or `coast` flank acts in place of that of the gear";
            return Err(wrong(format!("changes `{}`, which changes nothing", parameter.name()), advice));
        }
    }
    let numbers = all.tolerances.iter().filter(|axis| axis.pitch.is_none() && axis.words.is_empty());
    let numbers = numbers.flat_map(|axis| &axis.keys);
    if let Some(key) = numbers.into_iter().find(|key| scene.number_at(key).is_none()) {
        let advice = "give the key its nominal value in the scene, or leave the tolerance out";
        return Err(wrong(format!("has a tolerance for `{key}`, which has no number in the scene"), advice));
    }
    Ok(all)
}

/// Words of a list; none where it is not written.
pub(super) fn words(list: &Option<Vec<Spanned<String>>>) -> &[Spanned<String>] {
    list.as_deref().unwrap_or_default()
}

/// What an optimisation sets beside its document.
pub(super) fn settings(s: &Source<'_>, raw: &RawOptimisation, more: &[Setting]) -> Checked<Vec<Setting>> {
    let mut settings = raw.set.iter().flatten().map(|word| setting(s, word)).collect::<Checked<Vec<_>>>()?;
    settings.extend_from_slice(more);
    Ok(settings)
}

/// What may change, with starts and roundings of their own.
pub(super) fn parameters(
    s: &Source<'_>,
    raw: &RawOptimise,
    known: impl Fn(&str) -> Option<f64>,
) -> Checked<Vec<DesignParameter>> {
    let one = |word: &Spanned<String>| {
        parameter(word.get_ref(), &known).map_err(|what| s.conflict(&word.span(), what, "as `KEY=FROM:TO`"))
    };
    let mut all = words(&raw.keys).iter().map(one).collect::<Checked<Vec<_>>>()?;
    for word in words(&raw.start) {
        let (k, value) = number_of(s, word, &all)?;
        let [low, high] = all[k].bounds;
        if !(low..=high).contains(&value) {
            return Err(s.conflict(
                &word.span(),
                format!("{value} is not within {low} .. {high}"),
                "start within the bounds",
            ));
        }
        (all[k].start, all[k].outside) = (value, None);
    }
    for word in words(&raw.round) {
        let (k, value) = number_of(s, word, &all)?;
        if value < 0.0 {
            return Err(s.conflict(&word.span(), "a grain below 0", "give one above 0, or 0 for any value"));
        }
        all[k].grain = value;
    }
    Ok(all)
}

/// Which parameter `KEY=NUMBER` is about, and the number.
fn number_of(s: &Source<'_>, word: &Spanned<String>, all: &[DesignParameter]) -> Checked<(usize, f64)> {
    let wrong = |what: String| s.conflict(&word.span(), what, "as `KEY=24.5`, the key one of `keys`");
    let (key, value) = word.get_ref().split_once('=').ok_or_else(|| wrong("it has no `=`".into()))?;
    let key = key.trim();
    let place = all.iter().position(|p| p.keys.iter().any(|own| own == key));
    let place = place.ok_or_else(|| wrong(format!("`{key}` may not change")))?;
    let value = value.trim().parse::<f64>().ok().filter(|x| x.is_finite());
    Ok((place, value.ok_or_else(|| wrong("no number behind `=`".into()))?))
}

/// Numbers of a list without their places.
fn plain(list: &Spanned<Vec<Spanned<f64>>>) -> Vec<f64> {
    list.get_ref().iter().map(|x| *x.get_ref()).collect()
}

fn torques(s: &Source<'_>, raw: &RawOptimise, own: f64) -> Checked<Vec<TorqueWeight>> {
    let list = raw.torques_nm.as_ref().map_or_else(|| vec![own], plain);
    let span = raw.torques_nm.as_ref().map_or(0..0, Spanned::span);
    if list.is_empty() || list.iter().any(|t| !(t.is_finite() && *t > 0.0)) {
        return Err(s.conflict(&span, "`torques_nm` holds what is not a torque above 0", "give torques in N m"));
    }
    let weights = raw.weights.as_ref().map_or_else(|| vec![1.0; list.len()], plain);
    if weights.len() != list.len() || weights.iter().any(|w| !(w.is_finite() && *w > 0.0)) {
        let span = raw.weights.as_ref().map_or(span, Spanned::span);
        return Err(s.conflict(&span, "`weights` is not one number above 0 for each torque", "give as many weights"));
    }
    Ok(list.into_iter().zip(weights).map(|(torque_nm, weight)| TorqueWeight { torque_nm, weight }).collect())
}

/// Measures by their words.
pub(super) const MEASURES: [(&str, Measure); 3] =
    [("peak-to-peak", Measure::PeakToPeak), ("rms", Measure::Rms), ("harmonics", Measure::Harmonics(Vec::new()))];

fn goal(s: &Source<'_>, raw: &RawOptimise) -> Checked<Goal> {
    let known: Vec<(&str, usize)> = MEASURES.iter().enumerate().map(|(i, (word, _))| (*word, i)).collect();
    let mut measure = MEASURES[s.choice("measure", &raw.measure, &known)?].1.clone();
    if let Measure::Harmonics(orders) = &mut measure {
        // What is no order of a harmonic is 0, which is none.
        let order = |order: &i64| u32::try_from(*order).unwrap_or(0);
        *orders = raw.harmonics.as_ref().map_or_else(|| vec![1], |list| list.get_ref().iter().map(order).collect());
        let span = raw.harmonics.as_ref().map_or(0..0, Spanned::span);
        if orders.is_empty() || orders.iter().any(|&order| !(1..=1000).contains(&order)) {
            return Err(s.conflict(&span, "`harmonics` holds no orders, 1 to 1000", "as `harmonics = [1, 2]`"));
        }
    } else if let Some(list) = &raw.harmonics {
        return Err(s.conflict(&list.span(), "`harmonics` goes with `measure = \"harmonics\"`", "leave it out"));
    }
    let over = match &raw.quantile {
        None => Over::Mean,
        Some(_) if measure != Measure::PeakToPeak || words(&raw.tolerances).is_empty() => {
            let what = "`quantile` goes with `measure = \"peak-to-peak\"` and `tolerances`";
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
    // From the scene's own value on, as parameters that are named.
    let own = |key: String, bounds: [f64; 2], usual: f64, grain: f64| {
        let stated = scene.number_at(&key);
        let start = stated.unwrap_or(usual).clamp(bounds[0], bounds[1]);
        DesignParameter { keys: vec![key], bounds, start, outside: stated.filter(|own| *own != start), grain }
    };
    let mut all = Vec::new();
    for (name, gear) in [("pinion", &pair.pinion), ("wheel", &pair.wheel)] {
        let key = |what: &str| format!("{name}.modification.{what}");
        all.push(own(key("tip_relief_um"), [0.0, 15.0 * module], 0.0, 1.0));
        let profile = gear.profile();
        let roll = |share: f64| (profile.roll_form() + share * (profile.roll_tip() - profile.roll_form())).to_degrees();
        all.push(own(key("tip_relief_start_roll_deg"), [roll(0.4), roll(0.9)], roll(0.6), 0.1));
    }
    all.push(own("pinion.modification.lead_crowning_um".into(), [0.0, 5.0 * module], 0.0, 1.0));
    Ok(all)
}

/// A measure by its word.
pub(super) fn measure(word: &str) -> Result<Measure, String> {
    let names = MEASURES.each_ref().map(|(name, _)| *name);
    let known = MEASURES.iter().find(|(name, _)| *name == word).map(|(_, measure)| measure.clone());
    known.ok_or_else(|| format!("is none; did you mean `{}`?", nearest(word, &names).unwrap_or(names[0])))
}
