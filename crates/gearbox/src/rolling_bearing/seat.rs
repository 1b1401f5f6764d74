//! Shaft thrust that the seat of a bearing takes. A floating ring adjusts its axial position freely.
//!
//! ```text
//! V*(d) = min over w of V(d - w e_z)      w free, or on one side of 0 alone
//! F_z = 0 where w is free,   T* = T - t t'/T_zz,   t = T e_z
//! ```

use nalgebra::{Matrix5, Vector5};

use super::RollingReply;

/// Direction of shaft thrust that the seat of the outer ring takes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum AxialSeat {
    /// Both directions: the ring is fixed axially.
    #[default]
    Held,
    /// None: the ring floats axially.
    Floating,
    /// Only towards +z (+1) or -z (-1): the ring has a shoulder on that side.
    Shoulder(f64),
}

/// Place along the axis.
const Z: usize = 2;
/// Doublings of the step that finds a place beyond the equilibrium of a floating ring, and steps to it.
const DOUBLINGS: usize = 64;
const STEPS: usize = 100;

impl AxialSeat {
    /// Reply of a bearing in this seat, from that of its rows alone, and the displacements of the inner ring against the outer one.
    pub(super) fn reply(
        self,
        displacements: &Vector5<f64>,
        rows: impl Fn(&Vector5<f64>) -> RollingReply,
    ) -> (Vector5<f64>, RollingReply) {
        let held = rows(displacements);
        let is_held = match self {
            Self::Held => true,
            Self::Floating => held.force[Z] == 0.0,
            // The force on the shaft is against its thrust.
            Self::Shoulder(way) => held.force[Z] * way <= 0.0,
        };
        if is_held {
            return (*displacements, held);
        }
        let place = |z: f64| {
            let mut place = *displacements;
            place[Z] = z;
            place
        };
        let (z, mut free) = floating(displacements[Z], held, |z| rows(&place(z)));
        free.force[Z] = 0.0;
        free.stiffness = without_thrust(&free.stiffness);
        (place(z), free)
    }

    /// A stiffness that a floating ring leaves.
    pub(super) fn of(self, stiffness: &Matrix5<f64>) -> Matrix5<f64> {
        if self == Self::Floating { without_thrust(stiffness) } else { *stiffness }
    }
}

/// The place where the thrust vanishes and the reply there, by Newton's steps between two places on either side of it.
fn floating(from: f64, held: RollingReply, at: impl Fn(f64) -> RollingReply) -> (f64, RollingReply) {
    let newton = |reply: &RollingReply| reply.force[Z] / reply.stiffness[(Z, Z)];
    // A force along z pushes the shaft, and with it the ring's own place, towards the equilibrium.
    let (mut near, mut step) = ((from, held), newton(&held));
    if !step.is_finite() {
        return near;
    }
    let mut far = None;
    for _ in 0..DOUBLINGS {
        let place = near.0 + step;
        let reply = at(place);
        if reply.force[Z] * held.force[Z] <= 0.0 {
            far = Some((place, reply));
            break;
        }
        near = (place, reply);
        step *= 2.0;
    }
    let Some(mut far) = far else { return near };
    let mut halve = false;
    for _ in 0..STEPS {
        let best = if near.1.force[Z].abs() <= far.1.force[Z].abs() { near } else { far };
        let step = newton(&best.1);
        let (tried, middle) = (best.0 + step, 0.5 * (near.0 + far.0));
        let is_between = (tried - near.0) * (tried - far.0) < 0.0;
        let place = if is_between && !halve { tried } else { middle };
        let is_fine = step.abs() <= 4.0 * f64::EPSILON * best.0.abs().max(from.abs());
        if is_fine || place == near.0 || place == far.0 {
            return best;
        }
        let width = (far.0 - near.0).abs();
        let reply = at(place);
        *(if reply.force[Z] * held.force[Z] > 0.0 { &mut near } else { &mut far }) = (place, reply);
        // Newton's steps may come from one side alone.
        halve = (far.0 - near.0).abs() > 0.5 * width;
    }
    if near.1.force[Z].abs() <= far.1.force[Z].abs() { near } else { far }
}

/// Schur's complement of the coordinate along the axis.
fn without_thrust(stiffness: &Matrix5<f64>) -> Matrix5<f64> {
    let own = stiffness[(Z, Z)];
    let coupled = stiffness.column(Z) * stiffness.row(Z);
    let mut left = if own > 0.0 { stiffness - coupled / own } else { *stiffness };
    left.row_mut(Z).fill(0.0);
    left.column_mut(Z).fill(0.0);
    0.5 * (left + left.transpose())
}
