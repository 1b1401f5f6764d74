//! One small document of every kind, and of every model and kind of run, each solved in some seconds at the most: what
//! must give the same bytes whatever the threads, the cache and the interruptions.

use std::{fs, io, path::Path};

/// Files of a question, and the words of `ale-gear` that ask it.
#[derive(Debug, Clone)]
pub struct SmallDocument {
    /// Name of the record.
    pub name: &'static str,
    /// Names and texts.
    pub files: Vec<(&'static str, String)>,
    /// Words of the command, without `--out`.
    pub words: Vec<&'static str>,
}

impl SmallDocument {
    /// A scene that `ale-gear run` solves.
    pub fn scene(name: &'static str, text: String) -> Self {
        Self { name, files: vec![("scene.toml", text)], words: vec!["run", "scene.toml"] }
    }

    /// A scene that another command takes.
    fn asked(name: &'static str, text: String, words: &[&'static str]) -> Self {
        Self { name, files: vec![("scene.toml", text)], words: words.to_vec() }
    }

    /// Writes the files into a folder.
    ///
    /// # Errors
    /// As the system says.
    pub fn lay_out(&self, folder: &Path) -> io::Result<()> {
        self.files.iter().try_for_each(|(name, text)| fs::write(folder.join(name), text))
    }

    /// Words of the command that write the answer into `out`.
    pub fn words_into<'a>(&'a self, out: &'a str, further: &[&'a str]) -> Vec<&'a str> {
        [&self.words[..], &["--out", out, "--quiet"], further].concat()
    }
}

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

const VIBRATION: &str = "[vibration]\nfrom_rpm = 500.0\nto_rpm = 4000.0\nspeeds = 6\norders = 2\nmodes = 6\n";
const RUN_UP: &str =
    "[motion]\nspeed_rpm = 1000.0\nto_speed_rpm = 1500.0\nmesh = \"spring\"\ncycles = 6\nsteps_per_cycle = 20\n";

/// The shipped resonance curve of a gearbox, its first part.
fn gearbox_branch() -> SmallDocument {
    let text = include_str!("../../../scenes/gearbox/resonance_curve.toml")
        .replace("to_speed_rpm = 8500.0", "to_speed_rpm = 11000.0")
        .replace("time_points = 4", "time_points = 1");
    SmallDocument { name: "gearbox_branch", files: vec![("box.toml", text)], words: vec!["run", "box.toml"] }
}

/// Two stages on three shafts, with one bearing by its type: at rest, and what `tasks` ask.
fn gearbox(name: &'static str, tasks: &str) -> SmallDocument {
    let shaft = |name: &str, y: f64, length: f64, diameter: f64| {
        format!(
            "[[shaft]]\nname = \"{name}\"\norigin_mm = [0.0, {y}, 0.0]\n[[shaft.section]]\nlength_mm = {length}\n\
             outer_diameter_mm = {diameter}\n"
        )
    };
    let bearing = |shaft: &str, at: f64, z: &str| {
        format!("[[bearing]]\nshaft = \"{shaft}\"\nposition_mm = {at}\nstiffness_n_per_mm = [2.0e5, 2.0e5, {z}]\n")
    };
    let gear = |name: &str, shaft: &str, at: f64| {
        format!("[[gear]]\nname = \"{name}\"\nshaft = \"{shaft}\"\nposition_mm = {at}\n")
    };
    let mesh = |scene: &str, pinion: &str, wheel: &str| {
        format!("[[mesh]]\nscene = \"{scene}\"\npinion = \"{pinion}\"\nwheel = \"{wheel}\"\n")
    };
    let parts = [
        shaft("fast", 0.0, 90.0, 20.0),
        shaft("middle", 50.5, 110.0, 25.0),
        shaft("slow", 101.0, 90.0, 30.0),
        "[[bearing]]\nshaft = \"fast\"\nposition_mm = 10.0\ntype = \"deep-groove-ball\"\nbore_mm = 20.0\n\
         outer_diameter_mm = 47.0\nstatic_rating_kn = 6.55\n"
            .to_owned(),
        bearing("fast", 80.0, "0.0"),
        bearing("middle", 10.0, "1.0e5"),
        bearing("middle", 100.0, "0.0"),
        bearing("slow", 10.0, "1.0e5"),
        bearing("slow", 80.0, "0.0"),
        gear("1", "fast", 30.0),
        gear("2", "middle", 30.0),
        gear("3", "middle", 70.0),
        gear("4", "slow", 70.0),
        mesh("pair.toml", "1", "2"),
        mesh("pair.toml", "3", "4"),
        "[input]\nshaft = \"fast\"\nposition_mm = 0.0\ninertia_kg_m2 = 0.001\n\
         [[torque]]\nshaft = \"slow\"\nposition_mm = 90.0\ntorque_nm = 60.0\ninertia_kg_m2 = 0.01\n\
         [analysis]\npositions_per_cycle = 4\n"
            .to_owned(),
        tasks.to_owned(),
    ];
    let pair = at_rest(4, "[contact]\nslices = 6\n")
        .replace("helix_angle_deg = 12.0", "helix_angle_deg = 0.0")
        .replace("face_width_mm = 14.0", "face_width_mm = 14.0\ncentre_distance_mm = 50.5");
    SmallDocument {
        name,
        files: vec![("box.toml", parts.concat()), ("pair.toml", pair)],
        words: vec!["run", "box.toml"],
    }
}

