//! The committed laws of pairs at rest on measured pairs that none of them was made of: no run is needed.

use std::collections::BTreeMap;

use analysis::accuracy::{CalibratedMesh, Calibration, Quantity, Seen};
use verification::{
    held_out::held_out,
    measured_pair::{LEAST_ERROR, MeasuredPair, RUNGS},
    pairs_done::lines,
};

use super::{Failure, median};

/// Numbers of positions.
const OF_POSITIONS: [u32; 3] = [8, 16, 32];

/// Bounds of a quantity in a stratum of pairs.
#[derive(Debug, Default)]
struct Stratum {
    bounds: usize,
    within: usize,
    /// Bound over error.
    sharpness: Vec<f64>,
}

impl Stratum {
    fn add(&mut self, [error, known, within]: [f64; 3], scale: f64) {
        self.bounds += 1;
        self.within += usize::from((error - known).abs() <= within);
        self.sharpness.push((known.abs() + within) / error.abs().max(LEAST_ERROR * scale.abs()));
    }

    fn cell(&mut self) -> String {
        let share = 100.0 * self.within as f64 / self.bounds as f64;
        format!("{share:.1} %, {:.1}", median(&mut self.sharpness))
    }
}

/// All pairs of the files; tables by quantity and stratum.
pub(super) fn check(files: &[String]) -> Result<(), Failure> {
    let pairs: Vec<MeasuredPair> = MeasuredPair::all(&lines(files)?)
        .into_iter()
        .filter(|pair| pair.has_meshes() && pair.has_curves() && held_out(pair.seed))
        .collect();
    println!("{} pairs that no law was made of: share of bounds that hold, median bound over error\n", pairs.len());
    let mut tables = BTreeMap::<&str, BTreeMap<&str, Stratum>>::new();
    for pair in &pairs {
        for q in Quantity::ALL.iter().copied().filter(|q| !q.is_of_motion()) {
            for bound in bounds(pair, q).into_iter().flatten() {
                for stratum in strata(pair) {
                    tables.entry(q.key()).or_default().entry(stratum).or_default().add(bound.0, bound.1);
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

/// Error, known part and bound of a number on every mesh with every number of positions, and its scale.
fn bounds(pair: &MeasuredPair, q: Quantity) -> Vec<Option<([f64; 3], f64)>> {
    let meshes = RUNGS.into_iter().map(CalibratedMesh::Rung).chain([CalibratedMesh::Default]);
    let all = meshes.flat_map(|mesh| OF_POSITIONS.map(|positions| (mesh, positions)));
    all.map(|(mesh, positions)| {
        let laws = Calibration::committed().of(q)?;
        let (sample, features) = (pair.sample(mesh)?, pair.features(mesh)?);
        let (own, scale) = (sample.get(q)?, sample.scale(q)?);
        let of_mesh = laws.of_mesh(mesh)?.law.of(&features, &Seen::number(own), scale);
        let of_slices = laws.slices.of(&features, &Seen::number(own), scale);
        let at = pair.of_positions(positions)?;
        let seen = pair.seen(positions, q)?;
        let of_positions =
            laws.of_positions(positions)?.of(&pair.features_of_positions(positions)?, &seen, at.scale(q)?);
        let error = pair.mesh_error(mesh, q)? + pair.slices_error(q)? + pair.positions_error(positions, q)?;
        let [known, within] = [0, 1].map(|k| of_mesh[k] + of_slices[k] + of_positions[k]);
        Some(([error, known, within], scale))
    })
    .collect()
}

/// Strata that a pair belongs to.
fn strata(pair: &MeasuredPair) -> Vec<&'static str> {
    let scene = &pair.scene;
    let modules = scene.pair.face_width_mm / scene.pair.normal_module_mm;
    let modified = scene.gears().iter().any(|g| !g.modification.drive.is_none());
    vec![
        "all",
        if scene.pinion.helix_angle_deg == 0.0 { "spur" } else { "helical" },
        if pair.contact_ratio() < 2.0 { "contact ratio below 2" } else { "contact ratio from 2 on" },
        if modules < 8.0 { "width below 8 m_n" } else { "width from 8 m_n on" },
        if modified { "flanks modified" } else { "flanks as generated" },
        if scene.pair.misalignment.is_none() { "aligned" } else { "misaligned" },
        if pair.pressure_mpa() < 1000.0 { "below 1000 MPa" } else { "from 1000 MPa on" },
    ]
}
