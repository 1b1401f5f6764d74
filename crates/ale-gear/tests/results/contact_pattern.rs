//! Contact lines and pressure pattern of a run with slices.

use std::collections::HashMap;
use std::sync::LazyLock;

use crate::util::{ISO_SCENE, Scratch, repository};

type Row = HashMap<String, f64>;

const SLICES: usize = 10;
const PLACES: usize = 41;
const GEARS: [&str; 2] = ["pinion", "wheel"];

/// The default pair on a small mesh, twice as strong as the other scenes so that tip edges touch.
fn scene() -> String {
    let mesher =
        "mesher = { order = 1, elements_profile = 3, elements_thickness = 2, elements_face = 4, elements_rim = 1 }\n";
    let contact = format!("[contact]\nslices = {SLICES}\n[output]\ncontact_lines = true\nvtu = true\nvtu_every = 99\n");
    ISO_SCENE.replace("[wheel]\n", &format!("{mesher}[wheel]\n{mesher}")).replace("150.0", "300.0").replace(
        "[analysis]\nmodel = \"iso\"",
        &format!("{contact}[analysis]\nmodel = \"reduced\"\npositions_per_cycle = 8"),
    )
}

/// One run for all tests; the second one replaces it, which needs every file's name to be known.
static RUN: LazyLock<Scratch> = LazyLock::new(|| {
    let scratch = Scratch::new().file("a.toml", scene());
    for _ in 0..2 {
        let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
    }
    scratch
});

fn rows(file: &str) -> Vec<Row> {
    let csv = RUN.read(&format!("o/{file}"));
    let mut lines = csv.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    lines
        .map(|line| {
            let values: Vec<f64> = line.split(',').map(|v| v.parse().unwrap()).collect();
            assert_eq!(values.len(), names.len(), "{file}: {line}");
            names.iter().map(|n| (*n).to_owned()).zip(values).collect()
        })
        .collect()
}

fn pattern(gear: &str) -> Vec<Row> {
    let rows = rows(&format!("contact_pattern_{gear}.csv"));
    assert_eq!(rows.len(), SLICES * PLACES);
    rows
}

fn largest(rows: &[Row], column: &str) -> f64 {
    rows.iter().map(|r| r[column]).fold(0.0, f64::max)
}

/// The part of the pattern that belongs to a height, and the step of its roll angles (degrees).
fn station(pattern: &[Row], z: f64) -> (&[Row], f64) {
    let mine = pattern.chunks(PLACES).find(|s| (s[0]["z_mm"] - z).abs() < 1e-9).unwrap();
    (mine, mine[1]["roll_angle_deg"] - mine[0]["roll_angle_deg"])
}

#[test]
fn files_are_there_and_every_column_is_documented() {
    let written: serde_json::Value = serde_json::from_str(&RUN.read("o/summary.json")).unwrap();
    let docs = std::fs::read_to_string(repository().join("docs/outputs.md")).unwrap();
    for file in [
        "contact_lines.csv",
        "contact_pattern.svg",
        "contact_pattern_pinion.csv",
        "contact_pattern_pinion.vtu",
        "contact_pattern_wheel.csv",
        "contact_pattern_wheel.vtu",
    ] {
        assert!(written["files"].as_array().unwrap().contains(&file.into()), "{file} is not listed");
        assert!(docs.contains(&format!("`{file}`")), "{file} is not in the documentation");
        if file.ends_with(".csv") {
            let text = RUN.read(&format!("o/{file}"));
            for column in text.lines().next().unwrap().split(',') {
                assert!(docs.contains(&format!("`{column}`")), "{file}: `{column}` is not in the documentation");
            }
        }
    }
    let page = RUN.read("o/report.html");
    assert_eq!(page.matches("<svg").count(), 10, "seven charts, the pattern, the transverse section with its mesh");
    let picture = RUN.read("o/contact_pattern.svg");
    for word in ["tip", "root", "MPa", "pinion, left flank", "wheel, left flank", "diameter [mm]", "z [mm]"] {
        assert!(picture.contains(word), "no `{word}` in the picture");
    }
}

