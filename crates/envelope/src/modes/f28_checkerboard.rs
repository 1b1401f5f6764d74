//! F28: pressures that alternate from point to point.

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, largest},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 28,
    name: "pressure checkerboard",
    file: "F28-checkerboard",
    scene: scene_text!("F28-checkerboard"),
    fails: "More pressures than the mesh can tell apart: they alternate from point to point, and the largest is noise.",
    does: "One load a slice on a contact line, with a compliance of its own: the load runs smoothly along the line.",
    naive: &["contact.method=nodal"],
    look,
};

/// Second differences of the line load along the inner slices of the most loaded pair, root mean square over its mean.
fn roughness(result: &analysis::StaticResult) -> f64 {
    let pairs = result.history.positions.iter().flat_map(|p| &p.pairs);
    let rough = |slices: &[contact::SliceResult]| {
        let load: Vec<f64> = slices.iter().map(|s| s.line_load).collect();
        let inner = load.get(2..load.len().saturating_sub(2)).unwrap_or_default();
        let mean = inner.iter().sum::<f64>() / inner.len() as f64;
        let bends = inner.windows(3).map(|w| (w[0] - 2.0 * w[1] + w[2]).powi(2));
        (bends.sum::<f64>() / inner.len() as f64).sqrt() / mean
    };
    largest(pairs.filter(|pair| pair.slices.len() >= 12).map(|pair| rough(&pair.slices)))
}

/// Largest pressure of a point at the first position, MPa: its force over its share of the face.
fn largest_of_points(bench: &Bench, per_edge: u32) -> Result<f64, EnvelopeError> {
    let points = format!("contact.points_per_face_edge={per_edge}");
    let settings = bench.naive(&[&points, "analysis.positions_per_cycle=1"]);
    bench.at_first_position(&settings, |_, model| {
        let found = model.last().map(|last| (&last.rows, &last.solution.forces));
        let rows = found.into_iter().flat_map(|(rows, forces)| rows.iter().zip(forces));
        largest(rows.filter(|(row, _)| row.area > 0.0).map(|(row, force)| force / row.area))
    })
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let slices = bench.at_rest(&AS_IT_IS)?;
    let with_slices = |count: &str| {
        let positions = bench.at_rest(&[format!("contact.slices={count}")])?.history.positions;
        Ok::<_, EnvelopeError>(largest(positions.iter().map(|p| p.max_pressure)))
    };
    let of_slices = 100.0 * (with_slices("64")? / with_slices("128")? - 1.0).abs();
    let of_points = 100.0 * (largest_of_points(bench, 4)? / largest_of_points(bench, 8)? - 1.0).abs();
    Ok(vec![
        Figure::new(
            "second difference of the load along a line over its mean",
            Shown::at_most(roughness(&slices), 0.1),
        ),
        Figure::new(
            "largest pressure on half as many slices (naive: points an edge), % off",
            Shown::at_most(of_slices, 2.0),
        )
        .beside(Shown::at_least(of_points, 20.0)),
    ])
}
