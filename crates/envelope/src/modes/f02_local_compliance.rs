//! F2: local compliance taken from the mesh.

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{Bench, errors_um, largest, mean},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 2,
    name: "mesh-dependent local compliance",
    file: "F02-local-compliance",
    scene: scene_text!("F02-local-compliance"),
    fails: "The local (Hertzian) compliance is that of the elements: deflection and pressure change with every mesh.",
    does: "Slices take the bodies' part from the mesh and the local part from the closed form, at a matched depth.",
    naive: &["contact.method=nodal"],
    look,
};

/// Elements along the profile and the face.
const MESHES: [[u32; 2]; 2] = [[3, 6], [5, 10]];

fn settings([profile, face]: [u32; 2]) -> Vec<String> {
    ["pinion", "wheel"]
        .iter()
        .flat_map(|g| [format!("{g}.mesher.elements_profile={profile}"), format!("{g}.mesher.elements_face={face}")])
        .collect()
}

/// Mean transmission error and largest pressure on a mesh and on a finer one.
fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let changes = |naive: bool| {
        let solved = MESHES.map(|mesh| {
            let mut all = settings(mesh);
            all.extend(if naive { bench.naive(&[]) } else { Vec::new() });
            bench.at_rest(&all)
        });
        let [coarse, fine] = solved;
        let (coarse, fine) = (coarse?, fine?);
        let error = mean(&errors_um(&coarse)) / mean(&errors_um(&fine)) - 1.0;
        let pressure = |r: &analysis::StaticResult| largest(r.history.positions.iter().map(|p| p.max_pressure));
        Ok::<_, EnvelopeError>([error, pressure(&coarse) / pressure(&fine) - 1.0].map(|x| 100.0 * x.abs()))
    };
    let [[error, pressure], [naive_error, _]] = [changes(false)?, changes(true)?];
    Ok(vec![
        Figure::new(
            "mean transmission error on three elements along the profile against five, % off",
            Shown::at_most(error, 1.0),
        )
        .beside(Shown::at_least(naive_error, 2.5)),
        Figure::new(
            "largest pressure on three elements along the profile against five, % off",
            Shown::at_most(pressure, 1.0),
        ),
    ])
}
