//! Checks raw values of a plan file. All errors are found here, before any work starts.

use cases::{Axis, Cases, CasesError, Design, Sampling};
use toml::Spanned;

use super::{
    AxisValues, AxisWord, PitchTolerance, Plan, PlanAxis, PlanOutput, classed,
    schema::{RawPlan, RawVary, SAMPLES, SEED},
    start::Start,
    tolerance::is_pitch,
};
use crate::{Document, SceneError, Setting, Source};

type Checked<T> = Result<T, SceneError>;

/// Designs by their words; the first one where none is written.
pub(crate) const DESIGNS: [(&str, Design); 3] =
    [("latin-hypercube", Design::LatinHypercube), ("sobol", Design::Sobol), ("random", Design::Random)];
/// What a tolerance class is of.
pub(super) const CLASSED: &str =
    "it has of profile_slope_um, profile_crowning_um, lead_slope_um, lead_crowning_um and pitch_errors_um of a gear";
pub(super) fn check(s: &Source<'_>, raw: &RawPlan, (document, more): (Document, &[Setting])) -> Checked<Plan> {
    let nothing = |what: &str, advice: &str| s.conflict(&(0..0), what, advice);
    let raw_vary = &raw.vary;
    let start: Start = s.choice_of("start", &raw_vary.start)?;
    fits(s, start, raw)?;
    if start != Start::Each {
        let span = raw_vary.start.as_ref().map_or(0..0, Spanned::span);
        let what = format!("values of this plan do not each start alone: `start = \"{}\"`", start.word());
        return Err(s.conflict(&span, what, "`ale-gear run` takes it as a whole"));
    }
    let [keys, wanted] = [&raw_vary.keys, &raw_vary.output].map(|all| all.as_deref().unwrap_or_default());
    if keys.is_empty() {
        let advice = "say keys with values: `--vary 'operation.torque_nm=50,100,200' --output peak_to_peak_ste_um`, or `keys` \
                      and `output` in [vary]";
        let (file, what) = (s.file.to_owned(), "nothing is varied".to_owned());
        return Err(SceneError::Asked { file, what, advice: advice.to_owned() });
    }
    if wanted.is_empty() {
        let advice = "name numbers: `output = [\"peak_to_peak_ste_um\", \"least(contact_line_length_mm)\"]` in [vary]";
        return Err(nothing("a plan that asks for nothing", advice));
    }
    let mut settings = raw.set.iter().flatten().map(|word| setting(s, word)).collect::<Checked<Vec<_>>>()?;
    settings.extend_from_slice(more);
    let sampling = Sampling {
        design: s.choice("design", &raw_vary.design, &DESIGNS)?,
        samples: s.whole("samples", &raw_vary.samples, SAMPLES[0], 1, SAMPLES[1])?,
        seed: u64::from(s.whole("seed", &raw_vary.seed, SEED, 0, u32::MAX)?),
    };
    let known = document.machine(&settings).ok();
    let classed = |key: &str, class: u32| {
        let known = known.as_ref()?.pair()?;
        classed(known, key, class, known.number_at(key))
    };
    let (axes, kinds) = axes(s, keys, classed)?;
    let cases = Cases::new(kinds, &sampling).map_err(|e| unfit(s, keys, &e))?;
    let output = |word: &Spanned<String>| {
        PlanOutput::parse(word.get_ref()).map_err(|what| s.conflict(&word.span(), what, OUTPUTS))
    };
    let outputs = wanted.iter().map(output).collect::<Checked<Vec<_>>>()?;
    let name = s.title(&raw.name)?;
    let file = s.file.to_owned();
    finish(Plan { name, file, document, settings, axes, sampling, cases, outputs })
}

/// Where words for numbers are told.
const OUTPUTS: &str = "a number of the headline (`peak_to_peak_ste_um`), or of a column `mean(ste_um)`, `peak_to_peak(..)`, \
                       `least(..)`, `largest(..)`, `harmonic(ste_um, 2)`";
/// Where words for keys are told.
const WORDS: &str = "say `KEY=1,2,5`, `KEY=0:40:9`, `KEY~0:40`, `KEY~normal:0:5` or `KEY~iso1328:6`";

/// The axes that words say; `classed(key, class)`: how a key deviates in a class of ISO 1328-1.
pub(crate) fn axes(
    s: &Source<'_>,
    words: &[Spanned<String>],
    classed: impl Fn(&str, u32) -> Option<Classed>,
) -> Checked<(Vec<PlanAxis>, Vec<Axis>)> {
    let one = |word: &Spanned<String>| {
        axis(word.get_ref(), &classed)
            .map_err(|what| s.conflict(&word.span(), format!("`{}`: {what}", word.get_ref()), WORDS))
    };
    let all = words.iter().map(one).collect::<Checked<Vec<_>>>()?;
    Ok(all.into_iter().unzip())
}

/// A complaint about values, at the word that it is about.
pub(crate) fn unfit(s: &Source<'_>, words: &[Spanned<String>], e: &CasesError) -> SceneError {
    let word = match e {
        CasesError::NoValues { axis } | CasesError::NoDistribution { axis, .. } => words.get(*axis),
        CasesError::TooMany { .. } => None,
    };
    s.conflict(&word.map_or(0..0, Spanned::span), fault(e), WORDS)
}

