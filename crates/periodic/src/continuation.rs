//! A branch of periodic motions over a parameter, around its folds. Pseudo-arclength (Keller, 1977). Theory (70).

use nalgebra::DVector;

use crate::{
    BalanceOptions, Floquet, FourierSeries, Loss, PeriodicError, PeriodicMotion,
    dense::solved,
    equations::{Balance, PeriodicEquations},
    series::Basis,
    solution::{Condition, Equations, Point, Solved, unknowns},
    turns::listed,
};

/// Options of a branch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BranchOptions {
    /// The branch ends where the parameter leaves this range.
    pub range: [f64; 2],
    /// First step of the parameter, signed: the way to go.
    pub first_step: f64,
    /// Largest step along the branch, in ranges of the parameter and scales of the coordinates.
    pub longest_step: f64,
    /// Largest number of motions.
    pub most: usize,
}

/// Point at which a branch changes its stability.
#[derive(Debug, Clone, PartialEq)]
pub struct Bifurcation {
    /// How.
    pub loss: Loss,
    /// The motion there.
    pub motion: PeriodicMotion,
    /// Number (from 0) of the motion of the branch before it.
    pub after: usize,
}

/// A branch of periodic motions.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch<E> {
    /// Motions along it.
    pub motions: Vec<PeriodicMotion>,
    /// Folds, period doublings and torus bifurcations, in order.
    pub bifurcations: Vec<Bifurcation>,
    /// Newton steps in all.
    pub iterations: usize,
    /// Why it goes no further, where it stops within its range: steps as short as allowed lead nowhere.
    pub broken: Option<PeriodicError<E>>,
}

/// Newton steps for which the step along the branch is kept.
const WANTED: f64 = 4.0;
/// Shortest step over the longest.
const SHORTEST: f64 = 1e-5;
/// Steps to a bifurcation.
const REFINEMENTS: usize = 40;
/// How near to a bifurcation is near enough, over the step that passed it.
const NEAR: f64 = 1e-7;
/// Largest growth and decrease of a step.
const CHANGE: [f64; 2] = [0.5, 1.6];

/// Follows motions of one family.
pub struct Tracer<'a, S> {
    system: &'a mut S,
    options: BalanceOptions,
    basis: Basis,
    unit: f64,
    iterations: usize,
}

/// A motion whose stability is not judged, with what was found on the way.
struct Solution {
    motion: PeriodicMotion,
    x: DVector<f64>,
    balance: Balance,
}

/// A motion with the direction of its branch.
struct Place {
    motion: PeriodicMotion,
    x: DVector<f64>,
    tangent: DVector<f64>,
}

impl Place {
    /// Change of the parameter along the branch: 0 at a fold.
    fn slope(&self) -> f64 {
        self.tangent[self.tangent.len() - 1]
    }
}

impl<'a, S: PeriodicEquations> Tracer<'a, S> {
    /// Tracer for a system; `unit`: what counts as a large change of its parameter, > 0.
    ///
    /// # Errors
    /// [`PeriodicError::OutOfRange`].
    pub fn new(system: &'a mut S, options: BalanceOptions, unit: f64) -> Result<Self, PeriodicError<S::Error>> {
        let check = |name, value: f64, fine: bool, expected| {
            if fine { Ok(()) } else { Err(PeriodicError::OutOfRange { name, value, expected }) }
        };
        check("scale of the parameter", unit, unit.is_finite() && unit > 0.0, "above 0")?;
        check("harmonics", options.harmonics as f64, options.harmonics >= 1, "1 or more")?;
        let most = options.most_harmonics;
        check("most harmonics", most as f64, most >= options.harmonics, "no less than the first number")?;
        let samples = options.samples_per_harmonic;
        check("samples per harmonic", samples as f64, samples >= 4, "4 or more")?;
        let basis = basis_of(&options, options.harmonics);
        Ok(Self { system, options, basis, unit, iterations: 0 })
    }

