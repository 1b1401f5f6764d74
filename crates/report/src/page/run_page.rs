//! The page of a run, whatever its model: pair and load at a glance, its gears in space, what all analyses have.

use std::f64::consts::PI;

use analysis::facts::Facts;
use minijinja::{context, value::Serde};
use scene::{Driver, Scene};
use serde::Serialize;

use super::Rendered;
use crate::{
    Cost, ReportError,
    charts::embedded,
    tables::{geometry_table, model_name, torque},
    view::View,
};

/// What a page shows of a run.
#[derive(Debug)]
pub struct RunPage<'a, H> {
    /// What was asked.
    pub scene: &'a Scene,
    /// What it was made of.
    pub facts: &'a Facts,
    /// What it cost.
    pub cost: &'a Cost,
    /// Numbers that the page's own template names.
    pub headline: &'a H,
    /// Parts of the page, each a figure.
    pub charts: Vec<String>,
    /// The contact pattern, where there is one.
    pub pattern: Option<&'a str>,
    /// The gears in space with their fields; without, they are drawn from geometry alone.
    pub view: Option<&'a View>,
    /// What a user should hear.
    pub warnings: &'a [String],
}

impl<H: Serialize> RunPage<'_, H> {
    /// The page, from a template that knows its headline.
    ///
    /// # Errors
    /// [`ReportError`] if the template cannot be filled; that would be a fault of this program.
    pub fn render(self, name: &str) -> Result<Rendered, ReportError> {
        let Self { scene, facts, cost, headline, charts, pattern, view, warnings } = self;
        let view = match view {
            Some(view) => embedded("view", view),
            None => embedded("view", &View::of_geometry(scene, &scene.gear_pair()?)),
        };
        let rpm = scene.pinion_speed() * 30.0 / PI;
        let context = context! {
            name => &scene.name,
            model => model_name(scene),
            version => env!("CARGO_PKG_VERSION"),
            scene => scene.to_toml(),
            default_scene => scene.is_default_scene(),
            scene_file => scene.file.display().to_string(),
            set => &scene.set,
            vtu => scene.output.vtu,
            glance => glance(scene, facts),
            headline => Serde(headline),
            facts => Serde(facts),
            cost => Serde(cost),
            geometry_table => geometry_table(&scene.name, facts, &torque(scene), rpm),
            charts => charts,
            pattern => pattern,
            view => view,
            warnings => warnings.to_vec(),
        };
        Rendered::new(name, context)
    }
}

/// Pair and load in a few words each.
fn glance(scene: &Scene, facts: &Facts) -> Vec<[String; 2]> {
    let (pinion, wheel, pair) = (&scene.pinion, &scene.wheel, &scene.pair);
    let ratio = f64::from(wheel.teeth) / f64::from(pinion.teeth);
    let (driven, driver) = match scene.operation.driver {
        Driver::Pinion => ("wheel", "pinion"),
        Driver::Wheel => ("pinion", "wheel"),
    };
    let rows = [
        ("teeth, ratio", format!("{} : {}, {ratio:.3}", pinion.teeth, wheel.teeth)),
        ("normal module", format!("{} mm", pair.normal_module_mm)),
        ("helix angle of the pinion", format!("{} deg", pinion.helix_angle_deg)),
        ("face width", widths(scene)),
        ("centre distance", format!("{:.3} mm", facts.geometry.centre_distance_mm)),
        ("contact ratio", format!("{:.3}", facts.geometry.eps_gamma)),
        ("", format!("{} N m", scene.operation.torque_nm)),
        ("", format!("{} 1/min", speeds(scene))),
    ];
    let mut rows = rows.map(|(label, value)| [label.to_owned(), value]);
    rows[6][0] = format!("torque on the {driven}");
    rows[7][0] = format!("speed of the {driver}");
    let mut rows = Vec::from(rows);
    if let Some(slices) = facts.resolution.as_ref().and_then(|r| Some((r.slices?, r.slices_chosen))) {
        let (count, chosen) = slices;
        let whose = if chosen { "chosen" } else { "of the scene" };
        rows.push(["slices over the face".to_owned(), format!("{count} ({whose})")]);
    }
    rows
}

/// One face width, or both and how they stand to each other.
fn widths(scene: &Scene) -> String {
    let [pinion, wheel] = scene.face_widths_mm();
    match scene.pair.mid_face_offset_mm {
        Some(offset) if offset != 0.0 => format!("{pinion} : {wheel} mm, mid-faces {offset} mm apart"),
        _ if pinion != wheel => format!("{pinion} : {wheel} mm"),
        _ => format!("{pinion} mm"),
    }
}

/// The speed of the driver, or the first and the last one.
fn speeds(scene: &Scene) -> String {
    let motion = scene.motion.as_ref();
    let ramp = motion.and_then(|m| m.ramp.as_ref()).map(|r| [r.from_rpm, r.to_rpm]);
    let ends = ramp.or(motion.and_then(|m| m.sweep.as_ref()).map(|s| [s.from_rpm, s.to_rpm]));
    ends.map_or_else(|| scene.operation.speed_rpm.to_string(), |[from, to]| format!("{from} .. {to}"))
}
