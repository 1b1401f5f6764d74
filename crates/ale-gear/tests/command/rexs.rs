//! `ale-gear init --rexs`: pairs and whole gearboxes out of files of other programs, and what is told of the rest.

use crate::util::{Scratch, repository};

/// A stage of 22 : 40 teeth with its flanks and a centre distance, as programs for gears write it.
fn pair(gear_2: &str, of_gear_2: &str, more: &str) -> String {
    let flank = |id: u32, angle: &str| {
        format!(
            "<component id=\"{id}\" type=\"cylindrical_gear_flank\"><attribute id=\"normal_pressure_angle\" \
             unit=\"deg\">{angle}</attribute><attribute id=\"addendum_modification_coefficient\" \
             unit=\"none\">0</attribute></component>"
        )
    };
    let gear = |id: u32, kind: &str, teeth: &str, own: &str| {
        format!(
            "<component id=\"{id}\" type=\"{kind}\"><attribute id=\"number_of_teeth\" unit=\"none\">{teeth}</attribute>\
             <attribute id=\"normal_module\" unit=\"mm\">4</attribute><attribute id=\"face_width\" \
             unit=\"mm\">50</attribute>{own}</component>"
        )
    };
    let teeth_2 = if gear_2 == "ring_gear" { "61" } else { "40" };
    let angle_2 = if more.contains("25 deg") { "25" } else { "20" };
    let distance = if more.contains("125 mm") { "125" } else { "124" };
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model version=\"1.4\" applicationId=\"own\">\n<relations>\
         <relation id=\"1\" type=\"stage\"><ref id=\"3\" role=\"stage\" hint=\"cylindrical_stage\"/><ref id=\"5\" \
         role=\"gear_1\" hint=\"cylindrical_gear\"/><ref id=\"7\" role=\"gear_2\" hint=\"{gear_2}\"/></relation>\
         <relation id=\"2\" type=\"flank\"><ref id=\"5\" role=\"gear\"/><ref id=\"11\" role=\"left\"/><ref id=\"12\" \
         role=\"right\"/></relation><relation id=\"4\" type=\"flank\"><ref id=\"7\" role=\"gear\"/><ref id=\"13\" \
         role=\"left\"/><ref id=\"14\" role=\"right\"/></relation></relations>\n<components><component id=\"3\" \
         type=\"cylindrical_stage\"><attribute id=\"center_distance\" unit=\"mm\">{distance}</attribute></component>\n\
         {}{}{}{}{}{}\n<!-- {more} --></components>\n</model>\n",
        gear(5, "cylindrical_gear", "22", ""),
        gear(7, gear_2, teeth_2, of_gear_2),
        [flank(11, "20"), flank(12, "20")].concat(),
        [flank(13, angle_2), flank(14, angle_2)].concat(),
        if more.contains("load") {
            "<component id=\"20\" type=\"shaft\"><attribute id=\"rotational_speed\" unit=\"1 / min\">1400</attribute>\
             </component>"
        } else {
            ""
        },
        if more.contains("load") {
            "<component id=\"21\" type=\"external_load\"><attribute id=\"torque_around_u_axis\" unit=\"N m\">4.7\
             </attribute></component>"
        } else {
            ""
        },
    )
}

