//! The command: a thin shell around the library.

use std::io::{ErrorKind, Write};
use std::process::ExitCode;

fn main() -> ExitCode {
    let ended = ale_gear::command::Cli::of_process().execute();
    // A process that is being stopped says nothing more, and its status is that of the stop.
    ale_gear::stop::unless_stopping();
    match ended {
        Ok(answer) => {
            let printed = print(&answer.text);
            match answer.failure {
                None => printed,
                Some(error) => {
                    complain(&error.text(ale_gear::talk::colours_on_stderr()));
                    ExitCode::from(error.status)
                }
            }
        }
        Err(error) => {
            complain(&error.text(ale_gear::talk::colours_on_stderr()));
            ExitCode::from(error.status)
        }
    }
}

/// A reader that has gone (`ale-gear ... | head`) is no failure of the run.
fn print(text: &str) -> ExitCode {
    let mut out = std::io::stdout().lock();
    match out.write_all(ale_gear::printed::plain(text).as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            complain(&format!("ale-gear: stdout cannot be written: {error}\nhint: is the disk full?\n"));
            ExitCode::from(1)
        }
        _ => ExitCode::SUCCESS,
    }
}

fn complain(text: &str) {
    let _ = std::io::stderr().lock().write_all(text.as_bytes());
}
