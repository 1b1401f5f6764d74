//! Values of a gearbox file that are possible but unlikely: shafts, bearings, gears and machines in other units.

use std::f64::consts::PI;

use answer::Remark;
use scene::{
    gearbox::{Gearbox, GearboxBearing, GearboxGear, GearboxShaft, RollingSize},
    units::in_another_unit,
};

use super::material::{DENSITIES, SOFT};
use crate::remark;

/// Stiffer than cemented carbide, MPa.
const HARD: f64 = 1e6;
/// Young's modulus of steel, MPa: what sizes are judged by where that of a shaft may be in another unit.
const STEEL: f64 = 2.06e5;
/// Stiffness of a bearing over Young's modulus times the diameter of its shaft: a ring of rolling elements has some 0.02
/// to 0.3, a seat of rubber 1e-3.
const STIFFNESSES: [f64; 2] = [3e-4, 10.0];
/// Difference of the bore of a bearing from the diameter of its shaft, over it, from which on it is told: sections of a model
/// are seldom exact.
const BORE: f64 = 0.1;
/// Mass of a gear over that of a solid one of its pair's face width and tip diameter.
const MASSES: [f64; 2] = [0.02, 20.0];
/// Radius of gyration of a gear over its tip radius: 0.7 is a disc, 1 a rim.
const GYRATIONS: [f64; 2] = [0.05, 3.0];
/// Inertia of a machine over that of all gears on its shaft as solid discs, above: a generator on a small pinion
/// has some million.
const MACHINE: f64 = 1e7;

/// Remarks about unlikely values of a gearbox file, with the unit that may have been intended.
pub fn gearbox_remarks(file: &Gearbox) -> Vec<Remark> {
    let moves = file.vibration.is_some() || file.motion.is_some() || file.branch.is_some();
    let shafts = file.shafts.iter().flat_map(|shaft| {
        let density = moves.then(|| density(shaft)).flatten();
        [young(shaft), density].into_iter().flatten()
    });
    let bearings = file.bearings.iter().flat_map(|bearing| {
        let shaft = &file.shafts[bearing.shaft];
        [stiffness(bearing, shaft), bore(bearing, shaft)].into_iter().flatten()
    });
    let gears = file.gears.iter().enumerate().filter(|_| moves).flat_map(|(i, gear)| {
        let disc = disc(file, i);
        disc.into_iter().flat_map(|disc| inertias(gear, disc))
    });
    let machines = moves.then(|| machines(file)).into_iter().flatten();
    shafts.chain(bearings).chain(gears).chain(machines).collect()
}

/// What `value` is in another unit; nothing where no unit fits.
fn meant(key: &str, value: f64, fits: impl Fn(f64) -> bool) -> String {
    in_another_unit(key, value, fits).map(|other| other.said).unwrap_or_default()
}

/// Density below which a shaft has no mass on purpose, kg/m^3, where no slip of units explains it.
const NO_MASS: f64 = 1e-2;

fn young(shaft: &GearboxShaft) -> Option<Remark> {
    let young = shaft.young_mpa;
    let usual = |x: f64| (SOFT..=HARD).contains(&x);
    (!usual(young)).then(|| {
        let than = if young < SOFT { "softer than plastics" } else { "stiffer than any metal" };
        let other = meant("young_mpa", young, usual);
        remark::unlikely_shaft_modulus(shaft.name.as_str(), young, than, other)
    })
}

fn density(shaft: &GearboxShaft) -> Option<Remark> {
    let density = 1e12 * shaft.density;
    let usual = |x: f64| (DENSITIES[0]..=DENSITIES[1]).contains(&x);
    let other = meant("density_kg_m3", density, usual);
    // A held shaft, or one without mass on purpose, leaves all inertia to its gears.
    let is_meant = shaft.held || (density <= NO_MASS && other.is_empty());
    (!usual(density) && !is_meant).then(|| remark::unlikely_shaft_density(shaft.name.as_str(), density, other))
}

/// Outer diameter of a shaft at a place, mm.
fn diameter(shaft: &GearboxShaft, at: f64) -> Option<f64> {
    let ends = shaft.sections.iter().scan(0.0, |end, section| {
        *end += section.length;
        Some((*end, section.outer))
    });
    ends.clone().find(|(end, _)| at <= *end).or_else(|| ends.last()).map(|(_, outer)| outer)
}

