//! The file itself, and the tables on pair, load, contact, analysis and output.

use super::gear::{GEAR, MATERIAL, WHEEL};
use super::ladder::{IMPACT, LUMPED8, LUMPED12, MESH, SHAFT18};
use super::motion::{DRIVE, LOAD, MODES, MOTION};
use super::{Key, Table, bare, bare_whole, bare_word, keys, number, switch, table, text, whole, word, words};

const INF: f64 = f64::INFINITY;

/// The whole file.
pub(crate) static SCENE: Table = Table {
    about: "A scene of ale-gear: a pair of helical gears, its load, and what is computed. Every key has its unit in its name",
    keys: &[
        text("name", "title of the case; default: the file's name"),
        table("pinion", &GEAR),
        table("wheel", &WHEEL),
        table("pair", &PAIR),
        table("material", &MATERIAL),
        table("operation", &OPERATION),
        table("contact", &CONTACT),
        table("drive", &DRIVE),
        table("load", &LOAD),
        table("analysis", &ANALYSIS),
        table("modes", &MODES),
        table("motion", &MOTION),
        table("mesh", &MESH),
        table("lumped8", &LUMPED8),
        table("lumped12", &LUMPED12),
        table("shaft18", &SHAFT18),
        table("impact", &IMPACT),
        table("output", &OUTPUT),
    ],
    needed: &["pinion", "wheel", "pair", "operation"],
};

/// `[pair]`
pub(crate) static PAIR: Table = Table {
    about: "what both gears share",
    keys: &[
        bare("normal_module_mm", 0.01, 200.0, "normal module, mm"),
        number("normal_pressure_angle_deg", 5.0, 40.0, 20.0, "normal pressure angle, degrees"),
        bare("face_width_mm", 0.01, 1e4, "face width of both gears, mm"),
        bare(
            "centre_distance_mm",
            0.01,
            1e5,
            "working centre distance, mm; default: the one that follows from the profile shifts",
        ),
        number("addendum_coefficient", 0.1, 2.0, 1.0, "addendum of the basic rack over the normal module"),
        number("dedendum_coefficient", 0.1, 2.5, 1.25, "dedendum of the basic rack over the normal module"),
        number("root_radius_coefficient", 0.0, 1.0, 0.38, "tip radius of the basic rack over the normal module"),
        table("misalignment", &MISALIGNMENT),
    ],
    needed: &["normal_module_mm", "face_width_mm"],
};

const MISALIGNED: &[Key] = &[
    number(
        "deviation_um",
        -INF,
        INF,
        0.0,
        "f_Sigma_beta: deviation of the wheel's axis across the plane of axes, um over the face width",
    ),
    number(
        "inclination_um",
        -INF,
        INF,
        0.0,
        "f_Sigma_delta: deviation of the wheel's axis in the plane of axes, um over the face width",
    ),
    number(
        "in_plane_of_action_um",
        -INF,
        INF,
        0.0,
        "deviation in the plane of action of the driving flanks, um over the face width",
    ),
    number("across_plane_of_action_um", -INF, INF, 0.0, "deviation across it, um over the face width"),
];

/// `[pair.misalignment]`
static MISALIGNMENT: Table = keys("deviation of the wheel's axis; each at most 10 um a mm of face width", MISALIGNED);

/// `[operation]`
pub(crate) static OPERATION: Table = Table {
    about: "load and motion",
    keys: &[
        word("driver", &["pinion", "wheel"], "the gear that drives"),
        word("rotation", &["ccw", "cw"], "sense of rotation of the pinion, seen from +z"),
        bare(
            "torque_nm",
            0.0,
            1e9,
            "torque on the driven gear, N m, against its motion; `driver` and `rotation` say which flanks it presses",
        ),
        number("speed_rpm", 1e-6, 1e7, 1000.0, "speed of the driver, 1/min"),
    ],
    needed: &["torque_nm"],
};

/// `[contact]`
pub(crate) static CONTACT: Table = keys(
    "how flanks press on each other",
    &[
        word(
            "method",
            &["slice", "nodal"],
            "contact unknowns: one line load an axial slice, or pressed points of the flank mesh",
        ),
        bare_whole(
            "slices",
            4,
            1000,
            "slices over the face width (method slice); default: as width, load and micro-geometry ask for, at least 32",
        ),
        bare(
            "penalty_mpa_per_mm",
            1.0,
            1e15,
            "pressure a mm of penetration, MPa/mm, instead of exact contact (method nodal)",
        ),
        word(
            "gap",
            &["smooth", "facet"],
            "surface that the gaps come from (method nodal): the exact helicoid, or the flat faces of the mesh",
        ),
        whole("points_per_face_edge", 1, 20, 6, "quadrature points along each edge of a flank face (method nodal)"),
        bare_word("flanks", &["driving", "both"], "which flanks may touch; default: driving, in time both"),
        number("friction", 0.0, 1.0, 0.0, "coefficient of friction"),
        switch("corner_contact", true, "whether tip edges may press off the line of action (method slice)"),
    ],
);

/// `[analysis]`
pub(crate) static ANALYSIS: Table = keys(
    "what is computed",
    &[
        bare_word(
            "kind",
            &["static", "dynamic"],
            "equilibrium at every position, or motion in time; default: static, for models of motion dynamic",
        ),
        word(
            "model",
            &["reduced", "reduced+modes", "full", "iso", "lumped8", "lumped12", "shaft18", "impact"],
            "which model of the pair",
        ),
        word(
            "reduction",
            &["auto", "general"],
            "one sector where the gear is cyclic, else the whole gear; or always the whole gear",
        ),
        whole("positions_per_cycle", 1, 100_000, 32, "positions in one mesh cycle, its end left out"),
        bare_whole("cycles", 1, 100_000_000, "mesh cycles; default: 1, in time 8"),
        bare_whole(
            "window_teeth",
            1,
            25,
            "teeth whose flanks are kept; default: as the contact ratio and the load ask for",
        ),
    ],
);

/// `[output]`
pub(crate) static OUTPUT: Table = keys(
    "what is computed and written on request",
    &[
        switch("root_stress", false, "stress in the root fillets at every position"),
        switch("contact_lines", false, "contact_lines.csv: every loaded slice of every position"),
        switch("parquet", false, "history.parquet: the columns of history.csv for long runs"),
        switch("vtu", false, "ParaView files"),
        words("fields", &["displacement", "pressure", "stress"], "fields of the ParaView files; default: all"),
        whole("vtu_every", 1, 1_000_000, 1, "one ParaView file every so many positions"),
    ],
);
