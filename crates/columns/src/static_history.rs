//! `history.csv` of a run at rest: one row a position.

use analysis::{
    Derivatives,
    results::{MAX_PRINCIPAL, MIN_PRINCIPAL, Measure, VON_MISES, base_radius_mm, error_percent, pairs, place_values},
};
use std::f64::consts::PI;

use ltca::{StaticHistory, StaticPosition};
use scene::Scene;
use study::Columns;

use super::{At, Column, Group, Over, Rows, Table, columns, derivatives};

/// Rows of a run at rest.
#[derive(Debug)]
pub struct StaticRows;

impl Rows for StaticRows {
    type Layout = StaticLayout;
    type Record = StaticPosition;
}

/// What all rows of a run at rest share.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StaticLayout {
    /// Pinion angle of the first position, rad.
    start: f64,
    /// Speed of the pinion, rad/s.
    speed: f64,
    /// Pitch angle of the pinion, rad.
    pitch: f64,
    /// Base radius of the pinion, mm.
    base_radius: f64,
    slices: bool,
    root_stress: bool,
}

impl StaticLayout {
    /// Layout of a scene's rows, the first of them at this pinion angle, rad.
    fn new(scene: &Scene, start: f64) -> Self {
        Self {
            start,
            speed: scene.pinion_speed(),
            pitch: 2.0 * PI / f64::from(scene.pinion.teeth),
            base_radius: base_radius_mm(scene, 0),
            slices: scene.has_slices(),
            root_stress: scene.output.root_stress,
        }
    }

    /// Layout of a solved history.
    pub fn of(scene: &Scene, history: &StaticHistory) -> Self {
        Self::new(scene, history.positions.first().map_or(0.0, |p| p.pinion_angle))
    }

    /// Pitch angle of the pinion, rad.
    pub fn pitch(&self) -> f64 {
        self.pitch
    }

    /// Where the largest pressure of a position is.
    fn place(&self, p: &StaticPosition) -> [f64; 3] {
        place_values(self.base_radius, p.pairs.iter().flat_map(|pair| &pair.slices))
    }

    /// The worst stress in the fillets of a gear's tooth of a pair, MPa; NaN where the pair is not in the window.
    fn tooth_stress(&self, p: &StaticPosition, at: At, measure: Measure) -> f64 {
        let teeth = pairs::teeth(p, at.pair, self.pitch);
        teeth.map_or(f64::NAN, |teeth| measure.stress(&p.root_stress[at.gear], Some(teeth[at.gear])))
    }
}

columns!(StaticRows, LEADING, |_, _| true, {
    TIME = "time_s" ["s"] "time since the first position, from `speed_rpm`", |l, p, _| (p.pinion_angle - l.start) / l.speed;
    PINION_ANGLE = "pinion_angle_deg" ["deg"]
        "angle of the pinion in the sense of rotation; 0 where pair 0 touches the middle of the path of contact, in the middle of the common face",
        |_, p, _| p.pinion_angle.to_degrees();
    MESH_PHASE = "mesh_phase" [""] "phase of the mesh cycle, 0 .. 1; 0.5 at pinion angle 0", |_, p, _| p.mesh_phase;
    STE = "ste_um" ["um"]
        "static transmission error (STE) on the transverse line of action, positive when the driven gear lags; 0 where the unmodified flanks would touch with parallel axes",
        |_, p, _| p.transmission_error * 1e3;
    KINEMATIC_TE = "kinematic_te_um" ["um"]
        "no-load transmission error, of micro-geometry, pitch errors and misalignment alone; 0 as of `ste_um`",
        |_, p, _| p.kinematic_transmission_error * 1e3;
    SECANT_STIFFNESS = "mesh_stiffness_n_per_um" ["N/um"] "secant mesh stiffness F_bt / (STE - no-load transmission error)",
        |_, p, _| p.secant_stiffness * 1e-3;
    TANGENT_STIFFNESS = "mesh_stiffness_tangent_n_per_um" ["N/um"] "tangent mesh stiffness dF_bt / dSTE",
        |_, p, _| p.tangent_stiffness * 1e-3;
    LINE_LENGTH = "contact_line_length_mm" ["mm"]
        "total contact-line length from the deformed gaps under load; contact beyond the nominal path included",
        |_, p, _| p.contact_line_length;
    GEOMETRIC_LENGTH = "geometric_line_length_mm" ["mm"] "total contact-line length of the unloaded pair, analytic",
        |_, p, _| p.geometric_line_length;
    PAIRS = "pairs_in_contact" [""] "tooth pairs that carry load",
        |_, p, _| p.pairs.iter().filter(|pair| pair.normal_force > 0.0).count() as f64;
});

