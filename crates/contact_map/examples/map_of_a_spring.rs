//! A contact that is a spring behind a gap, and its map.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use std::{convert::Infallible, f64::consts::TAU};

use contact_map::{ContactMap, ContactSample, LoadedSlice, MapPlan, PhaseContact, Wanted};

/// Stiffness (N/mm) and gap (mm) at a phase.
struct Spring {
    stiffness: f64,
    gap: f64,
}

impl PhaseContact for Spring {
    type Error = Infallible;

    fn overlap(&mut self, approach: f64, _: f64) -> f64 {
        approach - self.gap
    }

    fn sample(&mut self, approach: f64, _: f64) -> Result<ContactSample, Infallible> {
        let force = self.stiffness * (approach - self.gap).max(0.0);
        let slices = vec![LoadedSlice { force, length: 10.0, lever: 0.0, pair: 0, friction: [0.0; 3] }];
        let stiffness = if force > 0.0 { self.stiffness } else { 0.0 };
        Ok(ContactSample { force, stiffness, slices })
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let plan = MapPlan {
        mean_force: 1000.0,
        largest_force: 4000.0,
        tilt: None,
        width: 10.0,
        half_path: None,
        tolerance: 1e-4,
        worst: 1e-4,
    };
    let map = ContactMap::build(&plan, &|_| {}, |phase| {
        Ok::<_, Infallible>(Spring { stiffness: 2e5 * (1.0 + 0.2 * (TAU * phase).cos()), gap: 1e-3 })
    })?;
    let certificate = map.certificate();
    println!("{} contacts solved, error {:.1e} mm", certificate.contacts, certificate.rms_error_mm);
    for approach in [0.0, 2e-3, 6e-3, 1e-2] {
        let contact = map.at(0.125, approach, 0.0, Wanted { energy: true, phase_rate: false });
        println!("approach {approach:.3} mm: {:.1} N, energy {:.3} N mm", contact.force, contact.energy);
    }
    Ok(())
}
