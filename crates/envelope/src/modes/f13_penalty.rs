//! F13: a penalty is too soft, or spoils the equations.

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, errors_um, mean},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 13,
    name: "penalty too soft or too stiff",
    file: "F13-penalty",
    scene: scene_text!("F13-penalty"),
    fails: "A penalty lets flanks overlap by what they press: too soft it adds a spring, too stiff it spoils the equations.",
    does: "Contact is exact (a complementarity problem on the reduced gears); a penalty is an option, and tends to it.",
    naive: &["contact.penalty_mpa_per_mm=1e5"],
    look,
};

/// Six decades, MPa/mm.
const PENALTIES: [&str; 7] = ["1e5", "1e6", "1e7", "1e8", "1e9", "1e10", "1e11"];

/// Mean transmission error with each penalty against that of exact contact: it falls in proportion to 1/penalty
/// to a plateau, which differs from exact contact by what lies between the points of a face, and nothing scatters on
/// the way.
fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let exact = mean(&errors_um(&bench.at_rest(&AS_IT_IS)?));
    let mut off = Vec::new();
    for penalty in PENALTIES {
        let result = bench.at_rest(&[format!("contact.penalty_mpa_per_mm={penalty}")])?;
        off.push(100.0 * (mean(&errors_um(&result)) / exact - 1.0));
    }
    let stiffest = off[off.len() - 1].abs();
    let falls = off.windows(2).filter(|w| w[1].abs() > w[0].abs().max(1e-6)).count();
    Ok(vec![
        Figure::new(
            "mean transmission error against exact contact, % (10^11 MPa/mm; naive: 10^5)",
            Shown::at_most(stiffest, 1.5),
        )
        .beside(Shown::at_least(off[0], 5.0)),
        Figure::new("plateau: change over the last decade, %", Shown::at_most((off[5] - off[6]).abs(), 0.2)),
        Figure::new("decades of penalty, of six, in which the error does not fall", Shown::at_most(falls as f64, 0.0)),
    ])
}
