//! `ale-gear study`: several scenes in, the same figures of all out.

use std::path::PathBuf;

use super::{cache_args::CacheArgs, run::write_result};
use crate::{
    chart::{SpeedUp, speed_up},
    error::CommandError,
    facts::Cost,
    output::{ResultDirectory, StudyResult, study_csv, study_table, write_study_report, write_study_summary},
    parameter_study::{CaseRun, Study, findings, run_cases},
    phases::Phases,
    scene::SceneError,
};

/// Words of `ale-gear study`.
#[derive(Debug, clap::Args)]
pub(super) struct StudyArgs {
    /// Study file
    study: PathBuf,
    /// Folder for the results; it appears when they are complete
    #[arg(long, short, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    cache: CacheArgs,
}

impl StudyArgs {
    /// Every complaint about the words and about all files is made here, before any work starts or any file is written.
    fn plan(&self) -> Result<Study, CommandError> {
        let study = Study::read(&self.study).map_err(|e| match &e {
            SceneError::Read { .. } => CommandError::input(
                &e,
                Some("`ale-gear study STUDY.toml --out DIR` wants the path of a study file".into()),
            ),
            _ => e.into(),
        })?;
        Ok(study)
    }

    /// Runs the study; the text is the closing table.
    pub(super) fn execute(self) -> Result<String, CommandError> {
        let mut phases = Phases::with_bars();
        let study = self.plan()?;
        let results = ResultDirectory::create(&self.out)?;
        let cache = self.cache.open();
        let runs = phases.run_steps("cases", study.cases.len() as u64, |progress| {
            let solve = |scene: &_, own: &_| {
                let mut own_phases = Phases::quiet();
                write_result(scene, &mut own_phases, own, &cache)?.verdict?;
                Ok(Cost::of(&own_phases))
            };
            run_cases(&study, &results, &solve, &|case| {
                progress.say(case.label.clone());
                progress.tick();
            })
        })?;
        let speed_up = against_full(&study, &mut phases, &results)?;
        let findings = findings(&study, &runs)?;
        results.write("study.csv", study_csv(&study, &findings).as_bytes())?;
        let (cost, warnings) = (Cost::of(&phases), warnings(&study, &runs));
        let of = StudyResult {
            study: &study,
            runs: &runs,
            findings: &findings,
            speed_up: speed_up.as_ref(),
            cost: &cost,
            warnings: &warnings,
        };
        let table = study_table(of);
        write_study_report(of, &table)?.write(&results)?;
        // Last of all, so that a summary means that everything is there.
        let files = results.files()?;
        results.write("summary.json", write_study_summary(of, &files).as_bytes())?;
        results.finish()?;
        Ok(format!("{table}\nresults: {}\n", self.out.display()))
    }
}

/// The whole model beside one case, where the study asks for it; alone on the machine, after all cases.
fn against_full(
    study: &Study,
    phases: &mut Phases,
    results: &ResultDirectory,
) -> Result<Option<SpeedUp>, CommandError> {
    let Some(full) = study.full else { return Ok(None) };
    phases.run("full", || speed_up(&study.cases[full.case].scene, full.positions, results)).map(Some)
}

/// What the cases warn of, each once, with their names.
fn warnings(study: &Study, runs: &[CaseRun]) -> Vec<String> {
    let of = |(case, run): (&crate::parameter_study::Case, &CaseRun)| {
        run.warnings.iter().map(|w| format!("{}: {w}", case.label)).collect::<Vec<_>>()
    };
    study.cases.iter().zip(runs).flat_map(of).collect()
}
