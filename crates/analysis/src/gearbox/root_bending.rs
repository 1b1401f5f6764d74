//! Alternating stress of a gear's root fillets by all its meshes.

use answer::Remark;
use gearbox::GearboxPosition;
use geometry::Side;
use ltca::{FilletField, FilletPlace};
use scene::gearbox::Gearbox;

use crate::{remark, results::DOUBTFUL_PERCENT};

/// Stress of the root fillets on one side of a gear's teeth at the point of largest tension, over all positions and all
/// meshes of the gear.
///
/// ```text
/// R = sigma_min/sigma_max,   range = sigma_max - sigma_min
/// ```
/// sigma_max is the largest first principal stress of the fillet, at its bending peak; sigma_min the smallest third
/// principal stress at the same point. Loads on only one flank give R of -0.2 to -0.5, because the load on the
/// neighbouring tooth compresses the fillet. Teeth of idlers and planets are loaded on both flanks alternately: R is
/// near -1.2 (ISO 6336-3, annex B). The stress of a mesh is that of its own forces. Theory (22e).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RootBending {
    /// Side of the teeth.
    pub side: Side,
    /// Largest stress sigma_max, MPa.
    pub largest: f64,
    /// Estimated error of sigma_max, %.
    pub error_percent: f64,
    /// Smallest stress sigma_min, MPa; negative for compression.
    pub least: f64,
}

impl RootBending {
    /// The fillets on a side by what positions show of them; `None` of none.
    fn of<'a>(side: Side, shown: impl Iterator<Item = &'a FilletField> + Clone) -> Option<Self> {
        let own = shown.filter(|field| field.peaks.side == side);
        let worst = own
            .clone()
            .map(|field| &field.peaks)
            .reduce(|best, now| if now.max_principal.seen() > best.max_principal.seen() { now } else { best })?;
        let peak = worst.max_principal;
        let apart = |place: &FilletPlace| (place.radius - peak.radius).hypot(place.z - peak.z);
        let there = own.filter_map(|field| field.places.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))));
        let least = there.map(|place| place.min_principal).fold(f64::INFINITY, f64::min);
        Some(Self { side, largest: peak.stress, error_percent: 100.0 * peak.relative_error(), least })
    }

    /// Range of the stress, MPa.
    pub fn range(&self) -> f64 {
        self.largest - self.least
    }

    /// Stress ratio R; `None` without tension.
    pub fn ratio(&self) -> Option<f64> {
        (self.largest > 0.0).then(|| self.least / self.largest)
    }
}

/// Fillets on both sides of the teeth of every gear, that with the larger tension first; `None` of gears of which no mesh
/// knows root stress.
pub(super) fn root_bending(file: &Gearbox, positions: &[GearboxPosition]) -> Vec<Option<[RootBending; 2]>> {
    let of_gear = |gear: usize| {
        let ends: Vec<(usize, usize)> = (file.meshes.iter().enumerate())
            .filter_map(|(i, mesh)| Some((i, mesh.gears.iter().position(|own| *own == gear)?)))
            .collect();
        let shown =
            positions.iter().flat_map(|p| ends.iter().flat_map(|(mesh, end)| &p.meshes[*mesh].root_stress[*end]));
        let [right, left] = [RootBending::of(Side::Right, shown.clone())?, RootBending::of(Side::Left, shown)?];
        Some(if right.largest >= left.largest { [right, left] } else { [left, right] })
    };
    (0..file.gears.len()).map(of_gear).collect()
}

/// What the user should hear of gears whose mesh is too coarse in the fillets.
pub(super) fn remarks<'a>(file: &'a Gearbox, all: &'a [Option<[RootBending; 2]>]) -> impl Iterator<Item = Remark> + 'a {
    let one = |(gear, own): (&'a scene::gearbox::GearboxGear, &'a Option<[RootBending; 2]>)| {
        let [worst, _] = own.as_ref()?;
        (worst.error_percent > DOUBTFUL_PERCENT)
            .then(|| remark::root_stress_coarse(format!("gear \"{}\"", gear.name), worst.largest, worst.error_percent))
    };
    file.gears.iter().zip(all).filter_map(one)
}
