//! Cholesky's factor of a symmetric positive matrix that grows by rows.

use super::dot;
use crate::Real;

#[derive(Clone)]
pub(crate) struct Cholesky<T> {
    /// Row by row, each up to the diagonal.
    rows: Vec<T>,
    count: usize,
}

/// Where a row starts.
fn start(row: usize) -> usize {
    row * (row + 1) / 2
}

impl<T: Real> Cholesky<T> {
    pub fn new() -> Self {
        Self { rows: Vec::new(), count: 0 }
    }

    /// Leaves no more than the first rows.
    pub fn truncate(&mut self, count: usize) {
        self.count = self.count.min(count);
        self.rows.truncate(start(self.count));
    }

    /// Adds a row of the matrix, up to its diagonal; `false` if that is no longer positive, or not finite.
    pub fn push(&mut self, row: impl Iterator<Item = T>) -> bool {
        let n = self.count;
        self.rows.extend(row);
        let (before, row) = self.rows.split_at_mut(start(n));
        for j in 0..n {
            let other = &before[start(j)..start(j + 1)];
            row[j] = (row[j] - dot(&row[..j], &other[..j])) / other[j];
        }
        let rest = row[n] - dot(&row[..n], &row[..n]);
        row[n] = rest.max(T::zero()).sqrt();
        self.count += 1;
        rest > T::zero() && rest.is_finite()
    }

    fn row(&self, i: usize) -> &[T] {
        &self.rows[start(i)..start(i + 1)]
    }

    /// Half of a solution: the factor's inverse times the right side.
    pub fn forward(&self, mut values: Vec<T>) -> Vec<T> {
        for i in 0..self.count {
            let row = self.row(i);
            values[i] = (values[i] - dot(&row[..i], &values[..i])) / row[i];
        }
        values
    }

    /// The other half: its transpose's inverse.
    pub fn backward(&self, mut values: Vec<T>) -> Vec<T> {
        for i in (0..self.count).rev() {
            let row = self.row(i);
            let value = values[i] / row[i];
            values[i] = value;
            for (rest, &a) in values[..i].iter_mut().zip(row) {
                *rest -= value * a;
            }
        }
        values
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_matrix_that_loses_a_row() {
        let entry = |i: usize, j: usize| 1.0 / (1.0 + i.abs_diff(j) as f64).powi(2);
        let mut factor = Cholesky::new();
        for cells in [vec![0, 1, 2, 3, 4], vec![0, 1, 4, 3, 6, 9]] {
            factor.truncate(2);
            let rows = if cells.len() == 5 { 0 } else { 2 };
            for n in rows..cells.len() {
                assert!(factor.push((0..=n).map(|j| entry(cells[n], cells[j]))));
            }
            let right: Vec<f64> = (0..cells.len()).map(|i| i as f64 - 2.0).collect();
            let solution = factor.backward(factor.forward(right.clone()));
            for (&i, right) in cells.iter().zip(right) {
                let each = cells.iter().zip(&solution).map(|(&j, x)| entry(i, j) * x);
                assert!((each.sum::<f64>() - right).abs() < 1e-14);
            }
        }
        assert!(!factor.push([1.0; 7].into_iter()));
    }
}