/// What cannot be run is refused with the part of the REXS file that says so, and no scene is written.
#[test]
fn what_cannot_be_taken_is_told_of_the_rexs_file() {
    let tip = "<attribute id=\"tip_diameter\" unit=\"mm\">1</attribute>";
    let rings = pair("ring_gear", "", "").replace("id=\"5\" type=\"cylindrical_gear\"", "id=\"5\" type=\"ring_gear\"");
    let json = "{\"model\": {}}".to_owned();
    let cases = [
        (pair("worm", "", ""), "f.rexs: gear 7 is a `worm`", "cylindrical gears"),
        (rings, "f.rexs: gear 7 is a ring as its mating gear is", "external gear"),
        (pair("cylindrical_gear", "", "25 deg"), "the gears differ in normal pressure angle: 20 and 25", "external"),
        (pair("cylindrical_gear", tip, ""), "f.rexs: gear 7: `tip_diameter`: `tip_diameter_mm` is 1", ""),
        (json, "f.rexs: is JSON", "XML"),
    ];
    for (text, said, hint) in cases {
        let scratch = Scratch::new().file("f.rexs", text);
        let run = scratch.command(&["init", "t.toml", "--rexs", "f.rexs"]);
        assert_eq!(run.code, Some(2), "{said}: {}", run.stderr);
        assert!(run.stderr.contains(said) && run.stderr.contains(hint), "{}", run.stderr);
        assert!(!run.stderr.contains("t.toml") && !scratch.path().join("t.toml").exists(), "{}", run.stderr);
    }
    let packed = Scratch::new().file("p.rexsz", [&b"PK\x03\x04\x14\x00"[..], &[0xff; 40]].concat());
    let run = packed.command(&["init", "t.toml", "--rexs", "p.rexsz"]);
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("p.rexsz: is packed REXS") && run.stderr.contains("unzip"), "{}", run.stderr);
}

