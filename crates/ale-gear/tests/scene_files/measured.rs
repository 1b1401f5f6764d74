//! A measured gear: from its curve file to a run.

use std::fmt::Write as _;

use crate::util::Scratch;

const PAIR: &str = "[pinion]\nteeth = 30\nhelix_angle_deg = 0.0\nthickness_allowance_mm = 0.05\nMESHER\n\
                    [wheel]\nteeth = 30\nthickness_allowance_mm = 0.05\nMESHER\n\
                    [pair]\nnormal_module_mm = 3.0\nface_width_mm = 20.0\n[operation]\ntorque_nm = 150.0\n\
                    [analysis]\npositions_per_cycle = 2\n";
const MESHER: &str =
    "mesher = { order = 1, elements_profile = 2, elements_thickness = 2, elements_face = 2, elements_rim = 1 }";

/// A curve file with a wave of an order on all left flanks, and a pitch error of tooth 4.
fn curves(order: f64, um: f64) -> String {
    let mut text = String::from(
        "HEADER KS.MK.FILE\n 21 :mn [mm]: 3\n 22 :z: 30\n 23 :beta: 0\n 24 :alpha: 20\n 43 :da [mm]: 86\n 44 :de [mm]: 95.5\n",
    );
    let base = 90.0 * 20f64.to_radians().cos();
    let length = |d: f64| 0.5 * (d * d - base * base).sqrt();
    for tooth in 0..30 {
        let _ = writeln!(text, "\nProfil:  Zahn-Nr.: {} links / 200 Werte  z= 0", tooth + 1);
        for i in 0..200 {
            let u = (length(86.0) + (length(95.5) - length(86.0)) * f64::from(i) / 199.0) / (0.5 * base);
            let value = um * (order * (u - std::f64::consts::TAU * f64::from(tooth) / 30.0)).cos();
            let _ = write!(text, " {value:.5}");
        }
    }
    text += "\n\n linke Zahnflanke\n Zahn-Nr.  fp  Fp  Fr\n\n";
    for tooth in 1..=30 {
        let _ = writeln!(text, " {tooth}  {} {} 0", if tooth == 4 { 3 } else { 0 }, if tooth == 4 { 3 } else { 0 });
    }
    text
}

