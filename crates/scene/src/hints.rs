//! What someone who wrote a wrong value may do next.

use std::ops::Range;

/// Of a number that is out of its range.
pub(super) fn of_range(key: &str, allowed: &str, about: Option<&str>) -> String {
    match about {
        Some(about) => format!("`{key}` means: {about}"),
        None => format!("give `{key}` a number in {allowed}"),
    }
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

/// Of a value of another type.
pub(super) fn of_type(key: &str, expected: &str, found: &str) -> String {
    match expected {
        "a whole number" if found.starts_with("number") => "write it without a decimal point".into(),
        "a whole number" if found.starts_with("integer") => {
            "a number of so many digits is none of this program's".into()
        }
        e if e.contains("number") => "write numbers without quotes and without a unit: the unit is in the key".into(),
        "a text in quotes" => format!("write `{key} = \"...\"`, the text between the quotes"),
        "true or false" => format!("write `{key} = true` or `{key} = false`, without quotes"),
        "a table" => format!("write `[{key}]` on a line of its own, and its keys on the lines below"),
        "a list" => format!("write `{key} = [...]`, its values between the brackets, commas between them"),
        _ => format!("write `{key}` as {expected}"),
    }
}

/// Of text that is no TOML; `None` where nothing better is known than what a TOML file is.
pub(super) fn of_syntax(text: &str, at: &Range<usize>, message: &str) -> Option<&'static str> {
    let begin = text.get(..at.start).unwrap_or_default();
    let after_digit = begin.ends_with(|c: char| c.is_ascii_digit());
    let comma = text.get(at.start..).is_some_and(|rest| rest.starts_with(','));
    match message {
        _ if comma && after_digit => Some("write numbers with a decimal point: `2.5`, not `2,5`"),
        "duplicate key" => Some("keep one of them; all keys of a table stand under one heading"),
        m if m.contains("invalid fraction") => Some("write a digit behind the decimal point: `2.0`, not `2.`"),
        m if is_nesting(m) => Some("a key of a scene has four parts at most, and a list of lists is the deepest value"),
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
