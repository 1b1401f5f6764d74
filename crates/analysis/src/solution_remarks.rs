//! Remarks about a solution for the user.

use answer::Remark;
use fem::locks_from;
use geometry::GearPair;
use ltca::{StaticModel, StaticOptions, StaticPosition};
use mesh::{BoreCoupling, ElementKind, Extent};
use nalgebra::{Vector3, Vector6};
use reduction::{ElasticGear, GearReducer};

use crate::{coarse::Coarse, gear_dofs::reduced, meshes::SceneMesh, remark};

const NAMES: [&str; 2] = ["pinion", "wheel"];

/// Remarks about effects of the modelled gear bodies that the user's machine may not have: free cuts soften, bores
/// close to the teeth stiffen.
pub fn body_remarks(model: &StaticModel) -> Vec<Remark> {
    let gears = model.gears();
    let coarse = Coarse::new(model.pair(), [gears[0].material(), gears[1].material()], model.options());
    let warn = |i: usize| {
        let bodies = sector_remark(model, &coarse, i).into_iter().chain(rim_remark(model, &coarse, i));
        bodies.chain(locking_remark(&gears[i], NAMES[i]))
    };
    (0..2).flat_map(warn).collect()
}

/// A free-cut sector is softer than the gear it was cut from: by how much, two coarse models say.
fn sector_remark(model: &StaticModel, coarse: &Coarse<'_>, i: usize) -> Option<Remark> {
    let gear = model.gears()[i].gear();
    let (meshed, teeth) = (gear.teeth().len(), gear.tooth_count());
    let cyclic = reduced(&model.gears()[i]).is_some_and(GearReducer::is_cyclic);
    if cyclic || meshed >= teeth as usize {
        return None;
    }
    let whole = coarse.solid();
    let mut cut = whole;
    cut[i].extent = Extent::Sector(meshed as u32);
    let by = match coarse.ratio(whole, cut) {
        Some(ratio) => format!(
            " (coarse solid gears: the mean transmission error is {:.0} % larger with such a sector than with all teeth)",
            100.0 * (ratio - 1.0)
        ),
        None => String::new(),
    };
    Some(remark::free_cut_sector(NAMES[i], meshed, teeth, by))
}

/// Bore over reference diameter of the solid gear that a thin rim is held against: the default of scenes.
const SOLID: f64 = 0.55;
/// Bore over reference diameter below which the mean transmission error is within a tenth of the solid gear's, an
/// eighth where it is narrow and helical (`docs/validation.md`, Thin rims): no model is made there.
const THIN: f64 = 0.64;
/// Change of the mean transmission error that is worth a word.
const HELD: f64 = 0.1;

/// A bore close to the teeth holds them: what the answer would be were the gear solid further in, two coarse models
/// say.
fn rim_remark(model: &StaticModel, coarse: &Coarse<'_>, i: usize) -> Option<Remark> {
    let gear = [&model.pair().pinion, &model.pair().wheel][i];
    let (bore, reference) = (gear.data().bore_diameter, 2.0 * gear.reference_radius());
    let held = |g: &ElasticGear| g.gear().bore_coupling() == BoreCoupling::Kinematic;
    if bore < THIN * reference || !held(&model.gears()[i]) {
        return None;
    }
    let as_is = coarse.solid();
    let mut solid = as_is;
    solid[i].bore_diameter = SOLID * reference;
    let softer = coarse.ratio(as_is, solid)? - 1.0;
    (softer > HELD)
        .then(|| remark::rim_held(NAMES[i], bore, lumped::iso::rim_ratio(gear), solid[i].bore_diameter, 100.0 * softer))
}

/// Remark about elements that lock: linear tetrahedra and wedges in bending always, others near a Poisson's ratio of
/// 0.5.
pub fn locking_remark(gear: &ElasticGear, name: &str) -> Option<Remark> {
    let poisson = gear.material().poisson();
    let kinds: Vec<ElementKind> = gear.gear().mesh().blocks.iter().map(|b| b.kind).collect();
    let locks = kinds.iter().find(|kind| locks_from(**kind).is_some_and(|from| poisson >= from));
    let stiff = kinds.iter().find(|kind| matches!(kind, ElementKind::Tet4 | ElementKind::Wedge6));
    match (locks, stiff) {
        (Some(kind), _) => Some(remark::locking_elements(name, kind.name(), poisson)),
        (None, Some(kind)) => Some(remark::stiff_elements(name, kind.name())),
        (None, None) => None,
    }
}

