//! Grid lines over a flank, and interpolation between them.

use crate::flank::FlankPatch;

/// Cells over the surface coordinates of a patch; each has four lines along the profile and three along the face, ends
/// shared.
#[derive(Debug, Clone)]
pub(crate) struct FlankGridLines {
    /// Ends of the cells, ascending, in either coordinate.
    ends: [Vec<f64>; 2],
}

/// Lines of a cell, as parts of its length: Lobatto's points.
const PROFILE: [f64; 4] = [0.0, 0.276_393_202_250_021, 0.723_606_797_749_979, 1.0];
const FACE: [f64; 3] = [0.0, 0.5, 1.0];
/// One over the product of the distances of a line to the others: the scale of its Lagrange polynomial.
const PROFILE_SCALES: [f64; 2] =
    [-1.0 / (PROFILE[1] * PROFILE[2]), 1.0 / (PROFILE[1] * (PROFILE[2] - PROFILE[1]) * (1.0 - PROFILE[1]))];

/// Cells of the coarsest uniform grid.
const COARSEST: [usize; 2] = [4, 8];
/// Ends of faces nearer than this share of a face are one.
const SAME: f64 = 0.05;

impl FlankGridLines {
    /// A grid whose cells are the faces of the mesh, if these form a grid.
    pub fn of_faces(patch: &FlankPatch) -> Option<Self> {
        let mut ends = [Vec::new(), Vec::new()];
        for face in 0..patch.face_count() {
            let [low, high] = patch.face_range(face);
            (0..2).for_each(|k| ends[k].extend([low[k], high[k]]));
        }
        let size = patch.mean_face_size();
        for (k, of) in ends.iter_mut().enumerate() {
            of.sort_unstable_by(f64::total_cmp);
            of.dedup_by(|b, a| *b - *a < SAME * size[k]);
        }
        let cells = [0, 1].map(|k| ends[k].len().saturating_sub(1));
        (cells[0] > 0 && cells[0] * cells[1] == patch.face_count()).then_some(Self { ends })
    }

    /// A grid of equal cells; each refinement doubles their number in both directions.
    pub fn uniform(patch: &FlankPatch, refinement: usize) -> Self {
        let [low, high] = patch.range();
        let ends = [0, 1].map(|k| {
            let cells = COARSEST[k] << refinement;
            (0..=cells).map(|i| low[k] + (high[k] - low[k]) * i as f64 / cells as f64).collect()
        });
        Self { ends }
    }

    /// The same grid with `cells` equal cells along the face from `low` to `high` (mm); the cells along the profile
    /// stay the same.
    pub fn along_face(&self, cells: usize, [low, high]: [f64; 2]) -> Self {
        let face = (0..=cells).map(|i| low + (high - low) * i as f64 / cells as f64).collect();
        Self { ends: [self.ends[0].clone(), face] }
    }

    /// Number of cells along the face.
    pub fn face_cells(&self) -> usize {
        self.ends[1].len() - 1
    }

    /// Number of lines of points along the profile (0) or the face (1).
    pub fn lines(&self, axis: usize) -> usize {
        [PROFILE.len() - 1, FACE.len() - 1][axis] * (self.ends[axis].len() - 1) + 1
    }

    /// Number of grid points.
    pub fn count(&self) -> usize {
        self.lines(0) * self.lines(1)
    }

    /// Surface coordinates of a grid point.
    pub fn point(&self, p: usize) -> [f64; 2] {
        // Along the profile first: contact lines run along the face, and the points around each place shall lie side by
        // side.
        let number = [p % self.lines(0), p / self.lines(0)];
        [0, 1].map(|k| {
            let parts: &[f64] = if k == 0 { &PROFILE } else { &FACE };
            let ends = &self.ends[k];
            let cell = (number[k] / (parts.len() - 1)).min(ends.len() - 2);
            ends[cell] + (ends[cell + 1] - ends[cell]) * parts[number[k] - cell * (parts.len() - 1)]
        })
    }

    /// Points around a position, three rows of four along the profile, and their weights. Beyond the ends of the flank
    /// they are those of the end. Only the first point of each row is given: the others follow it.
    #[inline]
    pub fn weights(&self, at: [f64; 2]) -> ([usize; FACE.len()], [[f64; PROFILE.len()]; FACE.len()]) {
        let ((i, u, _), (j, v, _)) = (self.cell(0, at[0]), self.cell(1, at[1]));
        let [ends, inner] = PROFILE_SCALES;
        let [a, b, c, d] = [u, u - PROFILE[1], u - PROFILE[2], u - 1.0];
        let (near, far) = (a * b, c * d);
        let of_profile = [ends * b * far, inner * a * far, -inner * near * d, -ends * near * c];
        let of_face = [(2.0 * v - 1.0) * (v - 1.0), 4.0 * v * (1.0 - v), v * (2.0 * v - 1.0)];
        let rows = std::array::from_fn(|b| (j + b) * self.lines(0) + i);
        (rows, of_face.map(|z| of_profile.map(|u| u * z)))
    }

