//! A stage of a REXS file as a scene: gears, flanks, allowances, tools, steel, and the load if shafts and loads of the
//! file give it.
//!
//! A `cylindrical_stage` with its two gears and their flanks is required. Other missing data keep their defaults; data
//! of the file that a scene does not support are named.

use roxmltree::Node;

use super::{
    RexsError,
    document::{Model, Part, parsed, reference},
    gear::GearData,
    left::left,
    train::Train,
};
use crate::{Driver, SceneError, Sense, Starter, Steel};

/// A pair from a REXS file.
#[derive(Debug, Clone)]
pub struct RexsPair {
    /// Values of the scene.
    pub starter: Starter,
    /// Remarks for the user: about chosen values, and about data of the file that were not used.
    pub remarks: Vec<String>,
    /// Keys of the scene, each with the part and attribute of the file from which it comes.
    pub places: Vec<(String, String)>,
}

/// The pair of stage `stage` of a REXS file, under load case `case` (both counted from 1). Values that the file does
/// not give are those of `from`.
///
/// # Errors
/// [`RexsError`].
pub fn read_pair(text: &str, stage: usize, case: usize, from: &Starter) -> Result<RexsPair, RexsError> {
    let document = parsed(text)?;
    let model = Model::of(&document)?;
    model.choose(case)?;
    let train = Train::of(&model)?;
    let mut pair = pair_of(&model, &train, stage, from)?;
    pair.remarks.extend(case_remark(&model));
    let untaken = left(&model);
    if !untaken.is_empty() {
        pair.remarks.push(format!("not taken of the file:\n  {}", untaken.join("\n  ")));
    }
    Ok(pair)
}

/// Which of several load cases is taken.
pub(super) fn case_remark(model: &Model<'_>) -> Option<String> {
    let (case, all) = (model.chosen()?, model.cases());
    (all > 1).then(|| format!("load case {case} of {all} is taken: `--load-case N` takes another"))
}

/// Stages of cylindrical gears.
pub(super) fn stages<'a>(model: &Model<'a>) -> Vec<Node<'a, 'a>> {
    model.relations("stage").filter(|r| model.refers(*r, "stage", "cylindrical_stage")).collect()
}

/// A pair within a file that is read; what is left of it is not told.
pub(super) fn pair_of(
    model: &Model<'_>,
    train: &Train<'_, '_>,
    stage: usize,
    from: &Starter,
) -> Result<RexsPair, RexsError> {
    let stages = stages(model);
    let wrong = RexsError::Stage { found: stages.len(), asked: stage };
    let relation = *stage.checked_sub(1).and_then(|i| stages.get(i)).ok_or(wrong)?;
    let of = |role: &'static str| {
        let part = reference(relation, role).and_then(|id| model.part("gear", id));
        GearData::of(model, part.ok_or(RexsError::Gear { stage, role })?)
    };
    let mut gears = [of("gear_1")?, of("gear_2")?];
    // The wheel alone may be a ring.
    if gears[0].teeth < 0 {
        gears.reverse();
    }
    let own = reference(relation, "stage").and_then(|id| model.part("stage", id));
    let mut places = places(&gears);
    let starter = starter(model, &gears, own.as_ref(), (stage, from), &mut places)?;
    let (starter, remarks) = loaded(model, train, &gears, starter);
    let mut pair = RexsPair { starter, remarks, places };
    pair.shorten_tips();
    let ring_shift = pair.starter.profile_shift[1];
    if pair.starter.teeth[1] < 0 && ring_shift != 0.0 {
        pair.remarks.push(format!(
            "profile_shift = {ring_shift} of the ring is read with ISO 21771's sign; programs that count z_2 > 0 write minus that"
        ));
    }
    Ok(pair)
}

