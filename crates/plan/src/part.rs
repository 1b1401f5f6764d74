//! Parts of a plan: some of its cases in a file, to be made anywhere and merged.

use std::{
    collections::BTreeMap,
    io,
    ops::Range,
    path::{Path, PathBuf},
};

use files::{most, read_regular_text, write_file};
use scene::plan::Plan;

use crate::{CaseLines, CaseRow};

/// Cases of a plan that one process has solved.
///
/// ```text
/// # cases FROM..TO of DIGEST      which cases of which plan
/// a line a case, as in cases.csv
/// # end HASH                      of the lines above: a file that was cut short is none
/// ```
/// One plan and range make the same bytes, wherever and how often they are made.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    /// Cases FROM..TO.
    pub range: Range<usize>,
    /// Lines of the cases, in their order.
    pub text: String,
}

/// What is wrong with parts that are to be merged.
#[derive(Debug, thiserror::Error)]
pub enum PartError {
    /// A file cannot be read.
    #[error("{file} cannot be read: {source}")]
    Read {
        /// The file.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A file is no whole part.
    #[error("{file} is not a whole part of this plan: {what}")]
    NotWhole {
        /// The file.
        file: PathBuf,
        /// What is wrong.
        what: &'static str,
    },
    /// A whole part of another plan.
    #[error("{file} is not a part of this plan: plan, scene or version of the program are others")]
    AnotherPlan {
        /// The file.
        file: PathBuf,
    },
    /// Two parts have another row of the same case.
    #[error("case {case} is in two parts with other numbers, the later one {file}")]
    Differ {
        /// The case.
        case: usize,
        /// The later part.
        file: PathBuf,
    },
    /// Cases are in no part.
    #[error("cases {} are in no part", ranges(.missing))]
    Missing {
        /// Ranges of cases.
        missing: Vec<Range<usize>>,
    },
}

/// Ranges as words.
fn ranges(list: &[Range<usize>]) -> String {
    let words: Vec<String> = list.iter().take(5).map(|r| format!("{}..{}", r.start, r.end)).collect();
    words.join(", ") + if list.len() > 5 { ", ..." } else { "" }
}

impl Part {
    fn first(&self, digest: &str) -> String {
        format!("# cases {}..{} of {digest}\n", self.range.start, self.range.end)
    }

    fn last(&self, digest: &str) -> String {
        let whole = self.first(digest) + &self.text;
        format!("# end {}\n", blake3::hash(whole.as_bytes()).to_hex())
    }

    /// Writes it as a whole or not at all.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn write(&self, path: &Path, digest: &str) -> io::Result<()> {
        write_file(path, (self.first(digest) + &self.text + &self.last(digest)).as_bytes())
    }

    /// Whether a part may be written there: nothing is, or what begins as a part does.
    pub fn may_replace(path: &Path) -> bool {
        match read_regular_text(path, most::ROWS) {
            Ok(text) => text.is_empty() || text.starts_with("# cases "),
            Err(e) => e.kind() == io::ErrorKind::NotFound,
        }
    }

    /// Reads a part of the plan with this digest.
    ///
    /// # Errors
    /// [`PartError::Read`], [`PartError::NotWhole`].
    pub fn read(path: &Path, digest: &str) -> Result<Self, PartError> {
        let file = path.to_owned();
        let text =
            read_regular_text(path, most::ROWS).map_err(|source| PartError::Read { file: file.clone(), source })?;
        let not_whole = |what| PartError::NotWhole { file: file.clone(), what };
        let (first, rest) = text.split_once('\n').ok_or_else(|| not_whole("it has no lines"))?;
        let words = first.strip_prefix("# cases ").and_then(|words| words.split_once(" of "));
        let (range, of) = words.ok_or_else(|| not_whole("its first line does not say which cases it has"))?;
        if of != digest {
            return Err(PartError::AnotherPlan { file: file.clone() });
        }
        let ends = range.split_once("..").and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
        let (start, end) = ends.ok_or_else(|| not_whole("its first line does not say which cases it has"))?;
        let at = rest.rfind("# end ").ok_or_else(|| not_whole("it was cut short"))?;
        let part = Self { range: start..end, text: rest[..at].to_owned() };
        if rest[at..] != part.last(digest) {
            return Err(not_whole("it was cut short, or changed"));
        }
        Ok(part)
    }
}

/// Rows of all cases of the plan with this digest, from parts in any order; a case may be in several, with the same row.
///
/// # Errors
/// [`PartError`].
pub fn merged(files: &[PathBuf], digest: &str, plan: &Plan) -> Result<BTreeMap<usize, CaseRow>, PartError> {
    let (lines, count) = (CaseLines::of(plan), plan.cases.count());
    let mut rows: BTreeMap<usize, CaseRow> = BTreeMap::new();
    for file in files {
        let part = Part::read(file, digest)?;
        for line in part.text.split_inclusive('\n') {
            let own = lines.row(line).filter(|row| part.range.contains(&row.case) && row.case < count);
            let not_whole = PartError::NotWhole { file: file.clone(), what: "it has a line of no case of its own" };
            let row = own.ok_or(not_whole)?;
            let case = row.case;
            // As lines: a number that is none equals itself there.
            if rows.insert(case, row).is_some_and(|before| lines.line(&before) != line) {
                return Err(PartError::Differ { case, file: file.clone() });
            }
        }
    }
    let mut missing: Vec<Range<usize>> = Vec::new();
    for case in (0..count).filter(|case| !rows.contains_key(case)) {
        match missing.last_mut() {
            Some(last) if last.end == case => last.end = case + 1,
            _ => missing.push(case..case + 1),
        }
    }
    if missing.is_empty() { Ok(rows) } else { Err(PartError::Missing { missing }) }
}
