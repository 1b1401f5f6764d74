//! A quantity over a rectangle, in colours: a picture that prints, and the cells for the script that zooms.

use answer::{Numbers, shown_units};
use base64::{Engine, prelude::BASE64_STANDARD};
use plotters::prelude::*;
use serde::{Serialize, Serializer};

use super::overlay::{Overlay, Room, words};

/// Pixels of the picture inside its axes, of which a cell covers one or many.
const PIXELS: [u32; 2] = [720, 320];
/// Steps between the least colour and the largest; step 0 is no colour.
const STEPS: f64 = 65_534.0;
/// Digits of the cells' edges.
const DIGITS: usize = 7;

/// One side of a map.
#[derive(Debug, Serialize)]
pub struct Side<'a> {
    /// Quantity and unit.
    #[serde(serialize_with = "units")]
    pub label: &'a str,
    /// Edges of the cells, ascending, one more than there are cells.
    #[serde(serialize_with = "short")]
    pub edges: Vec<f64>,
}

/// Values of cells.
#[derive(Debug, Serialize)]
pub struct FieldMap<'a> {
    /// Title of the map.
    #[serde(serialize_with = "units")]
    pub title: String,
    /// Horizontal and vertical side.
    pub sides: [Side<'a>; 2],
    /// Quantity with unit that the colours stand for.
    #[serde(serialize_with = "units")]
    pub quantity: &'a str,
    /// Value of the first colour; of no meaning with decades.
    pub least: f64,
    /// Value of the last colour.
    pub largest: f64,
    /// Decades below it that have colours; `None`: linear from the first.
    pub decades: Option<f64>,
    /// A second quantity of the rows, with its unit and name: what a reader of the map wants to know too.
    pub beside: Option<(&'a str, Numbers)>,
    /// Row by row from the lowest, each along the horizontal side; 0 where there is nothing.
    #[serde(rename = "cells", serialize_with = "steps")]
    pub shares: Vec<f64>,
    /// What is drawn over it.
    #[serde(flatten)]
    pub over: Overlay,
}

/// Where a value stands between no colour (0) and the last one (1).
pub fn share(value: f64, largest: f64, decades: Option<f64>) -> f64 {
    if largest > 0.0 && value > 0.0 {
        decades.map_or(value / largest, |d| 1.0 + (value / largest).log10() / d).clamp(0.0, 1.0)
    } else {
        0.0
    }
}

/// With units as people read them.
fn units<S: Serializer>(text: impl AsRef<str>, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&shown_units(text.as_ref()))
}

fn short<S: Serializer>(edges: &[f64], serializer: S) -> Result<S::Ok, S::Error> {
    // A copy of some hundred numbers.
    Numbers(edges.to_vec(), DIGITS).serialize(serializer)
}

/// Two bytes a cell, low byte first, as base64: 0 for nothing, else one more than its step.
fn steps<S: Serializer>(shares: &[f64], serializer: S) -> Result<S::Ok, S::Error> {
    let step = |s: f64| if s > 0.0 { (1.0 + s * STEPS).round() as u16 } else { 0 };
    let bytes: Vec<u8> = shares.iter().flat_map(|&s| step(s).to_le_bytes()).collect();
    serializer.serialize_str(&BASE64_STANDARD.encode(bytes))
}

impl FieldMap<'_> {
    /// The picture as SVG: axes as lines and letters, the cells as one image.
    pub fn picture(&self) -> Option<String> {
        let mut svg = String::new();
        let [x, y] = &self.sides;
        let ends = |side: &Side<'_>| Some((*side.edges.first()?, *side.edges.last()?));
        let ((left, right), (low, high)) = (ends(x)?, ends(y)?);
        let axes = [x.label, y.label].map(shown_units);
        let axes = axes.each_ref().map(String::as_str);
        let place = draw_axes(&mut svg, &shown_units(&self.caption()), axes, [left, right, low, high]).ok()?;
        let image = BASE64_STANDARD.encode(self.pixels([left, right, low, high])?);
        let [at_x, at_y, width, height] = place;
        let image = format!(
            "<image x=\"{at_x}\" y=\"{at_y}\" width=\"{width}\" height=\"{height}\" preserveAspectRatio=\"none\" \
             href=\"data:image/png;base64,{image}\"/>"
        );
        let over = self.over.svg(Room { place, ends: [left, right, low, high] });
        Some(svg.trim_end().trim_end_matches("</svg>").to_owned() + &image + &over + "</svg>")
    }

    /// The title; where the scale does not begin at 0, with its ends: the still picture has no bar of colours.
    fn caption(&self) -> String {
        let ends = || format!("{}: dark {}, light {}", self.title, words(self.least), words(self.largest));
        if self.least == 0.0 { self.title.clone() } else { ends() }
    }

    /// The cells as PNG, four bytes a pixel; where there is no cell nothing is drawn.
    fn pixels(&self, [left, right, low, high]: [f64; 4]) -> Option<Vec<u8>> {
        let [width, height] = PIXELS;
        let middles = |count: u32, from: f64, to: f64| {
            (0..count).map(move |i| from + (to - from) * (f64::from(i) + 0.5) / f64::from(count))
        };
        let cell = |side: &Side<'_>, at: f64| side.edges.partition_point(|&e| e <= at).checked_sub(1);
        let columns: Vec<Option<usize>> = middles(width, left, right).map(|x| cell(&self.sides[0], x)).collect();
        let per_row = self.sides[0].edges.len().saturating_sub(1);
        let mut pixels = Vec::with_capacity(4 * (width * height) as usize);
        for y in middles(height, high, low) {
            let row = cell(&self.sides[1], y);
            for column in &columns {
                let share = row.zip(*column).and_then(|(r, c)| self.shares.get(r * per_row + c)).copied();
                let of_share = |share: f64| {
                    let RGBColor(r, g, b) = ViridisRGB.get_color(share as f32);
                    [r, g, b, u8::MAX]
                };
                pixels.extend(share.filter(|s| *s > 0.0).map_or([0; 4], of_share));
            }
        }
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, width, height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.write_header().ok()?.write_image_data(&pixels).ok()?;
        Some(file)
    }
}

/// Axes without anything in them; left, top, width and height of the room inside, in units of the drawing.
fn draw_axes(
    svg: &mut String,
    title: &str,
    [x, y]: [&str; 2],
    [left, right, low, high]: [f64; 4],
) -> Result<[i32; 4], String> {
    fn text(e: impl std::fmt::Display) -> String {
        e.to_string()
    }
    let root = SVGBackend::with_string(svg, (820, 420)).into_drawing_area();
    root.fill(&WHITE).map_err(text)?;
    let mut chart = ChartBuilder::on(&root)
        .caption(title, ("sans-serif", 18))
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(72)
        .build_cartesian_2d(left..right, low..high)
        .map_err(text)?;
    chart.configure_mesh().disable_mesh().x_desc(x).y_desc(y).draw().map_err(text)?;
    let (across, down) = chart.plotting_area().get_pixel_range();
    root.present().map_err(text)?;
    Ok([across.start, down.start, across.end - across.start, down.end - down.start])
}
