//! Contact patch test: two blocks with meshes that do not match, pressed together by a uniform pressure (failure mode
//! F12).
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use contact::complementarity::Law;
use envelope::contact_patch_deviation;
use mesh::ElementKind;

fn deviation(kind: ElementKind, per_edge: usize, law: Law) -> [f64; 2] {
    contact_patch_deviation(kind, per_edge, law).unwrap_or_else(|e| panic!("{kind:?}, {per_edge} points: {e}"))
}

#[test]
fn uniform_pressure_passes_between_meshes_that_do_not_match() {
    for kind in [ElementKind::Hex8, ElementKind::Hex20] {
        let mut worst = Vec::new();
        let counts = [2, 3, 4, 6, 8, 12, 16, 24];
        for per_edge in counts {
            let [a, b] = deviation(kind, per_edge, Law::Penalty(1e7));
            println!(
                "{kind:?}, {per_edge:>2} points an edge: displacement of the faces {:.4} % and {:.4} % off uniform",
                100.0 * a,
                100.0 * b
            );
            worst.push(a.max(b));
        }
        let order = (worst[3] / worst[7]).ln() / (24.0f64 / 6.0).ln();
        println!("{kind:?}: observed order in the number of points {order:.2}");
        assert!(worst[3] < 0.01, "{kind:?}: 6 points an edge leave {:.3} %", 100.0 * worst[3]);
        assert!(worst[7] < 0.2 * worst[3], "{kind:?}: {worst:?} does not vanish");
    }
}

/// Meshes that do match pass to round-off with as few points as the faces need.
#[test]
fn exact_contact_agrees() {
    for kind in [ElementKind::Hex8, ElementKind::Hex20] {
        let [a, b] = deviation(kind, 6, Law::Exact);
        println!("{kind:?}, exact contact, 6 points an edge: {:.4} % and {:.4} % off uniform", 100.0 * a, 100.0 * b);
        assert!(a.max(b) < 0.02, "{kind:?}: {a} {b}");
    }
}
