//! Checks raw values of a gearbox file and makes a gearbox. All errors are found here, before any work starts.

use toml::Spanned;

use super::accuracy::accuracy;
use super::bearing::bearing;
use super::file::{Gearbox, GearboxGear, GearboxInput, GearboxMesh, GearboxShaft, GearboxTorque, mid_face_offset};
use super::housing::housing;
use super::loads::{apart, loaded};
use super::mesh_cycles::fastest_per_turn;
use super::modes::modes;
use super::motion::{Asked, GearboxMotion, asked};
use super::one_gear::one_shape;
use super::pair_setting::PairSetting;
use super::parts::{all, distinct, few, mesh_name, place, place_of_gear};
use super::planets::written_out;
use super::rating::rating;
use super::schema::{GearboxDrive, MeshModel, RawGear, RawGearbox, RawInput, RawMesh, RawTorque, TORQUE};
use super::seats::{in_bores, seats};
use super::shaft::{length, shaft};
use super::values::{Checked, given, missing, needed_of, needed_word, row};
use super::vibration::vibration;
use crate::{
    Kind, Method, Model, PairScene, SceneError, Setting, Source, Word,
    motion::{begins_unloaded, beside_mean},
    spanned::{Number, Rows},
    study::setting,
};

/// Keys that a mesh sets otherwise at the most; a scene has a third of them.
const SETTINGS: usize = 1000;

pub(super) fn check(s: &Source<'_>, raw: RawGearbox, of_pairs: &[PairSetting]) -> Checked<Gearbox> {
    let (raw, written) = written_out(s, raw)?;
    few(s, "shafts", &raw.shaft)?;
    few(s, "bearings", &raw.bearing)?;
    few(s, "gears", &raw.gear)?;
    few(s, "meshes", &raw.mesh)?;
    few(s, "torques", &raw.torque)?;
    let mut shafts = all(&raw.shaft, |t| shaft(s, t))?;
    let names: Vec<(String, f64)> = shafts.iter().map(|x| (x.name.clone(), length(x))).collect();
    distinct(s, "shafts", &raw.shaft, names.iter().map(|n| n.0.as_str()))?;
    let called: Vec<String> =
        raw.gear.iter().filter_map(|t| Some(t.get_ref().name.as_ref()?.get_ref().clone())).collect();
    let mut bearings = all(&raw.bearing, |t| bearing(s, t, &names, &called))?;
    written.place(s, &raw.planets, &mut shafts, &mut bearings)?;
    seats(s, &raw, (&shafts, &bearings))?;
    let gears = all(&raw.gear, |t| gear(s, t, &names))?;
    distinct(s, "gears", &raw.gear, gears.iter().map(|g| g.name.as_str()))?;
    in_bores(s, &raw, (&bearings, &gears))?;
    let called_meshes: Vec<String> = raw.mesh.iter().map(|table| mesh_name(table.get_ref())).collect();
    let means = |own: &PairSetting, mesh: usize| written.means(&own.mesh, mesh, &called_meshes[mesh]);
    if let Some(none) = of_pairs.iter().find(|own| !(0..called_meshes.len()).any(|mesh| means(own, mesh))) {
        let what = format!("there is no mesh `{}`; there are {}", none.mesh, written.mesh_names());
        return Err(SceneError::Setting { label: format!("--set {}", none.key), what });
    }
    let mut meshes = Vec::new();
    for (i, table) in raw.mesh.iter().enumerate() {
        s.called(&table.get_ref().name)?;
        let own = of_pairs.iter().filter(|own| means(own, i)).map(|own| own.setting.clone());
        meshes.push(mesh(s, table, &gears, own.collect())?);
    }
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
    meshes.iter_mut().zip(&raw.mesh).try_for_each(|(mesh, table)| place_axes(s, table, mesh, (&shafts, &gears)))?;
    one_shape(s, &raw.mesh, (&meshes, &gears))?;
    loaded(s, &raw.mesh, (&meshes, &gears, &shafts), (&input, &torques))?;
    in_mesh(s, &raw.gear, &gears, &meshes)?;
    let planets = written.planets(s, &raw.planets, (&shafts, &gears, &meshes))?;
    let parts = [meshes.len(), bearings.len()];
    let housed = bearings.iter().filter(|b| b.in_shaft.is_none()).count();
    let housing = raw.housing.as_ref().map(|table| housing(s, table, housed)).transpose()?;
    let rating = rating(s, &raw, (&meshes, &bearings))?;
    let vibration = raw.vibration.as_ref().map(|table| vibration(s, table, parts)).transpose()?;
    let moves = raw.motion.as_ref().map(|table| asked(s, table, fastest_per_turn(input.shaft, &meshes, &gears)));
    let moves = moves.transpose()?;
    over_time(s, (&raw, &torques), table.get_ref(), moves.as_ref().map(Asked::motion))?;
    let modes = modes(s, &raw, moves.as_ref().map(Asked::motion))?;
    if vibration.is_some() || moves.is_some() {
        closed_bolts(s, &raw.mesh, &meshes)?;
    }
    without_friction(s, (&raw.mesh, &meshes), vibration.is_some(), moves.as_ref().map(Asked::motion))?;
    let (motion, branch) = match moves {
        None => (None, None),
        Some(Asked::Motion(motion)) => (Some(motion), None),
        Some(Asked::Branch(branch)) => (None, Some(branch)),
    };
    let name = s.title(&raw.name)?;
    let (analysis, output) = (&raw.analysis, &raw.output);
    Ok(Gearbox {
        name,
        file: s.file.to_owned(),
        set: Vec::new(),
        shafts,
        bearings,
        gears,
        meshes,
        input,
        torques,
        planets,
        housing,
        positions_per_cycle: row!(s, ANALYSIS, analysis.positions_per_cycle)?,
        cycles: row!(s, ANALYSIS, analysis.cycles)?,
        shaft_elements: row!(s, ANALYSIS, analysis.shaft_elements)?,
        accuracy: accuracy(s, &raw)?,
        rating,
        vibration,
        modes,
        motion,
        branch,
        parquet: row!(s, OUTPUT, output.parquet)?,
    })
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
    let key = row!(s, GEAR, raw.key_deg)?.to_radians();
    let inertia = [
        given!(s, GEAR, raw.mass_kg)?.map(|x| 1e-3 * x),
        given!(s, GEAR, raw.transverse_inertia_kg_m2)?.map(|x| 1e3 * x),
        given!(s, GEAR, raw.polar_inertia_kg_m2)?.map(|x| 1e3 * x),
    ];
    Ok(GearboxGear { name, shaft, position, seat, key, inertia })
}

