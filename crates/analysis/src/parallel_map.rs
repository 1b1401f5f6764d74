//! Pieces of work side by side, each with threads of its own.

use std::sync::{
    Mutex, PoisonError,
    atomic::{AtomicUsize, Ordering},
};

use rayon::ThreadPoolBuilder;

/// Results of `run(0)` .. `run(count - 1)`, in their order.
///
/// As many run at once as there are threads, each with its share of them: motion is serial, so cores serve cases. The
/// threads of a piece are its own, so that none waits for, or is timed with, the work of another. Results do not depend
/// on their number where those of `run` do not.
pub fn parallel_map<T: Send>(count: usize, run: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let threads = rayon::current_num_threads();
    let workers = threads.min(count).max(1);
    let next = AtomicUsize::new(0);
    let slots: Vec<Mutex<Option<T>>> = (0..count).map(|_| Mutex::new(None)).collect();
    let work = || {
        let pool = ThreadPoolBuilder::new().num_threads((threads / workers).max(1)).build();
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            let Some(slot) = slots.get(i) else { break };
            let ran = match &pool {
                Ok(pool) => pool.install(|| run(i)),
                // No threads to be had: the process's own serve as well.
                Err(_) => run(i),
            };
            *slot.lock().unwrap_or_else(PoisonError::into_inner) = Some(ran);
        }
    };
    std::thread::scope(|scope| {
        let others: Vec<_> = (1..workers).map(|_| scope.spawn(work)).collect();
        work();
        drop(others);
    });
    slots.into_iter().filter_map(|slot| slot.into_inner().unwrap_or_else(PoisonError::into_inner)).collect()
}
