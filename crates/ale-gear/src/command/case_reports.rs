//! Reports of single cases of a plan: each a whole result, as `ale-gear run` writes it.

use std::{
    path::Path,
    sync::{Mutex, PoisonError},
};

use analysis::side_by_side;
use report::{
    check_memory,
    folder::Cache,
    plan_files::{KnownCases, report_folder},
};
use scene::plan::Plan;

use super::run::write_result;
use crate::{
    error::CommandError, memory, output::ResultDirectory, phases::Phases, resolution::with_slices, scene::Scene, talk,
};

/// Words that say which cases have a report of their own.
#[derive(Debug, Default, clap::Args)]
#[command(next_help_heading = "Reports of single cases")]
pub(super) struct CaseReports {
    /// A whole result, as `ale-gear run` writes it, of the N best cases (least first output), linked in the report
    #[arg(long, value_name = "N", default_value = "0", hide_default_value = true)]
    reports: usize,
    /// The same of these cases, by their numbers with commas between
    #[arg(long, value_name = "CASES", value_delimiter = ',')]
    report_case: Vec<usize>,
}

impl CaseReports {
    /// Refuses numbers that are no cases.
    pub(super) fn check(&self, plan: &Plan) -> Result<(), CommandError> {
        self.report_case.iter().try_for_each(|&case| is_one(plan, case).map(|_| ()))
    }

    /// The words that ask for them again.
    pub(super) fn words(&self) -> String {
        let best = if self.reports > 0 { format!(" --reports {}", self.reports) } else { String::new() };
        let list: Vec<String> = self.report_case.iter().map(usize::to_string).collect();
        if list.is_empty() { best } else { format!("{best} --report-case {}", list.join(",")) }
    }

    /// Cases that are asked for and have a result, ascending.
    fn cases(&self, known: &KnownCases) -> Vec<usize> {
        let listed = self.report_case.iter().copied().filter(|&case| known.reasons[case].is_empty());
        let mut cases: Vec<usize> = known.best().into_iter().take(self.reports).chain(listed).collect();
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
            side_by_side(cases.len(), |i| {
                let folder = results.path(&report_folder(cases[i]));
                let written = scene_of(plan, cases[i])
                    .and_then(|scene| write_one(&scene, &mut Phases::quiet(), &folder, cache).map(|_| ()));
                if let Err(e) = written {
                    failed.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(e);
                }
                progress.tick();
            })
        });
        failed.into_inner().unwrap_or_else(PoisonError::into_inner).map_or(Ok(cases), Err)
    }
}

/// A case of a plan, if it is one.
fn is_one(plan: &Plan, case: usize) -> Result<usize, CommandError> {
    let count = plan.cases.count();
    if case < count {
        return Ok(case);
    }
    let hint = format!("cases are numbered from 0 to {}", count.saturating_sub(1));
    Err(CommandError::input(format_args!("{}: there is no case {case}", plan.file.display()), Some(hint)))
}

/// The scene of a case, as it is run by itself.
pub(super) fn scene_of(plan: &Plan, case: usize) -> Result<Scene, CommandError> {
    let scene = with_slices(plan.scene(is_one(plan, case)?)?);
    check_memory(&scene, memory::available_bytes())?;
    Ok(scene)
}

/// Runs the scene of a case into a folder; the text is the closing table.
pub(super) fn write_one(
    scene: &Scene,
    phases: &mut Phases,
    folder: &Path,
    cache: &Cache,
) -> Result<String, CommandError> {
    let own = ResultDirectory::create(folder)?;
    let written = write_result(scene, phases, &own, cache)?;
    own.finish(talk::note)?;
    written.verdict?;
    Ok(written.table)
}
