//! Free coordinates of a moving gearbox, and their effect on its bodies. Theory (92).

use nalgebra::{DMatrix, DVector};

use super::{Drive, ReducedBodies};
use crate::{Assembly, Operation, Train};

/// Coordinates z of the motion.
///
/// ```text
/// y = B z + r psi,   theta of shaft i = ratio_i psi + deviation
/// ```
/// psi: turn of the input, given with time or a coordinate of its own; r turns all shafts by their ratios in space, and with
/// the frame of a carrier the axes of its planets. All other coordinates are deviations from that, so that they keep their digits however far the shafts have turned. The input has
/// none of its own; where its torque balances, all are such that they have no momentum along r:
///
/// ```text
/// b := b - r (r' M b)/(r' M r)
/// ```
#[derive(Debug, Clone)]
pub(super) struct FreeCoordinates {
    /// B, with a column r where the input's turn is free.
    pub basis: DMatrix<f64>,
    /// r.
    pub rigid: DVector<f64>,
    /// Generalised force of a unit input torque.
    pub input: DVector<f64>,
    /// r in the coordinates z without psi: turns of the train with the input held back to its place.
    pub turning: DVector<f64>,
    /// Number of the coordinate psi, where a torque drives.
    pub turn: Option<usize>,
    /// Which coordinates are turns (rad); the others are mm, modes among them.
    pub turns: Vec<bool>,
    /// First of the coordinates that are modes of gears, which stand together.
    pub first_of_gears: usize,
}

/// How shafts are guided beside their turns, which are always free.
pub(super) struct Guide<'a> {
    /// Whether a shaft moves along or about an axis (0 .. 4).
    pub moves: &'a dyn Fn(usize, usize) -> bool,
    /// A shaft whose turn is told by a length, and that turn in rad a mm.
    pub by_length: Option<(usize, f64)>,
}

impl FreeCoordinates {
    pub fn new(
        (assembly, bodies): (&Assembly, &ReducedBodies),
        (train, operation): (&Train, &Operation),
        drive: &Drive,
        guide: &Guide<'_>,
    ) -> Self {
        let n = bodies.size();
        let held = |shaft: usize| operation.held.contains(&shaft);
        let input_shaft = assembly.structure().discs[operation.input].shaft;
        let input_turn = bodies.of_node(assembly.disc(operation.input).unwrap_or(0)) + 5;
        let along = |of: &dyn Fn(usize) -> f64| {
            DVector::from_fn(n, |i, _| if bodies.axis(i) == Some(5) { of(bodies.shaft(i)) } else { 0.0 })
        };
        let mut rigid = along(&|shaft| train.ratios_in_space()[shaft]);
        rigid += bodies.by_frame(assembly) * train.frame_ratio();
        for (i, own) in rigid.iter_mut().enumerate() {
            // A turn of the whole train deforms no gear.
            if let Some(by_turn) = bodies.by_turn(i) {
                *own = by_turn * train.ratios_in_space()[bodies.shaft(i)];
            }
        }
        let mut input = DVector::zeros(n);
        input[input_turn] = 1.0;
        let (mut columns, mut turns): (Vec<DVector<f64>>, Vec<bool>) = Default::default();
        for shaft in (0..train.ratios().len()).filter(|s| held(*s) && *s != input_shaft) {
            columns.push(along(&|s| f64::from(u8::from(s == shaft))));
            turns.push(true);
        }
        let is_of_gear = |i: usize| bodies.by_turn(i).is_some();
        let mut first_of_gears = columns.len();
        let is_guided = |i: usize| bodies.axis(i).is_some_and(|axis| axis < 5 && !(guide.moves)(bodies.shaft(i), axis));
        let is_free = |i: &usize| (is_of_gear(*i) || !held(bodies.shaft(*i))) && !is_guided(*i);
        for i in (0..n).filter(|i| is_free(i) && *i != input_turn) {
            if !is_of_gear(i) {
                first_of_gears = columns.len() + 1;
            }
            let by_length = guide.by_length.filter(|own| bodies.axis(i) == Some(5) && own.0 == bodies.shaft(i));
            let mut column = DVector::zeros(n);
            column[i] = by_length.map_or(1.0, |own| own.1);
            columns.push(column);
            turns.push(by_length.is_none() && bodies.axis(i).is_some_and(|axis| axis > 2));
        }
        let turn = matches!(drive, Drive::Torque { .. }).then_some(columns.len());
        if turn.is_some() {
            columns.push(rigid.clone());
            turns.push(true);
        }
        // All coordinates that a column moves turn by one ratio.
        let ratio = |j: usize| {
            let moved = columns[j].iter().zip(rigid.iter()).find(|(x, _)| **x != 0.0);
            moved.map_or(0.0, |(x, r)| if Some(j) == turn { 0.0 } else { r / x })
        };
        let turning = DVector::from_fn(columns.len(), |j, _| ratio(j));
        if matches!(drive, Drive::Balanced(_)) {
            let heavy = &bodies.mass * &rigid;
            let inertia = heavy.dot(&rigid);
            for column in &mut columns {
                let along = heavy.dot(column);
                if along != 0.0 {
                    column.axpy(-along / inertia, &rigid, 1.0);
                }
            }
        }
        let basis = DMatrix::from_fn(n, columns.len(), |i, j| columns[j][i]);
        Self { basis, rigid, input, turning, turn, turns, first_of_gears }
    }

    /// Number of coordinates z.
    pub fn count(&self) -> usize {
        self.basis.ncols()
    }

    /// B with zeros for the rotation of the whole train.
    pub fn of_deviations(&self) -> DMatrix<f64> {
        let mut own = self.basis.clone();
        if let Some(i) = self.turn {
            own.column_mut(i).fill(0.0);
        }
        own
    }

    /// The y of the deviations alone.
    pub fn deviations(&self, z: &DVector<f64>) -> DVector<f64> {
        let mut own = z.clone();
        if let Some(i) = self.turn {
            own[i] = 0.0;
        }
        &self.basis * own
    }

    /// B' A B; entries that the rotation of the whole train does not affect are exactly zero.
    pub fn of(&self, matrix: &DMatrix<f64>, turns: bool) -> DMatrix<f64> {
        let mut all = self.basis.transpose() * matrix * &self.basis;
        if let (Some(i), false) = (self.turn, turns) {
            all.row_mut(i).fill(0.0);
            all.column_mut(i).fill(0.0);
        }
        all
    }
}
