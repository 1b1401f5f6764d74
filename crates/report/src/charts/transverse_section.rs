//! The mesh in transverse section: teeth, base and tip circles, path of contact with its points; both gears with their
//! senses of rotation and the torques on their shafts.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;

use answer::shown_units;
use export::view::outline;
use geometry::{Driver, Gear, GearPair, Sense, Side};

/// What the drawing is of.
#[derive(Debug, Clone, Copy)]
pub struct TransverseSection<'a> {
    /// The pair.
    pub pair: &'a GearPair,
    /// Flanks that press.
    pub side: Side,
    /// Gear that drives.
    pub driver: Driver,
    /// Sense of rotation of the pinion, seen against +z.
    pub sense: Sense,
    /// First and last speed of pinion and wheel, 1/min.
    pub speeds_rpm: [[f64; 2]; 2],
    /// Torque on pinion and wheel, N m.
    pub torques_nm: [f64; 2],
}

/// Width and height of the drawing, and of its left part.
const SIZE: [f64; 2] = [820.0, 340.0];
const LEFT: f64 = 320.0;
/// Fills of pinion and wheel.
const FILLS: [&str; 2] = [
    "color-mix(in srgb, var(--link, #0072b2) 22%, var(--paper, #fff))",
    "color-mix(in srgb, var(--ink, #222) 14%, var(--paper, #fff))",
];
/// Straight pieces of the body's edge.
const ARC: usize = 24;
/// Height of the words about a gear, and the room that they take.
const LINE: f64 = 14.0;
const WORDS: f64 = 44.0;
/// Room about both gears, and about the path of contact, over what is shown.
const ROOM: f64 = 1.35;