impl RexsPair {
    /// Tips of which the file says nothing are as short as they have to be.
    fn shorten_tips(&mut self) {
        let shorter = self.starter.with_tips_that_pass();
        let before = std::mem::replace(&mut self.starter, shorter);
        for (name, gear) in ["pinion", "ring"].into_iter().zip(0..) {
            if let (None, Some(tip)) = (before.tip_diameter_mm[gear], self.starter.tip_diameter_mm[gear]) {
                self.remarks.push(format!(
                    "the file states no tip diameter of the {name}: tip_diameter_mm = {tip}, as its mating gear asks"
                ));
            }
        }
    }
}

/// Where values of the scene come from.
fn places(gears: &[GearData<'_, '_>; 2]) -> Vec<(String, String)> {
    let mut all = Vec::new();
    for (table, gear) in ["pinion", "wheel"].into_iter().zip(gears) {
        let flank = gear.flank.map_or_else(|| gear.part.named(), |id| format!("flank {id}"));
        let named = gear.part.named();
        let mut add = |key: &str, part: &str, attribute: &str| {
            all.push((format!("{table}.{key}"), format!("{part}: `{attribute}`")));
        };
        add("teeth", &named, "number_of_teeth");
        add("helix_angle_deg", &named, "helix_angle_reference_diameter");
        add("face_width_mm", &named, "face_width");
        add("tip_diameter_mm", &named, "tip_diameter");
        add("bore_diameter_mm", &named, if gear.teeth < 0 { "outer_diameter" } else { "inner_diameter" });
        add("thickness_allowance_mm", &named, "tooth thickness allowance");
        add("profile_shift", &flank, "addendum_modification_coefficient");
        add("material.young_mpa", &named, "elastic_modulus of its material");
        add("material.poisson", &named, "poisson_ratio of its material");
        add("material.density_kg_m3", &named, "density of its material");
    }
    let pinion = gears[0].part.named();
    all.push(("pair.normal_module_mm".into(), format!("{pinion}: `normal_module`")));
    all.push(("pair.face_width_mm".into(), format!("{pinion}: `face_width`")));
    all.push(("pair.normal_pressure_angle_deg".into(), format!("{pinion}: `normal_pressure_angle` of its flanks")));
    all
}

fn starter(
    model: &Model<'_>,
    gears: &[GearData<'_, '_>; 2],
    own: Option<&Part<'_, '_>>,
    (stage, from): (usize, &Starter),
    places: &mut Vec<(String, String)>,
) -> Result<Starter, RexsError> {
    let [pinion, wheel] = gears;
    if pinion.teeth < 0 {
        return Err(RexsError::Rings { part: pinion.part.named() });
    }
    alike("normal module", pinion.module, wheel.module)?;
    if wheel.teeth < 0 {
        alike("helix angle of the same hand", pinion.helix, wheel.helix)?;
    } else {
        alike("helix angle of opposite hand", pinion.helix, 0.0 - wheel.helix)?;
    }
    if let (Some(first), Some(second)) = (pinion.angle, wheel.angle) {
        alike("normal pressure angle", first, second)?;
    }
    let widths = [pinion.width, wheel.width];
    let placed = apart(gears)?;
    let centre = centre_distance(own, placed.map(|[across, _]| across))?;
    if let Some((_, said)) = &centre {
        places.push(("pair.centre_distance_mm".into(), said.clone()));
    }
    let [dedendum, root_radius] = tools(model, gears)?;
    let steel = |gear: &GearData<'_, '_>| {
        let [young_mpa, poisson, density_kg_m3] = gear.steel;
        Steel { young_mpa, poisson, density_kg_m3 }
    };
    Ok(Starter {
        name: model.program().map(|p| format!("{p}, stage {stage}")).unwrap_or_default(),
        teeth: [pinion.teeth, wheel.teeth],
        module_mm: pinion.module,
        helix_deg: pinion.helix,
        face_width_mm: widths[0].min(widths[1]),
        profile_shift: [pinion.shift, wheel.shift],
        pressure_angle_deg: pinion.angle.or(wheel.angle),
        tip_diameter_mm: [pinion.tip, wheel.tip],
        bore_diameter_mm: [pinion.bore, wheel.bore],
        thickness_allowance_mm: [pinion.thinning, wheel.thinning],
        steel: [steel(pinion), steel(wheel)],
        dedendum_coefficient: dedendum,
        root_radius_coefficient: root_radius,
        own_face_width_mm: if widths[0] == widths[1] { [None, None] } else { widths.map(Some) },
        centre_distance_mm: centre.map(|(a, _)| a),
        mid_face_offset_mm: placed.map(|[_, along]| along).filter(|along| along.abs() > ONE_HEIGHT),
        ..from.clone()
    })
}

