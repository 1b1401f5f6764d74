//! Motions that carry on from the state of the last value, up and down: bifurcation diagrams and resonance curves.

use analysis::lumped::{SweepOptions, is_lumped};
use clap::ValueEnum;
use scene::plan::{AxisWord, SectionEvery};
use store::check_sweep_memory;

use super::{super::Answer, VaryArgs};
use crate::{
    error::CommandError,
    lumped, memory,
    output::ResultDirectory,
    phases::Phases,
    resolution::with_slices,
    scene::{Document, Kind, Scene, Setting, SweepWay},
    talk,
};

/// Words for sections of motions.
#[derive(Debug, Default, clap::Args)]
#[command(next_help_heading = "Motions that carry on (`--start carry`)")]
pub(super) struct SectionArgs {
    /// Order of the values: up and down continue from the last one, apart starts each at rest [default: up,down]
    #[arg(long, value_enum, value_delimiter = ',')]
    ways: Vec<Way>,
    /// Interval between points of a section [default: mesh-cycle]
    #[arg(long, value_enum)]
    once: Option<Once>,
    /// Number of points of a section [default: 64]
    #[arg(long, value_name = "N")]
    cycles: Option<u32>,
    /// Maximum number of mesh cycles before the section [default: the scene's `warm_up_cycles`, or 400]
    #[arg(long, value_name = "N")]
    settle: Option<u32>,
    /// Mesh cycles for the largest Lyapunov exponent; 0 omits it [default: 200, impact: 0]
    #[arg(long, value_name = "N")]
    lyapunov: Option<u32>,
}

/// Which way values are gone through.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Way {
    /// Upwards, from motion to motion
    Up,
    /// Downwards likewise
    Down,
    /// Each from rest
    Apart,
}

impl Way {
    fn word(self) -> SweepWay {
        match self {
            Self::Up => SweepWay::Up,
            Self::Down => SweepWay::Down,
            Self::Apart => SweepWay::Apart,
        }
    }
}

/// How often the section has a point.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum Once {
    /// Once a mesh cycle.
    MeshCycle,
    /// Once a turn of the pinion.
    PinionTurn,
    /// Once a turn of the wheel.
    WheelTurn,
}

impl Once {
    fn every(self) -> SectionEvery {
        match self {
            Self::MeshCycle => SectionEvery::MeshCycle,
            Self::PinionTurn => SectionEvery::PinionTurn,
            Self::WheelTurn => SectionEvery::WheelTurn,
        }
    }
}

/// A choice as it is written on the command line.
fn word_of(choice: &impl clap::ValueEnum) -> String {
    choice.to_possible_value().map(|v| v.get_name().to_owned()).unwrap_or_default()
}

/// Column whose section is taken where nobody says.
const OF: &str = "dte_um";
/// Points of a section likewise.
const CYCLES: u32 = 64;
/// Settling cycles where nobody says.
const SETTLE: u32 = 400;
/// Stretches of the exponent likewise.
const LYAPUNOV_INTERVALS: u32 = 200;
/// Most values, and most points of a section.
const MOST: u32 = 100_000;

impl SectionArgs {
    /// The words of a plan: ways, how often, and points, mesh cycles before them, mesh cycles of the exponent.
    pub(super) fn of_plan(
        ways: &[SweepWay],
        every: Option<SectionEvery>,
        [cycles, settle, lyapunov]: [Option<u32>; 3],
    ) -> Self {
        let ways = ways.iter().filter_map(|way| Way::from_str(way.word(), false).ok()).collect();
        let once = every.and_then(|every| Once::from_str(every.word(), false).ok());
        Self { ways, once, cycles, settle, lyapunov }
    }

    /// Words, and whether they were given.
    pub(super) fn given(&self) -> [(&'static str, bool); 5] {
        [
            ("--ways", !self.ways.is_empty()),
            ("--once", self.once.is_some()),
            ("--cycles", self.cycles.is_some()),
            ("--settle", self.settle.is_some()),
            ("--lyapunov", self.lyapunov.is_some()),
        ]
    }

    /// Ways, each once.
    fn ways(&self) -> Vec<Way> {
        let mut ways = Vec::new();
        for way in if self.ways.is_empty() { &[Way::Up, Way::Down] } else { &self.ways[..] } {
            if !ways.contains(way) {
                ways.push(*way);
            }
        }
        ways
    }

    fn once(&self) -> Once {
        self.once.unwrap_or(Once::MeshCycle)
    }
}

impl VaryArgs {
    /// Words that go with motions that carry on.
    const CARRY: [&str; 9] =
        ["--vary", "--start", "--of", "--ways", "--once", "--cycles", "--settle", "--lyapunov", "--json"];

