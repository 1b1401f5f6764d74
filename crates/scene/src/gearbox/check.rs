//! From the words of a gearbox file to a gearbox. Every complaint is made here, before any work starts.

use std::path::Path;

use toml::Spanned;

use super::file::{
    Gearbox, GearboxBearing, GearboxGear, GearboxInput, GearboxMesh, GearboxSection, GearboxShaft, GearboxTorque,
};
use super::housing::housing;
use super::loads::{apart, loaded};
use super::motion::motion;
use super::raw::{RawBearing, RawGear, RawGearbox, RawInput, RawMesh, RawSection, RawShaft, RawTorque};
use super::values::{Checked, missing, needed_number, needed_word, numbers, square};
use super::vibration::vibration;
use crate::{Kind, Method, Model, Number, Rotation, Scene, SceneError, Source, Word, study::setting};

/// Parts of a kind at the most: the matrices are dense.
const PARTS: usize = 100;
/// Keys that a mesh sets otherwise at the most; a scene has a third of them.
const SETTINGS: usize = 1000;
/// Lengths and positions at the most, mm.
const FAR: f64 = 1e6;

pub(super) fn check(s: &Source<'_>, raw: RawGearbox) -> Checked<Gearbox> {
    few(s, "shafts", &raw.shaft)?;
    few(s, "bearings", &raw.bearing)?;
    few(s, "gears", &raw.gear)?;
    few(s, "meshes", &raw.mesh)?;
    few(s, "torques", &raw.torque)?;
    let shafts = all(&raw.shaft, |t| shaft(s, t))?;
    let names: Vec<(String, f64)> = shafts.iter().map(|x| (x.name.clone(), length(x))).collect();
    distinct(s, "shafts", &raw.shaft, names.iter().map(|n| n.0.as_str()))?;
    let bearings = all(&raw.bearing, |t| bearing(s, t, &names))?;
    let gears = all(&raw.gear, |t| gear(s, t, &names))?;
    distinct(s, "gears", &raw.gear, gears.iter().map(|g| g.name.as_str()))?;
    let meshes = all(&raw.mesh, |t| mesh(s, t, &gears))?;
    distinct(s, "meshes", &raw.mesh, meshes.iter().map(|m| m.name.as_str()))?;
    let nothing = |what: &str, advice: &str| Err(s.conflict(&(0..0), what, advice));
    if meshes.is_empty() {
        return nothing("a gearbox without meshes", "list them, each as [[mesh]] with `scene`, `pinion` and `wheel`");
    }
    let Some(table) = &raw.input else {
        return nothing("a gearbox that nothing drives", "say where it is driven: [input] with `shaft`");
    };
    let input = input(s, table, &names)?;
    let torques = all(&raw.torque, |t| torque(s, t, &names))?;
    apart(s, &raw.mesh, &meshes)?;
    loaded(s, &raw.mesh, (&meshes, &gears), (&input, &torques))?;
    let parts = [meshes.len(), bearings.len()];
    let housing = raw.housing.as_ref().map(|table| housing(s, table, bearings.len())).transpose()?;
    let name = raw.name.unwrap_or_else(|| {
        s.file.file_stem().map_or_else(|| "gearbox".into(), |stem| stem.to_string_lossy().into_owned())
    });
    Ok(Gearbox {
        name,
        file: s.file.to_owned(),
        shafts,
        bearings,
        gears,
        meshes,
        input,
        torques,
        housing,
        positions_per_cycle: s.whole("positions_per_cycle", &raw.analysis.positions_per_cycle, 32, 1, 10_000)?,
        cycles: s.whole("cycles", &raw.analysis.cycles, 1, 1, 10_000)?,
        vibration: raw.vibration.as_ref().map(|table| vibration(s, table, parts)).transpose()?,
        motion: raw.motion.as_ref().map(|table| motion(s, table)).transpose()?,
    })
}

fn all<R, T>(tables: &[Spanned<R>], of: impl Fn(&Spanned<R>) -> Checked<T>) -> Checked<Vec<T>> {
    tables.iter().map(of).collect()
}