    fn equations(&mut self) -> Equations<'_, S> {
        Equations { system: &mut *self.system, basis: &self.basis, unit: self.unit, tolerance: self.options.tolerance }
    }

    /// The periodic motion at a value of the parameter, from a near-by one.
    ///
    /// # Errors
    /// [`PeriodicError`] where none is found, or where it has too many harmonics.
    pub fn motion_at(
        &mut self,
        parameter: f64,
        start: &FourierSeries,
    ) -> Result<PeriodicMotion, PeriodicError<S::Error>> {
        Ok(self.first(parameter, start, 1.0)?.motion)
    }

    /// The place of the motion near `start` at a value of the parameter, and the way on from there.
    fn first(&mut self, parameter: f64, start: &FourierSeries, way: f64) -> Result<Place, PeriodicError<S::Error>> {
        let series = start.with_harmonics(self.basis.harmonics());
        let x = unknowns(&Point { parameter, series }, &self.system.scale(), self.unit);
        let mut normal = DVector::zeros(x.len());
        normal[x.len() - 1] = way;
        self.place(&x, normal)
    }

    /// The motion that keeps a condition, with as many harmonics as it needs.
    fn corrected(&mut self, x: &DVector<f64>, normal: DVector<f64>) -> Result<Solution, PeriodicError<S::Error>> {
        let (mut x, mut normal) = (widened(x, self.unknowns()), widened(&normal, self.unknowns()));
        loop {
            let condition = Condition { normal: normal.clone(), at: x.clone() };
            let Solved { point, balance, iterations } = self.equations().solve(&x, &condition)?;
            self.iterations += iterations;
            let scale = self.system.scale();
            let Point { parameter, series } = point;
            let harmonics = self.basis.harmonics();
            if balance.tail > self.options.tail {
                let allowed = self.options.tail;
                if harmonics >= self.options.most_harmonics {
                    return Err(PeriodicError::Harmonics { parameter, harmonics, tail: balance.tail, allowed });
                }
                let more = (harmonics + harmonics.div_ceil(2)).min(self.options.most_harmonics);
                self.basis = basis_of(&self.options, more);
                x = unknowns(&Point { parameter, series: series.with_harmonics(more) }, &scale, self.unit);
                normal = widened(&normal, x.len());
                continue;
            }
            let period = self.system.period();
            let floquet = Floquet { multipliers: Vec::new() };
            let residual = balance.residual.norm() / balance.size.max(f64::MIN_POSITIVE);
            let x = unknowns(&Point { parameter, series: series.clone() }, &scale, self.unit);
            let motion =
                PeriodicMotion { parameter, series, period, floquet, residual, tail: balance.tail, iterations };
            return Ok(Solution { motion, x, balance });
        }
    }

    /// Direction of the branch at unknowns that solve the equations, the way `before` goes.
    fn tangent(&mut self, solution: &Solution, before: &DVector<f64>) -> Result<DVector<f64>, PeriodicError<S::Error>> {
        let Solution { x, balance, motion } = solution;
        let (parameter, series) = (motion.parameter, motion.series.clone());
        let matrix = self.equations().matrix((x, &Point { parameter, series }), balance, before)?;
        let mut right = DVector::zeros(matrix.nrows());
        right[x.len() - 1] = 1.0;
        let tangent = solved(matrix, right).ok_or(PeriodicError::Singular { parameter })?;
        let tangent = tangent.rows(0, x.len()).into_owned();
        Ok(&tangent / tangent.norm())
    }

    fn place(&mut self, x: &DVector<f64>, normal: DVector<f64>) -> Result<Place, PeriodicError<S::Error>> {
        let (mut place, balance) = self.unjudged(x, normal)?;
        let singular = PeriodicError::Singular { parameter: place.motion.parameter };
        place.motion.floquet = self.system.floquet(&self.basis, &balance).ok_or(singular)?;
        Ok(place)
    }

    /// A place without the multipliers of its motion, which can cost more than all else.
    fn unjudged(
        &mut self,
        x: &DVector<f64>,
        normal: DVector<f64>,
    ) -> Result<(Place, Balance), PeriodicError<S::Error>> {
        let found = self.corrected(x, normal.clone())?;
        let tangent = self.tangent(&found, &widened(&normal, found.x.len()))?;
        let Solution { motion, x, balance } = found;
        Ok((Place { motion, x, tangent }, balance))
    }

    /// The branch through a motion near `start`, from one end of the range to where it leaves it. `seen` gets each
    /// motion and may end it.
    ///
    /// # Errors
    /// [`PeriodicError`] where the first motion is not found, or no second one.
    pub fn branch(
        &mut self,
        parameter: f64,
        start: &FourierSeries,
        options: &BranchOptions,
        mut seen: impl FnMut(&PeriodicMotion) -> std::ops::ControlFlow<()>,
    ) -> Result<Branch<S::Error>, PeriodicError<S::Error>> {
        let mut here = self.first(parameter, start, options.first_step.signum())?;
        let mut step = (options.first_step / self.unit).abs().min(options.longest_step);
        let motions = vec![here.motion.clone()];
        let mut branch = Branch { motions, bifurcations: Vec::new(), iterations: 0, broken: None };
        let shortest = SHORTEST * options.longest_step;
        let (mut told, mut passed) = (0, Vec::new());
        while branch.motions.len() < options.most {
            // A step that is tried anew begins at the same motion.
            if told < branch.motions.len() && seen(&here.motion).is_break() {
                break;
            }
            told = branch.motions.len();
            let guess = &here.x + &here.tangent * step;
            let next = match self.place(&guess, here.tangent.clone()) {
                Ok(next) if widened(&here.tangent, next.x.len()).dot(&next.tangent) > 0.5 => next,
                stuck if step <= shortest => {
                    let parameter = here.motion.parameter;
                    let why = stuck.err().unwrap_or(PeriodicError::Singular { parameter });
                    if branch.motions.len() == 1 {
                        return Err(why);
                    }
                    branch.broken = Some(why);
                    break;
                }
                _ => {
                    step *= CHANGE[0];
                    continue;
                }
            };
            if let Some((loss, motion)) = self.between(&here, &next, step)? {
                passed.push(Bifurcation { loss, motion, after: branch.motions.len() - 1 });
            }
            let growth = WANTED / next.motion.iterations.max(1) as f64;
            step = (step * growth.clamp(CHANGE[0], CHANGE[1])).min(options.longest_step);
            here = next;
            branch.motions.push(here.motion.clone());
            let end = here.motion.parameter.clamp(options.range[0], options.range[1]);
            if end != here.motion.parameter {
                // Beyond the range: the last motion is the one at its end, where there is one near by.
                let near = here.motion.series.clone();
                if let (Ok(at_end), Some(last)) = (self.motion_at(end, &near), branch.motions.last_mut()) {
                    *last = at_end;
                }
                break;
            }
        }
        branch.iterations = self.iterations;
        branch.bifurcations = listed(&branch.motions, passed, self.unit);
        Ok(branch)
    }

    /// What the branch passed between two of its places, found to a small part of the step.
    fn between(
        &mut self,
        here: &Place,
        next: &Place,
        step: f64,
    ) -> Result<Option<(Loss, PeriodicMotion)>, PeriodicError<S::Error>> {
        let folds = here.slope() * next.slope() < 0.0;
        let changes = here.motion.floquet.is_stable() != next.motion.floquet.is_stable();
        if !folds && !changes {
            return Ok(None);
        }
        let measure = |place: &Place| if folds { place.slope() } else { place.motion.floquet.largest() - 1.0 };
        let (mut a, mut b) = ((0.0, measure(here)), (step, measure(next)));
        let mut found: Option<Place> = None;
        for turn in 0..REFINEMENTS {
            if (b.0 - a.0).abs() <= NEAR * step {
                break;
            }
            // False position, every third time the middle: a measure with a kink would stay on one side.
            let at = if turn % 3 == 2 { 0.5 * (a.0 + b.0) } else { a.0 - a.1 * (b.0 - a.0) / (b.1 - a.1) };
            let x = &here.x + &here.tangent * at;
            // The multipliers of a fold are those of the motion that is found in the end.
            let place = if folds {
                self.unjudged(&x, here.tangent.clone()).map(|(place, _)| place)
            } else {
                self.place(&x, here.tangent.clone())
            };
            let Ok(place) = place else { break };
            let value = measure(&place);
            if value * a.1 > 0.0 {
                a = (at, value)
            } else {
                b = (at, value)
            }
            found = Some(place);
            if value == 0.0 {
                break;
            }
        }
        if let (true, Some(place)) = (folds, &mut found) {
            *place = self.place(&place.x, here.tangent.clone())?;
        }
        let loss = match &found {
            _ if folds => Loss::Fold,
            Some(place) => place.motion.floquet.loss(),
            None => next.motion.floquet.loss(),
        };
        Ok(Some((loss, found.map_or_else(|| next.motion.clone(), |place| place.motion))))
    }

    fn unknowns(&self) -> usize {
        self.system.scale().len() * (2 * self.basis.harmonics() + 1) + 1
    }
}

fn basis_of(options: &BalanceOptions, harmonics: usize) -> Basis {
    Basis::new(harmonics, (options.samples_per_harmonic * harmonics).max(options.least_samples))
}

/// A list of unknowns with more harmonics; the parameter stays last.
fn widened(x: &DVector<f64>, len: usize) -> DVector<f64> {
    if x.len() >= len {
        return x.clone();
    }
    let last = x.len() - 1;
    let mut all = DVector::zeros(len);
    all.rows_mut(0, last).copy_from(&x.rows(0, last));
    all[len - 1] = x[last];
    all
}
