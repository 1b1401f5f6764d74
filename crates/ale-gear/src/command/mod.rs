//! The subcommands: typed words, then a checked plan, then work.

mod chart;
mod compare;
mod default_scene;
mod init;
mod mesh;
mod overrides;
mod run;
mod schema;

use clap::{Parser, Subcommand};

use crate::error::CommandError;

/// Reduced finite-element contact of helical gears
///
/// Without a subcommand it runs the default scene of this repository into out/default.
/// Exit status: 0 solved, 1 no result, 2 wrong input.
#[derive(Debug, Parser)]
#[command(name = "ale-gear", version)]
pub struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Run a scene and write its result folder
    Run(run::RunArgs),
    /// Write a commented scene to begin with, from flags or from a few questions
    Init(init::InitArgs),
    /// Run every model and mesh density on a scene: accuracy against cost
    Chart(chart::ChartArgs),
    /// Result folders side by side: headline numbers with differences, curves over each other
    Compare(compare::CompareArgs),
    /// JSON Schema of the scene file on stdout, for completion and checks in editors
    Schema,
    /// Look at, check or make meshes
    #[command(subcommand)]
    Mesh(mesh::MeshCommand),
}

impl Cli {
    /// Does what was asked; the text is for stdout.
    ///
    /// # Errors
    /// The one message for stderr, with the exit status.
    pub fn execute(self) -> Result<String, CommandError> {
        match self.command {
            None => run::RunArgs::for_default_scene()?.execute(),
            Some(Command::Run(args)) => args.execute(),
            Some(Command::Chart(args)) => args.execute(),
            Some(Command::Init(args)) => args.execute(),
            Some(Command::Compare(args)) => args.execute(),
            Some(Command::Schema) => Ok(schema::execute()),
            Some(Command::Mesh(command)) => command.execute(),
        }
    }
}

/// Threads of the whole process, all cores where nothing is said.
fn use_threads(threads: Option<usize>) {
    if let Some(threads) = threads {
        // Fails only when a pool is there already, which nobody has made before this line.
        let _ = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
    }
}
