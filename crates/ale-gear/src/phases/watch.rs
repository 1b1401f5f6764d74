//! Lines of text for a log while a phase has no steps, or none yet.

use std::{
    sync::{
        Arc, Condvar, Mutex, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
    thread::JoinHandle,
    time::Duration,
};

/// A thread that says how far a phase is whenever a line is due; it ends with this.
#[derive(Debug)]
pub(super) struct Watch {
    over: Arc<(Mutex<bool>, Condvar)>,
    thread: Option<JoinHandle<()>>,
}

impl Watch {
    /// `log` says a line and moves on the second of the phase at which the next one is `due`; `None` where the system
    /// gives no thread.
    pub(super) fn begin(
        due: Arc<AtomicU64>,
        elapsed: impl Fn() -> Duration + Send + 'static,
        log: impl Fn() + Send + 'static,
    ) -> Option<Self> {
        let over = Arc::new((Mutex::new(false), Condvar::new()));
        let own = Arc::clone(&over);
        let work = move || {
            let (flag, woken) = &*own;
            let mut ended = flag.lock().unwrap_or_else(PoisonError::into_inner);
            while !*ended {
                // A moment later, when the seconds that are due are whole.
                let at = Duration::from_secs(due.load(Ordering::Relaxed)) + Duration::from_millis(1);
                let wait = at.saturating_sub(elapsed());
                if wait.is_zero() {
                    log();
                } else {
                    ended = woken.wait_timeout(ended, wait).unwrap_or_else(PoisonError::into_inner).0;
                }
            }
        };
        let thread = std::thread::Builder::new().name("progress".into()).spawn(work).ok()?;
        Some(Self { over, thread: Some(thread) })
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        let (flag, woken) = &*self.over;
        *flag.lock().unwrap_or_else(PoisonError::into_inner) = true;
        woken.notify_all();
        if let Some(thread) = self.thread.take() {
            // It says lines and does nothing that could fail.
            let _ = thread.join();
        }
    }
}
