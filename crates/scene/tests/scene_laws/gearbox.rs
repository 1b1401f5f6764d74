//! The gearbox file: what it says, and how mistakes in it are told.

use std::path::{Path, PathBuf};

use scene::{
    Boundary, Quantity, SceneError, Sense, Tolerance,
    gearbox::{Gearbox, GearboxDrive, MeshModel},
};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/gearbox")
}

fn text() -> String {
    std::fs::read_to_string(folder().join("two_stages.toml")).unwrap()
}

/// The complaint about the two stages with some words put otherwise.
fn refused(from: &str, to: &str) -> SceneError {
    let text = text();
    assert!(text.contains(from), "{from} is not in the file");
    let found = Gearbox::parse(&text.replacen(from, to, 1), &folder().join("two_stages.toml"));
    found.map(|_| ()).expect_err(to)
}

/// Every number of the file in the solver's units: mm, N, rad.
#[test]
fn a_gearbox_is_read_as_it_is_written() {
    let file = Gearbox::read(&folder().join("two_stages.toml")).unwrap();
    assert_eq!((file.shafts.len(), file.bearings.len(), file.gears.len(), file.meshes.len()), (3, 6, 4, 2));
    assert_eq!(file.shafts[1].origin, [91.0, 0.0, 0.0]);
    assert_eq!((file.shafts[1].young_mpa, file.shafts[0].young_mpa), (2.1e5, 2.06e5));
    assert_eq!(file.shafts[1].sections[0].inner, 10.0);
    assert_eq!(file.bearings[1].name, "bearing at 185 mm of fast");
    // Five rows: the turn about z is free. N m/rad of the single values become N mm.
    assert_eq!((file.bearings[2].stiffness[4][0], file.bearings[2].stiffness[5]), (8.0e5, [0.0; 6]));
    assert_eq!(file.bearings[3].stiffness[3][3], 2.0e7);
    assert_eq!((file.gears[2].shaft, file.gears[2].key), (1, 5f64.to_radians()));
    assert_eq!(file.meshes[0].scene.contact.slices, Some(16), "what is set holds");
    assert_eq!(file.input.rotation, Sense::Cw);
    assert_eq!(file.torques[0].torque, 740e3);
    assert_eq!((file.positions_per_cycle, file.cycles), (8, 1));
    let motion = file.motion.unwrap();
    assert_eq!((motion.speed_rpm, motion.drive, motion.mesh), (1500.0, GearboxDrive::Torque, MeshModel::Spring));
    assert_eq!((motion.cycles, motion.steps_per_cycle, motion.steps_per_row), (20, 40, 2));
    assert_eq!((motion.input_torque, motion.highest_frequency_hz), (None, Some(2000.0)));
    // 7850 kg/m^3 in t/mm^3.
    assert!((file.shafts[0].density - 7.85e-9).abs() < 1e-20, "{}", file.shafts[0].density);
}

/// A name is a name: an empty one is refused, of every part and of the file.
#[test]
fn empty_names_are_refused() {
    let whole = text();
    let names: Vec<&str> = whole.lines().filter(|line| line.starts_with("name = ")).collect();
    assert!(names.len() > 8, "{names:?}");
    for line in names {
        let complaint = refused(line, "name = \" \"");
        assert!(
            complaint.to_string().contains("the name is empty") && complaint.place().is_some(),
            "{line}: {complaint}"
        );
    }
}

