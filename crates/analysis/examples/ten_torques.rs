//! Ten torques on one reduction, side by side on all cores.
//!
//! `cargo run --release -p analysis --example ten_torques`
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::{error::Error, sync::Arc};

use analysis::StaticAnalysis;
use ltca::{StaticError, StaticModel, StaticOptions};
use rayon::prelude::*;
use scene::Scene;

fn main() -> Result<(), Box<dyn Error>> {
    let base = Scene::builder().pinion(24, 18.0).wheel(31).normal_module_mm(3.0).face_width_mm(20.0);
    let scene = base.torque_nm(200.0).set("analysis.positions_per_cycle", 8).build()?;
    let reduced = StaticAnalysis::new(&scene).solve()?.model.ok_or("the model reduces no gears")?;
    let (pair, options) = (reduced.pair().clone(), reduced.options().clone());
    let gears = reduced.into_gears();
    let mean_ste_um = |torque_nm: f64| -> Result<f64, StaticError> {
        let options = StaticOptions { torque: 1e3 * torque_nm, ..options.clone() };
        let history = StaticModel::new(pair.clone(), Arc::clone(&gears), options)?.run(8, 1, |_, _, _| ())?;
        Ok(1e3 * history.positions.iter().map(|p| p.transmission_error).sum::<f64>() / 8.0)
    };
    let torques: Vec<f64> = (1..=10).map(|i| 20.0 * f64::from(i)).collect();
    let all = torques.par_iter().map(|&torque| mean_ste_um(torque)).collect::<Result<Vec<f64>, _>>()?;
    torques.iter().zip(all).for_each(|(torque, te)| println!("{torque:>6.0} N m: mean STE {te:.4} um"));
    Ok(())
}
