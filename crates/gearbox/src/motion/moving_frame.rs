//! Motion in the frame of a carrier that turns in space. Theory (93c).

use integrate::Forces;
use nalgebra::{DMatrix, DVector};

use super::{ReducedBodies, free_coordinates::FreeCoordinates, loops};
use crate::{Assembly, GearboxError, turning_frame::TurningFrame};

/// Forces of inertia beside the gyroscopic ones, at unit speed of the input.
///
/// ```text
/// psi'^2 (b - S z) - psi' Q z,   S = c^2 (M J^2 + K_p) + c G J,   Q = c C_s J,   b = c^2 M e
/// ```
/// c: turns of the frame a turn of the input; e: places of the axes from that of the frame; the others as in (86b).
#[derive(Debug, Clone)]
pub(super) struct MovingFrame {
    /// S of the bodies.
    on_bodies: DMatrix<f64>,
    /// S, symmetric.
    stiffness: DMatrix<f64>,
    /// Q; none without dampers in space.
    dragged: Option<DMatrix<f64>>,
    /// b: centrifugal forces on the axes of planets.
    centrifugal: DVector<f64>,
    /// c M J: what velocities have of the momentum of displacements.
    swept: DMatrix<f64>,
}

impl MovingFrame {
    /// Of bodies in a frame with c = `ratio`, `None` where it does not turn; adds the Coriolis forces to the gyroscopic matrix
    /// of all nodes at unit speed.
    pub fn of(
        (assembly, bodies, free): (&Assembly, &ReducedBodies, &FreeCoordinates),
        ratio: f64,
        gyroscopic: &mut DMatrix<f64>,
    ) -> Result<Option<Self>, GearboxError> {
        let mass = assembly.mass();
        let Some(own) = TurningFrame::of(assembly, &mass)? else { return Ok(None) };
        let on_bodies = bodies.of_nodes(&(ratio * ratio * &own.pull + ratio * own.tilted(gyroscopic)));
        *gyroscopic += ratio * &own.coriolis;
        let stiffness = free.of(&on_bodies, false);
        let dragged = own.dragged.as_ref().map(|own| free.of(&(ratio * bodies.of_nodes(own)), false));
        let mut centrifugal =
            free.basis.tr_mul(&bodies.of_forces(&(&mass * assembly.places_of_axes()))) * (ratio * ratio);
        // They do not turn the train.
        if let Some(i) = free.turn {
            centrifugal[i] = 0.0;
        }
        let swept = free.of(&(0.5 * ratio * bodies.skew(&own.coriolis)), false);
        Ok(Some(Self { on_bodies, stiffness, dragged, centrifugal, swept }))
    }

    /// At a speed of the input: forces without displacements, and the stiffness that displacements meet.
    pub fn at(&self, speed: f64) -> (DVector<f64>, DMatrix<f64>) {
        let mut stiffness = speed * speed * &self.stiffness;
        if let Some(dragged) = &self.dragged {
            stiffness += speed * dragged;
        }
        (speed * speed * &self.centrifugal, stiffness)
    }

    /// Moment on a coordinate of the bodies that is a turn, N mm.
    pub fn on_turn(&self, coordinate: usize, y: &DVector<f64>, speed: f64) -> f64 {
        -speed * speed * self.on_bodies.row(coordinate).transpose().dot(y)
    }

    /// Adds its forces with the input at a speed; `turn`: the number of that coordinate, which gives what they take.
    pub fn add(&self, [q, v]: [&DVector<f64>; 2], speed: f64, turn: Option<usize>, out: &mut Forces) {
        let mut at_unit = self.centrifugal.clone();
        at_unit.gemv(-1.0, &self.stiffness, q, 1.0);
        // Over the speed of the input.
        let mut along = speed * &at_unit;
        if let Some(dragged) = &self.dragged {
            along.gemv(-1.0, dragged, q, 1.0);
        }
        let taken = loops::along(&along, v);
        out.other.axpy(speed, &along, 1.0);
        out.supplied += speed * taken;
        if let Some(i) = turn {
            out.other[i] -= taken;
            out.supplied -= taken * v[i];
        }
        if !out.tangents {
            return;
        }
        let (_, stiffness) = self.at(speed);
        out.stiffness += &stiffness;
        if let Some(i) = turn {
            // d/d(speed) of the forces, and of what they take.
            let by_speed = &along + speed * &at_unit;
            let mut column = out.damping.column_mut(i);
            column -= by_speed;
            let mut row = out.damping.row_mut(i);
            row += along.transpose();
            out.damping[(i, i)] += loops::along(&at_unit, v);
            let mut slope = speed * self.stiffness.tr_mul(v);
            if let Some(dragged) = &self.dragged {
                slope += dragged.tr_mul(v);
            }
            let mut row = out.stiffness.row_mut(i);
            row -= slope.transpose();
        }
    }

    /// Kinetic energy that displacements and velocities share with the turn of the frame, over that speed: its square and
    /// itself, N mm.
    ///
    /// ```text
    /// T = v . M v/2 + psi' (m . v + v . c M J z) + psi'^2 (r' M r/2 + b . z - z . S z/2)
    /// ```
    pub fn kinetic(&self, [q, v]: [&DVector<f64>; 2], speed: f64) -> f64 {
        let squared = self.centrifugal.dot(q) - 0.5 * q.dot(&(&self.stiffness * q));
        speed * v.dot(&(&self.swept * q)) + speed * speed * squared
    }
}
