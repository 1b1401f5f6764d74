//! How much is said on stderr, and whether in colour. Data goes to stdout and is not touched by this.

use std::fmt::Display;
use std::io::{IsTerminal, Write};
use std::sync::atomic::{AtomicU8, AtomicU64, Ordering};

use crate::{error::CommandError, printed};

/// How much is said while work is done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verbosity {
    /// Errors only.
    Quiet,
    /// Progress bars, where stderr is a terminal.
    Bars,
    /// A line for every step.
    Steps,
    /// And what is found on the way.
    Details,
}

const ALL: [Verbosity; 4] = [Verbosity::Quiet, Verbosity::Bars, Verbosity::Steps, Verbosity::Details];
/// Verbosity of this process, as its command line says.
static VERBOSITY: AtomicU8 = AtomicU8::new(Verbosity::Bars as u8);

/// Sets how much the whole process says.
pub fn set_verbosity(verbosity: Verbosity) {
    VERBOSITY.store(verbosity as u8, Ordering::Relaxed);
}

/// How much the process says.
pub fn verbosity() -> Verbosity {
    ALL[usize::from(VERBOSITY.load(Ordering::Relaxed)).min(ALL.len() - 1)]
}

/// Variable of the environment: seconds into a phase at which a log gets its first line on how far it is, or `never`.
pub const PROGRESS_AFTER_S: &str = "ALE_GEAR_PROGRESS_AFTER_S";
/// Word of [`PROGRESS_AFTER_S`] for no such lines.
const NEVER: &str = "never";
/// Seconds of this process; the largest number stands for never. Twenty where the environment says nothing.
static PROGRESS_AFTER: AtomicU64 = AtomicU64::new(20);

/// Takes [`PROGRESS_AFTER_S`] from the environment.
///
/// # Errors
/// When it is neither whole seconds nor `never`.
pub(crate) fn read_progress_after() -> Result<(), CommandError> {
    let Some(word) = std::env::var_os(PROGRESS_AFTER_S) else { return Ok(()) };
    let word = word.to_string_lossy();
    let seconds = if word == NEVER { Some(u64::MAX) } else { word.parse().ok() };
    let wrong = || {
        let hint = "unset it for 20 s; it is a variable of the environment".to_owned();
        let allowed = format!("allowed are whole seconds and `{NEVER}`");
        CommandError::input(format_args!("{PROGRESS_AFTER_S} is `{word}`, {allowed}"), Some(hint))
    };
    PROGRESS_AFTER.store(seconds.ok_or_else(wrong)?, Ordering::Relaxed);
    Ok(())
}

/// Seconds into a phase at which a log gets its first line on how far it is; `None`: no such lines.
pub(crate) fn progress_after_s() -> Option<u64> {
    Some(PROGRESS_AFTER.load(Ordering::Relaxed)).filter(|&s| s < u64::MAX)
}

/// Says a line on stderr if that much is wanted.
pub(crate) fn say<D: Display>(from: Verbosity, line: impl FnOnce() -> D) {
    if verbosity() >= from {
        write(&printed::message(&printed::units(&line().to_string())));
    }
}

/// Says what is wrong, and a line behind it.
pub(crate) fn complain(error: &CommandError, behind: &str) {
    write(&format!("\n{}{behind}", error.text(colours_on_stderr())));
}

fn write(line: &str) {
    // Whoever has closed stderr does not want to hear it.
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

/// Says what the user should know however little is to be said.
pub(crate) fn note(message: String) {
    say(Verbosity::Quiet, || format!("ale-gear: {message}"));
}

/// Whether stderr takes colours: it is a terminal that can, and nobody has set `NO_COLOR`.
pub fn colours_on_stderr() -> bool {
    let said_no = std::env::var_os("NO_COLOR").is_some_and(|v| !v.is_empty());
    let dumb = std::env::var_os("TERM").is_some_and(|v| v == "dumb");
    !said_no && !dumb && std::io::stderr().is_terminal()
}
