//! One pair by three models: closed form, eight coordinates in time, reduced finite elements.
//!
//! `cargo run --release -p analysis --example cheaper_models`
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;

use analysis::{StaticAnalysis, lumped::LumpedAnalysis};
use scene::{Scene, SceneBuilder};

fn pair() -> SceneBuilder {
    Scene::builder().pinion(24, 18.0).wheel(31).normal_module_mm(3.0).face_width_mm(20.0).torque_nm(120.0)
}

fn main() -> Result<(), Box<dyn Error>> {
    for model in ["iso", "reduced"] {
        let scene = pair().set("analysis.model", model).set("analysis.positions_per_cycle", 16).build()?;
        let positions = StaticAnalysis::new(&scene).solve()?.history.positions;
        let mean_ste = positions.iter().map(|p| p.transmission_error).sum::<f64>() / positions.len() as f64;
        println!("{model:<8} mean STE {:.3} um", 1e3 * mean_ste);
    }
    let mut lumped8 = pair().set("analysis.model", "lumped8").set("mesh.stiffness_from", "iso");
    for gear in ["pinion", "wheel"] {
        for axis in ["x", "y", "z"] {
            lumped8 = lumped8.set(&format!("{gear}.bearing.stiffness_{axis}_n_per_mm"), 1e6);
        }
    }
    let scene = lumped8.set("motion.mesh_damping_ratio", 0.05).build()?;
    let result = LumpedAnalysis::new(&scene).solve()?;
    analysis::certificate::verdict(result.certificate(), &scene)?;
    println!("lumped8  peak-to-peak DTE {:.3} um", result.headline.peak_to_peak_dte_um);
    Ok(())
}
