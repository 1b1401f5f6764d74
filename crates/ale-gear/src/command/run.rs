//! `ale-gear run`: a document in, a result folder out.

use std::path::PathBuf;

use analysis::{Solved, SolvedAtRest, in_time::is_one_motion, lumped::is_lumped};
use scene::{Document, Machine, gearbox::Gearbox, plan::Plan};

use super::{Answer, FileWords, cache_args::CacheArgs, kind_of_file, overrides::Overrides, plan_case::machine_of};
use report::write_static_result;
use store::check_memory;

use store::folder::Cache;

use crate::{
    certificate::{Closing, Written},
    error::CommandError,
    facts::ForFiles,
    gearbox, memory, motion,
    output::ResultDirectory,
    phases::Phases,
    progression::{Outcome, Progression},
    resolution::with_slices,
    run::{self, InSpace},
    scene::{DocumentKind, Kind, Model, Run, Scene},
    talk::{self, Verbosity},
};

/// Words of `ale-gear run`.
#[derive(Debug, clap::Args)]
pub(super) struct RunArgs {
    /// Scene of a pair, gearbox file, plan, study or optimisation
    file: PathBuf,
    /// Run only this case of a plan, with its full result
    #[arg(long, value_name = "N")]
    case: Option<usize>,
    /// Whether it is the scene of the program instead.
    #[arg(skip)]
    default_scene: bool,
    /// Whether what the document says of many runs is left out: words say it instead.
    #[arg(skip)]
    one_run: bool,
    /// Folder for the results, created when they are complete
    #[arg(long, short, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    cache: CacheArgs,
    #[command(flatten)]
    overrides: Overrides,
    /// Print the summary as JSON instead of the closing table
    #[arg(long)]
    json: bool,
    /// Differentiate the history of a pair at rest with respect to these keys, comma-separated, e.g.
    /// `pinion.modification.tip_relief_um`
    #[arg(long, value_name = "KEYS", value_delimiter = ',', help_heading = "Overrides")]
    derivatives: Vec<String>,
    /// Write ParaView files even if the scene does not ask for them
    #[arg(long, help_heading = "Overrides")]
    vtu: bool,
    /// Draw only contact bands on the gears in space, which is faster (pairs at rest)
    #[arg(long)]
    no_view: bool,
    /// Continue from the last checkpoint in the folder (motions)
    #[arg(long, help_heading = "Checkpoints")]
    resume: bool,
    /// Stop after this many mesh cycles in total and keep a checkpoint (motions)
    #[arg(long, value_name = "N", help_heading = "Checkpoints", value_parser = clap::value_parser!(u64).range(1..))]
    stop_after_cycles: Option<u64>,
}

impl RunArgs {
    /// A scene file into a folder.
    pub(super) fn of_file(FileWords { file, out, overrides, cache, json }: FileWords) -> Self {
        let (case, default_scene, derivatives, vtu, no_view, resume, stop_after_cycles) =
            (None, false, Vec::new(), false, false, false, None);
        Self {
            file,
            one_run: true,
            case,
            default_scene,
            out,
            cache,
            overrides,
            json,
            derivatives,
            vtu,
            no_view,
            resume,
            stop_after_cycles,
        }
    }

    /// The default scene of the program into `out/default`.
    pub(super) fn for_default_scene() -> Self {
        let out = PathBuf::from("out/default");
        Self { default_scene: true, ..Self::of_file(FileWords { out, ..FileWords::default() }) }
    }

    /// Kind of the document; `None` where it has none of a known kind, and where one case of a plan is asked for.
    pub(super) fn kind(&self) -> Option<DocumentKind> {
        if self.default_scene || self.case.is_some() { None } else { kind_of_file(&self.file) }
    }

    /// File and words for a document of many runs.
    ///
    /// # Errors
    /// Exit status 2 for words that only single runs have a use for.
    pub(super) fn many(self) -> Result<FileWords, CommandError> {
        self.fits_many()?;
        let Self { file, out, overrides, cache, json, .. } = self;
        Ok(FileWords { file, out, overrides, cache, json })
    }

    /// Refuses words that only a single run has a use for.
    fn fits_many(&self) -> Result<(), CommandError> {
        let goes_on = "leave it out: cases that are done are not run again";
        let own = "leave it out, or write it into [output] of the scene";
        let words = [
            (!self.derivatives.is_empty(), "--derivatives", own),
            (self.vtu, "--vtu", own),
            (self.no_view, "--no-view", "leave it out: nothing is saved by it"),
            (self.resume, "--resume", goes_on),
            (self.stop_after_cycles.is_some(), "--stop-after-cycles", goes_on),
        ];
        let Some((_, word, hint)) = words.into_iter().find(|(given, ..)| *given) else { return Ok(()) };
        let said = format_args!("{}: `{word}` is for single runs, and this file has many", self.file.display());
        Err(CommandError::input(said, Some(hint.to_owned())))
    }

