//! `contact_pattern.svg`: the patterns of both gears on their unrolled flanks.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::{
    curves::figure,
    field_map::{FieldMap, Side, share},
    overlay::Overlay,
    plot_data::embedded,
};
use analysis::results::GearPattern;

/// Columns of a flank at most; more stations share columns, which then show the larger value.
const COLUMNS: usize = 96;
/// Steps of the colour bar.
const SHADES: usize = 64;
/// Room for the words at tip and root, over the height of the flank.
const ROOM: f64 = 0.08;
/// Numbers and words at the axes.
const LABELS: (&str, i32) = ("sans-serif", 12);
/// A flank where nothing touched it; no colour of the map.
const UNTOUCHED: RGBColor = RGBColor(232, 232, 228);

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Heat map of the largest pressure on both flanks, profile up, face width across, one colour scale for both.
///
/// `None` if the chart cannot be drawn.
pub fn contact_pattern_svg(patterns: &[GearPattern; 2]) -> Option<String> {
    let mut svg = String::new();
    draw(&mut svg, patterns).ok()?;
    Some(svg)
}

/// The picture with the cells of both flanks, as a part of a page.
pub fn contact_pattern_figure(svg: &str, patterns: &[GearPattern; 2]) -> String {
    figure(svg, &contact_pattern_maps(patterns).map(|map| embedded("map", &map)))
}

/// The cells of both flanks on one scale of colours, as the script of a page takes them.
pub fn contact_pattern_maps(patterns: &[GearPattern; 2]) -> [FieldMap<'static>; 2] {
    let largest = patterns.iter().map(GearPattern::largest_pressure).fold(0.0, f64::max);
    patterns.each_ref().map(|pattern| field_map(pattern, largest))
}

fn field_map(pattern: &GearPattern, largest: f64) -> FieldMap<'static> {
    let GearPattern { grid, flank, name, .. } = pattern;
    let (rolls, count) = (grid.rolls(), grid.stations().len());
    let pressure = grid.max_pressure();
    let z = (0..=count).map(|i| pattern.strip_edge(i)).collect();
    let places = (0..rolls.len()).flat_map(|i| (0..count).map(move |station| station * rolls.len() + i));
    FieldMap {
        title: format!("Contact pattern: {name}, {} flank", flank.side.name()),
        sides: [
            Side { label: "z [mm]", edges: z },
            Side { label: "diameter [mm]", edges: (0..=rolls.len()).map(|i| edge(pattern, i)).collect() },
        ],
        quantity: "largest pressure [MPa]",
        least: 0.0,
        largest,
        decades: None,
        beside: None,
        shares: places.map(|at| share(pressure[at], largest, None)).collect(),
        over: Overlay::default(),
    }
}

/// Diameter at the lower edge of a strip of the grid, mm; the first and the last strip are half as high as the others.
fn edge(pattern: &GearPattern, strip: usize) -> f64 {
    let rolls = pattern.grid.rolls();
    let (below, above) = (strip.saturating_sub(1), strip.min(rolls.len() - 1));
    pattern.diameter(0.5 * (rolls[below] + rolls[above]))
}

fn draw(svg: &mut String, patterns: &[GearPattern; 2]) -> Result<(), String> {
    let largest = patterns.iter().map(GearPattern::largest_pressure).fold(0.0, f64::max);
    // Without load the bar still needs a length.
    let scale = if largest > 0.0 { largest } else { 1.0 };
    let root = SVGBackend::with_string(svg, (820, 400)).into_drawing_area();
    root.fill(&WHITE).map_err(text)?;
    let (flanks, bar) = root.split_horizontally(700);
    let halves = flanks.split_evenly((1, 2));
    for (area, pattern) in halves.iter().zip(patterns) {
        flank(area, pattern, scale)?;
    }
    colour_bar(&bar, scale)?;
    root.present().map_err(text)
}

fn flank(area: &Area<'_>, pattern: &GearPattern, scale: f64) -> Result<(), String> {
    let GearPattern { flank, name, .. } = pattern;
    let (root, tip) = (pattern.diameter(flank.roll_form), pattern.diameter(flank.roll_tip));
    let room = ROOM * (tip - root);
    let half = flank.half_width;
    let mut chart = ChartBuilder::on(area)
        .caption(format!("{name}, {} flank", flank.side.name()), ("sans-serif", 16))
        .margin(8)
        .x_label_area_size(40)
        .y_label_area_size(58)
        .build_cartesian_2d(-half..half, root - room..tip + room)
        .map_err(text)?;
    let mut axes = chart.configure_mesh();
    axes.disable_mesh().label_style(LABELS).axis_desc_style(LABELS).x_labels(5);
    axes.x_desc("z [mm]").y_desc("diameter [mm]").draw().map_err(text)?;
    chart.draw_series([Rectangle::new([(-half, root), (half, tip)], UNTOUCHED.filled())]).map_err(text)?;

    let cells = cells(pattern).into_iter().map(|([low, high], pressure)| {
        let colour: RGBColor = ViridisRGB.get_color((pressure / scale) as f32);
        Rectangle::new([low, high], colour.filled())
    });
    chart.draw_series(cells).map_err(text)?;
    let style = LABELS.into_font().color(&BLACK).pos(Pos::new(HPos::Center, VPos::Center));
    let words = [(tip + 0.5 * room, "tip"), (root - 0.5 * room, "root")];
    chart.draw_series(words.map(|(d, word)| Text::new(word, (0.0, d), style.clone()))).map_err(text)?;
    Ok(())
}

/// Two opposite corners (z, diameter; mm) and pressure (MPa) of every touched cell.
fn cells(pattern: &GearPattern) -> Vec<([(f64, f64); 2], f64)> {
    let grid = &pattern.grid;
    let (rolls, count) = (grid.rolls(), grid.stations().len());
    let shared = count.div_ceil(COLUMNS).max(1);
    let mut cells = Vec::new();
    for first in (0..count).step_by(shared) {
        let columns = first..(first + shared).min(count);
        for i in 0..rolls.len() {
            let values = columns.clone().map(|station| grid.max_pressure()[station * rolls.len() + i]);
            let pressure = values.fold(0.0, f64::max);
            if pressure > 0.0 {
                let low = (pattern.strip_edge(columns.start), edge(pattern, i));
                let high = (pattern.strip_edge(columns.end), edge(pattern, i + 1));
                cells.push(([low, high], pressure));
            }
        }
    }
    cells
}

fn colour_bar(area: &Area<'_>, scale: f64) -> Result<(), String> {
    let mut chart = ChartBuilder::on(area)
        .caption("max. MPa", ("sans-serif", 16))
        .margin(8)
        .x_label_area_size(40)
        .y_label_area_size(58)
        .build_cartesian_2d(0.0..1.0, 0.0..scale)
        .map_err(text)?;
    let mut axes = chart.configure_mesh();
    axes.disable_mesh().disable_x_axis().label_style(LABELS).y_label_formatter(&|p| format!("{p:.0}"));
    axes.draw().map_err(text)?;
    let step = scale / SHADES as f64;
    let shades = (0..SHADES).map(|k| {
        let colour: RGBColor = ViridisRGB.get_color((k as f32 + 0.5) / SHADES as f32);
        Rectangle::new([(0.0, step * k as f64), (1.0, step * (k + 1) as f64)], colour.filled())
    });
    chart.draw_series(shades).map_err(text)?;
    Ok(())
}

/// Errors of the drawing backend borrow it; their text does not.
fn text(e: impl std::fmt::Display) -> String {
    e.to_string()
}
