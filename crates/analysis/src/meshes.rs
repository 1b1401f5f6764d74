//! Meshes of a scene: read from a file or generated, checked, with the parts of the gear found.

use crate::remark;
use answer::Remark;
use geometry::{Gear, GearPair};
use mesh::{
    BoreCoupling, Extent, GroupNames, Mesh, MeshError, MeshReport, MeshedGear, Severity, StructuredError,
    StructuredOptions, SurfaceGroup, generate,
};

use scene::{Coupling, GearScene, MesherScene, Scene};

use crate::{
    AnalysisError, GearCache, NoCache, SoundKey,
    error::{in_scene, mismatch, place_in},
    facts::MeshFacts,
    flank_checks::NamedFlanks,
    refused::{Blame, Refusal},
};

/// What the summary says of where a mesh comes from that the built-in mesher made.
pub(crate) const BUILT_IN: &str = "built-in mesher";

/// The mesh of one gear of a scene.
#[derive(Debug, Clone)]
pub struct SceneMesh {
    /// The mesh with bore and flanks.
    pub gear: MeshedGear,
    /// The corresponding entries of the summary.
    pub facts: MeshFacts,
    /// Remarks for the user.
    pub remarks: Vec<Remark>,
}

/// The meshes of pinion and wheel.
///
/// # Errors
/// The errors of [`gear_mesh`].
pub fn pair_meshes(scene: &Scene, pair: &GearPair) -> Result<[SceneMesh; 2], AnalysisError> {
    known_pair_meshes(scene, pair, &NoCache)
}

/// [`pair_meshes`], with files that the cache knows to be sound not checked for that again.
///
/// # Errors
/// As [`gear_mesh`].
pub(crate) fn known_pair_meshes(
    scene: &Scene,
    pair: &GearPair,
    cache: &dyn GearCache,
) -> Result<[SceneMesh; 2], AnalysisError> {
    let pinion = known_gear_mesh(scene, "pinion", (&scene.pinion, &pair.pinion), cache)?;
    let wheel = known_gear_mesh(scene, "wheel", (&scene.wheel, &pair.wheel), cache)?;
    Ok([pinion, wheel])
}

/// The mesh of one gear: `whose` is `pinion` or `wheel`, `exact` its geometry.
///
/// # Errors
/// [`AnalysisError`] if the file is damaged, has inverted elements, does not name the parts of a gear, or is the mesh
/// of another gear, or if the built-in mesher cannot make the requested mesh.
pub fn gear_mesh(scene: &Scene, whose: &str, gear: &GearScene, exact: &Gear) -> Result<SceneMesh, AnalysisError> {
    known_gear_mesh(scene, whose, (gear, exact), &NoCache)
}

fn known_gear_mesh(
    scene: &Scene,
    whose: &str,
    (gear, exact): (&GearScene, &Gear),
    cache: &dyn GearCache,
) -> Result<SceneMesh, AnalysisError> {
    match &gear.mesh {
        Some(file) => {
            let names = [scene.resolve(file.path()).display().to_string(), file.path().display().to_string()];
            // What the checks go by beside the file.
            let key =
                cache.is_on().then(|| SoundKey::new(&file.blake3(), &format!("{:?} {}", gear.groups, gear.teeth)));
            let known = key.as_ref().is_some_and(|key| cache.is_sound(key));
            let (mesh, sound) = with_checks(scene, whose, (gear, exact), file.values().clone(), names, known)?;
            if let Some(key) = key.filter(|_| sound && !known) {
                cache.keep_sound(&key);
            }
            Ok(mesh)
        }
        None => {
            let mut options = options_of(gear);
            if options.extent == Extent::Whole && sector_is_enough(scene) {
                options.extent = Extent::Periodic;
            }
            let mesh = generated_with(scene, whose, exact, &options)?;
            let failed = |source| made_no_gear(whose, source);
            let (found, _) = MeshedGear::find(mesh, exact, &GroupNames::default()).map_err(failed)?;
            let (gear, facts) = to_compute(scene, gear, found, BUILT_IN.to_owned()).map_err(failed)?;
            Ok(SceneMesh { gear, facts, remarks: Vec::new() })
        }
    }
}

/// A mesh from the caller, checked against its gear; `names` are used for its file in messages and in the summary.
///
/// # Errors
/// The errors of [`gear_mesh`].
pub fn checked_mesh(
    scene: &Scene,
    whose: &str,
    gears: (&GearScene, &Gear),
    mesh: Mesh,
    names: [String; 2],
) -> Result<SceneMesh, AnalysisError> {
    Ok(with_checks(scene, whose, gears, mesh, names, false)?.0)
}

