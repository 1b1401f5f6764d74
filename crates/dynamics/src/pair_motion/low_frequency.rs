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

/// Share of the peak to peak that may change before a user should hear of it: what one harmonic at [`LOW_FREQUENCY_LIMIT`] changes, 1/(1 - r^2) - 1 = 1/15.
pub const CHANGE_LIMIT: f64 =
    LOW_FREQUENCY_LIMIT * LOW_FREQUENCY_LIMIT / (1.0 - LOW_FREQUENCY_LIMIT * LOW_FREQUENCY_LIMIT);

/// Damping ratio of an elastic mode that an exciting frequency meets: of a steel gear with what holds it.
const MODE_DAMPING: f64 = 0.01;
/// Mesh frequencies at which a motion that passes through many is looked at, beside those that meet the lowest mode.
const PLACES: usize = 64;

/// Mesh harmonics of the transmission error beside the lowest elastic frequencies of both gears. Theory (63).
///
/// ```text
/// change(f_m) = sum_k 2 A_k |1 / (1 - r_k^2 + 2 i zeta r_k) - 1|,   r_k = k f_m / f_1
/// ```
/// The largest over the mesh frequencies of the motion: by so much its peak to peak may change if the inertia of elastic deformation is taken into account. A bound, since it puts all compliance of the
/// flanks into the lowest mode.
#[derive(Debug, Clone, PartialEq)]
pub struct ElasticChange {
    /// Mesh frequency at which most may change, Hz.
    pub mesh_hz: f64,
    /// Mesh harmonic that has the largest part in it, 1 the mesh frequency itself.
    pub harmonic: usize,
    /// Lowest elastic frequency of pinion and wheel, bore held and flanks free, Hz ([`reduction::LowestFrequencies::flanks_free_hz`]), or the highest mode that is kept.
    pub elastic_hz: [f64; 2],
    /// By how much the peak to peak may change, mm or whatever the amplitudes are in.
    pub change: f64,
}

impl ElasticChange {
    /// `amplitudes`: of mesh harmonics 1, 2, ...; `mesh_hz`: least and highest mesh frequency of the motion.
    pub fn of(amplitudes: &[f64], mesh_hz: [f64; 2], elastic_hz: [f64; 2]) -> Self {
        let lowest = elastic_hz[0].min(elastic_hz[1]);
        let part = |k: usize, mesh: f64| 2.0 * amplitudes[k].abs() * off((k + 1) as f64 * mesh / lowest);
        let [from, to] = mesh_hz;
        let passed = (0..=PLACES).map(|i| from + (to - from) * i as f64 / PLACES as f64);
        let met = (1..=amplitudes.len()).map(|k| lowest / k as f64).filter(|f| (from..to).contains(f));
        let mut worst = Self { mesh_hz: to, harmonic: 1, elastic_hz, change: 0.0 };
        for mesh in passed.chain(met) {
            let change: f64 = (0..amplitudes.len()).map(|k| part(k, mesh)).sum();
            if change > worst.change {
                let first = |best: usize, k: usize| if part(k, mesh) > part(best, mesh) { k } else { best };
                let harmonic = 1 + (0..amplitudes.len()).fold(0, first);
                worst = Self { mesh_hz: mesh, harmonic, elastic_hz, change };
            }
        }
        worst
    }

    /// Frequency of the harmonic, Hz.
    pub fn harmonic_hz(&self) -> f64 {
        self.harmonic as f64 * self.mesh_hz
    }

    /// Harmonic times mesh frequency over the lowest elastic frequency, of pinion and wheel.
    pub fn ratios(&self) -> [f64; 2] {
        self.elastic_hz.map(|f| self.harmonic_hz() / f)
    }

    /// The larger one.
    pub fn largest_ratio(&self) -> f64 {
        self.ratios().into_iter().fold(0.0, f64::max)
    }

    /// Whether a user should hear of it beside a peak to peak, in the unit of the amplitudes.
    pub fn matters(&self, peak_to_peak: f64) -> bool {
        self.change > CHANGE_LIMIT * peak_to_peak
    }
}

/// |1 / (1 - r^2 + 2 i zeta r) - 1|: what a lowest mode changes in a deflection at r times its frequency.
fn off(r: f64) -> f64 {
    let (re, im) = (1.0 - r * r, 2.0 * MODE_DAMPING * r);
    // (1 - d) / d with d = re + i im.
    (1.0 - re).hypot(im) / re.hypot(im)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ELASTIC: [f64; 2] = [36_000.0, 24_000.0];

    /// One harmonic alone matters from a quarter of the lower frequency on.
    #[test]
    fn one_harmonic_matters_from_the_limit_on() {
        let at = |mesh_hz: f64| ElasticChange::of(&[0.0, 0.0, 1.0], [mesh_hz; 2], ELASTIC);
        assert!(!at(1_990.0).matters(2.0) && at(2_010.0).matters(2.0), "{:?} {:?}", at(1_990.0), at(2_010.0));
        assert_eq!((at(2_010.0).harmonic, at(2_010.0).harmonic_hz()), (3, 6_030.0));
        assert!((at(2_000.0).change / (2.0 * CHANGE_LIMIT) - 1.0).abs() < 1e-2, "{:?}", at(2_000.0));
    }

    /// A harmonic of a thousandth of the motion may be fast: it changes nothing. The same beside a still motion does.
    #[test]
    fn a_small_harmonic_changes_little() {
        let change = ElasticChange::of(&[0.5, 0.0, 0.001], [4_000.0; 2], ELASTIC);
        assert!(!change.matters(1.0), "{change:?}");
        assert!(ElasticChange::of(&[0.0, 0.0, 0.001], [4_000.0; 2], ELASTIC).matters(0.002));
    }

    /// A motion that passes through a mode meets it between the places that are looked at; far above a mode the gear no longer gives way, and all of the harmonic is off.
    #[test]
    fn passing_a_mode_is_seen() {
        let passing = ElasticChange::of(&[0.001], [10_000.0, 30_000.0], ELASTIC);
        assert_eq!(passing.mesh_hz, 24_000.0);
        assert!((passing.change - 0.002 * 50.0).abs() < 1e-4, "{passing:?}");
        assert!((ElasticChange::of(&[1.0], [1e6; 2], ELASTIC).change - 2.0).abs() < 1e-2);
        assert_eq!(ElasticChange::of(&[], [1.0; 2], ELASTIC).change, 0.0);
    }
}
