//! From the words of the tables on motion to what they mean.

use toml::Spanned;

use super::raw::{Matrix, RawBearing, RawBody, RawDrive, RawLoad, RawMotion, RawRamp, RawSweep};
use super::{
    Axis, BearingScene, BodyScene, DriveBy, DriveScene, Integration, MotionScene, RampScene, Run, SteadyBy, SweepScene,
    SweepWay, TorqueScene,
};
use crate::scene::raw::{Number, Whole};
use crate::scene::source::Source;
use crate::scene::{SceneError, schema};

type Checked<T> = Result<T, SceneError>;
type Span = std::ops::Range<usize>;

const AXES: [(&str, Axis); 5] = [("x", Axis::X), ("y", Axis::Y), ("z", Axis::Z), ("rx", Axis::Rx), ("ry", Axis::Ry)];

fn conflict(s: &Source<'_>, span: &Span, what: String, advice: &str) -> SceneError {
    SceneError::Conflict { place: s.place(span), what, advice: advice.into() }
}

pub(in crate::scene) fn body(s: &Source<'_>, raw: &RawBody) -> Checked<BodyScene> {
    let mut free = Vec::new();
    for word in raw.free.iter().flatten() {
        if word.get_ref() == "turn" {
            let what = "`free` lists \"turn\", which is no choice".into();
            let advice = "leave it out: the driven gear's turn is always free, the driver's when a torque drives it";
            return Err(conflict(s, &word.span(), what, advice));
        }
        let axis = s.one_of("free", word, &AXES)?;
        if !free.contains(&axis) {
            free.push(axis);
        }
    }
    free.sort_by_key(|a| a.number());
    Ok(BodyScene {
        mass_kg: s.optional_of(&schema::BODY, "mass_kg", &raw.mass_kg)?,
        transverse_inertia_kg_m2: s.optional_of(
            &schema::BODY,
            "transverse_inertia_kg_m2",
            &raw.transverse_inertia_kg_m2,
        )?,
        polar_inertia_kg_m2: s.optional_of(&schema::BODY, "polar_inertia_kg_m2", &raw.polar_inertia_kg_m2)?,
        added_inertia_kg_m2: s.number_of(&schema::BODY, "added_inertia_kg_m2", &raw.added_inertia_kg_m2)?,
        free,
    })
}

