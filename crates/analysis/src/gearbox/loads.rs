//! Loads of teeth and bearings caused by the torques of a gearbox, from equilibrium alone; checked before the solution.

use gearbox::{GearMesh, GearboxError, Operation, Structure, Train, even_mesh_torques, mesh_torques};
use scene::{
    Driver, Scene,
    gearbox::{Gearbox, GearboxBearing, RollingKind},
    units::{OtherUnit, in_another_unit},
};

use crate::{
    AnalysisError,
    plausible::{beyond, remarks},
    refused::Refusal,
};

/// Slope of balls under a radial load over that of their nominal contact angle, at the least.
const BALLS: f64 = 0.5;

/// The parts of a gearbox that is driven and loaded.
#[derive(Clone, Copy)]
pub(super) struct Loaded<'a> {
    pub file: &'a Gearbox,
    pub scenes: &'a [Scene],
    pub structure: &'a Structure,
    pub meshes: &'a [GearMesh],
    pub train: &'a Train,
    pub operation: &'a Operation,
}

impl Loaded<'_> {
    /// Rejects torques that would deflect teeth by their own size, and thrust that no bearing takes. Returns remarks
    /// about unlikely values.
    ///
    /// # Errors
    /// [`AnalysisError::Refused`]; [`GearboxError::OneWay`].
    pub fn judge(&self) -> Result<Vec<answer::Remark>, AnalysisError> {
        let mut said = Vec::new();
        let torques = mesh_torques(self.structure, self.meshes, self.operation);
        let even = match &torques {
            Some(_) => None,
            None => even_mesh_torques(self.structure, self.meshes, self.operation),
        };
        for (i, (mesh, scene)) in self.meshes.iter().zip(self.scenes).enumerate() {
            let mut scene = scene.clone();
            if let Some(all) = torques.as_ref().or(even.as_ref()) {
                let driven = usize::from(scene.operation.driver == Driver::Pinion);
                super::rating::check((self.file, self.train), (i, mesh), &scene, all[i][driven].abs())?;
                scene.operation.torque_nm = 1e-3 * all[i][driven].abs();
                if let Some(found) = beyond(&scene, &mesh.pair) {
                    let hint = match self.in_n_m().filter(|_| found.in_n_mm) {
                        Some(other) => format!("{}: write `torque_nm = {}` in [[torque]]", other.said, other.value),
                        None => found.hint,
                    };
                    let error = AnalysisError::from(Refusal::input(found.said, hint));
                    return Err(error.of_part(format!("mesh {}", mesh.name)).in_file(&self.file.file));
                }
            }
            said.extend(remarks(&scene, &mesh.pair).into_iter().map(|own| own.about(&mesh.name)));
        }
        if let Some(all) = torques {
            self.thrust(&all).map_err(|source| AnalysisError::from(source).in_file(&self.file.file))?;
        }
        Ok(said)
    }

    /// The largest torque of the file as if it were in N mm.
    fn in_n_m(&self) -> Option<OtherUnit> {
        let largest = self.file.torques.iter().map(|t| 1e-3 * t.torque).fold(0.0, f64::max);
        in_another_unit("torque_nm", largest, |x| x > 0.0)
    }

    /// Checks that the axial forces of the gears, and those of bearings that stand at an angle to their radial load, meet a bearing,
    /// shaft by shaft.
    ///
    /// ```text
    /// F_z = -T tan(beta) / |r|     of a gear: its flanks are the same after a turn along their helix
    /// F_a >= F_r tan(alpha)        of rollers at the contact angle alpha under F_r; balls may stand at a lesser one
    /// ```
    fn thrust(&self, torques: &[[f64; 2]]) -> Result<(), GearboxError> {
        for (i, shaft) in self.file.shafts.iter().enumerate().filter(|(_, shaft)| !shaft.held) {
            let bearings = || self.file.bearings.iter().filter(|b| b.shaft == i);
            let [plus, minus] = bearings().map(takes_thrust).fold([false; 2], |a, b| [a[0] || b[0], a[1] || b[1]]);
            // Neither way: said where bearings are counted. Two meshes with one shaft may hold it by their helices.
            if plus == minus || self.has_double_mesh(i) {
                continue;
            }
            let [x, y, z] = self.force(i, torques);
            let slope = bearings().filter_map(least_slope).fold(f64::INFINITY, f64::min);
            // Where another bearing shares the radial load nobody knows how much of it is left for these.
            let alone = bearings().all(|b| takes_thrust(b) != [false; 2]);
            let from_rolling = if alone { x.hypot(y) * slope } else { 0.0 };
            let (direction, taken, pressing) = if plus { ("-z", "+z", z) } else { ("+z", "-z", -z) };
            let left = from_rolling - pressing;
            if left > 0.0 {
                let by =
                    if pressing < 0.0 { "its gears press" } else { "its radial load on raceways at an angle presses" };
                return Err(GearboxError::OneWay { shaft: shaft.name.clone(), direction, taken, by, force_n: left });
            }
        }
        Ok(())
    }

    /// Force of all gears on a shaft, N.
    ///
    /// ```text
    /// T = r_w F_t,   F_r = |F_t| tan a_wt away from the mating gear,   F_z as above
    /// ```
    fn force(&self, shaft: usize, torques: &[[f64; 2]]) -> [f64; 3] {
        let mut all = [0.0; 3];
        for ((mesh, meshing), own) in self.meshes.iter().zip(self.train.meshing()).zip(torques) {
            let gears = [&mesh.pair.pinion, &mesh.pair.wheel];
            for end in (0..2).filter(|end| self.structure.discs[mesh.discs[*end]].shaft == shaft) {
                // From this gear's axis to the contact; of a ring the other way, as its radius is below zero.
                let (sin, cos) = meshing.direction.sin_cos();
                let [ex, ey] = if end == 0 { [cos, sin] } else { [-cos, -sin] };
                let tangential = own[end] / mesh.pair.working_radii()[end];
                let radial = tangential.abs() * mesh.pair.working_pressure_angle().tan();
                all[0] -= ey * tangential + ex * radial;
                all[1] += ex * tangential - ey * radial;
                all[2] -= own[end] * gears[end].data().helix_angle.tan() / gears[end].reference_radius().abs();
            }
        }
        all
    }

    /// Whether two meshes join a shaft to the same other one.
    fn has_double_mesh(&self, shaft: usize) -> bool {
        let other = |mesh: &GearMesh| {
            let [a, b] = mesh.discs.map(|disc| self.structure.discs[disc].shaft);
            if a == shaft { Some(b) } else { (b == shaft).then_some(a) }
        };
        let others: Vec<usize> = self.meshes.iter().filter_map(other).collect();
        others.iter().enumerate().any(|(i, one)| others[..i].contains(one))
    }
}

/// Axial over radial force of a bearing whose rows stand at an angle, at the least; `None` of others.
fn least_slope(bearing: &GearboxBearing) -> Option<f64> {
    let own = bearing.rolling.as_ref()?;
    match own.kind {
        RollingKind::TaperedRoller => Some(own.contact_angle.tan()),
        RollingKind::AngularContactBall => Some(BALLS * own.contact_angle.tan()),
        RollingKind::DeepGrooveBall | RollingKind::CylindricalRoller => None,
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
