//! The geometry sheet as tables: of a page, and of the terminal.

use std::fmt::Write;

use analysis::{
    facts::{IsoGearRoot, IsoRootStress, RunInfo},
    nominal_pressure::NominalPressure,
};
use geometry::{GearSheet, GeometrySheet, RingSheet};
use serde::Serialize;

/// The table that `ale-gear geometry` prints: the sheet, then what a nominal load does; `speed_rpm` of the pinion,
/// where speeds are to be told. `None` without a sheet.
pub fn geometry_table(name: &str, facts: &RunInfo, torque: &str, speed_rpm: f64) -> Option<String> {
    let blocks = blocks(facts, torque, speed_rpm)?;
    Some(blocks.iter().fold(format!("{name}\n"), |t, block| t + "\n" + &block.text()))
}

/// The tables of the sheet and of a nominal load; none without a sheet.
pub(crate) fn geometry_blocks(facts: &RunInfo, torque: &str, speed_rpm: f64) -> Vec<GeometryBlock> {
    blocks(facts, torque, speed_rpm).unwrap_or_default()
}

fn blocks(facts: &RunInfo, torque: &str, speed_rpm: f64) -> Option<Vec<GeometryBlock>> {
    let mut blocks = sheet_blocks(facts.geometry_sheet.as_ref()?, speed_rpm);
    blocks.extend(facts.nominal_pressure.as_ref().map(|nominal| pressures(nominal, torque)));
    blocks.extend(facts.iso_root_stress.as_ref().map(|iso| roots([&iso.pinion, &iso.wheel])));
    Some(blocks)
}

/// Width of the labels on the terminal, of a number of a gear, and of both together.
const LABEL: usize = 44;
const NUMBER: usize = 14;

/// A table of the sheet.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct GeometryBlock {
    /// Heading of the labels, then of the numbers; empty where they need none.
    pub head: Vec<String>,
    /// Widths of label and numbers on the terminal.
    widths: Vec<usize>,
    /// Label, numbers, unit.
    pub rows: Vec<(String, Vec<String>, &'static str)>,
}

impl GeometryBlock {
    /// Of both gears, or of numbers that are of neither.
    fn new(head: &[&str]) -> Self {
        let head = head.iter().map(|word| (*word).to_owned()).collect();
        Self { head, widths: vec![LABEL, NUMBER, NUMBER], rows: Vec::new() }
    }

    fn row(&mut self, what: impl Into<String>, values: &[Option<f64>], digits: usize, unit: &'static str) {
        let number = |v: &Option<f64>| v.map_or_else(|| "-".to_owned(), |v| format!("{v:.digits$}"));
        self.rows.push((what.into(), values.iter().map(number).collect(), unit));
    }

    /// For the terminal.
    fn text(&self) -> String {
        let line = |label: &str, numbers: &[String], unit: &str| {
            let label = format!("  {label:<width$}", width = self.widths[0]);
            let all = self.widths[1..].iter().sum::<usize>();
            let numbers = numbers.iter().zip(&self.widths[1..]).fold(String::new(), |mut t, (number, width)| {
                // Writing to a String cannot fail.
                let _ = write!(t, "{number:>width$}");
                t
            });
            format!("{label}{numbers:<all$}  {unit}").trim_end().to_owned() + "\n"
        };
        let head = self.head.split_first().map(|(label, numbers)| line(label, numbers, "")).unwrap_or_default();
        self.rows.iter().fold(head, |t, (label, numbers, unit)| t + &line(label, numbers, unit))
    }
}

/// Geometry as JSON, with the names of `summary.json`: the sheet, and beside it what the nominal load does.
pub fn geometry_json(facts: &RunInfo) -> String {
    #[derive(Serialize)]
    struct Sheet<'a> {
        #[serde(flatten)]
        geometry_sheet: &'a Option<GeometrySheet>,
        nominal_pressure: &'a Option<NominalPressure>,
        iso_root_stress: &'a Option<IsoRootStress>,
    }
    let RunInfo { geometry_sheet, nominal_pressure, iso_root_stress, .. } = facts;
    // Numbers and strings: there is nothing that JSON could refuse.
    serde_json::to_string_pretty(&Sheet { geometry_sheet, nominal_pressure, iso_root_stress }).unwrap_or_default()
}

