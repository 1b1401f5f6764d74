//! Which teeth are in the window as a pair of 7 and 11 teeth turns, and what happens when one that carries load should
//! leave?
//!
//! `cargo run -p ale --example tooth_window`
#![allow(clippy::print_stdout, reason = "an example prints")]

use ale::{AleError, ToothWindow, teeth_needed};
use geometry::Sense;

fn main() -> Result<(), AleError> {
    let count = teeth_needed(2.17);
    let mut window = ToothWindow::new(0, count, [7, 11])?;
    println!("contact ratio 2.17: {count} pairs are kept");
    println!("{:>8}  pinion tooth/wheel tooth", "change");
    for change in 0..10 {
        let teeth: Vec<String> =
            window.pairs().map(|pair| window.teeth_of(pair)).map(|[p, w]| format!("{p}/{w}")).collect();
        println!("{change:>8}  {}", teeth.join("  "));
        // Forces of the window's pairs, N, ascending: the one that leaves carries none.
        let mut forces = vec![800.0; count];
        forces[(window.outgoing(Sense::Ccw) - window.first()) as usize] = 0.0;
        window = window.change(Sense::Ccw, &forces)?;
    }

    // A loaded tooth is never dropped.
    match window.change(Sense::Ccw, &vec![800.0; count]) {
        Err(refused) => println!("\nall three loaded: {refused}"),
        Ok(_) => println!("\na force was dropped"),
    }
    Ok(())
}
