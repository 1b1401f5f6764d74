//! Gear data from REXS files (Reusable Engineering EXchange Standard, rexs.info, versions 1.0 to 1.4 and on; XML).
//!
//! Read is what a pair begins with: a `cylindrical_stage` with its two gears and their flanks; shafts are read in
//! `rexs_shaft`. What is missing there keeps its default, and what the file has beside it (bearings, load spectra,
//! lubricants) is left alone.

use roxmltree::Node;

use crate::{
    RexsError, Starter,
    rexs_document::{Model, Part, parsed, reference, refers},
};

/// The pair of stage `stage` (counted from 1) of a REXS file; torque and speed are those of `from`.
///
/// # Errors
/// [`RexsError`].
pub fn read_pair(text: &str, stage: usize, from: &Starter) -> Result<Starter, RexsError> {
    let document = parsed(text)?;
    let model = Model::of(&document)?;
    let stages: Vec<Node<'_, '_>> =
        model.relations("stage").filter(|r| refers(*r, "stage", "cylindrical_stage")).collect();
    let wrong = RexsError::Stage { found: stages.len(), asked: stage };
    let relation = *stage.checked_sub(1).and_then(|i| stages.get(i)).ok_or(wrong)?;
    let of = |role: &'static str| {
        let id = reference(relation, role).ok_or(RexsError::Gear { stage, role })?;
        model.component(id).map(|node| Part { kind: "gear", id, node }).ok_or(RexsError::Gear { stage, role })
    };
    let (pinion, wheel) = (of("gear_1")?, of("gear_2")?);
    pair(&model, [pinion, wheel], stage, from)
}

fn pair(model: &Model<'_, '_>, gears: [Part<'_, '_>; 2], stage: usize, from: &Starter) -> Result<Starter, RexsError> {
    let both = |attribute, unit| -> Result<[f64; 2], RexsError> {
        Ok([gears[0].needed(attribute, unit)?, gears[1].needed(attribute, unit)?])
    };
    let modules = both("normal_module", "mm")?;
    alike("normal module", modules[0], modules[1])?;
    // Spur gears may leave it out.
    let helix_of = |i: usize| gears[i].number("helix_angle_reference_diameter", "deg").map(|b| b.unwrap_or(0.0));
    let helix = [helix_of(0)?, helix_of(1)?];
    alike("helix angle of opposite hand", helix[0], 0.0 - helix[1])?;
    let teeth = [gears[0].teeth()?, gears[1].teeth()?];
    let widths = both("face_width", "mm")?;
    let flanks = [0, 1].map(|i| model.flank(gears[i].id));
    let of_flank = |i: usize, attribute, unit| match &flanks[i] {
        Some(flank) => flank.number(attribute, unit),
        None => Ok(None),
    };
    let shift = [0, 1].map(|i| of_flank(i, "addendum_modification_coefficient", ""));
    let [x1, x2] = shift;
    let apart = apart(&gears)?;
    Ok(Starter {
        name: model.name(stage).unwrap_or_default(),
        teeth,
        module_mm: modules[0],
        helix_deg: helix[0],
        face_width_mm: widths[0].min(widths[1]),
        profile_shift: [x1?.unwrap_or(0.0), x2?.unwrap_or(0.0)],
        pressure_angle_deg: of_flank(0, "normal_pressure_angle", "deg")?,
        tip_diameter_mm: [gears[0].number("tip_diameter", "mm")?, gears[1].number("tip_diameter", "mm")?],
        own_face_width_mm: if widths[0] == widths[1] { [None, None] } else { widths.map(Some) },
        centre_distance_mm: apart.map(|[across, _]| across),
        mid_face_offset_mm: apart.map(|[_, along]| along).filter(|along| along.abs() > ONE_HEIGHT),
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

/// Distance of the axes, and how far the second gear stands above the first along its axis, mm, where both say so in the
/// same frame; a gear stands where its mid-face is.
fn apart(gears: &[Part<'_, '_>; 2]) -> Result<Option<[f64; 2]>, RexsError> {
    let frames = [0, 1].map(|i| gears[i].text("reference_component_for_position"));
    let places = [gears[0].vector("support_vector")?, gears[1].vector("support_vector")?];
    let axis = gears[0].vector("u_axis_vector")?;
    let ([Some(a), Some(b)], Some(axis)) = (places, axis) else { return Ok(None) };
    let apart = [0, 1, 2].map(|k| b[k] - a[k]);
    let along: f64 = (0..3).map(|k| apart[k] * axis[k]).sum::<f64>() / axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    let square = apart.iter().map(|x| x * x).sum::<f64>() - along * along;
    Ok((frames[0] == frames[1] && square > 0.0 && square.is_finite()).then(|| [square.sqrt(), along]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rexs_document::ATTRIBUTES;

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
        let found = read_pair(MODEL, 1, &Starter::default()).unwrap();
        assert_eq!((found.teeth, found.module_mm, found.helix_deg), ([27, 51], 4.5, 21.0));
        assert_eq!((found.face_width_mm, found.profile_shift), (48.0, [0.23, 0.0]));
        assert_eq!((found.pressure_angle_deg, found.centre_distance_mm), (Some(20.0), Some(190.0)));
        assert_eq!((found.torque_nm, found.name.as_str()), (150.0, "Test, stage 1"));
        assert_eq!((found.own_face_width_mm, found.mid_face_offset_mm), ([Some(50.0), Some(48.0)], Some(7.0)));
    }

    /// Each fault is told with its place and a way out; a file cut off anywhere ends in a message.
    #[test]
    fn what_is_wrong_is_told() {
        let said = |text: &str, stage| {
            let error = read_pair(text, stage, &Starter::default()).expect_err("it is taken");
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
        let negative = MODEL.replacen(">51<", ">-51<", 1);
        assert_eq!(said(&negative, 1), "gear 7: `number_of_teeth` is -51, wanted is a whole number above 0");
        for value in ["NaN", "inf", "1e999"] {
            let attributes =
                [(">27<", "gear 5: `number_of_teeth`"), (">0.23<", "gear 48: `addendum_modification_coefficient`")];
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
            assert!(read_pair(&MODEL[..at], 1, &Starter::default()).is_err(), "cut at {at}");
        }
    }
}
