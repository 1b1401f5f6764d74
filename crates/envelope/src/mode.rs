//! A way in which gear contact solvers fail.

use std::time::Instant;

use crate::{EnvelopeError, Figure, bench::Bench};

/// Modes with motions, or with many meshes: more than some three seconds each.
const LONG: [u32; 18] = [2, 3, 4, 6, 7, 11, 13, 16, 20, 21, 22, 23, 24, 27, 29, 30, 33, 38];

/// A way in which gear contact solvers fail: what it is, a scene, and how to look.
#[derive(Debug, Clone, Copy)]
pub struct FailureMode {
    /// Running number; F7 is 7.
    pub number: u32,
    /// What fails, in a few words.
    pub name: &'static str,
    /// File of the scene in `scenes/envelope`, without its ending.
    pub file: &'static str,
    /// Text of the scene.
    pub scene: &'static str,
    /// What the naive way does.
    pub fails: &'static str,
    /// What this program does.
    pub does: &'static str,
    /// Settings with which the scene shows the failure; none where only a library call does.
    pub naive: &'static [&'static str],
    /// Looks.
    pub(crate) look: fn(&Bench) -> Result<Vec<Figure>, EnvelopeError>,
}

/// A failure mode that was looked at.
#[derive(Debug)]
pub struct Examined {
    /// What was found, or why there is nothing.
    pub figures: Result<Vec<Figure>, EnvelopeError>,
    /// Wall time, s.
    pub seconds: f64,
}

impl Examined {
    /// Whether all of its figures show what they have to.
    pub fn holds(&self) -> bool {
        self.figures.as_ref().is_ok_and(|figures| !figures.is_empty() && figures.iter().all(Figure::holds))
    }
}

impl FailureMode {
    /// `F7`.
    pub fn label(&self) -> String {
        format!("F{}", self.number)
    }

    /// Whether a user means it by `word`: `F7`, `f7`, `F07`.
    pub fn is_named(&self, word: &str) -> bool {
        let digits = word.strip_prefix(['F', 'f']);
        digits.and_then(|d| d.parse::<u32>().ok()) == Some(self.number)
    }

    /// Whether looking takes no more than a few seconds.
    pub fn is_quick(&self) -> bool {
        !LONG.contains(&self.number)
    }

    /// Runs its scene, the naive way and the robust one.
    pub fn examine(&self) -> Examined {
        let start = Instant::now();
        let figures = (self.look)(&Bench { file: self.file, scene: self.scene, naive: self.naive });
        Examined { figures, seconds: start.elapsed().as_secs_f64() }
    }

    /// The command that shows the failure; `None` where none does.
    pub fn naive_command(&self) -> Option<String> {
        let settings: Vec<String> = self.naive.iter().map(|s| format!(" --set {s}")).collect();
        (!settings.is_empty()).then(|| format!("{}{}", self.command(), settings.concat()))
    }

    /// The command that runs its scene.
    pub fn command(&self) -> String {
        format!("ale-gear run scenes/envelope/{0}.toml --out out/{0}", self.file)
    }
}
