//! The gearbox file: what it says, and how mistakes in it are told.

use std::path::{Path, PathBuf};

use scene::{
    Rotation, SceneError,
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
    assert_eq!(file.input.rotation, Rotation::Cw);
    assert_eq!(file.torques[0].torque, 740e3);
    assert_eq!((file.positions_per_cycle, file.cycles), (8, 1));
    let motion = file.motion.unwrap();
    assert_eq!((motion.speed_rpm, motion.drive, motion.mesh), (1500.0, GearboxDrive::Torque, MeshModel::Spring));
    assert_eq!((motion.cycles, motion.steps_per_cycle, motion.steps_per_row), (20, 40, 2));
    assert_eq!((motion.input_torque, motion.highest_frequency_hz), (None, Some(2000.0)));
    // 7850 kg/m^3 in t/mm^3.
    assert!((file.shafts[0].density - 7.85e-9).abs() < 1e-20, "{}", file.shafts[0].density);
}

/// A mistake is told with its line, what is allowed, and what to do.
#[test]
fn mistakes_are_told_with_their_place() {
    let cases = [
        ("shaft = \"fast\"", "shaft = \"fats\"", "\"fats\"", "did you mean \"fast\"?"),
        ("wheel = \"4\"", "wheel = \"2\"", "\"3\" and \"2\" are on one shaft", "two shafts"),
        ("position_mm = 185.0", "position_mm = 285.0", "0 .. 200", ""),
        ("length_mm = 40.0", "length = 40.0", "`length`", "did you mean `length_mm`?"),
        ("inner_diameter_mm = 10.0", "inner_diameter_mm = 40.0", "35 mm wide outside and 40 mm inside", "smaller"),
        ("name = \"middle\"\n", "name = \"fast\"\n", "two shafts with the name \"fast\"", "`name` of its own"),
        ("[2.0e5, 2.0e5, 8.0e4]", "[2.0e5, 2.0e5]", "`stiffness_n_per_mm` has 2 numbers", "give 3"),
        ("scene = \"first_stage.toml\"", "scene = \"none.toml\"", "cannot be read", "relative to the gearbox file"),
        ("set = [\"contact.slices=16\"]", "set = [\"contact.friction=0.1\"]", "has friction", "leave `friction` out"),
        ("set = [\"contact.slices=16\"]", "set = [\"contact.slice=16\"]", "slice", "slices"),
        ("torque_nm = 740.0", "torque_nm = -740.0", "torque_nm", ""),
        ("rotation = \"cw\"", "rotation = \"left\"", "\"left\"", "ccw"),
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
