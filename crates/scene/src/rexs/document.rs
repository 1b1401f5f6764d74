//! A REXS file as components, relations, load cases and attributes with units.

use std::{
    cell::{Cell, RefCell},
    collections::{BTreeMap, BTreeSet},
};

use roxmltree::{Document, Node};

use super::RexsError;

/// Attributes of an element at the most: each is compared with all before it. REXS has a handful.
pub(super) const ATTRIBUTES: usize = 10_000;

/// Mark of a component that is passed over.
const ALL: &str = "*";

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
pub(super) fn parsed(text: &str) -> Result<Document<'_>, RexsError> {
    let text = text.trim_start_matches('\u{feff}');
    if text.trim_start().starts_with('{') {
        return Err(RexsError::Json);
    }
    match crowded(text) {
        Some(line) => Err(RexsError::Crowded { most: ATTRIBUTES, line }),
        None => Ok(Document::parse(text)?),
    }
}

/// Components of the file by their numbers.
type Components<'a> = BTreeMap<&'a str, Node<'a, 'a>>;

/// The file, and what was taken of it.
pub(super) struct Model<'a> {
    root: Node<'a, 'a>,
    components: Components<'a>,
    /// Numbers of the components in the order of the file.
    order: Vec<&'a str>,
    cases: Vec<Node<'a, 'a>>,
    /// Values of the load case that was chosen; they go before those of the component.
    case: RefCell<Components<'a>>,
    chosen: Cell<Option<usize>>,
    /// Names of the attributes of each component that were looked at.
    taken: RefCell<BTreeMap<&'a str, BTreeSet<&'static str>>>,
}

/// All components that are children of a node, the first of each number.
fn components_in<'a>(parent: Node<'a, 'a>) -> impl Iterator<Item = (&'a str, Node<'a, 'a>)> {
    parent.children().filter(|n| n.has_tag_name("component")).filter_map(|n| Some((n.attribute("id")?, n)))
}

impl<'a> Model<'a> {
    pub(super) fn of(document: &'a Document<'a>) -> Result<Self, RexsError> {
        let root = document.root_element();
        let name = root.tag_name().name();
        if name != "model" {
            return Err(RexsError::Root { root: name.to_owned() });
        }
        let (mut components, mut order) = (Components::new(), Vec::new());
        for (id, node) in root.children().filter(|n| n.has_tag_name("components")).flat_map(components_in) {
            components.entry(id).or_insert_with(|| {
                order.push(id);
                node
            });
        }
        let spectra = root.children().filter(|n| n.has_tag_name("load_spectrum"));
        let cases = spectra.flat_map(|n| n.children()).filter(|n| n.has_tag_name("load_case")).collect();
        let (case, taken) = (RefCell::default(), RefCell::default());
        Ok(Self { root, components, order, cases, case, chosen: Cell::new(None), taken })
    }

    /// Takes the values of a load case, counted from 1; without any the file's own values stand.
    pub(super) fn choose(&self, case: usize) -> Result<(), RexsError> {
        if self.cases.is_empty() && case == 1 {
            return Ok(());
        }
        let wrong = RexsError::Case { found: self.cases.len(), asked: case };
        let node = *case.checked_sub(1).and_then(|i| self.cases.get(i)).ok_or(wrong)?;
        *self.case.borrow_mut() = components_in(node).collect();
        self.chosen.set(Some(case));
        Ok(())
    }

    /// Number of load cases.
    pub(super) fn cases(&self) -> usize {
        self.cases.len()
    }

    /// The standard's version that the file names.
    pub(super) fn version(&self) -> &'a str {
        self.root.attribute("version").unwrap_or_default()
    }

    /// Program that wrote the file.
    pub(super) fn program(&self) -> Option<&'a str> {
        self.root.attribute("applicationId")
    }

    /// Numbers and nodes of all components, in the order of the file.
    pub(super) fn all(&self) -> impl Iterator<Item = (&'a str, Node<'a, 'a>)> {
        self.order.iter().filter_map(|id| Some((*id, *self.components.get(id)?)))
    }

    /// All components of a kind.
    pub(super) fn parts<'m>(&'m self, kind: &'static str, called: &'static str) -> impl Iterator<Item = Part<'m, 'a>> {
        let own = self.all().filter(move |(_, n)| n.attribute("type") == Some(kind));
        own.map(move |(id, node)| Part { kind: called, id, node, model: self })
    }

    pub(super) fn relations(&self, kind: &'static str) -> impl Iterator<Item = Node<'a, 'a>> {
        let all = self.root.children().filter(|n| n.has_tag_name("relations"));
        all.flat_map(|n| n.children()).filter(move |n| n.attribute("type") == Some(kind))
    }

    /// Relations of parts with what they are parts of.
    pub(super) fn assemblies(&self) -> impl Iterator<Item = Node<'a, 'a>> {
        self.relations("assembly").chain(self.relations("ordered_assembly"))
    }

    /// The component of a number, as messages call it.
    pub(super) fn part<'m>(&'m self, called: &'static str, id: &str) -> Option<Part<'m, 'a>> {
        let (id, node) = self.components.get_key_value(id)?;
        Some(Part { kind: called, id, node: *node, model: self })
    }

    /// Whether the component that has a role in a relation is of a kind, by its hint or by itself.
    pub(super) fn refers(&self, relation: Node<'_, '_>, role: &str, kind: &str) -> bool {
        let Some(own) = relation.children().find(|n| n.attribute("role") == Some(role)) else { return false };
        let component = own.attribute("id").and_then(|id| self.components.get(id)).and_then(|n| n.attribute("type"));
        own.attribute("hint").or(component) == Some(kind)
    }

    /// Whether an attribute of a component was looked at.
    pub(super) fn is_taken(&self, id: &str, attribute: &str) -> bool {
        self.taken.borrow().get(id).is_some_and(|names| names.contains(attribute) || names.contains(ALL))
    }

    /// A component that is as another one, of which all was looked at.
    pub(super) fn pass_over(&self, id: &'a str) {
        self.taken.borrow_mut().entry(id).or_default().insert(ALL);
    }

    /// What was looked at and not used after all.
    pub(super) fn forget(&self, id: &str, attribute: &str) {
        if let Some(names) = self.taken.borrow_mut().get_mut(id) {
            names.remove(attribute);
        }
    }

    /// Values of the chosen load case.
    pub(super) fn case_values(&self) -> Vec<(&'a str, Node<'a, 'a>)> {
        self.case.borrow().iter().map(|(id, node)| (*id, *node)).collect()
    }

    /// Load case whose values are taken.
    pub(super) fn chosen(&self) -> Option<usize> {
        self.chosen.get()
    }
}

