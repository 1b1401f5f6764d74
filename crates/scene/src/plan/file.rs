//! A checked plan.

use std::path::{Path, PathBuf};

use cases::{Cases, Sampling};

use super::PitchTolerance;
use crate::{Document, Machine, SceneError, Setting, study::Take};

/// A pair or a gearbox, what of it is varied, and what is wanted of each case.
#[derive(Debug, Clone)]
pub struct Plan {
    /// Title.
    pub name: String,
    /// Where it stands; the path of the scene is relative to its folder.
    pub file: PathBuf,
    /// What is varied.
    pub document: Document,
    /// Keys that all cases have otherwise.
    pub settings: Vec<Setting>,
    /// What is varied.
    pub axes: Vec<PlanAxis>,
    /// How samples are spread; of no meaning where nothing is drawn.
    pub sampling: Sampling,
    /// The cases.
    pub cases: Cases,
    /// What is wanted of each.
    pub outputs: Vec<PlanOutput>,
}

/// Keys that have one value.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanAxis {
    /// At least one; the first one names the axis.
    pub keys: Vec<String>,
    /// Where it is the pitch deviations of a gear.
    pub pitch: Option<PitchTolerance>,
}

/// A number of a case.
#[derive(Debug, Clone, PartialEq)]
pub enum PlanOutput {
    /// A number of the headline of `summary.json`, by its key; parts of it behind dots, entries of lists from 0.
    Headline(String),
    /// A number that is read off a column of `history.csv`.
    Column {
        /// The column.
        column: String,
        /// What is taken of it.
        take: PlanTake,
    },
}

/// What is taken of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlanTake {
    /// Over all rows.
    Of(Take),
    /// Amplitude of a mesh harmonic, 1 ...
    Harmonic(u32),
}

impl PlanAxis {
    /// The key that it is named by.
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
        match &self.pitch {
            Some(pitch) => Ok(vec![pitch.setting(value)?]),
            None => self.keys.iter().map(|key| Setting::number(key, value)).collect(),
        }
    }
}

/// Mesh harmonics at the most.
const ORDERS: u32 = 1000;
/// Word for a mesh harmonic among what may be taken of a column.
const HARMONIC: &str = "harmonic";

impl PlanOutput {
    /// The number that a word says: a key of the headline, or `TAKE(COLUMN)`.
    ///
    /// ```text
    /// peak_to_peak_ste_um     ste_harmonics_um.1     mean(ste_um)     harmonic(ste_um, 2)
    /// ```
    ///
    /// # Errors
    /// What is wrong with it.
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
    /// The scene file.
    pub fn scene_file(&self) -> &Path {
        self.document.file()
    }

    /// The settings of a case: its keys and their values.
    ///
    /// # Errors
    /// [`SceneError::Setting`] for a key that is none.
    pub fn settings_of(&self, case: usize) -> Result<Vec<Setting>, SceneError> {
        let mut all = self.settings.clone();
        for (axis, value) in self.axes.iter().zip(self.cases.values(case)) {
            all.extend(axis.settings(value)?);
        }
        Ok(all)
    }

    /// What is told of a case, a number an axis: its value; of pitch deviations the total one of the gear, F_p, um.
    pub fn values(&self, case: usize) -> Vec<f64> {
        let told = |(axis, value): (&PlanAxis, f64)| axis.pitch.as_ref().map_or(value, |pitch| pitch.total_um(value));
        self.axes.iter().zip(self.cases.values(case)).map(told).collect()
    }

    /// The pair, or the gearbox, of a case.
    ///
    /// # Errors
    /// [`SceneError`]: what its document does not allow.
    pub fn machine(&self, case: usize) -> Result<Machine, SceneError> {
        self.document.machine(&self.settings_of(case)?)
    }
}
