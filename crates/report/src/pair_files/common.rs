//! Parts that the pages of all runs of a pair have.

use std::f64::consts::PI;

use analysis::{
    facts::RunInfo,
    motion::{ElasticHeadline, InertiaHeadline},
    results::PressurePlace,
};
use answer::{Answer, Cost, Remark, Table, keyed, shown_units};
use minijinja::context;
use scene::{Driver, Scene};
use serde::Serialize;

use crate::{
    ReportError,
    charts::{TransverseSection, embedded},
    how_exact::how_exact,
    page::{Cell, Content, Grid, Line, Page, Part, again, cost_part, render},
    tables::{GeometryBlock, fixed, geometry_blocks, given, model_name, torque},
};
use export::view::View;

/// The answer of a run of a pair, without its rows.
pub(super) fn pair_answer<H: Serialize>(
    scene: &Scene,
    (facts, cost): (&RunInfo, &Cost),
    headline: &H,
    remarks: &[Remark],
    tables: Vec<Table>,
) -> Answer {
    let mut info = keyed(facts);
    // An answer has its checks apart.
    info.retain(|key, _| !key.starts_with("certificate"));
    Answer {
        kind: "pair",
        name: scene.name.clone(),
        inputs: keyed(scene).into(),
        tables,
        headline: keyed(headline).into(),
        checks: facts.certificate.clone(),
        remarks: remarks.to_vec(),
        info,
        cost: cost.clone(),
    }
}

/// What a page of a pair shows beside what all have.
#[derive(Debug, Default)]
pub(super) struct Shown<'a> {
    /// Text after the model, in the line below the title.
    pub subtitle: String,
    /// Numbers that people look for first.
    pub key: Vec<[String; 2]>,
    /// Heading of the charts.
    pub over: String,
    /// Charts.
    pub charts: Vec<String>,
    /// Parts after the charts.
    pub after: Vec<Part>,
    /// Headline numbers.
    pub headline: Vec<Line>,
    /// Numbers that tell how well it was solved.
    pub solved: Vec<Line>,
    /// The gears in space with their fields; without, they are drawn from geometry alone.
    pub view: Option<&'a View>,
    /// The command that makes it again; without, `ale-gear run`.
    pub again: Option<String>,
}

/// The page of a run of a pair.
///
/// # Errors
/// [`ReportError`] if a part cannot be filled; that would be a fault of this program.
pub(super) fn pair_page(
    scene: &Scene,
    facts: &RunInfo,
    answer: &Answer,
    shown: Shown<'_>,
) -> Result<Page, ReportError> {
    let mut page = Page::of(answer, format!("model {}{}", model_name(scene), shown.subtitle));
    page.glance =
        glance(scene, facts).into_iter().chain(shown.key).map(|item| item.map(|text| shown_units(&text))).collect();
    let view = match shown.view {
        Some(view) => embedded("view", view),
        None => embedded("view", &View::of_geometry(scene, &scene.gear_pair()?)),
    };
    page.push(Part::more().with(Content::Html(render("view.html", context! { view => view })?)));
    page.push(transverse_section(scene)?);
    page.push(Part::new(shown.over).figures(shown.charts));
    shown.after.into_iter().for_each(|part| page.push(part));
    let first = Line::number("contact ratio eps_gamma", facts.geometry.eps_gamma, 4, "");
    page.push(
        Part::new("Headline numbers")
            .closing()
            .lines(std::iter::once(first).chain(shown.headline))
            .lines(resolution(scene, facts)),
    );
    facts.accuracy.iter().flat_map(how_exact).for_each(|part| page.push(part));
    let solved = Content::Lines(shown.solved);
    page.push(Page::trust(answer).with(solved).note(
        "These checks are about the equations as they were set up. What a mesh, linear elasticity or a reduced-order model \
         leave out is not in them: `ale-gear chart` shows the error of models and meshes for a pair, docs/validation.md \
         what was compared with published results.",
    ));
    let rpm = scene.pinion_speed() * 30.0 / PI;
    let sheet = geometry_blocks(facts, &torque(scene), rpm);
    let few = if sheet.is_empty() { geometry(facts) } else { Vec::new() };
    page.push(sheet.into_iter().map(grid).fold(Part::new("Geometry").lines(few), Part::grid));
    page.push(Part::new("Size").closing().lines(size(facts)));
    page.push(cost_part(&answer.cost));
    page.push(again(&shown.again.unwrap_or_else(|| command(scene))));
    let words = "The scene with every default written out; paths in it are relative to the scene file.";
    page.push(Part::more().words(words).with(Content::Plain(scene.to_toml())));
    Ok(page)
}

