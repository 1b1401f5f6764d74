//! Transmission error over mesh density: slices, pressed points with exact contact, pressed points with a penalty; see
//! `benches/README.md`.
//!
//! `cargo bench -p benches --bench mesh_independence` takes the three coarser meshes for all methods and the finest for
//! slices; `-- --quick` leaves the finest out, `-- --points` the slices.
#![allow(clippy::print_stdout, reason = "a bench prints")]

use std::time::Instant;

use contact::{complementarity::Law, flank::flank_grids};
use ltca::{StaticModel, StaticOptions};
use mesh::Extent;
use reduction::{ElasticGear, GearReducer, ReductionOptions};
use testing::{Case, default_data, mean_and_peak_to_peak, quadratic};

/// Positions of a mesh cycle for slices, and for points, which take long.
const POSITIONS: [usize; 2] = [64, 16];
/// Elements along the active profile and across the face.
const MESHES: [[u32; 2]; 4] = [[2, 6], [4, 12], [8, 24], [16, 48]];
/// Above as many nodes a flank, slices are reduced to grids of this many quadratic faces.
const GRID: [usize; 2] = [8, 24];

/// Fillet, tooth thickness and rim in four elements or more: they bend.
fn case([profile, face]: [u32; 2]) -> Case {
    let half = (profile / 2).max(4);
    let counts = [profile, half, half, face, 4];
    quadratic(default_data(20.0), None, 150e3, counts, Extent::Periodic)
}

fn gears(case: &Case, options: &StaticOptions, on_grid: bool) -> [ElasticGear; 2] {
    let first = StaticModel::first_teeth(&case.pair, options).unwrap();
    [0, 1].map(|i| {
        let o = ReductionOptions {
            sides: options.contact.sides(),
            window: options.window_teeth(&case.pair),
            first: first[i],
            elements: case.elements,
        };
        let geometry = [&case.pair.pinion, &case.pair.wheel][i];
        let (sides, count, z) = (o.sides.clone(), o.window as u32, geometry.teeth());
        let teeth: Vec<u32> = (0..count).map(|k| (o.first + k) % z).collect();
        let mesh = case.meshes[i].clone();
        let reducer = if on_grid {
            GearReducer::on_grids(mesh, fem::Material::STEEL, o, false, |mesh| {
                flank_grids(mesh, geometry, &teeth, &sides, GRID, options.contact.surface_tolerance)
            })
            .unwrap_or_else(|e: contact::ContactError| panic!("{e}"))
        } else {
            GearReducer::new(mesh, fem::Material::STEEL, o).unwrap_or_else(|e| panic!("{e}"))
        };
        ElasticGear::Reduced(reducer)
    })
}

/// Mean and peak to peak of STE, um; seconds of reduction and run.
fn run(
    mesh: [u32; 2],
    positions: usize,
    options: impl Fn(&Case) -> StaticOptions,
    on_grid: bool,
) -> ([f64; 2], [f64; 2]) {
    let case = case(mesh);
    let options = options(&case);
    let started = Instant::now();
    let gears = gears(&case, &options, on_grid);
    let reduced = started.elapsed().as_secs_f64();
    let started = Instant::now();
    let mut model = StaticModel::new(case.pair.clone(), gears, options).unwrap_or_else(|e| panic!("{e}"));
    let history = model.run(positions, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{e}"));
    let (mean, swing) = mean_and_peak_to_peak(history.positions.iter().map(|p| 1e3 * p.transmission_error));
    ([mean, swing], [reduced, started.elapsed().as_secs_f64()])
}

/// Observed order of the last three of values on meshes halved each time.
fn order(values: &[f64]) -> String {
    let n = values.len();
    let [a, b, c] = [values[n - 3], values[n - 2], values[n - 1]];
    let ratio = (a - b) / (b - c);
    if ratio > 0.0 { format!("{:.1}", ratio.log2()) } else { "none".into() }
}

fn table(name: &str, meshes: &[[u32; 2]], positions: usize, options: impl Fn(&Case) -> StaticOptions) {
    println!(
        "\n{name}\n| elements | mean STE, um | peak to peak, um | reduction, s | {positions} positions, s |\n|---|---|---|---|---|"
    );
    let mut all: Vec<[f64; 2]> = Vec::new();
    for mesh in meshes {
        let (ste, time) = run(*mesh, positions, &options, mesh[0] >= 16);
        println!("| {} x {} | {:.4} | {:.4} | {:.2} | {:.2} |", mesh[0], mesh[1], ste[0], ste[1], time[0], time[1]);
        all.push(ste);
    }
    let finest = all[all.len() - 1];
    for (what, i) in [("mean", 0), ("peak to peak", 1)] {
        let off: Vec<String> = all.iter().map(|v| format!("{:+.2}", 100.0 * (v[i] / finest[i] - 1.0))).collect();
        let column: Vec<f64> = all.iter().map(|v| v[i]).collect();
        println!("{what}: {} % of the finest, order {}", off.join(", "), order(&column));
    }
}

fn main() {
    let quick = std::env::args().any(|a| a == "--quick");
    let points_only = std::env::args().any(|a| a == "--points");
    if !points_only {
        table("slices", if quick { &MESHES[..3] } else { &MESHES }, POSITIONS[0], Case::slice_options);
    }
    table("points, exact contact", &MESHES[..3], POSITIONS[1], Case::options);
    table("points, penalty 1e6 MPa/mm", &MESHES[..3], POSITIONS[1], |case| {
        case.options().with_contact(|c| c.law = Law::Penalty(1e6))
    });
}
