//! Structure of a supernodal factor: the positions of its entries.

use faer::{MatRef, sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky};

use super::Supernode;

/// Columns, rows and places of the values of all supernodes, in order of elimination.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Structure {
    /// First column of each supernode; the last entry is the order of the matrix.
    columns: Vec<usize>,
    /// First entry of each supernode in `rows`; the last one is their number.
    first_row: Vec<usize>,
    /// First entry of each supernode in the values; the last one is their number.
    first_value: Vec<usize>,
    /// Rows of the blocks below the triangles.
    rows: Vec<usize>,
}

impl Structure {
    /// Structure of a symbolic factor.
    pub(super) fn of(symbolic: &SymbolicSupernodalCholesky<usize>) -> Self {
        let count = symbolic.n_supernodes();
        let nodes = || (0..count).map(|k| symbolic.supernode(k));
        let columns: Vec<usize> = nodes().map(|node| node.start()).chain([symbolic.nrows()]).collect();
        let (mut first_row, mut rows) = (vec![0], Vec::new());
        for node in nodes() {
            rows.extend_from_slice(node.pattern());
            first_row.push(rows.len());
        }
        Self { first_value: first_values(&columns, &first_row), columns, first_row, rows }
    }

    /// Structure of supernodes with so many columns each, `order` together, and these rows below; `None` unless the rows of
    /// each ascend and lie below its columns.
    pub(super) fn new(widths: &[u32], rows_below: &[Vec<u32>], order: usize) -> Option<Self> {
        if widths.len() != rows_below.len() || widths.iter().map(|w| *w as usize).sum::<usize>() != order {
            return None;
        }
        let (mut columns, mut first_row, mut rows) = (vec![0], vec![0], Vec::new());
        for (&width, below) in widths.iter().zip(rows_below) {
            columns.push(columns.last()? + width as usize);
            rows.extend(below.iter().map(|&row| row as usize));
            first_row.push(rows.len());
        }
        let made = Self { first_value: first_values(&columns, &first_row), columns, first_row, rows };
        let is_below = |k: usize| {
            let below = made.below(k);
            below.is_sorted_by(|a, b| a < b)
                && below.first().is_none_or(|&row| row >= made.columns[k + 1])
                && below.last().is_none_or(|&row| row < order)
        };
        (!widths.contains(&0) && (0..made.count()).all(is_below)).then_some(made)
    }

    /// Number of supernodes.
    pub(super) fn count(&self) -> usize {
        self.columns.len().saturating_sub(1)
    }

    /// Number of values, the unused triangles among them.
    pub(super) fn values(&self) -> usize {
        self.first_value.last().copied().unwrap_or(0)
    }

    /// Rows below the triangle of supernode `k`.
    pub(super) fn below(&self, k: usize) -> &[usize] {
        &self.rows[self.first_row[k]..self.first_row[k + 1]]
    }

    /// The supernodes with their values.
    pub(super) fn supernodes<'a>(&'a self, values: &'a [f64]) -> impl DoubleEndedIterator<Item = Supernode<'a>> {
        (0..self.count()).map(move |k| {
            let (start, pattern) = (self.columns[k], self.below(k));
            let columns = self.columns[k + 1] - start;
            let own = &values[self.first_value[k]..self.first_value[k + 1]];
            let values = MatRef::from_column_major_slice(own, columns + pattern.len(), columns);
            Supernode { index: k, start, columns, pattern, values }
        })
    }
}

/// Each supernode has a dense block of all its columns, the triangle above the diagonal unused.
fn first_values(columns: &[usize], first_row: &[usize]) -> Vec<usize> {
    let mut first = vec![0];
    for (columns, rows) in columns.windows(2).zip(first_row.windows(2)) {
        let (width, below) = (columns[1] - columns[0], rows[1] - rows[0]);
        first.push(first[first.len() - 1] + width * (width + below));
    }
    first
}
