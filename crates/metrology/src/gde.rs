//! Gear data exchange after VDI/VDE 2610 (XML), through a map of names.
//!
//! The schema is not public, and programs differ in what they call left and right (`datum_face`). So nothing is guessed:
//! the map names the elements and attributes that hold each thing, and what has no name in it is passed over.

use std::path::Path;

use geometry::Side;
use roxmltree::{Document, Node};
use serde::Deserialize;

use crate::MetrologyError;
use crate::measured_gear::{GearHeader, MeasuredGear, Trace, TraceKind};

/// Names in a file. Each is a path of element names below the element before, with `/`, and `@name` for an attribute at
/// its end: `GearData/Teeth`, `Trace/@tooth`. As a file they are keys of TOML, [`GdeNames::parse`].
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GdeNames {
    /// Number of teeth, from the root.
    pub teeth: String,
    /// Normal module, mm, from the root.
    pub normal_module: String,
    /// Helix angle, degrees, right hand positive, from the root.
    pub helix_angle: String,
    /// Normal pressure angle, degrees, from the root.
    pub pressure_angle: String,
    /// Elements of profiles, from the root; those of helices.
    pub profiles: String,
    /// Elements of helices, from the root.
    pub helices: String,
    /// Tooth, from a trace, and the number of the first tooth.
    pub tooth: String,
    /// What the first tooth is called; 1 unless a file says otherwise.
    #[serde(default = "one")]
    pub first_tooth: u32,
    /// Side, from a trace, and its words.
    pub side: String,
    /// Word for a left flank.
    pub left: String,
    /// Word for a right flank.
    pub right: String,
    /// Height of a profile (mm) or diameter of a helix (mm), from a trace.
    pub place: String,
    /// Start and end of a trace: diameters (mm) of a profile, heights (mm) of a helix, from a trace.
    pub from: String,
    /// End of the trace.
    pub to: String,
    /// Values, um, from a trace: one text with blanks, commas or semicolons between, or as many elements.
    pub values: String,
    /// What stands for a value that is none, besides words that are no number of their own (`nan`, `-`).
    #[serde(default)]
    pub undefined: Option<f64>,
}

fn one() -> u32 {
    1
}

impl GdeNames {
    /// Whether a number stands for no value: within 1e-6 of `undefined`.
    fn is_undefined(&self, value: f64) -> bool {
        self.undefined.is_some_and(|none| (value - none).abs() <= 1e-6 * none.abs())
    }

    /// Names of a file with the fields of [`GdeNames`] as keys; `path` is what messages name.
    ///
    /// # Errors
    /// [`MetrologyError::Names`] with file, line and what is missing, unknown or of another kind.
    pub fn parse(text: &str, path: &Path) -> Result<Self, MetrologyError> {
        let names: Self = toml::from_str(text).map_err(|e: toml::de::Error| MetrologyError::Names {
            path: path.to_owned(),
            line: e.span().map_or(1, |span| {
                1 + text.as_bytes()[..span.start.min(text.len())].iter().filter(|b| **b == b'\n').count()
            }),
            message: e.message().to_owned(),
        })?;
        if names.left == names.right {
            let message = format!("`left` and `right` are both `{}`", names.left);
            return Err(MetrologyError::Names { path: path.to_owned(), line: 1, message });
        }
        Ok(names)
    }
}

/// Reads the text of a file; `path` is what messages name. All profiles must have one range, and all helices.
///
/// # Errors
/// [`MetrologyError`] with file and line.
pub fn read_gde(text: &str, names: &GdeNames, path: &Path) -> Result<MeasuredGear, MetrologyError> {
    let document = Document::parse(text).map_err(|e| MetrologyError::Xml {
        path: path.to_owned(),
        line: e.pos().row as usize,
        message: e.to_string(),
    })?;
    let reader = Reader { document: &document, names, path };
    let root = document.root_element();
    let number = |name: &str, what| reader.number(root, name, what);
    let teeth = number(&names.teeth, "the number of teeth")?;
    let mut header = GearHeader {
        teeth: if (1.0..=10_000.0).contains(&teeth) && teeth.fract() == 0.0 { teeth as u32 } else { 0 },
        normal_module: number(&names.normal_module, "the normal module")?,
        helix_angle: number(&names.helix_angle, "the helix angle")?.to_radians(),
        pressure_angle: number(&names.pressure_angle, "the pressure angle")?.to_radians(),
        profile_shift: None,
        face_width: None,
        profile_evaluation: None,
        profile_measured: None,
        helix_evaluation: None,
        helix_measured: None,
    };
    if header.teeth == 0 {
        return Err(MetrologyError::Missing { path: path.to_owned(), what: "a whole number of teeth" });
    }
    let mut traces = Vec::new();
    for (name, kind) in
        [(&names.profiles, TraceKind::Profile as fn(f64) -> TraceKind), (&names.helices, TraceKind::Helix)]
    {
        for node in below(root, name) {
            let (trace, range) = reader.trace(node, kind, header.teeth)?;
            let all = match trace.kind {
                TraceKind::Profile(_) => &mut header.profile_measured,
                TraceKind::Helix(_) => &mut header.helix_measured,
            };
            if all.is_some_and(|all| all != range) {
                return Err(reader.fault(
                    node,
                    "the same start and end for all traces of a kind",
                    &format!("{range:?}"),
                ));
            }
            *all = Some(range);
            traces.push(trace);
        }
    }
    if traces.is_empty() {
        return Err(MetrologyError::Missing { path: path.to_owned(), what: "any trace of the names given" });
    }
    MeasuredGear { header, traces, pitch: Vec::new() }.checked(path)
}

