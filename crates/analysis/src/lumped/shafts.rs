//! Two lumped shafts with the mesh of the pair between them.

use ::lumped::{
    LumpedError, MeshCycle, MeshFrame, PlaneOfAction,
    shaft18::{
        Mesh, MeshGeometry, RunOut, Segment, Shaft, ShaftMechanism, ShaftRow, ShaftStation, ShaftSystem, ShaftTorque,
        Station, Support,
    },
};
use dynamics::RigidBody;
use gearbox::GearboxError;
use geometry::GearPair;
use integrate::State;
use nalgebra::DVector;
use scene::{DiscScene, Driver, GearScene, MeshScene, Operation, Scene, Shaft18Scene, ShaftScene, SupportScene};

use super::{
    LumpedRow,
    bodies::bodies,
    excitation::MeshExcitation,
    mechanism::{Formulas, LumpedMechanism, StaticPoint, at_rest},
};
use crate::{AnalysisError, options};

/// The gear's station; the others follow it.
const GEAR: usize = 0;
/// Contact lines of a scene's pair.
pub(super) fn plane(scene: &Scene, pair: &GearPair) -> PlaneOfAction {
    let running = options(scene, pair);
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
    own: &Shaft18Scene,
    mesh: &MeshScene,
    pair: &GearPair,
    excitation: &MeshExcitation,
) -> Result<(ShaftSystem, f64), LumpedError> {
    let bodies = bodies(scene.gears(), pair);
    let (mut shafts, mut torques) = (Vec::new(), Vec::new());
    let sense = scene.operation.rotation.sign() as f64;
    let teeth = scene.gears().map(|gear| f64::from(gear.teeth));
    for (i, gear) in scene.gears().into_iter().enumerate() {
        let Some(stated) = &gear.shaft else { continue };
        let (shaft, at) = shaft(gear, stated, &bodies[i]);
        shafts.push(shaft);
        torques.push(ShaftTorque {
            place: ShaftStation { shaft: i, station: at },
            torque: sense * torque_about_z(&scene.operation, teeth, i),
        });
    }
    let mesh = live_mesh(scene, mesh, pair, &excitation.cycle)?;
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
        mass_damping: own.mass_damping_per_s,
        stiffness_damping: own.stiffness_damping_s,
        gravity: own.gravity(),
    };
    Ok((system, resonance))
}

/// Whether supports hold both shafts of a scene, before anything is computed.
///
/// # Errors
/// [`LumpedError::Loose`].
pub(super) fn check_held(scene: &Scene, own: &Shaft18Scene, pair: &GearPair) -> Result<(), LumpedError> {
    let bodies = bodies(scene.gears(), pair);
    let thrust = own.gravity_m_per_s2[2] != 0.0 || pair.base_helix_angle() != 0.0;
    for (i, gear) in scene.gears().into_iter().enumerate() {
        let motion = gear.shaft.as_ref().and_then(|stated| shaft(gear, stated, &bodies[i]).0.loose_motion(thrust));
        if let Some(motion) = motion {
            return Err(LumpedError::Loose { shaft: i, motion });
        }
    }
    Ok(())
}

/// Torque on a gear's shaft about +z, N mm, for a pinion that turns counter-clockwise. The driver is pushed the way
/// it turns, the driven gear held back; the gears turn against each other, so both torques have one sign.
fn torque_about_z(operation: &Operation, teeth: [f64; 2], gear: usize) -> f64 {
    let sign = match operation.driver {
        Driver::Pinion => 1.0,
        Driver::Wheel => -1.0,
    };
    sign * operation.torque() * teeth[gear] / teeth[operation.driver.driven()]
}

fn live_mesh(scene: &Scene, mesh: &MeshScene, pair: &GearPair, cycle: &MeshCycle) -> Result<Mesh, LumpedError> {
    let cos = pair.base_helix_angle().cos();
    let run_out = scene.gears().map(|g| {
        g.shaft.as_ref().map_or_else(RunOut::default, |s| {
            let [eccentricity, phase] = s.run_out();
            RunOut { eccentricity, phase }
        })
    });
    Mesh {
        gears: [0, 1].map(|shaft| ShaftStation { shaft, station: GEAR }),
        geometry: MeshGeometry::of_pair(pair, scene.side()),
        stiffness: cycle.stiffness.clone(),
        damping_ratio: scene.motion.as_ref().and_then(|m| m.mesh_damping_ratio).unwrap_or(0.0),
        half_backlash: mesh.half_backlash().unwrap_or(0.5 * pair.backlash().max(0.0) * cos),
        error: cycle.error.clone(),
        run_out,
    }
    .fed(cycle)
}

