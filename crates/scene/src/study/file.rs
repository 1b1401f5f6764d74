//! Study files: the scenes, and the figures to be drawn.

use std::path::PathBuf;

use serde::Serialize;

use crate::Scene;

/// A checked study.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// Title.
    pub name: String,
    /// Path of the file; paths in it are relative to its folder.
    pub file: PathBuf,
    /// Name and unit of the cases' value: the axis of figures over it.
    pub parameter: String,
    /// The scenes, in the order of the file.
    pub cases: Vec<StudyCase>,
    /// Values of each case: columns of the table, each with a figure over the parameter.
    pub quantities: Vec<StudyQuantity>,
    /// Figures over time, one curve per case.
    pub over_time: Vec<OverTime>,
    /// Figures of one case over mesh cycles, with correlations of every case.
    pub follow: Vec<Follow>,
    /// Run of the model with all degrees of freedom, to compare its time.
    pub full: Option<FullRun>,
}

/// A scene of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct StudyCase {
    /// Name in tables and legends.
    pub label: String,
    /// Position on the axis of the parameter.
    pub value: f64,
    /// The scene; for a rejected case the scene without the case's settings.
    pub scene: Scene,
    /// Error if the scene does not permit the values of the case. The case then has no result; other cases are not
    /// affected.
    pub refused: Option<RefusedCase>,
}

/// An error in the values of a case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RefusedCase {
    /// One line: the error, its place, and the permitted range.
    pub message: String,
    /// The line that is meant, with a mark below it.
    pub excerpt: Option<String>,
    /// Hint: what to do next.
    pub hint: Option<String>,
}

/// A value computed from a column of a case's rows.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct StudyQuantity {
    /// Column of `history.csv`.
    pub column: String,
    /// Value that is computed.
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
    /// Number of the last mesh cycles to be drawn; `None`: all.
    pub cycles: Option<u32>,
}

/// One column with others over mesh cycles, and its correlation with each of them.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Follow {
    /// Index of the case that is drawn.
    pub case: usize,
    /// Column of `history.csv`.
    pub column: String,
    /// Columns with which it is correlated.
    pub beside: Vec<String>,
    /// Number of the last mesh cycles to be drawn; `None`: all.
    pub cycles: Option<u32>,
}

/// Positions of the model with all degrees of freedom.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct FullRun {
    /// Index of the case.
    pub case: usize,
    /// Largest number of positions in a mesh cycle.
    pub positions: u32,
}

impl Study {
    /// Folder of a case's own results in the study's folder: its number and its label, letters and digits.
    pub fn folder(&self, case: usize) -> String {
        let label: String = self.cases[case].label.chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
        format!("{:02}-{}", case + 1, label.trim_matches('-'))
    }
}

impl StudyQuantity {
    /// Name with the unit in which the column's name ends.
    pub fn name(&self) -> String {
        format!("{}_{}", self.take.word(), self.column)
    }
}

impl Take {
    /// All values.
    pub const ALL: [Self; 4] = [Self::Mean, Self::PeakToPeak, Self::Least, Self::Largest];
}
