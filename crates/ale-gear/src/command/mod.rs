//! The subcommands: typed words, then a checked plan, then work.

mod cache_args;
mod case;
mod case_reports;
mod chart;
mod compare;
mod curve;
mod envelope;
mod geometry;
mod init;
mod mesh;
mod optimise;
mod overrides;
mod reduce;
mod report;
mod run;
mod schema;
mod serve;
mod shell;
mod study;
mod sweep;
mod target;
mod vary;

use std::{ffi::OsString, io::Write};

use clap::{
    ArgAction, Args, Parser, Subcommand,
    error::{ContextKind, ContextValue},
};
use clap_complete::Shell;

use crate::{
    error::CommandError,
    printed,
    stop::on_stop,
    talk::{Loudness, colours_on_stderr, read_progress_after, say, set_loudness},
};

/// Reduced finite-element contact of helical gears
///
/// Without a subcommand it runs the default pair, which is in the program with its meshes, into out/default.
/// Exit status: 0 solved, 1 no result or one that does not hold, 2 wrong input, 3 less exact than asked.
#[derive(Debug, Parser)]
#[command(name = "ale-gear", version)]
pub struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    everywhere: Everywhere,
}

/// Words that every subcommand knows.
#[derive(Debug, Args)]
#[command(next_help_heading = "Everywhere")]
struct Everywhere {
    /// Say nothing but errors, and what was asked for on stdout
    #[arg(long, short, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Say on stderr what is being done; twice: what is found on the way as well
    #[arg(long, short, global = true, action = ArgAction::Count)]
    verbose: u8,
    /// Threads [default: all cores]
    #[arg(long, short = 'j', global = true, value_name = "N")]
    threads: Option<usize>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Run a scene of a pair, or a gearbox file, and write its result folder
    Run(run::RunArgs),
    /// Write a commented scene to begin with, from flags or from a few questions
    Init(init::InitArgs),
    /// Run every model and mesh density on a scene: accuracy against cost
    Chart(chart::ChartArgs),
    /// Run a scene at many values of a key: bifurcation diagrams and resonance curves of motions, curves of a pair at rest
    Sweep(sweep::SweepArgs),
    /// Follow the periodic motions of a pair along a key, around folds: resonance curves with their unstable parts
    Curve(curve::CurveArgs),
    /// Run several scenes and draw the same figures of all
    Study(study::StudyArgs),
    /// Run a scene with some of its keys varied, by list, grid or sample: a row of wanted numbers a case
    Vary(vary::VaryArgs),
    /// Solve some cases of a plan into a file: for many machines, in any order, as often as need be
    Case(case::CaseArgs),
    /// Put the files of `ale-gear case` together
    Merge(case::MergeArgs),
    /// Search the micro-geometry that is quietest, within bounds and limits
    Optimise(optimise::OptimiseArgs),
    /// Every way in which such solvers fail: naive and robust, and maps of where methods fail
    Envelope(envelope::EnvelopeArgs),
    /// Geometry sheet of a scene's pair on stdout: diameters, roll angles, span, balls, backlash, sliding
    Geometry(geometry::GeometryArgs),
    /// Reduce the gears of a scene into the cache, or that of a mesh file, and tell what it takes
    Reduce(reduce::ReduceArgs),
    /// Result folders side by side: headline numbers with differences, curves over each other
    Compare(compare::CompareArgs),
    /// Make report.html of a result folder again, with the pages of this version
    Report(report::ReportArgs),
    /// A page on this machine where a pair is tried by hand: sliders, curves, pattern, gears in space
    Serve(serve::ServeArgs),
    /// JSON Schema of the scene file, or of the gearbox file, on stdout, for completion and checks in editors
    Schema(schema::SchemaArgs),
    /// Script on stdout that completes words in a shell
    Completions {
        /// Which shell
        shell: Shell,
    },
    /// Manual page on stdout (roff), as in `ale-gear man | man -l -`
    Man,
    /// Licences of the program, and of everything by others that it carries, on stdout
    #[command(alias = "licenses")]
    Licences,
    /// Look at, check or make meshes
    #[command(subcommand)]
    Mesh(mesh::MeshCommand),
}

/// Licences of everything that the program carries; `.ci/notices` writes the file.
const NOTICES: &str = include_str!("../../../../NOTICES.txt");

/// What a command has to say when its work is done.
#[derive(Debug, Default)]
pub struct Answer {
    /// For stdout.
    pub text: String,
    /// For stderr: files are written, but the result does not hold.
    pub failure: Option<CommandError>,
}

impl From<String> for Answer {
    fn from(text: String) -> Self {
        Self { text, failure: None }
    }
}