/// A table of the geometry sheet.
fn grid(block: GeometryBlock) -> Grid {
    let numbers = block.rows.iter().map(|(_, numbers, _)| numbers.len()).max().unwrap_or(0);
    let has_units = block.rows.iter().any(|(_, _, unit)| !unit.is_empty());
    let mut head = block.head;
    head.resize(1 + numbers + usize::from(has_units), String::new());
    let rows = block.rows.into_iter().map(|(label, own, unit)| {
        let empty = std::iter::repeat_n(String::new(), numbers - own.len());
        let mut row = vec![Cell::text(label)];
        row.extend(own.into_iter().chain(empty).map(Cell::count));
        row.extend(has_units.then(|| Cell::text(unit)));
        row
    });
    Grid::new(head).rows(rows)
}

/// The mesh in transverse section with senses of rotation and torques.
fn transverse_section(scene: &Scene) -> Result<Part, ReportError> {
    let pair = scene.gear_pair()?;
    let operation = &scene.operation;
    let ratio = f64::from(scene.wheel.teeth).abs() / f64::from(scene.pinion.teeth);
    let pinion_rpm = scene.pinion_speed() * 30.0 / PI;
    let own = operation.speed_rpm;
    let of_driver = speed_ends(scene).unwrap_or([own, own]);
    let speeds_rpm = [pinion_rpm, pinion_rpm / ratio].map(|rpm| of_driver.map(|end| rpm * end / own));
    let torques_nm = match operation.driver {
        Driver::Pinion => [operation.torque_nm / ratio, operation.torque_nm],
        Driver::Wheel => [operation.torque_nm, operation.torque_nm * ratio],
    };
    let section = TransverseSection {
        pair: &pair,
        side: scene.side(),
        driver: operation.driver,
        sense: operation.rotation,
        speeds_rpm,
        torques_nm,
    };
    Ok(Part::more().with(Content::Html(section.figure())).note(
        "The middle of the common face, seen against +z, tooth 0 in the middle of its path. Blue arrows: rotation; orange \
         arrows: torques on the shafts. Orange line: path of contact from A to E on the line of action, C at the pitch \
         point, one pair of teeth touches from B to D. Base circles are solid, tip circles dotted, pitch circles \
         dash-dotted.",
    ))
}

/// The command that runs a scene.
fn command(scene: &Scene) -> String {
    let run = if scene.is_default_scene() {
        "ale-gear".to_owned()
    } else {
        format!("ale-gear run {} --out DIR", scene.file.display())
    };
    let vtu = scene.output.vtu.then(|| "--vtu".to_owned());
    std::iter::once(run).chain(scene.set.iter().cloned()).chain(vtu).collect::<Vec<_>>().join(" ")
}