impl TransverseSection<'_> {
    /// The drawing as a figure of a page. It needs no script, and follows the page's light and dark.
    pub fn figure(&self) -> String {
        let [width, height] = SIZE;
        let mut svg = format!(
            "<figure class=\"chart wide section\"><h3>The mesh in transverse section</h3>\
             <svg viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{}\">",
            "Transverse section of the mesh with path of contact, senses of rotation and torques"
        );
        svg += &self.whole();
        svg += &self.mesh();
        svg + "</svg></figure>"
    }

    /// Middles of both gears on the x axis, mm.
    fn centres(&self) -> [f64; 2] {
        [0.0, self.pair.centre_distance()]
    }

    fn gears(&self) -> [&Gear; 2] {
        [&self.pair.pinion, &self.pair.wheel]
    }

    /// Both gears as circles, with what turns and drives them.
    fn whole(&self) -> String {
        let (centres, gears) = (self.centres(), self.gears());
        let outer = gears.map(|gear| gear.tip_radius().abs().max(gear.root_radius().abs()));
        let low = (0..2).map(|i| centres[i] - outer[i]).fold(f64::INFINITY, f64::min);
        let high = (0..2).map(|i| centres[i] + outer[i]).fold(f64::NEG_INFINITY, f64::max);
        let tall = 2.0 * outer[0].max(outer[1]);
        let [_, height] = SIZE;
        let scale = ((LEFT - 20.0) / (high - low)).min((height - 2.0 * WORDS) / tall);
        let frame = Frame { scale, middle: [0.5 * (low + high), 0.0], at: [0.5 * LEFT, 0.5 * height] };
        let mut svg = String::new();
        // A ring lies behind its pinion.
        for i in if self.pair.is_internal() { [1, 0] } else { [0, 1] } {
            let gear = gears[i];
            let body = format!("fill:{};stroke:var(--ink,#222)", FILLS[i]);
            let (tip, root) = (gear.tip_radius().abs(), gear.root_radius().abs());
            let inner = if gear.is_internal() { "fill:var(--paper,#fff)" } else { "fill:none" };
            svg += &frame.circle(centres[i], tip.max(root), &body, 1.2);
            svg += &frame.circle(centres[i], tip.min(root), &format!("{inner};stroke:var(--faint,#666)"), 0.8);
            svg += &frame.cross(centres[i]);
        }
        for (i, name) in ["pinion", "wheel"].into_iter().enumerate() {
            let radius = 0.62 * self.gears()[i].tip_radius().abs();
            let turns = self.turns(i);
            // Away from the mesh, where a ring and its pinion are apart as well.
            let away = if i == 0 || self.pair.is_internal() { PI } else { 0.0 };
            svg += &frame.arc_arrow(centres[i], radius, away, turns, "var(--link,#0072b2)");
            let torque = turns * if (i == 0) == (self.driver == Driver::Pinion) { 1.0 } else { -1.0 };
            if self.torques_nm[i] != 0.0 {
                svg += &frame.arc_arrow(centres[i], 0.8 * radius, away, torque, "#d55e00");
            }
            let role = if (i == 0) == (self.driver == Driver::Pinion) { "drives" } else { "is driven" };
            let words = [
                format!("{name}, z {}, {role}", self.gears()[i].teeth()),
                format!("{} 1/min, {} N m", self.speed(i), crate::tables::fixed(self.torques_nm[i].abs(), 1)),
            ];
            let [x, y] = frame.place([centres[i], 0.0]);
            // The pinion's words are below it, the wheel's above: side by side they would not fit.
            let below = if i == 0 { 1.0 } else { -1.0 };
            let beyond = if self.pair.is_internal() { outer[1] } else { outer[i] };
            let middle = y + below * (scale * beyond + 0.5 * WORDS);
            for (k, line) in words.iter().enumerate() {
                let y = middle + LINE * (k as f64 - 0.5) + 0.3 * LINE;
                svg += &text([x.clamp(70.0, LEFT - 70.0), y], &shown_units(line), "middle");
            }
        }
        svg
    }

    /// Speed of a gear, or its first and last one, 1/min.
    fn speed(&self, gear: usize) -> String {
        let [from, to] = self.speeds_rpm[gear].map(|rpm| format!("{:.0}", rpm.abs()));
        if from == to { from } else { format!("{from} .. {to}") }
    }

    /// +1 where a gear turns counter-clockwise seen against +z.
    fn turns(&self, gear: usize) -> f64 {
        let pinion = self.sense.sign() as f64;
        if gear == 0 || self.pair.is_internal() { pinion } else { -pinion }
    }

    /// Place on the line of action `xi` (mm) from the tangent point on the pinion's base circle.
    fn on_path(&self, xi: f64) -> [f64; 2] {
        let side = self.side.sign();
        let angle = -side * self.pair.working_pressure_angle();
        let base = self.pair.pinion.base_radius();
        [base * angle.cos() - side * xi * angle.sin(), base * angle.sin() + side * xi * angle.cos()]
    }

    /// Teeth about the pitch point.
    fn mesh(&self) -> String {
        let pair = self.pair;
        let (gears, centres) = (self.gears(), self.centres());
        let [start, end] = pair.path_of_contact();
        let module = gears[0].transverse_module();
        let [width, height] = SIZE;
        let half = (0.5 * ROOM * (end - start)).max(3.0 * module);
        let scale = 0.5 * height / half;
        let pitch = pair.working_radii()[0];
        let frame = Frame { scale, middle: [pitch, 0.0], at: [0.5 * (width + LEFT), 0.5 * height] };
        let mut svg = format!(
            "<svg x=\"{LEFT}\" y=\"0\" width=\"{}\" height=\"{height}\" viewBox=\"{LEFT} 0 {} {height}\">",
            width - LEFT,
            width - LEFT
        );
        let reach = half * (width - LEFT) / height + half;
        let pinion_angle = pair.middle_angle(self.side);
        let angles = [pinion_angle, pair.wheel_angle(self.side, pinion_angle)];
        let heights = pair.common_middle();
        for i in 0..2 {
            let turn = angles[i] + gears[i].twist() * heights[i];
            let teeth = frame.teeth(gears[i], (centres[i], turn), reach);
            let _ = write!(
                svg,
                "<path d=\"{teeth}\" style=\"fill:{};stroke:var(--ink,#222)\" stroke-width=\"1.3\" fill-rule=\"evenodd\"/>",
                FILLS[i]
            );
        }
        for i in 0..2 {
            svg += &frame.circle(centres[i], gears[i].base_radius().abs(), "fill:none;stroke:var(--faint,#666)", 0.8);
            svg += &frame.circle(
                centres[i],
                gears[i].tip_radius().abs(),
                "fill:none;stroke:var(--faint,#666);stroke-dasharray:2 3",
                0.8,
            );
            svg += &frame.circle(
                centres[i],
                pair.working_radii()[i].abs(),
                "fill:none;stroke:var(--faint,#666);stroke-dasharray:8 3 2 3",
                0.8,
            );
        }
        let line = |from: f64, to: f64, style: &str, wide: f64| {
            let ([x1, y1], [x2, y2]) = (frame.place(self.on_path(from)), frame.place(self.on_path(to)));
            format!(
                "<line x1=\"{x1:.2}\" y1=\"{y1:.2}\" x2=\"{x2:.2}\" y2=\"{y2:.2}\" style=\"{style}\" stroke-width=\"{wide}\"/>"
            )
        };
        let far = 2.0 * reach;
        svg += &line(start - far, end + far, "stroke:var(--link,#0072b2)", 0.8);
        svg += &line(start, end, "stroke:#d55e00", 3.0);
        let base_pitch = pair.transverse_base_pitch();
        let pitch_point = gears[0].base_radius() * pair.working_pressure_angle().tan();
        let mut points = vec![("A", start), ("C", pitch_point), ("E", end)];
        if base_pitch < end - start {
            points.extend([("B", end - base_pitch), ("D", start + base_pitch)]);
        }
        for (name, xi) in points {
            let [x, y] = frame.place(self.on_path(xi));
            let _ = write!(svg, "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"3.2\" style=\"fill:#d55e00\"/>");
            svg += &text([x + 11.0, y + 12.0], name, "middle");
        }
        svg + "</svg>"
    }
}

