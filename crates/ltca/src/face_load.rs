//! How unevenly the load lies over the face width, from its solved distribution. Theory (34a).

use contact::SliceResult;

/// K_Hbeta after ISO 6336-1 (its definition, not its estimates): the largest load per width over the mean one, of the
/// largest line loads that each height of the face sees over the mesh; heights without load count as 0.
///
/// `loaded`: the loaded slices of all pairs and positions, of a face of `slices` slices. `None` without load.
pub fn face_load_factor<'a>(slices: usize, loaded: impl IntoIterator<Item = &'a SliceResult>) -> Option<f64> {
    let of_height = envelope(loaded);
    let largest = of_height.iter().map(|(_, load)| *load).fold(0.0, f64::max);
    let mean = of_height.iter().map(|(_, load)| load).sum::<f64>() / slices.max(1) as f64;
    (largest > 0.0).then_some(largest / mean)
}

/// Height on the pinion (mm) and largest line load (N/mm) that each height of the face sees, in the order in which they
/// come.
pub fn envelope<'a>(loaded: impl IntoIterator<Item = &'a SliceResult>) -> Vec<(f64, f64)> {
    let mut of_height: Vec<(f64, f64)> = Vec::new();
    for slice in loaded {
        // Slices lie at the same heights in all positions.
        match of_height.iter_mut().find(|(z, _)| *z == slice.z) {
            Some((_, largest)) => *largest = largest.max(slice.line_load),
            None => of_height.push((slice.z, slice.line_load)),
        }
    }
    of_height
}
