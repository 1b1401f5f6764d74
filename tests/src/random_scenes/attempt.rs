//! The program run on one scene in a process of its own, within limits of time and memory.

use std::{
    fs, io,
    path::Path,
    process::{ExitStatus, Stdio},
    time::{Duration, Instant},
};

use crate::program::behind;

/// How often a running process is looked at.
const GLANCE: Duration = Duration::from_millis(2);

/// What a small scene may take.
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    /// After so many seconds it hangs.
    pub seconds: f64,
    /// Address space, kB.
    pub memory_kb: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { seconds: 300.0, memory_kb: 6_000_000 }
    }
}

/// How a process ended.
#[derive(Debug, Clone)]
pub struct Attempt {
    /// `None` where a signal ended it, or the limit of time.
    pub status: Option<i32>,
    /// Whether the limit of time ended it.
    pub late: bool,
    /// What it said on stderr.
    pub said: String,
    /// Wall time.
    pub seconds: f64,
}

/// Runs `ale-gear` with these words in a folder.
///
/// # Errors
/// When no process can be started.
pub(super) fn run(program: &Path, folder: &Path, words: &[&str], limits: Limits) -> io::Result<Attempt> {
    let heard = folder.join("stderr.txt");
    let start = Instant::now();
    // The shell's own limit: there is none in the standard library.
    let mut command = behind(&format!("ulimit -v {}", limits.memory_kb), program, folder, words);
    let mut child = command.stdout(Stdio::null()).stderr(fs::File::create(&heard)?).spawn()?;
    let mut late = false;
    let status: ExitStatus = loop {
        if let Some(status) = child.try_wait()? {
            break status;
        }
        if start.elapsed().as_secs_f64() > limits.seconds {
            late = true;
            child.kill()?;
        }
        std::thread::sleep(GLANCE);
    };
    let said = String::from_utf8_lossy(&fs::read(&heard)?).into_owned();
    Ok(Attempt { status: status.code().filter(|_| !late), late, said, seconds: start.elapsed().as_secs_f64() })
}
