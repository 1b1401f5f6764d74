//! `cases.csv`: a row a case, written as they come and put in order at the end.

use std::{
    collections::BTreeMap,
    fs,
    io::{self, Write},
    path::Path,
    sync::{Mutex, PoisonError},
};

use files::{Lock, most, read_regular_text};
use scene::plan::{Plan, PlanAxis, PlanOutput};

use crate::{
    ReportError,
    csv::always_quoted,
    folder::{beside_results, in_use},
};

/// What came of a case.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseRow {
    /// Its number, from 0.
    pub case: usize,
    /// Values of the axes.
    pub values: Vec<f64>,
    /// The numbers wanted, or why there are none.
    pub outcome: Result<Vec<f64>, String>,
}

/// The rows of a plan.
#[derive(Debug, Clone)]
pub struct CaseTable {
    header: String,
    outputs: usize,
}

impl CaseTable {
    /// Of a plan.
    pub fn of(plan: &Plan) -> Self {
        let axes = plan.axes.iter().map(PlanAxis::name).map(str::to_owned);
        let outputs = plan.outputs.iter().map(PlanOutput::name);
        let names: Vec<String> = ["case".to_owned()].into_iter().chain(axes).chain(outputs).collect();
        Self { header: names.join(",") + ",status,reason\n", outputs: plan.outputs.len() }
    }

    /// First line of the file.
    pub fn header(&self) -> &str {
        &self.header
    }

    /// The case of a whole line: one that ends, and has the fields that [`CaseTable::line`] writes.
    fn case_of(&self, line: &str) -> Option<usize> {
        // Only the last field, in quotes, may hold commas.
        let fields = self.header.matches(',').count() + 1;
        let words: Vec<&str> = line.strip_suffix('\n')?.splitn(fields, ',').collect();
        let (case, [status, reason]) = (words.first()?.parse().ok()?, words.last_chunk()?);
        let numbers = words.get(1..fields.checked_sub(2)?)?;
        let whole = match *status {
            "solved" => reason.is_empty() && numbers.iter().all(|word| word.parse::<f64>().is_ok()),
            "failed" => reason.len() >= 2 && reason.starts_with('"') && reason.ends_with('"'),
            _ => false,
        };
        (words.len() == fields && whole).then_some(case)
    }

    /// A row as its line; numbers read back to the same bits.
    pub fn line(&self, row: &CaseRow) -> String {
        let mut line = row.case.to_string();
        for value in &row.values {
            line.push_str(&format!(",{value}"));
        }
        match &row.outcome {
            Ok(numbers) => {
                for number in numbers {
                    line.push_str(&format!(",{number}"));
                }
                line.push_str(",solved,\n");
            }
            Err(why) => {
                line.push_str(&",".repeat(self.outputs));
                line.push_str(",failed,");
                line.push_str(&always_quoted(&why.replace(['\n', '\r'], " ")));
                line.push('\n');
            }
        }
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
    lines: Mutex<BTreeMap<usize, String>>,
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
    pub fn in_memory(lines: BTreeMap<usize, String>) -> Self {
        Self { file: None, lines: Mutex::new(lines) }
    }

    /// Those of the plan with this digest, which goes into `out`; of another plan: none. Lines have as many fields as
    /// those of `table`. The file is locked until the value is gone.
    ///
    /// # Errors
    /// [`ReportError::Folder`] where another run has the file or it is none of this program, else [`ReportError::Write`].
    pub fn open(out: &Path, digest: &str, table: &CaseTable) -> Result<Self, ReportError> {
        let path = beside_results(out);
        let failed = |cause: io::Error| ReportError::Write { file: path.clone(), cause };
        let foreign = || ReportError::Folder {
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
        let mut lines = BTreeMap::new();
        let mut whole = 0;
        if let Some(rows) = text.strip_prefix(&first) {
            whole = first.len();
            // What was cut short, by a full disk or a power cut, and all behind it are done again.
            for line in rows.split_inclusive('\n') {
                let Some(case) = table.case_of(line) else { break };
                lines.insert(case, line.to_owned());
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
        Ok(Self { file: Some(Mutex::new(growing)), lines: Mutex::new(lines) })
    }

    /// Whether a case is done.
    pub fn has(&self, case: usize) -> bool {
        self.lines.lock().unwrap_or_else(PoisonError::into_inner).contains_key(&case)
    }

    /// How many are.
    pub fn count(&self) -> usize {
        self.lines.lock().unwrap_or_else(PoisonError::into_inner).len()
    }

    /// One more.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn add(&self, case: usize, line: String) -> io::Result<()> {
        if let Some(file) = &self.file {
            file.lock().unwrap_or_else(PoisonError::into_inner).push(&line)?;
        }
        self.lines.lock().unwrap_or_else(PoisonError::into_inner).insert(case, line);
        Ok(())
    }

    /// All lines in the order of their cases.
    pub fn text(&self) -> String {
        self.lines.lock().unwrap_or_else(PoisonError::into_inner).values().map(String::as_str).collect()
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

    fn table() -> CaseTable {
        CaseTable { header: "case,a,b,status,reason\n".into(), outputs: 1 }
    }

    fn row(case: usize) -> String {
        let outcome = if case == 2 { Err("no, \"never\"".into()) } else { Ok(vec![0.5]) };
        table().line(&CaseRow { case, values: vec![case as f64], outcome })
    }

    #[test]
    fn lines_that_were_cut_short_are_done_again() {
        let scratch = tempfile::tempdir().unwrap();
        let (out, file) = (scratch.path().join("v"), scratch.path().join("v.cases"));
        let open = |digest| DoneCases::open(&out, digest, &table());
        let first = open(ONE).unwrap();
        (0..4).for_each(|case| first.add(case, row(case)).unwrap());
        assert!(open(ONE).unwrap_err().to_string().contains("another run into it is under way"));
        drop(first);
        assert_eq!(open(ONE).unwrap().count(), 4);
        let whole = fs::read_to_string(&file).unwrap();
        for (cut, count) in
            [(1, 3), (whole.len() - 2, 0), (whole.len() - 40, 0), (row(3).len(), 3), (row(3).len() + 3, 2)]
        {
            fs::write(&file, &whole[..whole.len() - cut]).unwrap();
            assert_eq!(open(ONE).unwrap().count(), count, "{cut} bytes fewer");
        }
        // Two lines that ran into each other.
        fs::write(&file, whole.replace(&row(1), &row(1)[..3])).unwrap();
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
            let error = DoneCases::open(&scratch.path().join("v"), ONE, &table()).unwrap_err();
            assert!(error.to_string().contains("holds no cases of this program"), "{text}: {error}");
            assert_eq!(fs::read_to_string(&file).unwrap(), text);
        }
    }
}
