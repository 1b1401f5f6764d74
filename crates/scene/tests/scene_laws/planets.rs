//! Planets of a gearbox file: what one table writes out, and what cannot be.

use std::path::{Path, PathBuf};

use scene::{
    SceneError, Setting, Starter,
    gearbox::{Gearbox, GearboxBearing, StageHeld, StageStarter},
};

fn file() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/gearbox/planetary_stage.toml")
}

/// The stage with some words put otherwise.
fn text(changes: &[(&str, &str)]) -> String {
    changes.iter().fold(std::fs::read_to_string(file()).unwrap(), |text, (from, to)| {
        assert!(text.contains(from), "{from} is not in the file");
        text.replacen(from, to, 1)
    })
}

fn read(changes: &[(&str, &str)]) -> Result<Gearbox, SceneError> {
    Gearbox::parse(&text(changes), &file())
}

const COUNT: &str = "count = 3\nangles_deg = [0.0, 120.0, 240.0]    # multiples of 360/(21 + 81): teeth meet gaps\n";
const ERRORS: &str = "tangential_errors_um = [10.0, 0.0, 0.0]\nradial_errors_um = [0.0, 0.0, 5.0]\n";
const PIN: &str = "origin_mm = [76.5, 0.0, -24.0]";
const LOAD: &str = "torque_nm = 810.0";
const SHAFTS: &str = "shafts = [\"planet\", \"pin\"]\n";

/// One planet stands for three: shafts and bearings around the carrier, turned with their seats, meshes of all of them, and
/// names with numbers.
#[test]
fn one_planet_is_written_for_all() {
    let errors = "tangential_errors_um = [10.0, 0.0, -4.0]\nradial_errors_um = [0.0, 6.0, 0.0]\n";
    let plate = "name = \"plate a\"\nshaft = \"pin\"\nin_shaft = \"carrier\"\nposition_mm = 4.0\n\
                 stiffness_n_per_mm = [2e6, 2e6, 2e6]";
    let oval = plate.replace("[2e6, 2e6, 2e6]", "[3e6, 1e6, 2e6]");
    let own = read(&[(ERRORS, errors), (plate, &oval)]).unwrap();
    assert_eq!((own.shafts.len(), own.bearings.len(), own.gears.len(), own.meshes.len()), (9, 18, 5, 6));
    let names: Vec<&str> = own.shafts.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names[..4], ["sun", "planet 1", "planet 2", "planet 3"]);
    let meshes: Vec<&str> = own.meshes.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(meshes[..4], ["sun, planet 1", "sun, planet 2", "sun, planet 3", "planet, ring 1"]);
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * (1.0 + b.abs()), "{a} beside {b}");
    let (sin, cos) = 120f64.to_radians().sin_cos();
    let second = own.shafts.iter().find(|s| s.name == "pin 2").unwrap();
    near(second.origin[0], 76.5 * cos);
    near(second.origin[1], 76.5 * sin);
    assert!(second.stands && own.shafts.iter().filter(|s| s.stands).count() == 4);
    let bearing = |name: &str| -> &GearboxBearing { own.bearings.iter().find(|b| b.name == name).unwrap() };
    // Pins stand off in the carrier, planets do not on their pins.
    let offsets = [
        ("plate a 1", [0.0, 10e-3]),
        ("plate b 2", [6e-3 * cos, 6e-3 * sin]),
        ("plate a 3", [-4e-3 * sin, -4e-3 * cos]),
    ];
    for (name, wanted) in offsets {
        (0..2).for_each(|k| near(bearing(name).seat_offset[k], wanted[k]));
    }
    assert_eq!(bearing("needles a 1").seat_offset, [0.0; 3]);
    assert_eq!(bearing("needles a 2").in_shaft, own.shafts.iter().position(|s| s.name == "pin 2"));
    // K turned by 120 degrees: k_xx = cos^2 k_x + sin^2 k_y, k_xy = sin cos (k_x - k_y).
    let turned = bearing("plate a 2").stiffness;
    near(turned[0][0], 1.5e6);
    near(turned[0][1], sin * cos * 2e6);
    near(turned[5][5], 1e8);
    assert_eq!(bearing("plate a 1").stiffness[0][0], 3e6);
    let planets = &own.planets[0];
    assert_eq!((planets.name.as_str(), planets.angles.len(), planets.meshes.len()), ("planet", 3, 2));
    assert_eq!((planets.meshes[1].name.as_str(), &planets.meshes[1].of_planets[..]), ("planet, ring", &[3, 4, 5][..]));
}

