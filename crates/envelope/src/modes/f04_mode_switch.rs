//! F4: coordinates at a tooth change.

use geometry::Sense;
use ltca::{StaticModel, StaticPosition};

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{Bench, largest},
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
fn energies(position: &StaticPosition, model: &StaticModel) -> Result<[f64; 3], EnvelopeError> {
    let missing = |what: &str| EnvelopeError::piece("tooth change", what);
    let fail = EnvelopeError::of::<reduction::ReductionError>("tooth change");
    let from = &model.contact_set().windows().ok_or_else(|| missing("no window"))?[0];
    let displacements = &model.last().ok_or_else(|| missing("no equilibrium"))?.displacements[0];
    let forces: Vec<f64> = position.pairs.iter().map(|p| p.normal_force).collect();
    // One of the two pairs at the ends is free of load here.
    let next = model.window().change(Sense::Cw, &forces).or_else(|_| model.window().change(Sense::Ccw, &forces));
    let next = next.map_err(EnvelopeError::of("tooth change"))?;
    let gear = analysis::reduced(&model.gears()[0]).ok_or_else(|| missing("no reduced gear"))?;
    let to = gear.window(next.first_teeth()[0]).map_err(&fail)?;
    let carried = gear.carry(from, &to, displacements).map_err(&fail)?;
    let mut naive = carried.clone();
    // Numbers of pairs and teeth grow together: the oncoming tooth is the last of the window, or its first.
    let oncoming =
        if next.first() > model.window().first() { to.reduced.teeth.last() } else { to.reduced.teeth.first() };
    let tooth = oncoming.copied().unwrap_or(0) % gear.gear().tooth_count();
    let faces = gear.gear().flank(tooth, model.options().side()).ok_or_else(|| missing("no such flank"))?;
    for at in faces.iter().flat_map(|f| f.nodes()).filter_map(|node| to.reduced.position(*node)) {
        naive[3 * at..3 * at + 3].fill(0.0);
    }
    let before = from.reduced.strain_energy(displacements);
    Ok([before, to.reduced.strain_energy(&carried), to.reduced.strain_energy(&naive)])
}

/// In motion until it repeats itself, then over a whole turn and more.
const IN_MOTION: [&str; 6] = [
    "analysis.kind=dynamic",
    "analysis.cycles=32",
    "contact.slices=8",
    "drive.by=speed",
    "motion.steps_per_mesh_cycle=32",
    "motion.periodic_tolerance=1e-9",
];
/// Settings of the pair at rest, on points: slices have no coordinates of their own to tear.
const AT_REST: [&str; 3] = ["contact.method=nodal", "contact.points_per_face_edge=4", "analysis.cycles=1"];

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let [before, carried, naive] = bench.at_first_position(&AT_REST.map(str::to_owned), energies)??;
    let result = bench.in_motion(&IN_MOTION)?;
    let headline = &result.headline;
    let jump = headline.certificate.flanks.force_jump_at_tooth_change_n / headline.mean_normal_force_n;
    // Lines between the mesh harmonics over whole turns are what changes alone could make.
    let rows = result.rows.series(0..result.rows.len(), |row| row.dte_um)?;
    let per_cycle = headline.rows_per_cycle as usize;
    let repeats = largest(rows.iter().zip(rows.iter().skip(per_cycle)).map(|(a, b)| (a - b).abs()));
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
