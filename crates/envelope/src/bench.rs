//! A mode's scene as it stands and with keys set otherwise, solved.

use std::path::PathBuf;

use ale::{Station, ToothWindow};
use analysis::{
    AnalysisError, Context, Ending, NoObserver, SinkResult, StaticAnalysis, StaticResult, StaticSink,
    gearbox::GearboxResult,
    lumped::{LumpedAnalysis, LumpedResult},
    motion::{MotionAnalysis, MotionResult},
    solve, static_certificate,
};
use geometry::Sense;
use ltca::{StaticModel, StaticPosition};
use scene::{Scene, SceneError, Setting, gearbox::Gearbox};

use crate::EnvelopeError;

/// Solves the scene of one failure mode, as it stands and with keys set otherwise.
#[derive(Debug)]
pub(crate) struct Bench {
    /// File of the scene in `scenes/envelope`, without its ending.
    pub(crate) file: &'static str,
    /// Text of the scene.
    pub(crate) scene: &'static str,
    /// Settings with which the scene shows the failure.
    pub(crate) naive: &'static [&'static str],
}

impl Bench {
    /// The settings that show the failure, and these beside them.
    pub(crate) fn naive(&self, more: &[&str]) -> Vec<String> {
        self.naive.iter().chain(more).map(|s| (*s).to_owned()).collect()
    }

    /// The scene with some of its keys set otherwise, `key=value` each.
    pub(crate) fn scene<S: AsRef<str>>(&self, settings: &[S]) -> Result<Scene, SceneError> {
        let settings = settings.iter().map(|s| Setting::parse(s.as_ref())).collect::<Result<Vec<_>, _>>()?;
        let file = PathBuf::from(format!("scenes/envelope/{}.toml", self.file));
        Scene::parse_with(self.scene, &file, &settings)
    }

    /// Solved at rest, its certificate held.
    pub(crate) fn at_rest<S: AsRef<str>>(&self, settings: &[S]) -> Result<StaticResult, AnalysisError> {
        let scene = self.scene(settings)?;
        let result = StaticAnalysis::new(&scene).solve()?;
        analysis::certificate::verdict(&static_certificate(&scene, &result.history.positions), &scene)?;
        Ok(result)
    }

    /// A gearbox, solved at rest, its certificate held.
    pub(crate) fn gearbox_at_rest<S: AsRef<str>>(&self, settings: &[S]) -> Result<GearboxResult, AnalysisError> {
        let settings = settings.iter().map(|s| Setting::parse(s.as_ref())).collect::<Result<Vec<_>, _>>()?;
        let file = PathBuf::from(format!("scenes/envelope/{}.toml", self.file));
        let gearbox = Gearbox::parse_with(self.scene, &file, &settings)?;
        let result = solve(&gearbox, Context::new(&mut NoObserver)).and_then(Ending::finished)?;
        result.verdict(&gearbox)?;
        Ok(result)
    }

    /// What `look` takes from the first position of an analysis at rest, where the model stands as it was found.
    pub(crate) fn at_first_position<T>(
        &self,
        settings: &[String],
        look: impl FnMut(&StaticPosition, &StaticModel) -> T,
    ) -> Result<T, EnvelopeError> {
        let scene = self.scene(settings)?;
        let mut sink = FirstPosition { look, taken: None };
        StaticAnalysis::new(&scene).solve_into(&mut NoObserver, &mut sink)?;
        sink.taken.ok_or_else(|| EnvelopeError::piece("first position", "there is none"))
    }

    /// Solved in motion, its certificate held.
    pub(crate) fn in_motion<S: AsRef<str>>(&self, settings: &[S]) -> Result<MotionResult, AnalysisError> {
        let scene = self.scene(settings)?;
        let result = MotionAnalysis::new(&scene).solve()?;
        analysis::certificate::verdict(&result.facts.certificate, &scene)?;
        Ok(result)
    }

    /// Solved in motion, whatever its certificate says.
    pub(crate) fn unchecked_motion<S: AsRef<str>>(&self, settings: &[S]) -> Result<MotionResult, AnalysisError> {
        MotionAnalysis::new(&self.scene(settings)?).solve()
    }

    /// Solved by a model with few coordinates, its certificate held.
    pub(crate) fn lumped<S: AsRef<str>>(&self, settings: &[S]) -> Result<LumpedResult, AnalysisError> {
        let scene = self.scene(settings)?;
        let result = LumpedAnalysis::new(&scene).solve()?;
        analysis::certificate::verdict(result.certificate(), &scene)?;
        Ok(result)
    }
}

/// Looks at position 0.
struct FirstPosition<F, T> {
    look: F,
    taken: Option<T>,
}

impl<T, F: FnMut(&StaticPosition, &StaticModel) -> T> StaticSink for FirstPosition<F, T> {
    fn begin(&mut self, _: &Scene) {}

    fn position(&mut self, index: usize, position: &StaticPosition, model: &StaticModel) -> SinkResult {
        if index == 0 {
            self.taken = Some((self.look)(position, model));
        }
        Ok(())
    }

    fn finish(&mut self) -> SinkResult {
        Ok(())
    }
}

/// Force on pairs outside a window of so many teeth that follows the unloaded geometry, N, at the worst position.
pub(crate) fn outside_of_window(result: &StaticResult, teeth: usize) -> f64 {
    let outside = |p: &StaticPosition| {
        let centre = Station { cycle: 0, phase: p.mesh_phase }.centre(Sense::Ccw);
        let first = ToothWindow::nominal_first(centre, teeth);
        let inside = first..first + teeth as i64;
        p.pairs.iter().filter(|q| !inside.contains(&q.pair)).map(|q| q.normal_force).sum::<f64>()
    };
    largest(result.history.positions.iter().map(outside))
}

/// No settings.
pub(crate) const AS_IT_IS: [&str; 0] = [];

/// Transmission error of all positions, um.
pub(crate) fn errors_um(result: &StaticResult) -> Vec<f64> {
    result.history.positions.iter().map(|p| 1e3 * p.transmission_error).collect()
}

/// The largest; NaN of nothing, and where one is no number: neither is a bound kept.
pub(crate) fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().reduce(analysis::worse).unwrap_or(f64::NAN)
}

/// The least; NaN as of [`largest`].
pub(crate) fn least(values: impl IntoIterator<Item = f64>) -> f64 {
    -largest(values.into_iter().map(|x| -x))
}

/// Arithmetic mean; NaN of nothing.
pub(crate) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Largest less least; NaN where one is no number.
pub(crate) fn peak_to_peak(values: &[f64]) -> f64 {
    let (low, high) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &v| (v.min(l), v.max(h)));
    if values.iter().any(|v| v.is_nan()) { f64::NAN } else { high - low }
}

/// Largest difference of two rows of equal length; infinite where they are not, NaN of none.
pub(crate) fn farthest(a: &[f64], b: &[f64]) -> f64 {
    if a.len() != b.len() {
        return f64::INFINITY;
    }
    largest(a.iter().zip(b).map(|(a, b)| (a - b).abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is no number, and what is not there, keeps no bound.
    #[test]
    fn nothing_and_no_number_are_neither_large_nor_small() {
        assert_eq!([largest([1.0, 3.0, 2.0]), least([1.0, -3.0, 2.0])], [3.0, -3.0]);
        let none: [f64; 0] = [];
        for lost in [largest(none), least(none), largest([f64::NAN, 1.0]), largest([1.0, f64::NAN]), farthest(&[], &[])]
        {
            assert!(lost.is_nan(), "{lost}");
        }
        assert_eq!(farthest(&[1.0], &[1.0, 2.0]), f64::INFINITY);
    }
}
