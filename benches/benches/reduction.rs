//! One sector against the whole gear, over teeth and mesh size; see `benches/README.md`.
#![allow(clippy::print_stdout, reason = "the table is what the bench is for")]

use std::time::Instant;

use fem::{ElementOptions, Material};
use geometry::{Gear, GearData, Side};
use mesh::{Extent, GroupNames, MeshedGear, StructuredOptions};
use reduction::{GearReducer, ReductionError, ReductionOptions, ReductionWay};

/// Runs of which the fastest counts.
const REPEATS: usize = 3;
/// The general way is not timed beyond this many degrees of freedom: its time is known from the smaller ones.
const LARGEST_GENERAL: usize = 400_000;

fn main() {
    println!("Reduction of one gear to one flank each of 3 teeth, hex20; wall s, fastest of {REPEATS} runs.");
    println!(
        "`sector`: periodic sector; `found`: whole mesh, recognised as cyclic; `general`: one factor of the whole gear."
    );
    let density = [4, 2, 3, 5, 3];
    let over_teeth: Vec<Row> = [15, 30, 60, 120].map(|z| row(&format!("z {z}"), z, density)).into();
    print(&over_teeth);
    slopes("teeth", over_teeth.iter().map(|r| (f64::from(r.teeth), r)));
    if let (Some(few), Some(many)) = (over_teeth.get(1), over_teeth.last()) {
        println!("z 120 / z 30 by sector: {:.2}", many.sector / few.sector);
    }
    let sizes: [[u32; 5]; 4] = [[2, 2, 2, 3, 1], [4, 2, 3, 5, 2], [6, 3, 4, 6, 3], [8, 4, 6, 8, 4]];
    let over_size: Vec<Row> = sizes.map(|n| row(&format!("z 30, {n:?}"), 30, n)).into();
    print(&over_size);
    slopes("degrees of freedom", over_size.iter().map(|r| (r.dofs as f64, r)));
}

/// One gear, all ways; s.
struct Row {
    name: String,
    teeth: u32,
    dofs: usize,
    sector: f64,
    found: f64,
    general: Option<f64>,
}

fn row(name: &str, teeth: u32, counts: [u32; 5]) -> Row {
    let data = GearData { teeth, profile_shift: if teeth < 17 { 0.3 } else { 0.0 }, ..GearData::default() };
    let bore = 0.55 * data.normal_module * f64::from(teeth) / data.helix_angle.cos();
    let gear = Gear::new(GearData { bore_diameter: bore, ..data }).expect("a gear of the default rack");
    let [sector, whole] = [Extent::Periodic, Extent::Whole].map(|extent| meshed(&gear, counts, extent));
    let dofs = GearReducer::new(sector.clone(), Material::STEEL, options()).expect("a sound sector").free_count();
    let (sector, way) = fastest(&sector, GearReducer::new);
    assert_eq!(way, ReductionWay::CyclicSector);
    let (found, way) = fastest(&whole, GearReducer::new);
    assert_eq!(way, ReductionWay::CyclicSector);
    let general = (dofs <= LARGEST_GENERAL).then(|| fastest(&whole, GearReducer::general).0);
    Row { name: name.to_owned(), teeth, dofs, sector, found, general }
}

fn meshed(gear: &Gear, [profile, fillet, thickness, face, rim]: [u32; 5], extent: Extent) -> MeshedGear {
    let options = StructuredOptions {
        order: 2,
        elements_profile: profile,
        elements_fillet: fillet,
        elements_thickness: thickness,
        elements_face: face,
        elements_rim: rim,
        extent,
    };
    let mesh = mesh::generate(gear, &options).expect("a mesh of a sound gear");
    MeshedGear::from_groups(mesh, &GroupNames::default(), gear.teeth()).expect("the mesher names all parts")
}

fn options() -> ReductionOptions {
    ReductionOptions { sides: vec![Side::Left], window: 3, first: 0, elements: ElementOptions::default() }
}

type Way = fn(MeshedGear, Material, ReductionOptions) -> Result<GearReducer, ReductionError>;

fn fastest(mesh: &MeshedGear, reduce: Way) -> (f64, ReductionWay) {
    let runs = (0..REPEATS).map(|_| {
        let mesh = mesh.clone();
        let start = Instant::now();
        let reducer = reduce(mesh, Material::STEEL, options()).expect("a sound gear");
        (start.elapsed().as_secs_f64(), reducer.way())
    });
    runs.reduce(|a, b| if b.0 < a.0 { b } else { a }).expect("at least one run")
}

fn print(rows: &[Row]) {
    println!(
        "\n{:<24} {:>9} {:>9} {:>9} {:>9} {:>16}",
        "gear", "DOF", "sector", "found", "general", "general / sector"
    );
    for r in rows {
        let general = r.general.map_or_else(|| "-".into(), |g| format!("{g:.3}"));
        let ratio = r.general.map_or_else(|| "-".into(), |g| format!("{:.1}", g / r.sector));
        println!("{:<24} {:>9} {:>9.3} {:>9.3} {general:>9} {ratio:>16}", r.name, r.dofs, r.sector, r.found);
    }
}

/// Exponents p of time ~ x^p, least squares of the logarithms.
fn slopes<'a>(x: &str, rows: impl Iterator<Item = (f64, &'a Row)> + Clone) {
    type Time = (&'static str, fn(&Row) -> Option<f64>);
    let times: [Time; 3] = [("sector", |r| Some(r.sector)), ("found", |r| Some(r.found)), ("general", |r| r.general)];
    for (name, time) in times {
        let points: Vec<(f64, f64)> = rows.clone().filter_map(|(x, r)| Some((x.ln(), time(r)?.ln()))).collect();
        let n = points.len() as f64;
        let mean = |f: fn(&(f64, f64)) -> f64| points.iter().map(f).sum::<f64>() / n;
        let (mx, my) = (mean(|p| p.0), mean(|p| p.1));
        let covariance: f64 = points.iter().map(|p| (p.0 - mx) * (p.1 - my)).sum();
        let variance: f64 = points.iter().map(|p| (p.0 - mx).powi(2)).sum();
        println!("{name}: time ~ {x}^{:.2}", covariance / variance);
    }
}
