//! Full against reduced over mesh size and number of teeth, with fitted exponents; see `benches/README.md`.
#![allow(clippy::print_stdout, reason = "the table is what the bench is for")]

use std::time::Instant;

use ale::Station;
use geometry::GearData;
use mesh::Extent;
use study::power_law;
use testing::{Case, default_data, quadratic};

/// Positions of one mesh cycle.
const POSITIONS: usize = 8;

/// Wall times (s) of one pair.
struct Row {
    teeth: u32,
    dof: f64,
    /// One position with all degrees of freedom kept.
    full: f64,
    /// Everything before the first position.
    reduce: f64,
    /// One position on reduced gears.
    position: f64,
}

/// A pair of equal gears with so many quadratic elements along the profile.
fn case(teeth: u32, profile: u32) -> Case {
    let data = default_data(20.0).map(|d| {
        let reference = f64::from(teeth) * d.normal_module / d.helix_angle.cos();
        GearData { teeth, bore_diameter: 0.55 * reference, ..d }
    });
    quadratic(
        data,
        None,
        150e3 * f64::from(teeth) / 30.0,
        [profile, 2, 2 * profile.div_ceil(3), profile, 2],
        Extent::Whole,
    )
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = work();
    (result, start.elapsed().as_secs_f64())
}

fn measure(teeth: u32, profile: u32) -> Row {
    let case = case(teeth, profile);
    let (mut reduced, reduce) = timed(|| case.reduced(case.slice_options()));
    let (history, cycle) = timed(|| reduced.run(POSITIONS, 1, |_, _, _| ()).unwrap());
    let mut whole = case.full(case.slice_options());
    let station = Station { cycle: 0, phase: 0.0 };
    let (position, full) = timed(|| whole.solve(station).unwrap());
    // The same answer, or the comparison is none.
    let (a, b) = (position.transmission_error, history.positions[0].transmission_error);
    assert!((a / b - 1.0).abs() < 1e-8, "{teeth} teeth: full {a} mm, reduced {b} mm");
    let nodes = case.meshes.iter().map(|m| m.mesh().nodes.len() - m.bore_nodes().len());
    Row { teeth, dof: 3.0 * nodes.sum::<usize>() as f64, full, reduce, position: cycle / POSITIONS as f64 }
}

fn table(title: &str, rows: &[Row], x_name: &str, x: fn(&Row) -> f64) {
    println!("\n{title}\n");
    println!(
        "| teeth | DOF | full, s a position | reduction, s | reduced, ms a position | times faster, 32 positions with reduction | a further position |"
    );
    println!("|---|---|---|---|---|---|---|");
    for r in rows {
        let cycle = 32.0 * r.full / (r.reduce + 32.0 * r.position);
        println!(
            "| {} | {} | {:.3} | {:.3} | {:.2} | {cycle:.0} | {:.0} |",
            r.teeth,
            r.dof,
            r.full,
            r.reduce,
            1e3 * r.position,
            r.full / r.position
        );
    }
    type Column = (&'static str, fn(&Row) -> f64);
    let columns: [Column; 3] =
        [("full", |r| r.full), ("reduction", |r| r.reduce), ("reduced position", |r| r.position)];
    for (name, y) in columns {
        let points: Vec<(f64, f64)> = rows.iter().map(|r| (x(r), y(r))).collect();
        let law = power_law(&points).unwrap();
        println!("{name} ~ {x_name}^{:.2} (within {:.0} %)", law.exponent, 100.0 * law.largest_residual);
    }
}

fn main() {
    let by_mesh: Vec<Row> = [2, 3, 4].into_iter().map(|profile| measure(30, profile)).collect();
    table("30 teeth, 2 to 4 quadratic elements along the profile", &by_mesh, "DOF", |r| r.dof);
    let by_teeth: Vec<Row> = [20, 30, 45, 60].into_iter().map(|teeth| measure(teeth, 2)).collect();
    table("2 quadratic elements along the profile, 20 to 60 teeth", &by_teeth, "teeth", |r| f64::from(r.teeth));
}
