//! `ale-gear sweep`: a scene run at many values of one of its keys; at rest these are the cases of a plan.

mod at_rest;

use std::path::PathBuf;

use analysis::lumped::{SectionEvery, SweepOptions, is_lumped};

use report::check_sweep_memory;

use super::{cache_args::CacheArgs, overrides::Overrides};

use crate::{
    error::CommandError,
    lumped, memory,
    output::ResultDirectory,
    phases::Phases,
    resolution::with_slices,
    scene::{Kind, Scene, Setting, SweepWay},
    talk,
};

/// Words of `ale-gear sweep`.
#[derive(Debug, clap::Args)]
pub(super) struct SweepArgs {
    /// Scene file
    scene: PathBuf,
    /// Folder for the results; it appears when they are complete
    #[arg(long, short, value_name = "DIR")]
    out: PathBuf,
    /// The key that changes, as `operation.speed_rpm`
    #[arg(long)]
    key: String,
    /// Its first value
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    from: f64,
    /// Its last value
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    to: f64,
    /// How many values
    #[arg(long, value_name = "N", default_value = "101")]
    points: u32,
    /// Space them evenly in the logarithm
    #[arg(long)]
    log: bool,
    /// Which way a motion goes: up and down go on from the last one, apart begins each at rest [default: up,down]
    #[arg(long, value_enum, value_delimiter = ',')]
    ways: Vec<Way>,
    /// How often the section of a motion has a point [default: mesh-cycle]
    #[arg(long, value_enum)]
    once: Option<Once>,
    /// Column of `history.csv`: of motions its section is taken, at rest mean, peak to peak, least and largest value
    /// [default: dte_um, at rest ste_um]
    #[arg(long, value_name = "COLUMN")]
    of: Option<String>,
    /// Points of a section [default: 64]
    #[arg(long, value_name = "N")]
    cycles: Option<u32>,
    /// Mesh cycles before it, at the most [default: the scene's `warm_up_cycles`, or 400]
    #[arg(long, value_name = "N")]
    settle: Option<u32>,
    /// Mesh cycles over which the largest Lyapunov exponent is found; 0: it is not [default: 200, impact: 0]
    #[arg(long, value_name = "N")]
    lyapunov: Option<u32>,
    #[command(flatten)]
    overrides: Overrides,
    #[command(flatten)]
    cache: CacheArgs,
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

/// Column whose section is taken where nobody says, and that whose cycles are read at rest.
const OF: [&str; 2] = ["dte_um", "ste_um"];
/// Points of a section likewise.
const CYCLES: u32 = 64;
/// Settling cycles where nobody says.
const SETTLE: u32 = 400;
/// Stretches of the exponent likewise.
const STRETCHES: u32 = 200;
/// Most values, and most points of a section.
const MOST: u32 = 100_000;

impl SweepArgs {
    fn cycles(&self) -> u32 {
        self.cycles.unwrap_or(CYCLES)
    }

    fn ways(&self) -> Vec<Way> {
        if self.ways.is_empty() { vec![Way::Up, Way::Down] } else { self.ways.clone() }
    }

    fn once(&self) -> Once {
        self.once.unwrap_or(Once::MeshCycle)
    }

    fn of(&self, at_rest: bool) -> &str {
        self.of.as_deref().unwrap_or(OF[usize::from(at_rest)])
    }

    /// All values, ascending.
    fn values(&self) -> Result<Vec<f64>, CommandError> {
        let refuse = |what: String, hint: &str| Err(CommandError::input(what, Some(hint.into())));
        for (word, n, low) in [("--points", self.points, 2), ("--cycles", self.cycles(), 1)] {
            if !(low..=MOST).contains(&n) {
                return refuse(format!("`{word}` is {n}, allowed is {low} .. {MOST}"), "a diagram has a few hundred");
            }
        }
        if !(self.from.is_finite() && self.to.is_finite() && self.from < self.to) {
            let what = format!("`--from {}` is not below `--to {}`", self.from, self.to);
            return refuse(what, "the way is said by `--ways`");
        }
        if self.log && self.from <= 0.0 {
            return refuse(format!("`--log` from {}", self.from), "logarithms begin above 0");
        }
        let last = self.points - 1;
        Ok((0..=last)
            .map(|i| match (i, self.log) {
                (0, _) => self.from,
                (i, _) if i == last => self.to,
                (i, true) => self.from * (self.to / self.from).powf(f64::from(i) / f64::from(last)),
                (i, false) => self.from + (self.to - self.from) * f64::from(i) / f64::from(last),
            })
            .collect())
    }

