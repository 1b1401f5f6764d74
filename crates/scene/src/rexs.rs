//! Gear data from REXS files (Reusable Engineering EXchange Standard, rexs.info, versions 1.0 to 1.4 and on; XML).
//!
//! Read is what a pair begins with: a `cylindrical_stage` with its two gears and their flanks. What is missing there
//! keeps its default, and what the file has beside it (shafts, bearings, load spectra, lubricants) is left alone.

use roxmltree::{Document, Node};

use crate::Starter;

/// Why no pair comes out of a REXS file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RexsError {
    /// It is no XML.
    #[error("is no XML: {0}")]
    Xml(#[from] roxmltree::Error),
    /// An element that the reader of XML would take hours for.
    #[error("has an element of more than {ATTRIBUTES} attributes in line {line}")]
    Crowded {
        /// Line in which it begins, from 1.
        line: usize,
    },
    /// It is XML of another kind.
    #[error("is no REXS file: its root is <{root}>, not <model>")]
    Root {
        /// Name of the root.
        root: String,
    },
    /// It has no such stage.
    #[error("has {found} cylindrical stages, stage {asked} is wanted")]
    Stage {
        /// Stages that it has.
        found: usize,
        /// Counted from 1.
        asked: usize,
    },
    /// A stage without its two gears.
    #[error("stage {stage} has no {role}")]
    Gear {
        /// Counted from 1.
        stage: usize,
        /// `gear_1` or `gear_2`.
        role: &'static str,
    },
    /// A number that every gear has.
    #[error("gear {gear} has no `{attribute}`")]
    Missing {
        /// Number of its component.
        gear: String,
        /// Name of the attribute.
        attribute: &'static str,
    },
    /// A value that cannot be used.
    #[error("gear {gear}: `{attribute}` is {value} {unit}, wanted is a number in {wanted}")]
    Value {
        /// Number of its component.
        gear: String,
        /// Name of the attribute.
        attribute: &'static str,
        /// As written.
        value: String,
        /// As written.
        unit: String,
        /// Unit of the standard's data base.
        wanted: &'static str,
    },
    /// A number of teeth that no gear has.
    #[error("gear {gear}: `number_of_teeth` is {value}, wanted is a whole number above 0")]
    Teeth {
        /// Number of its component.
        gear: String,
        /// As read.
        value: f64,
    },
    /// A place or direction that is not three numbers.
    #[error("gear {gear}: `{attribute}` is not three finite numbers in {wanted}")]
    Vector {
        /// Number of its component.
        gear: String,
        /// Name of the attribute.
        attribute: &'static str,
        /// Unit of the standard's data base.
        wanted: &'static str,
    },
    /// Two gears that are no external pair.
    #[error("the gears differ in {what}: {pinion} and {wheel}")]
    Pair {
        /// In what.
        what: &'static str,
        /// Gear 1.
        pinion: f64,
        /// Gear 2.
        wheel: f64,
    },
}

impl RexsError {
    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        Some(match self {
            Self::Xml(_) | Self::Crowded { .. } | Self::Root { .. } => {
                "export the model as REXS in XML (`.rexs`), not packed (`.rexsz`) and not as JSON".into()
            }
            Self::Stage { found: 0, .. } => "only stages of cylindrical gears can be run".into(),
            Self::Stage { found, .. } => format!("give `--stage` 1 to {found}"),
            Self::Gear { .. } | Self::Missing { .. } => "export the whole model, gears and flanks with it".into(),
            Self::Value { .. } | Self::Vector { .. } => "export with the units of the standard's data base".into(),
            Self::Teeth { .. } => "correct the file: half a tooth is no tooth".into(),
            Self::Pair { .. } => "only external pairs of one module can be run".into(),
        })
    }
}

/// Attributes of an element at the most: each is compared with all before it. REXS has a handful.
const ATTRIBUTES: usize = 10_000;

/// Line of the first element with more attributes than that, by its equals signs: no `<` stands within an element.
fn crowded(text: &str) -> Option<usize> {
    let mut line = 1;
    for part in text.split('<') {
        if part.matches('=').nth(ATTRIBUTES).is_some() {
            return Some(line);
        }
        line += part.matches('\n').count();
    }
    None
}

