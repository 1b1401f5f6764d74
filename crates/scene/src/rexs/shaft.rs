//! Shafts from REXS files (rexs.info, components and attributes of the versions 1.0 to 1.4): their sections and
//! material.
//!
//! | component | attribute | unit |
//! |---|---|---|
//! | `shaft_section`, part of a `shaft` | `u_coordinate_on_shaft`, `length` | mm |
//! | | `outer_diameter_begin`, `outer_diameter_end`, `inner_diameter_begin`, `inner_diameter_end` | mm |
//! | `material`, referenced by the `shaft` | `elastic_modulus`, `poisson_ratio`, `density` | N / mm^2, none, kg / dm^3 |
//!
//! The position of the shaft, the parts on it and its loads are not read.

use super::{
    RexsError,
    document::{Model, Part, parsed, reference},
};

/// A shaft of a REXS file.
#[derive(Debug, Clone, PartialEq)]
pub struct RexsShaft {
    /// Length, outer and inner diameter of each section, mm, from its beginning; cones are approximated by steps.
    pub sections: Vec<[f64; 3]>,
    /// Young's modulus, MPa.
    pub young_mpa: Option<f64>,
    /// Poisson's ratio.
    pub poisson: Option<f64>,
    /// Density, kg/m^3.
    pub density_kg_m3: Option<f64>,
}

/// Share by which steps bend and twist a cone otherwise, at the most.
const STEPPED: f64 = 5e-3;
/// Steps of a cone at the most; one that needs more ends in a point.
const MOST_STEPS: usize = 24;
/// Places of a cone at which its compliance is added up, against which steps are held.
const FINE: usize = 2000;
/// Gap between sections that is the digits of a file, mm.
const DIGITS: f64 = 1e-3;

/// A section as written.
struct Section {
    id: String,
    from: Option<f64>,
    order: f64,
    length: f64,
    outer: [f64; 2],
    inner: [f64; 2],
}

/// The shaft with a number or a name; without it the only shaft of the file.
///
/// # Errors
/// [`RexsError`].
pub fn read_shaft(text: &str, which: Option<&str>) -> Result<RexsShaft, RexsError> {
    let document = parsed(text)?;
    let model = Model::of(&document)?;
    let all: Vec<(&str, &str)> = model.parts("shaft", "shaft").map(|s| (s.id, s.name().unwrap_or_default())).collect();
    let matching: Vec<&str> =
        all.iter().filter(|(id, name)| which.is_none_or(|w| w == *id || w == *name)).map(|s| s.0).collect();
    let [shaft] = matching[..] else {
        let asked = which.map_or_else(|| "to choose".into(), |w| format!("\"{w}\" alone"));
        let named = |(id, name): &(&str, &str)| format!("{id} \"{name}\"");
        let found = if all.is_empty() { "none".into() } else { all.iter().map(named).collect::<Vec<_>>().join(", ") };
        return Err(RexsError::Shaft { asked, found });
    };
    shaft_of(&model, shaft)
}

/// The shaft of a number.
pub(super) fn shaft_of(model: &Model<'_>, shaft: &str) -> Result<RexsShaft, RexsError> {
    let mut sections = sections(model, shaft)?;
    in_order(shaft, &mut sections)?;
    let steps = sections.iter().map(|own| stepped(shaft, own)).collect::<Result<Vec<_>, _>>()?;
    let [young_mpa, poisson, density_kg_m3] = material(model, shaft)?;
    Ok(RexsShaft { sections: steps.concat(), young_mpa, poisson, density_kg_m3 })
}

fn sections(model: &Model<'_>, shaft: &str) -> Result<Vec<Section>, RexsError> {
    let is_own = |r: &roxmltree::Node<'_, '_>| {
        reference(*r, "assembly") == Some(shaft) && model.refers(*r, "part", "shaft_section")
    };
    let own = model.assemblies().filter(is_own);
    let one = |relation: roxmltree::Node<'_, '_>| {
        let id = reference(relation, "part").unwrap_or_default().to_owned();
        let Some(part) = model.part("shaft section", &id) else {
            let what = format!("has a section {id} that is not a component");
            return Err(RexsError::Sections { shaft: shaft.to_owned(), what });
        };
        let both = |begin, end, default: Option<f64>| -> Result<[f64; 2], RexsError> {
            let first = match default {
                Some(usual) => part.number(begin, "mm")?.unwrap_or(usual),
                None => part.needed(begin, "mm")?,
            };
            Ok([first, part.number(end, "mm")?.unwrap_or(first)])
        };
        Ok(Section {
            from: part.number("u_coordinate_on_shaft", "mm")?,
            order: relation.attribute("order").and_then(|o| o.parse().ok()).unwrap_or(0.0),
            length: part.needed("length", "mm")?,
            outer: both("outer_diameter_begin", "outer_diameter_end", None)?,
            inner: both("inner_diameter_begin", "inner_diameter_end", Some(0.0))?,
            id,
        })
    };
    own.map(one).collect()
}

