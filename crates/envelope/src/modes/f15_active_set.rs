//! F15: an active set that goes round in circles.

use analysis::worse;
use contact::complementarity::{Balance, DenseProblem, DenseSolver};
use nalgebra::{DMatrix, DVector};

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, largest},
    pieces::active_set::naive_ends,
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 15,
    name: "active-set cycling",
    file: "F15-active-set",
    scene: scene_text!("F15-active-set"),
    fails: "Points come in and go out in turns where gaps are equal or points lie on an edge; the loop ends at its limit.",
    does: "Block pivots only while they make progress, then single pivots by the least index, which end; the residual is in every result.",
    naive: &[],
    look,
};

const ROWS: usize = 24;
const PROBLEMS: u64 = 400;

/// Numbers between 0 and 1 by Knuth's linear congruence; the same on every machine.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Three rows that send each other in and out (F. E. Curtis, Z. Han, D. P. Robinson, Comput. Optim. Appl. 60, 2015),
/// eight times over, their gaps a little apart; all gaps equal on every third problem.
const TRIPLE: [[f64; 3]; 3] = [[4.0, 5.0, -5.0], [5.0, 9.0, -5.0], [-5.0, -5.0, 7.0]];
const TRIPLE_GAPS: [f64; 3] = [-2.0, -1.0, 3.0];

fn problem(seed: u64) -> (DMatrix<f64>, DVector<f64>) {
    let mut random = Random(seed.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
    let compliance =
        DMatrix::from_fn(ROWS, ROWS, |i, j| if i / 3 == j / 3 { 1e-6 * TRIPLE[i % 3][j % 3] } else { 0.0 });
    let equal = seed.is_multiple_of(3);
    let gap = |i: usize, apart: f64| if equal { -0.01 } else { 5e-3 * TRIPLE_GAPS[i % 3] * (1.0 + 0.1 * apart) };
    let gaps = DVector::from_fn(ROWS, |i, _| gap(i, random.next() - 0.5));
    (compliance, gaps)
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let (mut circles, mut worst, mut apart) = (0, 0.0f64, 0.0f64);
    for seed in 0..PROBLEMS {
        let (compliance, gaps) = problem(seed);
        let mut random = Random(seed ^ 0x5555);
        let start: Vec<bool> = (0..ROWS).map(|_| random.next() < 0.5).collect();
        circles += usize::from(!naive_ends(&compliance, &gaps, &start));
        let dense = faer::Mat::from_fn(ROWS, ROWS, |i, j| compliance[(i, j)]);
        let levers = [1.0; ROWS];
        let held = DenseProblem {
            compliance: dense.as_ref(),
            symmetric: true,
            gaps: gaps.as_slice(),
            levers: &levers,
            torque_levers: &levers,
            balance: Balance::Held,
        };
        let mut answers: Vec<Vec<f64>> = Vec::new();
        for restart in 0..3 {
            let mut solver = DenseSolver::new(ROWS);
            let begin =
                |i: usize| if restart == 0 { 0.0 } else { f64::from(restart) * 400.0 * f64::from(u8::from(start[i])) };
            solver.solve(&held, |_, _| (0.0, 0.0), begin).map_err(EnvelopeError::of("active set"))?;
            worst = worse(worst, solver.residual());
            answers.push(solver.forces().to_vec());
        }
        let size = largest(answers[0].iter().copied());
        let differs = answers.iter().flat_map(|a| a.iter().zip(&answers[0])).map(|(a, b)| (a - b).abs() / size);
        apart = differs.fold(apart, worse);
    }
    let pair = bench.at_rest(&AS_IT_IS)?;
    let residual = largest(pair.history.positions.iter().map(|p| p.certificate.complementarity_residual));
    Ok(vec![
        Figure::new(
            "400 problems, a third of equal gaps, three starts each: largest violation; naive: problems that go round in circles",
            Shown::at_most(worst, 1e-9),
        )
        .beside(Shown::at_least(circles as f64, 20.0)),
        Figure::new("forces from other starts, parts of the largest off", Shown::at_most(apart, 1e-6)),
        Figure::new("spur pair on points, more points than nodes, symmetric pose: violation", Shown::at_most(residual, 1e-8)),
    ])
}
