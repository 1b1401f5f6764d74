//! Face load factor K_Hbeta from the solved load distribution. Theory (34a).

use contact::SliceResult;

/// K_Hbeta by its definition in ISO 6336-1 (not its estimates): the largest load per width divided by the mean one.
/// Each height of the face counts with the largest line load over the mesh; heights without load count as 0.
///
/// `loaded` are the loaded slices of all pairs and positions, of a face with `slices` slices. `None` without load.
pub fn face_load_factor<'a>(slices: usize, loaded: impl IntoIterator<Item = &'a SliceResult>) -> Option<f64> {
    let of_height = envelope(loaded);
    let largest = of_height.iter().map(|(_, load)| *load).fold(0.0, f64::max);
    let mean = of_height.iter().map(|(_, load)| load).sum::<f64>() / slices.max(1) as f64;
    (largest > 0.0).then_some(largest / mean)
}

/// Height on the pinion (mm) and largest line load (N/mm) at each height of the face, in the order of first occurrence.
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
