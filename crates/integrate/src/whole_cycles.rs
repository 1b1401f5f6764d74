//! Number of cycles of a motion of given length.

/// Share of a cycle that is none: last digits of what was turned.
const NO_CYCLE: f64 = 1e-9;

/// Number of whole cycles, >= 1, within which a motion of `turned` cycles ends; rows are written to the end of the last
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
