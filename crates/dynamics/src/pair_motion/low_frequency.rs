//! How far quasi-static elasticity may be trusted.

/// Highest ratio of an exciting frequency to a gear's lowest elastic one at which elasticity counts as quasi-static.
///
/// ```text
/// c(f) = sum_j phi_j phi_j' / (omega_j^2 - omega^2) <= c(0) / (1 - r^2),   r = f / f_1
/// ```
/// f_1 the gear's lowest frequency with its bore held and its flanks free. At r = 1/4 a gear gives way by 7 % more than at rest where all of its compliance is in its lowest mode,
/// and less where it is not. What that does to the dynamic transmission error of two discs on thin shafts (`tests/verification/modes_in_motion.rs`): 1 % at 0.1, 4 to 5 % at 0.2, 7 to 8 %
/// at the limit, 10 to 14 % at 0.3, all of it at 1. With the flanks held the lowest frequency of such gears is up to twice as high: as a bound it would warn too late.
pub const LOW_FREQUENCY_LIMIT: f64 = 0.25;

/// Share of the largest harmonic from which on a harmonic of the transmission error matters.
const MATTERS: f64 = 0.1;

/// Mesh harmonics beside the lowest elastic frequencies of both gears.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElasticRatio {
    /// Highest mesh frequency, Hz.
    pub mesh_hz: f64,
    /// Highest harmonic of it that matters, 1 the mesh frequency itself.
    pub harmonic: usize,
    /// Lowest elastic frequency of pinion and wheel, bore held and flanks free, Hz ([`reduction::LowestFrequencies::flanks_free_hz`]).
    pub elastic_hz: [f64; 2],
}

impl ElasticRatio {
    /// Harmonic times mesh frequency over the lowest elastic frequency, of pinion and wheel.
    pub fn ratios(&self) -> [f64; 2] {
        self.elastic_hz.map(|f| self.harmonic as f64 * self.mesh_hz / f)
    }

    /// The larger one.
    pub fn largest(&self) -> f64 {
        self.ratios().into_iter().fold(0.0, f64::max)
    }

    /// What to tell the user when elasticity is taken for quasi-static above [`LOW_FREQUENCY_LIMIT`]; `None` below.
    pub fn warning(&self) -> Option<String> {
        let [pinion, wheel] = self.ratios();
        let (gear, ratio, hz) =
            if pinion >= wheel { ("pinion", pinion, self.elastic_hz[0]) } else { ("wheel", wheel, self.elastic_hz[1]) };
        (ratio > LOW_FREQUENCY_LIMIT).then(|| {
            format!(
                "mesh harmonic {} at {:.0} Hz is {ratio:.2} of the {gear}'s lowest elastic frequency, {hz:.0} Hz (bore held, flanks free); quasi-static elasticity \
                 holds up to {LOW_FREQUENCY_LIMIT}: take the model `reduced+modes`",
                self.harmonic,
                self.harmonic as f64 * self.mesh_hz
            )
        })
    }
}

/// The highest harmonic that matters: of at least a tenth of the largest amplitude. `amplitudes`: of harmonics 1, 2, ... of the static transmission error; 1 where there are none.
pub fn harmonic_that_matters(amplitudes: &[f64]) -> usize {
    let largest = amplitudes.iter().fold(0.0f64, |m, a| m.max(a.abs()));
    let last = amplitudes.iter().rposition(|a| largest > 0.0 && a.abs() >= MATTERS * largest);
    last.map_or(1, |i| i + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The warning comes with the first ratio above the limit, names the gear that it is about, and what to do.
    #[test]
    fn warning_names_gear_and_remedy() {
        let at = |mesh_hz: f64| ElasticRatio { mesh_hz, harmonic: 3, elastic_hz: [36_000.0, 24_000.0] };
        assert_eq!(at(2_000.0).warning(), None, "the limit itself is allowed");
        let said = at(2_001.0).warning().unwrap();
        assert!(
            said.contains("harmonic 3 at 6003 Hz is 0.25 of the wheel's") && said.contains("`reduced+modes`"),
            "{said}"
        );
    }

    #[test]
    fn small_harmonics_do_not_matter() {
        assert_eq!(harmonic_that_matters(&[2.0, -0.5, 0.21, 0.19, 0.0]), 3);
        assert_eq!(harmonic_that_matters(&[]), 1);
        assert_eq!(harmonic_that_matters(&[0.0, 0.0]), 1);
    }
}
