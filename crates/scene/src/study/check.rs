//! Checks raw values of a study file. All errors are found here, before any work starts.

use toml::Spanned;

use super::columns::{self, ColumnsOf};
use super::file::{Follow, FullRun, OverTime, RefusedCase, Study, StudyCase, StudyQuantity};
use super::schema::{CASE, FOLLOW, FULL, RawCase, RawFollow, RawFull, RawQuantity, RawStudy};
use crate::{Place, Run, SceneError, Setting, Source, Whole, Word};

type Checked<T> = Result<T, SceneError>;
/// The cases so far, and which columns their rows will have.
type Known<'a> = (&'a [StudyCase], ColumnsOf<'a>);

/// Cases of a study at the most: each is a run.
const CASES: usize = 1000;
/// Keys that a case sets at the most; a scene has a third of them.
const SETTINGS: usize = 1000;

pub(super) fn check(s: &Source<'_>, raw: RawStudy, settings: &[Setting], columns: ColumnsOf<'_>) -> Checked<Study> {
    if let Some(table) = raw.case.get(CASES) {
        let what = format!("a study of {} cases", raw.case.len());
        return Err(s.conflict(&table.span(), what, format!("list {CASES} at the most")));
    }
    let mut cases: Vec<StudyCase> = Vec::new();
    for table in &raw.case {
        let new = case(s, table, settings)?;
        if cases.iter().any(|c| c.label == new.label) {
            let what = format!("there are two cases with the label \"{}\"", new.label);
            return Err(s.conflict(&table.span(), what, "give each a `label` of its own"));
        }
        cases.push(new);
    }
    has_effect(&raw.case, settings)?;
    let nothing = |what: &str, advice: &str| Err(s.conflict(&(0..0), what, advice));
    if cases.is_empty() {
        return nothing("a study without cases", "list scenes, each as [[case]] with `scene` and `value`");
    }
    if raw.quantity.is_empty() && raw.over_time.is_empty() && raw.follow.is_empty() {
        return nothing("a study that asks for nothing", "say what to draw: [[quantity]], [[over_time]], [[follow]]");
    }
    let known = (&cases[..], columns);
    let quantities = raw.quantity.iter().map(|t| quantity(s, t, known)).collect::<Checked<_>>()?;
    let over_time = raw.over_time.iter().map(|t| {
        let column = column(s, t, &t.get_ref().column, known)?;
        Ok(OverTime { column, cycles: cycles(s, &t.get_ref().cycles)? })
    });
    let over_time = over_time.collect::<Checked<_>>()?;
    let follow = raw.follow.iter().map(|t| follow(s, t, known)).collect::<Checked<_>>()?;
    let full = raw.full.as_ref().map(|t| full(s, t, &cases)).transpose()?.flatten();
    let name = s.title(&raw.name)?;
    let parameter = raw.parameter.map_or_else(|| "value".into(), Spanned::into_inner);
    Ok(Study { name, file: s.file.to_owned(), parameter, cases, quantities, over_time, follow, full })
}

/// Refuses a setting of all scenes that no scene follows, since every case sets its key itself.
fn has_effect(cases: &[Spanned<RawCase>], settings: &[Setting]) -> Checked<()> {
    let sets = |case: &Spanned<RawCase>, key: &str| {
        let own = case.get_ref().set.iter().flatten().filter_map(|word| Setting::parse(word.get_ref()).ok());
        own.into_iter().any(|own| own.key() == key)
    };
    let idle = |setting: &&Setting| !cases.is_empty() && cases.iter().all(|case| sets(case, setting.key()));
    settings.iter().find(idle).map_or(Ok(()), |setting| {
        let place = Place::Setting { label: setting.label().into() };
        let what = format!("every case of the study sets `{}` itself", setting.key());
        Err(SceneError::Conflict { place, what, advice: "leave it out, or change `set` of the cases".into() })
    })
}

