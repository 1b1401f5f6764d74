//! A pair that is set in motion again and again: condensed once, with its quasi-static answer beside it.

use std::{ops::ControlFlow, sync::Arc};

use dynamics::{Bearing, Drive, MeshDamping, MotionOptions, RigidBody, Speed, Torque, equivalent_mass};
use fem::Material;
use gearbox::motion::{
    CycleSteps, GearboxMechanism, MotionTimes, PairModel, PairMotion, SweepPlan, SweepPoint, instants, sweep,
};
use integrate::{Scheme, State};
use ltca::{StaticOptions, StaticPosition};
use mesh::MeshedGear;
use reduction::ElasticGear;

use crate::case::Case;

/// Everything is held but the driven gear's turn: the driver keeps its `speed` (rad/s), `torque` (N mm) is steady,
/// `ratio` damps the mesh.
pub fn at_speed(statics: StaticOptions, bodies: [RigidBody; 2], speed: f64, torque: f64, ratio: f64) -> MotionOptions {
    MotionOptions {
        statics,
        bodies,
        bearings: [Bearing::default(); 2],
        free: [[false; 6]; 2],
        drive: Drive::Speed(Speed::Constant(speed)),
        load: Torque::Constant(torque),
        damping: MeshDamping::Ratio(ratio),
        start_cycles: 0.0,
    }
}

/// Mass and inertia of gears of steel, from meshes of whole gears.
pub fn rigid_bodies(meshes: &[MeshedGear; 2]) -> [RigidBody; 2] {
    meshes.each_ref().map(|mesh| {
        let m = fem::mass_properties(mesh.mesh(), &Material::STEEL).unwrap();
        RigidBody::of_tensor(m.mass_t, m.inertia_about_tmm2([0.0; 3]))
    })
}

/// A pair at one load, driven by speed unless a test says otherwise.
pub struct MovingPair {
    /// The pair and its meshes.
    pub case: Case,
    /// Options of the contact.
    pub contact: StaticOptions,
    /// Both gears, reduced.
    pub gears: Arc<[ElasticGear; 2]>,
    /// Quasi-static transmission error at evenly spaced phases from 0 on, mm.
    pub ste: Vec<f64>,
    /// Tangent stiffness at the same phases, N/mm.
    pub stiffness: Vec<f64>,
    /// Means of tangent stiffness (N/mm) and of the length of contact lines (mm).
    pub means: [f64; 2],
    /// Mass and inertia of both gears.
    pub bodies: [RigidBody; 2],
}

