//! Hints for the user after a wrong value.

use std::{borrow::Cow, ops::Range};

use crate::{
    Quantity,
    units::{in_another_unit, in_written_unit, own_unit, plain},
    wrong_line,
};

/// Hint for a number that is out of its range.
pub(super) fn of_range(key: &str, allowed: &str, about: Option<&str>) -> String {
    match about {
        Some(about) => format!("`{key}` means: {about}"),
        None => format!("give `{key}` a number in {allowed}"),
    }
}

/// Times by which a number passes the end of its range that is in the right unit all the same.
const NEAR: f64 = 3.0;

/// Hint for a number that is out of its range and in another unit within it.
pub(super) fn of_number(key: &str, value: f64, [low, high]: [f64; 2]) -> Option<String> {
    let fits = |x: f64| (low..=high).contains(&x);
    // A unit is a factor of a hundred or more, or of 57 or 9.5: what misses the range by less is a number too large.
    let beyond = if value.abs() > high.abs().max(low.abs()) { value / high } else { low / value };
    let meant = in_another_unit(key, value, fits).filter(|_| !(0.0..NEAR).contains(&beyond.abs()))?;
    Some(format!("{}: write `{key} = {}`", meant.said, plain(meant.value)))
}

/// What stands there, in words of this program.
pub(super) fn found(readers: &str) -> String {
    let plain = readers.replace("floating point", "number").replace('`', "");
    match plain.as_str() {
        "sequence" => "a list".into(),
        "map" => "a table or a date".into(),
        other => other.trim_end_matches(" as i128").trim_end_matches(" as u128").to_owned(),
    }
}

/// Hint for a value of another type.
pub(super) fn of_type(key: &str, expected: &str, found: &str) -> String {
    match expected {
        "a whole number" if found.starts_with("number") => "write a whole number, without a decimal point".into(),
        "a whole number" if found.starts_with("integer") => {
            "a number of so many digits is none of this program's".into()
        }
        e if e.contains("number") => match found.split('"').nth(1).and_then(|written| number_in(key, written)) {
            Some(advice) => advice,
            None if found.contains('"') => {
                "write numbers without quotes and without a unit: the unit is in the key".into()
            }
            None if e == "a whole number" => format!("write a whole number alone, as `{key} = 4`"),
            None => format!("write a number alone, as `{key} = 2.5`"),
        },
        "a text in quotes" => format!("write `{key} = \"...\"`, the text between the quotes"),
        "true or false" => format!("write `{key} = true` or `{key} = false`, without quotes"),
        "a table" => format!("write `[{key}]` on a line of its own, and its keys on the lines below"),
        "a list" if found.starts_with("a table") && !key.split('.').any(|part| part.parse::<u32>().is_ok()) => {
            format!("write `[[{key}]]`, with two brackets: there may be several")
        }
        "a list" if found.starts_with("a table") => {
            "its entries are named by numbers from 0, as in `torque.0.torque_nm`, and there is one of each number"
                .into()
        }
        "a list" => format!("write `{key} = [...]`, its values between the brackets, commas between them"),
        _ => format!("write `{key}` as {expected}"),
    }
}

/// Signs that text processors put in place of the minus sign of TOML.
const MINUS: [char; 3] = ['\u{2212}', '\u{2013}', '\u{2014}'];

/// How a number is written that stands there with another minus sign or with a unit; `None` where there is none.
fn number_in(key: &str, written: &str) -> Option<String> {
    let plain = written.trim().replace(MINUS, "-");
    let is_number = |text: &str| text.parse::<f64>().is_ok_and(f64::is_finite);
    if plain == written.trim() && is_number(&plain) {
        return None;
    }
    if plain != written.trim() && is_number(&plain) {
        return Some(format!("its minus sign is not the one of a keyboard: write `{key} = {plain}`"));
    }
    // The longest beginning that is a number; what is behind it is a unit.
    let ends = plain.char_indices().map(|(at, _)| at).skip(1);
    let number = ends.filter_map(|at| plain.get(..at)).filter(|text| is_number(text.trim_end())).last()?.trim_end();
    let unit = plain.get(number.len()..)?.trim();
    let is_unit =
        unit.starts_with(|c: char| c.is_alphabetic() || matches!(c, '%' | '\u{b0}' | '\u{2032}' | '"' | '\''));
    is_unit.then(|| with_unit(key, (number, unit)))
}

