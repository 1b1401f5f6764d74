//! Runs pieces of work in parallel, each with its own threads.

use std::sync::{
    Mutex, PoisonError,
    atomic::{AtomicUsize, Ordering},
};

use rayon::ThreadPoolBuilder;

/// Results of `run(0)` .. `run(count - 1)`, in order.
///
/// As many pieces run at once as there are threads, each with its share of them. A motion is serial, so cores are used
/// for cases. Each piece has its own threads, so none waits for the work of another or is timed with it. Results do not
/// depend on the number of threads if those of `run` do not.
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
