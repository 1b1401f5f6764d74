//! Gearboxes at rest.

use std::{f64::consts::TAU, time::Instant};

use analysis::{
    Context, NoObserver,
    accuracy::{Quantity, Rung},
    gearbox::GearboxResult,
};
use scene::{AccuracyScene, Tolerance, gearbox::Gearbox};
use verification::random_gearbox::random_gearbox;

use super::{Failure, Tallies};

/// Elements along the profile, slices, positions in a cycle and elements of a shaft of the reference.
const FINE: (u32, u32, u32, u32) = (6, 64, 64, 48);
const QUANTITIES: [Quantity; 7] = [
    Quantity::MeanSte,
    Quantity::PeakToPeakSte,
    Quantity::MaxPressure,
    Quantity::MisalignmentInPlane,
    Quantity::FaceLoadFactor,
    Quantity::BearingForce,
    Quantity::NaturalFrequency,
];

/// Random gearboxes; `words`: seed, first, count.
pub(super) fn check(share: f64, words: &[String], tallies: &mut Tallies) -> Result<(), Failure> {
    let [seed, first, count] = words else { return Err("SEED FIRST COUNT are wanted".into()) };
    let (seed, first, count): (u64, u64, u64) = (seed.parse()?, first.parse()?, count.parse()?);
    for index in first..first + count {
        let Some(file) = random_gearbox(seed, index) else { continue };
        match checked(file, share, tallies) {
            Ok(said) => println!("gearbox {index:4}: {said}"),
            Err(e) => println!("gearbox {index:4}: {e}"),
        }
    }
    Ok(())
}

/// One gearbox, in words.
fn checked(mut file: Gearbox, share: f64, tallies: &mut Tallies) -> Result<String, Failure> {
    let solve = |file: &Gearbox| analysis::solve(file, Context::new(&mut NoObserver)).and_then(|own| own.finished());
    let exact = solve(&fine(file.clone())?)?;
    file.accuracy = AccuracyScene::new(QUANTITIES.map(|q| (q, Tolerance::Relative(share))));
    let start = Instant::now();
    let found = solve(&file)?;
    let mut said = format!("{:.1} s", start.elapsed().as_secs_f64());
    let mut bearings = 0..exact.bearings.len();
    for bound in &found.accuracy.as_ref().ok_or("no bounds")?.bounds {
        let exact = number(&exact, bound.quantity, &mut bearings).ok_or_else(|| bound.quantity.key().to_owned())?;
        let within = tallies.entry(bound.quantity.key()).or_default().add(bound, exact);
        let of = |x: f64| 100.0 * x / bound.value.abs();
        said += &format!(
            "; {} {:.4e} {:+.2} % in -{:.2} +{:.2}{}",
            bound.quantity.key(),
            bound.value,
            of(exact - bound.value),
            of(bound.below),
            of(bound.above),
            if within { "" } else { " OUTSIDE" }
        );
    }
    Ok(said)
}

/// The gearbox as the reference has it.
fn fine(mut file: Gearbox) -> Result<Gearbox, Failure> {
    let (elements, slices, positions, shaft_elements) = FINE;
    let rung = Rung::ALL.into_iter().find(|rung| rung.elements_profile == elements).ok_or("no such rung")?;
    for mesh in &mut file.meshes {
        mesh.scene = rung.scene(&mesh.scene);
        mesh.scene.contact.slices = Some(slices);
    }
    (file.positions_per_cycle, file.shaft_elements) = (positions, shaft_elements);
    Ok(file)
}

/// A number of the only mesh, of the next bearing, or of the whole.
fn number(result: &GearboxResult, quantity: Quantity, bearings: &mut impl Iterator<Item = usize>) -> Option<f64> {
    let mesh = result.meshes.first()?;
    match quantity {
        Quantity::MeanSte => Some(1e3 * mesh.transmission_error[0]),
        Quantity::PeakToPeakSte => Some(1e3 * mesh.transmission_error[1]),
        Quantity::MaxPressure => Some(mesh.max_pressure),
        Quantity::MisalignmentInPlane => Some(1e3 * mesh.misalignment[0]),
        Quantity::FaceLoadFactor => mesh.face_load_factor,
        Quantity::BearingForce => {
            let [x, y, z] = result.bearings.get(bearings.next()?)?.force;
            Some(x.hypot(y).hypot(z))
        }
        Quantity::NaturalFrequency => Some(result.vibration.as_ref()?.modes.first()?.modes.first()?.frequency / TAU),
        _ => None,
    }
}