/// The stiffness across the axis, over that of solid steel of the shaft's size.
fn stiffness(bearing: &GearboxBearing, shaft: &GearboxShaft) -> Option<Remark> {
    let across = (bearing.stiffness[0][0] * bearing.stiffness[1][1]).abs().sqrt();
    let solid = STEEL * diameter(shaft, bearing.position)?;
    let usual = |x: f64| (STIFFNESSES[0]..=STIFFNESSES[1]).contains(&(x / solid));
    (across > 0.0 && bearing.rolling.is_none() && !shaft.held && !usual(across)).then(|| {
        let than = if across < STIFFNESSES[0] * solid { "softer than a seat of rubber" } else { "as good as rigid" };
        let other = meant("stiffness_n_per_mm", across, usual);
        let (across, diameter) = (across, solid / STEEL);
        remark::unlikely_bearing_stiffness(bearing.name.as_str(), across, than, diameter, other)
    })
}

/// The bore of a rolling bearing beside the diameter of its shaft.
fn bore(bearing: &GearboxBearing, shaft: &GearboxShaft) -> Option<Remark> {
    let own = match bearing.rolling.as_ref()?.size {
        RollingSize::Catalogue { bore, .. } | RollingSize::Dimensions { bore, .. } => bore,
        RollingSize::Elements { .. } => return None,
    };
    let diameter = diameter(shaft, bearing.position)?;
    let differs = (own / diameter - 1.0).abs() > BORE;
    differs.then(|| remark::bore_beside_shaft(bearing.name.as_str(), own, shaft.name.as_str(), diameter))
}

/// A gear as a solid disc: mass, kg, and tip radius, m.
#[derive(Clone, Copy)]
struct Disc {
    mass: f64,
    radius: f64,
}

/// Disc of a gear in the first pair that it is in: its tips are about a module beyond its reference circle.
fn disc(file: &Gearbox, gear: usize) -> Option<Disc> {
    let (mesh, end) = file.meshes.iter().find_map(|m| Some((m, m.gears.iter().position(|&g| g == gear)?)))?;
    let (pair, own) = (&mesh.scene.pair, mesh.scene.gears()[end]);
    let cosine = mesh.scene.pinion.helix_angle_deg.to_radians().cos();
    let radius = 1e-3 * pair.normal_module_mm * (0.5 * f64::from(own.teeth) / cosine + 1.0);
    let width = 1e-3 * mesh.scene.face_widths_mm()[end];
    Some(Disc { mass: own.material.density_kg_m3 * PI * radius * radius * width, radius })
}

fn inertias(gear: &GearboxGear, disc: Disc) -> Vec<Remark> {
    let [mass, transverse, polar] = gear.inertia;
    let (mass, transverse, polar) = (mass.map(|t| 1e3 * t), transverse.map(|x| 1e-3 * x), polar.map(|x| 1e-3 * x));
    let mut all = Vec::new();
    let usual = |x: f64| (MASSES[0]..=MASSES[1]).contains(&(x / disc.mass));
    if let Some(own) = mass.filter(|&own| !usual(own)) {
        let other = meant("mass_kg", own, usual);
        all.push(remark::unlikely_gear_mass(gear.name.as_str(), own, disc.mass, other));
    }
    let weight = mass.filter(|&own| usual(own)).unwrap_or(disc.mass);
    for (key, own) in [("polar_inertia_kg_m2", polar), ("transverse_inertia_kg_m2", transverse)] {
        let usual = |x: f64| (GYRATIONS[0]..=GYRATIONS[1]).contains(&((x / weight).sqrt() / disc.radius));
        if let Some(own) = own.filter(|&own| !usual(own)) {
            let solid = 0.5 * weight * disc.radius * disc.radius;
            let other = meant(key, own, usual);
            all.push(remark::unlikely_gear_inertia(gear.name.as_str(), key, own, solid, other));
        }
    }
    all
}

