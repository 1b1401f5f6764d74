//! For every key of the scene file: a case in which another value must show.

/// A case that keys are changed in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Base {
    /// ISO 6336-1, no mesh.
    Iso,
    /// The reduced model on tiny meshes.
    Reduced,
    /// The reduced model on sectors from files.
    Files,
    /// The reduced model in motion.
    Motion,
    /// The reduced model in motion with normal modes.
    Modes,
    /// The seeds' scenes, shortened.
    Lumped8,
    Lumped12,
    Shaft18,
    Impact,
    /// Rigid gears on ground flanks, pressed on one side and then on the other.
    Flanks,
    /// A pinion in a ring, on tiny meshes.
    Ring,
}

/// Key, case, further keys that the case wants (`;` between them), the other value. `~` is the table that the key
/// stands in, with its dot.
pub type Row = (&'static str, Base, &'static str, &'static str);

use Base::{Files, Flanks, Impact, Iso, Lumped8, Lumped12, Modes, Motion, Reduced, Ring, Shaft18};

/// Keys of a flank.
const FLANK: &[Row] = &[
    ("tip_relief_um", Flanks, "~tip_relief_start_roll_deg=26; ~tip_relief_um=-2", "-9"),
    ("tip_relief_start_diameter_mm", Flanks, "~tip_relief_um=-9; ~tip_relief_start_diameter_mm=99", "97"),
    ("tip_relief_start_roll_deg", Flanks, "~tip_relief_um=-9; ~tip_relief_start_roll_deg=26", "24"),
    ("tip_relief_shape", Flanks, "~tip_relief_um=-9; ~tip_relief_start_roll_deg=24", "parabolic"),
    ("root_relief_um", Flanks, "~root_relief_start_roll_deg=18; ~root_relief_um=-2", "-9"),
    ("root_relief_start_diameter_mm", Flanks, "~root_relief_um=-9; ~root_relief_start_diameter_mm=94", "95"),
    ("root_relief_start_roll_deg", Flanks, "~root_relief_um=-9; ~root_relief_start_roll_deg=18", "20"),
    ("root_relief_shape", Flanks, "~root_relief_um=-9; ~root_relief_start_roll_deg=20", "parabolic"),
    ("profile_crowning_um", Flanks, "", "-8"),
    ("profile_slope_um", Flanks, "", "-8"),
    ("lead_crowning_um", Flanks, "", "-8"),
    ("lead_slope_um", Flanks, "", "-8"),
    ("end_relief_lower_um", Flanks, "~end_relief_lower_length_mm=8; ~end_relief_lower_um=-2", "-9"),
    ("end_relief_lower_length_mm", Flanks, "~end_relief_lower_um=-9; ~end_relief_lower_length_mm=8", "12"),
    ("end_relief_upper_um", Flanks, "~end_relief_upper_length_mm=8; ~end_relief_upper_um=-2", "-9"),
    ("end_relief_upper_length_mm", Flanks, "~end_relief_upper_um=-9; ~end_relief_upper_length_mm=8", "12"),
    ("end_relief_shape", Flanks, "~end_relief_upper_um=-9; ~end_relief_upper_length_mm=12", "parabolic"),
    ("bias_um", Flanks, "", "-12"),
    ("topography", Flanks, "", "grid.csv"),
    ("evaluation_start_diameter_mm", Flanks, "~profile_slope_um=-9", "93"),
];

/// A bore on springs all around.
const ON_SPRINGS: &str =
    "~bore.coupling=elastic; ~bore.radial_n_per_mm3=1e3; ~bore.tangential_n_per_mm3=1e3; ~bore.axial_n_per_mm3=1e3";
/// A bore on bolts.
const ON_BOLTS: &str = "~bore.coupling=elastic; ~bore.bolts.count=6; ~bore.bolts.width_mm=8; ~bore.bolts.radial_n_per_mm=2e5; ~bore.bolts.tangential_n_per_mm=2e5; ~bore.bolts.axial_n_per_mm=2e5";

/// Keys of a material.
const MATERIAL: &[Row] =
    &[("young_mpa", Iso, "", "1.0e5"), ("poisson", Reduced, "", "0.25"), ("density_kg_m3", Motion, "", "2700")];

/// Keys of the cutter of an internal gear; an external one refuses them.
const SHAPER: &[Row] =
    &[("teeth", Ring, "", "25"), ("profile_shift", Ring, "", "0.1"), ("tip_rounding_coefficient", Ring, "", "0.1")];

/// Keys of a torque beside its mean.
const TORQUE: &[Row] = &[
    ("amplitude_nm", Motion, "~frequency_hz=900; ~amplitude_nm=5", "20"),
    ("frequency_hz", Motion, "~amplitude_nm=20; ~frequency_hz=900", "700"),
    ("phase_deg", Motion, "~amplitude_nm=20; ~frequency_hz=900", "90"),
    ("table_s_nm", Motion, "", "[[0.0, 150.0], [0.01, 250.0]]"),
];

/// Keys of a gear.
const GEAR: &[Row] = &[
    ("teeth", Iso, "", "31"),
    ("face_width_mm", Iso, "", "18"),
    ("helix_angle_deg", Iso, "", "15"),
    ("bore_diameter_mm", Reduced, "", "50"),
    ("profile_shift", Iso, "", "0.1"),
    ("tip_diameter_mm", Iso, "", "101"),
    ("tip_edge_radius_mm", Reduced, "operation.torque_nm=900", "0.5"),
    ("thickness_allowance_mm", Iso, "", "0.08"),
    ("pitch_errors_um", Reduced, "", "[5,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,3]"),
    ("pitch_errors_file", Reduced, "", "pitch.csv"),
    ("mesh", Files, "", "other.msh"),
    ("mesher.order", Reduced, "", "2"),
    ("mesher.elements_profile", Reduced, "", "3"),
    ("mesher.elements_fillet", Reduced, "", "5"),
    ("mesher.elements_thickness", Reduced, "", "4"),
    ("mesher.elements_face", Reduced, "", "3"),
    ("mesher.elements_rim", Reduced, "", "2"),
    ("mesher.sector_teeth", Reduced, "", "5"),
    ("bore.held_mm", Reduced, "", "[-10, 0]"),
    ("bore.coupling", Reduced, "", "distributing"),
    ("bore.radial_n_per_mm3", Reduced, ON_SPRINGS, "5e3"),
    ("bore.tangential_n_per_mm3", Reduced, ON_SPRINGS, "5e3"),
    ("bore.axial_n_per_mm3", Reduced, ON_SPRINGS, "5e3"),
    ("bore.bolts.count", Reduced, ON_BOLTS, "8"),
    ("bore.bolts.first_angle_deg", Reduced, ON_BOLTS, "20"),
    ("bore.bolts.width_mm", Reduced, ON_BOLTS, "12"),
    ("bore.bolts.over_mm", Reduced, ON_BOLTS, "[-6, 6]"),
    ("bore.bolts.radial_n_per_mm", Reduced, ON_BOLTS, "5e5"),
    ("bore.bolts.tangential_n_per_mm", Reduced, ON_BOLTS, "5e5"),
    ("bore.bolts.axial_n_per_mm", Reduced, ON_BOLTS, "5e5"),
    ("bore.bolts.opens", Reduced, ON_BOLTS, "true"),
    ("bore.bolts.preload_n", Reduced, ON_BOLTS, "500"),
    ("groups.bore", Files, "", "Hub"),
    ("groups.flank_left", Files, "", "Left_{k}"),
    ("groups.flank_right", Files, "", "Right_{k}"),
    ("groups.cut_0", Files, "", "First"),
    ("groups.cut_1", Files, "", "Last"),
    ("body.mass_kg", Lumped8, "", "9"),
    ("body.transverse_inertia_kg_m2", Lumped12, "", "0.02"),
    ("body.polar_inertia_kg_m2", Lumped8, "", "0.02"),
    ("body.added_inertia_kg_m2", Lumped8, "", "0.02"),
    ("body.free", Motion, "", "[\"y\"]"),
    ("bearing.stiffness_x_n_per_mm", Lumped8, "", "2e5"),
    ("bearing.stiffness_y_n_per_mm", Lumped8, "", "2e5"),
    ("bearing.stiffness_z_n_per_mm", Lumped8, "", "2e5"),
    ("bearing.stiffness_rx_nmm_per_rad", Lumped12, "", "2e8"),
    ("bearing.stiffness_ry_nmm_per_rad", Lumped12, "", "2e8"),
    ("bearing.stiffness_rz_nmm_per_rad", Lumped8, "", "2e7"),
    ("bearing.damping_ratio", Lumped8, "", "0.05"),
    ("bearing.damping_x_ns_per_mm", Lumped8, "", "20"),
    ("bearing.damping_y_ns_per_mm", Lumped8, "", "20"),
    ("bearing.damping_z_ns_per_mm", Lumped8, "", "20"),
    ("bearing.damping_rx_nmms_per_rad", Motion, "~body.free=[\"rx\"]; ~bearing.stiffness_rx_nmm_per_rad=1e8", "2e4"),
    ("bearing.damping_ry_nmms_per_rad", Motion, "~body.free=[\"ry\"]; ~bearing.stiffness_ry_nmm_per_rad=1e8", "2e4"),
    ("bearing.damping_rz_nmms_per_rad", Lumped8, "", "5e3"),
    (
        "bearing.stiffness_matrix_n_mm_rad",
        Motion,
        "~body.free=[\"y\"]; ~bearing.stiffness_matrix_n_mm_rad=[[1e5,0,0,0,0],[0,1e5,0,0,0],[0,0,1e5,0,0],[0,0,0,1e8,0],[0,0,0,0,1e8]]",
        "[[1e5,0,0,0,0],[0,2e5,0,0,0],[0,0,1e5,0,0],[0,0,0,1e8,0],[0,0,0,0,1e8]]",
    ),
    (
        "bearing.damping_matrix_ns_mm_rad",
        Motion,
        "~body.free=[\"y\"]; ~bearing.stiffness_y_n_per_mm=1e5",
        "[[9,0,0,0,0],[0,9,0,0,0],[0,0,9,0,0],[0,0,0,9,0],[0,0,0,0,9]]",
    ),
    ("shaft.segments_mm", Shaft18, "", "[[113.8, 30.0, 0.0], [118.0, 32.0, 5.0]]"),
    ("shaft.gear_at_mm", Shaft18, "", "110"),
    ("shaft.torque_at_mm", Shaft18, "", "20"),
    ("shaft.nodes_mm", Shaft18, "", "[40.0]"),
    ("shaft.run_out_um", Shaft18, "", "20"),
    ("shaft.run_out_phase_deg", Shaft18, "~shaft.run_out_um=20", "90"),
    ("shaft.discs.0.at_mm", Shaft18, "", "50"),
    ("shaft.discs.0.mass_kg", Shaft18, "", "3"),
    ("shaft.discs.0.polar_inertia_kg_m2", Shaft18, "", "0.01"),
    ("shaft.discs.0.transverse_inertia_kg_m2", Shaft18, "", "0.01"),
    ("shaft.discs.0.keeps", Shaft18, "", "[\"x\", \"y\", \"rx\", \"rz\"]"),
    ("shaft.supports.0.at_mm", Shaft18, "", "5"),
    ("shaft.supports.0.stiffness_x_n_per_mm", Shaft18, "", "4e5"),
    ("shaft.supports.0.stiffness_y_n_per_mm", Shaft18, "", "4e5"),
    ("shaft.supports.0.stiffness_z_n_per_mm", Shaft18, "", "4e5"),
    ("shaft.supports.0.stiffness_rx_nmm_per_rad", Shaft18, "", "1e9"),
    ("shaft.supports.0.stiffness_ry_nmm_per_rad", Shaft18, "", "1e9"),
    ("shaft.supports.0.stiffness_rz_nmm_per_rad", Shaft18, "", "1e7"),
    ("shaft.supports.0.damping_x_ns_per_mm", Shaft18, "", "5"),
    ("shaft.supports.0.damping_y_ns_per_mm", Shaft18, "", "5"),
    ("shaft.supports.0.damping_z_ns_per_mm", Shaft18, "", "5"),
    ("shaft.supports.0.damping_rx_nmms_per_rad", Shaft18, "", "1e5"),
    ("shaft.supports.0.damping_ry_nmms_per_rad", Shaft18, "", "1e5"),
    ("shaft.supports.0.damping_rz_nmms_per_rad", Shaft18, "", "1e5"),
];

const RAMP: &str = "motion.run=ramp; motion.ramp.from_rpm=3000; motion.ramp.to_rpm=4000; motion.ramp.duration_s=0.004; motion.ramp.waterfall_cycles=4";
const SWEEP: &str = "motion.run=sweep; motion.sweep.from_rpm=2000; motion.sweep.to_rpm=3000; motion.sweep.speeds=2; motion.sweep.ways=[\"up\"]; motion.warm_up_cycles=3";

const BRANCH: &str = "motion.run=continuation; motion.continuation.from=3000; motion.continuation.to=3200; motion.continuation.longest_step=1.0; motion.continuation.motions=12; motion.continuation.time_points=0; motion.continuation.phases=64; motion.continuation.tail=0.01";

/// A continuation with so few harmonics that more are wanted.
const MORE: &str = "motion.run=continuation; motion.continuation.from=3000; motion.continuation.to=3200; motion.continuation.longest_step=1.0; motion.continuation.motions=12; motion.continuation.time_points=0; motion.continuation.phases=64; motion.continuation.harmonics=2; motion.continuation.tail=1e-3";

/// A plane of four starts.
const BASINS: &str = "motion.run=basins; motion.basins.from_um=-1; motion.basins.to_um=2; motion.basins.from_mm_s=-1; motion.basins.to_mm_s=2; motion.basins.columns=2; motion.basins.rows=2; motion.warm_up_cycles=3";

/// Keys that stand once in a scene.
const SCENE: &[Row] = &[
    ("name", Iso, "", "another"),
    ("pair.normal_module_mm", Iso, "", "3.5"),
    ("pair.normal_pressure_angle_deg", Iso, "", "21"),
    ("pair.face_width_mm", Iso, "", "22"),
    ("pair.mid_face_offset_mm", Iso, "", "2"),
    ("pair.centre_distance_mm", Iso, "", "96"),
    ("pair.addendum_coefficient", Iso, "", "0.95"),
    ("pair.dedendum_coefficient", Iso, "", "1.3"),
    ("pair.root_radius_coefficient", Reduced, "", "0.3"),
    ("pair.misalignment.deviation_um", Reduced, "", "20"),
    ("pair.misalignment.inclination_um", Reduced, "", "20"),
    ("pair.misalignment.in_plane_of_action_um", Reduced, "", "20"),
    ("pair.misalignment.across_plane_of_action_um", Reduced, "", "20"),
    ("operation.driver", Iso, "", "wheel"),
    ("operation.rotation", Reduced, "", "cw"),
    ("operation.torque_nm", Iso, "", "200"),
    ("operation.speed_rpm", Iso, "", "1200"),
    ("contact.method", Reduced, "", "nodal"),
    ("contact.slices", Reduced, "", "20"),
    ("contact.penalty_mpa_per_mm", Reduced, "contact.method=nodal", "1e5"),
    ("contact.gap", Reduced, "contact.method=nodal", "facet"),
    ("contact.points_per_face_edge", Reduced, "contact.method=nodal", "4"),
    ("contact.flanks", Reduced, "", "both"),
    ("accuracy.mean_ste", Reduced, "", "50 %"),
    ("accuracy.peak_to_peak_ste", Reduced, "", "50 %"),
    ("accuracy.first_ste_harmonic", Reduced, "", "50 %"),
    ("accuracy.second_ste_harmonic", Reduced, "", "50 %"),
    ("accuracy.third_ste_harmonic", Reduced, "", "50 %"),
    ("accuracy.max_pair_force", Reduced, "", "50 %"),
    ("accuracy.max_pressure", Reduced, "", "50 %"),
    ("accuracy.contact_line_length", Reduced, "", "50 %"),
    ("accuracy.mesh_stiffness", Reduced, "", "50 %"),
    ("accuracy.mesh_stiffness_tangent", Reduced, "", "50 %"),
    ("accuracy.rms_dte", Motion, "motion.run=steady; motion.warm_up_cycles=1; analysis.model=reduced", "50 %"),
    ("accuracy.peak_to_peak_dte", Motion, "motion.run=steady; motion.warm_up_cycles=1; analysis.model=reduced", "50 %"),
    ("accuracy.pinion_root_stress", Reduced, "output.root_stress=true", "50 %"),
    ("accuracy.wheel_root_stress", Reduced, "output.root_stress=true", "50 %"),
    ("contact.friction", Reduced, "", "0.1"),
    ("contact.corner_contact", Reduced, "operation.torque_nm=2000", "false"),
    ("drive.by", Motion, "", "speed"),
    ("drive.torque_nm", Motion, "drive.by=torque", "160"),
    ("analysis.kind", Reduced, "analysis.cycles=1; contact.slices=4", "dynamic"),
    ("analysis.model", Iso, "", "reduced"),
    ("analysis.reduction", Reduced, "", "general"),
    ("analysis.positions_per_cycle", Iso, "", "8"),
    ("analysis.cycles", Iso, "", "2"),
    ("analysis.turn", Iso, "", "pinion"),
    ("analysis.window_teeth", Reduced, "", "4"),
    ("modes.count", Modes, "", "6"),
    ("modes.below_hz", Modes, "", "20000"),
    ("modes.boundary", Modes, "", "consistent"),
    ("modes.fixed_modes", Modes, "modes.boundary=consistent; modes.count=20", "3"),
    ("modes.damping_ratio", Modes, "", "0.05"),
    ("motion.run", Lumped8, "", "span"),
    ("motion.method", Lumped8, "", "newmark"),
    ("motion.spectral_radius", Lumped8, "", "0.5"),
    ("motion.steps_per_mesh_cycle", Lumped8, "", "32"),
    ("motion.steps_per_resonance", Lumped8, "", "200"),
    ("motion.error_tolerance", Lumped8, "", "1e-6"),
    ("motion.stop_at_events", Motion, "load.amplitude_nm=400; load.frequency_hz=900", "true"),
    ("motion.mesh_damping_ratio", Lumped8, "", "0.02"),
    ("motion.mesh_damping_ns_per_mm2", Motion, "", "0.5"),
    ("motion.periodic_tolerance", Lumped8, "", "0.1"),
    ("motion.warm_up_cycles", Lumped8, "", "3"),
    ("motion.duration_s", Motion, "", "0.006"),
    ("motion.checkpoint_every_cycles", Motion, "", "1"),
    ("motion.ramp.from_rpm", Motion, RAMP, "2500"),
    ("motion.ramp.to_rpm", Motion, RAMP, "4500"),
    ("motion.ramp.duration_s", Motion, RAMP, "0.005"),
    ("motion.ramp.before_s", Motion, RAMP, "0.001"),
    ("motion.ramp.after_s", Motion, RAMP, "0.001"),
    ("motion.ramp.waterfall_cycles", Motion, RAMP, "5"),
    ("motion.sweep.from_rpm", Motion, SWEEP, "1800"),
    ("motion.sweep.to_rpm", Motion, SWEEP, "3200"),
    ("motion.sweep.speeds", Motion, SWEEP, "3"),
    ("motion.sweep.ways", Motion, SWEEP, "[\"down\"]"),
    ("motion.sweep.steady_by", Motion, SWEEP, "shooting"),
    ("motion.continuation.key", Motion, BRANCH, "operation.torque_nm"),
    ("motion.continuation.from", Motion, BRANCH, "3100"),
    ("motion.continuation.to", Motion, BRANCH, "4500"),
    ("motion.continuation.period_cycles", Motion, BRANCH, "2"),
    ("motion.continuation.harmonics", Motion, BRANCH, "6"),
    ("motion.continuation.most_harmonics", Motion, MORE, "2"),
    ("motion.continuation.tail", Motion, BRANCH, "1e-5"),
    ("motion.continuation.phases", Motion, BRANCH, "128"),
    ("motion.continuation.longest_step", Motion, BRANCH, "0.2"),
    ("motion.continuation.motions", Motion, BRANCH, "3"),
    ("motion.continuation.time_points", Motion, BRANCH, "1"),
    ("motion.basins.from_um", Lumped8, BASINS, "-3"),
    ("motion.basins.to_um", Lumped8, BASINS, "3"),
    ("motion.basins.from_mm_s", Lumped8, BASINS, "-3"),
    ("motion.basins.to_mm_s", Lumped8, BASINS, "3"),
    ("motion.basins.columns", Lumped8, BASINS, "3"),
    ("motion.basins.rows", Lumped8, BASINS, "3"),
    ("mesh.stiffness_from", Lumped8, "", "iso"),
    ("mesh.stiffness_n_per_um", Lumped8, "", "4000"),
    ("mesh.stiffness_cos_n_per_um", Lumped8, "", "[300.0]"),
    ("mesh.stiffness_sin_n_per_um", Lumped8, "", "[300.0]"),
    ("mesh.error_cos_um", Lumped8, "", "[0.5]"),
    ("mesh.error_sin_um", Lumped8, "", "[0.5]"),
    ("mesh.half_backlash_um", Lumped8, "", "50"),
    ("mesh.line_sharing", Lumped8, "", "line"),
    ("lumped8.law", Lumped8, "", "projected"),
    (
        "lumped8.speed_fluctuation_rpm",
        Lumped8,
        "lumped8.speed_fluctuation_rpm=0.5; lumped8.speed_fluctuation_hz=100",
        "1",
    ),
    (
        "lumped8.speed_fluctuation_hz",
        Lumped8,
        "lumped8.speed_fluctuation_rpm=1; lumped8.speed_fluctuation_hz=100",
        "120",
    ),
    ("lumped12.orientation_deg", Lumped12, "", "30"),
    ("lumped12.damping_ratio", Lumped12, "", "0.05"),
    ("lumped12.damping_from_hz", Lumped12, "", "200"),
    ("lumped12.damping_to_hz", Lumped12, "", "5000"),
    ("shaft18.mass_damping_per_s", Shaft18, "", "40"),
    ("shaft18.stiffness_damping_s", Shaft18, "", "1e-6"),
    ("shaft18.gravity_m_per_s2", Shaft18, "", "[9.81, 0.0, 0.0]"),
    ("impact.stiffness_n_per_mm_to_exponent", Impact, "", "2e6"),
    ("impact.exponent", Impact, "", "2.0"),
    ("impact.damping_ns_per_mm", Impact, "", "90"),
    ("impact.damping_depth_mm", Impact, "", "0.3"),
    ("impact.static_friction", Impact, "", "0.12"),
    ("impact.dynamic_friction", Impact, "", "0.03"),
    ("impact.static_speed_mm_per_s", Impact, "", "5"),
    ("impact.dynamic_speed_mm_per_s", Impact, "", "2000"),
    ("output.root_stress", Reduced, "", "true"),
    ("output.contact_lines", Reduced, "", "true"),
    (
        "output.flank_orders",
        Reduced,
        "pinion.pitch_errors_um=[5,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,3]",
        "true",
    ),
    ("output.parquet", Iso, "", "true"),
    ("output.vtu", Reduced, "", "true"),
    ("output.fields", Reduced, "output.vtu=true", "[\"pressure\"]"),
    ("output.vtu_every", Reduced, "output.vtu=true", "2"),
    ("output.derivatives", Reduced, "", "[\"pinion.modification.lead_crowning_um\"]"),
];

/// A whole rating of the small pair.
const RATED: &str = "rating.life_h=10000; rating.application_factor=1.25; rating.face_load_factor=1.2; rating.tolerance_class=6; rating.lubricant=mineral VG 220; rating.pinion.material=18CrNiMo7-6; rating.pinion.flank_roughness_rz_um=4; rating.pinion.root_roughness_rz_um=20; rating.wheel.material=18CrNiMo7-6; rating.wheel.flank_roughness_rz_um=4; rating.wheel.root_roughness_rz_um=20";

/// What scuffing and micropitting want beside a rating.
const OILED: &str = "rating.oil_temperature_c=80; rating.lubrication=dip; rating.scuffing=true; rating.structural_factor=1; rating.micropitting=true; rating.material_factor=1; rating.pinion.flank_roughness_ra_um=0.6; rating.wheel.flank_roughness_ra_um=0.6";

/// Keys of a rating.
const RATING: &[Row] = &[
    ("edition", Iso, "", "iso-2006"),
    ("life_h", Iso, "", "20000"),
    ("application_factor", Iso, "", "1.5"),
    ("face_load_factor", Iso, "", "1.3"),
    ("dynamic_factor", Iso, "", "1.4"),
    ("transverse_load_factor", Iso, "", "1.3"),
    ("tolerance_class", Iso, "", "8"),
    ("base_pitch_deviation_um", Iso, "", "60"),
    ("profile_form_deviation_um", Iso, "", "80"),
    ("tip_relief_um", Iso, "rating.tolerance_class=5", "20"),
    ("gear_blank_factor", Iso, "", "0.8"),
    ("limited_pitting", Iso, "", "true"),
    ("long_life_factor", Iso, "", "1.0"),
    ("spectrum", Iso, "", "loads.csv"),
    ("lubricant", Iso, "", "mineral VG 460"),
    ("lubricants", Iso, "", "oils.toml"),
    ("materials", Iso, "", "steels.toml"),
    ("oil_temperature_c", Reduced, OILED, "70"),
    ("lubrication", Reduced, OILED, "spray"),
    ("scuffing", Reduced, OILED, "false"),
    ("structural_factor", Reduced, OILED, "1.15"),
    ("micropitting", Reduced, OILED, "false"),
    ("material_factor", Reduced, OILED, "0.8"),
    (
        "permissible_specific_film_thickness",
        Reduced,
        "rating.oil_temperature_c=80; rating.lubrication=dip; rating.micropitting=true; rating.permissible_specific_film_thickness=0.3; rating.pinion.flank_roughness_ra_um=0.6; rating.wheel.flank_roughness_ra_um=0.6",
        "0.4",
    ),
];

/// Keys of a rated gear.
const RATED_GEAR: &[Row] = &[
    ("material", Iso, "", "42CrMo4 300 HV"),
    ("flank_roughness_rz_um", Iso, "", "12"),
    ("root_roughness_rz_um", Iso, "", "60"),
    ("flank_roughness_ra_um", Reduced, OILED, "0.8"),
    ("reversed_load_ratio", Iso, "", "1"),
    ("meshes_per_turn", Iso, "", "2"),
];

/// Every table with its rows, and words that all of them want.
pub fn tables() -> Vec<(String, &'static str, &'static [Row])> {
    let once =
        [("", "", SCENE), ("material.", "", MATERIAL), ("drive.", "drive.by=torque", TORQUE), ("load.", "", TORQUE)];
    let mut all: Vec<_> = once.map(|(table, words, rows)| (table.to_owned(), words, rows)).into();
    all.push(("rating.".to_owned(), RATED, RATING));
    for gear in ["pinion.", "wheel."] {
        all.push((gear.to_owned(), "", GEAR));
        all.push((format!("{gear}material."), "", MATERIAL));
        all.push((format!("{gear}shaper."), "", SHAPER));
        all.push((format!("rating.{gear}"), RATED, RATED_GEAR));
        all.extend(["", "drive.", "coast."].map(|side| (format!("{gear}modification.{side}"), "", FLANK)));
    }
    all
}
