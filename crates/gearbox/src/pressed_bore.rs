//! Rolling elements that press the bore of an elastic gear: what they open there and on its flanks. Theory (38b).

use std::f64::consts::{PI, TAU};

use contact::slice::{FlanksOfBore, PressedBore};
use faer::Mat;
use mesh::BoreGrid;
use nalgebra::{Matrix2, Vector2, Vector6};
use reduction::{GearReducer, ReductionError, Window};

use crate::{
    BoreError, GearboxError, Structure,
    compliant_support::CompliantBearing,
    rolling_bearing::{Cylinders, RollingReply},
};

/// Stations of the grid of pressures between two rolling elements, and heights along as much of the bore.
const STATIONS: f64 = 6.0;
const HEIGHTS: f64 = 2.0;
/// Difference of the diameters of bore and outer race, over the bore's, that is no error of a drawing.
const SAME_RACE: f64 = 0.01;
/// Reach of rolling elements beyond the bore, over its width, that is round-off of a drawing.
const BEYOND: f64 = 1e-6;
/// Matrices that are kept of a gear's flanks: teeth change in turn, and come back.
const KEPT: usize = 3;

/// Rollers on the bore of a gear at a position, in the frame of the gear's matrices.
#[derive(Debug, Clone)]
pub struct RollersOnBore {
    /// Angle of that frame from +x, rad.
    pub angle: f64,
    /// Pressures on the bore.
    pub grid: BoreGrid,
    /// Pressures of the rollers at its heights, each of a resultant of 1 N: shares of the grid's.
    pub prints: Vec<Vec<(usize, f64)>>,
    /// Shares of every lamina in them.
    pub shares: Vec<[(usize, f64); 2]>,
    /// What the rings have to approach by at every lamina until it presses, mm.
    pub gaps: Vec<f64>,
    /// Forces of the laminae, N.
    pub forces: Vec<f64>,
}

/// A window of the gear in one of the joined meshes.
pub(crate) struct SeenBy<'a> {
    pub reducer: &'a GearReducer,
    pub window: &'a Window,
    /// Angle of the frame of its matrices from +x of the gearbox, rad.
    pub angle: f64,
}

/// A bearing in the bore of a gear of some joined meshes.
pub(crate) struct BoreOfGear {
    /// Place of the bearing among those with rolling elements.
    pub bearing: usize,
    /// Places of the gear's meshes among the joined ones, and its end there.
    pub meshes: Vec<(usize, usize)>,
    body: Option<PressedBody>,
    placed: Option<Placed>,
    /// Flanks under the grid's pressures, by mesh and first tooth of the window.
    known: Vec<((usize, u32), Mat<f64>)>,
    /// Forces of the laminae, N.
    pub forces: Vec<f64>,
    gaps: Vec<f64>,
}

/// The gear's bore, and the laminae in it.
struct PressedBody {
    rollers: Cylinders,
    grid: BoreGrid,
    compliance: Mat<f64>,
}

/// Rollers where the gear stands.
struct Placed {
    /// Angles of the frames of the matrices in all meshes, rad.
    angles: Vec<f64>,
    /// First teeth of the windows.
    firsts: Vec<u32>,
    /// What laminae open by the coordinates of the bearing.
    levers: Vec<[f64; 6]>,
    /// Shares of the laminae in the pressures of rollers at heights.
    shares: Vec<[(usize, f64); 2]>,
    prints: Vec<Footprint>,
    /// U.
    compliance: Mat<f64>,
    /// U_f of each mesh.
    flanks: Vec<Mat<f64>>,
}

/// A pressure of one roller at one height: shares of the grid's, and its resultant.
struct Footprint {
    parts: Vec<(usize, f64)>,
    resultant: Vector6<f64>,
}

