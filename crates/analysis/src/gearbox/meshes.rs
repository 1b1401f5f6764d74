//! The meshes of a gearbox: pairs as they run, their reduced gears, and their contact.

use crate::remark;
use answer::Remark;
use contact::Offset;
use std::sync::Arc;

use dynamics::{MeshFlanks, RigidBody};
use fem::Wanted;
use gearbox::{
    ExactMesh, GearMesh, GearboxError, GearboxPosition, MeshElement, MeshOfGears, MeshState, Meshing, Train, Vector12,
    motion::{MapRequest, MappedMesh, MovingExactMesh},
};
use ltca::{StaticModel, StaticOptions};
use reduction::{ElasticGear, GearModes, GearReducer};
use scene::{
    Scene,
    gearbox::{Gearbox, GearboxGear, GearboxMesh, MeshTiming},
};

use crate::{
    AnalysisError, GearCache, NoObserver, Progress, SharedModels,
    contact_maps::{map_teller, map_words, pitch_errors_told},
    error::failed_modes,
    gear_dofs, gears,
    inputs::resolved_scene,
    meshes::SceneMesh,
    motion::{QuasiStatic, body},
    options::options,
    reduced_pairs::ReducedPair,
    solution_remarks::{PressedMesh, jam_remark},
};

/// Pairs before it is known which way they turn.
pub(super) fn pairs(file: &Gearbox) -> Result<Vec<GearMesh>, AnalysisError> {
    file.meshes.iter().map(|own| mesh(own, &own.scene)).collect()
}

/// A mesh with the shape that its scene says.
pub(super) fn mesh(own: &GearboxMesh, scene: &Scene) -> Result<GearMesh, AnalysisError> {
    Ok(GearMesh { name: own.name.clone(), discs: own.gears, pair: scene.gear_pair()? })
}

/// The scenes of all meshes as they run: driver and rotation, and slices where these are to be settled.
pub(super) fn running(file: &Gearbox, train: &Train, slices: bool) -> Vec<Scene> {
    let one = |(i, (own, meshing)): (usize, (&GearboxMesh, &Meshing))| {
        let mut scene = own.scene.clone();
        // A mesh that closes a ring of gears counts their teeth from another one on, and bolts stay where they are.
        let [pinion, wheel] = train.counted_from(i).map(f64::to_degrees);
        let bolts = [(&mut scene.pinion.bore.bolts, pinion), (&mut scene.wheel.bore.bolts, wheel)];
        for (bolts, counted_from) in bolts {
            bolts.iter_mut().for_each(|bolts| bolts.first_angle_deg -= counted_from);
        }
        (scene.operation.driver, scene.operation.rotation) = (meshing.driver, meshing.sense);
        // Slices follow the flanks that press.
        if slices { resolved_scene(&scene, false) } else { scene }
    };
    file.meshes.iter().zip(train.meshing()).enumerate().map(one).collect()
}

/// How far the wheel of each mesh stands off where its flanks touch, rad.
pub(super) fn wheel_turns(file: &Gearbox, train: &Train) -> Vec<f64> {
    let one = |(own, meshing): (&GearboxMesh, &Meshing)| match own.timing {
        MeshTiming::Touching => 0.0,
        MeshTiming::Keyed => 0.0 - meshing.timing,
    };
    file.meshes.iter().zip(train.meshing()).map(one).collect()
}

/// Solves with the windows of the meshes as they are, and again with one more tooth where one of them starves.
pub(super) fn widening<T>(
    meshes: &[GearMesh],
    reduced: &mut [ReducedMesh],
    models: &SharedModels<'_>,
    remarks: &mut Vec<Remark>,
    mut solve: impl FnMut(&[ReducedMesh]) -> Result<T, AnalysisError>,
) -> Result<T, AnalysisError> {
    loop {
        let error = match solve(reduced) {
            Ok(solved) => return Ok(solved),
            Err(error) => error,
        };
        let starved = match error.what() {
            AnalysisError::Gearbox(source) => source.starved_mesh(),
            _ => None,
        };
        let which = starved.and_then(|name| meshes.iter().position(|m| m.name == name));
        let Some(i) = which else { return Err(error) };
        if !reduced[i].widen(&meshes[i], models)? {
            return Err(error);
        }
        remarks.push(remark::window_widened(error.to_string(), reduced[i].window()));
    }
}

