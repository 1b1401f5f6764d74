//! Extrapolation of a map beyond its range of tilts. Theory (73a).

use crate::{
    load_axis::knot,
    map::{Beyond, ContactMap, CutPlace},
};

impl ContactMap {
    /// Goes on from an end of the tilts by `way` of their spacing. A cubic would go anywhere there. The slope over tilt turns
    /// into that at first touch, where the end of a line presses, so that approaches grow with the load as they do at the end.
    /// Theory (73a).
    ///
    /// ```text
    /// X = X_e + h X_e' + (way - h) X_e'(F = 0),   h = way / (1 + 2 |way|)
    /// ```
    pub(crate) fn go_beyond(&self, place: &mut CutPlace, way: f64) {
        let far = 1.0 + 2.0 * way.abs();
        let (h, rate, bend) = (way / far, far.powi(-2), -4.0 * way.signum() * far.powi(-3));
        let (values, slopes) = (place.phase.values, place.phase.slopes);
        let at_touch = |weights: [f64; 4], place: &mut CutPlace| {
            (place.phase.values, place.tilt.values) = (weights, place.tilt.slopes);
            let [k0, k1, k2, _] = self.in_cell(&self.approach, place, 0);
            knot([k0, k1, k2])
        };
        let tilt = place.tilt;
        let [edge, edge_by_phase] = [values, slopes].map(|weights| at_touch(weights, place));
        (place.phase.values, place.tilt) = (values, tilt);
        place.tilt.go_on(h, [rate, bend]);
        place.beyond = Some(Beyond { edge, edge_by_phase, factors: [way - h, 1.0 - rate, -bend] });
    }
}
