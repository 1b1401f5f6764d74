//! Charts of a report: a picture that prints and needs no script, and beside it the points for the script that zooms.

use std::borrow::Cow;

use answer::shown_units;
use plotters::prelude::*;

use super::{
    curve::{BARS, COLOURS, Curve, colour_of},
    plot_data::{Plot, embedded},
};

/// Stretches of a long record in the picture: of each the least and the largest value are drawn.
const LYAPUNOV_INTERVALS: usize = 800;

/// Height of a legend's line over the height of the chart.
const LEGEND_ROOM: f64 = 0.09;

/// Curves over one pair of axes, for a page of any kind.
#[derive(Debug, Clone, PartialEq)]
pub struct LineChart {
    /// Title of the chart.
    pub title: &'static str,
    /// Names of the axes with units.
    pub axes: [&'static str; 2],
    /// What is drawn.
    pub curves: Vec<Curve>,
    /// Whether the value axis begins at zero.
    pub from_zero: bool,
    /// Whether its only curve is the lines of a spectrum.
    pub is_spectrum: bool,
}

impl LineChart {
    /// With the curves that have something to draw; `None` without any.
    pub fn new(title: &'static str, axes: [&'static str; 2], curves: &[Curve], from_zero: bool) -> Option<Self> {
        let curves = with_points(curves);
        (!curves.is_empty()).then(|| Self { title, axes, curves: curves.into_owned(), from_zero, is_spectrum: false })
    }

    /// The lines of a spectrum; `None` without any.
    pub fn spectrum(title: &'static str, axes: [&'static str; 2], lines: Curve) -> Option<Self> {
        Self::new(title, axes, &[lines], true).map(|chart| Self { is_spectrum: true, ..chart })
    }

    /// As a part of a report.
    pub fn figure(&self) -> Option<String> {
        match (self.is_spectrum, self.curves.first()) {
            (true, Some(lines)) => stick_chart(self.title, self.axes[0], self.axes[1], lines.clone()),
            _ => line_chart(self.title, self.axes[0], self.axes[1], &self.curves, self.from_zero),
        }
    }

    /// As the script of a page takes it.
    pub fn plot(&self) -> Plot {
        match (self.is_spectrum, self.curves.first()) {
            (true, Some(lines)) => Plot::sticks(self.title, self.axes[0], self.axes[1], lines),
            _ => Plot::new(self.title, self.axes[0], self.axes[1], &self.curves, self.from_zero),
        }
    }
}

/// Curves over one pair of axes, as a part of a page. The value axis begins at zero when `from_zero` is set; without
/// points, or with nothing finite, the chart is left out and `None` comes back. Long records may come as they are.
pub fn line_chart(title: &str, x: &str, y: &str, curves: &[Curve], from_zero: bool) -> Option<String> {
    let curves = with_points(curves);
    let svg = picture(title, [x, y], &curves, from_zero, Marks::Lines)?;
    Some(figure(&svg, &[embedded("plot", &Plot::new(title, x, y, &curves, from_zero))]))
}

/// [`line_chart`] of one curve in the band that it is known to: the exact one lies between `below` under it and `above`
/// over it; `name` says what the band is.
pub fn banded_chart(
    title: &str,
    x: &str,
    y: &str,
    curve: Curve,
    name: &str,
    [below, above]: [f64; 2],
) -> Option<String> {
    let moved = |by: f64| curve.points.iter().map(|&(at, value)| (at, value + by)).collect();
    let edges = [(name, moved(above)), ("", moved(-below))];
    let [upper, lower] = edges.map(|(label, points)| Curve { label: label.to_owned(), points });
    let curves = [curve, upper, lower];
    let curves = with_points(&curves);
    let svg = picture(title, [x, y], &curves, false, Marks::Band)?;
    Some(figure(&svg, &[embedded("plot", &Plot::banded(title, x, y, &curves))]))
}

/// Chart with dots in place of lines: sections and bifurcation diagrams.
pub fn dot_chart(title: &str, x: &str, y: &str, curves: &[Curve]) -> Option<String> {
    let curves = with_points(curves);
    let svg = picture(title, [x, y], &curves, false, Marks::Dots)?;
    Some(figure(&svg, &[embedded("plot", &Plot::dots(title, x, y, &curves))]))
}

/// [`dot_chart`] as SVG alone, for a file of its own.
pub fn dot_picture(title: &str, x: &str, y: &str, curves: &[Curve]) -> Option<String> {
    picture(title, [x, y], &with_points(curves), false, Marks::Dots)
}

