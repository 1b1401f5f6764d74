//! Gearboxes at rest.

use std::time::Instant;

use scene::gearbox::Gearbox;
use verification::{measured_gearbox::Exact, random_gearbox::random_gearbox};

use super::{Failure, Tallies};

/// Random gearboxes; `words`: seed, first, count.
pub(super) fn check(share: f64, words: &[String], tallies: &mut Tallies) -> Result<(), Failure> {
    let [seed, first, count] = words else { return Err("SEED FIRST COUNT are wanted".into()) };
    let (seed, first, count): (u64, u64, u64) = (seed.parse()?, first.parse()?, count.parse()?);
    for index in first..first + count {
        let Some(file) = random_gearbox(seed, index) else { continue };
        match checked(&file, share, tallies) {
            Ok(said) => println!("gearbox {index:4}: {said}"),
            Err(e) => println!("gearbox {index:4}: {e}"),
        }
    }
    Ok(())
}

/// One gearbox, in words.
fn checked(file: &Gearbox, share: f64, tallies: &mut Tallies) -> Result<String, Failure> {
    let exact = Exact::of(file)?;
    let start = Instant::now();
    let found = exact.beside(file, share)?;
    let mut said = format!("{:.1} s", start.elapsed().as_secs_f64());
    for (bound, exact) in found {
        let within = tallies.entry(bound.quantity.key()).or_default().add(&bound, exact);
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