    /// Derivatives of the weights of [`Self::weights`] by either coordinate; 0 beyond the ends of the flank.
    pub fn weight_slopes(&self, at: [f64; 2]) -> [[[f64; PROFILE.len()]; FACE.len()]; 2] {
        let ((_, u, per_u), (_, v, per_v)) = (self.cell(0, at[0]), self.cell(1, at[1]));
        let [ends, inner] = PROFILE_SCALES;
        let [a, b, c, d] = [u, u - PROFILE[1], u - PROFILE[2], u - 1.0];
        let of_profile = [ends * b * c * d, inner * a * c * d, -inner * a * b * d, -ends * a * b * c];
        let of_face = [(2.0 * v - 1.0) * (v - 1.0), 4.0 * v * (1.0 - v), v * (2.0 * v - 1.0)];
        let by_u = [
            ends * (c * d + b * d + b * c),
            inner * (c * d + a * d + a * c),
            -inner * (b * d + a * d + a * b),
            -ends * (b * c + a * c + a * b),
        ];
        let by_v = [4.0 * v - 3.0, 4.0 - 8.0 * v, 4.0 * v - 1.0];
        [of_face.map(|z| by_u.map(|u| u * per_u * z)), by_v.map(|z| of_profile.map(|u| u * per_v * z))]
    }

    /// First line of the cell that a coordinate is in, which part of the cell lies below it, and the derivative of that.
    fn cell(&self, axis: usize, at: f64) -> (usize, f64, f64) {
        let ends = &self.ends[axis][..];
        let [from, .., to] = ends else { return (0, 0.0, 0.0) };
        let lines = [PROFILE.len() - 1, FACE.len() - 1][axis];
        // Cells are about equally long: the place tells which it is, or which is next to it.
        let last = ends.len() - 2;
        let mut cell = (((at - from) / (to - from) * (last + 1) as f64) as usize).min(last);
        loop {
            let [low, high] = [ends[cell], ends[cell + 1]];
            if high <= at && cell < last {
                cell += 1;
            } else if low > at && cell > 0 {
                cell -= 1;
            } else {
                let part = ((at - low) / (high - low)).clamp(0.0, 1.0);
                let is_within = at >= low && at <= high;
                return (cell * lines, part, if is_within { 1.0 / (high - low) } else { 0.0 });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Slopes of the weights are their derivatives, in cells of any length.
    #[test]
    fn slopes_of_weights_are_their_derivatives() {
        let lines = FlankGridLines { ends: [vec![0.0, 0.4, 1.0], vec![-3.0, 1.0, 2.0]] };
        let h = 1e-6;
        for at in [[0.1, -2.0], [0.3, 0.5], [0.7, 1.2], [0.95, -0.1]] {
            let slopes = lines.weight_slopes(at);
            for (axis, of_axis) in slopes.iter().enumerate() {
                let moved = |by: f64| lines.weights([0, 1].map(|k| if k == axis { at[k] + by } else { at[k] })).1;
                let (less, more) = (moved(-h), moved(h));
                for (slope, (less, more)) in
                    of_axis.as_flattened().iter().zip(less.as_flattened().iter().zip(more.as_flattened()))
                {
                    assert!((slope - (more - less) / (2.0 * h)).abs() < 1e-8, "axis {axis} at {at:?}: {slope}");
                }
            }
        }
        assert_eq!(lines.weight_slopes([1.2, 0.0])[0], [[0.0; 4]; 3]);
    }

    /// Weights are Lagrange's: one at their own line and none at the others.
    #[test]
    fn weights_are_those_of_their_lines() {
        let lines = FlankGridLines { ends: [vec![0.0, 1.0], vec![0.0, 1.0]] };
        for (i, u) in PROFILE.into_iter().enumerate() {
            for (j, v) in FACE.into_iter().enumerate() {
                let (_, weights) = lines.weights([u, v]);
                for (b, of_row) in weights.iter().enumerate() {
                    for (a, weight) in of_row.iter().enumerate() {
                        let own = f64::from(u8::from(a == i && b == j));
                        assert!((weight - own).abs() < 1e-14, "line {a}, {b} at {u}, {v}: {weight}");
                    }
                }
            }
        }
    }
}
