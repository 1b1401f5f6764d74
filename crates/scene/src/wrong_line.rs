//! Lines that are not TOML, reported in the terms of this program.

use std::ops::Range;

/// What is wrong with a line.
enum Wrong<'a> {
    /// `key =` alone.
    NoValue { key: &'a str },
    /// `key : value`.
    Colon { key: &'a str, value: &'a str },
    /// `key = 30"`.
    OneQuote { key: &'a str, value: &'a str },
    /// Values of a list whose bracket does not open.
    NoKey,
    /// `[bearing]` beside `[[bearing]]`.
    OneBracket { table: &'a str },
    /// A key that is there twice.
    Twice { key: &'a str },
}

/// The line that a place lies in.
pub(super) fn line_at<'a>(text: &'a str, at: &Range<usize>) -> Option<&'a str> {
    let begin = text.get(..at.start)?.rfind('\n').map_or(0, |i| i + 1);
    text.get(begin..)?.lines().next()
}

fn wrong<'a>(text: &'a str, at: &Range<usize>, message: &str) -> Option<Wrong<'a>> {
    let line = line_at(text, at)?;
    let bare = line.split('#').next()?.trim();
    if message == "duplicate key" {
        let key = text.get(at.clone())?;
        let table =
            bare.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')).filter(|rest| !rest.starts_with('['));
        let is_list = |table: &&str| text.contains(&format!("[[{table}]]"));
        return Some(table.filter(is_list).map_or(Wrong::Twice { key }, |table| Wrong::OneBracket { table }));
    }
    let is_key =
        |word: &str| !word.is_empty() && word.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '.'));
    if let Some((key, value)) = bare.split_once('=') {
        let (key, value) = (key.trim(), value.trim());
        if value.is_empty() && is_key(key) {
            return Some(Wrong::NoValue { key });
        }
        let own = value.strip_suffix('"').filter(|own| !own.contains(['"', '\'']) && is_key(key))?;
        return Some(Wrong::OneQuote { key, value: own });
    }
    if !message.contains("key with no value") {
        return None;
    }
    match bare.split_once(':') {
        Some((key, value)) if is_key(key.trim()) => Some(Wrong::Colon { key: key.trim(), value: value.trim() }),
        _ => bare.split(',').next()?.trim().parse::<f64>().ok().map(|_| Wrong::NoKey),
    }
}

/// What is wrong with the line at a place, where that is known better than by the reader's own message.
pub(super) fn message(text: &str, at: &Range<usize>, message: &str) -> Option<String> {
    Some(match wrong(text, at, message)? {
        Wrong::NoValue { key } => format!("`{key}` has no value"),
        Wrong::Colon { .. } => "`:` stands where `=` is wanted".into(),
        Wrong::OneQuote { key, .. } => format!("`{key}` has a quote at its end alone"),
        Wrong::NoKey => "values without a key".into(),
        Wrong::OneBracket { table } => format!("`[{table}]` stands beside `[[{table}]]`"),
        Wrong::Twice { key } => format!("`{key}` is there twice"),
    })
}

/// What to write in place of such a line.
pub(super) fn advice(text: &str, at: &Range<usize>, message: &str) -> Option<String> {
    Some(match wrong(text, at, message)? {
        Wrong::NoValue { .. } => "write a value after `=`: a number without quotes, a text in quotes".into(),
        Wrong::Colon { key, value } => format!("write `{key} = {value}`"),
        Wrong::OneQuote { key, value } if value.parse::<f64>().is_ok() => {
            format!("write `{key} = {value}`, without a quote")
        }
        Wrong::OneQuote { key, value } => format!("write `{key} = \"{value}\"`, with a quote on either side"),
        Wrong::NoKey => "a list stands in brackets behind its key: `key = [1.0, 2.0]`, also over several lines".into(),
        Wrong::OneBracket { table } => format!("write `[[{table}]]`, with two brackets: there may be several"),
        Wrong::Twice { .. } => "keep one of them; all keys of a table stand under one heading".into(),
    })
}