impl Structure {
    /// Checks that bearings in bores are where their gears are, one in each.
    pub(crate) fn check_bores(&self) -> Result<(), GearboxError> {
        for (i, bearing) in self.bearings.iter().enumerate() {
            let Some(disc) = bearing.bore_of else { continue };
            self.has_discs(&bearing.name, [disc; 2])?;
            let own = &self.discs[disc];
            let away = (own.position - bearing.position).abs().max(own.reach.abs());
            let gear = || own.name.clone();
            let source = if own.shaft != bearing.shaft || away > BEYOND {
                Some(BoreError::Elsewhere { gear: gear() })
            } else if self.bearings[..i].iter().any(|other| other.bore_of == Some(disc)) {
                Some(BoreError::Twice { gear: gear() })
            } else {
                let rolls = bearing.law.as_ref().is_some_and(|law| law.cylinders().is_some());
                (!rolls).then_some(BoreError::Elements)
            };
            if let Some(source) = source {
                return Err(GearboxError::Bore { bearing: bearing.name.clone(), source });
            }
        }
        Ok(())
    }
}

impl BoreOfGear {
    pub fn new(bearing: usize, meshes: Vec<(usize, usize)>) -> Self {
        let (body, placed) = (None, None);
        Self { bearing, meshes, body, placed, known: Vec::new(), forces: Vec::new(), gaps: Vec::new() }
    }

    /// Makes what is known of the gear where its meshes stand, if it is not: `seen` by each of them.
    pub fn stand(&mut self, support: &CompliantBearing, seen: &[SeenBy<'_>]) -> Result<(), BoreFailure> {
        let firsts: Vec<u32> = seen.iter().map(SeenBy::first).collect();
        let angles: Vec<f64> = seen.iter().map(|own| own.angle).collect();
        if self.placed.as_ref().is_some_and(|placed| placed.angles == angles && placed.firsts == firsts) {
            return Ok(());
        }
        let body = match self.body.take() {
            Some(body) => body,
            None => PressedBody::new(support, seen[0].reducer)?,
        };
        for (mesh, own) in seen.iter().enumerate() {
            let key = (mesh, own.first());
            let last = match self.known.iter().position(|known| known.0 == key) {
                Some(at) => self.known.remove(at),
                None => (key, own.reducer.flanks_under_bore(&own.base(), &body.grid)?),
            };
            if self.known.len() >= KEPT * seen.len() {
                self.known.remove(0);
            }
            self.known.push(last);
        }
        let flanks: Vec<&Mat<f64>> =
            firsts.iter().enumerate().filter_map(|(mesh, first)| self.flanks_of((mesh, *first))).collect();
        let placed = body.placed((&angles, firsts), &flanks);
        (self.body, self.placed) = (Some(body), Some(placed));
        Ok(())
    }

    fn flanks_of(&self, key: (usize, u32)) -> Option<&Mat<f64>> {
        self.known.iter().find(|known| known.0 == key).map(|known| &known.1)
    }

    /// What presses with the shaft displaced by `moved` against the seat; `under` is the law of a lamina.
    pub fn pressed<'a>(
        &'a mut self,
        moved: &Vector6<f64>,
        under: contact::slice::Approach<'a>,
    ) -> Option<PressedBore<'a>> {
        let (placed, body) = (self.placed.as_ref()?, self.body.as_ref()?);
        let open = |lever: &[f64; 6]| (0..6).map(|k| lever[k] * moved[k]).sum::<f64>();
        self.gaps.clear();
        self.gaps.extend(body.rollers.laminae.iter().zip(&placed.levers).map(|(own, lever)| own.gap + open(lever)));
        let flanks = self.meshes.iter().zip(&placed.flanks);
        let flanks =
            flanks.map(|(&(contact, body), columns)| FlanksOfBore { contact, body, columns: columns.as_ref() });
        Some(PressedBore {
            gaps: &self.gaps,
            levers: &placed.levers,
            approach: under,
            compliance: placed.compliance.as_ref(),
            shares: &placed.shares,
            flanks: flanks.collect(),
            preload: 0.0,
            forces: &mut self.forces,
        })
    }

    /// Its rollers at the last position.
    pub fn rollers(&self) -> Option<RollersOnBore> {
        let (placed, body) = (self.placed.as_ref()?, self.body.as_ref()?);
        Some(RollersOnBore {
            angle: placed.angles[0],
            grid: body.grid.clone(),
            prints: placed.prints.iter().map(|own| own.parts.clone()).collect(),
            shares: placed.shares.clone(),
            gaps: body.rollers.laminae.iter().map(|own| own.gap).collect(),
            forces: self.forces.clone(),
        })
    }

    /// Force on the gear by its laminae.
    pub fn reply(&self, support: &CompliantBearing) -> RollingReply {
        let levers = self.placed.as_ref().map_or(&[][..], |placed| &placed.levers);
        support.law().reply_of(&self.forces, levers)
    }
}

