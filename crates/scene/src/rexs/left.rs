//! Parts of a REXS file that were not used, as text: each kind of component once.

use std::collections::{BTreeMap, BTreeSet};

use roxmltree::Node;

use super::document::Model;

/// Attributes of a kind that are named; of more the number.
const NAMED: usize = 8;
/// Components of a kind whose numbers are told.
const NUMBERED: usize = 6;

/// Attributes that say how a file is drawn and ordered, and nothing of a gearbox.
const DRAWN: &[&str] = &[
    "display_color",
    "reference_component_for_position",
    "u_axis_vector",
    "w_axis_vector",
    "support_vector",
    "modification_date",
    "number_of_gears",
    "gear_shift_index",
    "name",
    "manufacturer",
    "catalogue_designation",
    "material_designation",
];

/// What is left of one kind of component.
#[derive(Default)]
struct Kind<'a> {
    ids: Vec<&'a str>,
    seen: BTreeSet<&'a str>,
    /// Value of each attribute, where all components have the same.
    values: BTreeMap<&'a str, Option<String>>,
}

/// A line for each kind of component that says something which was not looked at: amounts of 0 and what is off say
/// nothing.
pub(super) fn left(model: &Model<'_>) -> Vec<String> {
    let mut kinds: BTreeMap<&str, Kind<'_>> = BTreeMap::new();
    for (id, node) in model.all().chain(model.case_values()) {
        let said = attributes(node).filter(|(name, _)| !model.is_taken(id, name));
        for (name, value) in said {
            let own = kinds.entry(node.attribute("type").unwrap_or("component")).or_default();
            if own.seen.insert(id) {
                own.ids.push(id);
            }
            let seen = own.values.entry(name).or_insert_with(|| Some(value.clone()));
            if seen.as_ref() != Some(&value) {
                *seen = None;
            }
        }
    }
    kinds.iter().map(|(kind, own)| line(kind, own)).collect()
}

fn line(kind: &str, own: &Kind<'_>) -> String {
    let more = |all: usize, told: usize| if all > told { format!(" and {} more", all - told) } else { String::new() };
    let ids = own.ids.iter().take(NUMBERED).copied().collect::<Vec<_>>().join(", ");
    let one = |(name, value): (&&str, &Option<String>)| match value {
        Some(value) if !value.is_empty() => format!("`{name}` ({value})"),
        _ => format!("`{name}`"),
    };
    let names = own.values.iter().take(NAMED).map(one).collect::<Vec<_>>().join(", ");
    format!("{kind} {ids}{}: {names}{}", more(own.ids.len(), NUMBERED), more(own.values.len(), NAMED))
}

/// Names and values, with units, of a component's attributes that say something.
fn attributes<'a>(node: Node<'a, 'a>) -> impl Iterator<Item = (&'a str, String)> {
    node.children().filter(|n| n.has_tag_name("attribute")).filter_map(|n| {
        let name = n.attribute("id")?;
        let value = n.text().unwrap_or_default().trim();
        let is_list = n.children().any(|c| c.is_element());
        let says_nothing = value.parse::<f64>().is_ok_and(|x| x == 0.0) || matches!(value, "" | "false" | "0");
        if DRAWN.contains(&name) || name.starts_with("custom_") || (says_nothing && !is_list) {
            return None;
        }
        let unit = n.attribute("unit").filter(|u| !matches!(*u, "" | "none" | "-")).unwrap_or_default();
        // A value may be a text of any length.
        let short: String = value.chars().take(40).collect();
        Some((name, if is_list { String::new() } else { format!("{short} {unit}").trim().to_owned() }))
    })
}
