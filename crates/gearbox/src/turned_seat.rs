//! Bearings whose seats turn about the axis of a carrier: displacements counted in the axes of the seat. Theory (79d).

use nalgebra::{DMatrix, DVector, Matrix2, Matrix6, SMatrix, Vector2, Vector3, Vector6};

use crate::{Assembly, Bearing, Structure, Vector12, mesh_element::spread, seats::Seats};

/// Relative difference of a stiffness and the same one turned about z that is round-off.
const ALL_ROUND: f64 = 1e-12;

impl Structure {
    /// Whether a bearing presses otherwise when the shaft of its seat turns: that shaft stands, as a carrier seen from
    /// itself, and the seat is beside its axis, stands off, or is not the same all round.
    pub(crate) fn seat_turns(&self, bearing: &Bearing) -> bool {
        let Some([x, y, _]) = self.seat(bearing).filter(|_| bearing.outer.is_some_and(|outer| self.stands(outer)))
        else {
            return false;
        };
        let off = |v: &Vector3<f64>| v.x != 0.0 || v.y != 0.0;
        off(&Vector3::new(x, y, 0.0)) || off(&bearing.offset) || bearing.law.is_some() || !all_round(&bearing.stiffness)
    }
}

/// Whether a stiffness is the same in all directions across z.
fn all_round(stiffness: &Matrix6<f64>) -> bool {
    let mut turn = Matrix6::identity();
    let (sin, cos) = 1f64.sin_cos();
    for at in [0, 3] {
        turn.fixed_view_mut::<2, 2>(at, at).copy_from(&Matrix2::new(cos, -sin, sin, cos));
    }
    let apart = turn.tr_mul(stiffness) * turn - stiffness;
    let size = [(0, 1), (0, 1), (2, 2), (3, 4), (3, 4), (5, 5)].map(|(i, j)| stiffness[(i, i)].max(stiffness[(j, j)]));
    (0..6).all(|i| (0..6).all(|j| apart[(i, j)].abs() <= ALL_ROUND * (size[i] * size[j]).sqrt()))
}

/// Both ends of a bearing, seen from the axes of its seat.
pub(crate) struct TurnedSeat {
    /// First coordinates of the shaft's node and of the seat's, among those of the seats.
    at: [usize; 2],
    /// What each adds to the displacement of the bearing while nothing has turned.
    ends: [Matrix6<f64>; 2],
    /// Place of the shaft's node across the axis of the seat's, mm.
    arm: Vector2<f64>,
}

/// The ends at some displacements.
pub(crate) struct Seen {
    /// Displacements in the seat's axes.
    own: Vector12,
    /// Their slopes over those in common axes.
    slopes: SMatrix<f64, 12, 12>,
    sin_cos: (f64, f64),
}

impl TurnedSeat {
    /// Of a bearing, where its seat turns.
    pub fn of(assembly: &Assembly, seats: &Seats, bearing: usize) -> Option<Self> {
        let own = &assembly.structure().bearings[bearing];
        let [x, y, _] = assembly.structure().seat(own).filter(|_| assembly.structure().seat_turns(own))?;
        let ends: Vec<(usize, Matrix6<f64>)> = assembly
            .bearing_ends(bearing)
            .map(|(node, own)| Some((seats.of_node(node)?, *own)))
            .collect::<Option<_>>()?;
        let [(a, inner), (b, outer)] = <[_; 2]>::try_from(ends).ok()?;
        Some(Self { at: [a, b], ends: [inner, outer], arm: Vector2::new(x, y) })
    }

    /// First coordinates of the shaft's node and of the seat's, among those of the seats.
    pub fn at(&self) -> [usize; 2] {
        self.at
    }

    /// At displacements of all seats. A turn of the seat turns the shaft with it, about the axis of the seat's shaft:
    ///
    /// ```text
    /// u_i' = R (r + u_i) - r,   u_o' = R u_o,   tilt' = R tilt,   turn_i' = turn_i - turn_o,   turn_o' = 0,   R = R_z(-turn_o)
    /// ```
    /// Theory (79d).
    pub fn seen(&self, y: &DVector<f64>) -> Seen {
        let all = Vector12::from_fn(|k, _| y[self.place(k)]);
        let (sin, cos) = all[11].sin_cos();
        let back = Matrix2::new(cos, sin, -sin, cos);
        let (mut own, mut slopes) = (all, SMatrix::<f64, 12, 12>::identity());
        for at in [0, 3, 6, 9] {
            let arm = if at == 0 { self.arm } else { Vector2::zeros() };
            let turned = back * (arm + all.fixed_rows::<2>(at));
            own.fixed_rows_mut::<2>(at).copy_from(&(turned - arm));
            slopes.fixed_view_mut::<2, 2>(at, at).copy_from(&back);
            (slopes[(at, 11)], slopes[(at + 1, 11)]) = (turned.y, -turned.x);
        }
        (own[5], own[11]) = (all[5] - all[11], 0.0);
        (slopes[(5, 11)], slopes[(11, 11)]) = (-1.0, 0.0);
        Seen { own, slopes, sin_cos: (sin, cos) }
    }

    /// Displacement of the bearing, offset of its seat beside.
    pub fn moved(&self, seen: &Seen) -> Vector6<f64> {
        self.of_ends() * seen.own
    }

    /// The displacement by a small step of all seats.
    pub fn step(&self, seen: &Seen, step: &DVector<f64>) -> Vector6<f64> {
        self.of_ends() * seen.slopes * Vector12::from_fn(|k, _| step[self.place(k)])
    }