/// The pair of stage `stage` (counted from 1) of a REXS file; torque and speed are those of `from`.
///
/// # Errors
/// [`RexsError`].
pub fn read_pair(text: &str, stage: usize, from: &Starter) -> Result<Starter, RexsError> {
    if let Some(line) = crowded(text) {
        return Err(RexsError::Crowded { line });
    }
    let document = Document::parse(text.trim_start_matches('\u{feff}'))?;
    let root = document.root_element();
    if root.tag_name().name() != "model" {
        return Err(RexsError::Root { root: root.tag_name().name().to_owned() });
    }
    let model = Model(root);
    let stages: Vec<Node<'_, '_>> =
        model.relations("stage").filter(|r| refers(*r, "stage", "cylindrical_stage")).collect();
    let wrong = RexsError::Stage { found: stages.len(), asked: stage };
    let relation = *stage.checked_sub(1).and_then(|i| stages.get(i)).ok_or(wrong)?;
    let of = |role: &'static str| {
        let id = reference(relation, role).ok_or(RexsError::Gear { stage, role })?;
        model.component(id).map(|node| Part { id, node }).ok_or(RexsError::Gear { stage, role })
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

/// The file.
struct Model<'a, 'i>(Node<'a, 'i>);

impl<'a, 'i> Model<'a, 'i> {
    fn relations(&self, kind: &'static str) -> impl Iterator<Item = Node<'a, 'i>> {
        let all = self.0.children().find(|n| n.has_tag_name("relations"));
        all.into_iter().flat_map(|n| n.children()).filter(move |n| n.attribute("type") == Some(kind))
    }

    fn component(&self, id: &str) -> Option<Node<'a, 'i>> {
        let all = self.0.children().find(|n| n.has_tag_name("components"))?;
        all.children().find(|n| n.has_tag_name("component") && n.attribute("id") == Some(id))
    }

    /// Either flank of a gear: what is read of it is the same on both sides.
    fn flank(&self, gear: &str) -> Option<Part<'a, 'i>> {
        let relation = self.relations("flank").find(|r| reference(*r, "gear") == Some(gear))?;
        let id = reference(relation, "left").or_else(|| reference(relation, "right"))?;
        Some(Part { id, node: self.component(id)? })
    }

    fn name(&self, stage: usize) -> Option<String> {
        let program = self.0.attribute("applicationId")?;
        Some(format!("{program}, stage {stage}"))
    }
}

/// Number of the component that has a role in a relation.
fn reference<'a>(relation: Node<'a, '_>, role: &str) -> Option<&'a str> {
    relation.children().find(|n| n.attribute("role") == Some(role))?.attribute("id")
}

fn refers(relation: Node<'_, '_>, role: &str, hint: &str) -> bool {
    relation.children().any(|n| n.attribute("role") == Some(role) && n.attribute("hint") == Some(hint))
}

/// A component.
struct Part<'a, 'i> {
    id: &'a str,
    node: Node<'a, 'i>,
}

impl Part<'_, '_> {
    fn attribute(&self, name: &str) -> Option<Node<'_, '_>> {
        self.node.children().find(|n| n.has_tag_name("attribute") && n.attribute("id") == Some(name))
    }

    fn text(&self, name: &str) -> Option<&str> {
        self.attribute(name)?.text().map(str::trim)
    }

    fn number(&self, attribute: &'static str, wanted: &'static str) -> Result<Option<f64>, RexsError> {
        let Some(node) = self.attribute(attribute) else { return Ok(None) };
        let unit = node.attribute("unit").unwrap_or_default();
        let value = node.text().unwrap_or_default().trim();
        let same = match wanted {
            "deg" => matches!(unit, "deg" | "\u{b0}"),
            "" => matches!(unit, "" | "none" | "-"),
            _ => unit == wanted,
        };
        match value.parse::<f64>().ok().filter(|v| v.is_finite() && same) {
            Some(number) => Ok(Some(number)),
            None => Err(RexsError::Value {
                gear: self.id.to_owned(),
                attribute,
                value: value.to_owned(),
                unit: unit.to_owned(),
                wanted: if wanted.is_empty() { "no unit" } else { wanted },
            }),
        }
    }

    fn needed(&self, attribute: &'static str, unit: &'static str) -> Result<f64, RexsError> {
        self.number(attribute, unit)?.ok_or_else(|| RexsError::Missing { gear: self.id.to_owned(), attribute })
    }

    fn teeth(&self) -> Result<u32, RexsError> {
        let value = self.needed("number_of_teeth", "")?;
        let whole = value.fract() == 0.0 && (1.0..=f64::from(u32::MAX)).contains(&value);
        if whole { Ok(value as u32) } else { Err(RexsError::Teeth { gear: self.id.to_owned(), value }) }
    }

    /// Three lengths, mm.
    fn vector(&self, attribute: &'static str) -> Result<Option<[f64; 3]>, RexsError> {
        let Some(node) = self.attribute(attribute) else { return Ok(None) };
        let wrong = || RexsError::Vector { gear: self.id.to_owned(), attribute, wanted: "mm" };
        let array = node.children().find(|n| n.has_tag_name("array")).ok_or_else(wrong)?;
        let words = array.children().filter(Node::is_element).map(|n| n.text().unwrap_or_default().trim());
        let values: Vec<f64> = words.filter_map(|w| w.parse().ok()).filter(|v: &f64| v.is_finite()).collect();
        let in_mm = matches!(node.attribute("unit"), None | Some("mm"));
        let three = array.children().filter(Node::is_element).count() == 3 && in_mm;
        values.try_into().ok().filter(|_| three).map(Some).ok_or_else(wrong)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
