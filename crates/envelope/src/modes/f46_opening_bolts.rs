//! F46: bolts that open.

use analysis::gearbox::GearboxResult;
use gearbox::BoltForce;

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, largest},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 46,
    name: "bolts that open",
    file: "F46-opening-bolts",
    scene: scene_text!("F46-opening-bolts"),
    fails: "Bolts and seats are springs both ways: where a ring bends away from one it is pulled back by a force that no bolt has.",
    does: "Each bolt is a row of the one contact problem: it presses, or has lifted off; a preload counts.",
    naive: &["mesh.stage.scene.wheel.bore.bolts.opens=false"],
    look,
};

fn bolts(result: &GearboxResult) -> impl Iterator<Item = &BoltForce> {
    result.positions.iter().flat_map(|p| p.bolts.iter().flatten())
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let (robust, naive) = (bench.gearbox_at_rest(&AS_IT_IS)?, bench.gearbox_at_rest(&bench.naive(&[]))?);
    let pressed = bench.gearbox_at_rest(&["mesh.stage.scene.wheel.bore.bolts.preload_n=20000"])?;
    let pull = |result: &GearboxResult| largest(bolts(result).map(|own| (-own.radial).max(0.0)));
    let lag = |result: &GearboxResult| result.outputs[0].mean;
    let opened = 100.0 * (lag(&robust) / lag(&pressed) - 1.0);
    Ok(vec![
        Figure::new("largest pull of a bolt, N; naive: bolts that do not open", Shown::at_most(pull(&robust), 0.0))
            .beside(Shown::at_least(pull(&naive), 10.0)),
        Figure::new("largest number of bolts that are open", Shown::at_least(most_open(&robust), 1.0)),
        Figure::new(
            "lag of the output beyond that with a preload that keeps all bolts closed, %",
            Shown::at_least(opened, 0.01),
        ),
    ])
}

fn most_open(result: &GearboxResult) -> f64 {
    let open = |bolts: &Vec<BoltForce>| bolts.iter().filter(|own| own.open).count() as f64;
    largest(result.positions.iter().map(|p| p.bolts.iter().map(open).sum()))
}
