//! Joins identical super-elements by doubling.

use std::collections::BTreeMap;

use faer::{Mat, MatRef};
use fem::{FemError, Wanted, dense, unless_unwanted};

use super::seat::{SIX, turned};

/// A row of equal sectors as one super-element between its first and its last cut.
///
/// ```text
///  l     m     r        K_mm = A_rr + B_ll,   K_me = [A_rl  B_lr]
///  |--A--|--B--|        u_m = -K_mm^-1 K_me u_e,   K_e = diag(A_ll, B_rr) - K_me' K_mm^-1 K_me,   u_e = [u_l; u_r]
/// ```
/// Every cut's unknowns are in the frame of the sector on its counter-clockwise side, so that equal rows have equal
/// matrices wherever they are and no join turns anything. n sectors take about log2 n joins for the powers of two and
/// as many as n has binary ones. Eliminating free cuts is exact, so the row answers as its sectors would.
///
/// Six loads g that all sectors take alike, each turned into its frame (the seat of a bore that is held by its means), go along,
/// in the frame of the row's first sector; D turns them into that of B:
///
/// ```text
/// h = A_rg + B_lg D,   u_m = K_mm^-1 (h g - K_me u_e),   H_e = [A_lg; B_rg D] - K_me' K_mm^-1 h,   G = A_g + D' B_g D + h' K_mm^-1 h
/// ```
#[derive(Debug)]
pub(super) struct Chain {
    /// Shorter rows first; the last one is the whole.
    links: Vec<Link>,
    /// Stiffness between first and last cut, 2c x 2c, N/mm.
    pub(super) stiffness: Mat<f64>,
    /// Loads that all sectors take alike.
    pub(super) seat: Option<RowSeat>,
}

/// What six loads that all sectors of a row take alike do to it.
#[derive(Debug, Clone)]
pub(super) struct RowSeat {
    /// H_e: forces on the ends, 2c x 6.
    pub ends: Mat<f64>,
    /// G: displacement along the loads with the ends held, 6 x 6.
    pub own: Mat<f64>,
    /// Angle from one sector to the next, rad.
    pub pitch: f64,
}

/// A row that is being joined.
#[derive(Clone)]
struct Row {
    link: usize,
    stiffness: Mat<f64>,
    seat: Option<RowSeat>,
}

#[derive(Debug)]
struct Link {
    sectors: usize,
    join: Option<Join>,
}

/// Two rows made one.
#[derive(Debug)]
struct Join {
    left: usize,
    right: usize,
    /// L of K_mm = L L', c x c.
    factor: Mat<f64>,
    /// Z = L^-1 K_me, c x 2c.
    ends: Mat<f64>,
    /// Y = L^-1 h, c x 6, and the angle from the first sector to that of the right row, rad.
    seat: Option<(Mat<f64>, f64)>,
}

impl Join {
    /// Displacement of the middle cut for that of the ends, 2c x k, and the loads that all sectors take, 6 x k.
    fn middle(&self, ends: MatRef<'_, f64>, loads: MatRef<'_, f64>) -> Mat<f64> {
        let mut middle = dense::product(self.ends.as_ref(), ends);
        if let Some((seat, _)) = &self.seat {
            middle -= dense::product(seat.as_ref(), loads);
        }
        dense::solve_lower_transposed(self.factor.as_ref(), middle.as_mut());
        middle *= faer::Scale(-1.0);
        middle
    }
}

/// Both cuts' displacements, one above the other.
pub(super) fn stacked(above: MatRef<'_, f64>, below: MatRef<'_, f64>) -> Mat<f64> {
    let mut both = Mat::zeros(above.nrows() + below.nrows(), above.ncols());
    both.as_mut().subrows_mut(0, above.nrows()).copy_from(above);
    both.as_mut().subrows_mut(above.nrows(), below.nrows()).copy_from(below);
    both
}

impl Chain {
    /// `count` > 0 sectors of stiffness `sector` (2c x 2c, left cut before right cut), with what loads do to one that all take.
    pub(super) fn new(
        sector: &Mat<f64>,
        seat: Option<RowSeat>,
        count: usize,
        wanted: Wanted<'_>,
    ) -> Result<Self, FemError> {
        let mut links = vec![Link { sectors: 1, join: None }];
        let mut power = Row { link: 0, stiffness: sector.clone(), seat };
        let mut whole: Option<Row> = None;
        let mut rest = count;
        loop {
            unless_unwanted(wanted)?;
            if rest % 2 == 1 {
                whole = Some(match whole {
                    None => power.clone(),
                    Some(left) => join(&mut links, [&left, &power])?,
                });
            }
            rest /= 2;
            if rest == 0 {
                break;
            }
            power = join(&mut links, [&power, &power])?;
        }
        let Row { link, stiffness, seat } = whole.unwrap_or(power);
        links.truncate(link + 1);
        Ok(Self { links, stiffness, seat })
    }

