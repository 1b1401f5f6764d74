//! The half tooth of a spur gear, resolved: flank (tip edge sharp or rounded) and tip land free, centre surface and
//! foot clamped.

use faer::Mat;
use geometry::Gear;

use super::plane::{Lattice, Vec2, graded};

/// Compliance of the part of a flank that a band can reach.
pub struct Resolved {
    /// Distance of the nodes from the sharp tip corner along the flank, mm; on a rounded edge along the flank's
    /// tangent.
    pub x: Vec<f64>,
    pub compliance: Mat<f64>,
}

/// What is meshed.
pub struct HalfSection<'a> {
    pub gear: &'a Gear,
    pub young: f64,
    pub poisson: f64,
    /// Radius of the tip edge, mm; 0: sharp.
    pub edge_radius: f64,
}

/// One place of the half tooth's outline.
struct Outline {
    x: f64,
    r: f64,
    angle: f64,
    inward: Vec2,
}

impl HalfSection<'_> {
    /// Distance from the corner where the flank ends: 0, or where the arc begins.
    pub fn flank_start(&self) -> f64 {
        let omega = std::f64::consts::FRAC_PI_2 + self.gear.profile().roll_tip().atan();
        self.edge_radius / (0.5 * omega).tan()
    }

    /// The flank with nodes at the distances `fine` from the corner (element ends and middles by turns, ascending), all
    /// of the arc before them when the first one is [`HalfSection::flank_start`] of a rounded edge.
    pub fn resolve(&self, fine: &[f64]) -> Resolved {
        let profile = self.gear.profile();
        let (tip, form, base) = (profile.roll_tip(), profile.roll_form(), self.gear.base_radius());
        let length = 0.5 * base * (tip * tip - form * form);
        let on_flank = |x: f64| {
            let u = if x >= length { form } else { (tip * tip - 2.0 * x / base).max(form * form).sqrt() };
            let angle = profile.half_angle(u);
            let slant = angle - u.atan();
            Outline { x, r: profile.radius(u), angle, inward: [slant.sin(), -slant.cos()] }
        };
        let (tangent, h) = (self.flank_start(), fine[2] - fine[0]);
        let mut outline: Vec<Outline> = Vec::new();
        if self.edge_radius > 0.0 {
            // From the top of the arc, where it runs along a circle about the axis, to the flank.
            let end = on_flank(tangent);
            let [nx, ny] = end.inward;
            let at = [end.r * end.angle.cos(), end.r * end.angle.sin()];
            let centre = [at[0] + self.edge_radius * nx, at[1] + self.edge_radius * ny];
            let up = centre[1].atan2(centre[0]);
            let from = (-ny).atan2(-nx);
            let count = 2 * ((self.edge_radius * (from - up) / h).ceil() as usize).max(6);
            for i in 0..count {
                let turn = up + (from - up) * i as f64 / count as f64;
                let p = [centre[0] + self.edge_radius * turn.cos(), centre[1] + self.edge_radius * turn.sin()];
                let x = tangent - self.edge_radius * (from - turn).sin();
                outline.push(Outline { x, r: p[0].hypot(p[1]), angle: p[1].atan2(p[0]), inward: end.inward });
            }
        }
        let along = graded(tangent, fine, length, 1.25, 0.06 * length);
        outline.extend(along.iter().map(|&x| on_flank(x)));
        let foot = 16;
        outline.extend((1..=foot).map(|i| {
            let (r, angle) = profile.fillet(1.0 - 0.9 * f64::from(i) / f64::from(foot));
            Outline { x: f64::INFINITY, r, angle, inward: [0.0; 2] }
        }));
        let depth = outline[0].r * outline[0].angle.sin();
        let first = (h / depth).min(0.1);
        let across = graded(0.0, &[0.0, 0.5 * first, first], 1.0, 1.25, 0.12);
        let point = |row: usize, column: usize| -> Vec2 {
            let Outline { r, angle, .. } = outline[row];
            let angle = angle * (1.0 - across[column]);
            [r * angle.cos(), r * angle.sin()]
        };
        let (rows, columns) = (outline.len() - 1, across.len() - 1);
        let lattice = Lattice {
            rows,
            columns,
            point: &point,
            clamped: &|row, column| row == rows || column == columns,
            young: self.young,
            poisson: self.poisson,
        };
        let with_arc = self.edge_radius > 0.0 && fine[0] <= tangent + 1e-12;
        let reached = fine[fine.len() - 1] + 1e-12;
        let first = outline.iter().position(|o| with_arc || o.x >= fine[0] - 1e-12).unwrap_or(0);
        let last = outline.iter().rposition(|o| o.x <= reached).unwrap_or(rows - 1);
        let inward: Vec<Vec2> = outline[first..=last].iter().map(|o| o.inward).collect();
        let x = outline[first..=last].iter().map(|o| o.x).collect();
        Resolved { x, compliance: lattice.compliance(first, last, &inward) }
    }
}
