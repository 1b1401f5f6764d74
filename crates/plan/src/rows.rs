//! A row a case, written down as they come: a run that is cut short goes on from there.

use std::{
    collections::BTreeMap,
    fs,
    io::{self, Write},
    path::Path,
    sync::{Mutex, MutexGuard, PoisonError},
};

use files::{Lock, most, read_regular_text};
use scene::plan::Plan;

use answer::csv::always_quoted;
use store::StoreError;
use store::folder::{beside_results, in_use};

/// What came of a case.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseRow {
    /// Number of the case, from 0.
    pub case: usize,
    /// Values of the axes.
    pub values: Vec<f64>,
    /// The numbers wanted, or why there are none.
    pub outcome: Result<Vec<f64>, String>,
}

/// How the rows of a plan are kept while its cases are solved: a line a case,
/// `case,axes..,outputs..,status,reason`.
#[derive(Debug, Clone, Copy)]
pub struct CaseLines {
    axes: usize,
    outputs: usize,
}

/// Status of a case with a result.
pub const SOLVED: &str = "solved";
/// Status of a case without a result.
pub const FAILED: &str = "failed";

impl CaseRow {
    /// Status of the case in a word.
    pub fn status(&self) -> &'static str {
        if self.outcome.is_ok() { SOLVED } else { FAILED }
    }
}

impl CaseLines {
    /// Lines of cases with so many values and numbers.
    pub fn new(axes: usize, outputs: usize) -> Self {
        Self { axes, outputs }
    }

    /// Lines of a plan's cases.
    pub fn of(plan: &Plan) -> Self {
        Self { axes: plan.axes.len(), outputs: plan.outputs.len() }
    }

    /// The row of a whole line: one that ends, and has the fields that [`CaseLines::line`] writes.
    pub fn row(&self, line: &str) -> Option<CaseRow> {
        let Self { axes, outputs } = *self;
        // Only the last field, in quotes, may hold commas.
        let fields: Vec<&str> = line.strip_suffix('\n')?.splitn(axes + outputs + 3, ',').collect();
        let (case, [status, reason]) = (fields.first()?.parse().ok()?, fields.last_chunk()?);
        let numbers = |from: usize, count: usize| -> Option<Vec<f64>> {
            fields.get(from..from + count)?.iter().map(|word| word.parse().ok()).collect()
        };
        let outcome = match *status {
            SOLVED if reason.is_empty() => Ok(numbers(1 + axes, outputs)?),
            FAILED => Err(reason.strip_prefix('"')?.strip_suffix('"')?.replace("\"\"", "\"")),
            _ => return None,
        };
        (fields.len() == axes + outputs + 3).then_some(CaseRow { case, values: numbers(1, axes)?, outcome })
    }

    /// A row as its line; numbers read back to the same bits.
    pub fn line(&self, row: &CaseRow) -> String {
        let mut line = row.case.to_string();
        let mut push = |field: &str| {
            line.push(',');
            line.push_str(field);
        };
        row.values.iter().for_each(|value| push(&value.to_string()));
        match &row.outcome {
            Ok(numbers) => numbers.iter().for_each(|number| push(&number.to_string())),
            Err(_) => (0..self.outputs).for_each(|_| push("")),
        }
        push(row.status());
        push(&row.outcome.as_ref().err().map_or_else(String::new, |why| always_quoted(why)));
        line.push('\n');
        line
    }
}

/// The cases of a plan that are done, in a file beside the results: a run that is cut short goes on from there.
///
/// The first line says which plan they belong to. A line that was cut short is none.
#[derive(Debug)]
pub struct DoneCases {
    /// None where they are kept in memory alone.
    file: Option<Mutex<Growing>>,
    lines: CaseLines,
    rows: Mutex<BTreeMap<usize, CaseRow>>,
}

/// Beginning of the first line.
const OF: &str = "# cases of ";
/// Letters of a digest.
const DIGEST: usize = 64;

