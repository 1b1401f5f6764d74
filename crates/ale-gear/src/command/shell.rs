//! `ale-gear completions` and `ale-gear man`: what shells and manuals want to know of the command line.

use clap::CommandFactory;
use clap_complete::Shell;

use super::Cli;
use crate::error::CommandError;

/// The script that completes words in a shell.
pub(super) fn completions(shell: Shell) -> String {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "ale-gear", &mut script);
    String::from_utf8_lossy(&script).into_owned()
}

/// The manual page in roff: of the whole program, then of each subcommand.
pub(super) fn man() -> Result<String, CommandError> {
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
