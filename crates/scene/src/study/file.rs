//! The study file: which scenes, and what to draw of them.

use std::path::PathBuf;

use serde::Serialize;

use crate::Scene;

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
    /// The scene; of a refused case the one without what it sets.
    pub scene: Scene,
    /// Why the scene does not allow the values that the case sets: it has no result, and takes nothing from the others.
    pub refused: Option<RefusedCase>,
}

/// A complaint about the values of a case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RefusedCase {
    /// One line: what, where, what is allowed.
    pub message: String,
    /// The line that is meant, with a mark below it.
    pub excerpt: Option<String>,
    /// What to do next.
    pub hint: Option<String>,
}

/// A number that is read off a column of a case's rows.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct StudyQuantity {
    /// Column of `history.csv`.
    pub column: String,
    /// What is taken of it.
    pub take: Take,
}

choices! {
    /// What is taken of a column, over all rows written.
    pub enum Take {
        /// Arithmetic mean.
        Mean = "mean",
        /// Largest minus smallest.
        PeakToPeak = "peak_to_peak",
        /// Smallest.
        Least = "least",
        /// Largest.
        Largest = "largest",
    }
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
}
