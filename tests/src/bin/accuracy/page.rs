//! Writes the page that says which model of a motion suffices at which speed and tolerance, from measured motions.

use std::{fmt::Write, fs};

use analysis::accuracy::motion::MotionCalibration;
use scene::Quantity;
use verification::measured_motion::MeasuredMotion;

use super::Failure;

/// Upper ends of the bins of mesh frequency over mesh resonance.
const SPEEDS: [f64; 6] = [0.1, 0.2, 0.4, 0.7, 1.1, 1.5];
/// Tolerances, per cent.
const TOLERANCES: [f64; 4] = [30.0, 10.0, 3.0, 1.0];
/// Share of the motions within a tolerance from which on a model suffices.
const ENOUGH: f64 = 0.9;
/// Models, cheap to dear, beside the reference.
const MODELS: [(&str, &str); 2] = [("lumped12", "lumped12 16"), ("reduced", "reduced 16")];
/// What they are held against.
const REFERENCE: &str = "reduced+modes 6";

/// `words`: the page, and the files of motions.
pub(super) fn run(words: &[String]) -> Result<(), Failure> {
    let [out, files @ ..] = words else { return Err("OUT.md FILE... are wanted".into()) };
    let mut motions = Vec::new();
    for file in files {
        for line in fs::read_to_string(file)?.lines() {
            motions.extend(MeasuredMotion::new(serde_json::from_str(line)?));
        }
    }
    let mut page = String::from(INTRODUCTION);
    for (q, what) in [
        (Quantity::PeakToPeakDte, "Peak to peak of the dynamic transmission error"),
        (Quantity::RmsDte, "Root mean square of it"),
    ] {
        write!(page, "\n## {what}\n\n")?;
        table(&mut page, &motions, q)?;
    }
    page += BOUNDS;
    bounds(&mut page)?;
    fs::write(out, page)?;
    Ok(())
}

/// Which model suffices, by speed and tolerance.
fn table(page: &mut String, motions: &[MeasuredMotion], q: Quantity) -> Result<(), std::fmt::Error> {
    let heads = TOLERANCES.map(|t| format!("within {t} %")).join(" | ");
    writeln!(page, "| f_m / f_0 | motions | {heads} |\n|---|---|---|---|---|---|")?;
    let mut from = 0.05;
    for to in SPEEDS {
        let bin: Vec<&MeasuredMotion> = motions.iter().filter(|m| m.speed > from && m.speed <= to).collect();
        let mut cells = Vec::new();
        for tolerance in TOLERANCES {
            let shares = MODELS.map(|(name, run)| (name, share(&bin, q, run, 1e-2 * tolerance)));
            let taken = shares.iter().find(|(_, s)| s.is_some_and(|s| s >= ENOUGH)).map_or("reduced+modes", |(n, _)| n);
            let told = shares.map(|(_, s)| s.map_or("-".to_owned(), |s| format!("{:.0}", 100.0 * s)));
            cells.push(format!("`{taken}` ({})", told.join(", ")));
        }
        writeln!(page, "| {from} .. {to} | {} | {} |", bin.len(), cells.join(" | "))?;
        from = to;
    }
    Ok(())
}

/// Share of the motions in which a run is as near to the reference as a share of it.
fn share(bin: &[&MeasuredMotion], q: Quantity, run: &str, tolerance: f64) -> Option<f64> {
    let error = |m: &&MeasuredMotion| {
        let exact = m.value(REFERENCE, q)?;
        Some((m.value(run, q)? / exact - 1.0).abs())
    };
    let errors: Vec<f64> = bin.iter().filter_map(error).collect();
    let near = errors.iter().filter(|e| **e <= tolerance).count();
    (!errors.is_empty()).then(|| near as f64 / errors.len() as f64)
}

/// What bounds usually come to.
fn bounds(page: &mut String) -> Result<(), std::fmt::Error> {
    writeln!(
        page,
        "| number | model | f_m / f_0 up to | f_m / f_elastic | motions | usual bound |\n|---|---|---|---|---|---|"
    )?;
    for laws in &MotionCalibration::committed().quantities {
        for u in &laws.usual {
            let least = MotionCalibration::ELASTIC[0];
            let elastic = if u.elastic_to > least { format!("above {least}") } else { format!("up to {least}") };
            writeln!(
                page,
                "| `{}` | `{}` | {} | {elastic} | {} | {:.1} % |",
                laws.quantity,
                u.model,
                u.speed_to,
                u.motions,
                100.0 * u.share
            )?;
        }
    }
    Ok(())
}

const INTRODUCTION: &str = "\
# Which model suffices

Errors of the models, measured on random narrow pairs (b/m_n up to 8, otherwise the ranges of [theory](theory.md), section
15). Motions are steady, at mesh frequencies f_m of 0.05 to 1.5 of the mesh resonance f_0, with mesh damping of 0.04 to
0.12. `lumped12` takes the stiffness of the reduced model at rest. It and `reduced` take 16 steps in a period of the
resonance. The reference is `reduced+modes` with four modes of each gear and steps of a sixth of the period of the highest.

A cell names the cheapest model that is within the tolerance of the reference in nine of ten motions. In brackets: the
per cent of motions in which `lumped12` and `reduced` are within it. Errors of meshes and slices add to these, alike for all models. `accuracy page`
writes this page (section 15 has the commands).
";

const BOUNDS: &str = "
## What bounds say

`model = \"auto\"` does not know errors, only bounds, which are wider. It chooses the first model by the usual bounds below.
In three of five motions the bound is at most this share of the number. It covers steps, elasticity without inertia and the
model, not meshes and slices.

";
