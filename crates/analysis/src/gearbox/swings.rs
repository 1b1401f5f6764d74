//! Results of a gearbox vibration about its equilibrium.

use std::sync::Arc;

use dynamics::RigidBody;
use gearbox::{ExcitationLine, OrderForces, SpeedRms, WhirlModes, taken_off};
use reduction::GearModes;
use scene::gearbox::{Gearbox, GearboxGear, GearboxMesh};
use study::Campbell;

use crate::{
    motion::RPM,
    remark::{self, Remark},
};

/// Elastic modes of the gear on every disc; `None` where it is in no mesh, and nothing where none are kept.
pub(super) type GearModesOfDiscs = Vec<Option<Arc<GearModes>>>;

/// Vibration of a gearbox about its equilibrium, order by order of its meshes.
#[derive(Debug, Clone)]
pub struct VibrationResult {
    /// Mass and inertia of the gears, in their order.
    pub gears: Vec<RigidBody>,
    /// Elastic modes of the gears, in order; `None` for gears that are rigid apart from their teeth.
    pub gear_modes: Vec<Option<GearFrequencies>>,
    /// Mean stiffness of every mesh along its normal, N/mm, for rotation of gear 1.
    pub mesh_stiffness: Vec<f64>,
    /// Single-sided amplitudes of the loaded transmission error of every mesh, mm, order by order.
    pub transmission_error: Vec<Vec<f64>>,
    /// Number of modes without spin in the response.
    pub modes_kept: usize,
    /// Frequency up to which all modes are included, Hz.
    pub modes_up_to_hz: f64,
    /// Natural modes at the speeds of the Campbell diagram, as many as requested.
    pub modes: Vec<WhirlModes>,
    /// Natural frequencies over the speed of the input.
    pub campbell: GearboxCampbell,
    /// Speeds of the input for the forced response, rad/s.
    pub speeds: Vec<f64>,
    /// All orders of all meshes at all speeds.
    pub orders: Vec<Vec<OrderForces>>,
    /// All orders together, speed by speed.
    pub rms: Vec<SpeedRms>,
}

/// Elastic modes of a vibrating gear.
#[derive(Debug, Clone, PartialEq)]
pub struct GearFrequencies {
    /// Natural frequencies with the bore held and the flanks free, Hz, ascending.
    pub frequencies_hz: Vec<f64>,
    /// Whether the gear is condensed by sectors; its modes are then fixed in space while the teeth pass.
    pub by_sectors: bool,
}

/// Natural frequencies of a gearbox over the speed of its input, and its excitations.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxCampbell {
    /// Natural frequencies, and their intersections with excitation lines.
    pub diagram: Campbell,
    /// Excitation lines, in the order of the diagram's orders.
    pub lines: Vec<ExcitationLine>,
}

impl VibrationResult {
    /// Meshes whose linear vibration takes more than their mean load (N) off them at some speed: flanks would lose contact.
    fn beyond_load(&self, file: &Gearbox, loads: &[f64]) -> Vec<Remark> {
        let one = |(i, (mesh, &load)): (usize, (&GearboxMesh, &f64))| {
            let forces: Vec<f64> = self
                .orders
                .iter()
                .map(|orders| taken_off(orders.iter().map(|o| (o.frequency_hz, o.order, o.mesh_forces[i]))))
                .collect();
            let beyond = |at: &usize| forces[*at] > load;
            let worst = (0..forces.len()).filter(beyond).max_by(|&a, &b| forces[a].total_cmp(&forces[b]))?;
            let size = |own: &&OrderForces| own.mesh_forces[i].norm();
            let most = self.orders[worst].iter().max_by(|a, b| size(a).total_cmp(&size(b)))?;
            let listed = ranges(&forces.iter().map(|force| *force > load).collect::<Vec<_>>());
            let rpm = |at: usize| format!("{:.0}", self.speeds[at] / RPM);
            let words = listed.iter().map(|&[a, b]| if a == b { rpm(a) } else { format!("{} to {}", rpm(a), rpm(b)) });
            let said = remark::vibration_beyond_load(
                forces[worst],
                self.speeds[worst] / RPM,
                most.order,
                &*file.meshes[most.mesh].name,
                load,
                listed.iter().map(|[a, b]| b - a + 1).sum::<usize>(),
                forces.len(),
                format!("rpm: {}", words.take(LISTED).collect::<Vec<_>>().join(", ")),
            );
            Some(said.about(&mesh.name))
        };
        file.meshes.iter().zip(loads).enumerate().filter_map(one).collect()
    }

    /// What a user should hear: of vibration beyond the mean load of each mesh (N), of the modes of gears.
    pub(super) fn remarks(&self, file: &Gearbox, loads: &[f64]) -> Vec<Remark> {
        let orders = self.orders.iter().flatten().map(|order| order.frequency_hz);
        let still = file.gears.iter().zip(&self.gear_modes).filter_map(|(gear, own)| {
            own.as_ref().filter(|own| !own.by_sectors).map(|_| remark::gear_modes_do_not_travel(&*gear.name))
        });
        let few = few_modes(file, &self.gear_modes, orders.fold(0.0, f64::max));
        self.beyond_load(file, loads).into_iter().chain(few).chain(still).collect()
    }

    /// Speed (rad/s) at which a root mean square is largest, and its value there; `None` if there are no speeds.
    pub fn peak(&self, of: impl Fn(&SpeedRms) -> f64) -> Option<(f64, f64)> {
        let all = self.speeds.iter().zip(&self.rms).map(|(speed, rms)| (*speed, of(rms)));
        all.max_by(|a, b| a.1.total_cmp(&b.1))
    }
}

/// Ranges of speeds that are listed.
const LISTED: usize = 4;

/// First and last place of each row of those that are marked.
fn ranges(marked: &[bool]) -> Vec<[usize; 2]> {
    let mut all: Vec<[usize; 2]> = Vec::new();
    for at in (0..marked.len()).filter(|at| marked[*at]) {
        match all.last_mut() {
            Some([_, last]) if *last + 1 == at => *last = at,
            _ => all.push([at; 2]),
        }
    }
    all
}

/// Gears whose modes end below the highest frequency (Hz) that excites them.
pub(super) fn few_modes(file: &Gearbox, gears: &[Option<GearFrequencies>], fastest: f64) -> Vec<Remark> {
    let one = |(gear, own): (&GearboxGear, &Option<GearFrequencies>)| {
        let last = own.as_ref()?.frequencies_hz.last().copied();
        let highest = file.modes.and_then(|asked| asked.below_hz).or(last).unwrap_or(0.0);
        (highest < fastest).then(|| remark::few_gear_modes(&*gear.name, highest, fastest, fastest.ceil()))
    };
    file.gears.iter().zip(gears).filter_map(one).collect()
}

/// Frequencies of the modes of all gears, in their order.
pub(super) fn gear_frequencies(count: usize, modes: &GearModesOfDiscs) -> Vec<Option<GearFrequencies>> {
    let of = |own: &Arc<GearModes>| GearFrequencies {
        frequencies_hz: own.frequencies_hz(),
        by_sectors: own.standing().is_some(),
    };
    (0..count).map(|i| modes.get(i).and_then(Option::as_ref).map(of)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Speeds in a row are listed as one range.
    #[test]
    fn speeds_in_a_row_are_one_range() {
        assert_eq!(ranges(&[true, true, false, true]), [[0, 1], [3, 3]]);
        assert!(ranges(&[false; 3]).is_empty());
    }
}
