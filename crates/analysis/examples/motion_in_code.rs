//! A pair written down in code, followed in time until its motion repeats itself; arrays in hand, nothing on the disk.
//!
//! `cargo run --release -p analysis --example motion_in_code`
#![allow(clippy::print_stdout, reason = "an example prints")]

use analysis::motion::MotionAnalysis;
use scene::Scene;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = Scene::builder()
        .pinion(24, 15.0)
        .wheel(31)
        .normal_module_mm(3.0)
        .face_width_mm(20.0)
        .torque_nm(300.0)
        .set("operation.speed_rpm", 3000.0)
        .set("pinion.mesher.order", 1)
        .set("pinion.mesher.sector_teeth", 1)
        .set("wheel.mesher.order", 1)
        .set("wheel.mesher.sector_teeth", 1)
        .set("analysis.kind", "dynamic")
        .set("analysis.positions_per_cycle", 8)
        .set("motion.run", "steady")
        .set("motion.steps_per_mesh_cycle", 32)
        .set("motion.mesh_damping_ratio", 0.06)
        .build()?;
    let result = MotionAnalysis::new(&scene).solve()?;
    let dte_um = result.rows.series(0..result.rows.len(), |row| row.dte_um)?;
    let h = &result.headline;
    println!(
        "{} rows, {:.3} um peak to peak, at rest {:.3} um",
        dte_um.len(),
        h.peak_to_peak_dte_um,
        h.peak_to_peak_ste_um
    );
    assert!(result.facts.certificate.missed().next().is_none());
    Ok(())
}
