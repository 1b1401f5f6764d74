//! Peak memory is that of the process: the only test of its program, so that no other one is seen in it.

use ale_gear::phases::Phases;

/// A phase that touches 64 MB shows them, and the next one does not.
#[test]
fn a_phase_has_its_own_peak() {
    let mut phases = Phases::quiet();
    phases.run("large", || std::hint::black_box(vec![1_u8; 64_000_000]).len());
    phases.run("small", || ());
    let [large, small] = phases.rows() else { panic!("two phases") };
    if let (Some(large), Some(small)) = (large.peak_memory_mb, small.peak_memory_mb) {
        assert!(large > small + 30.0, "{large} MB, then {small} MB");
    }
}
