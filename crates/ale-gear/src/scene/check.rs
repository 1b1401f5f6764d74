//! From words to a scene: ranges, defaults, what goes together, what this version cannot do.

use std::path::PathBuf;

use mesh::GroupNames;

use super::raw::{
    RawAnalysis, RawContact, RawGear, RawGroups, RawMaterial, RawMesher, RawOperation, RawOutput, RawPair, RawScene,
    Word,
};
use super::source::Source;
use super::{
    Analysis, ContactScene, Driver, FieldName, Flanks, Gap, GearScene, Kind, Material, MesherScene, Method, Model,
    ModesScene, Operation, OutputScene, PairScene, Reduction, Rotation, Scene, SceneError,
};
use super::{ladder, micro, motion, schema};

type Checked<T> = Result<T, SceneError>;

/// Default bore over reference diameter.
const BORE_RATIO: f64 = 0.55;

/// Every complaint is made here, before any work starts or any file is written.
pub(super) fn scene(source: &Source<'_>, raw: RawScene) -> Checked<Scene> {
    all_given(source, &raw)?;
    let shared = material(source, &raw.material, steel())?;
    let pair = pair(source, &raw.pair)?;
    let mut pinion = gear(source, &raw.pinion, Hand::Own, &pair, shared)?;
    let mut wheel = gear(source, &raw.wheel, Hand::Against(pinion.helix_angle_deg), &pair, shared)?;
    let analysis = analysis(source, &raw.analysis)?;
    ladder::tables(source, &raw, analysis.model)?;
    let rung = ladder::Rung::of(analysis.model);
    let dynamic = analysis.kind == Kind::Dynamic;
    if dynamic {
        for (of, words, whose) in [(&mut pinion, &raw.pinion, "pinion"), (&mut wheel, &raw.wheel, "wheel")] {
            let mut body =
                words.body.as_ref().map(|b| motion::body(source, b.get_ref())).transpose()?.unwrap_or_default();
            let mut free_at = words.body.as_ref().map(toml::Spanned::span);
            if let Some((rung, moves)) = rung.and_then(|r| Some((r, r.moves?))) {
                ladder::moves(source, words, rung, &body)?;
                body.free = moves.to_vec();
                free_at = raw.analysis.model.as_ref().map(toml::Spanned::span);
            }
            let bearing = words.bearing.as_ref().map(toml::Spanned::get_ref);
            of.bearing = motion::bearing(source, bearing, &body.free, free_at, whose)?;
            if analysis.model == Model::Lumped12 {
                // Its damping is Rayleigh's.
                of.bearing.damping_ratio = None;
            }
            of.body = Some(body);
        }
    } else {
        belongs_to_motion(source, &raw)?;
    }
    let modes = normal_modes(source, &raw, analysis.model)?;
    let (no_drive, no_load, no_motion) = Default::default();
    let in_time = dynamic
        .then(|| motion::motion(source, raw.motion.as_ref().map_or(&no_motion, |m| m.get_ref()), &raw.analysis.cycles))
        .transpose()?;
    let in_time = in_time.map(|m| super::MotionScene {
        // Only a mesh that says so has a damping of its own.
        mesh_damping_ratio: m.mesh_damping_ratio.filter(|_| rung.is_none_or(|r| r.mesh_damping)),
        ..m
    });
    let ladder::Words { mesh, lumped8, lumped12, shaft18, impact } = ladder::words(source, &raw, analysis.model)?;
    if let Some(word) = raw.analysis.model.as_ref().filter(|_| shaft18.is_some()) {
        pinion.shaft = Some(shaft(source, &raw.pinion, "pinion", word)?);
        wheel.shaft = Some(shaft(source, &raw.wheel, "wheel", word)?);
    }
    let in_seconds = in_time.as_ref().is_some_and(|m| m.run == super::Run::Ramp || m.duration_s.is_some());
    let cycles = if in_seconds { 0 } else { analysis.cycles };
    let scene = Scene {
        name: raw.name.clone().unwrap_or_else(|| default_name(source)),
        file: source.file.to_owned(),
        written: super::Written::new(source),
        set: Vec::new(),
        operation: operation(source, &raw.operation)?,
        contact: contact(source, &raw.contact, analysis.kind)?,
        drive: dynamic
            .then(|| motion::drive(source, raw.drive.as_ref().map_or(&no_drive, |d| d.get_ref())))
            .transpose()?,
        load: dynamic.then(|| motion::load(source, raw.load.as_ref().map_or(&no_load, |l| l.get_ref()))).transpose()?,
        analysis: Analysis { cycles, ..analysis },
        modes,
        motion: in_time,
        mesh,
        lumped8,
        lumped12,
        impact,
        shaft18,
        output: output(source, &raw.output)?,
        pinion,
        wheel,
        pair,
    };
    together(source, &raw, &scene)?;
    Ok(scene)
}

