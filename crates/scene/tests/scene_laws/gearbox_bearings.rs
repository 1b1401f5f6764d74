//! Rolling bearings and REXS shafts of the gearbox file: what it says, and how mistakes in it are told.

use std::path::{Path, PathBuf};

use scene::{
    SceneError,
    gearbox::{AxialPlay, Gearbox, RollingKind, RollingSize, ThrustSeat},
};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/gearbox")
}

fn text() -> String {
    std::fs::read_to_string(folder().join("rolling_bearings.toml")).unwrap()
}

fn read(text: &str) -> Result<Gearbox, SceneError> {
    Gearbox::parse(text, &folder().join("rolling_bearings.toml"))
}

/// Every number of the file in the solver's units: mm, N, rad.
#[test]
fn rolling_bearings_are_read_as_they_are_written() {
    let file = read(&text()).unwrap();
    let of = |i: usize| file.bearings[i].rolling.clone().unwrap();
    let kinds: Vec<RollingKind> = (0..6).map(|i| of(i).kind).collect();
    type K = RollingKind;
    assert_eq!(
        kinds,
        [
            K::DeepGrooveBall,
            K::CylindricalRoller,
            K::TaperedRoller,
            K::TaperedRoller,
            K::AngularContactBall,
            K::DeepGrooveBall
        ]
    );
    assert_eq!(file.bearings[0].stiffness, [[0.0; 6]; 6]);
    assert_eq!((of(0).conformity, of(4).conformity), ([0.515, 0.53], [0.52, 0.53]));
    assert!((of(0).radial_clearance - 8e-3).abs() < 1e-15, "{}", of(0).radial_clearance);
    let RollingSize::Elements { elements, diameter, length, pitch_diameter } = of(2).size else {
        panic!("{:?}", of(2))
    };
    assert_eq!((elements, diameter, length, pitch_diameter), (17, 8.6, 12.5, 53.5));
    assert_eq!(of(1).size, RollingSize::Catalogue { bore: 25.0, outer_diameter: 52.0, static_rating: 27e3 });
    assert_eq!((of(2).rows, of(3).rows), (vec![[0.0, -1.0]], vec![[0.0, 1.0]]));
    assert_eq!(of(3).axial, AxialPlay::Clearance(5e-3));
    // Back to back: the row at -z takes the thrust towards +z.
    assert_eq!((of(4).rows, of(4).axial), (vec![[-7.5, 1.0], [7.5, -1.0]], AxialPlay::Preload(250.0)));
    assert!((of(4).contact_angle - 30f64.to_radians()).abs() < 1e-15);
    // Without a pitch diameter it is in the middle of bore and outer diameter.
    let between = text().replace("pitch_diameter_mm = 38.5", "bore_mm = 25.0\nouter_diameter_mm = 52.0");
    let own = read(&between).unwrap().bearings[0].rolling.clone().unwrap();
    assert!(matches!(own.size, RollingSize::Elements { pitch_diameter: 38.5, .. }), "{own:?}");
}

