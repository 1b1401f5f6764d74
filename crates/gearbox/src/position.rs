//! Results of a gearbox at a solved position. Theory (85).

use contact::SliceResult;
use ltca::FilletField;
use nalgebra::{DVector, Vector3, Vector6};

use crate::{
    BoltForce, GearboxPosition, MeshForces, MeshState, StaticGearbox, Vector12,
    balance::{Balance, balances},
    equilibrium::Converged,
    rolling_bearing::{RollingReply, RollingState},
    static_result::{BearingState, GearboxCertificate, ShaftLine},
};

/// A solution as it comes from the search.
pub(crate) struct Solved {
    pub angle: f64,
    pub cycles: Vec<f64>,
    pub found: Converged,
    pub replies: Vec<MeshForces>,
    /// Replies of bearings with rolling elements.
    pub pressed: Vec<RollingReply>,
    /// Forces of the laminae of each bearing that presses the bore of a gear, N.
    pub laminae: Vec<Vec<f64>>,
    /// Forces of the bolts of each disc.
    pub bolts: Vec<Vec<BoltForce>>,
    /// Forces on the gears, common axes.
    pub forces: Vec<Vector12>,
    pub slices: Vec<Vec<SliceResult>>,
    pub roots: Vec<[Vec<FilletField>; 2]>,
}

/// Everything that is known of it.
pub(crate) fn position(gearbox: &StaticGearbox, solved: Solved) -> GearboxPosition {
    let Solved { angle, cycles, found, replies, pressed, laminae, bolts, forces, slices, roots } = solved;
    let seats = &gearbox.seats.basis * &found.displacements;
    let mut all = gearbox.seats.all(&seats);
    for (shaft, _) in gearbox.held.iter().enumerate().filter(|(_, held)| **held) {
        turn_along(gearbox, shaft, &seats, &mut all);
    }
    let at_bearings = gearbox.assembly.at_bearings(&all);
    let supports = gearbox.assembly.supports();
    let [relative, on_shafts] = supports.standing(&at_bearings);
    let structure = gearbox.assembly.structure();
    let step = &gearbox.seats.basis * &found.last_step;
    let at_rest = |b: &crate::Bearing| b.law.as_ref().map(|_| RollingState::at_rest());
    let mut rolling: Vec<Option<RollingState>> = structure.bearings.iter().map(at_rest).collect();
    for (own, reply) in gearbox.compliant_support.iter().zip(&pressed) {
        rolling[own.bearing] = Some(own.state(reply, &seats, &step));
    }
    let mut turned: Vec<Option<Vector12>> = vec![None; structure.bearings.len()];
    for own in &gearbox.compliant_support {
        turned[own.bearing] = rolling[own.bearing].and_then(|state| own.at_ends(&state, &seats)).map(|(_, ends)| ends);
    }
    let mut moved: Vec<Option<Vector6<f64>>> = vec![None; structure.bearings.len()];
    for own in &gearbox.turned_springs {
        let (displacement, ends) = own.at(&seats);
        moved[own.bearing] = Some(displacement);
        turned[own.bearing] = Some(turned[own.bearing].map_or(ends, |rolls| rolls + ends));
    }
    let bearings: Vec<BearingState> = (0..structure.bearings.len())
        .map(|i| {
            let rolls = rolling[i].map_or_else(Vector6::zeros, |state| state.force);
            // The reaction of a held shaft stands by itself.
            let counts = if gearbox.held[structure.bearings[i].shaft] { 0.0 } else { 1.0 };
            let own = |k: usize| turned[i].map_or_else(|| counts * on_shafts[6 * i + k] + rolls[k], |ends| ends[k]);
            BearingState {
                force: std::array::from_fn(own),
                moment: std::array::from_fn(|k| own(3 + k)),
                displacement: std::array::from_fn(|k| moved[i].map_or(relative[6 * i + k], |moved| moved[k])),
            }
        })
        .collect();
    let reactions = gearbox.reactions(&seats, &forces, &rolling);
    let balance = balances(gearbox, &reactions, &forces, (&bearings, &turned));
    let meshes: Vec<MeshState> =
        (replies.iter().zip(&forces).zip(cycles).zip(slices.into_iter().zip(roots)).enumerate())
            .map(|(i, (((reply, force), cycles), solved))| {
                mesh_state(gearbox, i, &seats, cycles, (reply, force), solved)
            })
            .collect();
    let lags = gearbox.operation.torques.iter().map(|torque| lag(gearbox, torque.disc, &seats)).collect();
    let Balance { input_torque, held, body } = balance;
    GearboxPosition {
        input_angle: angle,
        shafts: (0..gearbox.held.len()).map(|shaft| shaft_line(gearbox, shaft, &all)).collect(),
        bearings,
        rolling,
        laminae,
        bolts,
        meshes,
        input_torque,
        held_reactions: held,
        output_lags: lags,
        certificate: GearboxCertificate { residual: found.residual, body_balance: body, iterations: found.iterations },
    }
}

