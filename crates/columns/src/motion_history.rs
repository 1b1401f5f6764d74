//! `history.csv` of a motion of reduced gears: one row a step of output.

use analysis::motion::{BearingRow, MotionLayout, MotionRow, RootStressRow};

use super::{At, Group, Over, Rows, Table, columns};

/// Rows of a motion of reduced gears.
#[derive(Debug)]
pub struct MotionRows;

impl Rows for MotionRows {
    type Layout = MotionLayout;
    type Record = MotionRow;
}

/// A number of a gear's bearing; none where it has no free coordinates.
fn bearing(row: &MotionRow, at: At, value: impl Fn(&BearingRow) -> f64) -> f64 {
    row.bearing[at.gear].as_deref().map_or(f64::NAN, value)
}

/// A root stress; none where the scene asks for none.
fn root(row: &MotionRow, at: At, value: impl Fn(&RootStressRow) -> f64) -> f64 {
    row.root_stress.as_ref().map_or(f64::NAN, |both| value(&both[at.gear]))
}

columns!(MotionRows, LEADING, |_, _| true, {
    TIME = "time_s" ["s"] "time since the quasi-static start", |_, row, _| row.time_s;
    PINION_ANGLE = "pinion_angle_deg" ["deg"]
        "angle of the pinion in the nominal motion, in the sense of rotation; with a driving torque the angle of the driver's own motion",
        |_, row, _| row.pinion_angle_deg;
    MESH_PHASE = "mesh_phase" [""] "phase of the mesh cycle in the nominal motion, 0 .. 1; with a driving torque in the driver's own motion", |_, row, _| row.mesh_phase;
    PINION_SPEED = "pinion_speed_rpm" ["1/min"] "speed of the pinion about +z", |_, row, _| row.speed_rpm[0];
    WHEEL_SPEED = "wheel_speed_rpm" ["1/min"] "speed of the wheel about +z", |_, row, _| row.speed_rpm[1];
    DTE = "dte_um" ["um"]
        "dynamic transmission error (DTE): lag of the driven gear behind the nominal motion on its base circle. Unmodified rigid flanks that just touch read 0, coast flanks minus the backlash. Displacements of the axes are included",
        |_, row, _| row.dte_um;
    DTE_RATE = "dte_rate_um_per_s" ["um/s"] "rate of the dynamic transmission error", |_, row, _| row.dte_rate_um_per_s;
    LINE_LENGTH = "contact_line_length_mm" ["mm"] "total contact-line length of the driving flanks, from the deformed gaps under load", |_, row, _| row.contact_line_length_mm;
    PAIRS = "pairs_in_contact" [""] "tooth pairs whose driving flanks carry load",
        |_, row, _| f64::from(row.pairs_in_contact);
});

columns!(MotionRows, WRENCH, |_, _| true, {
    FORCE_X = "<gear>_force_x_n" ["N"]
        "x component of the mesh force on the gear, friction, damping and coast flanks included, fixed axes",
        |_, row, at| row.force_n[at.gear][0];
    FORCE_Y = "<gear>_force_y_n" ["N"] "y component of the mesh force on the gear, fixed axes", |_, row, at| row.force_n[at.gear][1];
    FORCE_Z = "<gear>_force_z_n" ["N"] "z component of the mesh force on the gear, the axial force", |_, row, at| row.force_n[at.gear][2];
    MOMENT_X = "<gear>_moment_x_nmm" ["N mm"] "x component of the mesh moment on the gear about its displaced centre, fixed axes",
        |_, row, at| row.moment_nmm[at.gear][0];
    MOMENT_Y = "<gear>_moment_y_nmm" ["N mm"] "y component of the mesh moment on the gear, the tilting moment",
        |_, row, at| row.moment_nmm[at.gear][1];
    MOMENT_Z = "<gear>_moment_z_nmm" ["N mm"] "z component of the mesh moment on the gear", |_, row, at| row.moment_nmm[at.gear][2];
});

columns!(MotionRows, SHARING, |_, _| true, {
    PAIR_FORCE = "normal_force_pair_<k>_n" ["N"] "normal force on the driving flanks of a tooth pair, without damping; numbered as at rest",
        |_, row, at| row.pair_force_n(at.pair);
});

