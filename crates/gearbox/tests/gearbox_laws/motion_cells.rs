//! What is kept of the contact of a pair in motion is memory of a pure function: forces do not depend on where the pair
//! has been.

use std::sync::OnceLock;

use fem::ElementOptions;
use gearbox::motion::{GearboxMechanism, PairModel};
use integrate::{Forces, Mechanism};
use nalgebra::DVector;
use testing::{
    Case,
    moving::{MovingPair, machine},
};

fn pair() -> &'static MovingPair {
    static PAIR: OnceLock<MovingPair> = OnceLock::new();
    PAIR.get_or_init(|| {
        let case = Case::read("coarse_hex8_pinion.msh", "coarse_hex8_wheel.msh", ElementOptions::default());
        let contact = case.slice_options().with_contact(|c| c.slices = 12);
        MovingPair::new(case, contact, 8)
    })
}

const FREQUENCY: f64 = 500.0;

/// Free to move along all axes, and to tilt if asked.
fn system(tilts: bool) -> PairModel {
    pair().system(FREQUENCY, |options| options.free = [[true, true, true, tilts, tilts, false]; 2])
}

/// Displaced by some um from the quasi-static place, everywhere a little differently.
fn place(system: &PairModel, i: usize) -> DVector<f64> {
    let (scale, lag) = (system.scale(1e-3), system.lag());
    DVector::from_fn(scale.len(), |j, _| {
        let swing = ((i * 7 + j * 3) as f64 * 0.9).sin() * scale[j];
        if j == lag { pair().ste[0] + swing } else { 0.3 * swing }
    })
}

fn forces(system: &mut GearboxMechanism, t: f64, q: &DVector<f64>) -> Forces {
    let mut out = Forces::zeros(q.len());
    system.forces(t, q, &DVector::zeros(q.len()), &mut out).unwrap_or_else(|e| panic!("{e}"));
    out
}

/// Forces of a pair that has been at a hundred other places, of one that has been here before, and of a new one are the
/// same to the last bit.
#[test]
fn forces_do_not_depend_on_where_the_pair_has_been() {
    let model = system(true);
    let mut travelled = machine(&model);
    let time = |i: usize| i as f64 / (24.0 * FREQUENCY);
    let visits: Vec<_> = (0..24).map(|i| (time(i), place(&model, i))).collect();
    let first: Vec<_> = visits.iter().map(|(t, q)| forces(&mut travelled, *t, q)).collect();
    for (i, (t, q)) in visits.iter().enumerate().rev() {
        travelled.forget();
        let again = forces(&mut travelled, *t, q);
        let of_new = forces(&mut machine(&model), *t, q);
        for (name, other) in [("first visit", &first[i]), ("a new pair", &of_new)] {
            assert_eq!(again.conservative, other.conservative, "forces at place {i} are not those of {name}");
            assert_eq!(again.stiffness, other.stiffness, "tangents at place {i} are not those of {name}");
        }
    }
}

/// Strain energy is the integral of the forces: over a way of half a um along every axis at once, by Simpson's rule, to
/// some millionths: slices come and go on it.
#[test]
fn energy_is_what_the_forces_do() {
    let model = system(false);
    let (mut system, q) = (machine(&model), place(&model, 5));
    let scale = model.scale(2.5e-4);
    let (from, to) = (&q - &scale, &q + &scale);
    // The middle first: all of the way then belongs to what is found there.
    let [middle, start, end] = [&q, &from, &to].map(|q| forces(&mut system, 0.0, q).conservative);
    let done = (start + 4.0 * middle + end).dot(&scale) / 3.0;
    let [before, after] = [&from, &to].map(|q| system.potential(0.0, q).unwrap_or_else(|e| panic!("{e}")));
    assert!(
        (after - before + done).abs() < 1e-5 * done.abs(),
        "energy changes by {:e} N mm, forces do {done:e}: off by {:e}",
        after - before,
        (after - before + done) / done
    );
}
