//! `contact_pattern_pinion.csv`, `contact_pattern_wheel.csv`: one row a place on the flank.

use analysis::results::GearPattern;
use answer::Table;

/// A gear's pattern under that name, station by station in z, from root to tip.
pub fn pattern_table(name: &'static str, pattern: &GearPattern) -> Table {
    let grid = &pattern.grid;
    let places = || grid.stations().iter().flat_map(|&z| grid.rolls().iter().map(move |&roll| (roll, z)));
    let values = grid.max_pressure().iter().zip(grid.max_line_load());
    let rows = places()
        .zip(values)
        .map(|((roll, z), (pressure, load))| [roll.to_degrees(), pattern.diameter(roll), z, *pressure, *load]);
    of_places(name, &rows.collect::<Vec<_>>())
}

/// Places with their roll angle (degrees), diameter and height (mm), largest pressure (MPa) and line load (N/mm).
pub(crate) fn of_places(name: &'static str, rows: &[[f64; 5]]) -> Table {
    let column = |k: usize| rows.iter().map(move |row| row[k]);
    Table::new(name)
        .numbers("roll_angle_deg", "roll angle of the place: 41 places from the root form circle to the tip circle, equally spaced, each the middle of a strip", column(0))
        .numbers("diameter_mm", "diameter of the place", column(1))
        .numbers("z_mm", "middle of the slice, from the gear's own mid-face", column(2))
        .numbers("max_pressure_mpa", "largest pressure p0 of the contact lines within half a strip; 0 where there is none", column(3))
        .numbers("max_line_load_n_per_mm", "largest line load of the contact lines within half a strip; 0 where there is none", column(4))
}
