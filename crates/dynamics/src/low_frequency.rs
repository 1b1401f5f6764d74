//! Frequency range in which quasi-static elasticity is valid.

/// Largest ratio of an exciting frequency to a gear's lowest elastic frequency at which elasticity counts as
/// quasi-static.
///
/// ```text
/// c(f) = sum_j phi_j phi_j' / (omega_j^2 - omega^2) <= c(0) / (1 - r^2),   r = f / f_1
/// ```
/// f_1 is the gear's lowest frequency with its bore held and its flanks free. At r = 1/4 a gear deflects by 7 % more
/// than in static equilibrium if all of its compliance is in its lowest mode, and by less otherwise. The effect on the
/// dynamic transmission error of two discs on thin shafts (`crates/gearbox/tests/gearbox_laws/modes_in_motion.rs`) is 1
/// % at 0.1, 4 to 5 % at 0.2, 7 to 8 % at the limit, 10 to 14 % at 0.3, and 100 % at 1. With the flanks held the lowest
/// frequency of such gears is up to twice as high, so as a limit it would warn too late.
pub const LOW_FREQUENCY_LIMIT: f64 = 0.25;

/// Share of the peak to peak whose change is reported to the user: the change of one harmonic at
/// [`LOW_FREQUENCY_LIMIT`], 1/(1 - r^2) - 1 = 1/15.
pub const CHANGE_LIMIT: f64 =
    LOW_FREQUENCY_LIMIT * LOW_FREQUENCY_LIMIT / (1.0 - LOW_FREQUENCY_LIMIT * LOW_FREQUENCY_LIMIT);

/// Least damping ratio of the mesh that is reckoned with.
const MESH_DAMPING: f64 = 0.005;
/// Mesh frequencies at which a motion that passes through many is looked at, beside those that meet a resonance.
const PLACES: usize = 256;

/// The mesh resonance: frequency of the two gears on the mean stiffness of their teeth, Hz, and its damping ratio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshResonance {
    /// Frequency of the resonance, Hz.
    pub hz: f64,
    /// Damping ratio of the resonance.
    pub damping: f64,
}

/// Possible change of the transmission error by neglected elastic inertia. Theory (63).
///
/// ```text
/// x_k = A_k / |1 - rho_k^2 + 2 i zeta rho_k|,   rho_k = k f_m / f_0,   r_k = k f_m / f_1
/// change(f_m) = sum_k x_k min(|1 / (1 - r_k^2) - 1|, 1),   share = max change / max sum_k x_k
/// ```
/// A_k are harmonics of the quasi-static transmission error, f_0 is the mesh resonance, f_1 the lowest elastic
/// frequency. If all compliance is in the lowest mode, teeth and bodies deflect by 1/(1 - r^2) times the static
/// deflection, and a harmonic changes by the corresponding share (compared with measurements in
/// `crates/gearbox/tests/gearbox_laws/modes_in_motion.rs`), at most completely. Both maxima are over the mesh
/// frequencies that the motion passes.
#[derive(Debug, Clone, PartialEq)]
pub struct ElasticChange {
    /// Mesh frequency with the largest possible change, Hz.
    pub mesh_hz: f64,
    /// Mesh harmonic that contributes most, 1 for the mesh frequency itself.
    pub harmonic: usize,
    /// Lowest elastic frequency of pinion and wheel, with bore held and flanks free, Hz
    /// ([`reduction::LowestFrequencies::flanks_free_hz`]), or the highest mode that is kept.
    pub elastic_hz: [f64; 2],
    /// Share by which the peak to peak may change.
    pub share: f64,
}

impl ElasticChange {
    /// `amplitudes` are those of mesh harmonics 1, 2, ... of the quasi-static transmission error; `mesh_hz` has the
    /// lowest and highest mesh frequency of the motion.
    pub fn of(amplitudes: &[f64], mesh_hz: [f64; 2], elastic_hz: [f64; 2], resonance: MeshResonance) -> Self {
        let lowest = elastic_hz[0].min(elastic_hz[1]);
        let [from, to] = mesh_hz;
        let part = |k: usize, mesh: f64| {
            let hz = (k + 1) as f64 * mesh;
            let size = amplitudes[k].abs() * resonance.response(hz);
            [size, size * off(hz / lowest)]
        };
        let passed = (0..=PLACES).map(|i| from + (to - from) * i as f64 / PLACES as f64);
        let met = (1..=amplitudes.len()).flat_map(|k| [lowest / k as f64, resonance.hz / k as f64]);
        let met = met.filter(|f| (from..to).contains(f));
        let (mut worst, mut largest, mut most) =
            (Self { mesh_hz: to, harmonic: 1, elastic_hz, share: 0.0 }, 0.0f64, 0.0);
        for mesh in passed.chain(met) {
            let parts: Vec<[f64; 2]> = (0..amplitudes.len()).map(|k| part(k, mesh)).collect();
            largest = largest.max(parts.iter().map(|p| p[0]).sum());
            let change: f64 = parts.iter().map(|p| p[1]).sum();
            if change > most {
                let first = |best: usize, k: usize| if parts[k][1] > parts[best][1] { k } else { best };
                most = change;
                worst.mesh_hz = mesh;
                worst.harmonic = 1 + (0..parts.len()).fold(0, first);
            }
        }
        worst.share = if largest > 0.0 { most / largest } else { 0.0 };
        worst
    }

