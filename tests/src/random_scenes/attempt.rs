//! One scene run in a process of its own, within limits of time and memory.

use std::{
    fs, io,
    path::Path,
    process::{ExitStatus, Stdio},
    time::{Duration, Instant},
};

use super::{RandomScene, Refusals, Verdict, judge, mirror};
use crate::program::behind;

/// How often a running process is looked at.
const GLANCE: Duration = Duration::from_millis(2);
/// One scene in so many is solved in a mirror as well.
const MIRRORED: u64 = 4;

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
fn run(program: &Path, folder: &Path, words: &[&str], limits: Limits) -> io::Result<Attempt> {
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

/// Writes a scene and its files into a folder.
fn lay_out(draft: &super::Draft, folder: &Path, name: &str) -> io::Result<()> {
    fs::write(folder.join(name), draft.text().map_err(io::Error::other)?)?;
    for (file, content) in &draft.files {
        fs::write(folder.join(file), content)?;
    }
    let link = folder.join("meshes");
    if !link.exists() {
        std::os::unix::fs::symlink(crate::meshes_folder().canonicalize()?, link)?;
    }
    Ok(())
}

/// Solves a scene in an empty folder, and says what became of it.
///
/// # Errors
/// When files cannot be written or no process can be started: nothing of the scene's.
pub fn try_scene(
    program: &Path,
    folder: &Path,
    index: u64,
    scene: &RandomScene,
    (limits, refusals): (Limits, &Refusals),
) -> io::Result<Verdict> {
    lay_out(&scene.draft, folder, "scene.toml")?;
    let words = |scene, out| ["run", scene, "--out", out, "--no-cache", "--quiet", "--threads", "1"];
    let attempt = run(program, folder, &words("scene.toml", "o"), limits)?;
    let mut verdict = Verdict::of(index, scene, &attempt, refusals);
    if matches!(attempt.status, Some(0 | 3)) && !folder.join("o/summary.json").exists() {
        verdict.wrong.push(format!("status {:?}, and there is no summary.json", attempt.status));
    }
    if folder.join("o/summary.json").exists() {
        let judged = judge::judge(&folder.join("o"));
        verdict.warnings = judged.warnings;
        verdict.wrong.extend(judged.wrong);
        if let (0, Some((other, turned))) = (index % MIRRORED, mirror::mirrored(index, scene))
            && attempt.status == Some(0)
        {
            lay_out(&other, folder, "mirrored.toml")?;
            let attempt = run(program, folder, &words("mirrored.toml", "m"), limits)?;
            verdict.mirrored = true;
            verdict.wrong.extend(match attempt.status {
                Some(0) => mirror::compare(&folder.join("o"), &folder.join("m"), turned),
                other => vec![format!("mirrored: status {other:?}, {}", attempt.said.trim())],
            });
        }
    }
    Ok(verdict)
}
