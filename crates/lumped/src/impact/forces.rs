//! Forces of overlapping flanks on both gears.

use contact::Pose;
use dynamics::{COORDINATES, Displacement};
use nalgebra::{SMatrix, Vector3};

use super::{ImpactOptions, StickSlip, flanks::Slice};

pub(super) type Square = SMatrix<f64, 12, 12>;

/// Forces of the flanks of one side on both gears.
#[derive(Debug, Clone, PartialEq)]
pub struct FlankForce {
    /// Normal forces on the twelve coordinates of both gears, elastic part: N, N mm.
    pub elastic: Displacement,
    /// Normal forces on the twelve coordinates of both gears, damping part: N, N mm.
    pub damping: Displacement,
    /// Friction on the twelve coordinates of both gears: N, N mm.
    pub friction: Displacement,
    /// Sum of normal forces, N.
    pub normal_force: f64,
    /// Smallest normal force of a slice that overlaps, N; 0 without any.
    pub least_force: f64,
    /// Deepest overlap, mm; below zero where flanks are apart.
    pub overlap: f64,
    /// Length of the slices that overlap, mm.
    pub length: f64,
    /// Normal force of each pair that overlaps, by the running number of its pinion tooth.
    pub pairs: Vec<(i64, f64)>,
    /// Potential, mJ.
    pub potential: f64,
    /// dV/dt by the nominal motion.
    pub(super) parametric: f64,
    /// -dF/dd.
    pub(super) stiffness: Square,
    /// -dF/dd'.
    pub(super) rates: Square,
}

impl FlankForce {
    pub(super) fn none() -> Self {
        let zero = Displacement::zeros();
        Self {
            elastic: zero,
            damping: zero,
            friction: zero,
            normal_force: 0.0,
            least_force: 0.0,
            overlap: f64::NEG_INFINITY,
            length: 0.0,
            pairs: Vec::new(),
            potential: 0.0,
            parametric: 0.0,
            stiffness: Square::zeros(),
            rates: Square::zeros(),
        }
    }

    /// All forces of the flanks on both gears.
    pub fn wrench(&self) -> Displacement {
        self.elastic + self.damping + self.friction
    }

    /// Adds what one slice does that stands for `share` of the face width; `velocity`: of both gears, and the nominal
    /// part of it.
    pub(super) fn add(
        &mut self,
        slice: &Slice,
        poses: &[Pose; 2],
        options: &ImpactOptions,
        share: f64,
        [velocity, nominal]: [&Displacement; 2],
    ) {
        let place = &slice.place;
        self.overlap = self.overlap.max(-place.gap);
        if place.gap >= 0.0 {
            return;
        }
        let row = |direction: &Vector3<f64>| row(&place.position, poses, direction);
        let normal = row(&place.normal);
        let force = options.law.at(-place.gap, -normal.dot(velocity));
        let total = share * force.total();
        self.elastic += share * force.elastic * normal;
        self.damping += share * force.damping * normal;
        self.potential += share * force.potential;
        self.parametric -= share * force.elastic * normal.dot(nominal);
        self.least_force = if self.pairs.is_empty() { total } else { self.least_force.min(total) };
        self.normal_force += total;
        match self.pairs.last_mut() {
            Some((tooth, f)) if *tooth == slice.tooth => *f += total,
            _ => self.pairs.push((slice.tooth, total)),
        }
        // -dF/dd and -dF/dd' along the normal: F grows as the gap falls.
        let (by_gap, by_rate) = (share * force.by_overlap, share * force.by_rate);
        self.stiffness.ger(by_gap, &normal, &normal, 1.0);
        self.rates.ger(by_rate, &normal, &normal, 1.0);
        if let Some(friction) = &options.friction {
            self.add_friction(friction, slice, poses, velocity, [total, by_gap, by_rate]);
        }
    }

    /// Friction of a slice with a normal force, and its slopes by gap and rate.
    fn add_friction(
        &mut self,
        friction: &StickSlip,
        slice: &Slice,
        poses: &[Pose; 2],
        velocity: &Displacement,
        [total, by_gap, by_rate]: [f64; 3],
    ) {
        let place = &slice.place;
        let row = |direction: &Vector3<f64>| row(&place.position, poses, direction);
        let normal = row(&place.normal);
        // Sliding velocity of body 1 on body 2: what is left of the relative velocity without its normal part.
        let along: [Displacement; 3] = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| row(&axis));
        let relative = Vector3::from(along.map(|j| j.dot(velocity)));
        let sliding = relative - place.normal * place.normal.dot(&relative);
        let speed = sliding.norm();
        let [mu, slope] = friction.at(speed);
        // At rest mu/v has the limit dmu/dv.
        let over_speed = if speed > 0.0 { mu / speed } else { slope };
        let direction = if speed > 0.0 { sliding / speed } else { Vector3::zeros() };
        let pull = row(&direction);
        self.friction -= total * over_speed * row(&sliding);
        // Friction follows the normal force, and the sliding velocity within the tangent plane.
        self.stiffness.ger(-mu * by_gap, &pull, &normal, 1.0);
        self.rates.ger(-mu * by_rate, &pull, &normal, 1.0);
        let mut plane = Square::zeros();
        along.iter().for_each(|j| plane.ger(1.0, j, j, 1.0));
        plane.ger(-1.0, &normal, &normal, 1.0);
        plane.ger(-1.0, &pull, &pull, 1.0);
        self.rates += total * over_speed * plane;
        self.rates.ger(total * slope, &pull, &pull, 1.0);
    }
}

/// What a unit force at `position` does along the twelve coordinates: on body 1, and its reaction on body 2.
fn row(position: &Vector3<f64>, poses: &[Pose; 2], direction: &Vector3<f64>) -> Displacement {
    let mut j = Displacement::zeros();
    for (g, sign) in [1.0, -1.0].into_iter().enumerate() {
        let moment = (position - poses[g].translation.vector).cross(direction);
        for i in 0..3 {
            j[COORDINATES * g + i] = sign * direction[i];
            j[COORDINATES * g + 3 + i] = sign * moment[i];
        }
    }
    j
}
