//! Position of the largest pressure.

use contact::{Site, SliceResult};
use ltca::StaticHistory;
use serde::{Deserialize, Serialize};

use scene::Scene;

use super::pattern::diameter;

described::described! {
    /// Place of the largest pressure of a run.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct PressurePlace {
        /// `flank`, `end_face` (a slice that ends at an end face), `pinion_tip_edge` or `wheel_tip_edge`
        pub place: Site,
        /// height on the pinion, from its mid-face
        pub z_mm: f64,
        /// diameter on the pinion
        pub pinion_diameter_mm: f64,
        /// angle of the pinion at that position
        pub pinion_angle_deg: f64,
        /// phase of the mesh cycle at that position
        pub mesh_phase: f64,
        /// diameter on the wheel; at rest
        #[serde(skip_serializing_if = "Option::is_none")]
        pub wheel_diameter_mm: Option<f64>,
        /// number of the pinion's tooth; at rest
        #[serde(skip_serializing_if = "Option::is_none")]
        pub pinion_tooth: Option<u32>,
        /// number of the wheel's tooth; at rest
        #[serde(skip_serializing_if = "Option::is_none")]
        pub wheel_tooth: Option<u32>,
    }
}

impl PressurePlace {
    /// Position of the largest pressure of a static history; `None` without loaded slices.
    pub fn of(scene: &Scene, history: &StaticHistory) -> Option<Self> {
        let slices = history
            .positions
            .iter()
            .flat_map(|p| p.pairs.iter().flat_map(move |q| q.slices.iter().map(move |s| (p, q, s))));
        let (p, q, s) = slices.fold(None, |best: Option<(_, _, &SliceResult)>, now| match best {
            Some(b) if !now.2.is_harder(b.2) => Some(b),
            _ => Some(now),
        })?;
        let at = |gear: usize| diameter(base_radius_mm(scene, gear), s.roll[gear]);
        Some(Self {
            place: s.site,
            z_mm: s.z,
            pinion_diameter_mm: at(0),
            pinion_angle_deg: p.pinion_angle.to_degrees(),
            mesh_phase: p.mesh_phase,
            wheel_diameter_mm: Some(at(1)),
            pinion_tooth: Some(q.pinion_tooth),
            wheel_tooth: Some(q.wheel_tooth),
        })
    }

    /// Position of the largest pressure of one row of a motion.
    pub fn of_spot(spot: &PressureSpot, pinion_angle_deg: f64, mesh_phase: f64) -> Self {
        let PressureSpot { site: place, z_mm, pinion_diameter_mm } = *spot;
        let (wheel_diameter_mm, pinion_tooth, wheel_tooth) = (None, None, None);
        Self {
            place,
            z_mm,
            pinion_diameter_mm,
            pinion_angle_deg,
            mesh_phase,
            wheel_diameter_mm,
            pinion_tooth,
            wheel_tooth,
        }
    }

    /// Text for tables and reports.
    pub fn describe(&self) -> String {
        let diameter = self.pinion_diameter_mm;
        format!("{}, z {:.2} mm, d1 {diameter:.2} mm", words(self.place), self.z_mm)
    }
}

/// What a place is called.
fn words(site: Site) -> &'static str {
    match site {
        Site::Flank => "flank",
        Site::EndFace => "end face",
        Site::PinionTipEdge => "pinion's tip edge",
        Site::WheelTipEdge => "wheel's tip edge",
    }
}

/// Position of the slice with the largest pressure of a row.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PressureSpot {
    /// Part of the flank: flank, end face, or a tip edge.
    pub site: Site,
    /// Height on the pinion.
    pub z_mm: f64,
    /// Diameter on the pinion.
    pub pinion_diameter_mm: f64,
}

impl PressureSpot {
    /// Position of the largest pressure of a row's loaded slices; `None` if there are none.
    pub fn of<'a>(base_radius_mm: f64, slices: impl IntoIterator<Item = &'a SliceResult>) -> Option<Self> {
        let s = SliceResult::hardest(slices)?;
        Some(Self { site: s.site, z_mm: s.z, pinion_diameter_mm: diameter(base_radius_mm, s.roll[0]) })
    }

    /// Position with the part of the flank given by its number in files; `None` for an unknown number.
    pub fn of_number(number: usize, z_mm: f64, pinion_diameter_mm: f64) -> Option<Self> {
        let site = *Site::ALL.get(number.checked_sub(1)?)?;
        Some(Self { site, z_mm, pinion_diameter_mm })
    }

    /// Number of the part of the flank in files: 1 flank, 2 end face, 3 and 4 tip edge of pinion and wheel.
    pub fn site_number(&self) -> usize {
        Site::ALL.iter().position(|site| *site == self.site).map_or(0, |i| i + 1)
    }
}

/// Part, height (mm) and diameter on the pinion (mm) of the largest pressure of a row's loaded slices. The part is
/// given by [`PressureSpot::site_number`]; 0 and `NaN` if there are no loaded slices.
pub fn place_values<'a>(base_radius_mm: f64, slices: impl IntoIterator<Item = &'a SliceResult>) -> [f64; 3] {
    let Some(spot) = PressureSpot::of(base_radius_mm, slices) else { return [0.0, f64::NAN, f64::NAN] };
    [spot.site_number() as f64, spot.z_mm, spot.pinion_diameter_mm]
}

/// Base radius of pinion (0) or wheel (1), mm.
pub fn base_radius_mm(scene: &Scene, gear: usize) -> f64 {
    let gear = scene.gears()[gear];
    let cos = gear.helix_angle().cos();
    let transverse = (scene.pair.normal_pressure_angle().tan() / cos).atan();
    0.5 * f64::from(gear.teeth) * scene.pair.normal_module_mm / cos * transverse.cos()
}
