//! `ale-gear study`: several scenes in, the same figures of all out.

use std::path::PathBuf;

use analysis::{
    SharedModels,
    accuracy_chart::{SpeedUp, speed_up},
    parameter_study::{Findings, findings},
    resolution::with_slices,
};
use report::study_files::{StudyResult, columns_of, study_answer, study_digest, study_page, study_warnings};
use scene::study::Study;

use super::{cache_args::CacheArgs, overrides::Overrides, run::write_result};
use report::{check_memory, folder::KeptCases, write_summary, write_tables_and_page};

use crate::{
    chart::ProcessMemory,
    error::CommandError,
    memory,
    output::{CASES, ResultDirectory},
    phases::Phases,
    scene::SceneError,
    study_cases::{CaseRunner, run_cases},
    talk,
};

/// Words of `ale-gear study`.
#[derive(Debug, clap::Args)]
pub(super) struct StudyArgs {
    /// Study file
    study: PathBuf,
    /// Folder for the results; it appears when they are complete
    #[arg(long, short, value_name = "DIR")]
    out: PathBuf,
    /// A whole result of every case, with a report and a view of its own, as `ale-gear run` writes it
    #[arg(long)]
    reports: bool,
    #[command(flatten)]
    overrides: Overrides,
    #[command(flatten)]
    cache: CacheArgs,
}

impl StudyArgs {
    /// Every complaint about the words and about all files is made here, before any work starts or any file is written.
    fn plan(&self) -> Result<Study, CommandError> {
        let settings = self.overrides.settings()?;
        let mut study = Study::read(&self.study, &settings, &columns_of).map_err(|e| match &e {
            SceneError::Read { .. } => CommandError::input(
                &e,
                Some("`ale-gear study STUDY.toml --out DIR` wants the path of a study file".into()),
            ),
            _ => e.into(),
        })?;
        for case in &mut study.cases {
            case.scene = with_slices(case.scene.clone());
        }
        let free = memory::available_bytes();
        study.cases.iter().try_for_each(|case| check_memory(&case.scene, free))?;
        Ok(study)
    }

    /// Runs the study; the text is the closing table.
    pub(super) fn execute(self) -> Result<String, CommandError> {
        let mut phases = Phases::with_bars();
        let study = self.plan()?;
        let results = ResultDirectory::create(&self.out)?;
        let cache = self.cache.open();
        let kept = KeptCases::beside(&self.out, &study_digest(&study, self.reports))?;
        let runs = phases.run_steps("cases", study.cases.len() as u64, |progress| {
            let models = SharedModels::new(&cache);
            let alone = |scene: &_, own: &_| write_result(scene, &mut Phases::quiet(), own, &cache);
            let runner = CaseRunner { models: &models, alone: &alone, reports: self.reports };
            run_cases(&study, &kept, runner, &|case| {
                progress.say(case.label.clone());
                progress.tick();
            })
        });
        let records: Vec<_> = runs.iter().map(|r| r.as_ref().map(|r| &r.record).map_err(|m| &m.failure)).collect();
        let folders: Vec<String> = (0..study.cases.len()).map(|i| study.folder(i)).collect();
        let findings = match findings(&study, &records) {
            Ok(findings) => findings,
            Err(e) => {
                kept.remove_if_empty();
                return Err(e.into());
            }
        };
        let mut warnings = study_warnings(&study, &runs, &findings);
        let speed_up = against_full(&study, &findings, &mut phases).unwrap_or_else(|said| {
            warnings.push(analysis::remark::study_said(said));
            None
        });
        let of = StudyResult {
            study: &study,
            runs: &runs,
            findings: &findings,
            speed_up: speed_up.as_ref(),
            warnings: &warnings,
            reports: self.reports,
        };
        let answer = study_answer(of, phases.cost());
        let table = write_tables_and_page(&answer, &study_page(of, &answer)?, false, &results)?;
        // Cases stay where they are until all else is written. Last of all the summary: it means that everything is there.
        kept.move_into(&results.path(CASES), folders.iter().map(String::as_str))?;
        write_summary(&answer, &results)?;
        results.finish(talk::note)?;
        Ok(format!("{table}\nresults: {}\n", self.out.display()))
    }
}

/// The whole model beside one case, where the study asks for it; alone on the machine, after all cases. An error says
/// why there is none.
fn against_full(study: &Study, findings: &Findings, phases: &mut Phases) -> Result<Option<SpeedUp>, String> {
    let Some(full) = study.full else { return Ok(None) };
    let label = &study.cases[full.case].label;
    let none = |why: &str| format!("nothing to compare every degree of freedom with: {label}: {why}");
    if let Some(reason) = findings.reason(full.case) {
        return Err(none(reason));
    }
    let solved = phases.run("full", || speed_up(&study.cases[full.case].scene, full.positions, &ProcessMemory));
    solved.map(Some).map_err(|e| none(&e.to_string()))
}
