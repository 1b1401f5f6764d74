//! Length of the contact lines from the forces and gaps of the slices.

use contact::{MeshContact, Pose, covered, line_station, slice_line};
use geometry::GearPair;

/// Total length of the contact lines of the last evaluation, with the gears' frames at `poses`, mm: as that of a
/// position at rest, theory (21b).
pub(super) fn length(pair: &GearPair, contact: &MeshContact, poses: &[Pose; 2]) -> f64 {
    let half = 0.5 * pair.face_width();
    let rows = contact.rows();
    let (forces, openings) = (contact.solver().forces(), contact.solver().openings());
    let mut length = 0.0;
    let mut from = 0;
    while from < rows.len() {
        let patches = rows[from].patches;
        let to = from + rows[from..].iter().take_while(|row| row.patches == patches).count();
        let stations = (from..to).map(|i| {
            let (row, slice) = (&rows[i], &contact.slices()[i]);
            let station = line_station(row.gap, openings[i], slice, forces[i], contact.modal_opening(i));
            (row.point, station, *slice)
        });
        length += covered(&slice_line(contact.contact_set(), poses, patches, stations, half), [-half, half]);
        from = to;
    }
    length / pair.base_helix_angle().cos()
}
