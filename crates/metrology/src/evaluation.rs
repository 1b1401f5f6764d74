//! Deviations of traces and pitch after ISO 1328-1:2013, and their tolerance classes.

use geometry::{FlankTolerances, Gear, Side, TOLERANCE_CLASSES};
use serde::Serialize;

use crate::MetrologyError;
use crate::gaussian::low_pass;
use crate::least_squares::polynomial;
use crate::measured_gear::{GearHeader, MeasuredGear, Pitch, Range, Trace, TraceKind};

/// Cut-off of the low pass over the evaluation length: lambda_c = L/30.
const CUTOFF: f64 = 1.0 / 30.0;

/// Deviations of one trace over its evaluation range, um; the sign is that of ISO 1328-1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TraceEvaluation {
    /// Which way it runs, and where.
    pub kind: TraceKind,
    /// Tooth, from 0.
    pub tooth: u32,
    /// Side of the tooth.
    pub side: Side,
    /// Slope deviation f_Halpha or f_Hbeta: rise of the mean line over the range; positive where the flank stands proud at
    /// the tip, or at the upper end face.
    pub slope_um: f64,
    /// Form deviation f_falpha or f_fbeta: spread about the mean line.
    pub form_um: f64,
    /// Total deviation F_alpha or F_beta: spread of the trace about the nominal flank.
    pub total_um: f64,
    /// Crowning C_alpha or C_beta: height of the parabola over its chord, positive where the middle stands proud.
    pub crowning_um: f64,
    /// Evaluation range: roll lengths of a profile, heights of a helix, mm.
    pub range_mm: Range,
}

/// Pitch deviations on one side of the teeth, um.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PitchEvaluation {
    /// Side of the teeth.
    pub side: Side,
    /// Largest single pitch deviation f_p, without sign.
    pub single_um: f64,
    /// Total cumulative pitch deviation F_p: spread of the index deviations.
    pub total_um: f64,
}

/// All deviations of a gear, and the classes that it reaches.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GearEvaluation {
    /// Evaluation of each trace that has a range.
    pub traces: Vec<TraceEvaluation>,
    /// Evaluation of each side with pitch deviations.
    pub pitch: Vec<PitchEvaluation>,
    /// Variation of the tooth thickness R_s on the reference circle, um of arc; `None` without the pitch of both sides.
    pub thickness_variation_um: Option<f64>,
    /// Twist S_alpha of each tooth and side with profiles at two heights or more: slope at the upper less slope at the
    /// lower one, over the face width, um.
    pub twist_um: Vec<(u32, Side, f64)>,
    /// Quantity with the largest deviation of its kind (um) and the class of ISO 1328-1:2013 that allows for it; `None`
    /// beyond class 11.
    pub classes: Vec<(&'static str, f64, Option<u32>)>,
}

/// Deviations of one trace; `None` where the header has no range for it or fewer than three points lie in it.
///
/// ```text
/// z = low pass of the trace (cut-off L/30, Gaussian);   mean line by least squares over L;   parabola the same
/// f_H = rise over L,   F = max z - min z,   f_f = max (z - line) - min (z - line),   C = -c_2 of c_0 + c_1 t + c_2 t^2, t = -1 .. 1
/// ```
pub fn evaluate_trace(header: &GearHeader, trace: &Trace) -> Option<TraceEvaluation> {
    let points = trace.points(header)?;
    let range = match trace.kind {
        TraceKind::Profile(_) => header.profile_evaluation.map(|r| r.map(|d| header.roll_length(d))),
        TraceKind::Helix(_) => header.helix_evaluation,
    };
    // Without a range of its own all of it is evaluated.
    let range = range.or(Some([points.first()?[0], points.last()?[0]]))?;
    let length = range[1] - range[0];
    if length.is_nan() || length <= 0.0 {
        return None;
    }
    let filtered = low_pass(&points, CUTOFF * length);
    let slack = 1e-9 * length;
    let within: Vec<[f64; 2]> = points
        .iter()
        .zip(filtered)
        .filter(|([x, _], _)| *x >= range[0] - slack && *x <= range[1] + slack)
        .map(|([x, _], y)| [*x, y])
        .collect();
    let line = polynomial(&within, range, 1)?;
    let parabola = polynomial(&within, range, 2)?;
    let spread = |of: &dyn Fn(&[f64; 2]) -> f64| {
        let (low, high) =
            within.iter().map(of).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), y| (l.min(y), h.max(y)));
        high - low
    };
    let middle = 0.5 * (range[0] + range[1]);
    Some(TraceEvaluation {
        kind: trace.kind,
        tooth: trace.tooth,
        side: trace.side,
        slope_um: 2.0 * line[1],
        form_um: spread(&|[x, y]| y - line[1] * 2.0 * (x - middle) / length),
        total_um: spread(&|[_, y]| *y),
        crowning_um: -parabola[2],
        range_mm: range,
    })
}

