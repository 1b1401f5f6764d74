//! Bars and times in words.

/// Width of a bar, characters.
const BAR: usize = 32;

/// A bar filled in part; what takes longer than foreseen stays just short of full.
pub(super) fn filled(part: f64) -> String {
    let full = ((BAR as f64 * part.max(0.0)) as usize).min(BAR - 1);
    format!("{}>{}", "=".repeat(full), " ".repeat(BAR - 1 - full))
}

/// Remaining seconds in words.
pub(super) fn left(seconds: f64) -> String {
    match seconds {
        s if s >= 1.0 => format!("about {} left", time(s)),
        _ => "a moment left".to_owned(),
    }
}

/// What was foreseen for all of it; nothing for what takes no time.
pub(super) fn foreseen(seconds: f64) -> String {
    if seconds >= 1.0 { format!(", of some {}", time(seconds)) } else { String::new() }
}

/// Seconds, minutes, hours or days: two digits or so.
fn time(seconds: f64) -> String {
    match seconds {
        s if s >= 172_800.0 => format!("{:.0} days", s / 86_400.0),
        s if s >= 7200.0 => format!("{:.0} h", s / 3600.0),
        s if s >= 120.0 => format!("{:.0} min", s / 60.0),
        s => format!("{s:.0} s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bar_grows_and_never_bursts() {
        let full = |part: f64| filled(part).matches('=').count();
        assert_eq!((full(-1.0), full(0.0), full(0.5), full(1.0), full(1e9)), (0, 0, 16, 31, 31));
        assert!([0.0, 0.3, 5.0].iter().all(|&p| filled(p).len() == BAR));
        assert_eq!(left(44760.0 * 60.0), "about 31 days left");
        assert_eq!((left(7300.0), foreseen(20_000.0)), ("about 2 h left".to_owned(), ", of some 6 h".to_owned()));
        assert_eq!((left(200.0).as_str(), left(12.3).as_str()), ("about 3 min left", "about 12 s left"));
    }
}
