//! `ale-gear case` and `ale-gear merge`: the cases of a plan on many machines, and one of them by itself.

use std::{collections::BTreeMap, ops::Range, path::PathBuf};

use report::plan_files::{DoneCases, PageWords, Part, PartError, check_outputs, merged, plan_digest, write_cases};
use scene::plan::Plan;

use super::{
    cache_args::CacheArgs,
    case_reports::{scene_of, write_one},
    vary::solve_range,
};
use crate::{error::CommandError, output::ResultDirectory, phases::Phases, talk};

/// Words of `ale-gear case`.
#[derive(Debug, clap::Args)]
pub(super) struct CaseArgs {
    /// Plan file
    plan: PathBuf,
    /// Cases, from the first to before the last: `0..100`; those beyond the plan are none
    #[arg(long, value_name = "FROM..TO", value_parser = range, required_unless_present_any = ["list", "report"],
          requires = "out")]
    range: Option<Range<usize>>,
    /// File for the rows of these cases, left alone where it has them already; with `--report` a folder
    #[arg(long, short, value_name = "PART", required_unless_present = "list")]
    out: Option<PathBuf>,
    /// Solve nothing, but say on stdout which ranges of so many cases the plan has
    #[arg(long, value_name = "CASES", conflicts_with_all = ["range", "out"],
          value_parser = clap::value_parser!(u32).range(1..))]
    list: Option<u32>,
    /// A whole result of one case, as `ale-gear run` writes it, into the folder `--out`
    #[arg(long, value_name = "CASE", conflicts_with_all = ["range", "list"], requires = "out")]
    report: Option<usize>,
    #[command(flatten)]
    cache: CacheArgs,
}

/// Words of `ale-gear merge`.
#[derive(Debug, clap::Args)]
pub(super) struct MergeArgs {
    /// Plan file
    plan: PathBuf,
    /// Files of `ale-gear case` that together have all cases
    #[arg(required = true)]
    parts: Vec<PathBuf>,
    /// Folder for the results; it appears when they are complete
    #[arg(long, short, value_name = "DIR")]
    out: PathBuf,
}

fn range(word: &str) -> Result<Range<usize>, String> {
    let ends = word.split_once("..").and_then(|(a, b)| Some((a.trim().parse().ok()?, b.trim().parse().ok()?)));
    let (from, to): (usize, usize) = ends.ok_or("say FROM..TO, as 0..100")?;
    if from < to { Ok(from..to) } else { Err(format!("there is no case in {from}..{to}")) }
}

impl CaseArgs {
    /// Solves the cases of the range; the same words leave the same file, however often.
    pub(super) fn execute(self, told: impl Fn(String) -> String) -> Result<String, CommandError> {
        let (plan, mut phases) = (Plan::read(&self.plan)?, Phases::with_bars());
        check_outputs(&plan).map_err(|e| CommandError::input(&e, Some(e.hint.clone())))?;
        if let (Some(case), Some(out)) = (self.report, &self.out) {
            let table = write_one(&scene_of(&plan, case)?, &mut phases, out, &self.cache.open())?;
            return Ok(told(format!("{table}\nresults: {}\n", out.display())));
        }
        let count = plan.cases.count();
        let (Some(range), Some(out)) = (&self.range, &self.out) else {
            let chunk = self.list.unwrap_or(1) as usize;
            // What is asked for goes to stdout, however quiet.
            return Ok((0..count).step_by(chunk).map(|a| format!("{a}..{}\n", (a + chunk).min(count))).collect());
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
                return refuse("is there, and is no file of `ale-gear case`".to_owned());
            }
            Err(_) => {}
        }
        let complain = |e: std::io::Error| CommandError::write(out, &e);
        let done = DoneCases::in_memory(&plan, BTreeMap::new());
        solve_range(&plan, range.clone(), &mut phases, &self.cache.open(), &done).map_err(complain)?;
        Part { range, text: done.text() }.write(out, &digest).map_err(complain)?;
        Ok(told(format!("{}: cases {from}..{to} of {count}\n", out.display())))
    }
}

impl MergeArgs {
    /// Puts the parts together; the files are those of `ale-gear vary`.
    pub(super) fn execute(self) -> Result<String, CommandError> {
        let (plan, phases) = (Plan::read(&self.plan)?, Phases::quiet());
        let rows = merged(&self.parts, &plan_digest(&plan), &plan).map_err(|e| {
            let hint = match &e {
                PartError::Missing { missing } => missing.first().map(|range| {
                    let (plan, from, to) = (self.plan.display(), range.start, range.end);
                    format!("make them: `ale-gear case {plan} --range {from}..{to} --out part-{from}.csv`")
                }),
                PartError::Read { .. } => None,
                _ => Some("take the file away and make it again with `ale-gear case`".to_owned()),
            };
            CommandError::input(&e, hint)
        })?;
        let results = ResultDirectory::create(&self.out)?;
        let parts: Vec<String> = self.parts.iter().map(|part| part.display().to_string()).collect();
        let again = format!("ale-gear merge {} {} --out DIR", self.plan.display(), parts.join(" "));
        let words = PageWords { again: &again, reports: &[] };
        let text = write_cases((&plan, &DoneCases::in_memory(&plan, rows)), words, phases.cost(), &results)?.table;
        results.finish(talk::note)?;
        Ok(format!("{text}\nresults: {}\n", self.out.display()))
    }
}
