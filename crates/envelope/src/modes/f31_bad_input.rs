//! F31: bad input.

use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
    time::Instant,
};

use mesh::{Extent, Mesh, MshFormat, StructuredOptions, generate};
use scene::Scene;

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 31,
    name: "crash or hang on bad input",
    file: "F31-bad-input",
    scene: scene_text!("F31-bad-input"),
    fails: "A count of 10^18, a NaN, a file cut short: the reader crashes, hangs, or takes all of the memory.",
    does: "Readers check every count against what is there, and answer with file, line and key.",
    naive: &["pair.normal_module_mm=nan"],
    look,
};

const SCENES: u64 = 4000;
const MESHES: u64 = 2000;
/// Pieces that break what reads numbers.
const NASTY: [&str; 10] = ["nan", "-1", "1e999", "999999999999999999", "", "\"", "[", "\u{0}", "inf", "0x7fffffff"];

fn random(seed: u64, k: u64) -> usize {
    let mut z = seed.wrapping_mul(97).wrapping_add(k).wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 31)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    (z ^ (z >> 29)) as usize
}

/// The bytes with a few places overwritten, cut out or replaced by something nasty.
fn damaged(bytes: &[u8], seed: u64) -> Vec<u8> {
    let mut out = bytes.to_vec();
    for k in 0..1 + seed % 4 {
        let at = random(seed, 3 * k) % out.len().max(1);
        match random(seed, 3 * k + 1) % 4 {
            0 => out.truncate(at),
            1 => out.iter_mut().skip(at).take(1).for_each(|b| *b = random(seed, 3 * k + 2) as u8),
            2 => drop(out.splice(at..(at + 6).min(out.len()), NASTY[random(seed, 3 * k + 2) % NASTY.len()].bytes())),
            _ => drop(out.splice(at..at, NASTY[random(seed, 3 * k + 2) % NASTY.len()].bytes())),
        }
    }
    out
}

/// How many of `count` damaged copies make `read` panic, how many it refuses, and the longest time it takes, s.
fn try_all(bytes: &[u8], count: u64, read: impl Fn(&[u8]) -> bool) -> [f64; 3] {
    let [mut panics, mut refused, mut longest] = [0.0, 0.0, 0.0f64];
    for seed in 0..count {
        let bytes = damaged(bytes, seed);
        let start = Instant::now();
        match catch_unwind(AssertUnwindSafe(|| read(&bytes))) {
            Err(_) => panics += 1.0,
            Ok(false) => refused += 1.0,
            Ok(true) => {}
        }
        longest = longest.max(start.elapsed().as_secs_f64());
    }
    [panics, refused, longest]
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let read_scene = |bytes: &[u8]| {
        let text = String::from_utf8_lossy(bytes);
        Scene::parse(&text, Path::new("damaged.toml")).is_ok_and(|s| s.gear_pair().is_ok())
    };
    let of_scenes = try_all(MODE.scene.as_bytes(), SCENES, read_scene);
    let pair = bench.scene(&AS_IT_IS)?.gear_pair()?;
    let options = StructuredOptions {
        order: 1,
        elements_profile: 1,
        elements_fillet: 2,
        elements_thickness: 1,
        elements_face: 1,
        elements_rim: 1,
        extent: Extent::Sector(1),
    };
    let made = generate(&pair.pinion, &options).map_err(EnvelopeError::of("mesh"))?;
    let mut of_meshes = [0.0f64; 3];
    for format in MshFormat::ALL {
        let bytes = made.to_msh(format).map_err(EnvelopeError::of("mesh"))?;
        let found = try_all(&bytes, MESHES, |bytes| Mesh::parse(bytes, "damaged.msh").is_ok());
        of_meshes = [of_meshes[0] + found[0], of_meshes[1] + found[1], of_meshes[2].max(found[2])];
    }
    let nan = bench.at_rest(&bench.naive(&[]));
    Ok(vec![
        Figure::new(
            format!("panics on {SCENES} damaged scenes, {} refused", of_scenes[1]),
            Shown::at_most(of_scenes[0], 0.0),
        ),
        Figure::new("damaged scenes that are refused", Shown::at_least(of_scenes[1], 0.25 * SCENES as f64)),
        Figure::new("panics on damaged meshes in every format", Shown::at_most(of_meshes[0], 0.0)),
        Figure::new(
            "damaged meshes that are refused",
            Shown::at_least(of_meshes[1], 0.25 * (MESHES * MshFormat::ALL.len() as u64) as f64),
        ),
        Figure::new("longest reading, s", Shown::at_most(of_scenes[2].max(of_meshes[2]), 1.0)),
        Figure::new("a module that is not a number", Shown::refused(&nan, "normal_module_mm")),
    ])
}
