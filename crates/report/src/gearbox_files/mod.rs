//! The answer about a gearbox: positions, shaft lines, line loads, vibration, rows in time, headline numbers, page.

mod branch;
mod motion;
mod motion_charts;
mod motion_tables;
mod page;
mod space;
mod summary;
mod swing_words;
mod vibration;
mod vibration_rows;

pub use page::charts as gearbox_charts;

use std::sync::Arc;

use analysis::{
    gearbox::{GearFrequencies, GearboxCampbell, GearboxResult, VibrationResult},
    motion::{MotionSpectrum, Waterfall},
};
use answer::{Answer, Cost, Table};
use columns::{ENERGY, gearbox as rows};
use described::Key;
use gearbox::ExcitationLine;
use scene::gearbox::Gearbox;
use serde_json::json;
use study::Campbell;

use crate::{ReportError, Written, branch_files, write_result};
use store::folder::ResultDirectory;

/// The answer about a gearbox: of rest `positions`, `shafts`, `line_load`, of gears on
/// bolts `bolts`; of a vibration `modes`, `campbell`,
/// `crossings`, `response`, `rms`, `bearing_forces`; of a motion `motion`, `energy`, `section` where it comes back to where its meshes
/// began, and, where it is long enough to tell orders, `motion_orders` and of a run-up `waterfall`, of that `cycles`, and `campbell` and `crossings` without a vibration, as well; of a branch over the speed `branch`, `bifurcations`, `in_time`.
///
/// # Errors
/// [`ReportError::Study`] for rows that hold what is no number.
pub fn gearbox_answer(file: &Gearbox, result: &GearboxResult, cost: Cost) -> Result<Answer, ReportError> {
    let mut tables = vec![
        rows::positions(file, &result.positions),
        rows::shafts(file, &result.positions),
        rows::line_loads(&result.meshes, &result.positions),
    ];
    if result.positions.iter().flat_map(|own| &own.bolts).any(|bolts| !bolts.is_empty()) {
        tables.push(rows::bolts(file, &result.positions));
    }
    if let Some(swings) = &result.vibration {
        tables.extend([
            vibration_rows::modes(file, swings),
            vibration_rows::campbell(&swings.campbell),
            vibration_rows::crossings(&swings.campbell),
            vibration_rows::response(file, swings),
            vibration_rows::rms(file, swings),
            vibration_rows::bearing_forces(file, swings),
        ]);
    }
    if let Some(own) = &result.motion {
        let rows = rows::motion(file, &own.rows);
        let section = motion_tables::section(own, &rows)?;
        let energy = ENERGY.sheet(&(), &[]).kept("energy", &(), &own.ledger, |row| row);
        tables.extend([rows, energy].into_iter().chain(section));
        if !own.orders.is_empty() {
            tables.push(motion_tables::orders(file, &own.orders));
        }
        tables.extend(own.spectrum.as_ref().map(|own| motion_tables::spectrum(file, own)));
        tables.extend(own.waterfall.as_ref().map(|own| motion_tables::waterfall(file, own)));
        if let Some(own) = &own.campbell {
            tables.extend([vibration_rows::campbell(own), vibration_rows::crossings(own)]);
        }
        tables.extend((!own.run_ups.is_empty()).then(|| motion_tables::cycles(file, &own.run_ups)));
    }
    tables.extend(result.branch.iter().flat_map(|own| branch_files::tables(&branch::shown(file, own))));
    Ok(Answer {
        kind: "gearbox",
        name: file.name.clone(),
        inputs: json!({ "gearbox": file.file }),
        tables,
        headline: result.headline(),
        checks: result.checks(),
        remarks: result.remarks.clone(),
        info: summary::info(file, result),
        cost,
    })
}

/// Tables of a gearbox without rows, and objects of its summary with their keys, for `docs/outputs.md`.
pub(crate) fn documented(file: &Gearbox) -> (Vec<Table>, Vec<(&'static str, Vec<Key>)>) {
    let line = |name: &str| ExcitationLine { name: name.to_owned(), order: 1.0 };
    let (frequencies, orders) = (vec![Vec::new()], vec![1.0, 1.0]);
    let none = VibrationResult {
        gears: Vec::new(),
        // Columns that only elastic gears have are there.
        gear_modes: vec![Some(GearFrequencies { frequencies_hz: Vec::new(), by_sectors: true })],
        mesh_stiffness: Vec::new(),
        transmission_error: Vec::new(),
        modes_kept: 0,
        modes_up_to_hz: 0.0,
        modes: Vec::new(),
        campbell: GearboxCampbell {
            diagram: Campbell { speeds: Vec::new(), frequencies, orders, resonances: Vec::new() },
            lines: vec![line("mesh_1_order_1"), line("shaft_1")],
        },
        speeds: Vec::new(),
        orders: Vec::new(),
        rms: Vec::new(),
    };
    let mut tables = vec![
        rows::positions(file, &[]),
        rows::shafts(file, &[]),
        rows::line_loads(&[], &[]),
        rows::bolts(file, &[]),
        vibration_rows::modes(file, &none),
        vibration_rows::campbell(&none.campbell),
        vibration_rows::crossings(&none.campbell),
        vibration_rows::response(file, &none),
        vibration_rows::rms(file, &none),
        vibration_rows::bearing_forces(file, &none),
        rows::motion(file, &Arc::default()),
        motion_tables::orders(file, &[]),
        motion_tables::spectrum(file, &MotionSpectrum::default()),
        motion_tables::waterfall(file, &Waterfall::default()),
        motion_tables::cycles(file, &[]),
    ];
    tables.extend(branch_files::tables(&branch::without_rows(file)));
    let objects = summary::OBJECTS.iter().map(|(name, keys)| (*name, keys.to_vec()));
    (tables, objects.chain(motion::objects()).chain(branch::objects()).collect())
}

/// Writes all files of a gearbox, `summary.json` last: where it is, everything is. What comes back is the closing table.
///
/// # Errors
/// When the system refuses, or the page cannot be filled.
pub fn write_gearbox(
    file: &Gearbox,
    result: &GearboxResult,
    cost: Cost,
    results: &ResultDirectory,
) -> Result<Written, ReportError> {
    let answer = gearbox_answer(file, result, cost)?;
    if let Some(swings) = &result.vibration {
        results.write("bearing_forces.uff", vibration_rows::universal(file, swings).as_bytes())?;
    }
    let page = page::gearbox_page(file, result, &answer)?;
    write_result(answer, &page, file.parquet, results)
}

/// Length of a force.
fn norm(force: [f64; 3]) -> f64 {
    force[0].hypot(force[1]).hypot(force[2])
}