/// Line load times length adds up to the pairs' forces, and p0 = 2 F' / (pi a) in every row: Hertz.
#[test]
fn contact_lines_carry_the_load() {
    let lines = rows("contact_lines.csv");
    let base_helix = (20_f64.to_radians().sin() * 20_f64.to_radians().cos()).asin();
    let length = 20.0 / SLICES as f64 / base_helix.cos();
    for position in rows("history.csv") {
        let mine = lines.iter().filter(|r| r["mesh_phase"] == position["mesh_phase"]);
        let sum: f64 = mine.map(|r| r["line_load_n_per_mm"] * length).sum();
        let want: f64 = (-1..=1).map(|k| position[&format!("normal_force_pair_{k}_n")]).sum();
        assert!((sum / want - 1.0).abs() < 1e-12, "phase {}: {sum} N, not {want} N", position["mesh_phase"]);
    }
    for r in &lines {
        let hertz = 2.0 * r["line_load_n_per_mm"] / (std::f64::consts::PI * r["half_width_mm"]);
        assert!((r["pressure_mpa"] / hertz - 1.0).abs() < 1e-12, "{r:?}");
        assert_eq!(r["coast_flank"], 0.0);
    }
}

/// The pattern holds every contact: its largest value is the run's, bit for bit, and no slice was pressed harder than
/// its place says.
#[test]
fn the_pattern_passes_through_every_contact() {
    let lines = rows("contact_lines.csv");
    let run = largest(&rows("history.csv"), "max_pressure_mpa");
    for gear in GEARS {
        let pattern = pattern(gear);
        assert_eq!(largest(&pattern, "max_pressure_mpa"), run, "{gear}");
        assert_eq!(largest(&pattern, "max_line_load_n_per_mm"), largest(&lines, "line_load_n_per_mm"), "{gear}");
        for r in &lines {
            let (places, step) = station(&pattern, r["z_mm"]);
            let roll = r[&format!("{gear}_roll_angle_deg")];
            let place = ((roll - places[0]["roll_angle_deg"]) / step).round() as usize;
            let held = places[place]["max_pressure_mpa"];
            assert!(held >= r["pressure_mpa"], "{gear} at {roll} deg: {held} MPa, but a slice has {r:?}");
        }
    }
}

/// Positions are farther apart than places, and yet there is no stripe: at every station the pattern is one piece
/// without a hole, and zero beyond the contacts, which leave the foot of the flank free.
#[test]
fn the_pattern_is_one_piece_and_zero_off_it() {
    let lines = rows("contact_lines.csv");
    for gear in GEARS {
        let pattern = pattern(gear);
        let roll = format!("{gear}_roll_angle_deg");
        for (k, places) in pattern.chunks(PLACES).enumerate() {
            let z = places[0]["z_mm"];
            let (_, step) = station(&pattern, z);
            let touched: Vec<f64> = lines.iter().filter(|r| (r["z_mm"] - z).abs() < 1e-9).map(|r| r[&roll]).collect();
            let (low, high) = touched.iter().fold((f64::MAX, f64::MIN), |(l, h), &v| (l.min(v), h.max(v)));
            for place in places {
                let at = place["roll_angle_deg"];
                let inside = at > low - 0.4999 * step && at < high + 0.4999 * step;
                let outside = at < low - 0.5001 * step || at > high + 0.5001 * step;
                let pressed = place["max_pressure_mpa"] > 0.0;
                assert!(!inside || pressed, "{gear}, slice {k}: a hole at {at} deg, touched {low} .. {high}");
                assert!(!outside || !pressed, "{gear}, slice {k}: pressed at {at} deg, touched {low} .. {high}");
                assert_eq!(pressed, place["max_line_load_n_per_mm"] > 0.0);
            }
            assert_eq!(places[0]["max_pressure_mpa"], 0.0, "{gear}: the root form circle is off the path");
        }
    }
}

/// Equal gears seen from each other: turned by half a turn about z and mirrored at mid-face, the pinion is the wheel.
/// The pinion is solved at given angles and the wheel lags by the transmission error, a shift of 0.03 of a place:
/// enough to move a contact over the border of a place, so neighbours take part.
#[test]
fn patterns_of_equal_gears_are_mirror_images() {
    let [pinion, wheel] = GEARS.map(pattern);
    for (k, places) in pinion.chunks(PLACES).enumerate() {
        let mirrored = &wheel[(SLICES - 1 - k) * PLACES..][..PLACES];
        for i in 0..PLACES {
            let around = &mirrored[i.saturating_sub(1)..(i + 2).min(PLACES)];
            let values = around.iter().map(|r| r["max_pressure_mpa"]);
            let (low, high) = values.fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)));
            let p = places[i]["max_pressure_mpa"];
            assert!(0.97 * low <= p && p <= 1.03 * high, "slice {k}, place {i}: {p} MPa, mirrored {low} .. {high} MPa");
        }
    }
    let mean = |rows: &[Row]| rows.iter().map(|r| r["max_pressure_mpa"]).sum::<f64>() / rows.len() as f64;
    let (a, b) = (mean(&pinion), mean(&wheel));
    assert!((a / b - 1.0).abs() < 0.01, "mean of the pattern: {a} MPa on the pinion, {b} MPa on the wheel");
}