/// Hertz pressure at the points of the path of contact, and the factors of ISO 6336-2.
fn pressures(nominal: &NominalPressure, torque: &str) -> GeometryBlock {
    let mut block = GeometryBlock::new(&[&format!("under {torque}, without load factors")]);
    let mut row = |what: &str, value: f64, digits, unit| block.row(what, &[Some(value)], digits, unit);
    row("normal force", nominal.normal_force_n, 1, "N");
    for p in &nominal.hertz {
        let what = format!("Hertz pressure at {}, on {:.2} mm of contact line", p.name, p.line_length_mm);
        row(&what, p.pressure_mpa, 1, "MPa");
    }
    row("contact stress of ISO 6336-2, sigma_H0", nominal.iso_contact_stress_mpa, 1, "MPa");
    row("  zone factor Z_H", nominal.zone_factor, 4, "");
    row("  elasticity factor Z_E", nominal.elasticity_factor, 2, "MPa^0.5");
    row("  contact ratio factor Z_eps", nominal.contact_ratio_factor, 4, "");
    row("  helix angle factor Z_beta", nominal.helix_angle_factor, 4, "");
    if let Some([pinion, wheel]) = nominal.single_contact_factors {
        row("  single contact factor Z_B", pinion, 4, "");
        row("  single contact factor Z_D", wheel, 4, "");
    }
    block
}

/// Nominal root stress of ISO 6336-3 with its factors.
fn roots(gears: [&IsoGearRoot; 2]) -> GeometryBlock {
    let mut block = GeometryBlock::new(&["ISO 6336-3, nominal", "pinion", "wheel"]);
    let mut row = |what: &str, of: fn(&IsoGearRoot) -> f64, digits, unit| {
        block.row(what, &gears.map(|gear| Some(of(gear))), digits, unit);
    };
    row("root stress sigma_F0", |g| g.nominal_root_stress_mpa, 1, "MPa");
    row("  form factor Y_F", |g| g.form_factor, 4, "");
    row("  stress correction factor Y_S", |g| g.stress_correction_factor, 4, "");
    row("  helix angle factor Y_beta", |g| g.helix_factor, 4, "");
    row("  rim thickness factor Y_B", |g| g.rim_thickness_factor, 4, "");
    block
}

/// An internal pair: magnitudes as on a drawing, room about the tips, tool.
fn ring_block(ring: &RingSheet) -> GeometryBlock {
    let mut block = GeometryBlock::new(&["internal gear, magnitudes"]);
    let mut row = |what: &str, value: Option<f64>, unit| block.row(what, &[value], 4, unit);
    row("centre distance", Some(ring.centre_distance_magnitude_mm), "mm");
    row("reference diameter", Some(ring.reference_diameter_magnitude_mm), "mm");
    row("base diameter", Some(ring.base_diameter_magnitude_mm), "mm");
    row("tip diameter", Some(ring.tip_diameter_magnitude_mm), "mm");
    row("root diameter", Some(ring.root_diameter_magnitude_mm), "mm");
    row("root form diameter", Some(ring.root_form_diameter_magnitude_mm), "mm");
    row("start of active profile", Some(ring.start_of_active_profile_diameter_magnitude_mm), "mm");
    row("room before involute interference", Some(ring.involute_margin_mm), "mm");
    row("room before trochoid interference", ring.trochoid_margin_deg, "deg");
    row("room for radial assembly", Some(ring.trimming_margin_deg), "deg");
    row("shaper, teeth", Some(f64::from(ring.shaper_teeth)), "");
    row("  profile shift coefficient", Some(ring.shaper_profile_shift), "");
    row("  tip diameter", Some(ring.shaper_tip_diameter_mm), "mm");
    row("  rounding of its tip edges", Some(ring.shaper_tip_rounding_mm), "mm");
    row("  centre distance at full depth", Some(ring.shaper_centre_distance_mm), "mm");
    row("  working pressure angle at full depth", Some(ring.shaper_working_pressure_angle_deg), "deg");
    row("  room for radial feed", Some(ring.shaper_trimming_margin_deg), "deg");
    block
}