fn few<R>(s: &Source<'_>, what: &str, tables: &[Spanned<R>]) -> Checked<()> {
    match tables.get(PARTS) {
        Some(table) => {
            let said = format!("a gearbox of {} {what}", tables.len());
            Err(s.conflict(&table.span(), said, format!("list {PARTS} at the most")))
        }
        None => Ok(()),
    }
}

/// No two of a kind with one name.
fn distinct<'a, R>(
    s: &Source<'_>,
    what: &str,
    tables: &[Spanned<R>],
    names: impl Iterator<Item = &'a str>,
) -> Checked<()> {
    let mut seen: Vec<&str> = Vec::new();
    for (name, table) in names.zip(tables) {
        if seen.contains(&name) {
            let said = format!("there are two {what} with the name \"{name}\"");
            return Err(s.conflict(&table.span(), said, "give each a `name` of its own"));
        }
        seen.push(name);
    }
    Ok(())
}

fn length(shaft: &GearboxShaft) -> f64 {
    shaft.sections.iter().map(|x| x.length).sum()
}

fn shaft(s: &Source<'_>, table: &Spanned<RawShaft>) -> Checked<GearboxShaft> {
    let raw = table.get_ref();
    let name = needed_word(s, table, "[[shaft]]", "name", &raw.name, "a name that bearings and gears call it by")?;
    if raw.section.is_empty() {
        let said = format!("the shaft \"{name}\" has no sections");
        return Err(s.conflict(&table.span(), said, "list them from its z = 0 on, each as [[shaft.section]]"));
    }
    few(s, "sections of a shaft", &raw.section)?;
    Ok(GearboxShaft {
        origin: numbers::<3>(s, "origin_mm", &raw.origin_mm, FAR)?.unwrap_or_default(),
        sections: all(&raw.section, |t| section(s, t))?,
        young_mpa: s.number("young_mpa", &raw.young_mpa, 2.06e5, 1.0, 1e12)?,
        poisson: s.number("poisson", &raw.poisson, 0.3, 0.0, 0.499)?,
        density: 1e-12 * s.number("density_kg_m3", &raw.density_kg_m3, 7850.0, 1.0, 1e5)?,
        held: raw.held.as_ref().is_some_and(|h| *h.get_ref()),
        name,
    })
}

fn section(s: &Source<'_>, table: &Spanned<RawSection>) -> Checked<GearboxSection> {
    let raw = table.get_ref();
    let of = |key, value| needed_number(s, table, "[[shaft.section]]", key, value, 1e-3, FAR);
    let (length, outer) = (of("length_mm", &raw.length_mm)?, of("outer_diameter_mm", &raw.outer_diameter_mm)?);
    let inner = s.number("inner_diameter_mm", &raw.inner_diameter_mm, 0.0, 0.0, FAR)?;
    if inner >= outer {
        let said = format!("a section {outer} mm wide outside and {inner} mm inside");
        return Err(s.conflict(&table.span(), said, "the inner diameter is the smaller one; 0 is solid"));
    }
    Ok(GearboxSection { length, outer, inner })
}

fn bearing(s: &Source<'_>, table: &Spanned<RawBearing>, shafts: &[(String, f64)]) -> Checked<GearboxBearing> {
    let raw = table.get_ref();
    let (shaft, position) = place(s, table, "[[bearing]]", (&raw.shaft, &raw.position_mm), shafts)?;
    let name = match &raw.name {
        Some(word) => word.get_ref().clone(),
        None => format!("bearing at {position} mm of {}", shafts[shaft].0),
    };
    let mut stiffness = [[0.0; 6]; 6];
    match &raw.matrix_n_mm_rad {
        Some(rows) => {
            let apart = raw.stiffness_n_per_mm.is_some() || raw.tilt_stiffness_nm_per_rad.is_some();
            if apart {
                let said = format!("{name} has its stiffness twice");
                return Err(s.conflict(&rows.span(), said, "give the matrix or the single values, not both"));
            }
            let size = rows.get_ref().len();
            if size != 5 && size != 6 {
                let said = format!("{name} has a matrix of {size} rows");
                let advice = "give 6 rows for x, y, z and the turns about them, or 5 without the turn about z";
                return Err(s.conflict(&rows.span(), said, advice));
            }
            for (i, row) in square(s, table, &raw.matrix_n_mm_rad, size)?.iter().enumerate() {
                stiffness[i][..size].copy_from_slice(row);
            }
        }
        None => {
            let Some(shifts) = numbers::<3>(s, "stiffness_n_per_mm", &raw.stiffness_n_per_mm, 1e15)? else {
                return Err(missing(
                    s,
                    table,
                    "[[bearing]]",
                    "stiffness_n_per_mm",
                    "a list for x, y and z, or a matrix",
                ));
            };
            let tilts = numbers::<2>(s, "tilt_stiffness_nm_per_rad", &raw.tilt_stiffness_nm_per_rad, 1e15)?;
            let diagonal = shifts.into_iter().chain(tilts.unwrap_or_default().map(|t| 1e3 * t));
            diagonal.enumerate().for_each(|(i, value)| stiffness[i][i] = value);
        }
    }
    let damping = numbers::<3>(s, "damping_n_s_per_mm", &raw.damping_n_s_per_mm, 1e12)?.unwrap_or_default();
    Ok(GearboxBearing { name, shaft, position, stiffness, damping })
}

