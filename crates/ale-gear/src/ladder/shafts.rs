//! Two lumped shafts with the mesh of the pair between them.

use dynamics::RigidBody;
use geometry::GearPair;
use integrate::State;
use lumped::{
    LumpedError, MeshCycle, MeshFrame, PlaneOfAction,
    shaft18::{
        Mesh, MeshGeometry, RunOut, Segment, Shaft, ShaftMechanism, ShaftRow, ShaftStation, ShaftSystem, ShaftTorque,
        Station, Support,
    },
};
use nalgebra::DVector;

use super::{
    bodies::bodies,
    mesh_cycle::Fed,
    model::{LadderModel, StaticPoint, at_rest},
};
use crate::{
    motion::{GEARS, WRENCH},
    run,
    scene::{DiscScene, Driver, GearScene, MeshScene, Scene, Shaft18Scene, ShaftScene},
};

/// The gear's station; the others follow it.
const GEAR: usize = 0;
const AXES: [&str; 6] = ["x_um", "y_um", "z_um", "tilt_x_urad", "tilt_y_urad", "turn_urad"];
const LEADING: [&str; 8] = [
    "time_s",
    "mesh_cycles",
    "mesh_phase",
    "dte_um",
    "compression_um",
    "compression_rate_um_per_s",
    "normal_mesh_stiffness_n_per_um",
    "normal_force_n",
];

/// Contact lines of a scene's pair.
pub(super) fn plane(scene: &Scene, pair: &GearPair) -> PlaneOfAction {
    let running = run::options(scene, pair);
    PlaneOfAction::of_pair(
        pair,
        running.contact.driver,
        &MeshFrame::of_pair(pair, running.contact.driver, running.contact.sense),
    )
}

/// Shafts, mesh and torques of a scene, and the mesh resonance of its gears alone, rad/s.
///
/// # Errors
/// [`LumpedError`] for what has no meaning.
pub(super) fn system(
    scene: &Scene,
    words: &Shaft18Scene,
    mesh: &MeshScene,
    pair: &GearPair,
    fed: &Fed,
) -> Result<(ShaftSystem, f64), LumpedError> {
    let bodies = bodies(scene, pair);
    let (mut shafts, mut torques) = (Vec::new(), Vec::new());
    let sense = scene.operation.rotation.sign();
    for (i, gear) in scene.gears().into_iter().enumerate() {
        let Some(own) = &gear.shaft else { continue };
        let (shaft, at) = shaft(gear, own, &bodies[i]);
        shafts.push(shaft);
        torques.push(ShaftTorque {
            place: ShaftStation { shaft: i, station: at },
            torque: sense * torque_about_z(scene, i),
        });
    }
    let mesh = live_mesh(scene, mesh, pair, &fed.cycle)?;
    let cos = pair.base_helix_angle().cos();
    let inverse_mass: f64 = [&pair.pinion, &pair.wheel]
        .iter()
        .zip(&bodies)
        .map(|(g, b)| (g.base_radius() * cos).powi(2) / b.polar_inertia)
        .sum();
    let resonance = (mesh.stiffness.mean * inverse_mass).sqrt();
    let system = ShaftSystem {
        shafts,
        meshes: vec![mesh],
        torques,
        speed: sense * scene.pinion_speed(),
        mass_damping: words.mass_damping_per_s,
        stiffness_damping: words.stiffness_damping_s,
        gravity: words.gravity_m_per_s2.map(|g| 1e3 * g),
    };
    Ok((system, resonance))
}

/// Torque on a gear's shaft about +z, N mm, for a pinion that turns counter-clockwise. The driver is pushed the way it turns, the driven gear held back; the gears turn against each other, so
/// both torques have one sign.
fn torque_about_z(scene: &Scene, gear: usize) -> f64 {
    let teeth = [scene.pinion.teeth, scene.wheel.teeth].map(f64::from);
    let (driven, sign) = match scene.operation.driver {
        Driver::Pinion => (1, 1.0),
        Driver::Wheel => (0, -1.0),
    };
    sign * scene.operation.torque() * teeth[gear] / teeth[driven]
}

fn live_mesh(scene: &Scene, words: &MeshScene, pair: &GearPair, cycle: &MeshCycle) -> Result<Mesh, LumpedError> {
    let cos = pair.base_helix_angle().cos();
    let run_out = scene.gears().map(|g| {
        g.shaft.as_ref().map_or_else(RunOut::default, |s| RunOut {
            eccentricity: 1e-3 * s.run_out_um,
            phase: s.run_out_phase_deg.to_radians(),
        })
    });
    Mesh {
        gears: [0, 1].map(|shaft| ShaftStation { shaft, station: GEAR }),
        geometry: MeshGeometry::of_pair(pair, scene.side()),
        stiffness: cycle.stiffness.clone(),
        damping_ratio: scene.motion.as_ref().and_then(|m| m.mesh_damping_ratio).unwrap_or(0.0),
        half_backlash: words.half_backlash_um.map_or(0.5 * pair.backlash().max(0.0) * cos, |b| 1e-3 * b),
        error: cycle.error.clone(),
        run_out,
    }
    .fed(cycle)
}