/// A designation gives type, boundary dimensions and contact angle; stated ratings and elements go before the estimate.
#[test]
fn a_designation_stands_for_type_and_dimensions() {
    let deep = text();
    let begin = deep.find("type = \"deep-groove-ball\"\nelements").unwrap();
    let end = deep.find("damping_n_s_per_mm").unwrap();
    let rating = "[rating]\nspeed_rpm = 1500.0\n";
    let with = |words: &str| read(&format!("{}{words}\n{}\n{rating}", &deep[..begin], &deep[end..]));
    let own = |words: &str| with(words).unwrap_or_else(|e| panic!("{words}: {e}")).bearings[0].rolling.clone().unwrap();
    let found = own("designation = \"6205\"");
    assert_eq!(found.kind, RollingKind::DeepGrooveBall);
    assert_eq!(found.size, RollingSize::Dimensions { bore: 25.0, outer_diameter: 52.0, width: 15.0 });
    assert!(found.has_life() && found.dynamic_rating.is_none());
    let stated = own("designation = \"6205\"\nstatic_rating_kn = 7.8\ndynamic_rating_kn = 14.8");
    assert_eq!(stated.size, RollingSize::Catalogue { bore: 25.0, outer_diameter: 52.0, static_rating: 7.8e3 });
    assert_eq!(stated.dynamic_rating, Some(14.8e3));
    let drawn = own("designation = \"6205\"\nelements = 9\nelement_diameter_mm = 7.938");
    assert!(matches!(drawn.size, RollingSize::Elements { pitch_diameter: 38.5, .. }), "{drawn:?}");
    let cone = own("designation = \"32206\"\ntakes_thrust = \"+z\"");
    assert!((cone.contact_angle.to_degrees() - 14.0361).abs() < 1e-9 && cone.rows == [[0.0, 1.0]], "{cone:?}");
    let mistakes = [
        ("designation = \"22205\"", "no series of the designation \"22205\" is known", "deep groove balls 618"),
        ("designation = \"6205-2RS1\"", "\"2RS1\" is no part of the basic designation", "radial_clearance_um"),
        ("designation = \"6299\"", "no bearing \"6299\" is known", "from 6200 to 6240"),
        ("designation = \"7205\"\ntakes_thrust = \"+z\"", "no letter for its contact angle", "7205B"),
        ("designation = \"6205\"\nbore_mm = 25.0", "`bore_mm` beside a designation", "leave one of both out"),
        ("designation = \"6205\"\ntype = \"deep-groove-ball\"", "`type` beside a designation", "leave one"),
        ("designation = \"32206\"", "has no `takes_thrust`", "\"+z\" or \"-z\""),
        ("designation = \"6205\"\npreload_n = 5.0", "a \"deep-groove-ball\" bearing has no `preload_n`", "play"),
        ("designation = \"6205\"\nstiffness_n_per_mm = [1.0, 1.0, 1.0]", "with a `type` or `designation`", "follows"),
    ];
    for (words, said, hint) in mistakes {
        let error = with(words).unwrap_err();
        let told = format!("{error} {}", error.hint().unwrap_or_default());
        assert!(told.contains(said) && told.contains(hint), "{words}: {told}");
    }
}

/// A seat that floats, or has a shoulder on one side, is said of every type that takes thrust both ways.
#[test]
fn seats_take_the_thrust_that_the_file_says() {
    let deep = "type = \"deep-groove-ball\"\nelements";
    let back = "arrangement = \"back-to-back\"";
    let cases = [
        (deep, "type = \"deep-groove-ball\"\ntakes_thrust = \"none\"\nelements", 0, ThrustSeat::Floating),
        (deep, "type = \"deep-groove-ball\"\ntakes_thrust = \"-z\"\nelements", 0, ThrustSeat::Shoulder(-1.0)),
        (deep, "type = \"deep-groove-ball\"\ntakes_thrust = \"both\"\nelements", 0, ThrustSeat::Held),
        ("static_rating_kn = 27.0", "static_rating_kn = 27.0\ntakes_thrust = \"none\"", 1, ThrustSeat::Held),
        ("name", "name", 2, ThrustSeat::Held),
        (back, "arrangement = \"back-to-back\"\ntakes_thrust = \"+z\"", 4, ThrustSeat::Shoulder(1.0)),
        (back, "arrangement = \"back-to-back\"\ntakes_thrust = \"none\"", 4, ThrustSeat::Floating),
    ];
    for (from, to, i, seat) in cases {
        assert!(text().contains(from), "{from}");
        let own = read(&text().replacen(from, to, 1)).unwrap_or_else(|e| panic!("{to}: {e}"));
        assert_eq!(own.bearings[i].rolling.as_ref().map(|r| r.seat), Some(seat), "{to}");
    }
}

