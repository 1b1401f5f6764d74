//! Which random pairs laws are made of, and which they are checked on: no seed is both.

/// Seeds of checks: pairs and motions that no law was made of.
const CHECKS: [u64; 3] = [3, 6, 11];
/// From this seed on odd ones are for laws, even ones for checks.
const BY_PARITY: u64 = 100;
/// Seed of spur pairs that took no part in the laws of all pairs: they say how much wider bounds of their positions are.
const SPUR: u64 = 4;

/// Whether pairs of a seed are for checks alone.
pub fn held_out(seed: u64) -> bool {
    if seed < BY_PARITY { CHECKS.contains(&seed) } else { seed.is_multiple_of(2) }
}

/// Whether pairs of a seed are the spur pairs beside the laws of all pairs.
pub fn spur_alone(seed: u64) -> bool {
    seed == SPUR
}
