//! Runs CalculiX on a deck in a separate folder.

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
    time::{Duration, Instant},
};

use super::{CalculixError, CalculixResult, Deck};

/// The installed program.
#[derive(Debug, Clone)]
pub struct Calculix {
    program: PathBuf,
    threads: usize,
}

/// A finished run of one position.
#[derive(Debug, Clone, PartialEq)]
pub struct CalculixRun {
    /// Result of the run.
    pub result: CalculixResult,
    /// Wall-clock time of the process, s.
    pub wall_s: f64,
    /// Largest resident set of the process, MB; `None` if the operating system does not report it.
    pub peak_memory_mb: Option<f64>,
}

/// Name of the deck without its suffix.
const JOB: &str = "position";
/// How often its memory is looked at, and how long it may live on after it is done.
const LOOK: Duration = Duration::from_millis(20);

impl Calculix {
    /// Searches for `ccx` in PATH.
    ///
    /// # Errors
    /// [`CalculixError::NotInstalled`] if it is not found.
    pub fn find(threads: usize) -> Result<Self, CalculixError> {
        Self::at(Path::new("ccx"), threads)
    }

    /// A program by name or path; `threads` is the number of threads that it may use.
    ///
    /// # Errors
    /// [`CalculixError::NotInstalled`] if it cannot be started.
    pub fn at(program: &Path, threads: usize) -> Result<Self, CalculixError> {
        let started = Command::new(program).arg("-v").stdout(Stdio::null()).stderr(Stdio::null()).status();
        match started {
            Ok(_) => Ok(Self { program: program.to_owned(), threads: threads.max(1) }),
            Err(_) => Err(CalculixError::NotInstalled { program: program.display().to_string() }),
        }
    }

    /// First line of its version message.
    pub fn version(&self) -> Option<String> {
        let output = Command::new(&self.program).arg("-v").output().ok()?;
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        said.lines().map(str::trim).find(|l| !l.is_empty()).map(str::to_owned)
    }

    /// Writes the deck into `folder`, runs it there and reads the results.
    ///
    /// # Errors
    /// [`CalculixError`] of the deck or of a file; [`CalculixError::NoResult`].
    pub fn run(&self, deck: &Deck<'_>, folder: &Path) -> Result<CalculixRun, CalculixError> {
        let start = Instant::now();
        let (print, peak_memory_mb, said) = self.solve(&deck.text()?, folder)?;
        let wall_s = start.elapsed().as_secs_f64();
        let result = CalculixResult::read(&print, deck).ok_or(CalculixError::NoResult { said })?;
        Ok(CalculixRun { result, wall_s, peak_memory_mb })
    }

    /// Runs any deck in `folder`. Returns its printed results (its `.dat` file), the largest resident set (MB), and its
    /// last messages.
    ///
    /// # Errors
    /// [`CalculixError`] of a file.
    pub fn solve(&self, text: &str, folder: &Path) -> Result<(String, Option<f64>, String), CalculixError> {
        let at = |name: String| folder.join(name);
        let failed = |path: &Path, source| CalculixError::File { path: path.to_owned(), source };
        let input = at(format!("{JOB}.inp"));
        fs::write(&input, text).map_err(|e| failed(&input, e))?;
        let log = at(format!("{JOB}.log"));
        let said = fs::File::create(&log).map_err(|e| failed(&log, e))?;
        let mut child = Command::new(&self.program)
            .arg(JOB)
            .current_dir(folder)
            .env("OMP_NUM_THREADS", self.threads.to_string())
            .stdin(Stdio::null())
            .stdout(said)
            .stderr(Stdio::null())
            .spawn()
            .map_err(|_| CalculixError::NotInstalled { program: self.program.display().to_string() })?;
        let peak_memory_mb = wait(&mut child).map_err(|e| failed(&self.program, e))?;
        // The exit status is no measure: 2.20 ends with 201 after warnings.
        let print = fs::read_to_string(at(format!("{JOB}.dat"))).unwrap_or_default();
        let said = fs::read_to_string(&log).unwrap_or_default();
        let mut last: Vec<&str> = said.lines().rev().map(str::trim).filter(|l| !l.is_empty()).take(4).collect();
        last.reverse();
        Ok((print, peak_memory_mb, last.join("; ")))
    }
}

/// Waits for the end and watches the memory meanwhile, MB.
fn wait(child: &mut Child) -> std::io::Result<Option<f64>> {
    let status = PathBuf::from(format!("/proc/{}/status", child.id()));
    let mut peak = None;
    while child.try_wait()?.is_none() {
        let text = fs::read_to_string(&status).unwrap_or_default();
        let kib = text.lines().find_map(|l| l.strip_prefix("VmHWM:")?.trim().strip_suffix("kB")?.trim().parse().ok());
        peak = kib.map(|kib: f64| kib * 1024.0 / 1e6).or(peak);
        std::thread::sleep(LOOK);
    }
    Ok(peak)
}
