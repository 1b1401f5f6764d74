//! F11: nearly incompressible material.

use fem::ElementOptions;
use mesh::ElementKind;

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{Bench, errors_um, mean},
    pieces::block::{Test, compliance},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 11,
    name: "volumetric locking",
    file: "F11-volumetric-locking",
    scene: scene_text!("F11-volumetric-locking"),
    fails: "Towards a Poisson's ratio of 0.5 elements with as many conditions on their volume as freedoms do not move at all.",
    does: "Hexahedra of the mesher (incompatible modes; reduced integration) do not lock; meshes of elements that do are warned of.",
    naive: &[],
    look,
};

/// Compliance of the pressed cube over that of a fine one, both at Poisson's ratio `nu`, less 1, %.
fn off(kind: ElementKind, cells: usize, nu: f64) -> Result<f64, EnvelopeError> {
    let options = ElementOptions::default();
    let pressed = |kind, cells| compliance(Test::Pressed, kind, [cells; 3], nu, &options);
    Ok(100.0 * (pressed(kind, cells)? / pressed(ElementKind::Hex20, 8)? - 1.0))
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let mut figures = Vec::new();
    for kind in ElementKind::ALL {
        let [metal, rubber] = [off(kind, 4, 0.3)?, off(kind, 4, 0.499)?];
        figures.push(Figure::new(
            format!("{}: {metal} {rubber}", kind.name()),
            Shown::at_most((rubber - metal).abs(), 10.0),
        ));
    }
    let error = |nu: &str, order: u32| {
        let orders = ["pinion", "wheel"].map(|g| format!("{g}.mesher.order={order}"));
        Ok::<_, EnvelopeError>(mean(&errors_um(&bench.at_rest(&[
            format!("material.poisson={nu}"),
            orders[0].clone(),
            orders[1].clone(),
        ])?)))
    };
    for nu in ["0.3", "0.45", "0.49", "0.499"] {
        let ratio = error(nu, 1)? / error(nu, 2)? - 1.0;
        figures.push(Figure::new(format!("linear over quadratic at {nu}"), Shown::at_most(100.0 * ratio.abs(), 3.0)));
    }
    Ok(figures)
}