/// Why a bore cannot be pressed.
pub(crate) enum BoreFailure {
    Reduction(ReductionError),
    Bore(BoreError),
}

impl From<ReductionError> for BoreFailure {
    fn from(source: ReductionError) -> Self {
        Self::Reduction(source)
    }
}

impl SeenBy<'_> {
    /// First tooth of its matrices; alike teeth have but one set of them.
    fn first(&self) -> u32 {
        if self.reducer.is_cyclic() { 0 } else { self.window.reduced.teeth.first().copied().unwrap_or(0) }
    }

    /// The window in the frame of the matrices of alike teeth.
    fn base(&self) -> Window {
        let shift = if self.reducer.is_cyclic() { 0 } else { self.window.shift };
        Window { reduced: std::sync::Arc::clone(&self.window.reduced), shift }
    }
}

impl PressedBody {
    fn new(support: &CompliantBearing, reducer: &GearReducer) -> Result<Self, BoreFailure> {
        let rollers = support.law().cylinders().ok_or(BoreFailure::Bore(BoreError::Elements))?;
        let count = rollers.a_row as f64;
        let coarse = reducer.bore_grid(1, 2)?;
        let heights = HEIGHTS * (coarse.ends[1] - coarse.ends[0]) / (TAU * coarse.radius / count);
        let grid = reducer.bore_grid((STATIONS * count) as usize, heights.ceil() as usize + 1)?;
        let (race_mm, bore_mm) = (rollers.race, 2.0 * grid.radius);
        if (race_mm / bore_mm - 1.0).abs() > SAME_RACE {
            return Err(BoreFailure::Bore(BoreError::Race { race_mm, bore_mm }));
        }
        let ([low, high], [from, to]) = (grid.ends, rollers.ends);
        let near = BEYOND * (high - low);
        if from < low - near || to > high + near {
            return Err(BoreFailure::Bore(BoreError::Beyond { rollers_mm: rollers.ends, bore_mm: grid.ends }));
        }
        let compliance = reducer.bore_compliance(&grid)?;
        Ok(Self { rollers, grid, compliance })
    }