/// Elements at a path below one.
fn below<'a, 'i>(from: Node<'a, 'i>, path: &str) -> Vec<Node<'a, 'i>> {
    let mut all = vec![from];
    for name in path.split('/').filter(|name| !name.is_empty() && !name.starts_with('@')) {
        all = all
            .into_iter()
            .flat_map(|node| node.children().filter(|child| child.is_element()).collect::<Vec<_>>())
            .filter(|child| child.tag_name().name() == name)
            .collect();
    }
    all
}

struct Reader<'a> {
    document: &'a Document<'a>,
    names: &'a GdeNames,
    path: &'a Path,
}

impl Reader<'_> {
    fn fault(&self, node: Node<'_, '_>, expected: &'static str, found: &str) -> MetrologyError {
        let line = self.document.text_pos_at(node.range().start).row as usize;
        MetrologyError::Syntax {
            path: self.path.to_owned(),
            line,
            expected,
            found: found.trim().chars().take(60).collect(),
        }
    }

    /// Texts at a path below an element.
    fn texts<'n>(&self, from: Node<'n, '_>, path: &str) -> Vec<String> {
        let attribute = path.rsplit('/').next().and_then(|last| last.strip_prefix('@'));
        let text = |node: Node<'_, '_>| match attribute {
            Some(name) => node.attribute(name).map(str::to_owned),
            None => node.text().map(str::to_owned),
        };
        below(from, path).into_iter().filter_map(text).collect()
    }

    fn text(&self, from: Node<'_, '_>, path: &str, what: &'static str) -> Result<String, MetrologyError> {
        let found = self.texts(from, path).into_iter().next();
        found.map(|text| text.trim().to_owned()).ok_or_else(|| self.fault(from, what, from.tag_name().name()))
    }

    fn number(&self, from: Node<'_, '_>, path: &str, what: &'static str) -> Result<f64, MetrologyError> {
        let text = self.text(from, path, what)?;
        text.parse::<f64>().ok().filter(|v| v.is_finite()).ok_or_else(|| self.fault(from, what, &text))
    }

    fn trace(
        &self,
        node: Node<'_, '_>,
        kind: fn(f64) -> TraceKind,
        teeth: u32,
    ) -> Result<(Trace, [f64; 2]), MetrologyError> {
        let names = self.names;
        let word = self.text(node, &names.tooth, "a tooth")?;
        let tooth = word.parse::<u32>().ok().and_then(|t| t.checked_sub(names.first_tooth)).filter(|t| *t < teeth);
        let tooth = tooth.ok_or_else(|| self.fault(node, "a tooth of the gear", &word))?;
        let word = self.text(node, &names.side, "a side")?;
        let side = match word.as_str() {
            own if own == names.left => Side::Left,
            own if own == names.right => Side::Right,
            own => return Err(self.fault(node, "a side by its names in the map", own)),
        };
        let place = self.number(node, &names.place, "the place of the trace")?;
        let [from, to] = [&names.from, &names.to].map(|name| self.number(node, name, "start and end of the trace"));
        let mut deviations_um = Vec::new();
        for text in self.texts(node, &names.values) {
            // Commas separate where nothing else does; with blanks between values they would be decimal marks.
            let mut apart = text.split(|c: char| c.is_whitespace() || c == ';').filter(|w| !w.is_empty());
            let decimal = |word: &&str| word.trim_end_matches(',').contains(',');
            if text.split_whitespace().count() > 1
                && let Some(word) = apart.find(decimal)
            {
                return Err(self.fault(node, "a number with a decimal point", word));
            }
            for word in text.split(|c: char| c.is_whitespace() || c == ',' || c == ';').filter(|w| !w.is_empty()) {
                let value = match word.parse::<f64>() {
                    Ok(value) => Some(value).filter(|v| v.is_finite() && !names.is_undefined(*v)),
                    Err(_) if word == "-" => None,
                    Err(_) => return Err(self.fault(node, "a number", word)),
                };
                deviations_um.push(value);
            }
        }
        Ok((Trace { kind: kind(place), tooth, side, deviations_um }, [from?, to?]))
    }
}
