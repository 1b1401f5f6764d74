//! The face load factor, from the solved distribution of the load.

use ltca::StaticHistory;

/// K_Hbeta after ISO 6336-1 (its definition, not its estimates): the largest load per width over the mean one, of the
/// largest line loads that each height of the face sees over the mesh; heights without load count as 0.
///
/// `None` where points touch, and without load.
pub fn face_load_factor(slices: usize, history: &StaticHistory) -> Option<f64> {
    let loaded = history.positions.iter().flat_map(|position| &position.pairs).flat_map(|pair| &pair.slices);
    let mut of_height: Vec<(f64, f64)> = Vec::with_capacity(slices);
    for slice in loaded {
        // Slices lie at the same heights in all positions.
        match of_height.iter_mut().find(|(z, _)| *z == slice.z) {
            Some((_, largest)) => *largest = largest.max(slice.line_load),
            None => of_height.push((slice.z, slice.line_load)),
        }
    }
    let largest = of_height.iter().map(|(_, load)| *load).fold(0.0, f64::max);
    let mean = of_height.iter().map(|(_, load)| load).sum::<f64>() / slices.max(1) as f64;
    (largest > 0.0).then_some(largest / mean)
}
