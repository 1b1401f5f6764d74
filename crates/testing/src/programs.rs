//! Programs of others on this machine. What is missing is told in words that end a sentence: "left out: no browser
//! ...".

use std::path::PathBuf;
use std::process::Command;

/// Names under which browsers that can be asked from a command line are known.
const BROWSERS: [&str; 5] = ["chromium", "chromium-browser", "google-chrome-stable", "google-chrome", "chrome"];

/// What a shell's status is for a program that is not there, or cannot be run; what stands for several versions of a
/// program ends so as well.
const NOT_THERE: [i32; 2] = [126, 127];

/// Whether a program in `PATH` starts when it is asked for its version, as by `ccx -v`; some end that with an odd
/// status.
///
/// # Errors
/// Says that it does not.
pub fn program(name: &str, version: &str) -> Result<(), String> {
    let answer = Command::new(name).arg(version).output();
    let there = answer.is_ok_and(|o| o.status.code().is_some_and(|code| !NOT_THERE.contains(&code)));
    there.then_some(()).ok_or_else(|| format!("no `{name}` in PATH"))
}

/// The file of a program in `PATH`.
fn file(name: &str) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path).map(|folder| folder.join(name)).find(|file| file.is_file())
}

/// Chromium or Chrome: what the variable `CHROME` names, or one in `PATH`.
///
/// # Errors
/// Says that there is none.
pub fn browser() -> Result<PathBuf, String> {
    let wished = std::env::var_os("CHROME").map(PathBuf::from).filter(|file| file.is_file());
    let known = || BROWSERS.iter().find_map(|name| file(name));
    wished.or_else(known).ok_or_else(|| "no browser in PATH or CHROME".to_owned())
}

/// Whether `python3` has all these modules, given as in `import a, b`.
///
/// # Errors
/// Says that it has not.
pub fn python(modules: &str) -> Result<(), String> {
    let there = Command::new("python3").args(["-c", &format!("import {modules}")]).output();
    let done = there.is_ok_and(|o| o.status.success());
    done.then_some(()).ok_or_else(|| format!("no python3 with {modules}"))
}