/// A bearing of a gear whose coordinates `free` are free: each of them is held, and nothing else is said.
pub(in crate::scene) fn bearing(
    s: &Source<'_>,
    raw: Option<&RawBearing>,
    free: &[Axis],
    free_at: Option<Span>,
    whose: &str,
) -> Checked<BearingScene> {
    let none = RawBearing::default();
    let raw = raw.unwrap_or(&none);
    let stiffness = [
        ("stiffness_x_n_per_mm", &raw.stiffness_x_n_per_mm),
        ("stiffness_y_n_per_mm", &raw.stiffness_y_n_per_mm),
        ("stiffness_z_n_per_mm", &raw.stiffness_z_n_per_mm),
        ("stiffness_rx_nmm_per_rad", &raw.stiffness_rx_nmm_per_rad),
        ("stiffness_ry_nmm_per_rad", &raw.stiffness_ry_nmm_per_rad),
    ];
    let damping = [
        ("damping_x_ns_per_mm", &raw.damping_x_ns_per_mm),
        ("damping_y_ns_per_mm", &raw.damping_y_ns_per_mm),
        ("damping_z_ns_per_mm", &raw.damping_z_ns_per_mm),
        ("damping_rx_nmms_per_rad", &raw.damping_rx_nmms_per_rad),
        ("damping_ry_nmms_per_rad", &raw.damping_ry_nmms_per_rad),
    ];
    one_way(s, "stiffness_matrix_n_mm_rad", &raw.stiffness_matrix_n_mm_rad, &stiffness)?;
    one_way(s, "damping_matrix_ns_mm_rad", &raw.damping_matrix_ns_mm_rad, &damping)?;
    let matrices = [
        ("stiffness_matrix_n_mm_rad", &raw.stiffness_matrix_n_mm_rad),
        ("damping_matrix_ns_mm_rad", &raw.damping_matrix_ns_mm_rad),
    ];
    if let Some((key, Some(matrix))) = matrices.into_iter().find(|(_, m)| m.is_some() && free.is_empty()) {
        let what = format!("`{key}` holds nothing: no coordinate of the {whose} is free");
        let advice = format!("add `free` to [{whose}.body], or leave it out");
        return Err(conflict(s, &matrix.span(), what, &advice));
    }
    for (i, axis) in Axis::ALL.into_iter().enumerate() {
        let is_free = free.contains(&axis);
        for (key, value) in [stiffness[i], damping[i]] {
            if let Some(value) = value.as_ref().filter(|_| !is_free) {
                let what = format!("`{key}` holds a coordinate of the {whose} that is not free");
                let advice = format!("add \"{}\" to `free` in [{whose}.body], or leave it out", AXES[i].0);
                return Err(conflict(s, &value.span(), what, &advice));
            }
        }
        if let (true, None, None, Some(span)) =
            (is_free, stiffness[i].1, &raw.stiffness_matrix_n_mm_rad, free_at.as_ref())
        {
            let what = format!("\"{}\" of the {whose} is free, but no bearing holds it", AXES[i].0);
            return Err(conflict(s, span, what, &format!("give `{}` in [{whose}.bearing]", stiffness[i].0)));
        }
    }
    let of = |list: &[(&str, &Number); 5], i: usize| s.optional_of(&schema::BEARING, list[i].0, list[i].1);
    Ok(BearingScene {
        stiffness_x_n_per_mm: of(&stiffness, 0)?,
        stiffness_y_n_per_mm: of(&stiffness, 1)?,
        stiffness_z_n_per_mm: of(&stiffness, 2)?,
        stiffness_rx_nmm_per_rad: of(&stiffness, 3)?,
        stiffness_ry_nmm_per_rad: of(&stiffness, 4)?,
        stiffness_rz_nmm_per_rad: s.optional_of(
            &schema::BEARING,
            "stiffness_rz_nmm_per_rad",
            &raw.stiffness_rz_nmm_per_rad,
        )?,
        damping_ratio: match (free.is_empty(), &raw.damping_ratio) {
            (true, Some(value)) => {
                let what = format!("`damping_ratio` has nothing to damp: no coordinate of the {whose} is free");
                let advice = format!("add `free` to [{whose}.body], or leave it out");
                return Err(conflict(s, &value.span(), what, &advice));
            }
            (true, None) => None,
            (false, ratio) => Some(s.number_of(&schema::BEARING, "damping_ratio", ratio)?),
        },
        damping_x_ns_per_mm: of(&damping, 0)?,
        damping_y_ns_per_mm: of(&damping, 1)?,
        damping_z_ns_per_mm: of(&damping, 2)?,
        damping_rx_nmms_per_rad: of(&damping, 3)?,
        damping_ry_nmms_per_rad: of(&damping, 4)?,
        damping_rz_nmms_per_rad: s.optional_of(
            &schema::BEARING,
            "damping_rz_nmms_per_rad",
            &raw.damping_rz_nmms_per_rad,
        )?,
        stiffness_matrix_n_mm_rad: matrix(s, "stiffness_matrix_n_mm_rad", &raw.stiffness_matrix_n_mm_rad)?,
        damping_matrix_ns_mm_rad: matrix(s, "damping_matrix_ns_mm_rad", &raw.damping_matrix_ns_mm_rad)?,
    })
}

/// A matrix says it all, or single values do.
fn one_way(s: &Source<'_>, key: &str, matrix: &Matrix, single: &[(&str, &Number); 5]) -> Checked<()> {
    let Some(matrix) = matrix else { return Ok(()) };
    match single.iter().find(|(_, value)| value.is_some()) {
        None => Ok(()),
        Some((other, _)) => Err(conflict(
            s,
            &matrix.span(),
            format!("`{key}` and `{other}` say the same thing twice"),
            "keep the matrix, or the values of the directions",
        )),
    }
}

/// Five rows of five finite numbers, symmetric, with no negative value on the diagonal.
fn matrix(s: &Source<'_>, key: &str, raw: &Matrix) -> Checked<Option<[[f64; 5]; 5]>> {
    let Some(rows) = raw else { return Ok(None) };
    let bad = |span: &Span, what: &str| {
        let advice = "five rows of five numbers, in the order x, y, z, rx, ry";
        Err(conflict(s, span, format!("`{key}` {what}"), advice))
    };
    let mut all = [[0.0; 5]; 5];
    if rows.get_ref().len() != 5 {
        return bad(&rows.span(), &format!("has {} rows, not 5", rows.get_ref().len()));
    }
    for (to, row) in all.iter_mut().zip(rows.get_ref()) {
        match <[f64; 5]>::try_from(row.get_ref().as_slice()) {
            Ok(values) if values.iter().all(|v| v.is_finite()) => *to = values,
            Ok(_) => return bad(&row.span(), "holds what is no number"),
            Err(_) => return bad(&row.span(), &format!("has a row of {} numbers", row.get_ref().len())),
        }
    }
    let largest = all.iter().flatten().fold(0.0, |m: f64, v| m.max(v.abs()));
    let symmetric = (0..5).all(|i| (0..i).all(|j| (all[i][j] - all[j][i]).abs() <= 1e-9 * largest));
    if !symmetric {
        return bad(&rows.span(), "is not symmetric");
    }
    if (0..5).any(|i| all[i][i] < 0.0) {
        return bad(&rows.span(), "has a negative value on its diagonal");
    }
    Ok(Some(all))
}

