//! Several scenes with the same figures of all.

use analysis::{
    SharedModels,
    accuracy_chart::{SpeedUp, speed_up},
    parameter_study::{Findings, findings},
    remark::{self, Remark},
    resolution::with_slices,
};
use plan::{columns_of_scene, study_digest};
use report::study_files::{StudyResult, study_answer, study_page, study_remarks};
use scene::study::Study;

use super::{
    super::{Answer, run::write_result},
    VaryArgs,
};
use report::{write_summary, write_tables_and_page};
use store::check_memory;
use store::folder::KeptCases;

use crate::{
    chart::ProcessMemory,
    error::CommandError,
    memory,
    output::{CASES, ResultDirectory},
    phases::Phases,
    study_cases::{CaseRunner, run_cases},
    talk,
};

impl VaryArgs {
    /// Every complaint about the words and about all files is made here, before any work starts or any file is written.
    fn study_of_file(&self) -> Result<Study, CommandError> {
        let settings = self.overrides.settings()?;
        let mut study = Study::read(&self.file, &settings, &columns_of_scene)?;
        for case in &mut study.cases {
            case.scene = with_slices(case.scene.clone());
        }
        let free = memory::available_bytes();
        study.cases.iter().try_for_each(|case| check_memory(&case.scene, free))?;
        Ok(study)
    }

    /// Runs the study.
    pub(super) fn study(&self, quiet: bool) -> Result<Answer, CommandError> {
        self.only(&["--reports", "--json"], "a study file")?;
        let (mut phases, out) = (Phases::with_bars(), self.folder()?);
        let study = self.study_of_file()?;
        let reports = self.reports.of_all(study.cases.len())?;
        let results = ResultDirectory::create(out)?;
        let cache = self.cache.open();
        let kept = KeptCases::beside(out, &study_digest(&study, reports))?;
        let runs = phases.run_steps("cases", study.cases.len() as u64, |progress| {
            let models = SharedModels::new(&cache);
            let alone = |scene: &_, own: &_| write_result(scene, &mut Phases::quiet(), own, &cache);
            let runner = CaseRunner { models: &models, alone: &alone, reports };
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
        let mut remarks = study_remarks(&study, &runs, &findings);
        let speed_up = against_full(&study, &findings, &mut phases).unwrap_or_else(|said| {
            remarks.push(said);
            None
        });
        let of = StudyResult {
            study: &study,
            runs: &runs,
            findings: &findings,
            speed_up: speed_up.as_ref(),
            remarks: &remarks,
            reports,
        };
        let answer = study_answer(of, phases.cost());
        let table = write_tables_and_page(&answer, &study_page(of, &answer)?, false, &results)?;
        // Cases stay where they are until all else is written. Last of all the summary: it means that everything is there.
        kept.move_into(&results.path(CASES), folders.iter().map(String::as_str))?;
        write_summary(&answer, &results)?;
        results.finish(talk::note)?;
        Answer::of_folder(out, (table, None), (self.json, quiet))
    }
}

/// The whole model beside one case, where the study asks for it; alone on the machine, after all cases. An error says
/// why there is none.
fn against_full(study: &Study, findings: &Findings, phases: &mut Phases) -> Result<Option<SpeedUp>, Remark> {
    let Some(full) = study.full else { return Ok(None) };
    let label = &study.cases[full.case].label;
    let none = |why: &str| remark::no_full_model(why).about(label);
    if let Some(reason) = findings.reason(full.case) {
        return Err(none(reason));
    }
    let solved = phases.run("full", || speed_up(&study.cases[full.case].scene, full.positions, &ProcessMemory));
    solved.map(Some).map_err(|e| none(&e.to_string()))
}
