//! Motion in time: bodies, bearings, torques, modes, integration, analyses.

use super::{Key, Table, bare, bare_word, keys, number, rows, switch, table, whole, word, words};

/// `[pinion.body]`
pub(crate) static BODY: Table = keys(
    "rigid body of the gear (analyses in time)",
    &[
        bare("mass_kg", 1e-9, 1e9, "mass, kg; default: of the mesh"),
        bare(
            "transverse_inertia_kg_m2",
            1e-15,
            1e12,
            "inertia about an axis across the gear's own, kg m^2; default: of the mesh",
        ),
        bare("polar_inertia_kg_m2", 1e-15, 1e12, "inertia about the gear's own axis, kg m^2; default: of the mesh"),
        number("added_inertia_kg_m2", 0.0, 1e12, 0.0, "inertia of engine, load or shaft on the same axis, kg m^2"),
        words("free", &["x", "y", "z", "rx", "ry"], "coordinates that are free beside the turn"),
    ],
);

const fn spring(name: &'static str, about: &'static str) -> Key {
    bare(name, 1e-6, 1e15, about)
}

const fn damper(name: &'static str, about: &'static str) -> Key {
    bare(name, 0.0, 1e15, about)
}

/// `[pinion.bearing]`
pub(crate) static BEARING: Table = keys(
    "what holds the gear's centre (analyses in time)",
    &[
        spring("stiffness_x_n_per_mm", "stiffness along the line of centres, N/mm"),
        spring("stiffness_y_n_per_mm", "stiffness across it, N/mm"),
        spring("stiffness_z_n_per_mm", "stiffness along the axis, N/mm"),
        spring("stiffness_rx_nmm_per_rad", "stiffness against tilt about x, N mm/rad"),
        spring("stiffness_ry_nmm_per_rad", "stiffness against tilt about y, N mm/rad"),
        spring(
            "stiffness_rz_nmm_per_rad",
            "stiffness against the turn off the nominal one, N mm/rad (lumped8, lumped12)",
        ),
        number("damping_ratio", 0.0, 10.0, 0.02, "damping ratio of every free direction without damping of its own"),
        damper("damping_x_ns_per_mm", "damping along x, N s/mm"),
        damper("damping_y_ns_per_mm", "damping along y, N s/mm"),
        damper("damping_z_ns_per_mm", "damping along z, N s/mm"),
        damper("damping_rx_nmms_per_rad", "damping of the tilt about x, N mm s/rad"),
        damper("damping_ry_nmms_per_rad", "damping of the tilt about y, N mm s/rad"),
        damper("damping_rz_nmms_per_rad", "damping of the turn off the nominal one, N mm s/rad (lumped8)"),
        rows(
            "stiffness_matrix_n_mm_rad",
            5,
            "in place of single stiffnesses: five rows of five, order x, y, z, rx, ry; N/mm, N/rad, N mm/rad",
        ),
        rows("damping_matrix_ns_mm_rad", 5, "in place of single dampings: N s/mm, N s/rad, N mm s/rad"),
    ],
);

const AMPLITUDE: Key = bare("amplitude_nm", 0.0, 1e9, "amplitude of a harmonic part, N m");
const FREQUENCY: Key = bare("frequency_hz", 1e-9, 1e9, "its frequency, Hz");
const PHASE: Key = number("phase_deg", -360.0, 360.0, 0.0, "phase of its cosine at t = 0, degrees");
const TABLE: Key = rows("table_s_nm", 2, "in place of the others: rows of time, s, ascending, and torque, N m");

/// `[drive]`
pub(crate) static DRIVE: Table = keys(
    "what drives the driver (analyses in time)",
    &[
        bare_word(
            "by",
            &["torque", "speed"],
            "what is given of the driver; default: its torque, with the models impact, lumped8, lumped12 and shaft18 its speed",
        ),
        bare(
            "torque_nm",
            -1e9,
            1e9,
            "torque of the driver in the running sense, N m; default: in balance with the load, which holds the mean speed",
        ),
        AMPLITUDE,
        FREQUENCY,
        PHASE,
        TABLE,
    ],
);

