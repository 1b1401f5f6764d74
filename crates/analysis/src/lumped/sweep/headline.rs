//! Headline values of a sweep.

use scene::{Scene, SweepWay, plan::SectionEvery};
use serde::Serialize;
use study::{Bifurcation, Branch};

use super::{SweepOptions, SweepPoint};

/// Answers of both ways are two when their extents differ by this share of the largest peak to peak.
const APART: f64 = 0.02;

described::described! {
    /// What a sweep is made for.
    #[derive(Debug, Clone, Serialize)]
    pub struct SweepHeadline {
        /// key that is varied
        pub key: String,
        /// smallest and largest value
        pub range: [f64; 2],
        /// number of values
        pub values: usize,
        /// column of the section
        pub section_of: String,
        /// when points of the section are taken: `mesh-cycle`, `pinion-turn` or `wheel-turn`
        pub once: SectionEvery,
        /// of each direction the value with the largest peak to peak
        pub largest: Vec<SweepPoint>,
        /// points of the diagram: values times directions
        pub points: usize,
        /// sections of one point
        pub period_one: usize,
        /// sections of a few points: direction, value, number of points
        pub subharmonic: Vec<(SweepWay, f64, usize)>,
        /// sections that do not come back within `periodic_tolerance`: direction, value
        pub not_periodic: Vec<(SweepWay, f64)>,
        /// direction and value where exponent and section show chaos; `null` where no exponent is asked for
        pub chaotic: Option<Vec<(SweepWay, f64)>>,
        /// ranges in which up and down differ by more than 2 % of the largest peak to peak
        pub hysteresis: Option<Vec<[f64; 2]>>,
        /// points at which the driving flanks lose contact
        pub parting: usize,
        /// values without a solution: direction, value, reason
        pub failed: Vec<(SweepWay, f64, String)>,
        /// tolerance of `periodicity`
        pub periodic_tolerance: f64,
        /// command that makes the result again; missing without one
        #[serde(skip_serializing_if = "Option::is_none")]
        pub again: Option<String>,
    }
}

/// Reads it off the points.
pub(super) fn headline(scene: &Scene, options: &SweepOptions, points: &[SweepPoint]) -> SweepHeadline {
    let largest = options.ways.iter().filter_map(|way| {
        let own = points.iter().filter(|p| p.way == *way && p.failed.is_none());
        own.max_by(|a, b| a.peak_to_peak().total_cmp(&b.peak_to_peak())).cloned()
    });
    let which = |keep: &dyn Fn(&SweepPoint) -> bool| -> Vec<(SweepWay, f64)> {
        points.iter().filter(|p| keep(p)).map(|p| (p.way, p.value)).collect()
    };
    let range = points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], p| [a.min(p.value), b.max(p.value)]);
    SweepHeadline {
        key: options.key.clone(),
        range,
        values: points.len() / options.ways.len().max(1),
        section_of: options.quantity.name.clone(),
        once: options.every,
        largest: largest.collect(),
        points: points.len(),
        period_one: points.iter().filter(|p| p.period == Some(1)).count(),
        subharmonic: points.iter().filter_map(|p| Some((p.way, p.value, p.period.filter(|n| *n > 1)?))).collect(),
        // A section of a point or two tells no period.
        not_periodic: which(&|p| p.period.is_none() && p.points.len() > 2),
        failed: points.iter().filter_map(|p| p.failed.as_ref().map(|e| (p.way, p.value, e.to_string()))).collect(),
        chaotic: (options.stretches > 0).then(|| which(&SweepPoint::is_chaotic)),
        hysteresis: hysteresis(options, points),
        parting: points.iter().filter(|p| p.rows_apart > 0).count(),
        periodic_tolerance: scene.motion.as_ref().and_then(|m| m.periodic_tolerance).unwrap_or(1e-6),
        again: None,
    }
}

/// Where both ways differ by more than a share of the largest peak to peak. Motions that never come back differ at
/// all times, and say nothing of two answers.
fn hysteresis(options: &SweepOptions, points: &[SweepPoint]) -> Option<Vec<[f64; 2]>> {
    let both = [SweepWay::Up, SweepWay::Down];
    if !both.iter().all(|way| options.ways.contains(way)) {
        return None;
    }
    let largest = points.iter().map(SweepPoint::peak_to_peak).filter(|x| x.is_finite()).fold(0.0, f64::max);
    let [up, down] = both.map(|way| points.iter().filter(|p| p.way == way).collect::<Vec<_>>());
    let branch = |p: &SweepPoint, other: &SweepPoint| Branch {
        value: p.value,
        points: if p.period.is_none() && other.period.is_none() || [p, other].iter().any(|p| p.failed.is_some()) {
            Vec::new()
        } else {
            p.extent.to_vec()
        },
    };
    let of =
        |a: &[&SweepPoint], b: &[&SweepPoint]| -> Vec<Branch> { a.iter().zip(b).map(|(p, o)| branch(p, o)).collect() };
    Some(Bifurcation { forward: of(&up, &down), backward: of(&down, &up) }.hysteresis(APART * largest))
}

impl SweepHeadline {
    /// What a user should hear.
    pub(super) fn remarks(&self) -> Vec<answer::Remark> {
        let silent = self.chaotic.is_none();
        let failed = self
            .failed
            .first()
            .map(|(_, _, reason)| crate::remark::points_unsolved(self.failed.len(), self.points, &**reason));
        (silent && !self.not_periodic.is_empty())
            .then(|| crate::remark::points_not_periodic(self.not_periodic.len(), self.points))
            .into_iter()
            .chain(failed)
            .collect()
    }
}
