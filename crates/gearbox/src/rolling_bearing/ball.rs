//! A row of balls. Theory (98).

use std::f64::consts::TAU;

use nalgebra::{Matrix2, Matrix2x3, Matrix2x5, Matrix3x5, Vector2, Vector3, Vector5};

use super::{BallGeometry, PointContact, RollingBearingError, RollingReply, Row};

/// Balls between two rigid rings: each presses along the line through the centres of curvature of both grooves, and its
/// contact angle follows.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BallRow {
    geometry: BallGeometry,
    row: Row,
    contacts: [PointContact; 2],
    /// Stiffness of both contacts in series, N/mm^1.5.
    stiffness: f64,
    /// Radial clearance taken off the distance of the grooves' centres, and what is missing along the axis, mm.
    gap: [f64; 2],
}

/// Where the grooves of a row are before anything moves: distance of their centres, and the inner one's radius, height, and place beside the outer one, mm.
struct Grooves {
    rest: f64,
    radius: f64,
    height: f64,
    start: Vector2<f64>,
}

/// A ball at some displacements of the inner ring.
struct Ball {
    /// What these displace in its radial plane.
    moves: Matrix2x5<f64>,
    /// v+, mm.
    v: Vector2<f64>,
    /// 1 for the parts of v that count.
    sides: Vector2<f64>,
    /// delta, mm.
    approach: f64,
    /// Q, N.
    force: f64,
}

impl BallRow {
    /// `clearance` is the total radial play, `axial` the axial distance until contact, mm.
    pub fn new(geometry: BallGeometry, row: Row, clearance: f64, axial: f64) -> Result<Self, RollingBearingError> {
        geometry.check()?;
        let most = 2.0 * geometry.groove_distance();
        if clearance.is_nan() || clearance >= most {
            let (clearance_um, most_um) = (1e3 * clearance, 1e3 * most);
            return Err(RollingBearingError::Clearance { clearance_um, most_um });
        }
        let wrong = RollingBearingError::OutOfRange {
            quantity: "groove radius over ball diameter",
            value: geometry.conformity[0],
            wanted: "one that touches at a point",
        };
        let contacts = geometry.contacts().ok_or(wrong)?;
        let stiffness = contacts.iter().map(|c| c.stiffness.powf(-2.0 / 3.0)).sum::<f64>().powf(-1.5);
        Ok(Self { geometry, row, contacts, stiffness, gap: [0.5 * clearance, axial] })
    }

    /// Adds its energy, force and stiffness at displacements of the inner ring.
    ///
    /// ```text
    /// v = A n_0 - gaps + N (u + theta x r),   delta = |v+| - A,   n = v+/|v+|
    /// Q = c delta^(3/2),   V = (2/5) c delta^(5/2)
    /// d2V/dv2 = (3/2) c delta^(1/2) n n' + Q/|v+| (1 - n n')
    /// ```
    /// r is the centre of curvature of the inner groove. N projects onto the radial plane of the ball (radial and
    /// axial), because the ball rolls freely along the groove. v+ is v without negative components: the inner ring has
    /// left the ball, or the ball is behind the bottom of an angular contact groove, which has no shoulder there. |v+|
    /// is convex in (u, theta), and so is V.
    pub fn add(&self, d: &Vector5<f64>, reply: &mut RollingReply) {
        let grooves = self.grooves();
        for j in 0..self.geometry.elements {
            let Ball { moves, v, sides, approach, force } = self.ball(&grooves, j, d);
            // Also nothing where the place is no number: the solver then says that there is no equilibrium.
            if approach > 0.0 {
                let length = v.norm();
                let n = v / length;
                let along = n * n.transpose();
                let tangent = 1.5 * self.stiffness * approach.sqrt() * along
                    + force / length * (Matrix2::from_diagonal(&sides) - along);
                reply.energy += 0.4 * force * approach;
                reply.force -= moves.tr_mul(&(force * n));
                reply.stiffness += moves.transpose() * tangent * moves;
                let pressure = self.contacts.iter().map(|c| c.pressure(force)).fold(0.0, f64::max);
                reply.count(force, pressure);
            }
        }
    }

    /// Forces of all balls at displacements of the inner ring, N.
    pub fn forces(&self, d: &Vector5<f64>) -> impl Iterator<Item = f64> {
        let grooves = self.grooves();
        (0..self.geometry.elements).map(move |j| self.ball(&grooves, j, d).force)
    }

    fn grooves(&self) -> Grooves {
        let (rest, g) = (self.geometry.groove_distance(), &self.geometry);
        let (sin, cos) = g.contact_angle.sin_cos();
        let behind = (g.conformity[0] - 0.5) * g.diameter;
        Grooves {
            rest,
            radius: 0.5 * g.pitch_diameter + behind * cos,
            height: self.row.position + self.row.thrust * behind * sin,
            start: Vector2::new(rest * cos - self.gap[0], rest * sin - self.gap[1]),
        }
    }

    /// Ball j at displacements of the inner ring.
    fn ball(&self, grooves: &Grooves, j: usize, d: &Vector5<f64>) -> Ball {
        let (g, Grooves { rest, radius, height, start }) = (&self.geometry, grooves);
        // Deep grooves have two sides, angular contact grooves one.
        let is_deep = g.contact_angle == 0.0;
        let (y, x) = (TAU * j as f64 / g.elements as f64).sin_cos();
        let lever = moves(&Vector3::new(radius * x, radius * y, *height));
        let plane = Matrix2x3::new(x, y, 0.0, 0.0, 0.0, self.row.thrust);
        let moves = plane * lever;
        let v = start + moves * d;
        let sides = Vector2::new(v.x > 0.0, is_deep || v.y > 0.0).map(|is| f64::from(u8::from(is)));
        let v = v.component_mul(&sides);
        let approach = v.norm() - rest;
        let force = if approach > 0.0 { self.stiffness * approach * approach.sqrt() } else { 0.0 };
        Ball { moves, v, sides, approach, force }
    }

    /// Stiffness with every ball loaded by a force (N), at a contact angle of at least `least` in either direction.
    pub fn pressed(&self, force: f64, least: f64, reply: &mut RollingReply) {
        let g = &self.geometry;
        let each = 1.5 * self.stiffness.powf(2.0 / 3.0) * force.cbrt();
        let angles = if g.contact_angle > 0.0 { [g.contact_angle * self.row.thrust; 2] } else { [least, -least] };
        for j in 0..2 * g.elements {
            let (y, x) = (TAU * (j / 2) as f64 / g.elements as f64).sin_cos();
            let (sin, cos) = angles[j % 2].sin_cos();
            let radius = 0.5 * g.pitch_diameter;
            let lever = moves(&Vector3::new(radius * x, radius * y, self.row.position));
            let along = lever.tr_mul(&Vector3::new(cos * x, cos * y, sin));
            reply.stiffness += 0.5 * each * along * along.transpose();
        }
    }
}

/// Displacement of a place r of the ring by its five coordinates: u + theta x r.
pub(super) fn moves(r: &Vector3<f64>) -> Matrix3x5<f64> {
    Matrix3x5::new(1.0, 0.0, 0.0, 0.0, r.z, 0.0, 1.0, 0.0, -r.z, 0.0, 0.0, 0.0, 1.0, r.y, -r.x)
}