    /// The document with what is set beside it. Every complaint about the words is made here, before any work starts or
    /// any file is written.
    fn machine(&self) -> Result<Machine, CommandError> {
        if self.default_scene {
            talk::say(Verbosity::Bars, || {
                format!(
                    "ale-gear: no scene given: runs the default pair, which is in the program, into {}; \
                     `ale-gear run SCENE.toml --out DIR` runs another, `ale-gear init` writes one",
                    self.out.display()
                )
            });
            return Ok(Machine::Pair(Box::new(self.plan(Scene::default_scene()?)?)));
        }
        let text = Document::read(&self.file)?;
        if let Some(case) = self.case {
            let plan = Plan::of(&text, &self.overrides.settings()?)?;
            return match machine_of(&plan, case)? {
                Machine::Pair(scene) => Ok(Machine::Pair(Box::new(self.plan(*scene)?))),
                Machine::Gearbox(file) => self.gearbox(*file),
            };
        }
        // Words of `vary` take the place of what a document says of many runs; else one comes here through a pipe alone,
        // which cannot be read twice.
        let kind = if self.one_run { text.base_kind() } else { text.kind() };
        if let Some(many) = kind.filter(|kind| !matches!(kind, DocumentKind::Scene | DocumentKind::Gearbox)) {
            let message =
                format_args!("{}: this is {many}, and what it names is found beside a file", self.file.display());
            return Err(CommandError::input(message, Some("write it into a file".into())));
        }
        if kind == Some(DocumentKind::Gearbox) {
            self.fits_a_gearbox()?;
            return self.gearbox(text.gearbox(&self.overrides.settings()?)?);
        }
        let quoted: Vec<String> = self.derivatives.iter().map(|key| format!("\"{}\"", key.trim())).collect();
        let asked = (!quoted.is_empty()).then(|| format!("output.derivatives=[{}]", quoted.join(",")));
        let scene = text.scene(&self.overrides.clone().behind(asked).settings()?)?;
        Ok(Machine::Pair(Box::new(self.plan(scene)?)))
    }

    /// A gearbox, where the words fit one.
    fn gearbox(&self, file: Gearbox) -> Result<Machine, CommandError> {
        self.fits_a_gearbox()?;
        if file.motion.is_none() && (self.resume || self.stop_after_cycles.is_some()) {
            let said = format_args!("{}: this analysis has no checkpoints", self.file.display());
            let hint = match &file.branch {
                Some(_) => {
                    "leave `--resume` and `--stop-after-cycles` out: a branch (`run = \"continuation\"`) is followed in one piece"
                }
                None => "`--resume` and `--stop-after-cycles` belong to gearbox files with [motion]",
            };
            return Err(CommandError::input(said, Some(hint.to_owned())));
        }
        Ok(Machine::Gearbox(Box::new(file)))
    }

    /// Refuses words that only a pair has a use for.
    fn fits_a_gearbox(&self) -> Result<(), CommandError> {
        let torque = "`--set torque.0.torque_nm=NM` sets the first torque of a gearbox";
        let accuracy = "`--set \"accuracy.face_load_factor=2 %\"` asks it of a gearbox";
        let words = [
            (self.overrides.has_torque(), "--torque-nm", torque),
            (self.overrides.has_accuracy(), "--accuracy", accuracy),
            (!self.derivatives.is_empty(), "--derivatives", "leave it out, or run the scene of one of its pairs"),
            (self.vtu, "--vtu", "leave it out: the page shows the gearbox in space"),
            (self.no_view, "--no-view", "leave it out: nothing is saved by it"),
        ];
        let Some((_, word, hint)) = words.into_iter().find(|(given, ..)| *given) else { return Ok(()) };
        let said = format_args!("{}: `{word}` is for pairs, and this is a gearbox file", self.file.display());
        Err(CommandError::input(said, Some(hint.to_owned())))
    }

    /// The scene with what the words ask of it.
    fn plan(&self, scene: Scene) -> Result<Scene, CommandError> {
        let mut scene = with_slices(scene);
        scene.output.vtu |= self.vtu;
        if scene.output.vtu && scene.analysis.model == Model::Iso {
            return Err(CommandError::input(
                format_args!(
                    "{}: the model \"iso\" has no mesh, so there is nothing for ParaView",
                    self.file.display()
                ),
                Some("leave `vtu` out, or use `model = \"reduced\"`".into()),
            ));
        }
        if self.no_view && (scene.motion.is_some() || scene.analysis.model == Model::Iso) {
            return Err(CommandError::input(
                format_args!("{}: `--no-view` is for pairs with meshes at rest", self.file.display()),
                Some("leave it out: beside a motion the fields of one mesh cycle cost little".into()),
            ));
        }
        self.plan_motion(&scene)?;
        check_memory(&scene, memory::available_bytes())?;
        Ok(scene)
    }

