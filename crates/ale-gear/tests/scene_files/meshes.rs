//! `ale-gear mesh` and meshes in scenes, as a user meets them.

use crate::util::{ISO_SCENE, Scratch, repository};

/// A small sector: one quadratic layer is enough to see every part.
fn scene(order: u32, sector: u32) -> String {
    let mesher = format!(
        "[pinion.mesher]\norder = {order}\nelements_profile = 2\nelements_fillet = 2\nelements_thickness = 2\n\
         elements_face = 2\nelements_rim = 1\nsector_teeth = {sector}\n[pair]"
    );
    ISO_SCENE.replace("[pair]", &mesher)
}

/// What is generated is sound and tells its parts, in every flavour of the file format.
#[test]
fn a_generated_mesh_checks_and_tells_its_parts() {
    for (format, words) in [("4.1", true), ("4.1", false), ("2.2", true), ("2.2", false)] {
        let scratch = Scratch::new().file("a.toml", scene(2, 3));
        let base = ["mesh", "generate", "a.toml", "--gear", "pinion", "-o", "p.msh", "--format", format];
        let run = if words {
            let [a, b, c, d, e, f, g, h, i] = base;
            scratch.ale_gear([a, b, c, d, e, f, g, h, i, "--ascii"])
        } else {
            scratch.ale_gear(base)
        };
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
        let info = scratch.ale_gear(["mesh", "info", "p.msh"]);
        assert_eq!(info.code, Some(0), "{}", info.stderr);
        for part in ["hex20", "flank_left_0", "flank_right_1", "bore", "cut_0", "teeth            30"] {
            assert!(info.stdout.contains(part), "{part} is not in\n{}", info.stdout);
        }
        let check = scratch.ale_gear(["mesh", "check", "p.msh", "--teeth", "30"]);
        assert_eq!((check.code, check.stderr.as_str()), (Some(0), ""), "{}", check.stdout);
        let other = scratch.ale_gear(["mesh", "check", "p.msh", "--teeth", "23"]);
        assert_eq!(other.code, Some(2), "{}", other.stdout);
        assert!(other.stderr.contains("23 teeth") && other.stderr.contains("--teeth 30"), "{}", other.stderr);
    }
}

#[test]
fn a_format_that_is_not_written_is_named() {
    let scratch = Scratch::new().file("a.toml", scene(1, 1));
    let run = scratch.ale_gear(["mesh", "generate", "a.toml", "--gear", "wheel", "-o", "w.msh", "--format", "4.0"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(2), "ale-gear: `--format` is 4.0, allowed is 4.1 or 2.2\n"));
    assert_eq!(scratch.names(), ["a.toml"]);
}

