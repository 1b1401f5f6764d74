//! One queue of work for all pages: the latest move of a page wins, and no page waits for the reductions of another.

use std::{
    collections::VecDeque,
    sync::{
        Arc, Condvar, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    time::{Duration, Instant},
};

use analysis::SharedGears;

/// A solve that is overtaken goes on so long: it is nearly there, and a slider that is moved without rest shall show
/// something.
const PATIENCE: Duration = Duration::from_millis(100);
/// Pages that are known at most; of more, which only a program can open, the first are forgotten.
const MOST_PAGES: usize = 256;
/// Moves that are solved at once, those included that nobody waits for any more and that end at their next step.
const MOST_AT_ONCE: usize = 8;
/// Moves of one page that are solved at once: the latest, and one before it that still ends.
const MOST_OF_A_PAGE: usize = 2;

/// The moves of all pages, numbered by each of them in the order in which they are made.
#[derive(Debug, Default)]
pub(crate) struct Queue {
    now: Mutex<Now>,
    changed: Condvar,
}

/// What a move asks for.
#[derive(Debug, Clone)]
pub(crate) struct Asked {
    pub page: u64,
    pub number: u64,
    /// What its gears have in common with others; `None` of a scene that is none.
    pub gears: Option<Arc<SharedGears>>,
    /// Set when whoever asked has gone.
    pub gone: Arc<AtomicBool>,
}

#[derive(Debug, Default)]
struct Now {
    /// Number of the first page that is known.
    first: u64,
    /// The latest move of each page, if it has made one.
    pages: VecDeque<Option<Asked>>,
    running: Vec<Asked>,
    ended: bool,
}

/// The right to solve a move, until it is dropped.
#[derive(Debug)]
pub(crate) struct Turn<'a> {
    queue: &'a Queue,
    asked: Asked,
    since: Instant,
}

impl Asked {
    fn is_gone(&self) -> bool {
        self.gone.load(Ordering::SeqCst)
    }

    fn is(&self, other: &Self) -> bool {
        (self.page, self.number) == (other.page, other.number)
    }
}

impl Now {
    /// The latest move of a page that is known.
    fn latest(&self, page: u64) -> Option<&Asked> {
        self.pages.get(usize::try_from(page.checked_sub(self.first)?).ok()?)?.as_ref()
    }

    /// Whether a move is still the latest of its page, and somebody waits for it.
    fn is_latest(&self, asked: &Asked) -> bool {
        !self.ended && !asked.is_gone() && self.latest(asked.page).is_some_and(|latest| latest.is(asked))
    }

    /// Whether it may begin: moves on the same gears one after the other, so that each finds what the one before it has
    /// reduced; one on other gears at once.
    fn may_begin(&self, asked: &Asked) -> bool {
        let own: Vec<&Asked> = self.running.iter().filter(|running| running.page == asked.page).collect();
        self.running.len() < MOST_AT_ONCE
            && own.len() < MOST_OF_A_PAGE
            && own.iter().all(|running| running.gears != asked.gears)
    }

    /// Whether the latest move of a page stands on some gears; a page that has not moved yet stands on those of the
    /// first scene, which are reduced for it.
    fn stand_on(&self, page: u64, gears: Option<&Arc<SharedGears>>) -> bool {
        let latest = self.latest(page);
        !self.ended && latest.is_some_and(|latest| !latest.is_gone() && latest.gears.as_ref() == gears)
    }
}

impl Queue {
    /// Number of a page that is opened now.
    pub fn open(&self) -> u64 {
        let mut now = self.now();
        if now.pages.len() == MOST_PAGES {
            now.pages.pop_front();
            now.first += 1;
        }
        now.pages.push_back(None);
        now.first + now.pages.len() as u64 - 1
    }

    /// Whether a page was opened, and is not forgotten.
    pub fn knows(&self, page: u64) -> bool {
        let now = self.now();
        page.checked_sub(now.first).is_some_and(|at| at < now.pages.len() as u64)
    }

    /// Waits until a move may be solved; `None` when a later one of its page has come by then, or whoever asked has
    /// gone.
    pub fn turn(&self, asked: Asked) -> Option<Turn<'_>> {
        let mut now = self.now();
        let at = usize::try_from(asked.page.checked_sub(now.first)?).ok()?;
        let latest = now.pages.get_mut(at)?;
        if latest.as_ref().is_none_or(|latest| latest.number < asked.number) {
            *latest = Some(asked.clone());
        }
        // Those that wait may have been overtaken.
        self.changed.notify_all();
        while now.is_latest(&asked) {
            if now.may_begin(&asked) {
                now.running.push(asked.clone());
                return Some(Turn { queue: self, asked, since: Instant::now() });
            }
            now = self.changed.wait(now).unwrap_or_else(PoisonError::into_inner);
        }
        None
    }

    /// Whether gears that are reduced before any page asks for them are wanted: until all pages have moved to others.
    pub fn may_want(&self, gears: &Arc<SharedGears>) -> bool {
        let now = self.now();
        let waits = |page: &Option<Asked>| page.as_ref().is_none_or(|latest| latest.gears.as_ref() == Some(gears));
        !now.ended && (now.pages.is_empty() || now.pages.iter().any(waits))
    }

    /// Who waits may have gone.
    pub fn look_again(&self) {
        // Between the look of one that waits and its sleep nothing may be missed.
        drop(self.now());
        self.changed.notify_all();
    }

    /// No move is wanted any more.
    pub fn end(&self) {
        self.now().ended = true;
        self.changed.notify_all();
    }

    fn now(&self) -> MutexGuard<'_, Now> {
        self.now.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Turn<'_> {
    /// Whether the answer is still waited for.
    pub fn wants_positions(&self) -> bool {
        let now = self.queue.now();
        let overtaken = !now.is_latest(&self.asked);
        !overtaken || (!now.ended && !self.asked.is_gone() && self.since.elapsed() < PATIENCE)
    }

    /// Whether its gears are, by a later move of the page if not by itself.
    pub fn wants_gears(&self) -> bool {
        self.queue.now().stand_on(self.asked.page, self.asked.gears.as_ref())
    }
}

