//! A row of rollers, divided into laminae. Theory (99).

use std::f64::consts::{PI, TAU};

use nalgebra::{Vector3, Vector5};

use super::{RollerGeometry, RollerProfile, RollingBearingError, RollingReply, Row, STEEL, ball::moves};

/// Laminae of a roller; ISO/TS 16281 asks for 30 at the least.
pub(super) const LAMINAE: usize = 41;
/// c of a contact of L mm with both rings, q = c L^(8/9) delta^(10/9): N/mm^2. ISO/TS 16281.
const LINE: f64 = 35_948.0;

/// Rollers between two rigid rings: laminae that press one by one, tilted as the rings are.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RollerRow {
    geometry: RollerGeometry,
    row: Row,
    /// What rings have to approach by at every lamina until it presses, mm.
    gaps: Vec<f64>,
    /// Stiffness of one lamina, N/mm^(10/9).
    stiffness: f64,
}

impl RollerRow {
    /// `clearance` is the total radial play, `axial` the axial distance until contact, mm.
    ///
    /// ```text
    /// P(x) = 0.00035 D ln(1/(1 - (2 x/L)^2))                                       L <= 2.5 D
    /// P(x) = 0.0005 D ln(1/(1 - ((2 |x| - L + 2.5 D)/(2.5 D))^2)), 0 within         longer ones
    /// ```
    /// Source: ISO/TS 16281, 6.2.
    pub fn new(geometry: RollerGeometry, row: Row, clearance: f64, axial: f64) -> Result<Self, RollingBearingError> {
        geometry.check()?;
        let (sin, cos) = geometry.contact_angle.sin_cos();
        let own = 0.5 * clearance * cos + axial * sin;
        let gaps = (0..LAMINAE).map(|k| own + 2.0 * relief(&geometry, place(&geometry, k))).collect();
        let stiffness = LINE * geometry.length.powf(8.0 / 9.0) / LAMINAE as f64;
        Ok(Self { geometry, row, gaps, stiffness })
    }

    /// Adds its energy, force and stiffness at displacements of the inner ring.
    ///
    /// ```text
    /// delta_k = n . (u + theta x r_k) - gap - 2 P(x_k),   q = c delta^(10/9),   V = (9/19) c delta^(19/9)
    /// ```
    pub fn add(&self, d: &Vector5<f64>, reply: &mut RollingReply) {
        for j in 0..self.geometry.elements {
            let (mut force, mut largest) = (0.0, 0.0f64);
            for k in 0..LAMINAE {
                let (lever, approach) = self.approach(j, k, d);
                if approach > 0.0 {
                    let root = self.stiffness * approach.powf(1.0 / 9.0);
                    let own = root * approach;
                    reply.energy += 9.0 / 19.0 * own * approach;
                    reply.force -= own * lever;
                    reply.stiffness += 10.0 / 9.0 * root * lever * lever.transpose();
                    force += own;
                    largest = largest.max(own);
                }
            }
            if force > 0.0 {
                reply.count(force, self.pressure_under(largest));
            }
        }
    }

    /// Forces of lamina k of all rollers at displacements of the inner ring, N; k is below [`LAMINAE`].
    pub fn forces(&self, k: usize, d: &Vector5<f64>) -> impl Iterator<Item = f64> {
        let of = move |j| self.stiffness * self.approach(j, k, d).1.max(0.0).powf(10.0 / 9.0);
        (0..self.geometry.elements).map(of)
    }

    /// Forces of all rollers at displacements of the inner ring, N: sums over their laminae.
    pub fn element_forces(&self, d: &Vector5<f64>) -> impl Iterator<Item = f64> {
        let of = move |j| {
            let lamina = |k| self.stiffness * self.approach(j, k, d).1.max(0.0).powf(10.0 / 9.0);
            (0..LAMINAE).map(lamina).sum()
        };
        (0..self.geometry.elements).map(of)
    }

    /// Approach of the rings at lamina k of roller j, mm, and what the coordinates of the inner ring press it by.
    fn approach(&self, j: usize, k: usize, d: &Vector5<f64>) -> (Vector5<f64>, f64) {
        let lever = self.lever(j, k);
        (lever, lever.dot(d) - self.gaps[k])
    }

    /// Height of its middle over that of the bearing, mm.
    pub fn position(&self) -> f64 {
        self.row.position
    }

    /// c of one lamina, N/mm^(10/9).
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Laminae of cylindrical rollers, roller by roller: number of the roller, height over the middle of the bearing, and gap,
    /// mm.
    pub fn laminae(&self) -> impl Iterator<Item = (usize, f64, f64)> {
        let height = |k: usize| self.row.position + place(&self.geometry, k);
        (0..self.geometry.elements).flat_map(move |j| (0..LAMINAE).map(move |k| (j, height(k), self.gaps[k])))
    }

    /// Pressure where a lamina presses by a force (N), MPa.
    pub fn pressure_under(&self, force: f64) -> f64 {
        self.pressure(force * LAMINAE as f64 / self.geometry.length)
    }

    /// Stiffness with every roller evenly loaded by a force, N.
    pub fn pressed(&self, force: f64, reply: &mut RollingReply) {
        let each = 10.0 / 9.0 * self.stiffness.powf(0.9) * (force / LAMINAE as f64).powf(0.1);
        for (j, k) in (0..self.geometry.elements).flat_map(|j| (0..LAMINAE).map(move |k| (j, k))) {
            let lever = self.lever(j, k);
            reply.stiffness += each * lever * lever.transpose();
        }
    }

    /// What the coordinates of the inner ring press lamina k of roller j by: n and r x n.
    fn lever(&self, j: usize, k: usize) -> Vector5<f64> {
        let g = &self.geometry;
        let (y, x) = (TAU * j as f64 / g.elements as f64).sin_cos();
        let (sin, cos) = g.contact_angle.sin_cos();
        let (along, thrust) = (place(g, k), self.row.thrust);
        let radius = 0.5 * g.pitch_diameter - thrust * along * sin;
        let r = Vector3::new(radius * x, radius * y, self.row.position + along * cos);
        moves(&r).tr_mul(&Vector3::new(cos * x, cos * y, thrust * sin))
    }

    /// Pressure under a line load (N/mm) at the inner ring, whose curvature is the larger one, MPa.
    ///
    /// ```text
    /// p = sqrt(w E' S/(2 pi)),   S = 2/(D (1 - gamma)),   E' = E_steel/(1 - nu^2)
    /// ```
    fn pressure(&self, load: f64) -> f64 {
        let [young, nu] = STEEL;
        let sum = 2.0 / (self.geometry.diameter * (1.0 - self.geometry.gamma()));
        (load * young / (1.0 - nu * nu) * sum / (2.0 * PI)).sqrt()
    }
}

/// Middle of lamina k along the roller, mm from its middle.
fn place(g: &RollerGeometry, k: usize) -> f64 {
    g.length * ((k as f64 + 0.5) / LAMINAE as f64 - 0.5)
}

/// Relief of a roller, mm.
fn relief(g: &RollerGeometry, x: f64) -> f64 {
    let drop = |size: f64, share: f64| -size * g.diameter * (1.0 - share * share).ln();
    let ends = 2.5 * g.diameter;
    match g.profile {
        RollerProfile::Straight => 0.0,
        RollerProfile::Logarithmic if g.length <= ends => drop(0.000_35, 2.0 * x / g.length),
        RollerProfile::Logarithmic => drop(0.000_5, ((2.0 * x.abs() - g.length + ends) / ends).max(0.0)),
    }
}
