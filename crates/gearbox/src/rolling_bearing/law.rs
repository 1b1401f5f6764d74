//! All rows of a bearing as one law; forces are the gradient of a convex energy. Theory (97) to (100).

use std::f64::consts::TAU;

use nalgebra::{Matrix6, Vector5};

use super::{
    AxialSeat, AxialSetting, RollingBearingError, RollingElements, RollingReply, Row,
    ball::BallRow,
    life::{BallCapacity, LaminaCapacity},
    reply::with_turn,
    roller::{LAMINAE, RollerRow},
};

/// One row.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum LoadedRow {
    Balls(BallRow),
    Rollers(RollerRow),
}

impl LoadedRow {
    fn new(elements: RollingElements, row: Row, clearance: f64, axial: f64) -> Result<Self, RollingBearingError> {
        Ok(match elements {
            RollingElements::Balls(own) => Self::Balls(BallRow::new(own, row, clearance, axial)?),
            RollingElements::Rollers(own) => Self::Rollers(RollerRow::new(own, row, clearance, axial)?),
        })
    }

    fn add(&self, d: &Vector5<f64>, reply: &mut RollingReply) {
        match self {
            Self::Balls(row) => row.add(d, reply),
            Self::Rollers(row) => row.add(d, reply),
        }
    }
}

/// Force on one rolling element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElementLoad {
    /// Row, from 0.
    pub row: usize,
    /// Angle of its place, rad from +x towards +y.
    pub angle: f64,
    /// Force with which both rings press it, N: of a ball along its contact angle, of a roller across its axis.
    pub force: f64,
}

impl ElementLoad {
    /// Angle of the load zone of a bearing, rad: from the first loaded element to the last one, past all but the largest
    /// gap; 2 pi where every place of a row has a loaded element.
    pub fn zone(all: &[Self]) -> f64 {
        let mut angles: Vec<f64> = all.iter().filter(|own| own.force > 0.0).map(|own| own.angle).collect();
        angles.sort_unstable_by(f64::total_cmp);
        let Some(&first) = angles.first() else { return 0.0 };
        let next = angles.iter().skip(1).copied().chain([first + TAU]);
        let gap = angles.iter().zip(next).map(|(one, next)| next - one).fold(0.0, f64::max);
        let pitch = TAU / all.iter().filter(|own| own.row == all[0].row).count() as f64;
        if gap < 1.5 * pitch { TAU } else { TAU - gap }
    }
}

/// A rolling bearing whose stiffness depends on its load.
#[derive(Debug, Clone, PartialEq)]
pub struct RollingBearing {
    elements: RollingElements,
    pub(super) rows: Vec<LoadedRow>,
    seat: AxialSeat,
}

/// Contact angle that deep grooves are taken to have where nothing is known of their load, rad.
const ROUGH_ANGLE: f64 = 0.1;
/// Halvings that find a preload to its last digits, and doublings of the way that is tried for it.
const HALVINGS: usize = 100;
const DOUBLINGS: usize = 60;

impl RollingBearing {
    /// Bearing with given rolling elements, rows, radial clearance (total play, mm; negative: interference), and axial
    /// setting of the rings.
    ///
    /// # Errors
    /// [`RollingBearingError`] for values out of range.
    pub fn new(
        elements: RollingElements,
        rows: &[Row],
        radial_clearance: f64,
        axial: AxialSetting,
    ) -> Result<Self, RollingBearingError> {
        if rows.is_empty() {
            return Err(RollingBearingError::OutOfRange { quantity: "rows", value: 0.0, wanted: "1 or more" });
        }
        let numbers = rows.iter().flat_map(|r| [("position of a row, mm", r.position), ("thrust of a row", r.thrust)]);
        let setting = match axial {
            AxialSetting::Clearance(way) => ("axial clearance, mm", way),
            AxialSetting::Preload(force) => ("preload, N", force),
        };
        let all = numbers.chain([("radial clearance, mm", radial_clearance), setting]);
        for (quantity, value) in all {
            if !value.is_finite() {
                return Err(RollingBearingError::OutOfRange { quantity, value, wanted: "a number" });
            }
        }
        let one = |row: &Row| {
            let way = match axial {
                AxialSetting::Clearance(way) => way,
                AxialSetting::Preload(force) => -pressed_way(elements, *row, radial_clearance, force)?,
            };
            LoadedRow::new(elements, *row, radial_clearance, way)
        };
        let rows = rows.iter().map(one).collect::<Result<Vec<_>, _>>()?;
        Ok(Self { elements, rows, seat: AxialSeat::Held })
    }

    /// The bearing with another axial seat.
    #[must_use]
    pub fn in_seat(self, seat: AxialSeat) -> Self {
        Self { seat, ..self }
    }

    /// Rolling elements of the bearing.
    pub fn elements(&self) -> &RollingElements {
        &self.elements
    }

    /// Number of rolling elements of all rows.
    pub fn count(&self) -> usize {
        let a_row = match &self.elements {
            RollingElements::Balls(own) => own.elements,
            RollingElements::Rollers(own) => own.elements,
        };
        a_row * self.rows.len()
    }

