//! Keys of a scene's text changed one by one: comments, order and all other keys stay.

use std::collections::BTreeMap;

use toml_edit::{Array, DocumentMut, Item, Table, TableLike, Value};

use crate::fault::Fault;

/// Parts of a key at most; the deepest of a scene has four.
const DEEPEST: usize = 8;

/// Keys that are set beside a text at most; a scene has some hundred.
const MOST: usize = 1000;

/// A text with some keys set otherwise. Each key has dots (`operation.torque_nm`) and its value as it is typed: what is
/// no TOML is a text, and so is all that `is_text` says of; nothing takes the key away.
///
/// A text that is no TOML comes back as it is: reading it complains in the scene's own words.
///
/// # Errors
/// A key below something that is no table, or of more parts than any scene has; more keys than that.
pub(crate) fn changed(
    text: &str,
    changes: &BTreeMap<String, String>,
    is_text: impl Fn(&str) -> bool,
) -> Result<String, Fault> {
    if changes.len() > MOST {
        let message = format!("{} keys cannot be set beside the text of a scene, {MOST} at most", changes.len());
        return Err(Fault::new(message, "change them in the text of the scene"));
    }
    let Ok(mut document) = text.parse::<DocumentMut>() else { return Ok(text.to_owned()) };
    for (key, typed) in changes {
        let parts: Vec<&str> = key.split('.').collect();
        if parts.len() > DEEPEST {
            let message = format!("a key of {} parts cannot be set; a scene has {DEEPEST} at most", parts.len());
            return Err(Fault::new(message, "see all keys of the scene in the form").about(key));
        }
        let value = match typed.trim() {
            "" => None,
            text if is_text(key) => Some(Value::from(text)),
            typed => Some(typed.parse().unwrap_or_else(|_| Value::from(typed))),
        };
        if !put(document.as_table_mut(), &parts, value) {
            let message = format!("`{key}` cannot be set: what stands before a dot is not a table in this scene");
            return Err(Fault::new(message, "change it in the text of the scene").about(key));
        }
    }
    Ok(document.to_string())
}

/// Whether it could be done. A number among the parts counts the entries of a list of tables; below the scene of a mesh
/// that is a file of its own, a key stands in the list `set` of that mesh.
fn put(table: &mut dyn TableLike, parts: &[&str], value: Option<Value>) -> bool {
    let Some((first, rest)) = parts.split_first() else { return false };
    if rest.is_empty() {
        match (table.get_mut(first), value) {
            (Some(Item::Value(old)), Some(mut new)) => {
                // The comment behind it.
                *new.decor_mut() = old.decor().clone();
                *old = new;
            }
            (_, Some(new)) => _ = table.insert(first, Item::Value(new)),
            (_, None) => _ = table.remove(first),
        }
        return true;
    }
    if *first == SCENE && table.get(first).is_some_and(Item::is_str) {
        return put_beside(table, &rest.join("."), value);
    }
    if table.get(first).is_none_or(Item::is_none) {
        if value.is_none() {
            return true;
        }
        let mut inner = Table::new();
        inner.set_implicit(true);
        table.insert(first, Item::Table(inner));
    }
    let entry = |rest: &[&str]| rest.first().and_then(|part| part.parse::<usize>().ok());
    match table.get_mut(first) {
        Some(Item::ArrayOfTables(list)) => {
            entry(rest).and_then(|i| list.get_mut(i)).is_some_and(|inner| put(inner, &rest[1..], value))
        }
        Some(Item::Value(Value::Array(list))) => {
            let inner = entry(rest).and_then(|i| list.get_mut(i)).and_then(Value::as_inline_table_mut);
            inner.is_some_and(|inner| put(inner, &rest[1..], value))
        }
        Some(item) => item.as_table_like_mut().is_some_and(|inner| put(inner, rest, value)),
        None => false,
    }
}

/// Table or path of the pair of a mesh, and the keys of that file that are set otherwise.
const SCENE: &str = "scene";
const SET: &str = "set";

/// Sets a key of the file that a mesh names, in the list beside that name.
fn put_beside(mesh: &mut dyn TableLike, key: &str, value: Option<Value>) -> bool {
    if mesh.get(SET).is_none() {
        if value.is_none() {
            return true;
        }
        mesh.insert(SET, Item::Value(Value::Array(Array::new())));
    }
    let Some(list) = mesh.get_mut(SET).and_then(Item::as_array_mut) else { return false };
    let is_it =
        |word: &Value| word.as_str().and_then(|word| word.split_once('=')).is_some_and(|(own, _)| own.trim() == key);
    list.retain(|word| !is_it(word));
    if let Some(mut value) = value {
        value.decor_mut().clear();
        list.push(format!("{key}={value}"));
    }
    true
}

/// Every key of a text with dots, and its value as one would type it; entries of lists of tables are counted from 0.
/// Nothing of what is no TOML.
pub(crate) fn flat(text: &str) -> BTreeMap<String, String> {
    let mut all = BTreeMap::new();
    if let Ok(document) = text.parse::<DocumentMut>() {
        walk("", document.as_table(), &mut all);
    }
    all
}

