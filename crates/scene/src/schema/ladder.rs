//! Cheaper models of the same pair.

use super::{Key, Table, bare, bare_word, keys, list, number, numbers, rows, word, words};

const INF: f64 = f64::INFINITY;

/// `[mesh]`
pub(crate) static MESH: Table = keys(
    "mesh of a model that has a stiffness instead of flanks (lumped8, lumped12, shaft18)",
    &[
        bare_word(
            "stiffness_from",
            &["reduced", "series", "iso"],
            "where the stiffness over the mesh cycle comes from; default: series where that is given, else reduced",
        ),
        bare("stiffness_n_per_um", 1e-6, 1e9, "mean stiffness along the flanks' normal, N/um"),
        numbers("stiffness_cos_n_per_um", "cosine amplitudes of the mesh orders 1, 2, ..., N/um"),
        numbers("stiffness_sin_n_per_um", "sine amplitudes, N/um"),
        numbers("error_cos_um", "unloaded transmission error on the transverse line of action: cosine amplitudes, um"),
        numbers("error_sin_um", "sine amplitudes, um"),
        bare(
            "half_backlash_um",
            0.0,
            1e5,
            "half of the backlash along the normal, um; 0: a linear mesh; default: of the geometry",
        ),
        word("line_sharing", &["length", "line"], "how friction weighs the contact lines (lumped8, lumped12)"),
    ],
);

/// `[lumped8]`
pub(crate) static LUMPED8: Table = keys(
    "the model with eight coordinates",
    &[
        word("law", &["normal", "projected"], "one spring along the normal, or two with projected stiffness"),
        number("speed_fluctuation_rpm", 0.0, 1e7, 0.0, "amplitude of the driver's speed about its mean, 1/min"),
        bare("speed_fluctuation_hz", 1e-6, 1e7, "its frequency, Hz"),
    ],
);

/// `[lumped12]`
pub(crate) static LUMPED12: Table = keys(
    "the model with twelve coordinates",
    &[
        bare(
            "orientation_deg",
            -360.0,
            360.0,
            "direction from the driver's centre to the driven gear's, degrees; default: as the pair stands",
        ),
        number("damping_ratio", 0.0, 10.0, 0.03, "Rayleigh damping at both frequencies"),
        number("damping_from_hz", 1e-6, 1e7, 100.0, "the lower one, Hz"),
        number("damping_to_hz", 1e-6, 1e7, 10_000.0, "the higher one, Hz"),
    ],
);

/// `[impact]`
pub(crate) static IMPACT: Table = keys(
    "rigid gears on true flanks, force by overlap",
    &[
        bare(
            "stiffness_n_per_mm_to_exponent",
            1e-6,
            1e15,
            "K of K delta^e of a pair that touches over its whole face width, N/mm^e; default: 4/3 sqrt(R) E*",
        ),
        number("exponent", 1.0, 10.0, 1.5, "e"),
        number("damping_ns_per_mm", 0.0, 1e9, 50.0, "largest damping, N s/mm"),
        number("damping_depth_mm", 1e-9, 1e3, 0.1, "overlap from which damping is whole, mm"),
        number("static_friction", 0.0, 1.0, 0.0, "coefficient of friction at the static speed"),
        number("dynamic_friction", 0.0, 1.0, 0.0, "the same from the dynamic speed on"),
        number("static_speed_mm_per_s", 1e-9, 1e6, 0.1, "sliding speed up to which flanks creep, mm/s"),
        number("dynamic_speed_mm_per_s", 1e-9, 1e6, 10.0, "sliding speed from which on they slip, mm/s"),
    ],
);

/// `[shaft18]`
pub(crate) static SHAFT18: Table = keys(
    "both shafts of the model of shafts",
    &[
        number("mass_damping_per_s", 0.0, 1e9, 20.0, "damping in proportion to mass, 1/s"),
        number("stiffness_damping_s", 0.0, 1.0, 2e-7, "damping in proportion to stiffness, s"),
        numbers("gravity_m_per_s2", "acceleration of gravity along x, y, z, m/s^2"),
    ],
);

/// `[pinion.shaft]`
pub(crate) static SHAFT: Table = Table {
    about: "the shaft the gear sits on (model shaft18); places are mm from the beginning of its first segment",
    keys: &[
        rows("segments_mm", 3, "length, outer and inner diameter of each segment, mm"),
        bare("gear_at_mm", 0.0, INF, "place of the gear, mm"),
        bare("torque_at_mm", 0.0, INF, "where drive or load acts, mm; default: at the gear"),
        numbers("nodes_mm", "further places at which the shaft's own mass is put, mm"),
        number("run_out_um", 0.0, 1e4, 0.0, "eccentricity of the gear's teeth, um"),
        number("run_out_phase_deg", -360.0, 360.0, 0.0, "its angle before the line of action at the start, degrees"),
        list("discs", &DISC),
        list("supports", &SUPPORT),
    ],
    needed: &["segments_mm", "gear_at_mm"],
};

/// `[[pinion.shaft.discs]]`
pub(crate) static DISC: Table = Table {
    about: "couplings and wheels on the shaft",
    keys: &[
        bare("at_mm", 0.0, INF, "place, mm"),
        number("mass_kg", 0.0, 1e9, 0.0, "mass, kg"),
        number("polar_inertia_kg_m2", 0.0, 1e12, 0.0, "inertia about the shaft's axis, kg m^2"),
        number("transverse_inertia_kg_m2", 0.0, 1e12, 0.0, "inertia about an axis across, kg m^2"),
        words("keeps", &["x", "y", "z", "rx", "ry", "rz"], "coordinates that remain; default: x, y, rz"),
    ],
    needed: &["at_mm"],
};

const fn of(name: &'static str, about: &'static str) -> Key {
    number(name, 0.0, 1e15, 0.0, about)
}

/// `[[pinion.shaft.supports]]`
pub(crate) static SUPPORT: Table = Table {
    about: "bearings of the shaft; what is 0 does not hold",
    keys: &[
        bare("at_mm", 0.0, INF, "place, mm"),
        of("stiffness_x_n_per_mm", "stiffness along x, N/mm"),
        of("stiffness_y_n_per_mm", "stiffness along y, N/mm"),
        of("stiffness_z_n_per_mm", "stiffness along the axis, N/mm"),
        of("stiffness_rx_nmm_per_rad", "stiffness against tilt about x, N mm/rad"),
        of("stiffness_ry_nmm_per_rad", "stiffness against tilt about y, N mm/rad"),
        of("stiffness_rz_nmm_per_rad", "stiffness against turning, N mm/rad"),
        of("damping_x_ns_per_mm", "damping along x, N s/mm"),
        of("damping_y_ns_per_mm", "damping along y, N s/mm"),
        of("damping_z_ns_per_mm", "damping along the axis, N s/mm"),
        of("damping_rx_nmms_per_rad", "damping of the tilt about x, N mm s/rad"),
        of("damping_ry_nmms_per_rad", "damping of the tilt about y, N mm s/rad"),
        of("damping_rz_nmms_per_rad", "damping of turning, N mm s/rad"),
    ],
    needed: &["at_mm"],
};
