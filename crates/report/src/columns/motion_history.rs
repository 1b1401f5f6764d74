//! `history.csv` of a motion of reduced gears: one row a step of output.

use std::f64::consts::TAU;

use dynamics::{COORDINATES, Instant, PairMechanism};
use scene::{Axis, Scene};

use super::{At, Group, Over, Rows, Sheet, Table, columns};
use analysis::results::{MAX_PRINCIPAL, MIN_PRINCIPAL, VON_MISES, base_radius_mm, error_percent, place_values};

/// Rows of a motion of reduced gears.
#[derive(Debug)]
pub struct MotionRows;

impl Rows for MotionRows {
    type Layout = MotionLayout;
    type Record = Instant;
}

/// What all rows of a motion share.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionLayout {
    /// Pitch angle of the pinion, rad.
    pitch: f64,
    /// Base radius of the pinion, mm.
    base_radius: f64,
    sense: i64,
    /// Free coordinates of each gear, which have columns of displacement and bearing: x, y, z, and the turns about x and y.
    free: [[bool; 5]; 2],
    root_stress: bool,
}

impl MotionLayout {
    fn new(scene: &Scene, free: [[bool; 5]; 2]) -> Self {
        Self {
            pitch: TAU / f64::from(scene.pinion.teeth),
            base_radius: base_radius_mm(scene, 0),
            sense: scene.operation.rotation.sign() as i64,
            free,
            root_stress: scene.output.root_stress,
        }
    }

    /// Of a scene and its mechanism.
    pub fn of(scene: &Scene, system: &PairMechanism) -> Self {
        Self::new(scene, system.options().free.map(|f| [f[0], f[1], f[2], f[3], f[4]]))
    }

    /// Of a scene alone.
    pub fn of_scene(scene: &Scene) -> Self {
        let free = scene.gears().map(|g| {
            let axes = g.body.as_ref().map_or(&[][..], |b| &b.free);
            Axis::ALL.map(|axis| axes.contains(&axis))
        });
        Self::new(scene, free)
    }

    /// The columns for a window of so many teeth.
    pub fn sheet(&self, window: usize) -> Sheet<MotionRows> {
        let reach = window as i64 / 2 + 1;
        MOTION_HISTORY.sheet(self, &(-reach..=reach).collect::<Vec<_>>())
    }

    fn any_free(&self, at: At) -> bool {
        self.free[at.gear].contains(&true)
    }

    /// Normal force of a pair by its number within the mesh cycle, N; 0 outside of the window.
    fn pair_force(&self, now: &Instant, pair: i64) -> f64 {
        let running = self.sense * (pair - cycle(now) as i64);
        let place = usize::try_from(running - now.first_pair).ok();
        place.and_then(|i| now.pair_forces.get(i)).copied().unwrap_or(0.0)
    }

    /// Where the largest pressure is.
    fn place(&self, now: &Instant) -> [f64; 3] {
        place_values(self.base_radius, now.slices.iter().map(|s| &s.slice))
    }
}

/// Whole mesh cycles. A row at the end of a cycle belongs to the next one, whatever the last bits say.
fn cycle(now: &Instant) -> f64 {
    (now.cycles + 1e-9).floor()
}

/// The stress is that of the driving flanks: no number where coast flanks press as well.
fn driving_alone(now: &Instant, stress: f64) -> f64 {
    if now.normal_forces[1] == 0.0 { stress } else { f64::NAN }
}

