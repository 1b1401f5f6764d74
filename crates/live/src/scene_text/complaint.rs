//! Which keys of a text a complaint is about.

use scene::{Place, SceneError};
use toml_edit::{Document, TableLike};

/// Keys with dots, as the form has them; none where the complaint is about no key, or about one that no scene has.
pub(crate) fn keys_of(text: &str, error: &SceneError) -> Vec<String> {
    let (place, named) = match error {
        SceneError::WrongType { place, key, .. }
        | SceneError::OutOfRange { place, key, .. }
        | SceneError::NotYet { place, key, .. } => (Some(place), Some(key.as_str())),
        SceneError::Conflict { place, .. } | SceneError::Syntax { place, .. } => (Some(place), None),
        SceneError::Geometry { place, .. } => (place.as_ref(), None),
        SceneError::Missing { keys, .. } => return keys.iter().map(|key| dotted(key)).collect(),
        _ => (None, None),
    };
    let Some(Place::Line(line)) = place else { return Vec::new() };
    let there = on_line(text, line.number);
    let is_named = |key: &&String| named.is_none_or(|name| key.rsplit('.').next() == Some(name));
    there.iter().find(is_named).or(there.first()).cloned().into_iter().collect()
}

/// `` `[pinion] teeth` `` as `pinion.teeth`.
fn dotted(key: &str) -> String {
    key.trim_matches('`').replacen('[', "", 1).replacen("] ", ".", 1)
}

/// Keys of which something stands on a line, counted from 1; those of the innermost tables first.
fn on_line(text: &str, number: usize) -> Vec<String> {
    let start = text.split_inclusive('\n').take(number.saturating_sub(1)).map(str::len).sum::<usize>();
    let end = start + text[start.min(text.len())..].find('\n').unwrap_or(text.len().saturating_sub(start));
    let mut found = Vec::new();
    if let Ok(document) = Document::parse(text) {
        walk("", document.as_table(), [start, end], &mut found);
    }
    found
}

fn walk(path: &str, table: &dyn TableLike, line: [usize; 2], found: &mut Vec<String>) {
    for (name, item) in table.iter() {
        let key = if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
        if let Some(inner) = item.as_table_like() {
            walk(&key, inner, line, found);
            continue;
        }
        let start = table.key(name).and_then(toml_edit::Key::span).map(|s| s.start);
        let span = item.span().map(|s| [start.unwrap_or(s.start), s.end]);
        if span.is_some_and(|[from, to]| from <= line[1] && to >= line[0]) {
            found.push(key);
        }
    }
}

#[cfg(test)]
mod tests {
    use scene::Scene;

    use super::*;

    const TEXT: &str = "[pinion]\nteeth = 30\nhelix_angle_deg = 20.0\n[wheel]\nteeth = 30\nmesher = { order = 2, elements_rim = 3 }\n\
        [pair]\nnormal_module_mm = 3.0\nface_width_mm = 20.0\n[operation]\ntorque_nm = 150.0\n";

    fn keys(text: &str) -> Vec<String> {
        keys_of(text, &Scene::parse(text, "a.toml".as_ref()).expect_err("a complaint"))
    }

    #[test]
    fn a_complaint_finds_its_key() {
        let out_of_range = TEXT.replace("torque_nm = 150.0", "torque_nm = -1.0");
        assert_eq!(keys(&out_of_range), ["operation.torque_nm"]);
        assert_eq!(keys(&TEXT.replace("elements_rim = 3", "elements_rim = 0")), ["wheel.mesher.elements_rim"]);
        assert_eq!(keys(&TEXT.replace("face_width_mm = 20.0", "face_width_mm = \"wide\"")), ["pair.face_width_mm"]);
        assert_eq!(keys(&TEXT.replacen("teeth = 30\n", "", 1)), ["pinion.teeth"]);
        let half = TEXT.replace("[wheel]", "modification = { tip_relief_um = 5.0 }\n[wheel]");
        assert_eq!(keys(&half), ["pinion.modification.tip_relief_um"]);
        assert_eq!(keys(&TEXT.replace("teeth = 30\nhelix", "teeht = 30\nhelix")), [""; 0], "no key of the form");
    }
}
