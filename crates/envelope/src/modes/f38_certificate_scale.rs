//! F38: a certificate that divides by what is large.

use analysis::motion::EnergyRow;

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, largest},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 38,
    name: "certificate scaled by what is large",
    file: "F38-certificate-scale",
    scene: scene_text!("F38-certificate-scale"),
    fails: "Energy that does not close is divided by the work through the pair: of a light vibration half of the ledger may be missing, and the certificate holds.",
    does: "What every step adds or takes is measured by the kinetic and elastic energy that comes and goes in it.",
    naive: &[],
    look,
};

/// Energy that rows open, over what comes and goes from row to row, of a ledger in which `lost` of the supplied work is
/// not booked.
fn open(rows: &[EnergyRow], lost: f64) -> f64 {
    let sum = |of: &dyn Fn(&EnergyRow) -> f64| rows.windows(2).map(|w| (of(&w[1]) - of(&w[0])).abs()).sum::<f64>();
    sum(&|row| row.residual_mj + lost * row.supplied_mj) / (sum(&|row| row.kinetic_mj) + sum(&|row| row.elastic_mj))
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let mapped = bench.lumped(&AS_IT_IS)?;
    let reduced = bench.in_motion(&["analysis.model=reduced"])?;
    let rows: Vec<EnergyRow> = reduced.rows.part(0..reduced.rows.len())?.iter().map(|row| row.energy).collect();
    let missing = largest(rows.iter().map(|row| (0.5 * row.supplied_mj).abs()));
    Ok(vec![
        Figure::new(
            "half of the supplied work left out: open energy over that of the vibration; naive: over the work through the pair",
            Shown::at_least(open(&rows, 0.5), 0.1),
        )
        .beside(Shown::at_most(missing / reduced.headline.certificate.work_through_pair_mj, 1e-2)),
        Figure::new("the same with all work booked", Shown::at_most(open(&rows, 0.0), 1e-6)),
        Figure::new(
            "certificate of the model \"mapped\" under a torque: open energy over that of the vibration",
            Shown::at_most(mapped.headline.certificate.energy_open_over_vibration, 1e-6),
        ),
    ])
}
