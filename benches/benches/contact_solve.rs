//! One contact solve of the default pair, against one pass over its data; see `benches/README.md`.
#![allow(clippy::print_stdout, reason = "the table is what the bench is for")]

use std::time::{Duration, Instant};

use ale::Station;
use contact::{Bulk, Pose, slice::MeshContact};
use divan::{Bencher, black_box};
use ltca::{StaticModel, StaticOptions};
use testing::{default_data, quadratic};

/// Positions of the mesh cycle whose contact is solved in turn.
const POSITIONS: usize = 32;
/// Rounds over the cycle that medians are taken of.
const ROUNDS: usize = 40;
/// Doubles of each of the triad's three arrays when they are to lie in memory: 128 MiB.
const LARGE: usize = 1 << 24;

fn main() {
    table();
    divan::main();
}

/// The default pair on quadratic elements, four along the profile and eight along the face, 32 slices a pair of teeth.
fn model(options: impl Fn(StaticOptions) -> StaticOptions) -> StaticModel {
    let case = quadratic(default_data(20.0), None, 150e3, [4, 3, 4, 8, 2], mesh::Extent::Sector(5));
    case.reduced(options(case.slice_options()))
}

/// The window's contact, and the poses of a mesh cycle that it serves.
fn contact(model: &mut StaticModel) -> (MeshContact, Vec<[Pose; 2]>) {
    let station = |i: usize| Station { cycle: 0, phase: i as f64 / POSITIONS as f64 };
    let poses = (0..POSITIONS)
        .map(|i| {
            model.solve(station(i)).unwrap();
            model.last().unwrap().poses
        })
        .collect();
    (MeshContact::new(model.pair(), model.contact_set().clone(), &model.options().contact).unwrap(), poses)
}

fn median(mut times: Vec<Duration>) -> f64 {
    times.sort_unstable();
    1e6 * times[times.len() / 2].as_secs_f64()
}

/// Bytes a second of a[i] = b[i] + s c[i] over arrays of `doubles`, the median of many passes.
fn triad(doubles: usize) -> f64 {
    let (b, c) = (vec![1.0; doubles], vec![2.0; doubles]);
    let mut a = vec![0.0; doubles];
    let repeats = (LARGE / doubles).clamp(5, 2000);
    let times = (0..repeats)
        .map(|i| {
            let start = Instant::now();
            let s = black_box(i as f64);
            a.iter_mut().zip(b.iter().zip(&c)).for_each(|(a, (b, c))| *a = b + s * c);
            black_box(&mut a);
            start.elapsed()
        })
        .collect();
    24.0 * doubles as f64 / (1e-6 * median(times))
}

/// Time, data, bandwidth and operations side by side, measured in one run.
fn table() {
    let mut model = model(|o| o);
    let (mut mesh, poses) = contact(&mut model);
    let (mut times, mut bytes, mut flops, mut steps, mut rows) = (Vec::new(), 0.0, 0.0, 0, 0);
    for _ in 0..ROUNDS {
        for pose in &poses {
            let start = Instant::now();
            black_box(mesh.evaluate(black_box(pose)).unwrap());
            times.push(start.elapsed());
            let work = mesh.work();
            (bytes, flops) = (bytes + work.bytes, flops + work.flops);
            steps += mesh.solver().iterations();
            rows += mesh.rows().len();
        }
    }
    let count = times.len() as f64;
    let (bytes, flops) = (bytes / count, flops / count);
    let time = median(times);
    println!("one contact solve, tangent included: median {time:.0} us");
    println!(
        "   {:.0} rows, {:.1} Newton steps, {:.0} kB of data, {:.2} Mflop ({:.1} Gflop/s)",
        rows as f64 / count,
        steps as f64 / count,
        1e-3 * bytes,
        1e-6 * flops,
        1e-3 * flops / time
    );
    for (name, doubles) in [("arrays of the same size", (bytes / 24.0) as usize), ("arrays in memory", LARGE)] {
        let bandwidth = triad(doubles);
        let pass = 1e6 * bytes / bandwidth;
        println!("   triad over {name}: {:.1} GB/s, one pass {pass:.0} us, ratio {:.1}", 1e-9 * bandwidth, time / pass);
    }
}

/// One contact solve after the other at neighbouring poses.
fn solves(bencher: Bencher, options: impl Fn(StaticOptions) -> StaticOptions) {
    let mut model = model(options);
    let (mut mesh, poses) = contact(&mut model);
    let mut i = 0;
    bencher.bench_local(|| {
        i = (i + 1) % poses.len();
        mesh.evaluate(&poses[i]).map(|f| f.tangent[11][11])
    });
}

#[divan::bench]
fn contact_solve(bencher: Bencher) {
    solves(bencher, |o| o);
}

/// Contact solve from the mesh's matrices, without tables.
#[divan::bench]
fn contact_solve_exact(bencher: Bencher) {
    solves(bencher, |o| o.clone().with_contact(|c| c.bulk = Bulk::Exact));
}

#[divan::bench]
fn mesh_cycle_32(bencher: Bencher) {
    let mut model = model(|o| o);
    bencher.bench_local(|| model.run(POSITIONS, 1, |_, _, _| ()).map(|h| h.positions.len()));
}
