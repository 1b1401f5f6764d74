//! F10: linear elements that lock in tooth bending.

use fem::{ElementOptions, IncompatibleModes};
use mesh::ElementKind;

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, errors_um, mean},
    pieces::block::{Test, compliance},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 10,
    name: "shear locking",
    file: "F10-shear-locking",
    scene: scene_text!("F10-shear-locking"),
    fails: "Plain linear hexahedra cannot bend: a cantilever reaches two thirds of its deflection, a tooth is too stiff.",
    does: "Linear hexahedra have incompatible bending modes that pass the patch test; quadratic ones are the default.",
    naive: &[],
    look,
};

const ONE_THROUGH: [usize; 3] = [10, 1, 1];

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let bent = |kind, cells, modes| {
        let options = ElementOptions { incompatible_modes: modes, ..ElementOptions::default() };
        compliance(Test::Bent, kind, cells, 0.3, &options)
    };
    let exact = bent(ElementKind::Hex20, [20, 4, 4], IncompatibleModes::Taylor)?;
    let off =
        |modes| Ok::<_, EnvelopeError>(100.0 * (1.0 - bent(ElementKind::Hex8, ONE_THROUGH, modes)? / exact).abs());
    let (robust, plain) = (off(IncompatibleModes::Taylor)?, off(IncompatibleModes::Off)?);
    let linear = mean(&errors_um(&bench.at_rest(&AS_IT_IS)?));
    let quadratic = mean(&errors_um(&bench.at_rest(&["pinion.mesher.order=2", "wheel.mesher.order=2"])?));
    Ok(vec![
        Figure::new(
            "deflection of a cantilever of ten hex8, % off; naive: without incompatible modes",
            Shown::at_most(robust, 3.0),
        )
        .beside(Shown::at_least(plain, 25.0)),
        Figure::new(
            "mean transmission error on linear elements against quadratic ones, % off",
            Shown::at_most(100.0 * (linear / quadratic - 1.0).abs(), 5.0),
        ),
    ])
}
