//! Memory of the process, as the caller reads it.

/// Tells peak and free memory of the process.
pub trait MemoryGauge: Sync {
    /// Forgets the peak so far.
    fn reset_peak(&self);

    /// Largest resident set since, MB; `None` where the system does not tell.
    fn peak_mb(&self) -> Option<f64>;

    /// Memory that is free, MB; `None` where the system does not tell.
    fn available_mb(&self) -> Option<f64>;
}

/// Tells nothing.
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
