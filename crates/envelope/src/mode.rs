//! A way in which gear contact solvers fail.

use std::time::Instant;

use crate::{EnvelopeError, Figure, bench::Bench};

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

    /// Runs its scene, the naive way and the robust one.
    pub fn examine(&self) -> Examined {
        let start = Instant::now();
        let figures = (self.look)(&Bench::new(self));
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