/// A key of a mesh sets those of all planets by its number or name in the file, and that of one planet by the name with its
/// number.
#[test]
fn one_mesh_sets_all_planets() {
    let slices = |which: &str| -> Vec<Option<u32>> {
        let setting = Setting::parse(&format!("mesh.{which}.scene.contact.slices=9")).unwrap();
        let own = Gearbox::parse_with(&text(&[]), &file(), &[setting]).unwrap_or_else(|e| panic!("{e}"));
        own.meshes.iter().map(|m| m.scene.contact.slices).collect()
    };
    let of =
        |set: [usize; 3]| -> Vec<Option<u32>> { (0..6).map(|i| Some(if set.contains(&i) { 9 } else { 8 })).collect() };
    assert_eq!(slices("1"), of([3, 4, 5]));
    assert_eq!(slices("\"sun, planet\""), of([0, 1, 2]));
    assert_eq!(slices("\"sun, planet 2\""), of([1; 3]));
    let own = read(&[]).unwrap();
    let called =
        ["0", "1", "sun, planet", "planet, ring", "planet, ring 3", "2", "none"].map(|name| own.mesh_called(name));
    assert_eq!(called, [Some(0), Some(3), Some(0), Some(3), Some(5), None, None]);
    let setting = Setting::parse("mesh.2.scene.contact.slices=9").unwrap();
    let error = Gearbox::parse_with(&text(&[]), &file(), &[setting]).map(|_| ()).unwrap_err();
    assert!(error.to_string().contains("there are 0 (\"sun, planet\"), 1 (\"planet, ring\")"), "{error}");
}

/// Stated angles where teeth go in, not evenly; four planets of 102 teeth in sun and ring go in at multiples of 360/102
/// degrees only.
#[test]
fn planets_go_in_where_teeth_meet_gaps() {
    let step = 360.0 / 102.0;
    let angles = format!("count = 4\nangles_deg = [0.0, {:?}, 180.0, {:?}]\n", 26.0 * step, 180.0 + 26.0 * step);
    let own = read(&[(COUNT, &angles), (ERRORS, "")]).unwrap();
    assert_eq!((own.shafts.len(), own.meshes.len()), (11, 8));
    let error = read(&[(COUNT, "count = 4\n"), (ERRORS, "")]).map(|_| ()).unwrap_err();
    let (said, hint) = (error.to_string(), error.hint().unwrap_or_default());
    assert!(said.contains("planet 2 at 90.0000 degrees does not go in") && said.contains("by 0.50 pitches"), "{said}");
    assert!(hint.contains("multiples of 3.529412 degrees") && hint.contains("`angles_deg`"), "{hint}");
}

