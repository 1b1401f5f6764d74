//! F5: a tooth change while the tooth is loaded.

use ale::{Station, ToothWindow};
use geometry::Sense;

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench},
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

/// Force on pairs outside the window that geometry alone would take, N, at the worst position.
fn left_out(bench: &Bench) -> Result<f64, EnvelopeError> {
    let result = bench.at_rest(&AS_IT_IS)?;
    let outside = |p: &ltca::StaticPosition| {
        let centre = Station { cycle: 0, phase: p.mesh_phase }.centre(Sense::Ccw);
        let first = ToothWindow::nominal_first(centre, BY_GEOMETRY);
        let inside = first..first + BY_GEOMETRY as i64;
        p.pairs.iter().filter(|q| !inside.contains(&q.pair)).map(|q| q.normal_force).sum::<f64>()
    };
    Ok(result.history.positions.iter().map(outside).fold(0.0, f64::max))
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let dropped = left_out(bench)?;
    let fixed = bench.at_rest(&bench.naive(&[]));
    let result = bench.at_rest(&AS_IT_IS)?;
    let changes = &result.history.tooth_changes;
    let jump = changes.iter().map(|c| c.force_jump).fold(0.0, f64::max);
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
