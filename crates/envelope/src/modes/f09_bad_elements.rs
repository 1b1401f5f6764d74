//! F9: inverted elements in fillets, undercut and pointed teeth.

use mesh::{Extent, StructuredOptions, generate, scaled_jacobian};

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 9,
    name: "bad elements",
    file: "F09-bad-elements",
    scene: scene_text!("F09-bad-elements"),
    fails: "Elements turn inside out in sharp fillets, undercut roots and pointed tips; the solver goes on.",
    does: "Undercut and pointing are found by the geometry and refused; what is meshed has sound elements, and a bad one is named.",
    naive: &["pinion.teeth=8", "pinion.profile_shift=-0.6", "pinion.helix_angle_deg=0", "pinion.bore_diameter_mm=6"],
    look,
};

const TEETH: [u32; 7] = [8, 12, 17, 25, 40, 90, 200];
const SHIFTS: [f64; 5] = [-0.6, -0.2, 0.2, 0.7, 1.5];
const HELIX_DEG: [f64; 4] = [0.0, 15.0, 30.0, 45.0];

/// Gears of all kinds: how many are meshed, how many refused, and the least scaled Jacobian of those that are meshed.
fn sweep(bench: &Bench) -> Result<(usize, usize, f64), EnvelopeError> {
    let sample = bench.scene(&AS_IT_IS)?.gear_pair()?.pinion.data().clone();
    let options = StructuredOptions {
        elements_profile: 3,
        elements_fillet: 3,
        elements_thickness: 2,
        elements_face: 4,
        elements_rim: 2,
        extent: Extent::Sector(1),
        ..StructuredOptions::default()
    };
    let (mut meshed, mut refused, mut least) = (0, 0, f64::INFINITY);
    for teeth in TEETH {
        for profile_shift in SHIFTS {
            for helix_deg in HELIX_DEG {
                let helix_angle = f64::to_radians(helix_deg);
                let reference = f64::from(teeth) * sample.normal_module / helix_angle.cos();
                let (bore_diameter, tip_diameter) = (0.45 * reference, None);
                let data = geometry::GearData {
                    teeth,
                    profile_shift,
                    helix_angle,
                    bore_diameter,
                    tip_diameter,
                    ..sample.clone()
                };
                let made = geometry::Gear::new(data).ok().and_then(|gear| generate(&gear, &options).ok());
                let Some(mesh) = made else {
                    refused += 1;
                    continue;
                };
                meshed += 1;
                for block in &mesh.blocks {
                    for element in block.elements() {
                        let at: Vec<[f64; 3]> = element.iter().map(|&n| mesh.nodes[n as usize]).collect();
                        least = least.min(scaled_jacobian(block.kind, &at));
                    }
                }
            }
        }
    }
    Ok((meshed, refused, least))
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let (meshed, refused, least) = sweep(bench)?;
    let undercut = bench.at_rest(&bench.naive(&[]));
    bench.at_rest(&AS_IT_IS)?;
    Ok(vec![
        Figure::new(
            format!("least scaled Jacobian of {meshed} gears of 8 to 200 teeth ({refused} refused)"),
            Shown::at_least(least, 0.02),
        ),
        Figure::new("gears of these 140 that are meshed", Shown::at_least(meshed as f64, 80.0)),
        Figure::new("8 teeth with a profile shift of -0.6", Shown::refused(&undercut, "involute")),
    ])
}
