//! How long are the contact lines of a helical pair, and of how many tooth pairs, as the pinion turns through one
//! pitch?
//!
//! `cargo run -p geometry --example contact_lines`
#![allow(clippy::print_stdout, reason = "an example prints")]

use geometry::{Gear, GearData, GearPair, GeometryError, Side};

fn main() -> Result<(), GeometryError> {
    // 23/41 teeth, module 2.5 mm, helix angle 15 degrees, right hand on the pinion. Inside: mm and rad.
    let pinion = GearData {
        teeth: 23,
        normal_module: 2.5,
        helix_angle: 15f64.to_radians(),
        face_width: 18.0,
        bore_diameter: 30.0,
        ..GearData::default()
    };
    let wheel = GearData { teeth: 41, helix_angle: -pinion.helix_angle, ..pinion.clone() };
    let pair = GearPair::new(Gear::new(pinion)?, Gear::new(wheel)?, None)?;

    println!("centre distance {:.4} mm, base pitch {:.4} mm", pair.centre_distance(), pair.transverse_base_pitch());
    println!(
        "contact ratio {:.3} = {:.3} transverse + {:.3} overlap\n",
        pair.total_contact_ratio(),
        pair.transverse_contact_ratio(),
        pair.overlap_ratio()
    );

    println!("{:>6} {:>6} {:>12}   length of each line, mm", "phase", "pairs", "total, mm");
    let positions = 16;
    for i in 0..positions {
        let phase = f64::from(i) / f64::from(positions);
        let lines = pair.contact_lines(Side::Left, phase * pair.pinion.pitch_angle());
        let lengths: Vec<String> = lines.iter().map(|line| format!("{:.2}", line.length)).collect();
        let total = pair.contact_line_length(Side::Left, phase * pair.pinion.pitch_angle());
        println!("{phase:>6.3} {:>6} {total:>12.4}   {}", lines.len(), lengths.join("  "));
    }
    println!("{:>13} {:>12.4}   = eps_alpha b / cos b_b", "mean", pair.mean_contact_line_length());
    Ok(())
}
