//! A gearbox at rest: from its file to where shafts, bearings and gears stand.
//!
//! | module | what it does |
//! |---|---|
//! | `parts`, `bearings` | shafts, discs and bearings of the file |
//! | `meshes` | pairs, their reduced gears, and the contact of each mesh |
//! | `loads` | what equilibrium alone says of teeth and bearings, before any work |
//! | `checks` | what must hold |
//! | `headline` | the numbers that it is judged by |
//! | `motion`, `orders`, `sink` | from rest on, in time, and the orders of its meshes; who gets rows and checkpoints |
//! | `result` | what is read off all positions, and what is said of large deflections |
//! | `room` | what is said of parts that have no room |
//! | `inertia`, `vibration`, `swings` | how it swings about that: masses, the search, and what it finds |

mod bearings;
mod checks;
mod headline;
mod inertia;
mod loads;
mod meshes;
mod motion;
mod orders;
mod parts;
mod result;
mod room;
mod sink;
mod swings;
mod vibration;

use std::f64::consts::TAU;

use gearbox::{
    GearboxError, GearboxPosition, MeshSample, StaticGearbox, Train,
    motion::{GearboxCheckpoint, GearboxInstant},
};
use scene::{Scene, gearbox::Gearbox};

use crate::{
    AnalysisError, Observer, PhaseWork, SharedModels,
    context::{Context, Ending, Question},
    plausible::gearbox_remarks,
    run_phase, unless_cancelled,
};
pub use bearings::RollingLoad;
use meshes::{ReducedMesh, widening};
pub use motion::{GearboxMotionResult, Range};
pub use orders::MotionOrder;
pub use result::{BearingLoad, GearboxResult, MeshResult, OutputResult};
pub use sink::GearboxSink;
use sink::NoGearboxSink;
pub use swings::{ExcitationLine, GearboxSwings, OrderForces, SpeedRms};
use vibration::Parts;

/// Where a motion begins, and where it is to stop.
#[derive(Debug, Default)]
struct Span {
    /// State to go on from, with the rows before it.
    from: Option<(GearboxCheckpoint, Vec<GearboxInstant>)>,
    /// Stop when so many cycles of the fastest mesh are done.
    stop_after: Option<u64>,
}

impl Question for Gearbox {
    type Answer = GearboxResult;
    type Sink<'s> = dyn GearboxSink + 's;
    type State = (GearboxCheckpoint, Vec<GearboxInstant>);

    /// What is at rest is solved again where its motion is gone on with.
    fn answer(&self, context: Context<'_, Self>) -> Result<Ending<GearboxResult>, AnalysisError> {
        let Context { observer, cache, models, sink, from, stop_after, .. } = context;
        let own = SharedModels::new(cache);
        let models = models.unwrap_or(&own);
        let span = Span { from, stop_after };
        let (result, stopped) = match sink {
            Some(sink) => solve((self, models), span, observer, sink),
            None => solve((self, models), span, observer, &mut NoGearboxSink),
        }?;
        Ok(stopped.map_or(Ending::Finished(result), |cycles| Ending::Stopped { cycles }))
    }
}

