//! A square system of linear equations, solved by Gaussian elimination row by row; the pivot of a
//! row is its largest element.
//!
//! Its storage is kept from one system to the next.

use super::dot;
use crate::Real;

/// Number of rows that are subtracted from another at a time: it is read and written once for all.
const ROWS_TOGETHER: usize = 4;

#[derive(Clone)]
pub(crate) struct LinearSystem<T> {
    /// Factors, row by row: below the diagonal the factors of the elimination.
    factors: Vec<T>,
    /// Unknown that stands in each column.
    order: Vec<usize>,
}

impl<T: Real> LinearSystem<T> {
    pub fn new() -> Self {
        Self { factors: Vec::new(), order: Vec::new() }
    }

    /// Factors a square matrix given row by row; `false` if it is singular, or not finite.
    pub fn factor<'m>(&mut self, rows: impl ExactSizeIterator<Item = &'m [T]>) -> bool {
        let n = rows.len();
        self.order.clear();
        self.order.extend(0..n);
        self.factors.clear();
        rows.for_each(|row| self.factors.extend_from_slice(row));
        for i in 0..n {
            let (above, rest) = self.factors.split_at_mut(i * n);
            eliminate(above, &mut rest[..n]);
            let larger =
                |best: usize, k: usize| if rest[k].abs() > rest[best].abs() { k } else { best };
            let pivot = (i..n).fold(i, larger);
            if rest[pivot].is_zero() || !rest[i..n].iter().all(|a| a.is_finite()) {
                return false;
            }
            if pivot != i {
                self.order.swap(pivot, i);
                self.factors.chunks_exact_mut(n).for_each(|row| row.swap(pivot, i));
            }
        }
        true
    }

    /// Solves the factored system.
    pub fn solve(&self, right_side: &[T], solution: &mut Vec<T>) {
        let n = self.order.len();
        solution.clear();
        solution.extend_from_slice(right_side);
        for row in 0..n {
            let known = dot(&self.factors[row * n..][..row], &solution[..row]);
            solution[row] -= known;
        }
        for row in (0..n).rev() {
            let factors = &self.factors[row * n..(row + 1) * n];
            let rest = dot(&factors[row + 1..], &solution[row + 1..]);
            solution[row] = (solution[row] - rest) / factors[row];
        }
        solution.resize(2 * n, T::zero());
        for (i, &unknown) in self.order.iter().enumerate() {
            solution[n + unknown] = solution[i];
        }
        solution.drain(..n);
    }
}

/// Eliminates from a row the unknowns of the factored rows above it, several at a time.
fn eliminate<T: Real>(above: &[T], row: &mut [T]) {
    let (zero, n) = (T::zero(), row.len());
    for (block, pivots) in above.chunks(ROWS_TOGETHER * n).enumerate() {
        let (first, count) = (ROWS_TOGETHER * block, pivots.len() / n);
        let mut factors = [zero; ROWS_TOGETHER];
        for j in 0..count {
            let known = |rest: T, l: usize| rest - factors[l] * pivots[l * n + first + j];
            factors[j] = (0..j).fold(row[first + j], known) / pivots[j * n + first + j];
            row[first + j] = factors[j];
        }
        let row = &mut row[first + count..];
        let rests: [&[T]; ROWS_TOGETHER] = std::array::from_fn(|j| {
            let end = (j.min(count - 1) + 1) * n;
            &pivots[end - row.len()..end]
        });
        for i in 0..row.len() {
            row[i] -= (0..ROWS_TOGETHER).fold(zero, |sum, j| sum + factors[j] * rests[j][i]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::LinearSystem;

    #[test]
    fn the_solution_satisfies_the_equations() {
        // Badly scaled, and with a zero where the first pivot would be.
        let matrix = [0.0, 2e9, 1e9, 1e-7, 1e-7, 0.0, 3.0, -1.0, 4.0];
        let right_side = [4e9, 3e-7, 13.0];
        let (mut system, mut solution) = (LinearSystem::new(), Vec::new());
        assert!(system.factor(matrix.chunks(3)));
        system.solve(&right_side, &mut solution);
        for (row, due) in matrix.chunks(3).zip(right_side) {
            let sum: f64 = row.iter().zip(&solution).map(|(a, x)| a * x).sum();
            assert!((sum / due - 1.0).abs() < 1e-14);
        }
        assert!(!system.factor([1.0, 2.0, 2.0, 4.0].chunks(2)));
        assert!(!system.factor([1.0, f64::NAN, 2.0, 4.0].chunks(2)));
    }
}