/// The stage's own centre distance is taken; places that contradict it are told.
#[test]
fn the_centre_distance_of_the_stage_is_taken() {
    let scratch = Scratch::new().file("f.rexs", pair("cylindrical_gear", "", "125 mm"));
    let run = scratch.command(&["init", "t.toml", "--rexs", "f.rexs"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    assert!(scratch.read("t.toml").contains("centre_distance_mm = 125.0"), "{}", scratch.read("t.toml"));
    let vector = |z: u32| {
        format!(
            "<attribute id=\"u_axis_vector\" unit=\"mm\"><array><c>1</c><c>0</c><c>0</c></array></attribute><attribute \
             id=\"support_vector\" unit=\"mm\"><array><c>0</c><c>0</c><c>{z}</c></array></attribute></component>"
        )
    };
    let apart = pair("cylindrical_gear", "", "125 mm").replacen(
        "50</attribute></component>",
        &format!("50</attribute>{}", vector(0)),
        1,
    );
    let apart = apart.replacen("50</attribute></component>", &format!("50</attribute>{}", vector(124)), 1);
    let scratch = scratch.file("f.rexs", apart);
    let run = scratch.command(&["init", "u.toml", "--rexs", "f.rexs"]);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(run.stderr.contains("stage 3 has a `center_distance` of 125 mm"), "{}", run.stderr);
    assert!(run.stderr.contains("124 mm apart"), "{}", run.stderr);
}

/// Load and speed that name no shaft of the stage are listed with their values, once, and so is what the scene says.
#[test]
fn what_is_not_taken_is_listed_once() {
    let scratch = Scratch::new().file("f.rexs", pair("cylindrical_gear", "", "load"));
    let run = scratch.command(&["init", "t.toml", "--rexs", "f.rexs"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    for said in
        ["torque_nm = 150", "speed_rpm = 1000", "`rotational_speed` (1400 1 / min)", "`torque_around_u_axis` (4.7 N·m)"]
    {
        assert_eq!(run.stderr.matches(said).count(), 1, "{said}: {}", run.stderr);
    }
}

/// The gearbox of `scenes/gearbox/two_stages.rexs` as a person writes it.
const BY_HAND: &str = r#"
[[shaft]]
name = "fast"
[[shaft.section]]
length_mm = 200.0
outer_diameter_mm = 25.0
[[shaft]]
name = "middle"
origin_mm = [91.0, 0.0, 0.0]
[[shaft.section]]
length_mm = 200.0
outer_diameter_mm = 35.0
[[shaft]]
name = "slow"
origin_mm = [91.0, 118.5, 0.0]
[[shaft.section]]
length_mm = 220.0
outer_diameter_mm = 50.0

[[bearing]]
shaft = "fast"
position_mm = 15.0
type = "deep-groove-ball"
bore_mm = 25.0
outer_diameter_mm = 52.0
static_rating_kn = 7.8
radial_clearance_um = 8.0
[[bearing]]
shaft = "fast"
position_mm = 185.0
type = "cylindrical-roller"
bore_mm = 25.0
outer_diameter_mm = 52.0
static_rating_kn = 27.0
radial_clearance_um = 15.0
[[bearing]]
shaft = "middle"
position_mm = 15.0
type = "tapered-roller"
bore_mm = 35.0
outer_diameter_mm = 72.0
static_rating_kn = 85.0
contact_angle_deg = 14.04
takes_thrust = "-z"
[[bearing]]
shaft = "middle"
position_mm = 185.0
type = "tapered-roller"
bore_mm = 35.0
outer_diameter_mm = 72.0
static_rating_kn = 85.0
contact_angle_deg = 14.04
takes_thrust = "+z"
axial_clearance_um = 5.0
[[bearing]]
shaft = "slow"
position_mm = 15.0
type = "deep-groove-ball"
bore_mm = 50.0
outer_diameter_mm = 90.0
static_rating_kn = 23.2
radial_clearance_um = 12.0
[[bearing]]
shaft = "slow"
position_mm = 185.0
type = "deep-groove-ball"
bore_mm = 50.0
outer_diameter_mm = 90.0
static_rating_kn = 23.2
radial_clearance_um = 12.0
takes_thrust = "none"

[[gear]]
name = "1"
shaft = "fast"
position_mm = 50.0
[[gear]]
name = "2"
shaft = "middle"
position_mm = 50.0
[[gear]]
name = "3"
shaft = "middle"
position_mm = 140.0
[[gear]]
name = "4"
shaft = "slow"
position_mm = 140.0

[[mesh]]
scene = "one.toml"
pinion = "1"
wheel = "2"
[[mesh]]
scene = "two.toml"
pinion = "3"
wheel = "4"

[input]
shaft = "fast"
position_mm = 0.0
rotation = "cw"
[[torque]]
shaft = "slow"
position_mm = 220.0
torque_nm = 740.0
"#;

/// The scenes of its pairs as a person writes them; deviations of the base tangent of 30 to 50 um.
fn by_hand(scratch: Scratch) -> Scratch {
    let thinning = 0.04 / 20f64.to_radians().cos();
    let gear = |table: &str, teeth: u32, keys: &str| {
        format!("[{table}]\nteeth = {teeth}\nthickness_allowance_mm = {thinning:?}\n{keys}\n")
    };
    let scene = |pinion: (u32, &str), wheel: (u32, &str), pair: &str| {
        let gears = [gear("pinion", pinion.0, pinion.1), gear("wheel", wheel.0, wheel.1)].concat();
        format!("{gears}[pair]\n{pair}\n[operation]\ntorque_nm = 1.0\n")
    };
    let one = scene(
        (17, "helix_angle_deg = 15.0\nbore_diameter_mm = 25.0\nface_width_mm = 26.0\nprofile_shift = 0.1"),
        (53, "bore_diameter_mm = 60.0\nface_width_mm = 24.0"),
        "normal_module_mm = 2.5\ncentre_distance_mm = 91.0",
    );
    let two = scene(
        (19, "helix_angle_deg = -12.0\nbore_diameter_mm = 35.0"),
        (47, "bore_diameter_mm = 90.0"),
        "normal_module_mm = 3.5\nface_width_mm = 36.0\ncentre_distance_mm = 118.5",
    );
    scratch.file("one.toml", one).file("two.toml", two).file("hand.toml", coarse(BY_HAND))
}

/// A scene with few elements and slices, at two positions.
fn coarse(text: &str) -> String {
    let keys = ["pinion", "wheel"].map(|gear| {
        let of = |key: &str, n: u32| format!("\"{gear}.mesher.{key}={n}\"");
        [of("order", 1), of("elements_profile", 3), of("elements_fillet", 2), of("elements_thickness", 2)].join(", ")
            + ", "
            + &[of("elements_face", 4), of("elements_rim", 2), of("sector_teeth", 1)].join(", ")
    });
    let set = format!("[[mesh]]\nset = [{}, {}, \"contact.slices=16\"]", keys[0], keys[1]);
    let text = text.replace("[[mesh]]", &set).replace("[analysis]\n", "");
    text + "\n[analysis]\npositions_per_cycle = 2\n"
}

/// A whole gearbox of a REXS file runs, and to the bit as the one that a person writes of it; the second load case has
/// another load and turns the other way.
#[test]
fn a_rexs_gearbox_runs_as_the_one_by_hand() {
    let rexs = repository().join("scenes/gearbox/two_stages.rexs");
    let scratch = by_hand(Scratch::new().file("box.rexs", std::fs::read(rexs).unwrap()));
    let made = scratch.command(&["init", "made.toml", "--rexs", "box.rexs"]);
    assert_eq!(made.code, Some(0), "{}", made.stderr);
    assert!(made.stdout.contains("made_stage_1.toml, made_stage_2.toml, made.toml: written"), "{}", made.stdout);
    assert!(made.stderr.contains("load case 1 of 2 is taken"), "{}", made.stderr);
    assert_eq!(made.stderr.matches("external_load 73: `force_v_direction` (150 N)").count(), 1, "{}", made.stderr);
    let again = scratch.command(&["init", "made.toml", "--rexs", "box.rexs"]);
    assert_eq!(again.code, Some(2), "{}", again.stderr);
    let text = coarse(&scratch.read("made.toml"));
    let scratch = scratch.file("coarse.toml", text);
    for name in ["coarse", "hand"] {
        let run = scratch.command(&["run", &format!("{name}.toml"), "--out", name, "--no-cache", "-q"]);
        assert_eq!(run.code, Some(0), "{name}: {}", run.stderr);
    }
    assert_eq!(scratch.read("coarse/positions.csv"), scratch.read("hand/positions.csv"));
    let other = scratch.command(&["init", "other.toml", "--rexs", "box.rexs", "--load-case", "2"]);
    assert_eq!(other.code, Some(0), "{}", other.stderr);
    let text = scratch.read("other.toml");
    assert!(text.contains("torque_nm = 320.0") && text.contains("rotation = \"ccw\""), "{text}");
}

/// A file of the gearbox that is there already stays, and none of the others is written.
#[test]
fn a_gearbox_is_written_whole_or_not_at_all() {
    let rexs = std::fs::read(repository().join("scenes/gearbox/two_stages.rexs")).unwrap();
    let scratch = Scratch::new().file("box.rexs", rexs).file("a_stage_2.toml", "mine");
    let run = scratch.command(&["init", "a.toml", "--rexs", "box.rexs"]);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(run.stderr.contains("a_stage_2.toml: is there already"), "{}", run.stderr);
    assert!(!scratch.path().join("a.toml").exists() && !scratch.path().join("a_stage_1.toml").exists());
    assert_eq!(scratch.read("a_stage_2.toml"), "mine");
    // A pair of it alone is a scene.
    let pair = scratch.command(&["init", "pair.toml", "--rexs", "box.rexs", "--stage", "2", "-q"]);
    assert_eq!(pair.code, Some(0), "{}", pair.stderr);
    let text = scratch.read("pair.toml");
    assert!(text.contains("torque_nm = 740.0") && text.contains("speed_rpm = 481.13207"), "{text}");
    for (change, said) in [
        ("radial_grooved_ball_bearing", "bearing 61 is a `radial_spherical_roller_bearing`"),
        (
            "<attribute id=\"inner_diameter\" unit=\"mm\">25</attribute>\n   <attribute id=\"outer_diameter\"",
            "bearing 61",
        ),
    ] {
        let to = if change.starts_with('<') {
            "<attribute id=\"outer_diameter\""
        } else {
            "radial_spherical_roller_bearing"
        };
        let text = scratch.read("box.rexs").replacen(change, to, 1);
        let own = Scratch::new().file("b.rexs", text);
        let run = own.command(&["init", "b.toml", "--rexs", "b.rexs"]);
        assert_eq!(run.code, Some(2), "{}", run.stderr);
        assert!(run.stderr.contains("b.rexs: ") && run.stderr.contains(said), "{}", run.stderr);
        assert!(!own.path().join("b_stage_1.toml").exists());
    }
}
