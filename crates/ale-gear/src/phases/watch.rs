//! Lines of text for a log while a phase has no steps, or none yet.

use std::{
    sync::{Arc, Condvar, Mutex, PoisonError, atomic::Ordering},
    thread::JoinHandle,
    time::Duration,
};

use super::BarProgress;

/// A thread that says how far a phase is whenever a line is due; it ends with this.
#[derive(Debug)]
pub(super) struct Watch {
    over: Arc<(Mutex<bool>, Condvar)>,
    thread: Option<JoinHandle<()>>,
}

impl Watch {
    /// Of a phase that says lines at all; `None` of others, and where the system gives no thread.
    pub(super) fn begin(progress: &BarProgress) -> Option<Self> {
        let due = progress.due.clone()?;
        let (over, progress) = (Arc::new((Mutex::new(false), Condvar::new())), progress.clone());
        let own = Arc::clone(&over);
        let work = move || {
            let (flag, woken) = &*own;
            let mut ended = flag.lock().unwrap_or_else(PoisonError::into_inner);
            while !*ended {
                // A moment later, when the seconds that are due are whole.
                let at = Duration::from_secs(due.load(Ordering::Relaxed)) + Duration::from_millis(1);
                let wait = at.saturating_sub(progress.bar.elapsed());
                if wait.is_zero() {
                    progress.log(&due);
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
