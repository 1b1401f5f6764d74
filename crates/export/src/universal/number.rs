//! Numbers as Fortran writes them.

/// A number in `width` columns with so many digits behind the point, its exponent in `mark` (E or D), sign and two or
/// three digits. What is no number is written as 0: the format has no word for it.
pub(super) fn real(value: f64, width: usize, digits: usize, mark: char) -> String {
    let value = if value.is_finite() { value } else { 0.0 };
    let plain = format!("{value:.digits$e}");
    let (mantissa, exponent) = plain.split_once('e').unwrap_or((&plain, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let sign = if exponent < 0 { '-' } else { '+' };
    let size = exponent.unsigned_abs();
    let written = if size < 100 {
        format!("{mantissa}{mark}{sign}{size:02}")
    } else {
        // Three digits take the place of the mark, as in Fortran.
        format!("{mantissa}{sign}{size:03}")
    };
    format!("{written:>width$}")
}

/// A text in `width` columns of characters that every reader knows.
pub(super) fn text(words: &str, width: usize) -> String {
    let plain: String = words.chars().map(|c| if (' '..='~').contains(&c) { c } else { '?' }).take(width).collect();
    format!("{plain:<width$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_as_fortran_writes_them() {
        assert_eq!(real(-1234.5, 13, 5, 'E'), " -1.23450E+03");
        assert_eq!(real(0.0, 20, 12, 'E'), "  0.000000000000E+00");
        assert_eq!(real(1e-120, 20, 12, 'E'), "  1.000000000000-120");
        assert_eq!(real(f64::NAN, 13, 5, 'E'), "  0.00000E+00");
        assert_eq!(real(1000.0, 25, 17, 'D'), "  1.00000000000000000D+03");
        assert_eq!(text("K\u{f6}rper, 30 mm", 8), "K?rper, ");
    }
}
