//! Whether the pair will hold, on the page and in the closing table.

use analysis::pair_rating::RatingHeadline;
use answer::Table;
use ltca::RootPattern;
use rating::{GearDamage, GearRating, LocalDamage, StandardRating, local_bending_safety, local_pitting_safety};

use super::common::key;
use crate::page::{Cell, Content, Grid, Line, Part};

/// The safeties that people look for first.
pub(super) fn safeties(rating: &RatingHeadline) -> [[String; 2]; 2] {
    [
        key("safety against pitting", rating.least_pitting_safety, 2, ""),
        key("safety against root breakage", rating.least_bending_safety, 2, ""),
    ]
}

/// The part `Will it hold?`, of a mesh with its name: safeties in the closing table, then all factors in the order of the standard.
pub(crate) fn parts(rating: &RatingHeadline, mesh: Option<&str>) -> [Part; 2] {
    let r = &rating.standard;
    let least = |value: f64, of: &str| Line::number("  the smaller one", value, 2, format!("({of})"));
    let both = |of: fn(&GearRating) -> f64| r.gears().map(|g| crate::tables::fixed(of(g), 2)).join(", ");
    let of = mesh.map_or_else(String::new, |name| format!("{name}: "));
    let mut lines = vec![
        Line::text(format!("{of}safety against pitting S_H"), both(|g| g.pitting_safety), "(pinion, wheel)"),
        least(rating.least_pitting_safety, rating.least_pitting_safety_of),
        Line::text("safety against root breakage S_F", both(|g| g.bending_safety), "(pinion, wheel)"),
        least(rating.least_bending_safety, rating.least_bending_safety_of),
    ];
    let pair = |of: [f64; 2]| of.map(|value| crate::tables::fixed(value, 2)).join(", ");
    if let Some(local) = &rating.local {
        let at = format!("(pinion, wheel; {})", local.contact_stress_at.describe());
        lines.push(Line::text("  local, by the solved pressure", pair(local.pitting_safety), at));
        let roots = local
            .bending_safety
            .map(|both| Line::text("  local, by the solved root stress", pair(both), "(pinion, wheel)"));
        lines.extend(roots);
    }
    if let Some(spectrum) = &rating.spectrum {
        let both = |of: fn(&GearDamage) -> f64| [&spectrum.pinion, &spectrum.wheel].map(of);
        let sum = |of: [f64; 2]| of.map(|value| crate::tables::fixed(value, 3)).join(", ");
        let loads = format!("(pinion, wheel; {} loads)", spectrum.loads);
        lines.push(Line::text("Miner's sum of pitting", sum(both(|d| d.pitting_damage)), loads.clone()));
        lines.push(Line::text("Miner's sum of root breakage", sum(both(|d| d.bending_damage)), loads));
        lines.push(Line::text("safety of the spectrum, pitting", pair(both(|d| d.pitting_safety)), "(pinion, wheel)"));
        lines.push(Line::text("safety of the spectrum, breakage", pair(both(|d| d.bending_safety)), "(pinion, wheel)"));
        lines.extend(rating.local_spectrum.iter().flat_map(local_damage));
    }
    lines.extend(oiled(rating));
    let title = mesh.map_or_else(|| "Will it hold?".to_owned(), |name| format!("Will it hold? {name}"));
    let safeties = Part::new(title).closing().lines(lines);
    let note = "Pitting after ISO 6336-2, tooth root breakage after ISO 6336-3, load factors after ISO 6336-1, method B unless stated; K_Hbeta is that of the solved load distribution unless stated. A life ends where the safety is 1; a safety below the one that your application asks for is not enough.";
    let sheet = Part::more().lines(load(r)).with(Content::Grid(sheet(r))).note(note);
    [safeties, sheet]
}