/// Pair and load in a few words each.
fn glance(scene: &Scene, facts: &RunInfo) -> Vec<[String; 2]> {
    let (pinion, wheel, pair) = (&scene.pinion, &scene.wheel, &scene.pair);
    let ratio = f64::from(wheel.teeth) / f64::from(pinion.teeth);
    let (driven, driver) = match scene.operation.driver {
        Driver::Pinion => ("wheel", "pinion"),
        Driver::Wheel => ("pinion", "wheel"),
    };
    let mut rows = vec![
        ["teeth, ratio".into(), format!("{} : {}, {ratio:.3}", pinion.teeth, wheel.teeth)],
        ["normal module".into(), format!("{} mm", pair.normal_module_mm)],
        ["helix angle of the pinion".into(), format!("{} deg", pinion.helix_angle_deg)],
        ["face width".into(), widths(scene)],
        ["centre distance".into(), format!("{:.3} mm", facts.geometry.centre_distance_mm)],
        ["contact ratio".into(), format!("{:.3}", facts.geometry.eps_gamma)],
        [format!("torque on the {driven}"), format!("{} N m", given(scene.operation.torque_nm))],
        [format!("speed of the {driver}"), format!("{} 1/min", speeds(scene))],
    ];
    if let Some((slices, chosen)) = facts.resolution.as_ref().and_then(|r| Some((r.slices?, r.slices_chosen))) {
        let whose = if chosen { "chosen" } else { "of the scene" };
        rows.push(["slices over the face".to_owned(), format!("{slices} ({whose})")]);
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

/// First and last speed of the driver where it changes.
fn speed_ends(scene: &Scene) -> Option<[f64; 2]> {
    let motion = scene.motion.as_ref()?;
    let ramp = motion.ramp.as_ref().map(|r| [r.from_rpm, r.to_rpm]);
    ramp.or(motion.sweep.as_ref().map(|s| [s.from_rpm, s.to_rpm]))
}

/// The speed of the driver, or the first and the last one.
fn speeds(scene: &Scene) -> String {
    speed_ends(scene).map_or_else(|| scene.operation.speed_rpm.to_string(), |[from, to]| format!("{from} .. {to}"))
}

/// Slices and elements along the face, and whether the program chose them.
fn resolution(scene: &Scene, facts: &RunInfo) -> Vec<Line> {
    let Some(r) = &facts.resolution else { return Vec::new() };
    let slices = r.slices.map(|slices| {
        Line::text("slices over the face", slices, if r.slices_chosen { "(chosen)" } else { "(of the scene)" })
    });
    let elements = match r.face_elements {
        [Some(pinion), Some(wheel)] => {
            let chosen = ["pinion.mesher.elements_face", "wheel.mesher.elements_face"]
                .map(|key| scene.place_of(&[key]).is_none());
            let by = if chosen == [true; 2] { "(chosen)" } else { "(of the scene)" };
            Some(Line::text("elements along the face, pinion, wheel", format!("{pinion}, {wheel}"), by))
        }
        _ => None,
    };
    slices.into_iter().chain(elements).collect()
}

fn geometry(facts: &RunInfo) -> Vec<Line> {
    let g = &facts.geometry;
    let ratios = [g.eps_alpha, g.eps_beta, g.eps_gamma].map(|ratio| fixed(ratio, 4));
    let [alpha, beta, gamma] = ratios;
    vec![
        Line::text("contact ratios eps_alpha + eps_beta = eps_gamma", format!("{alpha} + {beta} = {gamma}"), ""),
        Line::number("centre distance", g.centre_distance_mm, 4, "mm"),
        Line::number("working pressure angle", g.working_pressure_angle_deg, 4, "deg"),
        Line::number("base helix angle", g.base_helix_angle_deg, 4, "deg"),
        Line::number("base radius of the pinion", g.base_radius_mm[0], 4, "mm"),
        Line::number("base radius of the wheel", g.base_radius_mm[1], 4, "mm"),
        Line::number("transverse base pitch", g.base_pitch_mm, 4, "mm"),
    ]
}

/// Meshes and degrees of freedom.
fn size(facts: &RunInfo) -> Vec<Line> {
    if facts.dof_before == [0; 2] && facts.meshes.is_empty() {
        return Vec::new();
    }
    let names = ["pinion", "wheel"];
    let meshes = facts.meshes.iter().zip(names).map(|(mesh, name)| {
        let kinds = format!("nodes, {} ({})", mesh.kinds.join(", "), mesh.source);
        Line::text(format!("mesh of the {name}"), mesh.nodes, kinds)
    });
    let sum = |[pinion, wheel]: [usize; 2]| (pinion + wheel).to_string();
    let dof = [
        Line::text("DOF before reduction, pinion + wheel", sum(facts.dof_before), ""),
        Line::text("DOF after reduction, pinion + wheel", sum(facts.dof_after), ""),
    ];
    let ways = names.iter().zip(&facts.reduction).map(|(name, way)| Line::text(format!("reduction, {name}"), way, ""));
    meshes.chain(dof).chain(ways).collect()
}

/// The largest pressure, and where it is.
pub(super) fn pressure(pressure_mpa: f64, at: Option<&PressurePlace>) -> Line {
    let unit = at.map_or_else(|| "MPa".to_owned(), |at| format!("MPa ({})", at.describe()));
    Line::number("maximum pressure", pressure_mpa, 0, unit)
}

/// The transmission errors of a motion beside those of the quasi-static cycle: means, then peak to peak, um.
pub(super) fn errors(dynamic: [f64; 2], quasi_static: [Option<f64>; 2]) -> Vec<Line> {
    let labels = ["mean DTE", "peak-to-peak DTE"];
    let of = |(k, label): (usize, &str)| {
        [Line::number(label, dynamic[k], 4, "um"), Line::number("  quasi-static", quasi_static[k], 4, "um")]
    };
    labels.into_iter().enumerate().flat_map(of).collect()
}

/// Amplitudes of the first mesh orders, um.
pub(super) fn harmonics(of: &str, amplitudes_um: &[f64]) -> Vec<Line> {
    let line = |(k, amplitude): (usize, &f64)| {
        Line::number(format!("mesh harmonic {} of {of}, amplitude", k + 1), *amplitude, 4, "um")
    };
    amplitudes_um.iter().take(4).enumerate().map(line).collect()
}

/// Nominal root stresses of the standard, where there are some.
pub(super) fn iso_root_stress(facts: &RunInfo) -> Option<Line> {
    let iso = facts.iso_root_stress.as_ref()?;
    let [pinion, wheel] = [&iso.pinion, &iso.wheel].map(|g| fixed(g.nominal_root_stress_mpa, 1));
    Some(Line::text("nominal root stress by ISO 6336-3", format!("{pinion}, {wheel}"), "MPa (pinion, wheel)"))
}

/// Mesh cycles of a motion, and how nearly it repeats itself.
pub(super) fn cycles([settling, written]: [u64; 2], periodicity: Option<f64>, period: Option<usize>) -> [Line; 2] {
    [
        Line::text("mesh cycles, settling and written", format!("{settling} + {written}"), ""),
        Line::science("repeats itself to", periodicity, format!("after {} cycle(s)", period.unwrap_or(1))),
    ]
}

/// Whose inertia the mesh resonance is of.
pub(super) fn inertia(inertia: &InertiaHeadline) -> [Line; 3] {
    let of = format!("kg ({})", inertia.describe());
    [
        Line::number("  of an inertia on the base circle of", inertia.equivalent_mass_kg, 4, of),
        Line::number("  with both gears free", inertia.mesh_resonance_both_free_hz, 1, "Hz"),
        Line::number("  with the driver held", inertia.mesh_resonance_driver_held_hz, 1, "Hz"),
    ]
}

/// Where quasi-static elasticity ends.
pub(super) fn elasticity(e: &ElasticHeadline) -> [Line; 3] {
    let [pinion, wheel] = e.lowest_elastic_frequency_hz.map(|hz| fixed(hz, 0));
    let of = format!("(harmonic {} of {} Hz)", e.mesh_harmonic, fixed(e.highest_mesh_frequency_hz, 1));
    let change = format!(
        "um, {} % of the peak to peak (reported from {} % on)",
        fixed(100.0 * e.change_over_peak_to_peak, 1),
        fixed(100.0 * e.limit_of_change, 1)
    );
    [
        Line::text("lowest elastic frequencies", format!("{pinion}, {wheel}"), "Hz"),
        Line::number("mesh harmonic over elastic frequency", e.mesh_harmonic_over_elastic, 4, of),
        Line::number("  its inertia may change the DTE by", e.change_of_peak_to_peak_um, 4, change),
    ]
}

/// A label and a number with its unit, for the top of a page.
pub(super) fn key(label: &str, value: impl Into<Option<f64>>, decimals: usize, unit: &str) -> [String; 2] {
    let Line { value, .. } = Line::number("", value, decimals, "");
    [label.to_owned(), format!("{value} {unit}")]
}