/// A held shaft turns as a whole.
fn turn_along(gearbox: &StaticGearbox, shaft: usize, seats: &DVector<f64>, all: &mut DVector<f64>) {
    let turn = gearbox.seats.on_shaft(shaft).next().map_or(0.0, |(at, _)| seats[at + 5]);
    let (first, line) = gearbox.assembly.line(shaft);
    for node in 0..line.positions().len() {
        (0..6).for_each(|axis| all[first + 6 * node + axis] = if axis == 5 { turn } else { 0.0 });
    }
}

fn shaft_line(gearbox: &StaticGearbox, shaft: usize, all: &DVector<f64>) -> ShaftLine {
    let (first, line) = gearbox.assembly.line(shaft);
    let positions = line.positions().to_vec();
    let all = gearbox.assembly.of_sections(all);
    let of = |node: usize| std::array::from_fn(|axis| all[first + 6 * node + axis]);
    ShaftLine { displacements: (0..positions.len()).map(of).collect(), positions }
}

/// How far a disc stays behind its nominal turn, rad.
fn lag(gearbox: &StaticGearbox, disc: usize, seats: &DVector<f64>) -> f64 {
    let shaft = gearbox.assembly.structure().discs[disc].shaft;
    let sense = (gearbox.train.ratios_in_space()[shaft] * gearbox.operation.sense.sign() as f64).signum();
    let turned = gearbox.seats.of_disc(&gearbox.assembly, disc).map_or(0.0, |at| seats[at + 5]);
    0.0 - sense * turned
}

fn mesh_state(
    gearbox: &StaticGearbox,
    mesh: usize,
    seats: &DVector<f64>,
    cycles: f64,
    (reply, force): (&MeshForces, &Vector12),
    (slices, root_stress): (Vec<SliceResult>, [Vec<FilletField>; 2]),
) -> MeshState {
    let (at, turn) = gearbox.place(mesh);
    let own = turn.transpose() * Vector12::from_fn(|k, _| seats[at[k / 6] + k % 6]);
    let (pair, meshing) = (&gearbox.meshes[mesh].pair, &gearbox.train.meshing()[mesh]);
    let s = meshing.side().sign();
    let [r1, r2] = [&pair.pinion, &pair.wheel].map(|g| g.base_radius());
    let (sin, cos) = pair.working_pressure_angle().sin_cos();
    // Deviation of gear 2's axis from gear 1's over the face width, as `contact::Misalignment` counts it.
    let lean = pair.face_width() * Vector3::new(own[10] - own[4], own[3] - own[9], 0.0);
    MeshState {
        cycles,
        displacements: own.into(),
        force: std::array::from_fn(|g| std::array::from_fn(|k| force[6 * g + k])),
        moment: std::array::from_fn(|g| std::array::from_fn(|k| force[6 * g + 3 + k])),
        normal_force: reply.normal_force,
        transmission_error: s * (r1 * own[5] + r2 * own[11]),
        misalignment_in_plane: lean.x * sin + lean.y * s * cos,
        misalignment_across: lean.y * sin - lean.x * s * cos,
        slices,
        root_stress,
    }
}
