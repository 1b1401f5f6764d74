//! A scene built in code, solved; arrays in hand, nothing on the disk.
//!
//! `cargo run --release -p analysis --example scene_in_code`
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;

use analysis::StaticAnalysis;
use scene::Scene;

fn main() -> Result<(), Box<dyn Error>> {
    let scene = Scene::builder()
        .pinion(24, 18.0)
        .wheel(31)
        .normal_module_mm(3.0)
        .face_width_mm(20.0)
        .torque_nm(120.0)
        .set("pinion.modification.drive.tip_relief_um", 15.0)
        .set("pinion.modification.drive.tip_relief_start_roll_deg", 24.0)
        .set("analysis.positions_per_cycle", 16)
        .build()?;
    let result = StaticAnalysis::new(&scene).solve()?;
    let ste_um: Vec<f64> = result.history.positions.iter().map(|p| 1e3 * p.transmission_error).collect();
    let length_mm: Vec<f64> = result.history.positions.iter().map(|p| p.contact_line_length).collect();
    println!("eps_gamma {:.3}", result.pair.total_contact_ratio());
    println!("{:>10} {:>22}", "STE [um]", "contact lines [mm]");
    ste_um.iter().zip(&length_mm).for_each(|(te, length)| println!("{te:>10.4} {length:>22.3}"));
    Ok(())
}