columns!(StaticRows, WRENCH, |_, _| true, {
    FORCE_X = "<gear>_force_x_n" ["N"] "x component of the mesh force on the gear, fixed axes", |_, p, at| p.wrench[at.gear].force[0];
    FORCE_Y = "<gear>_force_y_n" ["N"] "y component of the mesh force on the gear, fixed axes", |_, p, at| p.wrench[at.gear].force[1];
    FORCE_Z = "<gear>_force_z_n" ["N"] "z component of the mesh force on the gear, the axial force", |_, p, at| p.wrench[at.gear].force[2];
    MOMENT_X = "<gear>_moment_x_nmm" ["N mm"] "x component of the mesh moment on the gear about its own centre, fixed axes",
        |_, p, at| p.wrench[at.gear].moment[0];
    MOMENT_Y = "<gear>_moment_y_nmm" ["N mm"] "y component of the mesh moment on the gear, the tilting moment",
        |_, p, at| p.wrench[at.gear].moment[1];
    MOMENT_Z = "<gear>_moment_z_nmm" ["N mm"] "z component of the mesh moment on the gear", |_, p, at| p.wrench[at.gear].moment[2];
});

columns!(StaticRows, SHARING, |_, _| true, {
    PAIR_FORCE = "normal_force_pair_<k>_n" ["N"]
        "normal force of a tooth pair: pair 0 passes the middle of its path during this cycle, 1 is one pitch ahead in the sense of rotation, -1 one behind",
        |l, p, at| pairs::force(p, at.pair, l.pitch);
});

columns!(StaticRows, TRAILING, |_, _| true, {
    MAX_PRESSURE = "max_pressure_mpa" ["MPa"]
        "largest Hertzian pressure of any slice; of points from the line load over axial bins of one and a half elements and the curvatures of the exact flanks ([theory](theory.md), equation 22), good to some ten per cent on coarse meshes",
        |_, p, _| p.max_pressure;
    PRESSURE_PLACE = "max_pressure_place" [""]
        "place of the largest pressure: 1 flank, 2 a slice that ends at an end face, 3 tip edge of the pinion, 4 tip edge of the wheel (it presses off the line of action, or lies within the band); 0 without load; models with slices",
        @ |l, _| l.slices, |l, p, _| l.place(p)[0];
    PRESSURE_Z = "max_pressure_z_mm" ["mm"] "height of the place on the pinion; `NaN` without load; models with slices",
        @ |l, _| l.slices, |l, p, _| l.place(p)[1];
    PRESSURE_DIAMETER = "max_pressure_pinion_diameter_mm" ["mm"] "diameter of the place on the pinion; `NaN` without load; models with slices",
        @ |l, _| l.slices, |l, p, _| l.place(p)[2];
    STRAIN_ENERGY = "strain_energy_nmm" ["N mm"] "strain energy of both gears", |_, p, _| p.strain_energy;
    FRICTION_LOSS = "friction_power_loss_w" ["W"]
        "power lost to friction at the scene's speed", |l, p, _| 1e-3 * p.friction_work * l.speed;
    TOOTH_CHANGES = "tooth_changes" [""] "tooth changes of the window since the start",
        |_, p, _| p.tooth_changes as f64;
    TORQUE_RESIDUAL = "torque_residual" [""] "relative difference of contact torque and applied torque",
        |_, p, _| p.certificate.torque_residual;
    COMPLEMENTARITY_RESIDUAL = "complementarity_residual" [""]
        "relative violation of gap >= 0, pressure >= 0, one of them zero",
        |_, p, _| p.certificate.complementarity_residual;
    ACTION_REACTION_RESIDUAL = "action_reaction_residual" [""]
        "relative difference of the forces on pinion and wheel", |_, p, _| p.certificate.action_reaction_residual;
    WINDOW_EDGE_LOAD = "window_edge_load" [""]
        "share of the load on the more loaded end pair of the window; with the smallest window 0.5 is usual. A window that is too small ends the run with a message",
        |_, p, _| p.certificate.window_edge_load;
    ITERATIONS = "iterations" [""] "iterations of the contact solver", |_, p, _| p.certificate.iterations as f64;
});

columns!(StaticRows, ROOT_STRESS, |l, _| l.root_stress, {
    ROOT_TENSION = "<gear>_root_stress_max_principal_mpa" ["MPa"]
        "largest first principal stress (tension) in any fillet of the window's teeth; with `root_stress = true` ([theory](theory.md), equations 22a, 22c)",
        |_, p, at| MAX_PRINCIPAL.stress(&p.root_stress[at.gear], None);
    ROOT_COMPRESSION = "<gear>_root_stress_min_principal_mpa" ["MPa"]
        "smallest third principal stress (compression, negative) in the fillets of the window; with `root_stress = true`",
        |_, p, at| MIN_PRINCIPAL.stress(&p.root_stress[at.gear], None);
    ROOT_VON_MISES = "<gear>_root_stress_von_mises_mpa" ["MPa"] "largest von Mises stress in the fillets of the window; with `root_stress = true`",
        |_, p, at| VON_MISES.stress(&p.root_stress[at.gear], None);
    ROOT_ERROR = "<gear>_root_stress_estimated_error_percent" ["%"]
        "estimated distance of the largest tension from that of an infinitely fine mesh: a share of the difference between two recoveries, and the error that both share by the rotation of the surface within one face; a remark tells of more than 3 % in the largest of the run",
        |_, p, at| error_percent(&p.root_stress[at.gear]);
});

