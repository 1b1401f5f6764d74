//! A pair alone in a gearbox in motion, beside its own model.

use std::f64::consts::TAU;

use gearbox::{
    GearMesh, Torque,
    motion::{Drive, GearboxMechanism, MotionOptions, SpringMesh},
};
use geometry::Sense;
use integrate::{Integrator, Scheme, State, StepControl};
use lumped::{
    Fourier,
    shaft18::{
        MeshGeometry, Segment, Shaft as LumpedShaft, ShaftMechanism, ShaftStation, ShaftSystem, ShaftTorque, Station,
    },
};
use nalgebra::DVector;

use crate::{
    motion::stiffness,
    pairs::{operation, pair, single},
};

/// Two rigid shafts in rigid bearings and the spring between their gears are the pair's own model: started 20 um off
/// its equilibrium the pair rings, flanks part and meet, the same way step by step.
///
/// The model knows the phase by nominal time: alike for a stiffness that is always the same, and for one that varies
/// where the pinion is so heavy that it keeps its speed.
#[test]
fn a_pair_alone_moves_as_its_own_model() {
    for (k, pinion, tolerance) in [(Fourier::constant(4e5), 0.2, 1e-8), (stiffness(), 2e5, 1e-5)] {
        let [found, wanted] = pair_alone(&k, [pinion, 9.0]);
        let size = wanted.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let off = found.iter().zip(&wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(size > 0.015, "{size} mm");
        assert!(off < tolerance * size, "pinion of {pinion} t mm^2: {off:.2e} mm of {size:.2e} mm");
    }
}

/// Transmission errors of the pair in the gearbox and of its own model, step by step.
fn pair_alone(k: &Fourier, inertia: [f64; 2]) -> [Vec<f64>; 2] {
    let gears = pair([17, 53], 15.0);
    let mut structure = single(&gears, 0.0);
    for (disc, polar) in structure.discs.iter_mut().zip(inertia) {
        (disc.mass, disc.polar_inertia, disc.diametral_inertia) = (1e-3, polar, 0.5 * polar);
    }
    let (speed, torque) = (300.0, 2e5);
    let mut operation = operation(&structure, 2, Sense::Ccw, vec![Torque { disc: 3, torque }]);
    operation.held = vec![0, 1];
    let meshes = vec![GearMesh { name: "pair".into(), discs: [0, 1], pair: gears.clone() }];
    let options =
        MotionOptions { drive: Drive::Torque { start: speed, torque: None }, modal_damping: 0.0, limit: TAU * 1000.0 };
    let mut mechanism = GearboxMechanism::new(structure, meshes, operation, &options, |_, mesh, meshing| {
        Ok(Box::new(SpringMesh::new(mesh, meshing, k.clone())?.with_coast_flanks(mesh, meshing)?))
    })
    .unwrap();
    assert_eq!(mechanism.count(), 2);
    let mut start = mechanism.start(0.0).unwrap();
    // Coordinates: turn of the wheel beside the nominal one, turn of the input.
    let r = [gears.pinion.base_radius(), gears.wheel.base_radius()];
    start.q[0] += 0.02 / r[1];
    start.v.fill(0.0);
    start.v[1] = speed;
    // Polar inertia of discs and shafts, as the gearbox has them.
    let mass = integrate::Mechanism::mass(&mechanism).clone();
    let ratio = -17.0 / 53.0;
    let of_wheel = mass[(0, 0)];
    let of_pinion = mass[(1, 1)] - ratio * ratio * of_wheel;
    let meshing = mechanism.train().meshing()[0];
    let geometry = MeshGeometry::of_pair(&gears, meshing.side());
    let half = 0.5 * gears.backlash() * geometry.line().unwrap().cos_base_helix;
    // The phase that the pair has at the start, as the model counts from t = 0.
    let phase = mechanism.train().cycles(0.0)[0] * TAU;
    let shifted = Fourier {
        mean: k.mean,
        cosine: (1..=2).map(|n| shifted_by(k, n, phase)[0]).collect(),
        sine: (1..=2).map(|n| shifted_by(k, n, phase)[1]).collect(),
    };
    let system = ShaftSystem {
        shafts: [of_pinion, of_wheel].map(turning).into(),
        meshes: vec![lumped::shaft18::Mesh {
            gears: [0, 1].map(|shaft| ShaftStation { shaft, station: 0 }),
            geometry,
            stiffness: shifted,
            damping_ratio: 0.0,
            half_backlash: half,
            error: Fourier::constant(0.0),
            run_out: Default::default(),
        }],
        torques: [-torque * ratio, torque]
            .into_iter()
            .enumerate()
            .map(|(shaft, torque)| ShaftTorque { place: ShaftStation { shaft, station: 0 }, torque })
            .collect(),
        speed,
        ..ShaftSystem::default()
    };
    let mut own = ShaftMechanism::new(&system).unwrap();
    let lean = integrate::Mechanism::mass(&own).clone();
    assert!((lean[(0, 0)] / of_pinion - 1.0).abs() < 1e-6, "{} beside {of_pinion}", lean[(0, 0)]);
    // The model's zero is the middle of the backlash.
    let beyond = half / geometry.line().unwrap().cos_base_helix;
    let q = DVector::from_vec(vec![meshing.side().sign() * beyond / r[0], start.q[0]]);
    let mut state = State::new(0.0, q, DVector::zeros(2));
    let step = 1.0 / mechanism.mesh_frequencies()[0] / 100.0;
    let steps = 400;
    let scheme = Scheme::GeneralisedAlpha { rho: 0.9 };
    let plan = crate::motion::steps(scheme, [steps / 100, 100]);
    let mut found = Vec::new();
    let done = mechanism
        .run(&start, &plan, |instant| {
            found.push(instant.meshes[0].transmission_error);
        })
        .unwrap();
    let mut integrator = Integrator::new(scheme, StepControl::Fixed(step), own.scale());
    let mut wanted = vec![meshing.side().sign() * r[1] * start.q[0]];
    for i in 1..=steps {
        integrator.advance(&mut own, &mut state, step * i as f64, |_, _| ()).unwrap();
        wanted.push(meshing.side().sign() * (r[0] * state.q[0] + r[1] * state.q[1]) - beyond);
    }
    assert!(done.flanks[0].contact_losses > 3, "the flanks come apart: {:?}", done.flanks);
    [found, wanted]
}

/// Coefficients of order n of f(phi + by).
fn shifted_by(f: &Fourier, n: usize, by: f64) -> [f64; 2] {
    let ([a, b], (sin, cos)) = (f.coefficients(n), (n as f64 * by).sin_cos());
    [a * cos + b * sin, b * cos - a * sin]
}

/// A shaft that turns and does nothing else.
fn turning(polar_inertia: f64) -> LumpedShaft {
    let segment = |length| Segment {
        length,
        outer_diameter: 20.0,
        inner_diameter: 0.0,
        young: 2.06e5,
        poisson: 0.3,
        density: 1e-20,
    };
    LumpedShaft {
        segments: vec![segment(50.0)],
        stations: vec![Station {
            position: 25.0,
            mass: 1e-3,
            polar_inertia,
            transverse_inertia: 0.5 * polar_inertia,
            kept: [false, false, false, false, false, true],
        }],
        supports: [0.0, 50.0]
            .map(|position| lumped::shaft18::Support {
                position,
                stiffness: [1e6, 1e6, 1e6, 0.0, 0.0, 0.0],
                damping: [0.0; 6],
            })
            .into(),
    }
}
