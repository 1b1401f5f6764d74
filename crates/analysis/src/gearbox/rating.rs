//! Rating of the meshes of a gearbox: that of each pair under its torque and at its speed.

use answer::Remark;
use gearbox::{GearMesh, GearboxPosition, MeshBears, MeshState, Train};
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
    let bears = MeshBears::of(positions);
    let mut one = |(i, mesh): (usize, &GearMesh)| {
        let states: Vec<&MeshState> = positions.iter().map(|p| &p.meshes[i]).collect();
        let solved = |scene: &Scene| SolvedMesh::of_mesh(scene, &states, train.meshing()[i].sense);
        let driven = reduced[i].options.driven();
        let torque = bears.mean(i, driven).abs();
        let Some(mut scene) = rated_scene(file, train, (i, &reduced[i].scene), torque) else { return Ok(None) };
        let counted = count_meshes(file, i, &mut scene, &bears);
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
    /// Meshes that load the same flank with half of the load of the mesh or more: with less they count for little.
    same_flank: u32,
    /// Largest load on the other flank over that of the mesh, at most 1.
    reversed: f64,
}

impl ToothLoads {
    /// Of a gear (0 or 1) of a mesh, by the mean moments about the axes: one sense is one flank.
    fn of(file: &Gearbox, (mesh, side): (usize, usize), bears: &MeshBears) -> Self {
        let gear = file.meshes[mesh].gears[side];
        let own = bears.mean(mesh, side);
        let of_others = (file.meshes.iter().enumerate())
            .filter_map(|(i, other)| Some(bears.mean(i, other.gears.iter().position(|g| *g == gear)?)));
        // Over that of the mesh, below 0 on the other flank.
        let shares: Vec<f64> = of_others.filter(|_| own != 0.0).map(|moment| moment / own).collect();
        let same = shares.iter().filter(|share| **share >= 0.5).count();
        let reversed = shares.iter().fold(0.0, |most: f64, share| most.max(-share)).min(1.0);
        Self { same_flank: same.max(1) as u32, reversed }
    }
}

/// Gives the gears of a mesh the loads that their teeth have in all meshes, unless the scene states them; what is to be told
/// of numbers that are stated too small.
fn count_meshes(file: &Gearbox, mesh: usize, scene: &mut Scene, bears: &MeshBears) -> Vec<Remark> {
    let Some(rating) = &mut scene.rating else { return Vec::new() };
    let one = |(side, own): (usize, &mut RatedGearScene)| {
        let ToothLoads { same_flank, reversed } = ToothLoads::of(file, (mesh, side), bears);
        let stated_times = *own.meshes_per_turn.get_or_insert(same_flank);
        let stated_reversed = *own.reversed_load_ratio.get_or_insert(reversed);
        let name = file.gears[file.meshes[mesh].gears[side]].name.as_str();
        (stated_times < same_flank || stated_reversed < reversed - 1e-3)
            .then(|| remark::rating_states_few_loads(name, f64::from(same_flank), reversed))
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