/// Damage of the spectrum by what is solved under each load.
fn local_damage(local: &LocalDamage) -> Vec<Line> {
    let text = |of: [f64; 2], digits: usize| of.map(|value| crate::tables::fixed(value, digits)).join(", ");
    let [pinion, wheel] = local.pitting_damage_at;
    let places = format!(
        "(pinion, wheel; at d1 {:.2} z1 {:.2}, d2 {:.2} z2 {:.2} mm)",
        pinion.diameter_mm, pinion.z_mm, wheel.diameter_mm, wheel.z_mm
    );
    let mut lines = vec![
        Line::text("local Miner's sum of pitting", text(local.pitting_damage, 3), places),
        Line::text("  factor on pressures that makes it 1", text(local.pitting_safety, 2), "(pinion, wheel)"),
    ];
    if let (Some(sum), Some(safety)) = (local.bending_damage, local.bending_safety) {
        let at = local.bending_damage_at.map_or(String::new(), |[pinion, wheel]| {
            format!(
                "; at d1 {:.2} z1 {:.2}, d2 {:.2} z2 {:.2} mm",
                pinion.diameter_mm, pinion.z_mm, wheel.diameter_mm, wheel.z_mm
            )
        });
        let places = format!("(pinion, wheel{at})");
        lines.push(Line::text("local Miner's sum of root breakage", text(sum, 3), places));
        lines.push(Line::text("  factor on root stresses that makes it 1", text(safety, 2), "(pinion, wheel)"));
    }
    lines
}

/// Scuffing, micropitting and losses, as far as they are rated.
fn oiled(rating: &RatingHeadline) -> Vec<Line> {
    let mut lines = Vec::new();
    if let Some(s) = &rating.scuffing {
        let flash = format!("({:.1} C of {:.1} C)", s.flash.contact_temperature_c, s.flash.scuffing_temperature_c);
        lines.push(Line::number("safety against scuffing S_B, flash temperature", s.flash.safety, 2, flash));
        let start = format!("({:.1} C)", s.flash.start_temperature_c);
        lines.push(Line::number("  at the start of approach", s.flash.start_safety, 2, start));
        let integral =
            format!("({:.1} C of {:.1} C)", s.integral.integral_temperature_c, s.integral.scuffing_temperature_c);
        lines.push(Line::number(
            "safety against scuffing S_intS, integral temperature",
            s.integral.safety,
            2,
            integral,
        ));
    }
    if let Some(local) = &rating.local_scuffing {
        let at = format!("({:.1} C, d1 {:.2} mm)", local.contact_temperature_c, local.pinion_diameter_mm);
        lines.push(Line::number("  local S_B, by the solved pressure", local.safety, 2, at));
    }
    if let Some(m) = &rating.standard_micropitting {
        let at = format!("(lambda {:.3} at {}, d1 {:.2} mm)", m.specific_film_thickness, m.point, m.pinion_diameter_mm);
        lines.push(Line::number("safety against micropitting S_lambda, standard", m.safety, 2, at));
    }
    if let Some(m) = &rating.micropitting {
        let at = format!("(lambda {:.3}, d1 {:.2} mm)", m.specific_film_thickness, m.pinion_diameter_mm);
        lines.push(Line::number("safety against micropitting S_lambda, local", m.safety, 2, at));
        let permissible = m.permissible_specific_film_thickness;
        lines.push(Line::number("  permissible specific film thickness", permissible, 3, ""));
        lines.push(Line::number("  bulk temperature", m.bulk_temperature_c, 1, "C"));
    }
    if let Some(loss) = &rating.mesh_loss {
        lines.push(Line::number("loss of the mesh by friction of the oil", loss.mesh_loss_w, 1, "W"));
        lines.push(Line::number("  mean coefficient of friction", loss.mean_friction_coefficient, 4, ""));
        lines.push(Line::number("  efficiency, sliding of the teeth", 100.0 * loss.efficiency, 3, "%"));
    }
    lines
}

/// Patterns of pinion and wheel with the local safety of every place behind their columns, and temperature and film where they are rated.
pub(super) fn with_safeties(mut patterns: Vec<Table>, rating: Option<&RatingHeadline>) -> Vec<Table> {
    let local = rating.and_then(|rating| Some((rating.standard.gears(), rating.local.as_ref()?)));
    let Some((gears, local)) = local else { return patterns };
    let helix = rating.map_or(1.0, |rating| rating.standard.helix_angle_factor);
    for (k, (table, gear)) in patterns.iter_mut().zip(gears).enumerate() {
        let safety = |p: &f64| local_pitting_safety(gear.contact_stress_limit_mpa, *p, helix, local.load_factor);
        let all: Vec<f64> = table.find("max_pressure_mpa").unwrap_or_default().iter().map(safety).collect();
        table.push_numbers(
            "local_pitting_safety",
            "safety against pitting by the largest pressure that came there",
            all,
        );
        if let Some(damage) = rating.and_then(|rating| rating.local_spectrum.as_ref()) {
            let meaning =
                "Miner's sum for pitting over the life, each load with the largest pressure that it puts there";
            table.push_numbers("pitting_damage", meaning, damage.flanks[k].clone());
        }
        add_oiled(table, k, rating);
    }
    patterns
}

