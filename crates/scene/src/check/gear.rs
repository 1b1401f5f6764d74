//! Checks of the gears and of the data common to both.

use geometry::{GearData, Shaper};
use mesh::{GroupNames, Mesh};
use toml::Spanned;

use super::Checked;
use super::bore::bore;
use super::pitch_errors::pitch_errors;
use crate::{
    DataFile, GearScene, MesherScene, ModificationScene, PairScene, ShaperScene, inputs,
    schema::{GEAR, MESHER, PAIR, RawGear, RawGroups, RawMesher, RawPair, RawShaper},
    source::Source,
    spanned::{Number, Word},
};

/// Default bore over reference diameter, and over the root diameter of a gear of few teeth, to which the first leaves no
/// rim.
const BORE_RATIO: f64 = 0.55;
const BORE_OF_ROOT: f64 = 0.5;

/// Default rim of an internal gear, root to outside, over the module: from 3.5 on ISO 6336-3 has no rim factor.
const RING_RIM: f64 = 4.0;
/// Rounding over the module with which the teeth of a shaper are chosen that says none: it hardly matters to them.
const LEAST_ROUNDING: f64 = 0.02;

/// What both share; the gears say whether they have widths of their own.
pub(super) fn pair(s: &Source<'_>, raw: &RawPair, [pinion, wheel]: [&RawGear; 2]) -> Checked<PairScene> {
    let own = [optional!(s, GEAR, pinion.face_width_mm)?, optional!(s, GEAR, wheel.face_width_mm)?];
    let face_width_mm = match (own, optional!(s, PAIR, raw.face_width_mm)?) {
        (_, Some(width)) => width,
        ([Some(a), Some(b)], None) => a.min(b),
        // Told by who looks for all that is needed.
        _ => value!(s, PAIR, raw.face_width_mm)?,
    };
    // Each at most 0.01 rad over the narrower face: more than that is no misalignment but another gear drive.
    let [a, b] = own.map(|width| width.unwrap_or(face_width_mm));
    let most = 10.0 * a.min(b);
    let centre_distance_mm = centre_distance(s, &raw.centre_distance_mm, is_ring(wheel))?;
    let mut pair = PairScene { face_width_mm, centre_distance_mm, ..PairScene::read(s, raw, most)? };
    if raw.root_radius_coefficient.is_none() {
        pair.root_radius_coefficient = fitting_root_radius(&pair);
    }
    Ok(pair)
}

/// Whether a gear is an internal one.
fn is_ring(raw: &RawGear) -> bool {
    raw.teeth.as_ref().is_some_and(|teeth| *teeth.get_ref() < 0)
}

/// A length without the sign that it may have of an internal gear.
fn unsigned(value: &Number, ring: bool) -> Number {
    value.as_ref().map(|v| Spanned::new(v.span(), if ring { v.get_ref().abs() } else { *v.get_ref() }))
}

fn centre_distance(s: &Source<'_>, value: &Number, ring: bool) -> Checked<Option<f64>> {
    let value = unsigned(value, ring);
    let (low, high, _) = PAIR.number("centre_distance_mm");
    value.is_some().then(|| s.number("centre_distance_mm", &value, 0.0, low, high)).transpose()
}

/// The tool of an internal gear: what is said of it, and what is usual for the rest.
fn shaper(s: &Source<'_>, raw: &RawGear, gear: GearData) -> Checked<Option<ShaperScene>> {
    if !is_ring(raw) {
        return match &raw.shaper {
            None => Ok(None),
            Some(table) => Err(s.conflict(
                &table.span(),
                "`shaper` makes internal gears, and this gear is an external one",
                "give an internal gear negative teeth, as in teeth = -93, or leave this table out",
            )),
        };
    }
    let none = RawShaper::default();
    let stated = raw.shaper.as_ref().map_or(&none, |table| table.get_ref());
    let read = ShaperScene::read(s, stated, f64::INFINITY)?;
    let profile_shift = read.profile_shift;
    let stated_teeth = optional!(s, SHAPER, stated.teeth)?;
    let rounding = optional!(s, SHAPER, stated.tip_rounding_coefficient)?;
    let usual = GearData { root_radius_coefficient: rounding.unwrap_or(LEAST_ROUNDING), ..gear.clone() };
    let teeth = stated_teeth.or(usual.with_usual_shaper(profile_shift).shaper.map(|s| s.teeth)).unwrap_or_default();
    let made = GearData { shaper: Some(Shaper { teeth, profile_shift }), ..gear };
    // A cutter that has room for none says so where the geometry is made.
    let largest = (1e4 * made.largest_root_radius_coefficient()).floor() / 1e4;
    let fitting = if largest > 0.0 { made.root_radius_coefficient.min(largest) } else { made.root_radius_coefficient };
    Ok(Some(ShaperScene { teeth, tip_rounding_coefficient: rounding.unwrap_or(fitting), ..read }))
}

