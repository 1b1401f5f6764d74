//! The short form of `random_scenes`, and that it leaves no key out.

use std::{collections::BTreeSet, time::Instant};

use scene::Scene;
use verification::random_scenes::{KINDS, Limits, Refusals, draw, keys_of_schema, power, try_scene};

use crate::program;

/// The seed of the long runs: docs/robustness.md.
const SEED: u64 = 2026;
/// Documents of each kind in the short form, in the order of [`KINDS`].
const DOCUMENTS: [u64; 3] = [40, 12, 12];
/// Scenes are drawn, not run, until every key has been in one that fits together.
const DRAWN: u64 = 20_000;

#[test]
fn every_document_is_solved_or_refused_for_a_known_reason() {
    let refusals = Refusals::committed().unwrap();
    let (start, mut wrong) = (Instant::now(), Vec::new());
    for ((kind, draw), count) in KINDS.iter().zip(DOCUMENTS) {
        for index in 0..count {
            let folder = tempfile::tempdir().unwrap();
            let document = draw(SEED, index);
            let tried = try_scene(program(), folder.path(), index, &document, (Limits::default(), &refusals)).unwrap();
            wrong.extend(tried.wrong.iter().map(|w| format!("{kind} {index} ({}): {w}", tried.model)));
        }
    }
    let seconds = start.elapsed().as_secs_f64();
    assert!(wrong.is_empty(), "of {DOCUMENTS:?} documents of seed {SEED}, {seconds:.0} s:\n{}", wrong.join("\n"));
}

/// A scene is its seed and its number: drawn twice it is the same text.
#[test]
fn a_scene_is_determined_by_seed_and_number() {
    for index in 0..50 {
        for (kind, draw) in KINDS {
            let [a, b] = [(); 2].map(|()| draw(SEED, index).draft.text().unwrap());
            assert_eq!(a, b, "{kind} {index}");
            assert_ne!(a, draw(SEED + 1, index).draft.text().unwrap(), "{kind} {index} of another seed");
        }
    }
}

/// Every key of the table of keys is in some scene that is accepted; what is left out would never be tried.
#[test]
fn no_key_is_left_out() {
    let all: BTreeSet<String> = scene::all_keys().into_iter().collect();
    let of_schema: BTreeSet<String> = keys_of_schema().iter().map(|k| k.name.clone()).collect();
    assert_eq!(all, of_schema, "keys of the table and of the schema");
    let folder = tempfile::tempdir().unwrap();
    std::os::unix::fs::symlink(testing::meshes_folder(), folder.path().join("meshes")).unwrap();
    // The ring of a pair is its wheel: a pinion has no shaper. Bolts open in gearboxes alone.
    let of_pairs = |key: &String| {
        let of_bolts = key.ends_with(".bore.bolts.opens") || key.ends_with(".bore.bolts.preload_n");
        !key.starts_with("pinion.shaper.") && !of_bolts
    };
    let mut left: BTreeSet<String> = all.into_iter().filter(of_pairs).collect();
    for index in 0..DRAWN {
        if left.is_empty() {
            return;
        }
        let drawn = draw(SEED, index).draft;
        let keys: Vec<String> = drawn.keys().into_iter().filter(|k| left.contains(k)).collect();
        if keys.is_empty() {
            continue;
        }
        for (name, content) in &drawn.files {
            std::fs::write(folder.path().join(name), content).unwrap();
        }
        if Scene::parse(&drawn.text().unwrap(), &folder.path().join("scene.toml")).is_ok() {
            keys.iter().for_each(|k| _ = left.remove(k));
        }
    }
    assert!(left.is_empty(), "in none of {DRAWN} accepted scenes: {left:?}");
}

/// Patterns of known reasons: a star stands for anything, and the ends are held.
#[test]
fn a_star_stands_for_anything() {
    use verification::random_scenes::matches;
    assert!(matches("a * b", "a 12.5 b") && matches("*", "") && matches("a*", "a: `x`"));
    assert!(!matches("a * b", "a 12.5 c") && !matches("a", "ab") && !matches("*x", "y"));
}

/// Every key of a scene with a unit has one that is known: what stands behind the last underscore is no unit.
#[test]
fn units_are_those_of_names() {
    for (name, wanted) in [
        ("mesh_damping_ns_per_mm2", 1),
        ("penalty_mpa_per_mm", -1),
        ("stiffness_rx_nmm_per_rad", 3),
        ("torque_nm", 3),
        ("density_kg_m3", 0),
        ("polar_inertia_kg_m2", 5),
        ("teeth", 0),
        ("positions_per_cycle", 0),
        ("pinion_force_x_n", 2),
        ("mesh_stiffness_n_per_um", 1),
        ("wheel_x_rate_um_per_s", 0),
    ] {
        assert_eq!(power(name), wanted, "{name}");
    }
}