fn gear(s: &Source<'_>, table: &Spanned<RawGear>, shafts: &[(String, f64)]) -> Checked<GearboxGear> {
    let raw = table.get_ref();
    let name = needed_word(s, table, "[[gear]]", "name", &raw.name, "a name that meshes call it by")?;
    // A gear that is meshed in one with its part of the shaft need not be on the rest of it: its seat is.
    let place = if raw.seat_mm.is_some() { place_of_gear } else { place };
    let (shaft, position) = place(s, table, "[[gear]]", (&raw.shaft, &raw.position_mm), shafts)?;
    let seat = match &raw.seat_mm {
        None => position,
        Some(_) => s.number("seat_mm", &raw.seat_mm, position, 0.0, shafts[shaft].1)?,
    };
    let key = s.number("key_deg", &raw.key_deg, 0.0, -360.0, 360.0)?.to_radians();
    let stated = |key: &str, value: &Number, unit: f64, least: f64| {
        let read = value.is_some().then(|| s.number(key, value, 0.0, least, 1e12)).transpose();
        read.map(|x| x.map(|x| unit * x))
    };
    let inertia = [
        stated("mass_kg", &raw.mass_kg, 1e-3, 1e-9)?,
        stated("transverse_inertia_kg_m2", &raw.transverse_inertia_kg_m2, 1e3, 1e-15)?,
        stated("polar_inertia_kg_m2", &raw.polar_inertia_kg_m2, 1e3, 1e-15)?,
    ];
    Ok(GearboxGear { name, shaft, position, seat, key, inertia })
}

fn mesh(s: &Source<'_>, table: &Spanned<RawMesh>, gears: &[GearboxGear]) -> Checked<GearboxMesh> {
    let raw = table.get_ref();
    let known: Vec<(&str, usize)> = gears.iter().enumerate().map(|(i, g)| (g.name.as_str(), i)).collect();
    let of = |key: &str, word: &Word| match word {
        Some(word) => s.one_of(key, word, &known),
        None => Err(missing(s, table, "[[mesh]]", key, "the name of a gear")),
    };
    let pair = [of("pinion", &raw.pinion)?, of("wheel", &raw.wheel)?];
    if gears[pair[0]].shaft == gears[pair[1]].shaft {
        let said = format!("\"{}\" and \"{}\" are on one shaft", gears[pair[0]].name, gears[pair[1]].name);
        return Err(s.conflict(&table.span(), said, "gears in mesh are on two shafts"));
    }
    let Some(word) = &raw.scene else {
        return Err(missing(s, table, "[[mesh]]", "scene", "the path of the scene of this pair"));
    };
    let path = s.file.parent().unwrap_or(Path::new("")).join(word.get_ref());
    if let Some(own) = raw.set.iter().flatten().nth(SETTINGS) {
        let said = format!("a mesh sets more than {SETTINGS} keys");
        return Err(s.conflict(&own.span(), said, "change the scene of the pair instead"));
    }
    let settings = raw.set.iter().flatten().map(|own| setting(s, own)).collect::<Checked<Vec<_>>>()?;
    let scene = Scene::read_with(&path, &settings).map_err(|e| match e {
        SceneError::Read { file, source } => {
            let said = format!("{} cannot be read: {source}", file.display());
            s.conflict(&word.span(), said, "paths are relative to the gearbox file")
        }
        other => other,
    })?;
    let unfit = |what: &str, advice: &str| Err(s.conflict(&word.span(), format!("{} {what}", path.display()), advice));
    if scene.analysis.kind != Kind::Static || scene.analysis.model != Model::Reduced {
        return unfit(
            "is not at rest with the model \"reduced\"",
            "a gearbox takes pairs of `kind = \"static\"`, `model = \"reduced\"`",
        );
    }
    if scene.contact.method != Method::Slice {
        return unfit("has contact by points", "a gearbox takes `method = \"slice\"` in [contact]");
    }
    if scene.contact.friction != 0.0 {
        return unfit("has friction", "a gearbox at rest has none: leave `friction` out, or `set` it to 0");
    }
    if !scene.accuracy.is_none() {
        return unfit("asks for an accuracy", "a gearbox has no bounds: leave [accuracy] out");
    }
    let name = match &raw.name {
        Some(own) => own.get_ref().clone(),
        None => format!("{}/{}", gears[pair[0]].name, gears[pair[1]].name),
    };
    Ok(GearboxMesh { name, gears: pair, scene })
}

