//! Typical mistakes, as a user meets them: the whole text, exit status 2, nothing written.

use crate::util::{ISO_SCENE, Scratch, motion_scene};

fn says(scene: &str, text: &str) {
    let scratch = Scratch::new().file("a.toml", scene);
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!(run.complaint(), text, "for\n{scene}");
    assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""));
    assert_eq!(scratch.names(), ["a.toml"], "something was left behind");
}

/// The complete scene with one line replaced.
fn with(old: &str, new: &str) -> String {
    assert!(ISO_SCENE.contains(old));
    ISO_SCENE.replacen(old, new, 1)
}

#[test]
fn a_misspelt_key_names_line_and_neighbour() {
    says(
        "[pair]\nface_widht_mm = 25.0\n",
        "ale-gear: a.toml:2: unknown key `face_widht_mm`\nhint: did you mean `face_width_mm`?\n",
    );
    says(
        &with("torque_nm = ", "torque = "),
        "ale-gear: a.toml:14: unknown key `torque`\nhint: did you mean `torque_nm`?\n",
    );
}

/// The line itself, with a mark below the word that is meant: of every kind of complaint.
#[test]
fn the_line_is_shown_with_a_mark() {
    let shown = |scene: &str, text: &str| {
        let scratch = Scratch::new().file("a.toml", scene);
        let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
        assert!(run.stderr.contains(text), "{}", run.stderr);
        assert!(!run.stderr.contains('\x1b'), "colours into a pipe: {}", run.stderr);
    };
    shown(
        "[pair]\nface_widht_mm = 25.0 # wide\n",
        "ale-gear: a.toml:2: unknown key `face_widht_mm`\n  2 | face_widht_mm = 25.0 # wide\n    | ^^^^^^^^^^^^^\nhint: ",
    );
    shown(&with("teeth = 30", "teeth = \"30\""), "  2 | teeth = \"30\"\n    |         ^^^^\n");
    shown(&with("teeth = 30", "teeth = -3"), "  2 | teeth = -3\n    |         ^^\n");
    shown(&format!("{ISO_SCENE}[contact]\ngap = \"facet\"\n"), "  18 | gap = \"facet\"\n     |       ^^^^^^^\n");
    shown("[pair\n", "  1 | [pair\n");
}

/// What only the geometry can judge names the line of the key at fault, or the heading of its table.
#[test]
fn physical_nonsense_names_its_line() {
    let refused = |scene: String, said: &[&str]| {
        let scratch = Scratch::new().file("a.toml", scene);
        let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
        for text in said {
            assert!(run.stderr.contains(text), "no `{text}` in\n{}", run.stderr);
        }
        assert!(run.stderr.contains("\nhint: "), "{}", run.stderr);
        assert_eq!((run.code, scratch.names().len()), (Some(2), 1), "{}", run.stderr);
    };
    let pair = |line: &str| with("[pair]\n", &format!("[pair]\n{line}\n"));
    let pinion = |line: &str| with("teeth = 30\n", &format!("teeth = 30\n{line}\n"));
    refused(
        pair("centre_distance_mm = 80.0"),
        &["a.toml:11: [pair]: centre distance 80 mm is too small", "11 | centre_distance_mm = 80.0"],
    );
    refused(pair("centre_distance_mm = 95.0"), &["a.toml:11: [pair]: the teeth jam", "fit at 95.7760 mm"]);
    refused(pair("centre_distance_mm = 103.0"), &["a.toml:11: [pair]: the pair has no path of contact"]);
    refused(
        pair("root_radius_coefficient = 0.45\naddendum_coefficient = 1.24").replacen(
            "[wheel]\nteeth = 30",
            "[wheel]\nteeth = 120",
            1,
        ),
        &["a.toml:12: [pair]: interference at the root: the wheel's tip enters the fillet of the pinion by 0."],
    );
    refused(
        ISO_SCENE
            .replace("helix_angle_deg = 20.0", "helix_angle_deg = 0.0")
            .replace("[pair]\n", "[pair]\ncentre_distance_mm = 93.2\n"),
        &["a.toml:11: [pair]: total contact ratio", "below 1"],
    );
    refused(pinion("profile_shift = 1.9"), &["a.toml:3: [pinion]: the teeth are pointed", "3 | profile_shift = 1.9"]);
    refused(
        pinion("profile_shift = -1.5").replacen("thickness_allowance_mm = 0.05", "thickness_allowance_mm = 1.5", 1),
        &["a.toml:3: [pinion]: the teeth have no thickness"],
    );
    refused(
        with("bore_diameter_mm = 60.0", "bore_diameter_mm = 92.0"),
        &["a.toml:4: [pinion]: bore diameter 92 mm leaves no rim"],
    );
    refused(pair("root_radius_coefficient = 0.6"), &["a.toml:11: [pinion]: root radius coefficient 0.6 is too large"]);
    // Of several keys that may be at fault the first that is written is named.
    refused(
        with("teeth = 30", "teeth = 12")
            .replace("bore_diameter_mm = 60.0\n", "")
            .replace("[pair]\n", "[pair]\nnormal_pressure_angle_deg = 35.0\n"),
        &["a.toml:9: [pinion]: the teeth are pointed", "9 | normal_pressure_angle_deg = 35.0"],
    );
}

