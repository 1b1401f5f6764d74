//! Checks raw values of the tables for motion.

use toml::Spanned;

use crate::models::table;
use crate::schema::{
    Integration, MotionScene, RawBasins, RawContinuation, RawMotion, RawRamp, RawSweep, Run, SweepScene, SweepWay,
};
use crate::source::Source;
use crate::spanned::Number;
use crate::{BasinScene, ContinuationScene, RampScene, SceneError};

type Checked<T> = Result<T, SceneError>;
type Span = std::ops::Range<usize>;

const STEADY: (&str, Run) = ("steady", Run::Steady);
const SHOOTING: (&str, Run) = ("shooting", Run::Shooting);
const SPAN: (&str, Run) = ("span", Run::Span);
const RAMP: (&str, Run) = ("ramp", Run::Ramp);
const SWEEP: (&str, Run) = ("sweep", Run::Sweep);
const CONTINUATION: (&str, Run) = ("continuation", Run::Continuation);
const BASINS: (&str, Run) = ("basins", Run::Basins);

/// Which analyses a key belongs to.
fn only(s: &Source<'_>, key: &str, span: Option<Span>, run: Run, allowed: &[(&'static str, Run)]) -> Checked<()> {
    let Some(span) = span.filter(|_| allowed.iter().all(|(_, r)| *r != run)) else { return Ok(()) };
    let names: Vec<String> = allowed.iter().map(|(name, _)| format!("`run = \"{name}\"`")).collect();
    let what = format!("`{key}` belongs to {}", names.join(" or "));
    Err(s.conflict(&span, what, "leave it out, or say so in `run`"))
}

fn span<T>(value: &Option<Spanned<T>>) -> Option<Span> {
    value.as_ref().map(Spanned::span)
}

