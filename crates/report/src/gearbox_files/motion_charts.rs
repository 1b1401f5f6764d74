//! Charts of a gearbox in motion: over time, over speed, sections, waterfalls.

use analysis::{
    gearbox::{GearboxMotionResult, MotionOrder},
    motion::{MotionSpectrum, RPM, Waterfall},
};
use answer::Answer;
use gearbox::motion::GearboxInstant;
use scene::gearbox::Gearbox;

use crate::{
    ReportError,
    charts::{Curve, line_chart},
    motion_files::{energy_chart, portrait, spectrum_chart, waterfall_chart},
};

/// Orders of a mesh that are drawn over the speed.
const DRAWN: usize = 3;
/// Change of the speed over its largest from which on a motion is a run-up.
const RUN_UP: f64 = 0.02;

/// All charts; `answer` has the tables.
///
/// # Errors
/// [`ReportError`] where rows cannot be read back.
pub(super) fn motion_charts(
    file: &Gearbox,
    motion: &GearboxMotionResult,
    answer: &Answer,
) -> Result<Vec<String>, ReportError> {
    let mut all: Vec<String> = over_time(file, motion)?.into_iter().flatten().collect();
    if let Some(energy) = answer.table("energy") {
        all.extend(energy_chart(energy, "time [s]", &|t| t)?);
    }
    if is_run_up(motion) {
        all.extend(over_speed(file, motion).into_iter().flatten());
        all.extend(
            motion.campbell.iter().filter_map(|own| super::vibration::campbell(own, &|m| format!("natural mode {m}"))),
        );
        all.extend(motion.waterfall.iter().flat_map(|own| waterfalls(file, own)));
        return Ok(all);
    }
    all.extend(motion.spectrum.iter().flat_map(|own| spectra(file, own)));
    if let Some((rows, section)) = answer.table("motion").zip(answer.table("section")) {
        for (i, mesh) in file.meshes.iter().enumerate() {
            let whose = format!("the transmission error of mesh {}", mesh.name);
            all.extend(portrait([rows, section], &format!("mesh_{}_dte", i + 1), [&whose, "once a common period"])?);
        }
    }
    Ok(all)
}

/// Waterfalls of every mesh, and of the bearing with the largest line.
fn waterfalls(file: &Gearbox, of: &Waterfall) -> Vec<String> {
    let speed = "speed of the input [1/min]";
    let lines: Vec<&[Vec<f64>]> = of.lines.iter().map(|line| &line.amplitudes[..]).collect();
    let one = |(place, whose, unit): (usize, String, &str)| waterfall_chart(of, place, [&whose, unit], speed);
    shown(file, &lines).into_iter().filter_map(one).collect()
}

/// Spectra of the same.
fn spectra(file: &Gearbox, of: &MotionSpectrum) -> Vec<String> {
    let one = |(place, whose, unit): (usize, String, &str)| {
        spectrum_chart(of, place, [&format!("Spectrum of {whose}"), &format!("amplitude [{unit}]")])
    };
    shown(file, &[&of.amplitudes]).into_iter().filter_map(one).collect()
}

/// What is shown of spectra with these amplitudes: place among the quantities, name and unit.
fn shown(file: &Gearbox, amplitudes: &[&[Vec<f64>]]) -> Vec<(usize, String, &'static str)> {
    let mesh = |(i, mesh): (usize, &scene::gearbox::GearboxMesh)| {
        let dte = format!("the DTE of mesh {}", mesh.name);
        let force = format!("the normal force of mesh {}", mesh.name);
        [(2 * i, dte, "um"), (2 * i + 1, force, "N")]
    };
    let place = |bearing: usize| 2 * file.meshes.len() + bearing;
    let largest = |bearing: usize| {
        let lines = amplitudes.iter().filter_map(|own| own.get(place(bearing))?.get(1..)).flatten();
        lines.fold(0.0, |m: f64, a| m.max(*a))
    };
    let strongest = (0..file.bearings.len()).max_by(|&a, &b| largest(a).total_cmp(&largest(b)));
    let bearing = strongest.map(|i| (place(i), format!("the force of bearing {}", file.bearings[i].name), "N"));
    file.meshes.iter().enumerate().flat_map(mesh).chain(bearing).collect()
}