/// What cannot be is told with its line, and what to do.
#[test]
fn mistakes_are_told_with_their_place() {
    let cases: &[(&str, &str, &str, &str)] = &[
        (SHAFTS, "shafts = [\"plant\", \"pin\"]\n", "`shafts` is \"plant\"", "did you mean \"planet\"?"),
        (SHAFTS, "", "[[planets]] has no `shafts`", "names of the shafts"),
        (SHAFTS, "shafts = []\n", "[[planets]] has no `shafts`", ""),
        (SHAFTS, "shafts = [\"planet\", \"planet\"]\n", "\"planet\" is in [[planets]] twice", "one planet"),
        ("around = \"carrier\"", "around = \"pin\"", "\"pin\" is in [[planets]] twice", "around itself"),
        ("around = \"carrier\"", "around = \"carier\"", "`around` is \"carier\"", "did you mean \"carrier\"?"),
        ("around = \"carrier\"\n", "", "[[planets]] has no `around`", "they stand around"),
        (COUNT, "", "[[planets]] has no `count`", "how many"),
        (COUNT, "count = 1\n", "`count`", "2 .. 24"),
        (COUNT, "count = 3\nangles_deg = [0.0, 120.0]\n", "`angles_deg` has 2 numbers", "give 3"),
        (COUNT, "count = 3\nangles_deg = [120.0, 0.0, 240.0]\n", "120 degrees from itself", "begin with 0"),
        (
            COUNT,
            "count = 3\nangles_deg = [0.0, 0.0, 240.0]\n",
            "run into each other: their axes are 0.000 mm apart",
            "",
        ),
        (
            COUNT,
            "count = 3\nangles_deg = [0.0, 120.0, -240.0]\n",
            "run into each other: their axes are 0.000 mm apart",
            "",
        ),
        (SHAFTS, "shafts = [\"planet\"]\n", "turns on \"pin\", which is no part of the planet", "name it in `shafts`"),
        (PIN, "origin_mm = [60.0, 0.0, -24.0]", "whose axis is 16.500 mm beside its own", "`origin_mm`"),
        (LOAD, "torque_nm = 0.0", "carries no load", "above 0"),
        (
            COUNT,
            "count = 3\nangles_deg = [0.0, 121.0, 240.0]\n",
            "planet 2 at 121.0000 degrees does not go in",
            "120.000000",
        ),
        (ERRORS, "tangential_errors_um = [10.0]\n", "`tangential_errors_um` has 1 numbers", "give 3"),
        (ERRORS, "radial_errors_um = [10.0, 0.0, 20000.0]\n", "radial_errors_um", "10000"),
        (
            "origin_mm = [76.5, 0.0, -24.0]",
            "origin_mm = [0.0, 0.0, -24.0]",
            "\"pin 1\" stands on the axis of \"carrier\"",
            "`origin_mm`",
        ),
        (
            "[input]\nshaft = \"sun\"",
            "[input]\nshaft = \"planet\"",
            "the input on \"planet\", which is a planet",
            "sun, ring or carrier",
        ),
        (
            "[[torque]]\nshaft = \"ring\"",
            "[[torque]]\nshaft = \"pin\"",
            "a torque on \"pin\", which is a planet",
            "in the middle",
        ),
        (
            "shaft = \"sun\"\nposition_mm = 5.0",
            "shaft = \"sun\"\nin_shaft = \"pin\"\nposition_mm = 5.0",
            "sits in \"pin\", which is a planet, and its shaft is none of it",
            "`in_shaft`",
        ),
        (
            "position_mm = 8.0\n",
            "position_mm = 8.0\ndamping_n_s_per_mm = [1.0, 2.0, 0.0]\n",
            "\"needles a 1\" is of a planet, and its damping along x and y differs",
            "one value",
        ),
        (
            "position_mm = 8.0\n",
            "position_mm = 8.0\nturn_stiffness_nm_per_rad = 10.0\n",
            "\"needles a 1\" holds the turn of \"planet 1\", which turns",
            "`stands = true`",
        ),
        (
            "position_mm = 8.0\n",
            "position_mm = 8.0\nseat_offset_um = [1.0]\n",
            "`seat_offset_um` has 1 numbers",
            "give 3",
        ),
        ("in_shaft = \"pin\"", "in_shaft = \"pins\"", "`in_shaft` is \"pins\"", "did you mean \"pin\"?"),
        ("in_shaft = \"pin\"", "in_shaft = \"planet\"", "is between \"planet 1\" and itself", "another shaft"),
        (
            "in_shaft = \"pin\"",
            "in_shaft = \"ring\"",
            "76.5 mm beside the axis of \"ring\", which turns",
            "`stands = true`",
        ),
        (
            "origin_mm = [76.5, 0.0, -24.0]",
            "origin_mm = [76.5, 0.0, -4.0]",
            "the seat of \"needles a 1\" is -2 mm from z = 0 of \"pin 1\", which is 54 mm long",
            "lengthen",
        ),
        (
            "name = \"sun\"\n",
            "name = \"sun\"\nstands = true\n",
            "\"sun\" stands, and nothing holds its turn",
            "`turn_stiffness_nm_per_rad`",
        ),
        (
            "name = \"carrier\"\n",
            "name = \"carrier\"\nheld = true\n",
            "\"carrier\" is held, rigid in rigid bearings",
            "leave `held` out",
        ),
        (
            "position_mm = 5.0\n",
            "position_mm = 5.0\nturn_stiffness_nm_per_rad = 10.0\n",
            "holds the turn of \"sun\", which turns",
            "",
        ),
    ];
    for (from, to, said, hinted) in cases {
        // An error list of three would be told first where there are other counts.
        let error = read(&[(from, to)]).map(|_| ()).expect_err(to);
        let (message, hint) = (error.to_string(), error.hint().unwrap_or_default());
        assert!(message.contains("planetary_stage.toml:") && message.contains(said), "{to}: {message}; {hint}");
        assert!(hint.contains(hinted) || message.contains(hinted), "{to}: {message}; {hint}");
    }
}