/// `length`: keys of `[analysis]` that say how many cycles there are, and where.
pub(crate) fn motion(
    s: &Source<'_>,
    raw: &RawMotion,
    length: [Option<(&'static str, Span)>; 2],
) -> Checked<MotionScene> {
    let run = choice!(s, raw.run)?;
    check_keys_of_run(s, raw, run, &length)?;
    let method = method(s, raw)?;
    if let (Some(_), Some(per_length)) = (&raw.mesh_damping_ratio, &raw.mesh_damping_ns_per_mm2) {
        let what = "`mesh_damping_ratio` and `mesh_damping_ns_per_mm2` both say how the mesh is damped";
        return Err(s.conflict(&per_length.span(), what, "keep one of them"));
    }
    let settles = matches!(run, Run::Steady | Run::Shooting | Run::Sweep | Run::Continuation | Run::Basins);
    let writes_checkpoints = matches!(run, Run::Steady | Run::Span | Run::Ramp);
    let read = MotionScene::read(s, raw, f64::INFINITY)?;
    Ok(MotionScene {
        spectral_radius: read.spectral_radius.filter(|_| method == Integration::GeneralisedAlpha),
        mesh_damping_ratio: read.mesh_damping_ratio.filter(|_| read.mesh_damping_ns_per_mm2.is_none()),
        periodic_tolerance: read.periodic_tolerance.filter(|_| settles),
        warm_up_cycles: read.warm_up_cycles.filter(|_| settles),
        checkpoint_every_cycles: read.checkpoint_every_cycles.filter(|_| writes_checkpoints),
        ramp: table(&raw.ramp, run == Run::Ramp, |words| ramp(s, words, span(&raw.run)))?,
        sweep: table(&raw.sweep, run == Run::Sweep, |words| sweep(s, words, span(&raw.run)))?,
        continuation: table(&raw.continuation, run == Run::Continuation, |words| {
            continuation(s, words, span(&raw.run))
        })?,
        basins: table(&raw.basins, run == Run::Basins, |words| basins(s, words, span(&raw.run)))?,
        ..read
    })
}

/// Keys go with the run that they say something of.
fn check_keys_of_run(
    s: &Source<'_>,
    raw: &RawMotion,
    run: Run,
    length: &[Option<(&'static str, Span)>; 2],
) -> Checked<()> {
    for (key, at, allowed) in [
        ("periodic_tolerance", span(&raw.periodic_tolerance), &[STEADY, SHOOTING, SWEEP, CONTINUATION, BASINS][..]),
        ("warm_up_cycles", span(&raw.warm_up_cycles), &[STEADY, SHOOTING, SWEEP, CONTINUATION, BASINS][..]),
        ("duration_s", span(&raw.duration_s), &[SPAN][..]),
        ("checkpoint_every_cycles", span(&raw.checkpoint_every_cycles), &[STEADY, SPAN, RAMP][..]),
        ("ramp", span(&raw.ramp), &[RAMP][..]),
        ("sweep", span(&raw.sweep), &[SWEEP][..]),
        ("continuation", span(&raw.continuation), &[CONTINUATION][..]),
        ("basins", span(&raw.basins), &[BASINS][..]),
    ] {
        only(s, key, at, run, allowed)?;
    }
    for (key, at) in length.iter().flatten() {
        only(s, key, Some(at.clone()), run, &[STEADY, SHOOTING, SPAN, SWEEP, CONTINUATION, BASINS])?;
        if let Some(duration) = &raw.duration_s {
            let what = format!("`duration_s` and `{key}` both say how long the span is");
            return Err(s.conflict(&duration.span(), what, "keep one of them"));
        }
    }
    Ok(())
}

/// The method, with what belongs to it alone.
fn method(s: &Source<'_>, raw: &RawMotion) -> Checked<Integration> {
    let method = choice!(s, raw.method)?;
    let alpha = method == Integration::GeneralisedAlpha;
    if let (false, Some(rho)) = (alpha, &raw.spectral_radius) {
        let what = "`spectral_radius` belongs to `method = \"generalised-alpha\"`";
        return Err(s.conflict(&rho.span(), what, "leave it out: this method has none"));
    }
    Ok(method)
}

/// Keys of a table that have no default.
fn needed(s: &Source<'_>, table: &str, keys: &[(&str, &Number)], run: Option<Span>) -> Checked<()> {
    let gone: Vec<String> = keys.iter().filter(|(_, v)| v.is_none()).map(|(key, _)| format!("`{key}`")).collect();
    if gone.is_empty() {
        return Ok(());
    }
    let what = format!("[motion.{table}] has no {}", gone.join(", no "));
    Err(s.conflict(&run.unwrap_or(0..0), what, "from where to where has no default"))
}

fn ramp(s: &Source<'_>, raw: &RawRamp, run: Option<Span>) -> Checked<RampScene> {
    let keys = [("from_rpm", &raw.from_rpm), ("to_rpm", &raw.to_rpm), ("duration_s", &raw.duration_s)];
    needed(s, "ramp", &keys, run)?;
    let read = RampScene::read(s, raw, f64::INFINITY)?;
    if let (Some(to), true) = (&raw.to_rpm, read.to_rpm == read.from_rpm) {
        let what = format!("`to_rpm` is {0}, and so is `from_rpm`: the speed stays", read.to_rpm);
        return Err(s.conflict(&to.span(), what, "take `run = \"span\"` with `speed_rpm`, or another `to_rpm`"));
    }
    Ok(read)
}

fn sweep(s: &Source<'_>, raw: &RawSweep, run: Option<Span>) -> Checked<SweepScene> {
    needed(s, "sweep", &[("from_rpm", &raw.from_rpm), ("to_rpm", &raw.to_rpm)], run)?;
    let mut read = SweepScene::read(s, raw, f64::INFINITY)?;
    if let (Some(to), true) = (&raw.to_rpm, read.to_rpm <= read.from_rpm) {
        let what = format!("`to_rpm` is {}, not above `from_rpm`, {}", read.to_rpm, read.from_rpm);
        return Err(s.conflict(&to.span(), what, "the way is said by `ways`"));
    }
    if read.ways.is_empty() {
        read.ways = vec![SweepWay::Up, SweepWay::Down];
    }
    Ok(read)
}

fn continuation(s: &Source<'_>, raw: &RawContinuation, run: Option<Span>) -> Checked<ContinuationScene> {
    needed(s, "continuation", &[("from", &raw.from), ("to", &raw.to)], run)?;
    let read = ContinuationScene::read(s, raw, f64::INFINITY)?;
    if let (Some(to), true) = (&raw.to, read.from == read.to) {
        return Err(s.conflict(&to.span(), "`from` and `to` are the same", "`from` and `to` must differ"));
    }
    if let (Some(most), true) = (&raw.most_harmonics, read.most_harmonics < read.harmonics) {
        let what =
            format!("`most_harmonics` is {}, less than the {} to begin with", read.most_harmonics, read.harmonics);
        return Err(s.conflict(&most.span(), what, "give more, or fewer `harmonics`"));
    }
    Ok(read)
}

fn basins(s: &Source<'_>, raw: &RawBasins, run: Option<Span>) -> Checked<BasinScene> {
    let keys =
        [("from_um", &raw.from_um), ("to_um", &raw.to_um), ("from_mm_s", &raw.from_mm_s), ("to_mm_s", &raw.to_mm_s)];
    needed(s, "basins", &keys, run)?;
    let read = BasinScene::read(s, raw, f64::INFINITY)?;
    for (key, of, to, from) in
        [("um", &raw.to_um, read.to_um, read.from_um), ("mm_s", &raw.to_mm_s, read.to_mm_s, read.from_mm_s)]
    {
        if let (Some(at), true) = (of, to < from) {
            let what = format!("`to_{key}` is {to}, below `from_{key}`, {from}");
            return Err(s.conflict(&at.span(), what, "give the lower end as `from`"));
        }
    }
    Ok(read)
}