/// The loaded fillets of pinion and wheel, a row a point, with local safety and damage where they are rated.
pub(super) fn root_patterns(roots: &[RootPattern; 2], rating: Option<&RatingHeadline>) -> [Table; 2] {
    [0, 1].map(|k| {
        let own = &roots[k];
        let mut table = of_root(["root_pattern_pinion", "root_pattern_wheel"][k], own);
        if let Some((gears, local)) = rating.and_then(|r| Some((r.standard.gears(), r.local.as_ref()?))) {
            let safety = |t: &f64| local_bending_safety(gears[k].root_stress_limit_mpa, *t, local.load_factor);
            let all: Vec<f64> = own.tension.iter().map(safety).collect();
            table.push_numbers("local_bending_safety", "safety against tooth root breakage by that stress", all);
        }
        if let Some(damage) = rating.and_then(|r| r.local_spectrum.as_ref()?.roots.as_ref()) {
            let meaning =
                "Miner's sum for tooth root breakage over the life, each load with the largest stress that it puts there";
            table.push_numbers("bending_damage", meaning, damage[k].clone());
        }
        table
    })
}

/// The points of a fillet under that name.
pub(crate) fn of_root(name: &'static str, own: &RootPattern) -> Table {
    Table::new(name)
        .numbers("diameter_mm", "diameter of the point", own.places.iter().map(|at| 2.0 * at[0]))
        .numbers("z_mm", "height of the point, from the gear's own mid-face", own.places.iter().map(|at| at[1]))
        .numbers("max_principal_mpa", "largest first principal stress that came there, of all teeth; 0 where nothing pulls, and beside the flank where stress is above the peak of its fillet, which contact makes", own.tension.iter().copied())
}

/// Contact temperature and film of every place of a pattern, where they are rated.
fn add_oiled(table: &mut Table, gear: usize, rating: Option<&RatingHeadline>) {
    let column = |name: &str| table.find(name).unwrap_or_default().to_vec();
    // tan of the pressure angle times the base radius: the radius of curvature of an involute.
    let places: Vec<(f64, f64)> = (column("diameter_mm").into_iter())
        .zip(column("roll_angle_deg"))
        .zip(column("max_pressure_mpa"))
        .map(|((diameter, roll), pressure)| {
            let tan = roll.to_radians();
            (0.5 * diameter.abs() * tan.abs() / tan.hypot(1.0), pressure)
        })
        .collect();
    if let Some(field) = rating.and_then(|rating| rating.contact_field.as_ref()) {
        let all: Vec<f64> = places.iter().map(|(radius, p)| field.temperature_c(gear, *radius, *p)).collect();
        table.push_numbers("contact_temperature_c", "contact temperature by the largest pressure that came there", all);
    }
    if let Some(field) = rating.and_then(|rating| rating.film_field.as_ref()) {
        let all: Vec<f64> = places.iter().map(|(radius, p)| field.specific(gear, *radius, *p)).collect();
        let meaning = "oil film over R_a, by the largest pressure that came there";
        table.push_numbers("specific_film_thickness", meaning, all);
    }
}

