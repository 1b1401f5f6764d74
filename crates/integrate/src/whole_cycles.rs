//! How many cycles a motion of a given length has.

/// Share of a cycle that is none: last digits of what was turned.
const NO_CYCLE: f64 = 1e-9;

/// Whole cycles within which a motion ends that turns through so many of them, >= 1: rows are written to the end of the last
/// one.
///
/// ```
/// use integrate::whole_cycles;
///
/// assert_eq!(whole_cycles(85.0 * (1.0 + 1e-12)), 85.0);
/// assert_eq!(whole_cycles(85.01), 86.0);
/// assert_eq!(whole_cycles(0.2), 1.0);
/// ```
pub fn whole_cycles(turned: f64) -> f64 {
    (turned - NO_CYCLE * turned.max(1.0)).ceil().max(1.0)
}