/// Gears at two heights have the offset that their positions say, whatever heights shafts begin at; what the scene of the
/// pair says of it may agree.
#[test]
fn positions_say_the_offset_of_mid_faces() {
    let of = |text: &str| Gearbox::parse(text, &folder().join("two_stages.toml")).unwrap_or_else(|e| panic!("{e}"));
    let text = text();
    let level = of(&text);
    let shifted = text.replacen("origin_mm = [91.0, 0.0, 0.0]", "origin_mm = [91.0, 0.0, 3.0]", 1);
    assert_eq!(level.meshes.iter().map(|m| m.scene.pair.mid_face_offset_mm).collect::<Vec<_>>(), [Some(0.5), None]);
    assert_eq!(level.meshes[0].scene.pair.centre_distance_mm, Some(91.0));
    let moved = of(&shifted.replacen("[\"contact.slices=16\"]", "[\"pair.mid_face_offset_mm=3.5\"]", 1));
    let apart = |file: &Gearbox, mesh: usize| file.meshes[mesh].scene.pair.mid_face_offset_mm.unwrap_or(0.0);
    // The second stage has its pinion on the shaft that moved.
    let said = [apart(&moved, 0) - apart(&level, 0), apart(&moved, 1) - apart(&level, 1)];
    assert!((said[0] - 3.0).abs() < 1e-12 && (said[1] + 3.0).abs() < 1e-12, "{said:?} mm");
}

/// A gear moves with the cross-section at its mid-plane, or where its seat is said to be: then it may stand beyond
/// the end.
#[test]
fn a_seat_may_be_beside_the_gear() {
    let file = Gearbox::read(&folder().join("overhung_pinion.toml")).unwrap();
    assert_eq!((file.gears[0].position, file.gears[0].seat), (185.0, 155.0));
    assert_eq!((file.gears[1].position, file.gears[1].seat), (185.0, 185.0));
    let text = std::fs::read_to_string(folder().join("overhung_pinion.toml")).unwrap();
    let error =
        Gearbox::parse(&text.replace("seat_mm = 155.0\n", ""), &folder().join("overhung_pinion.toml")).unwrap_err();
    assert!(error.to_string().contains("0 .. 155"), "{error}");
}

/// A duration is whole cycles of the fastest mesh: 17 a turn of the input; a run-up has the mean of both speeds.
#[test]
fn a_motion_lasts_as_long_as_it_says() {
    let motion = |from: &str, to: &str| {
        let text = text();
        assert!(text.contains(from), "{from} is not in the file");
        let read = Gearbox::parse(&text.replacen(from, to, 1), &folder().join("two_stages.toml"));
        read.unwrap_or_else(|e| panic!("{to}: {e}")).motion.unwrap()
    };
    let cycles = |from: &str, to: &str| motion(from, to).cycles;
    assert_eq!(cycles("cycles = 20\nsteps", "duration_s = 0.2\nsteps"), 85);
    assert_eq!(cycles("cycles = 20\nsteps", "duration_s = 0.2001\nsteps"), 86);
    let ramp = (
        "drive = \"torque\"\nmesh = \"spring\"\ncycles = 20",
        "to_speed_rpm = 4500.0\nmesh = \"spring\"\nduration_s = 0.2",
    );
    assert_eq!(cycles(ramp.0, ramp.1), 170);
    // The speed changes as long as the file says, whatever is left of the last cycle.
    let longer = motion(ramp.0, &ramp.1.replace("0.2", "0.2005"));
    assert_eq!((longer.cycles, longer.duration), (171, Some(0.2005)));
    let twice = refused("cycles = 20\nsteps", "cycles = 20\nduration_s = 0.2\nsteps");
    assert!(twice.to_string().contains("both say how long"), "{twice}");
    let long = refused("cycles = 20\nsteps", "duration_s = 1e5\nsteps");
    assert!(long.to_string().contains("cycles of the fastest mesh"), "{long}");
}

