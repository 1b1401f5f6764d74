//! Running mean and extremes of a series.

/// Sum, count, least and largest of numbers so far.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Running {
    sum: f64,
    count: usize,
    /// Least and largest; infinite, the wrong way round, of nothing. A NaN is neither.
    pub ends: [f64; 2],
    is_known: bool,
}

impl Default for Running {
    fn default() -> Self {
        // The sum of nothing as the standard library has it: sums of lists come out to the same bit.
        let sum = [0.0; 0].iter().sum();
        Self { sum, count: 0, ends: [f64::INFINITY, f64::NEG_INFINITY], is_known: true }
    }
}

impl Running {
    /// Adds a value.
    pub fn push(&mut self, x: f64) {
        self.sum += x;
        self.count += 1;
        self.ends = [self.ends[0].min(x), self.ends[1].max(x)];
    }

    /// Adds a value if there is one. If one value is unknown, the whole result is unknown.
    pub fn push_known(&mut self, x: Option<f64>) {
        match x {
            Some(x) => self.push(x),
            None => self.is_known = false,
        }
    }

    /// Arithmetic mean; NaN for an empty series.
    pub fn mean(&self) -> f64 {
        self.sum / self.count as f64
    }

    /// The result, if every value was known and there was at least one.
    pub fn known(self) -> Option<Self> {
        (self.is_known && self.count > 0).then_some(self)
    }
}