    /// Displacements of the cuts `wanted` (0 the first, n the last) for those of the ends, 2c x k, and the loads that all sectors
    /// take, 6 x k in the frame of the first one.
    pub(super) fn cuts(
        &self,
        ends: MatRef<'_, f64>,
        loads: MatRef<'_, f64>,
        wanted: &[usize],
    ) -> BTreeMap<usize, Mat<f64>> {
        let c = self.stiffness.nrows() / 2;
        let mut found = BTreeMap::new();
        let last = self.links.len() - 1;
        found.insert(0, ends.subrows(0, c).to_owned());
        found.insert(self.links[last].sectors, ends.subrows(c, c).to_owned());
        self.descend((last, 0), ends, loads, wanted, &mut found);
        found
    }

    fn descend(
        &self,
        (link, start): (usize, usize),
        ends: MatRef<'_, f64>,
        loads: MatRef<'_, f64>,
        wanted: &[usize],
        found: &mut BTreeMap<usize, Mat<f64>>,
    ) {
        let Link { sectors, join: Some(join) } = &self.links[link] else { return };
        if !wanted.iter().any(|&w| start < w && w < start + sectors) {
            return;
        }
        let c = ends.nrows() / 2;
        let middle = join.middle(ends, loads);
        let at = start + self.links[join.left].sectors;
        let of_right = join.seat.as_ref().map_or_else(|| loads.to_owned(), |(_, angle)| turned(loads, -angle));
        let left = stacked(ends.subrows(0, c), middle.as_ref());
        let right = stacked(middle.as_ref(), ends.subrows(c, c));
        self.descend((join.left, start), left.as_ref(), loads, wanted, found);
        self.descend((join.right, at), right.as_ref(), of_right.as_ref(), wanted, found);
        found.insert(at, middle);
    }

    /// Mass (t) of the row between its ends, T' M T, from that of one sector, 2c x 2c; of a row without loads.
    pub(super) fn mass(&self, sector: &Mat<f64>) -> Mat<f64> {
        let c = sector.nrows() / 2;
        let mut masses: Vec<Mat<f64>> = Vec::with_capacity(self.links.len());
        for link in &self.links {
            masses.push(match &link.join {
                None => sector.clone(),
                Some(join) => {
                    let (a, b) = (&masses[join.left], &masses[join.right]);
                    let unit = Mat::<f64>::identity(2 * c, 2 * c);
                    let middle = join.middle(unit.as_ref(), Mat::zeros(SIX, 2 * c).as_ref());
                    let left = stacked(unit.get(..c, ..), middle.as_ref());
                    let right = stacked(middle.as_ref(), unit.get(c.., ..));
                    congruent(a, &left) + congruent(b, &right)
                }
            });
        }
        masses.pop().unwrap_or_else(|| sector.clone())
    }
}

/// T' M T.
pub(super) fn congruent(m: &Mat<f64>, t: &Mat<f64>) -> Mat<f64> {
    let product = dense::product(m.as_ref(), t.as_ref());
    dense::product(t.transpose(), product.as_ref())
}

/// The row of two rows.
fn join(links: &mut Vec<Link>, [left, right]: [&Row; 2]) -> Result<Row, FemError> {
    let [a, b] = [left, right].map(|row| row.stiffness.as_ref());
    let c = a.nrows() / 2;
    let factor = dense::cholesky((a.get(c.., c..) + b.get(..c, ..c)).as_ref())?;
    let mut ends = Mat::zeros(c, 2 * c);
    ends.as_mut().subcols_mut(0, c).copy_from(a.get(c.., ..c));
    ends.as_mut().subcols_mut(c, c).copy_from(b.get(..c, c..));
    dense::solve_lower(factor.as_ref(), ends.as_mut());
    let mut stiffness = dense::gram(ends.as_ref());
    stiffness *= faer::Scale(-1.0);
    let mut outer = stiffness.as_mut().submatrix_mut(0, 0, c, c);
    outer += a.get(..c, ..c);
    let mut outer = stiffness.as_mut().submatrix_mut(c, c, c, c);
    outer += b.get(c.., c..);
    let seats = left.seat.as_ref().zip(right.seat.as_ref());
    let joined = seats.map(|(a, b)| {
        let angle = a.pitch * links[left.link].sectors as f64;
        // X D = (D' X')'.
        let seen = |x: MatRef<'_, f64>| turned(x.transpose(), angle).transpose().to_owned();
        let of_right = seen(b.ends.as_ref());
        let mut middle = a.ends.get(c.., ..) + of_right.get(..c, ..);
        dense::solve_lower(factor.as_ref(), middle.as_mut());
        let outer = stacked(a.ends.get(..c, ..), of_right.get(c.., ..));
        let by_middle = dense::product(ends.transpose(), middle.as_ref());
        let own = turned(seen(b.own.as_ref()).as_ref(), angle);
        let own = &a.own + own + dense::product(middle.transpose(), middle.as_ref());
        (RowSeat { ends: outer - by_middle, own, pitch: a.pitch }, (middle, angle))
    });
    let (seat, of_join) = joined.unzip();
    let sectors = links[left.link].sectors + links[right.link].sectors;
    let join = Join { left: left.link, right: right.link, factor, ends, seat: of_join };
    links.push(Link { sectors, join: Some(join) });
    Ok(Row { link: links.len() - 1, stiffness, seat })
}