/// A motion that settles has its tolerance and its wait; what has no period, or rows beside the ends of cycles, is refused,
/// and so are words that a motion from rest on has no use for.
#[test]
fn a_motion_settles_where_it_can() {
    let steady = "drive = \"speed\"\nrun = \"steady\"\nwarm_up_cycles = 70\n";
    let asked = |words: &str| {
        let text = text().replacen("drive = \"torque\"\n", words, 1);
        Gearbox::parse(&text, &folder().join("two_stages.toml"))
    };
    let motion = asked(steady).unwrap().motion.unwrap();
    assert_eq!((motion.settle, motion.error_tolerance, motion.stop_at_events), (Some((1e-6, 70)), None, false));
    let shot = asked("run = \"shooting\"\nwarm_up_cycles = 70\n").unwrap().motion.unwrap();
    assert_eq!((shot.settle, shot.shoots, motion.shoots), (motion.settle, true, false));
    assert_eq!(asked("").unwrap().motion.unwrap().settle, None, "from rest on, unless it says otherwise");
    for (words, said) in [
        ("drive = \"speed\"\nwarm_up_cycles = 70\n", "`warm_up_cycles` belongs to a motion that settles first"),
        ("periodic_tolerance = 1e-3\n", "`periodic_tolerance` belongs to a motion that settles first"),
        ("drive = \"torque\"\nrun = \"steady\"\n", "has no period"),
        ("run = \"steady\"\nto_speed_rpm = 900.0\n", "never repeats itself"),
        ("drive = \"torque\"\nrun = \"shooting\"\n", "has no period"),
        ("to_speed_rpm = 1500.0\n", "the speed stays"),
    ] {
        let error = asked(words).map(|_| ()).expect_err(words);
        assert!(error.to_string().contains(said) && error.hint().is_some(), "{words}: {error}");
    }
    let beside =
        text().replacen("drive = \"torque\"\n", steady, 1).replacen("steps_per_row = 2", "steps_per_row = 3", 1);
    let error = Gearbox::parse(&beside, &folder().join("two_stages.toml")).unwrap_err();
    assert!(error.to_string().contains("rows of 3 steps do not meet the ends of cycles of 40"), "{error}");
    let few = text().replacen("steps_per_row = 2", "steps_per_row = 11", 1);
    let error = Gearbox::parse(&few, &folder().join("two_stages.toml")).unwrap_err();
    assert!(error.to_string().contains("a cycle of 40 steps with a row each 11"), "{error}");
    assert!(error.hint().unwrap().contains("4 rows a cycle"), "{error}");
}

/// Friction is in the contact itself, at rest and in motion, and in its maps.
#[test]
fn friction_is_for_the_contact_itself() {
    let rough = text().replacen("set = [\"contact.slices=16\"]", "set = [\"contact.friction=0.05\"]", 1);
    let read = |text: &str| Gearbox::parse(text, &folder().join("two_stages.toml"));
    assert!(read(&rough).unwrap_err().to_string().contains("has friction, and [vibration] has none"));
    let (before, after) = rough.split_once("[vibration]").unwrap();
    let rough = format!("{before}[motion]{}", after.split_once("[motion]").unwrap().1);
    let error = read(&rough).unwrap_err();
    assert!(error.to_string().contains("\"first\" has friction, and springs have none"), "{error}");
    for mesh in ["exact", "mapped"] {
        let found = read(&rough.replacen("mesh = \"spring\"", &format!("mesh = \"{mesh}\""), 1)).unwrap();
        assert_eq!(found.meshes[0].scene.contact.friction, 0.05);
    }
}

