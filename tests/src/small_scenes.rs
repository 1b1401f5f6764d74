//! One small scene of every model and kind of run, each solved in less than a second: what must give the same bytes
//! whatever the threads, the cache and the interruptions.

/// Name and text of a scene.
pub type SmallScene = (&'static str, String);

const PAIR: &str = "[pinion]
teeth = 17
helix_angle_deg = 12.0
thickness_allowance_mm = 0.04
profile_shift = 0.2
[wheel]
teeth = 23
thickness_allowance_mm = 0.04
[pair]
normal_module_mm = 2.5
face_width_mm = 14.0
[operation]
torque_nm = 60.0
speed_rpm = 3000.0
";
const MESHER: &str = "order = 1\nelements_profile = 2\nelements_fillet = 2\nelements_thickness = 2\nelements_face = 3\n\
                      elements_rim = 1\n";
const MOTION: &str = "[motion]\nsteps_per_mesh_cycle = 16\nsteps_per_resonance = 0\n";
const SPRINGS: &str = "stiffness_x_n_per_mm = 2e5\nstiffness_y_n_per_mm = 2e5\nstiffness_z_n_per_mm = 1e5\n";
const TILTS: &str = "stiffness_rx_nmm_per_rad = 2e8\nstiffness_ry_nmm_per_rad = 2e8\n";
const SERIES: &str = "[mesh]\nstiffness_n_per_um = 180.0\nstiffness_cos_n_per_um = [20.0, 5.0]\nerror_sin_um = [2.0]\n";
const SETTLES: &str = "run = \"steady\"\nwarm_up_cycles = 60\nperiodic_tolerance = 1e-3\n";

fn meshed(rest: &str) -> String {
    format!("{PAIR}[pinion.mesher]\n{MESHER}[wheel.mesher]\n{MESHER}{rest}")
}

fn at_rest(positions: u32, rest: &str) -> String {
    meshed(&format!("[analysis]\npositions_per_cycle = {positions}\n{rest}"))
}

fn moving(cycles: &str, rest: &str) -> String {
    meshed(&format!(
        "[contact]\nslices = 6\n[analysis]\nkind = \"dynamic\"\npositions_per_cycle = 4\n{cycles}{MOTION}{rest}"
    ))
}

fn bearings(lines: &str) -> String {
    ["pinion", "wheel"].map(|gear| format!("[{gear}.bearing]\n{lines}")).concat()
}

fn lumped(model: &str, rest: &str) -> String {
    format!("{PAIR}[analysis]\nmodel = \"{model}\"\ncycles = 4\n{MOTION}{SETTLES}{rest}")
}

/// A steady motion with a checkpoint every few cycles: what is killed and taken up again.
pub fn long_motion(cycles: u32) -> String {
    let text = moving(&format!("cycles = {cycles}\n"), "run = \"span\"\ncheckpoint_every_cycles = 3\n");
    text.replace("steps_per_mesh_cycle = 16", "steps_per_mesh_cycle = 32")
}

/// Positions at rest on meshes whose reduction takes a while.
pub fn long_rest(positions: u32) -> String {
    at_rest(positions, "[contact]\nslices = 12\n").replace("order = 1", "order = 2")
}

/// Steady states at some speeds.
pub fn long_sweep(speeds: u32) -> String {
    let sweep = format!("[motion.sweep]\nfrom_rpm = 2000.0\nto_rpm = 6000.0\nspeeds = {speeds}\n");
    moving("cycles = 1\n", &format!("run = \"sweep\"\nwarm_up_cycles = 20\nperiodic_tolerance = 1e-2\n{sweep}"))
}

/// All of them.
pub fn all() -> Vec<SmallScene> {
    let relief = "[pinion.modification]\ntip_relief_um = 12.0\ntip_relief_start_roll_deg = 28.0\nlead_crowning_um = 4.0\n\
                  [pair.misalignment]\nin_plane_of_action_um = 6.0\n";
    let free = ["pinion", "wheel"].map(|g| format!("[{g}.body]\nfree = [\"x\", \"y\", \"z\"]\n")).concat();
    let shafts = ["pinion", "wheel"].map(|g| {
        format!(
            "[{g}.shaft]\nsegments_mm = [[40.0, 24.0, 0.0], [30.0, 30.0, 8.0], [40.0, 24.0, 0.0]]\ngear_at_mm = 55.0\n\
             run_out_um = 5.0\n[[{g}.shaft.supports]]\nat_mm = 5.0\n{SPRINGS}[[{g}.shaft.supports]]\nat_mm = 105.0\n{SPRINGS}"
        )
    });
    vec![
        ("rest_slices", at_rest(6, &format!("[contact]\nslices = 8\n{relief}[output]\nroot_stress = true\n"))),
        ("rest_friction", at_rest(4, "[contact]\nslices = 6\nfriction = 0.08\nflanks = \"both\"\n")),
        ("rest_nodal", at_rest(3, "[contact]\nmethod = \"nodal\"\npoints_per_face_edge = 3\n")),
        (
            "rest_penalty",
            at_rest(
                3,
                "[contact]\nmethod = \"nodal\"\npenalty_mpa_per_mm = 1e5\ngap = \"facet\"\npoints_per_face_edge = 3\n",
            ),
        ),
        ("rest_general", at_rest(2, "reduction = \"general\"\n[contact]\nslices = 6\n")),
        ("rest_full", at_rest(2, "model = \"full\"\n[contact]\nslices = 6\n")),
        ("rest_iso", format!("{PAIR}[analysis]\nmodel = \"iso\"\npositions_per_cycle = 16\n")),
        ("motion_steady", moving("cycles = 2\n", SETTLES)),
        (
            "motion_free",
            moving(
                "cycles = 3\n",
                &format!("run = \"span\"\nmethod = \"generalised-alpha\"\n{free}{}", bearings(SPRINGS)),
            )
            // With sixteen steps a mesh cycle the method takes a hundredth of the vibration's energy.
            .replace("= 16", "= 32"),
        ),
        (
            "motion_explicit",
            moving("cycles = 2\n", "run = \"span\"\nmethod = \"dormand-prince\"\n").replace("= 16", "= 64"),
        ),
        ("motion_tolerance", moving("cycles = 2\n", "run = \"span\"\nerror_tolerance = 1e-4\nstop_at_events = true\n")),
        ("motion_shooting", moving("cycles = 1\n", "run = \"shooting\"\nperiodic_tolerance = 1e-5\n")),
        (
            "motion_ramp",
            moving(
                "",
                "run = \"ramp\"\n[motion.ramp]\nfrom_rpm = 1500.0\nto_rpm = 4000.0\nduration_s = 0.01\nwaterfall_cycles = 4\n",
            ),
        ),
        ("motion_sweep", long_sweep(3)),
        (
            "motion_modes",
            moving(
                "model = \"reduced+modes\"\ncycles = 2\n",
                "run = \"span\"\n[modes]\ncount = 3\ndamping_ratio = 0.02\n",
            ),
        ),
        ("motion_mapped", moving("model = \"mapped\"\ncycles = 2\n", &format!("{SETTLES}{free}{}", bearings(SPRINGS)))),
        (
            "motion_branch",
            moving(
                "model = \"mapped\"\n",
                "run = \"continuation\"\n[motion.continuation]\nfrom = 3000.0\nto = 9000.0\ntime_points = 2\n",
            ),
        ),
        ("lumped8", lumped("lumped8", &format!("{SERIES}{}", bearings(SPRINGS)))),
        ("lumped12", lumped("lumped12", &format!("{SERIES}{}", bearings(&format!("{SPRINGS}{TILTS}"))))),
        ("shaft18", lumped("shaft18", &format!("{SERIES}{}", shafts.concat()))),
        ("impact", lumped("impact", "").replace("steps_per_resonance = 0\n", "").replace(SETTLES, "run = \"span\"\n")),
    ]
}
