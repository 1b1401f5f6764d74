//! The meshes of a gearbox: pairs as they run, their reduced gears, and the contact of each.

use crate::remark;
use answer::Remark;
use std::sync::Arc;

use dynamics::RigidBody;
use gearbox::{
    ExactMesh, GearboxError, GearboxPosition, Mesh, MeshElement, MeshState, Meshing, Train,
    motion::{MapRequest, MappedMesh, MovingExactMesh},
};
use geometry::Sense;
use ltca::StaticOptions;
use reduction::ElasticGear;
use scene::{
    Driver, Rotation, Scene,
    gearbox::{Gearbox, GearboxGear},
};

use crate::{
    AnalysisError, GearCache, NoObserver, Progress,
    elastic_gears::{ElasticGears, RecordKeys, elastic_gears},
    gears,
    inputs::{meshes_of, settled_scene},
    meshes::SceneMesh,
    motion::body,
    options::options,
    warnings::{PressedMesh, jam_warning},
};

/// The scene of a mesh with the axes where the shafts have them, and, once it is known, as the mesh runs.
pub(super) fn scene_of(file: &Gearbox, mesh: usize, meshing: Option<&Meshing>) -> Scene {
    let own = &file.meshes[mesh];
    let mut scene = own.scene.clone();
    let [a, b] = own.gears.map(|g| file.shafts[file.gears[g].shaft].origin);
    let apart = (b[0] - a[0]).hypot(b[1] - a[1]);
    // A stated distance stands, and is held against that of the shafts; digits of a file are no difference.
    if scene.pair.centre_distance_mm.is_none_or(|stated| (stated - apart).abs() < 1e-6 * apart) {
        scene.pair.centre_distance_mm = Some(apart);
    }
    // What the scene states of it was held against this where the file was read.
    scene.pair.mid_face_offset_mm = file.mid_face_offset(own.gears);
    if let Some(meshing) = meshing {
        scene.operation.driver = match meshing.driver {
            geometry::Driver::Pinion => Driver::Pinion,
            geometry::Driver::Wheel => Driver::Wheel,
        };
        scene.operation.rotation = match meshing.sense {
            Sense::Ccw => Rotation::Ccw,
            Sense::Cw => Rotation::Cw,
        };
    }
    settled_scene(&scene, false)
}

/// All meshes.
pub(super) fn meshes(file: &Gearbox, train: Option<&Train>) -> Result<Vec<Mesh>, AnalysisError> {
    let one = |i: usize| {
        let pair = scene_of(file, i, train.map(|t| &t.meshing()[i])).gear_pair()?;
        let own = &file.meshes[i];
        Ok(Mesh { name: own.name.clone(), discs: own.gears, pair })
    };
    (0..file.meshes.len()).map(one).collect()
}

/// Solves with the windows of the meshes as they are, and again with one more tooth where one of them starves.
pub(super) fn widening<T>(
    (file, meshes): (&Gearbox, &[Mesh]),
    reduced: &mut [ReducedMesh],
    cache: &dyn GearCache,
    warnings: &mut Vec<Remark>,
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
        if !reduced[i].widen(file, i, &meshes[i], cache)? {
            return Err(error);
        }
        warnings.push(remark::window_widened(error.to_string(), reduced[i].window()));
    }
}

/// How far from its seat a bore may be held before it is told, over the face width.
const OFF_SEAT: f64 = 0.05;

/// The gears of a mesh, reduced.
pub(super) struct ReducedMesh {
    pub scene: Scene,
    pub options: StaticOptions,
    meshes: [SceneMesh; 2],
    gears: Arc<[ElasticGear; 2]>,
    keys: RecordKeys,
    /// What the user should hear of them.
    pub warnings: Vec<Remark>,
}

impl ReducedMesh {
    pub fn new(
        file: &Gearbox,
        i: usize,
        meshing: &Meshing,
        mesh: &Mesh,
        (cache, progress): (&dyn GearCache, &dyn Progress),
    ) -> Result<Self, AnalysisError> {
        let scene = scene_of(file, i, Some(meshing));
        let meshes = meshes_of(&scene, &mesh.pair, None)?;
        let options = options(&scene, &mesh.pair);
        let ElasticGears { gears, keys, warnings } =
            elastic_gears(&scene, &mesh.pair, &options, &meshes, (cache, progress, &|| true))?;
        let of_pair = gears::warnings(&mesh.pair).into_iter().chain(meshes.iter().flat_map(|m| m.warnings.clone()));
        let warnings = of_pair.chain(warnings).map(|said| said.about(&mesh.name)).collect();
        Ok(Self { scene, options, meshes, gears: Arc::new(gears), keys, warnings })
    }