/// A mistake is told with its line, what is allowed, and what to do.
#[test]
fn mistakes_are_told_with_their_place() {
    let cases = [
        ("shaft = \"fast\"", "shaft = \"fats\"", "\"fats\"", "did you mean \"fast\"?"),
        ("wheel = \"4\"", "wheel = \"2\"", "\"3\" and \"2\" are on one shaft", "two shafts"),
        ("position_mm = 185.0", "position_mm = 285.0", "0 .. 200", ""),
        ("key_deg = 5.0", "key_deg = 5.0\nseat_mm = 300.0", "0 .. 200", ""),
        ("length_mm = 40.0", "length = 40.0", "`length`", "did you mean `length_mm`?"),
        ("inner_diameter_mm = 10.0", "inner_diameter_mm = 40.0", "35 mm wide outside and 40 mm inside", "smaller"),
        ("name = \"middle\"\n", "name = \"fast\"\n", "two shafts with the name \"fast\"", "`name` of its own"),
        ("[2.0e5, 2.0e5, 8.0e4]", "[2.0e5, 2.0e5]", "`stiffness_n_per_mm` has 2 numbers", "give 3"),
        ("scene = \"first_stage.toml\"", "scene = \"none.toml\"", "cannot be read", "relative to the gearbox file"),
        ("set = [\"contact.slices=16\"]", "set = [\"contact.friction=0.1\"]", "has friction", "leave `friction` out"),
        ("set = [\"contact.slices=16\"]", "set = [\"contact.slice=16\"]", "slice", "slices"),
        ("torque_nm = 740.0", "torque_nm = -740.0", "torque_nm", ""),
        ("[[torque]]", "[torque]", "`torque` must be a list", "write `[[torque]]`, with two brackets"),
        ("rotation = \"cw\"", "rotation = \"left\"", "\"left\"", "ccw"),
        ("torque_nm = 740.0", "torque_nm = 0.0", "the mesh \"first\" carries no load", "above 0"),
        (
            "shaft = \"slow\"\nposition_mm = 220.0",
            "shaft = \"middle\"\nposition_mm = 100.0",
            "the mesh \"second\" carries no load",
            "leave the mesh out",
        ),
        (
            "shaft = \"middle\"\nposition_mm = 50.5",
            "shaft = \"middle\"\nposition_mm = 150.0",
            "\"1\" (26 mm wide) and \"2\" (24 mm) do not overlap: their mid-faces are 100 mm apart",
            "`position_mm`",
        ),
        (
            "set = [\"contact.slices=16\"]",
            "set = [\"pair.mid_face_offset_mm=-2\"]",
            "`mid_face_offset_mm` is -2",
            "leave it out of the scene",
        ),
        ("pinion = \"3\"\nwheel = \"4\"", "pinion = \"1\"\nwheel = \"2\"", "have the same gears", "leave one out"),
        ("from_rpm = 400.0", "from_rpm = 7000.0", "speeds from 7000 to 6000", "higher one"),
        ("to_rpm = 6000.0\n", "", "[vibration] has no `to_rpm`", "a number"),
        ("damping_ratio = 0.03", "damping_ratio = 0", "damping_ratio", ""),
        ("input = \"free\"", "input = \"loose\"", "\"loose\"", "held"),
        ("orders = 3", "order = 3", "`order`", "did you mean `orders`?"),
        ("inertia_kg_m2 = 0.02", "inertia_kg_m2 = -0.02", "inertia_kg_m2", ""),
        ("speed_rpm = 1500.0", "speed = 1500.0", "`speed`", "did you mean `speed_rpm`?"),
        ("speed_rpm = 1500.0\n", "", "[motion] has no `speed_rpm`", ""),
        ("mesh = \"spring\"", "mesh = \"sprung\"", "\"sprung\"", "spring"),
        ("drive = \"torque\"", "drive = \"speed\"\ninput_torque_nm = 3.0", "a torque of its own", "a result"),
        ("method = \"energy\"", "spectral_radius = 0.5", "belongs to generalised-alpha", "leave it out"),
        ("cycles = 20\n", "cycles = 1000000\n", "20000000 rows", "raise `steps_per_row`"),
        ("[analysis]", "[housing]\nmatrix_n_mm_rad = [[1.0]]\n[analysis]", "a matrix of 1 rows", "give 36"),
        (
            "matrix_n_mm_rad = [\n",
            "stiffness_n_per_mm = [1.0, 1.0, 1.0]\nmatrix_n_mm_rad = [\n",
            "stiffness twice",
            "not both",
        ),
    ];
    for (from, to, said, hinted) in cases {
        let error = refused(from, to);
        let (message, hint) = (error.to_string(), error.hint().unwrap_or_default());
        assert!(message.contains("two_stages.toml:") && message.contains(said), "{to}: {message}");
        assert!(hint.contains(hinted) || message.contains(hinted), "{to}: {message}; {hint}");
    }
}

