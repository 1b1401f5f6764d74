//! Checks that meshes carry load: without load the position of the teeth is undefined.

use toml::Spanned;

use super::{
    file::{GearboxGear, GearboxInput, GearboxMesh, GearboxShaft, GearboxTorque},
    schema::RawMesh,
    values::Checked,
};
use crate::Source;

/// No two meshes of the same gears.
pub(super) fn apart(s: &Source<'_>, tables: &[Spanned<RawMesh>], meshes: &[GearboxMesh]) -> Checked<()> {
    for (i, mesh) in meshes.iter().enumerate() {
        let [a, b] = mesh.gears;
        if let Some(first) = meshes[..i].iter().find(|m| m.gears == [a, b] || m.gears == [b, a]) {
            let said = format!("the meshes \"{}\" and \"{}\" have the same gears", first.name, mesh.name);
            return Err(s.conflict(&tables[i].span(), said, "two gears mesh once: leave one out"));
        }
    }
    Ok(())
}

/// Every mesh without which some shafts are not driven has a load beyond it.
pub(super) fn loaded(
    s: &Source<'_>,
    tables: &[Spanned<RawMesh>],
    (meshes, gears, shafts): (&[GearboxMesh], &[GearboxGear], &[GearboxShaft]),
    (input, torques): (&GearboxInput, &[GearboxTorque]),
) -> Checked<()> {
    // What is fixed in space takes a torque; a carrier has no meshes of its own.
    let fixed = shafts.iter().position(|shaft| shaft.fixed);
    let from = fixed.filter(|_| shafts[input.shaft].stands).unwrap_or(input.shaft);
    let ends = |m: &GearboxMesh| m.gears.map(|g| gears[g].shaft);
    // Shafts that the input reaches by all meshes but one.
    let reached = |without: Option<usize>| {
        let mut all = vec![from];
        let mut at = 0;
        while let Some(&shaft) = all.get(at) {
            for (_, mesh) in meshes.iter().enumerate().filter(|(k, _)| Some(*k) != without) {
                let [a, b] = ends(mesh);
                for (from, to) in [(a, b), (b, a)] {
                    if from == shaft && !all.contains(&to) {
                        all.push(to);
                    }
                }
            }
            at += 1;
        }
        all
    };
    let driven = reached(None);
    // Meshes on several ways of the power, as of planets, are none of them alone.
    let unloaded = torques.iter().all(|t| t.torque == 0.0);
    for (i, mesh) in meshes.iter().enumerate() {
        let still = reached(Some(i));
        let beyond = |shaft: &usize| driven.contains(shaft) && !still.contains(shaft);
        let alone = driven.iter().any(&beyond);
        let mut takers = torques.iter().filter(|t| t.torque > 0.0).map(|t| t.shaft).chain(fixed);
        if unloaded || alone && !takers.any(|shaft| beyond(&shaft)) {
            let said = format!("the mesh \"{}\" carries no load: no torque acts on the shafts beyond it", mesh.name);
            let advice =
                "load them, as [[torque]] with `shaft`, `position_mm` and `torque_nm` above 0; or leave the mesh out";
            return Err(s.conflict(&tables[i].span(), said, advice));
        }
    }
    Ok(())
}