/// A shaft with its gear first, discs next, then what merely bears mass; and the station of the torque.
fn shaft(gear: &GearScene, words: &ShaftScene, body: &RigidBody) -> (Shaft, usize) {
    let segment = |&[length, outer_diameter, inner_diameter]: &[f64; 3]| Segment {
        length,
        outer_diameter,
        inner_diameter,
        young: gear.material.young_mpa,
        poisson: gear.material.poisson,
        density: gear.material.density(),
    };
    let support = |s: &crate::scene::SupportScene| Support {
        position: s.at_mm,
        stiffness: s.stiffnesses(),
        damping: s.dampings(),
    };
    let sits = Station { position: words.gear_at_mm, kept: [true; 6], ..Station::default() }.bearing(body);
    let mut stations = vec![sits];
    stations.extend(words.discs.iter().map(disc));
    stations.extend(words.nodes_mm.iter().map(|&position| Station { position, ..Station::default() }));
    let near = |s: &Station| (s.position - words.torque_at_mm).abs() < 1e-6;
    let at = stations.iter().position(near).unwrap_or_else(|| {
        stations.push(Station { position: words.torque_at_mm, ..Station::default() });
        stations.len() - 1
    });
    let made = Shaft {
        segments: words.segments_mm.iter().map(segment).collect(),
        stations,
        supports: words.supports.iter().map(support).collect(),
    };
    (made, at)
}

fn disc(words: &DiscScene) -> Station {
    let mut kept = [false; 6];
    words.keeps.iter().for_each(|&k| kept[k as usize] = true);
    Station {
        position: words.at_mm,
        mass: 1e-3 * words.mass_kg,
        polar_inertia: 1e3 * words.polar_inertia_kg_m2,
        transverse_inertia: 1e3 * words.transverse_inertia_kg_m2,
        kept,
    }
}

/// Displacements of the gears with their rates; a gear keeps all of its coordinates.
fn of_gears(model: &ShaftMechanism) -> Vec<(usize, usize, usize)> {
    let on_gear =
        |(i, (shaft, station, axis)): (usize, (usize, usize, usize))| (station == GEAR).then_some((i, shaft, axis));
    model.coordinates().into_iter().enumerate().filter_map(on_gear).collect()
}

fn of_row(row: &ShaftRow, cycles: f64) -> Vec<f64> {
    let mut all = vec![
        row.time,
        cycles,
        row.mesh_phase,
        row.transmission_error_um,
        1e3 * row.compression,
        1e3 * row.compression_rate,
        1e-3 * row.stiffness,
        row.normal_force,
    ];
    all.extend(row.wrench.iter().flatten());
    all
}

impl LadderModel for ShaftMechanism {
    fn start(&mut self) -> Result<State, LumpedError> {
        Ok(at_rest(self.static_state(0.0)?))
    }

    fn scale(&self) -> DVector<f64> {
        Self::scale(self)
    }

    fn columns(&self) -> Vec<String> {
        let mut names: Vec<String> = LEADING.iter().map(|&n| n.to_owned()).collect();
        names.extend(GEARS.iter().flat_map(|g| WRENCH.iter().map(move |n| format!("{g}_{n}"))));
        let gears = of_gears(self);
        names.extend(gears.iter().map(|&(_, shaft, axis)| format!("{}_{}", GEARS[shaft.min(1)], AXES[axis])));
        names.extend(gears.iter().map(|&(_, shaft, axis)| {
            let (name, unit) = AXES[axis].rsplit_once('_').unwrap_or((AXES[axis], ""));
            format!("{}_{name}_rate_{unit}_per_s", GEARS[shaft.min(1)])
        }));
        names
    }

    fn row(&mut self, state: &State) -> Vec<f64> {
        let cycles = self.mesh_period(0).map_or(0.0, |period| state.time / period);
        let Some(row) = Self::row(self, 0, state.time, &state.q, &state.v) else { return Vec::new() };
        let mut all = of_row(&row, cycles);
        let gears = of_gears(self);
        for list in [&state.q, &state.v] {
            all.extend(gears.iter().map(|&(i, _, axis)| list[i] * if axis < 3 { 1e3 } else { 1e6 }));
        }
        all
    }

    fn static_cycle(&self, phases: usize) -> Option<Vec<StaticPoint>> {
        let period = self.mesh_period(0)?;
        let at = |k: usize| {
            let t = period * k as f64 / phases as f64;
            let q = self.static_state(t).ok()?;
            let row = Self::row(self, 0, t, &q, &DVector::zeros(q.len()))?;
            Some(StaticPoint { error: 1e-3 * row.transmission_error_um, line_length: None })
        };
        (0..phases).map(at).collect()
    }

    fn natural_frequencies_hz(&self, share: f64) -> Vec<f64> {
        self.whirl(share).iter().flatten().map(|m| m.frequency_hz).collect()
    }
}
