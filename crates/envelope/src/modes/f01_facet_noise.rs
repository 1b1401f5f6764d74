//! F1: flat faces of the mesh taken for the flank.

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, errors_um, peak_to_peak},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 1,
    name: "facet noise",
    file: "F01-facet-noise",
    scene: scene_text!("F01-facet-noise"),
    fails: "Flat faces of the mesh are taken for the flank: their sagitta h^2/(8 rho) goes into the transmission error.",
    does: "The gap is that of the exact involute; the mesh carries compliance alone.",
    naive: &["contact.gap=facet"],
    look,
};

/// Twice as many elements along the flank.
const FINER: [&str; 2] = ["pinion.mesher.elements_profile=8", "wheel.mesher.elements_profile=8"];

/// Peak to peak of the transmission error under next to no load, which is all noise on unmodified flanks; and how it
/// goes with the size of the elements: to the second power.
fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let noise = |settings: &[String]| Ok::<_, EnvelopeError>(peak_to_peak(&errors_um(&bench.at_rest(settings)?)));
    let smooth = peak_to_peak(&errors_um(&bench.at_rest(&AS_IT_IS)?));
    let [facet, finer] = [noise(&bench.naive(&[]))?, noise(&bench.naive(&FINER))?];
    let order = (facet / finer).log2();
    Ok(vec![
        Figure::new("peak to peak of the transmission error at 1 N m, um", Shown::at_most(smooth, 0.05))
            .beside(Shown::at_least(facet, 0.2)),
        Figure::new("order of the facets' noise in the size of the elements", Shown::at_least(order, 1.5)),
    ])
}
