//! Scenes that the bounds do not cover: scenes unlike those of the calibration, and effects that no mesh can show.

use std::{f64::consts::PI, ops::RangeInclusive};

use fem::mass_properties;
use mesh::MeshedGear;
use scene::{GearScene, Scene};

use super::{Rung, companion::Standing, coverage_flanks::other_flanks};
use crate::{AnalysisError, StaticResult, elastic_gears::material, loaded_pair::LoadedPair, meshes};

/// Ranges of the random pairs that the laws were made of, or checked on (`tests/src/random_scene.rs`); of each array the first is the
/// pinion's, the second the wheel's.
struct Ranges {
    teeth: [RangeInclusive<f64>; 2],
    helix_deg: RangeInclusive<f64>,
    width_modules: RangeInclusive<f64>,
    shift: [RangeInclusive<f64>; 2],
    /// Least radial thickness of the body beyond the root, modules.
    rim_modules: [f64; 2],
}

const EXTERNAL: Ranges = Ranges {
    teeth: [12.0..=120.0, 12.0..=120.0],
    helix_deg: 0.0..=40.0,
    width_modules: 3.0..=25.0,
    shift: [-0.4..=0.8, -0.4..=0.8],
    rim_modules: [0.8, 0.8],
};
/// Pairs of the checks alone: the laws are those of external pairs.
const INTERNAL: Ranges = Ranges {
    teeth: [12.0..=60.0, 24.0..=160.0],
    helix_deg: 0.0..=30.0,
    width_modules: 3.0..=10.0,
    shift: [-0.2..=0.6, -0.3..=0.4],
    rim_modules: [0.8, 1.2],
};
const PRESSURE_ANGLE_DEG: RangeInclusive<f64> = 15.0..=28.0;
/// Hertz pressure of the mean line load at the pitch point, MPa.
const PRESSURE_MPA: RangeInclusive<f64> = 500.0..=1800.0;
const POSITIONS: RangeInclusive<u32> = 8..=1_000_000;
/// Difference of the volumes of two meshes of one body, relative; facets of linear elements cost a third of it.
const SAME_BODY: f64 = 0.015;

/// What of a scene is unlike those of the calibration, in words, one each: empty where its laws hold.
pub(super) fn beyond_calibration(scene: &Scene, result: &StaticResult) -> Vec<String> {
    let mut all = beyond_ranges(scene, result);
    all.extend(other_flanks(scene));
    all.extend(few_slices(result));
    if scene.contact.friction > 0.0 {
        all.push("friction: the calibration has none".into());
    }
    if scene.contact.corner_contact == Some(false) {
        all.push("edges cut off: in the calibration corners press".into());
    }
    all
}

/// All that bounds do not cover, in words, one each; `beyond` from [`beyond_calibration`].
///
/// # Errors
/// [`AnalysisError`] where meshes cannot be made.
pub(super) fn not_covered(
    scene: &Scene,
    result: &StaticResult,
    standing: Standing,
    beyond: Vec<String>,
) -> Result<Vec<String>, AnalysisError> {
    let mut all = beyond;
    if let Standing::Beside(_) = standing {
        all.extend(other_bodies(scene, result)?);
    }
    all.push(
        "material data, load and micro-geometry as they are given; bodies beyond the bore, which is held rigid".into(),
    );
    if scene.contact.friction > 0.0 {
        all.push("the coefficient of friction as it is given".into());
    }
    Ok(all)
}