/// A mistake is told with its line, what is wrong, and what to do.
#[test]
fn mistakes_in_rolling_bearings_are_told_with_their_place() {
    let (deep, cones) = ("type = \"deep-groove-ball\"\nelements", "takes_thrust = \"-z\"\n");
    let cases = [
        ("\"deep-groove-ball\"", "\"deep-grove-ball\"", "deep-grove-ball", "did you mean \"deep-groove-ball\"?"),
        (
            "\"deep-groove-ball\"",
            "\"spherical-roller\"",
            "no law of a \"spherical-roller\" bearing",
            "give its stiffness",
        ),
        (deep, "elements", "`elements` is of a rolling bearing", "`type`"),
        (
            deep,
            "stiffness_n_per_mm = [1.0, 1.0, 1.0]\ntype = \"deep-groove-ball\"\nelements",
            "with a `type`",
            "follows",
        ),
        ("elements = 9", "elements = 1", "elements", "3 .. 500"),
        ("elements = 9\n", "", "has no `elements`", "rolling elements"),
        ("element_diameter_mm = 7.938\n", "", "has no `element_diameter_mm`", ""),
        ("pitch_diameter_mm = 38.5\n", "", "has no `pitch_diameter_mm`", ""),
        ("pitch_diameter_mm = 38.5", "static_rating_kn = 7.8", "a static rating", "leave one of both out"),
        (
            deep,
            "type = \"deep-groove-ball\"\ncontact_angle_deg = 15.0\nelements",
            "no `contact_angle_deg`",
            "clearance",
        ),
        (deep, "type = \"deep-groove-ball\"\naxial_clearance_um = 5.0\nelements", "no `axial_clearance_um`", "play"),
        (deep, "type = \"deep-groove-ball\"\nelement_length_mm = 5.0\nelements", "no `element_length_mm`", "out"),
        ("inner_conformity = 0.515", "inner_conformity = 0.5", "inner_conformity", "0.502"),
        ("radial_clearance_um = 8.0", "radial_clearance_um = nan", "radial_clearance_um", ""),
        ("static_rating_kn = 27.0\n", "", "has no `static_rating_kn`", ""),
        ("outer_diameter_mm = 52.0", "outer_diameter_mm = 20.0", "outer_diameter_mm", "25.0"),
        (cones, "", "has no `takes_thrust`", "\"+z\" or \"-z\""),
        (cones, "takes_thrust = \"left\"\n", "\"left\"", "+z"),
        (cones, "takes_thrust = \"-z\"\nradial_clearance_um = 5.0\n", "no `radial_clearance_um`", "preload_n"),
        (cones, "takes_thrust = \"-z\"\narrangement = \"tandem\"\n", "`arrangement` of one row", "rows = 2"),
        (
            "axial_clearance_um = 5.0",
            "axial_clearance_um = 5.0\npreload_n = 1.0",
            "a preload and an axial",
            "one of both",
        ),
        ("profile = \"logarithmic\"", "profile = \"log\"", "\"log\"", "logarithmic"),
        ("contact_angle_deg = 30.0", "contact_angle_deg = 0.0", "contact_angle_deg", "5 .. 75"),
        ("row_distance_mm = 15.0\n", "", "has no `row_distance_mm`", ""),
        ("arrangement = \"back-to-back\"\n", "", "has no `arrangement`", "face-to-face"),
        ("arrangement = \"back-to-back\"", "arrangement = \"tandem\"", "has no `takes_thrust`", ""),
        (deep, "type = \"deep-groove-ball\"\ntakes_thrust = \"left\"\nelements", "\"left\"", "none"),
        (cones, "takes_thrust = \"none\"\n", "\"none\"", "+z"),
        ("static_rating_kn = 27.0", "static_rating_kn = 27.0\ntakes_thrust = \"both\"", "take thrust", "ribs"),
        ("rows = 2", "rows = 3", "rows", "1 .. 2"),
        ("preload_n = 250.0", "preload_n = -1.0", "preload_n", ""),
    ];
    for (from, to, said, hinted) in cases {
        let text = text();
        assert!(text.contains(from), "{from} is not in the file");
        let error = read(&text.replacen(from, to, 1)).map(|_| ()).expect_err(to);
        let (message, hint) = (error.to_string(), error.hint().unwrap_or_default());
        assert!(message.contains("rolling_bearings.toml:") && message.contains(said), "{to}: {message}");
        assert!(hint.contains(hinted) || message.contains(hinted), "{to}: {message}; {hint}");
    }
}