/// The flank as a surface: places by slices and end faces, fields named with their units.
#[test]
fn the_surface_has_a_node_for_every_place() {
    for gear in GEARS {
        let file = std::fs::read(RUN.path().join(format!("o/contact_pattern_{gear}.vtu"))).unwrap();
        let xml = String::from_utf8_lossy(&file[..file.windows(13).position(|w| w == b"<AppendedData").unwrap()]);
        let (nodes, quads) = (PLACES * (SLICES + 2), (PLACES - 1) * (SLICES + 1));
        assert!(xml.contains(&format!("NumberOfPoints=\"{nodes}\" NumberOfCells=\"{quads}\"")), "{xml}");
        for field in ["max_pressure_mpa", "max_line_load_n_per_mm", "roll_angle_deg", "diameter_mm"] {
            assert!(xml.contains(&format!("Name=\"{field}\" NumberOfComponents=\"1\"")), "{field}: {xml}");
        }
    }
}

/// A scene without slices has no contact lines to list, and is told so before any work.
#[test]
fn contact_lines_need_slices() {
    let ask = "[output]\ncontact_lines = true\n";
    for text in [format!("{ISO_SCENE}{ask}"), scene().replace(&format!("slices = {SLICES}"), "method = \"nodal\"")] {
        let run = Scratch::new().file("a.toml", text).ale_gear(["run", "a.toml", "--out", "o"]);
        assert_eq!(run.code, Some(2), "{}", run.stdout);
        assert!(run.stderr.contains("`contact_lines` lists slices, and this scene has none"), "{}", run.stderr);
    }
}

/// The largest pressure of the run is that of a row of the contact lines, and the summary and every row of the history
/// say where: height, diameter, and an edge where an edge presses.
#[test]
fn the_largest_pressure_says_where_it_is() {
    let summary: serde_json::Value = serde_json::from_str(&RUN.read("o/summary.json")).unwrap();
    let (at, most) = (&summary["headline"]["max_pressure_at"], &summary["headline"]["max_pressure_mpa"]);
    let lines = rows("contact_lines.csv");
    let hardest = lines.iter().find(|r| r["pressure_mpa"] == most.as_f64().unwrap()).unwrap();
    for key in ["z_mm", "pinion_diameter_mm", "wheel_diameter_mm", "mesh_phase", "pinion_tooth"] {
        let (said, found) = (at[key].as_f64().unwrap(), hardest[key]);
        assert!((said / found - 1.0).abs() < 1e-12 || said == found, "{key}: {said}, {found}");
    }
    let history = rows("history.csv");
    let half = 10.0;
    for row in &history {
        let of_row: Vec<&Row> = lines.iter().filter(|l| l["mesh_phase"] == row["mesh_phase"]).collect();
        let hard = of_row.iter().find(|l| l["pressure_mpa"] == row["max_pressure_mpa"]).unwrap();
        assert!((hard["z_mm"] - row["max_pressure_z_mm"]).abs() < 1e-12, "phase {}", row["mesh_phase"]);
        let place = row["max_pressure_place"];
        if hard["off_line_mm"] > 0.0 {
            assert!(place >= 3.0, "an edge presses off the line of action: {place}");
        } else if place == 2.0 {
            assert!(hard["z_mm"].abs() > half * (1.0 - 2.0 / SLICES as f64), "an end face at z {}", hard["z_mm"]);
        }
    }
    assert!(
        history.iter().any(|r| r["max_pressure_place"] >= 3.0),
        "twice the torque, and no tip edge presses hardest"
    );
}

/// Ten slices are the scene's own, and the summary says so; too few of them are remarked on with the number that would
/// do.
#[test]
fn few_slices_are_remarked_on() {
    let summary: serde_json::Value = serde_json::from_str(&RUN.read("o/summary.json")).unwrap();
    let said = &summary["resolution"];
    assert_eq!((said["slices"].as_u64(), said["slices_chosen"].as_bool()), (Some(SLICES as u64), Some(false)));
    let enough = said["slices_that_would_do"].as_u64().unwrap();
    assert!(enough >= 32, "{said}");
    let scratch = Scratch::new().file("a.toml", scene().replace(&format!("slices = {SLICES}"), "slices = 4"));
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let warning = "4 slices are few for this pair: on a row of independent springs they are off by";
    let summary: serde_json::Value = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    let remarks = summary["remarks"].to_string();
    assert!(remarks.contains(warning) && remarks.contains(&format!("{enough} would do")), "{remarks}");
}