/// Number of the component that has a role in a relation.
pub(super) fn reference<'a>(relation: Node<'a, '_>, role: &str) -> Option<&'a str> {
    relation.children().find(|n| n.attribute("role") == Some(role))?.attribute("id")
}

/// A component.
#[derive(Clone, Copy)]
pub(super) struct Part<'m, 'a> {
    /// What messages call it.
    pub kind: &'static str,
    pub id: &'a str,
    node: Node<'a, 'a>,
    model: &'m Model<'a>,
}

impl<'a> Part<'_, 'a> {
    /// Kind and number of the part, for messages.
    pub(super) fn named(&self) -> String {
        format!("{} {}", self.kind, self.id)
    }

    /// The type of the standard that it has.
    pub(super) fn component(&self) -> &'a str {
        self.node.attribute("type").unwrap_or_default()
    }

    /// The name that its author gave it.
    pub(super) fn name(&self) -> Option<&'a str> {
        self.node.attribute("name").map(str::trim).filter(|name| !name.is_empty())
    }

    fn attribute(&self, name: &'static str) -> Option<Node<'a, 'a>> {
        self.model.taken.borrow_mut().entry(self.id).or_default().insert(name);
        let of = |node: Node<'a, 'a>| {
            node.children().find(|n| n.has_tag_name("attribute") && n.attribute("id") == Some(name))
        };
        let case = self.model.case.borrow().get(self.id).copied();
        case.and_then(of).or_else(|| of(self.node))
    }

    pub(super) fn text(&self, name: &'static str) -> Option<&'a str> {
        self.attribute(name)?.text().map(str::trim)
    }

    /// Whether an attribute says no: alone, or as a list of which the first counts.
    pub(super) fn is_off(&self, name: &'static str) -> bool {
        let Some(node) = self.attribute(name) else { return false };
        let first = node.descendants().filter_map(|n| n.text().map(str::trim)).find(|text| !text.is_empty());
        first == Some("false")
    }

    pub(super) fn number(&self, attribute: &'static str, wanted: &'static str) -> Result<Option<f64>, RexsError> {
        let Some(node) = self.attribute(attribute) else { return Ok(None) };
        let unit = node.attribute("unit").unwrap_or_default();
        let value = node.text().unwrap_or_default().trim();
        let same = match wanted {
            "deg" => matches!(unit, "deg" | "\u{b0}"),
            "" => matches!(unit, "" | "none" | "-"),
            "mum" => matches!(unit, "mum" | "um" | "\u{b5}m" | "\u{3bc}m"),
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

    /// The first of some attributes that the component has: a quantity had other names in other versions.
    pub(super) fn first(&self, attributes: &[&'static str], unit: &'static str) -> Result<Option<f64>, RexsError> {
        let mut found = None;
        for attribute in attributes {
            let own = self.number(attribute, unit)?;
            found = found.or(own);
        }
        Ok(found)
    }

    pub(super) fn needed(&self, attribute: &'static str, unit: &'static str) -> Result<f64, RexsError> {
        self.number(attribute, unit)?.ok_or_else(|| RexsError::Missing { part: self.named(), attribute })
    }

    /// Three lengths, mm.
    pub(super) fn vector(&self, attribute: &'static str) -> Result<Option<[f64; 3]>, RexsError> {
        let Some(node) = self.attribute(attribute) else { return Ok(None) };
        let wrong = || RexsError::Vector { part: self.named(), attribute, wanted: "mm" };
        let array = node.children().find(|n| n.has_tag_name("array")).ok_or_else(wrong)?;
        let numbers = array.children().filter(Node::is_element).filter_map(|c| c.text()?.trim().parse::<f64>().ok());
        let values: Vec<f64> = numbers.filter(|x| x.is_finite()).collect();
        let in_mm = matches!(node.attribute("unit"), None | Some("mm"));
        let three = array.children().filter(Node::is_element).count() == 3 && in_mm;
        values.try_into().ok().filter(|_| three).map(Some).ok_or_else(wrong)
    }
}
