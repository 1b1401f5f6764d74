//! Compliance of a window of identical teeth, tooth by tooth.

use faer::Mat;

/// C of a window whose teeth are all alike.
///
/// ```text
/// C_ij = R_i B_(i-j) R_j'     B_d: displacements on the d-th tooth on by forces on one, each in its own frame, mm/N
/// ```
/// w blocks in place of w^2: they are what is kept of C.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ToothBlocks {
    /// B_d, d = 0 .. w - 1, 3m x 3m each; B_0 symmetric to the bit.
    pub blocks: Vec<Mat<f64>>,
    /// Of each coordinate node the tooth, from the window's first one, and the number of the load on it.
    pub places: Vec<[u32; 2]>,
    /// Angle of the frame of each tooth in that of C, rad.
    pub angles: Vec<f64>,
}

impl ToothBlocks {
    /// Whether blocks, places and angles fit together, for so many nodes.
    pub(crate) fn fit(&self, nodes: usize) -> bool {
        let loads = self.blocks.first().map_or(0, Mat::nrows);
        let inside = |&[tooth, load]: &[u32; 2]| (tooth as usize) < self.angles.len() && 3 * (load as usize) < loads;
        self.places.len() == nodes
            && self.angles.len() == self.blocks.len()
            && loads.is_multiple_of(3)
            && self.blocks.iter().all(|block| (block.nrows(), block.ncols()) == (loads, loads))
            && self.places.iter().all(inside)
    }

    /// Columns of C (mm/N) by forces on the first `count` nodes.
    pub(crate) fn columns(&self, count: usize) -> Mat<f64> {
        // Coordinates and loads of each tooth.
        let mut of_tooth = vec![Vec::new(); self.blocks.len()];
        let places = self.places.iter().map(|place| place.map(|k| k as usize));
        places.enumerate().for_each(|(i, [tooth, load])| of_tooth[tooth].push((i, load)));
        let mut columns = Mat::<f64>::zeros(3 * self.places.len(), 3 * count);
        let counted = |of: &[(usize, usize)]| of.iter().any(|(i, _)| *i < count);
        for (low, loaded) in of_tooth.iter().enumerate() {
            for (high, moved) in of_tooth.iter().enumerate().skip(low).filter(|(_, of)| counted(of) || counted(loaded))
            {
                let block = turned(&self.blocks[high - low], [high, low].map(|tooth| self.angles[tooth]));
                for &(j, load) in loaded {
                    for &(i, at) in moved.iter().filter(|(i, _)| high > low || *i >= j) {
                        for (a, b) in (0..3).flat_map(|b| (0..3).map(move |a| (a, b))) {
                            let value = block[(3 * at + a, 3 * load + b)];
                            // C is symmetric to the bit.
                            if j < count && (i != j || a >= b) {
                                columns[(3 * i + a, 3 * j + b)] = value;
                            }
                            if i < count && (i != j || a >= b) {
                                columns[(3 * j + b, 3 * i + a)] = value;
                            }
                        }
                    }
                }
            }
        }
        columns
    }
}

/// A block with its rows and columns turned from the frames of their teeth by these angles, rad.
pub(crate) fn turned(block: &Mat<f64>, angles: [f64; 2]) -> Mat<f64> {
    angles.into_iter().fold(block.clone(), |mut block, angle| {
        let (sin, cos) = angle.sin_cos();
        for mut column in block.col_iter_mut() {
            for i in (0..column.nrows()).step_by(3) {
                let (x, y) = (column[i], column[i + 1]);
                column[i] = cos * x - sin * y;
                column[i + 1] = sin * x + cos * y;
            }
        }
        block.transpose().to_owned()
    })
}
