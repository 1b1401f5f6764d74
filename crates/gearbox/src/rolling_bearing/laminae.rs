//! Cylindrical rollers lamina by lamina, for a bore that gives way under them. Theory (99), (38b).

use nalgebra::Matrix5;

use super::{
    ElementLoad, RollingBearing, RollingElements, RollingReply,
    law::{LoadedRow, pitch_of},
    life::LaminaCapacity,
    roller::LAMINAE,
};

/// Cylindrical rollers of all rows.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Cylinders {
    /// Their laminae, roller by roller of each row in turn.
    pub laminae: Vec<Lamina>,
    /// Number of rollers of a row.
    pub a_row: usize,
    /// Diameter of the outer race, mm.
    pub race: f64,
    /// Where the rollers end over the middle of the bearing, mm along +z.
    pub ends: [f64; 2],
}

/// A lamina of a roller.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Lamina {
    /// Angle of the roller, rad from +x towards +y.
    pub angle: f64,
    /// Height over the middle of the bearing, mm along +z.
    pub height: f64,
    /// What the rings have to approach by until it presses, mm.
    pub gap: f64,
}

/// Approach of the rings at a lamina below which its force is proportional to it, mm: far below all that counts.
const LEAST_APPROACH: f64 = 1e-10;

impl RollingBearing {
    /// Its rollers; `None` of balls and tapered rollers, which press along the axis as well.
    pub(crate) fn cylinders(&self) -> Option<Cylinders> {
        let RollingElements::Rollers(own) = self.elements() else { return None };
        if own.contact_angle != 0.0 {
            return None;
        }
        let (mut laminae, mut ends) = (Vec::new(), [f64::INFINITY, f64::NEG_INFINITY]);
        for row in &self.rows {
            let LoadedRow::Rollers(row) = row else { return None };
            laminae.extend(row.laminae().map(|(element, height, gap)| Lamina {
                angle: element as f64 * pitch_of(own.elements),
                height,
                gap,
            }));
            let middle = row.position();
            ends = [ends[0].min(middle - 0.5 * own.length), ends[1].max(middle + 0.5 * own.length)];
        }
        Some(Cylinders { laminae, a_row: own.elements, race: own.pitch_diameter + own.diameter, ends })
    }

    /// Approach (mm) of the rings at a lamina under a force (N), and its slope: delta = (F/c)^(9/10).
    pub(crate) fn lamina_under(&self, force: f64) -> (f64, f64) {
        let stiffness = match &self.rows[0] {
            LoadedRow::Rollers(own) => own.stiffness(),
            LoadedRow::Balls(_) => return (0.0, 0.0),
        };
        let approach = (force.max(0.0) / stiffness).powf(0.9);
        if approach > LEAST_APPROACH {
            return (approach, 0.9 * approach / force);
        }
        let slope = LEAST_APPROACH / (stiffness * LEAST_APPROACH.powf(10.0 / 9.0));
        (slope * force, slope)
    }

    /// Forces of all rollers by those of their laminae: the load zone.
    pub fn zone_of(&self, laminae: &[f64]) -> Vec<ElementLoad> {
        let a_row = self.count() / self.rows.len();
        let of = |(roller, own): (usize, &[f64])| ElementLoad {
            row: roller / a_row,
            angle: (roller % a_row) as f64 * pitch_of(a_row),
            force: own.iter().sum(),
        };
        laminae.chunks(LAMINAE).enumerate().map(of).collect()
    }

    /// Share of the life used by a million revolutions, as [`RollingBearing::damage`], by the forces of the laminae;
    /// the outer ring turns under the load.
    pub fn damage_of(&self, laminae: &[f64], dynamic_rating: f64) -> f64 {
        let RollingElements::Rollers(rollers) = self.elements() else { return 0.0 };
        let capacity = LaminaCapacity::new(rollers, self.rows.len(), dynamic_rating);
        let a_row = rollers.elements * LAMINAE;
        let of_row = |row: &[f64]| -> f64 {
            (0..LAMINAE).map(|k| capacity.used(k, row.chunks(LAMINAE).map(|own| own[k]), 1)).sum()
        };
        laminae.chunks(a_row).map(of_row).sum::<f64>().powf(8.0 / 9.0)
    }

    /// What laminae press a bore with: force on the gear by their levers, energy of their approach, pressure; without a
    /// stiffness.
    pub(crate) fn reply_of(&self, laminae: &[f64], levers: &[[f64; 6]]) -> RollingReply {
        let mut reply = RollingReply::nothing();
        let LoadedRow::Rollers(row) = &self.rows[0] else { return reply };
        for (own, levers) in laminae.chunks(LAMINAE).zip(levers.chunks(LAMINAE)) {
            let (mut force, mut largest) = (0.0, 0.0f64);
            for (&lamina, lever) in own.iter().zip(levers) {
                (0..5).for_each(|k| reply.force[k] += lamina * lever[k]);
                // V = (9/19) c delta^(19/9) = (9/19) F delta.
                reply.energy += 9.0 / 19.0 * lamina * self.lamina_under(lamina).0;
                force += lamina;
                largest = largest.max(lamina);
            }
            if force > 0.0 {
                reply.count(force, row.pressure_under(largest));
            }
        }
        reply
    }
}

impl RollingReply {
    /// The reply with a stiffness.
    pub(crate) fn stiff(self, stiffness: Matrix5<f64>) -> Self {
        Self { stiffness, ..self }
    }

    /// The reply of a bearing whose rings have changed places.
    pub(crate) fn turned_inside_out(self) -> Self {
        Self { force: -self.force, ..self }
    }
}