/// The result, and the cycles after which its motion was stopped, where it was.
fn solve(
    (file, models): (&Gearbox, &SharedModels<'_>),
    span: Span,
    observer: &mut dyn Observer,
    sink: &mut dyn GearboxSink,
) -> Result<(GearboxResult, Option<u64>), AnalysisError> {
    let failed = |source: GearboxError| AnalysisError::from(source).in_file(&file.file);
    let structure = parts::structure(file).map_err(failed)?;
    let mut warnings = Vec::new();
    // First with the pairs as they are: which flanks press is known once all turn.
    let rough = meshes::pairs(file)?;
    let (input, sense, keys) = parts::input(file);
    let train = Train::new(&structure, &rough, &keys, input, sense).map_err(failed)?;
    let operation = parts::operation(file, &train);
    let scenes = meshes::running(file, &train);
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
        warnings.push(said);
    }
    let mut reduced = run_phase(observer, "reduce", PhaseWork::Steps(meshes.len() as u64), |progress| {
        let one = |(mesh, scene): (&gearbox::Mesh, Scene)| {
            progress.say(mesh.name.clone());
            let own = ReducedMesh::new(scene, mesh, (models, progress))?;
            progress.tick();
            unless_cancelled(progress)?;
            Ok(own)
        };
        meshes.iter().zip(scenes).map(one).collect::<Result<Vec<_>, AnalysisError>>()
    })?;
    for (i, own) in reduced.iter().enumerate() {
        warnings.extend(own.warnings.clone());
        warnings.extend(own.seats(file, i));
    }
    let (positions, samples) = widening(&meshes, &mut reduced, models, &mut warnings, |reduced| {
        run_phase(observer, "solve", PhaseWork::Steps(u64::from(count(file))), |progress| {
            let made = StaticGearbox::new(structure.clone(), meshes.clone(), operation.clone(), |i, mesh, _| {
                reduced[i].element(mesh)
            });
            let mut gearbox = made.map_err(failed)?;
            let mut positions: Vec<GearboxPosition> = Vec::new();
            let mut samples: Vec<Vec<MeshSample>> = vec![Vec::new(); meshes.len()];
            for angle in angles(file, gearbox.train()) {
                let position = gearbox.solve(angle).map_err(failed)?;
                for (i, own) in samples.iter_mut().enumerate() {
                    own.extend(MeshSample::at(&gearbox, &position, i));
                }
                positions.push(position);
                progress.tick();
                unless_cancelled(progress)?;
            }
            Ok((positions, samples))
        })
    })?;
    for (i, own) in reduced.iter().enumerate() {
        warnings.extend(own.jammed(i, &meshes[i], &positions));
    }
    // What swings and moves has springs in place of rolling elements, about where these stand.
    let linear = match (&file.vibration, &file.motion) {
        (None, None) => structure.clone(),
        _ => {
            let held = |own: &gearbox::Structure| own.check_held(&operation.held, (&meshes, &train), operation.input);
            structure.about(&positions).and_then(|own| held(&own).map(|()| own)).map_err(failed)?
        }
    };
    let vibration = match &file.vibration {
        None => None,
        Some(asked) => {
            let parts = Parts { file, structure: &linear, meshes: &meshes, train: &train, operation: &operation };
            let found = widening(&meshes, &mut reduced, models, &mut warnings, |reduced| {
                vibration::vibration(&parts, asked, reduced, &samples, observer)
            });
            Some(found?)
        }
    };
    warnings.extend(reduced.iter().flat_map(|own| own.save(models.cache())));
    let rest = motion::AtRest {
        file,
        structure: &linear,
        meshes: &meshes,
        operation: &operation,
        train: &train,
        reduced: &reduced,
        positions: &positions,
    };
    let moved = file.motion.as_ref().map(|asked| motion::run(&rest, asked, span, (observer, sink))).transpose()?;
    let (moved, stopped) = moved.map_or((None, None), |(own, stopped)| (Some(own), stopped));
    warnings.extend(moved.as_ref().zip(file.motion.as_ref()).and_then(|(moved, asked)| moved.remark(asked)));
    let result = result::result((file, &structure), meshes, &train, &reduced, (positions, vibration), warnings);
    Ok((GearboxResult { motion: moved, ..result }, stopped))
}

fn count(file: &Gearbox) -> u32 {
    file.positions_per_cycle.saturating_mul(file.cycles)
}

/// Angles of the input (rad about +z) at which the first mesh has gone through its cycles, evenly spaced from where it
/// starts.
fn angles(file: &Gearbox, train: &Train) -> impl Iterator<Item = f64> + use<> {
    let first = &train.meshing()[0];
    let teeth = f64::from(file.meshes[0].scene.pinion.teeth);
    let pitch = first.sense.sign() as f64 * TAU / teeth / first.ratio;
    let per_cycle = f64::from(file.positions_per_cycle);
    (0..count(file)).map(move |i| pitch * f64::from(i) / per_cycle)
}
