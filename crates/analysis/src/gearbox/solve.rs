//! Solves a gearbox once with the settings of its document: equilibrium, then vibration and motion if requested.

use gearbox::{GearboxError, Train};
use scene::{
    DataFile, Scene,
    gearbox::{Gearbox, MeshModel},
};

use super::{
    GearboxMotionResult, GearboxResult, GearboxSink,
    at_rest::AtRest,
    branch, loads,
    meshes::{self, ReducedMesh, widening},
    motion::{self, Span},
    parts, rating, result,
    solved_positions::{at_all_angles, count, on_coast_flanks},
    spectrum::SolvedSpectrum,
    vibration::{self, Parts},
};
use crate::{
    AnalysisError, Observer, PhaseWork, SharedModels, plausible::gearbox_remarks, run_phase, unless_cancelled,
};

/// A gearbox that is to be solved.
#[derive(Clone, Copy)]
pub(super) struct Asked<'a> {
    pub file: &'a Gearbox,
    pub models: &'a SharedModels<'a>,
    /// Who chooses slices.
    pub slices: Slices,
}

/// Who chooses the slices of the meshes.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Slices {
    /// The program, where the scene of a pair states none.
    Settled,
    /// The scenes of the pairs have all that are wanted.
    AsTheyAre,
}

/// The result, and the cycles after which its motion was stopped, where it was.
///
/// # Errors
/// [`AnalysisError`].
pub(super) fn solve(
    asked: Asked<'_>,
    span: Span,
    observer: &mut dyn Observer,
    sink: &mut dyn GearboxSink,
) -> Result<(GearboxResult, Option<u64>), AnalysisError> {
    let Asked { file, models, .. } = asked;
    let failed = |source: GearboxError| AnalysisError::from(source).in_file(&file.file);
    let structure = parts::structure(file).map_err(failed)?;
    let mut remarks = Vec::new();
    let (train, scenes) = running(file, asked.slices)?;
    let operation = parts::operation(file, &train);
    let meshes = file.meshes.iter().zip(&scenes).map(|(own, scene)| meshes::mesh(own, scene));
    let meshes = meshes.collect::<Result<Vec<_>, _>>()?;
    let loaded = loads::Loaded {
        file,
        scenes: &scenes,
        structure: &structure,
        meshes: &meshes,
        train: &train,
        operation: &operation,
    };
    for said in gearbox_remarks(file).into_iter().chain(loaded.judge()?) {
        observer.note(said.to_string());
        remarks.push(said);
    }
    let mut reduced = run_phase(observer, "reduce", PhaseWork::Steps(meshes.len() as u64), |progress| {
        let one = |((mesh, scene), turn): ((&gearbox::GearMesh, Scene), f64)| {
            progress.say(mesh.name.clone());
            let own = ReducedMesh::new(scene, (mesh, turn), (models, progress))?;
            progress.tick();
            unless_cancelled(progress)?;
            Ok(own)
        };
        meshes
            .iter()
            .zip(scenes)
            .zip(meshes::wheel_turns(file, &train))
            .map(one)
            .collect::<Result<Vec<_>, AnalysisError>>()
    })?;
    for (i, own) in reduced.iter().enumerate() {
        remarks.extend(own.remarks.clone());
        remarks.extend(own.seats(file, i));
    }
    let parts = Parts { file, structure: &structure, meshes: &meshes, train: &train, operation: &operation };
    let (positions, samples) = widening(&meshes, &mut reduced, models, &mut remarks, |reduced| {
        run_phase(observer, "solve", PhaseWork::Steps(u64::from(count(file))), |progress| {
            at_all_angles(&parts, reduced, progress)
        })
    })?;
    let spectrum = file.rating.as_ref().and_then(|asked| asked.spectrum.as_ref()).map(DataFile::values);
    let loads = spectrum.map(|spectrum| {
        widening(&meshes, &mut reduced, models, &mut remarks, |reduced| {
            SolvedSpectrum::new(&parts, spectrum, reduced, observer)
        })
    });
    let loads = loads.transpose()?;
    for (i, own) in reduced.iter().enumerate() {
        remarks.extend(own.jammed(i, &meshes[i], &positions));
    }
    // A vibration has springs in place of rolling elements, about where these stand; a motion begins with them.
    let linear = match (&file.vibration, &file.motion, &file.branch) {
        (None, None, None) => structure.clone(),
        _ => {
            let held = |own: &gearbox::Structure| own.check_held(&operation.held, (&meshes, &train), operation.input);
            structure.about(&positions).and_then(|own| held(&own).map(|()| own)).map_err(failed)?
        }
    };
    let modes = vibration::elastic_modes((file, &structure, &meshes), &reduced, observer)?;
    let vibration = match &file.vibration {
        None => None,
        Some(asked) => {
            let parts = Parts { structure: &linear, ..parts };
            let found = widening(&meshes, &mut reduced, models, &mut remarks, |reduced| {
                vibration::vibration(&parts, asked, (reduced, &modes), &samples, observer)
            });
            let found = found?;
            let load = |i: usize| gearbox::mesh_numbers::mean(positions.iter().map(|p| p.meshes[i].normal_force));
            remarks.extend(found.remarks(file, &(0..meshes.len()).map(load).collect::<Vec<_>>()));
            Some(found)
        }
    };
    let campbell = match (&file.vibration, &file.motion) {
        (None, Some(asked)) if asked.to_speed_rpm.is_some() => {
            let parts = Parts { structure: &linear, ..parts };
            Some(widening(&meshes, &mut reduced, models, &mut remarks, |reduced| {
                vibration::campbell(&parts, asked, (reduced, &modes), &samples, observer)
            })?)
        }
        _ => None,
    };
    let lowest_hz = match &file.motion {
        None => Vec::new(),
        Some(_) => run_phase(observer, "frequencies", PhaseWork::Steps(reduced.len() as u64), |progress| {
            let one = |own: &ReducedMesh| {
                unless_cancelled(progress)?;
                let found = own.lowest_hz();
                progress.tick();
                found
            };
            reduced.iter().map(one).collect::<Result<Vec<_>, AnalysisError>>()
        })?,
    };
    remarks.extend(reduced.iter().flat_map(|own| own.save(models.cache())));
    let asked = file.motion.as_ref().or(file.branch.as_ref().map(|own| &own.motion));
    let maps = asked.is_some_and(|own| own.mesh == MeshModel::Mapped);
    let on_coast = if maps && reduced.iter().all(ReducedMesh::has_coast_flanks) {
        widening(&meshes, &mut reduced, models, &mut remarks, |reduced| {
            run_phase(observer, "stand on coast flanks", PhaseWork::Unknown, |progress| {
                on_coast_flanks(&parts, reduced, progress)
            })
        })?
    } else {
        Vec::new()
    };
    let rest = AtRest {
        file,
        structure: &structure,
        linear: &linear,
        meshes: &meshes,
        operation: &operation,
        train: &train,
        reduced: &reduced,
        positions: &positions,
        on_coast: &on_coast,
        modes: &modes,
        lowest_hz: &lowest_hz,
        cache: models.cache(),
    };
    let moved = file.motion.as_ref().map(|asked| motion::run(&rest, asked, span, (observer, sink))).transpose()?;
    let (moved, stopped) = moved.map_or((None, None), |(own, stopped)| (Some(own), stopped));
    let moved = moved.map(|own| GearboxMotionResult { campbell, ..own });
    remarks.extend(moved.iter().flat_map(|own| own.remarks.iter().cloned()));
    let branch = file.branch.as_ref().map(|asked| branch::branch(&rest, asked, observer)).transpose()?;
    remarks.extend(branch.iter().flat_map(|own| own.remarks.iter().cloned()));
    let (ratings, said) = rating::ratings((file, &train), &meshes, &reduced, (&positions, loads.as_ref()))?;
    remarks.extend(said);
    let solved = (positions, vibration, loads.as_ref());
    let result = result::result((file, &structure), (meshes, ratings), &train, &reduced, solved, remarks);
    Ok((GearboxResult { motion: moved, branch, ..result }, stopped))
}

/// The train of a gearbox, and the scenes of its meshes as they run: driver, rotation and slices are known.
///
/// # Errors
/// [`AnalysisError`] where they do not fit each other.
pub(super) fn running(file: &Gearbox, slices: Slices) -> Result<(Train, Vec<Scene>), AnalysisError> {
    let failed = |source: GearboxError| AnalysisError::from(source).in_file(&file.file);
    // First with the pairs as they are: which flanks press is known once all turn.
    let (structure, rough) = (parts::structure(file).map_err(failed)?, meshes::pairs(file)?);
    let (input, sense, keys) = parts::input(file);
    let train = Train::new(&structure, &rough, &keys, input, sense).map_err(failed)?;
    let scenes = meshes::running(file, &train, slices == Slices::Settled);
    Ok((train, scenes))
}