/// A checked mesh, and whether it is sound without a remark; one that is `known` to be is held against its gear alone.
fn with_checks(
    scene: &Scene,
    whose: &str,
    (gear, exact): (&GearScene, &Gear),
    mesh: Mesh,
    [file, source]: [String; 2],
    known: bool,
) -> Result<(SceneMesh, bool), AnalysisError> {
    let complain = |source| of_mesh(&file, source);
    of_this_size(&file, whose, &mesh, exact)?;
    let mut remarks = if known { Vec::new() } else { sound(&file, &mesh, gear)? };
    let is_sound = remarks.is_empty();
    let (found, fit) = MeshedGear::find(mesh, exact, &gear.groups).map_err(complain)?;
    if let Some(fit) = fit {
        let turned = if fit.phase == 0.0 {
            String::new()
        } else {
            format!(", the mesh turned by {:.4} deg", -fit.phase.to_degrees())
        };
        remarks.push(remark::flanks_found(&*file, fit.flanks.len(), 1e3 * fit.largest_deviation(), turned));
    }
    same_bore(scene, &file, whose, &found, exact)?;
    let flanks = NamedFlanks { file: &file, whose, found: &found, exact, names: &gear.groups };
    flanks.lie_on_the_gear()?;
    flanks.are_whole()?;
    remarks.extend(flanks.reach(&scene.gear_pair()?)?);
    let (gear, facts) = to_compute(scene, gear, found, source).map_err(complain)?;
    Ok((SceneMesh { gear, facts, remarks }, is_sound))
}

/// The mesh of one gear by the built-in mesher.
///
/// # Errors
/// [`AnalysisError`] if the gear cannot be meshed with these numbers of elements.
pub fn generated(scene: &Scene, whose: &str, gear: &GearScene, exact: &Gear) -> Result<Mesh, AnalysisError> {
    generated_with(scene, whose, exact, &options_of(gear))
}

/// What the built-in mesher is asked for.
pub(crate) fn options_of(gear: &GearScene) -> StructuredOptions {
    gear.mesher.map_or_else(StructuredOptions::default, |m| options(&m))
}

/// Whether one sector tells all: nobody asks for the mesh of the whole gear.
fn sector_is_enough(scene: &Scene) -> bool {
    scene.analysis.model.has_reduced_gears() && !scene.analysis.is_general() && !scene.output.vtu
}

fn generated_with(
    scene: &Scene,
    whose: &str,
    exact: &Gear,
    options: &StructuredOptions,
) -> Result<Mesh, AnalysisError> {
    let refused = |source: StructuredError| {
        let hint = source.hint();
        let refusal = Refusal { what: source.to_string(), hint, blame: Blame::Input };
        AnalysisError::from(refusal).of_part(format!("[{whose}.mesher]"))
    };
    generate(exact, options).map_err(refused).map_err(in_scene(scene))
}

fn options(m: &MesherScene) -> StructuredOptions {
    StructuredOptions {
        order: m.order,
        elements_profile: m.elements_profile,
        elements_fillet: m.elements_fillet,
        elements_thickness: m.elements_thickness,
        elements_face: m.elements_face,
        elements_rim: m.elements_rim,
        extent: match m.sector_teeth {
            0 => Extent::Whole,
            1 => Extent::Periodic,
            k => Extent::Sector(k),
        },
    }
}

/// What is wrong with a mesh, which a file or a name in memory stands for; errors of reading name it by themselves.
fn of_mesh(file: &str, source: MeshError) -> AnalysisError {
    let is_named = source.to_string().starts_with(file);
    let error = AnalysisError::from(source);
    if is_named { error } else { error.of_part(file) }
}

/// What the built-in mesher made is no gear: its own fault, but for the part of the bore that the scene holds.
fn made_no_gear(whose: &str, source: MeshError) -> AnalysisError {
    let error = match source {
        MeshError::NotHeld { .. } => source.into(),
        _ => AnalysisError::from(Refusal::no_result(source.to_string(), source.hint())),
    };
    error.of_part(format!("built-in mesher, {whose}"))
}