/// Checks that no mesh has friction where what is asked for has none: the contact itself has, at rest and in motion, and its maps.
fn without_friction(
    s: &Source<'_>,
    (tables, meshes): (&[Spanned<RawMesh>], &[GearboxMesh]),
    vibrates: bool,
    motion: Option<&GearboxMotion>,
) -> Checked<()> {
    let what = match motion {
        _ if vibrates => "[vibration] has none",
        Some(motion) if motion.mesh == MeshModel::Spring => "springs have none",
        _ => return Ok(()),
    };
    let rough = |(_, mesh): &(&Spanned<RawMesh>, &GearboxMesh)| mesh.scene.contact.friction != 0.0;
    let Some((table, mesh)) = tables.iter().zip(meshes).find(rough) else { return Ok(()) };
    let said = format!("the pair of mesh \"{}\" has friction, and {what}", mesh.name);
    let span = table.get_ref().scene.as_ref().map_or(table.span(), Spanned::span);
    Err(s.conflict(&span, said, "leave `friction` out, or `set` it to 0"))
}

/// Checks that no bolts open: in vibration and in motion they have no forces of their own.
fn closed_bolts(s: &Source<'_>, tables: &[Spanned<RawMesh>], meshes: &[GearboxMesh]) -> Checked<()> {
    let opens = |(_, mesh): &(&Spanned<RawMesh>, &GearboxMesh)| mesh.scene.has_opening_bolts();
    let Some((table, mesh)) = tables.iter().zip(meshes).find(opens) else { return Ok(()) };
    let said = format!("bolts of mesh \"{}\" open, which they do at rest alone", mesh.name);
    let span = table.get_ref().scene.as_ref().map_or(table.span(), Spanned::span);
    Err(s.conflict(&span, said, "leave `opens` out of its scene, or vibration and motion out of this file"))
}