/// The shaft of a gear, which the model of shafts wants.
fn shaft(s: &Source<'_>, raw: &RawGear, whose: &str, model: &toml::Spanned<String>) -> Checked<super::ShaftScene> {
    match &raw.shaft {
        Some(table) => ladder::shaft(s, table),
        None => Err(SceneError::Conflict {
            place: s.place(&model.span()),
            what: format!("the model \"shaft18\" wants the shaft of the {whose}"),
            advice: format!("give [{whose}.shaft] with `segments_mm`, `gear_at_mm` and supports"),
        }),
    }
}

/// The table of modes goes with the model that keeps them, and with no other.
fn normal_modes(s: &Source<'_>, raw: &RawScene, model: Model) -> Checked<Option<ModesScene>> {
    match (model, &raw.modes) {
        (Model::ReducedModes, None) => motion::modes(s, &Default::default()).map(Some),
        (Model::ReducedModes, Some(words)) => motion::modes(s, words.get_ref()).map(Some),
        (_, None) => Ok(None),
        (_, Some(words)) => Err(SceneError::Conflict {
            place: s.place(&words.span()),
            what: "[modes] belongs to `model = \"reduced+modes\"`".into(),
            advice: "leave it out, or say so in [analysis]".into(),
        }),
    }
}

/// Tables on motion mean nothing to an analysis without time.
fn belongs_to_motion(s: &Source<'_>, raw: &RawScene) -> Checked<()> {
    let tables = [
        ("[pinion.body]", raw.pinion.body.as_ref().map(toml::Spanned::span)),
        ("[pinion.bearing]", raw.pinion.bearing.as_ref().map(toml::Spanned::span)),
        ("[wheel.body]", raw.wheel.body.as_ref().map(toml::Spanned::span)),
        ("[wheel.bearing]", raw.wheel.bearing.as_ref().map(toml::Spanned::span)),
        ("[drive]", raw.drive.as_ref().map(toml::Spanned::span)),
        ("[load]", raw.load.as_ref().map(toml::Spanned::span)),
        ("[motion]", raw.motion.as_ref().map(toml::Spanned::span)),
    ];
    match tables.into_iter().find_map(|(name, span)| Some((name, span?))) {
        None => Ok(()),
        Some((name, span)) => Err(SceneError::Conflict {
            place: s.place(&span),
            what: format!("{name} belongs to an analysis in time"),
            advice: "leave it out, or say `kind = \"dynamic\"` in [analysis]".into(),
        }),
    }
}

fn default_name(source: &Source<'_>) -> String {
    source.file.file_stem().map_or_else(|| "scene".into(), |s| s.to_string_lossy().into_owned())
}