fn alike(what: &'static str, pinion: f64, wheel: f64) -> Result<(), RexsError> {
    if (pinion - wheel).abs() <= 1e-6 * pinion.abs().max(1.0) {
        Ok(())
    } else {
        Err(RexsError::Pair { what, pinion, wheel })
    }
}

/// Heights nearer than this are one, mm.
const ONE_HEIGHT: f64 = 1e-6;
/// Digits of places in a file, mm.
const DIGITS: f64 = 1e-2;

/// The stage's own centre distance, or that of the gears' places; and what says it.
fn centre_distance(own: Option<&Part<'_, '_>>, placed: Option<f64>) -> Result<Option<(f64, String)>, RexsError> {
    let stated = match own {
        Some(part) => {
            part.number("center_distance", "mm")?.map(|a| (a.abs(), format!("{}: `center_distance`", part.named())))
        }
        None => None,
    };
    if let (Some((a, _)), Some(placed), Some(part)) = (&stated, placed, own)
        && (a - placed).abs() > DIGITS
    {
        return Err(RexsError::Unfit {
            part: part.named(),
            what: format!(
                "has a `center_distance` of {a} mm, and its gears stand {placed} mm apart (`support_vector`)"
            ),
            hint: "correct one of both in the file".into(),
        });
    }
    Ok(stated.or_else(|| placed.map(|a| (a, "the places of the gears: `support_vector`".into()))))
}

/// Distance of the axes, and how far the second gear stands above the first along its axis, mm, where both say so in the
/// same frame; a gear stands where its mid-face is.
fn apart(gears: &[GearData<'_, '_>; 2]) -> Result<Option<[f64; 2]>, RexsError> {
    let frames = [0, 1].map(|i| gears[i].part.text("reference_component_for_position"));
    let places = [gears[0].part.vector("support_vector")?, gears[1].part.vector("support_vector")?];
    let axis = gears[0].part.vector("u_axis_vector")?;
    let ([Some(a), Some(b)], Some(axis)) = (places, axis) else { return Ok(None) };
    let apart = [0, 1, 2].map(|k| b[k] - a[k]);
    let along: f64 = (0..3).map(|k| apart[k] * axis[k]).sum::<f64>() / axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    let square = apart.iter().map(|x| x * x).sum::<f64>() - along * along;
    Ok((frames[0] == frames[1] && square > 0.0 && square.is_finite()).then(|| [square.sqrt(), along]))
}

