//! A checked plan.

use std::path::{Path, PathBuf};

use cases::{Cases, Sampling};

use super::PitchTolerance;
use crate::{Document, Machine, SceneError, Setting, study::Take};

/// A pair or a gearbox, its varied keys, and the values wanted of each case.
#[derive(Debug, Clone)]
pub struct Plan {
    /// Title.
    pub name: String,
    /// Path of the file; the path of the scene is relative to its folder.
    pub file: PathBuf,
    /// Document that is varied.
    pub document: Document,
    /// Keys that are set to other values in all cases.
    pub settings: Vec<Setting>,
    /// The varied axes.
    pub axes: Vec<PlanAxis>,
    /// Sampling method; not used if nothing is drawn.
    pub sampling: Sampling,
    /// The cases of the plan.
    pub cases: Cases,
    /// Values wanted of each case.
    pub outputs: Vec<PlanOutput>,
}

/// Keys that always have the same value.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanAxis {
    /// The keys, at least one; the first one is the name of the axis.
    pub keys: Vec<String>,
    /// Pitch tolerance, if the axis is the pitch deviations of a gear.
    pub pitch: Option<PitchTolerance>,
    /// Texts that its values count, from 0, such as names of files; none: values are numbers.
    pub words: Vec<String>,
}

/// A value of a case.
#[derive(Debug, Clone, PartialEq)]
pub enum PlanOutput {
    /// A headline value of `summary.json`, by its key as a dotted path; list entries are counted from 0.
    Headline(String),
    /// A value computed from a column of `history.csv`.
    Column {
        /// Name of the column.
        column: String,
        /// Value that is computed.
        take: PlanTake,
    },
}

/// Value computed from a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlanTake {
    /// Over all rows.
    Of(Take),
    /// Amplitude of a mesh harmonic, starting with 1.
    Harmonic(u32),
}

impl PlanAxis {
    /// The key that is its name.
    pub fn name(&self) -> &str {
        self.keys.first().map_or("", String::as_str)
    }
}

impl PlanAxis {
    /// What its keys are set to by a value of its axis.
    ///
    /// # Errors
    /// [`SceneError::Setting`] for a key that is none.
    fn settings(&self, value: f64) -> Result<Vec<Setting>, SceneError> {
        if let Some(pitch) = &self.pitch {
            return Ok(vec![pitch.setting(value)?]);
        }
        let one = |key: &String| self.word(key, value).unwrap_or_else(|| Setting::number(key, value));
        self.keys.iter().map(one).collect()
    }

    /// What a key is set to by a value that counts texts; `None` where values are numbers.
    pub(crate) fn word(&self, key: &str, value: f64) -> Option<Result<Setting, SceneError>> {
        let word = self.words.get(value as usize)?;
        Some(Setting::of(key, &toml::Value::from(word.as_str())))
    }
}

/// Mesh harmonics at the most.
const ORDERS: u32 = 1000;
/// Word for a mesh harmonic among what may be taken of a column.
const HARMONIC: &str = "harmonic";

impl PlanOutput {
    /// Parses a key of the headline, or `TAKE(COLUMN)`.
    ///
    /// ```text
    /// peak_to_peak_ste_um     ste_harmonics_um.1     mean(ste_um)     harmonic(ste_um, 2)
    /// ```
    ///
    /// # Errors
    /// A text about the error.
    pub fn parse(word: &str) -> Result<Self, String> {
        let word = word.trim();
        let Some((take, rest)) = word.split_once('(') else {
            return if word.is_empty() { Err("an empty word".into()) } else { Ok(Self::Headline(word.to_owned())) };
        };
        let inner = rest.strip_suffix(')').ok_or_else(|| format!("`{word}` has no `)` at its end"))?;
        let (column, order) = inner.split_once(',').map_or((inner, None), |(column, order)| (column, Some(order)));
        let column = column.trim().to_owned();
        let take = match (take.trim(), order) {
            (HARMONIC, order) => {
                let order = order.map_or(Ok(1), |order| order.trim().parse());
                let order = order.ok().filter(|order| (1..=ORDERS).contains(order));
                PlanTake::Harmonic(order.ok_or_else(|| format!("an order is a number, 1 to {ORDERS}"))?)
            }
            (_, Some(_)) => return Err(format!("an order goes with `{HARMONIC}(..)`")),
            (take, None) => {
                let known = Take::ALL.into_iter().find(|own| own.word() == take).map(PlanTake::Of);
                let names: Vec<&str> = Take::ALL.iter().map(|t| t.word()).chain([HARMONIC]).collect();
                let near = crate::nearest(take, &names).unwrap_or(names[0]);
                known.ok_or_else(|| format!("`{take}(..)` is taken of no column; did you mean `{near}(..)`?"))?
            }
        };
        Ok(Self::Column { column, take })
    }

    /// Name of its column in the table of cases.
    pub fn name(&self) -> String {
        match self {
            Self::Headline(key) => key.clone(),
            Self::Column { column, take: PlanTake::Of(take) } => format!("{}_{column}", take.word()),
            Self::Column { column, take: PlanTake::Harmonic(order) } => format!("harmonic_{order}_{column}"),
        }
    }
}

impl Plan {
    /// Path of the scene file.
    pub fn scene_file(&self) -> &Path {
        self.document.file()
    }

    /// The settings of a case: its keys and their values.
    ///
    /// # Errors
    /// [`SceneError::Setting`] for an unknown key.
    pub fn settings_of(&self, case: usize) -> Result<Vec<Setting>, SceneError> {
        let mut all = self.settings.clone();
        for (axis, value) in self.axes.iter().zip(self.cases.values(case)) {
            all.extend(axis.settings(value)?);
        }
        Ok(all)
    }

    /// Values of a case, one per axis; for pitch deviations the total cumulative deviation of the gear, F_p, um.
    pub fn values(&self, case: usize) -> Vec<f64> {
        let told = |(axis, value): (&PlanAxis, f64)| axis.pitch.as_ref().map_or(value, |pitch| pitch.total_um(value));
        self.axes.iter().zip(self.cases.values(case)).map(told).collect()
    }

    /// The pair or the gearbox of a case.
    ///
    /// # Errors
    /// [`SceneError`] if the document does not permit the values.
    pub fn machine(&self, case: usize) -> Result<Machine, SceneError> {
        self.document.machine(&self.settings_of(case)?)
    }
}
