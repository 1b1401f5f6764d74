//! Do the bounds of headline numbers hold on meshes of another program?
//!
//! `python3 tests/scripts/foreign_meshes.py FOLDER` makes them, then
//! `cargo run --release -p verification --bin check_foreign_meshes -- FOLDER [FIRST [COUNT]]` runs every pair of
//! `tests/data/foreign_pairs.json` on its hexahedra and tetrahedra, coarse and refined, and on a fine mesh of the
//! ladder with four times the slices and positions. It ends with status 1 where a bound does not hold.
#![allow(clippy::print_stdout, reason = "the table is what it is for")]

use std::{error::Error, path::Path, process::ExitCode};

use analysis::accuracy::Rung;
use scene::{MesherScene, Scene, SceneError};
use serde_json::Value;
use verification::judged::{JUDGED, accurate, bound, exact, holds};

type Failure = Box<dyn Error>;

/// Mesh that the bounds are judged by, of whole gears and of open sectors, which take much longer.
const FINE: [Rung; 2] = [Rung::ALL[4], Rung::ALL[3]];
/// Teeth of the meshes of tetrahedra.
const SECTOR: u32 = 5;

fn main() -> Result<ExitCode, Failure> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [folder, rest @ ..] = &words[..] else { return Err("FOLDER [FIRST [COUNT]] are wanted".into()) };
    let numbers = rest.iter().map(|word| word.parse()).collect::<Result<Vec<usize>, _>>()?;
    let (first, count) = (numbers.first().unwrap_or(&0), numbers.get(1).unwrap_or(&usize::MAX));
    let pairs: Vec<Value> = serde_json::from_str(include_str!("../../data/foreign_pairs.json"))?;
    println!("| pair | meshes | mean STE, um | its bounds | finer | p-p, um | its bounds | finer | hold |");
    println!("|---|---|---|---|---|---|---|---|---|");
    let (mut held, mut all) = (0, 0);
    for (number, pair) in pairs.iter().enumerate().skip(*first).take(*count) {
        for (kind, rung) in ["hex8", "tet10"].into_iter().zip(FINE) {
            let mut truth = None;
            for size in ["coarse", "fine"] {
                let name = format!("{number}_{kind}_{size}");
                let scene = scene(pair, Path::new(folder), &name)?;
                let (accuracy, mut solved) = accurate(&scene)?;
                if truth.is_none() {
                    set_teeth(&mut solved.scene, if kind == "tet10" { SECTOR } else { 0 });
                    truth = Some(exact(&solved, rung)?);
                }
                let mut line = format!("| {number} | {kind} {size} |");
                let mut inside = true;
                for (quantity, exact) in JUDGED.into_iter().zip(truth.iter().flatten()) {
                    let bound = bound(&accuracy, quantity);
                    inside &= holds(bound, *exact);
                    line += &format!(" {:.3} | +{:.3} -{:.3} | {exact:.3} |", bound.value, bound.above, bound.below);
                }
                let said = accuracy.not_covered.iter().any(|line| line.contains("another body"));
                let word = if inside { "yes" } else { "**no**" };
                println!("{line} {word}{} |", if said { ", not covered: another body" } else { "" });
                held += usize::from(inside || said);
                all += 1;
            }
        }
    }
    println!("\n{held} of {all} hold, or are said not to be covered");
    Ok(if held == all { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// A pair of the table on its meshes.
fn scene(pair: &Value, folder: &Path, name: &str) -> Result<Scene, SceneError> {
    let number = |key: &str| pair[key].as_f64().unwrap_or(f64::NAN);
    let of = |key: &str, i: usize| pair[key][i].as_f64().unwrap_or(f64::NAN);
    let mut builder = Scene::builder()
        .pinion(of("teeth", 0) as u32, number("helix"))
        .wheel(of("teeth", 1) as u32)
        .normal_module_mm(number("module"))
        .face_width_mm(number("width"))
        .torque_nm(number("torque"))
        .set("name", name)
        .set("analysis.model", "reduced")
        .set("analysis.positions_per_cycle", 16)
        .set("accuracy.mean_ste", "1 %")
        .relative_to(folder);
    for (i, gear) in ["pinion", "wheel"].into_iter().enumerate() {
        builder = builder
            .set(&format!("{gear}.bore_diameter_mm"), of("bore", i))
            .set(&format!("{gear}.profile_shift"), of("shift", i))
            .set(&format!("{gear}.thickness_allowance_mm"), THINNING * number("module"))
            .set(&format!("{gear}.mesh"), format!("{name}_{gear}.msh"));
    }
    builder.build()
}

/// Thinning of the teeth over the module, as the meshes have it.
const THINNING: f64 = 0.02;

/// The mesher's number of teeth: 0 for whole gears.
fn set_teeth(scene: &mut Scene, sector_teeth: u32) {
    let mesher = Rung::ALL[0].mesher(scene);
    for gear in [&mut scene.pinion, &mut scene.wheel] {
        gear.mesher = Some(MesherScene { sector_teeth, ..mesher });
    }
}