/// How far from its seat a bore may be held before it is told, over the face width.
const OFF_SEAT: f64 = 0.05;

/// The gears of a mesh, reduced.
pub(super) struct ReducedMesh {
    pub scene: Scene,
    pub options: StaticOptions,
    pair: Arc<ReducedPair>,
    /// What the user should hear of them.
    pub remarks: Vec<Remark>,
}

impl ReducedMesh {
    /// `wheel_turn` is the angle between the wheel and the position in which the flanks touch, rad.
    pub fn new(
        scene: Scene,
        (mesh, wheel_turn): (&GearMesh, f64),
        (models, progress): (&SharedModels<'_>, &dyn Progress),
    ) -> Result<Self, AnalysisError> {
        let options = options(&scene, &mesh.pair).with_contact(|contact| contact.wheel_turn = wheel_turn);
        let pair = models.pairs.of(&scene, &mesh.pair, &options, (models.cache(), progress, &|| true))?;
        let of_meshes = pair.meshes.iter().flat_map(|m| &m.remarks).chain(&pair.remarks).cloned();
        let remarks = gears::remarks(&mesh.pair).into_iter().chain(of_meshes);
        let remarks = remarks.map(|said| said.about(&mesh.name)).collect();
        Ok(Self { scene, options, pair, remarks })
    }

    /// Remark if the held part of a bore is about another cross-section than the gear's seat: the shaft would act on it
    /// with a lever that does not exist.
    pub fn seats(&self, file: &Gearbox, i: usize) -> Vec<Remark> {
        let width = self.scene.pair.face_width_mm;
        let gears =
            file.meshes[i].gears.into_iter().zip(&self.pair.meshes).map(|(gear, mesh)| (&file.gears[gear], mesh));
        let one = |(gear, mesh): (&GearboxGear, &SceneMesh)| {
            let weights = mesh.gear.bore_weights();
            let z = |n: u32| mesh.gear.mesh().nodes[n as usize][2];
            let area: f64 = weights.iter().map(|(_, w)| w).sum();
            let held = weights.iter().map(|&(n, w)| w * z(n)).sum::<f64>() / area;
            let seat = gear.seat - gear.position;
            let apart = !file.shafts[gear.shaft].held && (held - seat).abs() > OFF_SEAT * width;
            apart.then(|| remark::seat_elsewhere(&*gear.name, held, seat, gear.position + held))
        };
        gears.filter_map(one).collect()
    }

    /// Remark about a mesh whose flanks are in contact on both sides at once.
    pub fn jammed(&self, i: usize, mesh: &GearMesh, positions: &[GearboxPosition]) -> Option<Remark> {
        let contact = &self.options.contact;
        let lever = mesh.pair.wheel.base_radius().abs() * mesh.pair.base_helix_angle().cos();
        let of = |p: &GearboxPosition| {
            let MeshState { normal_force, moment, .. } = &p.meshes[i];
            PressedMesh { sum: *normal_force, needed: moment[1][2].abs() / lever }
        };
        let all: Vec<PressedMesh> = positions.iter().map(of).collect();
        let said = contact.both_flanks.then(|| jam_remark(&all, contact.friction)).flatten()?;
        Some(said.about(&mesh.name))
    }

    /// Whether its gears are reduced for both flanks, and these may touch.
    pub fn has_coast_flanks(&self) -> bool {
        self.options.contact.both_flanks
    }

    /// Its contact with rotation and load reversed: on the coast flanks.
    pub fn turned_round(
        &self,
        mesh: &GearMesh,
        (meshing, wheel_turn): (&Meshing, f64),
    ) -> Result<Box<dyn MeshElement>, GearboxError> {
        let options = self.options.clone().with_contact(|contact| {
            (contact.driver, contact.sense, contact.wheel_turn) = (meshing.driver, meshing.sense, wheel_turn);
        });
        Ok(Box::new(ExactMesh::new(mesh.pair.clone(), self.gears(), options)?))
    }

    /// Its contact, beside those of other meshes that stand on the same gears: what these have in common is made once.
    pub fn element(
        &self,
        mesh: &GearMesh,
        common: &mut Vec<(Arc<ReducedPair>, MeshOfGears)>,
    ) -> Result<Box<dyn MeshElement>, GearboxError> {
        let known = common.iter().find(|(pair, _)| Arc::ptr_eq(pair, &self.pair)).map(|(_, own)| own);
        let is_known = known.is_some();
        let own = ExactMesh::beside(known, mesh.pair.clone(), self.gears(), self.options.clone())?;
        if !is_known {
            common.push((Arc::clone(&self.pair), own.of_gears()));
        }
        Ok(Box::new(own))
    }

    /// Contact of the mesh, with the elastic modes of its gears.
    pub fn with_modes(
        &self,
        mesh: &GearMesh,
        modes: [Arc<GearModes>; 2],
    ) -> Result<Box<dyn MeshElement>, GearboxError> {
        Ok(Box::new(self.exact(mesh)?.with_modes(modes)?))
    }

    /// Lowest elastic frequency of both gears, with bore held and flanks free, Hz; infinite for gears that are not
    /// reduced.
    ///
    /// # Errors
    /// [`AnalysisError::Reduction`].
    pub fn lowest_hz(&self) -> Result<[f64; 2], AnalysisError> {
        let of = |i: usize| {
            let found =
                gear_dofs::reduced(&self.pair.gears[i]).map_or(Ok(f64::INFINITY), GearReducer::lowest_elastic_hz);
            found.map_err(|e| failed_modes(&self.scene, i, e))
        };
        Ok([of(0)?, of(1)?])
    }

    /// Gears of the mesh.
    pub fn gears(&self) -> Arc<[ElasticGear; 2]> {
        Arc::clone(&self.pair.gears)
    }

    /// Contact of the mesh as its concrete type.
    pub fn exact(&self, mesh: &GearMesh) -> Result<ExactMesh, GearboxError> {
        ExactMesh::new(mesh.pair.clone(), Arc::clone(&self.pair.gears), self.options.clone())
    }

    /// The contact as a mesh in motion, with a damper (N s/mm per mm) on its contact lines, including the coast flanks
    /// if the gears are reduced for both.
    pub fn moving(&self, mesh: &GearMesh, damping_per_length: f64) -> Result<MovingExactMesh, GearboxError> {
        let gears = &self.pair.gears;
        let coast = self.has_coast_flanks().then(|| Arc::clone(gears));
        // Rows have no stress of fillets.
        let options = StaticOptions { root_stress: false, ..self.options.clone() };
        MovingExactMesh::new(mesh.pair.clone(), Arc::clone(gears), coast, &options, damping_per_length)
    }

    /// The mesh alone through its own static cycle: `torque` (N mm) on the driven gear, axes displaced by `about` in
    /// the mesh's own axes.
    pub fn cycle(
        &self,
        mesh: &GearMesh,
        torque: f64,
        about: &Vector12,
        positions: u32,
    ) -> Result<QuasiStatic, AnalysisError> {
        let options = StaticOptions { torque, ..self.options.clone() }.with_contact(|contact| {
            contact.both_flanks = false;
            for (gear, offset) in contact.offsets.iter_mut().enumerate() {
                let [x, y, z, tilt_x, tilt_y] = std::array::from_fn(|i| about[6 * gear + i]);
                *offset = Offset {
                    x: offset.x + x,
                    y: offset.y + y,
                    z: offset.z + z,
                    tilt_x: offset.tilt_x + tilt_x,
                    tilt_y: offset.tilt_y + tilt_y,
                };
            }
        });
        let named =
            |source| GearboxError::AtMesh { mesh: mesh.name.clone(), source: Box::new(GearboxError::from(source)) };
        let made = StaticModel::new(mesh.pair.clone(), Arc::clone(&self.pair.gears), options);
        let history = made.and_then(|mut model| model.run(positions as usize, 1, |_, _, _| ())).map_err(named)?;
        Ok(QuasiStatic::of(&history))
    }

    /// The contact as a map, from the cache or computed; remarks are about files of the cache.
    pub fn map(
        &self,
        mesh: &GearMesh,
        request: &MapRequest,
        (cache, progress, remarks): (&dyn GearCache, &dyn Progress, &mut Vec<Remark>),
    ) -> Result<MappedMesh, GearboxError> {
        let turn = self.options.contact.wheel_turn;
        let coast = self.has_coast_flanks().then(|| self.gears());
        let options = self.options.clone().with_contact(|contact| contact.both_flanks = false);
        let flanks = MeshFlanks::new(&mesh.pair, self.gears(), coast, &options, 0.0)?;
        let key =
            cache.is_on().then(|| self.pair.map_key(&map_words(&self.scene, &mesh.pair, &(request, turn)))).flatten();
        let known = key.as_ref().and_then(|key| {
            let (kept, said) = cache.load_maps(key);
            remarks.extend(said);
            kept.and_then(|kept| kept.of(key))
        });
        let made = match known.map(|maps| MappedMesh::on(&flanks, &mesh.pair, request, maps)) {
            Some(Ok(known)) => known,
            _ => {
                let of = format!("{}: ", mesh.name);
                let made = MappedMesh::new(&flanks, &mesh.pair, request, &map_teller(progress, &of))?;
                remarks.extend(key.and_then(|key| cache.save_maps(&key, &made.maps().collect::<Vec<_>>())));
                made
            }
        };
        let found = made.pitch_error(&flanks, &mesh.pair, request)?;
        let told = found.zip(made.maps().next()).map(|(error, map)| pitch_errors_told(&error, map).about(&mesh.name));
        remarks.extend(told);
        Ok(made)
    }

    /// Mass and inertia of a gear: those of its mesh, unless the scene of the pair gives others.
    pub fn body(&self, gear: usize) -> Result<RigidBody, AnalysisError> {
        let stated = self.scene.gears()[gear].body.clone().unwrap_or_default();
        body(&self.scene, &self.pair.meshes, &stated, gear)
    }

    /// Number of teeth of its window.
    pub fn window(&self) -> usize {
        self.options.window.unwrap_or_default()
    }

    /// Reduces the gears again with one more tooth in the window; returns whether there was one.
    pub fn widen(&mut self, mesh: &GearMesh, models: &SharedModels<'_>) -> Result<bool, AnalysisError> {
        let teeth = self.options.window_teeth(&mesh.pair) + 1;
        let room = self.pair.meshes.iter().all(|m| {
            let there = if m.gear.is_periodic_sector() { m.gear.tooth_count() as usize } else { m.gear.teeth().len() };
            teeth < there
        });
        if self.scene.analysis.window_teeth.is_some() || !room {
            return Ok(false);
        }
        self.options.window = Some(teeth);
        let waiting = (models.cache() as &dyn GearCache, &NoObserver as &dyn Progress, &(|| true) as Wanted<'_>);
        self.pair = models.pairs.of(&self.scene, &mesh.pair, &self.options, waiting)?;
        Ok(true)
    }

    /// Stores the gears for later runs; returns remarks about write errors.
    pub fn save(&self, cache: &dyn GearCache) -> Vec<Remark> {
        self.pair.save(cache)
    }
}
