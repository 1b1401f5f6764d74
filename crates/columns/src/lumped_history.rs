//! `history.csv` and `section.csv` of a cheaper model in motion: one row a step of output.

use std::f64::consts::TAU;

use analysis::lumped::{CoordinateAxis, GearCoordinate, LumpedQuantity, LumpedRow, gear_coordinates};
use answer::{RowStore, TableError};
use scene::{Model, Scene};
use study::Columns;

use super::{At, Group, Over, Rows, Sheet, Table, columns};

/// Rows of a cheaper model.
#[derive(Debug)]
pub struct LumpedRows;

impl Rows for LumpedRows {
    type Layout = LumpedLayout;
    type Record = LumpedRow;

    fn gear_order(layout: &LumpedLayout) -> [usize; 2] {
        // That of the model's coordinates.
        if layout.coordinates.first().is_some_and(|c| c.gear == 1) { [1, 0] } else { [0, 1] }
    }
}

/// What all rows of a cheaper model share.
#[derive(Debug, Clone, PartialEq)]
pub struct LumpedLayout {
    model: Model,
    coordinates: Vec<GearCoordinate>,
}

impl LumpedLayout {
    /// Layout of a scene's history.
    pub fn of(scene: &Scene) -> Self {
        Self { model: scene.analysis.model, coordinates: gear_coordinates(scene) }
    }

    /// The columns.
    pub fn sheet(&self) -> Sheet<LumpedRows> {
        LUMPED_HISTORY.sheet(self, &[])
    }

    /// Lumped gears, as against shafts and rigid gears.
    fn is_gears(&self) -> bool {
        matches!(self.model, Model::Lumped8 | Model::Lumped12)
    }

    fn is_shafts(&self) -> bool {
        self.model == Model::Shaft18
    }

    fn is_rigid(&self) -> bool {
        self.model == Model::Impact
    }

    /// Flanks on either side of the teeth, each with its own force.
    fn has_flanks(&self) -> bool {
        self.model == Model::Impact || self.model.has_reduced_gears()
    }

    fn place(&self, at: At, axis: CoordinateAxis) -> Option<usize> {
        self.coordinates.iter().position(|c| *c == GearCoordinate { gear: at.gear, axis })
    }

    fn has(&self, at: At, axis: CoordinateAxis) -> bool {
        self.place(at, axis).is_some()
    }

    /// A coordinate or its rate; NaN for one that the model has not.
    fn coordinate(&self, list: &[f64], at: At, axis: CoordinateAxis) -> f64 {
        self.place(at, axis).and_then(|i| list.get(i)).copied().unwrap_or(f64::NAN)
    }
}

/// The rows of a scene as columns by name, for charts and studies of any analysis.
///
/// # Errors
/// [`TableError::Kept`] where rows cannot be read back.
pub fn lumped_columns(scene: &Scene, rows: &RowStore<LumpedRow>) -> Result<Columns, TableError> {
    let layout = LumpedLayout::of(scene);
    layout.sheet().columns(&layout, rows)
}

/// The column of that name as a quantity of rows; `None` where a scene's model has no such column.
pub fn lumped_quantity(scene: &Scene, name: &str) -> Option<LumpedQuantity> {
    let layout = LumpedLayout::of(scene);
    let (column, at) = layout.sheet().find(name)?;
    Some(LumpedQuantity::new(name, move |row| (column.value)(&layout, row, at)))
}

/// A number that a model may not tell.
fn or_none(value: Option<f64>) -> f64 {
    value.unwrap_or(f64::NAN)
}