/// Sorts them along the shaft, and sees that they follow on each other.
fn in_order(shaft: &str, sections: &mut [Section]) -> Result<(), RexsError> {
    let wrong = |what: String| Err(RexsError::Sections { shaft: shaft.to_owned(), what });
    if sections.is_empty() {
        return wrong("has no sections".into());
    }
    if sections.iter().any(|s| s.from.is_none()) {
        // Without places along the shaft their order is that of the file.
        sections.sort_by(|a, b| a.order.total_cmp(&b.order));
        return Ok(());
    }
    let begin = |s: &Section| s.from.unwrap_or(0.0);
    sections.sort_by(|a, b| begin(a).total_cmp(&begin(b)));
    let mut at = 0.0;
    for own in sections {
        if (begin(own) - at).abs() > DIGITS {
            return wrong(format!("has a section {} that begins at {} mm and not at {at} mm", own.id, begin(own)));
        }
        at += own.length;
    }
    Ok(())
}

/// A section as steps: those of a cone have its diameters in their middles, and are as many as keep its compliance.
fn stepped(shaft: &str, own: &Section) -> Result<Vec<[f64; 3]>, RexsError> {
    let wrong = |what: &str| {
        let what = format!("has a section {} {what}", own.id);
        Err(RexsError::Sections { shaft: shaft.to_owned(), what })
    };
    let is_round = (0..2).all(|end| own.outer[end] > own.inner[end] && own.inner[end] >= 0.0);
    if !(own.length > 0.0 && is_round) {
        return wrong("without length, or that is not wider outside than inside");
    }
    let at = |ends: [f64; 2], share: f64| ends[0] + (ends[1] - ends[0]) * share;
    let compliance = |steps: usize| {
        let place = |i: usize| (i as f64 + 0.5) / steps as f64;
        let one = |i: usize| 1.0 / (at(own.outer, place(i)).powi(4) - at(own.inner, place(i)).powi(4));
        (0..steps).map(one).sum::<f64>() / steps as f64
    };
    let whole = compliance(FINE);
    let Some(steps) = (1..=MOST_STEPS).find(|n| (compliance(*n) / whole - 1.0).abs() <= STEPPED) else {
        return wrong("that ends nearly in a point");
    };
    let step = |i: usize| {
        let share = (i as f64 + 0.5) / steps as f64;
        [own.length / steps as f64, at(own.outer, share), at(own.inner, share)]
    };
    Ok((0..steps).map(step).collect())
}

