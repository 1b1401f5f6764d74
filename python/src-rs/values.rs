//! Python's values as those of a scene.

use ::scene::{Setting, Value};
use pyo3::{
    prelude::*,
    types::{PyBool, PyFloat, PyInt, PyList, PyMapping, PyString, PyTuple},
};

use crate::{
    arguments::{dict, shown},
    error::Complaint,
};

/// Tables in tables at the most; a list may hold itself.
const DEEPEST: usize = 12;

/// Every key of nested tables with its value, in the order of Python.
pub fn settings(tables: &Bound<'_, PyAny>) -> Result<Vec<Setting>, Complaint> {
    let mut all = Vec::new();
    flatten(tables, "", 0, &mut all)?;
    Ok(all)
}

fn flatten(tables: &Bound<'_, PyAny>, prefix: &str, depth: usize, all: &mut Vec<Setting>) -> Result<(), Complaint> {
    let name = if prefix.is_empty() { "tables" } else { prefix };
    let tables = dict(name, tables, "as {\"operation\": {\"torque_nm\": 150.0}}")?;
    for (key, value) in tables.iter() {
        let Some(key) = key.cast::<PyString>().ok().and_then(|key| key.extract::<String>().ok()) else {
            let what = format_args!("has the key {}, wanted are texts", shown(&key)).to_string();
            return Err(Complaint::argument(name, what, "keys are texts, as \"torque_nm\""));
        };
        let whole = if prefix.is_empty() { key } else { format!("{prefix}.{key}") };
        if value.cast::<PyMapping>().is_ok() {
            deep_enough(&whole, depth)?;
            flatten(&value, &whole, depth + 1, all)?;
        } else {
            all.push(Setting::of(&whole, &of(&whole, &value, depth)?)?);
        }
    }
    Ok(())
}

fn deep_enough(key: &str, depth: usize) -> Result<(), Complaint> {
    if depth < DEEPEST {
        return Ok(());
    }
    Err(Complaint::argument(key, "is nested too deep", "no key of a scene lies so deep; does a list hold itself?"))
}

/// One value: a switch, a whole number, a number, a text, a path, a list, a table; NumPy's as well.
fn of(key: &str, any: &Bound<'_, PyAny>, depth: usize) -> Result<Value, Complaint> {
    deep_enough(key, depth)?;
    let wrong = |what: &str, hint: &str| Err(Complaint::argument(key, what, hint));
    if any.is_none() {
        return wrong("is None", "leave a key out to have its default");
    }
    if any.is_instance_of::<PyBool>() {
        return Ok(Value::Boolean(any.is_truthy().unwrap_or(false)));
    }
    if any.is_instance_of::<PyString>() {
        return any.extract::<String>().map_or_else(|_| wrong("is no text", "give a text in UTF-8"), |s| Ok(s.into()));
    }
    if any.is_instance_of::<PyInt>() {
        return whole(key, any);
    }
    if any.is_instance_of::<PyFloat>() {
        return any.extract::<f64>().map_or_else(|_| wrong("is no number", "give a number"), |x| Ok(x.into()));
    }
    if any.cast::<PyMapping>().is_ok() {
        let dict = dict(key, any, "give a dict of keys and values")?;
        let mut table = toml::Table::new();
        for (name, value) in dict.iter() {
            let Some(name) = name.extract::<String>().ok().filter(|_| name.is_instance_of::<PyString>()) else {
                return wrong("has a key that is no text", "keys are texts, as \"torque_nm\"");
            };
            let inner = of(&format!("{key}.{name}"), &value, depth + 1)?;
            table.insert(name, inner);
        }
        return Ok(Value::Table(table));
    }
    if any.is_instance_of::<PyList>() || any.is_instance_of::<PyTuple>() {
        let entries = any.try_iter().map_err(|_| Complaint::argument(key, "is no list", "give a list"))?;
        let mut list = Vec::new();
        for entry in entries {
            let entry =
                entry.map_err(|_| Complaint::argument(key, "is a list that ends in an error", "give a list"))?;
            list.push(of(key, &entry, depth + 1)?);
        }
        return Ok(Value::Array(list));
    }
    of_others(key, any, depth)
}

/// What other packages have for numbers, lists and paths.
fn of_others(key: &str, any: &Bound<'_, PyAny>, depth: usize) -> Result<Value, Complaint> {
    let has = |name: &str| any.hasattr(name).unwrap_or(false);
    if has("dtype") && has("tolist") {
        let plain =
            any.call_method0("tolist").ok().filter(|plain| plain.get_type().as_ptr() != any.get_type().as_ptr());
        if let Some(plain) = plain {
            return of(key, &plain, depth + 1);
        }
    }
    if has("__fspath__")
        && let Some(path) = any.call_method0("__fspath__").ok().and_then(|path| path.extract::<String>().ok())
    {
        return Ok(path.into());
    }
    if has("__index__") {
        return whole(key, any);
    }
    if let (true, Ok(number)) = (has("__float__"), any.extract::<f64>()) {
        return Ok(number.into());
    }
    let what = format_args!("is {}, which a scene has no word for", shown(any)).to_string();
    Err(Complaint::argument(key, what, "give a number, a text, True or False, or a list of them"))
}

fn whole(key: &str, any: &Bound<'_, PyAny>) -> Result<Value, Complaint> {
    any.extract::<i64>().map(Value::Integer).map_err(|_| {
        let what = format_args!("is {}, which is beyond 64 bits", shown(any)).to_string();
        Complaint::argument(key, what, "give a smaller number")
    })
}