fn walk(path: &str, table: &dyn TableLike, all: &mut BTreeMap<String, String>) {
    for (name, item) in table.iter() {
        let key = if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
        match (item.as_table_like(), item) {
            (Some(inner), _) => walk(&key, inner, all),
            (None, Item::ArrayOfTables(list)) => {
                list.iter().enumerate().for_each(|(i, inner)| walk(&format!("{key}.{i}"), inner, all));
            }
            (None, Item::Value(Value::Array(list))) if name == SET && table.get(SCENE).is_some_and(Item::is_str) => {
                let words = list.iter().filter_map(|word| word.as_str()?.split_once('='));
                all.extend(words.map(|(own, value)| (of_scene(path, own.trim()), value.trim().to_owned())));
            }
            (None, Item::Value(Value::String(text))) => _ = all.insert(key, text.value().clone()),
            (None, Item::Value(value)) => {
                // Without the comment behind it.
                let mut bare = value.clone();
                bare.decor_mut().clear();
                all.insert(key, bare.to_string());
            }
            _ => {}
        }
    }
}

/// A key of the scene of the mesh at a path.
fn of_scene(mesh: &str, key: &str) -> String {
    if mesh.is_empty() { format!("{SCENE}.{key}") } else { format!("{mesh}.{SCENE}.{key}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "name = \"a\"  # title\n[pinion]\nteeth = 30 # z1\n[wheel]\nmesher = { order = 1 }\n";

    fn with(key: &str, value: &str) -> String {
        changed(TEXT, &BTreeMap::from([(key.into(), value.into())]), |key| key == "name").unwrap()
    }

    #[test]
    fn a_change_leaves_comments_and_all_other_keys() {
        assert_eq!(with("pinion.teeth", "31"), TEXT.replace("30", "31"));
        assert_eq!(with("name", "7"), TEXT.replace("\"a\"", "\"7\""), "a title of digits is a text");
        assert_eq!(with("wheel.mesher.order", "2"), TEXT.replace("order = 1", "order = 2"));
        assert_eq!(
            with("pinion.teeth", "many"),
            TEXT.replace("30", "\"many\""),
            "a word, for the scene to complain of"
        );
    }

    #[test]
    fn new_keys_get_their_tables_and_nothing_takes_a_key_away() {
        let new = with("pair.misalignment.deviation_um", "-3.5");
        assert!(new.contains("[pair.misalignment]\ndeviation_um = -3.5\n"), "{new}");
        assert!(!new.contains("[pair]\n"), "{new}");
        assert_eq!(with("pinion.teeth", " "), TEXT.replace("teeth = 30 # z1\n", ""));
        assert_eq!(with("load.torque_nm", ""), TEXT);
    }

    /// A key of an entry of a list; below a scene that is a file, in the list beside its name.
    #[test]
    fn entries_of_lists_are_counted() {
        const BOX: &str = "[[torque]]\ntorque_nm = 3.0 # on the wheel\n[[mesh]]\nscene = \"a.toml\"\n";
        let with = |text: &str, key: &str, value: &str| {
            changed(text, &BTreeMap::from([(key.into(), value.into())]), |_| false).unwrap()
        };
        assert_eq!(with(BOX, "torque.0.torque_nm", "4.0"), BOX.replace("3.0", "4.0"));
        let slope = "mesh.0.scene.pinion.modification.lead_slope_um";
        let (one, two) = (with(BOX, slope, "5"), with(&with(BOX, slope, "5"), slope, "-6.5"));
        assert_eq!(one, format!("{BOX}set = [\"pinion.modification.lead_slope_um=5\"]\n"));
        assert_eq!(two, one.replace("=5", "=-6.5"));
        assert_eq!(flat(&two)[slope], "-6.5");
        assert_eq!(flat(&two)["torque.0.torque_nm"], "3.0");
        assert_eq!(with(&one, slope, ""), format!("{BOX}set = []\n"));
        assert!(changed(BOX, &BTreeMap::from([("torque.1.torque_nm".into(), "1".into())]), |_| false).is_err());
    }

    #[test]
    fn what_is_no_table_is_told_with_its_key() {
        let changes = BTreeMap::from([("pinion.teeth.x".to_owned(), "1".to_owned())]);
        let fault = changed(TEXT, &changes, |_| false).unwrap_err();
        assert_eq!(fault.keys, ["pinion.teeth.x"]);
        assert_eq!(changed("no toml", &changes, |_| false).unwrap(), "no toml");
    }

    #[test]
    fn keys_of_thousands_of_parts_are_refused() {
        let all = scene::all_keys();
        let deepest = all.iter().map(|key| key.split('.').count()).max().unwrap();
        assert!(deepest < DEEPEST, "a key of {deepest} parts");
        for parts in [DEEPEST + 1, 5_000, 500_000] {
            let changes = BTreeMap::from([(vec!["a"; parts].join("."), "1".to_owned())]);
            let fault = changed(TEXT, &changes, |_| false).unwrap_err();
            assert!(fault.message.contains(&parts.to_string()), "{}", fault.message);
        }
    }

    #[test]
    fn more_keys_than_any_scene_has_are_refused() {
        assert!(scene::all_keys().len() < MOST);
        let changes = (0..=MOST).map(|i| (format!("k{i}"), "1".to_owned())).collect();
        assert!(changed(TEXT, &changes, |_| false).unwrap_err().message.starts_with("1001 keys"));
    }

    #[test]
    fn keys_are_read_with_dots() {
        let all = flat(TEXT);
        let want = [("name", "a"), ("pinion.teeth", "30"), ("wheel.mesher.order", "1")];
        assert_eq!(all, want.map(|(k, v)| (k.to_owned(), v.to_owned())).into());
    }
}