impl MovingPair {
    /// Solved at `stations` phases of a mesh cycle.
    pub fn new(case: Case, contact: StaticOptions, stations: usize) -> Self {
        let mut model = case.reduced(contact.clone());
        let all = model.run(stations, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{e}")).positions;
        let mean = |f: fn(&StaticPosition) -> f64| all.iter().map(f).sum::<f64>() / stations as f64;
        let means = [mean(|p| p.tangent_stiffness), mean(|p| p.contact_line_length)];
        let bodies = rigid_bodies(&case.meshes);
        let ste = all.iter().map(|p| p.transmission_error).collect();
        let stiffness = all.iter().map(|p| p.tangent_stiffness).collect();
        Self { gears: model.into_gears(), case, contact, ste, stiffness, means, bodies }
    }

    /// Inertia of the driven gear on its base circle where the driver's angle is given, t.
    pub fn mass(&self) -> f64 {
        let base = [self.case.pair.pinion.base_radius(), self.case.pair.wheel.base_radius()];
        let inertia = [0, 1].map(|i| self.bodies[i].polar_inertia / (base[i] * base[i]));
        equivalent_mass(inertia, Some(1 - self.contact.driven()))
    }

    /// sqrt(k_m / m_e) / 2 pi, Hz: mesh cycles a second at which the mesh frequency meets the resonance.
    pub fn resonance_hz(&self) -> f64 {
        (self.means[0] / self.mass()).sqrt() / std::f64::consts::TAU
    }

    /// Speed of the driver, rad/s.
    pub fn speed(&self, cycles_per_second: f64) -> f64 {
        let gears = [&self.case.pair.pinion, &self.case.pair.wheel];
        cycles_per_second * gears[1 - self.contact.driven()].pitch_angle().abs()
    }

    /// The wheel's turn is free, the driver keeps its speed, damping ratio 0.1.
    pub fn system(&self, cycles_per_second: f64, change: impl FnOnce(&mut MotionOptions)) -> PairModel {
        let speed = self.speed(cycles_per_second);
        let mut options = at_speed(self.contact.clone(), self.bodies, speed, self.contact.torque, 0.1);
        change(&mut options);
        PairModel::new(self.case.pair.clone(), Arc::clone(&self.gears), None, options, self.means)
            .unwrap_or_else(|e| panic!("{e}"))
    }

    /// `rows` a mesh cycle, at least 12 steps in a period of the resonance.
    pub fn times(&self, pair: &PairModel, scheme: Scheme, rows: usize) -> MotionTimes {
        self.times_showing(pair, scheme, [rows, 12])
    }

    /// The same with so many steps in a period of the resonance.
    pub fn times_showing(&self, pair: &PairModel, scheme: Scheme, steps: [usize; 2]) -> MotionTimes {
        let [rows, per_period] = steps.map(|n| n as u64);
        MotionTimes {
            scheme,
            steps: CycleSteps::Showing { rows, per_period, hz: pair.mesh_resonance_hz() },
            tolerance: None,
            stop_at_events: false,
            scale: pair.scale(self.ste[0]),
        }
    }

    /// From quasi-static balance on.
    pub fn motion(&self, pair: PairModel, times: MotionTimes) -> PairMotion {
        let (machine, start) = started(&pair, 0.0);
        PairMotion::new(machine, times, start)
    }
}

/// The machine of a pair.
pub fn machine(pair: &PairModel) -> GearboxMechanism {
    pair.machine().unwrap_or_else(|e| panic!("{e}"))
}

/// The machine of a pair, and where it stands in quasi-static balance at a time, s.
pub fn started(pair: &PairModel, time: f64) -> (GearboxMechanism, State) {
    let mut machine = machine(pair);
    let start = machine.start_at(time, 0.0).unwrap_or_else(|e| panic!("{e}"));
    (machine, start)
}

/// DTE row by row over `cycles` mesh cycles, mm.
pub fn rows(motion: &mut PairMotion, cycles: u64) -> Vec<f64> {
    let mut all = Vec::new();
    for _ in 0..cycles {
        motion
            .run_cycle(Some(&mut instants(|now, _, _| all.push(now.mesh.transmission_error))))
            .unwrap_or_else(|e| panic!("{e}"));
    }
    all
}

/// A sweep with an answer at every speed.
pub fn swept(pair: &PairModel, plan: &SweepPlan) -> Vec<SweepPoint> {
    let outcomes = sweep(pair, plan, &|_| ControlFlow::Continue(())).unwrap_or_else(|e| panic!("{e}"));
    outcomes.into_iter().map(|o| o.unwrap_or_else(|miss| panic!("{} rad/s: {}", miss.speed, miss.error))).collect()
}

/// Largest difference of two courses.
pub fn worst(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Least and largest, taken from each other.
pub fn peak_to_peak(values: &[f64]) -> f64 {
    let (low, high) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &v| (v.min(l), v.max(h)));
    high - low
}

/// Complex amplitude of order `n` of evenly spaced samples of one period: a cosine of amplitude 1 reads 1.
pub fn order(samples: &[f64], n: usize) -> [f64; 2] {
    let count = samples.len() as f64;
    let share = if n == 0 { 1.0 } else { 2.0 } / count;
    samples.iter().enumerate().fold([0.0; 2], |[re, im], (i, x)| {
        let (sin, cos) = (std::f64::consts::TAU * (n * i % samples.len()) as f64 / count).sin_cos();
        [re + share * x * cos, im - share * x * sin]
    })
}
