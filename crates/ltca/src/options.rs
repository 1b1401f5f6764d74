//! Options of a quasi-static analysis.

use ale::teeth_needed;
use contact::ContactOptions;
use geometry::{GearPair, Side};

/// Contact, load and window of a quasi-static analysis.
#[derive(Debug, Clone, PartialEq)]
pub struct StaticOptions {
    /// Flanks, offsets and discretisation.
    pub contact: ContactOptions,
    /// Torque on the driven gear, N mm, >= 0.
    pub torque: f64,
    /// Number of teeth of the window; `None`: floor(eps_gamma) + 1, at least 3.
    pub window: Option<usize>,
    /// Whether stress in the root fillets is computed at every station.
    pub root_stress: bool,
    /// Whether the ends of the loaded contact lines of slices are located. Otherwise the lengths are NaN.
    pub line_lengths: bool,
    /// Whether the derivatives of the transmission error by the gap of each loaded slice are computed.
    pub gap_rates: bool,
}

impl StaticOptions {
    /// Defaults for a torque (N mm) on the driven gear of `pair`; see [`ContactOptions::new`].
    pub fn new(torque: f64, pair: &GearPair) -> Self {
        Self {
            contact: ContactOptions::new(pair),
            torque,
            window: None,
            root_stress: false,
            line_lengths: true,
            gap_rates: false,
        }
    }

    /// The same options with the contact options changed.
    #[must_use]
    pub fn with_contact(mut self, change: impl FnOnce(&mut ContactOptions)) -> Self {
        change(&mut self.contact);
        self
    }

    /// The pinion flanks that carry the load.
    pub fn side(&self) -> Side {
        self.contact.side()
    }

    /// Index of the driven gear: 0 for the pinion, 1 for the wheel.
    pub fn driven(&self) -> usize {
        self.contact.driven()
    }

    /// Moment of the torque about the axis of the driven gear, positive counter-clockwise, N mm. A ring rotates in the
    /// sense of its pinion, any other gear in the opposite sense.
    pub fn moment(&self, pair: &GearPair) -> f64 {
        let driven = [&pair.pinion, &pair.wheel][self.driven()];
        -self.side().sign() * driven.sign() * self.torque
    }

    /// Force of the torque along the transverse line of action, N.
    pub fn base_force(&self, pair: &GearPair) -> f64 {
        self.torque / [&pair.pinion, &pair.wheel][self.driven()].base_radius().abs()
    }

    /// Options for contact on the coast flanks: the other gear drives.
    #[must_use]
    pub fn driven_backwards(&self) -> Self {
        self.clone().with_contact(|c| c.driver = c.driver.opposite())
    }

    /// Number of teeth that the window of `pair` has with these options.
    pub fn window_teeth(&self, pair: &GearPair) -> usize {
        self.window.unwrap_or_else(|| teeth_needed(pair.total_contact_ratio()))
    }
}
