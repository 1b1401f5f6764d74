//! One row of a motion: the values stored for each instant.

use std::f64::consts::TAU;

use dynamics::COORDINATES;
use gearbox::motion::{FlankInstant, PairInstant};
use integrate::Ledger;
use ltca::FilletStress;
use scene::{Axis, Scene};
use serde::{Deserialize, Serialize};

use crate::results::{MAX_PRINCIPAL, MIN_PRINCIPAL, PressureSpot, VON_MISES, base_radius_mm, error_percent};

/// One row of a motion, in the units of the result files. The name of a field ends in its unit; `docs/outputs.md`
/// explains each field.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MotionRow {
    /// Time since the quasi-static start.
    pub time_s: f64,
    /// Pinion angle of the nominal motion; 0 when pair 0 is in the middle of the path of contact.
    pub pinion_angle_deg: f64,
    /// Phase of the nominal motion, 0 .. 1 within the mesh cycle.
    pub mesh_phase: f64,
    /// Speeds of pinion and wheel, about +z.
    pub speed_rpm: [f64; 2],
    /// Dynamic transmission error: lag of the driven gear behind the nominal motion on its base circle.
    pub dte_um: f64,
    /// Rate of the dynamic transmission error.
    pub dte_rate_um_per_s: f64,
    /// Length of the contact lines of the driving flanks.
    pub contact_line_length_mm: f64,
    /// Number of tooth pairs whose driving flanks carry load.
    pub pairs_in_contact: u32,
    /// Force of the mesh on pinion and wheel, fixed axes.
    pub force_n: [[f64; 3]; 2],
    /// Moment of the mesh on pinion and wheel about their displaced centres, fixed axes.
    pub moment_nmm: [[f64; 3]; 2],
    /// Normal force of each pair by its number within the mesh cycle, starting with the smallest number (see
    /// [`MotionLayout::pairs`]); 0 outside the window.
    pub pair_normal_force_n: Box<[f64]>,
    /// Bearings and displacements of pinion and wheel; `None` for a gear without free coordinates.
    pub bearing: [Option<Box<BearingRow>>; 2],
    /// Sum of the normal forces over the driving flanks, damping included.
    pub normal_force_n: f64,
    /// Sum of the normal forces over the coast flanks, damping included.
    pub coast_normal_force_n: f64,
    /// Torque of the driver in the running sense.
    pub drive_torque_nm: f64,
    /// Torque on the driven gear against its motion.
    pub load_torque_nm: f64,
    /// Largest contact pressure.
    pub max_pressure_mpa: f64,
    /// Position of the largest pressure; `None` without load.
    pub max_pressure_at: Option<PressureSpot>,
    /// Number of tooth changes since the quasi-static start.
    pub tooth_changes: u64,
    /// Root stress of pinion and wheel, if the scene requests it.
    pub root_stress: Option<Box<[RootStressRow; 2]>>,
    /// Energy balance.
    pub energy: EnergyRow,
}

/// Bearing force and displacement of a gear with free coordinates.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct BearingRow {
    /// Force on the gear.
    pub force_n: [f64; 3],
    /// Moment on the gear, about x and y.
    pub moment_nmm: [f64; 2],
    /// Displacement of the gear's centre.
    pub displacement_um: [f64; 3],
    /// Rotations about x and y.
    pub tilt_urad: [f64; 2],
}

/// Largest stresses in the fillets of one gear's window; NaN if coast flanks are in contact as well.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RootStressRow {
    /// Largest first principal stress.
    pub max_principal_mpa: f64,
    /// Smallest third principal stress.
    pub min_principal_mpa: f64,
    /// Largest von Mises stress.
    pub von_mises_mpa: f64,
    /// Estimated error of the largest tension.
    pub estimated_error_percent: f64,
}

/// The energy balance of a motion at a time: work and energy since the start, mJ = N mm.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergyRow {
    /// Time, s.
    pub time_s: f64,
    /// Kinetic energy.
    pub kinetic_mj: f64,
    /// Elastic energy of teeth, bearings and modes.
    pub elastic_mj: f64,
    /// Work of drive and load.
    pub supplied_mj: f64,
    /// Change of the teeth's elastic energy by their rotation under load.
    pub parametric_mj: f64,
    /// Energy dissipated by dampers and friction.
    pub dissipated_mj: f64,
    /// Energy that the integrator adds or removes.
    pub residual_mj: f64,
}

impl EnergyRow {
    /// Row of a ledger at a time, s.
    pub fn of(time_s: f64, ledger: &Ledger) -> Self {
        Self {
            time_s,
            kinetic_mj: ledger.kinetic,
            elastic_mj: ledger.potential,
            supplied_mj: ledger.supplied,
            parametric_mj: ledger.parametric,
            dissipated_mj: ledger.dissipated,
            residual_mj: ledger.residual(),
        }
    }
}

/// Properties that all rows of a motion have in common.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionLayout {
    /// Pitch angle of the pinion, rad.
    pitch: f64,
    /// Base radius of the pinion, mm.
    base_radius: f64,
    sense: i64,
    free: [[bool; 5]; 2],
    root_stress: bool,
    /// Largest number of a pair.
    reach: i64,
}

