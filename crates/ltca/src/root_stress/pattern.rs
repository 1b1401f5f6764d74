//! Largest tensions at the points of a gear's fillets over a run.

use geometry::Side;
use serde::Serialize;

use super::FilletField;

/// Largest first principal stress at each point of the fillet below the loaded flank of one tooth, over all teeth and
/// positions.
///
/// Points are the nodes of the first fillet that came; what comes to a node of another tooth counts at the nearest of them.
/// Stress above the peak of its fillet rises up to the flank, where contact makes it, and does not count
/// ([`super::ROOT_STRESS_DEFINITION`]): the largest value is the reported root stress, at its place.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct RootPattern {
    /// Distance from the gear's axis and height from mid-face of each point, mm.
    pub places: Vec<[f64; 2]>,
    /// Largest first principal stress of each point, MPa; 0 where nothing that counts pulls.
    pub tension: Vec<f64>,
}

/// Points of two teeth that are one, over the radius.
const SAME: f64 = 1e-7;

impl RootPattern {
    /// Takes the fillets of a position on one side of the teeth.
    pub fn take(&mut self, fields: &[FilletField], side: Side) {
        for field in fields.iter().filter(|own| own.peaks.side == side) {
            if self.places.is_empty() {
                self.places = field.places.iter().map(|p| [p.radius, p.z]).collect();
                self.tension = vec![0.0; self.places.len()];
            }
            let most = field.peaks.max_principal.stress;
            for (i, place) in field.places.iter().enumerate().filter(|own| own.1.max_principal <= most) {
                let Some(own) = self.nearest(i, [place.radius, place.z]) else { continue };
                self.tension[own] = self.tension[own].max(place.max_principal);
            }
        }
    }

    /// The point that a place is; `i`: its number in the fillets of meshes whose teeth are alike.
    fn nearest(&self, i: usize, [radius, z]: [f64; 2]) -> Option<usize> {
        let away = |at: &[f64; 2]| (at[0] - radius).hypot(at[1] - z);
        if self.places.get(i).is_some_and(|at| away(at) <= SAME * radius) {
            return Some(i);
        }
        let near = self.places.iter().enumerate().min_by(|a, b| away(a.1).total_cmp(&away(b.1)));
        near.map(|(i, _)| i)
    }
}