pub(in crate::scene) fn drive(s: &Source<'_>, raw: &RawDrive) -> Checked<DriveScene> {
    let by = s.choice("by", &raw.by, &[("speed", DriveBy::Speed), ("torque", DriveBy::Torque)])?;
    let torque = torque(s, [&raw.torque_nm, &raw.amplitude_nm, &raw.frequency_hz, &raw.phase_deg], &raw.table_s_nm)?;
    let first = [&raw.torque_nm, &raw.amplitude_nm, &raw.frequency_hz, &raw.phase_deg];
    let span = first.iter().find_map(|v| v.as_ref().map(Spanned::span)).or(raw.table_s_nm.as_ref().map(Spanned::span));
    match (by, span) {
        (DriveBy::Speed, Some(span)) => {
            let what = "a driver whose speed is given takes whatever torque that needs".into();
            Err(conflict(s, &span, what, "say `by = \"torque\"` in [drive], or leave the torque out"))
        }
        _ => Ok(DriveScene { by, torque }),
    }
}

pub(in crate::scene) fn load(s: &Source<'_>, raw: &RawLoad) -> Checked<TorqueScene> {
    torque(s, [&None, &raw.amplitude_nm, &raw.frequency_hz, &raw.phase_deg], &raw.table_s_nm)
}

fn torque(s: &Source<'_>, [mean, amplitude, frequency, phase]: [&Number; 4], table: &Matrix) -> Checked<TorqueScene> {
    let all = [("torque_nm", mean), ("amplitude_nm", amplitude), ("frequency_hz", frequency), ("phase_deg", phase)];
    let said = |(key, value): &(&'static str, &Number)| value.as_ref().map(|v| (*key, v.span()));
    if let (Some(_), Some((key, span))) = (table, all.iter().find_map(said)) {
        let what = format!("`{key}` stands beside a table, which says everything");
        return Err(conflict(s, &span, what, "keep one of them"));
    }
    if amplitude.is_some() != frequency.is_some() || (phase.is_some() && amplitude.is_none()) {
        let (key, span) = all[1..].iter().find_map(said).unwrap_or(("amplitude_nm", 0..0));
        let what = format!("`{key}` alone makes no harmonic torque");
        return Err(conflict(s, &span, what, "give `amplitude_nm` and `frequency_hz` (and `phase_deg`)"));
    }
    Ok(TorqueScene {
        torque_nm: s.optional_of(&schema::DRIVE, "torque_nm", mean)?,
        amplitude_nm: s.optional_of(&schema::DRIVE, "amplitude_nm", amplitude)?,
        frequency_hz: s.optional_of(&schema::DRIVE, "frequency_hz", frequency)?,
        phase_deg: amplitude.as_ref().map(|_| s.number_of(&schema::DRIVE, "phase_deg", phase)).transpose()?,
        table_s_nm: time_table(s, table)?,
    })
}

fn time_table(s: &Source<'_>, raw: &Matrix) -> Checked<Option<Vec<[f64; 2]>>> {
    let Some(rows) = raw else { return Ok(None) };
    let advice = "rows of time (s, ascending) and torque (N m): table_s_nm = [[0.0, 150.0], [0.1, -20.0]]";
    let bad = |span: &Span, what: String| Err(conflict(s, span, what, advice));
    let mut all: Vec<[f64; 2]> = Vec::new();
    for row in rows.get_ref() {
        match <[f64; 2]>::try_from(row.get_ref().as_slice()) {
            Ok([time, torque]) if time.is_finite() && torque.is_finite() => {
                if all.last().is_some_and(|last| last[0] >= time) {
                    return bad(&row.span(), format!("`table_s_nm` goes back to {time} s"));
                }
                all.push([time, torque]);
            }
            _ => return bad(&row.span(), "a row of `table_s_nm` is not two numbers".into()),
        }
    }
    if all.is_empty() {
        return bad(&rows.span(), "`table_s_nm` is empty".into());
    }
    Ok(Some(all))
}

/// Which analyses a key belongs to.
fn only(s: &Source<'_>, key: &str, span: Option<Span>, run: Run, allowed: &[(&'static str, Run)]) -> Checked<()> {
    let Some(span) = span.filter(|_| allowed.iter().all(|(_, r)| *r != run)) else { return Ok(()) };
    let names: Vec<String> = allowed.iter().map(|(name, _)| format!("`run = \"{name}\"`")).collect();
    let what = format!("`{key}` belongs to {}", names.join(" or "));
    Err(conflict(s, &span, what, "leave it out, or say so in `run`"))
}

