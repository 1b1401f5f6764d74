//! Vibration of a cyclic gear: the inertia of the sector, and the stiffness of the whole ring by harmonics. Theory
//! (59).
//!
//! ```text
//! u_k = e^{i psi k} u_0,  psi = 2 pi n / z          n waves about the axis; u_k in the frame of sector k
//! K_n = K_ll + K_rr + e^{i psi} K_lr + e^{-i psi} K_rl       of a cut, Hermitian
//! K^-1 f:  K_n u_c = f_l + e^{-i psi} f_r,   u = X f + T [u_c; e^{i psi} u_c]
//! ```
//! A bore that is held by its means leaves harmonics 0 and 1 free to move as a whole: there forces are put in balance, springs stand
//! on the cut, and displacements are settled (theory (13f)).
//!
//! One factor of one sector serves all harmonics; each harmonic also has a dense factor of the size of a cut. Complex
//! vectors are stored as pairs of real ones, the imaginary part below the real part.

use std::f64::consts::TAU;

use faer::{Mat, MatRef};
use fem::{DofMap, ElementOptions, Material, SymmetricMatrix, dense};

use super::{
    Sector, SectorMesh,
    chain::stacked,
    seat::{SIX, Settled, turned},
};
use crate::{ReductionError, modes::Pencil};

/// One sector with its mass, and nothing held but the bore.
#[derive(Debug)]
pub(crate) struct VibratingSector {
    sector: Sector,
    mass: SymmetricMatrix,
    /// Sectors of the ring, z.
    pub(crate) teeth: u32,
    /// -1 where sectors follow each other clockwise, else +1.
    pub(crate) way: f64,
}

impl VibratingSector {
    pub(crate) fn new(
        part: &SectorMesh,
        material: &Material,
        elements: &ElementOptions,
    ) -> Result<Self, ReductionError> {
        let sector = Sector::new(part, material, elements, &[], (false, None), &|| true)?;
        let mass = fem::assemble_mass(&part.mesh, material, &sector.dofs)?;
        Ok(Self { sector, mass, teeth: part.teeth, way: part.way })
    }

    /// Free freedoms of a sector, those of both cuts counted.
    pub(crate) fn dofs(&self) -> &DofMap {
        &self.sector.dofs
    }

    /// The sector's nodes.
    pub(crate) fn mesh(&self) -> &mesh::Mesh {
        self.sector.mesh()
    }

    /// psi of `waves` waves, rad.
    pub(crate) fn phase(&self, waves: u32) -> f64 {
        TAU * f64::from(waves % self.teeth) / f64::from(self.teeth)
    }

    /// Motion with `waves` waves about the axis, 0 .. z/2.
    pub(crate) fn harmonic(&self, waves: u32) -> Result<Harmonic<'_>, ReductionError> {
        Ok(Harmonic { of: self, cut: CutFactor::new(self, waves)? })
    }

    /// Motion of any kind: all sectors one above the other.
    pub(crate) fn ring(&self) -> Result<Ring<'_>, ReductionError> {
        let cuts = (0..=self.teeth / 2).map(|n| CutFactor::new(self, n)).collect::<Result<_, _>>()?;
        let Some(own) = self.sector.seat() else { return Ok(Ring { of: self, cuts, seat: None }) };
        // Motions of the whole gear, sector by sector.
        let n = self.dofs().free_count();
        let all = |of_sector: &Mat<f64>| {
            let mut all = Mat::<f64>::zeros(n * self.teeth as usize, SIX);
            for k in 0..self.teeth as usize {
                // X D = (D' X')'.
                let seen = turned(of_sector.transpose(), own.seat.pitch * k as f64).transpose().to_owned();
                all.as_mut().subrows_mut(n * k, n).copy_from(seen);
            }
            all
        };
        let seat = Settled::new(all(&own.seat.rigid), all(&own.seat.forces)).ok_or(NO_MEAN_TURN)?;
        Ok(Ring { of: self, cuts, seat: Some(seat) })
    }

    /// Motions of the gear as a whole with so many waves, or the seat's forces, parts one above the other; none of other waves.
    ///
    /// ```text
    /// waves 0: along z, about z;   1: x + i w y, of displacement and turn, and i times these      w: way of the sectors
    /// ```
    fn of_waves(&self, of_sector: &Mat<f64>, waves: u32) -> Option<Mat<f64>> {
        let n = of_sector.nrows();
        match waves {
            0 => Some(Mat::from_fn(n, 2, |i, j| of_sector[(i, [2, 5][j])])),
            1 => Some(Mat::from_fn(2 * n, 4, |i, j| {
                let (row, first) = (i % n, [0, 3][j / 2]);
                let [re, im] = [of_sector[(row, first)], self.way * of_sector[(row, first + 1)]];
                match (i / n, j % 2) {
                    (0, 0) => re,
                    (0, _) => -im,
                    (_, 0) => im,
                    _ => re,
                }
            })),
            _ => None,
        }
    }

    /// M x of vectors whose parts stand one above the other.
    pub(crate) fn inertia(&self, x: MatRef<'_, f64>, parts: usize) -> Result<Mat<f64>, ReductionError> {
        Ok(together(&self.mass.multiply(apart(x, parts).as_ref())?, parts))
    }
}

