//! `ale-gear run`: a scene in, a result folder out.

use std::path::PathBuf;

use super::overrides::Overrides;
use crate::cache::Cache;
use crate::error::CommandError;
use crate::facts::{Cost, Solved};
use crate::motion::{self, Progression};
use crate::output::{
    ResultDirectory, closing_table, headline, write_contact, write_history, write_report, write_summary,
};
use crate::phases::Phases;
use crate::run;
use crate::scene::{Kind, Model, Run, Scene};

/// Words of `ale-gear run`.
#[derive(Debug, clap::Args)]
pub(super) struct RunArgs {
    /// Scene file
    scene: PathBuf,
    /// Folder for the results; it appears when they are complete
    #[arg(long, short, value_name = "DIR")]
    out: PathBuf,
    /// Folder of reduced gears [default: the user's cache folder]
    #[arg(long, value_name = "DIR")]
    cache: Option<PathBuf>,
    /// Neither read nor write reduced gears
    #[arg(long, conflicts_with = "cache")]
    no_cache: bool,
    #[command(flatten)]
    overrides: Overrides,
    /// Write ParaView files, whatever the scene says
    #[arg(long, help_heading = "Overrides")]
    vtu: bool,
    /// Go on from the last checkpoint of a run into the same folder (motions)
    #[arg(long, help_heading = "Checkpoints")]
    resume: bool,
    /// Stop after so many mesh cycles in all and leave a checkpoint (motions)
    #[arg(long, value_name = "N", help_heading = "Checkpoints")]
    stop_after_cycles: Option<u64>,
}

impl RunArgs {
    /// The default scene into `out/default`.
    pub(super) fn for_default_scene() -> Result<Self, CommandError> {
        let out = PathBuf::from("out/default");
        let scene = super::default_scene::find()?;
        Ok(Self {
            scene,
            out,
            cache: None,
            no_cache: false,
            overrides: Overrides::default(),
            vtu: false,
            resume: false,
            stop_after_cycles: None,
        })
    }

    fn cache(&self) -> Cache {
        match &self.cache {
            _ if self.no_cache => Cache::off(),
            Some(folder) => Cache::in_folder(folder.clone()),
            None => Cache::of_user(),
        }
    }

    /// Every complaint about the words is made here, before any work starts or any file is written.
    fn plan(&self) -> Result<Scene, CommandError> {
        let mut scene = self.overrides.read(&self.scene)?;
        scene.output.vtu |= self.vtu;
        if scene.output.vtu && scene.analysis.model == Model::Iso {
            return Err(CommandError::input(
                format_args!(
                    "{}: the model \"iso\" has no mesh, so there is nothing for ParaView",
                    self.scene.display()
                ),
                Some("leave `vtu` out, or use `model = \"reduced\"`".into()),
            ));
        }
        self.plan_motion(&scene)?;
        Ok(scene)
    }

    /// What only motions can do, and what they cannot.
    fn plan_motion(&self, scene: &Scene) -> Result<(), CommandError> {
        let refuse = |what: &str, hint: &str| {
            Err(CommandError::input(format_args!("{}: {what}", self.scene.display()), Some(hint.into())))
        };
        let full = !crate::ladder::has(scene);
        let checkpoints =
            full && scene.motion.as_ref().is_some_and(|m| matches!(m.run, Run::Steady | Run::Span | Run::Ramp));
        if (self.resume || self.stop_after_cycles.is_some()) && !checkpoints {
            return refuse(
                "this analysis has no checkpoints",
                "`--resume` and `--stop-after-cycles` belong to motions of the model \"reduced\" with `run` \"steady\", \"span\" or \"ramp\"",
            );
        }
        if scene.analysis.kind == Kind::Dynamic && scene.output.vtu {
            return refuse(
                "an analysis in time writes no ParaView files",
                "leave `--vtu` out, or use `kind = \"static\"`",
            );
        }
        Ok(())
    }

    /// Runs a motion; the text is the closing table.
    fn move_pair(
        &self,
        scene: &Scene,
        words: &crate::scene::MotionScene,
        mut phases: Phases,
        results: ResultDirectory,
    ) -> Result<String, CommandError> {
        let progression = Progression::new(words, &self.out, self.resume, self.stop_after_cycles);
        match motion::solve(scene, words, &mut phases, &results, &self.cache(), &progression)? {
            motion::Outcome::Stopped { cycles } => Ok(format!(
                "stopped after {cycles} mesh cycles; go on with\n  ale-gear run {} --out {} --resume\n",
                self.scene.display(),
                self.out.display()
            )),
            motion::Outcome::Finished(written) => {
                results.finish()?;
                progression.done()?;
                Ok(format!("{written}\nresults: {}\n", self.out.display()))
            }
        }
    }

    /// Runs the scene; the text is the closing table.
    pub(super) fn execute(self) -> Result<String, CommandError> {
        let mut phases = Phases::with_bars();
        let scene = self.plan()?;
        let results = ResultDirectory::create(&self.out)?;
        if let (Some(words), true) = (&scene.motion, crate::ladder::has(&scene)) {
            let table = crate::ladder::solve(&scene, words, &mut phases, &results, &self.cache())?;
            results.finish()?;
            return Ok(format!("{table}\nresults: {}\n", self.out.display()));
        }
        if let Some(words) = &scene.motion {
            return self.move_pair(&scene, words, phases, results);
        }
        let Solved { history, facts } = run::solve(&scene, &mut phases, &results, &self.cache())?;
        let headline = headline(&scene, &history).map_err(|e| CommandError::failed(&e, e.hint()))?;

        let picture = phases.run("write", || {
            results.write("history.csv", write_history(&scene, &history).as_bytes())?;
            write_contact(&scene, &history, &results)
        })?;
        let cost = Cost::of(&phases);
        let report = write_report(&scene, &history, &facts, &cost, &headline, picture.as_deref())?;
        results.write("report.html", report.as_bytes())?;
        // Last of all, so that a summary means that everything is there.
        let files = results.files()?;
        let summary = write_summary(&scene, &facts, &cost, &headline, &history.warnings, &files);
        results.write("summary.json", summary.as_bytes())?;
        results.finish()?;

        let mut text = closing_table(&scene, &facts, &cost, &headline, &history.warnings);
        text.push_str(&format!("\nresults: {}\n", self.out.display()));
        Ok(text)
    }
}