impl Drop for Turn<'_> {
    fn drop(&mut self) {
        self.queue.now().running.retain(|running| !running.is(&self.asked));
        self.queue.changed.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use std::{sync::mpsc, thread};

    use scene::Scene;

    use super::*;

    fn gears(teeth: u32) -> Option<Arc<SharedGears>> {
        let text = format!(
            "[pinion]\nteeth = {teeth}\nhelix_angle_deg = 20.0\n[wheel]\nteeth = 30\n[pair]\nnormal_module_mm = 3.0\n\
             face_width_mm = 20.0\n[operation]\ntorque_nm = 150.0\n"
        );
        Some(Arc::new(SharedGears::of(&Scene::parse(&text, "a.toml".as_ref()).unwrap())))
    }

    fn asked(page: u64, number: u64, teeth: u32) -> Asked {
        Asked { page, number, gears: gears(teeth), gone: Arc::default() }
    }

    /// Three moves come while one is solved: the last of them is next, the others never.
    #[test]
    fn the_latest_move_wins_and_no_two_on_the_same_gears_are_solved_at_once() {
        let queue = Queue::default();
        let page = queue.open();
        let first = queue.turn(asked(page, 1, 30)).expect("nothing else is solved");
        let (say, heard) = mpsc::channel();
        thread::scope(|scope| {
            for number in [2, 3, 4] {
                let (say, queue) = (say.clone(), &queue);
                scope.spawn(move || {
                    let turn = queue.turn(asked(page, number, 30));
                    say.send((number, turn.is_some())).unwrap();
                });
                // Each has come before the next one is made.
                while queue.now().latest(page).unwrap().number < number {
                    thread::yield_now();
                }
            }
            let mut dropped = [heard.recv().unwrap(), heard.recv().unwrap()];
            dropped.sort_unstable();
            assert_eq!(dropped, [(2, false), (3, false)], "the overtaken ones leave while the first is still solved");
            assert!(first.wants_gears(), "the move that waits stands on the gears that are being reduced");
            drop(first);
            assert_eq!(heard.recv().unwrap(), (4, true));
        });
        assert!(queue.turn(asked(page, 3, 30)).is_none(), "a move that comes late is dropped at once");
    }

    #[test]
    fn a_move_to_other_gears_does_not_wait_for_those_that_are_being_reduced() {
        let queue = Queue::default();
        let (page, other) = (queue.open(), queue.open());
        let reduces = queue.turn(asked(page, 1, 30)).expect("nothing else is solved");
        let beside = queue.turn(asked(other, 1, 30)).expect("another page waits for nobody");
        let next = queue.turn(asked(page, 2, 31)).expect("other gears");
        assert!(!reduces.wants_gears() && next.wants_gears() && beside.wants_gears());
        let fits = |teeth| queue.now().may_begin(&asked(page, 3, teeth));
        assert!(!fits(32), "two of a page at most");
        drop(reduces);
        assert!(fits(32) && !fits(31));
    }

    #[test]
    fn an_overtaken_solve_is_given_up_when_it_is_slow_and_at_once_at_the_end() {
        let queue = Queue::default();
        let page = queue.open();
        let turn = queue.turn(asked(page, 1, 30)).expect("nothing else is solved");
        assert!(turn.wants_positions());
        let _next = queue.turn(asked(page, 2, 31)).expect("other gears");
        assert!(turn.wants_positions(), "it is nearly there");
        let slow = Turn { queue: &queue, asked: turn.asked.clone(), since: Instant::now() - 2 * PATIENCE };
        assert!(!slow.wants_positions(), "nobody waits for it any more");
        queue.end();
        assert!(!turn.wants_positions() && !turn.wants_gears(), "the page is gone");
        std::mem::forget(slow);
    }

    #[test]
    fn who_has_gone_wants_nothing() {
        let queue = Queue::default();
        let page = queue.open();
        let own = asked(page, 1, 30);
        let turn = queue.turn(own.clone()).expect("nothing else is solved");
        own.gone.store(true, Ordering::SeqCst);
        assert!(!turn.wants_positions() && !turn.wants_gears());
        drop(turn);
        assert!(queue.turn(own).is_none());
    }

    #[test]
    fn gears_of_the_first_scene_are_wanted_until_all_pages_have_others() {
        let (queue, first) = (Queue::default(), gears(30).unwrap());
        assert!(queue.may_want(&first), "the browser opens");
        let (page, other) = (queue.open(), queue.open());
        drop(queue.turn(asked(page, 1, 31)));
        assert!(queue.may_want(&first), "the other page has not moved yet");
        drop(queue.turn(asked(other, 1, 31)));
        assert!(!queue.may_want(&first));
    }
}