    /// Frequency of the harmonic, Hz.
    pub fn harmonic_hz(&self) -> f64 {
        self.harmonic as f64 * self.mesh_hz
    }

    /// Harmonic times mesh frequency, divided by the lowest elastic frequency of pinion and wheel.
    pub fn ratios(&self) -> [f64; 2] {
        self.elastic_hz.map(|f| self.harmonic_hz() / f)
    }

    /// The larger of the two ratios.
    pub fn largest_ratio(&self) -> f64 {
        self.ratios().into_iter().fold(0.0, f64::max)
    }

    /// Whether the change must be reported to the user.
    pub fn matters(&self) -> bool {
        self.share > CHANGE_LIMIT
    }
}

impl MeshResonance {
    /// |1 / (1 - rho^2 + 2 i zeta rho)|.
    fn response(&self, hz: f64) -> f64 {
        let (rho, zeta) = (hz / self.hz, self.damping.max(MESH_DAMPING));
        1.0 / (1.0 - rho * rho).hypot(2.0 * zeta * rho)
    }
}

/// What a lowest mode changes in a deflection at r times its frequency, over that deflection: all of it at the most.
fn off(r: f64) -> f64 {
    let rest = 1.0 - r * r;
    (r * r / rest.abs().max(f64::MIN_POSITIVE)).min(1.0)
}

#[cfg(test)]
mod tests {
    use crate::*;

    const ELASTIC: [f64; 2] = [36_000.0, 24_000.0];
    const LOW: MeshResonance = MeshResonance { hz: 50.0, damping: 0.05 };

    /// One harmonic alone matters from a quarter of the lower elastic frequency on, wherever the mesh resonance is.
    #[test]
    fn one_harmonic_matters_from_the_limit_on() {
        for resonance in [LOW, MeshResonance { hz: 20_000.0, damping: 0.05 }] {
            let at = |mesh_hz: f64| ElasticChange::of(&[0.0, 0.0, 1.0], [mesh_hz; 2], ELASTIC, resonance);
            assert!(!at(1_990.0).matters() && at(2_010.0).matters(), "{:?} {:?}", at(1_990.0), at(2_010.0));
            assert_eq!((at(2_010.0).harmonic, at(2_010.0).harmonic_hz()), (3, 6_030.0));
            assert!((at(4_000.0).share * 3.0 - 1.0).abs() < 1e-12, "{:?}", at(4_000.0));
            assert_eq!(at(8_000.0).share, 1.0, "at its own frequency the gear gives way to everything");
        }
    }

    /// Far below every elastic frequency nothing is left out.
    #[test]
    fn slow_gears_change_little() {
        assert!(ElasticChange::of(&[1.0, 0.5], [500.0; 2], ELASTIC, LOW).share < 2e-3);
    }

    /// A harmonic of a thousandth of the motion may be as fast as it likes.
    #[test]
    fn a_small_harmonic_changes_little() {
        let resonance = MeshResonance { hz: 4_000.0, damping: 0.05 };
        let change = |a: &[f64]| ElasticChange::of(a, [500.0; 2], ELASTIC, resonance);
        let mut all = [0.0; 32];
        (all[0], all[24]) = (0.1, 0.0001);
        assert!(change(&all[..24]).share < 0.01 && !change(&all).matters(), "{:?}", change(&all));
        all[0] = 0.0;
        assert!(change(&all).matters(), "the only one there is: {:?}", change(&all));
        assert_eq!(change(&[]).share, 0.0);
    }

    /// A motion that passes many mesh frequencies is judged by its largest: what is fast and small beside its resonance
    /// does not matter, what is fast alone does.
    #[test]
    fn a_passage_is_judged_by_its_largest() {
        let resonance = MeshResonance { hz: 4_000.0, damping: 0.02 };
        let of = |range: [f64; 2]| ElasticChange::of(&[1.0], range, ELASTIC, resonance);
        assert!(!of([2_000.0, 12_000.0]).matters(), "{:?}", of([2_000.0, 12_000.0]));
        assert!(of([11_000.0, 12_000.0]).matters(), "{:?}", of([11_000.0, 12_000.0]));
    }
}
