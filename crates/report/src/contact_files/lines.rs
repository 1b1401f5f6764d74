//! `contact_lines.csv`: one row a loaded slice of a position.

use analysis::results::{diameter, pairs};
use std::f64::consts::PI;

use geometry::GearPair;
use ltca::StaticHistory;

use scene::Scene;

use crate::csv::push_row;

const COLUMNS: &str = "pinion_angle_deg,mesh_phase,pair,pinion_tooth,wheel_tooth,coast_flank,z_mm,\
                       pinion_roll_angle_deg,pinion_diameter_mm,wheel_roll_angle_deg,wheel_diameter_mm,\
                       line_load_n_per_mm,half_width_mm,pressure_mpa,off_line_mm\n";

/// Every contact line of a run, slice by slice, as CSV: position by position, pair by pair, ascending in z.
///
/// Pairs are numbered within their mesh cycle, as in `history.csv`.
pub fn write_contact_lines(scene: &Scene, pair: &GearPair, history: &StaticHistory) -> String {
    let pitch = 2.0 * PI / f64::from(scene.pinion.teeth);
    let base_radius = [pair.pinion.base_radius(), pair.wheel.base_radius()];
    let mut csv = COLUMNS.to_owned();
    for p in &history.positions {
        for of_pair in &p.pairs {
            for s in &of_pair.slices {
                let at = |gear: usize| [s.roll[gear].to_degrees(), diameter(base_radius[gear], s.roll[gear])];
                let ([pinion_roll, pinion_diameter], [wheel_roll, wheel_diameter]) = (at(0), at(1));
                push_row(
                    &mut csv,
                    [
                        p.pinion_angle.to_degrees(),
                        p.mesh_phase,
                        pairs::in_cycle(p, of_pair.pair, pitch) as f64,
                        f64::from(of_pair.pinion_tooth),
                        f64::from(of_pair.wheel_tooth),
                        f64::from(u8::from(s.side != scene.side())),
                        s.z,
                        pinion_roll,
                        pinion_diameter,
                        wheel_roll,
                        wheel_diameter,
                        s.line_load,
                        s.half_width,
                        s.pressure,
                        s.off_line,
                    ],
                );
            }
        }
    }
    csv
}
