//! Numbers in the JSON of a page.

use serde::{Serialize, Serializer};

/// Data as JSON. Texts of megabytes are moved and written by the library, whose code is optimised as that of pages need
/// not be: a quarter of the time.
///
/// # Errors
/// As [`serde_json::to_value`].
pub fn json(data: &impl Serialize) -> Result<String, serde_json::Error> {
    Ok(serde_json::to_value(data)?.to_string())
}

/// Numbers with so many digits; `null` for what is none.
#[derive(Debug, Clone, PartialEq)]
pub struct Numbers(pub Vec<f64>, pub usize);

impl Serialize for Numbers {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.iter().map(|&v| Number::new(v, self.1)))
    }
}

/// A number as it is shortest.
#[derive(Debug, PartialEq, Serialize)]
#[serde(untagged)]
enum Number {
    Whole(i64),
    Real(f64),
    None,
}

impl Number {
    /// Rounded to so many digits.
    fn new(value: f64, digits: usize) -> Self {
        if !value.is_finite() {
            return Self::None;
        }
        let rounded: f64 = format!("{value:.*e}", digits.max(1) - 1).parse().unwrap_or(value);
        if rounded.fract() == 0.0 && rounded.abs() < 1e9 { Self::Whole(rounded as i64) } else { Self::Real(rounded) }
    }
}
