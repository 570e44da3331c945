//! A square system of linear equations, solved by Gaussian elimination with partial pivoting of
//! scaled rows.
//!
//! Its storage is kept from one system to the next.

use super::dot;
use crate::Real;
use crate::real::same;

/// Number of columns eliminated together: the rows below then pass through the processor once for
/// all of them.
const BLOCK: usize = 16;

#[derive(Clone)]
pub(crate) struct LinearSystem<T> {
    n: usize,
    /// Factors, row by row: below the diagonal the factors of the elimination.
    factors: Vec<T>,
    /// Equation that stands in each row, and the divisor of each equation.
    order: Vec<usize>,
    scales: Vec<T>,
}

impl<T: Real> LinearSystem<T> {
    pub fn new() -> Self {
        Self { n: 0, factors: Vec::new(), order: Vec::new(), scales: Vec::new() }
    }

    /// Factors a matrix given row by row; `false` if it is singular, or not finite.
    pub fn factor(&mut self, matrix: &[T], n: usize) -> bool {
        let zero = T::zero();
        self.n = n;
        self.order.clear();
        self.order.extend(0..n);
        self.factors.clear();
        self.scales.clear();
        for row in matrix.chunks_exact(n) {
            let scale = row.iter().fold(zero, |max, a| max.max(a.abs())).component(0);
            if !(scale > zero && scale.is_finite()) {
                return false;
            }
            self.scales.push(scale);
            self.factors.extend(row.iter().map(|&a| a / scale));
        }
        for first in (0..n).step_by(BLOCK) {
            let last = n.min(first + BLOCK);
            if !(first..last).all(|column| self.eliminate(column, last)) {
                return false;
            }
            let (above, below) = self.factors.split_at_mut(last * n);
            let block = &mut above[first * n..];
            for i in 1..last - first {
                let (pivots, rows) = block.split_at_mut(i * n);
                let (factors, rest) = rows[first..n].split_at_mut(last - first);
                subtract(&factors[..i], pivots, n, rest);
            }
            for row in below.chunks_exact_mut(n) {
                let (factors, rest) = row[first..].split_at_mut(last - first);
                subtract(factors, block, n, rest);
            }
        }
        true
    }

    /// Eliminates a column from the rows below the pivot, in the columns up to `last`; `false`
    /// without a pivot.
    fn eliminate(&mut self, column: usize, last: usize) -> bool {
        let n = self.n;
        let size = |row: usize| self.factors[row * n + column].abs();
        let larger = |best: usize, row: usize| if size(row) > size(best) { row } else { best };
        let pivot = (column..n).fold(column, larger);
        // NaN cannot be a pivot either.
        let usable = size(pivot) > T::zero();
        if !usable {
            return false;
        }
        if pivot != column {
            self.order.swap(pivot, column);
            for k in 0..n {
                self.factors.swap(pivot * n + k, column * n + k);
            }
        }
        let (above, below) = self.factors.split_at_mut((column + 1) * n);
        let pivots = &above[column * n + column..column * n + last];
        for row in below.chunks_exact_mut(n) {
            let row = &mut row[column..last];
            let factor = row[0] / pivots[0];
            row[0] = factor;
            for (a, &pivot) in row.iter_mut().zip(pivots).skip(1) {
                *a -= factor * pivot;
            }
        }
        true
    }

    /// Solves the factored system.
    pub fn solve(&self, right_side: &[T], solution: &mut Vec<T>) {
        let n = self.n;
        solution.clear();
        solution.extend(self.order.iter().map(|&row| right_side[row] / self.scales[row]));
        let first = solution.iter().position(|&value| !same(value, T::zero())).unwrap_or(n);
        for row in first..n {
            let factors = &self.factors[row * n..(row + 1) * n];
            let known = dot(&factors[first..row], &solution[first..row]);
            solution[row] -= known;
        }
        for row in (0..n).rev() {
            let factors = &self.factors[row * n..(row + 1) * n];
            let known = dot(&factors[row + 1..], &solution[row + 1..]);
            solution[row] = (solution[row] - known) / factors[row];
        }
    }
}

/// Subtracts multiples of the last columns of some rows, each of length n.
fn subtract<T: Real>(factors: &[T], rows: &[T], n: usize, rest: &mut [T]) {
    let row = |i: usize| &rows[(i + 1) * n - rest.len()..(i + 1) * n];
    if let Ok(factors) = <[T; BLOCK]>::try_from(factors) {
        let rows: [&[T]; BLOCK] = std::array::from_fn(row);
        for (k, a) in rest.iter_mut().enumerate() {
            *a = (0..BLOCK).fold(*a, |a, i| a - factors[i] * rows[i][k]);
        }
        return;
    }
    let rows: Vec<&[T]> = (0..factors.len()).map(row).collect();
    for (&factor, row) in factors.iter().zip(rows) {
        rest.iter_mut().zip(row).for_each(|(a, &pivot)| *a -= factor * pivot);
    }
}

#[cfg(test)]
mod tests {
    use super::LinearSystem;

    /// More equations than are eliminated together, in any order.
    #[test]
    fn many_equations() {
        let n = 43;
        let entry = |i: usize, j: usize| ((i * i * 7919 + (i + 3) * j * j * 131) % 1009) as f64 - 500.0;
        let matrix: Vec<f64> = (0..n * n).map(|k| entry(k / n, k % n)).collect();
        let due: Vec<f64> = (0..n).map(|j| 1.0 + j as f64).collect();
        let right_side: Vec<f64> =
            matrix.chunks(n).map(|row| row.iter().zip(&due).map(|(a, x)| a * x).sum()).collect();
        let (mut system, mut solution) = (LinearSystem::new(), Vec::new());
        assert!(system.factor(&matrix, n));
        system.solve(&right_side, &mut solution);
        for (x, due) in solution.iter().zip(due) {
            assert!((x / due - 1.0).abs() < 1e-10, "{x} for {due}");
        }
    }

    #[test]
    fn the_solution_satisfies_the_equations() {
        // Badly scaled, and with a zero where the first pivot would be.
        let matrix = [0.0, 2e9, 1e9, 1e-7, 1e-7, 0.0, 3.0, -1.0, 4.0];
        let right_side = [4e9, 3e-7, 13.0];
        let (mut system, mut solution) = (LinearSystem::new(), Vec::new());
        assert!(system.factor(&matrix, 3));
        system.solve(&right_side, &mut solution);
        for (row, due) in matrix.chunks(3).zip(right_side) {
            let sum: f64 = row.iter().zip(&solution).map(|(a, x)| a * x).sum();
            assert!((sum / due - 1.0).abs() < 1e-14);
        }
        assert!(!system.factor(&[1.0, 2.0, 2.0, 4.0], 2));
        assert!(!system.factor(&[1.0, f64::NAN, 2.0, 4.0], 2));
    }
}
