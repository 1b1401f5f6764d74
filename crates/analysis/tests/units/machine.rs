//! Laws of what `in_motion::machine` keeps to itself.

use super::*;

/// A speed within a hundredth is silent, one beyond is told beside that of the start; likewise open energy.
#[test]
fn changed_speed_and_open_work_are_told() {
    assert_eq!([speed_changed(1009.0, 1000.0), work_open(-9e-7)], [None, None]);
    let told = speed_changed(985.0, 1000.0).unwrap().to_string();
    assert!(told.contains("985.0 rpm") && told.contains("1000.0 rpm"), "{told}");
    assert!(work_open(-2e-6).is_some() && speed_changed(f64::NAN, 1000.0).is_none());
}

/// A motion that comes back with all meshes is silent; one that needs two of these periods is subharmonic; one that does
/// not come back has waited too little, or drifts.
#[test]
fn what_does_not_settle_is_told() {
    let of = |period: usize, residual: f64, waited: u64| {
        let found = Periodicity { period, residual };
        let told = Settled { tolerance: 1e-6, found, waited, most: 1000, common: 53, why: "it may be chaotic" };
        told.remark().map(|told| told.to_string())
    };
    assert_eq!(of(53, 1e-7, 106), None);
    assert!(of(106, 1e-7, 106).unwrap().contains("subharmonic"));
    assert!(of(53, 1e-3, 106).unwrap().contains("the cycles that were written"));
    assert!(of(53, 1e-3, 1000).unwrap().contains("it may be chaotic"));
}
