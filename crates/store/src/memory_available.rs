//! Memory that is left, where the system tells it.

/// Memory that a new program could have without swapping, bytes; 10^12 where the system does not tell.
pub fn available_bytes() -> f64 {
    1e6 * available_mb().unwrap_or(1e6)
}

/// Memory that is available, MB; `None` where the system does not tell.
pub fn available_mb() -> Option<f64> {
    let info = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = info.lines().find_map(|l| l.strip_prefix("MemAvailable:"))?;
    let kib: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib * 1024.0 / 1e6)
}