/// `more`: keys of its scene that are set beside the file.
fn mesh(s: &Source<'_>, table: &Spanned<RawMesh>, gears: &[GearboxGear], more: Vec<Setting>) -> Checked<GearboxMesh> {
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
        return Err(missing(s, table, "[[mesh]]", "scene", "the path of the scene of this pair, or its tables"));
    };
    if let Some(own) = raw.set.iter().flatten().nth(SETTINGS) {
        let said = format!("a mesh sets more than {SETTINGS} keys");
        return Err(s.conflict(&own.span(), said, "change the scene of the pair instead"));
    }
    let mut settings = raw.set.iter().flatten().map(|own| setting(s, own)).collect::<Checked<Vec<_>>>()?;
    settings.extend(more);
    let document = s.document(word, "gearbox file")?;
    let scene = document.scene_of_mesh(&settings)?;
    let unfit = |what: &str, advice: &str| {
        Err(s.conflict(&word.span(), format!("{} {what}", document.file().display()), advice))
    };
    if !scene.accuracy.is_none() {
        return unfit(
            "asks for an accuracy",
            "that of a gearbox stands in [accuracy] of its own document: leave it out here",
        );
    }
    if scene.analysis.kind != Kind::Static || scene.analysis.model != Model::Reduced {
        return unfit(
            "is not at rest with the model \"reduced\"",
            "a gearbox takes pairs of `kind = \"static\"`, `model = \"reduced\"`",
        );
    }
    if scene.contact.method != Method::Slice {
        return unfit("has contact by points", "a gearbox takes `method = \"slice\"` in [contact]");
    }
    let own = &scene.output;
    let files = [
        ("contact_lines", own.contact_lines),
        ("flank_orders", own.flank_orders),
        ("parquet", own.parquet),
        ("vtu", own.vtu),
        ("derivatives", !own.derivatives.is_empty()),
    ];
    if let Some((key, _)) = files.into_iter().find(|(_, asked)| *asked) {
        let said = format!("asks for `{key}` in [output], which is the pair's alone");
        return unfit(&said, "leave it out here, and run the scene of the pair by itself for it");
    }
    let name = mesh_name(raw);
    let timing = s.choice_of("timing", &raw.timing)?;
    Ok(GearboxMesh { name, gears: pair, scene, timing })
}

/// Checks that every gear meshes, or has a mass at least: of another one nothing would be read.
fn in_mesh(s: &Source<'_>, tables: &[Spanned<RawGear>], gears: &[GearboxGear], meshes: &[GearboxMesh]) -> Checked<()> {
    let alone = |(i, gear): &(usize, &GearboxGear)| {
        gear.inertia.iter().all(Option::is_none) && !meshes.iter().any(|m| m.gears.contains(i))
    };
    let Some((i, gear)) = gears.iter().enumerate().find(alone) else { return Ok(()) };
    Err(s.conflict(
        &tables[i].span(),
        format!("gear \"{}\" meshes with nothing, and no mass of it is stated: it would do nothing", gear.name),
        "name it as `pinion` or `wheel` of a [[mesh]], give it a `mass_kg` as a flywheel, or leave it out",
    ))
}

/// Digits of a file by which a stated offset may differ from that of the positions, mm, and a stated centre distance from
/// that of the shafts, relative.
const DIGITS: f64 = 1e-6;

/// Gives the scene of a pair the axes and the mid-faces that its shafts have.
///
/// # Errors
/// [`SceneError::Conflict`](crate::SceneError::Conflict): faces that do not overlap there, and a scene that states
/// another offset. A stated centre distance stands, and is held against that of the shafts where the gearbox is built.
fn place_axes(
    s: &Source<'_>,
    table: &Spanned<RawMesh>,
    mesh: &mut GearboxMesh,
    (shafts, gears): (&[GearboxShaft], &[GearboxGear]),
) -> Checked<()> {
    let offset = mid_face_offset(shafts, gears, mesh.gears);
    let placed = offset.unwrap_or(0.0);
    let [pinion, wheel] = mesh.gears.map(|g| gears[g].name.as_str());
    if let Some(stated) = mesh.scene.pair.mid_face_offset_mm
        && (stated - placed).abs() > DIGITS
    {
        let said = format!(
            "the mid-face of \"{wheel}\" lies {placed} mm above that of \"{pinion}\", and the scene's `mid_face_offset_mm` is {stated}"
        );
        return Err(s.conflict(&table.span(), said, "leave it out of the scene, or move a gear (`position_mm`)"));
    }
    let widths = mesh.scene.face_widths_mm();
    let common = PairScene { mid_face_offset_mm: Some(placed), ..mesh.scene.pair }.common_face_mm(widths);
    if common[1] > common[0] {
        let [a, b] = mesh.gears.map(|g| shafts[gears[g].shaft].origin);
        let apart = (b[0] - a[0]).hypot(b[1] - a[1]);
        let own = &mut mesh.scene.pair;
        // Digits of a file are no difference.
        if own.centre_distance_mm.is_none_or(|stated| (stated - apart).abs() < DIGITS * apart) {
            own.centre_distance_mm = Some(apart);
        }
        own.mid_face_offset_mm = offset;
        return Ok(());
    }
    let said = format!(
        "the faces of \"{pinion}\" ({} mm wide) and \"{wheel}\" ({} mm) do not overlap: their mid-faces are {placed} mm apart \
         along z",
        widths[0], widths[1]
    );
    Err(s.conflict(&table.span(), said, "gears in mesh stand beside each other: see `position_mm` and `origin_mm`"))
}