/// The default radius of the rack's tip, or the largest that the rack has room for, to four decimals, where that is
/// less: 0.3178 at 25 degrees. A rack that has room for none keeps the default, and the geometry says why there is no
/// gear.
fn fitting_root_radius(pair: &PairScene) -> f64 {
    let data = GearData {
        normal_module: pair.normal_module_mm,
        normal_pressure_angle: pair.normal_pressure_angle(),
        dedendum_coefficient: pair.dedendum_coefficient,
        thickness_allowance: 0.0,
        ..GearData::default()
    };
    let largest = (1e4 * data.largest_root_radius_coefficient()).floor() / 1e4;
    if largest > 0.0 { pair.root_radius_coefficient.min(largest) } else { pair.root_radius_coefficient }
}

/// Diameter (mm) of the bore of a mesh: of the group that has its name, or of the innermost cylinder where no group has;
/// `None` where there is none.
fn bore_diameter(mesh: &Mesh, names: &GroupNames) -> Option<f64> {
    let [low, high] = match mesh.surface(&names.bore) {
        Some(bore) => mesh.radii(&bore.nodes()),
        None => mesh.bore_radii()?,
    };
    Some(low + high).filter(|d| d.is_finite() && *d > 0.0)
}

/// Whether a gear states its helix angle or follows the mating one.
pub(super) enum Hand {
    Own,
    Against(f64),
}

pub(super) fn gear(
    s: &Source<'_>,
    raw: &RawGear,
    hand: Hand,
    pair: &PairScene,
    face_elements: impl Fn(f64, u32) -> u32,
) -> Checked<GearScene> {
    let ring = is_ring(raw);
    let (fewest, most, _) = GEAR.whole("teeth");
    // Out of range it is told as it is written, with its sign.
    let counted =
        |z: &i64| z.checked_neg().filter(|n| ring && (i64::from(fewest)..=i64::from(most)).contains(n)).unwrap_or(*z);
    let count = raw.teeth.as_ref().map(|z| Spanned::new(z.span(), counted(z.get_ref())));
    let teeth = s.whole_of(&GEAR, "teeth", &count)?;
    let read = GearScene::read(s, raw, f64::INFINITY)?;
    let width = read.face_width_mm.unwrap_or(pair.face_width_mm);
    let helix_angle_deg = match hand {
        Hand::Own => value!(s, GEAR, raw.helix_angle_deg)?,
        Hand::Against(other) => against(s, raw, other, ring)?,
    };
    let reference = f64::from(teeth) * pair.normal_module_mm / helix_angle_deg.to_radians().cos();
    let widest_arc = 0.25 * pair.normal_module_mm;
    let bore_limit = if ring { f64::INFINITY } else { reference.max(1e-3) };
    let sign = if ring { -1.0 } else { 1.0 };
    let (mesh, mesher) = mesh_source(s, raw, teeth, |order| face_elements(width, order))?;
    let groups = groups(s, &raw.groups)?;
    let root = reference - sign * 2.0 * pair.normal_module_mm * pair.dedendum_coefficient;
    let bore_of_mesh = match &mesh {
        // A mesh in another unit, or of another gear, is told where it is read.
        Some(mesh) if raw.bore_diameter_mm.is_none() => {
            bore_diameter(mesh.values(), &groups).filter(|bore| sign * *bore < sign * root)
        }
        _ => None,
    };
    let pitch_errors_um = pitch_errors(s, raw, teeth)?;
    let shifted_root = root + sign * 2.0 * pair.normal_module_mm * read.profile_shift;
    let usual_bore = BORE_RATIO * reference;
    let default_bore = if ring {
        shifted_root + 2.0 * RING_RIM * pair.normal_module_mm
    } else if usual_bore < shifted_root || shifted_root <= 0.0 {
        usual_bore
    } else {
        BORE_OF_ROOT * shifted_root
    };
    let tip_diameter = unsigned(&raw.tip_diameter_mm, ring);
    let tip_diameter_mm = match tip_diameter {
        None => None,
        Some(_) => Some(s.number("tip_diameter_mm", &tip_diameter, 0.0, reference * 0.5, reference * 2.0)?),
    };
    let thickness_allowance_mm =
        s.number("thickness_allowance_mm", &raw.thickness_allowance_mm, 0.0, 0.0, 0.5 * pair.normal_module_mm)?;
    let cut = GearData {
        teeth,
        normal_module: pair.normal_module_mm,
        normal_pressure_angle: pair.normal_pressure_angle(),
        helix_angle: helix_angle_deg.to_radians(),
        profile_shift: read.profile_shift,
        thickness_allowance: thickness_allowance_mm,
        addendum_coefficient: pair.addendum_coefficient,
        dedendum_coefficient: pair.dedendum_coefficient,
        root_radius_coefficient: pair.root_radius_coefficient,
        tip_diameter: tip_diameter_mm.map(|d| sign * d),
        ..GearData::default()
    };
    Ok(GearScene {
        teeth,
        shaper: shaper(s, raw, cut)?,
        helix_angle_deg,
        bore_diameter_mm: s.number(
            "bore_diameter_mm",
            &unsigned(&raw.bore_diameter_mm, ring),
            bore_of_mesh.unwrap_or(default_bore),
            1e-3,
            bore_limit,
        )?,
        tip_edge_radius_mm: s.number("tip_edge_radius_mm", &raw.tip_edge_radius_mm, 0.0, 0.0, widest_arc)?,
        tip_diameter_mm,
        thickness_allowance_mm,
        pitch_errors_um,
        mesh,
        mesher,
        groups,
        bore: match &raw.bore {
            None => Default::default(),
            Some(table) => bore(s, table)?,
        },
        modification: match &raw.modification {
            None => Default::default(),
            Some(table) => ModificationScene::read(s, table.get_ref(), width)?,
        },
        ..read
    })
}

