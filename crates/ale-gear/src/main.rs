//! The command: a thin shell around the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    match ale_gear::command::Cli::of_process().execute() {
        Ok(text) => {
            print(&text);
            ExitCode::SUCCESS
        }
        Err(error) => {
            complain(&error.text(ale_gear::talk::colours_on_stderr()));
            ExitCode::from(error.status)
        }
    }
}

/// A reader that has gone (`ale-gear ... | head`) is no failure of the run.
fn print(text: &str) {
    use std::io::Write;
    let _ = std::io::stdout().lock().write_all(text.as_bytes());
}

fn complain(text: &str) {
    use std::io::Write;
    let _ = std::io::stderr().lock().write_all(text.as_bytes());
}
