//! `ale-gear chart`: a scene in, accuracy against cost of every model out.

use std::path::PathBuf;

use analysis::accuracy_chart::{ChartOptions, resonance_precision};
use analysis::motion::motion_precision;
use report::accuracy_chart::{methods_chart, resonance_chart, work_precision_chart, write_chart};

use super::overrides::Overrides;
use report::MarkedPlace;

use store::check_memory;

use crate::{chart::chart, error::CommandError, memory, output::ResultDirectory, phases::Phases, scene::Scene, talk};

/// Words of `ale-gear chart`.
#[derive(Debug, clap::Args)]
pub(super) struct ChartArgs {
    /// Scene file
    scene: PathBuf,
    /// Folder for chart and tables, created when they are complete
    #[arg(long, short, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    overrides: Overrides,
    /// Chart integration methods of a motion instead: error against step size and wall time
    #[arg(long, conflicts_with = "motion")]
    methods: bool,
    /// Chart models in motion over the speeds of `[motion.sweep]` instead: error of the resonance curve against wall
    /// time
    #[arg(long, conflicts_with_all = ["motion", "methods"])]
    resonance: bool,
    /// Use coarse meshes and few positions or steps: less than a minute
    #[arg(long)]
    quick: bool,
    /// Run the models in motion at the scene's torque and speed as well
    #[arg(long)]
    motion: bool,
    /// Skip what would take longer than this, judged by the coarser mesh
    #[arg(long, value_name = "S", default_value = "240")]
    limit_s: f64,
    /// Replace the tables between `<!-- chart NAME -->` and `<!-- end -->` in this Markdown file, NAME being the
    /// scene's name
    #[arg(long, value_name = "FILE")]
    into: Option<PathBuf>,
}

/// Positions of a cycle in a quick look.
const QUICK_POSITIONS: u32 = 8;

impl ChartArgs {
    /// Every complaint about the words is made here, before any work starts or any file is written.
    fn plan(&self) -> Result<(Scene, ChartOptions), CommandError> {
        let mut scene = self.overrides.read(&self.scene)?;
        if !(self.limit_s > 0.0 && self.limit_s.is_finite()) {
            let message = format_args!("`--limit-s` is {}, allowed is above 0", self.limit_s);
            return Err(CommandError::input(message, Some("give seconds, such as `--limit-s 240`".into())));
        }
        if let Some(file) = &self.into {
            MarkedPlace::find(file, &scene.name)?;
        }
        if self.methods && scene.motion.is_none() {
            return Err(self.other_scene("--methods", "an analysis in time", "say `kind = \"dynamic\"` in [analysis]"));
        }
        if self.resonance && scene.motion.as_ref().is_none_or(|m| m.sweep.is_none()) {
            let hint = "say `run = \"sweep\"` in [motion], and the speeds in [motion.sweep]";
            return Err(self.other_scene("--resonance", "a sweep over speed", hint));
        }
        let mut options = if self.quick {
            scene.analysis.positions_per_cycle = scene.analysis.positions_per_cycle.min(QUICK_POSITIONS);
            ChartOptions::quick(self.limit_s)
        } else {
            ChartOptions::whole(self.limit_s)
        };
        options.motion = self.motion;
        check_memory(&scene, memory::available_bytes())?;
        Ok((scene, options))
    }

    /// Runs all points; the text is the tables.
    pub(super) fn execute(self) -> Result<String, CommandError> {
        let (scene, options) = self.plan()?;
        let results = ResultDirectory::create(&self.out)?;
        let mut phases = Phases::with_bars();
        let quick = if self.quick { " --quick" } else { "" };
        let set: String = scene.set.iter().map(|word| format!(" {word}")).collect();
        let command = |words: &str| format!("ale-gear chart {} --out DIR{quick}{words}{set}", self.scene.display());
        let drawn = if self.methods {
            methods_chart(&scene.name, &motion_precision(&scene, &mut phases, self.quick)?, &command(" --methods"))
        } else if self.resonance {
            let found = resonance_precision(&scene, &mut phases, self.quick)?;
            resonance_chart(&scene.name, &found, &command(" --resonance"))
        } else {
            let points = chart(&scene, &options, &mut phases)?;
            let command = command(if self.motion { " --motion" } else { "" });
            work_precision_chart(&scene.name, &points, &command, rayon::current_num_threads())
        };
        let tables = drawn.markdown.clone();
        let text = write_chart(&scene, drawn, phases.cost(), &results)?.table;
        results.finish(talk::note)?;
        if let Some(file) = &self.into {
            MarkedPlace::find(file, &scene.name)?.replace(&tables)?;
        }
        Ok(format!("{text}\nresults: {}\n", self.out.display()))
    }

    fn other_scene(&self, word: &str, wanted: &str, hint: &str) -> CommandError {
        let what = format_args!("{}: `{word}` is for {wanted}", self.scene.display());
        CommandError::input(what, Some(hint.into()))
    }
}
