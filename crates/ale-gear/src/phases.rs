//! Wall time and peak memory of each phase, and bars for those who wait; into a log, a line now and then.

mod watch;
mod words;

use std::fmt::Write;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use analysis::{Observer, PhaseWork, Progress};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use report::{Cost, Phase};

use crate::memory;
use crate::pace::Pace;
use crate::printed;
use crate::talk::{self, Verbosity};
use watch::Watch;
use words::{filled, foreseen, left};

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
    /// Says lines of text while no step is done.
    watch: Option<Watch>,
}

/// The bar of a running phase; may be shared between threads.
#[derive(Debug, Clone)]
pub struct BarProgress {
    bar: ProgressBar,
    /// Where no bar is drawn: seconds of the phase after which the next line of text is due; `None` where none is
    /// wanted.
    due: Option<Arc<AtomicU64>>,
    /// Pace of the steps so far; `None` where their number is only a limit.
    pace: Option<SharedPace>,
    /// What was foreseen for all of it, s, where it has no steps.
    estimated_seconds: Option<f64>,
}

/// The pace of a phase, for its bar and for its lines of text.
type SharedPace = Arc<Mutex<Pace>>;

impl Progress for BarProgress {
    fn tick(&self) {
        self.bar.inc(1);
        if let Some(pace) = &self.pace {
            locked(pace).step(self.bar.elapsed().as_secs_f64());
        }
        if let Some(due) = &self.due {
            self.log(due);
        }
    }

    fn say(&self, message: String) {
        talk::say(Verbosity::Details, || format!("  {}: {message}", self.bar.prefix()));
        self.bar.set_message(printed::message(&message));
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
        let (done, length) = (self.bar.position(), self.bar.length());
        let seconds = elapsed.as_secs_f64();
        let (name, beside) = (self.bar.prefix(), self.bar.message());
        let steps = match (length, &self.pace) {
            (None, _) => String::new(),
            (Some(most), None) => format!("{done} of at most {most} "),
            (Some(all), Some(_)) => format!("{done} of {all} "),
        };
        let open = length.unwrap_or(0).saturating_sub(done);
        let rest = match &self.pace {
            Some(pace) => rest(pace, open, seconds),
            None => self.estimated_seconds.map(foreseen).unwrap_or_default(),
        };
        talk::say(Verbosity::Bars, || {
            format!("{name}: {steps}after {seconds:.0} s{rest} {beside}").trim_end().to_owned()
        });
    }
}

fn locked(pace: &SharedPace) -> std::sync::MutexGuard<'_, Pace> {
    pace.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What is left, as words behind others; nothing while nobody can know.
fn rest(pace: &SharedPace, steps: u64, now_s: f64) -> String {
    let rest = locked(pace).rest(steps, now_s).filter(|_| steps > 0);
    rest.map(|seconds| format!(", {}", left(seconds))).unwrap_or_default()
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
        self.measure(name, PhaseWork::Unknown, |_| work())
    }

    /// Runs a phase of `steps` units of work; `work` calls [`Progress::tick`] after each.
    pub fn run_steps<T>(&mut self, name: &str, steps: u64, work: impl FnOnce(&dyn Progress) -> T) -> T {
        self.measure(name, PhaseWork::Steps(steps), work)
    }

    fn measure<T>(&mut self, name: &str, work_ahead: PhaseWork, work: impl FnOnce(&dyn Progress) -> T) -> T {
        let progress = self.open(name, work_ahead);
        let result = work(&progress);
        self.close();
        result
    }

    /// Begins a phase with a bar.
    fn open(&mut self, name: &str, work: PhaseWork) -> BarProgress {
        let pace = matches!(work, PhaseWork::Steps(_)).then(SharedPace::default);
        let bar = match (work, &pace) {
            (PhaseWork::Unknown, _) => spinner(),
            (PhaseWork::Seconds(seconds), _) => seconds_bar(seconds),
            (PhaseWork::Steps(steps) | PhaseWork::AtMost(steps), pace) => steps_bar(steps, pace.clone()),
        };
        // indicatif draws nothing when stderr is no terminal.
        bar.set_draw_target(if self.bars && talk::verbosity() == Verbosity::Bars {
            ProgressDrawTarget::stderr()
        } else {
            ProgressDrawTarget::hidden()
        });
        bar.set_prefix(printed::message(name));
        bar.enable_steady_tick(Duration::from_millis(120));
        talk::say(Verbosity::Steps, || format!("{name} ..."));
        let own_peak = memory::reset_peak();
        let logs = self.bars && talk::verbosity() >= Verbosity::Bars && bar.is_hidden();
        let due = talk::progress_after_s().filter(|_| logs).map(|s| Arc::new(AtomicU64::new(s)));
        let estimated_seconds = if let PhaseWork::Seconds(seconds) = work { Some(seconds) } else { None };
        let progress = BarProgress { bar: bar.clone(), due, pace, estimated_seconds };
        let watch = progress.due.clone().and_then(|due| {
            let (bar, own) = (progress.bar.clone(), progress.clone());
            Watch::begin(Arc::clone(&due), move || bar.elapsed(), move || own.log(&due))
        });
        self.open.push(OpenPhase { name: name.to_owned(), bar, start: Instant::now(), own_peak, watch });
        progress
    }

    /// Ends the phase that began last.
    fn close(&mut self) {
        let Some(OpenPhase { name, bar, start, own_peak, watch }) = self.open.pop() else { return };
        drop(watch);
        let wall_s = start.elapsed().as_secs_f64();
        let peak = memory::peak_mb();
        bar.finish_and_clear();
        talk::say(Verbosity::Steps, || format!("{name}: {wall_s:.2} s"));
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

    /// Cost of all phases so far.
    pub fn cost(&self) -> Cost {
        Cost {
            threads: rayon::current_num_threads(),
            wall_s: self.total_wall_s(),
            peak_memory_mb: self.peak_memory_mb(),
            phases: self.rows().to_vec(),
        }
    }
}

