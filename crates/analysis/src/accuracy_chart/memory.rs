//! Memory of the process, measured by the caller.

/// Measures peak and free memory of the process.
pub trait MemoryGauge: Sync {
    /// Resets the peak.
    fn reset_peak(&self);

    /// Largest resident set since the reset, MB; `None` if the operating system does not report it.
    fn peak_mb(&self) -> Option<f64>;

    /// Free memory, MB; `None` if the operating system does not report it.
    fn available_mb(&self) -> Option<f64>;
}

/// Gauge without measurements.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoGauge;

impl MemoryGauge for NoGauge {
    fn reset_peak(&self) {}

    fn peak_mb(&self) -> Option<f64> {
        None
    }

    fn available_mb(&self) -> Option<f64> {
        None
    }
}
