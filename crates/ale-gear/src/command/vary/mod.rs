//! `ale-gear vary`: many values of some keys of a scene, or several scenes: each value alone, or from the state of the
//! last one.
//!
//! | module | what it does |
//! |---|---|
//! | `each` | every case alone: plans, and the words of a command line that say one |
//! | `part` | some cases of a plan into a file, and files put together again |
//! | `study` | several scenes with the same figures |
//! | `carry` | motions that begin where the last one ended, up and down |
//! | `branch` | periodic motions followed around folds |
//! | `basin` | starts over a plane of displacement and rate |

mod basin;
mod branch;
mod carry;
mod each;
mod part;
mod study;

pub(super) use part::MergeArgs;

use std::path::PathBuf;

use scene::{
    Document, DocumentKind,
    plan::{self, StartedPlan},
};

use super::{Answer, FileWords, cache_args::CacheArgs, case_reports::CaseReports, kind_of_file, overrides::Overrides};
use crate::error::CommandError;

/// Words of `ale-gear vary`.
#[derive(Debug, clap::Args)]
pub(super) struct VaryArgs {
    /// Plan or study file; or a scene file with `--vary` and `--output`, or with `--harris`
    file: PathBuf,
    /// Folder for the results, created when they are complete; with `--cases` the file for their rows
    #[arg(long, short, value_name = "DIR", required_unless_present = "list")]
    out: Option<PathBuf>,
    /// A key and its values: `KEY=1,2,5`, `KEY=0:40:9` (nine), `KEY=1:100:9:log`, `KEY~0:40` (drawn), `KEY~normal:0:5`,
    /// `KEY~iso1328:6` (a tolerance class), `KEY=0:40` (any between, with `--start branch`); several keys with the same
    /// value: `KEY+KEY=1,2,5`; repeatable
    #[arg(long, value_name = "WORDS", allow_hyphen_values = true)]
    vary: Vec<String>,
    /// The plan that says what is varied, where no words do
    #[arg(skip)]
    plan_file: Option<PathBuf>,
    /// Start of each case
    #[arg(long, value_enum, default_value_t = Start::Each)]
    start: Start,
    /// Output: a number of the headline of `summary.json`; repeatable
    #[arg(long, value_name = "KEY")]
    output: Vec<String>,
    /// Column of `history.csv`: of cases its mean, peak to peak, least and largest value are wanted, of motions that carry
    /// on its section is taken [default of those: dte_um]
    #[arg(long, value_name = "COLUMN")]
    of: Option<String>,
    /// Harris map: peak-to-peak STE over torque, from 0.1 to 1.4 times the scene's, one curve for each value of
    /// `--vary`
    #[arg(long)]
    harris: bool,
    #[command(flatten)]
    drawn: DrawnArgs,
    #[command(flatten)]
    sections: carry::SectionArgs,
    #[command(flatten)]
    part: part::PartArgs,
    #[command(flatten)]
    reports: CaseReports,
    /// Print the summary as JSON instead of the closing table
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    overrides: Overrides,
    #[command(flatten)]
    cache: CacheArgs,
}

/// How a value starts.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, clap::ValueEnum)]
enum Start {
    /// Each alone: one row of outputs per case
    #[default]
    Each,
    /// Motions continued from the last value, up and down: bifurcation diagrams
    Carry,
    /// Periodic motions continued around folds: resonance curves with their unstable parts
    Branch,
    /// One motion from each state of a plane: `start_um` and `start_mm_s` are varied
    Basin,
}

/// How values are drawn.
#[derive(Debug, Default, clap::Args)]
#[command(next_help_heading = "What is drawn")]
struct DrawnArgs {
    /// Sampling design: latin-hypercube, sobol or random [default: latin-hypercube]
    #[arg(long, value_name = "NAME")]
    design: Option<String>,
    /// Number of samples [default: 100]
    #[arg(long, value_name = "N")]
    samples: Option<u32>,
    /// Seed of the samples [default: 1]
    #[arg(long, value_name = "N")]
    seed: Option<u32>,
}

impl VaryArgs {
    /// A plan or study file into a folder.
    pub(super) fn of_file(FileWords { file, out, overrides, cache, json }: FileWords) -> Self {
        Self {
            file,
            out: Some(out),
            vary: Vec::new(),
            plan_file: None,
            start: Start::Each,
            output: Vec::new(),
            of: None,
            harris: false,
            drawn: DrawnArgs::default(),
            sections: carry::SectionArgs::default(),
            part: part::PartArgs::default(),
            reports: CaseReports::default(),
            json,
            overrides,
            cache,
        }
    }

