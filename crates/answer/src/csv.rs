//! Numbers and texts as fields of a file with commas.

use std::fmt::Write;

/// One line of numbers with commas between them.
pub fn push_row(csv: &mut String, row: impl IntoIterator<Item = f64>) {
    for (k, value) in row.into_iter().enumerate() {
        if k > 0 {
            csv.push(',');
        }
        push_number(csv, value);
    }
    csv.push('\n');
}

/// A text as one field of a file with commas: in quotes where it has to be.
pub fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) { always_quoted(text) } else { text.to_owned() }
}

/// A text as one field of a file with commas, in quotes.
pub fn always_quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

/// The shortest text that reads back to the same number.
pub fn push_number(text: &mut String, value: f64) {
    if value == 0.0 {
        return text.push_str(if value.is_sign_negative() { "-0" } else { "0" });
    }
    let size = value.abs();
    // Where the crate writes plain digits and this file wants them, or both want a power of ten.
    if (1e-4..1e12).contains(&size) || size < 1e-5 {
        let mut buffer = zmij::Buffer::new();
        let digits = buffer.format_finite(value);
        text.push_str(digits.strip_suffix(".0").unwrap_or(digits));
        return;
    }
    let plain = !value.is_finite();
    // Writing to a String cannot fail.
    let _ = if plain { write!(text, "{value}") } else { write!(text, "{value:e}") };
}

#[cfg(test)]
mod tests {
    use super::push_number;

    /// As the standard library writes it, whatever the size; and it reads back to the same bits.
    #[test]
    fn numbers_are_written_as_the_standard_library_does() {
        let mut bits = 0x9e37_79b9_7f4a_7c15u64;
        let mut all: Vec<f64> = (0..200_000)
            .map(|_| {
                bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                f64::from_bits(bits)
            })
            .collect();
        let near = (-330..309).flat_map(|e| ["1e", "2.5e", "9.999999999999999e", "-7e"].map(|s| format!("{s}{e}")));
        all.extend(near.filter_map(|word| word.parse::<f64>().ok()));
        all.extend([
            0.0,
            -0.0,
            1.0,
            -3.0,
            150.0,
            0.1,
            1e12,
            1e-4,
            1e-5,
            999_999_999_999.9,
            f64::MIN_POSITIVE,
            f64::MAX,
        ]);
        all.extend([f64::NAN, f64::INFINITY, f64::NEG_INFINITY]);
        for value in all {
            let mut text = String::new();
            push_number(&mut text, value);
            let plain = value == 0.0 || !value.is_finite() || (1e-4..1e12).contains(&value.abs());
            assert_eq!(text, if plain { format!("{value}") } else { format!("{value:e}") });
            let back: f64 = text.parse().unwrap_or(0.5);
            assert!(back.to_bits() == value.to_bits() || (back.is_nan() && value.is_nan()), "{text}");
        }
    }
}
