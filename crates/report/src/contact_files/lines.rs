//! `contact_lines.csv`: one row a loaded slice of a position.

use std::f64::consts::PI;

use analysis::results::{diameter, pairs};
use answer::Table;
use geometry::GearPair;
use ltca::StaticHistory;
use scene::Scene;

/// Every contact line of a run, slice by slice: position by position, pair by pair, ascending in z.
///
/// Pairs are numbered within their mesh cycle, as in `history.csv`.
pub fn contact_lines(scene: &Scene, pair: &GearPair, history: &StaticHistory) -> Table {
    let pitch = 2.0 * PI / f64::from(scene.pinion.teeth);
    let base_radius = [pair.pinion.base_radius(), pair.wheel.base_radius()];
    let all: Vec<_> = (history.positions.iter())
        .flat_map(|p| p.pairs.iter().flat_map(move |q| q.slices.iter().map(move |s| (p, q, s))))
        .collect();
    let rows = || all.iter();
    let roll = |gear: usize| rows().map(move |(_, _, s)| s.roll[gear].to_degrees());
    let diameters = |gear: usize| rows().map(move |(_, _, s)| diameter(base_radius[gear], s.roll[gear]));
    Table::new("contact_lines")
        .numbers("pinion_angle_deg", "angle of the pinion", rows().map(|(p, _, _)| p.pinion_angle.to_degrees()))
        .numbers("mesh_phase", "phase of the mesh cycle, 0 .. 1", rows().map(|(p, _, _)| p.mesh_phase))
        .numbers("pair", "number of the tooth pair, as in `normal_force_pair_<k>_n`", rows().map(|(p, q, _)| pairs::in_cycle(p, q.pair, pitch) as f64))
        .numbers("pinion_tooth", "tooth of the pinion, from 0", rows().map(|(_, q, _)| f64::from(q.pinion_tooth)))
        .numbers("wheel_tooth", "tooth of the wheel, from 0", rows().map(|(_, q, _)| f64::from(q.wheel_tooth)))
        .numbers(
            "coast_flank",
            "0 on the flank that the torque presses; 1 on the other one, which only `flanks = \"both\"` lets touch",
            rows().map(|(_, _, s)| f64::from(u8::from(s.side != scene.side()))),
        )
        .numbers("z_mm", "middle of the slice on the pinion, from its mid-face; on the wheel it is less by the offset of the mid-faces", rows().map(|(_, _, s)| s.z))
        .numbers("pinion_roll_angle_deg", "roll angle on the pinion", roll(0))
        .numbers("pinion_diameter_mm", "diameter on the pinion", diameters(0))
        .numbers("wheel_roll_angle_deg", "roll angle on the wheel", roll(1))
        .numbers("wheel_diameter_mm", "diameter on the wheel", diameters(1))
        .numbers("line_load_n_per_mm", "normal force per mm of contact line", rows().map(|(_, _, s)| s.line_load))
        .numbers("half_width_mm", "half the width of the Hertzian band", rows().map(|(_, _, s)| s.half_width))
        .numbers("pressure_mpa", "largest pressure across the band, p0", rows().map(|(_, _, s)| s.pressure))
        .numbers("off_line_mm", "0 of flank on flank; above 0 a tip edge presses off the line of action, and the flanks continued would touch this arc length past it", rows().map(|(_, _, s)| s.off_line))
}
