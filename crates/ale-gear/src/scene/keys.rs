//! Which keys there are, and which of them a misspelt one is nearest to.

/// Tables of a kind of file with their keys; the first one is the file itself.
pub(crate) type Tables = &'static [(&'static str, &'static [&'static str])];

/// Every table of a scene with its keys, in the order of the documentation.
pub(super) const TABLES: Tables = &[
    (
        "",
        &[
            "name",
            "pinion",
            "wheel",
            "pair",
            "material",
            "operation",
            "contact",
            "drive",
            "load",
            "analysis",
            "modes",
            "motion",
            "mesh",
            "lumped8",
            "lumped12",
            "shaft18",
            "impact",
            "output",
        ],
    ),
    (
        "pinion",
        &[
            "teeth",
            "helix_angle_deg",
            "bore_diameter_mm",
            "profile_shift",
            "tip_diameter_mm",
            "tip_edge_radius_mm",
            "thickness_allowance_mm",
            "pitch_errors_um",
            "pitch_errors_file",
            "mesh",
            "mesher",
            "groups",
            "material",
            "modification",
            "body",
            "bearing",
            "shaft",
        ],
    ),
    (
        "pinion.mesher",
        &[
            "order",
            "elements_profile",
            "elements_fillet",
            "elements_thickness",
            "elements_face",
            "elements_rim",
            "sector_teeth",
        ],
    ),
    ("pinion.groups", &["bore", "flank_left", "flank_right", "cut_0", "cut_1"]),
    (
        "pair",
        &[
            "normal_module_mm",
            "normal_pressure_angle_deg",
            "face_width_mm",
            "centre_distance_mm",
            "addendum_coefficient",
            "dedendum_coefficient",
            "root_radius_coefficient",
            "misalignment",
        ],
    ),
    ("material", &["young_mpa", "poisson", "density_kg_m3"]),
    ("operation", &["driver", "rotation", "torque_nm", "speed_rpm"]),
    (
        "contact",
        &[
            "method",
            "slices",
            "penalty_mpa_per_mm",
            "gap",
            "points_per_face_edge",
            "flanks",
            "friction",
            "corner_contact",
        ],
    ),
    ("analysis", &["kind", "model", "reduction", "positions_per_cycle", "cycles", "window_teeth"]),
    ("output", &["contact_lines", "root_stress", "vtu", "fields", "vtu_every"]),
    (
        "pinion.modification",
        &[
            "tip_relief_um",
            "tip_relief_start_diameter_mm",
            "tip_relief_start_roll_deg",
            "tip_relief_shape",
            "root_relief_um",
            "root_relief_start_diameter_mm",
            "root_relief_start_roll_deg",
            "root_relief_shape",
            "profile_crowning_um",
            "profile_slope_um",
            "lead_crowning_um",
            "lead_slope_um",
            "end_relief_lower_um",
            "end_relief_lower_length_mm",
            "end_relief_upper_um",
            "end_relief_upper_length_mm",
            "end_relief_shape",
            "bias_um",
            "topography",
            "evaluation_start_diameter_mm",
            "drive",
            "coast",
        ],
    ),
    ("pinion.body", &["mass_kg", "transverse_inertia_kg_m2", "polar_inertia_kg_m2", "added_inertia_kg_m2", "free"]),
    (
        "pinion.bearing",
        &[
            "stiffness_x_n_per_mm",
            "stiffness_y_n_per_mm",
            "stiffness_z_n_per_mm",
            "stiffness_rx_nmm_per_rad",
            "stiffness_ry_nmm_per_rad",
            "stiffness_rz_nmm_per_rad",
            "damping_ratio",
            "damping_x_ns_per_mm",
            "damping_y_ns_per_mm",
            "damping_z_ns_per_mm",
            "damping_rx_nmms_per_rad",
            "damping_ry_nmms_per_rad",
            "damping_rz_nmms_per_rad",
            "stiffness_matrix_n_mm_rad",
            "damping_matrix_ns_mm_rad",
        ],
    ),
    (
        "motion",
        &[
            "run",
            "method",
            "spectral_radius",
            "steps_per_mesh_cycle",
            "steps_per_resonance",
            "error_tolerance",
            "stop_at_events",
            "mesh_damping_ratio",
            "mesh_damping_ns_per_mm2",
            "periodic_tolerance",
            "warm_up_cycles",
            "duration_s",
            "checkpoint_every_cycles",
            "ramp",
            "sweep",
        ],
    ),
    ("modes", &["count", "below_hz", "boundary", "fixed_modes", "damping_ratio"]),
    ("motion.ramp", &["from_rpm", "to_rpm", "duration_s", "before_s", "after_s", "waterfall_cycles"]),
    ("motion.sweep", &["from_rpm", "to_rpm", "speeds", "ways", "steady_by"]),
    ("drive", &["by", "torque_nm", "amplitude_nm", "frequency_hz", "phase_deg", "table_s_nm"]),
    ("load", &["amplitude_nm", "frequency_hz", "phase_deg", "table_s_nm"]),
    (
        "mesh",
        &[
            "stiffness_from",
            "stiffness_n_per_um",
            "stiffness_cos_n_per_um",
            "stiffness_sin_n_per_um",
            "error_cos_um",
            "error_sin_um",
            "half_backlash_um",
            "line_sharing",
        ],
    ),
    ("lumped8", &["law", "speed_fluctuation_rpm", "speed_fluctuation_hz"]),
    (
        "impact",
        &[
            "stiffness_n_per_mm_to_exponent",
            "exponent",
            "damping_ns_per_mm",
            "damping_depth_mm",
            "static_friction",
            "dynamic_friction",
            "static_speed_mm_per_s",
            "dynamic_speed_mm_per_s",
        ],
    ),
    ("shaft18", &["mass_damping_per_s", "stiffness_damping_s", "gravity_m_per_s2"]),
    (
        "pinion.shaft",
        &[
            "segments_mm",
            "gear_at_mm",
            "torque_at_mm",
            "nodes_mm",
            "run_out_um",
            "run_out_phase_deg",
            "discs",
            "supports",
        ],
    ),
    ("lumped12", &["orientation_deg", "damping_ratio", "damping_from_hz", "damping_to_hz"]),
    ("pair.misalignment", &["deviation_um", "inclination_um", "in_plane_of_action_um", "across_plane_of_action_um"]),
];