/// Dedendum and root radius over the module, where racks of both gears make them alike and without protuberance.
fn tools(model: &Model<'_>, gears: &[GearData<'_, '_>; 2]) -> Result<[Option<f64>; 2], RexsError> {
    const RACK: &str = "rack_shaped_tool";
    let mut found = Vec::new();
    for gear in gears {
        let refers_to = |r: &Node<'_, '_>| r.children().any(|n| n.attribute("id") == Some(gear.part.id));
        let of_gear =
            ["manufacturing_step", "reference", "assembly"].into_iter().flat_map(|kind| model.relations(kind));
        let parts = of_gear.filter(refers_to).flat_map(|r| r.children()).filter_map(|n| n.attribute("id"));
        let Some(rack) = parts.filter_map(|id| model.part("tool", id)).find(|p| p.component() == RACK) else {
            return Ok([None; 2]);
        };
        let over = |own: Option<f64>, length: Option<f64>| own.or(length.map(|mm| mm / gear.module));
        let addendum = over(
            rack.number("addendum_coefficient_reference_profile", "")?,
            rack.number("addendum_reference_profile", "mm")?,
        );
        let radius = over(rack.number("tip_radius_factor", "")?, rack.number("tip_radius", "mm")?);
        let protuberance =
            over(rack.number("protuberance_amount_factor", "")?, rack.number("protuberance_amount", "mm")?);
        found.push((rack, [addendum, radius], protuberance.unwrap_or(0.0)));
    }
    let [(_, first, _), (_, second, _)] = &found[..] else { return Ok([None; 2]) };
    let same = first.iter().zip(second).all(|(a, b)| a.zip(*b).is_none_or(|(a, b)| (a - b).abs() < 1e-9));
    if same && found.iter().all(|(.., protuberance)| *protuberance == 0.0) {
        return Ok([0, 1].map(|k| first[k].or(second[k])));
    }
    for (rack, ..) in &found {
        for attribute in [
            "addendum_coefficient_reference_profile",
            "addendum_reference_profile",
            "tip_radius_factor",
            "tip_radius",
            "protuberance_amount_factor",
            "protuberance_amount",
        ] {
            model.forget(rack.id, attribute);
        }
    }
    Ok([None; 2])
}

/// The scene under the file's load: of shafts and loads that the stage hangs on, else that of the starter.
fn loaded(
    model: &Model<'_>,
    train: &Train<'_, '_>,
    gears: &[GearData<'_, '_>; 2],
    mut starter: Starter,
) -> (Starter, Vec<String>) {
    let own = train.stages.iter().position(|link| link.gears == [gears[0].part.id, gears[1].part.id]);
    let carried = own.and_then(|k| train.carried(k));
    if let Some(load) = &carried {
        let first = own.map_or(0.0, |k| train.speeds[train.stages[k].shafts[0]].unwrap_or(0.0));
        starter.driver = if load.driver == 0 { Driver::Pinion } else { Driver::Wheel };
        starter.rotation = if first < 0.0 { Sense::Cw } else { Sense::Ccw };
        (starter.torque_nm, starter.speed_rpm) = (load.torque, load.driver_speed.abs());
        return (starter, Vec::new());
    }
    train.shafts.iter().for_each(|shaft| model.forget(shaft.id, "rotational_speed"));
    train.loads.iter().for_each(|load| model.forget(load.part.id, "torque_around_u_axis"));
    let says_one = model.all().chain(model.case_values()).any(|(_, node)| {
        node.children().any(|n| matches!(n.attribute("id"), Some("rotational_speed" | "torque_around_u_axis")))
    });
    let (torque, speed) = (starter.torque_nm, starter.speed_rpm);
    let remark = format!(
        "the file's loads do not say what this stage carries: torque_nm = {torque}, speed_rpm = {speed} are the starting \
         values of `init`"
    );
    (starter, if says_one { vec![remark] } else { Vec::new() })
}