/// More planets than have room, what stands with parts that turn, and planets of two tables that are not as many.
#[test]
fn planets_have_room_and_drive() {
    let told = |changes: &[(&str, &str)], said: &str| {
        let error = read(changes).map(|_| ()).expect_err(said);
        assert!(error.to_string().contains(said) && error.hint().is_some(), "{error}");
    };
    let room = "run into each other: their axes are 76.500 mm apart, the tip diameter is 96.000 mm";
    told(&[(COUNT, "count = 6\n"), (ERRORS, "")], room);
    // A sun that stands, held by its bearing.
    let turn = "position_mm = 5.0\nturn_stiffness_nm_per_rad = 10.0\n";
    let stands = [("name = \"sun\"\n", "name = \"sun\"\nstands = true\n"), ("position_mm = 5.0\n", turn)];
    told(&stands, "a gear is on \"sun\", which stands");
    let elsewhere = [stands[0], stands[1], ("name = \"sun\"\nshaft = \"sun\"", "name = \"sun\"\nshaft = \"ring\"")];
    told(&elsewhere, "the input is on \"sun\", which stands");
    let loaded =
        [("[[torque]]\nshaft = \"ring\"\nposition_mm = 115.0", "[[torque]]\nshaft = \"carrier\"\nposition_mm = 10.0")];
    told(&loaded, "a torque is on \"carrier\", which stands");
    let carrier = [
        ("name = \"carrier\"\n", "name = \"carrier\"\nheld = true\n"),
        ("in_shaft = \"carrier\"\n", ""),
        ("in_shaft = \"carrier\"\n", ""),
    ];
    told(&carrier, "\"carrier\" stands and is held: nothing of it moves");
    let two = "count = 3\n[[planets]]\nshafts = [\"sun\"]\naround = \"ring\"\ncount = 2\n[[planets]]\nshafts = [\"pin\"]\n\
               around = \"ring\"\ncount = 3\n";
    let sun = [
        (SHAFTS, "shafts = [\"planet\"]\n"),
        (COUNT, two),
        ("[input]\nshaft = \"sun\"\nposition_mm = 0.0", "[input]\nshaft = \"ring\"\nposition_mm = 115.0"),
        ("in_shaft = \"pin\"\n", ""),
        ("in_shaft = \"pin\"\n", ""),
        (
            "origin_mm = [0.0, 0.0, -60.0]\n[[shaft.section]]\nlength_mm = 80.0",
            "origin_mm = [10.0, 0.0, -60.0]\n[[shaft.section]]\nlength_mm = 80.0",
        ),
        (ERRORS, ""),
    ];
    told(&sun, "planets that mesh with planets are as many of each");
}