/// The nearest of `known` if it is near enough to be meant.
pub(crate) fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    known
        .iter()
        .map(|&k| (strsim::normalized_damerau_levenshtein(word, k), k))
        .filter(|&(likeness, _)| likeness >= 0.6)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, k)| k)
}

/// One sentence for someone who wrote `word` where only `here` may stand, in a file of these tables.
pub(super) fn advice(tables: Tables, word: &str, here: &[&str]) -> String {
    let meant_here = nearest(word, here);
    let elsewhere = tables.iter().skip(1).find(|(_, keys)| keys.contains(&word));
    match (elsewhere, meant_here) {
        (Some((table, _)), _) => format!("`{word}` belongs to [{table}]"),
        (None, Some(key)) => format!("did you mean `{key}`?"),
        // A key without its unit (`torque`) is shorter than the real one, so the likeness alone misses it.
        (None, None) => match here.iter().find(|key| key.starts_with(word)) {
            Some(key) => format!("did you mean `{key}`?"),
            None => format!("known here: {}", here.join(", ")),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn advice_finds_neighbours_tables_and_units() {
        let pair = TABLES[4].1;
        assert_eq!(advice(TABLES, "face_widht_mm", pair), "did you mean `face_width_mm`?");
        assert_eq!(advice(TABLES, "teeth", pair), "`teeth` belongs to [pinion]");
        assert_eq!(advice(TABLES, "torque", TABLES[6].1), "did you mean `torque_nm`?");
        assert!(advice(TABLES, "colour", &["poisson"]).starts_with("known here"));
    }
}
