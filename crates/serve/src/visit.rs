//! Connections: how many there may be, and how long each may take.
//!
//! Whoever reaches the port may connect: other users of the machine, and any page in the browser. Until the head of a
//! request has shown the token, a connection is a stranger: it gets little memory, little time, and makes room for
//! others. No body is read of a stranger.

use std::{
    collections::VecDeque,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::Duration,
};

use tokio::{task::AbortHandle, time::Instant};

/// Strangers at once; the one that has been here longest goes when another comes.
const MOST_STRANGERS: usize = 64;
/// Requests with the token at once; a page makes six at the most.
const MOST_KNOWN: usize = 64;
/// Within this time the head of a request has come.
const HEAD: Duration = Duration::from_secs(5);
/// Within this time a body has come, and an answer is taken: both go through memory of this machine.
pub(crate) const TRANSFER: Duration = Duration::from_secs(20);
/// No limit: a solve takes as long as it takes.
const ALWAYS: Duration = Duration::from_secs(365 * 86_400);

/// Who is connected.
#[derive(Debug, Default)]
pub(crate) struct Connections {
    now: Mutex<Now>,
}

#[derive(Debug, Default)]
struct Now {
    made: u64,
    strangers: VecDeque<(u64, AbortHandle)>,
    known: usize,
}

/// One connection, which has one request.
#[derive(Debug)]
pub(crate) struct Visit {
    connections: Arc<Connections>,
    number: u64,
    state: Mutex<State>,
}

#[derive(Debug)]
struct State {
    /// When it is closed.
    until: Instant,
    known: bool,
}

impl Connections {
    /// A connection that was made now, and what attends to it, `begin` of it. The stranger that has been here longest
    /// makes room for it.
    pub fn welcome(self: &Arc<Self>, begin: impl FnOnce(Arc<Visit>) -> AbortHandle) {
        let mut now = self.now();
        if now.strangers.len() == MOST_STRANGERS
            && let Some((_, longest)) = now.strangers.pop_front()
        {
            longest.abort();
        }
        now.made += 1;
        let (connections, number) = (Arc::clone(self), now.made);
        let state = Mutex::new(State { until: Instant::now() + HEAD, known: false });
        // It begins when this thread does something else: what it says of itself finds it listed.
        let task = begin(Arc::new(Visit { connections, number, state }));
        now.strangers.push_back((number, task));
    }

    fn now(&self) -> MutexGuard<'_, Now> {
        self.now.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Visit {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The token was shown; `false` where too many have shown it already.
    pub fn is_known(&self) -> bool {
        let (mut now, mut state) = (self.connections.now(), self.state());
        if !state.known && now.known < MOST_KNOWN {
            now.strangers.retain(|(number, _)| *number != self.number);
            now.known += 1;
            state.known = true;
        }
        state.known
    }

    /// When it is closed.
    pub fn until(&self) -> Instant {
        self.state().until
    }

    /// Closes the connection after this time.
    pub fn within(&self, time: Duration) {
        self.state().until = Instant::now() + time;
    }

    /// Leaves it open until more is said.
    pub fn as_long_as_it_takes(&self) {
        self.within(ALWAYS);
    }
}

impl Drop for Visit {
    fn drop(&mut self) {
        let (mut now, known) = (self.connections.now(), self.state().known);
        if known {
            now.known -= 1;
        } else {
            now.strangers.retain(|(number, _)| *number != self.number);
        }
    }
}
