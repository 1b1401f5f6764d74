//! `contact_pattern_pinion.csv`, `contact_pattern_wheel.csv`: one row a place on the flank.

use analysis::results::GearPattern;

use crate::csv::push_row;

/// A gear's pattern as CSV, station by station in z, from root to tip.
pub fn write_contact_pattern(pattern: &GearPattern) -> String {
    let mut csv = "roll_angle_deg,diameter_mm,z_mm,max_pressure_mpa,max_line_load_n_per_mm\n".to_owned();
    let grid = &pattern.grid;
    let places = grid.stations().iter().flat_map(|&z| grid.rolls().iter().map(move |&roll| (roll, z)));
    for ((roll, z), (&pressure, &load)) in places.zip(grid.max_pressure().iter().zip(grid.max_line_load())) {
        push_row(&mut csv, [roll.to_degrees(), pattern.diameter(roll), z, pressure, load]);
    }
    csv
}
