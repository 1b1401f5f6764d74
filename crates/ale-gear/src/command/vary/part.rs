//! Some cases of a plan into a file, for many machines; and `ale-gear merge`, which puts them together.

use std::{collections::BTreeMap, ops::Range, path::PathBuf};

use plan::{CaseLines, DoneCases, Part, PartError, check_outputs, merged, plan_digest};
use report::plan_files::{PageWords, write_cases};
use scene::{Document, plan::Plan};

use super::{super::Answer, VaryArgs, each::solve_range};
use crate::{error::CommandError, output::ResultDirectory, phases::Phases, talk};

/// Words for a part of a plan's cases.
#[derive(Debug, Default, clap::Args)]
#[command(next_help_heading = "Many machines")]
pub(super) struct PartArgs {
    /// Only these cases of a plan, e.g. `0..100` (the end is excluded; cases beyond the plan are skipped). Their rows
    /// go into the file `--out`, which is kept if it has them already
    #[arg(long, value_name = "FROM..TO", value_parser = range)]
    cases: Option<Range<usize>>,
    /// Solve nothing, but say on stdout which ranges of so many cases the plan has
    #[arg(long, value_name = "CASES", conflicts_with_all = ["cases", "out"],
          value_parser = clap::value_parser!(u32).range(1..))]
    list: Option<u32>,
}

impl PartArgs {
    /// Whether a part is asked for.
    pub(super) fn any(&self) -> bool {
        self.cases.is_some() || self.list.is_some()
    }

    /// Words, and whether they were given.
    pub(super) fn given(&self) -> [(&'static str, bool); 2] {
        [("--cases", self.cases.is_some()), ("--list", self.list.is_some())]
    }
}

/// Words of `ale-gear merge`.
#[derive(Debug, clap::Args)]
pub(in crate::command) struct MergeArgs {
    /// Plan file
    plan: PathBuf,
    /// Files of `ale-gear vary --cases` that together have all cases
    #[arg(required = true)]
    parts: Vec<PathBuf>,
    /// Folder for the results, created when they are complete
    #[arg(long, short, value_name = "DIR")]
    out: PathBuf,
}

fn range(word: &str) -> Result<Range<usize>, String> {
    let ends = word.split_once("..").and_then(|(a, b)| Some((a.trim().parse().ok()?, b.trim().parse().ok()?)));
    let (from, to): (usize, usize) = ends.ok_or("say FROM..TO, as 0..100")?;
    if from < to { Ok(from..to) } else { Err(format!("there is no case in {from}..{to}")) }
}

impl VaryArgs {
    /// Solves the cases of the range; the same words leave the same file, however often.
    pub(super) fn part(&self, quiet: bool) -> Result<Answer, CommandError> {
        self.only(&["--cases", "--list"], "a part of a plan file's cases")?;
        let told = |text: String| Answer::from(if quiet { String::new() } else { text });
        let (plan, mut phases) =
            (Plan::of(&Document::read(&self.file)?, &self.overrides.settings()?)?, Phases::with_bars());
        check_outputs(&plan).map_err(|e| CommandError::input(&e, Some(e.hint.clone())))?;
        let count = plan.cases.count();
        let (Some(range), Some(out)) = (&self.part.cases, &self.out) else {
            let chunk = self.part.list.unwrap_or(1) as usize;
            // What is asked for goes to stdout, however quiet.
            let list: String =
                (0..count).step_by(chunk).map(|a| format!("{a}..{}\n", (a + chunk).min(count))).collect();
            return Ok(list.into());
        };
        let range = range.start.min(count)..range.end.min(count);
        let digest = plan_digest(&plan);
        let (from, to) = (range.start, range.end);
        let refuse = |what: String| {
            let hint = "give the name of a new file, or take that one away".to_owned();
            Err(CommandError::input(format_args!("--out {}: {what}", out.display()), Some(hint)))
        };
        match Part::read(out, &digest) {
            Ok(part) if part.range.start <= from && to <= part.range.end => {
                return Ok(told(format!("{}: cases {from}..{to} of {count} are there\n", out.display())));
            }
            Ok(part) => return refuse(format!("has the cases {}..{} of this plan", part.range.start, part.range.end)),
            Err(PartError::AnotherPlan { .. }) => return refuse("has cases of another plan or version".to_owned()),
            Err(_) if !Part::may_replace(out) => {
                return refuse("exists and is not a file of `ale-gear vary --cases`".to_owned());
            }
            Err(_) => {}
        }
        let complain = |e: std::io::Error| CommandError::write(out, &e);
        let done = DoneCases::in_memory(CaseLines::of(&plan), BTreeMap::new());
        solve_range(&plan, range.clone(), &mut phases, &self.cache.open(), &done).map_err(complain)?;
        Part { range, text: done.text() }.write(out, &digest).map_err(complain)?;
        Ok(told(format!("{}: cases {from}..{to} of {count}\n", out.display())))
    }
}

impl MergeArgs {
    /// Puts the parts together; the files are those of `ale-gear vary`.
    pub(in crate::command) fn execute(self) -> Result<String, CommandError> {
        let (plan, phases) = (Plan::read(&self.plan)?, Phases::quiet());
        let rows = merged(&self.parts, &plan_digest(&plan), &plan).map_err(|e| {
            let hint = match &e {
                PartError::Missing { missing } => missing.first().map(|range| {
                    let (plan, from, to) = (self.plan.display(), range.start, range.end);
                    format!("make them: `ale-gear vary {plan} --cases {from}..{to} --out part-{from}.csv`")
                }),
                PartError::Read { .. } => None,
                _ => Some("take the file away and make it again with `ale-gear vary --cases`".to_owned()),
            };
            CommandError::input(&e, hint)
        })?;
        let results = ResultDirectory::create(&self.out)?;
        let parts: Vec<String> = self.parts.iter().map(|part| part.display().to_string()).collect();
        let again = format!("ale-gear merge {} {} --out DIR", self.plan.display(), parts.join(" "));
        let words = PageWords { again: &again, reports: &[] };
        let text =
            write_cases((&plan, &DoneCases::in_memory(CaseLines::of(&plan), rows)), words, phases.cost(), &results)?
                .table;
        results.finish(talk::note)?;
        Ok(format!("{text}\nresults: {}\n", self.out.display()))
    }
}
