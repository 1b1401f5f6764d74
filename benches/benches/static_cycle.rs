//! The phases of a quasi-static run on the coarse meshes that Gmsh wrote; see `benches/README.md`.

use ale::Station;
use divan::{Bencher, black_box};
use fem::ElementOptions;
use mesh::Mesh;
use reduction::ElasticGear;
use testing::{Case, meshes_folder};

fn main() {
    divan::main();
}

fn coarse() -> Case {
    Case::read("coarse_hex8_pinion.msh", "coarse_hex8_wheel.msh", ElementOptions::default())
}

#[divan::bench]
fn read(bencher: Bencher) {
    let path = meshes_folder().join("medium_hex8_pinion.msh");
    bencher.bench(|| Mesh::read(black_box(&path)));
}

#[divan::bench(sample_count = 5)]
fn reduce(bencher: Bencher) {
    let case = coarse();
    let options = case.options();
    bencher.bench(|| {
        let model = case.reduced(options.clone());
        let reduced = |g: &ElasticGear| matches!(g, ElasticGear::Reduced(r) if r.is_cyclic());
        model.gears().iter().all(reduced)
    });
}

#[divan::bench(sample_count = 5)]
fn cycle(bencher: Bencher) {
    let case = coarse();
    bencher.with_inputs(|| case.reduced(case.options())).bench_values(|mut model| model.run(8, 1, |_, _, _| ()));
}

#[divan::bench(sample_count = 1)]
fn full_position(bencher: Bencher) {
    let case = coarse();
    let station = Station { cycle: 0, phase: 0.0 };
    bencher.with_inputs(|| case.full(case.options())).bench_values(|mut model| model.solve(station));
}
