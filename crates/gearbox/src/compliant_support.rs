//! Rolling bearings among the seats: their coordinates and their forces. Theory (84), (101).

use std::sync::Arc;

use nalgebra::{DMatrix, DVector, Matrix6, Vector6};

use crate::{
    Assembly, Structure, Supports, Vector12,
    rolling_bearing::{RollingBearing, RollingReply, RollingState},
    seats::Seats,
    turned_seat::TurnedSeat,
};

/// A rolling bearing between a seat of its shaft and an open seat of the housing, a seat of another shaft, or the ground.
pub(crate) struct CompliantBearing {
    /// Number of the bearing.
    pub bearing: usize,
    law: Arc<RollingBearing>,
    /// Disc of the gear whose bore is its outer race.
    pub bore_of: Option<usize>,
    /// First coordinates of what moves it among those of the seats, and what each adds to its displacement.
    ends: Vec<(usize, Matrix6<f64>)>,
    /// First coordinate of its open seat.
    housing: Option<usize>,
    /// Offset of its seat.
    offset: Vector6<f64>,
    /// Its seat, where that turns with a carrier.
    turned: Option<TurnedSeat>,
}

impl CompliantBearing {
    /// All rolling bearings, except those of shafts that do not move.
    pub fn all(assembly: &Assembly, seats: &Seats, held: &[bool]) -> Vec<Self> {
        let own = assembly.structure().bearings.iter().enumerate();
        let moving = own.filter(|(_, b)| !held[b.shaft]);
        let one = |(bearing, b): (usize, &crate::Bearing)| {
            let law = Arc::clone(b.law.as_ref()?);
            let housing = assembly.open_seat(bearing).and_then(|at| seats.of_open(assembly, at));
            let of_nodes = assembly.bearing_ends(bearing).map(|(node, own)| Some((seats.of_node(node)?, *own)));
            let ends = of_nodes.chain(housing.map(|at| Some((at, -Matrix6::identity())))).collect::<Option<_>>()?;
            let turned = TurnedSeat::of(assembly, seats, bearing);
            Some(Self { bearing, law, bore_of: b.bore_of, ends, housing, offset: b.offset6(), turned })
        };
        moving.filter_map(one).collect()
    }

    /// All rolling bearings, except those of shafts that do not move, in the coordinates of [`Supports`].
    pub fn at_supports(structure: &Structure, supports: &Supports, held: &[bool]) -> Vec<Self> {
        let own = structure.bearings.iter().enumerate().filter(|(_, b)| !held[b.shaft]);
        let one = |(bearing, b): (usize, &crate::Bearing)| {
            let law = Arc::clone(b.law.as_ref()?);
            let open = supports.open().iter().position(|i| *i == bearing);
            let housing = open.map(|at| 6 * (structure.bearings.len() + at));
            let own = [(6 * bearing, Matrix6::identity())].into_iter();
            let ends = own.chain(housing.map(|at| (at, -Matrix6::identity()))).collect();
            Some(Self { bearing, law, bore_of: b.bore_of, ends, housing, offset: b.offset6(), turned: None })
        };
        own.filter_map(one).collect()
    }

    /// Sets the displacements of its seat in the housing, if it has one; `seat` gives them in the order of the six
    /// axes.
    pub fn set_housing(&self, y: &mut DVector<f64>, seat: impl Fn(usize) -> f64) {
        if let Some(at) = self.housing {
            (0..6).for_each(|k| y[at + k] = seat(k));
        }
    }

    /// Displacement of the shaft relative to the bearing's seat, from the displacements of all seats.
    pub fn relative(&self, y: &DVector<f64>) -> Vector6<f64> {
        self.moved(y) - self.offset
    }

    /// The same against the seat's nominal place.
    fn moved(&self, y: &DVector<f64>) -> Vector6<f64> {
        self.ends.iter().map(|(at, own)| own * y.fixed_rows::<6>(*at)).sum()
    }

    /// The law of its rolling elements.
    pub fn law(&self) -> &RollingBearing {
        &self.law
    }

    /// Displacement of the shaft relative to the seat, in the axes of the seat where these turn.
    pub fn seen(&self, y: &DVector<f64>) -> Vector6<f64> {
        match &self.turned {
            Some(seat) => seat.moved(&seat.seen(y)) - self.offset,
            None => self.relative(y),
        }
    }

    /// Slopes of this over the displacements of all seats.
    pub fn slopes(&self, y: &DVector<f64>) -> DMatrix<f64> {
        let mut slopes = DMatrix::zeros(6, y.len());
        match &self.turned {
            Some(seat) => seat.add_slopes(&seat.seen(y), &mut slopes),
            None => self.ends.iter().for_each(|(at, own)| {
                let mut block = slopes.fixed_view_mut::<6, 6>(0, *at);
                block += own;
            }),
        }
        slopes
    }

    /// Reply of its rigid rings.
    pub fn reply(&self, y: &DVector<f64>) -> RollingReply {
        let moved = self.seen(y).fixed_rows::<5>(0).into_owned();
        match self.bore_of {
            None => self.law.evaluate(&moved),
            Some(_) => self.law.evaluate(&-moved).turned_inside_out(),
        }
    }

    /// Adds the forces of a reply and its -dV2/dy2 to those of the seats.
    pub fn add(&self, reply: &RollingReply, y: &DVector<f64>, forces: &mut DVector<f64>, slopes: &mut DMatrix<f64>) {
        if let Some(seat) = &self.turned {
            let seen = seat.seen(y);
            seat.add(&seen, (&reply.force6(), &reply.stiffness6()), forces, slopes);
            return;
        }
        for (at, own) in &self.ends {
            let mut rows = forces.fixed_rows_mut::<6>(*at);
            rows += own.transpose() * reply.force6();
        }
        self.add_stiffness(&(-reply.stiffness6()), slopes);
    }

    /// First coordinates of the shaft's node and of the seat's among those of the seats, and force and moment on both by a
    /// state, common axes, where the seat turns.
    pub fn at_ends(&self, state: &RollingState, y: &DVector<f64>) -> Option<([usize; 2], Vector12)> {
        self.turned.as_ref().map(|seat| (seat.at(), seat.forces(&seat.seen(y), &state.force)))
    }

    /// Adds a stiffness between its shaft and its seat.
    pub fn add_stiffness(&self, own: &Matrix6<f64>, all: &mut DMatrix<f64>) {
        for ((a, left), (b, right)) in self.ends.iter().flat_map(|x| self.ends.iter().map(move |y| (x, y))) {
            let mut block = all.fixed_view_mut::<6, 6>(*a, *b);
            block += left.transpose() * own * right;
        }
    }

    /// Results of the bearing after a last step of the seats from the displacements at which `reply` was computed, in the
    /// axes of its seat.
    pub fn state(&self, reply: &RollingReply, y: &DVector<f64>, step: &DVector<f64>) -> RollingState {
        if let Some(seat) = &self.turned {
            let seen = seat.seen(y);
            return RollingState::new(reply, seat.moved(&seen) - self.offset, &seat.step(&seen, step));
        }
        RollingState::new(reply, self.relative(y), &self.moved(step))
    }
}
