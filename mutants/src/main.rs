//! Mutation tests: small changes of the sources ("mutants"), each of which some test has to notice.
//!
//! All mutants live in one build, in branches that an environment variable chooses ("schemata"): building the tests for
//! each of them takes minutes, and there are thousands. `prepare` draws mutants and builds a copy of the workspace with
//! them, `cover` finds which test reaches which, `run` tries each mutant on the tests that reach it, `list` writes the
//! survivors.

mod build;
mod cover;
mod outcome;
mod sites;
mod tests;
mod tree;

use std::{error::Error, path::PathBuf, time::Duration};

use clap::{Parser, Subcommand};

use outcome::Wanted;

/// Crates whose sources are changed.
const CRATES: [&str; 6] = ["geometry", "reduction", "ale", "contact", "ltca", "dynamics"];

#[derive(Parser)]
#[command(about = "Mutation tests of the numerical crates; see docs/mutants.md")]
struct Words {
    /// Folder of the copy that is changed and built, and of what was found.
    #[arg(long, default_value = "target/work")]
    work: PathBuf,
    #[command(subcommand)]
    step: Step,
}

#[derive(Subcommand)]
enum Step {
    /// Draws mutants, writes them into a copy of the workspace and builds its tests.
    Prepare {
        /// Seed of the draw.
        #[arg(long, default_value_t = 2026)]
        seed: u64,
        /// How many are drawn of all.
        #[arg(long, default_value_t = 600)]
        sample: usize,
        /// The checkout.
        #[arg(long, default_value = "..")]
        root: PathBuf,
    },
    /// Runs each test once and notes its time and the mutants that it reaches.
    Cover {
        /// Seconds after which a test is of no use here.
        #[arg(long, default_value_t = 60)]
        longest: u64,
        /// Test programs that are not looked at: they read files that the copy has not, or run the command.
        #[arg(long, value_delimiter = ',', default_value = "documents,other_programs,robustness,fuzz_corpus,command")]
        leave_out: Vec<String>,
    },
    /// Tries the mutants that have no outcome yet.
    Run {
        /// How many at a time.
        #[arg(long, default_value_t = 2)]
        jobs: usize,
        /// Seconds of tests after which a mutant that none has noticed counts as a survivor.
        #[arg(long, default_value_t = 120.0)]
        budget: f64,
        /// Tests whose names hold this come first, whatever their time.
        #[arg(long)]
        first: Option<String>,
        /// Survivors once more.
        #[arg(long)]
        survivors: bool,
        /// These alone, once more.
        #[arg(long, value_delimiter = ',')]
        only: Vec<usize>,
    },
    /// Counts by crate, and the survivors.
    List,
}

fn main() -> Result<(), Box<dyn Error>> {
    let words = Words::parse();
    match words.step {
        Step::Prepare { seed, sample, root } => build::prepare(&root, &words.work, seed, sample),
        Step::Cover { longest, leave_out } => cover::cover(&words.work, Duration::from_secs(longest), &leave_out),
        Step::Run { jobs, budget, first, survivors, only } => {
            outcome::run(&words.work, jobs, budget, first.as_deref(), &Wanted { survivors, only })
        }
        Step::List => outcome::list(&words.work),
    }
}