const REXS: &str = r#"<model version="1.4">
 <relations>
  <relation id="1" type="assembly"><ref id="7" role="assembly" hint="shaft"/><ref id="11" role="part" hint="shaft_section"/></relation>
  <relation id="4" type="reference"><ref id="7" role="origin" hint="shaft"/><ref id="20" role="referenced" hint="material"/></relation>
 </relations>
 <components>
  <component id="7" type="shaft" name="input"/>
  <component id="11" type="shaft_section"><attribute id="u_coordinate_on_shaft" unit="mm">0</attribute><attribute id="length" unit="mm">200</attribute>
   <attribute id="outer_diameter_begin" unit="mm">26</attribute><attribute id="outer_diameter_end" unit="mm">26</attribute></component>
  <component id="20" type="material"><attribute id="elastic_modulus" unit="N / mm^2">210000</attribute><attribute id="density" unit="kg / dm^3">7.8</attribute></component>
 </components>
</model>"#;

/// Sections and steel out of a REXS file; what the gearbox file states itself holds.
#[test]
fn a_shaft_comes_out_of_a_rexs_file() {
    let scratch = tempfile::tempdir().unwrap();
    for name in ["first_stage.toml", "second_stage.toml"] {
        std::fs::copy(folder().join(name), scratch.path().join(name)).unwrap();
    }
    std::fs::write(scratch.path().join("box.rexs"), REXS).unwrap();
    let own = "name = \"fast\"\n[[shaft.section]]\nlength_mm = 200.0\nouter_diameter_mm = 25.0\n";
    let with = |keys: &str| {
        let text = text();
        assert!(text.contains(own));
        Gearbox::parse(&text.replacen(own, keys, 1), &scratch.path().join("box.toml"))
    };
    let file = with("name = \"fast\"\nrexs = \"box.rexs\"\nrexs_shaft = \"input\"\npoisson = 0.28\n").unwrap();
    let shaft = &file.shafts[0];
    assert_eq!((shaft.sections.len(), shaft.sections[0].length, shaft.sections[0].outer), (1, 200.0, 26.0));
    assert_eq!((shaft.young_mpa, shaft.poisson), (2.1e5, 0.28));
    assert!((shaft.density - 7.8e-9).abs() < 1e-20, "{}", shaft.density);
    let alone = with("name = \"fast\"\nrexs = \"box.rexs\"\n").unwrap();
    assert_eq!(alone.shafts[0].sections, shaft.sections, "the only shaft needs no name");
    let cases = [
        ("rexs = \"none.rexs\"\n", "cannot be read"),
        ("rexs = \"box.rexs\"\nrexs_shaft = \"output\"\n", "has no shaft \"output\""),
        ("rexs_shaft = \"input\"\n", "has no `rexs`"),
        ("rexs = \"first_stage.toml\"\n", "is no XML"),
        (&format!("rexs = \"box.rexs\"\n{}", &own[14..]), "has its sections twice"),
    ];
    for (keys, said) in cases {
        let error = with(&format!("name = \"fast\"\n{keys}")).map(|_| ()).expect_err(keys);
        assert!(error.to_string().contains("box.toml:") && error.to_string().contains(said), "{keys}{error}");
        assert!(error.hint().is_some_and(|h| !h.is_empty()), "{keys}{error}");
    }
}

/// Lines left out, told twice or cut short, and numbers of any size: a gearbox or a complaint with a place, and no
/// panic.
#[test]
fn damaged_rolling_bearings_are_read_or_refused() {
    let whole = text();
    let lines: Vec<&str> = whole.lines().collect();
    let from = lines.iter().position(|l| *l == "[[bearing]]").unwrap();
    let to = lines.iter().position(|l| *l == "[[gear]]").unwrap();
    let (mut fine, mut told) = (0, 0);
    for i in from..to {
        let mut meet = |own: &[&str]| match read(&[&lines[..i], own, &lines[i + 1..]].concat().join("\n")) {
            Ok(_) => fine += 1,
            Err(e) => {
                told += 1;
                assert!(!e.to_string().is_empty() && !e.to_string().contains('\n'), "{e}");
                let _ = (e.hint(), e.excerpt());
            }
        };
        meet(&[]);
        meet(&[lines[i], lines[i]]);
        if let Some((key, _)) = lines[i].split_once(" = ") {
            for value in ["nan", "inf", "-1", "0", "1e300", "[]", "\"\"", "true", "{}"] {
                meet(&[&format!("{key} = {value}")]);
            }
        }
    }
    assert!(fine > 20 && told > 300, "{fine} were read, {told} refused");
}
