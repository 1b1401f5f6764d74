//! A running `ale-gear` is killed at a random moment and taken up again, until it ends by itself: its files must be
//! those of a run that nobody disturbed, to the byte.

use std::{
    collections::BTreeMap,
    fs, io,
    path::{Path, PathBuf},
    process::{Command, Stdio},
    time::{Duration, Instant},
};

use serde_json::Value as Json;
use testing::{
    Random,
    small_scenes::{self, SmallDocument},
};

use crate::program::ale_gear;

/// Kills of one run at the most before it is left alone.
const PATIENCE: u32 = 4;
/// Keys of `summary.json` that tell of the run and not of its result.
const OF_THE_RUN: [&str; 5] = ["cost", "first_result_s", "gears_from_cache", "wall_s", "wall_time_s"];

/// Something that runs for a while.
#[derive(Debug, Clone)]
pub struct Task {
    /// What is asked; its name is for messages.
    pub document: SmallDocument,
    /// Words beyond those of the document.
    words: Vec<&'static str>,
    /// Whether `--resume` goes on from a checkpoint.
    resumes: bool,
}

/// Bytes of the files of a result, those of the run itself left out.
pub type Files = BTreeMap<PathBuf, Vec<u8>>;

/// Positions at rest with a cache, a motion with checkpoints, a sweep, a study.
pub fn tasks() -> Vec<Task> {
    let rest = small_scenes::long_rest(24);
    let study = "[[case]]\nscene = \"a.toml\"\nvalue = 1\n[[case]]\nscene = \"b.toml\"\nvalue = 2\n\
                 [[quantity]]\ncolumn = \"ste_um\"\n";
    let study = SmallDocument {
        name: "study",
        files: vec![
            ("study.toml", study.to_owned()),
            ("a.toml", rest.replace("positions_per_cycle = 24", "positions_per_cycle = 8")),
            ("b.toml", rest.replace("torque_nm = 60.0", "torque_nm = 90.0")),
        ],
        words: vec!["run", "study.toml"],
    };
    let task = |document, words: &[&'static str], resumes| Task { document, words: words.to_vec(), resumes };
    let scene = SmallDocument::scene;
    let (cached, alone) = (&["--threads", "2", "--cache", "kept"], &["--threads", "2", "--no-cache"]);
    vec![
        task(scene("rest with cache", rest), cached, false),
        task(scene("motion with checkpoints", small_scenes::long_motion(60)), alone, true),
        task(scene("sweep", small_scenes::long_sweep(6)), cached, false),
        task(study, cached, false),
    ]
}

impl Task {
    fn command(&self, program: &Path, folder: &Path) -> Command {
        let mut words = self.document.words_into("o", &self.words);
        if self.resumes && folder.join("o.checkpoint").exists() {
            words.push("--resume");
        }
        let mut command = ale_gear(program, folder, &words);
        command.stdout(Stdio::null()).stderr(Stdio::piped());
        command
    }

    /// The undisturbed run: its files, and how long it took.
    ///
    /// # Errors
    /// When it comes to no result.
    pub fn undisturbed(&self, program: &Path) -> io::Result<(Files, Duration)> {
        let folder = tempfile::tempdir()?;
        self.document.lay_out(folder.path())?;
        let start = Instant::now();
        let run = self.command(program, folder.path()).output()?;
        if !run.status.success() {
            return Err(io::Error::other(format!("{}: {}", self.document.name, String::from_utf8_lossy(&run.stderr))));
        }
        Ok((files_of(&folder.path().join("o"))?, start.elapsed()))
    }

    /// Kills the run again and again at moments of chance, then lets it end; gives how many kills met it alive.
    ///
    /// # Errors
    /// What is not as it must be, in words.
    pub fn disturbed(
        &self,
        program: &Path,
        (whole, takes): &(Files, Duration),
        random: &mut Random,
    ) -> Result<u32, String> {
        let folder = tempfile::tempdir().map_err(|e| e.to_string())?;
        let at = folder.path();
        self.document.lay_out(at).map_err(|e| e.to_string())?;
        let mut kills = 0;
        for _ in 0..PATIENCE {
            let wait = takes.mul_f64(random.between(0.0, 1.05));
            let mut child = self.command(program, at).spawn().map_err(|e| e.to_string())?;
            std::thread::sleep(wait);
            if let Some(status) = child.try_wait().map_err(|e| e.to_string())? {
                if !status.success() {
                    return Err(self.said(child, kills));
                }
                break;
            }
            child.kill().and_then(|()| child.wait()).map_err(|e| e.to_string())?;
            kills += 1;
            self.nothing_half_written(at, whole, kills)?;
            if random.between(0.0, 1.0) < 0.4 {
                break;
            }
        }
        let mut last = self.command(program, at).spawn().map_err(|e| e.to_string())?;
        if !last.wait().map_err(|e| e.to_string())?.success() {
            return Err(self.said(last, kills));
        }
        self.nothing_half_written(at, whole, kills)?;
        let mut names: Vec<String> = names_in(at).map_err(|e| e.to_string())?;
        names.retain(|n| {
            !self.document.files.iter().any(|(f, _)| f == n) && !["o", "kept", "user_cache"].contains(&n.as_str())
        });
        if !names.is_empty() {
            return Err(format!("{}: after {kills} kills {names:?} are left", self.document.name));
        }
        if !at.join("o/summary.json").exists() && !at.join("o/report.html").exists() {
            return Err(format!("{}: there is no result after {kills} kills", self.document.name));
        }
        Ok(kills)
    }

    fn said(&self, child: std::process::Child, kills: u32) -> String {
        let said = child.wait_with_output().map(|o| String::from_utf8_lossy(&o.stderr).into_owned());
        format!("{}: fails after {kills} kills: {}", self.document.name, said.unwrap_or_default())
    }

    /// A folder of results is a whole one, whenever it is there.
    fn nothing_half_written(&self, at: &Path, whole: &Files, kills: u32) -> Result<(), String> {
        let out = at.join("o");
        if !out.exists() {
            return Ok(());
        }
        let now = files_of(&out).map_err(|e| format!("{}: after {kills} kills: {e}", self.document.name))?;
        let other = |file: &&PathBuf| now.get(*file) != whole.get(*file);
        match whole.keys().chain(now.keys()).find(other) {
            None => Ok(()),
            Some(file) => Err(format!("{}: after {kills} kills {} is another", self.document.name, file.display())),
        }
    }
}

fn names_in(folder: &Path) -> io::Result<Vec<String>> {
    fs::read_dir(folder)?.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned())).collect()
}