/// How a key deviates in a tolerance class: pitch deviations of a gear, and what is drawn.
pub(crate) type Classed = (Option<PitchTolerance>, Axis);

/// The axis that a word says; the error says what is wrong with it.
pub(super) fn axis(word: &str, classed: &dyn Fn(&str, u32) -> Option<Classed>) -> Result<(PlanAxis, Axis), String> {
    let AxisWord { keys, values } = AxisWord::parse(word)?;
    let pitch_errors = keys.iter().any(|key| is_pitch(key));
    let (pitch, kind) = match values {
        AxisValues::Words(words) => {
            let kind = Axis::Each((0..words.len()).map(|k| k as f64).collect());
            return Ok((PlanAxis { keys, pitch: None, words }, kind));
        }
        AxisValues::Between([from, to]) => {
            return Err(format!("say how many, as `={from}:{to}:9`, or draw them, as `~{from}:{to}`"));
        }
        AxisValues::By(_) if pitch_errors => {
            return Err("pitch errors are drawn together, within a class, as `~iso1328:6`".into());
        }
        AxisValues::By(axis) => (None, axis),
        AxisValues::Class(_) if keys.len() > 1 && pitch_errors => {
            return Err("pitch errors of each gear are drawn by a word of its own".into());
        }
        AxisValues::Class(class) => {
            let key = &keys[0];
            classed(key, class).ok_or_else(|| format!("ISO 1328 has no tolerance for `{key}`: {CLASSED}"))?
        }
    };
    Ok((PlanAxis { keys, pitch, words: Vec::new() }, kind))
}

/// What the whole of a plan must be: keys and outputs are there once, and the scene is one.
///
/// # Errors
/// [`SceneError`].
pub(super) fn finish(plan: Plan) -> Checked<Plan> {
    let mut keys: Vec<&str> = plan.axes.iter().flat_map(|axis| &axis.keys).map(String::as_str).collect();
    keys.sort_unstable();
    if let Some(twice) = keys.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(SceneError::Asked {
            file: plan.file,
            what: format!("`{}` is varied twice", twice[0]),
            advice: format!("name each key once, with all its values: `--vary {}=50,100,200`", twice[0]),
        });
    }
    let mut names: Vec<String> = plan.outputs.iter().map(PlanOutput::name).collect();
    names.sort_unstable();
    if let Some(twice) = names.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(SceneError::Asked {
            file: plan.file,
            what: format!("`{}` is asked for twice", twice[0]),
            advice: "ask for each number once".to_owned(),
        });
    }
    // A key that is none, or a scene that is wrong in all cases, is told before any work; values may be wrong in some
    // cases alone.
    let tried = |case: usize| match plan.machine(case) {
        Ok(_) | Err(SceneError::OutOfRange { .. } | SceneError::Geometry { .. }) => Ok(()),
        Err(e) => {
            plan.document.machine(&plan.settings)?;
            Err(e)
        }
    };
    tried(0)?;
    // Texts may name files: each is read once.
    for (i, axis) in plan.axes.iter().enumerate() {
        for word in 1..axis.words.len() {
            let has = |case: &usize| plan.cases.values(*case).get(i).is_some_and(|own| *own as usize == word);
            (0..plan.cases.count()).find(has).map_or(Ok(()), &tried)?;
        }
    }
    Ok(plan)
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

/// Checks that every key of `[vary]` goes with how values start.
pub(super) fn fits(s: &Source<'_>, start: Start, raw: &RawPlan) -> Result<(), SceneError> {
    const EACH: &[Start] = &[Start::Each];
    const CARRY: &[Start] = &[Start::Carry];
    let RawVary { output, design, samples, seed, of, ways, once, cycles, settle, lyapunov, .. } = &raw.vary;
    let of_list = |list: &Option<Vec<Spanned<String>>>| list.as_ref().map(|l| l.first().map_or(0..0, Spanned::span));
    let given = [
        ("output", of_list(output), EACH),
        ("design", design.as_ref().map(Spanned::span), EACH),
        ("samples", samples.as_ref().map(Spanned::span), EACH),
        ("seed", seed.as_ref().map(Spanned::span), EACH),
        ("of", of.as_ref().map(Spanned::span), CARRY),
        ("ways", of_list(ways), CARRY),
        ("once", once.as_ref().map(Spanned::span), CARRY),
        ("cycles", cycles.as_ref().map(Spanned::span), CARRY),
        ("settle", settle.as_ref().map(Spanned::span), CARRY),
        ("lyapunov", lyapunov.as_ref().map(Spanned::span), CARRY),
    ];
    for (key, span, with) in given {
        if let Some(span) = span.filter(|_| !with.contains(&start)) {
            let what = format!("`{key}` does not go with `start = \"{}\"`", start.word());
            let takes = with.first().map_or("", |own| own.word());
            return Err(s.conflict(&span, what, format!("leave it out, or write `start = \"{takes}\"`")));
        }
    }
    Ok(())
}
