//! From traces to flanks.

use geometry::{FlankModification, GearModifications, Side};
use metrology::{MeasuredGear, TraceKind, flanks};

use crate::made::{gear, header, trace};

/// A flank that is a sum of a function along the profile and one along the face comes back from one profile and one
/// helix, whatever zero each has; one with a twist from three profiles and one helix.
#[test]
fn flanks_come_back_from_their_traces() {
    let gear = gear();
    let header = header(&gear);
    let (middle, diameter) = (15.0, 2.0 * gear.base_radius().hypot(15.0));
    for twist in [0.0, 0.05] {
        let proud = |x: f64, z: f64| 2.0 - 0.03 * (x - middle).powi(2) - 0.04 * z * z + twist * z * (x - middle) / 2.0;
        let heights: &[f64] = if twist == 0.0 { &[0.0] } else { &[-7.0, 0.0, 7.0] };
        let of = |z: f64| trace(&header, TraceKind::Profile(z), (2, Side::Left), |x| proud(x, z) + z + 0.3);
        let mut traces: Vec<_> = heights.iter().map(|&z| of(z)).collect();
        traces.push(trace(&header, TraceKind::Helix(diameter), (2, Side::Left), |z| proud(middle, z) - 7.0));
        let found = flanks(&MeasuredGear { header, traces, pitch: Vec::new() }, &gear).unwrap();
        assert_eq!(found.measured_teeth, [vec![2], vec![]]);
        assert!(found.extrapolated_mm.iter().all(|mm| *mm > 0.0 && *mm < 1.0), "{:?}", found.extrapolated_mm);
        let left = FlankModification { topography: found.topographies[0].clone(), ..FlankModification::default() };
        let ground = gear.clone().with_modifications(GearModifications { left, ..Default::default() }).unwrap();
        let at = |x: f64, z: f64| -1e3 * ground.depth(Side::Left, 11, x / gear.base_radius(), z).value;
        let zero = at(middle, 0.0) - proud(middle, 0.0);
        for x in [10.0, 13.0, 15.0, 19.0] {
            for z in [-6.0, -1.0, 2.0, 7.0] {
                let off = at(x, z) - proud(x, z) - zero;
                assert!(off.abs() < 2e-3, "twist {twist}, x {x}, z {z}: off by {off} um");
            }
        }
    }
}

/// A trace that was measured again counts in place of the first one, and is counted.
#[test]
fn the_last_of_repeated_traces_counts() {
    let gear = gear();
    let header = header(&gear);
    let of = |slope: f64| trace(&header, TraceKind::Profile(0.0), (2, Side::Left), |x| slope * x);
    let made = |slopes: &[f64]| {
        let traces = slopes.iter().map(|slope| of(*slope)).collect();
        MeasuredGear { header, traces, pitch: Vec::new() }
    };
    let again = made(&[0.5, -0.2, 0.1]);
    assert_eq!(again.repeated_traces(), 2);
    let topographies = |of: &MeasuredGear| flanks(of, &gear).unwrap().topographies;
    assert_eq!(topographies(&again), topographies(&made(&[0.1])));
    assert_ne!(topographies(&again), topographies(&made(&[0.5])));
}

/// Teeth with other traces than their neighbours, and traces with ends of their own: all grids of a side have the same lines, and
/// the flank of each tooth keeps its place.
#[test]
fn all_teeth_have_the_same_lines() {
    let gear = gear();
    let header = header(&gear);
    let slope = |z: f64| 0.5 * z;
    let profile = |tooth: u32| trace(&header, TraceKind::Profile(0.0), (tooth, Side::Left), |_| 0.0);
    let helix = |tooth: u32| trace(&header, TraceKind::Helix(90.0), (tooth, Side::Left), slope);
    let mut traces: Vec<_> = (0..30).map(profile).chain((0..30).step_by(7).map(helix)).collect();
    // A value that is none at the end of one of them.
    traces[31].deviations_um[0] = None;
    let found = flanks(&MeasuredGear { header, traces, pitch: Vec::new() }, &gear).unwrap();
    assert_eq!(found.same_along_face, [25, 0]);
    let grids = found.topographies[0].as_ref().unwrap().grids();
    assert!(grids.iter().all(|own| own.heights() == grids[0].heights() && own.profile() == grids[0].profile()));
    let left = FlankModification { topography: found.topographies[0].clone(), ..FlankModification::default() };
    let ground = gear.clone().with_modifications(GearModifications { left, ..Default::default() }).unwrap();
    for tooth in [0, 7, 28] {
        let at = |z: f64| -1e3 * ground.depth(Side::Left, tooth, 15.0 / gear.base_radius(), z).value;
        let off = at(6.0) - at(-6.0) - 6.0;
        assert!(off.abs() < 0.02, "tooth {tooth}: off by {off} um");
    }
}

/// Pitch of both sides becomes one error a tooth; what that leaves out is said.
#[test]
fn pitch_becomes_one_error_a_tooth() {
    let gear = gear();
    let all = crate::made::measured(|_, x| x);
    let found = flanks(&all, &gear).unwrap();
    assert_eq!(found.pitch_errors.len(), 30);
    assert!((found.pitch_errors[4] - 1e-3 * (0.25 + (2.8f64).sin() * 3.25)).abs() < 1e-12);
    assert!((found.left_out_mm - 0.25e-3).abs() < 1e-12);
    assert_eq!(found.measured_teeth[0].len(), 30);
}