/// From mm to the drawing: y goes up in the one and down in the other.
struct Frame {
    scale: f64,
    /// Place in mm that stands at `at` in the drawing.
    middle: [f64; 2],
    at: [f64; 2],
}

impl Frame {
    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.at[0] + self.scale * (x - self.middle[0]), self.at[1] - self.scale * (y - self.middle[1])]
    }

    fn circle(&self, centre: f64, radius: f64, style: &str, wide: f64) -> String {
        let ([x, y], r) = (self.place([centre, 0.0]), self.scale * radius);
        format!("<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{r:.2}\" style=\"{style}\" stroke-width=\"{wide}\"/>")
    }

    fn cross(&self, centre: f64) -> String {
        let [x, y] = self.place([centre, 0.0]);
        format!(
            "<path d=\"M{:.1} {y:.1}h8M{x:.1} {:.1}v8\" style=\"stroke:var(--ink,#222)\" stroke-width=\"1\"/>",
            x - 4.0,
            y - 4.0
        )
    }

    /// An arc about a centre with its middle in a direction, and a head at the end that it turns to: +1 counter-clockwise.
    fn arc_arrow(&self, centre: f64, radius: f64, middle: f64, turns: f64, colour: &str) -> String {
        let half = 0.9;
        let at = |angle: f64, r: f64| self.place([centre + r * angle.cos(), r * angle.sin()]);
        let (from, to) = (middle - turns * half, middle + turns * half);
        let ([x1, y1], [x2, y2], r) = (at(from, radius), at(to, radius), self.scale * radius);
        let sweep = i32::from(turns < 0.0);
        // The head points along the tangent at the end.
        let size = (9.0 / r.max(1.0)).min(0.5);
        let ([tip_x, tip_y], [a_x, a_y], [b_x, b_y]) =
            (at(to + turns * size, radius), at(to, radius * (1.0 + 0.5 * size)), at(to, radius * (1.0 - 0.5 * size)));
        format!(
            "<path d=\"M{x1:.2} {y1:.2}A{r:.2} {r:.2} 0 0 {sweep} {x2:.2} {y2:.2}\" style=\"fill:none;stroke:{colour}\" stroke-width=\"2.4\"/>\
             <path d=\"M{tip_x:.2} {tip_y:.2}L{a_x:.2} {a_y:.2}L{b_x:.2} {b_y:.2}Z\" style=\"fill:{colour}\"/>"
        )
    }

    /// The outline of the teeth of a gear that stand near the middle of the drawing, closed by its body.
    fn teeth(&self, gear: &Gear, (centre, turn): (f64, f64), reach: f64) -> String {
        let (outline, pitch) = (outline(gear), TAU / f64::from(gear.teeth()));
        let section = if gear.is_internal() { PI } else { 0.0 };
        let radius = gear.tip_radius().abs();
        // Direction of the mesh from the gear's centre.
        let towards = if centre < self.middle[0] { 0.0 } else { PI };
        let wide = if reach >= radius { PI } else { (reach / radius).asin() + 2.0 * pitch };
        let nearest = ((towards - turn) / pitch).round() as i64;
        let count = ((wide / pitch).ceil() as i64).min(i64::from(gear.teeth()) / 2);
        let mut path = String::new();
        let mut points: Vec<[f64; 2]> = Vec::new();
        for k in -count..=count {
            // A ring's outline goes clockwise, seen from its own centre.
            let k = nearest + if gear.is_internal() { -k } else { k };
            let at = |&(r, angle): &(f64, f64)| {
                let angle = section + angle + turn + k as f64 * pitch;
                [centre + r * angle.cos(), r * angle.sin()]
            };
            points.extend(outline.iter().map(at));
        }
        // The body lies towards the centre, of a ring away from it.
        let body = if gear.is_internal() { 1.3 * radius.max(gear.root_radius().abs()) } else { 0.05 * radius };
        let angle = |p: &[f64; 2]| (p[1]).atan2(p[0] - centre);
        if let Some([from, to]) = points.last().zip(points.first()).map(|(last, first)| [angle(last), angle(first)]) {
            let back = (to - from + PI).rem_euclid(TAU) - PI;
            points.extend((0..=ARC).map(|k| {
                let at = from + back * k as f64 / ARC as f64;
                [centre + body * at.cos(), body * at.sin()]
            }));
        }
        for (i, point) in points.into_iter().enumerate() {
            let [x, y] = self.place(point);
            let _ = write!(path, "{}{x:.2} {y:.2}", if i == 0 { 'M' } else { 'L' });
        }
        path.push('Z');
        path
    }
}

