//! The study file: which scenes, and what to draw of them.

use std::path::{Path, PathBuf};

use serde::Serialize;

use super::check::check;
use super::columns::ColumnsOf;
use super::raw::{RawStudy, tables};
use crate::{Scene, SceneError, Source, read_text};

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
    pub cases: Vec<StudyCase>,
    /// Numbers of each case: columns of the table, and a figure over the parameter each.
    pub quantities: Vec<StudyQuantity>,
    /// Figures over time, a curve a case.
    pub over_time: Vec<OverTime>,
    /// Figures of one case over mesh cycles, with correlations of every case.
    pub follow: Vec<Follow>,
    /// The model with every degree of freedom, for the time that it takes.
    pub full: Option<FullRun>,
}

/// A scene of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct StudyCase {
    /// Name in tables and legends.
    pub label: String,
    /// Place on the axis of the parameter.
    pub value: f64,
    /// The scene.
    pub scene: Scene,
}

/// A number that is read off a column of a case's rows.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct StudyQuantity {
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

impl Study {
    /// Reads and checks a study file and the scenes that it names; `columns` tells which columns the rows of a scene
    /// will have.
    ///
    /// # Errors
    /// [`SceneError`]: the first complaint, with its place in the study file or in a scene.
    pub fn read(file: &Path, columns: ColumnsOf<'_>) -> Result<Self, SceneError> {
        let text = read_text(file).map_err(|source| SceneError::Read { file: file.to_owned(), source })?;
        Self::parse(&text, file, columns)
    }

    /// Checks the text of a study file; `file` is what messages name and what paths are relative to.
    ///
    /// # Errors
    /// As [`Study::read`].
    pub fn parse(text: &str, file: &Path, columns: ColumnsOf<'_>) -> Result<Self, SceneError> {
        let source = Source::of(file, text, tables);
        let raw: RawStudy = toml::from_str(text).map_err(|e| source.explain(e.message(), e.span()))?;
        check(&source, raw, columns)
    }

    /// Name of the folder of a case's own results, below the study's: its number and its label, letters and digits.
    pub fn folder(&self, case: usize) -> String {
        let label: String = self.cases[case].label.chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
        format!("{:02}-{}", case + 1, label.trim_matches('-'))
    }
}

impl StudyQuantity {
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
