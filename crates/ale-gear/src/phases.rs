//! Wall time and peak memory of each phase, and bars for those who wait; into a log, a line now and then.

use std::fmt::Write;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use analysis::{Observer, PhaseWork, Progress};
use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use report::{Cost, Phase};

use crate::memory;
use crate::talk::{self, Loudness};

/// Records phases one after the other.
///
/// ```
/// # use ale_gear::phases::Phases;
/// let mut phases = Phases::quiet();
/// let sum = phases.run("sum", || (1..=4).sum::<u32>());
/// assert_eq!((sum, phases.rows()[0].name.as_str()), (10, "sum"));
/// ```
#[derive(Debug)]
pub struct Phases {
    rows: Vec<Phase>,
    start: Instant,
    highest: Option<f64>,
    bars: bool,
    /// Phases under way.
    open: Vec<OpenPhase>,
}

/// A phase under way.
#[derive(Debug)]
struct OpenPhase {
    name: String,
    bar: ProgressBar,
    start: Instant,
    own_peak: bool,
}

/// The bar of a running phase; may be shared between threads.
#[derive(Debug, Clone)]
pub struct BarProgress {
    bar: ProgressBar,
    /// Where no bar is drawn: seconds of the phase after which the next line of text is due; `None` where none is
    /// wanted.
    due: Option<Arc<AtomicU64>>,
}

impl Progress for BarProgress {
    fn tick(&self) {
        self.bar.inc(1);
        if let Some(due) = &self.due {
            self.log(due);
        }
    }

    fn say(&self, message: String) {
        talk::say(Loudness::Details, || format!("  {}: {message}", self.bar.prefix()));
        self.bar.set_message(message);
    }
}

impl BarProgress {
    /// A line for a log, that nobody who waits has to wonder: as due, and again after twice the time.
    fn log(&self, due: &AtomicU64) {
        let elapsed = self.bar.elapsed();
        let at = due.load(Ordering::Relaxed);
        let now = elapsed.as_secs();
        if now < at || due.compare_exchange(at, (2 * now).max(1), Ordering::Relaxed, Ordering::Relaxed).is_err() {
            return;
        }
        let (done, all) = (self.bar.position(), self.bar.length().unwrap_or(0));
        let seconds = elapsed.as_secs_f64();
        let rest = seconds * all.saturating_sub(done) as f64 / done.max(1) as f64;
        let (name, beside) = (self.bar.prefix(), self.bar.message());
        talk::say(Loudness::Bars, || format!("{name}: {done} of {all} after {seconds:.0} s, {} {beside}", left(rest)));
    }
}

impl Phases {
    /// With bars on stderr if it is a terminal.
    pub fn with_bars() -> Self {
        Self { bars: true, ..Self::quiet() }
    }

    /// Without bars.
    pub fn quiet() -> Self {
        Self { rows: Vec::new(), start: Instant::now(), highest: None, bars: false, open: Vec::new() }
    }

    /// Runs a phase whose amount of work is not known beforehand.
    pub fn run<T>(&mut self, name: &str, work: impl FnOnce() -> T) -> T {
        self.measure(name, spinner(), |_| work())
    }

    /// Runs a phase that should take about `seconds`: a bar with what is left of them.
    pub fn run_foreseen<T>(&mut self, name: &str, seconds: f64, work: impl FnOnce() -> T) -> T {
        self.measure(name, seconds_bar(seconds), |_| work())
    }

    /// Runs a phase of `steps` units of work; `work` calls [`Progress::tick`] after each.
    pub fn run_steps<T>(&mut self, name: &str, steps: u64, work: impl FnOnce(&dyn Progress) -> T) -> T {
        self.measure(name, steps_bar(steps), work)
    }

    fn measure<T>(&mut self, name: &str, bar: ProgressBar, work: impl FnOnce(&dyn Progress) -> T) -> T {
        let progress = self.open(name, bar);
        let result = work(&progress);
        self.close();
        result
    }

    /// Begins a phase with a bar.
    fn open(&mut self, name: &str, bar: ProgressBar) -> BarProgress {
        // indicatif draws nothing when stderr is no terminal.
        bar.set_draw_target(if self.bars && talk::loudness() == Loudness::Bars {
            ProgressDrawTarget::stderr()
        } else {
            ProgressDrawTarget::hidden()
        });
        bar.set_prefix(name.to_owned());
        bar.enable_steady_tick(Duration::from_millis(120));
        talk::say(Loudness::Steps, || format!("{name} ..."));
        let own_peak = memory::reset_peak();
        let logs = self.bars && talk::loudness() >= Loudness::Bars && bar.is_hidden();
        let due = talk::progress_after_s().filter(|_| logs).map(|s| Arc::new(AtomicU64::new(s)));
        self.open.push(OpenPhase { name: name.to_owned(), bar: bar.clone(), start: Instant::now(), own_peak });
        BarProgress { bar, due }
    }