impl MotionLayout {
    /// Layout for a scene and a window of a given number of teeth.
    pub fn of(scene: &Scene, window: usize) -> Self {
        let free = scene.gears().map(|g| {
            let axes = g.body.as_ref().map_or(&[][..], |b| &b.free);
            Axis::ALL.map(|axis| axes.contains(&axis))
        });
        Self {
            pitch: TAU / f64::from(scene.pinion.teeth),
            base_radius: base_radius_mm(scene, 0),
            sense: scene.operation.rotation.sign(),
            free,
            root_stress: scene.output.root_stress,
            reach: window as i64 / 2 + 1,
        }
    }

    /// Numbers of the pairs whose forces a row contains.
    pub fn pairs(&self) -> std::ops::RangeInclusive<i64> {
        -self.reach..=self.reach
    }

    /// Whether x, y, z and the rotations about x and y are free coordinates of a gear.
    pub fn free(&self, gear: usize) -> [bool; 5] {
        self.free[gear]
    }

    /// Whether rows have root stresses.
    pub fn has_root_stress(&self) -> bool {
        self.root_stress
    }

    /// The row at an instant.
    pub fn row(&self, now: &PairInstant, ledger: &Ledger) -> MotionRow {
        let (cycle, [driving, _]) = (cycle(now), &now.flanks);
        let [normal_force_n, coast_normal_force_n] = now.normal_forces();
        let of_gear = |i: usize, from: usize| std::array::from_fn(|k| now.mesh.wrench[COORDINATES * i + from + k]);
        let stress = |i: usize| RootStressRow::of(&driving.root_stress[i], coast_normal_force_n == 0.0);
        MotionRow {
            time_s: now.time,
            pinion_angle_deg: ((now.mesh.cycles - 0.5) * self.pitch).to_degrees(),
            mesh_phase: (now.mesh.cycles - cycle).max(0.0),
            speed_rpm: now.speeds.map(|w| w * 60.0 / TAU),
            dte_um: 1e3 * now.mesh.transmission_error,
            dte_rate_um_per_s: 1e3 * now.mesh.transmission_error_rate,
            contact_line_length_mm: driving.line_length,
            pairs_in_contact: driving.pair_forces.iter().filter(|f| **f > 0.0).count() as u32,
            force_n: [0, 1].map(|i| of_gear(i, 0)),
            moment_nmm: [0, 1].map(|i| of_gear(i, 3)),
            pair_normal_force_n: self.pairs().map(|pair| self.pair_force((driving, cycle), pair)).collect(),
            bearing: [0, 1].map(|i| self.free[i].contains(&true).then(|| Box::new(BearingRow::of(now, i)))),
            normal_force_n,
            coast_normal_force_n,
            drive_torque_nm: 1e-3 * now.drive_torque,
            load_torque_nm: 1e-3 * now.load_torque,
            max_pressure_mpa: driving.max_pressure(),
            max_pressure_at: PressureSpot::of(self.base_radius, driving.slices.iter().map(|s| &s.slice)),
            tooth_changes: driving.tooth_changes,
            root_stress: self.root_stress.then(|| Box::new([stress(0), stress(1)])),
            energy: EnergyRow::of(now.time, ledger),
        }
    }

    /// Normal force of a pair by its number within the mesh cycle, N; 0 outside of the window.
    fn pair_force(&self, (driving, cycle): (&FlankInstant, f64), pair: i64) -> f64 {
        let running = self.sense * (pair - cycle as i64);
        let place = usize::try_from(running - driving.first_pair).ok();
        place.and_then(|i| driving.pair_forces.get(i)).copied().unwrap_or(0.0)
    }
}

impl MotionRow {
    /// Normal force of a pair by its number within the mesh cycle, N; 0 outside the window.
    pub fn pair_force_n(&self, pair: i64) -> f64 {
        let place = usize::try_from(pair + self.pair_normal_force_n.len() as i64 / 2).ok();
        place.and_then(|i| self.pair_normal_force_n.get(i)).copied().unwrap_or(0.0)
    }
}

impl BearingRow {
    fn of(now: &PairInstant, gear: usize) -> Self {
        let (first, bearing) = (COORDINATES * gear, &now.bearings[gear]);
        Self {
            force_n: bearing.force,
            moment_nmm: [0, 1].map(|k| bearing.moment[k]),
            displacement_um: [0, 1, 2].map(|k| now.displacements[first + k] * 1e3),
            tilt_urad: [3, 4].map(|k| now.displacements[first + k] * 1e6),
        }
    }
}

impl RootStressRow {
    /// The stress is that of the driving flanks: no number where coast flanks press as well.
    fn of(fillets: &[FilletStress], driving_alone: bool) -> Self {
        let or_none = |value: f64| if driving_alone { value } else { f64::NAN };
        Self {
            max_principal_mpa: or_none(MAX_PRINCIPAL.stress(fillets, None)),
            min_principal_mpa: or_none(MIN_PRINCIPAL.stress(fillets, None)),
            von_mises_mpa: or_none(VON_MISES.stress(fillets, None)),
            estimated_error_percent: or_none(error_percent(fillets)),
        }
    }
}

/// Whole mesh cycles. A row at the end of a cycle belongs to the next one, whatever the last bits say.
fn cycle(now: &PairInstant) -> f64 {
    (now.mesh.cycles + 1e-9).floor()
}