fn beyond_ranges(scene: &Scene, result: &StaticResult) -> Vec<String> {
    let module = scene.pair.normal_module_mm;
    let ranges = if result.pair.is_internal() { INTERNAL } else { EXTERNAL };
    let mut all = Vec::new();
    let mut check = |what: &str, value: f64, range: RangeInclusive<f64>| {
        if !range.contains(&value) {
            all.push(format!("{what} of {value:.3}: the calibration has {} to {}", range.start(), range.end()));
        }
    };
    check("a helix angle", scene.pinion.helix_angle_deg.abs(), ranges.helix_deg);
    check("b/m_n", result.pair.face_width() / module, ranges.width_modules);
    check("a normal pressure angle", scene.pair.normal_pressure_angle_deg, PRESSURE_ANGLE_DEG);
    check(
        "a Hertz pressure at the pitch point (MPa)",
        nominal_pressure(&LoadedPair::of(scene, &result.pair)),
        PRESSURE_MPA,
    );
    let positions = f64::from(scene.analysis.positions_per_cycle);
    check("positions a cycle", positions, f64::from(*POSITIONS.start())..=f64::from(*POSITIONS.end()));
    let gears = [("pinion", &result.pair.pinion), ("wheel", &result.pair.wheel)];
    for (((name, exact), gear), i) in gears.into_iter().zip(scene.gears()).zip(0..) {
        let rim = (exact.root_radius() - 0.5 * exact.data().bore_diameter) / module;
        check(&format!("teeth of the {name}"), f64::from(gear.teeth), ranges.teeth[i].clone());
        check(&format!("profile shift of the {name}"), gear.profile_shift, ranges.shift[i].clone());
        check(&format!("rim of the {name} in modules"), rim, ranges.rim_modules[i]..=f64::INFINITY);
    }
    let [first, second] = result.pair.faces();
    if first != second {
        all.push("faces of two widths or at two heights: the calibration has equal ones side by side".into());
    }
    let measured = |gear: &&GearScene| {
        let flanks = [&gear.modification.drive, &gear.modification.coast];
        let pitch = !gear.pitch_errors_um.is_empty() || gear.pitch_errors_file.is_some();
        pitch || flanks.iter().any(|flank| flank.topography.is_some())
    };
    if scene.gears().iter().any(measured) {
        all.push("pitch errors and topographies: the calibration has none".into());
    }
    all
}

/// Half as many slices tell little of the error of too few: peaks between them are seen by neither.
fn few_slices(result: &StaticResult) -> Option<String> {
    let resolution = result.facts.resolution.as_ref()?;
    let [slices, enough] = [resolution.slices?, resolution.slices_that_would_do?];
    let few = slices < enough;
    few.then(|| format!("{slices} slices: the calibration has as many as a pair asks for, here {enough}"))
}

/// p = sqrt(F' E* / (pi rho)) of the mean line load, rho of both flanks at the pitch point, MPa.
fn nominal_pressure(loaded: &LoadedPair<'_>) -> f64 {
    let pair = loaded.pair;
    let cos = pair.base_helix_angle().cos();
    let line_load = loaded.torque / (loaded.driven_base_radius() * cos * pair.mean_contact_line_length());
    let [r1, r2] = pair.working_radii().map(|r| r * pair.working_pressure_angle().sin());
    (line_load * (r1 + r2) * cos / (PI * loaded.compliance() * r1 * r2)).sqrt()
}

/// Gears whose mesh is of another body than that of the built-in mesher, which it is held against.
fn other_bodies(scene: &Scene, result: &StaticResult) -> Result<Vec<String>, AnalysisError> {
    let Some(model) = &result.model else { return Ok(Vec::new()) };
    let coarse = Rung::ALL[0].scene(scene);
    let mut all = Vec::new();
    for (i, name) in ["pinion", "wheel"].into_iter().enumerate() {
        let exact = [&result.pair.pinion, &result.pair.wheel][i];
        let solid = meshes::gear_mesh(&coarse, name, coarse.gears()[i], exact)?;
        let volume = |gear: &MeshedGear| {
            let properties = mass_properties(gear.mesh(), &material(scene, i)?);
            let tooth = |p: fem::MassProperties| p.volume_mm3 / gear.teeth().len() as f64;
            properties.map(tooth).map_err(|source| AnalysisError::from(source).of_part(name))
        };
        let [own, solid] = [volume(model.gears()[i].gear())?, volume(&solid.gear)?];
        if (own / solid - 1.0).abs() > SAME_BODY {
            all.push(format!(
                "the mesh of the {name} has {:+.1} % more volume than a solid gear: another body, and what its mesh \
                 does is not told from what its shape does",
                100.0 * (own / solid - 1.0)
            ));
        }
    }
    Ok(all)
}