impl RexsPair {
    /// The error in the REXS file that corresponds to an error in the text of the pair's scene; `None` if it concerns
    /// no value from the REXS file.
    pub fn blamed(&self, text: &str, error: &SceneError) -> Option<RexsError> {
        let Some(crate::Place::Line(line)) = error.place() else { return None };
        let lines: Vec<&str> = text.lines().take(line.number).collect();
        let key = lines.last()?.split('=').next()?.trim();
        let table = lines.iter().rev().find_map(|l| l.strip_prefix('[')?.strip_suffix(']'))?;
        let whole = format!("{table}.{key}");
        let (_, place) = self.places.iter().find(|(own, _)| *own == whole)?;
        let hint = error.hint().map_or_else(String::new, |hint| format!(": {hint}"));
        let hint = format!("correct it in the file, or take it out{hint}");
        Some(RexsError::Unfit { part: format!("{place}:"), what: error.without_place(), hint })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rexs::document::ATTRIBUTES;

    /// A stage as the standard's pages describe it, gears 27 : 51 at a distance of 190 mm.
    const MODEL: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<model version="1.4" applicationId="Test" applicationVersion="1">
 <relations>
  <relation id="1" type="stage"><ref id="9" role="stage" hint="cylindrical_stage"/><ref id="5" role="gear_1"/><ref id="7" role="gear_2"/></relation>
  <relation id="2" type="flank"><ref id="5" role="gear"/><ref id="48" role="left"/></relation>
 </relations>
 <components>
  <component id="5" type="cylindrical_gear">
   <attribute id="number_of_teeth" unit="">27</attribute><attribute id="normal_module" unit="mm">4.5</attribute>
   <attribute id="face_width" unit="mm">50</attribute><attribute id="helix_angle_reference_diameter" unit="deg">21</attribute>
   <attribute id="u_axis_vector" unit="mm"><array><c>1</c><c>0</c><c>0</c></array></attribute>
   <attribute id="support_vector" unit="mm"><array><c>40</c><c>0</c><c>0</c></array></attribute>
  </component>
  <component id="7" type="cylindrical_gear">
   <attribute id="number_of_teeth" unit="">51</attribute><attribute id="normal_module" unit="mm">4.5</attribute>
   <attribute id="face_width" unit="mm">48</attribute><attribute id="helix_angle_reference_diameter" unit="deg">-21</attribute>
   <attribute id="support_vector" unit="mm"><array><c>47</c><c>0</c><c>-190</c></array></attribute>
  </component>
  <component id="48" type="cylindrical_gear_flank">
   <attribute id="normal_pressure_angle" unit="deg">20</attribute><attribute id="addendum_modification_coefficient" unit="">0.23</attribute>
  </component>
 </components>
</model>"#;

    #[test]
    fn a_stage_becomes_a_pair() {
        let found = read_pair(MODEL, 1, 1, &Starter::default()).unwrap().starter;
        assert_eq!((found.teeth, found.module_mm, found.helix_deg), ([27, 51], 4.5, 21.0));
        assert_eq!((found.face_width_mm, found.profile_shift), (48.0, [0.23, 0.0]));
        assert_eq!((found.pressure_angle_deg, found.centre_distance_mm), (Some(20.0), Some(190.0)));
        assert_eq!((found.torque_nm, found.name.as_str()), (150.0, "Test, stage 1"));
        assert_eq!((found.own_face_width_mm, found.mid_face_offset_mm), ([Some(50.0), Some(48.0)], Some(7.0)));
    }

    /// The stage with a ring of 96 teeth in place of its second gear.
    fn ring() -> String {
        let gear = MODEL.replace(">51<", ">96<").replace(">-21<", ">21<").replace("<c>-190</c>", "<c>-165</c>");
        gear.replace("id=\"7\" type=\"cylindrical_gear\"", "id=\"7\" type=\"ring_gear\"")
    }

    /// A ring is the wheel, wherever the stage names it, and however its teeth are counted.
    #[test]
    fn a_ring_becomes_the_wheel() {
        let plain = ring();
        let negative = plain.replace("ring_gear", "cylindrical_gear").replace(">96<", ">-96<");
        let swapped = plain.replace("role=\"gear_1\"", "role=\"one\"").replace("role=\"gear_2\"", "role=\"gear_1\"");
        let swapped = swapped.replace("role=\"one\"", "role=\"gear_2\"");
        for text in [plain, negative, swapped] {
            let found = read_pair(&text, 1, 1, &Starter::default()).unwrap().starter;
            assert_eq!((found.teeth, found.helix_deg, found.centre_distance_mm), ([27, -96], 21.0, Some(165.0)));
            assert_eq!(found.profile_shift, [0.23, 0.0]);
            let text = found.text("a.toml");
            let scene = crate::Scene::parse(&text, "a.toml".as_ref()).unwrap_or_else(|e| panic!("{e}\n{text}"));
            assert!(scene.gear_pair().unwrap().is_internal());
        }
        let flank = |id, shift| {
            format!(
                "<component id=\"{id}\" type=\"cylindrical_gear_flank\"><attribute id=\"addendum_modification_coefficient\" unit=\"\">{shift}</attribute></component></components>"
            )
        };
        let relation = "<relation id=\"3\" type=\"flank\"><ref id=\"7\" role=\"gear\"/><ref id=\"49\" role=\"left\"/></relation></relations>";
        let shifted = ring().replace("</relations>", relation).replace("</components>", &flank(49, -0.1));
        let found = read_pair(&shifted, 1, 1, &Starter::default()).unwrap();
        assert_eq!(found.starter.profile_shift, [0.23, -0.1]);
        assert!(found.remarks.iter().any(|said| said.contains("ISO 21771's sign")), "{:?}", found.remarks);
    }

    /// Each fault is told with its place and a hint; a file cut off anywhere ends in a message.
    #[test]
    fn what_is_wrong_is_told() {
        let said = |text: &str, stage| {
            let error = read_pair(text, stage, 1, &Starter::default()).map(|_| ()).expect_err("it is taken");
            assert!(error.hint().is_some(), "{error}");
            error.to_string()
        };
        assert_eq!(said(MODEL, 2), "has 1 cylindrical stages, stage 2 is wanted");
        assert_eq!(said(MODEL, 0), "has 1 cylindrical stages, stage 0 is wanted");
        assert_eq!(said("<other/>", 1), "is no REXS file: its root is <other>, not <model>");
        let inch = MODEL.replace("unit=\"mm\">4.5", "unit=\"inch\">4.5");
        assert_eq!(said(&inch, 1), "gear 5: `normal_module` is 4.5 inch, wanted is a number in mm");
        let broken = MODEL.replacen(">27<", ">27.9<", 1);
        assert_eq!(said(&broken, 1), "gear 5: `number_of_teeth` is 27.9, wanted is a whole number above 0");
        let rings = ring().replacen(">27<", ">-27<", 1);
        assert_eq!(said(&rings, 1), "gear 7 is a ring as its mating gear is");
        assert_eq!(
            said(&ring().replacen(">21<", ">-21<", 1), 1),
            "the gears differ in helix angle of the same hand: -21 and 21"
        );
        for value in ["NaN", "inf", "1e999"] {
            let attributes =
                [(">27<", "gear 5: `number_of_teeth`"), (">0.23<", "flank 48: `addendum_modification_coefficient`")];
            for (number, about) in attributes {
                let told = said(&MODEL.replacen(number, &format!(">{value}<"), 1), 1);
                assert!(told.starts_with(&format!("{about} is {value}")), "{told}");
            }
            let nowhere = MODEL.replacen("<c>-190</c>", &format!("<c>{value}</c>"), 1);
            assert_eq!(said(&nowhere, 1), "gear 7: `support_vector` is not three finite numbers in mm");
        }
        let metres = MODEL.replacen("id=\"support_vector\" unit=\"mm\"", "id=\"support_vector\" unit=\"m\"", 1);
        assert_eq!(said(&metres, 1), "gear 5: `support_vector` is not three finite numbers in mm");
        let many: String = (0..=ATTRIBUTES).map(|i| format!("a{i}='' ")).collect();
        assert_eq!(
            said(&format!("<model>\n<a {many}/></model>"), 1),
            "has an element of more than 10000 attributes in line 2"
        );
        let none = MODEL.replacen("number_of_teeth", "teeth", 1);
        assert_eq!(said(&none, 1), "gear 5 has no `number_of_teeth`");
        assert_eq!(
            said(&MODEL.replace(">-21<", ">21<"), 1),
            "the gears differ in helix angle of opposite hand: 21 and -21"
        );
        for at in (0..MODEL.len() - 8).step_by(7) {
            assert!(read_pair(&MODEL[..at], 1, 1, &Starter::default()).is_err(), "cut at {at}");
        }
    }
}