/// With a ring that is fixed in space the carrier takes the load; what a turning frame would change is refused.
#[test]
fn a_ring_is_fixed_in_space() {
    let file = file().with_file_name("planetary_stage_ring_fixed.toml");
    let text = std::fs::read_to_string(&file).unwrap();
    let own = Gearbox::parse(&text, &file).unwrap();
    let ring = own.fixed_shaft().unwrap();
    assert!(own.shafts[ring].name == "ring" && own.shafts[own.torques[0].shaft].stands);
    let turn = "turn_stiffness_nm_per_rad = 1e7\n";
    let cases = [
        (turn, "", "\"ring\" is fixed, and nothing holds its turn"),
        ("name = \"sun\"\norigin", "name = \"sun\"\nfixed = true\norigin", "\"sun\" and \"ring\" are fixed in space"),
        (
            "name = \"carrier a\"\n",
            "name = \"carrier a\"\nseat_offset_um = [5.0, 0.0, 0.0]\n",
            "not the same all round",
        ),
        ("[800000.0, 800000.0, 0.0]", "[800000.0, 700000.0, 0.0]", "not the same all round"),
        ("[analysis]\n", "[modes]\n[motion]\nspeed_rpm = 100.0\n[analysis]\n", "beside [modes] in a [motion]"),
        (
            "name = \"needles a\"\nshaft = \"planet\"\nin_shaft = \"pin\"\n",
            "name = \"needles a\"\nshaft = \"planet\"\n",
            "seen from the carrier that place turns",
        ),
        (
            "shaft = \"carrier\"\nposition_mm = 0.0",
            "shaft = \"ring\"\nposition_mm = 0.0",
            "a torque is on \"ring\", which is fixed",
        ),
    ];
    for (from, to, said) in cases {
        assert!(text.contains(from), "{from}");
        let error = Gearbox::parse(&text.replacen(from, to, 1), &file).map(|_| ()).expect_err(to);
        assert!(error.to_string().contains(said) && error.hint().is_some(), "{to}: {error}");
    }
}

/// A stage that is started from numbers of teeth is a gearbox whose planets mesh with sun and ring at one distance, without
/// backlash but for the thinning of the teeth, and whose planets stand where teeth meet gaps, or it is told why not.
#[test]
fn started_stages_fit_together() {
    let started = |teeth: [i32; 3], planets: usize, held: StageHeld, pair: Starter| {
        let stage =
            StageStarter { pair: Starter { teeth: [teeth[0], teeth[1]], ..pair }, ring_teeth: teeth[2], planets, held };
        assert!(stage.most_planets().unwrap() >= planets);
        stage.text("stage.toml").map(|text| Gearbox::parse(&text, "stage.toml".as_ref()).unwrap())
    };
    let spur = Starter { helix_deg: 0.0, ..Starter::default() };
    let small = Starter { helix_deg: -18.0, module_mm: 0.7, face_width_mm: 7.3, ..Starter::default() };
    let shifted = Starter { profile_shift: [0.4, 0.2], module_mm: 4.0, ..spur.clone() };
    let (ring, carrier) = (StageHeld::Ring, StageHeld::Carrier);
    let cases = [
        ([21, 30, -81], 3, ring, spur.clone()),
        ([24, 30, -84], 4, carrier, small),
        ([18, 27, -73], 3, ring, shifted.clone()),
        ([30, 19, -69], 5, ring, shifted),
    ];
    for (teeth, planets, held, pair) in cases {
        let file = started(teeth, planets, held, pair.clone()).unwrap_or_else(|e| panic!("{teeth:?}: {e}"));
        assert_eq!(file.meshes.len(), 2 * planets, "{teeth:?}");
        let distances = file.meshes.iter().map(|mesh| mesh.scene.gear_pair().unwrap().centre_distance().abs());
        let distances: Vec<f64> = distances.collect();
        assert!(distances.iter().all(|a| (a / distances[0] - 1.0).abs() < 1e-9), "{teeth:?}: {distances:?}");
        for mesh in &file.meshes {
            let pair = mesh.scene.gear_pair().unwrap();
            let free = mesh.scene.pinion.thickness_allowance_mm + mesh.scene.wheel.thickness_allowance_mm;
            let backlash = pair.backlash();
            assert!(backlash > 0.5 * free && backlash < 1.5 * free, "{teeth:?}: {backlash} mm of {free} mm");
        }
        assert_eq!(file.shafts.iter().any(|shaft| shaft.fixed), held == ring);
        assert_eq!(file.torques[0].torque.abs(), 1e3 * pair.torque_nm);
    }
    let refused = started([21, 30, -60], 3, ring, spur).unwrap_err();
    assert!(refused.to_string().contains("profile_shift"), "{refused}");
}