columns!(StaticRows, TOOTH_STRESS, |l, _| l.root_stress, {
    TOOTH_TENSION = "<gear>_root_stress_max_principal_pair_<k>_mpa" ["MPa"]
        "largest first principal stress in both fillets of this gear's tooth of pair k (numbered as `normal_force_pair_<k>_n`); `NaN` where the pair is not in the window",
        |l, p, at| l.tooth_stress(p, at, MAX_PRINCIPAL);
    TOOTH_VON_MISES = "<gear>_root_stress_von_mises_pair_<k>_mpa" ["MPa"] "largest von Mises stress in both fillets of this gear's tooth of pair k",
        |l, p, at| l.tooth_stress(p, at, VON_MISES);
});

/// All columns of a run at rest.
pub const STATIC_HISTORY: Table<StaticRows> = Table {
    groups: &[
        Group { over: Over::File, columns: LEADING },
        Group { over: Over::Gears, columns: WRENCH },
        Group { over: Over::Pairs, columns: SHARING },
        Group { over: Over::File, columns: TRAILING },
        Group { over: Over::Gears, columns: ROOT_STRESS },
        Group { over: Over::GearsAndPairs, columns: TOOTH_STRESS },
    ],
};

/// The history as the table `history`; behind its columns derivatives, where there are such.
///
/// Time starts with the first position. `NaN` stands where a quantity has no value (stiffness without load).
pub fn history_table(scene: &Scene, history: &StaticHistory, derivatives: Option<&Derivatives>) -> answer::Table {
    let layout = StaticLayout::of(scene, history);
    let numbers = pairs::columns(history, layout.pitch);
    let mut table = STATIC_HISTORY.sheet(&layout, &numbers).table("history", &layout, &history.positions);
    let Some(rates) = derivatives else { return table };
    let rows: Vec<Vec<f64>> = (history.positions.iter().enumerate())
        .map(|(i, position)| derivatives::row(rates, i, position, &numbers, layout.pitch))
        .collect();
    for (k, (name, meaning)) in derivatives::named(&rates.keys, &numbers).into_iter().enumerate() {
        table.push_numbers(name, meaning, rows.iter().map(|row| row[k]));
    }
    table
}

/// Columns of a history by name.
pub fn history_rows(scene: &Scene, history: &StaticHistory, derivatives: Option<&Derivatives>) -> Columns {
    let layout = StaticLayout::of(scene, history);
    let numbers = pairs::columns(history, layout.pitch);
    let sheet = STATIC_HISTORY.sheet(&layout, &numbers);
    let of_rates = derivatives.map_or_else(Vec::new, |rates| derivatives::names(&rates.keys, &numbers));
    let mut columns = Columns::named(sheet.names().into_iter().chain(of_rates));
    for (i, position) in history.positions.iter().enumerate() {
        let own = derivatives.map(|rates| derivatives::row(rates, i, position, &numbers, layout.pitch));
        columns.push(sheet.row(&layout, position).chain(own.into_iter().flatten()));
    }
    columns
}

/// Names of the columns for the pairs with these numbers.
pub fn history_columns(scene: &Scene, pairs: &[i64]) -> Vec<String> {
    let mut names = STATIC_HISTORY.sheet(&StaticLayout::new(scene, 0.0), pairs).names();
    names.extend(derivatives::names(&scene.output.derivatives, pairs));
    names
}

/// A column over the pinion angle: points of a curve.
pub type Points = Vec<(f64, f64)>;

/// Columns over the pinion angle.
#[derive(Debug, Clone, Copy)]
pub struct StaticCurves<'a> {
    layout: StaticLayout,
    history: &'a StaticHistory,
}

impl<'a> StaticCurves<'a> {
    /// Curves of a solved history.
    pub fn new(scene: &Scene, history: &'a StaticHistory) -> Self {
        Self { layout: StaticLayout::of(scene, history), history }
    }

    /// A column that stands once.
    pub fn of(&self, column: Column<StaticRows>) -> Points {
        self.at(column, At::default())
    }

    /// A column of one gear and pair.
    pub fn at(&self, column: Column<StaticRows>, at: At) -> Points {
        let value = |column: Column<StaticRows>, p, at| (column.value)(&self.layout, p, at);
        let point = |p| (value(PINION_ANGLE, p, at), value(column, p, at));
        self.history.positions.iter().map(point).collect()
    }

    /// A column of one gear, pair by pair, with the number of the pair.
    pub fn by_pair(&self, column: Column<StaticRows>, gear: usize) -> Vec<(i64, Points)> {
        let pairs = pairs::columns(self.history, self.layout.pitch).into_iter().map(|pair| At { gear, pair });
        pairs.filter(|&at| (column.present)(&self.layout, at)).map(|at| (at.pair, self.at(column, at))).collect()
    }
}