/// Machines whose inertia is far from that of the gears on their shaft.
fn machines(file: &Gearbox) -> Vec<Remark> {
    let of_shaft = |shaft: usize| {
        let gears = (0..file.gears.len()).filter(|&g| file.gears[g].shaft == shaft);
        gears.filter_map(|g| disc(file, g)).map(|d| 0.5 * d.mass * d.radius * d.radius).sum::<f64>()
    };
    let input = ("[input]".to_owned(), file.input.shaft, file.input.inertia);
    let torques = file.torques.iter().enumerate();
    let torques = torques.map(|(i, t)| (format!("[[torque]] {}", i + 1), t.shaft, t.inertia));
    let unlikely = |(place, shaft, inertia): (String, usize, f64)| {
        let (own, gears) = (1e-3 * inertia, of_shaft(shaft));
        (gears > 0.0 && own > MACHINE * gears).then(|| {
            let other = meant("inertia_kg_m2", own, |x| x < 1e3 * gears);
            remark::unlikely_machine_inertia(place, own, own / gears, other)
        })
    };
    std::iter::once(input).chain(torques).filter_map(unlikely).collect()
}

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};

    use super::*;

    fn file(name: &str) -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/gearbox").join(name)
    }

    /// What is said of the two stages with one line otherwise.
    fn said(old: &str, new: &str) -> Vec<Remark> {
        said_of("two_stages.toml", old, new)
    }

    fn said_of(name: &str, old: &str, new: &str) -> Vec<Remark> {
        let file = file(name);
        let text = std::fs::read_to_string(&file).unwrap();
        assert!(text.contains(old), "{old}");
        gearbox_remarks(&Gearbox::parse(&text.replacen(old, new, 1), &file).unwrap())
    }

    /// A bearing that does not fit its shaft is told, with both diameters; a tenth of a difference is not.
    #[test]
    fn a_bore_that_is_not_the_shaft_is_told() {
        let told = |bore: &str| said_of("rolling_bearings.toml", "bore_mm = 25.0", bore);
        assert_eq!(told("bore_mm = 26.5"), Vec::<Remark>::new());
        let told = told("bore_mm = 30.0");
        assert!(told.len() == 1 && told[0].code() == "bore_beside_shaft", "{told:?}");
        let words = told[0].to_string();
        assert!(words.contains("30 mm") && words.contains("25 mm"), "{words}");
    }

    /// A shaft without mass on purpose is none in another unit.
    #[test]
    fn a_shaft_without_mass_is_meant() {
        let [meant, slip, light] = ["1e-3", "7.85e-9", "50.0"]
            .map(|density| said("density_kg_m3 = 7800.0", &format!("density_kg_m3 = {density}")));
        assert_eq!(meant, Vec::<Remark>::new());
        assert_eq!([slip.len(), light.len()], [1, 1], "{slip:?}, {light:?}");
    }

    /// A number in another unit is told with the unit that was meant; shipped gearboxes have none.
    #[test]
    fn another_unit_is_told() {
        for (old, new, words) in [
            ("young_mpa = 2.1e5", "young_mpa = 2.1e11", "2.1e11 Pa are 210000 MPa"),
            ("young_mpa = 2.1e5", "young_mpa = 210.0", "210 GPa are 210000 MPa"),
            ("density_kg_m3 = 7800.0", "density_kg_m3 = 7.8", "7.8 g/cm^3 are 7800 kg/m^3"),
            ("[2.0e5, 2.0e5, 8.0e4]", "[2.0e8, 2.0e8, 8.0e7]", "2e8 N/m are 200000 N/mm"),
            ("[2.0e5, 2.0e5, 8.0e4]", "[200.0, 200.0, 80.0]", "200 N/um are 200000 N/mm"),
            ("mass_kg = 3.2", "mass_kg = 3200.0", "3200 g are 3.2 kg"),
            ("polar_inertia_kg_m2 = 0.0115", "polar_inertia_kg_m2 = 11500.0", "11500 kg mm^2 are 0.0115 kg m^2"),
            ("inertia_kg_m2 = 0.02\n", "inertia_kg_m2 = 20000.0\n", "20000 kg mm^2 are 0.02 kg m^2"),
            ("inertia_kg_m2 = 0.5\n", "inertia_kg_m2 = 500000.0\n", "500000 kg mm^2 are 0.5 kg m^2"),
        ] {
            let said = said(old, new);
            assert!(said.len() == 1 && said[0].hint().as_deref() == Some(words), "{new}: {said:#?}");
        }
        for name in [
            "two_stages",
            "in_housing",
            "rolling_bearings",
            "run_up",
            "overhung_pinion",
            "nrel_5mw_second_stage",
            "nrel_5mw_third_stage",
        ] {
            let file = Gearbox::read(&file(&format!("{name}.toml"))).unwrap();
            assert_eq!(gearbox_remarks(&file), Vec::<Remark>::new(), "{name}");
        }
    }
}
