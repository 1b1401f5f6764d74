//! Natural motions of a gearbox as files with commas.

use analysis::gearbox_at_rest::GearboxSwings;
use gearbox::{Component, WhirlMode};
use scene::gearbox::Gearbox;
use study::Columns;

use crate::columns_to_csv;

/// `modes.csv`: natural motions at the first and the last speed, a row each. Parts are numbered from 1 in the order of
/// the file.
pub(super) fn modes(file: &Gearbox, swings: &GearboxSwings) -> String {
    let parts = parts(file);
    let first = ["input_rpm", "mode", "frequency_hz"].map(str::to_owned);
    let whirl = (1..=file.shafts.len()).map(|i| format!("shaft_{i}_whirl"));
    let shares = parts.iter().map(|(name, _, _)| name.clone());
    let mut rows = Columns::named(first.into_iter().chain(whirl).chain(shares));
    let speeds = &swings.campbell.speeds;
    let ends = [0, swings.modes.len().saturating_sub(1)];
    for &at in if ends[0] == ends[1] { &ends[..1] } else { &ends[..] } {
        let Some(found) = swings.modes.get(at) else { continue };
        for (i, mode) in found.modes.iter().enumerate() {
            let first = [60.0 * speeds[at], (i + 1) as f64, mode.frequency / std::f64::consts::TAU];
            let shares = parts.iter().map(|(_, component, strain)| share(mode, *component, *strain));
            rows.push(first.into_iter().chain(mode.whirl.iter().copied()).chain(shares));
        }
    }
    columns_to_csv(&rows)
}

/// Columns of the shares of energy: name, part, and whether it is strain.
fn parts(file: &Gearbox) -> Vec<(String, Component, bool)> {
    let each = |count: usize, name: &'static str, of: fn(usize) -> Component, strain: bool| {
        let what = if strain { "strain_share" } else { "kinetic_share" };
        (0..count).map(move |i| (format!("{name}_{}_{what}", i + 1), of(i), strain))
    };
    let strain = each(file.shafts.len(), "shaft", Component::Shaft, true)
        .chain(each(file.bearings.len(), "bearing", Component::Bearing, true))
        .chain(each(file.meshes.len(), "mesh", Component::Mesh, true))
        .chain([("housing_strain_share".to_owned(), Component::Housing, true)]);
    let kinetic = each(file.shafts.len(), "shaft", Component::Shaft, false)
        .chain(each(file.gears.len(), "gear", Component::Disc, false))
        .chain([("input_kinetic_share".to_owned(), Component::Machine(0), false)])
        .chain(each(file.torques.len(), "output", |i| Component::Machine(i + 1), false));
    strain.chain(kinetic).collect()
}

/// Share of a part in a mode, 0 where it has none.
pub(super) fn share(mode: &WhirlMode, component: Component, strain: bool) -> f64 {
    let all = if strain { &mode.energy.strain } else { &mode.energy.kinetic };
    all.iter().find(|s| s.component == component).map_or(0.0, |s| s.share)
}

/// `campbell.csv`: natural frequencies and lines of excitation, one row a speed.
pub(super) fn campbell(swings: &GearboxSwings) -> String {
    let diagram = &swings.campbell;
    let modes = (1..=diagram.frequencies.len()).map(|m| format!("mode_{m}_hz"));
    let lines = swings.lines.iter().map(|l| format!("{}_hz", l.name));
    let mut rows = Columns::named(std::iter::once("input_rpm".to_owned()).chain(modes).chain(lines));
    for (s, &speed) in diagram.speeds.iter().enumerate() {
        let modes = diagram.frequencies.iter().map(|m| m[s]);
        let lines = diagram.orders.iter().map(|o| o * speed);
        rows.push(std::iter::once(60.0 * speed).chain(modes).chain(lines));
    }
    columns_to_csv(&rows)
}

/// `crossings.csv`: where a line of excitation meets a natural frequency, ascending in speed.
pub(super) fn crossings(swings: &GearboxSwings) -> String {
    let mut csv = "input_rpm,frequency_hz,mode,line\n".to_owned();
    for meeting in &swings.campbell.resonances {
        let line = swings.lines.iter().find(|l| l.order == meeting.order).map_or("", |l| l.name.as_str());
        for value in [60.0 * meeting.speed, meeting.frequency, (meeting.mode + 1) as f64] {
            crate::csv::push_number(&mut csv, value);
            csv.push(',');
        }
        csv.push_str(line);
        csv.push('\n');
    }
    csv
}