fn sheet_blocks(sheet: &GeometrySheet, speed_rpm: f64) -> Vec<GeometryBlock> {
    let mut of_pair = GeometryBlock::new(&[]);
    let mut row = |what: &str, values: &[f64], digits, unit| {
        of_pair.row(what, &values.iter().map(|value| Some(*value)).collect::<Vec<_>>(), digits, unit);
    };
    row("normal module", &[sheet.normal_module_mm], 4, "mm");
    row("normal pressure angle", &[sheet.normal_pressure_angle_deg], 4, "deg");
    row("helix angle at the reference cylinder", &[sheet.helix_angle_deg], 4, "deg");
    row("transverse module", &[sheet.transverse_module_mm], 4, "mm");
    row("transverse pressure angle", &[sheet.transverse_pressure_angle_deg], 4, "deg");
    row("base helix angle", &[sheet.base_helix_angle_deg], 4, "deg");
    row("centre distance, of the reference circles", &[sheet.reference_centre_distance_mm], 4, "mm");
    row("centre distance", &[sheet.centre_distance_mm], 4, "mm");
    row("working transverse pressure angle", &[sheet.working_pressure_angle_deg], 4, "deg");
    row("sum of profile shift coefficients", &[sheet.sum_of_profile_shifts], 4, "");
    row("base pitch, transverse", &[sheet.transverse_base_pitch_mm], 4, "mm");
    row("base pitch, normal", &[sheet.normal_base_pitch_mm], 4, "mm");
    row("path of contact", &[sheet.path_of_contact_mm], 4, "mm");
    row("  of approach, of recess", &[sheet.approach_path_mm, sheet.recess_path_mm], 4, "mm");
    row("common face width", &[sheet.common_face_width_mm], 4, "mm");
    row("  the wheel's mid-face over the pinion's", &[sheet.mid_face_offset_mm], 4, "mm");
    row("transverse contact ratio", &[sheet.eps_alpha], 4, "");
    row("overlap ratio", &[sheet.eps_beta], 4, "");
    row("total contact ratio", &[sheet.eps_gamma], 4, "");
    row("backlash, circumferential at the pitch circles", &[sheet.circumferential_backlash_mm], 4, "mm");
    row("backlash, normal", &[sheet.normal_backlash_mm], 4, "mm");
    row("backlash, radial (linear, ISO 21771)", &[sheet.radial_backlash_mm], 4, "mm");
    row("tooth loss factor H_V, even line load", &[sheet.tooth_loss_factor], 4, "");
    let both = [&sheet.pinion, &sheet.wheel];
    let mut of_gears = GeometryBlock::new(&["", "pinion", "wheel"]);
    let mut pair = |what: &str, of: &dyn Fn(&GearSheet) -> Option<f64>, digits, unit| {
        of_gears.row(what, &both.map(of), digits, unit);
    };
    pair("teeth", &|g| Some(g.teeth as f64), 0, "");
    pair("face width b", &|g| Some(g.face_width_mm), 4, "mm");
    pair("profile shift coefficient", &|g| Some(g.profile_shift), 4, "");
    pair("reference diameter d", &|g| Some(g.reference_diameter_mm), 4, "mm");
    pair("base diameter d_b", &|g| Some(g.base_diameter_mm), 4, "mm");
    pair("working pitch diameter d_w", &|g| Some(g.working_pitch_diameter_mm), 4, "mm");
    pair("tip diameter d_a", &|g| Some(g.tip_diameter_mm), 4, "mm");
    pair("root diameter d_f", &|g| Some(g.root_diameter_mm), 4, "mm");
    pair("root form diameter d_Ff", &|g| Some(g.root_form_diameter_mm), 4, "mm");
    pair("start of active profile d_Nf", &|g| Some(g.start_of_active_profile_diameter_mm), 4, "mm");
    pair("lowest point of single contact", &|g| g.single_contact_diameters_mm.map(|d| d[0]), 4, "mm");
    pair("highest point of single contact", &|g| g.single_contact_diameters_mm.map(|d| d[1]), 4, "mm");
    pair("end of active profile d_Na", &|g| Some(g.end_of_active_profile_diameter_mm), 4, "mm");
    pair("roll angle at d_Ff", &|g| Some(g.roll_angle_form_deg), 4, "deg");
    pair("roll angle at d_Nf", &|g| Some(g.roll_angle_start_of_active_profile_deg), 4, "deg");
    pair("roll angle at d_w", &|g| Some(g.roll_angle_pitch_deg), 4, "deg");
    pair("roll angle at d_Na", &|g| Some(g.roll_angle_end_of_active_profile_deg), 4, "deg");
    pair("tooth thickness, normal, at d", &|g| Some(g.normal_tooth_thickness_mm), 4, "mm");
    pair("  less than nominal by", &|g| Some(g.tooth_thickness_allowance_mm), 4, "mm");
    pair("tip thickness, normal", &|g| Some(g.normal_tip_thickness_mm), 4, "mm");
    pair("span over teeth k", &|g| g.span.map(|s| f64::from(s.teeth)), 0, "");
    pair("span W_k", &|g| g.span.map(|s| s.length_mm), 4, "mm");
    pair("  without allowance", &|g| g.span.map(|s| s.nominal_length_mm), 4, "mm");
    pair("  face width that it wants", &|g| g.span.map(|s| s.least_face_width_mm), 2, "mm");
    pair("ball diameter D_M", &|g| g.balls.map(|b| b.ball_diameter_mm), 2, "mm");
    pair("dimension over balls M_dK", &|g| g.balls.map(|b| b.dimension_mm), 4, "mm");
    pair("  without allowance", &|g| g.balls.map(|b| b.nominal_dimension_mm), 4, "mm");
    let mut blocks = vec![of_pair, of_gears];
    blocks.extend(sheet.ring.as_ref().map(ring_block));
    let head = ["point", "xi [mm]", "rho_1 [mm]", "rho_2 [mm]", "zeta pinion", "zeta wheel", "d_1 [mm]", "d_2 [mm]"];
    let mut points = GeometryBlock { widths: vec![6, 10, 12, 12, 14, 14, 14, 14], ..GeometryBlock::new(&head) };
    for p in &sheet.points {
        let values = [
            p.from_start_mm,
            p.pinion_curvature_radius_mm,
            p.wheel_curvature_radius_mm,
            p.pinion_specific_sliding,
            p.wheel_specific_sliding,
            p.pinion_diameter_mm,
            p.wheel_diameter_mm,
        ];
        points.row(p.name, &values.map(Some), 4, "");
    }
    blocks.push(points);
    if speed_rpm > 0.0 {
        let first = format!("at {speed_rpm:.0} 1/min of the pinion [m/s]");
        let head = [first.as_str(), "sliding", "pinion rolls at", "wheel rolls at"];
        let mut speeds = GeometryBlock { widths: vec![36, 10, 18, 18], ..GeometryBlock::new(&head) };
        for p in &sheet.points {
            let all =
                [p.sliding_speed_mm_s_per_rpm, p.pinion_rolling_speed_mm_s_per_rpm, p.wheel_rolling_speed_mm_s_per_rpm];
            speeds.row(p.name, &all.map(|v| Some(1e-3 * v * speed_rpm)), 4, "");
        }
        blocks.push(speeds);
    }
    blocks
}