/// Whether the speed changes so much that what is seen of orders is seen over it.
pub(super) fn is_run_up(motion: &GearboxMotionResult) -> bool {
    let speed = motion.reached.input_speed;
    !motion.orders.is_empty() && speed.span() > RUN_UP * speed.largest
}

fn over_time(file: &Gearbox, motion: &GearboxMotionResult) -> Result<[Option<String>; 5], ReportError> {
    let curves = |names: Vec<&str>, of: &dyn Fn(&GearboxInstant, usize) -> f64| -> Result<Vec<Curve>, ReportError> {
        let curve = |name: &str| Curve { label: name.to_owned(), points: Vec::with_capacity(motion.rows.len()) };
        let mut all: Vec<Curve> = names.into_iter().map(curve).collect();
        motion.rows.for_each(0..motion.rows.len(), |p| {
            all.iter_mut().enumerate().for_each(|(i, curve)| curve.points.push((p.time, of(p, i))));
        })?;
        Ok(all)
    };
    let meshes = || file.meshes.iter().map(|mesh| mesh.name.as_str()).collect();
    let bearings = file.bearings.iter().map(|bearing| bearing.name.as_str()).collect();
    let dte = curves(meshes(), &|p, i| 1e3 * p.meshes[i].transmission_error)?;
    let mut forces = curves(meshes(), &|p, i| p.meshes[i].normal_force)?;
    let coast = curves(meshes(), &|p, i| p.meshes[i].coast_normal_force)?;
    let pressed = coast.into_iter().zip(&motion.reached.meshes).filter(|(_, mesh)| mesh.coast_normal_force > 0.0);
    forces.extend(pressed.map(|(own, _)| Curve { label: format!("{}, coast flanks", own.label), ..own }));
    let radial = curves(bearings, &|p, i| p.bearings[i].force[0].hypot(p.bearings[i].force[1]))?;
    let swings = radial.iter().map(less_its_mean).collect::<Vec<_>>();
    let torque = curves(vec!["input"], &|p, _| 1e-3 * p.input_torque)?;
    let time = "time [s]";
    Ok([
        line_chart("Dynamic transmission error", time, "DTE [um]", &dte, false),
        line_chart("Normal force of the meshes", time, "force [N]", &forces, true),
        line_chart("Radial force of the bearings", time, "force [N]", &radial, true),
        line_chart("Radial force of the bearings less its mean", time, "force less its mean [N]", &swings, false),
        line_chart("Torque on the input", time, "torque [N m]", &torque, false),
    ])
}

/// A curve about its mean.
fn less_its_mean(of: &Curve) -> Curve {
    let mean = of.points.iter().map(|(_, value)| value).sum::<f64>() / of.points.len().max(1) as f64;
    Curve { label: of.label.clone(), points: of.points.iter().map(|(at, value)| (*at, value - mean)).collect() }
}

/// Orders of every mesh: its own transmission error and the force of the bearing that has most of it.
fn over_speed(file: &Gearbox, motion: &GearboxMotionResult) -> [Option<String>; 2] {
    let curves = |of: &dyn Fn(&MotionOrder) -> f64| -> Vec<Curve> {
        let each = (0..file.meshes.len()).flat_map(|mesh| (1..=DRAWN).map(move |order| (mesh, order)));
        let one = |(mesh, order): (usize, usize)| {
            let own = motion.orders.iter().filter(|o| o.mesh == mesh && o.order == order);
            let points: Vec<(f64, f64)> = own.map(|o| (o.speed.abs() / RPM, of(o))).collect();
            Curve { label: format!("{}, order {order}", file.meshes[mesh].name), points }
        };
        each.map(one).filter(|curve| !curve.points.is_empty()).collect()
    };
    let largest = |o: &MotionOrder| o.bearing_forces.iter().copied().fold(0.0, f64::max);
    let speed = "speed of the input [1/min]";
    [
        line_chart(
            "Mesh orders in the transmission error",
            speed,
            "amplitude [um]",
            &curves(&|o| 1e3 * o.transmission_errors[o.mesh]),
            true,
        ),
        line_chart("Mesh orders at the bearing that has most of them", speed, "amplitude [N]", &curves(&largest), true),
    ]
}
