//! `contact_pattern_pinion.vtu`, `contact_pattern_wheel.vtu`: the flank of tooth 0 as a surface with the pattern on it.

use std::io::{self, Write};

use super::{Encoding, Field, vtu::write_surface};
use analysis::results::GearPattern;

/// A gear's pattern on its flank in space: quads between roll angles and stations. The gear stands at its centre with
/// tooth 0 on +x at mid-face. The end faces have the values of the slices next to them.
///
/// # Errors
/// What `out` reports.
pub fn write_pattern_vtu(pattern: &GearPattern, out: &mut impl Write) -> io::Result<()> {
    let GearPattern { flank, grid, .. } = pattern;
    let (rolls, stations) = (grid.rolls(), grid.stations());
    let last = stations.len().saturating_sub(1);
    // Height of each row of nodes and the station whose values it has.
    let mut rows = vec![(-flank.half_width, 0)];
    rows.extend(stations.iter().copied().zip(0..));
    rows.push((flank.half_width, last));

    let on_rows = |value: &dyn Fn(usize, usize) -> f64| -> Vec<f64> {
        rows.iter().flat_map(|&(_, station)| (0..rolls.len()).map(move |i| value(station, i))).collect()
    };
    let pressure = on_rows(&|station, i| grid.max_pressure()[station * rolls.len() + i]);
    let load = on_rows(&|station, i| grid.max_line_load()[station * rolls.len() + i]);
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
        [p.x + pattern.centre_x, p.y, p.z]
    };
    let nodes: Vec<[f64; 3]> = rows.iter().flat_map(|&(z, _)| rolls.iter().map(move |&u| place(z, u))).collect();
    let across = rolls.len() as u32;
    let corner = |row: usize, i: usize| row as u32 * across + i as u32;
    let quads: Vec<[u32; 4]> = (1..rows.len())
        .flat_map(|row| {
            (1..rolls.len())
                .map(move |i| [corner(row - 1, i - 1), corner(row - 1, i), corner(row, i), corner(row, i - 1)])
        })
        .collect();
    write_surface(out, &nodes, &quads, &fields, Encoding::Zlib)
}