    /// What is held of the bores, where that is about another cross-section than the gear's seat: a shaft would take
    /// hold of it by a lever that is not there.
    pub fn seats(&self, file: &Gearbox, i: usize) -> Vec<Remark> {
        let width = self.scene.pair.face_width_mm;
        let gears = file.meshes[i].gears.into_iter().zip(&self.meshes).map(|(gear, mesh)| (&file.gears[gear], mesh));
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

    /// What is said of a mesh whose flanks press on both sides at once.
    pub fn jammed(&self, i: usize, mesh: &Mesh, positions: &[GearboxPosition]) -> Option<Remark> {
        let contact = &self.options.contact;
        let lever = mesh.pair.wheel.base_radius() * mesh.pair.base_helix_angle().cos();
        let of = |p: &GearboxPosition| {
            let MeshState { normal_force, moment, .. } = &p.meshes[i];
            PressedMesh { sum: *normal_force, needed: moment[1][2].abs() / lever }
        };
        let all: Vec<PressedMesh> = positions.iter().map(of).collect();
        let said = contact.both_flanks.then(|| jam_warning(&all, contact.friction)).flatten()?;
        Some(said.about(&mesh.name))
    }

    /// Its contact.
    pub fn element(&self, mesh: &Mesh) -> Result<Box<dyn MeshElement>, GearboxError> {
        Ok(Box::new(self.exact(mesh)?))
    }

    /// The same, as itself.
    pub fn exact(&self, mesh: &Mesh) -> Result<ExactMesh, GearboxError> {
        ExactMesh::new(mesh.pair.clone(), Arc::clone(&self.gears), self.options.clone())
    }

    /// The contact as a mesh in motion, with a damper along the normal (N s/mm).
    pub fn moving(&self, mesh: &Mesh, damping: f64) -> Result<MovingExactMesh, GearboxError> {
        Ok(MovingExactMesh::new(self.exact(mesh)?, damping))
    }

    /// A map of the contact.
    pub fn map(&self, mesh: &Mesh, request: &MapRequest) -> Result<MappedMesh, GearboxError> {
        MappedMesh::new(&mesh.pair, &self.gears, &self.options, request)
    }

    /// Mass and inertia of a gear: of its mesh, unless the scene of the pair states others.
    pub fn body(&self, gear: usize) -> Result<RigidBody, AnalysisError> {
        let stated = self.scene.gears()[gear].body.clone().unwrap_or_default();
        body(&self.scene, &self.meshes, &stated, gear)
    }

    /// Teeth of its window.
    pub fn window(&self) -> usize {
        self.options.window.unwrap_or_default()
    }

    /// Reduces anew with one more tooth in the window; whether there was one.
    pub fn widen(
        &mut self,
        file: &Gearbox,
        i: usize,
        mesh: &Mesh,
        cache: &dyn GearCache,
    ) -> Result<bool, AnalysisError> {
        let teeth = self.options.window_teeth(&mesh.pair) + 1;
        let room = self.meshes.iter().all(|m| {
            let there = if m.gear.is_periodic_sector() { m.gear.tooth_count() as usize } else { m.gear.teeth().len() };
            teeth < there
        });
        if file.meshes[i].scene.analysis.window_teeth.is_some() || !room {
            return Ok(false);
        }
        self.options.window = Some(teeth);
        let found =
            elastic_gears(&self.scene, &mesh.pair, &self.options, &self.meshes, (cache, &NoObserver, &|| true))?;
        (self.gears, self.keys) = (Arc::new(found.gears), found.keys);
        Ok(true)
    }

    /// Keeps the gears for later runs; what could not be written.
    pub fn save(&self, cache: &dyn GearCache) -> Vec<Remark> {
        if cache.is_on() { self.keys.save(cache, &self.gears) } else { Vec::new() }
    }
}
