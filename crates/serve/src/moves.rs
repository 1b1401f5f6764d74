//! One solve at a time a page, and the latest move wins.

use std::{
    sync::{Condvar, Mutex, MutexGuard, PoisonError},
    time::{Duration, Instant},
};

/// A solve that is overtaken goes on so long: it is nearly there, and a slider that is moved without rest shall show
/// something.
const PATIENCE: Duration = Duration::from_millis(100);

/// The moves of one page, numbered by it in the order in which they are made.
#[derive(Debug, Default)]
pub(crate) struct Moves {
    now: Mutex<Now>,
    changed: Condvar,
}

#[derive(Debug, Default)]
struct Now {
    /// Number of the latest move.
    latest: u64,
    solving: bool,
}

/// The right to solve a move, until it is dropped.
#[derive(Debug)]
pub(crate) struct Turn<'a> {
    moves: &'a Moves,
    number: u64,
    since: Instant,
}

impl Moves {
    /// Waits until no other move of the page is being solved; `None` when a later one has come by then.
    pub fn turn(&self, number: u64) -> Option<Turn<'_>> {
        let mut now = self.now();
        now.latest = now.latest.max(number);
        // Those that wait may have been overtaken.
        self.changed.notify_all();
        while now.latest == number {
            if !now.solving {
                now.solving = true;
                return Some(Turn { moves: self, number, since: Instant::now() });
            }
            now = self.changed.wait(now).unwrap_or_else(PoisonError::into_inner);
        }
        None
    }

    /// No move is wanted any more.
    pub fn end(&self) {
        self.now().latest = u64::MAX;
        self.changed.notify_all();
    }

    fn now(&self) -> MutexGuard<'_, Now> {
        self.now.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Turn<'_> {
    /// Whether its answer is still looked for.
    pub fn is_wanted(&self) -> bool {
        let latest = self.moves.now().latest;
        latest == self.number || (latest < u64::MAX && self.since.elapsed() < PATIENCE)
    }
}

impl Drop for Turn<'_> {
    fn drop(&mut self) {
        self.moves.now().solving = false;
        self.moves.changed.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use std::{sync::mpsc, thread};

    use super::*;

    /// Three moves come while one is solved: the last of them is next, the others never.
    #[test]
    fn the_latest_move_wins_and_no_two_are_solved_at_once() {
        let moves = Moves::default();
        let first = moves.turn(1).expect("nothing else is solved");
        let (say, heard) = mpsc::channel();
        thread::scope(|scope| {
            for number in [2, 3, 4] {
                let (say, moves) = (say.clone(), &moves);
                scope.spawn(move || {
                    let turn = moves.turn(number);
                    say.send((number, turn.is_some())).unwrap();
                });
                // Each has come before the next one is made.
                while moves.now().latest < number {
                    thread::yield_now();
                }
            }
            let mut dropped = [heard.recv().unwrap(), heard.recv().unwrap()];
            dropped.sort_unstable();
            assert_eq!(dropped, [(2, false), (3, false)], "the overtaken ones leave while the first is still solved");
            drop(first);
            assert_eq!(heard.recv().unwrap(), (4, true));
        });
        assert!(moves.turn(3).is_none(), "a move that comes late is dropped at once");
    }

    #[test]
    fn an_overtaken_solve_is_given_up_when_it_is_slow_and_at_once_at_the_end() {
        let moves = Moves::default();
        let turn = moves.turn(1).expect("nothing else is solved");
        assert!(turn.is_wanted());
        moves.now().latest = 2;
        assert!(turn.is_wanted(), "it is nearly there");
        let slow = Turn { moves: &moves, number: 1, since: Instant::now() - 2 * PATIENCE };
        assert!(!slow.is_wanted(), "nobody waits for it any more");
        moves.end();
        assert!(!turn.is_wanted(), "the page is gone");
        std::mem::forget(slow);
    }
}
