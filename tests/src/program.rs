//! The program itself in a process of its own: a binary of this crate that calls [`as_command`] first is `ale-gear`
//! where its first word says so. So the tests here run what is built with them and no older one.

use std::{
    io::{self, Write},
    path::Path,
    process::{Command, ExitCode},
};

use ale_gear::command::Cli;
use clap::Parser;

/// First word of a process that is to be `ale-gear`.
const AS_ALE_GEAR: &str = "ale-gear";

/// Where the words of this process ask for `ale-gear RUN ...`, it is that program.
pub fn as_command() -> Option<ExitCode> {
    let words: Vec<_> = std::env::args_os().skip(1).collect();
    if words.first().is_none_or(|w| w != AS_ALE_GEAR) {
        return None;
    }
    let (status, out, complaint) = match Cli::try_parse_from(words) {
        Err(usage) => (2, String::new(), usage.to_string()),
        Ok(cli) => match cli.execute() {
            Err(error) => (error.status, String::new(), error.text(false)),
            Ok(answer) => match answer.failure {
                None => (0, answer.text, String::new()),
                Some(error) => (error.status, answer.text, error.text(false)),
            },
        },
    };
    let _ = io::stdout().lock().write_all(out.as_bytes());
    let _ = io::stderr().lock().write_all(complaint.as_bytes());
    Some(ExitCode::from(status))
}

/// A process of `program` as `ale-gear` with these words in a folder, with its cache there.
pub fn ale_gear(program: &Path, folder: &Path, words: &[&str]) -> Command {
    let mut command = Command::new(program);
    command.arg(AS_ALE_GEAR).args(words);
    here(&mut command, folder);
    command
}

/// The program behind a line of shell, as `ulimit -v 1000000`.
pub fn behind(line: &str, program: &Path, folder: &Path, words: &[&str]) -> Command {
    let mut command = Command::new("sh");
    command.args(["-c", &format!("{line}; exec \"$0\" \"$@\"")]).arg(program).arg(AS_ALE_GEAR).args(words);
    here(&mut command, folder);
    command
}

fn here(command: &mut Command, folder: &Path) {
    command.current_dir(folder).env("XDG_CACHE_HOME", folder.join("user_cache"));
    command.env(ale_gear::talk::PROGRESS_AFTER_S, "never").env("RUST_BACKTRACE", "1");
}
