//! The subcommands: typed words, then a checked plan, then work.

mod cache_args;
mod case_reports;
mod chart;
mod compare;
mod envelope;
mod geometry;
mod group_args;
mod init;
mod measured;
mod mesh;
mod mesh_reduce;
mod optimise;
mod overrides;
mod plan_case;
mod print;
mod report;
mod run;
mod serve;
mod target;
mod vary;
mod wrong_words;

use std::{
    io::Write,
    path::{Path, PathBuf},
};

use clap::{ArgAction, Args, Parser, Subcommand};

use crate::{
    error::CommandError,
    scene::{Document, DocumentKind},
    stop::on_stop,
    talk::{Verbosity, colours_on_stderr, read_progress_after, say, set_verbosity},
};

/// Reduced finite-element contact of helical gears
///
/// Without a subcommand it runs the built-in default pair into out/default. Exit status: 0 solved, 1 no result or a
/// failed check, 2 wrong input, 3 less accurate than requested.
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
#[command(next_help_heading = "Global options")]
struct Everywhere {
    /// Print only errors and the requested output
    #[arg(long, short, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Report progress on stderr; given twice, report intermediate findings as well
    #[arg(long, short, global = true, action = ArgAction::Count)]
    verbose: u8,
    /// Number of threads [default: all cores]
    #[arg(long, short = 'j', global = true, value_name = "N")]
    threads: Option<usize>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Run a document: the scene of a pair, a gearbox file, a plan, a study or an optimisation
    Run(run::RunArgs),
    /// Vary keys of a scene by list, range or sample, each case alone or continued from the last one
    Vary(vary::VaryArgs),
    /// Find the quietest micro-geometry within bounds and limits
    Optimise(optimise::OptimiseArgs),
    /// Chart accuracy against cost of every model and mesh density
    Chart(chart::ChartArgs),
    /// Run known failure modes of such solvers, naive and robust, and map where methods fail
    Envelope(envelope::EnvelopeArgs),
    /// Merge the files of `ale-gear vary --cases`
    Merge(vary::MergeArgs),
    /// Print the geometry sheet of a pair: diameters, roll angles, span, balls, backlash, sliding
    Geometry(geometry::GeometryArgs),
    /// Inspect, check, generate or reduce meshes
    #[command(subcommand)]
    Mesh(mesh::MeshCommand),
    /// Compare result folders: headline numbers, differences, curves
    Compare(compare::CompareArgs),
    /// Rewrite report.html of a result folder with this version of the program
    Report(report::ReportArgs),
    /// Open a local page with sliders, curves, contact pattern and gears in space
    Serve(serve::ServeArgs),
    /// Write a commented scene file from options or a few questions
    Init(init::InitArgs),
    /// Print the JSON Schema, shell completions, the manual page or licences
    #[command(subcommand)]
    Print(print::PrintCommand),
}

/// A file into a folder, with words that all documents know.
#[derive(Debug, Default)]
struct FileWords {
    file: PathBuf,
    out: PathBuf,
    overrides: overrides::Overrides,
    cache: cache_args::CacheArgs,
    json: bool,
}

/// Kind of the document in a file; `None` where it has none of a known kind. A pipe, which can be read no second time, is
/// left for who runs it.
fn kind_of_file(file: &Path) -> Option<DocumentKind> {
    if file.is_file() { Document::read(file).ok()?.kind() } else { None }
}

/// What a command has to say when its work is done.
#[derive(Debug, Default)]
pub struct Answer {
    /// For stdout.
    pub text: String,
    /// For stderr: files are written, but the result does not hold.
    pub failure: Option<CommandError>,
}

impl Answer {
    /// What stands on stdout where a folder was written: its summary, nothing, or the closing table.
    fn of_folder(
        out: &Path,
        (table, failure): (String, Option<CommandError>),
        (json, quiet): (bool, bool),
    ) -> Result<Self, CommandError> {
        let summary = out.join("summary.json");
        let text = match (json, quiet) {
            (true, _) => files::read_regular_text(&summary, files::most::SUMMARY)
                .map_err(|e| CommandError::failed(format_args!("{}: {e}", summary.display()), None))?,
            (_, true) => String::new(),
            _ => format!("{table}\nresults: {}\n", out.display()),
        };
        Ok(Self { text, failure })
    }
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
            if let Some(said) = wrong_words::complaint(&error, &std::env::args_os().collect::<Vec<_>>()) {
                let _ = std::io::stderr().lock().write_all(said.text(colours_on_stderr()).as_bytes());
                std::process::exit(said.status.into());
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
        set_verbosity(match (quiet, verbose) {
            (true, _) => Verbosity::Quiet,
            (_, 0) => Verbosity::Bars,
            (_, 1) => Verbosity::Steps,
            _ => Verbosity::Details,
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
            Some(Command::Run(args)) => match args.kind() {
                Some(DocumentKind::Plan | DocumentKind::Study) => {
                    return vary::VaryArgs::of_file(args.many()?).execute(quiet);
                }
                Some(DocumentKind::Optimisation) => {
                    return optimise::OptimiseArgs::of_file(args.many()?).execute(quiet);
                }
                _ => return args.execute(quiet),
            },
            Some(Command::Envelope(args)) => return args.execute(),
            Some(Command::Optimise(args)) => return args.execute(quiet),
            Some(Command::Vary(args)) => return args.execute(quiet),
            Some(Command::Chart(args)) => args.execute().map(told),
            Some(Command::Merge(args)) => args.execute().map(told),
            Some(Command::Geometry(args)) => args.execute(),
            Some(Command::Init(args)) => args.execute(quiet),
            Some(Command::Compare(args)) => args.execute(),
            Some(Command::Report(args)) => args.execute(quiet),
            Some(Command::Serve(args)) => args.execute(),
            Some(Command::Print(what)) => what.execute(),
            Some(Command::Mesh(command)) => command.execute(quiet),
        };
        text.map(Answer::from)
    }
}

/// Threads a core from which on a user hears of it.
const OVER_CORES: usize = 4;

/// More than any machine has cores for; a hundred thousand only make the system busy with starting them.
const MOST_THREADS: usize = 1024;

/// Threads of the whole process, all cores where nothing is said.
fn use_threads(threads: Option<usize>) {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    if let Some(threads) = threads.filter(|n| *n > OVER_CORES * cores) {
        say(Verbosity::Bars, || {
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
