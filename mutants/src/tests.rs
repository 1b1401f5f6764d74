//! One test in a process of its own.

use std::{
    os::unix::process::CommandExt,
    process::{Command, Stdio},
    thread::sleep,
    time::{Duration, Instant},
};

use rustix::process::{Pid, Signal, kill_process_group};
use serde::{Deserialize, Serialize};

use crate::build::Binary;

/// A test, its time and the mutants that it reaches.
#[derive(Clone, Serialize, Deserialize)]
pub struct Test {
    pub binary: usize,
    pub name: String,
    pub seconds: f64,
    pub reaches: Vec<u32>,
}

/// How a test ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub enum Ended {
    Passed,
    Failed,
    /// It took many times its time.
    TooLong,
}

/// Memory that a test may take, in kB: a mutant may ask for all there is.
const MEMORY_KB: u64 = 6_000_000;

/// Names of the tests of a program that are not ignored.
pub fn names(binary: &Binary) -> std::io::Result<Vec<String>> {
    let listed = |words: &[&str]| -> std::io::Result<Vec<String>> {
        let output = Command::new(&binary.path).args(words).args(["--list", "--format", "terse"]).output()?;
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        Ok(text.lines().filter_map(|l| l.strip_suffix(": test")).map(str::to_string).collect())
    };
    let ignored = listed(&["--ignored"])?;
    Ok(listed(&[])?.into_iter().filter(|n| !ignored.contains(n)).collect())
}

/// Runs one test. `chosen`: a mutant's number, or `watch`.
pub fn run(binary: &Binary, name: &str, chosen: &str, seen: Option<&str>, limit: Duration) -> std::io::Result<Ended> {
    let mut command = Command::new("sh");
    command
        .args(["-c", &format!("ulimit -v {MEMORY_KB}; exec \"$0\" \"$@\"")])
        .arg(&binary.path)
        .args(["--exact", name, "--test-threads", "1"])
        .current_dir(&binary.folder)
        .env("CARGO_MANIFEST_DIR", &binary.folder)
        .env("MUTANT", chosen)
        .env("RAYON_NUM_THREADS", "2")
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .process_group(0);
    if let Some(seen) = seen {
        command.env("MUTANTS_SEEN", seen);
    }
    let mut child = command.spawn()?;
    let start = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(if status.success() { Ended::Passed } else { Ended::Failed });
        }
        if start.elapsed() > limit {
            // The group: programs that the test has started go with it.
            if let Some(group) = Pid::from_raw(child.id() as i32) {
                _ = kill_process_group(group, Signal::KILL);
            }
            child.wait()?;
            return Ok(Ended::TooLong);
        }
        sleep(Duration::from_millis(5));
    }
}
