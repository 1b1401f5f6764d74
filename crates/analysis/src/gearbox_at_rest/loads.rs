//! What the torques of a gearbox press on teeth and bearings, by equilibrium alone: judged before any work.

use gearbox::{GearboxError, Mesh, Operation, Structure, Train, mesh_torques};
use scene::{
    Driver,
    gearbox::{Gearbox, GearboxBearing, RollingKind},
};

use super::meshes::scene_of;
use crate::{
    AnalysisError,
    plausible::{Implausible, beyond, remarks},
};

/// The parts of a gearbox that is driven and loaded.
#[derive(Clone, Copy)]
pub(super) struct Loaded<'a> {
    pub file: &'a Gearbox,
    pub structure: &'a Structure,
    pub meshes: &'a [Mesh],
    pub train: &'a Train,
    pub operation: &'a Operation,
}

impl Loaded<'_> {
    /// Refuses torques that bend teeth by their own size, and thrust that no bearing takes; what is unlikely.
    ///
    /// # Errors
    /// [`AnalysisError::Implausible`]; [`GearboxError::OneWay`].
    pub fn judge(&self) -> Result<Vec<String>, AnalysisError> {
        let mut said = Vec::new();
        let torques = mesh_torques(self.structure, self.meshes, self.operation);
        for (i, mesh) in self.meshes.iter().enumerate() {
            let mut scene = scene_of(self.file, i, Some(&self.train.meshing()[i]));
            if let Some(all) = &torques {
                let driven = usize::from(scene.operation.driver == Driver::Pinion);
                scene.operation.torque_nm = 1e-3 * all[i][driven].abs();
                if let Some(found) = beyond(&scene, &mesh.pair) {
                    let (at, said) =
                        (self.file.file.display().to_string(), format!("mesh {}: {}", mesh.name, found.said));
                    let hint = format!("{} in [[torque]] or the scene of the mesh", found.hint);
                    return Err(AnalysisError::Implausible(Box::new(Implausible { at, excerpt: None, said, hint })));
                }
            }
            said.extend(remarks(&scene, &mesh.pair).into_iter().map(|own| format!("{}: {own}", mesh.name)));
        }
        if let Some(all) = torques {
            self.thrust(&all).map_err(|source| AnalysisError::Gearbox {
                file: self.file.file.display().to_string(),
                source: Box::new(source),
            })?;
        }
        Ok(said)
    }

    /// That the axial forces of the gears meet a bearing, shaft by shaft.
    ///
    /// ```text
    /// F_z = -T tan(beta) / r      of a gear: its flanks are the same after a turn along their helix
    /// ```
    fn thrust(&self, torques: &[[f64; 2]]) -> Result<(), GearboxError> {
        for (i, shaft) in self.file.shafts.iter().enumerate().filter(|(_, shaft)| !shaft.held) {
            let bearings = self.file.bearings.iter().filter(|b| b.shaft == i);
            let [plus, minus] = bearings.map(takes_thrust).fold([false; 2], |a, b| [a[0] || b[0], a[1] || b[1]]);
            // Neither way: said where bearings are counted. Two meshes with one shaft may hold it by their helices.
            if plus == minus || self.has_double_mesh(i) {
                continue;
            }
            let force = self.axial_force(i, torques);
            let (direction, taken) = if plus { ("-z", "+z") } else { ("+z", "-z") };
            let against = if plus { -force } else { force };
            if against > 0.0 {
                let force_n = against;
                return Err(GearboxError::OneWay { shaft: shaft.name.clone(), direction, taken, force_n });
            }
        }
        Ok(())
    }

    /// Axial force of all gears of a shaft, N.
    fn axial_force(&self, shaft: usize, torques: &[[f64; 2]]) -> f64 {
        let of = |(mesh, own): (&Mesh, &[f64; 2])| -> f64 {
            let gears = [&mesh.pair.pinion, &mesh.pair.wheel];
            let one = |end: usize| {
                let on = self.structure.discs[mesh.discs[end]].shaft == shaft;
                let lead = gears[end].data().helix_angle.tan() / gears[end].reference_radius();
                if on { -own[end] * lead } else { 0.0 }
            };
            one(0) + one(1)
        };
        self.meshes.iter().zip(torques).map(of).sum()
    }

    /// Whether two meshes join a shaft to the same other one.
    fn has_double_mesh(&self, shaft: usize) -> bool {
        let other = |mesh: &Mesh| {
            let [a, b] = mesh.discs.map(|disc| self.structure.discs[disc].shaft);
            if a == shaft { Some(b) } else { (b == shaft).then_some(a) }
        };
        let others: Vec<usize> = self.meshes.iter().filter_map(other).collect();
        others.iter().enumerate().any(|(i, one)| others[..i].contains(one))
    }
}

/// Whether a bearing takes thrust of its shaft towards +z, and towards -z.
fn takes_thrust(bearing: &GearboxBearing) -> [bool; 2] {
    let Some(rolling) = &bearing.rolling else { return [bearing.stiffness[2][2] > 0.0; 2] };
    match rolling.kind {
        RollingKind::DeepGrooveBall => [true; 2],
        RollingKind::CylindricalRoller => [false; 2],
        RollingKind::AngularContactBall | RollingKind::TaperedRoller => {
            [1.0, -1.0].map(|way| rolling.rows.iter().any(|row| row[1] == way))
        }
    }
}
