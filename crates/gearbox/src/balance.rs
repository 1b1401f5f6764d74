//! Equilibrium of every body: the residual of all forces on it. Theory (85).

use nalgebra::{DVector, Vector3};

use crate::{StaticGearbox, Vector12, static_result::BearingState};

/// What holds the bodies, and how well they are in balance.
pub(crate) struct Balance {
    /// Torque at the input, N mm about +z.
    pub input_torque: f64,
    /// Force and moment about its origin on each shaft that is held; `None` for the others.
    pub held: Vec<Option<[f64; 6]>>,
    /// Largest force or moment that is left over on a shaft, over the largest that acts on it, or over a thousandth of the
    /// largest in the gearbox where that is more: a planet whose teeth have parted carries nothing.
    pub body: f64,
}

/// Share of the largest force in a gearbox below which a shaft idles.
const IDLE: f64 = 1e-3;

/// Sums of forces and of moments about a shaft's origin, with the largest of each.
#[derive(Default)]
struct Sum {
    force: Vector3<f64>,
    moment: Vector3<f64>,
    largest: [f64; 2],
}

impl Sum {
    /// Adds a force and a moment at height z of the shaft.
    fn add(&mut self, z: f64, force: Vector3<f64>, moment: Vector3<f64>) {
        let arm = Vector3::new(0.0, 0.0, z).cross(&force);
        self.force += force;
        self.moment += arm + moment;
        self.largest[0] = self.largest[0].max(force.amax());
        self.largest[1] = self.largest[1].max(arm.amax()).max(moment.amax());
    }

    /// What is left over of forces and moments, relative; `whole`: the largest in the gearbox.
    fn left(&self, whole: [f64; 2]) -> f64 {
        let left = [self.force.amax(), self.moment.amax()];
        let of = |k: usize| {
            let largest = self.largest[k].max(IDLE * whole[k]);
            if largest > 0.0 { left[k] / largest } else { 0.0 }
        };
        of(0).max(of(1))
    }
}

/// Sums up what meshes, torques, bearings and the input do to every shaft: places where the parts are, undeformed, as
/// linear shafts have it. `turned`: forces of bearings whose seats turn, on their shafts and on the nodes of their seats.
pub(crate) fn balances(
    gearbox: &StaticGearbox,
    reactions: &DVector<f64>,
    forces: &[Vector12],
    (bearings, turned): (&[BearingState], &[Option<Vector12>]),
) -> Balance {
    let structure = gearbox.assembly.structure();
    let input = &structure.discs[gearbox.operation.input];
    let turn_at = |shaft: usize| gearbox.seats.on_shaft(shaft).map(|(at, _)| reactions[at + 5]).sum::<f64>();
    let input_torque = if gearbox.held[input.shaft] {
        turn_at(input.shaft)
    } else {
        gearbox.seats.of_disc(&gearbox.assembly, gearbox.operation.input).map_or(0.0, |at| reactions[at + 5])
    };
    let about_z = |torque: f64| Vector3::new(0.0, 0.0, torque);
    let (mut held, mut sums) = (Vec::new(), Vec::new());
    for shaft in 0..structure.shafts.len() {
        let mut sum = Sum::default();
        for (mesh, force) in gearbox.meshes.iter().zip(forces) {
            for (g, &disc) in mesh.discs.iter().enumerate().filter(|(_, d)| structure.discs[**d].shaft == shaft) {
                let own = force.fixed_rows::<6>(6 * g);
                sum.add(gear_height(gearbox, disc), own.fixed_rows::<3>(0).into(), own.fixed_rows::<3>(3).into());
            }
        }
        for torque in gearbox.operation.torques.iter().filter(|t| structure.discs[t.disc].shaft == shaft) {
            sum.add(0.0, Vector3::zeros(), about_z(torque.torque));
        }
        if input.shaft == shaft {
            sum.add(0.0, Vector3::zeros(), about_z(input_torque));
        }
        if gearbox.held[shaft] {
            // What is not balanced but about its axis is what holds it.
            let (f, m) = (-sum.force, -sum.moment);
            held.push(Some([f.x, f.y, f.z, m.x, m.y, 0.0]));
            sum.force = Vector3::zeros();
            sum.moment = about_z(sum.moment.z);
            sums.push(sum);
            continue;
        }
        for (i, ((bearing, state), turned)) in structure.bearings.iter().zip(bearings).zip(turned).enumerate() {
            let (force, moment) = (Vector3::from(state.force), Vector3::from(state.moment));
            if bearing.shaft == shaft {
                sum.add(height(gearbox, shaft, gearbox.assembly.bearing(i)), force, moment);
            }
            // The other way round on the shaft that its seat is part of.
            if let (Some(outer), Some([x, y, z])) = (bearing.outer, structure.seat(bearing))
                && outer == shaft
            {
                if let (Some(ends), Some(node)) =
                    (turned, gearbox.assembly.bearing_ends(i).nth(1).map(|(node, _)| node))
                {
                    let [force, moment] = [6, 9].map(|at| ends.fixed_rows::<3>(at).into());
                    sum.add(height(gearbox, shaft, node), force, moment);
                    continue;
                }
                sum.add(z, -force, -moment - Vector3::new(x, y, 0.0).cross(&force));
            }
        }
        held.push(None);
        sums.push(sum);
    }
    let whole = [0, 1].map(|k| sums.iter().map(|sum| sum.largest[k]).fold(0.0, f64::max));
    let body = sums.iter().map(|sum| sum.left(whole)).fold(0.0, f64::max);
    Balance { input_torque, held, body }
}

fn gear_height(gearbox: &StaticGearbox, disc: usize) -> f64 {
    let disc_of = &gearbox.assembly.structure().discs[disc];
    gearbox.assembly.disc(disc).map_or(0.0, |node| height(gearbox, disc_of.shaft, node) + disc_of.reach)
}

/// Height of a node on its shaft, mm.
fn height(gearbox: &StaticGearbox, shaft: usize, node: usize) -> f64 {
    let (first, line) = gearbox.assembly.line(shaft);
    line.positions()[(node - first) / 6]
}
