//! Numbers of messages.

/// Three digits, without an exponent where that is short.
pub(crate) fn digits(value: f64) -> String {
    let decimals = (2.0 - value.abs().max(1e-300).log10().floor()).clamp(0.0, 5.0) as usize;
    if value != 0.0 && !(1e-3..1e7).contains(&value.abs()) {
        format!("{value:.2e}")
    } else {
        let text = format!("{value:.decimals$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    }
}