fn load(r: &StandardRating) -> Vec<Line> {
    let number = |label: &str, value: f64, decimals: usize, unit: &str| Line::number(label, value, decimals, unit);
    vec![
        number("tangential force F_t", r.tangential_force_n, 1, "N"),
        number("line speed v", r.line_speed_m_per_s, 2, "m/s"),
        number("application factor K_A", r.application_factor, 3, ""),
        number("dynamic factor K_V", r.dynamic_factor, 3, ""),
        number("  speed over resonance speed N", r.resonance_ratio, 3, ""),
        number("face load factor K_Hbeta", r.face_load_factor, 3, ""),
        number("  of the root K_Fbeta", r.face_load_factor_bending, 3, ""),
        number("transverse load factor K_Halpha", r.transverse_load_factor, 3, ""),
        number("  of the root K_Falpha", r.transverse_load_factor_bending, 3, ""),
        number("zone factor Z_H", r.zone_factor, 3, ""),
        number("elasticity factor Z_E", r.elasticity_factor, 2, "MPa^0.5"),
        number("contact ratio factor Z_eps", r.contact_ratio_factor, 3, ""),
        number("helix angle factor Z_beta", r.helix_angle_factor, 3, ""),
        number("nominal contact stress sigma_H0", r.nominal_contact_stress_mpa, 1, "MPa"),
    ]
}

/// A row of the sheet: label, unit, decimals, value of a gear.
type Row = (&'static str, &'static str, usize, fn(&GearRating) -> f64);

const SHEET: &[Row] = &[
    ("load cycles N_L", "1e6", 3, |g| 1e-6 * g.load_cycles),
    ("contact stress sigma_H", "MPa", 1, |g| g.contact_stress_mpa),
    ("single contact factor Z_B, Z_D", "", 3, |g| g.single_contact_factor),
    ("life factor Z_NT", "", 3, |g| g.pitting_life_factor),
    ("lubricant factor Z_L", "", 3, |g| g.pitting.lubricant_factor),
    ("velocity factor Z_V", "", 3, |g| g.pitting.velocity_factor),
    ("roughness factor Z_R", "", 3, |g| g.pitting.roughness_factor),
    ("work hardening factor Z_W", "", 3, |g| g.pitting.work_hardening_factor),
    ("bearable contact stress sigma_HG", "MPa", 1, |g| g.contact_stress_limit_mpa),
    ("safety against pitting S_H", "", 3, |g| g.pitting_safety),
    ("life until pitting at S_H = 1", "h", 0, |g| g.pitting_life_h),
    ("form factor Y_F", "", 3, |g| g.form_factor),
    ("stress correction factor Y_S", "", 3, |g| g.stress_correction_factor),
    ("helix angle factor Y_beta", "", 3, |g| g.helix_factor),
    ("rim thickness factor Y_B", "", 3, |g| g.rim_thickness_factor),
    ("deep tooth factor Y_DT", "", 3, |g| g.deep_tooth_factor),
    ("nominal root stress sigma_F0", "MPa", 1, |g| g.nominal_root_stress_mpa),
    ("root stress sigma_F", "MPa", 1, |g| g.root_stress_mpa),
    ("notch sensitivity factor Y_delta rel T", "", 3, |g| g.bending.notch_sensitivity_factor),
    ("surface factor Y_R rel T", "", 3, |g| g.bending.surface_factor),
    ("size factor Y_X", "", 3, |g| g.bending.size_factor),
    ("mean stress factor Y_M", "", 3, |g| g.bending.mean_stress_factor),
    ("life factor Y_NT", "", 3, |g| g.bending_life_factor),
    ("bearable root stress sigma_FG", "MPa", 1, |g| g.root_stress_limit_mpa),
    ("safety against root breakage S_F", "", 3, |g| g.bending_safety),
    ("life until breakage at S_F = 1", "h", 0, |g| g.bending_life_h),
];

fn sheet(r: &StandardRating) -> Grid {
    let material = |g: &GearRating| Cell::text(g.material.clone());
    let first = vec![Cell::text("material"), material(&r.pinion), material(&r.wheel), Cell::text("")];
    let rows = SHEET.iter().map(|(label, unit, decimals, of)| {
        let [pinion, wheel] = r.gears().map(|g| number(of(g), *decimals));
        vec![Cell::text(*label), pinion, wheel, Cell::text(*unit)]
    });
    Grid::new(["", "pinion", "wheel", "unit"]).rows(std::iter::once(first).chain(rows))
}

/// Lives are of any size.
fn number(value: f64, decimals: usize) -> Cell {
    if value.is_finite() && value < 1e9 { Cell::number(value, decimals) } else { Cell::science(value) }
}