/// A shaft with its gear first, discs next, then what merely bears mass; and the station of the torque.
fn shaft(gear: &GearScene, stated: &ShaftScene, body: &RigidBody) -> (Shaft, usize) {
    let segment = |&[length, outer_diameter, inner_diameter]: &[f64; 3]| Segment {
        length,
        outer_diameter,
        inner_diameter,
        young: gear.material.young_mpa,
        poisson: gear.material.poisson,
        density: gear.material.density(),
    };
    let support = |s: &SupportScene| Support { position: s.at_mm, stiffness: s.stiffnesses(), damping: s.dampings() };
    let sits = Station { position: stated.gear_at_mm, kept: [true; 6], ..Station::default() }.bearing(body);
    let mut stations = vec![sits];
    stations.extend(stated.discs.iter().map(disc));
    let mut shaft = Shaft {
        segments: stated.segments_mm.iter().map(segment).collect(),
        stations,
        supports: stated.supports.iter().map(support).collect(),
    };
    // Places that merely bear the shaft's own mass, or take a torque, are those of a gear or disc that is there.
    let near = shaft.coincidence();
    let mut place = |position: f64| {
        let there = shaft.stations.iter().position(|s| (s.position - position).abs() <= near);
        there.unwrap_or_else(|| {
            shaft.stations.push(Station { position, ..Station::default() });
            shaft.stations.len() - 1
        })
    };
    stated.nodes_mm.iter().for_each(|&z| _ = place(z));
    let at = place(stated.torque_at_mm);
    (shaft, at)
}

fn disc(stated: &DiscScene) -> Station {
    let mut kept = [false; 6];
    stated.keeps.iter().for_each(|&k| kept[k as usize] = true);
    let [transverse_inertia, polar_inertia] = stated.inertias();
    Station { position: stated.at_mm, mass: stated.mass(), polar_inertia, transverse_inertia, kept }
}

/// Places of the gears' coordinates among those of the model; a gear keeps all of its six.
fn of_gears(model: &ShaftMechanism) -> Vec<usize> {
    let coordinates = model.coordinates();
    (0..coordinates.len()).filter(|&i| coordinates[i].1 == GEAR).collect()
}

fn shaft_row(row: &ShaftRow) -> LumpedRow {
    LumpedRow {
        time: row.time,
        mesh_phase: row.mesh_phase,
        transmission_error_um: row.transmission_error_um,
        compression: Some([row.compression, row.compression_rate]),
        normal_mesh_stiffness: Some(row.stiffness),
        normal_force: row.normal_force,
        wrench: row.wrench,
        ..LumpedRow::default()
    }
}

impl LumpedMechanism for Formulas<ShaftMechanism> {
    fn start(&mut self) -> Result<State, AnalysisError> {
        Ok(at_rest(self.static_state(0.0)?))
    }

    fn scale(&self) -> DVector<f64> {
        self.0.scale()
    }

    fn row(&mut self, state: &State) -> Result<LumpedRow, GearboxError> {
        let cycles = self.mesh_period(0).map_or(0.0, |period| state.time / period);
        // A system has one mesh, the first.
        let row = self.0.row(0, state.time, &state.q, &state.v).as_ref().map(shaft_row).unwrap_or_default();
        let gears = of_gears(self);
        let of = |list: &DVector<f64>| gears.iter().map(|&i| list[i]).collect();
        Ok(LumpedRow { mesh_cycles: Some(cycles), displacement: of(&state.q), velocity: of(&state.v), ..row })
    }

    fn static_cycle(&self, phases: usize) -> Option<Vec<StaticPoint>> {
        let period = self.mesh_period(0)?;
        let at = |k: usize| {
            let t = period * k as f64 / phases as f64;
            let q = self.static_state(t).ok()?;
            let row = self.0.row(0, t, &q, &DVector::zeros(q.len()))?;
            Some(StaticPoint { error: 1e-3 * row.transmission_error_um, line_length: None })
        };
        (0..phases).map(at).collect()
    }

    fn natural_frequencies_hz(&self, share: f64) -> Vec<f64> {
        self.whirl(share).iter().flatten().map(|m| m.frequency_hz).collect()
    }
}
