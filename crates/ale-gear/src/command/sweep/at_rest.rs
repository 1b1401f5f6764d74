//! A sweep of a pair at rest: the cases of a plan.

use report::study_files::columns_of;
use scene::{
    Document, Scene,
    plan::{Plan, PlanOutput, PlanTake, PlanWords},
    study::{Take, column_advice},
};

use super::{
    super::{case_reports::CaseReports, vary::run_plan},
    SweepArgs,
};
use crate::error::CommandError;

impl SweepArgs {
    /// The plan of a sweep at rest. Its cases know nothing of each other: ways and sections are words of motions.
    fn plan_at_rest(&self, document: Document, scene: &Scene) -> Result<Plan, CommandError> {
        let of_motions = [
            ("--ways", !self.ways.is_empty()),
            ("--once", self.once.is_some()),
            ("--cycles", self.cycles.is_some()),
            ("--settle", self.settle.is_some()),
            ("--lyapunov", self.lyapunov.is_some()),
        ];
        if let Some((word, _)) = of_motions.into_iter().find(|(_, given)| *given) {
            let what =
                format_args!("{}: `{word}` is a word of motions, and this pair is at rest", self.scene.display());
            return Err(CommandError::input(
                what,
                Some("leave it out, or say `kind = \"dynamic\"` in [analysis]".into()),
            ));
        }
        let column = self.of(true);
        if let Some(all) = columns_of(scene).filter(|all| !all.iter().any(|name| name == column)) {
            let names: Vec<&str> = all.iter().map(String::as_str).collect();
            let what = format_args!("`--of {column}` is no column of history.csv");
            return Err(CommandError::input(what, column_advice(column, &names)));
        }
        let log = if self.log { ":log" } else { "" };
        let vary = [format!("{}={}:{}:{}{log}", self.key, self.from, self.to, self.points)];
        let outputs: Vec<PlanOutput> =
            Take::ALL.map(|take| PlanOutput::Column { column: column.to_owned(), take: PlanTake::Of(take) }).into();
        let words = PlanWords { vary: &vary, ..PlanWords::default() };
        Ok(Plan { outputs, ..Plan::of_scene(document, &self.overrides.settings()?, &words)? })
    }

    /// Runs all values; the text is the closing table.
    pub(super) fn run_at_rest(&self, document: Document, scene: &Scene) -> Result<String, CommandError> {
        self.values()?;
        let plan = self.plan_at_rest(document, scene)?;
        let of = self.of.as_ref().map(|column| format!(" --of {column}")).unwrap_or_default();
        let (key, from, to, points) = (&self.key, self.from, self.to, self.points);
        let log = if self.log { " --log" } else { "" };
        let set: String = self.overrides.settings()?.iter().map(|setting| format!(" {}", setting.word())).collect();
        let again = format!(
            "ale-gear sweep {} --out DIR --key {key} --from {from} --to {to} --points {points}{log}{of}{set}",
            self.scene.display()
        );
        run_plan(&plan, (&self.out, &again), &CaseReports::default(), &self.cache.open())
    }
}