/// Files of a result folder and those in it, without what tells of the run: times, memory, the page that shows them.
///
/// # Errors
/// When one cannot be read.
pub fn files_of(folder: &Path) -> io::Result<Files> {
    let (mut files, mut folders) = (Files::new(), vec![PathBuf::new()]);
    while let Some(inner) = folders.pop() {
        for name in names_in(&folder.join(&inner))? {
            let relative = inner.join(&name);
            let path = folder.join(&relative);
            if path.is_dir() {
                folders.push(relative);
            } else if name == "summary.json" {
                files.insert(relative, of_summary(&fs::read(path)?)?);
            } else if !name.starts_with("report.") {
                files.insert(relative, fs::read(path)?);
            }
        }
    }
    Ok(files)
}

/// A summary without times, memory and where gears came from.
fn of_summary(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut summary: Json = serde_json::from_slice(bytes).map_err(io::Error::other)?;
    strip(&mut summary);
    serde_json::to_vec_pretty(&summary).map_err(io::Error::other)
}

fn strip(value: &mut Json) {
    match value {
        Json::Object(map) => {
            OF_THE_RUN.iter().for_each(|key| drop(map.remove(*key)));
            map.values_mut().for_each(strip);
        }
        Json::Array(list) => list.iter_mut().for_each(strip),
        _ => {}
    }
}