/// Refuses a mesh that is far larger or smaller than the gear: another unit, or another gear.
fn of_this_size(file: &str, whose: &str, mesh: &Mesh, exact: &Gear) -> Result<(), AnalysisError> {
    let reach = mesh.nodes.iter().map(|p| p[0].hypot(p[1])).fold(0.0, f64::max);
    let tip = exact.tip_radius().abs();
    if (0.5..2.0).contains(&(reach / tip)) {
        return Ok(());
    }
    Err(mismatch(
        file,
        format!("the mesh reaches a radius of {reach:.6} mm about the z axis, the {whose}'s tip radius is {tip:.3} mm"),
        match unit_of(reach / tip) {
            Some((unit, factor)) => format!(
                "the mesh is in {unit}: write it again in mm, {factor} times as large (Gmsh: `Mesh.ScalingFactor = {factor};`)"
            ),
            None => "coordinates must be in mm (not m or inch), the gear's axis on z".into(),
        },
    ))
}

/// The unit that a mesh is in by its size over the gear's, within a tenth; and mm in that unit.
fn unit_of(size: f64) -> Option<(&'static str, f64)> {
    const UNITS: [(&str, f64); 4] =
        [("metres", 1000.0), ("inches", 25.4), ("centimetres", 10.0), ("micrometres", 1e-3)];
    UNITS.into_iter().find(|(_, factor)| (0.9..1.1).contains(&(size * factor)))
}

/// Refuses a mesh with errors; hands on its remarks.
fn sound(file: &str, mesh: &Mesh, gear: &GearScene) -> Result<Vec<Remark>, AnalysisError> {
    let report = MeshReport::of_gear(mesh, &gear.groups, Some(gear.teeth));
    if let Some(error) = report.findings.iter().find(|f| f.severity == Severity::Error) {
        let hint = format!("`ale-gear mesh check {file} --teeth {}` lists everything", gear.teeth);
        return Err(mismatch(file, &*error.text, hint));
    }
    let remarks = report.findings.iter().filter(|f| f.severity == Severity::Warning);
    Ok(remarks.map(|f| remark::mesh_finding(file, &*f.text)).collect())
}

/// How far the stated bore may be from the mesh's, relative: digits that a user leaves out.
const BORE_AGREES: f64 = 1e-3;

/// The mesh is held at its own bore: another one in the scene would be an answer for another gear, and another inertia
/// where no mesh is needed.
fn same_bore(scene: &Scene, file: &str, whose: &str, found: &MeshedGear, exact: &Gear) -> Result<(), AnalysisError> {
    let stated = exact.data().bore_diameter.abs();
    let [low, high] = found.mesh().radii(found.bore_nodes()).map(|r| 2.0 * r);
    if (low * (1.0 - BORE_AGREES)..=high * (1.0 + BORE_AGREES)).contains(&stated) {
        return Ok(());
    }
    let own = if high - low < BORE_AGREES * high { format!("{high:.3}") } else { format!("{low:.3} to {high:.3}") };
    let what = format!("the {whose}'s `bore_diameter_mm` is {stated}, but the bore of {file} has {own} mm");
    let hint = "leave `bore_diameter_mm` out: the mesh's own is taken";
    let place = place_in(scene, &[&format!("{whose}.bore_diameter_mm")]);
    Err(AnalysisError::from(Refusal::input(what, hint)).at(place))
}

/// The mesh to compute with, and what the summary says of the gear: a periodic sector stays one where that is enough,
/// else it is repeated to the whole gear.
fn to_compute(
    scene: &Scene,
    gear: &GearScene,
    found: MeshedGear,
    mut source: String,
) -> Result<(MeshedGear, MeshFacts), MeshError> {
    let found = match gear.bore.held_mm {
        Some(part) => found.held_between(part)?,
        None => found,
    };
    let found = found.coupled(match gear.bore.coupling {
        Coupling::Kinematic => BoreCoupling::Kinematic,
        Coupling::Distributing => BoreCoupling::Distributing,
        Coupling::Elastic => BoreCoupling::Elastic(gear.bore.foundation()?),
    });
    let copies = if found.is_periodic_sector() { found.tooth_count() as usize } else { 1 };
    if found.is_periodic_sector() {
        source += &format!(", one sector, repeated {copies} times");
    }
    // What all copies make, joined at the cuts; an axis is in all of them.
    let on_cuts = found.cuts().filter(|_| copies > 1).map(|cuts| cuts.map(SurfaceGroup::nodes)).unwrap_or_default();
    let on_axis = on_cuts[0].iter().filter(|n| on_cuts[1].binary_search(n).is_ok()).count();
    let mesh = found.mesh();
    let facts = MeshFacts {
        source,
        nodes: copies * (mesh.nodes.len() - on_cuts[0].len()) + on_axis,
        elements: copies * mesh.element_count(),
        kinds: mesh.blocks.iter().map(|b| format!("{} {}", b.kind.name(), copies * b.len())).collect(),
    };
    let gear = if sector_is_enough(scene) { found } else { found.whole()? };
    Ok((gear, facts))
}
