//! `ale-gear mesh` and meshes in scenes, as a user meets them.

mod util;

use util::{ISO_SCENE, Scratch, repository};

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
    }
}

#[test]
fn a_format_that_is_not_written_is_named() {
    let scratch = Scratch::new().file("a.toml", scene(1, 1));
    let run = scratch.ale_gear(["mesh", "generate", "a.toml", "--gear", "wheel", "-o", "w.msh", "--format", "4.0"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(2), "ale-gear: `--format` is 4.0, allowed is 4.1 or 2.2\n"));
    assert_eq!(scratch.names(), ["a.toml"]);
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

/// A flank that its group has in part only would carry load on that part only: it is refused, and so is a mesh narrower than the scene's gears.
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