/// Gears that give on the springs of their bores: how far along the transverse line of action, as rigid bodies under the mean
/// force.
///
/// ```text
/// F w' S^-1 w      w: force of 1 across the line of centres, with its axial part, at the pitch point of mid-face
/// ```
pub(crate) fn bore_remarks(model: &StaticModel, meshes: &[SceneMesh; 2], positions: &[StaticPosition]) -> Vec<Remark> {
    let (pair, options) = (model.pair(), model.options());
    let mean = positions.iter().map(|p| p.transmission_error).sum::<f64>() / positions.len().max(1) as f64;
    let force = options.torque / [&pair.pinion, &pair.wheel][options.driven()].base_radius().abs();
    let (alpha, axial) = (pair.working_pressure_angle(), pair.base_helix_angle().tan());
    let given = |i: usize| {
        // A bore that does not fit its springs was refused before.
        let springs = meshes[i].gear.rigid_springs().ok()??;
        let radius = pair.working_radii()[i].abs();
        let unit = Vector3::new(alpha.sin(), alpha.cos(), axial);
        let moment = Vector3::new(radius, 0.0, 0.0).cross(&unit);
        let wrench = Vector6::new(unit.x, unit.y, unit.z, moment.x, moment.y, moment.z);
        Some(force * wrench.dot(&springs.cholesky()?.solve(&wrench)))
    };
    let told = |i: usize| {
        let given = given(i).filter(|given| *given > HELD * mean)?;
        Some(remark::bore_gives(NAMES[i], 1e3 * given, 100.0 * given / mean))
    };
    (0..2).filter_map(told).collect()
}

/// Sum of the normal forces over what the torque asks for from which on flanks of both sides press at once. Levers of tips
/// that meet early, and nothing else, change it by some per cent; friction by its coefficient.
const JAMMED: f64 = 1.1;

/// Normal forces of a mesh whose flanks may touch on both sides, position by position.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PressedMesh {
    /// Sum of the normal forces, N.
    pub sum: f64,
    /// T / (r_b cos b_b): what the torque asks for, N.
    pub needed: f64,
}

/// Gears that jam: driving and coast flanks press against each other, and the teeth carry many times their load.
pub(crate) fn jam_remark(all: &[PressedMesh], friction: f64) -> Option<Remark> {
    let jammed = |p: &&PressedMesh| p.sum > (JAMMED + friction) * p.needed;
    let count = all.iter().filter(jammed).count();
    let worst = all.iter().filter(jammed).max_by(|a, b| a.sum.total_cmp(&b.sum))?;
    let times = if worst.needed > 0.0 { format!("{:.1} times", worst.sum / worst.needed) } else { "not".to_owned() };
    Some(remark::jammed(count, all.len(), worst.sum, times, worst.needed))
}

/// [`jam_remark`] of a pair at rest whose flanks may touch on both sides.
pub(crate) fn jammed_pair(positions: &[StaticPosition], pair: &GearPair, options: &StaticOptions) -> Option<Remark> {
    let driven = [&pair.pinion, &pair.wheel][options.driven()];
    let needed = options.torque.abs() / (driven.base_radius().abs() * pair.base_helix_angle().cos());
    let of = |p: &StaticPosition| PressedMesh { sum: p.pairs.iter().map(|q| q.normal_force).sum(), needed };
    let all: Vec<PressedMesh> = positions.iter().map(of).collect();
    options.contact.both_flanks.then(|| jam_remark(&all, options.contact.friction)).flatten()
}

/// Transmission error over the module from which on small deflections are doubtful; gears at their limits reach 0.02.
const LARGE_ERROR_MODULES: f64 = 0.05;

/// Approach over the round-off of places below which a result has fewer than three digits.
const FEW_DIGITS: f64 = 1e3;

/// What a solution says that a user should hear; module and centre distance in mm.
pub(crate) fn deflection_remarks(positions: &[StaticPosition], module: f64, centre_distance: f64) -> Vec<Remark> {
    let worst = |value: fn(&StaticPosition) -> f64| positions.iter().map(value).fold(0.0, f64::max);
    let mut said = Vec::new();
    let error = worst(|p| (p.transmission_error - p.kinematic_transmission_error).abs());
    let round_off = f64::EPSILON * centre_distance.abs();
    if worst(|p| p.strain_energy) > 0.0 && error < FEW_DIGITS * round_off {
        said.push(remark::light_load(error, round_off));
    }
    said.extend(large_error(error, (LARGE_ERROR_MODULES, module)));
    said
}

/// What is said of a transmission error that is too large for linear elasticity: over so many modules; both in mm.
pub(crate) fn large_error(error: f64, (most, module): (f64, f64)) -> Option<Remark> {
    (error > most * module).then(|| remark::large_deflection(error, module))
}