fn span<T>(value: &Option<Spanned<T>>) -> Option<Span> {
    value.as_ref().map(Spanned::span)
}

pub(in crate::scene) fn motion(s: &Source<'_>, raw: &RawMotion, cycles: &Whole) -> Checked<MotionScene> {
    const STEADY: (&str, Run) = ("steady", Run::Steady);
    const SHOOTING: (&str, Run) = ("shooting", Run::Shooting);
    const SPAN: (&str, Run) = ("span", Run::Span);
    const RAMP: (&str, Run) = ("ramp", Run::Ramp);
    const SWEEP: (&str, Run) = ("sweep", Run::Sweep);
    let run = s.choice("run", &raw.run, &[STEADY, SHOOTING, SPAN, RAMP, SWEEP])?;
    for (key, at, allowed) in [
        ("periodic_tolerance", span(&raw.periodic_tolerance), &[STEADY, SHOOTING, SWEEP][..]),
        ("warm_up_cycles", span(&raw.warm_up_cycles), &[STEADY, SHOOTING, SWEEP][..]),
        ("duration_s", span(&raw.duration_s), &[SPAN][..]),
        ("checkpoint_every_cycles", span(&raw.checkpoint_every_cycles), &[STEADY, SPAN, RAMP][..]),
        ("ramp", span(&raw.ramp), &[RAMP][..]),
        ("sweep", span(&raw.sweep), &[SWEEP][..]),
        ("cycles", span(cycles), &[STEADY, SHOOTING, SPAN, SWEEP][..]),
    ] {
        only(s, key, at, run, allowed)?;
    }
    if let (Some(duration), Some(_)) = (&raw.duration_s, cycles) {
        let what = "`duration_s` and `cycles` both say how long the span is".into();
        return Err(conflict(s, &duration.span(), what, "keep one of them"));
    }
    let method = s.choice(
        "method",
        &raw.method,
        &[
            ("energy", Integration::Energy),
            ("generalised-alpha", Integration::GeneralisedAlpha),
            ("newmark", Integration::Newmark),
            ("dormand-prince", Integration::DormandPrince),
            ("rk4", Integration::RungeKutta4),
        ],
    )?;
    let alpha = method == Integration::GeneralisedAlpha;
    if let (false, Some(rho)) = (alpha, &raw.spectral_radius) {
        let what = "`spectral_radius` belongs to `method = \"generalised-alpha\"`".into();
        return Err(conflict(s, &rho.span(), what, "leave it out: this method has none"));
    }
    if let (Some(_), Some(per_length)) = (&raw.mesh_damping_ratio, &raw.mesh_damping_ns_per_mm2) {
        let what = "`mesh_damping_ratio` and `mesh_damping_ns_per_mm2` both say how the mesh is damped".into();
        return Err(conflict(s, &per_length.span(), what, "keep one of them"));
    }
    let settles = matches!(run, Run::Steady | Run::Shooting | Run::Sweep);
    let ramp_words = RawRamp::default();
    let sweep_words = RawSweep::default();
    Ok(MotionScene {
        run,
        method,
        spectral_radius: alpha
            .then(|| s.number_of(&schema::MOTION, "spectral_radius", &raw.spectral_radius))
            .transpose()?,
        steps_per_mesh_cycle: s.whole_of(&schema::MOTION, "steps_per_mesh_cycle", &raw.steps_per_mesh_cycle)?,
        steps_per_resonance: s.whole_of(&schema::MOTION, "steps_per_resonance", &raw.steps_per_resonance)?,
        error_tolerance: s.optional_of(&schema::MOTION, "error_tolerance", &raw.error_tolerance)?,
        stop_at_events: raw.stop_at_events.as_ref().is_some_and(|on| *on.get_ref()),
        mesh_damping_ratio: match raw.mesh_damping_ns_per_mm2 {
            Some(_) => None,
            None => Some(s.number_of(&schema::MOTION, "mesh_damping_ratio", &raw.mesh_damping_ratio)?),
        },
        mesh_damping_ns_per_mm2: s.optional_of(
            &schema::MOTION,
            "mesh_damping_ns_per_mm2",
            &raw.mesh_damping_ns_per_mm2,
        )?,
        periodic_tolerance: settles
            .then(|| s.number_of(&schema::MOTION, "periodic_tolerance", &raw.periodic_tolerance))
            .transpose()?,
        warm_up_cycles: settles
            .then(|| s.whole_of(&schema::MOTION, "warm_up_cycles", &raw.warm_up_cycles))
            .transpose()?,
        duration_s: s.optional_of(&schema::MOTION, "duration_s", &raw.duration_s)?,
        checkpoint_every_cycles: matches!(run, Run::Steady | Run::Span | Run::Ramp)
            .then(|| s.whole_of(&schema::MOTION, "checkpoint_every_cycles", &raw.checkpoint_every_cycles))
            .transpose()?,
        ramp: (run == Run::Ramp)
            .then(|| ramp(s, raw.ramp.as_ref().map_or(&ramp_words, |r| r.get_ref()), span(&raw.run)))
            .transpose()?,
        sweep: (run == Run::Sweep)
            .then(|| sweep(s, raw.sweep.as_ref().map_or(&sweep_words, |r| r.get_ref()), span(&raw.run)))
            .transpose()?,
    })
}

