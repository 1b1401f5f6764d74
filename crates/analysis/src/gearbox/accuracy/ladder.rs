//! The ladder of a gearbox: meshes, slices, positions, shaft elements.

use scene::{Quantity, Scene, gearbox::Gearbox};

use super::{
    pairs::pairs,
    sample::Sample,
    seen::Seen,
    settings::{Free, Settings},
};
use crate::{
    AnalysisError, NoObserver, Observer, PhaseWork, SharedModels,
    accuracy::{Accuracy, Bound, Calibration, Cause, Companions, Ladder, Rung, TriedSettings, stride},
    gearbox::{
        GearboxResult, GearboxSink, NoGearboxSink,
        motion::Span,
        solve::{Asked, Slices, running, solve},
    },
    refused::Refusal,
    run_phase,
};

/// A gearbox on the rungs of its ladder.
pub(super) struct GearboxLadder<'a> {
    file: &'a Gearbox,
    models: &'a SharedModels<'a>,
    sink: &'a mut dyn GearboxSink,
    free: Free,
    /// Scenes of the meshes with their slices.
    scenes: Vec<Scene>,
    /// Runs that others were held against, at their positions.
    known: Vec<(Settings, Sample)>,
    /// Of the pairs of the meshes.
    companions: Vec<Companions>,
}

impl<'a> GearboxLadder<'a> {
    /// Ladder of a gearbox with `[accuracy]`.
    ///
    /// # Errors
    /// [`AnalysisError`] if meshes and shafts do not match.
    pub fn new(
        file: &'a Gearbox,
        models: &'a SharedModels<'a>,
        sink: &'a mut dyn GearboxSink,
    ) -> Result<Self, AnalysisError> {
        let (_, scenes) = running(file, Slices::Settled)?;
        let companions = scenes.iter().map(|_| Companions::default()).collect();
        Ok(Self { file, models, sink, free: Free::of(file), scenes, known: Vec::new(), companions })
    }

    /// The numbers of the gearbox with other settings; two speeds of a vibration tell its natural frequencies.
    fn beside(&mut self, settings: Settings) -> Result<Sample, AnalysisError> {
        if let Some((_, known)) = self.known.iter().find(|(own, _)| *own == settings) {
            return Ok(known.clone());
        }
        let mut file = settings.gearbox(self.file);
        if let Some(vibration) = &mut file.vibration {
            vibration.speeds = 2;
        }
        let asked = Asked { file: &file, models: self.models, slices: Slices::AsTheyAre };
        let (result, _) = solve(asked, Span::default(), &mut NoObserver, &mut NoGearboxSink)?;
        let sample = Sample::of(&result, 1, 0);
        self.known.push((settings, sample.clone()));
        Ok(sample)
    }

    /// All that a run is held against.
    fn accuracy(&mut self, settings: &Settings, result: &GearboxResult) -> Result<Accuracy, AnalysisError> {
        let vibrates = result.vibration.is_some();
        // Natural frequencies are those of all positions: they are not read off some of them.
        let stride = if vibrates { 1 } else { stride(settings.positions) };
        let few = settings.with_positions(settings.positions / stride);
        let own = Sample::of(result, 1, 0);
        let sparse = Sample::of(result, stride as usize, 0);
        self.known.push((few.clone(), sparse.clone()));
        let every = |stride: usize| (0..stride).map(|first| Sample::of(result, stride, first)).collect::<Vec<_>>();
        let (mut halved, mut quartered) = (every(2), every(4));
        let on_rungs = few.on_rungs(self.file);
        let (coarser, ratio) = on_rungs.coarser();
        let fewer_elements = if vibrates {
            let half = self.beside(settings.with_positions(settings.positions / 2))?;
            for own in halved.iter_mut().chain(&mut quartered) {
                own.take(Quantity::NaturalFrequency, &half);
            }
            Some(self.beside(few.fewer_elements())?)
        } else {
            None
        };
        let solved = settings.gearbox(self.file);
        let cache = self.models.cache();
        let seen = Seen {
            file: self.file,
            result,
            own,
            sparse,
            halved,
            quartered,
            on_rungs: self.beside(on_rungs)?,
            coarser: self.beside(coarser)?,
            ratio,
            fewer_slices: self.beside(few.fewer_slices())?,
            fewer_elements,
            pairs: pairs(&solved, result, cache, &mut self.companions)?,
        };
        let bounds = seen.bounds();
        let asked = self.file.accuracy.tolerances();
        if let Some((missing, _)) = asked.iter().find(|(q, _)| bounds.iter().all(|b| b.quantity != *q)) {
            return Err(AnalysisError::from(Refusal::no_bound(*missing)).in_file(&self.file.file));
        }
        let calibration = Calibration::committed();
        Ok(Accuracy {
            coverage: calibration.coverage,
            calibrated_on_pairs: calibration.pairs,
            held_against: held_against(vibrates),
            bounds,
            not_covered: seen.not_covered(),
            ..Accuracy::default()
        })
    }