columns!(MotionRows, FREE, |l, at| l.free(at.gear).contains(&true), {
    BEARING_FORCE_X = "<gear>_bearing_force_x_n" ["N"] "x component of the force of the bearing on a gear that has free coordinates",
        |_, row, at| bearing(row, at, |b| b.force_n[0]);
    BEARING_FORCE_Y = "<gear>_bearing_force_y_n" ["N"] "y component of the bearing force on the gear",
        |_, row, at| bearing(row, at, |b| b.force_n[1]);
    BEARING_FORCE_Z = "<gear>_bearing_force_z_n" ["N"] "z component of the bearing force on the gear",
        |_, row, at| bearing(row, at, |b| b.force_n[2]);
    BEARING_MOMENT_X = "<gear>_bearing_moment_x_nmm" ["N mm"] "moment of the bearing on the gear about x",
        |_, row, at| bearing(row, at, |b| b.moment_nmm[0]);
    BEARING_MOMENT_Y = "<gear>_bearing_moment_y_nmm" ["N mm"] "moment of the bearing on the gear about y",
        |_, row, at| bearing(row, at, |b| b.moment_nmm[1]);
    DISPLACEMENT_X = "<gear>_x_um" ["um"] "displacement of the gear along x, where it is free",
        @ |l, at| l.free(at.gear)[0], |_, row, at| bearing(row, at, |b| b.displacement_um[0]);
    DISPLACEMENT_Y = "<gear>_y_um" ["um"] "displacement of the gear along y, where it is free",
        @ |l, at| l.free(at.gear)[1], |_, row, at| bearing(row, at, |b| b.displacement_um[1]);
    DISPLACEMENT_Z = "<gear>_z_um" ["um"] "displacement of the gear along its axis, where it is free",
        @ |l, at| l.free(at.gear)[2], |_, row, at| bearing(row, at, |b| b.displacement_um[2]);
    TILT_X = "<gear>_tilt_x_urad" ["urad"] "tilt of the gear about x, where it is free",
        @ |l, at| l.free(at.gear)[3], |_, row, at| bearing(row, at, |b| b.tilt_urad[0]);
    TILT_Y = "<gear>_tilt_y_urad" ["urad"] "tilt of the gear about y, where it is free",
        @ |l, at| l.free(at.gear)[4], |_, row, at| bearing(row, at, |b| b.tilt_urad[1]);
});

columns!(MotionRows, TRAILING, |_, _| true, {
    NORMAL_FORCE = "normal_force_n" ["N"] "sum of the normal forces on the driving flanks, damping included",
        |_, row, _| row.normal_force_n;
    COAST_FORCE = "coast_normal_force_n" ["N"] "sum of the normal forces on the coast flanks, damping included", |_, row, _| row.coast_normal_force_n;
    DRIVE_TORQUE = "drive_torque_nm" ["N m"]
        "torque of the driver in the sense of rotation: the given one, or the one that keeps the given speed",
        |_, row, _| row.drive_torque_nm;
    LOAD_TORQUE = "load_torque_nm" ["N m"] "torque on the driven gear against its motion", |_, row, _| row.load_torque_nm;
    MAX_PRESSURE = "max_pressure_mpa" ["MPa"] "largest Hertzian pressure of the driving flanks", |_, row, _| row.max_pressure_mpa;
    PRESSURE_PLACE = "max_pressure_place" [""] "place of the largest pressure: 1 flank, 2 a slice that ends at an end face, 3 tip edge of the pinion, 4 tip edge of the wheel; 0 without load", |_, row, _| row.max_pressure_at.map_or(0.0, |at| at.site_number() as f64);
    PRESSURE_Z = "max_pressure_z_mm" ["mm"] "height of the place on the pinion; `NaN` without load", |_, row, _| row.max_pressure_at.map_or(f64::NAN, |at| at.z_mm);
    PRESSURE_DIAMETER = "max_pressure_pinion_diameter_mm" ["mm"] "diameter of the place on the pinion; `NaN` without load", |_, row, _| row.max_pressure_at.map_or(f64::NAN, |at| at.pinion_diameter_mm);
    TOOTH_CHANGES = "tooth_changes" [""] "tooth changes of the window since the quasi-static start",
        |_, row, _| row.tooth_changes as f64;
});

columns!(MotionRows, ROOT_STRESS, |l, _| l.has_root_stress(), {
    ROOT_TENSION = "<gear>_root_stress_max_principal_mpa" ["MPa"]
        "largest first principal stress in any fillet of the window, under the elastic forces of the driving flanks; `NaN` in rows where coast flanks press as well",
        |_, row, at| root(row, at, |r| r.max_principal_mpa);
    ROOT_COMPRESSION = "<gear>_root_stress_min_principal_mpa" ["MPa"] "smallest third principal stress in the fillets of the window",
        |_, row, at| root(row, at, |r| r.min_principal_mpa);
    ROOT_VON_MISES = "<gear>_root_stress_von_mises_mpa" ["MPa"] "largest von Mises stress in the fillets of the window",
        |_, row, at| root(row, at, |r| r.von_mises_mpa);
    ROOT_ERROR = "<gear>_root_stress_estimated_error_percent" ["%"] "estimated distance of the largest tension from that of an infinitely fine mesh",
        |_, row, at| root(row, at, |r| r.estimated_error_percent);
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
