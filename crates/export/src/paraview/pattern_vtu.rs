//! `contact_pattern_pinion.vtu`, `contact_pattern_wheel.vtu`: the flank of tooth 0 as a surface with the pattern on it.

use std::io::{self, Write};

use super::{Encoding, Field, vtu::write_surface};
use analysis::results::GearPattern;

/// A gear's pattern on its flank in space: quads between roll angles and stations. The gear stands at its centre with
/// tooth 0 on +x at mid-face. The ends of the common face have the values of the slices next to them; beyond it nothing
/// is pressed.
///
/// # Errors
/// What `out` reports.
pub fn write_pattern_vtu(pattern: &GearPattern, out: &mut impl Write) -> io::Result<()> {
    let GearPattern { flank, grid, .. } = pattern;
    let rolls = grid.rolls();
    let rows = rows(pattern);

    let on_rows = |value: &dyn Fn(Option<usize>, usize) -> f64| -> Vec<f64> {
        rows.iter().flat_map(|&(_, station)| (0..rolls.len()).map(move |i| value(station, i))).collect()
    };
    let of_grid =
        |values: &[f64], station: Option<usize>, i: usize| station.map_or(0.0, |s| values[s * rolls.len() + i]);
    let pressure = on_rows(&|station, i| of_grid(grid.max_pressure(), station, i));
    let load = on_rows(&|station, i| of_grid(grid.max_line_load(), station, i));
    let roll = on_rows(&|_, i| rolls[i].to_degrees());
    let diameter = on_rows(&|_, i| pattern.diameter(rolls[i]));
    let field = |name, values| Field { name, components: 1, values };
    let fields = [
        field("max_pressure_mpa", pressure.as_slice()),
        field("max_line_load_n_per_mm", &load),
        field("roll_angle_deg", &roll),
        field("diameter_mm", &diameter),
    ];

    let place = |z: f64, roll: f64| {
        let p = flank.point(roll, z);
        [p.x + pattern.centre[0], p.y, p.z + pattern.centre[1]]
    };
    let nodes: Vec<[f64; 3]> = rows.iter().flat_map(|&(z, _)| rolls.iter().map(move |&u| place(z, u))).collect();
    let across = rolls.len() as u32;
    let corner = |row: usize, i: usize| row as u32 * across + i as u32;
    let quads: Vec<[u32; 4]> = (1..rows.len())
        .filter(|&row| rows[row].0 != rows[row - 1].0)
        .flat_map(|row| {
            (1..rolls.len())
                .map(move |i| [corner(row - 1, i - 1), corner(row - 1, i), corner(row, i), corner(row, i - 1)])
        })
        .collect();
    write_surface(out, &nodes, &quads, &fields, Encoding::Zlib)
}

/// Height of each row of nodes over the gear's mid-face, mm, and the station whose values it has; `None` beyond the
/// common face, whose ends then have two rows.
fn rows(pattern: &GearPattern) -> Vec<(f64, Option<usize>)> {
    let GearPattern { flank, grid, face: [low, high], .. } = pattern;
    let stations = grid.stations();
    let last = stations.len().saturating_sub(1);
    let mut rows = Vec::new();
    if -flank.half_width < *low {
        rows.extend([(-flank.half_width, None), (*low, None)]);
    }
    rows.push((*low, Some(0)));
    rows.extend(stations.iter().copied().zip((0..).map(Some)));
    rows.push((*high, Some(last)));
    if flank.half_width > *high {
        rows.extend([(*high, None), (flank.half_width, None)]);
    }
    rows
}