columns!(LumpedRows, LEADING, |_, _| true, {
    TIME = "time_s" ["s"] "time since the start", |_, row, _| row.time;
    MESH_CYCLES = "mesh_cycles" [""] "mesh cycles since the start (shaft18)",
        @ |l, _| l.is_shafts(), |_, row, _| or_none(row.mesh_cycles);
    PINION_ANGLE = "pinion_angle_deg" ["deg"] "angle of the pinion in the sense of rotation (not of shaft18)",
        @ |l, _| !l.is_shafts(), |_, row, _| or_none(row.pinion_angle).to_degrees();
    MESH_PHASE = "mesh_phase" [""] "phase of the mesh cycle, 0 .. 1", |_, row, _| row.mesh_phase;
    PINION_SPEED = "pinion_speed_rpm" ["1/min"] "speed of the gear about +z (impact, mapped)",
        @ |l, _| l.has_flanks(), |_, row, _| or_none(row.speeds.map(|s| s[0])) * 60.0 / TAU;
    WHEEL_SPEED = "wheel_speed_rpm" ["1/min"] "speed of the gear about +z (impact, mapped)",
        @ |l, _| l.has_flanks(), |_, row, _| or_none(row.speeds.map(|s| s[1])) * 60.0 / TAU;
    DTE = "dte_um" ["um"] "dynamic transmission error (DTE): lag of the driven gear on its base circle", |_, row, _| row.transmission_error_um;
    DEFLECTION = "mesh_deflection_um" ["um"]
        "displacement of the flanks on the transverse line of action: transmission error and deflection of the supports (lumped8, lumped12)",
        @ |l, _| l.is_gears(), |_, row, _| 1e3 * or_none(row.mesh_deflection);
    STIFFNESS = "mesh_stiffness_n_per_um" ["N/um"] "stiffness on the transverse line of action (lumped8, lumped12)",
        @ |l, _| l.is_gears(), |_, row, _| 1e-3 * or_none(row.mesh_stiffness);
    COMPRESSION = "compression_um" ["um"]
        "compression of the mesh along the normal: everything that moves the flanks against each other (shaft18)",
        @ |l, _| l.is_shafts(), |_, row, _| 1e3 * or_none(row.compression.map(|c| c[0]));
    COMPRESSION_RATE = "compression_rate_um_per_s" ["um/s"] "rate of `compression_um` (shaft18)",
        @ |l, _| l.is_shafts(), |_, row, _| 1e3 * or_none(row.compression.map(|c| c[1]));
    NORMAL_STIFFNESS = "normal_mesh_stiffness_n_per_um" ["N/um"] "stiffness along the normal (shaft18)",
        @ |l, _| l.is_shafts(), |_, row, _| 1e-3 * or_none(row.normal_mesh_stiffness);
    LINE_LENGTH = "contact_line_length_mm" ["mm"]
        "contact-line length, 0 where the flanks are apart; of `impact` that of the overlapping slices, tip edges included (not of shaft18)",
        @ |l, _| !l.is_shafts(), |_, row, _| or_none(row.contact_line_length);
    PAIRS = "pairs_in_contact" [""] "tooth pairs whose driving flanks carry load (impact)",
        @ |l, _| l.is_rigid(), |_, row, _| or_none(row.pairs_in_contact.map(|n| n as f64));
    NORMAL_FORCE = "normal_force_n" ["N"]
        "sum of the normal forces on the driving flanks; of a lumped mesh negative on the coast flanks, and where a linear mesh pulls",
        |_, row, _| row.normal_force;
    FRICTION_FORCE = "friction_force_n" ["N"] "friction force on the driver across the line of action (lumped8, lumped12)",
        @ |l, _| l.is_gears(), |_, row, _| or_none(row.friction_force);
    COAST_FORCE = "coast_normal_force_n" ["N"] "sum of the normal forces on the coast flanks (impact, mapped)",
        @ |l, _| l.has_flanks(), |_, row, _| or_none(row.coast_normal_force);
    LEAST_FORCE = "least_slice_force_n" ["N"] "smallest normal force of a slice in contact (impact)",
        @ |l, _| l.is_rigid(), |_, row, _| or_none(row.least_slice_force);
    OVERLAP = "overlap_um" ["um"] "deepest overlap of the driving flanks (impact)",
        @ |l, _| l.is_rigid(), |_, row, _| 1e3 * or_none(row.overlap.map(|o| o[0]));
    COAST_OVERLAP = "coast_overlap_um" ["um"] "deepest overlap of the coast flanks (impact)",
        @ |l, _| l.is_rigid(), |_, row, _| 1e3 * or_none(row.overlap.map(|o| o[1]));
    LARGEST_FORCE = "largest_pair_force_n" ["N"] "largest normal force of a pair (impact)",
        @ |l, _| l.is_rigid(), |_, row, _| or_none(row.largest_pair_force);
});

