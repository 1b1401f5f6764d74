//! Whether the meshes of a gearbox will hold: each pair's rating under the torque and at the speed that it has here.

use answer::Remark;
use gearbox::{GearMesh, GearboxPosition, MeshState, Train};
use scene::{Driver, RatedGearScene, Scene, gearbox::Gearbox};

use super::{meshes::ReducedMesh, spectrum::SolvedSpectrum};
use crate::{AnalysisError, pair_rating::RatingHeadline, remark, solved_mesh::SolvedMesh};

/// The scene of a mesh with a torque on its driven gear, N mm, and the speed of its driver; `None` where it is not to be rated.
pub(super) fn rated_scene(file: &Gearbox, train: &Train, (mesh, scene): (usize, &Scene), torque: f64) -> Option<Scene> {
    let (asked, _) = (file.rating.as_ref()?, scene.rating.as_ref()?);
    let driver = usize::from(scene.operation.driver == Driver::Wheel);
    let shaft = file.gears[file.meshes[mesh].gears[driver]].shaft;
    let mut scene = scene.clone();
    scene.operation.torque_nm = 1e-3 * torque;
    scene.operation.speed_rpm = asked.speed_rpm * train.ratios()[shaft].abs();
    Some(scene)
}

/// Ratings of all meshes, and what is to be told of them; `None` of meshes that are not rated, or carry nothing.
///
/// # Errors
/// [`AnalysisError::Rating`], [`AnalysisError::Lumped`] where a standard has no value.
pub(super) fn ratings(
    (file, train): (&Gearbox, &Train),
    meshes: &[GearMesh],
    reduced: &[ReducedMesh],
    (positions, loads): (&[GearboxPosition], Option<&SolvedSpectrum>),
) -> Result<(Vec<Option<RatingHeadline>>, Vec<Remark>), AnalysisError> {
    let mut said = Vec::new();
    let mut one = |(i, mesh): (usize, &GearMesh)| {
        let states: Vec<&MeshState> = positions.iter().map(|p| &p.meshes[i]).collect();
        let solved = |scene: &Scene| SolvedMesh::of_mesh(scene, &states, train.meshing()[i].sense);
        let driven = reduced[i].options.driven();
        let torque = states.iter().map(|m| m.moment[driven][2]).sum::<f64>().abs() / states.len().max(1) as f64;
        let Some(mut scene) = rated_scene(file, train, (i, &reduced[i].scene), torque) else { return Ok(None) };
        let counted = count_meshes(file, i, &mut scene, positions);
        let unloaded = torque == 0.0 || scene.operation.speed_rpm == 0.0;
        let speed_ratio = scene.operation.speed_rpm / file.rating.as_ref().map_or(f64::NAN, |asked| asked.speed_rpm);
        let of_gearbox = loads.map(|own| own.of_mesh(i, speed_ratio));
        let spectrum = of_gearbox.as_ref().map(|(loads, solved)| (loads, *solved));
        let rating = match unloaded {
            true => None,
            false => RatingHeadline::of_solved(&scene, &mesh.pair, (&solved(&scene), spectrum))?,
        };
        match &rating {
            Some(own) => {
                let all = own.remarks().into_iter().chain(counted);
                said.extend(all.map(|own| own.about(&mesh.name)));
            }
            None => said.push(remark::rating_unloaded().about(&mesh.name)),
        }
        Ok(rating)
    };
    let named = |(i, mesh): (usize, &GearMesh)| {
        one((i, mesh)).map_err(|e: AnalysisError| e.of_part(format!("mesh {}", mesh.name)).in_file(&file.file))
    };
    let all = meshes.iter().enumerate().map(named).collect::<Result<Vec<_>, _>>()?;
    Ok((all, said))
}

/// Loads that the teeth of a gear have from all its meshes, beside those of one mesh.
#[derive(Debug, Clone, Copy)]
struct ToothLoads {
    /// Meshes of the gear that carry load.
    meshes: usize,
    /// Those of them that load the same flank.
    same_flank: u32,
    /// Largest load on the other flank over that of the mesh, at most 1.
    reversed: f64,
}

impl ToothLoads {
    /// Of a gear (0 or 1) of a mesh, by the mean moments about the axes: one sense is one flank.
    fn of(file: &Gearbox, (mesh, side): (usize, usize), positions: &[GearboxPosition]) -> Self {
        let gear = file.meshes[mesh].gears[side];
        let moment = |i: usize, side: usize| positions.iter().map(|p| p.meshes[i].moment[side][2]).sum::<f64>();
        let own = moment(mesh, side);
        let all: Vec<f64> = (file.meshes.iter().enumerate())
            .filter_map(|(i, other)| Some(moment(i, other.gears.iter().position(|g| *g == gear)?)))
            .filter(|moment| *moment != 0.0)
            .collect();
        let same = all.iter().filter(|moment| **moment * own > 0.0).count();
        let other = all.iter().filter(|moment| **moment * own < 0.0).map(|moment| (moment / own).abs());
        Self { meshes: all.len(), same_flank: same.max(1) as u32, reversed: other.fold(0.0, f64::max).min(1.0) }
    }
}

/// Gives the gears of a mesh the loads that their teeth have in other meshes, unless the scene states them; what is to be
/// told of it.
fn count_meshes(file: &Gearbox, mesh: usize, scene: &mut Scene, positions: &[GearboxPosition]) -> Vec<Remark> {
    let Some(rating) = &mut scene.rating else { return Vec::new() };
    let one = |(side, own): (usize, &mut RatedGearScene)| {
        let loads = ToothLoads::of(file, (mesh, side), positions);
        let is_stated = own.meshes_per_turn.is_some() || own.reversed_load_ratio.is_some();
        if loads.meshes < 2 || is_stated {
            return None;
        }
        own.meshes_per_turn = Some(loads.same_flank);
        own.reversed_load_ratio = Some(loads.reversed);
        let name = file.gears[file.meshes[mesh].gears[side]].name.as_str();
        Some(remark::rating_counts_meshes(name, loads.meshes, f64::from(loads.same_flank), loads.reversed))
    };
    [&mut rating.pinion, &mut rating.wheel].into_iter().enumerate().filter_map(one).collect()
}

/// Refuses meshes whose rating has no value, before any work, by the torques on their driven gears, N mm.
///
/// # Errors
/// As [`ratings`].
pub(super) fn check(
    (file, train): (&Gearbox, &Train),
    (i, mesh): (usize, &GearMesh),
    scene: &Scene,
    torque: f64,
) -> Result<(), AnalysisError> {
    let Some(scene) = rated_scene(file, train, (i, scene), torque).filter(|_| torque > 0.0) else { return Ok(()) };
    crate::pair_rating::check(&scene, &mesh.pair)
        .map_err(|e| e.of_part(format!("mesh {}", mesh.name)).in_file(&file.file))
}