fn evaluate_pitch(pitch: &Pitch) -> PitchEvaluation {
    let n = pitch.index_um.len();
    let single = (0..n).map(|i| (pitch.index_um[i] - pitch.index_um[(i + n - 1) % n]).abs()).fold(0.0, f64::max);
    PitchEvaluation { side: pitch.side, single_um: single, total_um: spread(&pitch.index_um) }
}

fn spread(values: &[f64]) -> f64 {
    let (low, high) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), y| (l.min(*y), h.max(*y)));
    if low <= high { high - low } else { 0.0 }
}

/// All deviations of a measured gear; `gear` is what tolerances are taken of.
///
/// # Errors
/// [`MetrologyError::OtherGear`] where it is another one.
pub fn evaluate(measured: &MeasuredGear, gear: &Gear) -> Result<GearEvaluation, MetrologyError> {
    crate::flanks::same_gear(&measured.header, gear)?;
    let traces: Vec<TraceEvaluation> =
        measured.traces.iter().filter_map(|trace| evaluate_trace(&measured.header, trace)).collect();
    let pitch: Vec<PitchEvaluation> = measured.pitch.iter().map(evaluate_pitch).collect();
    let of = |side: Side| measured.pitch.iter().find(|p| p.side == side);
    let thickness_variation_um = of(Side::Left).zip(of(Side::Right)).map(|(left, right)| {
        let thickness: Vec<f64> = left.index_um.iter().zip(&right.index_um).map(|(l, r)| l - r).collect();
        spread(&thickness)
    });
    Ok(GearEvaluation {
        twist_um: twists(&traces, gear),
        classes: classes(&traces, &pitch, gear),
        traces,
        pitch,
        thickness_variation_um,
    })
}

/// Twist of each tooth and side from its lowest and highest profile.
fn twists(traces: &[TraceEvaluation], gear: &Gear) -> Vec<(u32, Side, f64)> {
    let mut all = Vec::new();
    let profile = |t: &TraceEvaluation| match t.kind {
        TraceKind::Profile(z) => Some((t.tooth, t.side, z, t.slope_um)),
        TraceKind::Helix(_) => None,
    };
    let profiles: Vec<(u32, Side, f64, f64)> = traces.iter().filter_map(profile).collect();
    for (i, own) in profiles.iter().enumerate() {
        let same = |other: &&(u32, Side, f64, f64)| (other.0, other.1) == (own.0, own.1);
        if profiles[..i].iter().any(|other| same(&other)) {
            continue;
        }
        let of_tooth = || profiles.iter().filter(same);
        let lowest = of_tooth().min_by(|a, b| a.2.total_cmp(&b.2));
        let highest = of_tooth().max_by(|a, b| a.2.total_cmp(&b.2));
        if let Some((low, high)) = lowest.zip(highest).filter(|(low, high)| low.2 < high.2) {
            all.push((own.0, own.1, (high.3 - low.3) / (high.2 - low.2) * gear.face_width()));
        }
    }
    all
}

/// The largest deviation of each kind and the least class that allows for it.
///
/// F_alphaT and F_betaT are the root of the sum of squares of slope and form.
fn classes(
    traces: &[TraceEvaluation],
    pitch: &[PitchEvaluation],
    gear: &Gear,
) -> Vec<(&'static str, f64, Option<u32>)> {
    let largest = |is_profile: bool, value: fn(&TraceEvaluation) -> f64| {
        let own = traces.iter().filter(|t| matches!(t.kind, TraceKind::Profile(_)) == is_profile);
        own.map(|t| value(t).abs()).reduce(f64::max)
    };
    let of_pitch = |value: fn(&PitchEvaluation) -> f64| pitch.iter().map(value).reduce(f64::max);
    type Tolerance = fn(&FlankTolerances) -> f64;
    let all: [(&'static str, Option<f64>, Tolerance); 8] = [
        ("f_Halpha", largest(true, |t| t.slope_um), |t| t.profile_slope_um),
        ("f_falpha", largest(true, |t| t.form_um), |t| t.profile_form_um),
        ("F_alpha", largest(true, |t| t.total_um), |t| t.profile_slope_um.hypot(t.profile_form_um)),
        ("f_Hbeta", largest(false, |t| t.slope_um), |t| t.helix_slope_um),
        ("f_fbeta", largest(false, |t| t.form_um), |t| t.helix_form_um),
        ("F_beta", largest(false, |t| t.total_um), |t| t.helix_slope_um.hypot(t.helix_form_um)),
        ("f_p", of_pitch(|p| p.single_um), |t| t.single_pitch_um),
        ("F_p", of_pitch(|p| p.total_um), |t| t.total_pitch_um),
    ];
    let class = |value: f64, tolerance: Tolerance| {
        TOLERANCE_CLASSES.into_iter().find(|&class| value <= tolerance(&FlankTolerances::new(gear, class)))
    };
    all.into_iter().filter_map(|(name, value, tolerance)| Some((name, value?, class(value?, tolerance)))).collect()
}