/// [`line_chart`] as SVG alone, likewise.
pub fn line_picture(title: &str, x: &str, y: &str, curves: &[Curve]) -> Option<String> {
    picture(title, [x, y], &with_points(curves), false, Marks::Lines)
}

/// Frequencies over speed: each order of excitation in a colour of its own, the modes all alike.
pub fn frequency_chart(title: &str, modes: Vec<Curve>, orders: Vec<Curve>) -> Option<String> {
    let curves: Vec<Curve> = orders.into_iter().chain(modes).collect();
    line_chart(title, "speed of the driver [1/min]", "frequency [Hz]", &curves, true)
}

/// Curves that have something to draw.
fn with_points(curves: &[Curve]) -> Cow<'_, [Curve]> {
    let seen = |c: &Curve| c.points.iter().any(|(a, b)| a.is_finite() && b.is_finite());
    if curves.iter().all(seen) {
        // Of a long motion they take more than all else.
        return Cow::Borrowed(curves);
    }
    Cow::Owned(curves.iter().filter(|c| seen(c)).cloned().collect())
}

/// Chart of the lines of a spectrum: one bar each, a stick where there are many.
pub fn stick_chart(title: &str, x: &str, y: &str, curve: Curve) -> Option<String> {
    if curve.points.len() <= BARS {
        let svg = picture(title, [x, y], std::slice::from_ref(&curve), true, Marks::Bars)?;
        return Some(figure(&svg, &[embedded("plot", &Plot::sticks(title, x, y, &curve))]));
    }
    let sticks = curve.points.iter().flat_map(|&(at, height)| [(at, 0.0), (at, height), (at, 0.0)]).collect();
    let svg = picture(title, [x, y], &[Curve { label: curve.label.clone(), points: sticks }], true, Marks::Lines)?;
    Some(figure(&svg, &[embedded("plot", &Plot::sticks(title, x, y, &curve))]))
}

/// A picture with what the script puts in its place on a screen.
pub fn figure(svg: &str, plots: &[String]) -> String {
    let wide = if plots.len() > 1 { " wide" } else { "" };
    format!("<figure class=\"chart{wide}\"><div class=\"still\">{svg}</div>{}</figure>", plots.concat())
}

/// The still pictures of a page, in their order: SVG that needs no script.
pub fn stills(page: &str) -> Vec<&str> {
    let begun = page.split("<div class=\"still\">").skip(1);
    begun.filter_map(|rest| rest.split_once("</svg>").map(|(svg, _)| &rest[..svg.len() + "</svg>".len()])).collect()
}

/// Dots of a curve in the still picture at most.
const DOTS: usize = 3000;
/// Half the width of a bar over the distance of two.
const BAR: f64 = 0.3;
/// Points of a curve up to which they are drawn large.
const FEW: usize = 100;

/// Colour of a band: that of its upper edge, the second curve.
const BAND: usize = 1;
/// Share of the colour in the area.
const BAND_FILL: f64 = 0.15;

/// How points are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Marks {
    Lines,
    Dots,
    /// A bar from zero to each value.
    Bars,
    /// A line, and the area between two others.
    Band,
}

/// The chart as SVG.
fn picture(title: &str, axes: [&str; 2], curves: &[Curve], from_zero: bool, marks: Marks) -> Option<String> {
    let finite = |&&(a, b): &&(f64, f64)| a.is_finite() && b.is_finite();
    let points = || curves.iter().flat_map(|c| c.points.iter()).filter(finite);
    points().next()?;
    let span = |pick: fn(&(f64, f64)) -> f64, zero: bool| {
        let start = if zero { (0.0, 0.0) } else { (f64::INFINITY, f64::NEG_INFINITY) };
        let (low, high) = points().map(pick).fold(start, |(lo, hi), v| (lo.min(v), hi.max(v)));
        // A constant still needs an axis of some length.
        let margin = match (high > low, high == 0.0) {
            (true, _) => 0.06 * (high - low),
            (false, true) => 1.0,
            (false, false) => 0.05 * high.abs(),
        };
        (low - if zero && low == 0.0 { 0.0 } else { margin }, high + margin)
    };
    let (mut x_low, mut x_high) = span(|p| p.0, false);
    if marks == Marks::Bars {
        (x_low, x_high) = (x_low - 2.0 * BAR, x_high + 2.0 * BAR);
    }
    let (y_low, mut y_high) = span(|p| p.1, from_zero);
    let named = curves.iter().filter(|c| !c.label.is_empty()).count();
    if named > 1 {
        // Room for the legend above the curves.
        y_high += LEGEND_ROOM * named as f64 * (y_high - y_low);
    }

    let mut svg = String::new();
    let ([x, y], title) = (axes.map(shown_units), shown_units(title));
    draw(&mut svg, &title, [&x, &y], curves, [x_low, x_high, y_low, y_high], marks).ok()?;
    Some(svg)
}