/// The default root radius is never larger than the rack has room for: 25 degrees leave 0.3178. One that is stated is
/// taken at its word.
#[test]
fn the_default_root_radius_fits_the_pressure_angle() {
    let steep = ISO_SCENE.replace("[pair]\n", "[pair]\nnormal_pressure_angle_deg = 25.0\n");
    let scratch = Scratch::new().file("a.toml", steep);
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let summary = std::fs::read_to_string(scratch.path().join("o/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    assert_eq!(summary["inputs"]["pair"]["root_radius_coefficient"], serde_json::json!(0.3178));
    let stated = "[pair]\nnormal_pressure_angle_deg = 25.0\nroot_radius_coefficient = 0.38\n";
    let scratch = Scratch::new().file("a.toml", ISO_SCENE.replace("[pair]\n", stated));
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!(run.code, Some(2), "{}", run.stdout);
    for part in
        ["a.toml:12: [pinion]: root radius coefficient 0.38 is too large", "12 | root_radius_coefficient = 0.38"]
    {
        assert!(run.stderr.contains(part), "{part} is not in {}", run.stderr);
    }
}

/// What only another model writes is not read and ignored.
#[test]
fn a_ramp_without_waterfall_takes_no_word_on_it() {
    let scene = with("model = \"iso\"", "model = \"impact\"")
        + "[motion]\nrun = \"ramp\"\n[motion.ramp]\nfrom_rpm = 500.0\nto_rpm = 900.0\nduration_s = 0.1\nwaterfall_cycles = 8\n";
    says(
        &scene,
        "ale-gear: a.toml:23: `waterfall_cycles` means nothing to the model \"impact\"\n\
         hint: leave it out: of a ramp of this model the last speed has a spectrum\n",
    );
}

/// Undercut is no error, but a user hears of it, with the number that avoids it.
#[test]
fn undercut_is_told_with_its_way_out() {
    let scene = with("teeth = 30", "teeth = 12").replacen("bore_diameter_mm = 60.0", "bore_diameter_mm = 15.0", 1);
    let scratch = Scratch::new().file("a.toml", scene);
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stdout.contains("the pinion is undercut"), "{}", run.stdout);
    assert!(run.stdout.contains("`profile_shift` of 0."), "{}", run.stdout);
}

#[test]
fn a_key_in_the_wrong_table_is_sent_to_its_own() {
    says(
        &with("[pair]\n", "[pair]\ntorque_nm = 3.0\n"),
        "ale-gear: a.toml:11: unknown key `torque_nm`\nhint: `torque_nm` belongs to [operation]\n",
    );
}

#[test]
fn a_wrong_type_names_both() {
    says(
        &with("teeth = 30", "teeth = \"30\""),
        "ale-gear: a.toml:2: `teeth` must be a whole number, found string \"30\"\n\
         hint: write numbers without quotes and without a unit: the unit is in the key\n",
    );
    says(
        "pinion = 3\n",
        "ale-gear: a.toml:1: `pinion` must be a table, found integer 3\n\
         hint: write `[pinion]` on a line of its own, and its keys on the lines below\n",
    );
    says(
        &with("teeth = 30", "teeth = 30.0"),
        "ale-gear: a.toml:2: `teeth` must be a whole number, found number 30.0\nhint: write a whole number, without a decimal point\n",
    );
    says(
        &with("model = \"iso\"", "model = 3"),
        "ale-gear: a.toml:16: `model` must be a text in quotes, found integer 3\n\
         hint: write `model = \"...\"`, the text between the quotes\n",
    );
}

#[test]
fn a_value_out_of_range_names_the_range() {
    says(
        &with("teeth = 30", "teeth = -3"),
        "ale-gear: a.toml:2: `teeth` is -3, allowed is 5 .. 2000\nhint: `teeth` means: number of teeth, negative of an internal gear (ISO 21771: z = -93)\n",
    );
    says(
        &with("face_width_mm = 20.0", "face_width_mm = nan"),
        "ale-gear: a.toml:12: `face_width_mm` is NaN, allowed is 0.01 .. 10000\nhint: `face_width_mm` means: face width of gears that state none of their own, mm; left out where both do\n",
    );
    says(
        &with("model = \"iso\"", "model = \"reducd\""),
        "ale-gear: a.toml:16: `model` is \"reducd\", allowed is \"reduced\" or \"auto\" or \"reduced+modes\" or \"mapped\" or \"full\" or \"iso\" or \"lumped8\" or \"lumped12\" \
         or \"shaft18\" or \"impact\"\n\
         hint: did you mean \"reduced\"?\n",
    );
}

#[test]
fn everything_that_is_missing_is_named_at_once() {
    says(
        "[pinion]\nteeth = 30\n[wheel]\nteeth = 30\n[pair]\nnormal_module_mm = 3.0\n",
        "ale-gear: a.toml: missing `[pinion] helix_angle_deg`, `[pair] face_width_mm`, `[operation] torque_nm`\n\
         hint: teeth, module, helix angle, face width and torque have no default\n",
    );
}

#[test]
fn what_this_version_cannot_do_is_refused_and_not_ignored() {
    says(
        &format!("{ISO_SCENE}[contact]\nfriction = 0.05\n"),
        "ale-gear: a.toml:18: only the model \"reduced\" has friction\n\
         hint: leave it out, or use `model = \"reduced\"`\n",
    );
    says(
        &format!("{ISO_SCENE}[contact]\ngap = \"facet\"\n"),
        "ale-gear: a.toml:18: `gap` means nothing to slices\n\
         hint: leave it out, or use `method = \"nodal\"`\n",
    );
    says(
        &with("model = \"iso\"", "model = \"reduced+modes\""),
        "ale-gear: a.toml:16: `model = \"reduced+modes\"` needs `kind = \"dynamic\"`: modes are motion, and nothing moves here\n\
         hint: say `kind = \"dynamic\"` in [analysis], or use `model = \"reduced\"`: at rest both are the same\n",
    );
    says(
        &with("[analysis]", "[analysis]\nkind = \"dynamic\""),
        "ale-gear: a.toml:17: `model = \"iso\"` asks for another model in time, which this version cannot do\n\
         hint: use `model = \"reduced\"`\n",
    );
}

/// Every count is in its range, and their product is beyond any memory: told with rows, bytes and keys, by every kind
/// of analysis.
#[test]
fn rows_beyond_any_memory_are_refused_before_the_work() {
    let refused = |scene: &str, words: &[&str], said: &[&str]| {
        let scratch = Scratch::new().file("a.toml", scene);
        let run = scratch.command(&[words, &["--out", "o"]].concat());
        for text in said {
            assert!(run.stderr.contains(text), "no `{text}` in\n{}", run.stderr);
        }
        assert!(run.stderr.contains(" GB of memory are free\n"), "{}", run.stderr);
        assert_eq!((run.code, scratch.names().len()), (Some(2), 1), "{}", run.stderr);
    };
    let run = ["run", "a.toml"];
    let huge = |scene: &str| scene.to_owned() + "positions_per_cycle = 100000\ncycles = 100000000\n";
    let said = [
        "1.0e13 positions (`cycles` 1.0e8 x `positions_per_cycle` 100000)",
        "\nhint: lower `cycles` or `positions_per_cycle`: ",
    ];
    refused(&huge(ISO_SCENE), &run, &[&["ale-gear: a.toml:18: "], &said[..]].concat());
    refused(&huge(&with("model = \"iso\"", "model = \"reduced\"")), &run, &said);
    refused(&huge(&with("model = \"iso\"", "model = \"full\"")), &run, &said);
    let seconds =
        motion_scene(0, "run = \"span\"\nduration_s = 1e9\n").replace("per_mesh_cycle = 16", "per_mesh_cycle = 100000");
    refused(
        &seconds,
        &run,
        &["5.0e16 rows (`duration_s` 5.0e11 x `steps_per_mesh_cycle` 100000)", "hint: lower `duration_s`"],
    );
    let sweep = "run = \"sweep\"\nsweep = { from_rpm = 3000, to_rpm = 4000, speeds = 100000 }\n";
    let sweep = motion_scene(100_000_000, sweep);
    refused(&sweep, &run, &["(`cycles` 1.0e8 x `steps_per_mesh_cycle` 16 x `speeds` 100000)"]);
    let ladder = with("model = \"iso\"", "model = \"impact\"\ncycles = 100000000");
    let ladder = ladder + "[motion]\nsteps_per_mesh_cycle = 100000\n";
    refused(&ladder, &run, &["1.0e13 rows (`cycles` 1.0e8 x `steps_per_mesh_cycle` 100000)"]);
    let by_key = ["vary", "a.toml", "--vary", "operation.speed_rpm=1000:2000:2", "--start", "carry"];
    let long = [&by_key[..], &["--cycles", "100000", "--once", "pinion-turn"]].concat();
    refused(&ladder, &long, &["(`--cycles` 100000 x `steps_per_mesh_cycle` 100000 x `mesh cycles of a turn` 30)"]);
    let study = "[[case]]\nscene = \"b.toml\"\nvalue = 1\n[[quantity]]\ncolumn = \"ste_um\"\n";
    let scratch = Scratch::new().file("b.toml", huge(ISO_SCENE)).file("a.toml", study);
    let refused = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert!(refused.stderr.starts_with("ale-gear: b.toml:18: 1.0e13 positions "), "{}", refused.stderr);
    assert_eq!(refused.code, Some(2));
}

#[test]
fn gears_that_cannot_run_together_are_refused() {
    says(
        &with("[wheel]", "[wheel]\nhelix_angle_deg = 20"),
        "ale-gear: a.toml:7: the wheel's `helix_angle_deg` is 20, but the pinion's is 20: they do not mesh\n\
         hint: leave it out: the wheel's helix angle follows from the pinion's\n",
    );
    let scratch = Scratch::new().file("a.toml", with("[pair]", "[pair]\ncentre_distance_mm = 80"));
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert!(
        run.stderr.starts_with("ale-gear: a.toml:11: [pair]: centre distance 80 mm is too small"),
        "{}",
        run.stderr
    );
    assert_eq!((run.code, scratch.names().len()), (Some(2), 1));
}

#[test]
fn a_mesh_that_is_not_there_is_missed_before_any_work() {
    says(
        &with("[wheel]", "[wheel]\nmesh = \"no.msh\""),
        "ale-gear: a.toml:7: `mesh` is \"no.msh\", but there is no file no.msh\n\
         hint: paths are relative to the scene file\n",
    );
    says(
        &with("[pair]", "[wheel.groups]\nflank_left = \"Left\"\n[pair]"),
        "ale-gear: a.toml:11: `flank_left` is \"Left\", which has no place for the tooth number\n\
         hint: write {k} where the number stands, as in flank_left = \"Left_{k}\"\n",
    );
}

#[test]
fn keys_of_micro_geometry_are_checked_one_with_the_other() {
    let check = says;
    let says = |table: &str, line: usize, text: &str| {
        check(&format!("{ISO_SCENE}{table}"), &format!("ale-gear: a.toml:{line}: {text}\n"));
    };
    says(
        "[pinion.modification.drive]\ntip_releif_um = 3\n",
        18,
        "unknown key `tip_releif_um`\nhint: did you mean `tip_relief_um`?",
    );
    says(
        "[wheel.modification]\nlead_crowning = 3\n",
        18,
        "unknown key `lead_crowning`\nhint: did you mean `lead_crowning_um`?",
    );
    says(
        "[pair.misalignment]\nbias_um = 3\n",
        18,
        "unknown key `bias_um`\nhint: `bias_um` belongs to [pinion.modification]",
    );
    says(
        "[pinion.modification]\ntip_relief_um = 3\n",
        18,
        "`tip_relief_um` has no start\nhint: a relief is `tip_relief_um` with `tip_relief_start_diameter_mm` or \
         `tip_relief_start_roll_deg`",
    );
    says(
        "[pinion.modification]\nroot_relief_shape = \"linear\"\n",
        18,
        "`root_relief_shape` has no `root_relief_um`\nhint: a relief is `root_relief_um` with \
         `root_relief_start_diameter_mm` or `root_relief_start_roll_deg`",
    );
    says(
        "[pinion.modification.coast]\nend_relief_upper_um = 4\n",
        18,
        "`end_relief_upper_um` has no `end_relief_upper_length_mm`\nhint: give both `end_relief_upper_um` and \
         `end_relief_upper_length_mm`, or neither",
    );
    says(
        "[pinion.modification]\ntopography = \"no.csv\"\n",
        18,
        "`topography` is \"no.csv\", but there is no file no.csv\nhint: paths are relative to the scene file",
    );
    says(
        "[pinion.modification]\nlead_crowning_um = 2000\n",
        18,
        "`lead_crowning_um` is 2000, allowed is -1000 .. 1000\nhint: `lead_crowning_um` means: lead crowning C_beta, µm at both ends of the face",
    );
    says(
        "[pair.misalignment]\ninclination_um = 500\n",
        18,
        "`inclination_um` is 500, allowed is -200 .. 200\n\
         hint: `inclination_um` means: f_Sigma_delta: deviation of the wheel's axis in the plane of axes, µm over the face width",
    );
    for table in ["[pair.misalignment]\ninclination_um = 5\n", "[wheel.modification]\nlead_slope_um = 3\n"] {
        let key = if table.contains("pair") { "misalignment" } else { "modification" };
        says(
            table,
            17,
            &format!(
                "`{key}` means nothing to the model \"iso\", which takes nominal flanks on parallel axes\n\
                 hint: leave it out, or use `model = \"reduced\"`"
            ),
        );
    }
    check(
        &with("teeth = 30\nhelix", "teeth = 30\npitch_errors_um = [1, 2]\nhelix"),
        "ale-gear: a.toml:3: `pitch_errors_um` has 2 values, but the gear has 30 teeth\n\
         hint: give one value a tooth, tooth 0 first\n",
    );
}

/// What only the geometry can judge names the gear, what only the file can the file and its line.
#[test]
fn micro_geometry_off_the_flank_names_the_range() {
    let scene = with("model = \"iso\"", "model = \"reduced\"");
    let off = format!("{scene}[pinion.modification]\ntip_relief_um = 5\ntip_relief_start_diameter_mm = 120\n");
    let scratch = Scratch::new().file("a.toml", off);
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert!(
        run.stderr.starts_with("ale-gear: a.toml:19: [pinion]: start of tip relief: 120.0000 mm"),
        "{}",
        run.stderr
    );
    assert!(run.stderr.contains("\nhint: put the start of tip relief between "), "{}", run.stderr);
    assert_eq!(run.code, Some(2));
    let grid = format!("{scene}[wheel.modification]\ntopography = \"grid.csv\"\n");
    let scratch = Scratch::new().file("a.toml", grid).file("grid.csv", "diameter_mm 0 1\n90 0 0\n91 0 zero\n");
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert!(run.stderr.starts_with("ale-gear: grid.csv:3: expected a number, found `zero`\nhint: "), "{}", run.stderr);
    assert_eq!(run.code, Some(2));
}

#[test]
fn broken_toml_names_the_line() {
    says(
        "[pair]\nface_width_mm = 1\nface_width_mm = 2\n",
        "ale-gear: a.toml:3: `face_width_mm` is there twice\n\
         hint: keep one of them; all keys of a table stand under one heading\n",
    );
    let hinted = |line: &str, hint: &str| {
        let scratch = Scratch::new().file("a.toml", with("normal_module_mm = 3.0", line));
        let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
        assert!(
            run.stderr.starts_with("ale-gear: a.toml:11: ") && run.stderr.ends_with(hint),
            "{line}: {}",
            run.stderr
        );
    };
    hinted("normal_module_mm = 3,0", "hint: write numbers with a decimal point: `2.5`, not `2,5`\n");
    hinted("normal_module_mm = 3.", "hint: write a digit behind the decimal point: `2.0`, not `2.`\n");
    hinted("normal_module_mm = 1e400", "hint: numbers end at 1.8e308\n");
    hinted("normal_module_mm = \"3.0", "hint: end the text with a quote on the same line\n");
}

/// A file of another encoding is told so, and not taken for one that is missing.
#[test]
fn a_scene_that_is_no_plain_text_is_told() {
    let scene: Vec<u8> = ISO_SCENE.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let scratch = Scratch::new().file("a.toml", [&[0xff, 0xfe], &scene[..]].concat());
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert!(run.stderr.ends_with("hint: a scene is plain text: save it as UTF-8\n"), "{}", run.stderr);
    assert_eq!(run.code, Some(2));
}

#[test]
fn words_of_the_command_are_checked_too() {
    let scratch = Scratch::new().file("a.toml", ISO_SCENE);
    for (run, text) in [
        (
            scratch.ale_gear(["run", "a.toml", "--out", "o", "--torque-nm", "-5"]),
            "ale-gear: --torque-nm: `torque_nm` is -5, allowed is 0 .. 1000000000\n\
             hint: `torque_nm` means: torque on the driven gear, N·m, against its motion; `driver` and `rotation` say which flanks it presses\n",
        ),
        (
            scratch.ale_gear(["run", "a.toml", "--out", "a.toml"]),
            "ale-gear: --out a.toml: is a file\nhint: give the name of a new folder\n",
        ),
        (
            scratch.ale_gear(["run", "a.toml", "--out", "."]),
            "ale-gear: --out .: is no name of a folder\nhint: give the name of a new folder\n",
        ),
        (
            scratch.ale_gear(["run", "a.toml", "--out", "o", "--vtu"]),
            "ale-gear: a.toml: the model \"iso\" has no mesh, so there is nothing for ParaView\n\
             hint: leave `vtu` out, or use `model = \"reduced\"`\n",
        ),
    ] {
        assert_eq!((run.stderr.as_str(), run.code), (text, Some(2)));
    }
    assert_eq!(scratch.ale_gear(["fly"]).code, Some(2));
    assert_eq!(scratch.names(), ["a.toml"]);
}

/// Any cut-off or damaged scene ends in a message and never in a panic.
#[test]
fn no_damage_to_a_scene_makes_the_reader_panic() {
    let bytes = ISO_SCENE.as_bytes();
    for at in 0..bytes.len() {
        for insert in [&b""[..], b"\"", b"[", b"=", b"-", b"\xc3\xa9", b"\0"] {
            let mut damaged = bytes[..at].to_vec();
            damaged.extend(insert);
            let cut = damaged.clone();
            damaged.extend(&bytes[at..]);
            for text in [cut, damaged] {
                // A scene that still says something whole is as good as a complaint; a panic fails the test.
                let text = String::from_utf8_lossy(&text).into_owned();
                if let Err(error) = ale_gear::scene::Scene::parse(&text, "a.toml".as_ref()) {
                    assert!(error.to_string().starts_with("a.toml"), "{error}");
                }
            }
        }
    }
}

/// Lines that are no TOML are told by what stands there, and the hint writes the line.
#[test]
fn lines_that_are_no_toml_are_written_right() {
    let teeth = |line: &str| with("teeth = 30", line);
    for (scene, said, hint) in [
        (teeth("teeth ="), "`teeth` has no value", "write a value after `=`"),
        (teeth("teeth : 30"), "`:` stands where `=` is wanted", "write `teeth = 30`"),
        (teeth("teeth = 30\""), "`teeth` has a quote at its end alone", "write `teeth = 30`, without a quote"),
        (
            teeth("name = a b\""),
            "`name` has a quote at its end alone",
            "write `name = \"a b\"`, with a quote on either side",
        ),
        (teeth("teeth = 30\n  0.1, 0.2,\n]"), "values without a key", "a list stands in brackets behind its key"),
        (teeth("teeth = 30\nteeth = 30"), "`teeth` is there twice", "keep one of them"),
        (
            teeth("teeth = true"),
            "`teeth` must be a whole number, found boolean true",
            "write a whole number alone, as `teeth = 4`",
        ),
        (with("[pair]", "[pairs]"), "unknown key `pairs`", "did you mean `pair`?"),
        ("[[pinion]]\nteeth = 3\n[pinion]\n".to_owned(), "`[pinion]` stands beside `[[pinion]]`", "write `[[pinion]]`"),
    ] {
        let run = Scratch::new().file("a.toml", &scene).ale_gear(["run", "a.toml", "--out", "o"]);
        let first = run.stderr.lines().next().unwrap_or_default();
        assert!(run.code == Some(2) && first.ends_with(said), "{scene}\nis answered by {}", run.stderr);
        assert!(run.stderr.contains(&format!("\nhint: {hint}")), "{scene}\nis answered by {}", run.stderr);
    }
}

/// Habits from other programs and other countries are answered with what is written here instead.
#[test]
fn habits_from_elsewhere_are_put_right() {
    let hint = |scene: &str, hint: &str| {
        let run = Scratch::new().file("a.toml", scene).ale_gear(["run", "a.toml", "--out", "o"]);
        assert_eq!(run.code, Some(2), "{}", run.stderr);
        assert!(run.stderr.contains(&format!("\nhint: {hint}")), "{scene}\nis answered by {}", run.stderr);
    };
    hint(
        &with("normal_module_mm = 3.0", "normal_module_mm = 3,0"),
        "write numbers with a decimal point: `2.5`, not `2,5`\n",
    );
    hint(&with("teeth = 30", "teeth = 30.5"), "write a whole number, without a decimal point\n");
    hint(&with("teeth = 30", "teeth = \"30\""), "write numbers without quotes");
    hint(
        &with("torque_nm = 150.0", "torque_nm = -150.0"),
        "`torque_nm` means: torque on the driven gear, N·m, against its motion; `driver` and `rotation`",
    );
    let run = Scratch::new().file("a.toml", ISO_SCENE).ale_gear(["a.toml"]);
    assert!(run.stderr.contains("ale-gear run a.toml --out DIR"), "{}", run.stderr);
    assert_eq!(run.code, Some(2));
}

/// Names, keys, values and paths of others say nothing to a terminal: on stderr, in tables, in progress.
#[test]
fn no_control_characters_of_files_reach_the_terminal() {
    // A title, C1's CSI, an override of the direction of writing, DEL.
    let hostile = "\\u001b]0;owned\\u0007 \\u009b31m \\u202Egnp.\\u2066 \\u007f\\r";
    let named = format!("name = \"{hostile}\"\n{ISO_SCENE}");
    let scenes = [
        named.clone(),
        with("[pinion]\n", &format!("[pinion]\n\"teeth {hostile}\" = 3\n")),
        with("[pinion]\n", &format!("[pinion]\nmesh = \"{hostile}.msh\"\n")),
        format!("{ISO_SCENE}[contact]\nmethod = \"{hostile}\"\n"),
        format!("[\"{hostile}\"]\n{ISO_SCENE}"),
    ];
    let clean = |text: &str| {
        let obeyed = |c: char| {
            (c.is_control() && c != '\n' && c != '\t')
                || ('\u{202a}'..='\u{202e}').contains(&c)
                || ('\u{2066}'..='\u{2069}').contains(&c)
        };
        assert!(!text.chars().any(obeyed), "{text:?}");
    };
    for scene in &scenes {
        let scratch = Scratch::new().file("a.toml", scene);
        for words in [&["run", "a.toml", "--out", "o", "-vv"][..], &["geometry", "a.toml"], &["init", "--help"]] {
            let run = scratch.command(words);
            clean(&run.stdout);
            clean(&run.stderr);
        }
    }
    let scratch = Scratch::new().file("a.toml", named);
    let raw = "\x1b]0;owned\x07\u{9b}31m\u{202e}";
    for words in [
        &["run", "a.toml", "--out", raw, "--set", raw][..],
        &["run", raw, "--out", "o"],
        &[raw],
        &["mesh", "check", raw],
    ] {
        let run = scratch.command(words);
        assert_eq!(run.code, Some(2), "{}", run.stderr);
        assert!(run.stderr.contains("31m"), "{}", run.stderr);
        clean(&run.stderr);
    }
}

/// A quantity of three hundred digits and a key of thousands of parts are cut to what is read.
#[test]
fn numbers_and_words_of_messages_are_as_long_as_one_reads() {
    let scratch = Scratch::new().file("a.toml", ISO_SCENE);
    let key = vec!["a"; 5000].join(".");
    let nested = format!("name={}{}", "[".repeat(50_000), "]".repeat(50_000));
    for setting in
        ["operation.torque_nm=1e300", "pinion.teeth=1e200", "pair.face_width_mm=-1e300", &format!("{key}=1"), &nested]
    {
        let run = scratch.ale_gear(["run", "a.toml", "--out", "o", "--set", setting]);
        assert_eq!(run.code, Some(2), "{}", run.stderr);
        assert!(run.stderr.len() < 1200, "{} bytes: {}", run.stderr.len(), run.stderr);
        assert!(!run.stderr.contains(&"0".repeat(12)), "{}", run.stderr);
    }
}
