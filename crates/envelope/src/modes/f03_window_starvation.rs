//! F3: more pairs touch than the window has teeth.

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, largest, outside_of_window},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 3,
    name: "window starvation",
    file: "F03-window-starvation",
    scene: scene_text!("F03-window-starvation"),
    fails: "Under load teeth bend so far that a pair beside the window would touch; without it the pair is too soft.",
    does: "The window grows, with a warning that names the load; a window that the user has fixed is refused.",
    naive: &["analysis.window_teeth=3"],
    look,
};

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let fixed = bench.at_rest(&bench.naive(&[]));
    let result = bench.at_rest(&AS_IT_IS)?;
    let teeth = result.facts.window_teeth.unwrap_or(0) as usize;
    let jump = largest(result.history.tooth_changes.iter().map(|c| c.error_jump));
    Ok(vec![
        Figure::new(
            "what is said of a window of three teeth",
            Shown::warned(&result.history.remarks, "the window was widened"),
        )
        .beside(Shown::refused(&fixed, "window")),
        Figure::new(
            "force outside of the window, N; naive: of three teeth",
            Shown::at_most(outside_of_window(&result, teeth), 0.0),
        )
        .beside(Shown::at_least(outside_of_window(&result, 3), 100.0)),
        Figure::new(
            "jump of the transmission error at a tooth change of the wider window, um",
            Shown::at_most(1e3 * jump, 1e-6),
        ),
    ])
}
