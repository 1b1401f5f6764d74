//! Arguments of Python, each with its own complaint: PyO3's are without a hint.

use std::path::PathBuf;

use pyo3::{
    prelude::*,
    types::{PyBool, PyBytes, PyDict, PyMapping, PyString},
};

use crate::error::Complaint;

/// An argument that may be left out.
pub type Given<'a, 'py> = Option<&'a Bound<'py, PyAny>>;

/// A value and its type, short enough for a message.
pub fn shown(any: &Bound<'_, PyAny>) -> String {
    let kind = any.get_type().name().map_or_else(|_| "object".to_owned(), |name| name.to_string());
    let text = any.repr().map_or_else(|_| String::new(), |text| text.to_string_lossy().into_owned());
    if text.is_empty() || text.chars().count() > 40 { kind } else { format!("{text} ({kind})") }
}

/// A number, NumPy's among them.
pub fn number(name: &str, any: &Bound<'_, PyAny>) -> Result<f64, Complaint> {
    let wrong = || Complaint::argument(name, format_args!("is {}, wanted is a number", shown(any)), "give a number");
    if any.is_instance_of::<PyBool>() || any.is_instance_of::<PyString>() {
        return Err(wrong());
    }
    any.extract::<f64>().map_err(|_| wrong())
}

/// A whole number from `least` on.
pub fn whole(name: &str, any: &Bound<'_, PyAny>, least: u32) -> Result<u32, Complaint> {
    let wrong = || {
        let what = format_args!("is {}, wanted is a whole number from {least} on", shown(any)).to_string();
        Complaint::argument(name, what, "give a whole number")
    };
    if any.is_instance_of::<PyBool>() {
        return Err(wrong());
    }
    any.extract::<u32>().ok().filter(|n| *n >= least).ok_or_else(wrong)
}

/// A text.
pub fn text(name: &str, any: &Bound<'_, PyAny>) -> Result<String, Complaint> {
    let wrong = || Complaint::argument(name, format_args!("is {}, wanted is a text", shown(any)), "give a text");
    if !any.is_instance_of::<PyString>() {
        return Err(wrong());
    }
    // A lone surrogate is no text.
    any.extract::<String>().map_err(|_| wrong())
}

/// A path: a text, or what says one of itself.
pub fn path(name: &str, any: &Bound<'_, PyAny>) -> Result<PathBuf, Complaint> {
    let wrong =
        || Complaint::argument(name, format_args!("is {}, wanted is a path", shown(any)), "give a text or a Path");
    if any.is_instance_of::<PyBytes>() {
        return Err(wrong());
    }
    let found = any.extract::<PathBuf>().map_err(|_| wrong())?;
    if found.as_os_str().as_encoded_bytes().contains(&0) {
        return Err(wrong());
    }
    Ok(found)
}

/// True or false.
pub fn switch(name: &str, any: &Bound<'_, PyAny>) -> Result<bool, Complaint> {
    any.extract::<bool>().map_err(|_| {
        Complaint::argument(name, format_args!("is {}, wanted is True or False", shown(any)), "give True or False")
    })
}

/// A number or some, and whether there were some.
pub fn numbers(name: &str, any: &Bound<'_, PyAny>) -> Result<(Vec<f64>, bool), Complaint> {
    let is_one = any.is_instance_of::<PyString>() || any.cast::<PyMapping>().is_ok() || any.len().is_err();
    if is_one {
        return Ok((vec![number(name, any)?], false));
    }
    Ok((list(name, any)?.iter().map(|one| number(name, one)).collect::<Result<_, _>>()?, true))
}

/// A dict of its own: nobody changes it while it is gone through. Other mappings become one.
pub fn dict<'py>(name: &str, any: &Bound<'py, PyAny>, hint: &str) -> Result<Bound<'py, PyDict>, Complaint> {
    let wrong = || Complaint::argument(name, format_args!("is {}, wanted is a dict", shown(any)), hint);
    if let Ok(dict) = any.cast::<PyDict>() {
        return dict.copy().map_err(|_| wrong());
    }
    let mapping = any.cast::<PyMapping>().map_err(|_| wrong())?;
    let made = any.py().get_type::<PyDict>().call1((mapping,)).map_err(|_| wrong())?;
    made.cast_into::<PyDict>().map_err(|_| wrong())
}

/// What a sequence, an array or another iterable holds.
pub fn list<'py>(name: &str, any: &Bound<'py, PyAny>) -> Result<Vec<Bound<'py, PyAny>>, Complaint> {
    let wrong = || Complaint::argument(name, format_args!("is {}, wanted is a list", shown(any)), "give a list");
    if any.is_instance_of::<PyString>() || any.cast::<PyMapping>().is_ok() {
        return Err(wrong());
    }
    let mut all = Vec::new();
    for one in any.try_iter().map_err(|_| wrong())? {
        if all.len() == MOST {
            let what = format_args!("has more than {MOST} entries").to_string();
            return Err(Complaint::argument(name, what, "give fewer"));
        }
        all.push(one.map_err(|_| wrong())?);
    }
    Ok(all)
}

/// Entries of a list of arguments at the most: iterables may have no end.
const MOST: usize = 1_000_000;