/// The command tells deviations and waves, and writes files that a scene takes as they are.
#[test]
fn a_measured_gear_is_evaluated_and_run() {
    let pair = PAIR.replace("MESHER", MESHER);
    let scratch = Scratch::new().file("a.toml", pair.clone()).file("g.mka", curves(61.0, 0.4));
    let told = scratch.ale_gear(["geometry", "a.toml", "--measured", "pinion=g.mka", "--out", "m"]);
    assert_eq!(told.code, Some(0), "{}", told.stderr);
    for line in [
        "f_p          3.00 um   class 3",
        "order   61    0.400 um   no multiple of the teeth",
        "left flanks of 30 teeth were measured",
    ] {
        assert!(told.stdout.contains(line), "no `{line}` in\n{}", told.stdout);
    }
    for name in [
        "pinion_drive.csv",
        "pinion_pitch.txt",
        "pinion_evaluation.csv",
        "pinion_ripple.csv",
        "pinion_profiles_left.svg",
        "pinion_ripple_left.svg",
    ] {
        assert!(scratch.path().join("m").join(name).is_file(), "no {name}");
    }
    let keys = "pitch_errors_file = \"m/pinion_pitch.txt\"\nmodification = { drive = { topography = \"m/pinion_drive.csv\" } }\n[wheel]";
    std::fs::write(scratch.path().join("b.toml"), pair.replace("[wheel]", keys)).unwrap();
    let run = scratch.ale_gear(["run", "b.toml", "--out", "o", "--no-cache"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let refused = |words: [&str; 6]| {
        let run = scratch.ale_gear(words);
        assert_eq!(run.code, Some(2), "{}", run.stdout);
        run.stderr
    };
    // The same gear, and another one, into the same folder: what was written before is replaced, what others wrote is not.
    std::fs::copy(scratch.path().join("g.mka"), scratch.path().join("other.mka")).unwrap();
    let again = scratch.ale_gear(["geometry", "a.toml", "--measured", "pinion=other.mka", "--out", "m"]);
    assert_eq!(again.code, Some(0), "{}", again.stderr);
    std::fs::create_dir(scratch.path().join("own")).unwrap();
    std::fs::write(scratch.path().join("own/pinion_drive.csv"), "my own\n").unwrap();
    let said = refused(["geometry", "a.toml", "--measured", "pinion=g.mka", "--out", "own"]);
    assert!(said.contains("a file of another kind is there") && said.contains("hint:"), "{said}");
    assert_eq!(scratch.read("own/pinion_drive.csv"), "my own\n");
    let said = refused(["geometry", "a.toml", "--measured", "g.mka", "--out", "x"]);
    assert!(said.contains("no gear is named"), "{said}");
    std::fs::write(scratch.path().join("c.mka"), curves(61.0, 0.4).replace("21 :mn [mm]: 3", "21 :mn [mm]: 2.5"))
        .unwrap();
    let said = refused(["geometry", "a.toml", "--measured", "wheel=c.mka", "--out", "x"]);
    assert!(said.contains("the measured gear has normal module [mm] 2.5, the gear 3"), "{said}");
}

/// A file of another machine is read by a map of names: the same gear as from its curve file.
#[test]
fn names_tell_where_a_file_has_its_values() {
    let pair = PAIR.replace("MESHER", MESHER);
    let curve = curves(61.0, 0.4);
    let traces = curve.split("Profil:").skip(1).map(|block| {
        let tooth: u32 =
            block.split("Zahn-Nr.:").nth(1).unwrap().trim_start().split(' ').next().unwrap().parse().unwrap();
        let values = block.lines().nth(1).unwrap();
        format!("<p n='{tooth}' s='L'><z>0</z><a>86</a><e>95.5</e><v>{values}</v></p>\n")
    });
    let xml = format!("<m><g z='30'><mn>3</mn><b>0</b><a>20</a></g>\n<t>\n{}</t></m>\n", traces.collect::<String>());
    let names = "teeth = \"g/@z\"\nnormal_module = \"g/mn\"\nhelix_angle = \"g/b\"\npressure_angle = \"g/a\"\n\
                 profiles = \"t/p\"\nhelices = \"t/l\"\ntooth = \"@n\"\nside = \"@s\"\nleft = \"L\"\nright = \"R\"\n\
                 place = \"z\"\nfrom = \"a\"\nto = \"e\"\nvalues = \"v\"\n";
    let scratch = Scratch::new()
        .file("a.toml", pair)
        .file("g.mka", curve)
        .file("g.xml", xml)
        .file("names.toml", names)
        .file("less.toml", names.replace("values", "value"));
    for words in [
        &["geometry", "a.toml", "--measured", "pinion=g.mka", "--out", "mka"][..],
        &["geometry", "a.toml", "--measured", "pinion=g.xml", "--names", "names.toml", "--out", "gde"],
    ] {
        let told = scratch.command(words);
        assert_eq!(told.code, Some(0), "{}", told.stderr);
        assert!(told.stdout.contains("order   61    0.400 um   no multiple of the teeth"), "{}", told.stdout);
    }
    let data = |folder: &str| {
        let text = scratch.read(&format!("{folder}/pinion_drive.csv"));
        text.lines().skip(1).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(data("mka"), data("gde"));
    let refused = |names: &str| {
        let run =
            scratch.command(&["geometry", "a.toml", "--measured", "pinion=g.xml", "--names", names, "--out", "x"]);
        assert_eq!(run.code, Some(2), "{}", run.stdout);
        run.stderr
    };
    let said = refused("less.toml");
    assert!(said.contains("less.toml:14: unknown field `value`") && said.contains("hint: keys: teeth"), "{said}");
}