    /// Finer settings for a bound that is not kept: of what it is mostly made of, else of what comes next. `None` where
    /// something that cannot be refined takes all that is asked: nothing else would help.
    fn finer(&self, settings: &Settings, worst: &Bound) -> Option<Settings> {
        let ways = [
            (Cause::Mesh, enough(settings, worst).map(|rung| settings.on(rung))),
            (Cause::Slices, settings.more_slices(&self.free)),
            (Cause::Positions, settings.more_positions()),
            (Cause::ShaftElements, settings.more_elements()),
        ];
        let takes_all = |cause: Cause| worst.asked.is_some_and(|asked| worst.by(cause) >= asked);
        if ways.iter().any(|(cause, finer)| finer.is_none() && takes_all(*cause)) {
            return None;
        }
        let finer = ways.into_iter().filter_map(|(cause, finer)| Some((worst.by(cause), finer?)));
        finer.filter(|(by, _)| *by > 0.0).max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, finer)| finer)
    }
}

fn held_against(vibrates: bool) -> String {
    let elements = if vibrates { ", half the shaft elements" } else { "" };
    format!("meshes of the next coarser rung, half the slices, half the positions{elements}")
}

/// The coarsest finer rung that is foreseen to keep a bound, whose errors fall with the square of the elements, else the
/// next one.
fn enough(settings: &Settings, worst: &Bound) -> Option<Rung> {
    let own = f64::from(settings.rung()?.elements_profile);
    let others: f64 = worst.terms.iter().filter(|t| t.cause != Cause::Mesh).map(|t| t.known.abs() + t.amount).sum();
    let room = worst.asked? - others;
    let keeps = |rung: &Rung| worst.by(Cause::Mesh) * (own / f64::from(rung.elements_profile)).powi(2) <= room;
    settings.finer_rungs().find(keeps).or(settings.finer_rungs().next())
}

impl Ladder for GearboxLadder<'_> {
    type Rung = Settings;
    type Solved = GearboxResult;
    type Tried = TriedSettings;
    /// Each is finer in something than one before.
    const TRIES: usize = 12;

    fn chooses(&self) -> bool {
        true
    }

    fn first(&mut self, _: &mut dyn Observer) -> Result<Settings, AnalysisError> {
        Ok(Settings::first(self.file, &self.free, &self.scenes))
    }

    fn solve(&mut self, settings: &Settings, observer: &mut dyn Observer) -> Result<GearboxResult, AnalysisError> {
        let file = settings.gearbox(self.file);
        let asked = Asked { file: &file, models: self.models, slices: Slices::AsTheyAre };
        Ok(solve(asked, Span::default(), observer, self.sink)?.0)
    }

    fn bound(
        &mut self,
        settings: &Settings,
        result: &GearboxResult,
        observer: &mut dyn Observer,
    ) -> Result<Accuracy, AnalysisError> {
        run_phase(observer, "estimate", PhaseWork::Unknown, |_| self.accuracy(settings, result))
    }

    fn refine(&mut self, settings: &Settings, _: &GearboxResult, accuracy: &Accuracy) -> Option<(Settings, String)> {
        Some((self.finer(settings, accuracy.worst()?)?, accuracy.shortfall()))
    }

    fn tried(&self, settings: &Settings, left_because: Option<String>) -> TriedSettings {
        TriedSettings {
            elements_profile: settings.rung().map(|rung| rung.elements_profile),
            slices: settings.slices.clone(),
            positions_per_cycle: settings.positions,
            shaft_elements: settings.shaft_elements,
            left_because,
        }
    }
}