impl analysis::Recorder for Phases {
    fn cost(&self) -> Cost {
        Self::cost(self)
    }
}

impl Observer for Phases {
    fn begin(&mut self, phase: &str, work: PhaseWork) -> Arc<dyn Progress> {
        Arc::new(self.open(phase, work))
    }

    fn end(&mut self) {
        self.close();
    }

    fn note(&mut self, message: String) {
        talk::say(Verbosity::Bars, || format!("ale-gear: {message}"));
    }
}

/// For work whose amount is not known beforehand.
fn spinner() -> ProgressBar {
    let bar = ProgressBar::new_spinner();
    bar.set_style(style("{spinner} {prefix:<10} {elapsed}"));
    bar
}

/// For work that should take about `seconds` on a machine that nobody has measured: a bar, and no countdown.
fn seconds_bar(seconds: f64) -> ProgressBar {
    let bar = ProgressBar::new_spinner();
    let shown = style("{spinner} {prefix:<10} [{done}] {elapsed}{foreseen}")
        .with_key("done", move |s: &ProgressState, w: &mut dyn Write| {
            let _ = w.write_str(&filled(s.elapsed().as_secs_f64() / seconds));
        })
        .with_key("foreseen", move |_: &ProgressState, w: &mut dyn Write| {
            let _ = w.write_str(&foreseen(seconds));
        });
    bar.set_style(shown);
    bar
}

/// For a number of steps, or for as many at the most.
fn steps_bar(steps: u64, pace: Option<SharedPace>) -> ProgressBar {
    let bar = ProgressBar::new(steps);
    let most = if pace.is_some() { "" } else { " at most" };
    let shown = style("{spinner} {prefix:<10} [{bar:32}] {pos}/{len}{most} {elapsed}{left} {msg}")
        .with_key("most", move |_: &ProgressState, w: &mut dyn Write| {
            let _ = w.write_str(most);
        })
        .with_key("left", move |s: &ProgressState, w: &mut dyn Write| {
            let open = s.len().unwrap_or(0).saturating_sub(s.pos());
            let said = pace.as_ref().map(|pace| rest(pace, open, s.elapsed().as_secs_f64())).unwrap_or_default();
            let _ = w.write_str(&said);
        });
    bar.set_style(shown.progress_chars("=> "));
    bar
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A limit is no amount of work: nobody counts down to it.
    #[test]
    fn what_may_end_early_has_no_remaining_time() {
        let mut phases = Phases::quiet();
        let [known, limit] = [PhaseWork::Steps(100), PhaseWork::AtMost(100)].map(|work| phases.open("solve", work));
        (0..50).for_each(|_| [&known, &limit].iter().for_each(|progress| progress.tick()));
        assert!(limit.pace.is_none());
        let said = rest(known.pace.as_ref().unwrap(), 50, known.bar.elapsed().as_secs_f64());
        assert!(said.ends_with(" left"), "{said}");
        assert_eq!(rest(known.pace.as_ref().unwrap(), 0, 1.0), "", "nothing is left");
    }
}