columns!(LumpedRows, WRENCH, |_, _| true, {
    FORCE_X = "<gear>_force_x_n" ["N"] "x component of the mesh force on the gear, fixed axes", |_, row, at| row.wrench[at.gear][0];
    FORCE_Y = "<gear>_force_y_n" ["N"] "y component of the mesh force on the gear, fixed axes", |_, row, at| row.wrench[at.gear][1];
    FORCE_Z = "<gear>_force_z_n" ["N"] "z component of the mesh force on the gear, the axial force", |_, row, at| row.wrench[at.gear][2];
    MOMENT_X = "<gear>_moment_x_nmm" ["N mm"] "x component of the mesh moment on the gear about its centre, fixed axes",
        |_, row, at| row.wrench[at.gear][3];
    MOMENT_Y = "<gear>_moment_y_nmm" ["N mm"] "y component of the mesh moment on the gear, the tilting moment", |_, row, at| row.wrench[at.gear][4];
    MOMENT_Z = "<gear>_moment_z_nmm" ["N mm"] "z component of the mesh moment on the gear", |_, row, at| row.wrench[at.gear][5];
});

/// Friction's part of a component of the wrench.
fn friction(row: &LumpedRow, at: At, component: usize) -> f64 {
    or_none(row.friction_wrench.as_ref().map(|w| w[at.gear][component]))
}

columns!(LumpedRows, FRICTION, |l, _| l.is_rigid(), {
    FRICTION_FORCE_X = "<gear>_friction_force_x_n" ["N"] "friction in `<gear>_force_x_n` (impact)",
        |_, row, at| friction(row, at, 0);
    FRICTION_FORCE_Y = "<gear>_friction_force_y_n" ["N"] "friction in `<gear>_force_y_n` (impact)", |_, row, at| friction(row, at, 1);
    FRICTION_FORCE_Z = "<gear>_friction_force_z_n" ["N"] "friction in `<gear>_force_z_n` (impact)", |_, row, at| friction(row, at, 2);
    FRICTION_MOMENT_X = "<gear>_friction_moment_x_nmm" ["N mm"] "friction in `<gear>_moment_x_nmm` (impact)",
        |_, row, at| friction(row, at, 3);
    FRICTION_MOMENT_Y = "<gear>_friction_moment_y_nmm" ["N mm"] "friction in `<gear>_moment_y_nmm` (impact)",
        |_, row, at| friction(row, at, 4);
    FRICTION_MOMENT_Z = "<gear>_friction_moment_z_nmm" ["N mm"] "friction in `<gear>_moment_z_nmm` (impact)",
        |_, row, at| friction(row, at, 5);
});

columns!(LumpedRows, DISPLACEMENTS, |_, _| true, {
    ACROSS = "<gear>_across_um" ["um"] "displacement across the line of action (lumped8)",
        @ |l, at| l.has(at, CoordinateAxis::Across),
        |l, row, at| 1e3 * l.coordinate(&row.displacement, at, CoordinateAxis::Across);
    ALONG = "<gear>_along_um" ["um"] "displacement along the line of action (lumped8)",
        @ |l, at| l.has(at, CoordinateAxis::Along),
        |l, row, at| 1e3 * l.coordinate(&row.displacement, at, CoordinateAxis::Along);
    X = "<gear>_x_um" ["um"] "displacement along x (lumped12, shaft18)",
        @ |l, at| l.has(at, CoordinateAxis::X),
        |l, row, at| 1e3 * l.coordinate(&row.displacement, at, CoordinateAxis::X);
    Y = "<gear>_y_um" ["um"] "displacement along y (lumped12, shaft18)",
        @ |l, at| l.has(at, CoordinateAxis::Y),
        |l, row, at| 1e3 * l.coordinate(&row.displacement, at, CoordinateAxis::Y);
    Z = "<gear>_z_um" ["um"] "displacement along the axis (not of impact)",
        @ |l, at| l.has(at, CoordinateAxis::Z),
        |l, row, at| 1e3 * l.coordinate(&row.displacement, at, CoordinateAxis::Z);
    TILT_X = "<gear>_tilt_x_urad" ["urad"] "tilt about x (lumped12, shaft18)",
        @ |l, at| l.has(at, CoordinateAxis::TiltX),
        |l, row, at| 1e6 * l.coordinate(&row.displacement, at, CoordinateAxis::TiltX);
    TILT_Y = "<gear>_tilt_y_urad" ["urad"] "tilt about y (lumped12, shaft18)",
        @ |l, at| l.has(at, CoordinateAxis::TiltY),
        |l, row, at| 1e6 * l.coordinate(&row.displacement, at, CoordinateAxis::TiltY);
    TURN = "<gear>_turn_urad" ["urad"] "rotation about the axis beyond the nominal one (not of impact)",
        @ |l, at| l.has(at, CoordinateAxis::Turn),
        |l, row, at| 1e6 * l.coordinate(&row.displacement, at, CoordinateAxis::Turn);
});