fn input(s: &Source<'_>, table: &Spanned<RawInput>, shafts: &[(String, f64)]) -> Checked<GearboxInput> {
    let raw = table.get_ref();
    let (shaft, position) = place(s, table, "[input]", (&raw.shaft, &raw.position_mm), shafts)?;
    let rotation = s.choice("rotation", &raw.rotation, &[("ccw", Rotation::Ccw), ("cw", Rotation::Cw)])?;
    Ok(GearboxInput { shaft, position, rotation, inertia: inertia(s, &raw.inertia_kg_m2)? })
}

fn torque(s: &Source<'_>, table: &Spanned<RawTorque>, shafts: &[(String, f64)]) -> Checked<GearboxTorque> {
    let raw = table.get_ref();
    let (shaft, position) = place(s, table, "[[torque]]", (&raw.shaft, &raw.position_mm), shafts)?;
    let torque = 1e3 * needed_number(s, table, "[[torque]]", "torque_nm", &raw.torque_nm, 0.0, 1e12)?;
    Ok(GearboxTorque { shaft, position, torque, inertia: inertia(s, &raw.inertia_kg_m2)? })
}

/// Inertia of a machine at a coupling, t mm^2.
fn inertia(s: &Source<'_>, value: &Number) -> Checked<f64> {
    Ok(1e3 * s.number("inertia_kg_m2", value, 0.0, 0.0, 1e12)?)
}

/// Shaft and place of a part on it.
fn place<R>(
    s: &Source<'_>,
    table: &Spanned<R>,
    name: &str,
    (shaft, position): (&Word, &Number),
    shafts: &[(String, f64)],
) -> Checked<(usize, f64)> {
    let on = shaft_of(s, table, name, shaft, shafts)?;
    Ok((on, needed_number(s, table, name, "position_mm", position, 0.0, shafts[on].1)?))
}

/// The same of a gear whose mid-plane may be beyond an end.
fn place_of_gear<R>(
    s: &Source<'_>,
    table: &Spanned<R>,
    name: &str,
    (shaft, position): (&Word, &Number),
    shafts: &[(String, f64)],
) -> Checked<(usize, f64)> {
    let on = shaft_of(s, table, name, shaft, shafts)?;
    Ok((on, needed_number(s, table, name, "position_mm", position, -1e6, 1e6)?))
}

fn shaft_of<R>(
    s: &Source<'_>,
    table: &Spanned<R>,
    name: &str,
    shaft: &Word,
    shafts: &[(String, f64)],
) -> Checked<usize> {
    let known: Vec<(&str, usize)> = shafts.iter().enumerate().map(|(i, x)| (x.0.as_str(), i)).collect();
    let Some(word) = shaft else { return Err(missing(s, table, name, "shaft", "the name of a shaft")) };
    s.one_of("shaft", word, &known)
}