    /// Force and tangent at displacements of the inner ring relative to the seat of the outer ring.
    pub fn evaluate(&self, displacements: &Vector5<f64>) -> RollingReply {
        self.settled(displacements).1
    }

    /// Displacements of the inner ring against the outer one, which may float, and the reply there.
    fn settled(&self, displacements: &Vector5<f64>) -> (Vector5<f64>, RollingReply) {
        self.seat.reply(displacements, |place| {
            let mut reply = RollingReply::nothing();
            self.rows.iter().for_each(|row| row.add(place, &mut reply));
            reply
        })
    }

    /// Forces of all rolling elements at displacements of the inner ring relative to the seat of the outer ring, row by
    /// row: the load zone. Elements stand where the law has them, element j of n at 2 pi j/n.
    pub fn load_zone(&self, displacements: &Vector5<f64>) -> Vec<ElementLoad> {
        let place = self.settled(displacements).0;
        let forces = |row: &LoadedRow| -> Vec<f64> {
            match row {
                LoadedRow::Balls(row) => row.forces(&place).collect(),
                LoadedRow::Rollers(row) => row.element_forces(&place).collect(),
            }
        };
        let of_row = |(row, own): (usize, &LoadedRow)| {
            let forces = forces(own);
            let pitch = pitch_of(forces.len());
            forces.into_iter().enumerate().map(move |(j, force)| ElementLoad { row, angle: j as f64 * pitch, force })
        };
        self.rows.iter().enumerate().flat_map(of_row).collect()
    }

    /// Share of the basic reference rating life used by a million revolutions of the inner ring under a stationary
    /// load, at displacements of the inner ring relative to the seat of the outer ring: 1/L_10r, 0 without load.
    /// `dynamic_rating` is C of the whole bearing, N, ISO 281.
    ///
    /// ```text
    /// balls:   L_10r^(-10/9) = sum over the rows of (Q_ei/Q_ci)^(10/3) + (Q_ee/Q_ce)^(10/3)
    /// rollers: L_10r^(-9/8)  = sum over rows and laminae k of (q_kei/q_ci)^(9/2) + (q_kee/q_ce)^(9/2)
    /// ```
    /// Source: ISO/TS 16281, 5.3 and 6.3; formulas and symbols: theory (101b).
    pub fn damage(&self, displacements: &Vector5<f64>, dynamic_rating: f64) -> f64 {
        let (place, rows) = (self.settled(displacements).0, self.rows.len());
        match &self.elements {
            RollingElements::Balls(balls) => {
                let capacity = BallCapacity::new(balls, rows, dynamic_rating);
                let of = |row: &LoadedRow| match row {
                    LoadedRow::Balls(row) => capacity.used(row.forces(&place)),
                    LoadedRow::Rollers(_) => 0.0,
                };
                self.rows.iter().map(of).sum::<f64>().powf(9.0 / 10.0)
            }
            RollingElements::Rollers(rollers) => {
                let capacity = LaminaCapacity::new(rollers, rows, dynamic_rating);
                let of = |row: &LoadedRow| match row {
                    LoadedRow::Rollers(row) => (0..LAMINAE).map(|k| capacity.used(k, row.forces(k, &place), 0)).sum(),
                    LoadedRow::Balls(_) => 0.0,
                };
                self.rows.iter().map(of).sum::<f64>().powf(8.0 / 9.0)
            }
        }
    }

    /// Stiffness of its size before anything is known of its load: all elements pressed evenly by their share of a
    /// force (N). What it holds at all, it holds here.
    pub(crate) fn rough_stiffness(&self, force: f64) -> Matrix6<f64> {
        let mut reply = RollingReply::nothing();
        let share = force / self.count() as f64;
        for row in &self.rows {
            match row {
                LoadedRow::Balls(own) => own.pressed(share, ROUGH_ANGLE, &mut reply),
                LoadedRow::Rollers(own) => own.pressed(share, &mut reply),
            }
        }
        with_turn(&self.seat.of(&reply.stiffness))
    }
}

/// Angle between neighbours of so many elements, rad.
pub(super) fn pitch_of(elements: usize) -> f64 {
    TAU / elements as f64
}

/// How far a row has to be pressed along the axis until it carries a force.
fn pressed_way(elements: RollingElements, row: Row, clearance: f64, force: f64) -> Result<f64, RollingBearingError> {
    let refused = |wanted| Err(RollingBearingError::OutOfRange { quantity: "preload, N", value: force, wanted });
    if force < 0.0 {
        return refused("0 or more");
    }
    let free = LoadedRow::new(elements, row, clearance, 0.0)?;
    let carries = |way: f64| {
        let mut reply = RollingReply::nothing();
        free.add(&Vector5::new(0.0, 0.0, row.thrust * way, 0.0, 0.0), &mut reply);
        -row.thrust * reply.force[2]
    };
    let (mut near, mut far) = (0.0, 1e-6);
    let grown = (0..DOUBLINGS).any(|_| {
        let enough = carries(far) >= force;
        if !enough {
            (near, far) = (far, 2.0 * far);
        }
        enough
    });
    if !grown {
        return refused("one that the row can carry along the axis");
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (near + far);
        if carries(middle) < force { near = middle } else { far = middle }
    }
    Ok(far)
}