columns!(LumpedRows, RATES, |_, _| true, {
    ACROSS_RATE = "<gear>_across_rate_um_per_s" ["um/s"] "rate of `<gear>_across_um`",
        @ |l, at| l.has(at, CoordinateAxis::Across),
        |l, row, at| 1e3 * l.coordinate(&row.velocity, at, CoordinateAxis::Across);
    ALONG_RATE = "<gear>_along_rate_um_per_s" ["um/s"] "rate of `<gear>_along_um`",
        @ |l, at| l.has(at, CoordinateAxis::Along),
        |l, row, at| 1e3 * l.coordinate(&row.velocity, at, CoordinateAxis::Along);
    X_RATE = "<gear>_x_rate_um_per_s" ["um/s"] "rate of `<gear>_x_um`",
        @ |l, at| l.has(at, CoordinateAxis::X),
        |l, row, at| 1e3 * l.coordinate(&row.velocity, at, CoordinateAxis::X);
    Y_RATE = "<gear>_y_rate_um_per_s" ["um/s"] "rate of `<gear>_y_um`",
        @ |l, at| l.has(at, CoordinateAxis::Y),
        |l, row, at| 1e3 * l.coordinate(&row.velocity, at, CoordinateAxis::Y);
    Z_RATE = "<gear>_z_rate_um_per_s" ["um/s"] "rate of `<gear>_z_um`",
        @ |l, at| l.has(at, CoordinateAxis::Z),
        |l, row, at| 1e3 * l.coordinate(&row.velocity, at, CoordinateAxis::Z);
    TILT_X_RATE = "<gear>_tilt_x_rate_urad_per_s" ["urad/s"] "rate of `<gear>_tilt_x_urad`",
        @ |l, at| l.has(at, CoordinateAxis::TiltX),
        |l, row, at| 1e6 * l.coordinate(&row.velocity, at, CoordinateAxis::TiltX);
    TILT_Y_RATE = "<gear>_tilt_y_rate_urad_per_s" ["urad/s"] "rate of `<gear>_tilt_y_urad`",
        @ |l, at| l.has(at, CoordinateAxis::TiltY),
        |l, row, at| 1e6 * l.coordinate(&row.velocity, at, CoordinateAxis::TiltY);
    TURN_RATE = "<gear>_turn_rate_urad_per_s" ["urad/s"] "rate of `<gear>_turn_urad`",
        @ |l, at| l.has(at, CoordinateAxis::Turn),
        |l, row, at| 1e6 * l.coordinate(&row.velocity, at, CoordinateAxis::Turn);
});

/// All columns of a cheaper model.
pub const LUMPED_HISTORY: Table<LumpedRows> = Table {
    groups: &[
        Group { over: Over::File, columns: LEADING },
        Group { over: Over::Gears, columns: WRENCH },
        Group { over: Over::Gears, columns: FRICTION },
        Group { over: Over::GearsInOrder, columns: DISPLACEMENTS },
        Group { over: Over::GearsInOrder, columns: RATES },
    ],
};