fn case(s: &Source<'_>, table: &Spanned<RawCase>, settings: &[Setting]) -> Checked<StudyCase> {
    let raw = table.get_ref();
    let word = raw.scene.as_ref().ok_or_else(|| missing(s, table, "[[case]]", "scene", "the path of a scene file"))?;
    if raw.value.is_none() {
        return Err(missing(s, table, "[[case]]", "value", "its place on the axis of the parameter"));
    }
    let value = s.number_of(&CASE, "value", &raw.value)?;
    let set = raw.set.as_deref().unwrap_or_default();
    if let Some(word) = set.get(SETTINGS) {
        let what = format!("a case sets {} keys", set.len());
        return Err(s.conflict(&word.span(), what, format!("set {SETTINGS} at the most")));
    }
    let own = set.iter().map(|word| setting(s, word)).collect::<Checked<Vec<_>>>()?;
    let document = s.document(word, "study file")?;
    let (scene, refused) = match document.scene(&[settings, &own].concat()) {
        Ok(scene) => (scene, None),
        // A value may be wrong in one case alone; a scene that is wrong without it is wrong in all.
        Err(e @ (SceneError::OutOfRange { .. } | SceneError::Geometry { .. })) if !own.is_empty() => {
            (document.scene(settings)?, Some(refusal(&e)))
        }
        Err(e) => return Err(e),
    };
    if let Some(motion) = &scene.motion {
        let which = match motion.run {
            Run::Sweep => Some("sweep"),
            Run::Continuation => Some("continuation"),
            Run::Basins => Some("search for basins"),
            _ => None,
        };
        if let Some(which) = which {
            let what = format!("{} is a {which}, which has no rows over time", document.file().display());
            return Err(s.conflict(
                &word.span(),
                what,
                "use a scene at one speed, or a ramp; sweeps, continuations and basins draw their own figures",
            ));
        }
        if motion.checkpoint_every_cycles.is_some_and(|every| every > 0) {
            let what = format!("{} asks for checkpoints, which a study has none of", document.file().display());
            return Err(s.conflict(&word.span(), what, "leave `checkpoint_every_cycles` out, or use `ale-gear run`"));
        }
    }
    Ok(StudyCase {
        label: raw.label.as_ref().map_or_else(|| scene.name.clone(), |label| label.get_ref().clone()),
        value,
        scene,
        refused,
    })
}

fn refusal(e: &SceneError) -> RefusedCase {
    RefusedCase { message: e.to_string(), excerpt: e.excerpt().map(str::to_owned), hint: e.hint() }
}

/// A key of a scene that another file sets otherwise; messages name it by its place in that file.
pub(crate) fn setting(s: &Source<'_>, word: &Spanned<String>) -> Checked<Setting> {
    let place = s.place(&word.span());
    match Setting::parse(word.get_ref()) {
        Ok(setting) => Ok(setting.clone().called(&format!("{place}: set {}", setting.key()))),
        Err(SceneError::Setting { what, .. }) => Err(SceneError::Setting { label: format!("{place}: set"), what }),
        Err(other) => Err(other),
    }
}

fn quantity(s: &Source<'_>, table: &Spanned<RawQuantity>, known: Known<'_>) -> Checked<StudyQuantity> {
    let take = s.choice_of("take", &table.get_ref().take)?;
    Ok(StudyQuantity { column: column(s, table, &table.get_ref().column, known)?, take })
}

fn follow(s: &Source<'_>, table: &Spanned<RawFollow>, known: Known<'_>) -> Checked<Follow> {
    let raw = table.get_ref();
    let own = column(s, table, &raw.column, known)?;
    let Some(words) = raw.beside.as_ref().filter(|list| !list.is_empty()) else {
        return Err(missing(s, table, "[[follow]]", "beside", "a list of columns that it may follow"));
    };
    let beside = words.iter().map(|word| columns::known(s, "beside", word, known));
    Ok(Follow {
        case: case_number(s, &raw.case, known.0)?,
        column: own,
        beside: beside.collect::<Checked<_>>()?,
        cycles: cycles(s, &raw.cycles)?,
    })
}

fn full(s: &Source<'_>, table: &Spanned<RawFull>, cases: &[StudyCase]) -> Checked<Option<FullRun>> {
    let raw = table.get_ref();
    let case = case_number(s, &raw.case, cases)?;
    let positions = s.whole_of(&FULL, "positions", &raw.positions)?;
    let scene = &cases[case].scene;
    let slices = scene.analysis.model.has_reduced_gears() && scene.contact.slices.is_some();
    if positions > 0 && !slices {
        let what = format!("the case \"{}\" has no gears with slices to reduce", cases[case].label);
        return Err(s.conflict(
            &table.span(),
            what,
            "name a `case` with the model \"reduced\" and the method \"slice\", or leave [full] out",
        ));
    }
    Ok((positions > 0).then_some(FullRun { case, positions }))
}

/// Number of the case with that label; the first one where none is named.
fn case_number(s: &Source<'_>, word: &Word, cases: &[StudyCase]) -> Checked<usize> {
    let Some(word) = word else { return Ok(0) };
    let labels: Vec<(&str, usize)> = cases.iter().enumerate().map(|(i, c)| (c.label.as_str(), i)).collect();
    s.one_of("case", word, &labels)
}

fn cycles(s: &Source<'_>, value: &Whole) -> Checked<Option<u32>> {
    value.as_ref().map(|_| s.whole_of(&FOLLOW, "cycles", value)).transpose()
}

fn column<T>(s: &Source<'_>, table: &Spanned<T>, word: &Word, known: Known<'_>) -> Checked<String> {
    match word {
        Some(word) => columns::known(s, "column", word, known),
        None => Err(missing(s, table, "this table", "column", "the name of a column of history.csv")),
    }
}

fn missing<T>(s: &Source<'_>, table: &Spanned<T>, name: &str, key: &str, what: &str) -> SceneError {
    s.conflict(&table.span(), format!("{name} has no `{key}`"), format!("give {what}"))
}
