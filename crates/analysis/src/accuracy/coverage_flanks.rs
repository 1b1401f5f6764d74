//! Flanks, racks and materials unlike those of the random pairs of the calibration.

use std::ops::RangeInclusive;

use scene::{FlankScene, GearScene, Scene};

/// Micro-geometry of the random pairs of the calibration (`tests/src/random_scene.rs`).
const TIP_RELIEF_UM_A_MODULE: RangeInclusive<f64> = 0.0..=10.0;
const LEAD_CROWNING_UM: RangeInclusive<f64> = 0.0..=20.0;
const MOST_MISALIGNMENT_UM: f64 = 20.0;
/// Their basic rack: addendum and dedendum over the module.
const RACK: [f64; 2] = [1.0, 1.25];
/// Addenda of their internal pairs, over the module.
const RING_ADDENDUM: RangeInclusive<f64> = 0.75..=1.0;
/// They are of steel, 0.3; metals differ by no more than this.
const POISSON: RangeInclusive<f64> = 0.25..=0.35;

/// In words, one each.
pub(super) fn other_flanks(scene: &Scene) -> Vec<String> {
    let mut all = Vec::new();
    for (name, gear) in ["pinion", "wheel"].into_iter().zip(scene.gears()) {
        all.extend(flank(name, gear, scene.pair.normal_module_mm));
        if !POISSON.contains(&gear.material.poisson) {
            all.push(format!("a Poisson's ratio of {} of the {name}: the calibration has 0.3", gear.material.poisson));
        }
    }
    let misalignment = &scene.pair.misalignment;
    let most = [misalignment.deviation_um, misalignment.inclination_um, misalignment.in_plane_of_action_um];
    let most: f64 = most.iter().map(|um| um.abs()).sum();
    if most > MOST_MISALIGNMENT_UM {
        all.push(format!("a misalignment of {most} um: the calibration has up to {MOST_MISALIGNMENT_UM} um"));
    }
    let [addendum, dedendum] = [scene.pair.addendum_coefficient, scene.pair.dedendum_coefficient];
    let [a, d] = RACK;
    let low = scene.wheel.is_internal() && RING_ADDENDUM.contains(&addendum);
    if dedendum != d || (addendum != a && !low) {
        all.push(format!("a basic rack of {addendum} and {dedendum} modules: the calibration has {a} and {d}"));
    }
    all
}

/// What of the pressed flank of a gear no random pair has.
fn flank(name: &str, gear: &GearScene, module: f64) -> Vec<String> {
    let flank = &gear.modification.drive;
    let mut all = Vec::new();
    let mut check = |what: &str, value: Option<f64>, range: RangeInclusive<f64>| {
        if let Some(value) = value.filter(|value| !range.contains(value)) {
            let [low, high] = [range.start(), range.end()];
            all.push(format!("{what} of {value} um of the {name}: the calibration has {low} to {high} um"));
        }
    };
    check("a tip relief", flank.tip_relief_um, 0.0..=TIP_RELIEF_UM_A_MODULE.end() * module);
    check("a lead crowning", flank.lead_crowning_um, LEAD_CROWNING_UM);
    let others = other_terms(flank);
    if !others.is_empty() {
        let others = others.join(", ");
        all.push(format!("{others} of the {name}: the calibration has tip relief and lead crowning alone"));
    }
    all
}

/// Names of the terms of a flank but tip relief and lead crowning.
fn other_terms(flank: &FlankScene) -> Vec<&'static str> {
    let terms = [
        ("root relief", flank.root_relief_um),
        ("profile crowning", flank.profile_crowning_um),
        ("profile slope", flank.profile_slope_um),
        ("lead slope", flank.lead_slope_um),
        ("end relief", flank.end_relief_lower_um.or(flank.end_relief_upper_um)),
        ("bias", flank.bias_um),
    ];
    terms.into_iter().filter(|(_, um)| um.is_some_and(|um| um != 0.0)).map(|(name, _)| name).collect()
}
