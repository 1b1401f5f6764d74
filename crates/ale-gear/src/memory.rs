//! Peak memory of this process, where the system tells it.

use std::fs;

pub use store::available_bytes;
pub use store::available_mb;

/// Forgets the peak so far. Returns whether the system could (Linux only).
pub fn reset_peak() -> bool {
    fs::write("/proc/self/clear_refs", "5").is_ok()
}

/// Largest resident set since the last reset (or since the start), MB = 10^6 bytes; `None` where the
/// system does not tell.
pub fn peak_mb() -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?;
    let kib: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib * 1024.0 / 1e6)
}