    /// Everything where the frames of the matrices of all meshes stand at some angles.
    fn placed(&self, (angles, firsts): (&[f64], Vec<u32>), flanks: &[&Mat<f64>]) -> Placed {
        let heights = self.grid.heights;
        // Rollers of all rows stand at the same angles: one set of pressures serves them all.
        let reach = TAU / self.rollers.a_row as f64;
        let at: Vec<f64> = (0..self.rollers.a_row).map(|j| j as f64 * reach).collect();
        let of_frame = |angle: f64| -> Vec<Footprint> {
            let one = |&place: &f64| (0..heights).map(move |h| self.footprint((place - angle, reach), h));
            at.iter().flat_map(one).collect()
        };
        let own = of_frame(angles[0]);
        let m = own.len();
        let mut half = Mat::<f64>::zeros(self.grid.count(), m);
        for (q, print) in own.iter().enumerate() {
            for &(g, share) in &print.parts {
                for i in 0..self.grid.count() {
                    half[(i, q)] += share * self.compliance[(i, g)];
                }
            }
        }
        let open = |p: usize, q: usize| own[p].parts.iter().map(|&(g, share)| share * half[(g, q)]).sum::<f64>();
        let compliance = Mat::from_fn(m, m, |p, q| 0.5 * (open(p, q) + open(q, p)));
        let (mut levers, mut shares) = (Vec::new(), Vec::new());
        for lamina in &self.rollers.laminae {
            let j = (lamina.angle / reach).round() as usize;
            let prints = &own[heights * j..heights * (j + 1)];
            let local = lamina.angle - angles[0];
            let share = between(prints, local, lamina.height);
            let sum: Vector6<f64> = share.iter().map(|&(h, s)| s * prints[h].resultant).sum();
            let (sin, cos) = angles[0].sin_cos();
            let turned = |k: usize| [cos * sum[k] - sin * sum[k + 1], sin * sum[k] + cos * sum[k + 1], 0.0];
            let ([fx, fy, _], [mx, my, _]) = (turned(0), turned(3));
            levers.push([fx, fy, 0.0, mx, my, 0.0]);
            shares.push(share.map(|(h, s)| (heights * j + h, s)));
        }
        let under = |(angle, columns): (&f64, &&Mat<f64>)| {
            let prints = of_frame(*angle);
            let mut all = Mat::<f64>::zeros(columns.nrows(), m);
            for (q, print) in prints.iter().enumerate() {
                for &(g, share) in &print.parts {
                    for i in 0..columns.nrows() {
                        all[(i, q)] += share * columns[(i, g)];
                    }
                }
            }
            all
        };
        let flanks = angles.iter().zip(flanks).map(under).collect();
        Placed { angles: angles.to_vec(), firsts, levers, shares, prints: own, compliance, flanks }
    }

    /// Pressure of a roller at an angle (rad) in the gear's frame, at one height of the grid: a wave that its neighbours' make up
    /// to an even pressure, of a resultant of 1 N along the roller's radius and 0 across.
    ///
    /// ```text
    /// p = w (1 + b sin s),   w = (1 + cos(pi s/r))/2 for |s| < r      s: angle from the roller, r: that to the next one
    /// ```
    fn footprint(&self, (angle, reach): (f64, f64), height: usize) -> Footprint {
        let grid = &self.grid;
        let (sin, cos) = angle.sin_cos();
        let (along, across) = (Vector2::new(cos, sin), Vector2::new(-sin, cos));
        let mut near = Vec::new();
        let mut sums = [Vector6::zeros(); 2];
        for station in 0..grid.stations {
            let from = grid.angle(station) - angle;
            let from = from - TAU * (from / TAU).round();
            if from.abs() < reach {
                let wave = 0.5 * (1.0 + (PI * from / reach).cos());
                let g = station * grid.heights + height;
                sums[0] += wave * grid.resultants[g];
                sums[1] += wave * from.sin() * grid.resultants[g];
                near.push((g, wave, from.sin()));
            }
        }
        let part = |sum: &Vector6<f64>, axis: &Vector2<f64>| sum[0] * axis.x + sum[1] * axis.y;
        let rows = Matrix2::new(
            part(&sums[0], &along),
            part(&sums[1], &along),
            part(&sums[0], &across),
            part(&sums[1], &across),
        );
        let found = rows.lu().solve(&Vector2::new(1.0, 0.0)).unwrap_or_else(Vector2::zeros);
        let parts = near.into_iter().map(|(g, wave, sin)| (g, wave * (found.x + found.y * sin))).collect();
        Footprint { parts, resultant: found.x * sums[0] + found.y * sums[1] }
    }
}

/// Shares of a lamina at a height (mm) in the pressures of its roller, which is at an angle (rad) in the gear's frame: those of
/// which the force is 1 N and acts at that height.
fn between(prints: &[Footprint], angle: f64, height: f64) -> [(usize, f64); 2] {
    let (sin, cos) = angle.sin_cos();
    // r x n = z (e_z x n).
    let acts_at = |h: usize| -sin * prints[h].resultant[3] + cos * prints[h].resultant[4];
    let above = (1..prints.len()).find(|&h| acts_at(h) >= height).unwrap_or(prints.len() - 1);
    let [low, high] = [acts_at(above - 1), acts_at(above)];
    let share = (height - low) / (high - low);
    [(above - 1, 1.0 - share), (above, share)]
}