/// The stiffness of one harmonic's cut, factored.
#[derive(Debug)]
struct CutFactor {
    cos: f64,
    sin: f64,
    /// Real parts alone, or real and imaginary ones.
    parts: usize,
    /// L of K_n = L L' or, with imaginary parts, of [Re -Im; Im Re]; with springs where the gear is free.
    factor: Mat<f64>,
    /// What settles a gear that is free.
    seat: Option<Settled>,
}

/// A bore held by its means that holds no turn is refused before its vibration is asked for.
const NO_MEAN_TURN: ReductionError = ReductionError::NoMeanTurn { faces: 0 };

impl CutFactor {
    fn new(of: &VibratingSector, waves: u32) -> Result<Self, ReductionError> {
        let (c, k) = (of.sector.cut, of.sector.stiffness.as_ref());
        let parts = if waves == 0 || 2 * waves == of.teeth { 1 } else { 2 };
        let (sin, cos) = of.phase(waves).sin_cos();
        let block = |a: usize, b: usize| k.submatrix(a * c, b * c, c, c);
        let real = |i: usize, j: usize| {
            block(0, 0)[(i, j)] + block(1, 1)[(i, j)] + cos * (block(0, 1)[(i, j)] + block(1, 0)[(i, j)])
        };
        let imaginary = |i: usize, j: usize| sin * (block(0, 1)[(i, j)] - block(1, 0)[(i, j)]);
        let mut stiffness = Mat::from_fn(parts * c, parts * c, |i, j| match (i / c.max(1), j / c.max(1)) {
            (0, 0) => real(i, j),
            (1, 1) => real(i - c, j - c),
            (1, _) => imaginary(i - c, j),
            _ => -imaginary(i, j - c),
        });
        let mut seat = None;
        if let Some(own) = of.sector.seat().map(|own| &own.seat)
            && let (Some(rigid), Some(forces)) = (of.of_waves(&own.rigid, waves), of.of_waves(&own.forces, waves))
        {
            let springs = own.springs_of(&rigid, parts);
            seat = Some(Settled::new(rigid, forces).ok_or(NO_MEAN_TURN)?);
            for (spring, part) in springs.into_iter().flat_map(|spring| (0..parts).map(move |part| (spring, part))) {
                let at = part * c + spring;
                stiffness[(at, at)] += own.stiffness;
            }
        }
        Ok(Self { cos, sin, parts, factor: dense::cholesky(stiffness.as_ref())?, seat })
    }

    /// Displacement of the left cut, parts one above the other, for forces on it.
    fn solve(&self, mut forces: Mat<f64>) -> Mat<f64> {
        dense::solve_lower(self.factor.as_ref(), forces.as_mut());
        dense::solve_lower_transposed(self.factor.as_ref(), forces.as_mut());
        forces
    }
}

/// Motion of one harmonic: the sector's freedoms, real parts above imaginary ones. Every mode is there twice where both
/// are.
#[derive(Debug)]
pub(crate) struct Harmonic<'a> {
    of: &'a VibratingSector,
    cut: CutFactor,
}

impl Harmonic<'_> {
    /// Number of parts: 2, or 1 where motion is the same or opposite in neighbouring sectors.
    pub(crate) fn parts(&self) -> usize {
        self.cut.parts
    }
}

impl Pencil for Harmonic<'_> {
    fn order(&self) -> usize {
        self.cut.parts * self.of.dofs().free_count()
    }

    fn inertia(&self, x: MatRef<'_, f64>) -> Result<Mat<f64>, ReductionError> {
        self.of.inertia(x, self.cut.parts)
    }

    fn follow(&self, f: MatRef<'_, f64>) -> Result<Mat<f64>, ReductionError> {
        let CutFactor { cos, sin, parts, .. } = self.cut;
        let (sector, c) = (&self.of.sector, self.of.sector.cut);
        let balanced = self.cut.seat.as_ref().map(|seat| seat.balanced(f));
        let force = apart(balanced.as_ref().map_or(f, |own| own.as_ref()), parts);
        let ends = sector.ends_under(force.as_ref())?;
        // Columns of the same vector stand side by side: real, imaginary.
        let part = |row: usize, j: usize, part: usize| if part < parts { ends[(row, parts * j + part)] } else { 0.0 };
        let on_cut = Mat::from_fn(parts * c, f.ncols(), |row, j| {
            let (i, right) = (row % c, c + row % c);
            match row / c {
                0 => part(i, j, 0) + cos * part(right, j, 0) + sin * part(right, j, 1),
                _ => part(i, j, 1) + cos * part(right, j, 1) - sin * part(right, j, 0),
            }
        });
        let left = self.cut.solve(on_cut);
        let at = |i: usize, j: usize, part: usize| if part < parts { left[(part * c + i, j)] } else { 0.0 };
        let ends = Mat::from_fn(2 * c, parts * f.ncols(), |row, column| {
            let (i, j, part) = (row % c, column / parts, column % parts);
            match (row / c, part) {
                (0, _) => at(i, j, part),
                (_, 0) => cos * at(i, j, 0) - sin * at(i, j, 1),
                _ => cos * at(i, j, 1) + sin * at(i, j, 0),
            }
        });
        let field = together(&sector.field_under(force.as_ref(), &ends)?, parts);
        Ok(self.cut.seat.as_ref().map_or_else(|| field.clone(), |seat| seat.settled(field.as_ref())))
    }
}