fn all_given(source: &Source<'_>, raw: &RawScene) -> Checked<()> {
    let needed = [
        ("`[pinion] teeth`", raw.pinion.teeth.is_none()),
        ("`[pinion] helix_angle_deg`", raw.pinion.helix_angle_deg.is_none()),
        ("`[wheel] teeth`", raw.wheel.teeth.is_none()),
        ("`[pair] normal_module_mm`", raw.pair.normal_module_mm.is_none()),
        ("`[pair] face_width_mm`", raw.pair.face_width_mm.is_none()),
        ("`[operation] torque_nm`", raw.operation.torque_nm.is_none()),
    ];
    let keys: Vec<String> = needed.into_iter().filter(|(_, gone)| *gone).map(|(key, _)| key.to_owned()).collect();
    if keys.is_empty() { Ok(()) } else { Err(SceneError::Missing { file: source.file.to_owned(), keys }) }
}

/// What a gear is of where nothing is said.
fn steel() -> Material {
    let of = |key| schema::MATERIAL.number(key).2.unwrap_or(0.0);
    Material { young_mpa: of("young_mpa"), poisson: of("poisson"), density_kg_m3: of("density_kg_m3") }
}

fn material(s: &Source<'_>, raw: &RawMaterial, default: Material) -> Checked<Material> {
    let or = |key, value, default| {
        let (low, high, _) = schema::MATERIAL.number(key);
        s.number(key, value, default, low, high)
    };
    Ok(Material {
        young_mpa: or("young_mpa", &raw.young_mpa, default.young_mpa)?,
        poisson: or("poisson", &raw.poisson, default.poisson)?,
        density_kg_m3: or("density_kg_m3", &raw.density_kg_m3, default.density_kg_m3)?,
    })
}

fn pair(s: &Source<'_>, raw: &RawPair) -> Checked<PairScene> {
    let face_width_mm = s.number_of(&schema::PAIR, "face_width_mm", &raw.face_width_mm)?;
    Ok(PairScene {
        normal_module_mm: s.number_of(&schema::PAIR, "normal_module_mm", &raw.normal_module_mm)?,
        normal_pressure_angle_deg: s.number_of(
            &schema::PAIR,
            "normal_pressure_angle_deg",
            &raw.normal_pressure_angle_deg,
        )?,
        face_width_mm,
        centre_distance_mm: s.optional_of(&schema::PAIR, "centre_distance_mm", &raw.centre_distance_mm)?,
        addendum_coefficient: s.number_of(&schema::PAIR, "addendum_coefficient", &raw.addendum_coefficient)?,
        dedendum_coefficient: s.number_of(&schema::PAIR, "dedendum_coefficient", &raw.dedendum_coefficient)?,
        root_radius_coefficient: s.number_of(&schema::PAIR, "root_radius_coefficient", &raw.root_radius_coefficient)?,
        misalignment: match &raw.misalignment {
            None => Default::default(),
            Some(table) => micro::misalignment(s, table.get_ref(), face_width_mm)?,
        },
    })
}

/// Whether a gear states its helix angle or follows the mating one.
enum Hand {
    Own,
    Against(f64),
}

