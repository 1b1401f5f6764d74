//! F5: a tooth change while the tooth is loaded.

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, largest, outside_of_window},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 5,
    name: "tooth change under load",
    file: "F05-loaded-swap",
    scene: scene_text!("F05-loaded-swap"),
    fails: "The window moves where the unloaded geometry says; a bent tooth that still presses off the line of action is dropped.",
    does: "A tooth is changed only where its contact force is zero; else the window waits, grows, or says which tooth is loaded.",
    naive: &["analysis.window_teeth=2"],
    look,
};

/// Teeth of a window by geometry alone: as many as the unloaded contact ratio asks for.
const BY_GEOMETRY: usize = 2;

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let fixed = bench.at_rest(&bench.naive(&[]));
    let result = bench.at_rest(&AS_IT_IS)?;
    let dropped = outside_of_window(&result, BY_GEOMETRY);
    let changes = &result.history.tooth_changes;
    let jump = largest(changes.iter().map(|c| c.force_jump));
    Ok(vec![
        Figure::new(
            "force that a tooth change takes away, N; naive: on teeth outside of a window by geometry",
            Shown::at_most(jump, 1e-3),
        )
        .beside(Shown::at_least(dropped, 100.0)),
        Figure::new("tooth changes in a cycle", Shown::at_least(changes.len() as f64, 1.0)),
        Figure::new("what is said of a window of two teeth", Shown::refused(&fixed, "window")),
    ])
}