impl Cli {
    /// The command line of this process; a wrong one, and `--help`, end the process here.
    pub fn of_process() -> Self {
        Self::try_parse().unwrap_or_else(|error| {
            if let Some(said) = of_an_old_word(&error, std::env::args_os()) {
                let _ = std::io::stderr().lock().write_all(said.text(colours_on_stderr()).as_bytes());
                std::process::exit(said.status.into());
            }
            let error = with_a_way_out(error);
            let said = error.render().to_string();
            let shown = printed::message(&said);
            if error.use_stderr() && shown != said {
                // Words of the command line are quoted as they are; without them the usual way has colours.
                let _ = std::io::stderr().lock().write_all(shown.as_bytes());
                std::process::exit(error.exit_code());
            }
            error.exit()
        })
    }

    /// Does what was asked.
    ///
    /// # Errors
    /// The one message for stderr, with the exit status.
    pub fn execute(self) -> Result<Answer, CommandError> {
        let Everywhere { quiet, verbose, threads } = self.everywhere;
        set_loudness(match (quiet, verbose) {
            (true, _) => Loudness::Quiet,
            (_, 0) => Loudness::Bars,
            (_, 1) => Loudness::Steps,
            _ => Loudness::Details,
        });
        read_progress_after()?;
        on_stop();
        if let Some(n) = threads.filter(|n| !(1..=MOST_THREADS).contains(n)) {
            let hint = "leave it out to use all cores".to_owned();
            let message = format_args!("`--threads` is {n}, allowed is 1 .. {MOST_THREADS}");
            return Err(CommandError::input(message, Some(hint)));
        }
        use_threads(threads);
        // A table at the end of work is talk; what a command is made for is data.
        let told = |text: String| if quiet { String::new() } else { text };
        let text = match self.command {
            None => return run::RunArgs::for_default_scene().execute(quiet),
            Some(Command::Run(args)) => return args.execute(quiet),
            Some(Command::Envelope(args)) => return args.execute(),
            Some(Command::Curve(args)) => return args.execute(quiet),
            Some(Command::Optimise(args)) => return args.execute(quiet),
            Some(Command::Chart(args)) => args.execute().map(told),
            Some(Command::Study(args)) => args.execute().map(told),
            Some(Command::Vary(args)) => args.execute().map(told),
            Some(Command::Case(args)) => args.execute(told),
            Some(Command::Merge(args)) => args.execute().map(told),
            Some(Command::Sweep(args)) => args.execute().map(told),
            Some(Command::Geometry(args)) => args.execute(),
            Some(Command::Init(args)) => args.execute(quiet),
            Some(Command::Reduce(args)) => args.execute(),
            Some(Command::Compare(args)) => args.execute(),
            Some(Command::Report(args)) => args.execute(quiet),
            Some(Command::Serve(args)) => args.execute(),
            Some(Command::Schema(args)) => Ok(args.execute()),
            Some(Command::Licences) => Ok(NOTICES.to_owned()),
            Some(Command::Completions { shell }) => Ok(shell::completions(shell)),
            Some(Command::Man) => shell::man(),
            Some(Command::Mesh(command)) => command.execute(quiet),
        };
        text.map(Answer::from)
    }
}

/// Subcommands that are gone, and what does their work now; `{}` stands for the file.
const OLD_WORDS: [(&str, &str); 1] = [("gearbox", "`ale-gear run {} --out DIR` takes it")];

/// What is said of a subcommand that is gone; `None` of any other mistake. `typed`: the whole command line.
fn of_an_old_word(error: &clap::Error, mut typed: impl Iterator<Item = OsString>) -> Option<CommandError> {
    let Some(ContextValue::String(word)) = error.get(ContextKind::InvalidSubcommand) else { return None };
    let (_, now) = OLD_WORDS.iter().find(|(old, _)| old == word)?;
    let file = typed.find_map(|word| word.into_string().ok().filter(|word| word.ends_with(".toml")));
    let hint = now.replace("{}", file.as_deref().unwrap_or("FILE.toml"));
    Some(CommandError::input(format_args!("the subcommand `{word}` is gone"), Some(hint)))
}

/// Who gives a scene where a subcommand is wanted is told which one takes it.
fn with_a_way_out(mut error: clap::Error) -> clap::Error {
    let word = match error.get(ContextKind::InvalidSubcommand) {
        Some(ContextValue::String(word)) if word.ends_with(".toml") => word.clone(),
        _ => return error,
    };
    let tip = format!("to run it: ale-gear run {word} --out DIR");
    error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip.into()]));
    error
}

/// Threads a core from which on a user hears of it.
const OVER_CORES: usize = 4;

/// More than any machine has cores for; a hundred thousand only make the system busy with starting them.
const MOST_THREADS: usize = 1024;

/// Threads of the whole process, all cores where nothing is said.
fn use_threads(threads: Option<usize>) {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    if let Some(threads) = threads.filter(|n| *n > OVER_CORES * cores) {
        say(Loudness::Bars, || {
            format!(
                "ale-gear: {threads} threads on {cores} cores: most of them only wait and take memory; leave `--threads` out \
                 to use all cores"
            )
        });
    }
    if let Some(threads) = threads {
        // Fails only when a pool is there already, which nobody has made before this line.
        let _ = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
    }
}