/// A housing out of a punch file and out of CalculiX's substructure is the matrix itself, node by node in the order of the
/// bearings.
#[test]
fn a_housing_is_read_from_files_of_other_programs() {
    let scratch = tempfile::tempdir().unwrap();
    for name in ["two_stages.toml", "first_stage.toml", "second_stage.toml"] {
        std::fs::copy(folder().join(name), scratch.path().join(name)).unwrap();
    }
    // Nodes 100, 90, .. 50; each on springs, tied to node 100 along x.
    let nodes: Vec<i64> = (0..6).map(|i| 100 - 10 * i).collect();
    let entry = |i: usize, j: usize| match (i, j) {
        (i, j) if i == j => 1e5 + i as f64,
        (0, k) | (k, 0) if k % 6 == 0 => -1e3,
        _ => 0.0,
    };
    let wanted: Vec<Vec<f64>> = (0..36).map(|i| (0..36).map(|j| entry(i, j)).collect()).collect();
    let mut punch = "DMIG    KHOUSE  0       6       2       0                       36\n".to_owned();
    for (column, values) in wanted.iter().enumerate() {
        punch += &format!("DMIG*   KHOUSE          {:>16}{:>16}\n", nodes[column / 6], column % 6 + 1);
        for (row, value) in values.iter().enumerate().skip(column).filter(|(_, v)| **v != 0.0) {
            let value = format!("{value:.9E}").replace('E', "D+0").replace("D+0-", "D-0");
            punch += &format!("*       {:>16}{:>16}{value:>16}\n", nodes[row / 6], row % 6 + 1);
        }
    }
    std::fs::write(scratch.path().join("house.pch"), &punch).unwrap();
    let of_row = |i: usize| if i % 6 < 3 { nodes[i / 6] } else { nodes[i / 6] + 1 };
    let mut substructure =
        "**\n** GENERATION OF SUBSTRUCTURE\n*USER ELEMENT,NODES= 36,LINEAR\n** ELEMENT NODES\n".to_owned();
    for six in (0..36).collect::<Vec<usize>>().chunks(6) {
        substructure += "**";
        six.iter().for_each(|i| substructure += &format!("{:>10},", of_row(*i)));
        substructure += "\n";
    }
    for i in 0..36 {
        substructure += &if i == 0 { "         1\n".to_owned() } else { format!("{:>10},{:>10}\n", i + 1, i % 3 + 1) };
    }
    substructure += "*MATRIX,TYPE=STIFFNESS\n";
    for (i, row) in wanted.iter().enumerate() {
        for four in row[..=i].chunks(4) {
            four.iter().for_each(|x| substructure += &format!("{x:.13E},"));
            substructure += "\n";
        }
    }
    std::fs::write(scratch.path().join("house.mtx"), &substructure).unwrap();
    let parse = |keys: &str| {
        let text = text().replacen("[analysis]", &format!("[housing]\n{keys}[analysis]"), 1);
        Gearbox::parse(&text, &scratch.path().join("two_stages.toml"))
    };
    let list = |by: i64| format!("{:?}", nodes.iter().map(|n| n + by).collect::<Vec<_>>());
    let punched = parse(&format!("file = \"house.pch\"\nmatrix = \"khouse\"\nnodes = {}\n", list(0))).unwrap();
    assert_eq!(punched.housing.as_ref(), Some(&wanted));
    let condensed = parse(&format!("file = \"house.mtx\"\nnodes = {}\nturn_nodes = {}\n", list(0), list(1))).unwrap();
    assert_eq!(condensed.housing.as_ref(), Some(&wanted));

    let nodes = list(0);
    let cases = [
        (format!("nodes = {nodes}\n"), "has no `file`"),
        ("file = \"house.pch\"\n".to_owned(), "has no `nodes`"),
        ("file = \"house.pch\"\nnodes = [1, 2]\n".to_owned(), "has 2 nodes, and there are 6 bearings"),
        ("file = \"house.pch\"\nnodes = [100, 90, 80, 70, 60, 60]\n".to_owned(), "node 60 twice"),
        ("file = \"house.pch\"\nnodes = [100, 90, 80, 70, 60, 40]\n".to_owned(), "of node 50, which is no seat"),
        (format!("file = \"none.pch\"\nnodes = {nodes}\n"), "cannot be read"),
        (format!("file = \"house.pch\"\nmatrix = \"MAAX\"\nnodes = {nodes}\n"), "without a matrix MAAX"),
        (format!("file = \"house.pch\"\nmatrix_n_mm_rad = [[1.0]]\nnodes = {nodes}\n"), "given twice"),
        (format!("file = \"house.mtx\"\nnodes = {nodes}\n"), "which is no seat"),
        (format!("file = \"first_stage.toml\"\nnodes = {nodes}\n"), "without a DMIG entry"),
    ];
    for (keys, said) in cases {
        let error = parse(&keys).map(|_| ()).expect_err(said);
        assert!(error.to_string().contains("two_stages.toml:") && error.to_string().contains(said), "{keys}{error}");
        assert!(error.hint().is_some(), "{error}");
    }
}

