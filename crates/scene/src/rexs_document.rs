//! A REXS file as components, relations and attributes with units.

use roxmltree::{Document, Node};

use crate::RexsError;

/// Attributes of an element at the most: each is compared with all before it. REXS has a handful.
pub(crate) const ATTRIBUTES: usize = 10_000;

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

/// The XML of a file.
pub(crate) fn parsed(text: &str) -> Result<Document<'_>, RexsError> {
    match crowded(text) {
        Some(line) => Err(RexsError::Crowded { line }),
        None => Ok(Document::parse(text.trim_start_matches('\u{feff}'))?),
    }
}

/// The file.
pub(crate) struct Model<'a, 'i>(Node<'a, 'i>);

impl<'a, 'i> Model<'a, 'i> {
    pub(crate) fn of(document: &'a Document<'i>) -> Result<Self, RexsError> {
        let root = document.root_element();
        match root.tag_name().name() {
            "model" => Ok(Self(root)),
            other => Err(RexsError::Root { root: other.to_owned() }),
        }
    }

    /// All components of a kind.
    pub(crate) fn components(&self, kind: &'static str) -> impl Iterator<Item = Node<'a, 'i>> {
        let all = self.0.children().find(|n| n.has_tag_name("components"));
        let own = all.into_iter().flat_map(|n| n.children()).filter(|n| n.has_tag_name("component"));
        own.filter(move |n| n.attribute("type") == Some(kind))
    }

    pub(crate) fn relations(&self, kind: &'static str) -> impl Iterator<Item = Node<'a, 'i>> {
        let all = self.0.children().find(|n| n.has_tag_name("relations"));
        all.into_iter().flat_map(|n| n.children()).filter(move |n| n.attribute("type") == Some(kind))
    }

    pub(crate) fn component(&self, id: &str) -> Option<Node<'a, 'i>> {
        let all = self.0.children().find(|n| n.has_tag_name("components"))?;
        all.children().find(|n| n.has_tag_name("component") && n.attribute("id") == Some(id))
    }

    /// Either flank of a gear: what is read of it is the same on both sides.
    pub(crate) fn flank(&self, gear: &str) -> Option<Part<'a, 'i>> {
        let relation = self.relations("flank").find(|r| reference(*r, "gear") == Some(gear))?;
        let id = reference(relation, "left").or_else(|| reference(relation, "right"))?;
        Some(Part { kind: "gear", id, node: self.component(id)? })
    }

    pub(crate) fn name(&self, stage: usize) -> Option<String> {
        let program = self.0.attribute("applicationId")?;
        Some(format!("{program}, stage {stage}"))
    }
}

/// Number of the component that has a role in a relation.
pub(crate) fn reference<'a>(relation: Node<'a, '_>, role: &str) -> Option<&'a str> {
    relation.children().find(|n| n.attribute("role") == Some(role))?.attribute("id")
}

pub(crate) fn refers(relation: Node<'_, '_>, role: &str, hint: &str) -> bool {
    relation.children().any(|n| n.attribute("role") == Some(role) && n.attribute("hint") == Some(hint))
}

/// A component.
pub(crate) struct Part<'a, 'i> {
    /// What messages call it.
    pub kind: &'static str,
    pub id: &'a str,
    pub node: Node<'a, 'i>,
}

impl Part<'_, '_> {
    fn named(&self) -> String {
        format!("{} {}", self.kind, self.id)
    }

    fn attribute(&self, name: &str) -> Option<Node<'_, '_>> {
        self.node.children().find(|n| n.has_tag_name("attribute") && n.attribute("id") == Some(name))
    }

    pub(crate) fn text(&self, name: &str) -> Option<&str> {
        self.attribute(name)?.text().map(str::trim)
    }

    pub(crate) fn number(&self, attribute: &'static str, wanted: &'static str) -> Result<Option<f64>, RexsError> {
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
                part: self.named(),
                attribute,
                value: value.to_owned(),
                unit: unit.to_owned(),
                wanted: if wanted.is_empty() { "no unit" } else { wanted },
            }),
        }
    }

    pub(crate) fn needed(&self, attribute: &'static str, unit: &'static str) -> Result<f64, RexsError> {
        self.number(attribute, unit)?.ok_or_else(|| RexsError::Missing { part: self.named(), attribute })
    }

    pub(crate) fn teeth(&self) -> Result<u32, RexsError> {
        let value = self.needed("number_of_teeth", "")?;
        let whole = value.fract() == 0.0 && (1.0..=f64::from(u32::MAX)).contains(&value);
        if whole { Ok(value as u32) } else { Err(RexsError::Teeth { part: self.named(), value }) }
    }

    /// Three lengths, mm.
    pub(crate) fn vector(&self, attribute: &'static str) -> Result<Option<[f64; 3]>, RexsError> {
        let Some(node) = self.attribute(attribute) else { return Ok(None) };
        let wrong = || RexsError::Vector { part: self.named(), attribute, wanted: "mm" };
        let array = node.children().find(|n| n.has_tag_name("array")).ok_or_else(wrong)?;
        let words = array.children().filter(Node::is_element).map(|n| n.text().unwrap_or_default().trim());
        let values: Vec<f64> = words.filter_map(|w| w.parse().ok()).filter(|v: &f64| v.is_finite()).collect();
        let in_mm = matches!(node.attribute("unit"), None | Some("mm"));
        let three = array.children().filter(Node::is_element).count() == 3 && in_mm;
        values.try_into().ok().filter(|_| three).map(Some).ok_or_else(wrong)
    }
}
