//! Files of a sweep, and what is read off its points.

use serde::Serialize;
use study::{Bifurcation, Branch};

use super::{Once, SweepPoint, SweepRequest};
use crate::{
    output::{push_row, quoted},
    scene::{Scene, SweepWay},
};

/// Answers of both ways are two when their extents differ by this share of the largest peak to peak.
const APART: f64 = 0.02;

/// What a sweep is made for.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct SweepSummary {
    /// The key that changes.
    pub key: String,
    /// First and last value.
    pub range: [f64; 2],
    /// Values.
    pub values: usize,
    /// The column whose section is taken.
    pub section_of: String,
    /// How often.
    pub once: Once,
    /// The largest peak to peak of each way.
    pub largest: Vec<SweepPoint>,
    /// Points, and among them those with a section that comes back at once.
    pub points: usize,
    /// Section of one point.
    pub period_one: usize,
    /// Section of a few points: a subharmonic answer. Way, value and period.
    pub subharmonic: Vec<(SweepWay, f64, usize)>,
    /// No period found, way and value.
    pub not_periodic: Vec<(SweepWay, f64)>,
    /// Lyapunov exponent above zero beyond three standard errors and a section that does not come back, way and value; `None` where no exponent was asked for.
    pub chaotic: Option<Vec<(SweepWay, f64)>>,
    /// Ranges of the key in which upwards and downwards give other answers.
    pub hysteresis: Option<Vec<[f64; 2]>>,
    /// Values at which flanks part at times, of all ways.
    pub parting: usize,
    /// Values without a motion, way, value and reason.
    pub failed: Vec<(SweepWay, f64, String)>,
    /// Tolerance of the periodic state.
    pub periodic_tolerance: f64,
    /// Words of `ale-gear sweep` that make it again, behind the scene's file; `None` where the scene says it all.
    pub again: Option<String>,
}

/// Reads it off the points.
pub(super) fn summary(scene: &Scene, request: &SweepRequest, points: &[SweepPoint]) -> SweepSummary {
    let largest = request.ways.iter().filter_map(|way| {
        let own = points.iter().filter(|p| p.way == *way && p.failed.is_none());
        own.max_by(|a, b| a.peak_to_peak().total_cmp(&b.peak_to_peak())).cloned()
    });
    let which = |keep: &dyn Fn(&SweepPoint) -> bool| -> Vec<(SweepWay, f64)> {
        points.iter().filter(|p| keep(p)).map(|p| (p.way, p.value)).collect()
    };
    let range = points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], p| [a.min(p.value), b.max(p.value)]);
    SweepSummary {
        key: request.key.clone(),
        range,
        values: points.len() / request.ways.len().max(1),
        section_of: request.of.clone(),
        once: request.once,
        largest: largest.collect(),
        points: points.len(),
        period_one: points.iter().filter(|p| p.period == Some(1)).count(),
        subharmonic: points.iter().filter_map(|p| Some((p.way, p.value, p.period.filter(|n| *n > 1)?))).collect(),
        // A section of a point or two tells no period.
        not_periodic: which(&|p| p.period.is_none() && p.points.len() > 2),
        failed: points.iter().filter_map(|p| p.failed.as_ref().map(|e| (p.way, p.value, e.message.clone()))).collect(),
        chaotic: (request.stretches > 0).then(|| which(&SweepPoint::is_chaotic)),
        hysteresis: hysteresis(request, points),
        parting: points.iter().filter(|p| p.rows_apart > 0).count(),
        periodic_tolerance: scene.motion.as_ref().and_then(|m| m.periodic_tolerance).unwrap_or(1e-6),
        again: request.again.clone(),
    }
}

/// Where both ways differ by more than a share of the largest peak to peak. Motions that never come back differ at all times, and say nothing of two answers.
fn hysteresis(request: &SweepRequest, points: &[SweepPoint]) -> Option<Vec<[f64; 2]>> {
    let both = [SweepWay::Up, SweepWay::Down];
    if !both.iter().all(|way| request.ways.contains(way)) {
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

impl SweepSummary {
    /// What a user should hear.
    pub fn doubts(&self) -> Vec<String> {
        let silent = self.chaotic.is_none();
        let failed = self.failed.first().map(|(_, _, reason)| {
            format!(
                "{} of {} points have no solution; their rows in sweep.csv say why, the first: {reason}",
                self.failed.len(),
                self.points
            )
        });
        (silent && !self.not_periodic.is_empty())
            .then(|| {
                format!(
                    "at {} of {} points the section does not come back: chaotic, quasi-periodic, or `warm_up_cycles` are too few; a Lyapunov exponent \
                     (`ale-gear sweep --lyapunov 200`) tells which",
                    self.not_periodic.len(),
                    self.points
                )
            })
            .into_iter()
            .chain(failed)
            .collect()
    }
}

pub(super) fn way_name(way: SweepWay) -> &'static str {
    match way {
        SweepWay::Apart => "apart",
        SweepWay::Up => "up",
        SweepWay::Down => "down",
    }
}

/// `sweep.csv`: one row a point.
pub(super) fn sweep_csv(request: &SweepRequest, points: &[SweepPoint]) -> String {
    let of = &request.of;
    let mut csv = format!(
        "way,{},mean_{of},peak_to_peak_{of},min_{of},max_{of},section_period,periodicity,warm_up_cycles,lyapunov_per_s,lyapunov_error_per_s,\
         min_normal_force_n,max_normal_force_n,rows_without_driving_force,status,reason\n",
        request.key
    );
    for p in points {
        csv.push_str(way_name(p.way));
        csv.push(',');
        let none = f64::NAN;
        push_row(
            &mut csv,
            [
                p.value,
                p.mean,
                p.peak_to_peak(),
                p.extent[0],
                p.extent[1],
                p.period.map_or(none, |n| n as f64),
                p.periodicity.unwrap_or(none),
                p.warm_up_cycles as f64,
                p.lyapunov.map_or(none, |l| l.exponent),
                p.lyapunov.map_or(none, |l| l.error),
                p.normal_force_n[0],
                p.normal_force_n[1],
                p.rows_apart as f64,
            ],
        );
        csv.pop();
        let reason = p.failed.as_ref().map_or(String::new(), |e| quoted(&e.message));
        csv.push_str(&format!(",{},{reason}\n", if p.failed.is_some() { "failed" } else { "solved" }));
    }
    csv
}

/// `bifurcation.csv`: one row a point of a section.
pub(super) fn bifurcation_csv(request: &SweepRequest, points: &[SweepPoint]) -> String {
    let mut csv = format!("way,{},point,{}\n", request.key, request.of);
    for p in points {
        for (k, x) in p.points.iter().enumerate() {
            csv.push_str(way_name(p.way));
            csv.push(',');
            push_row(&mut csv, [p.value, k as f64, *x]);
        }
    }
    csv
}