/// `[load]`
pub(super) static LOAD: Table =
    keys("torque on the driven gear beside its mean (analyses in time)", &[AMPLITUDE, FREQUENCY, PHASE, TABLE]);

/// `[modes]`
pub(crate) static MODES: Table = keys(
    "which normal modes of the gears move (model reduced+modes)",
    &[
        whole("count", 1, 1000, 12, "the lowest so many modes of each gear"),
        bare("below_hz", 1.0, 1e9, "in place of count: all modes up to this frequency, Hz"),
        word("boundary", &["massless", "consistent"], "whether the flanks have inertia of their own"),
        whole("fixed_modes", 0, 100, 2, "modes with the flanks held behind a consistent boundary"),
        number("damping_ratio", 0.0, 1.0, 0.01, "damping ratio of every mode"),
    ],
);

/// `[motion]`
pub(crate) static MOTION: Table = keys(
    "integration and analysis in time",
    &[
        word("run", &["steady", "shooting", "span", "ramp", "sweep"], "what is run"),
        word("method", &["energy", "generalised-alpha", "newmark", "dormand-prince", "rk4"], "method of integration"),
        number("spectral_radius", 0.0, 1.0, 0.9, "spectral radius at infinite frequency (generalised-alpha)"),
        whole("steps_per_mesh_cycle", 8, 100_000, 64, "rows in a mesh cycle, and least number of steps"),
        whole(
            "steps_per_resonance",
            0,
            100_000,
            16,
            "least number of steps in a period of the mesh resonance; 0: rows are the steps",
        ),
        bare(
            "error_tolerance",
            1e-12,
            0.1,
            "local error of a step over the static deflection; default: steps of equal length",
        ),
        switch("stop_at_events", false, "ends a step wherever contact is lost or gained"),
        number("mesh_damping_ratio", 0.0, 10.0, 0.05, "damping ratio of the mesh"),
        bare("mesh_damping_ns_per_mm2", 0.0, 1e9, "in its place: damping of a mm of contact line, N s/mm^2"),
        number(
            "periodic_tolerance",
            1e-12,
            0.5,
            1e-6,
            "difference after a period over the peak to peak that counts as none (steady, shooting, sweep)",
        ),
        whole(
            "warm_up_cycles",
            0,
            100_000_000,
            1000,
            "mesh cycles to wait for the periodic state at the most (the same)",
        ),
        bare("duration_s", 1e-9, 1e9, "length of a span, s, in place of cycles"),
        whole(
            "checkpoint_every_cycles",
            0,
            100_000_000,
            0,
            "a checkpoint every so many mesh cycles; 0: none (steady, span, ramp)",
        ),
        table("ramp", &RAMP),
        table("sweep", &SWEEP),
    ],
);

/// `[motion.ramp]`
pub(crate) static RAMP: Table = Table {
    about: "run-up or run-down: the driver's speed changes by a smooth step",
    keys: &[
        bare("from_rpm", 0.0, 1e7, "speed at first, 1/min; 0: from rest"),
        bare("to_rpm", 1e-3, 1e7, "speed in the end, 1/min"),
        bare("duration_s", 1e-6, 1e6, "how long the change takes, s"),
        number("before_s", 0.0, 1e6, 0.0, "time at the first speed before, s"),
        number("after_s", 0.0, 1e6, 0.0, "time at the last speed afterwards, s"),
        whole("waterfall_cycles", 4, 100_000, 16, "mesh cycles of one spectrum of the waterfall"),
    ],
    needed: &["from_rpm", "to_rpm", "duration_s"],
};

/// `[motion.sweep]`
pub(crate) static SWEEP: Table = Table {
    about: "steady states at many speeds of the driver",
    keys: &[
        bare("from_rpm", 1e-3, 1e7, "lowest speed, 1/min"),
        bare("to_rpm", 1e-3, 1e7, "highest speed, 1/min"),
        whole("speeds", 2, 100_000, 41, "how many speeds, evenly spaced"),
        words("ways", &["apart", "up", "down"], "which way they are gone through; default: up and down"),
        word("steady_by", &["running", "shooting"], "how each steady state is found"),
    ],
    needed: &["from_rpm", "to_rpm"],
};
