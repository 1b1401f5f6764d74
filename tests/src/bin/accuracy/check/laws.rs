//! The committed laws on measured pairs at rest and gearboxes that none of them was made of: no run is needed.

use std::collections::BTreeMap;

use analysis::{accuracy::Quantity, gearbox::GearboxCalibration};
use serde_json::Value;
use verification::{
    held_out::held_out,
    measured_gearbox::{MeasuredBound, QUANTITIES, bounds_of},
    measured_pair::MeasuredPair,
    pair_bounds::{PairBound, pair_bounds},
    pairs_done::lines,
};

use super::{Failure, median};

/// The row of all quantities together.
const ALL: &str = "all";

/// Bounds of a quantity in a stratum of pairs.
#[derive(Debug, Default)]
struct Stratum {
    bounds: usize,
    within: usize,
    /// Bound over error.
    sharpness: Vec<f64>,
}

impl Stratum {
    fn add(&mut self, bound: PairBound) {
        self.bounds += 1;
        self.within += usize::from(bound.holds());
        self.sharpness.push(bound.sharpness());
    }

    fn cell(&mut self) -> String {
        let share = 100.0 * self.within as f64 / self.bounds as f64;
        format!("{share:.1} %, {:.1}", median(&mut self.sharpness))
    }
}

/// All pairs and gearboxes of the files; tables by quantity and stratum.
pub(super) fn check(files: &[String]) -> Result<(), Failure> {
    let lines = lines(files)?;
    gearboxes(&lines);
    let pairs: Vec<MeasuredPair> = MeasuredPair::all(&lines)
        .into_iter()
        .filter(|pair| pair.has_meshes() && pair.has_curves() && held_out(pair.seed))
        .collect();
    if pairs.is_empty() {
        return Ok(());
    }
    println!("{} pairs that no law was made of: share of bounds that hold, median bound over error\n", pairs.len());
    let mut tables = BTreeMap::<&str, BTreeMap<&str, Stratum>>::new();
    for pair in &pairs {
        for q in Quantity::ALL.iter().copied().filter(|q| !q.is_of_motion()) {
            for bound in pair_bounds(pair, q) {
                for (row, stratum) in [q.key(), ALL].into_iter().flat_map(|row| strata(pair).map(|s| (row, s))) {
                    tables.entry(row).or_default().entry(stratum).or_default().add(bound);
                }
            }
        }
    }
    let names: Vec<&str> = tables.values().next().map(|row| row.keys().copied().collect()).unwrap_or_default();
    println!("| number | {} |\n|---|{}", names.join(" | "), "---|".repeat(names.len()));
    for (key, mut row) in tables {
        let cells = names.iter().map(|name| row.get_mut(name).map_or_else(|| "-".into(), Stratum::cell));
        println!("| `{key}` | {} |", cells.collect::<Vec<_>>().join(" | "));
    }
    Ok(())
}

/// What the committed factors make of bounds of gearboxes.
fn gearboxes(lines: &[Value]) {
    let all = lines.iter().filter(|line| line["seed"].as_u64().is_some_and(held_out));
    let all: Vec<Vec<MeasuredBound>> = all.map(bounds_of).filter(|own| !own.is_empty()).collect();
    if all.is_empty() {
        return;
    }
    println!(
        "{} gearboxes that no factor was made of, without the laws of pairs\n\n| number | bounds | hold | median bound over error |\n|---|---|---|---|",
        all.len()
    );
    for q in QUANTITIES {
        let factor = GearboxCalibration::committed().factor(q);
        let own: Vec<&MeasuredBound> = all.iter().flatten().filter(|bound| bound.key == q.key()).collect();
        let hold = own.iter().filter(|bound| bound.filled() <= factor).count();
        let mut sharpness: Vec<f64> = own.iter().map(|bound| bound.sharpness(factor)).collect();
        let share = 100.0 * hold as f64 / own.len() as f64;
        println!("| `{}` | {} | {share:.1} % | {:.1} |", q.key(), own.len(), median(&mut sharpness));
    }
    println!();
}

/// Strata that a pair belongs to.
fn strata(pair: &MeasuredPair) -> [&'static str; 8] {
    let scene = &pair.scene;
    let modules = scene.pair.face_width_mm / scene.pair.normal_module_mm;
    let modified = scene.gears().iter().any(|g| !g.modification.drive.is_none());
    [
        "all",
        if scene.wheel.is_internal() { "internal" } else { "external" },
        if scene.pinion.helix_angle_deg == 0.0 { "spur" } else { "helical" },
        if pair.contact_ratio() < 2.0 { "contact ratio below 2" } else { "contact ratio from 2 on" },
        if modules < 8.0 { "width below 8 m_n" } else { "width from 8 m_n on" },
        if modified { "flanks modified" } else { "flanks as generated" },
        if scene.pair.misalignment.is_none() { "aligned" } else { "misaligned" },
        match pair.pressure_mpa() {
            p if p < 500.0 => "below 500 MPa",
            p if p < 1000.0 => "500 to 1000 MPa",
            _ => "from 1000 MPa on",
        },
    ]
}
