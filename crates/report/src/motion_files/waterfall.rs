//! Order spectra of a motion whose speed changes: `waterfall` as a table, and its picture.

use analysis::motion::{Waterfall, WaterfallLine};
use answer::{Numbers, Table};

use super::charts::SHOWN_ORDERS;
use crate::charts::{FieldMap, Overlay, Side, embedded, figure, share};

/// Columns and rows of a picture at most.
const CELLS: [usize; 2] = [360, 300];
/// Decades of a picture's colours.
const DECADES: f64 = 4.0;

/// What a waterfall is of: a pair, or a gearbox.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WaterfallOf<'a> {
    /// Column of the speed, with its meaning.
    pub speed: [&'static str; 2],
    /// What orders are counted in.
    pub order: &'static str,
    /// Name and meaning of each quantity.
    pub quantities: &'a [(String, &'static str)],
}

/// `waterfall`: spectra stretch by stretch, one row a line of a spectrum.
pub(crate) fn waterfall(waterfall: &Waterfall, of: WaterfallOf<'_>) -> Table {
    let bins = |line: &WaterfallLine| line.amplitudes.first().map_or(0, Vec::len);
    let all = || waterfall.lines.iter().flat_map(|line| (0..bins(line)).map(move |k| (line, k)));
    let order = |k: usize| k as f64 * waterfall.order_step;
    let [name, meaning] = of.speed;
    let mut table = Table::new("waterfall")
        .numbers("time_s", "middle of the interval", all().map(|(line, _)| line.time))
        .numbers(name, meaning, all().map(|(line, _)| line.speed_rpm))
        .numbers("mesh_order", of.order, all().map(|(_, k)| order(k)))
        .numbers(
            "frequency_hz",
            "frequency of the order at the mean speed",
            all().map(|(line, k)| order(k) * line.mesh_frequency_hz),
        );
    for (i, (name, meaning)) in of.quantities.iter().enumerate() {
        table.push_numbers(name.clone(), *meaning, all().map(|(line, k)| line.amplitudes[i][k]));
    }
    table
}

/// Amplitudes of a quantity over order and time, colours by decades. `whose`: the quantity in words, and its unit; `speed`:
/// what the speeds are of.
pub(crate) fn waterfall_chart(
    waterfall: &Waterfall,
    quantity: usize,
    [whose, unit]: [&str; 2],
    speed: &'static str,
) -> Option<String> {
    let lines = &waterfall.lines;
    let (first, last) = (lines.first()?, lines.last()?);
    let of = |line: &'_ WaterfallLine| line.amplitudes.get(quantity).cloned();
    let amplitudes = lines.iter().map(of).collect::<Option<Vec<Vec<f64>>>>()?;
    let per_bin = waterfall.order_step;
    let bins = (amplitudes[0].len() - 1).max(1);
    let shown = ((SHOWN_ORDERS / per_bin).floor() as usize).clamp(1, bins);
    let largest = amplitudes.iter().flat_map(|l| &l[1..=shown]).fold(0.0, |m: f64, a| m.max(*a));
    let (across, along) = (shown.div_ceil(CELLS[0]).max(1), lines.len().div_ceil(CELLS[1]).max(1));
    let columns: Vec<usize> = (1..=shown).step_by(across).collect();
    let rows: Vec<&[WaterfallLine]> = lines.chunks(along).collect();
    let cell = |block: &[Vec<f64>], from: usize| {
        let to = (from + across).min(shown + 1);
        let value = block.iter().flat_map(|l| &l[from..to]).fold(0.0, |m: f64, a| m.max(*a));
        share(value, largest, Some(DECADES))
    };
    let order = |k: usize| per_bin * (k as f64 - 0.5);
    let end = last.time.max(first.time + 1e-9);
    let mean = |block: &[WaterfallLine]| block.iter().map(|l| l.speed_rpm).sum::<f64>() / block.len() as f64;
    let map = FieldMap {
        title: format!("Waterfall of {whose}, colours over {DECADES:.0} decades up to {largest:.3} {unit}"),
        sides: [
            Side { label: "mesh order", edges: columns.iter().map(|&k| order(k)).chain([order(shown + 1)]).collect() },
            Side { label: "time [s]", edges: rows.iter().map(|block| block[0].time).chain([end]).collect() },
        ],
        quantity: if unit == "um" { "DTE amplitude [um]" } else { "force amplitude [N]" },
        least: 0.0,
        largest,
        decades: Some(DECADES),
        beside: Some((speed, Numbers(rows.iter().map(|block| mean(block)).collect(), 6))),
        shares: amplitudes.chunks(along).flat_map(|block| columns.iter().map(|&from| cell(block, from))).collect(),
        over: Overlay::default(),
    };
    Some(figure(&map.picture()?, &[embedded("map", &map)]))
}
