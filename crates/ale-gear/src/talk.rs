//! How much is said on stderr, and whether in colour. Data goes to stdout and is not touched by this.

use std::fmt::Display;
use std::io::{IsTerminal, Write};
use std::sync::atomic::{AtomicU8, Ordering};

/// How much is said while work is done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Loudness {
    /// Errors only.
    Quiet,
    /// Progress bars, where stderr is a terminal.
    Bars,
    /// A line for every step.
    Steps,
    /// And what is found on the way.
    Details,
}

const ALL: [Loudness; 4] = [Loudness::Quiet, Loudness::Bars, Loudness::Steps, Loudness::Details];
/// Of this process, as its command line says.
static LOUDNESS: AtomicU8 = AtomicU8::new(Loudness::Bars as u8);

/// Sets how much the whole process says.
pub fn set_loudness(loudness: Loudness) {
    LOUDNESS.store(loudness as u8, Ordering::Relaxed);
}

/// How much the process says.
pub fn loudness() -> Loudness {
    ALL[usize::from(LOUDNESS.load(Ordering::Relaxed)).min(ALL.len() - 1)]
}

/// Says a line on stderr if that much is wanted.
pub(crate) fn say<D: Display>(from: Loudness, line: impl FnOnce() -> D) {
    if loudness() >= from {
        // Whoever has closed stderr does not want to hear it.
        let _ = writeln!(std::io::stderr().lock(), "{}", line());
    }
}

/// Whether stderr takes colours: it is a terminal that can, and nobody has set `NO_COLOR`.
pub fn colours_on_stderr() -> bool {
    let said_no = std::env::var_os("NO_COLOR").is_some_and(|v| !v.is_empty());
    let dumb = std::env::var_os("TERM").is_some_and(|v| v == "dumb");
    !said_no && !dumb && std::io::stderr().is_terminal()
}
