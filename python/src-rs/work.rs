//! Runs that take time: without the interpreter's lock, on a thread of their own, while the caller's thread looks for
//! Ctrl-C and tells of progress.

use std::{
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicBool, Ordering},
        mpsc::{RecvTimeoutError, sync_channel},
    },
    thread,
    time::{Duration, Instant},
};

use analysis::Recorder;
use analysis::{Observer, PhaseWork, Progress};
use pyo3::prelude::*;
use rayon::ThreadPoolBuilder;
use report::{Cost, Phase};

use crate::{
    arguments::Given,
    error::{Complaint, Kind},
};

/// How often Ctrl-C is looked for.
const POLL: Duration = Duration::from_millis(25);

/// What is shared between who works and who waits.
#[derive(Default)]
struct Shared {
    told: Mutex<Told>,
    cancelled: Arc<AtomicBool>,
}

/// How far the work has come.
#[derive(Debug, Clone, Default, PartialEq)]
struct Told {
    phase: String,
    done: u64,
    all: Option<u64>,
    message: String,
}

impl Shared {
    fn told(&self) -> MutexGuard<'_, Told> {
        self.told.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Progress for Shared {
    fn tick(&self) {
        self.told().done += 1;
    }

    fn say(&self, message: String) {
        self.told().message = message;
    }

    fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }
}

/// Hears of the phases, and keeps their times.
pub struct Watch {
    shared: Arc<Shared>,
    start: Instant,
    open: Vec<(String, Instant)>,
    phases: Vec<Phase>,
}

impl Watch {
    fn new(shared: Arc<Shared>) -> Self {
        Self { shared, start: Instant::now(), open: Vec::new(), phases: Vec::new() }
    }

    /// Work that tells nobody.
    pub fn alone() -> Self {
        Self::new(Arc::default())
    }

    /// Another of the same work, for a thread beside it: it stops as this one does, and its times are its own.
    pub fn beside(&self) -> Self {
        Self::new(Arc::new(Shared { told: Mutex::default(), cancelled: Arc::clone(&self.shared.cancelled) }))
    }

    /// Begins a phase; what it tells may outlive it.
    pub fn open(&mut self, phase: &str, work: PhaseWork) -> Arc<dyn Progress> {
        let all = if let PhaseWork::Steps(steps) = work { Some(steps) } else { None };
        *self.shared.told() = Told { phase: phase.to_owned(), done: 0, all, message: String::new() };
        self.open.push((phase.to_owned(), Instant::now()));
        Arc::clone(&self.shared) as Arc<dyn Progress>
    }

    /// When the work began.
    pub fn start(&self) -> Instant {
        self.start
    }
}

impl Observer for Watch {
    fn begin(&mut self, phase: &str, work: PhaseWork) -> Arc<dyn Progress> {
        self.open(phase, work)
    }

    fn end(&mut self) {
        let Some((name, start)) = self.open.pop() else { return };
        self.phases.push(Phase { name, wall_s: start.elapsed().as_secs_f64(), peak_memory_mb: None });
    }

    fn note(&mut self, message: String) {
        self.shared.told().message = message;
    }
}

impl Recorder for Watch {
    fn cost(&self) -> Cost {
        Cost {
            threads: rayon::current_num_threads(),
            wall_s: self.start.elapsed().as_secs_f64(),
            peak_memory_mb: None,
            phases: self.phases.clone(),
        }
    }
}

/// Tells the work to end when the caller leaves before it.
struct CancelOnDrop<'a>(&'a Shared);

impl Drop for CancelOnDrop<'_> {
    fn drop(&mut self) {
        self.0.cancelled.store(true, Ordering::Relaxed);
    }
}

/// Does `task` while the caller waits: others may run Python meanwhile.
///
/// It takes so many threads as are told, of its own; else it shares the cores with all other work. After Ctrl-C the
/// caller goes on at once; the work ends where it is asked next, and nobody sees its result.
pub fn run<T: Send + 'static>(
    py: Python<'_>,
    progress: Given<'_, '_>,
    threads: Option<u32>,
    task: impl FnOnce(&mut Watch) -> Result<T, Complaint> + Send + 'static,
) -> PyResult<T> {
    let helpers = py.import("ale_gear._progress")?;
    let callback = helpers.call_method1("callback", (progress,))?;
    let shared = Arc::new(Shared::default());
    let (done, finished) = sync_channel(1);
    let mut watch = Watch::new(Arc::clone(&shared));
    let work = move || {
        let _ = done.send(task(&mut watch));
    };
    let own = threads.map(|n| ThreadPoolBuilder::new().num_threads(n as usize).build()).transpose();
    let own = own.map_err(|e| Complaint::new(Kind::Input, format!("threads: {e}"), Some("take fewer".into())))?;
    let work = move || match own {
        Some(own) => own.install(work),
        None => work(),
    };
    let worker = thread::Builder::new().name("ale-gear".into()).spawn(work).map_err(Complaint::from)?;
    let _leaving = CancelOnDrop(&shared);
    let finished = Mutex::new(finished);
    let mut last = Told::default();
    loop {
        let heard = py.detach(|| finished.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(POLL));
        if !callback.is_none() {
            let told = shared.told().clone();
            if told != last {
                callback.call1((&told.phase, told.done, told.all, &told.message))?;
                last = told;
            }
        }
        match heard {
            Ok(result) => {
                helpers.call_method1("finish", (&callback,))?;
                return Ok(result?);
            }
            Err(RecvTimeoutError::Timeout) => py.check_signals()?,
            Err(RecvTimeoutError::Disconnected) => return Err(fault(worker).into()),
        }
    }
}

/// A thread that ended without a result.
fn fault(worker: thread::JoinHandle<()>) -> Complaint {
    let said = worker.join().err().and_then(|payload| {
        let text = payload.downcast_ref::<&str>().map(ToString::to_string);
        text.or_else(|| payload.downcast_ref::<String>().cloned())
    });
    let message = format!("a fault of ale-gear: {}", said.unwrap_or_else(|| "the work ended without a result".into()));
    Complaint::new(Kind::Internal, message, Some("please report it with the scene".into()))
}