    /// Ends the phase that began last.
    fn close(&mut self) {
        let Some(OpenPhase { name, bar, start, own_peak }) = self.open.pop() else { return };
        let wall_s = start.elapsed().as_secs_f64();
        let peak = memory::peak_mb();
        bar.finish_and_clear();
        talk::say(Loudness::Steps, || format!("{name}: {wall_s:.2} s"));
        self.highest = match (self.highest, peak) {
            (Some(a), Some(b)) => Some(f64::max(a, b)),
            (a, b) => a.or(b),
        };
        self.rows.push(Phase { name, wall_s, peak_memory_mb: peak.filter(|_| own_peak) });
    }

    /// The phases so far.
    pub fn rows(&self) -> &[Phase] {
        &self.rows
    }

    /// Wall time since the recorder was made, s.
    pub fn total_wall_s(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }

    /// When the recorder was made.
    pub fn start(&self) -> Instant {
        self.start
    }

    /// Largest resident set in any phase, MB.
    pub fn peak_memory_mb(&self) -> Option<f64> {
        self.highest
    }

    /// What it all cost so far.
    pub fn cost(&self) -> Cost {
        Cost {
            threads: rayon::current_num_threads(),
            wall_s: self.total_wall_s(),
            peak_memory_mb: self.peak_memory_mb(),
            phases: self.rows().to_vec(),
        }
    }
}

impl Observer for Phases {
    fn begin(&mut self, phase: &str, work: PhaseWork) -> Arc<dyn Progress> {
        let bar = match work {
            PhaseWork::Unknown => spinner(),
            PhaseWork::Seconds(seconds) => seconds_bar(seconds),
            PhaseWork::Steps(steps) => steps_bar(steps),
        };
        Arc::new(self.open(phase, bar))
    }

    fn end(&mut self) {
        self.close();
    }

    fn note(&mut self, message: String) {
        talk::say(Loudness::Bars, || format!("ale-gear: {message}"));
    }
}

/// For work whose amount is not known beforehand.
fn spinner() -> ProgressBar {
    let bar = ProgressBar::new_spinner();
    bar.set_style(style("{spinner} {prefix:<10} {elapsed}"));
    bar
}

/// For work that should take about `seconds`: a bar with what is left of them.
fn seconds_bar(seconds: f64) -> ProgressBar {
    let bar = ProgressBar::new_spinner();
    let shown = style("{spinner} {prefix:<10} [{done}] {elapsed} {left}")
        .with_key("done", move |s: &ProgressState, w: &mut dyn Write| {
            let _ = w.write_str(&filled(s.elapsed().as_secs_f64() / seconds));
        })
        .with_key("left", move |s: &ProgressState, w: &mut dyn Write| {
            let _ = w.write_str(&left(seconds - s.elapsed().as_secs_f64()));
        });
    bar.set_style(shown);
    bar
}

/// For a number of steps.
fn steps_bar(steps: u64) -> ProgressBar {
    let bar = ProgressBar::new(steps);
    let shown = style("{spinner} {prefix:<10} [{bar:32}] {pos}/{len} {elapsed}{left} {msg}").with_key(
        "left",
        |s: &ProgressState, w: &mut dyn Write| {
            // Before the first step is done nothing is known.
            if s.pos() > 0 {
                let _ = write!(w, ", {:#} left", HumanDuration(s.eta()));
            }
        },
    );
    bar.set_style(shown.progress_chars("=> "));
    bar
}

/// Width of a bar, characters.
const BAR: usize = 32;

/// A bar filled in part; what takes longer than foreseen stays just short of full.
fn filled(part: f64) -> String {
    let full = ((BAR as f64 * part.max(0.0)) as usize).min(BAR - 1);
    format!("{}>{}", "=".repeat(full), " ".repeat(BAR - 1 - full))
}

/// Remaining seconds in words.
fn left(seconds: f64) -> String {
    match seconds {
        s if s >= 120.0 => format!("about {:.0} min left", s / 60.0),
        s if s >= 1.0 => format!("about {s:.0} s left"),
        _ => "any moment, or longer than foreseen".to_owned(),
    }
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bar_grows_and_never_bursts() {
        let full = |part: f64| filled(part).matches('=').count();
        assert_eq!((full(-1.0), full(0.0), full(0.5), full(1.0), full(1e9)), (0, 0, 16, 31, 31));
        assert!([0.0, 0.3, 5.0].iter().all(|&p| filled(p).len() == BAR));
        assert_eq!((left(200.0).as_str(), left(12.3).as_str()), ("about 3 min left", "about 12 s left"));
    }
}
