//! F4: coordinates at a tooth change.

use ale::Station;
use geometry::Sense;

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 4,
    name: "mode-switch vibration",
    file: "F04-mode-switch",
    scene: scene_text!("F04-mode-switch"),
    fails: "The oncoming tooth starts from zero: the displacement field is torn, energy jumps, and the pair rings at every change.",
    does: "Coordinates and velocities go over by a cyclic relabelling of the same field, at no load of the outgoing tooth.",
    naive: &[],
    look,
};

/// Strain energy of the pinion before a change, after it, and after one that starts the oncoming tooth from zero.
fn energies(bench: &Bench) -> Result<[f64; 3], EnvelopeError> {
    let piece = "tooth change";
    let missing = |what: &str| EnvelopeError::piece("tooth change", what);
    let fail = |e: reduction::ReductionError| EnvelopeError::piece(piece, e);
    let solved = bench.at_rest(&["analysis.kind=static", "contact.method=nodal", "contact.points_per_face_edge=4"])?;
    let gear_pair = solved.pair;
    let mut model = solved.model.ok_or_else(|| missing("no model"))?;
    // The run ends before the first change is due; phase 0 is where it is.
    let before = model.solve(Station { cycle: 0, phase: 0.0 }).map_err(EnvelopeError::of(piece))?;
    let windows = model.contact_set().windows().ok_or_else(|| missing("no window"))?;
    let from = windows[0].clone();
    let displacements = model.last().ok_or_else(|| missing("no equilibrium"))?.displacements[0].clone();
    let forces: Vec<f64> = before.pairs.iter().map(|p| p.normal_force).collect();
    let next = model.window().change(Sense::Cw, &forces).or_else(|_| model.window().change(Sense::Ccw, &forces));
    let next = next.map_err(EnvelopeError::of(piece))?;
    let gear = analysis::reduced(&model.gears()[0]).ok_or_else(|| missing("no reduced gear"))?;
    let to = gear.window(next.first_teeth()[0]).map_err(fail)?;
    let carried = gear.carry(&from, &to, &displacements).map_err(fail)?;
    let mut naive = carried.clone();
    let teeth: Vec<u32> = to.reduced.teeth.iter().copied().filter(|t| !from.reduced.teeth.contains(t)).collect();
    for tooth in teeth {
        let faces = gear.gear().flank(tooth % gear_pair.pinion.teeth(), model.options().side());
        for node in faces.ok_or_else(|| missing("no such flank"))?.iter().flat_map(|f| f.nodes()) {
            if let Some(at) = to.reduced.position(*node) {
                naive[3 * at..3 * at + 3].fill(0.0);
            }
        }
    }
    Ok([
        from.reduced.strain_energy(&displacements),
        to.reduced.strain_energy(&carried),
        to.reduced.strain_energy(&naive),
    ])
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let [before, carried, naive] = energies(bench)?;
    let result = bench.in_motion(&AS_IT_IS)?;
    let headline = &result.headline;
    let jump = headline.certificate.force_jump_at_tooth_change_n / headline.mean_normal_force_n;
    // Lines between the mesh harmonics over whole turns are what changes alone could make.
    let rows: Vec<f64> = result.rows.iter().map(|r| r.dte_um).collect();
    let per_cycle = headline.rows_per_cycle as usize;
    let repeats = rows.iter().zip(&rows[per_cycle..]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    Ok(vec![
        Figure::new(
            "strain energy after a tooth change over that before, less 1; naive: the oncoming tooth from zero",
            Shown::at_most((carried / before - 1.0).abs(), 1e-9),
        )
        .beside(Shown::at_least((naive / before - 1.0).abs(), 1e-3)),
        Figure::new(
            "motion: jump of the contact force at a tooth change over the mean force",
            Shown::at_most(jump, 1e-6),
        ),
        Figure::new(
            "motion: difference of successive mesh cycles over the peak to peak",
            Shown::at_most(repeats / headline.peak_to_peak_dte_um, 1e-6),
        ),
    ])
}