/// What a gearbox cannot be without.
#[test]
fn a_gearbox_has_meshes_and_an_input() {
    let of = |text: &str| Gearbox::parse(text, Path::new("box.toml")).map(|_| ()).unwrap_err().to_string();
    assert!(of("").contains("without meshes"));
    let whole = text();
    let end = whole.find("[input]").unwrap();
    let found = Gearbox::parse(&whole[..end], &folder().join("two_stages.toml")).map(|_| ()).unwrap_err();
    assert!(found.to_string().contains("nothing drives"), "{found}");
    assert!(of("[[shaft]]\nname = \"a\"\n").contains("no sections"));
    assert!(of("[[shaft]]\n").contains("has no `name`"));
}

/// Lines left out, told twice or cut short, and numbers of any size: a gearbox or a complaint with a place, and no panic.
#[test]
fn a_damaged_gearbox_is_read_or_refused() {
    let whole = text();
    let lines: Vec<&str> = whole.lines().collect();
    let file = folder().join("two_stages.toml");
    let (mut read, mut told) = (0, 0);
    let mut meet = |text: &str| match Gearbox::parse(text, &file) {
        Ok(_) => read += 1,
        Err(e) => {
            told += 1;
            assert!(!e.to_string().is_empty() && !e.to_string().contains('\n'), "{e}");
            let _ = (e.hint(), e.excerpt());
        }
    };
    for i in 0..lines.len() {
        let with = |own: &[&str]| [&lines[..i], own, &lines[i + 1..]].concat().join("\n");
        meet(&with(&[]));
        meet(&with(&[lines[i], lines[i]]));
        meet(&with(&[&lines[i][..lines[i].len() / 2]]));
        if let Some((key, _)) = lines[i].split_once(" = ") {
            for value in ["nan", "inf", "-1", "0", "1e300", "[]", "[[1.0]]", "\"\"", "true", "{}"] {
                meet(&with(&[&format!("{key} = {value}")]));
            }
        }
    }
    assert!(read > 50 && told > 500, "{read} were read, {told} refused");
}

/// What [accuracy] of a gearbox asks is read; what it cannot have is refused with its line and a hint, and so is the
/// table in the scene of a pair.
#[test]
fn an_accuracy_is_asked_in_the_document_of_the_gearbox() {
    let file = folder().join("accurate.toml");
    let text = std::fs::read_to_string(&file).unwrap();
    let own = Gearbox::read(&file).unwrap();
    assert_eq!(own.accuracy.of(Quantity::FaceLoadFactor), Some(Tolerance::Absolute(0.5)));
    assert_eq!(own.accuracy.of(Quantity::BearingForce), Some(Tolerance::Relative(0.02)));
    assert_eq!(own.shaft_elements, 12);
    let without = |tables: &[&str]| {
        let keep = |part: &&str| !tables.iter().any(|table| part.starts_with(table));
        text.split("\n[").filter(keep).collect::<Vec<_>>().join("\n[")
    };
    let motion =
        without(&["vibration]"]).replace("natural_frequency = \"2 %\"\n", "") + "[motion]\nspeed_rpm = 500.0\n";
    for (wrong, says) in [
        (motion, "[accuracy] with [motion]"),
        (without(&["vibration]"]), "`natural_frequency` is asked for, but no vibration"),
        (text.replace("face_load_factor = \"0.5\"", "face_load_factor = \"0.5 um\""), "`0.5 um` is not an accuracy"),
        (
            text.replace("[mesh.scene.operation]", "[mesh.scene.accuracy]\nmean_ste = \"1 %\"\n[mesh.scene.operation]"),
            "asks for an accuracy",
        ),
        (text.replace("bearing_force", "rms_dte"), "rms_dte"),
    ] {
        let error = Gearbox::parse(&wrong, &file).map(|_| ()).expect_err(says);
        assert!(error.to_string().contains(says) && error.hint().is_some(), "{says}: {error}");
    }
}