/// What to write for a number that stands there with a unit.
fn with_unit(key: &str, (number, unit): (&str, &str)) -> String {
    let name = key.rsplit('.').next().unwrap_or(key);
    if Quantity::ALL.iter().any(|quantity| quantity.key() == name) {
        return format!("it is a text, in quotes: write `{key} = \"{number} {unit}\"`");
    }
    let value = number.parse::<f64>().ok();
    match (value.and_then(|value| Some((value, in_written_unit(key, value, unit)?))), own_unit(key)) {
        // As it is written, where it stays.
        (Some((value, meant)), _) if meant.value == value => format!("{}: write `{key} = {number}`", meant.said),
        (Some((_, meant)), _) => format!("{}: write `{key} = {}`", meant.said, plain(meant.value)),
        (None, Some("")) => format!("`{key}` has no unit: write a number alone"),
        (None, Some(own)) => format!("`{key}` is in {own}: write a number in that unit, without it and without quotes"),
        (None, None) => {
            format!("the unit is in the name of `{key}`: write a number in that unit, without it and without quotes")
        }
    }
}

/// What of a line stands behind its `=`, without a comment, and the key before it.
fn value_of_line<'a>(text: &'a str, at: &Range<usize>) -> Option<(&'a str, &'a str)> {
    let (key, value) = wrong_line::line_at(text, at)?.split_once('=')?;
    let value = value.split('#').next()?.trim();
    (!value.starts_with(['"', '\'', '[', '{'])).then_some((key.trim(), value))
}

/// Hint for text that is no TOML; `None` where nothing better is known than what a TOML file is.
pub(super) fn of_syntax(text: &str, at: &Range<usize>, message: &str) -> Option<Cow<'static, str>> {
    let of_line = wrong_line::advice(text, at, message);
    let of_number = || value_of_line(text, at).and_then(|(key, value)| number_in(key, value));
    of_line.or_else(of_number).map(Cow::Owned).or_else(|| of_toml(text, at, message).map(Cow::Borrowed))
}

/// Hint from the syntax alone.
fn of_toml(text: &str, at: &Range<usize>, message: &str) -> Option<&'static str> {
    let begin = text.get(..at.start).unwrap_or_default();
    let after_digit = begin.ends_with(|c: char| c.is_ascii_digit());
    let comma = text.get(at.start..).is_some_and(|rest| rest.starts_with(','));
    match message {
        _ if text.trim_start().starts_with("<?xml") => {
            Some("this is an XML file; `ale-gear init --rexs FILE` makes a gearbox file of a REXS file")
        }
        _ if comma && after_digit => Some("write numbers with a decimal point: `2.5`, not `2,5`"),
        m if m.contains("invalid fraction") => Some("write a digit behind the decimal point: `2.0`, not `2.`"),
        m if is_nesting(m) => Some("a key of a scene has four parts at most, and a list of lists is the deepest value"),
        m if m.contains("key with no value") => Some("write `key = value`, or `[table]` above keys of a table"),
        m if m.contains("string values must be quoted") => {
            Some("write a value after `=`: a number without quotes, a text in quotes")
        }
        m if m.contains("overflow") => Some("numbers end at 1.8e308"),
        m if m.contains("invalid basic string") => Some("end the text with a quote on the same line"),
        m if m.contains("carriage return") => {
            Some("end lines with a line feed: save the file with Unix or Windows line ends")
        }
        _ => None,
    }
}

/// Whether the TOML reader has ended at its own limit of depth.
pub(super) fn is_nesting(message: &str) -> bool {
    message.contains("recursion limit") || message.contains("cannot recurse")
}