/// The file while a run adds to it.
#[derive(Debug)]
struct Growing {
    lock: Lock,
    /// Bytes of whole lines.
    whole: u64,
    /// Nothing is written behind a line that was cut short.
    torn: bool,
}

impl Growing {
    fn push(&mut self, line: &str) -> io::Result<()> {
        if self.torn {
            return Err(io::Error::other("a line before was cut short"));
        }
        let mut file = self.lock.file();
        let written = file.write_all(line.as_bytes());
        match written {
            Ok(()) => self.whole += line.len() as u64,
            // Where it cannot be cut, whoever reads it does.
            Err(_) => self.torn = file.set_len(self.whole).is_err(),
        }
        written
    }
}

/// Whether a text is the first line of such a file, or what a full disk left of one.
fn is_beginning(text: &str) -> bool {
    let line = text.split_inclusive('\n').next().unwrap_or_default();
    let digest = match line.strip_prefix(OF) {
        Some(digest) => digest,
        None => return OF.starts_with(text),
    };
    let letters = digest.trim_end_matches('\n');
    letters.bytes().all(|b| b.is_ascii_hexdigit())
        && if digest.ends_with('\n') { letters.len() == DIGEST } else { letters.len() <= DIGEST }
}

impl DoneCases {
    /// In memory alone.
    pub fn in_memory(lines: CaseLines, rows: BTreeMap<usize, CaseRow>) -> Self {
        Self { file: None, lines, rows: Mutex::new(rows) }
    }

    /// Those of the plan with this digest, which goes into `out`; of another plan: none. The file is locked until the value is gone.
    ///
    /// # Errors
    /// [`StoreError::Folder`] where another run has the file or it is none of this program, else [`StoreError::Write`].
    pub fn open(out: &Path, digest: &str, lines: CaseLines) -> Result<Self, StoreError> {
        let path = beside_results(out);
        let failed = |cause: io::Error| StoreError::Write { file: path.clone(), cause };
        let foreign = || StoreError::Folder {
            folder: out.to_owned(),
            what: format!("{} holds no cases of this program", path.display()),
            hint: "cases that are done are kept there until all are: give another `--out`, or move it away",
        };
        if fs::symlink_metadata(&path).is_ok_and(|found| !found.is_file()) {
            return Err(foreign());
        }
        let lock = Lock::take(&path).map_err(failed)?.ok_or_else(|| in_use(out, &path))?;
        let text = match read_regular_text(&path, most::ROWS) {
            Err(e) if e.kind() == io::ErrorKind::InvalidData => return Err(foreign()),
            read => read.map_err(failed)?,
        };
        if !is_beginning(&text) {
            return Err(foreign());
        }
        let first = format!("{OF}{digest}\n");
        let mut rows = BTreeMap::new();
        let mut whole = 0;
        if let Some(kept) = text.strip_prefix(&first) {
            whole = first.len();
            // What was cut short, by a full disk or a power cut, and all behind it are done again.
            for line in kept.split_inclusive('\n') {
                let Some(row) = lines.row(line) else { break };
                rows.insert(row.case, row);
                whole += line.len();
            }
        }
        let mut file = lock.file();
        file.set_len(whole as u64).map_err(failed)?;
        if whole == 0 {
            if let Err(cause) = file.write_all(first.as_bytes()) {
                // There is nothing in it; that it stays is no harm.
                let _ = lock.remove();
                return Err(failed(cause));
            }
            whole = first.len();
        }
        let growing = Growing { lock, whole: whole as u64, torn: false };
        Ok(Self { file: Some(Mutex::new(growing)), lines, rows: Mutex::new(rows) })
    }

    fn rows(&self) -> MutexGuard<'_, BTreeMap<usize, CaseRow>> {
        self.rows.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Whether a case is done.
    pub fn has(&self, case: usize) -> bool {
        self.rows().contains_key(&case)
    }

    /// The row of a case, if it is done.
    pub fn row(&self, case: usize) -> Option<CaseRow> {
        self.rows().get(&case).cloned()
    }

