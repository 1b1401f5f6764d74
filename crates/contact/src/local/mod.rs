//! Local compliance of a line contact, which the mesh of a gear is too coarse to resolve. Theory (19c).

mod deviation;
mod edge;
mod end_face;
mod four_laws;
mod laws;
mod layer;

pub use deviation::BandMean;
pub(crate) use deviation::SAMPLES;
use edge::Edge;
pub use edge::wedge_softening;
pub use end_face::EndFace;
pub use laws::LocalLaw;
pub(crate) use laws::LocalLaws;
pub use layer::layer_constant;

/// One of the two flanks at the contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalBody {
    /// Young's modulus, MPa.
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Layer constant c at this position, without the effect of the tip edge: from `reduction::LayerProfile`, or
    /// [`layer_constant`] for a layer without ends (`tip_angle` PI).
    pub layer: f64,
    /// Depth t of the layer, mm: from the flank to the centre surface of its tooth.
    pub depth: f64,
    /// Distance d from the contact to the tip edge along the profile, mm, measured to the sharp corner even if it is
    /// rounded; 0 if the edge itself touches.
    pub tip_distance: f64,
    /// Angle between flank and tip land, inside the material, rad; PI if there is no edge.
    pub tip_angle: f64,
    /// d/dx [c + (1 + eta) ln t] at the tip, 1/mm, where x is the distance from the edge. It is needed because the band
    /// of an edge contact lies slightly inside the edge.
    pub tip_gradient: f64,
    /// Radius of the arc that rounds the tip edge, tangent to flank and tip land, mm; 0: sharp edge.
    pub edge_radius: f64,
    /// The two end faces of the gear.
    pub ends: [EndFace; 2],
}

/// Line contact of two flanks at one axial station.
#[derive(Debug, Clone, PartialEq)]
pub struct LocalContact {
    /// Data of the two flanks.
    pub bodies: [LocalBody; 2],
    /// Relative radius of curvature in the normal plane, mm.
    pub radius: f64,
    /// Distance beyond the tip edge at which the smooth flanks would touch, mm of arc along the extended flank of the
    /// edge; 0 on the line of action. The edge is that of the body with the smaller `tip_distance`.
    ///
    /// It is the radius times the angle (rad) by which the flanks diverge at the edge.
    pub off_line: f64,
    /// Effect on the band of flanks that deviate from their smooth surfaces; `None` if they do not. m(0) is part of the
    /// gap, not of the approach.
    pub deviation: Option<Box<BandMean>>,
}

/// A line contact under load.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LocalState {
    /// Approach of the two flanks, mm.
    pub approach: f64,
    /// d approach / d line load, mm^2/N.
    pub slope: f64,
    /// Half-width of the band, mm.
    pub half_width: f64,
    /// Largest pressure across the band, MPa.
    pub pressure: f64,
}

impl LocalContact {
    /// State under a line load q (N/mm), per unit length of contact line.
    ///
    /// ```text
    /// delta = sum over both flanks of K_b q [ln(2 t / a) + 1/2 + c + E + eta ln(t / l) + g (l - d)] + (K_1 + K_2) q P
    ///         + m(a) - m(0)
    /// K_b = 2 (1 - nu^2) / (pi E)
    /// ```
    /// a is the half-width after Hertz; c is [`LocalBody::layer`]; E the softening by the end faces; eta is
    /// [`wedge_softening`]; l the distance between load and tip edge, equal to d for a narrow band; g is
    /// [`LocalBody::tip_gradient`]; P the effect of a band that is cut off by the edge; m is [`BandMean`]. All terms
    /// have continuous slopes, from the middle of the flank to an edge far off the line of action. Without load all
    /// values are 0, and the slope is that of a negligibly small load.
    pub fn under(&self, load: f64) -> LocalState {
        self.law().under(load)
    }

    /// The local law: the part that does not depend on the load, computed once.
    pub fn law(&self) -> LocalLaw {
        LocalLaw::new(self)
    }

    /// Increase of the gap between the sharp flanks by the rounding of the edge, mm: the arc lies behind the corner
    /// that it replaces. 0 without an edge radius and away from the edge.
    pub fn edge_opening(&self) -> f64 {
        let rounded = self.bodies.iter().any(|body| body.edge_radius > 0.0);
        if rounded { self.edges().iter().map(Edge::opening).sum() } else { 0.0 }
    }

    fn edges(&self) -> [Edge; 2] {
        let [first, second] = self.bodies.map(|b| b.tip_distance);
        let past = if first <= second { [self.off_line, 0.0] } else { [0.0, self.off_line] };
        [0, 1].map(|i| {
            let body = &self.bodies[i];
            Edge {
                distance: body.tip_distance - past[i],
                angle: body.tip_angle,
                arc: body.edge_radius.max(0.0),
                radius: self.radius,
            }
        })
    }
}