/// The wheel of an external pair has the other hand, an internal gear the same; stated, it must agree.
fn against(s: &Source<'_>, raw: &RawGear, pinion_deg: f64, ring: bool) -> Checked<f64> {
    // `0.0 - x` and not `-x`: a spur wheel has helix angle 0, not -0.
    let follows = if ring { pinion_deg } else { 0.0 - pinion_deg };
    match &raw.helix_angle_deg {
        Some(own) if (own.get_ref() - follows).abs() > 1e-9 => Err(s.conflict(
            &own.span(),
            format!(
                "the wheel's `helix_angle_deg` is {}, but the pinion's is {pinion_deg}: they do not mesh",
                own.get_ref()
            ),
            "leave it out: the wheel's helix angle follows from the pinion's",
        )),
        _ => Ok(follows),
    }
}

fn mesh_source(
    s: &Source<'_>,
    raw: &RawGear,
    teeth: u32,
    face_elements: impl Fn(u32) -> u32,
) -> Checked<(Option<DataFile<Mesh>>, Option<MesherScene>)> {
    match (&raw.mesh, &raw.mesher) {
        (Some(_), Some(mesher)) => Err(s.conflict(
            &mesher.span(),
            "a gear has both a `mesh` and a `mesher` table",
            "keep `mesh` to read a file, or the `mesher` table to have one made",
        )),
        (Some(mesh), None) => Ok((Some(inputs::named(s, "mesh", mesh)?), None)),
        (None, mesher) => {
            let none = RawMesher::default();
            Ok((None, Some(mesher_options(s, mesher.as_ref().map_or(&none, |m| m.get_ref()), teeth, face_elements)?)))
        }
    }
}

fn mesher_options(
    s: &Source<'_>,
    raw: &RawMesher,
    teeth: u32,
    face_elements: impl Fn(u32) -> u32,
) -> Checked<MesherScene> {
    let read = MesherScene::read(s, raw, f64::INFINITY)?;
    let (least, most, _) = MESHER.whole("elements_face");
    Ok(MesherScene {
        elements_face: s.whole("elements_face", &raw.elements_face, face_elements(read.order), least, most)?,
        sector_teeth: s.whole("sector_teeth", &raw.sector_teeth, 0, 0, teeth - 1)?,
        ..read
    })
}

/// The mesh's own names; those of flanks need a place for the tooth number.
fn groups(s: &Source<'_>, raw: &RawGroups) -> Checked<GroupNames> {
    let ours = GroupNames::default();
    let name = |word: &Word, default: String| word.as_ref().map_or(default, |w| w.get_ref().clone());
    for (key, word) in [("flank_left", &raw.flank_left), ("flank_right", &raw.flank_right)] {
        if let Some(word) = word.as_ref().filter(|w| !w.get_ref().contains("{k}")) {
            return Err(s.conflict(
                &word.span(),
                format!("`{key}` is \"{}\", which has no place for the tooth number", word.get_ref()),
                format!("write {{k}} where the number stands, as in {key} = \"Left_{{k}}\""),
            ));
        }
    }
    Ok(GroupNames {
        bore: name(&raw.bore, ours.bore),
        flank_left: name(&raw.flank_left, ours.flank_left),
        flank_right: name(&raw.flank_right, ours.flank_right),
        cut_0: name(&raw.cut_0, ours.cut_0),
        cut_1: name(&raw.cut_1, ours.cut_1),
    })
}