    /// Every optional word, and whether it was given.
    fn given(&self) -> Vec<(&'static str, bool)> {
        let DrawnArgs { design, samples, seed } = &self.drawn;
        let mut all = vec![
            ("--vary", !self.vary.is_empty()),
            ("--start", self.start != Start::Each),
            ("--output", !self.output.is_empty()),
            ("--of", self.of.is_some()),
            ("--harris", self.harris),
            ("--design", design.is_some()),
            ("--samples", samples.is_some()),
            ("--seed", seed.is_some()),
            ("--reports", self.reports.best()),
            ("--report-case", self.reports.listed()),
            ("--json", self.json),
        ];
        all.extend(self.sections.given());
        all.extend(self.part.given());
        all
    }

    /// Refuses every optional word but these.
    fn only(&self, words: &[&str], whose: &str) -> Result<(), CommandError> {
        let Some((word, _)) = self.given().into_iter().find(|(word, given)| *given && !words.contains(word)) else {
            return Ok(());
        };
        let message = format_args!("{}: `{word}` does not go with {whose}", self.file.display());
        Err(CommandError::input(message, Some("leave it out; `ale-gear vary --help` tells what goes with what".into())))
    }

    /// Words that say no plan: all others take the place of the one in the file.
    const BESIDE: [&str; 3] = ["--json", "--reports", "--report-case"];

    /// Does what the file and the words ask for.
    pub(super) fn execute(self, quiet: bool) -> Result<Answer, CommandError> {
        let kind = kind_of_file(&self.file);
        let by_words = self.given().iter().any(|(word, given)| *given && !Self::BESIDE.contains(word));
        if kind == Some(DocumentKind::Plan) && !by_words {
            let document = Document::read(&self.file)?;
            if let Some(plan) = StartedPlan::of(&document, &[])? {
                return self.of_plan(plan).started(quiet);
            }
        }
        match (kind, self.start) {
            (Some(DocumentKind::Study), _) => self.study(quiet),
            (_, Start::Each) if self.part.any() => self.part(quiet),
            _ => self.started(quiet),
        }
    }

    /// The command by the words of a plan whose values do not each start alone.
    fn of_plan(self, plan: StartedPlan) -> Self {
        let plan_file = Some(self.file);
        Self {
            file: plan.document.file().to_owned(),
            plan_file,
            vary: plan.keys,
            start: match plan.start {
                plan::Start::Each => Start::Each,
                plan::Start::Carry => Start::Carry,
                plan::Start::Branch => Start::Branch,
                plan::Start::Basin => Start::Basin,
            },
            of: plan.of,
            sections: carry::SectionArgs::of_plan(&plan.ways, plan.every, [plan.cycles, plan.settle, plan.lyapunov]),
            overrides: self.overrides.behind_plan(plan.settings),
            ..self
        }
    }

    /// How what is varied is written: in a plan or on the command line.
    fn axes(&self) -> String {
        let number = self.vary.len();
        match &self.plan_file {
            Some(file) => format!("{}: {number} words in `keys` of [vary]", file.display()),
            None => format!("{number} `--vary`"),
        }
    }

    /// A word for what is varied, as messages name it.
    fn said(&self, word: &str) -> String {
        match &self.plan_file {
            Some(file) => format!("{}: `{word}` in [vary]", file.display()),
            None => format!("--vary {word}"),
        }
    }

    /// Runs values by how each of them starts.
    fn started(self, quiet: bool) -> Result<Answer, CommandError> {
        let of_pairs = self.start != Start::Each || self.harris;
        if of_pairs && self.base_kind() == Some(DocumentKind::Gearbox) {
            let (file, word) = match &self.plan_file {
                Some(file) => (file, "start"),
                None => (&self.file, if self.harris { "--harris" } else { "--start" }),
            };
            let message = format_args!("{}: `{word}` is for pairs: cases of a gearbox are each alone", file.display());
            let hint = match self.start {
                Start::Branch => {
                    "periodic motions of a gearbox over the speed are what `run = \"continuation\"` in [motion] asks for: \
                     `ale-gear run` with `speed_rpm` and `to_speed_rpm`"
                }
                Start::Carry => {
                    "a run-up carries the state of a gearbox from speed to speed: `to_speed_rpm` in [motion], with `ale-gear run`"
                }
                Start::Each | Start::Basin => {
                    "leave it out, vary `KEY=FROM:TO:COUNT`, and ask for an output as `face_load_factor.0`"
                }
            };
            return Err(CommandError::input(message, Some(hint.to_owned())));
        }
        match self.start {
            Start::Each => self.each(quiet),
            Start::Carry => self.carry(quiet),
            Start::Branch => self.branch(quiet),
            Start::Basin => self.basin(quiet),
        }
    }

    /// Kind of what the file describes; `None` of a pipe, and where it describes nothing.
    fn base_kind(&self) -> Option<DocumentKind> {
        if self.file.is_file() { Document::read(&self.file).ok()?.base_kind() } else { None }
    }

    /// The folder of the results.
    fn folder(&self) -> Result<&PathBuf, CommandError> {
        self.out.as_ref().ok_or_else(|| CommandError::input("no `--out DIR`", Some("say where results go".into())))
    }
}