/// The bore of a mesh without named groups is found, and not 55 % of the reference diameter; the run says what it found.
#[test]
fn the_bore_of_a_mesh_without_names_is_found() {
    let scratch =
        Scratch::new().file("a.toml", scene(2, 0).replacen("bore_diameter_mm = 60.0", "bore_diameter_mm = 44.0", 1));
    let made = scratch.ale_gear(["mesh", "generate", "a.toml", "--gear", "pinion", "-o", "named.msh"]);
    assert_eq!(made.code, Some(0), "{}", made.stderr);
    let mut mesh = mesh::Mesh::read(scratch.path().join("named.msh")).unwrap();
    let [low, high] = mesh.bore_radii().unwrap();
    assert!((low - 22.0).abs() < 1e-9 && (high - 22.0).abs() < 1e-9, "{low} .. {high}");
    mesh.surfaces.iter_mut().enumerate().for_each(|(i, s)| s.name = (i + 2).to_string());
    mesh.write(scratch.path().join("p.msh"), mesh::MshFormat::Binary22).unwrap();
    let with_mesh =
        ISO_SCENE.replacen("bore_diameter_mm = 60.0", "mesh = \"p.msh\"", 1).replace("model = \"iso\"\n", "");
    let scratch = scratch.file("b.toml", &with_mesh);
    let run = scratch.ale_gear(["mesh", "check", "p.msh", "--scene", "b.toml", "--gear", "pinion"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    // The hint for groups under other numbers: patterns that no group has.
    let mut odd = mesh::Mesh::read(scratch.path().join("named.msh")).unwrap();
    for group in &mut odd.surfaces {
        if let Some((of, n)) = group.name.rsplit_once('_').and_then(|(of, n)| Some((of, n.parse::<i64>().ok()?))) {
            group.name = format!("{of}_{}", 2 * n + 3);
        }
    }
    odd.write(scratch.path().join("p.msh"), mesh::MshFormat::Binary22).unwrap();
    let groups = "[pinion.groups]\nflank_left = \"none_{k}\"\nflank_right = \"none_{k}\"\n[wheel]";
    let scratch = scratch.file("b.toml", with_mesh.replacen("[wheel]", groups, 1));
    let run = scratch.ale_gear(["mesh", "check", "p.msh", "--scene", "b.toml", "--gear", "pinion"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
}

/// Files that are no mesh: one message that names the file, exit status 2, no panic.
#[test]
fn what_is_no_mesh_is_refused() {
    let scratch = Scratch::new().file("empty.msh", "").file("noise.msh", [0xff_u8; 300]).file("toml.msh", ISO_SCENE);
    for name in ["empty.msh", "noise.msh", "toml.msh", "none.msh"] {
        for word in ["info", "check"] {
            let run = scratch.ale_gear(["mesh", word, name]);
            assert_eq!(run.code, Some(2), "{name}");
            assert!(run.stderr.starts_with(&format!("ale-gear: {name}:")), "{}", run.stderr);
            assert!(!run.stderr.contains("panicked"), "{}", run.stderr);
        }
    }
}

/// The mesh of another gear is found out before it is solved: here the pinion's mesh as the wheel's.
#[test]
fn the_mesh_of_another_gear_is_refused() {
    let scratch = Scratch::new().file("a.toml", scene(1, 3));
    assert_eq!(scratch.ale_gear(["mesh", "generate", "a.toml", "--gear", "pinion", "-o", "p.msh"]).code, Some(0));
    let wrong = ISO_SCENE.replace("[wheel]", "mesh = \"p.msh\"\n[wheel]\nmesh = \"p.msh\"").replace("iso", "reduced");
    let scratch = scratch.file("b.toml", wrong);
    let run = scratch.ale_gear(["run", "b.toml", "--out", "o"]);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(run.stderr.contains("off the wheel's flank"), "{}", run.stderr);
    assert_eq!(scratch.names(), ["a.toml", "b.toml", "p.msh"]);
}

/// A mesh in another unit is noticed in a run, with the unit and the factor.
#[test]
fn meshes_in_metres_and_inches_are_noticed() {
    let file = repository().join("meshes/coarse_hex8_pinion.msh");
    let mm = mesh::Mesh::read(&file).unwrap();
    for (unit, factor) in [("metres", 1000.0), ("inches", 25.4), ("centimetres", 10.0)] {
        let mut scaled = mm.clone();
        scaled.nodes.iter_mut().flatten().for_each(|x| *x /= factor);
        let scene = ISO_SCENE.replace("[wheel]", "mesh = \"p.msh\"\n[wheel]").replace("model = \"iso\"\n", "");
        let scratch = Scratch::new().file("a.toml", scene);
        scaled.write(scratch.path().join("p.msh"), mesh::MshFormat::Binary41).unwrap();
        let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
        assert_eq!(run.code, Some(2), "{unit}: {}", run.stderr);
        assert!(
            run.stderr.contains(&format!("hint: the mesh is in {unit}: write it again in mm, {factor} times")),
            "{}",
            run.stderr
        );
    }
}

/// A mesh with names of its own is checked by them; without them its bore is missed.
#[test]
fn own_names_of_groups_are_checked_by_flags() {
    let file = repository().join("meshes/coarse_hex8_pinion.msh");
    let mut named = mesh::Mesh::read(&file).unwrap();
    let own = |name: &str| name.replace("bore", "Hub").replace("flank_left_", "L").replace("flank_right_", "R");
    named.surfaces.iter_mut().for_each(|s| s.name = own(&s.name));
    let scratch = Scratch::new();
    named.write(scratch.path().join("p.msh"), mesh::MshFormat::Binary41).unwrap();
    let without = scratch.ale_gear(["mesh", "check", "p.msh"]);
    assert!(without.stderr.contains("bore") || without.stdout.contains("bore"), "{}{}", without.stdout, without.stderr);
    let with = ["mesh", "check", "p.msh", "--bore", "Hub", "--flank-left", "L{k}", "--flank-right", "R{k}"];
    let run = scratch.command(&with);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(!run.stdout.contains("bore"), "{}", run.stdout);
    let json = scratch.command(&[&with[..], &["--json"]].concat());
    let findings: serde_json::Value =
        serde_json::from_str(&json.stdout).unwrap_or_else(|e| panic!("{e}: {}", json.stdout));
    assert!(findings.is_array());
    let wrong = scratch.ale_gear(["mesh", "check", "p.msh", "--flank-left", "L"]);
    assert_eq!((wrong.code, wrong.stdout.as_str()), (Some(2), ""));
    let info = scratch.ale_gear(["mesh", "info", "p.msh", "--json"]);
    let info: serde_json::Value = serde_json::from_str(&info.stdout).unwrap();
    assert_eq!(info["nodes"], named.nodes.len());
}

/// A flank that its group has in part only would carry load on that part only: it is refused, and so is a mesh narrower
/// than the scene's gears.
#[test]
fn a_flank_in_part_is_refused() {
    let scratch = Scratch::new().file("a.toml", scene(1, 1));
    let made = scratch
        .ale_gear(["mesh", "generate", "a.toml", "--gear", "pinion", "-o", "p.msh", "--format", "2.2", "--ascii"]);
    assert_eq!(made.code, Some(0), "{}", made.stderr);
    let mesh = scratch.read("p.msh");
    let refused = |mesh: &str, scene: &str| {
        let scratch = Scratch::new().file("p.msh", mesh).file("b.toml", scene);
        let run = scratch.ale_gear(["run", "b.toml", "--out", "o"]);
        assert_eq!(run.code, Some(2), "{}", run.stderr);
        assert!(run.stderr.contains(" flank of tooth 0 cover 50 % of the pinion's flank"), "{}", run.stderr);
        assert!(run.stderr.contains("\nhint: are all faces of the flank in its group"), "{}", run.stderr);
    };
    let with_mesh =
        ISO_SCENE.replacen("teeth = 30\n", "teeth = 30\nmesh = \"p.msh\"\n", 1).replace("model = \"iso\"\n", "");
    // Half of the faces of one group.
    let group = mesh.lines().find(|l| l.contains("\"flank_right_0\"")).unwrap().split(' ').nth(1).unwrap().to_owned();
    let mut of_group = 0;
    let half: Vec<&str> = mesh
        .lines()
        .filter(|line| {
            let words: Vec<&str> = line.split(' ').collect();
            // Number, quadrilateral, tags, group.
            let mine = words.len() > 6 && words[1] == "3" && words[3] == group;
            of_group += usize::from(mine);
            !mine || of_group % 2 == 0
        })
        .collect();
    let removed = mesh.lines().count() - half.len();
    assert!(removed > 0, "no face of group {group}");
    let at = half.iter().position(|l| *l == "$Elements").unwrap() + 1;
    let count = (half[at].parse::<usize>().unwrap() - removed).to_string();
    let text: String =
        half.iter().enumerate().map(|(i, l)| format!("{}\n", if i == at { &count } else { *l })).collect();
    refused(&text, &with_mesh);
    refused(&mesh, &with_mesh.replace("face_width_mm = 20.0", "face_width_mm = 40.0"));
}

/// Named flanks that end before contact does: refused with the diameters or heights where more than a tenth of the path of
/// contact or of the face has nothing to carry it, remarked on where it is less, for contact would be cut off there in
/// silence.
#[test]
fn flanks_that_end_before_contact_does_are_told() {
    let mesher = |profile: u32, face: u32| {
        format!(
            "[pinion.mesher]\norder = 1\nelements_profile = {profile}\nelements_fillet = 2\nelements_thickness = 2\n\
             elements_face = {face}\nelements_rim = 1\nsector_teeth = 1\n[pair]"
        )
    };
    let on_mesh = ISO_SCENE
        .replacen("teeth = 30\n", "teeth = 30\nmesh = \"p.msh\"\n", 1)
        .replace("model = \"iso\"\n", "positions_per_cycle = 1\n")
        .replace("[pair]", &mesher(2, 2).replace("pinion", "wheel"));
    // The faces of all flanks that lie between these radii and heights as a whole.
    let run = |profile: u32, face: u32, [from, to]: [f64; 2], [low, high]: [f64; 2]| {
        let scratch = Scratch::new().file("a.toml", ISO_SCENE.replace("[pair]", &mesher(profile, face)));
        let made = scratch.ale_gear(["mesh", "generate", "a.toml", "--gear", "pinion", "-o", "p.msh"]);
        assert_eq!(made.code, Some(0), "{}", made.stderr);
        let mut mesh = mesh::Mesh::read(scratch.path().join("p.msh")).unwrap();
        let nodes = mesh.nodes.clone();
        let is_in = |&n: &u32| {
            let [x, y, z] = nodes[n as usize];
            (from..=to).contains(&x.hypot(y)) && (low..=high).contains(&z)
        };
        for group in mesh.surfaces.iter_mut().filter(|s| s.name.starts_with("flank")) {
            group.faces.retain(|face| face.nodes().iter().all(is_in));
        }
        mesh.write(scratch.path().join("p.msh"), mesh::MshFormat::Binary41).unwrap();
        let scratch = scratch.file("b.toml", &on_mesh);
        scratch.ale_gear(["run", "b.toml", "--out", "o", "--no-cache"])
    };
    const ALL: [f64; 2] = [0.0, 1e3];
    const WIDE: [f64; 2] = [-1e3, 1e3];
    // d_Nf is 91.55, d_Na 101.77 mm, the face -10 .. 10 mm.
    for (profile, face, radii, heights, end, hint) in [
        (12, 2, [46.3, 1e3], WIDE, "begins at diameter 9", "from the root form diameter"),
        (12, 2, [0.0, 50.2], WIDE, "ends at diameter 100.076 mm", "`tip_diameter_mm = 100.076`"),
        (
            2,
            8,
            ALL,
            [-8.0, 1e3],
            "begins at z = -7.500 mm, the common face at z = -10.000 mm: 12.5 %",
            "`face_width_mm`",
        ),
        (2, 8, ALL, [-1e3, 8.0], "ends at z = 7.500 mm, the common face at z = 10.000 mm: 12.5 %", "`face_width_mm`"),
    ] {
        let told = run(profile, face, radii, heights);
        assert_eq!(told.code, Some(2), "{end}: {}", told.stderr);
        assert!(told.stderr.contains(end) && told.stderr.contains(hint), "{end}, {hint}: {}", told.stderr);
    }
    let remarked = run(2, 16, ALL, [-9.0, 1e3]);
    assert_eq!(remarked.code, Some(0), "{}", remarked.stderr);
    let said = remarked.stdout + &remarked.stderr;
    assert!(said.contains("begins at z = -8.750 mm") && said.contains("6.2 %"), "{said}");
    let whole = run(2, 2, ALL, WIDE);
    let said = whole.stdout + &whole.stderr;
    assert!(whole.code == Some(0) && !said.contains("has no face to carry it"), "{said}");
}

/// A flank that is drawn from the base circle, as CAD draws it, begins there to the last bit or to the last digit of a
/// file; one that begins a tenth of a millimetre below it is another gear's.
#[test]
fn flanks_from_the_base_circle_are_the_gears() {
    let gear = "[pinion]\nteeth = 17\nhelix_angle_deg = 0.0\n@[wheel]\nteeth = 40\n[pair]\nnormal_module_mm = 2.5\n\
                face_width_mm = 10.0\n[operation]\ntorque_nm = 50.0\n";
    let scratch = Scratch::new().file("a.toml", gear.replace('@', "mesher = { order = 1, sector_teeth = 1 }\n"));
    let made = scratch.ale_gear(["mesh", "generate", "a.toml", "--gear", "pinion", "-o", "good.msh"]);
    assert_eq!(made.code, Some(0), "{}", made.stderr);
    let good = mesh::Mesh::read(scratch.path().join("good.msh")).unwrap();
    let base = 21.25 * 20f64.to_radians().cos();
    let flank: Vec<u32> =
        good.surfaces.iter().filter(|s| s.name.starts_with("flank")).flat_map(|s| s.nodes()).collect();
    let radius = |p: &[f64; 3]| p[0].hypot(p[1]);
    let lowest = flank.iter().map(|&n| radius(&good.nodes[n as usize])).fold(f64::INFINITY, f64::min);
    assert!((lowest - base).abs() < 1e-3, "the involute begins at {lowest}, the base circle is at {base} mm");
    for (off, code) in [(0.0, 0), (2e-16, 0), (-2e-16, 0), (-1e-12, 0), (-1e-7, 0), (-5e-3, 2)] {
        let mut mesh = good.clone();
        for &n in &flank {
            let p = &mut mesh.nodes[n as usize];
            let r = radius(p);
            if r < lowest + 1e-3 {
                let stretch = base / r * (1.0 + off);
                (p[0], p[1]) = (p[0] * stretch, p[1] * stretch);
            }
        }
        let scratch = Scratch::new().file("b.toml", gear.replace('@', "mesh = \"p.msh\"\n"));
        mesh.write(scratch.path().join("p.msh"), mesh::MshFormat::Binary41).unwrap();
        let run = scratch.ale_gear(["mesh", "check", "p.msh", "--scene", "b.toml", "--gear", "pinion"]);
        assert_eq!(run.code, Some(code), "{off}: {}", run.stderr);
    }
}

/// A run of a scene on a mesh of the pinion with a bore of 60 mm; `pinion` are the words on its bore.
fn on_a_mesh(model: &str, pinion: &str) -> (Scratch, crate::util::Run) {
    let scratch = Scratch::new().file("a.toml", scene(1, 1));
    let made = scratch.ale_gear(["mesh", "generate", "a.toml", "--gear", "pinion", "-o", "p.msh"]);
    assert_eq!(made.code, Some(0), "{}", made.stderr);
    let wheel = "[wheel.mesher]\norder = 1\nelements_profile = 2\nelements_thickness = 2\nelements_face = 2\nelements_rim = 1\n[pair]";
    let text = ISO_SCENE
        .replacen("bore_diameter_mm = 60.0\n", &format!("{pinion}mesh = \"p.msh\"\n"), 1)
        .replace("[pair]", wheel)
        .replace("model = \"iso\"", &format!("model = \"{model}\"\npositions_per_cycle = 2"));
    let scratch = scratch.file("b.toml", text);
    let run = scratch.ale_gear(["run", "b.toml", "--out", "out"]);
    (scratch, run)
}

fn summary(scratch: &Scratch, folder: &str) -> serde_json::Value {
    serde_json::from_str(&std::fs::read_to_string(scratch.path().join(folder).join("summary.json")).unwrap()).unwrap()
}

/// A bore that contradicts the mesh is refused with both values; left out, it is the mesh's, also for a model that
/// needs no mesh.
#[test]
fn the_bore_is_that_of_the_mesh() {
    let (_, wrong) = on_a_mesh("reduced", "bore_diameter_mm = 50.0\n");
    assert_eq!(wrong.code, Some(2), "{}", wrong.stderr);
    for word in
        ["b.toml:4:", "the pinion's `bore_diameter_mm` is 50, but the bore of", "p.msh has 60.000 mm", "hint: leave"]
    {
        assert!(wrong.stderr.contains(word), "{word} is not in {}", wrong.stderr);
    }
    for model in ["reduced", "iso"] {
        // The default would be 52.7 mm.
        let (scratch, run) = on_a_mesh(model, "");
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        let bore = summary(&scratch, "out")["inputs"]["pinion"]["bore_diameter_mm"].as_f64().unwrap();
        assert!((bore - 60.0).abs() < 1e-6, "{model}: {bore}");
    }
    assert_eq!(on_a_mesh("reduced", "bore_diameter_mm = 60.01\n").1.code, Some(0), "a rounded value is taken");
}

/// Warnings of a run on small meshes with these words of the pinion.
fn warnings(teeth: u32, bore: f64, sector: u32) -> (Vec<String>, f64) {
    let text = scene(2, sector)
        .replace("teeth = 30", &format!("teeth = {teeth}"))
        .replacen("bore_diameter_mm = 60.0", &format!("bore_diameter_mm = {bore}"), 1)
        .replacen("bore_diameter_mm = 60.0", &format!("bore_diameter_mm = {}", 2 * teeth), 1)
        .replace("elements_rim = 1", "elements_rim = 2")
        .replace("[pair]", "[wheel.mesher]\norder = 2\nelements_profile = 2\nelements_fillet = 2\nelements_thickness = 2\nelements_face = 2\nelements_rim = 2\n[pair]")
        .replace("model = \"iso\"", "model = \"reduced\"\npositions_per_cycle = 4");
    let scratch = Scratch::new().file("a.toml", text);
    let run = scratch.ale_gear(["run", "a.toml", "--out", "out"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let told = summary(&scratch, "out");
    let said = told["remarks"].as_array().unwrap().iter().map(|w| w["text"].as_str().unwrap().to_owned()).collect();
    (said, told["headline"]["mean_ste_um"].as_f64().unwrap())
}

/// The number before ` % larger` in a warning.
fn per_cent(warning: &str) -> f64 {
    let before = warning.split(" % larger").next().unwrap();
    before.rsplit(' ').next().unwrap().parse().unwrap_or_else(|_| panic!("no number in {warning}"))
}

/// How much softer a free-cut sector is depends on the gear: what the warning says of it is what the runs find.
#[test]
fn the_softness_of_a_sector_is_computed() {
    for teeth in [20, 37] {
        let bore = 2.0 * f64::from(teeth);
        let (said, cut) = warnings(teeth, bore, 5);
        let (none, whole) = warnings(teeth, bore, 0);
        let told: Vec<&String> = said.iter().filter(|w| w.contains("free cuts")).collect();
        assert_eq!(told.len(), 1, "{said:?}");
        assert!(!none.iter().any(|w| w.contains("free cuts")), "{none:?}");
        let found = 100.0 * (cut / whole - 1.0);
        // A tenth of it, and the digits that are not printed.
        assert!(
            (per_cent(told[0]) - found).abs() < 0.1 * found + 0.5,
            "{} where the runs are {found:.1} % apart",
            told[0]
        );
    }
}

/// A bore close to the teeth is told with what it does; a deep one is not.
#[test]
fn a_bore_close_to_the_teeth_is_told() {
    let held = |bore: f64| warnings(30, bore, 0).0.into_iter().find(|w| w.contains("held rigidly"));
    assert_eq!(held(60.0), None);
    let told = held(86.0).expect("a warning");
    assert!(told.contains("the pinion's bore of 86.00 mm") && told.contains("a rim of 0.17 tooth heights"), "{told}");
    assert!(per_cent(&told) > 20.0, "{told}");
}

/// A mesh that is the gear's but for one of the commonest mistakes is refused with the name of that mistake, by a run
/// and by `mesh check` with the scene alike; the mesh as it was made is not.
#[test]
fn the_commonest_mistakes_are_named() {
    let scratch = Scratch::new().file("a.toml", scene(1, 3));
    let made = scratch.ale_gear(["mesh", "generate", "a.toml", "--gear", "pinion", "-o", "good.msh"]);
    assert_eq!(made.code, Some(0), "{}", made.stderr);
    let good = mesh::Mesh::read(scratch.path().join("good.msh")).unwrap();
    let with_mesh =
        ISO_SCENE.replacen("teeth = 30\n", "teeth = 30\nmesh = \"p.msh\"\n", 1).replace("model = \"iso\"\n", "");
    let check = |mesh: &mesh::Mesh, said: &str| {
        let scratch = Scratch::new().file("b.toml", &with_mesh);
        mesh.write(scratch.path().join("p.msh"), mesh::MshFormat::Binary41).unwrap();
        let run = scratch.ale_gear(["mesh", "check", "p.msh", "--scene", "b.toml", "--gear", "pinion"]);
        if said.is_empty() {
            assert_eq!(run.code, Some(0), "{}", run.stderr);
            return;
        }
        assert!(run.code == Some(2) && run.stderr.contains(said), "`{said}` is not in {}", run.stderr);
        let same = scratch.ale_gear(["run", "b.toml", "--out", "o"]);
        assert!(same.code == Some(2) && same.stderr.contains(said), "`{said}` is not in {}", same.stderr);
    };
    let renamed = |of: &dyn Fn(&str) -> String| {
        let mut mesh = good.clone();
        mesh.surfaces.iter_mut().for_each(|s| s.name = of(&s.name));
        mesh
    };
    let moved = |of: &dyn Fn([f64; 3]) -> [f64; 3]| {
        let mut mesh = good.clone();
        mesh.nodes.iter_mut().for_each(|p| *p = of(*p));
        mesh
    };
    check(&good, "");
    let from_one = |name: &str| match name.rsplit_once('_').and_then(|(of, n)| Some((of, n.parse::<i64>().ok()?))) {
        Some((of, n)) if of.starts_with("flank") => format!("{of}_{}", n + 1),
        _ => name.to_owned(),
    };
    check(&renamed(&from_one), "teeth are numbered from 1");
    let swapped = |name: &str| match name.contains("left") {
        true => name.replace("left", "right"),
        false => name.replace("right", "left"),
    };
    check(&renamed(&swapped), "left and right are swapped");
    // As a mesher numbers all its surfaces: 3, 5, 7.
    let odd = |name: &str| match name.rsplit_once('_').and_then(|(of, n)| Some((of, n.parse::<i64>().ok()?))) {
        Some((of, n)) if of.starts_with("flank") => format!("{of}_{}", 2 * n + 5),
        _ => name.to_owned(),
    };
    check(&renamed(&odd), "flanks of this gear under other numbers: `flank_");
    check(&moved(&|[x, y, z]| [x, y, z + 10.0]), "move the mesh by -10.0000 mm along z");
    check(&moved(&|[x, y, z]| [-y, x, z]), "turned by 90 deg: its tooth 0 lies on +y");
    check(&moved(&|[x, y, z]| [y, -x, z]), "turned by -90 deg");
    let without = |name: &str| if name == "flank_left_1" { "spare".to_owned() } else { name.to_owned() };
    check(&renamed(&without), "no physical group `flank_left_1`");
}