    /// The keys and their values, ascending.
    fn carried(&self) -> Result<(Vec<String>, Vec<f64>), CommandError> {
        let refuse = |what: String, hint: &str| Err(CommandError::input(what, Some(hint.into())));
        let cycles = self.sections.cycles.unwrap_or(CYCLES);
        if !(1..=MOST).contains(&cycles) {
            return refuse(
                format!("`--cycles` is {cycles}, allowed is 1 .. {MOST}"),
                "a section has some hundred points",
            );
        }
        let example = "as `--vary 'operation.speed_rpm=1000:6000:101'`, with `:log` behind it or as a list";
        let [word] = &self.vary[..] else {
            return refuse(format!("{}: motions carry on along one", self.axes()), example);
        };
        let axis =
            AxisWord::parse(word).map_err(|e| CommandError::input(format_args!("{}: {e}", self.said(word)), None))?;
        let Some(values) = axis.list() else {
            return refuse(
                format!("{}: motions carry on from value to value, which it does not say", self.said(word)),
                example,
            );
        };
        if !(2..=MOST as usize).contains(&values.len()) {
            let what = format!("{}: {} values, allowed is 2 .. {MOST}", self.said(word), values.len());
            return refuse(what, "a diagram has a few hundred");
        }
        if let Some(pair) = values.windows(2).find(|pair| !(pair[0] < pair[1] && pair[1].is_finite())) {
            let what = format!("{}: {} is not below {}", self.said(word), pair[0], pair[1]);
            return refuse(what, "write values in ascending order; `--ways` says which way they are gone through");
        }
        Ok((axis.keys.clone(), values.to_vec()))
    }

    /// Every complaint about words and scenes is made here, before any work starts or any file is written.
    fn sweep(&self, document: &Document) -> Result<(Vec<(f64, Scene)>, SweepOptions), CommandError> {
        let ((keys, values), settings) = (self.carried()?, self.overrides.settings()?);
        let words = &self.sections;
        let mut scenes = Vec::with_capacity(values.len());
        for value in values {
            let mut all = settings.clone();
            for key in &keys {
                all.push(Setting::number(key, value)?.called(&format!("--vary {key}={value}")));
            }
            let mut scene = with_slices(document.scene(&all)?);
            self.fits(&scene)?;
            if let Some(motion) = &mut scene.motion {
                let settle = words.settle.or(motion.warm_up_cycles).unwrap_or(SETTLE);
                motion.warm_up_cycles = Some(settle);
                motion.periodic_tolerance = Some(motion.periodic_tolerance.unwrap_or(1e-6));
            }
            // What the key is set to is in the tables; the settings are those of the whole.
            scene.set = settings.iter().map(Setting::word).collect();
            scenes.push((value, scene));
        }
        let impact = scenes.first().is_some_and(|(_, scene)| scene.impact.is_some());
        let ways: Vec<SweepWay> = words.ways().into_iter().map(Way::word).collect();
        let first = scenes.first().map(|(_, scene)| scene);
        let of = self.of.as_deref().unwrap_or(OF);
        let quantity = first.map(|scene| lumped::quantity(scene, of)).transpose()?;
        let Some(quantity) = quantity else {
            return Err(analysis::AnalysisError::from(analysis::Refusal::no_values()).into());
        };
        let options = SweepOptions {
            key: keys.join("+"),
            ways,
            every: words.once().every(),
            quantity,
            points: words.cycles.unwrap_or(CYCLES),
            stretches: words.lyapunov.unwrap_or(if impact { 0 } else { LYAPUNOV_INTERVALS }),
        };
        for (_, scene) in &scenes {
            let every = options.every.cycles(scene);
            check_sweep_memory(
                scene,
                (scenes.len(), options.ways.len()),
                (options.points, every),
                memory::available_bytes(),
            )?;
        }
        Ok((scenes, options))
    }

    /// The command that makes it again.
    fn again_carried(&self, options: &SweepOptions) -> String {
        let words = &self.sections;
        let ways: Vec<String> = words.ways().iter().map(word_of).collect();
        let mut again = format!(
            "ale-gear vary {} --out DIR --vary '{}' --start carry --ways {} --once {} --of {} --cycles {}",
            self.file.display(),
            self.vary.join(" "),
            ways.join(","),
            word_of(&words.once()),
            options.quantity.name,
            options.points
        );
        for (word, value) in [("--settle", words.settle), ("--lyapunov", words.lyapunov)] {
            if let Some(value) = value {
                again.push_str(&format!(" {word} {value}"));
            }
        }
        self.overrides
            .settings()
            .unwrap_or_default()
            .iter()
            .for_each(|own| again.push_str(&format!(" {}", own.word())));
        again
    }

    /// Refuses scenes that have no motion, or leave the model open.
    fn fits(&self, scene: &Scene) -> Result<(), CommandError> {
        if scene.analysis.kind == Kind::Dynamic && (is_lumped(scene) || scene.analysis.model.is_reduced()) {
            return Ok(());
        }
        let hint = "use one model in time; pairs at rest have no state that carries on: `--start each --of ste_um`";
        let what = "only a motion of one model carries on";
        Err(CommandError::input(format_args!("{}: {what}", self.file.display()), Some(hint.into())))
    }

    /// Runs all values.
    pub(super) fn carry(&self, quiet: bool) -> Result<Answer, CommandError> {
        self.only(&Self::CARRY, "motions that carry on")?;
        // As it stands first: what is wrong with the scene is not wrong with the key.
        let document = Document::read(&self.file)?;
        self.fits(&with_slices(document.scene(&self.overrides.settings()?)?))?;
        let (mut phases, out) = (Phases::with_bars(), self.folder()?);
        let (scenes, options) = self.sweep(&document)?;
        let results = ResultDirectory::create(out)?;
        let again = self.again_carried(&options);
        let table = lumped::sweep_key(&scenes, &options, &again, &mut phases, &results, &self.cache.open())?;
        results.finish(talk::note)?;
        Answer::of_folder(out, (table, None), (self.json, quiet))
    }
}