fn gear(s: &Source<'_>, raw: &RawGear, hand: Hand, pair: &PairScene, shared: Material) -> Checked<GearScene> {
    let teeth = s.whole_of(&schema::GEAR, "teeth", &raw.teeth)?;
    let helix_angle_deg = match hand {
        Hand::Own => s.number_of(&schema::GEAR, "helix_angle_deg", &raw.helix_angle_deg)?,
        Hand::Against(other) => against(s, raw, other)?,
    };
    let reference = f64::from(teeth) * pair.normal_module_mm / helix_angle_deg.to_radians().cos();
    let widest_arc = 0.25 * pair.normal_module_mm;
    let bore_limit = reference.max(1e-3);
    let (mesh, mesher) = mesh_source(s, raw, teeth)?;
    let (pitch_errors_um, pitch_errors_file) = micro::pitch_errors(s, raw, teeth)?;
    Ok(GearScene {
        teeth,
        helix_angle_deg,
        bore_diameter_mm: s.number(
            "bore_diameter_mm",
            &raw.bore_diameter_mm,
            BORE_RATIO * reference,
            1e-3,
            bore_limit,
        )?,
        profile_shift: s.number_of(&schema::GEAR, "profile_shift", &raw.profile_shift)?,
        tip_edge_radius_mm: s.number("tip_edge_radius_mm", &raw.tip_edge_radius_mm, 0.0, 0.0, widest_arc)?,
        tip_diameter_mm: match raw.tip_diameter_mm {
            None => None,
            Some(_) => {
                Some(s.number("tip_diameter_mm", &raw.tip_diameter_mm, 0.0, reference * 0.5, reference * 2.0)?)
            }
        },
        thickness_allowance_mm: s.number(
            "thickness_allowance_mm",
            &raw.thickness_allowance_mm,
            0.0,
            0.0,
            0.5 * pair.normal_module_mm,
        )?,
        pitch_errors_um,
        pitch_errors_file,
        mesh,
        mesher,
        groups: groups(s, &raw.groups)?,
        material: material(s, &raw.material, shared)?,
        modification: match &raw.modification {
            None => Default::default(),
            Some(table) => micro::modification(s, table.get_ref(), pair.face_width_mm)?,
        },
        body: None,
        bearing: Default::default(),
        shaft: None,
    })
}

/// The wheel of an external pair has the other hand; stated, it must agree.
fn against(s: &Source<'_>, raw: &RawGear, pinion_deg: f64) -> Checked<f64> {
    // `0.0 - x` and not `-x`: a spur wheel has helix angle 0, not -0.
    let follows = 0.0 - pinion_deg;
    match &raw.helix_angle_deg {
        Some(own) if (own.get_ref() - follows).abs() > 1e-9 => Err(SceneError::Conflict {
            place: s.place(&own.span()),
            what: format!(
                "the wheel's `helix_angle_deg` is {}, but the pinion's is {pinion_deg}: they do not mesh",
                own.get_ref()
            ),
            advice: "leave it out: the wheel's helix angle follows from the pinion's".into(),
        }),
        _ => Ok(follows),
    }
}

fn mesh_source(s: &Source<'_>, raw: &RawGear, teeth: u32) -> Checked<(Option<PathBuf>, Option<MesherScene>)> {
    match (&raw.mesh, &raw.mesher) {
        (Some(_), Some(mesher)) => Err(SceneError::Conflict {
            place: s.place(&mesher.span()),
            what: "a gear has both a `mesh` and a `mesher` table".into(),
            advice: "keep `mesh` to read a file, or the `mesher` table to have one made".into(),
        }),
        (Some(mesh), None) => {
            let path = PathBuf::from(mesh.get_ref());
            let found = s.file.parent().map_or_else(|| path.clone(), |folder| folder.join(&path));
            if !found.is_file() {
                return Err(SceneError::Conflict {
                    place: s.place(&mesh.span()),
                    what: format!("`mesh` is \"{}\", but there is no file {}", mesh.get_ref(), found.display()),
                    advice: "paths are relative to the scene file".into(),
                });
            }
            Ok((Some(path), None))
        }
        (None, mesher) => {
            let none = RawMesher::default();
            Ok((None, Some(mesher_options(s, mesher.as_ref().map_or(&none, |m| m.get_ref()), teeth)?)))
        }
    }
}

fn mesher_options(s: &Source<'_>, raw: &RawMesher, teeth: u32) -> Checked<MesherScene> {
    Ok(MesherScene {
        order: s.whole_of(&schema::MESHER, "order", &raw.order)?,
        elements_profile: s.whole_of(&schema::MESHER, "elements_profile", &raw.elements_profile)?,
        elements_fillet: s.whole_of(&schema::MESHER, "elements_fillet", &raw.elements_fillet)?,
        elements_thickness: s.whole_of(&schema::MESHER, "elements_thickness", &raw.elements_thickness)?,
        elements_face: s.whole_of(&schema::MESHER, "elements_face", &raw.elements_face)?,
        elements_rim: s.whole_of(&schema::MESHER, "elements_rim", &raw.elements_rim)?,
        sector_teeth: s.whole("sector_teeth", &raw.sector_teeth, 0, 0, teeth - 1)?,
    })
}

