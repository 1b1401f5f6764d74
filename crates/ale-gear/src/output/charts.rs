//! Charts of a history as SVG text, to be put into the report as they are.

use plotters::prelude::*;

/// One curve.
pub(super) struct Curve {
    pub label: String,
    pub points: Vec<(f64, f64)>,
}

pub(super) const COLOURS: [RGBColor; 12] = [
    RGBColor(31, 95, 168),
    RGBColor(200, 80, 30),
    RGBColor(40, 130, 70),
    RGBColor(130, 70, 150),
    RGBColor(120, 120, 40),
    RGBColor(90, 90, 90),
    RGBColor(90, 180, 230),
    RGBColor(230, 160, 0),
    RGBColor(0, 190, 150),
    RGBColor(200, 120, 170),
    RGBColor(110, 60, 20),
    RGBColor(0, 0, 0),
];

/// Height of a legend's line over the height of the chart.
const LEGEND_ROOM: f64 = 0.09;

/// Curves over one pair of axes. The value axis begins at zero when `from_zero` is set; without points, or with
/// nothing finite, the chart is left out and `None` comes back.
pub(super) fn line_chart(title: &str, x: &str, y: &str, curves: &[Curve], from_zero: bool) -> Option<String> {
    chart(title, [x, y], curves, from_zero, Marks::Lines)
}

/// The same with dots in place of lines: sections and bifurcation diagrams.
pub(super) fn dot_chart(title: &str, x: &str, y: &str, curves: &[Curve]) -> Option<String> {
    chart(title, [x, y], curves, false, Marks::Dots)
}

/// Frequencies over speed: modes all alike in grey, each order of excitation in a colour of its own.
pub(super) fn frequency_chart(title: &str, modes: Vec<Curve>, orders: Vec<Curve>) -> Option<String> {
    let curves: Vec<Curve> = orders.into_iter().chain(modes).collect();
    chart(title, ["speed of the driver [1/min]", "frequency [Hz]"], &curves, true, Marks::Lines)
}

/// Points of a curve up to which they are drawn large.
const FEW: usize = 100;

/// How points are shown.
#[derive(Clone, Copy, PartialEq)]
enum Marks {
    Lines,
    Dots,
}

fn chart(title: &str, axes: [&str; 2], curves: &[Curve], from_zero: bool, marks: Marks) -> Option<String> {
    let finite = |&&(a, b): &&(f64, f64)| a.is_finite() && b.is_finite();
    let points = || curves.iter().flat_map(|c| c.points.iter()).filter(finite);
    points().next()?;
    let span = |pick: fn(&(f64, f64)) -> f64, zero: bool| {
        let start = if zero { (0.0, 0.0) } else { (f64::INFINITY, f64::NEG_INFINITY) };
        let (low, high) = points().map(pick).fold(start, |(lo, hi), v| (lo.min(v), hi.max(v)));
        // A constant still needs an axis of some length.
        let margin = if high > low { 0.06 * (high - low) } else { 0.05 * high.abs().max(1e-9) };
        (low - if zero && low == 0.0 { 0.0 } else { margin }, high + margin)
    };
    let (x_low, x_high) = span(|p| p.0, false);
    let (y_low, mut y_high) = span(|p| p.1, from_zero);
    let named = curves.iter().filter(|c| !c.label.is_empty()).count();
    if named > 1 {
        // Room for the legend above the curves.
        y_high += LEGEND_ROOM * named as f64 * (y_high - y_low);
    }

    let mut svg = String::new();
    draw(&mut svg, title, axes, curves, [x_low, x_high, y_low, y_high], marks).ok()?;
    Some(svg)
}

fn draw(
    svg: &mut String,
    title: &str,
    [x, y]: [&str; 2],
    curves: &[Curve],
    [x_low, x_high, y_low, y_high]: [f64; 4],
    marks: Marks,
) -> Result<(), Box<dyn std::error::Error>> {
    let fail = |e: &dyn std::fmt::Display| e.to_string();
    let root = SVGBackend::with_string(svg, (820, 360)).into_drawing_area();
    root.fill(&WHITE).map_err(|e| fail(&e))?;
    let mut chart = ChartBuilder::on(&root)
        .caption(title, ("sans-serif", 18))
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(72)
        .build_cartesian_2d(x_low..x_high, y_low..y_high)
        .map_err(|e| fail(&e))?;
    chart.configure_mesh().max_light_lines(0).x_desc(x).y_desc(y).draw().map_err(|e| fail(&e))?;
    for (k, curve) in curves.iter().enumerate() {
        // Curves without a name are more of the last one that has one.
        let own = curves[..=k].iter().rposition(|c| !c.label.is_empty()).unwrap_or(0);
        let colour = COLOURS[own % COLOURS.len()];
        let finite = curve.points.iter().copied().filter(|(a, b)| a.is_finite() && b.is_finite());
        // A few points are to be seen, many to be told apart.
        let dot = if curve.points.len() <= FEW { 3 } else { 1 };
        let series = match marks {
            Marks::Lines => chart.draw_series(LineSeries::new(finite, colour.stroke_width(2))),
            Marks::Dots => chart.draw_series(finite.map(|p| Circle::new(p, dot, colour.filled()))),
        };
        let series = series.map_err(|e| fail(&e))?;
        if curve.label.is_empty() {
            continue;
        }
        series
            .label(curve.label.as_str())
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 20, y)], colour.stroke_width(2)));
    }
    if curves.len() > 1 {
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::UpperRight)
            .background_style(WHITE.mix(0.85))
            .border_style(RGBColor(160, 160, 160))
            .draw()
            .map_err(|e| fail(&e))?;
    }
    drop(chart);
    root.present().map_err(|e| fail(&e))?;
    Ok(())
}
