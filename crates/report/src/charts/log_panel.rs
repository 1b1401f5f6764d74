//! Panels with both axes logarithmic, as work-precision charts have them, and the legend above.

use plotters::{coord::Shift, prelude::*};

use super::curve::COLOURS;

/// Where a panel is drawn.
pub type Drawing<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// What drawing may fail with.
pub type Failure = Box<dyn std::error::Error>;

/// A point of a curve and what is written beside it.
#[derive(Debug, Clone, PartialEq)]
pub struct Labelled {
    /// Abscissa and value, both above zero.
    pub at: (f64, f64),
    /// What is written beside it.
    pub label: Option<String>,
    /// Value that the point's own bound ends at: a thin line with a stroke across it.
    pub bound: Option<f64>,
}

/// What stands around a panel.
#[derive(Debug, Clone, Copy)]
pub struct Captions<'a> {
    /// What the panel shows.
    pub title: &'a str,
    /// Quantity and unit of the horizontal axis.
    pub x: &'a str,
    /// Quantity and unit of the vertical axis.
    pub y: &'a str,
}

/// Names in a line of the legend.
const COLUMNS: usize = 3;

/// Names of the curves in their colours, three in a line.
pub fn legend(area: &Drawing<'_>, title: &str, names: &[&str]) -> Result<(), Failure> {
    area.draw(&Text::new(title.to_owned(), (16, 10), ("sans-serif", 18)))?;
    let (width, columns) = (area.dim_in_pixel().0 as i32, COLUMNS as i32);
    for (k, name) in names.iter().enumerate() {
        let (x, y) = (20 + (k as i32 % columns) * (width / columns), 44 + (k as i32 / columns) * 20);
        let colour = COLOURS[k % COLOURS.len()];
        area.draw(&PathElement::new([(x, y), (x + 24, y)], colour.stroke_width(2)))?;
        area.draw(&Circle::new((x + 12, y), 4, colour.filled()))?;
        area.draw(&Text::new((*name).to_owned(), (x + 32, y - 7), ("sans-serif", 14)))?;
    }
    Ok(())
}

/// Width of a picture of panels, pixels.
const WIDTH: u32 = 1040;
/// Height of a row of panels, pixels.
const ROW: u32 = 300;
/// Height of the title and of a line of the legend, pixels.
const HEAD: [u32; 2] = [44, 20];

/// A picture of panels, two in a row, under one legend, as SVG: the points of every panel are given in the order of
/// `names`, and those of a panel that lacks a name are none.
///
/// # Errors
/// What drawing failed with, as text.
pub fn log_panels(
    title: &str,
    names: &[&str],
    panels: &[(Captions<'_>, Vec<Vec<Labelled>>)],
) -> Result<String, String> {
    let mut svg = String::new();
    draw_panels(&mut svg, title, names, panels).map_err(|failure| failure.to_string())?;
    Ok(svg)
}

fn draw_panels(
    svg: &mut String,
    title: &str,
    names: &[&str],
    panels: &[(Captions<'_>, Vec<Vec<Labelled>>)],
) -> Result<(), Failure> {
    let head = HEAD[0] + HEAD[1] * (names.len().div_ceil(COLUMNS) as u32);
    let rows = panels.len().div_ceil(2);
    let root = SVGBackend::with_string(svg, (WIDTH, head + ROW * rows as u32)).into_drawing_area();
    root.fill(&WHITE)?;
    let (top, body) = root.split_vertically(head);
    legend(&top, title, names)?;
    for (area, (captions, points)) in body.split_evenly((rows, 2)).iter().zip(panels) {
        log_panel(area, *captions, points)?;
    }
    root.present()?;
    Ok(())
}

/// Curves through their points, one colour each, over whole decades.
pub fn log_panel(area: &Drawing<'_>, words: Captions<'_>, all: &[Vec<Labelled>]) -> Result<(), Failure> {
    let flat = || all.iter().flatten();
    if flat().next().is_none() {
        let text = format!("{}: no point", words.title);
        return Ok(area.draw(&Text::new(text, (40, 40), ("sans-serif", 14)))?);
    }
    let span = |pick: fn(&Labelled) -> [f64; 2]| {
        let (low, high) =
            flat().flat_map(pick).fold((f64::INFINITY, 0.0), |(l, h): (f64, f64), v| (l.min(v), h.max(v)));
        // Whole decades, so that every axis has at least one labelled step.
        (10f64.powf((low / 1.3).log10().floor()), 10f64.powf((1.3 * high).log10().ceil()))
    };
    let ((x0, x1), (y0, y1)) = (span(|p| [p.at.0; 2]), span(|p| [p.at.1, p.bound.unwrap_or(p.at.1)]));
    let mut panel = ChartBuilder::on(area)
        .caption(words.title, ("sans-serif", 14))
        .margin(8)
        .margin_right(24)
        .x_label_area_size(40)
        .y_label_area_size(62)
        .build_cartesian_2d((x0..x1).log_scale(), (y0..y1).log_scale())?;
    // Powers of ten that were added up are no round numbers.
    let label = |v: &f64| {
        if *v < 1e-3 {
            format!("{v:.0e}")
        } else {
            format!("{:.6}", v).trim_end_matches('0').trim_end_matches('.').to_owned()
        }
    };
    panel
        .configure_mesh()
        .max_light_lines(0)
        .x_desc(words.x)
        .y_desc(words.y)
        .x_label_formatter(&label)
        .y_label_formatter(&label)
        .draw()?;
    for (k, points) in all.iter().enumerate() {
        let colour = COLOURS[k % COLOURS.len()];
        panel.draw_series(LineSeries::new(points.iter().map(|p| p.at), colour.stroke_width(2)))?;
        panel.draw_series(points.iter().map(|p| Circle::new(p.at, 4, colour.filled())))?;
        for Labelled { at: (x, y), bound, .. } in points {
            if let Some(end) = bound {
                panel.draw_series(LineSeries::new([(*x, *y), (*x, *end)], colour.mix(0.5).stroke_width(1)))?;
                let stroke = PathElement::new([(-5, 0), (5, 0)], colour.stroke_width(2));
                panel.draw_series(std::iter::once(EmptyElement::at((*x, *end)) + stroke))?;
            }
        }
        for Labelled { at, label, .. } in points {
            if let Some(label) = label {
                let text = Text::new(label.clone(), (6, -14), ("sans-serif", 12).into_font().color(&colour));
                panel.draw_series(std::iter::once(EmptyElement::at(*at) + text))?;
            }
        }
    }
    Ok(())
}