/// The mesh's own names; those of flanks need a place for the tooth number.
fn groups(s: &Source<'_>, raw: &RawGroups) -> Checked<GroupNames> {
    let ours = GroupNames::default();
    let name = |word: &Word, default: String| word.as_ref().map_or(default, |w| w.get_ref().clone());
    for (key, word) in [("flank_left", &raw.flank_left), ("flank_right", &raw.flank_right)] {
        if let Some(word) = word.as_ref().filter(|w| !w.get_ref().contains("{k}")) {
            return Err(SceneError::Conflict {
                place: s.place(&word.span()),
                what: format!("`{key}` is \"{}\", which has no place for the tooth number", word.get_ref()),
                advice: format!("write {{k}} where the number stands, as in {key} = \"Left_{{k}}\""),
            });
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

fn operation(s: &Source<'_>, raw: &RawOperation) -> Checked<Operation> {
    Ok(Operation {
        driver: s.choice("driver", &raw.driver, &[("pinion", Driver::Pinion), ("wheel", Driver::Wheel)])?,
        rotation: s.choice("rotation", &raw.rotation, &[("ccw", Rotation::Ccw), ("cw", Rotation::Cw)])?,
        torque_nm: s.number_of(&schema::OPERATION, "torque_nm", &raw.torque_nm)?,
        speed_rpm: s.number_of(&schema::OPERATION, "speed_rpm", &raw.speed_rpm)?,
    })
}

fn contact(s: &Source<'_>, raw: &RawContact, kind: Kind) -> Checked<ContactScene> {
    let method = s.choice("method", &raw.method, &[("slice", Method::Slice), ("nodal", Method::Nodal)])?;
    let (sliced, nodal) = (method == Method::Slice, method == Method::Nodal);
    let slices = s.whole_of(&schema::CONTACT, "slices", &raw.slices)?;
    let gap = s.choice("gap", &raw.gap, &[("smooth", Gap::Smooth), ("facet", Gap::Facet)])?;
    let points = s.whole_of(&schema::CONTACT, "points_per_face_edge", &raw.points_per_face_edge)?;
    Ok(ContactScene {
        method,
        slices: sliced.then_some(slices),
        corner_contact: sliced.then_some(raw.corner_contact.as_ref().is_none_or(|c| *c.get_ref())),
        friction: s.number_of(&schema::CONTACT, "friction", &raw.friction)?,
        penalty_mpa_per_mm: s.optional_of(&schema::CONTACT, "penalty_mpa_per_mm", &raw.penalty_mpa_per_mm)?,
        gap: nodal.then_some(gap),
        points_per_face_edge: nodal.then_some(points),
        // What moves may part and come back on the other side.
        flanks: match (kind, &raw.flanks) {
            (Kind::Dynamic, None) => Flanks::Both,
            _ => s.choice("flanks", &raw.flanks, &[("driving", Flanks::Driving), ("both", Flanks::Both)])?,
        },
    })
}

fn not_yet(s: &Source<'_>, key: &str, word: &toml::Spanned<String>, what: &str, instead: &str) -> SceneError {
    SceneError::NotYet {
        place: s.place(&word.span()),
        key: format!("{key} = \"{}\"", word.get_ref()),
        what: what.into(),
        instead: instead.into(),
    }
}

fn analysis(s: &Source<'_>, raw: &RawAnalysis) -> Checked<Analysis> {
    let models = [
        ("reduced", Model::Reduced),
        ("reduced+modes", Model::ReducedModes),
        ("full", Model::Full),
        ("iso", Model::Iso),
        ("lumped8", Model::Lumped8),
        ("lumped12", Model::Lumped12),
        ("shaft18", Model::Shaft18),
        ("impact", Model::Impact),
    ];
    let model = s.choice("model", &raw.model, &models)?;
    if let Some(word) = raw.reduction.as_ref().filter(|_| !model.is_reduced()) {
        return Err(SceneError::Conflict {
            place: s.place(&word.span()),
            what: "`reduction` belongs to `model = \"reduced\"`".into(),
            advice: "leave it out: this model reduces nothing".into(),
        });
    }
    let rung = ladder::Rung::of(model);
    let kind = match (&raw.kind, rung) {
        (None, Some(_)) => Kind::Dynamic,
        (word, _) => s.choice("kind", word, &[("static", Kind::Static), ("dynamic", Kind::Dynamic)])?,
    };
    if let (Kind::Static, Some(word), Some(rung)) = (kind, &raw.kind, rung) {
        return Err(SceneError::Conflict {
            place: s.place(&word.span()),
            what: format!("the model \"{}\" is one of motion", rung.name),
            advice: "leave `kind` out, or use `model = \"reduced\"`, \"full\" or \"iso\"".into(),
        });
    }
    if let (Some(word), Model::ReducedModes, Kind::Static) = (&raw.model, model, kind) {
        return Err(SceneError::Conflict {
            place: s.place(&word.span()),
            what: "`model = \"reduced+modes\"` needs `kind = \"dynamic\"`: modes are motion, and nothing moves here"
                .into(),
            advice: "say `kind = \"dynamic\"` in [analysis], or use `model = \"reduced\"`: at rest both are the same"
                .into(),
        });
    }
    let ways = [("auto", Reduction::Auto), ("general", Reduction::General)];
    let reduction = s.choice("reduction", &raw.reduction, &ways)?;
    Ok(Analysis {
        kind,
        model,
        reduction: model.is_reduced().then_some(reduction),
        positions_per_cycle: s.whole_of(&schema::ANALYSIS, "positions_per_cycle", &raw.positions_per_cycle)?,
        cycles: {
            let (low, high, _) = schema::ANALYSIS.whole("cycles");
            s.whole("cycles", &raw.cycles, if kind == Kind::Dynamic { 8 } else { 1 }, low, high)?
        },
        window_teeth: match raw.window_teeth {
            None => None,
            Some(_) => Some(s.whole_of(&schema::ANALYSIS, "window_teeth", &raw.window_teeth)?),
        },
    })
}

fn output(s: &Source<'_>, raw: &RawOutput) -> Checked<OutputScene> {
    const FIELDS: [(&str, FieldName); 3] =
        [("displacement", FieldName::Displacement), ("pressure", FieldName::Pressure), ("stress", FieldName::Stress)];
    let mut fields = Vec::new();
    match &raw.fields {
        None => fields.extend(FIELDS.map(|(_, field)| field)),
        Some(words) => {
            for word in words {
                let field = s.one_of("fields", word, &FIELDS)?;
                if !fields.contains(&field) {
                    fields.push(field);
                }
            }
        }
    }
    Ok(OutputScene {
        root_stress: raw.root_stress.as_ref().is_some_and(|on| *on.get_ref()),
        contact_lines: raw.contact_lines.as_ref().is_some_and(|w| *w.get_ref()),
        parquet: raw.parquet.as_ref().is_some_and(|on| *on.get_ref()),
        vtu: raw.vtu.as_ref().is_some_and(|on| *on.get_ref()),
        fields,
        vtu_every: s.whole_of(&schema::OUTPUT, "vtu_every", &raw.vtu_every)?,
    })
}

/// What can only be judged with the whole scene in view.
fn together(s: &Source<'_>, raw: &RawScene, scene: &Scene) -> Checked<()> {
    if scene.analysis.model == Model::Iso {
        nominal_flanks(s, raw)?;
    }
    if scene.analysis.kind == Kind::Dynamic {
        in_time(s, raw, scene)?;
    }
    if let (Some(window), Some(word)) = (scene.analysis.window_teeth, &raw.analysis.window_teeth) {
        let teeth = scene.pinion.teeth.min(scene.wheel.teeth);
        if window > teeth {
            return Err(SceneError::Conflict {
                place: s.place(&word.span()),
                what: format!("`window_teeth` is {window}, but the smaller gear has {teeth} teeth"),
                advice: "leave it out: the window follows from the contact ratio".into(),
            });
        }
    }
    let nodal_only = [
        ("penalty_mpa_per_mm", raw.contact.penalty_mpa_per_mm.as_ref().map(toml::Spanned::span)),
        ("gap", raw.contact.gap.as_ref().map(toml::Spanned::span)),
        ("points_per_face_edge", raw.contact.points_per_face_edge.as_ref().map(toml::Spanned::span)),
    ];
    let nodal_key = nodal_only.into_iter().find_map(|(key, span)| Some((key, span?)));
    if let (Method::Slice, Some((key, span))) = (scene.contact.method, nodal_key) {
        return Err(SceneError::Conflict {
            place: s.place(&span),
            what: format!("`{key}` means nothing to slices"),
            advice: "leave it out, or use `method = \"nodal\"`".into(),
        });
    }
    if let (Method::Nodal, Some(slices)) = (scene.contact.method, &raw.contact.slices) {
        return Err(SceneError::Conflict {
            place: s.place(&slices.span()),
            what: "`slices` means nothing to the method \"nodal\"".into(),
            advice: "leave it out, or use `method = \"slice\"`".into(),
        });
    }
    if let Some(word) = raw.output.contact_lines.as_ref().filter(|w| *w.get_ref() && !crate::pattern::has_slices(scene))
    {
        return Err(SceneError::Conflict {
            place: s.place(&word.span()),
            what: "`contact_lines` lists slices, and this scene has none".into(),
            advice: "leave it out, or use the method \"slice\" and the model \"reduced\" or \"full\"".into(),
        });
    }
    if let (Method::Nodal, Some(corner)) = (scene.contact.method, &raw.contact.corner_contact) {
        return Err(SceneError::Conflict {
            place: s.place(&corner.span()),
            what:
                "`corner_contact` means nothing to the method \"nodal\", whose points press wherever the flanks touch"
                    .into(),
            advice: "leave it out, or use `method = \"slice\"`".into(),
        });
    }
    if let (Some(friction), Model::Full | Model::Iso) = (&raw.contact.friction, scene.analysis.model)
        && scene.contact.friction != 0.0
    {
        return Err(SceneError::Conflict {
            place: s.place(&friction.span()),
            what: "only the model \"reduced\" has friction".into(),
            advice: "leave it out, or use `model = \"reduced\"`".into(),
        });
    }
    if let (Some(asked), true, Model::Iso) = (&raw.output.root_stress, scene.output.root_stress, scene.analysis.model) {
        return Err(SceneError::Conflict {
            place: s.place(&asked.span()),
            what: "`root_stress` needs a mesh, and the model \"iso\" has none".into(),
            advice: "leave it out, or use `model = \"reduced\"`".into(),
        });
    }
    if let (Some(penalty), Model::Iso) = (&raw.contact.penalty_mpa_per_mm, scene.analysis.model) {
        return Err(SceneError::Conflict {
            place: s.place(&penalty.span()),
            what: "`penalty_mpa_per_mm` means nothing to the model \"iso\", which has no contact points".into(),
            advice: "leave it out, or use `model = \"reduced\"`".into(),
        });
    }
    Ok(())
}

/// What an analysis in time can do.
fn in_time(s: &Source<'_>, raw: &RawScene, scene: &Scene) -> Checked<()> {
    let rung = ladder::Rung::of(scene.analysis.model);
    if let (Some(word), true, None) = (&raw.analysis.model, !scene.analysis.model.is_reduced(), rung) {
        return Err(not_yet(s, "model", word, "another model in time", "use `model = \"reduced\"`"));
    }
    if let (Some(word), Method::Nodal) = (&raw.contact.method, scene.contact.method) {
        return Err(not_yet(s, "method", word, "pressed points in time", "use `method = \"slice\"`"));
    }
    // Of quasi-static elasticity the forces on the flanks tell all; normal modes bend teeth besides.
    let stress = scene.output.root_stress && scene.analysis.model != Model::Reduced;
    let fields = [
        ("root_stress", stress, raw.output.root_stress.as_ref().map(toml::Spanned::span)),
        ("contact_lines", scene.output.contact_lines, raw.output.contact_lines.as_ref().map(toml::Spanned::span)),
        ("vtu", scene.output.vtu, raw.output.vtu.as_ref().map(toml::Spanned::span)),
    ];
    if let Some((key, _, Some(span))) = fields.into_iter().find(|(_, asked, _)| *asked) {
        return Err(SceneError::NotYet {
            place: s.place(&span),
            key: format!("{key} = true"),
            what: "fields and stresses of an analysis in time".into(),
            instead: "leave it out, or use `kind = \"static\"` for them".into(),
        });
    }
    if let Some(rung) = rung {
        ladder::in_time(s, raw, scene, rung)?;
    }
    let linear = rung.is_some_and(|r| r.mesh && !r.backlash);
    if let (Some(torque), true, false) = (&raw.operation.torque_nm, scene.operation.torque_nm == 0.0, linear) {
        return Err(SceneError::Conflict {
            place: s.place(&torque.span()),
            what: "`torque_nm` is 0: a motion begins under load, and its scales are taken from it".into(),
            advice: "give the torque that the motion begins with; `table_s_nm` in [load] may take it away later".into(),
        });
    }
    if let (Some(asked), true, Some(super::Run::Sweep)) =
        (&raw.output.parquet, scene.output.parquet, scene.motion.as_ref().map(|m| m.run))
    {
        return Err(SceneError::Conflict {
            place: s.place(&asked.span()),
            what: "`parquet` writes the history, and a sweep has none".into(),
            advice: "leave it out: resonance.csv has a row a speed".into(),
        });
    }
    let sweeps = scene.motion.as_ref().filter(|m| m.run != super::Run::Steady && m.run != super::Run::Span);
    if let (Some(_), Some(drive), Some(table)) = (sweeps, &scene.drive, &raw.drive)
        && drive.by == super::DriveBy::Torque
    {
        return Err(SceneError::Conflict {
            place: s.place(&table.span()),
            what: "shooting, ramps and sweeps give the speed of the driver, and here a torque drives it".into(),
            advice: "use `run = \"span\"` or \"steady\", or drive `by = \"speed\"`".into(),
        });
    }
    Ok(())
}

/// The model "iso" knows nominal flanks on parallel axes only.
fn nominal_flanks(s: &Source<'_>, raw: &RawScene) -> Checked<()> {
    let tables = [("modification", &raw.pinion.modification), ("modification", &raw.wheel.modification)];
    let tables = tables.into_iter().filter_map(|(key, table)| table.as_ref().map(|t| (key, t.span())));
    let misaligned = raw.pair.misalignment.iter().map(|t| ("misalignment", t.span()));
    let lists = [&raw.pinion, &raw.wheel].into_iter().filter_map(|g| g.pitch_errors_um.as_ref());
    let files = [&raw.pinion, &raw.wheel].into_iter().filter_map(|g| g.pitch_errors_file.as_ref());
    let lists = lists.map(|l| ("pitch_errors_um", l.span()));
    let files = files.map(|f| ("pitch_errors_file", f.span()));
    match tables.chain(misaligned).chain(lists).chain(files).next() {
        None => Ok(()),
        Some((key, span)) => Err(SceneError::Conflict {
            place: s.place(&span),
            what: format!("`{key}` means nothing to the model \"iso\", which takes nominal flanks on parallel axes"),
            advice: "leave it out, or use `model = \"reduced\"`".into(),
        }),
    }
}
