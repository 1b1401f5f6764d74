//! A gear: data, mesh, material, micro-geometry.

use super::ladder::SHAFT;
use super::motion::{BEARING, BODY};
use super::{Key, Table, bare, bare_whole, keys, number, numbers, table, text, whole, word};

const INF: f64 = f64::INFINITY;

const GEAR_KEYS: &[Key] = &[
    bare_whole("teeth", 5, 2000, "number of teeth"),
    bare(
        "helix_angle_deg",
        -60.0,
        60.0,
        "helix angle at the reference cylinder, degrees, right hand positive; the wheel's follows from the pinion's",
    ),
    bare(
        "bore_diameter_mm",
        1e-3,
        INF,
        "diameter of the rigid bore, mm, below the reference diameter; default: 55 % of that",
    ),
    number("profile_shift", -1.5, 2.0, 0.0, "profile shift coefficient"),
    bare(
        "tip_diameter_mm",
        0.0,
        INF,
        "tip diameter, mm, 0.5 to 2 reference diameters; default: from addendum and profile shift",
    ),
    number(
        "tip_edge_radius_mm",
        0.0,
        INF,
        0.0,
        "radius of the arc that rounds the tip edges, mm, at most a quarter of the module; 0: sharp",
    ),
    number(
        "thickness_allowance_mm",
        0.0,
        INF,
        0.0,
        "thinning of the tooth in the normal section, mm, at most half the module",
    ),
    numbers("pitch_errors_um", "cumulative pitch deviation of each tooth, um, -1000 .. 1000, tooth 0 first"),
    text("pitch_errors_file", "file of them"),
    text("mesh", "Gmsh mesh file of the gear, instead of the built-in mesher"),
    table("mesher", &MESHER),
    table("groups", &GROUPS),
    table("material", &MATERIAL),
    table("modification", &MODIFICATION),
    table("body", &BODY),
    table("bearing", &BEARING),
    table("shaft", &SHAFT),
];

/// `[pinion]`
pub(crate) static GEAR: Table = Table { about: "gear 1", keys: GEAR_KEYS, needed: &["teeth", "helix_angle_deg"] };

/// `[wheel]`
pub(super) static WHEEL: Table = Table { about: "gear 2", keys: GEAR_KEYS, needed: &["teeth"] };

/// `[pinion.mesher]`
pub(crate) static MESHER: Table = keys(
    "the built-in structured mesher",
    &[
        whole("order", 1, 2, 2, "1: hex8, 2: hex20"),
        whole("elements_profile", 1, 500, 6, "elements along the active flank"),
        whole("elements_fillet", 2, 500, 6, "elements along fillet and root land"),
        whole("elements_thickness", 1, 500, 4, "elements across the tooth"),
        bare_whole(
            "elements_face",
            1,
            2000,
            "elements along the face width; default: as many as it asks for, at least 6",
        ),
        whole("elements_rim", 1, 500, 5, "elements from the root to the bore"),
        whole(
            "sector_teeth",
            0,
            u32::MAX,
            0,
            "0: whole gear; 1: periodic sector, which stands for the whole gear; k: open sector of k teeth, cut faces free, less than the gear has",
        ),
    ],
);

/// `[pinion.groups]`
static GROUPS: Table = keys(
    "the mesh's own names of the parts of the gear; {k} stands for the tooth number",
    &[
        text("bore", "the bore; default: bore"),
        text("flank_left", "counter-clockwise side of each tooth, seen from +z; default: flank_left_{k}"),
        text("flank_right", "clockwise side; default: flank_right_{k}"),
        text("cut_0", "clockwise cut face of a sector; default: cut_0"),
        text("cut_1", "counter-clockwise cut face; default: cut_1"),
    ],
);

/// `[material]`; a gear's own table takes its defaults from this one.
pub(crate) static MATERIAL: Table = keys(
    "linear elastic material",
    &[
        number("young_mpa", 1.0, 1e7, 2.06e5, "Young's modulus, MPa"),
        number("poisson", -0.9, 0.499, 0.3, "Poisson's ratio"),
        number("density_kg_m3", 1.0, 1e5, 7850.0, "density, kg/m^3"),
    ],
);

/// Largest amount of any modification, um: a millimetre is no micro-geometry.
const LARGEST: f64 = 1000.0;
const SHAPES: &[&str] = &["linear", "parabolic"];

const fn um(name: &'static str, about: &'static str) -> Key {
    bare(name, -LARGEST, LARGEST, about)
}

const fn diameter(name: &'static str, about: &'static str) -> Key {
    bare(name, 0.01, 1e5, about)
}

const fn roll(name: &'static str, about: &'static str) -> Key {
    bare(name, 0.0, 360.0, about)
}

const fn length(name: &'static str, about: &'static str) -> Key {
    bare(name, 1e-3, INF, about)
}

/// Keys of one flank once for the three tables that they stand in; a macro, as constants join no slices.
macro_rules! flank_keys {
    ($($more:expr),*) => {
        &[
            um("tip_relief_um", "tip relief C_alpha_a: depth at the tip circle, um"),
            diameter("tip_relief_start_diameter_mm", "where the tip relief starts: diameter, mm"),
            roll("tip_relief_start_roll_deg", "or roll angle, degrees"),
            word("tip_relief_shape", SHAPES, "how the tip relief grows"),
            um("root_relief_um", "root relief C_alpha_f: depth at the root form circle, um"),
            diameter("root_relief_start_diameter_mm", "where the root relief starts: diameter, mm"),
            roll("root_relief_start_roll_deg", "or roll angle, degrees"),
            word("root_relief_shape", SHAPES, "how the root relief grows"),
            um("profile_crowning_um", "profile crowning C_alpha, um at both ends of the range"),
            um("profile_slope_um", "profile slope C_Halpha, um more at the tip than at the start of the range"),
            um("lead_crowning_um", "lead crowning C_beta, um at both ends of the face"),
            um("lead_slope_um", "lead slope C_Hbeta, um more at z = +b/2 than at z = -b/2"),
            um("end_relief_lower_um", "end relief C_beta_I: depth at z = -b/2, um"),
            length("end_relief_lower_length_mm", "its length, mm, up to the face width"),
            um("end_relief_upper_um", "end relief C_beta_II: depth at z = +b/2, um"),
            length("end_relief_upper_length_mm", "its length, mm, up to the face width"),
            word("end_relief_shape", SHAPES, "how the end reliefs grow"),
            um("bias_um", "bias S_alpha, um: profile slope at z = +b/2 less that at z = -b/2"),
            text("topography", "file of measured depths"),
            diameter("evaluation_start_diameter_mm", "where the evaluation range of profile crowning, slope and bias starts, mm; default: the root form circle"),
            $($more),*
        ]
    };
}

/// `[pinion.modification]`
pub(crate) static MODIFICATION: Table = keys(
    "micro-geometry of both flanks of every tooth: material removed, normal to the flank",
    flank_keys![table("drive", &DRIVE_FLANK), table("coast", &COAST_FLANK)],
);

static DRIVE_FLANK: Table =
    keys("micro-geometry of the flanks that the torque presses, in place of both", flank_keys![]);
static COAST_FLANK: Table = keys("micro-geometry of the flanks behind them, in place of both", flank_keys![]);
