//! `ale-gear print`: what editors, shells, manuals and lawyers want to know.

use clap::{CommandFactory, Subcommand};
use clap_complete::Shell;
use scene::json_schema;

use super::Cli;
use crate::error::CommandError;

/// Subcommands of `ale-gear print`.
#[derive(Debug, Subcommand)]
pub(super) enum PrintCommand {
    /// JSON Schema of documents, for completion and checks in editors
    Schema,
    /// Script that completes words in a shell
    Completions {
        /// Which shell
        shell: Shell,
    },
    /// Manual page (roff), as in `ale-gear print man | man -l -`
    Man,
    /// Licences of the program, and of everything by others that it carries
    #[command(alias = "licenses")]
    Licences,
}

/// Licences of everything that the program carries; `.ci/notices` writes the file.
const NOTICES: &str = include_str!("../../../../NOTICES.txt");

impl PrintCommand {
    /// The text.
    pub(super) fn execute(self) -> Result<String, CommandError> {
        match self {
            Self::Schema => Ok(format!("{:#}\n", json_schema())),
            Self::Completions { shell } => Ok(completions(shell)),
            Self::Man => man(),
            Self::Licences => Ok(NOTICES.to_owned()),
        }
    }
}

/// The script that completes words in a shell.
fn completions(shell: Shell) -> String {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "ale-gear", &mut script);
    String::from_utf8_lossy(&script).into_owned()
}

/// The manual page in roff: of the whole program, then of each subcommand.
fn man() -> Result<String, CommandError> {
    let mut page = Vec::new();
    let mut command = Cli::command();
    command.build();
    render(command, &mut page).map_err(|e| CommandError::failed(format_args!("the manual page: {e}"), None))?;
    Ok(String::from_utf8_lossy(&page).into_owned())
}

/// A page, and below it those of its subcommands.
fn render(command: clap::Command, page: &mut Vec<u8>) -> std::io::Result<()> {
    let inner: Vec<clap::Command> = command.get_subcommands().filter(|c| c.get_name() != "help").cloned().collect();
    clap_mangen::Man::new(command).render(page)?;
    inner.into_iter().try_for_each(|c| render(c, page))
}