/// Plans, optimisations, sweeps, studies and curves of a scene, and a gearbox.
fn other_than_scenes() -> Vec<SmallDocument> {
    let rest = at_rest(4, "[contact]\nslices = 6\n");
    let mapped = moving("model = \"mapped\"\ncycles = 2\n", &format!("{SETTLES}mesh_damping_ratio = 0.05\n"));
    let plan = "scene = \"scene.toml\"\n[vary]\nkeys = [\"operation.torque_nm=40,80\", \
                \"pinion.modification.lead_crowning_um=0,10\"]\noutput = [\"mean_ste_um\", \"max_pressure_mpa\"]\n";
    let study = "[[case]]\nscene = \"scene.toml\"\nvalue = 1\n[[case]]\nscene = \"b.toml\"\nvalue = 2\n\
                 [[quantity]]\ncolumn = \"ste_um\"\n";
    vec![
        gearbox("gearbox", &format!("{VIBRATION}{RUN_UP}")),
        gearbox_branch(),
        gearbox("gearbox_modes", &format!("{VIBRATION}[modes]\ncount = 4\n")),
        SmallDocument {
            name: "plan",
            files: vec![("scene.toml", rest.clone()), ("plan.toml", plan.to_owned())],
            words: vec!["vary", "plan.toml"],
        },
        SmallDocument::asked(
            "plan_of_motions",
            mapped.clone(),
            &["vary", "scene.toml", "--vary", "operation.torque_nm=40:80:2", "--output", "peak_to_peak_dte_um"],
        ),
        SmallDocument::asked("optimum", rest.clone(), &["optimise", "scene.toml", "--torques", "40,80"]),
        SmallDocument::asked(
            "sweep",
            mapped.clone(),
            &["vary", "scene.toml", "--vary", "operation.speed_rpm=3000:5000:3", "--start", "carry"],
        ),
        SmallDocument::asked(
            "curve",
            mapped,
            &["vary", "scene.toml", "--vary", "operation.speed_rpm=3000:5000", "--start", "branch"],
        ),
        SmallDocument {
            name: "study",
            files: vec![
                ("b.toml", rest.replace("torque_nm = 60.0", "torque_nm = 90.0")),
                ("scene.toml", rest),
                ("study.toml", study.to_owned()),
            ],
            words: vec!["run", "study.toml"],
        },
    ]
}

/// Everything that a pair at rest is rated for.
fn rating() -> String {
    let gears = ["pinion", "wheel"].map(|gear| {
        format!(
            "[rating.{gear}]\nmaterial = \"18CrNiMo7-6\"\nflank_roughness_rz_um = 4.8\nflank_roughness_ra_um = 0.6\n\
             root_roughness_rz_um = 20.0\n"
        )
    });
    "[rating]\nlife_h = 2e4\napplication_factor = 1.25\ntolerance_class = 6\nlubricant = \"mineral VG 220\"\n\
     oil_temperature_c = 80.0\nlubrication = \"dip\"\nscuffing = true\nstructural_factor = 1.0\n\
     micropitting = true\nmaterial_factor = 1.0\n"
        .to_owned()
        + &gears.concat()
}

/// All documents.
pub fn all() -> Vec<SmallDocument> {
    scenes().into_iter().map(|(name, text)| SmallDocument::scene(name, text)).chain(other_than_scenes()).collect()
}

/// Names and texts of the scenes.
pub fn scenes() -> Vec<(&'static str, String)> {
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
        ("rest_rated", at_rest(4, &format!("[contact]\nslices = 6\n{}", rating()))),
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