    /// Adds the slopes of the displacement over those of all seats.
    pub fn add_slopes(&self, seen: &Seen, slopes: &mut DMatrix<f64>) {
        let own = self.of_ends() * seen.slopes;
        (0..12).for_each(|k| (0..6).for_each(|i| slopes[(i, self.place(k))] += own[(i, k)]));
    }

    /// Force and moment on both ends in common axes, of those (N, N mm) on the shaft in the seat's axes.
    pub fn forces(&self, seen: &Seen, force: &Vector6<f64>) -> Vector12 {
        seen.slopes.tr_mul(&self.of_ends().tr_mul(force))
    }

    /// The displacement of the bearing by those of both ends.
    fn of_ends(&self) -> SMatrix<f64, 6, 12> {
        SMatrix::from_fn(|i, j| self.ends[j / 6][(i, j % 6)])
    }

    /// Adds forces and their slopes: those of a force on the shaft and of its stiffness, both in the seat's axes, and
    /// what the axes themselves turn.
    pub fn add(
        &self,
        seen: &Seen,
        (force, stiffness): (&Vector6<f64>, &Matrix6<f64>),
        forces: &mut DVector<f64>,
        slopes: &mut DMatrix<f64>,
    ) {
        let of_ends = self.of_ends() * seen.slopes;
        let mut own = -(of_ends.tr_mul(stiffness) * of_ends);
        let at_ends = self.of_ends().tr_mul(force);
        let (sin, cos) = seen.sin_cos;
        for at in [0, 3, 6, 9] {
            let (fx, fy) = (at_ends[at], at_ends[at + 1]);
            // d2/d(turn) d(u) and d2/d(turn)2 of the turned vectors.
            let across = [fy * cos + fx * sin, fy * sin - fx * cos].map(|x| -x);
            for (k, value) in across.into_iter().enumerate() {
                own[(at + k, 11)] += value;
                own[(11, at + k)] += value;
            }
            let arm = if at == 0 { self.arm } else { Vector2::zeros() };
            let turned = arm + seen.own.fixed_rows::<2>(at);
            own[(11, 11)] -= fx * turned.x + fy * turned.y;
        }
        let all = self.forces(seen, force);
        for i in 0..12 {
            forces[self.place(i)] += all[i];
            (0..12).for_each(|j| slopes[(self.place(i), self.place(j))] += own[(i, j)]);
        }
    }

    fn place(&self, k: usize) -> usize {
        self.at[k / 6] + k % 6
    }
}

/// Springs of a bearing whose seat turns: what they do beside the springs of a seat that does not, which are among the
/// stiffness of the seats.
pub(crate) struct TurnedSprings {
    /// Number of the bearing.
    pub bearing: usize,
    seat: TurnedSeat,
    stiffness: Matrix6<f64>,
    preload: Vector6<f64>,
    offset: Vector6<f64>,
}

impl TurnedSprings {
    /// All of them.
    pub fn all(assembly: &Assembly, seats: &Seats) -> Vec<Self> {
        let one = |(bearing, own): (usize, &Bearing)| {
            let springs = own.stiffness.amax() > 0.0 || own.preload.amax() > 0.0;
            let seat = TurnedSeat::of(assembly, seats, bearing).filter(|_| springs)?;
            let stiffness = 0.5 * (own.stiffness + own.stiffness.transpose());
            Some(Self { bearing, seat, stiffness, preload: own.preload, offset: own.offset6() })
        };
        assembly.structure().bearings.iter().enumerate().filter_map(one).collect()
    }

    /// Displacement of the shaft against its seat's nominal place in the axes of that, and force and moment on the shaft and
    /// on the seat's node, common axes.
    pub fn at(&self, y: &DVector<f64>) -> (Vector6<f64>, Vector12) {
        let seen = self.seat.seen(y);
        let moved = self.seat.moved(&seen);
        (moved, self.seat.forces(&seen, &self.force(&moved)))
    }

    /// Forces that the turn of the seat changes, of all seats.
    pub fn beside_still(&self, y: &DVector<f64>) -> DVector<f64> {
        let own = self.at(y).1 - self.still(y);
        spread(y.len(), self.seat.at, &own)
    }

    /// Adds these and their slopes.
    pub fn add(&self, y: &DVector<f64>, forces: &mut DVector<f64>, slopes: &mut DMatrix<f64>) {
        let seen = self.seat.seen(y);
        let force = self.force(&self.seat.moved(&seen));
        self.seat.add(&seen, (&force, &self.stiffness), forces, slopes);
        let still = self.still(y);
        let of_ends = self.seat.of_ends();
        let stiffness = of_ends.tr_mul(&self.stiffness) * of_ends;
        for i in 0..12 {
            forces[self.seat.place(i)] -= still[i];
            (0..12).for_each(|j| slopes[(self.seat.place(i), self.seat.place(j))] += stiffness[(i, j)]);
        }
    }

    fn force(&self, moved: &Vector6<f64>) -> Vector6<f64> {
        self.preload - self.stiffness * (moved - self.offset)
    }

    /// Forces on both ends as if nothing had turned.
    fn still(&self, y: &DVector<f64>) -> Vector12 {
        let all = Vector12::from_fn(|k, _| y[self.seat.place(k)]);
        self.seat.of_ends().tr_mul(&self.force(&(self.seat.of_ends() * all)))
    }
}
