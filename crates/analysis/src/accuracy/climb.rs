//! The common loop of all ladders: settings are tried from coarse to fine until their bounds meet the requested
//! accuracy.

use super::Accuracy;
use crate::{AnalysisError, Observer};

/// Settings of a question from coarse to fine, and the bounds of its answer on each of them.
pub(crate) trait Ladder {
    /// Settings that are solved.
    type Rung;
    /// What is solved on a rung.
    type Solved;
    /// A rung as results tell of it.
    type Tried;
    /// Rungs that are tried at the most.
    const TRIES: usize;

    /// Whether the settings are the program's to choose; else the first rung is the only one.
    fn chooses(&self) -> bool;

    /// The rung that is tried first.
    ///
    /// # Errors
    /// [`AnalysisError`] where what tells it cannot be solved.
    fn first(&mut self, observer: &mut dyn Observer) -> Result<Self::Rung, AnalysisError>;

    /// Solves the question on a rung.
    ///
    /// # Errors
    /// [`AnalysisError`].
    fn solve(&mut self, rung: &Self::Rung, observer: &mut dyn Observer) -> Result<Self::Solved, AnalysisError>;

    /// The rung that is tried after one on which nothing could be solved; `None` where the error stands.
    fn after_failure(&mut self, _rung: &Self::Rung, _error: &AnalysisError) -> Option<Self::Rung> {
        None
    }

    /// Bounds of the answer on a rung.
    ///
    /// # Errors
    /// [`AnalysisError`] where what they are taken from cannot be solved, or something is asked that has no bound.
    fn bound(
        &mut self,
        rung: &Self::Rung,
        solved: &Self::Solved,
        observer: &mut dyn Observer,
    ) -> Result<Accuracy, AnalysisError>;

    /// The rung that is tried next, finer in what the bounds that are not kept are mostly made of, and why this one is
    /// left; `None` where all are kept, or nothing finer is there.
    fn refine(&mut self, rung: &Self::Rung, solved: &Self::Solved, accuracy: &Accuracy)
    -> Option<(Self::Rung, String)>;

    /// What is noted where a rung is left.
    fn note(&self, _rung: &Self::Rung, why: &str) -> String {
        format!("left for a finer one: {why}")
    }

    /// A rung as results tell of it, and why it was left; `None` for the one that was taken.
    fn tried(&self, rung: &Self::Rung, left_because: Option<String>) -> Self::Tried;
}

/// Where a climb ended.
pub(crate) struct Climbed<L: Ladder> {
    /// The answer on the rung that was taken.
    pub solved: L::Solved,
    /// Bounds of the answer. What cannot be kept on the finest rung is an answer all the same: [`Accuracy::is_met`].
    pub accuracy: Accuracy,
    /// All rungs that were tried, in their order; empty where there was nothing to choose.
    pub tried: Vec<L::Tried>,
}

/// Climbs a ladder until the bounds keep what is asked.
///
/// # Errors
/// [`AnalysisError`] of a rung that no finer one replaces.
pub(crate) fn climb<L: Ladder>(ladder: &mut L, observer: &mut dyn Observer) -> Result<Climbed<L>, AnalysisError> {
    let mut tried = Vec::new();
    let mut rung = ladder.first(observer)?;
    loop {
        let solved = match ladder.solve(&rung, observer) {
            Ok(solved) => solved,
            Err(e) => {
                let Some(finer) = ladder.after_failure(&rung, &e) else { return Err(e) };
                observer.note(ladder.note(&rung, &e.to_string()));
                tried.push(ladder.tried(&rung, Some(e.to_string())));
                rung = finer;
                continue;
            }
        };
        let accuracy = ladder.bound(&rung, &solved, observer)?;
        let goes_on = ladder.chooses() && tried.len() + 1 < L::TRIES;
        let next = if goes_on { ladder.refine(&rung, &solved, &accuracy) } else { None };
        if ladder.chooses() {
            tried.push(ladder.tried(&rung, next.as_ref().map(|(_, why)| why.clone())));
        }
        let Some((finer, why)) = next else { return Ok(Climbed { solved, accuracy, tried }) };
        observer.note(ladder.note(&rung, &why));
        rung = finer;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        NoObserver,
        accuracy::{Bound, Cause, Term},
        refused::Refusal,
    };
    use scene::{Quantity, Tolerance};

    /// A number 1 + 1/n on rung n, of which rung `fails` has none.
    struct Halving {
        chooses: bool,
        fails: u32,
        last: u32,
    }

    impl Ladder for Halving {
        type Rung = u32;
        type Solved = f64;
        type Tried = (u32, bool);
        const TRIES: usize = 6;

        fn chooses(&self) -> bool {
            self.chooses
        }

        fn first(&mut self, _: &mut dyn Observer) -> Result<u32, AnalysisError> {
            Ok(1)
        }

        fn solve(&mut self, rung: &u32, _: &mut dyn Observer) -> Result<f64, AnalysisError> {
            if *rung == self.fails {
                return Err(Refusal::no_result("too coarse", None).into());
            }
            Ok(1.0 + 1.0 / f64::from(*rung))
        }

        fn after_failure(&mut self, rung: &u32, _: &AnalysisError) -> Option<u32> {
            self.chooses.then_some(2 * rung)
        }

        fn bound(&mut self, rung: &u32, solved: &f64, _: &mut dyn Observer) -> Result<Accuracy, AnalysisError> {
            let term = Term { cause: Cause::Mesh, known: 0.0, amount: 1.0 / f64::from(*rung) };
            let bound = Bound::new(Quantity::MeanSte, *solved, vec![term]);
            let bounds = vec![bound.against(Some(Tolerance::Absolute(0.1)))];
            Ok(Accuracy { bounds, ..Accuracy::default() })
        }

        fn refine(&mut self, rung: &u32, _: &f64, accuracy: &Accuracy) -> Option<(u32, String)> {
            (!accuracy.is_met() && 2 * rung <= self.last).then(|| (2 * rung, "too coarse".into()))
        }

        fn tried(&self, rung: &u32, left_because: Option<String>) -> (u32, bool) {
            (*rung, left_because.is_some())
        }
    }

    fn climbed(mut ladder: Halving) -> Result<Climbed<Halving>, AnalysisError> {
        climb(&mut ladder, &mut NoObserver)
    }

    /// It ends on the first rung whose bound keeps what is asked; a rung without an answer is left for a finer one; all
    /// are told.
    #[test]
    fn the_first_rung_that_keeps_what_is_asked_is_taken() {
        let up = climbed(Halving { chooses: true, fails: 2, last: 64 }).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(up.solved, 1.0 + 1.0 / 16.0);
        assert_eq!(up.tried, [(1, true), (2, true), (4, true), (8, true), (16, false)]);
        assert!(up.accuracy.is_met());
    }

    /// The finest rung is an answer that does not keep what is asked, and no more than so many are tried.
    #[test]
    fn a_ladder_ends() {
        let short = climbed(Halving { chooses: true, fails: 0, last: 4 }).unwrap_or_else(|e| panic!("{e}"));
        assert!(short.solved == 1.25 && !short.accuracy.is_met() && short.tried.len() == 3);
        let given = climbed(Halving { chooses: false, fails: 0, last: 64 }).unwrap_or_else(|e| panic!("{e}"));
        assert!(given.solved == 2.0 && given.tried.is_empty() && !given.accuracy.is_met());
        assert!(climbed(Halving { chooses: false, fails: 1, last: 64 }).is_err());
    }
}