    /// Every complaint about words and scenes is made here, before any work starts or any file is written.
    fn plan(&self) -> Result<(Vec<(f64, Scene)>, SweepOptions), CommandError> {
        let (values, settings) = (self.values()?, self.overrides.settings()?);
        let mut scenes = Vec::with_capacity(values.len());
        for value in values {
            let own = Setting::number(&self.key, value)?.called(&format!("--key {} = {value}", self.key));
            let all: Vec<Setting> = settings.iter().cloned().chain([own]).collect();
            let mut scene = with_slices(Scene::read_with(&self.scene, &all)?);
            self.fits(&scene)?;
            if let Some(motion) = &mut scene.motion {
                let settle = self.settle.or(motion.warm_up_cycles).unwrap_or(SETTLE);
                motion.warm_up_cycles = Some(settle);
                motion.periodic_tolerance = Some(motion.periodic_tolerance.unwrap_or(1e-6));
            }
            // What the key is set to is in the tables; the settings are those of the whole.
            scene.set = settings.iter().map(Setting::word).collect();
            scenes.push((value, scene));
        }
        let impact = scenes.first().is_some_and(|(_, scene)| scene.impact.is_some());
        let mut ways: Vec<SweepWay> = Vec::new();
        for way in self.ways().iter().map(|w| w.word()) {
            if !ways.contains(&way) {
                ways.push(way);
            }
        }
        let first = scenes.first().map(|(_, scene)| scene);
        let quantity = first.map(|scene| lumped::quantity(scene, self.of(false))).transpose()?;
        let Some(quantity) = quantity else {
            return Err(analysis::AnalysisError::from(analysis::Refusal::no_values()).into());
        };
        let options = SweepOptions {
            key: self.key.clone(),
            ways,
            every: self.once().every(),
            quantity,
            points: self.cycles(),
            stretches: self.lyapunov.unwrap_or(if impact { 0 } else { STRETCHES }),
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

    /// The words behind the scene and the folder that make this sweep again.
    fn again(&self) -> String {
        let ways: Vec<String> = self.ways().iter().map(word_of).collect();
        let mut words = format!(
            "--key {} --from {} --to {} --points {}{} --ways {} --once {} --of {} --cycles {}",
            self.key,
            self.from,
            self.to,
            self.points,
            if self.log { " --log" } else { "" },
            ways.join(","),
            word_of(&self.once()),
            self.of(false),
            self.cycles()
        );
        for (word, value) in [("--settle", self.settle), ("--lyapunov", self.lyapunov)] {
            if let Some(value) = value {
                words.push_str(&format!(" {word} {value}"));
            }
        }
        words
    }

    /// Refuses scenes that have no motion, or leave the model open.
    fn fits(&self, scene: &Scene) -> Result<(), CommandError> {
        if scene.analysis.kind == Kind::Dynamic && (is_lumped(scene) || scene.analysis.model.is_reduced()) {
            return Ok(());
        }
        let hint = "use one model in time, or `kind = \"static\"`";
        let what = "a sweep wants a motion of one model, or a pair at rest";
        Err(CommandError::input(format_args!("{}: {what}", self.scene.display()), Some(hint.into())))
    }

    /// Runs all values; the text is the closing table.
    pub(super) fn execute(self) -> Result<String, CommandError> {
        let settings = self.overrides.settings()?;
        // As it stands first: what is wrong with the scene is not wrong with the key.
        let scene = with_slices(Scene::read_with(&self.scene, &settings)?);
        if scene.analysis.kind == Kind::Static {
            return self.run_at_rest(&scene);
        }
        self.fits(&scene)?;
        let mut phases = Phases::with_bars();
        let (scenes, options) = self.plan()?;
        let results = ResultDirectory::create(&self.out)?;
        let cache = self.cache.open();
        let again = self.again();
        let table = lumped::sweep_key(&scenes, &options, Some(&again), &mut phases, &results, &cache)?;
        results.finish(talk::note)?;
        Ok(format!("{table}\nresults: {}\n", self.out.display()))
    }
}
