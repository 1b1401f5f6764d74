//! Which model a scene is of, and what goes with it.

use super::Draft;

/// What is asked, as far as other keys depend on it.
#[derive(Debug, Clone, Copy)]
pub struct Asked {
    /// Word of `analysis.model`.
    pub model: &'static str,
    /// Whether it moves.
    pub in_time: bool,
    /// Whether there are meshes.
    pub meshed: bool,
    /// Whether there are slices.
    pub sliced: bool,
    /// Whether there is friction in `[contact]`.
    pub friction: bool,
    /// Word of `mesh.stiffness_from` of the models that have that.
    pub from: Option<&'static str>,
    /// Whether flanks have micro-geometry, and axes a misalignment.
    pub ground: bool,
}

/// Share of each model, in time or not.
const SHARES: [(&str, bool, f64); 9] = [
    ("reduced", false, 0.34),
    ("reduced", true, 0.13),
    ("reduced+modes", true, 0.04),
    ("full", false, 0.03),
    ("iso", false, 0.10),
    ("lumped8", true, 0.11),
    ("lumped12", true, 0.10),
    ("shaft18", true, 0.08),
    ("impact", true, 0.07),
];

/// Which model, and what it takes.
pub fn draw_model(d: &mut Draft) -> Asked {
    let mut left = d.between(0.0, 1.0);
    let found = SHARES.into_iter().find(|(_, _, share)| {
        left -= share;
        left < 0.0
    });
    let (model, in_time, _) = found.unwrap_or(SHARES[0]);
    let stiff = matches!(model, "lumped8" | "lumped12" | "shaft18");
    let from = stiff.then(|| d.pick(&["series", "series", "series", "iso", "iso", "iso", "reduced"]));
    let meshed = matches!(model, "reduced" | "reduced+modes" | "full") || from == Some("reduced");
    Asked {
        model,
        in_time,
        meshed,
        sliced: meshed || model == "impact",
        friction: matches!(model, "reduced" | "reduced+modes" | "lumped8" | "lumped12"),
        from,
        ground: meshed || model == "impact",
    }
}
