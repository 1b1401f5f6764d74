//! Reports of single cases of a plan: each a whole result, as `ale-gear run` writes it.

use std::{
    path::Path,
    sync::{Mutex, PoisonError},
};

use analysis::parallel_map;
use plan::KnownCases;
use report::plan_files::report_folder;
use scene::{Machine, plan::Plan};
use store::folder::Cache;

use super::{
    plan_case::{is_one, machine_of},
    run::write_result,
};
use crate::{certificate::Written, error::CommandError, gearbox, output::ResultDirectory, phases::Phases, talk};

/// Words that say which cases have a report of their own.
#[derive(Debug, Default, clap::Args)]
#[command(next_help_heading = "Reports of single cases")]
pub(super) struct CaseReports {
    /// Write a full result, as `ale-gear run` does, for the N best cases (smallest first output) or for `all`, linked
    /// in the report
    #[arg(long, value_name = "N|all", value_parser = how_many)]
    reports: Option<usize>,
    /// Write a full result for each of these cases, comma-separated numbers
    #[arg(long, value_name = "CASES", value_delimiter = ',')]
    report_case: Vec<usize>,
}

/// `all` as a number of cases.
const ALL: usize = usize::MAX;

fn how_many(word: &str) -> Result<usize, String> {
    if word == "all" { Ok(ALL) } else { word.parse().map_err(|_| "say a number of cases, or `all`".to_owned()) }
}

fn said(count: usize) -> String {
    if count == ALL { "all".to_owned() } else { count.to_string() }
}

impl CaseReports {
    /// Whether those of the best are asked for.
    pub(super) fn best(&self) -> bool {
        self.reports.is_some()
    }

    /// Whether cases are listed.
    pub(super) fn listed(&self) -> bool {
        !self.report_case.is_empty()
    }

    /// Whether each of so many cases, which have no order, is to have one.
    ///
    /// # Errors
    /// Exit status 2 where some are asked for.
    pub(super) fn of_all(&self, cases: usize) -> Result<bool, CommandError> {
        match self.reports {
            None | Some(0) => Ok(false),
            Some(n) if n >= cases => Ok(true),
            Some(n) => {
                let message = format_args!("`--reports {n}`: cases of a study have no order, so none of them is best");
                Err(CommandError::input(message, Some("say `--reports all`, or leave it out".into())))
            }
        }
    }

    /// Refuses numbers that are no cases.
    pub(super) fn check(&self, plan: &Plan) -> Result<(), CommandError> {
        self.report_case.iter().try_for_each(|&case| is_one(plan, case).map(|_| ()))
    }

    /// The words that ask for them again.
    pub(super) fn words(&self) -> String {
        let best = if let Some(n) = self.reports { format!(" --reports {}", said(n)) } else { String::new() };
        let list: Vec<String> = self.report_case.iter().map(usize::to_string).collect();
        if list.is_empty() { best } else { format!("{best} --report-case {}", list.join(",")) }
    }

    /// Cases that are asked for and have a result, ascending.
    fn cases(&self, known: &KnownCases) -> Vec<usize> {
        let listed = self.report_case.iter().copied().filter(|&case| known.reasons[case].is_empty());
        let mut cases: Vec<usize> = known.best().into_iter().take(self.reports.unwrap_or(0)).chain(listed).collect();
        cases.sort_unstable();
        cases.dedup();
        cases
    }

    /// Runs them into the folders of a plan's results; what comes back are the cases that have one.
    pub(super) fn write(
        &self,
        (plan, known): (&Plan, &KnownCases),
        phases: &mut Phases,
        results: &ResultDirectory,
        cache: &Cache,
    ) -> Result<Vec<usize>, CommandError> {
        let cases = self.cases(known);
        if cases.is_empty() {
            return Ok(cases);
        }
        let failed = Mutex::new(None);
        phases.run_steps("reports", cases.len() as u64, |progress| {
            parallel_map(cases.len(), |i| {
                let folder = results.path(&report_folder(cases[i]));
                let written = machine_of(plan, cases[i])
                    .and_then(|machine| write_one(&machine, &mut Phases::quiet(), &folder, cache).map(|_| ()));
                if let Err(e) = written {
                    failed.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(e);
                }
                progress.tick();
            })
        });
        failed.into_inner().unwrap_or_else(PoisonError::into_inner).map_or(Ok(cases), Err)
    }
}

/// Runs a case into a folder; the text is the closing table.
fn write_one(machine: &Machine, phases: &mut Phases, folder: &Path, cache: &Cache) -> Result<String, CommandError> {
    let own = ResultDirectory::create(folder)?;
    let (table, verdict) = match machine {
        Machine::Pair(scene) => {
            let Written { table, verdict, .. } = write_result(scene, phases, &own, cache)?;
            (table, verdict)
        }
        Machine::Gearbox(file) => gearbox::solve_whole(file, phases, &own, cache)?,
    };
    own.finish(talk::note)?;
    verdict?;
    Ok(table)
}
