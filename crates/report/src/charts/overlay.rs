//! What is drawn over a map: lines of equal value, dots, a marked place.

use std::fmt::Write;

use plotters::style::{
    RGBColor,
    colors::colormaps::{ColorMap, ViridisRGB},
};
use serde::Serialize;

use answer::Numbers;

/// Digits of places.
const DIGITS: usize = 5;

/// Lines, dots and a mark over a map; nothing by default.
#[derive(Debug, Default, Serialize)]
pub struct Overlay {
    /// Lines of equal value.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub lines: Vec<LevelLine>,
    /// Dots in the colours of the map: x, y, share of the scale.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub dots: Vec<Numbers>,
    /// The place that a reader looks for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mark: Option<Mark>,
}

/// A line of equal value.
#[derive(Debug, Serialize)]
pub struct LevelLine {
    /// The value in words.
    value: String,
    /// Ends of its pieces: x, y, x, y, and so on.
    pieces: Numbers,
}

/// A marked place.
#[derive(Debug, Serialize)]
pub struct Mark {
    /// Where.
    pub at: [f64; 2],
    /// Text at this place.
    pub text: String,
}

/// The area of a chart in a drawing, and which values are at its ends.
#[derive(Debug, Clone, Copy)]
pub struct Room {
    /// Left, top, width, height.
    pub place: [i32; 4],
    /// Left, right, low, high.
    pub ends: [f64; 4],
}

impl Room {
    /// Where values are in the drawing.
    fn at(&self, x: f64, y: f64) -> (f64, f64) {
        let [left, top, width, height] = self.place.map(f64::from);
        let [from, to, low, high] = self.ends;
        (left + width * (x - from) / (to - from), top + height * (high - y) / (high - low))
    }
}

impl LevelLine {
    /// From the ends of its pieces.
    pub fn new(level: f64, pieces: &[[(f64, f64); 2]]) -> Self {
        let ends = pieces.iter().flatten().flat_map(|&(x, y)| [x, y]).collect();
        Self { value: words(level), pieces: Numbers(ends, DIGITS) }
    }
}

impl Overlay {
    /// One more dot.
    pub fn dot(&mut self, x: f64, y: f64, share: f64) {
        self.dots.push(Numbers(vec![x, y, share], DIGITS));
    }

    /// As parts of an SVG drawing.
    pub fn svg(&self, room: Room) -> String {
        let mut svg = String::new();
        // Writing to a String cannot fail.
        for dot in &self.dots {
            let (x, y) = room.at(dot.0[0], dot.0[1]);
            let RGBColor(r, g, b) = ViridisRGB.get_color(dot.0[2] as f32);
            let _ = write!(
                svg,
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\" fill=\"rgb({r},{g},{b})\" stroke=\"#555\" stroke-width=\"0.4\"/>"
            );
        }
        for line in &self.lines {
            let mut path = String::new();
            for piece in line.pieces.0.chunks_exact(4) {
                let ((x, y), (u, v)) = (room.at(piece[0], piece[1]), room.at(piece[2], piece[3]));
                let _ = write!(path, "M{x:.1} {y:.1}L{u:.1} {v:.1}");
            }
            let _ = write!(svg, "<path d=\"{path}\" fill=\"none\" stroke=\"#fff\" stroke-width=\"1\"/>");
            // Beside a piece in the middle of the list, which is not at an end of the line.
            if let Some(piece) = line.pieces.0.chunks_exact(4).nth(line.pieces.0.len() / 8) {
                let (x, y) = room.at(piece[0], piece[1]);
                svg += &text(x + 3.0, y - 3.0, &line.value);
            }
        }
        if let Some(Mark { at, text: said }) = &self.mark {
            // At a corner the mark and its text stay inside of the map.
            let [left, top, width, height] = room.place.map(f64::from);
            let (x, y) = room.at(at[0], at[1]);
            let (x, y) = (x.clamp(left + 8.0, left + width - 8.0), y.clamp(top + 8.0, top + height - 8.0));
            let _ = write!(
                svg,
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"6\" fill=\"#d55e00\" stroke=\"#fff\" stroke-width=\"2\"/>"
            );
            // On the side where there is room.
            let right = x > left + 0.7 * width;
            let shift = if right { -10.0 - 7.0 * said.chars().count() as f64 } else { 10.0 };
            svg += &text(x + shift, y + 5.0, said);
        }
        svg
    }
}

/// White letters with a dark rim, to be read on any colour.
fn text(x: f64, y: f64, said: &str) -> String {
    format!(
        "<text x=\"{x:.1}\" y=\"{y:.1}\" font-family=\"sans-serif\" font-size=\"13\" fill=\"#fff\" stroke=\"#222\" \
         stroke-width=\"2.5\" paint-order=\"stroke\">{}</text>",
        said.replace('&', "&amp;").replace('<', "&lt;")
    )
}

/// A number with as many digits as a reader of a chart wants.
pub fn words(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e6).contains(&size) {
        return format!("{value:.2e}");
    }
    let decimals = if size == 0.0 { 0 } else { (2 - size.log10().floor() as i32).max(0) as usize };
    let written = format!("{value:.decimals$}");
    if written.contains('.') { written.trim_end_matches('0').trim_end_matches('.').to_owned() } else { written }
}
