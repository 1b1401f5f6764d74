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
        s if s >= 120.0 => format!("about {:.0} min left", s / 60.0),
        s if s >= 1.0 => format!("about {s:.0} s left"),
        _ => "a moment left".to_owned(),
    }
}

/// What was foreseen for all of it; nothing for what takes no time.
pub(super) fn foreseen(seconds: f64) -> String {
    match seconds {
        s if s >= 120.0 => format!(", of some {:.0} min", s / 60.0),
        s if s >= 1.0 => format!(", of some {s:.0} s"),
        _ => String::new(),
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
        assert_eq!((left(200.0).as_str(), left(12.3).as_str()), ("about 3 min left", "about 12 s left"));
    }
}