columns!(MotionRows, LEADING, |_, _| true, {
    TIME = "time_s" ["s"] "since the quasi-static start", |_, now, _| now.time;
    PINION_ANGLE = "pinion_angle_deg" ["deg"]
        "as above, of the nominal motion (a driver that a torque turns: its own)",
        |l, now, _| ((now.cycles - 0.5) * l.pitch).to_degrees();
    MESH_PHASE = "mesh_phase" [""] "as above, of the nominal motion likewise", |_, now, _| (now.cycles - cycle(now)).max(0.0);
    PINION_SPEED = "pinion_speed_rpm" ["1/min"] "about +z", |_, now, _| now.speeds[0] * 60.0 / TAU;
    WHEEL_SPEED = "wheel_speed_rpm" ["1/min"] "about +z", |_, now, _| now.speeds[1] * 60.0 / TAU;
    DTE = "dte_um" ["um"]
        "lag of the driven gear behind the nominal motion on its base circle: the dynamic transmission error. Unmodified rigid flanks just touching read 0, coast flanks minus the backlash. Displacements of the axes are in it: free bearings that give way let the driven gear lag",
        |_, now, _| 1e3 * now.transmission_error;
    DTE_RATE = "dte_rate_um_per_s" ["um/s"] "its rate", |_, now, _| 1e3 * now.transmission_error_rate;
    LINE_LENGTH = "contact_line_length_mm" ["mm"] "of the driving flanks, as at rest", |_, now, _| now.contact_line_length;
    PAIRS = "pairs_in_contact" [""] "as above, driving flanks",
        |_, now, _| now.pair_forces.iter().filter(|f| **f > 0.0).count() as f64;
});

columns!(MotionRows, WRENCH, |_, _| true, {
    FORCE_X = "<gear>_force_x_n" ["N"]
        "of the mesh on the gear, friction, damping and coast flanks included, fixed axes",
        |_, now, at| now.mesh[COORDINATES * at.gear];
    FORCE_Y = "<gear>_force_y_n" ["N"] "the same along y", |_, now, at| now.mesh[COORDINATES * at.gear + 1];
    FORCE_Z = "<gear>_force_z_n" ["N"] "the same along z: the axial force", |_, now, at| now.mesh[COORDINATES * at.gear + 2];
    MOMENT_X = "<gear>_moment_x_nmm" ["N mm"] "its moment about the displaced centre of the gear, fixed axes",
        |_, now, at| now.mesh[COORDINATES * at.gear + 3];
    MOMENT_Y = "<gear>_moment_y_nmm" ["N mm"] "the same about y: the tilting moment",
        |_, now, at| now.mesh[COORDINATES * at.gear + 4];
    MOMENT_Z = "<gear>_moment_z_nmm" ["N mm"] "the same about z", |_, now, at| now.mesh[COORDINATES * at.gear + 5];
});

columns!(MotionRows, SHARING, |_, _| true, {
    PAIR_FORCE = "normal_force_pair_<k>_n" ["N"] "as above, driving flanks, without damping",
        |l, now, at| l.pair_force(now, at.pair);
});

columns!(MotionRows, FREE, |l, at| l.any_free(at), {
    BEARING_FORCE_X = "<gear>_bearing_force_x_n" ["N"] "of the bearing on a gear that has free coordinates",
        |_, now, at| now.bearing[COORDINATES * at.gear];
    BEARING_FORCE_Y = "<gear>_bearing_force_y_n" ["N"] "the same along y",
        |_, now, at| now.bearing[COORDINATES * at.gear + 1];
    BEARING_FORCE_Z = "<gear>_bearing_force_z_n" ["N"] "the same along z",
        |_, now, at| now.bearing[COORDINATES * at.gear + 2];
    BEARING_MOMENT_X = "<gear>_bearing_moment_x_nmm" ["N mm"] "its moment about x",
        |_, now, at| now.bearing[COORDINATES * at.gear + 3];
    BEARING_MOMENT_Y = "<gear>_bearing_moment_y_nmm" ["N mm"] "its moment about y",
        |_, now, at| now.bearing[COORDINATES * at.gear + 4];
    DISPLACEMENT_X = "<gear>_x_um" ["um"] "displacement, where it is free",
        @ |l, at| l.free[at.gear][0], |_, now, at| now.displacement[COORDINATES * at.gear] * 1e3;
    DISPLACEMENT_Y = "<gear>_y_um" ["um"] "the same along y",
        @ |l, at| l.free[at.gear][1], |_, now, at| now.displacement[COORDINATES * at.gear + 1] * 1e3;
    DISPLACEMENT_Z = "<gear>_z_um" ["um"] "the same along z",
        @ |l, at| l.free[at.gear][2], |_, now, at| now.displacement[COORDINATES * at.gear + 2] * 1e3;
    TILT_X = "<gear>_tilt_x_urad" ["urad"] "turn about x, where it is free",
        @ |l, at| l.free[at.gear][3], |_, now, at| now.displacement[COORDINATES * at.gear + 3] * 1e6;
    TILT_Y = "<gear>_tilt_y_urad" ["urad"] "turn about y, where it is free",
        @ |l, at| l.free[at.gear][4], |_, now, at| now.displacement[COORDINATES * at.gear + 4] * 1e6;
});