fn text([x, y]: [f64; 2], words: &str, anchor: &str) -> String {
    format!(
        "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"12\" text-anchor=\"{anchor}\" style=\"fill:var(--ink,#222)\">{words}</text>"
    )
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use scene::Scene;

    use super::*;

    /// The path of contact goes from the tip circle of the wheel over the pitch point to that of the pinion, on either
    /// flank, of external and internal pairs; every number of the drawing is one.
    #[test]
    fn the_path_of_contact_lies_between_the_tip_circles() {
        for (wheel, shift) in [(41, 0.0), (-52, -0.1)] {
            let text = format!(
                "[pinion]\nteeth = 20\nhelix_angle_deg = 15.0\nprofile_shift = 0.3\n[wheel]\nteeth = {wheel}\n\
                 profile_shift = {shift}\n[pair]\nnormal_module_mm = 3.0\nface_width_mm = 20.0\n\
                 addendum_coefficient = 0.85\n[operation]\ntorque_nm = 100.0\n"
            );
            let scene = Scene::parse(&text, Path::new("pair.toml")).unwrap_or_else(|e| panic!("{e}"));
            let pair = scene.gear_pair().unwrap_or_else(|e| panic!("{e}"));
            let [start, end] = pair.path_of_contact();
            let pitch = pair.pinion.base_radius() * pair.working_pressure_angle().tan();
            for side in [Side::Left, Side::Right] {
                let section = TransverseSection {
                    pair: &pair,
                    side,
                    driver: Driver::Pinion,
                    sense: Sense::Ccw,
                    speeds_rpm: [[1000.0; 2], [500.0; 2]],
                    torques_nm: [50.0, 100.0],
                };
                let from = |gear: usize, xi: f64| {
                    let [x, y] = section.on_path(xi);
                    (x - section.centres()[gear]).hypot(y)
                };
                let pairs = [
                    (from(0, end), pair.pinion.tip_radius()),
                    (from(1, start), pair.wheel.tip_radius().abs()),
                    (from(0, pitch), pair.working_radii()[0]),
                    (section.on_path(pitch)[1], 0.0),
                ];
                for (i, (found, wanted)) in pairs.into_iter().enumerate() {
                    assert!((found - wanted).abs() < 1e-9, "{wheel} teeth, {side:?}, {i}: {found} beside {wanted} mm");
                }
                let drawn = section.figure();
                assert!(!drawn.contains("NaN") && !drawn.contains("inf"), "{drawn}");
                assert!(["A", "B", "C", "D", "E"].iter().all(|name| drawn.contains(&format!(">{name}</text>"))));
            }
        }
    }
}