/// Modes of gears are those that a pair has; what they cannot have is refused with its line and a hint.
#[test]
fn modes_of_gears_belong_to_a_vibration() {
    let file = folder().join("elastic_gears.toml");
    let text = std::fs::read_to_string(&file).unwrap();
    let own = Gearbox::read(&file).unwrap().modes.unwrap();
    assert_eq!((own.count, own.below_hz, own.boundary), (None, Some(12000.0), Boundary::Massless));
    let other = Gearbox::read(&folder().join("elastic_pair.toml")).unwrap().modes.unwrap();
    assert_eq!((other.count, other.boundary, other.fixed_modes), (Some(12), Boundary::Consistent, Some(2)));
    let (without, _) = text.split_once("[vibration]").unwrap();
    for (wrong, says) in [
        (format!("{without}[modes]\ncount = 6\n"), "[modes] belongs to a vibration"),
        (format!("{text}[motion]\nspeed_rpm = 500.0\n"), "[modes] with a motion of `mesh = \"mapped\"`"),
        (text.replace("boundary = ", "count = 6\nboundary = "), "both say which modes are kept"),
        (text.replace("boundary = ", "fixed_modes = 6\nboundary = "), "`fixed_modes` belongs to"),
        (text.replace("below_hz = 12000.0", "damping_ratio = 0.1"), "`damping_ratio` of [modes] is that of a motion"),
    ] {
        let error = Gearbox::parse(&wrong, &file).map(|_| ()).expect_err(says);
        assert!(error.to_string().contains(says) && error.hint().is_some(), "{says}: {error}");
    }
}

/// A load over time is read as that of a pair, and told where it has no meaning.
#[test]
fn loads_over_time_act_in_motion() {
    let load = "torque_nm = 740.0\n";
    let with = |more: &str| format!("{load}{more}\n");
    let read = |more: &str| {
        let found = Gearbox::parse(&text().replacen(load, &with(more), 1), &folder().join("two_stages.toml"));
        found.unwrap_or_else(|e| panic!("{e}")).torques[0].over_time.clone().expect(more)
    };
    let table = read("table_s_nm = [[0.0, 740.0], [0.1, -20.0]]");
    assert_eq!(table.table(), Some([vec![0.0, 0.1], vec![740e3, -20e3]]));
    let harmonic = read("amplitude_nm = 10.0\nfrequency_hz = 50.0\nphase_deg = 90.0");
    assert_eq!(harmonic.harmonic(), Some([1e4, 50.0, std::f64::consts::FRAC_PI_2]));
    let table = with("table_s_nm = [[0.0, 740.0], [0.1, -20.0]]");
    let alone = refused(load, &with("phase_deg = 10.0"));
    assert!(alone.to_string().contains("makes no harmonic torque"), "{alone}");
    let back = refused(load, &with("table_s_nm = [[0.0, 740.0], [0.0, 20.0]]"));
    assert!(back.to_string().contains("goes back to 0 s"), "{back}");
    let file = folder().join("two_stages.toml");
    let (rest, _) = text().split_once("[motion]").map(|(a, b)| (a.to_owned(), b.to_owned())).unwrap();
    let at_rest = Gearbox::parse(&rest.replacen(load, &table, 1), &file).expect_err("no motion");
    assert!(at_rest.to_string().contains("`table_s_nm` acts in motion alone"), "{at_rest}");
    let settled = format!("{}[motion]\nspeed_rpm = 1000.0\nrun = \"steady\"\n", rest.replacen(load, &table, 1));
    let settled = Gearbox::parse(&settled, &file).expect_err("it settles");
    assert!(settled.to_string().contains("its period is none of the meshes"), "{settled}");
}

