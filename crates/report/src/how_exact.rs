//! How exact the headline numbers of a pair or a gearbox are.

use analysis::accuracy::{Accuracy, Bound, Term};
use serde::Serialize;

use crate::page::{Cell, Grid, Line, Part};

/// Headline numbers with their bounds, what was asked of them, what was tried.
pub(crate) fn how_exact(exact: &Accuracy) -> Vec<Part> {
    let words = format!(
        "Held against {}; laws of the errors from {} random pairs, of which {:.0} % lie within each of their bounds.",
        exact.held_against,
        exact.calibrated_on_pairs,
        100.0 * exact.coverage
    );
    let bounds = exact.bounds.iter().map(|bound| {
        let asked = match (bound.asked, bound.met) {
            (Some(_), Some(true)) => format!("(within {}, as asked)", bound.asked_words()),
            (Some(_), _) => format!("(NOT within {}, as asked)", bound.asked_words()),
            _ => String::new(),
        };
        Line::text(name(bound), bound.words(), asked)
    });
    let mesh = |elements: Option<u32>| elements.map_or("meshes of the scene".into(), |n| format!("{n} elements"));
    let slices = |slices: Option<u32>| slices.map_or(String::new(), |n| format!(", {n} slices"));
    let left = |why: &Option<String>| why.as_ref().map_or("taken".into(), |why| format!("left: {why}"));
    let rungs = exact.rungs.iter().map(|rung| {
        let of =
            format!("{}{}, {} positions", mesh(rung.elements_profile), slices(rung.slices), rung.positions_per_cycle);
        Line::text("tried", of, left(&rung.left_because))
    });
    let models = exact.models.iter().map(|tried| {
        let mesh = mesh(tried.elements_profile);
        let of = format!("{}, {mesh}{}, {} steps", tried.model.name(), slices(tried.slices), tried.steps_per_resonance);
        Line::text("tried", of, left(&tried.left_because))
    });
    let settings = exact.settings.iter().map(|tried| {
        let slices = tried.slices.iter().map(u32::to_string).collect::<Vec<_>>().join(" and ");
        let mesh = mesh(tried.elements_profile);
        let of = format!(
            "{mesh}, {slices} slices, {} positions, {} shaft elements",
            tried.positions_per_cycle, tried.shaft_elements
        );
        Line::text("tried", of, left(&tried.left_because))
    });
    let tried = rungs.chain(models).chain(settings);
    let not_covered = exact.not_covered.iter().map(|what| Line::text("not covered", "", what));
    let causes = exact.bounds.first().map_or(&[][..], |bound| &bound.terms);
    let head = ["number", "unit", "as computed", "above", "below", "corrected", "within"].map(str::to_owned);
    let cause = |term: &Term| format!("by {}", words_of(&term.cause));
    let grid = Grid::new(head.into_iter().chain(causes.iter().map(cause)));
    vec![
        Part::new("How exact").closing().words(words).lines(bounds.chain(tried).chain(not_covered)),
        Part::more().grid(grid.rows(exact.bounds.iter().map(bound_row))),
    ]
}

/// What a bound is of, in words.
fn name(bound: &Bound) -> String {
    let key = bound.quantity.key().replace('_', " ");
    bound.of.as_ref().map_or(key.clone(), |of| format!("{key}, {of}"))
}

/// A cause of an error in words.
fn words_of(cause: &impl Serialize) -> String {
    serde_json::to_value(cause).ok().and_then(|v| Some(v.as_str()?.replace('_', " "))).unwrap_or_default()
}

fn bound_row(bound: &Bound) -> Vec<Cell> {
    let numbers = [
        Cell::text(name(bound)),
        Cell::text(bound.unit),
        Cell::number(bound.value, 4),
        Cell::science(bound.above),
        Cell::science(bound.below),
        Cell::number(bound.corrected, 4),
        Cell::science(bound.corrected_within),
    ];
    numbers.into_iter().chain(bound.terms.iter().map(|term| Cell::science(term.amount))).collect()
}
