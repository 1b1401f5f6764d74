//! The study file: which scenes, and what to draw of them. Every complaint is made here, before any work starts.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use toml::Spanned;

use super::columns;
use crate::scene::{Number, Run, Scene, SceneError, Setting, Source, Whole, Word};

/// Every table with its keys.
const TABLES: &[(&str, &[&str])] = &[
    ("", &["name", "parameter", "case", "quantity", "over_time", "follow", "full"]),
    ("[case]", &["scene", "set", "label", "value"]),
    ("[quantity]", &["column", "take"]),
    ("[over_time]", &["column", "cycles"]),
    ("[follow]", &["case", "column", "beside", "cycles"]),
    ("full", &["case", "positions"]),
];

fn tables() -> Vec<(String, Vec<&'static str>)> {
    TABLES.iter().map(|(name, keys)| ((*name).to_owned(), keys.to_vec())).collect()
}

/// Mesh cycles of a figure at the most.
const CYCLES: u32 = 100_000_000;

/// A checked study.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// Title.
    pub name: String,
    /// Where the file stands; paths in it are relative to its folder.
    pub file: PathBuf,
    /// What the value of a case is, with its unit: the axis of figures over it.
    pub parameter: String,
    /// The scenes, in the order of the file.
    pub cases: Vec<Case>,
    /// Numbers of each case: columns of the table, and a figure over the parameter each.
    pub quantities: Vec<Quantity>,
    /// Figures over time, a curve a case.
    pub over_time: Vec<OverTime>,
    /// Figures of one case over mesh cycles, with correlations of every case.
    pub follow: Vec<Follow>,
    /// The model with every degree of freedom, for the time that it takes.
    pub full: Option<FullRun>,
}

/// A scene of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Name in tables and legends.
    pub label: String,
    /// Place on the axis of the parameter.
    pub value: f64,
    /// The scene.
    pub scene: Scene,
}

/// A number that is read off a column of a case's rows.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Quantity {
    /// Column of `history.csv`.
    pub column: String,
    /// What is taken of it.
    pub take: Take,
}

/// What is taken of a column, over all rows written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Take {
    /// Arithmetic mean.
    Mean,
    /// Largest minus smallest.
    PeakToPeak,
    /// Smallest.
    Least,
    /// Largest.
    Largest,
}

/// One column of every case over time.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct OverTime {
    /// Column of `history.csv`.
    pub column: String,
    /// The last so many mesh cycles; `None`: all that are written.
    pub cycles: Option<u32>,
}

/// One column beside others over mesh cycles, and how nearly it follows each of them.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Follow {
    /// Number of the case that is drawn.
    pub case: usize,
    /// Column of `history.csv`.
    pub column: String,
    /// Columns that it may follow.
    pub beside: Vec<String>,
    /// The last so many mesh cycles; `None`: all that are written.
    pub cycles: Option<u32>,
}

