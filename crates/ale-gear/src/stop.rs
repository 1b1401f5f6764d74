//! What happens when the user stops the program (Ctrl-C), or the system does.

use std::{
    process::exit,
    sync::{Mutex, PoisonError},
    thread,
    time::Duration,
};

use report::folder::remove_partial_paths;

/// Exit status of a process that was stopped in its work, as shells give it.
const STOPPED: i32 = 130;
/// How long work that ends by itself may take for it.
const GRACE: Duration = Duration::from_secs(1);

type Ending = Box<dyn FnOnce() + Send>;

/// How the work of this process is ended by itself.
static GENTLE: Mutex<Option<Ending>> = Mutex::new(None);

/// From now on the first stop calls `ending`, after which the process is to come to its end by itself; where it does not
/// soon, or where it is stopped again, it is ended.
pub(crate) fn gently(ending: impl FnOnce() + Send + 'static) {
    *GENTLE.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(ending));
}

/// Takes away what is half written when the user stops the program.
pub(crate) fn on_stop() {
    // A host that has a handler of its own keeps it; then the names of such paths still say what they are.
    let _ = ctrlc::set_handler(|| {
        if let Some(ending) = GENTLE.lock().unwrap_or_else(PoisonError::into_inner).take() {
            ending();
            thread::sleep(GRACE);
        }
        remove_partial_paths();
        exit(STOPPED);
    });
}