/// Young's modulus (MPa), Poisson's ratio and density (kg/m^3) of the material that a component refers to.
pub(super) fn material(model: &Model<'_>, id: &str) -> Result<[Option<f64>; 3], RexsError> {
    let is_own =
        |r: &roxmltree::Node<'_, '_>| reference(*r, "origin") == Some(id) && model.refers(*r, "referenced", "material");
    let own = model.relations("reference").find(is_own).and_then(|r| reference(r, "referenced"));
    let Some(part) = own.and_then(|id| model.part("material", id)) else { return Ok([None; 3]) };
    let of = |attribute, unit| Part::number(&part, attribute, unit);
    let density = of("density", "kg / dm^3")?.map(|rho| 1e3 * rho);
    Ok([of("elastic_modulus", "N / mm^2")?, of("poisson_ratio", "")?, density])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two shafts as the standard's pages describe them: a stepped one, hollow and conical, of another steel.
    const MODEL: &str = r#"<model version="1.4">
 <relations>
  <relation id="1" type="assembly"><ref id="7" role="assembly" hint="shaft"/><ref id="12" role="part" hint="shaft_section"/></relation>
  <relation id="2" type="assembly"><ref id="7" role="assembly" hint="shaft"/><ref id="11" role="part" hint="shaft_section"/></relation>
  <relation id="3" type="assembly"><ref id="7" role="assembly" hint="shaft"/><ref id="30" role="part" hint="cylindrical_gear"/></relation>
  <relation id="4" type="reference"><ref id="7" role="origin" hint="shaft"/><ref id="20" role="referenced" hint="material"/></relation>
  <relation id="5" type="assembly"><ref id="8" role="assembly" hint="shaft"/><ref id="13" role="part" hint="shaft_section"/></relation>
 </relations>
 <components>
  <component id="7" type="shaft" name="input"/>
  <component id="8" type="shaft" name="output"/>
  <component id="11" type="shaft_section"><attribute id="u_coordinate_on_shaft" unit="mm">0</attribute><attribute id="length" unit="mm">40</attribute>
   <attribute id="outer_diameter_begin" unit="mm">30</attribute><attribute id="outer_diameter_end" unit="mm">30</attribute>
   <attribute id="inner_diameter_begin" unit="mm">10</attribute><attribute id="inner_diameter_end" unit="mm">10</attribute></component>
  <component id="12" type="shaft_section"><attribute id="u_coordinate_on_shaft" unit="mm">40</attribute><attribute id="length" unit="mm">60</attribute>
   <attribute id="outer_diameter_begin" unit="mm">30</attribute><attribute id="outer_diameter_end" unit="mm">45</attribute></component>
  <component id="13" type="shaft_section"><attribute id="length" unit="mm">80</attribute><attribute id="outer_diameter_begin" unit="mm">50</attribute></component>
  <component id="20" type="material"><attribute id="elastic_modulus" unit="N / mm^2">210000</attribute>
   <attribute id="poisson_ratio" unit="">0.29</attribute><attribute id="density" unit="kg / dm^3">7.8</attribute></component>
 </components>
</model>"#;

    #[test]
    fn a_shaft_is_read_with_its_steel() {
        let found = read_shaft(MODEL, Some("input")).unwrap();
        assert_eq!(found, read_shaft(MODEL, Some("7")).unwrap());
        assert_eq!((found.young_mpa, found.poisson, found.density_kg_m3), (Some(2.1e5), Some(0.29), Some(7800.0)));
        assert_eq!(found.sections[0], [40.0, 30.0, 10.0]);
        let cone = &found.sections[1..];
        let length: f64 = cone.iter().map(|s| s[0]).sum();
        assert!((length - 60.0).abs() < 1e-12 && cone.windows(2).all(|w| w[1][1] > w[0][1]), "{cone:?}");
        let other = read_shaft(MODEL, Some("output")).unwrap();
        assert_eq!((other.sections, other.young_mpa), (vec![[80.0, 50.0, 0.0]], None));
    }

    /// Steps of a cone bend as the cone: the integral of 1/d^4 in closed form, to half a per cent.
    #[test]
    fn steps_bend_as_the_cone() {
        let steps = &read_shaft(MODEL, Some("7")).unwrap().sections[1..];
        let own: f64 = steps.iter().map(|s| s[0] / s[1].powi(4)).sum();
        let exact = 60.0 / (3.0 * 15.0) * (30f64.powi(-3) - 45f64.powi(-3));
        assert!((own / exact - 1.0).abs() <= 5e-3 && steps.len() > 2, "{own} beside {exact}, {} steps", steps.len());
    }

    /// Each fault is told with its place and a hint; a file cut off anywhere ends in a message.
    #[test]
    fn what_is_wrong_is_told() {
        let said = |text: &str, which: Option<&str>| {
            let error = read_shaft(text, which).expect_err("it is taken");
            assert!(error.hint().is_some(), "{error}");
            error.to_string()
        };
        assert_eq!(said(MODEL, None), "has no shaft to choose: there are 7 \"input\", 8 \"output\"");
        assert!(said(MODEL, Some("middle")).starts_with("has no shaft \"middle\" alone: there are 7"));
        assert!(said("<model/>", None).ends_with("there are none"));
        let with = |from: &str, to: &str| {
            assert!(MODEL.contains(from), "{from}");
            said(&MODEL.replacen(from, to, 1), Some("7"))
        };
        let gap = "<attribute id=\"u_coordinate_on_shaft\" unit=\"mm\">40<";
        assert_eq!(
            with(gap, &gap.replace("40", "41")),
            "shaft 7 has a section 12 that begins at 41 mm and not at 40 mm"
        );
        assert_eq!(
            with("unit=\"mm\">60<", "unit=\"m\">60<"),
            "shaft section 12: `length` is 60 m, wanted is a number in mm"
        );
        assert!(with(">45<", ">0.01<").contains("nearly in a point"));
        assert!(with(">10<", ">35<").contains("wider outside than inside"));
        assert!(with("unit=\"mm\">60<", "unit=\"mm\">-60<").contains("without length"));
        assert!(with("N / mm^2", "GPa").contains("`elastic_modulus` is 210000 GPa"));
        assert!(with("id=\"11\" type", "id=\"19\" type").contains("section 11 that is not a component"));
        let none = MODEL.replace("hint=\"shaft_section\"", "hint=\"gear\"");
        assert_eq!(said(&none, Some("7")), "shaft 7 has no sections");
        for at in (0..MODEL.len() - 8).step_by(7) {
            assert!(read_shaft(&MODEL[..at], Some("7")).is_err(), "cut at {at}");
        }
    }
}
