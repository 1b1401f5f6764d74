//! The factor of a gear's stiffness beside PARDISO's of the same matrix, in the same run, both on one core; see
//! `benches/README.md`.
#![allow(clippy::print_stdout, reason = "the table is what the bench is for")]

use std::{
    env,
    error::Error,
    fs::File,
    io::{BufWriter, Write},
    path::Path,
    process::Command,
    time::Instant,
};

use faer::MatMut;
use fem::{BoundaryLastFactor, DofMap, ElementOptions, Material, Ordering, SymmetricMatrix};
use geometry::{Gear, GearData};
use mesh::{Extent, GroupNames, MeshedGear, StructuredOptions};

/// Elements along the profile, along the fillet, across the tooth, along the face and below the teeth, quadratic.
const SIZES: [[u32; 5]; 3] = [[2, 2, 2, 3, 1], [4, 2, 3, 5, 2], [6, 3, 4, 10, 4]];
const TEETH: u32 = 30;
/// The fastest of so many runs counts.
const RUNS: usize = 3;
/// Largest difference of the two answers to one load, over the largest displacement.
const SAME: f64 = 1e-8;

fn main() -> Result<(), Box<dyn Error>> {
    let program = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/pardiso.py");
    let python = env::var("PYTHON").unwrap_or_else(|_| "python3".into());
    println!("Whole gear, z {TEETH}, hex20, nothing kept apart; one core; wall s, fastest of {RUNS} runs.");
    println!(
        "\n| DOF | entries | order | factor | PARDISO: order | factor | ratio of factors | ratio of both together |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    // One core for both: what is compared is the arithmetic and the order.
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    for counts in SIZES {
        let stiffness = stiffness(counts)?;
        let load: Vec<f64> = (0..stiffness.n()).map(|row| (0.37 * row as f64).sin()).collect();
        let ours = one.install(|| factored(&stiffness, &load)).map_err(|e| e.to_string())?;
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("matrix.bin");
        write(&path, &stiffness, &load)?;
        let output = Command::new(&python).arg(&program).arg(&path).arg(RUNS.to_string()).output()?;
        let text = String::from_utf8_lossy(&output.stdout);
        let numbers: Vec<f64> = text.split_whitespace().filter_map(|word| word.parse().ok()).collect();
        let [order, factor, ref theirs @ ..] = numbers[..] else {
            return Err(format!("no PARDISO: {}", String::from_utf8_lossy(&output.stderr)).into());
        };
        let largest = ours.answer.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let apart = ours.answer.iter().zip(theirs).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / largest;
        if theirs.len() != ours.answer.len() || apart.is_nan() || apart > SAME {
            return Err(format!("the two answers are {apart:.1e} apart").into());
        }
        println!(
            "| {} | {} | {:.3} | {:.3} | {order:.3} | {factor:.3} | {:.2} | {:.2} |",
            stiffness.n(),
            stiffness.stored(),
            ours.order,
            ours.factor,
            ours.factor / factor,
            (ours.order + ours.factor) / (order + factor),
        );
    }
    Ok(())
}

/// Times of ordering and of the factor (s), and the answer to one load.
struct Factored {
    order: f64,
    factor: f64,
    answer: Vec<f64>,
}

fn factored(stiffness: &SymmetricMatrix, load: &[f64]) -> Result<Factored, Box<dyn Error + Send + Sync>> {
    let mut best = Factored { order: f64::INFINITY, factor: f64::INFINITY, answer: Vec::new() };
    for _ in 0..RUNS {
        let start = Instant::now();
        drop(Ordering::new(stiffness, &[])?);
        let order = start.elapsed().as_secs_f64();
        let start = Instant::now();
        let factor = BoundaryLastFactor::new(stiffness, &[])?;
        let both = start.elapsed().as_secs_f64();
        best.order = best.order.min(order);
        best.factor = best.factor.min(both - order);
        best.answer = load.to_vec();
        factor.solve(MatMut::from_column_major_slice_mut(&mut best.answer, load.len(), 1))?;
    }
    Ok(best)
}

fn stiffness(counts: [u32; 5]) -> Result<SymmetricMatrix, Box<dyn Error>> {
    let data = GearData { teeth: TEETH, ..GearData::default() };
    let bore = 0.55 * data.normal_module * f64::from(TEETH) / data.helix_angle.cos();
    let gear = Gear::new(GearData { bore_diameter: bore, ..data })?;
    let [elements_profile, elements_fillet, elements_thickness, elements_face, elements_rim] = counts;
    let options = StructuredOptions {
        order: 2,
        elements_profile,
        elements_fillet,
        elements_thickness,
        elements_face,
        elements_rim,
        extent: Extent::Whole,
    };
    let gear = MeshedGear::from_groups(mesh::generate(&gear, &options)?, &GroupNames::default(), TEETH)?;
    let dofs = DofMap::new(gear.mesh().nodes.len(), gear.bore_nodes());
    Ok(fem::assemble_stiffness(gear.mesh(), &Material::STEEL, &dofs, &ElementOptions::default())?)
}

/// Order and number of entries, starts of the columns, rows and values of the lower triangle, and the load: eight bytes
/// each, little-endian.
fn write(path: &Path, stiffness: &SymmetricMatrix, load: &[f64]) -> Result<(), Box<dyn Error>> {
    let lower = stiffness.lower();
    let mut out = BufWriter::new(File::create(path)?);
    let counts = [stiffness.n(), stiffness.stored()];
    for &number in counts.iter().chain(lower.symbolic().col_ptr()).chain(lower.symbolic().row_idx()) {
        out.write_all(&(number as u64).to_le_bytes())?;
    }
    for value in lower.val().iter().chain(load) {
        out.write_all(&value.to_le_bytes())?;
    }
    Ok(out.flush()?)
}
