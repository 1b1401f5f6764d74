//! Wall-clock time of each phase of a point, and the largest resident set.

use std::{sync::Arc, time::Instant};

use super::MemoryGauge;
use crate::{NoObserver, Observer, PhaseWork, Progress};

/// Records phases one after the other.
pub(super) struct PhaseTimes<'a> {
    memory: &'a dyn MemoryGauge,
    open: Vec<(String, Instant)>,
    done: Vec<(String, f64)>,
    highest: Option<f64>,
}

impl<'a> PhaseTimes<'a> {
    pub fn new(memory: &'a dyn MemoryGauge) -> Self {
        Self { memory, open: Vec::new(), done: Vec::new(), highest: None }
    }

    /// Wall-clock time of the phases selected by `which`, s.
    pub fn wall_s(&self, which: impl Fn(&str) -> bool) -> f64 {
        self.done.iter().filter(|(name, _)| which(name)).map(|(_, seconds)| seconds).sum()
    }

    /// Largest resident set in any phase, MB; `None` if it is not measured.
    pub fn peak_mb(&self) -> Option<f64> {
        self.highest
    }
}

impl Observer for PhaseTimes<'_> {
    fn begin(&mut self, phase: &str, _: PhaseWork) -> Arc<dyn Progress> {
        self.memory.reset_peak();
        self.open.push((phase.to_owned(), Instant::now()));
        Arc::new(NoObserver)
    }

    fn end(&mut self) {
        let Some((name, start)) = self.open.pop() else { return };
        self.done.push((name, start.elapsed().as_secs_f64()));
        self.highest = self.highest.into_iter().chain(self.memory.peak_mb()).reduce(f64::max);
    }
}