columns!(MotionRows, TRAILING, |_, _| true, {
    NORMAL_FORCE = "normal_force_n" ["N"] "sum of the normal forces on the driving flanks, damping included",
        |_, now, _| now.normal_forces[0];
    COAST_FORCE = "coast_normal_force_n" ["N"] "the same on the coast flanks", |_, now, _| now.normal_forces[1];
    DRIVE_TORQUE = "drive_torque_nm" ["N m"]
        "of the driver in the running sense: the given one, or the one that keeps the given speed",
        |_, now, _| 1e-3 * now.drive_torque;
    LOAD_TORQUE = "load_torque_nm" ["N m"] "on the driven gear against its motion", |_, now, _| 1e-3 * now.load_torque;
    MAX_PRESSURE = "max_pressure_mpa" ["MPa"] "as above", |_, now, _| now.max_pressure;
    PRESSURE_PLACE = "max_pressure_place" [""] "as above", |l, now, _| l.place(now)[0];
    PRESSURE_Z = "max_pressure_z_mm" ["mm"] "as above", |l, now, _| l.place(now)[1];
    PRESSURE_DIAMETER = "max_pressure_pinion_diameter_mm" ["mm"] "as above", |l, now, _| l.place(now)[2];
    TOOTH_CHANGES = "tooth_changes" [""] "as above; changes count from the quasi-static start",
        |_, now, _| now.tooth_changes as f64;
});

columns!(MotionRows, ROOT_STRESS, |l, _| l.root_stress, {
    ROOT_TENSION = "<gear>_root_stress_max_principal_mpa" ["MPa"]
        "as above, under the elastic forces of the driving flanks; `NaN` in rows where coast flanks press as well",
        |_, now, at| driving_alone(now, MAX_PRINCIPAL.stress(&now.root_stress[at.gear], None));
    ROOT_COMPRESSION = "<gear>_root_stress_min_principal_mpa" ["MPa"] "likewise",
        |_, now, at| driving_alone(now, MIN_PRINCIPAL.stress(&now.root_stress[at.gear], None));
    ROOT_VON_MISES = "<gear>_root_stress_von_mises_mpa" ["MPa"] "likewise",
        |_, now, at| driving_alone(now, VON_MISES.stress(&now.root_stress[at.gear], None));
    ROOT_ERROR = "<gear>_root_stress_estimated_error_percent" ["%"] "likewise",
        |_, now, at| driving_alone(now, error_percent(&now.root_stress[at.gear]));
});

/// All columns of a motion of reduced gears.
pub const MOTION_HISTORY: Table<MotionRows> = Table {
    groups: &[
        Group { over: Over::File, columns: LEADING },
        Group { over: Over::Gears, columns: WRENCH },
        Group { over: Over::Pairs, columns: SHARING },
        Group { over: Over::Gears, columns: FREE },
        Group { over: Over::File, columns: TRAILING },
        Group { over: Over::Gears, columns: ROOT_STRESS },
    ],
};