/// Keys of a table that have no default.
fn needed(s: &Source<'_>, table: &str, keys: &[(&str, &Number)], run: Option<Span>) -> Checked<()> {
    let gone: Vec<String> = keys.iter().filter(|(_, v)| v.is_none()).map(|(key, _)| format!("`{key}`")).collect();
    if gone.is_empty() {
        return Ok(());
    }
    let what = format!("[motion.{table}] has no {}", gone.join(", no "));
    Err(conflict(s, &run.unwrap_or(0..0), what, "from where to where has no default"))
}

fn ramp(s: &Source<'_>, raw: &RawRamp, run: Option<Span>) -> Checked<RampScene> {
    let keys = [("from_rpm", &raw.from_rpm), ("to_rpm", &raw.to_rpm), ("duration_s", &raw.duration_s)];
    needed(s, "ramp", &keys, run)?;
    Ok(RampScene {
        from_rpm: s.number_of(&schema::RAMP, "from_rpm", &raw.from_rpm)?,
        to_rpm: s.number_of(&schema::RAMP, "to_rpm", &raw.to_rpm)?,
        duration_s: s.number_of(&schema::RAMP, "duration_s", &raw.duration_s)?,
        before_s: s.number_of(&schema::RAMP, "before_s", &raw.before_s)?,
        after_s: s.number_of(&schema::RAMP, "after_s", &raw.after_s)?,
        waterfall_cycles: s.whole_of(&schema::RAMP, "waterfall_cycles", &raw.waterfall_cycles)?,
    })
}

fn sweep(s: &Source<'_>, raw: &RawSweep, run: Option<Span>) -> Checked<SweepScene> {
    needed(s, "sweep", &[("from_rpm", &raw.from_rpm), ("to_rpm", &raw.to_rpm)], run)?;
    let from_rpm = s.number_of(&schema::SWEEP, "from_rpm", &raw.from_rpm)?;
    let to_rpm = s.number_of(&schema::SWEEP, "to_rpm", &raw.to_rpm)?;
    if let (Some(to), true) = (&raw.to_rpm, to_rpm <= from_rpm) {
        let what = format!("`to_rpm` is {to_rpm}, not above `from_rpm`, {from_rpm}");
        return Err(conflict(s, &to.span(), what, "the way is said by `ways`"));
    }
    const WAYS: [(&str, SweepWay); 3] = [("apart", SweepWay::Apart), ("up", SweepWay::Up), ("down", SweepWay::Down)];
    let mut ways = Vec::new();
    for word in raw.ways.iter().flatten() {
        let way = s.one_of("ways", word, &WAYS)?;
        if !ways.contains(&way) {
            ways.push(way);
        }
    }
    if ways.is_empty() {
        ways = vec![SweepWay::Up, SweepWay::Down];
    }
    let by = [("running", SteadyBy::Running), ("shooting", SteadyBy::Shooting)];
    Ok(SweepScene {
        from_rpm,
        to_rpm,
        speeds: s.whole_of(&schema::SWEEP, "speeds", &raw.speeds)?,
        ways,
        steady_by: s.choice("steady_by", &raw.steady_by, &by)?,
    })
}
