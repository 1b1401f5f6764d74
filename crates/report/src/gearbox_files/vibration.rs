//! How a gearbox swings, as parts of its page.

use analysis::{
    gearbox::{GearboxCampbell, VibrationResult},
    motion::RPM,
};
use scene::gearbox::{Gearbox, GearboxVibration};
use study::Campbell;

use super::swing_words::{bearing_peaks, first_modes, holders, mesh_peaks, most_strained};
use crate::{
    charts::{Curve, campbell_chart, line_chart, stick_chart},
    page::{Cell, Grid, Part},
};

/// Orders that are drawn as lines of a Campbell diagram at the most.
const DRAWN: usize = 8;
/// Modes that the closing table lists.
const LISTED: usize = 8;

/// Modes, charts, largest forces.
pub(super) fn parts(file: &Gearbox, asked: &GearboxVibration, swings: &VibrationResult) -> Vec<Part> {
    let charts =
        [campbell(&swings.campbell, &|m| mode_name(file, swings, m)), meshes(file, swings), bearings(file, swings)];
    let charts = charts.into_iter().flatten().chain(spectra(file, swings));
    let rows: Vec<Vec<Cell>> = first_modes(swings)
        .iter()
        .enumerate()
        .map(|(i, mode)| {
            vec![
                Cell::count(i + 1),
                Cell::number(mode.frequency / std::f64::consts::TAU, 1),
                Cell::text(holders(file, &mode.energy.strain)),
                Cell::text(holders(file, &mode.energy.kinetic)),
            ]
        })
        .collect();
    let words = format!(
        "Natural frequencies at {:.1} rpm input speed, with the mean stiffness of every mesh. Columns: shares of strain energy \
         and of kinetic energy. The picture in space shows each mode as a shape.",
        swings.campbell.diagram.speeds.first().map_or(f64::NAN, |s| 60.0 * s)
    );
    let of_meshes = mesh_peaks(file, swings).into_iter().zip(&swings.mesh_stiffness).map(|(peak, stiffness)| {
        vec![
            Cell::text(peak.name),
            Cell::number(1e-3 * stiffness, 1),
            Cell::number(peak.force_n, 1),
            Cell::number(peak.input_rpm, 0),
        ]
    });
    let of_bearings = bearing_peaks(file, swings)
        .into_iter()
        .map(|peak| vec![Cell::text(peak.name), Cell::number(peak.force_n, 2), Cell::number(peak.input_rpm, 0)]);
    let forces = format!("Root mean square of all orders of all meshes, damping ratio {:.3}.", asked.damping_ratio);
    let head = ["mode", "Hz", "strain energy in", "kinetic energy in"];
    // A terminal has no room for where the kinetic energy is.
    let narrow = Grid::new(head[..3].iter().copied()).rows(rows.iter().take(LISTED).map(|row| row[..3].to_vec()));
    vec![
        Part::new("Natural frequencies").closing().words(words).grid(narrow),
        Part::more().grid(Grid::new(head).rows(rows)).figures(charts),
        Part::new("Largest dynamic forces")
            .closing()
            .words(forces)
            .grid(Grid::new(["mesh", "mean stiffness N/um", "dynamic force rms N", "at input 1/min"]).rows(of_meshes))
            .grid(Grid::new(["bearing", "force on the housing rms N", "at input 1/min"]).rows(of_bearings)),
    ]
}

/// Natural frequencies over speed with the lowest orders of every mesh.
pub(super) fn campbell(
    GearboxCampbell { diagram, lines }: &GearboxCampbell,
    mode_name: &dyn Fn(usize) -> String,
) -> Option<String> {
    let first = lines.iter().enumerate().filter(|(_, l)| l.name.ends_with("_order_1"));
    let rest = lines.iter().enumerate().filter(|(_, l)| !l.name.ends_with("_order_1") && l.name.contains("order"));
    let (numbers, names): (Vec<usize>, Vec<String>) =
        first.chain(rest).take(DRAWN).map(|(i, l)| (i, l.name.replace('_', " "))).unzip();
    let orders = numbers.iter().map(|i| diagram.orders[*i]).collect();
    let modes: Vec<String> = (1..=diagram.frequencies.len()).map(mode_name).collect();
    campbell_chart(&Campbell { orders, ..diagram.clone() }, &names, &modes)
}

/// Name of a mode in the diagram, counted from 1: by the part that is strained most.
fn mode_name(file: &Gearbox, swings: &VibrationResult, mode: usize) -> String {
    let strained = first_modes(swings).get(mode - 1);
    match strained.and_then(|own| most_strained(file, own)) {
        Some(part) => format!("mode {mode}: {part}"),
        None => String::new(),
    }
}

/// Orders of the loaded transmission error that excite.
fn spectra(file: &Gearbox, swings: &VibrationResult) -> Vec<String> {
    let of = |(mesh, orders): (&scene::gearbox::GearboxMesh, &Vec<f64>)| {
        let points = orders.iter().zip(1u32..).map(|(mm, order)| (f64::from(order), 1e3 * mm)).collect();
        let title = format!("Orders of the static transmission error of mesh {}", mesh.name);
        stick_chart(&title, "mesh order", "amplitude [um]", Curve { label: "amplitude".to_owned(), points })
    };
    file.meshes.iter().zip(&swings.transmission_error).filter_map(of).collect()
}

/// A root mean square over the speed of the input.
fn over_speed(swings: &VibrationResult, label: &str, of: impl Fn(usize) -> f64) -> Curve {
    let points = swings.speeds.iter().enumerate().map(|(s, speed)| (speed / RPM, of(s)));
    Curve { label: label.to_owned(), points: points.collect() }
}

const SPEED: &str = "speed of the input [1/min]";

fn meshes(file: &Gearbox, swings: &VibrationResult) -> Option<String> {
    let of = |(i, mesh): (usize, &scene::gearbox::GearboxMesh)| {
        over_speed(swings, &mesh.name, |s| swings.rms[s].mesh_forces[i])
    };
    let curves: Vec<Curve> = file.meshes.iter().enumerate().map(of).collect();
    line_chart("Dynamic normal force of the meshes", SPEED, "root mean square [N]", &curves, true)
}

fn bearings(file: &Gearbox, swings: &VibrationResult) -> Option<String> {
    let of = |(i, bearing): (usize, &scene::gearbox::GearboxBearing)| {
        over_speed(swings, &bearing.name, |s| swings.rms[s].bearing_forces[i])
    };
    let curves: Vec<Curve> = file.bearings.iter().enumerate().map(of).collect();
    line_chart("Forces of the bearings on the housing", SPEED, "root mean square [N]", &curves, true)
}
