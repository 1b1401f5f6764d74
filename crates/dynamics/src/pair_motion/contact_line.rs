//! Length of the contact lines from the forces and gaps of the slices.

use geometry::GearPair;

use crate::MeshContact;

/// Total length of the contact lines of the last evaluation, mm.
///
/// A slice that presses overlaps by its local approach, one that does not gapes by its opened gap; between two stations, and from the last ones to the end faces, this goes along
/// a straight line, and the contact ends where it is zero. So the length is continuous in the position of the gears.
pub(super) fn length(pair: &GearPair, contact: &MeshContact) -> f64 {
    let Some(stations) = contact.contact_set().slices().map(|s| s.stations()) else { return 0.0 };
    let half = 0.5 * pair.face_width();
    let step = stations.get(1).map_or(2.0 * half, |z| z - stations[0]);
    let rows = contact.rows();
    let (forces, openings) = (contact.solver().forces(), contact.solver().openings());
    // Rows are the stations that the deepest overlap may close: beyond them the flanks gape by more.
    let reach = rows.iter().fold(0.0, |m: f64, row| m.max(-row.gap));
    let mut length = 0.0;
    let mut from = 0;
    while from < rows.len() {
        let patches = rows[from].patches;
        let to = from + rows[from..].iter().take_while(|row| row.patches == patches).count();
        let mut values = vec![reach; stations.len()];
        for i in from..to {
            let law = contact.slices()[i].local.under(forces[i] / contact.slices()[i].length);
            values[rows[i].point] = if forces[i] > 0.0 { -law.approach } else { rows[i].gap + openings[i] };
        }
        length += below_zero(&values, step);
        from = to;
    }
    length / pair.base_helix_angle().cos()
}

/// Length over which the polygon through `values`, `step` apart and going on straight for half a step at either end, is below zero.
fn below_zero(values: &[f64], step: f64) -> f64 {
    let part = |a: f64, b: f64| match (a < 0.0, b < 0.0) {
        (true, true) => 1.0,
        (false, false) => 0.0,
        (true, false) => a / (a - b),
        (false, true) => b / (b - a),
    };
    let inner: f64 = values.windows(2).map(|w| part(w[0], w[1])).sum();
    let end = |last: f64, before: f64| 0.5 * part(last, last + 0.5 * (last - before));
    let ends = match values {
        [] => 0.0,
        [only] => part(*only, *only),
        [first, second, ..] => end(*first, *second) + end(values[values.len() - 1], values[values.len() - 2]),
    };
    step * (inner + ends)
}

#[cfg(test)]
mod tests {
    use super::below_zero;

    /// A line that lets go somewhere loses its length without a jump.
    #[test]
    fn length_is_continuous() {
        let at = |shift: f64| {
            let values: Vec<f64> = (0..10).map(|i| (0.5 + f64::from(i)) - shift).collect();
            below_zero(&values, 1.0)
        };
        for i in 0..=100 {
            let shift = 0.1 * f64::from(i);
            assert!((at(shift) - shift).abs() < 1e-12, "{shift}: {}", at(shift));
        }
        assert_eq!(below_zero(&[-1.0; 4], 0.5), 2.0);
        assert_eq!(below_zero(&[1.0; 4], 0.5), 0.0);
    }
}