    /// How many are.
    pub fn count(&self) -> usize {
        self.rows().len()
    }

    /// One more.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn add(&self, mut row: CaseRow) -> io::Result<()> {
        // A row is a line.
        row.outcome = row.outcome.map_err(|why| why.replace(['\n', '\r'], " "));
        if let Some(file) = &self.file {
            file.lock().unwrap_or_else(PoisonError::into_inner).push(&self.lines.line(&row))?;
        }
        self.rows().insert(row.case, row);
        Ok(())
    }

    /// All rows in the order of their cases.
    pub fn all(&self) -> Vec<CaseRow> {
        self.rows().values().cloned().collect()
    }

    /// All lines in the order of their cases.
    pub fn text(&self) -> String {
        self.rows().values().map(|row| self.lines.line(row)).collect()
    }

    /// Takes the file away: the results hold everything.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn remove(self) -> io::Result<()> {
        let file = self.file.map(|file| file.into_inner().unwrap_or_else(PoisonError::into_inner));
        file.map_or(Ok(()), |file| file.lock.remove())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ONE: &str = "0000000000000000000000000000000000000000000000000000000000000001";
    const TWO: &str = "0000000000000000000000000000000000000000000000000000000000000002";

    const LINES: CaseLines = CaseLines { axes: 1, outputs: 1 };

    fn row(case: usize) -> CaseRow {
        let outcome = if case == 2 { Err("no, \"never\"".into()) } else { Ok(vec![0.5]) };
        CaseRow { case, values: vec![case as f64], outcome }
    }

    fn line(case: usize) -> String {
        LINES.line(&row(case))
    }

    #[test]
    fn a_line_reads_back_to_its_row() {
        for case in 0..4 {
            assert_eq!(LINES.row(&line(case)), Some(row(case)));
            assert_eq!(CaseLines { axes: 2, outputs: 1 }.row(&line(case)), None, "of another plan");
        }
    }

    #[test]
    fn lines_that_were_cut_short_are_done_again() {
        let scratch = tempfile::tempdir().unwrap();
        let (out, file) = (scratch.path().join("v"), scratch.path().join("v.cases"));
        let open = |digest| DoneCases::open(&out, digest, LINES);
        let first = open(ONE).unwrap();
        (0..4).for_each(|case| first.add(row(case)).unwrap());
        assert!(open(ONE).unwrap_err().to_string().contains("another run into it is under way"));
        drop(first);
        assert_eq!(open(ONE).unwrap().count(), 4);
        let whole = fs::read_to_string(&file).unwrap();
        for (cut, count) in
            [(1, 3), (whole.len() - 2, 0), (whole.len() - 40, 0), (line(3).len(), 3), (line(3).len() + 3, 2)]
        {
            fs::write(&file, &whole[..whole.len() - cut]).unwrap();
            assert_eq!(open(ONE).unwrap().count(), count, "{cut} bytes fewer");
        }
        // Two lines that ran into each other.
        fs::write(&file, whole.replace(&line(1), &line(1)[..3])).unwrap();
        assert_eq!(open(ONE).unwrap().count(), 1);
        fs::write(&file, &whole).unwrap();
        assert_eq!(open(TWO).unwrap().count(), 0, "of another plan");
        open(TWO).unwrap().remove().unwrap();
        assert!(!file.exists());
    }

    #[test]
    fn a_file_of_somebody_else_is_left_alone() {
        let scratch = tempfile::tempdir().unwrap();
        let file = scratch.path().join("v.cases");
        for text in ["years of work", "# cases of beer\n", "# cases\n"] {
            fs::write(&file, text).unwrap();
            let error = DoneCases::open(&scratch.path().join("v"), ONE, LINES).unwrap_err();
            assert!(error.to_string().contains("holds no cases of this program"), "{text}: {error}");
            assert_eq!(fs::read_to_string(&file).unwrap(), text);
        }
    }
}
