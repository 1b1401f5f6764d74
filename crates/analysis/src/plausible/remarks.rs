//! Values that are possible but unlikely; reported once, before the solution.

use std::f64::consts::PI;

use answer::Remark;
use geometry::{Gear, GearPair, Side};
use scene::{GearScene, Kind, Operation, PairScene, Scene, units::in_another_unit};

use super::{
    flanks::largest_depth,
    material::{DENSITIES, HEAVY, SOFT},
    refusal::doubtful,
};
use crate::remark;

/// Helix angles that nobody makes, degrees: up to 45 degrees in rad.
const FLAT: [f64; 2] = [0.02, 0.8];
/// Face width over module likewise, below and above.
const WIDTHS: [f64; 2] = [0.05, 200.0];
/// Bore over reference diameter likewise, below.
const BORE: f64 = 0.01;
/// Micro-geometry over module: a fifth of it is a tooth no longer.
const DEEP: f64 = 0.15;
/// Micro-geometry that no machine grinds, mm, and over the module.
const SHALLOW_MM: f64 = 2e-4;
const SHALLOW: f64 = 1e-4;
/// Backlash over module likewise.
const LOOSE: f64 = 0.5;
/// Thinning of a tooth that is not measured, mm.
const THIN_MM: f64 = 5e-4;
/// Speeds of machines are multiples of this, 1/min.
const ROUND_RPM: f64 = 50.0;

/// Remarks about unlikely values of a scene, with the unit that may have been intended.
pub fn remarks(scene: &Scene, pair: &GearPair) -> Vec<Remark> {
    let gears = [("pinion", &scene.pinion, &pair.pinion), ("wheel", &scene.wheel, &pair.wheel)];
    let (alike, dynamic) = (scene.pinion.material == scene.wheel.material, scene.analysis.kind == Kind::Dynamic);
    let module = scene.pair.normal_module_mm;
    let of_gears = gears.into_iter().flat_map(|(name, gear, exact)| {
        let of = if alike { "gears" } else { name };
        let own = [material(of, gear), density(dynamic, of, gear), bore(name, gear, exact), thinning(name, gear)];
        own.into_iter().flatten().chain(flanks(module, name, exact)).collect::<Vec<_>>()
    });
    let of_pair =
        [doubtful(scene, pair), helix(&scene.pinion), width(&scene.pair), backlash(module, pair), ring_shift(pair)];
    let mut all: Vec<Remark> = Vec::new();
    let speed = if dynamic { speed(&scene.operation) } else { None };
    for said in of_pair.into_iter().chain([speed]).flatten().chain(of_gears) {
        if !all.contains(&said) {
            all.push(said);
        }
    }
    all
}

/// What `value` is in another unit; nothing where no unit fits.
fn meant(key: &str, value: f64, fits: impl Fn(f64) -> bool) -> String {
    in_another_unit(key, value, fits).map(|other| other.said).unwrap_or_default()
}

fn material(name: &str, gear: &GearScene) -> Option<Remark> {
    let (young, density) = (gear.material.young_mpa, gear.material.density_kg_m3);
    (young < SOFT && density > HEAVY).then(|| {
        let other = meant("young_mpa", young, |x| x >= SOFT);
        remark::soft_material(name, young, other)
    })
}

fn density(dynamic: bool, name: &str, gear: &GearScene) -> Option<Remark> {
    let density = gear.material.density_kg_m3;
    let known = (DENSITIES[0]..=DENSITIES[1]).contains(&density);
    (dynamic && !known).then(|| {
        let other = meant("density_kg_m3", density, |x| (DENSITIES[0]..=DENSITIES[1]).contains(&x));
        remark::unlikely_density(name, density, other)
    })
}

fn bore(name: &str, gear: &GearScene, exact: &Gear) -> Option<Remark> {
    let (bore, reference) = (gear.bore_diameter_mm, 2.0 * exact.reference_radius().abs());
    (bore < BORE * reference).then(|| {
        let other = meant("bore_diameter_mm", bore, |x| (0.1 * reference..reference).contains(&x));
        remark::small_bore(name, bore, reference, other)
    })
}

fn thinning(name: &str, gear: &GearScene) -> Option<Remark> {
    let thinner = gear.thickness_allowance_mm;
    (thinner > 0.0 && thinner < THIN_MM).then(|| {
        let other = meant("thickness_allowance_mm", thinner, |x| x > THIN_MM && x < 1.0);
        remark::small_thinning(name, thinner, other)
    })
}

fn flanks(module: f64, name: &str, exact: &Gear) -> Option<Remark> {
    let depth = [Side::Left, Side::Right].map(|side| largest_depth(exact, side)).into_iter().fold(0.0, f64::max);
    if depth > DEEP * module {
        return Some(remark::deep_flanks(name, 1e3 * depth, depth / module));
    }
    (depth > 0.0 && depth < SHALLOW_MM.min(SHALLOW * module))
        .then(|| remark::shallow_flanks(name, 1e3 * depth, 1e6 * depth))
}

fn helix(pinion: &GearScene) -> Option<Remark> {
    let helix = pinion.helix_angle_deg;
    (FLAT[0]..FLAT[1]).contains(&helix.abs()).then(|| {
        let other = meant("helix_angle_deg", helix, |x| x.abs() < 60.0);
        remark::small_helix(helix, other)
    })
}

fn width(pair: &PairScene) -> Option<Remark> {
    let (width, module) = (pair.face_width_mm, pair.normal_module_mm);
    let ratio = width / module;
    let other = if ratio < WIDTHS[0] {
        meant("face_width_mm", width, |x| (module..100.0 * module).contains(&x))
    } else if ratio > WIDTHS[1] {
        let in_m = in_another_unit("normal_module_mm", module, |x| (1.0..50.0).contains(&(width / x)));
        in_m.map(|own| own.said).unwrap_or_default()
    } else {
        return None;
    };
    Some(remark::unlikely_width(width, ratio, module, other))
}

fn backlash(module: f64, pair: &GearPair) -> Option<Remark> {
    let backlash = pair.backlash();
    (backlash > LOOSE * module).then(|| remark::large_backlash(backlash, backlash / module))
}

fn ring_shift(pair: &GearPair) -> Option<Remark> {
    let other = pair.ring_shift_of_other_sign()?;
    Some(remark::ring_shift_of_other_sign(-other, pair.backlash(), other))
}

/// A speed in rad/s is the digits of a round number of turns a minute.
fn speed(operation: &Operation) -> Option<Remark> {
    let written = operation.speed_rpm;
    if written.fract() == 0.0 {
        return None;
    }
    let decimals = format!("{written}").split_once('.').map_or(0, |(_, digits)| digits.len());
    let round = (written * 30.0 / PI / ROUND_RPM).round() * ROUND_RPM;
    let same = format!("{:.decimals$}", round * PI / 30.0).parse() == Ok(written);
    (same && round > 0.0 && decimals <= 4).then(|| remark::speed_in_rad_per_s(written, round))
}
