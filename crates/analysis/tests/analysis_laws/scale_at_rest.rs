//! Lengths follow the problem: a pair of another size has the same answer at rest, with whatever is ground off its
//! flanks.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use crate::scaled::{FLANKS, Flanks, SIZES, apart, largest, scene};
use analysis::{StaticAnalysis, StaticResult};
use ltca::StaticPosition;

/// Quantities and the power of the size that they go with.
type Quantity = (&'static str, i32, fn(&StaticPosition) -> f64);

const UNLOADED: &str = "transmission error without load";
const QUANTITIES: [Quantity; 8] = [
    ("transmission error", 1, |p| p.transmission_error),
    (UNLOADED, 1, |p| p.kinematic_transmission_error),
    ("largest pressure", 0, |p| p.max_pressure),
    ("length of contact lines", 1, |p| p.contact_line_length),
    ("the same by geometry", 1, |p| p.geometric_line_length),
    ("tangent stiffness", 1, |p| p.tangent_stiffness),
    ("axial force", 2, |p| p.wrench[0].force[2]),
    ("tilting moment", 3, |p| p.wrench[0].moment[1]),
];

fn solved(size: f64, flanks: Flanks, contact: &str) -> StaticResult {
    let scene = scene(size, flanks, &format!("[analysis]\npositions_per_cycle = 8\n[contact]\n{contact}"));
    StaticAnalysis::new(&scene).solve().unwrap_or_else(|e| panic!("size {size}, {}: {e}", flanks.0))
}

/// By how much the worst quantity of a pair of another size is off, and which.
fn off(size: f64, one: &StaticResult, other: &StaticResult) -> (f64, &'static str) {
    let of = |result: &StaticResult, value: fn(&StaticPosition) -> f64, scale: f64| -> Vec<f64> {
        result.history.positions.iter().map(|p| value(p) / scale).collect()
    };
    let all = QUANTITIES.map(|(name, power, value)| {
        let own = of(one, value, 1.0);
        // Without load nominal parts of flanks touch at 0: its scale is the error under load.
        let scale = if name == UNLOADED { largest(&of(one, |p| p.transmission_error, 1.0)) } else { largest(&own) };
        (apart(&of(other, value, size.powi(power)), &own, scale), name)
    });
    all.into_iter().reduce(|a, b| if a.0.is_nan() || a.0 >= b.0 { a } else { b }).expect("quantities")
}

#[test]
fn a_pair_of_another_size_has_the_same_answer_at_rest() {
    let mut missed = Vec::new();
    for contact in ["slices = 12\n", "method = \"nodal\"\npoints_per_face_edge = 2\n"] {
        for flanks in FLANKS {
            let one = solved(1.0, flanks, contact);
            for size in SIZES {
                let (worst, name) = off(size, &one, &solved(size, flanks, contact));
                println!("{contact:?} {}, size {size}: {worst:.1e} ({name})", flanks.0);
                if worst.is_nan() || worst > 1e-9 {
                    missed.push(format!("{contact:?} {}, size {size}: {name} off by {worst:.2e}", flanks.0));
                }
            }
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}
