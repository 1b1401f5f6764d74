//! What happens when the user stops the program (Ctrl-C), or the system does.

use std::{
    process::exit,
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    thread,
    time::Duration,
};

use files::hold_still;

/// Exit status of a process that was stopped in its work, as shells give it.
const STOPPED: i32 = 130;
/// How long work that ends by itself may take for it.
const GRACE: Duration = Duration::from_secs(1);

/// Whether the process is about to end with its folders taken away.
static STOPPING: AtomicBool = AtomicBool::new(false);

type Ending = Box<dyn FnOnce() + Send>;

/// How the work of this process is ended by itself.
static GENTLE: Mutex<Option<Ending>> = Mutex::new(None);

/// From now on the first stop calls `ending`, after which the process is to come to its end by itself; where it does not
/// soon, or where it is stopped again, it is ended.
pub(crate) fn gently(ending: impl FnOnce() + Send + 'static) {
    *GENTLE.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(ending));
}

/// Does not come back when the process is being stopped: what went wrong since then is its own doing.
pub fn unless_stopping() {
    while STOPPING.load(Ordering::SeqCst) {
        thread::park();
    }
}

/// Takes away what is half written when the user stops the program.
pub(crate) fn on_stop() {
    // A host that has a handler of its own keeps it; then the names of such paths still say what they are.
    let _ = ctrlc::set_handler(|| {
        if let Some(ending) = GENTLE.lock().unwrap_or_else(PoisonError::into_inner).take() {
            ending();
            thread::sleep(GRACE);
        }
        STOPPING.store(true, Ordering::SeqCst);
        // Held until the process is gone: nothing new is begun meanwhile.
        let _still = hold_still();
        exit(STOPPED);
    });
}
