//! A curve with its colour.

use plotters::style::RGBColor;

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Name in the legend; of one without a name nothing is told apart.
    pub label: String,
    /// Abscissa and value.
    pub points: Vec<(f64, f64)>,
}

/// Colours that the colour-blind can tell apart, without the yellow, which paper swallows.
/// Source: the first seven Okabe and Ito, Color Universal Design, 2008; the others Tol, Colour schemes, 2021 (muted).
pub const COLOURS: [RGBColor; 12] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
    RGBColor(51, 34, 136),
    RGBColor(136, 34, 85),
    RGBColor(153, 153, 51),
    RGBColor(120, 120, 120),
    RGBColor(110, 60, 20),
];

/// Lines of a spectrum up to which they are bars.
pub(super) const BARS: usize = 24;

/// Which of the palette's colours a curve has: one without a name is more of the last that has one.
pub fn colour_of<'a>(labels: impl Iterator<Item = &'a str>, k: usize) -> usize {
    labels.take(k + 1).enumerate().filter(|(_, label)| !label.is_empty()).last().map_or(0, |(own, _)| own)
        % COLOURS.len()
}