/// A gear in two meshes has one shape: what two scenes say of it differs in nothing, and the refusal names key, values and
/// meshes; a scene that leaves to the program what the other one says is told so.
#[test]
fn a_gear_of_two_meshes_has_one_shape() {
    let path = folder().join("idler.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(Gearbox::parse(&text, &path).is_ok());
    let of_second = text.find("name = \"idler, wheel\"").unwrap();
    let refused = |from: &str, to: &str| {
        let (before, after) = text.split_at(of_second);
        let text = before.to_owned() + &after.replacen(from, to, 1);
        Gearbox::parse(&text, &path).map(|_| ()).expect_err(to)
    };
    for (from, to, said) in [
        ("bore_diameter_mm = 50.0", "bore_diameter_mm = 48.0", "`bore_diameter_mm` 50 in mesh"),
        ("bore_diameter_mm = 50.0\n", "", "`bore_diameter_mm` 50 in mesh"),
        ("teeth = 31", "profile_shift = 0.1\nteeth = 31", "`profile_shift` 0 in mesh"),
        ("teeth = 31", "tip_diameter_mm = 101.0\nteeth = 31", "`tip_diameter_mm` its default in mesh"),
        ("-15.0", "-14.9", "`helix_angle_deg`"),
    ] {
        let error = refused(from, to);
        let told = error.to_string();
        assert!(told.contains("gear \"idler\" has") && told.contains(said), "{told}");
        assert!(told.contains("pinion, idler") && told.contains("idler, wheel") && error.hint().is_some(), "{told}");
    }
}

/// What a gearbox does not read is refused where it stands, with what to do: files that only a pair writes, bodies of a pair,
/// settings of maps without maps, and a motion that begins without a load.
#[test]
fn what_a_gearbox_does_not_read_is_refused() {
    let slices = "set = [\"contact.slices=16\"]";
    for key in ["vtu=true", "contact_lines=true", "parquet=true", "derivatives=[\"pair.misalignment.deviation_um\"]"] {
        let complaint = refused(slices, &format!("set = ['output.{key}']"));
        let (name, _) = key.split_once('=').unwrap();
        let said = format!("asks for `{name}` in [output]");
        assert!(complaint.to_string().contains(&said) && complaint.hint().is_some(), "{key}: {complaint}");
    }
    for (key, cure) in
        [("pinion.body.mass_kg=2", "[[gear]]"), ("wheel.bearing.stiffness_x_n_per_mm=1e5", "[[bearing]]")]
    {
        let complaint = refused(slices, &format!("set = [\"{key}\"]"));
        let hint = complaint.hint().unwrap_or_default();
        assert!(hint.contains(cure) && !hint.contains("kind"), "{key}: {complaint}: {hint}");
    }
    for key in ["map_tolerance = 1e-3", "map_overload = 6.0"] {
        for mesh in ["spring", "exact"] {
            let complaint = refused("mesh = \"spring\"\n", &format!("mesh = \"{mesh}\"\n{key}\n"));
            assert!(complaint.to_string().contains("belongs to maps"), "{mesh}, {key}: {complaint}");
        }
    }
    let load = "torque_nm = 740.0\n";
    for (law, cure) in [
        ("table_s_nm = [[0.0, 0.0], [0.1, 740.0]]", "first row"),
        ("table_s_nm = [[-0.1, -740.0], [0.1, 740.0]]", "first row"),
        ("amplitude_nm = 740.0\nfrequency_hz = 5.0\nphase_deg = 180.0", "phase_deg"),
    ] {
        let complaint = refused(load, &format!("{load}{law}\n"));
        let hint = complaint.hint().unwrap_or_default();
        assert!(complaint.to_string().contains("begins with a load of 0") && hint.contains(cure), "{law}: {complaint}");
    }
}
