//! Campbell diagrams.

use study::Campbell;

use super::{curve::Curve, curves::frequency_chart};

/// Lowest modes that have lines of their own at most.
const NAMED: usize = 8;

/// Natural frequencies over speed with the orders that may meet them; `orders` and `modes`: their names. Modes without a
/// name, and those above the lowest ones, are drawn alike.
pub fn campbell_chart(d: &Campbell, orders: &[String], modes: &[String]) -> Option<String> {
    let highest = d.frequencies.iter().flatten().copied().fold(0.0, f64::max);
    let rpm = |s: f64| 60.0 * s;
    let line = |m: usize| d.speeds.iter().zip(&d.frequencies[m]).map(|(s, f)| (rpm(*s), *f)).collect();
    let last = d.speeds.last().copied().unwrap_or(0.0);
    let order_lines = d.orders.iter().zip(orders).map(|(order, name)| {
        // No line leaves the diagram: it would squeeze the modes together.
        let end = last.min(1.05 * highest / order);
        Curve { label: name.clone(), points: vec![(0.0, 0.0), (rpm(end), order * end)] }
    });
    let of = |m: usize| modes.get(m).map_or("", String::as_str);
    let (own, alike): (Vec<usize>, Vec<usize>) =
        (0..d.frequencies.len()).partition(|&m| m < NAMED && !of(m).is_empty());
    let others = if own.is_empty() { "natural frequencies" } else { "other natural frequencies" };
    let own = own.into_iter().map(|m| Curve { label: of(m).to_owned(), points: line(m) });
    let alike = alike
        .into_iter()
        .enumerate()
        .map(|(i, m)| Curve { label: if i == 0 { others.to_owned() } else { String::new() }, points: line(m) });
    frequency_chart("Campbell diagram", own.chain(alike).collect(), order_lines.collect())
}
