//! Time and peak memory of every phase before the first position, both ways; see `benches/README.md`.
#![allow(clippy::print_stdout, reason = "the table is what the bench is for")]

use std::{env, fs, process::Command, time::Instant};

use fem::{BoundaryLastFactor, DofMap, ElementOptions, Material, Ordering};
use geometry::{Gear, GearData, Side};
use mesh::{Extent, GroupNames, Mesh, MeshedGear, MshFormat, StructuredOptions};
use reduction::{GearReducer, ReductionOptions};

/// First two lines of a table of phases.
const HEAD: &str = "| way | elements | DOF | phase | s | peak MB |\n|---|---|---|---|---|---|";
/// Elements along the profile, along the fillet, across the tooth, along the face and below the teeth, quadratic.
const SIZES: [[u32; 5]; 4] = [[2, 2, 2, 3, 1], [4, 2, 3, 5, 2], [4, 3, 4, 8, 3], [6, 3, 4, 10, 4]];
/// Each step of the search for the largest gear has this many times the elements of the step before.
const GROWTH: f64 = 1.5;
const TEETH: u32 = 30;

/// Way of a reduction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    /// One factor of the whole gear.
    General,
    /// One periodic sector.
    Sector,
}

/// `offline`: the table; `offline --largest`: grows the mesh until memory ends; the rest is for the program's own
/// children.
fn main() {
    let arguments: Vec<String> = env::args().collect();
    if let Some(at) = arguments.iter().position(|a| a == "--child") {
        let counts: Vec<u32> = arguments[at + 2..].iter().filter_map(|a| a.parse().ok()).collect();
        child(if arguments[at + 1] == "General" { Way::General } else { Way::Sector }, &counts);
        return;
    }
    println!("One gear, z {TEETH}, hex20, one flank each of 3 teeth; every row a process of its own.");
    println!("\n{HEAD}");
    for way in [Way::Sector, Way::General] {
        for counts in SIZES {
            print!(
                "{}",
                measured(way, counts).unwrap_or_else(|e| format!("| {way:?} | {counts:?} | failed: {e} | | | |\n"))
            );
        }
    }
    if arguments.iter().any(|a| a == "--largest") {
        [Way::Sector, Way::General].into_iter().for_each(largest);
    }
}

/// Rows of the largest gear that goes through.
fn largest(way: Way) {
    let (mut scale, mut last) = (2.0f64, None);
    loop {
        let edge = scale.cbrt();
        let counts = SIZES[3].map(|n| (f64::from(n) * edge).round() as u32);
        match measured(way, counts) {
            Ok(rows) => last = Some(rows),
            Err(why) => {
                println!("\nLargest gear, {way:?}: the next, {counts:?}, ends with `{why}`.\n\n{HEAD}");
                print!("{}", last.unwrap_or_default());
                return;
            }
        }
        scale *= GROWTH;
    }
}

/// The rows that a child prints, or how it ended.
fn measured(way: Way, counts: [u32; 5]) -> Result<String, String> {
    let program = env::current_exe().map_err(|e| e.to_string())?;
    let numbers = counts.map(|n| n.to_string());
    let output = Command::new(program).arg("--child").arg(format!("{way:?}")).args(numbers).output();
    let output = output.map_err(|e| e.to_string())?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let failed = text.lines().find_map(|l| l.strip_prefix("failed: ")).map(str::to_owned);
    match failed {
        None if output.status.success() => Ok(text),
        None => Err(output.status.to_string()),
        Some(why) => Err(why),
    }
}

fn child(way: Way, counts: &[u32]) {
    let rows = match way {
        Way::General => general(counts),
        Way::Sector => sector(counts),
    };
    match rows {
        Ok((dofs, rows)) => rows.iter().for_each(|(phase, s, mb)| {
            println!("| {way:?} | {counts:?} | {dofs} | {phase} | {s:.3} | {mb:.0} |");
        }),
        Err(e) => println!("failed: {e}"),
    }
}

type Rows = Vec<(&'static str, f64, f64)>;
type Measured = Result<(usize, Rows), Box<dyn std::error::Error>>;

/// Runs a phase; its time (s) and the largest resident set in it (MB).
fn phase<T>(rows: &mut Rows, name: &'static str, work: impl FnOnce() -> T) -> T {
    // Linux forgets the peak so far when asked to.
    let _ = fs::write("/proc/self/clear_refs", "5");
    let start = Instant::now();
    let result = work();
    rows.push((name, start.elapsed().as_secs_f64(), peak_mb()));
    result
}

fn peak_mb() -> f64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:")).unwrap_or_default();
    line.trim().trim_end_matches(" kB").parse::<f64>().map_or(f64::NAN, |kib| kib * 1024.0 / 1e6)
}

/// A mesh written and read again: reading is a phase.
fn read(rows: &mut Rows, counts: &[u32], extent: Extent) -> Result<MeshedGear, Box<dyn std::error::Error>> {
    let data = GearData { teeth: TEETH, ..GearData::default() };
    let bore = 0.55 * data.normal_module * f64::from(TEETH) / data.helix_angle.cos();
    let gear = Gear::new(GearData { bore_diameter: bore, ..data })?;
    let &[elements_profile, elements_fillet, elements_thickness, elements_face, elements_rim] = counts else {
        return Err("five counts of elements".into());
    };
    let options = StructuredOptions {
        order: 2,
        elements_profile,
        elements_fillet,
        elements_thickness,
        elements_face,
        elements_rim,
        extent,
    };
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("gear.msh");
    mesh::generate(&gear, &options)?.write(&path, MshFormat::Binary41)?;
    let mesh = phase(rows, "read", || Mesh::read(&path))?;
    Ok(MeshedGear::from_groups(mesh, &GroupNames::default(), TEETH)?)
}

fn general(counts: &[u32]) -> Measured {
    let mut rows = Rows::new();
    let gear = read(&mut rows, counts, Extent::Whole)?;
    let dofs = DofMap::new(gear.mesh().nodes.len(), gear.bore_nodes());
    let elements = ElementOptions::default();
    let stiffness =
        phase(&mut rows, "assemble", || fem::assemble_stiffness(gear.mesh(), &Material::STEEL, &dofs, &elements))?;
    let mut last: Vec<u32> =
        (0..3).filter_map(|tooth| gear.flank(tooth, Side::Left)).flatten().flat_map(|f| f.nodes()).copied().collect();
    last.sort_unstable();
    last.dedup();
    let boundary: Vec<usize> = last.iter().filter_map(|&n| dofs.position(n)).flat_map(|p| 3 * p..3 * p + 3).collect();
    let order = phase(&mut rows, "order", || Ordering::new(&stiffness, &boundary))?;
    drop(order);
    let factor = phase(&mut rows, "order and factor", || BoundaryLastFactor::new(&stiffness, &boundary))?;
    let compliance = phase(&mut rows, "condense", || factor.compliance());
    assert_eq!(compliance.nrows(), boundary.len());
    Ok((dofs.free_count(), rows))
}

fn sector(counts: &[u32]) -> Measured {
    let mut rows = Rows::new();
    let gear = read(&mut rows, counts, Extent::Periodic)?;
    let options =
        ReductionOptions { sides: vec![Side::Left], window: 3, first: 0, elements: ElementOptions::default() };
    let reducer = phase(&mut rows, "assemble, order, factor, condense, join", || {
        GearReducer::new(gear, Material::STEEL, options)
    })?;
    Ok((reducer.free_count(), rows))
}
