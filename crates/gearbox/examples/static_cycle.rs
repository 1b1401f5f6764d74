//! Quasi-static contact of a helical pair over one mesh cycle: transmission error, contact-line length, load of each
//! pair of teeth.
//!
//! `cargo run -p gearbox --example static_cycle`
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;

mod pair;

use ltca::{StaticModel, StaticOptions};

fn main() -> Result<(), Box<dyn Error>> {
    let (pair, meshes) = pair::coarse()?;
    let options = StaticOptions::new(150e3, &pair); // N mm on the driven gear
    let gears = pair::reduced(&pair, &meshes, &options)?;
    let mut model = StaticModel::new(pair, gears, options)?;
    let history = model.run(16, 1, |_, _, _| ())?;

    println!("{:>6} {:>9} {:>11} {:>9}   forces of the pairs, N", "phase", "STE, um", "length, mm", "p0, MPa");
    for position in &history.positions {
        let forces: Vec<String> = position.pairs.iter().map(|p| format!("{:7.1}", p.normal_force)).collect();
        println!(
            "{:>6.3} {:>9.4} {:>11.3} {:>9.1}   {}",
            position.mesh_phase,
            1e3 * position.transmission_error,
            position.contact_line_length,
            position.max_pressure,
            forces.join(" ")
        );
    }
    println!(
        "\nworst torque residual {:.0e}",
        history.positions.iter().map(|p| p.certificate.torque_residual).fold(0.0, f64::max)
    );
    Ok(())
}