/// Motion of the whole gear: the freedoms of all sectors, each in its own frame, one above the other.
#[derive(Debug)]
pub(crate) struct Ring<'a> {
    of: &'a VibratingSector,
    cuts: Vec<CutFactor>,
    /// What settles a gear that is free.
    seat: Option<Settled>,
}

impl Ring<'_> {
    /// Displacement of all left cuts (c x z k, sector by sector) under forces on them, harmonic by harmonic.
    fn cuts_under(&self, forces: &Mat<f64>) -> Mat<f64> {
        let (z, c) = (self.of.teeth as usize, forces.nrows());
        let columns = forces.ncols() / z;
        let mut moved = Mat::<f64>::zeros(c, forces.ncols());
        let angle = |n: usize, k: usize| (TAU * ((n * k) % z) as f64 / z as f64).sin_cos();
        for (n, cut) in self.cuts.iter().enumerate() {
            let wave = Mat::from_fn(cut.parts * c, columns, |row, j| {
                let (i, imaginary) = (row % c, row / c == 1);
                let share = |k: usize| {
                    let (sin, cos) = angle(n, k);
                    forces[(i, z * j + k)] * if imaginary { -sin } else { cos }
                };
                (0..z).map(share).sum()
            });
            let wave = cut.solve(wave);
            let weight = cut.parts as f64 / z as f64;
            for j in 0..columns {
                for k in 0..z {
                    let (sin, cos) = angle(n, k);
                    for i in 0..c {
                        let imaginary = if cut.parts == 2 { wave[(c + i, j)] } else { 0.0 };
                        moved[(i, z * j + k)] += weight * (cos * wave[(i, j)] - sin * imaginary);
                    }
                }
            }
        }
        moved
    }
}

impl Pencil for Ring<'_> {
    fn order(&self) -> usize {
        self.of.teeth as usize * self.of.dofs().free_count()
    }

    fn inertia(&self, x: MatRef<'_, f64>) -> Result<Mat<f64>, ReductionError> {
        self.of.inertia(x, self.of.teeth as usize)
    }

    fn follow(&self, f: MatRef<'_, f64>) -> Result<Mat<f64>, ReductionError> {
        let (z, c) = (self.of.teeth as usize, self.of.sector.cut);
        let balanced = self.seat.as_ref().map(|seat| seat.balanced(f));
        let force = apart(balanced.as_ref().map_or(f, |own| own.as_ref()), z);
        let ends = self.of.sector.ends_under(force.as_ref())?;
        // The right cut of the sector before is the left one of this.
        let before = |column: usize| column - column % z + (column % z + z - 1) % z;
        let on_cuts = Mat::from_fn(c, ends.ncols(), |i, column| ends[(i, column)] + ends[(c + i, before(column))]);
        let left = self.cuts_under(&on_cuts);
        let after = |column: usize| column - column % z + (column % z + 1) % z;
        let right = Mat::from_fn(c, left.ncols(), |i, column| left[(i, after(column))]);
        let ends = stacked(left.as_ref(), right.as_ref());
        let field = together(&self.of.sector.field_under(force.as_ref(), &ends)?, z);
        Ok(self.seat.as_ref().map_or_else(|| field.clone(), |seat| seat.settled(field.as_ref())))
    }
}

/// From parts one above the other (n parts x k) to parts side by side (n x parts k).
fn apart(x: MatRef<'_, f64>, parts: usize) -> Mat<f64> {
    let n = x.nrows() / parts;
    let mut apart = Mat::zeros(n, parts * x.ncols());
    for column in 0..apart.ncols() {
        let own = x.col(column / parts).subrows(n * (column % parts), n);
        apart.as_mut().col_mut(column).copy_from(own);
    }
    apart
}

/// Back from [`apart`].
fn together(x: &Mat<f64>, parts: usize) -> Mat<f64> {
    let n = x.nrows();
    let mut together = Mat::zeros(parts * n, x.ncols() / parts);
    for column in 0..x.ncols() {
        let own = x.col(column);
        together.as_mut().col_mut(column / parts).subrows_mut(n * (column % parts), n).copy_from(own);
    }
    together
}
