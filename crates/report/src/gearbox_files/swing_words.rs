//! Headline of a vibration in words and numbers: summary, table and page tell the same.

use analysis::{gearbox::VibrationResult, motion::RPM};
use gearbox::{Component, EnergyShare, WhirlMode};
use scene::gearbox::Gearbox;

/// A root mean square where it is largest.
pub(super) struct Peak {
    pub name: String,
    pub force_n: f64,
    pub input_rpm: f64,
}

/// Largest dynamic force of every mesh.
pub(super) fn mesh_peaks(file: &Gearbox, swings: &VibrationResult) -> Vec<Peak> {
    let of = |(i, name): (usize, &String)| peak(swings, name, move |rms| rms.mesh_forces[i]);
    file.meshes.iter().map(|m| &m.name).enumerate().map(of).collect()
}

/// Largest force of every bearing on the housing.
pub(super) fn bearing_peaks(file: &Gearbox, swings: &VibrationResult) -> Vec<Peak> {
    let of = |(i, name): (usize, &String)| peak(swings, name, move |rms| rms.bearing_forces[i]);
    file.bearings.iter().map(|b| &b.name).enumerate().map(of).collect()
}

fn peak(swings: &VibrationResult, name: &str, of: impl Fn(&gearbox::SpeedRms) -> f64) -> Peak {
    let (speed, force_n) = swings.peak(of).unwrap_or_default();
    Peak { name: name.to_owned(), force_n, input_rpm: speed / RPM }
}

/// Parts that hold a tenth of an energy or more, largest first.
pub(super) fn holders(file: &Gearbox, shares: &[EnergyShare]) -> String {
    const LEAST: f64 = 0.1;
    let mut large: Vec<&EnergyShare> = shares.iter().filter(|s| s.share >= LEAST).collect();
    large.sort_by(|a, b| b.share.total_cmp(&a.share));
    let named = |s: &&EnergyShare| format!("{} {:.0} %", part(file, s.component), 100.0 * s.share);
    large.iter().map(named).collect::<Vec<_>>().join(", ")
}

/// The part with most of the strain energy of a mode; `None` where nothing is strained.
pub(super) fn most_strained(file: &Gearbox, mode: &WhirlMode) -> Option<String> {
    let most = mode.energy.strain.iter().max_by(|a, b| a.share.total_cmp(&b.share))?;
    Some(part(file, most.component))
}

fn part(file: &Gearbox, component: Component) -> String {
    let or = |name: Option<&String>| name.map_or_else(|| "-".to_owned(), String::clone);
    match component {
        Component::Shaft(i) => format!("shaft {}", or(file.shafts.get(i).map(|s| &s.name))),
        Component::Bearing(i) => format!("bearing {}", or(file.bearings.get(i).map(|b| &b.name))),
        Component::Housing => "housing".to_owned(),
        Component::Mesh(i) => format!("mesh {}", or(file.meshes.get(i).map(|m| &m.name))),
        Component::Disc(i) => format!("gear {}", or(file.gears.get(i).map(|g| &g.name))),
        Component::Body(i) => format!("body of gear {}", or(file.gears.get(i).map(|g| &g.name))),
        Component::Machine(0) => "machine at the input".to_owned(),
        Component::Machine(i) => format!("machine at output {i}"),
    }
}

/// Natural motions at the lowest speed.
pub(super) fn first_modes(swings: &VibrationResult) -> &[WhirlMode] {
    swings.modes.first().map_or(&[], |m| &m.modes)
}