/// Least and largest value of each stretch, so that a long record keeps its envelope.
fn thinned(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    if points.len() <= 2 * LYAPUNOV_INTERVALS {
        return points.to_vec();
    }
    let mut kept = Vec::with_capacity(2 * LYAPUNOV_INTERVALS);
    for stretch in points.chunks(points.len().div_ceil(LYAPUNOV_INTERVALS)) {
        let low = stretch.iter().enumerate().min_by(|a, b| a.1.1.total_cmp(&b.1.1));
        let high = stretch.iter().enumerate().max_by(|a, b| a.1.1.total_cmp(&b.1.1));
        if let (Some(low), Some(high)) = (low, high) {
            let (first, second) = if low.0 <= high.0 { (low, high) } else { (high, low) };
            kept.extend([*first.1, *second.1]);
        }
    }
    kept
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
    if let (Marks::Band, [_, upper, lower]) = (marks, curves) {
        let around = thinned(&upper.points).into_iter().chain(thinned(&lower.points).into_iter().rev());
        let area: Vec<_> = around.filter(|(a, b)| a.is_finite() && b.is_finite()).collect();
        chart.draw_series([Polygon::new(area, COLOURS[BAND].mix(BAND_FILL))]).map_err(|e| fail(&e))?;
    }
    // The curve lies over the edges of its band.
    let mut order: Vec<usize> = (0..curves.len()).collect();
    if marks == Marks::Band {
        order.reverse();
    }
    for k in order {
        let curve = &curves[k];
        let colour = COLOURS[colour_of(curves.iter().map(|c| c.label.as_str()), k)];
        let shown = match marks {
            Marks::Lines | Marks::Band | Marks::Bars => thinned(&curve.points),
            Marks::Dots => curve.points.iter().step_by(curve.points.len().div_ceil(DOTS).max(1)).copied().collect(),
        };
        let finite = shown.into_iter().filter(|(a, b)| a.is_finite() && b.is_finite());
        // A few points are to be seen, many to be told apart.
        let dot = if curve.points.len() <= FEW { 3 } else { 1 };
        let series = match marks {
            Marks::Lines | Marks::Band => {
                let width = if marks == Marks::Band && k > 0 { 1 } else { 2 };
                chart.draw_series(LineSeries::new(finite, colour.stroke_width(width)))
            }
            Marks::Dots => chart.draw_series(finite.map(|p| Circle::new(p, dot, colour.filled()))),
            Marks::Bars => {
                let bar =
                    |(at, height): (f64, f64)| Rectangle::new([(at - BAR, 0.0), (at + BAR, height)], colour.filled());
                chart.draw_series(finite.map(bar))
            }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// What a page shows without scripts can be taken out of it again, picture by picture.
    #[test]
    fn a_page_gives_back_its_still_pictures() {
        let curve = |label: &str| Curve { label: label.into(), points: vec![(0.0, 1.0), (1.0, 2.0)] };
        let charts = ["a", "b"].map(|name| line_chart(name, "x", "y", &[curve(name)], false).unwrap());
        let page = format!("<p>{}</p>{}", charts[0], charts[1]);
        let found = stills(&page);
        assert_eq!(found.len(), 2);
        assert!(found.iter().all(|svg| svg.starts_with("<svg") && svg.ends_with("</svg>")), "{found:?}");
        assert!(stills("<p>no chart</p>").is_empty());
    }

    /// The picture has the area between both edges, the script's numbers have the edges beside the curve.
    #[test]
    fn a_band_lies_around_its_curve() {
        let curve = Curve { label: "STE".into(), points: vec![(0.0, 9.0), (1.0, 10.0), (2.0, 9.0)] };
        let figure = banded_chart("t", "x", "y", curve, "bounds", [0.25, 0.5]).unwrap();
        assert_eq!(figure.matches("<polygon").count(), 1, "{figure}");
        assert!(figure.contains(r#""band":true"#), "{figure}");
        assert!(figure.contains("[[0,1,2],[9,10,9],[9.5,10.5,9.5],[8.75,9.75,8.75]]"), "{figure}");
    }
}