/// Positions of the whole model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct FullRun {
    /// Number of the case.
    pub case: usize,
    /// Positions of a mesh cycle, at the most.
    pub positions: u32,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawStudy {
    name: Option<String>,
    parameter: Option<String>,
    #[serde(default)]
    case: Vec<Spanned<RawCase>>,
    #[serde(default)]
    quantity: Vec<Spanned<RawQuantity>>,
    #[serde(default)]
    over_time: Vec<Spanned<RawOverTime>>,
    #[serde(default)]
    follow: Vec<Spanned<RawFollow>>,
    full: Option<Spanned<RawFull>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawCase {
    scene: Word,
    #[serde(default)]
    set: Vec<Spanned<String>>,
    label: Option<String>,
    value: Number,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawQuantity {
    column: Word,
    take: Word,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawOverTime {
    column: Word,
    cycles: Whole,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawFollow {
    case: Word,
    column: Word,
    beside: Option<Vec<Spanned<String>>>,
    cycles: Whole,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawFull {
    case: Word,
    positions: Whole,
}

type Checked<T> = Result<T, SceneError>;

impl Study {
    /// Reads and checks a study file and the scenes that it names.
    ///
    /// # Errors
    /// [`SceneError`]: the first complaint, with its place in the study file or in a scene.
    pub fn read(file: &Path) -> Result<Self, SceneError> {
        let text =
            std::fs::read_to_string(file).map_err(|source| SceneError::Read { file: file.to_owned(), source })?;
        Self::parse(&text, file)
    }

    /// Checks the text of a study file; `file` is what messages name and what paths are relative to.
    ///
    /// # Errors
    /// As [`Study::read`].
    pub fn parse(text: &str, file: &Path) -> Result<Self, SceneError> {
        let source = Source::of(file, text, tables);
        let raw: RawStudy = toml::from_str(text).map_err(|e| source.explain(e.message(), e.span()))?;
        check(&source, raw)
    }

    /// Name of the folder of a case's own results, below the study's: its number and its label, letters and digits.
    pub fn folder(&self, case: usize) -> String {
        let label: String = self.cases[case].label.chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
        format!("{:02}-{}", case + 1, label.trim_matches('-'))
    }
}

impl Quantity {
    /// Name with the unit that the column's name ends in.
    pub fn name(&self) -> String {
        format!("{}_{}", self.take.word(), self.column)
    }
}

impl Take {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Mean, Self::PeakToPeak, Self::Least, Self::Largest];

    /// The word in study files and column names.
    pub fn word(self) -> &'static str {
        match self {
            Self::Mean => "mean",
            Self::PeakToPeak => "peak_to_peak",
            Self::Least => "least",
            Self::Largest => "largest",
        }
    }
}

fn check(s: &Source<'_>, raw: RawStudy) -> Checked<Study> {
    let mut cases: Vec<Case> = Vec::new();
    for table in &raw.case {
        let new = case(s, table)?;
        if cases.iter().any(|c| c.label == new.label) {
            let what = format!("there are two cases with the label \"{}\"", new.label);
            return Err(conflict(s, table, what, "give each a `label` of its own"));
        }
        cases.push(new);
    }
    let nothing = |what: &str, advice: &str| {
        Err(SceneError::Conflict { place: s.place(&(0..0)), what: what.into(), advice: advice.into() })
    };
    if cases.is_empty() {
        return nothing("a study without cases", "list scenes, each as [[case]] with `scene` and `value`");
    }
    if raw.quantity.is_empty() && raw.over_time.is_empty() && raw.follow.is_empty() {
        return nothing("a study that asks for nothing", "say what to draw: [[quantity]], [[over_time]], [[follow]]");
    }
    let quantities = raw.quantity.iter().map(|t| quantity(s, t, &cases)).collect::<Checked<_>>()?;
    let over_time = raw.over_time.iter().map(|t| {
        let column = column(s, t, &t.get_ref().column, &cases)?;
        Ok(OverTime { column, cycles: cycles(s, &t.get_ref().cycles)? })
    });
    let over_time = over_time.collect::<Checked<_>>()?;
    let follow = raw.follow.iter().map(|t| follow(s, t, &cases)).collect::<Checked<_>>()?;
    let full = raw.full.as_ref().map(|t| full(s, t, &cases)).transpose()?.flatten();
    let name = raw.name.unwrap_or_else(|| {
        s.file.file_stem().map_or_else(|| "study".into(), |stem| stem.to_string_lossy().into_owned())
    });
    let parameter = raw.parameter.unwrap_or_else(|| "value".into());
    Ok(Study { name, file: s.file.to_owned(), parameter, cases, quantities, over_time, follow, full })
}

fn case(s: &Source<'_>, table: &Spanned<RawCase>) -> Checked<Case> {
    let raw = table.get_ref();
    let word = raw.scene.as_ref().ok_or_else(|| missing(s, table, "[[case]]", "scene", "the path of a scene file"))?;
    if raw.value.is_none() {
        return Err(missing(s, table, "[[case]]", "value", "its place on the axis of the parameter"));
    }
    let value = s.number("value", &raw.value, 0.0, -1e300, 1e300)?;
    let path = s.file.parent().unwrap_or(Path::new("")).join(word.get_ref());
    let settings = raw.set.iter().map(|word| setting(s, word)).collect::<Checked<Vec<_>>>()?;
    let scene = Scene::read_with(&path, &settings).map_err(|e| match e {
        SceneError::Read { file, source } => {
            let what = format!("{} cannot be read: {source}", file.display());
            conflict(s, word, what, "paths are relative to the study file")
        }
        other => other,
    })?;
    if let Some(motion) = &scene.motion {
        if motion.run == Run::Sweep {
            let what = format!("{} is a sweep, which has no rows over time", path.display());
            return Err(conflict(s, word, what, "use a scene at one speed, or a ramp; a sweep draws its own figures"));
        }
        if motion.checkpoint_every_cycles.is_some_and(|every| every > 0) {
            let what = format!("{} asks for checkpoints, which a study has none of", path.display());
            return Err(conflict(s, word, what, "leave `checkpoint_every_cycles` out, or use `ale-gear run`"));
        }
    }
    Ok(Case { label: raw.label.clone().unwrap_or_else(|| scene.name.clone()), value, scene })
}

/// A key of the scene that a case sets otherwise; messages name it by its place in the study file.
fn setting(s: &Source<'_>, word: &Spanned<String>) -> Checked<Setting> {
    let place = s.place(&word.span());
    match Setting::parse(word.get_ref()) {
        Ok(setting) => Ok(setting.clone().called(&format!("{place}: set {}", setting.key()))),
        Err(SceneError::Setting { what, .. }) => Err(SceneError::Setting { label: format!("{place}: set"), what }),
        Err(other) => Err(other),
    }
}

fn quantity(s: &Source<'_>, table: &Spanned<RawQuantity>, cases: &[Case]) -> Checked<Quantity> {
    let take = s.choice("take", &table.get_ref().take, &Take::ALL.map(|t| (t.word(), t)))?;
    Ok(Quantity { column: column(s, table, &table.get_ref().column, cases)?, take })
}

fn follow(s: &Source<'_>, table: &Spanned<RawFollow>, cases: &[Case]) -> Checked<Follow> {
    let raw = table.get_ref();
    let own = column(s, table, &raw.column, cases)?;
    let Some(words) = raw.beside.as_ref().filter(|list| !list.is_empty()) else {
        return Err(missing(s, table, "[[follow]]", "beside", "a list of columns that it may follow"));
    };
    let beside = words.iter().map(|word| columns::known(s, "beside", word, cases));
    Ok(Follow {
        case: case_number(s, &raw.case, cases)?,
        column: own,
        beside: beside.collect::<Checked<_>>()?,
        cycles: cycles(s, &raw.cycles)?,
    })
}

fn full(s: &Source<'_>, table: &Spanned<RawFull>, cases: &[Case]) -> Checked<Option<FullRun>> {
    let raw = table.get_ref();
    let case = case_number(s, &raw.case, cases)?;
    let positions = s.whole("positions", &raw.positions, 1, 0, 100_000)?;
    let scene = &cases[case].scene;
    let slices = scene.analysis.model.is_reduced() && scene.contact.slices.is_some();
    if positions > 0 && !slices {
        let what = format!("the case \"{}\" has no gears with slices to reduce", cases[case].label);
        return Err(conflict(
            s,
            table,
            what,
            "name a `case` with the model \"reduced\" and the method \"slice\", or leave [full] out",
        ));
    }
    Ok((positions > 0).then_some(FullRun { case, positions }))
}

/// Number of the case with that label; the first one where none is named.
fn case_number(s: &Source<'_>, word: &Word, cases: &[Case]) -> Checked<usize> {
    let Some(word) = word else { return Ok(0) };
    let labels: Vec<(&str, usize)> = cases.iter().enumerate().map(|(i, c)| (c.label.as_str(), i)).collect();
    s.one_of("case", word, &labels)
}

fn cycles(s: &Source<'_>, value: &Whole) -> Checked<Option<u32>> {
    value.as_ref().map(|_| s.whole("cycles", value, 1, 1, CYCLES)).transpose()
}

fn column<T>(s: &Source<'_>, table: &Spanned<T>, word: &Word, cases: &[Case]) -> Checked<String> {
    match word {
        Some(word) => columns::known(s, "column", word, cases),
        None => Err(missing(s, table, "this table", "column", "the name of a column of history.csv")),
    }
}

fn missing<T>(s: &Source<'_>, table: &Spanned<T>, name: &str, key: &str, what: &str) -> SceneError {
    conflict(s, table, format!("{name} has no `{key}`"), &format!("give {what}"))
}

fn conflict<T>(s: &Source<'_>, at: &Spanned<T>, what: String, advice: &str) -> SceneError {
    SceneError::Conflict { place: s.place(&at.span()), what, advice: advice.into() }
}
