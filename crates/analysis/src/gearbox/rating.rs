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
        let Some(scene) = rated_scene(file, train, (i, &reduced[i].scene), torque) else { return Ok(None) };
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
                let all = own.remarks().into_iter().chain(counted_once(file, i, &scene, positions));
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

/// Gears of a mesh that work in others as well, and are rated as if they did not.
fn counted_once(file: &Gearbox, mesh: usize, scene: &Scene, positions: &[GearboxPosition]) -> Vec<Remark> {
    let works = |i: usize| positions.iter().any(|p| p.meshes[i].normal_force > 0.0);
    let rated = scene.rating.iter().flat_map(|rating| rating.gears());
    let one = |(rated, gear): (&RatedGearScene, usize)| {
        let meshes = (0..file.meshes.len()).filter(|i| file.meshes[*i].gears.contains(&gear) && works(*i)).count();
        let once = rated.meshes_per_turn == 1 && rated.reversed_load_ratio == 0.0;
        (meshes > 1 && once).then(|| remark::rating_counts_one_mesh(file.gears[gear].name.as_str(), meshes))
    };
    rated.zip(file.meshes[mesh].gears).filter_map(one).collect()
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
