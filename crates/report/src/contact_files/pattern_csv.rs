//! `contact_pattern_pinion.csv`, `contact_pattern_wheel.csv`: one row a place on the flank.

use analysis::results::GearPattern;
use answer::Table;

/// A gear's pattern under that name, station by station in z, from root to tip.
pub fn pattern_table(name: &'static str, pattern: &GearPattern) -> Table {
    let grid = &pattern.grid;
    let places = || grid.stations().iter().flat_map(|&z| grid.rolls().iter().map(move |&roll| (roll, z)));
    let of = places().count().min(grid.max_pressure().len()).min(grid.max_line_load().len());
    Table::new(name)
        .numbers("roll_angle_deg", "roll angle", places().map(|(roll, _)| roll.to_degrees()).take(of))
        .numbers("diameter_mm", "diameter", places().map(|(roll, _)| pattern.diameter(roll)).take(of))
        .numbers("z_mm", "height on the gear", places().map(|(_, z)| z).take(of))
        .numbers("max_pressure_mpa", "largest pressure that came there", grid.max_pressure().iter().copied().take(of))
        .numbers("max_line_load_n_per_mm", "largest line load", grid.max_line_load().iter().copied().take(of))
}