    /// What only motions can do, and what they cannot.
    fn plan_motion(&self, scene: &Scene) -> Result<(), CommandError> {
        let refuse = |what: &str, hint: &str| {
            Err(CommandError::input(format_args!("{}: {what}", self.file.display()), Some(hint.into())))
        };
        let full = !is_lumped(scene) && scene.accuracy.is_none();
        let checkpoints =
            full && scene.motion.as_ref().is_some_and(|m| matches!(m.run, Run::Steady | Run::Span | Run::Ramp));
        if (self.resume || self.stop_after_cycles.is_some()) && !checkpoints {
            return refuse(
                "this analysis has no checkpoints",
                "`--resume` and `--stop-after-cycles` belong to motions of the models \"reduced\" and \"reduced+modes\" with `run = \"steady\"`, \"span\" or \"ramp\", without [accuracy]: take `run = \"steady\"` in place of \"shooting\"",
            );
        }
        let in_parts = self.resume || self.stop_after_cycles.is_some();
        if scene.analysis.kind == Kind::Dynamic && scene.output.vtu && (in_parts || !scene.can_write_fields()) {
            return refuse(
                "this analysis in time writes no ParaView files",
                "leave `--vtu` out, use one motion of the model \"reduced\" without checkpoints, or `kind = \"static\"`",
            );
        }
        Ok(())
    }

    /// What is said of a motion: the closing table, or how to go on.
    fn ended(
        &self,
        outcome: Outcome,
        (progression, results): (&Progression, ResultDirectory),
        quiet: bool,
    ) -> Result<Answer, CommandError> {
        match outcome {
            Outcome::Stopped { cycles } if self.json => Ok(format!("{{\"stopped_after_cycles\": {cycles}}}\n").into()),
            Outcome::Stopped { cycles } => Ok(format!(
                "stopped after {cycles} mesh cycles; go on with\n  ale-gear run {}{}{} --out {} --resume\n",
                self.file.display(),
                self.case.map_or_else(String::new, |case| format!(" --case {case}")),
                self.overrides.again(),
                self.out.display()
            )
            .into()),
            Outcome::Finished(written) => {
                results.finish(talk::note)?;
                progression.done()?;
                self.answer(written, quiet)
            }
        }
    }

    /// What stands on stdout at the end: the summary, nothing, or the closing table.
    fn answer(&self, (table, verdict): Closing, quiet: bool) -> Result<Answer, CommandError> {
        Answer::of_folder(&self.out, (table, verdict.err()), (self.json, quiet))
    }

    /// Runs a gearbox; the text is the closing table, or how to go on.
    fn solve_gearbox(&self, file: &Gearbox, mut phases: Phases, quiet: bool) -> Result<Answer, CommandError> {
        let results = ResultDirectory::create(&self.out)?;
        let every = file.motion.map(|motion| motion.checkpoint_every_cycles);
        let progression = Progression::new(every, &self.out, self.resume, self.stop_after_cycles);
        let outcome = gearbox::solve(file, &mut phases, &results, &self.cache.open(), &progression)?;
        self.ended(outcome, (&progression, results), quiet)
    }

    /// Runs the document; the text is the closing table.
    pub(super) fn execute(self, quiet: bool) -> Result<Answer, CommandError> {
        let mut phases = Phases::with_bars();
        let scene = match self.machine()? {
            Machine::Pair(scene) => *scene,
            Machine::Gearbox(file) => return self.solve_gearbox(&file, phases, quiet),
        };
        let results = ResultDirectory::create(&self.out)?;
        if let Some(motion) = &scene.motion {
            let every = motion.checkpoint_every_cycles.filter(|_| is_one_motion(&scene));
            let progression = Progression::new(every, &self.out, self.resume, self.stop_after_cycles);
            let outcome = motion::solve(&scene, &mut phases, &results, &self.cache.open(), &progression)?;
            return self.ended(outcome, (&progression, results), quiet);
        }
        let in_space = if self.no_view { InSpace::Bands } else { InSpace::Fields };
        let written = write_static(&scene, &mut phases, &results, &self.cache.open(), in_space)?;
        results.finish(talk::note)?;
        self.answer((written.table, written.verdict), quiet)
    }
}

/// Runs a scene of any kind from its beginning to its end and writes every file of its result, also of one that does
/// not hold.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no result comes out.
pub(super) fn write_result(
    scene: &Scene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
) -> Result<Written, CommandError> {
    if scene.motion.is_none() {
        return write_static(scene, phases, results, cache, InSpace::Fields);
    }
    motion::solve_whole(scene, phases, results, cache)
}

/// As [`write_result`], for positions at rest.
fn write_static(
    scene: &Scene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
    in_space: InSpace,
) -> Result<Written, CommandError> {
    let ForFiles { solved, mut facts, view } = run::solve(scene, phases, results, cache, in_space)?;
    let SolvedAtRest { scene, history, derivatives } = &solved;
    facts.certificate = run::certificate(scene, &history.positions);
    let (cost, rows) = (phases.cost(), (history, derivatives.as_ref()));
    let table = write_static_result(scene, rows, (&facts, &cost), view.as_ref(), results)?.table;
    let verdict = facts.verdict(scene).map_err(CommandError::from);
    Ok(Written { table, verdict, solved: Solved::AtRest(Box::new(solved)), cost })
}
