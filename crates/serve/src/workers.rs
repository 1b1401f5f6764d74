//! Threads that solve moves.

use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{Arc, Mutex, PoisonError, mpsc},
    thread::{self, Scope},
};

use analysis::Interest;
use live::Session;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::{
    queue::{Asked, Queue},
    routes::Job,
};

/// Solves moves, each on threads of its own: a reduction of one page keeps no thread from another page.
pub(crate) struct Workers<'a> {
    session: &'a Session<'a>,
    queue: &'a Queue,
    /// Threads that wait for a move.
    idle: Mutex<Vec<ThreadPool>>,
}

impl<'a> Workers<'a> {
    /// None is at work.
    pub fn new(session: &'a Session<'a>, queue: &'a Queue) -> Self {
        Self { session, queue, idle: Mutex::default() }
    }

    /// Reduces the gears of the first scene while the browser opens; what is wrong with it the page will say.
    pub fn warm(&self) {
        if let Some(scene) = self.session.first_scene() {
            let gears = Arc::new(analysis::SharedGears::of(&scene));
            let wanted = || self.queue.may_want(&gears);
            self.on_own_threads(|| self.session.warm(&scene, Interest { gears: &wanted, positions: &wanted }));
        }
    }

    /// Solves moves until no more come.
    pub fn work<'scope>(&'scope self, scope: &'scope Scope<'scope, '_>, jobs: mpsc::Receiver<Job>) {
        for job in jobs {
            // Where the system gives no thread, the job is dropped, and its page told.
            let _ = thread::Builder::new().spawn_scoped(scope, || self.solve(job));
        }
    }

    fn solve(&self, job: Job) {
        let Job { change, gone, answer } = job;
        let answered = self.on_own_threads(|| {
            let taken = self.session.take(&change);
            let asked = Asked { page: change.page, number: change.number, gears: taken.gears(), gone };
            let turn = self.queue.turn(asked)?;
            let (gears, positions) = (|| turn.wants_gears(), || turn.wants_positions());
            self.session.answer(change.number, taken, Interest { gears: &gears, positions: &positions })
        });
        if let Some(body) = answered {
            // Whoever asked may have gone.
            let _ = answer.send(body);
        }
    }

    /// `None` where the work has panicked, which is written to stderr, or no threads are to be had.
    fn on_own_threads<T: Send>(&self, work: impl FnOnce() -> T + Send) -> Option<T> {
        let idle = || self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        let kept = idle().pop();
        let threads = match kept {
            Some(threads) => threads,
            None => ThreadPoolBuilder::new().num_threads(rayon::current_num_threads()).build().ok()?,
        };
        let done = catch_unwind(AssertUnwindSafe(|| threads.install(work)));
        idle().push(threads);
        done.ok()
    }
}
