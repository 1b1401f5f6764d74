//! The work-precision chart: errors against wall times, one panel a quantity and a kind of work.

use plotters::{coord::Shift, prelude::*};
use study::{AnswerError, Work};

use super::charts::COLOURS;
use crate::chart::{Outcome, WorkPrecision};

const WIDTH: u32 = 1040;
/// Height of a row of panels.
const PANEL: i32 = 290;
/// Height of title and legend.
const HEAD: u32 = 136;
/// Errors below this are drawn on the axis: round-off and luck are no accuracy.
const LEAST: f64 = 1e-5;

type Drawing<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Failure = Box<dyn std::error::Error>;

/// One error of an answer, where it is known.
struct Quantity {
    name: &'static str,
    of: fn(&AnswerError) -> Option<f64>,
}

/// One wall time.
struct Effort {
    name: &'static str,
    of: fn(&Work) -> f64,
}

const QUANTITIES: [Quantity; 3] = [
    Quantity { name: "mean STE", of: |e| Some(e.mean_ste) },
    Quantity { name: "peak-to-peak STE", of: |e| e.peak_to_peak_ste },
    Quantity { name: "mean contact-line length", of: |e| e.mean_line_length },
];
const EFFORTS: [Effort; 2] = [
    Effort { name: "first cycle, everything before it included [s]", of: Work::first_cycle_s },
    Effort { name: "one more position [s]", of: Work::position_s },
];

/// The chart as SVG.
///
/// # Errors
/// What the drawing library complains of.
pub fn work_precision_svg(title: &str, chart: &WorkPrecision) -> Result<String, String> {
    let mut svg = String::new();
    draw(&mut svg, title, chart).map_err(|e| e.to_string())?;
    Ok(svg)
}

/// Names of the ways that have a point, in the order of the table.
fn series(chart: &WorkPrecision) -> Vec<&'static str> {
    let mut names: Vec<&'static str> = Vec::new();
    for row in &chart.rows {
        if matches!(row.outcome, Outcome::Measured { .. }) && !names.contains(&row.way) {
            names.push(row.way);
        }
    }
    names
}

/// Points (s, relative error) of a way in one panel, with the elements along the profile.
fn points(chart: &WorkPrecision, way: &str, q: &Quantity, e: &Effort) -> Vec<(f64, f64, u32)> {
    let rows = chart.rows.iter().filter(|r| r.way == way);
    rows.filter_map(|r| match &r.outcome {
        Outcome::Measured { work, error, .. } => {
            let (x, y) = ((e.of)(work), (q.of)(error)?.abs().max(LEAST));
            (x > 0.0 && x.is_finite() && y.is_finite()).then(|| (x, y, r.density.map_or(0, |d| d.profile)))
        }
        Outcome::Skipped(_) => None,
    })
    .collect()
}

fn draw(svg: &mut String, title: &str, chart: &WorkPrecision) -> Result<(), Failure> {
    let height = HEAD + (PANEL as u32) * QUANTITIES.len() as u32;
    let root = SVGBackend::with_string(svg, (WIDTH, height)).into_drawing_area();
    root.fill(&WHITE)?;
    let (head, body) = root.split_vertically(HEAD);
    let names = series(chart);
    legend(&head, title, &names)?;
    let panels = body.split_evenly((QUANTITIES.len(), EFFORTS.len()));
    for (i, panel) in panels.iter().enumerate() {
        let (q, e) = (&QUANTITIES[i / EFFORTS.len()], &EFFORTS[i % EFFORTS.len()]);
        let all: Vec<_> = names.iter().map(|n| points(chart, n, q, e)).collect();
        draw_panel(panel, q, e, &all)?;
    }
    root.present()?;
    Ok(())
}

fn legend(area: &Drawing<'_>, title: &str, names: &[&str]) -> Result<(), Failure> {
    area.draw(&Text::new(title.to_owned(), (16, 10), ("sans-serif", 18)))?;
    const COLUMNS: i32 = 3;
    for (k, name) in names.iter().enumerate() {
        let (x, y) = (20 + (k as i32 % COLUMNS) * (WIDTH as i32 / COLUMNS), 44 + (k as i32 / COLUMNS) * 20);
        let colour = COLOURS[k % COLOURS.len()];
        area.draw(&PathElement::new([(x, y), (x + 24, y)], colour.stroke_width(2)))?;
        area.draw(&Circle::new((x + 12, y), 4, colour.filled()))?;
        area.draw(&Text::new((*name).to_owned(), (x + 32, y - 7), ("sans-serif", 14)))?;
    }
    Ok(())
}

fn draw_panel(area: &Drawing<'_>, q: &Quantity, e: &Effort, all: &[Vec<(f64, f64, u32)>]) -> Result<(), Failure> {
    let flat = || all.iter().flatten();
    if flat().next().is_none() {
        let text = format!("{}: no point", q.name);
        return Ok(area.draw(&Text::new(text, (40, 40), ("sans-serif", 14)))?);
    }
    let span = |pick: fn(&(f64, f64, u32)) -> f64| {
        let (low, high) = flat().map(pick).fold((f64::INFINITY, 0.0), |(l, h): (f64, f64), v| (l.min(v), h.max(v)));
        // Whole decades, so that every axis has at least one labelled step.
        (10f64.powf((low / 1.3).log10().floor()), 10f64.powf((1.3 * high).log10().ceil()))
    };
    let ((x0, x1), (y0, y1)) = (span(|p| p.0), span(|p| 100.0 * p.1));
    let mut panel = ChartBuilder::on(area)
        .caption(format!("Error of {}", q.name), ("sans-serif", 14))
        .margin(8)
        .margin_right(24)
        .x_label_area_size(40)
        .y_label_area_size(62)
        .build_cartesian_2d((x0..x1).log_scale(), (y0..y1).log_scale())?;
    let label = |v: &f64| format!("{v}");
    panel
        .configure_mesh()
        .max_light_lines(0)
        .x_desc(e.name)
        .y_desc("error [%]")
        .x_label_formatter(&label)
        .y_label_formatter(&label)
        .draw()?;
    for (k, points) in all.iter().enumerate() {
        let colour = COLOURS[k % COLOURS.len()];
        let at: Vec<(f64, f64)> = points.iter().map(|&(x, y, _)| (x, 100.0 * y)).collect();
        panel.draw_series(LineSeries::new(at.iter().copied(), colour.stroke_width(2)))?;
        panel.draw_series(at.iter().map(|&p| Circle::new(p, 4, colour.filled())))?;
        for (&p, &(_, _, profile)) in at.iter().zip(points) {
            if profile > 0 {
                let text = Text::new(profile.to_string(), (6, -14), ("sans-serif", 12).into_font().color(&colour));
                panel.draw_series(std::iter::once(EmptyElement::at(p) + text))?;
            }
        }
    }
    Ok(())
}