fn input(s: &Source<'_>, table: &Spanned<RawInput>, shafts: &[(String, f64)]) -> Checked<GearboxInput> {
    let raw = table.get_ref();
    let (shaft, position) = place(s, table, "[input]", (&raw.shaft, &raw.position_mm), shafts)?;
    let rotation = s.choice_of("rotation", &raw.rotation)?;
    let over_time = beside_mean(s, [&raw.amplitude_nm, &raw.frequency_hz, &raw.phase_deg], &raw.table_s_nm)?;
    let over_time = Some(over_time).filter(|own| !own.is_none());
    Ok(GearboxInput { shaft, position, rotation, over_time, inertia: 1e3 * row!(s, INPUT, raw.inertia_kg_m2)? })
}

fn torque(s: &Source<'_>, table: &Spanned<RawTorque>, shafts: &[(String, f64)]) -> Checked<GearboxTorque> {
    let raw = table.get_ref();
    let (shaft, position) = place(s, table, "[[torque]]", (&raw.shaft, &raw.position_mm), shafts)?;
    let torque = 1e3 * needed_of(s, (table, "[[torque]]"), &TORQUE, "torque_nm", &raw.torque_nm)?;
    let over_time = beside_mean(s, [&raw.amplitude_nm, &raw.frequency_hz, &raw.phase_deg], &raw.table_s_nm)?;
    let over_time = Some(over_time).filter(|own| !own.is_none());
    Ok(GearboxTorque { shaft, position, torque, over_time, inertia: 1e3 * row!(s, TORQUE, raw.inertia_kg_m2)? })
}

type Span = std::ops::Range<usize>;

/// First of the keys by which a torque changes with time, with its place; `None` where it is constant.
fn varies((amplitude, frequency): (&Number, &Number), table: &Rows) -> Option<(Span, &'static str)> {
    let numbers = [(amplitude, "amplitude_nm"), (frequency, "frequency_hz")];
    let stated = numbers.into_iter().find_map(|(value, key)| value.as_ref().map(|v| (v.span(), key)));
    stated.or_else(|| Some((table.as_ref()?.span(), "table_s_nm")))
}

/// Torques that change with time act in motion, that of the input in one that it drives, and a motion that settles has the
/// periods of its meshes alone.
fn over_time(
    s: &Source<'_>,
    (raw, torques): (&RawGearbox, &[GearboxTorque]),
    input: &RawInput,
    motion: Option<&GearboxMotion>,
) -> Checked<()> {
    let of_input = varies((&input.amplitude_nm, &input.frequency_hz), &input.table_s_nm);
    let of_torque = |own: &Spanned<RawTorque>| {
        let own = own.get_ref();
        varies((&own.amplitude_nm, &own.frequency_hz), &own.table_s_nm)
    };
    let Some((span, key)) = of_input.clone().or_else(|| raw.torque.iter().find_map(of_torque)) else { return Ok(()) };
    let Some(motion) = motion else {
        return Err(s.conflict(&span, format!("`{key}` acts in motion alone"), "add [motion], or leave it out"));
    };
    if of_input.is_some() && motion.drive != GearboxDrive::Torque {
        let said = format!("`{key}` of an input of given speed: its torque is a result");
        return Err(s.conflict(&span, said, "take `drive = \"torque\"` in [motion], or leave it out"));
    }
    if let (Some(own), Some(motion), Some(_)) = (&input.table_s_nm, &raw.motion, motion.input_torque) {
        let at = motion.get_ref().input_torque_nm.as_ref().map_or(own.span(), Spanned::span);
        let said = "`input_torque_nm` is beside a table in [input] that already gives it";
        return Err(s.conflict(&at, said, "keep one of them"));
    }
    let begins = raw.torque.iter().zip(torques).map(|(own, torque)| {
        let (nm, own) = (1e-3 * torque.torque, own.get_ref());
        let law = varies((&own.amplitude_nm, &own.frequency_hz), &own.table_s_nm);
        (torque.over_time.as_ref().map_or(nm, |law| law.at_start(nm)), law)
    });
    let begins: Vec<_> = begins.collect();
    if let (true, Some((span, key))) =
        (begins.iter().all(|(nm, _)| *nm == 0.0), begins.iter().find_map(|(_, law)| law.clone()))
    {
        return Err(begins_unloaded(s, &span, key));
    }
    if motion.settle.is_some() {
        let said = format!("`{key}` in a motion that settles: its period is none of the meshes");
        return Err(s.conflict(&span, said, "take `run = \"span\"`, or leave it out"));
    }
    Ok(())
}
