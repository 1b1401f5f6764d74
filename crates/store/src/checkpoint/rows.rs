//! Rows of `history.csv` and `energy.csv`, written as the motion goes on.

use std::{io::BufRead, path::Path};

use analysis::motion::{MotionLayout, MotionRow};
use answer::{RowStore, csv::push_row};
use scene::Scene;
use study::Columns;

use super::growing::{Growing, Kept, digested};
use crate::StoreError;
use columns::parse_columns;
use columns::{ColumnsError, ENERGY, EnergyRows, MOTION_HISTORY, MotionRows, Sheet, motion_rows};

/// Rows of a motion.
pub const HISTORY: &str = "history.csv";
/// Ledger of energy of a motion, row by row.
pub const ENERGY_FILE: &str = "energy.csv";

/// Columns that `history.csv` of a scene's motion will have, but for those of single pairs, which go with the window.
pub fn motion_column_names(scene: &Scene) -> Vec<String> {
    MOTION_HISTORY.sheet(&MotionLayout::of(scene, 0), &[]).names()
}

/// Columns of both files.
fn sheets(layout: &MotionLayout) -> (Sheet<MotionRows>, Sheet<EnergyRows>) {
    (MOTION_HISTORY.sheet(layout, &layout.pairs().collect::<Vec<_>>()), ENERGY.sheet(&(), &[]))
}

/// Rows that are read at a time.
const ROWS: usize = 2_048;

/// The rows of a run so far, from both files as far as a checkpoint kept them.
///
/// # Errors
/// When a file cannot be read or holds what is no row; [`StoreError::Table`] where there is no room for the rows.
pub fn read_rows(
    layout: &MotionLayout,
    folder: &Path,
    [history, energy]: &[Kept; 2],
) -> Result<RowStore<MotionRow>, StoreError> {
    let [of_history, of_energy] = [HISTORY, ENERGY_FILE].map(|name| folder.join(name));
    let history = CsvBlocks::new(&of_history, history.reader(&of_history)?)?;
    rows_of(layout, history, CsvBlocks::new(&of_energy, energy.reader(&of_energy)?)?)
}

/// Rows from the texts of both files, `history.csv` first; `folder` is what messages name.
///
/// # Errors
/// As [`read_rows`].
pub fn parse_rows(
    layout: &MotionLayout,
    [history, energy]: [&str; 2],
    folder: &Path,
) -> Result<RowStore<MotionRow>, StoreError> {
    let [of_history, of_energy] = [HISTORY, ENERGY_FILE].map(|name| folder.join(name));
    let history = CsvBlocks::new(&of_history, history.as_bytes())?;
    rows_of(layout, history, CsvBlocks::new(&of_energy, energy.as_bytes())?)
}

/// The rows of both files, some at a time.
fn rows_of(
    layout: &MotionLayout,
    mut history: CsvBlocks<'_, impl BufRead>,
    mut energy: CsvBlocks<'_, impl BufRead>,
) -> Result<RowStore<MotionRow>, StoreError> {
    let mut all = RowStore::default();
    loop {
        let (of_history, of_energy) = (history.next()?, energy.next()?);
        if of_history.is_empty() {
            return Ok(all);
        }
        motion_rows(layout, &of_history, &of_energy)?.into_iter().try_for_each(|row| all.push(row))?;
    }
}

/// A file with commas, some lines at a time.
struct CsvBlocks<'a, R> {
    file: &'a Path,
    reader: R,
    /// The first line.
    names: String,
}

impl<'a, R: BufRead> CsvBlocks<'a, R> {
    fn new(file: &'a Path, mut reader: R) -> Result<Self, StoreError> {
        let mut names = String::new();
        reader.read_line(&mut names).map_err(|cause| ColumnsError::Read { file: file.to_owned(), cause })?;
        Ok(Self { file, reader, names })
    }

    /// Columns of the next rows; without rows at the end.
    fn next(&mut self) -> Result<Columns, StoreError> {
        let mut text = self.names.clone();
        for _ in 0..ROWS {
            let read = self.reader.read_line(&mut text);
            let read = read.map_err(|cause| ColumnsError::Read { file: self.file.to_owned(), cause })?;
            if read == 0 {
                break;
            }
        }
        parse_columns(&text).ok_or_else(|| ColumnsError::NoNumber { file: self.file.to_owned() }.into())
    }
}

/// Both files of rows.
#[derive(Debug)]
pub struct Rows {
    layout: MotionLayout,
    sheets: (Sheet<MotionRows>, Sheet<EnergyRows>),
    history: Growing,
    energy: Growing,
    line: String,
}

impl Rows {
    /// Fresh files in a folder.
    pub fn new(layout: &MotionLayout, folder: &Path) -> Result<Self, StoreError> {
        let sheets = sheets(layout);
        let history = Growing::new(folder.join(HISTORY), &sheets.0.header())?;
        let energy = Growing::new(folder.join(ENERGY_FILE), &sheets.1.header())?;
        Ok(Self { layout: *layout, sheets, history, energy, line: String::new() })
    }

    /// Files of before, cut to what was kept of them.
    pub fn resume(layout: &MotionLayout, folder: &Path, kept: &[Kept; 2]) -> Result<Self, StoreError> {
        let [history, energy] = [folder.join(HISTORY), folder.join(ENERGY_FILE)];
        // Both are looked at before either is cut.
        let digests = (digested(&history, &kept[0])?, digested(&energy, &kept[1])?);
        Ok(Self {
            layout: *layout,
            sheets: sheets(layout),
            history: Growing::resume(history, digests.0)?,
            energy: Growing::resume(energy, digests.1)?,
            line: String::new(),
        })
    }

    /// One row of each file.
    pub fn push(&mut self, row: &MotionRow) {
        self.line.clear();
        push_row(&mut self.line, self.sheets.0.row(&self.layout, row));
        self.history.push(&self.line);
        self.line.clear();
        push_row(&mut self.line, self.sheets.1.row(&(), &row.energy));
        self.energy.push(&self.line);
    }

    /// Writes out what is held back; what a checkpoint keeps of both files.
    pub fn flush(&mut self) -> Result<[Kept; 2], StoreError> {
        Ok([self.history.flush()?, self.energy.flush()?])
    }
}
