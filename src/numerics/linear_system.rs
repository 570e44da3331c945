//! A square system of linear equations, solved by Gaussian elimination with partial pivoting of
//! scaled rows.
//!
//! Its storage is kept from one system to the next.

use super::dot;
use crate::Real;
use crate::real::same;

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

    /// Factors a square matrix given row by row; `false` if it is singular, or not finite.
    pub fn factor<'m>(&mut self, rows: impl ExactSizeIterator<Item = &'m [T]>) -> bool {
        let (zero, n) = (T::zero(), rows.len());
        self.n = n;
        self.order.clear();
        self.order.extend(0..n);
        self.factors.clear();
        self.scales.clear();
        for row in rows {
            let scale = row.iter().fold(zero, |max, a| max.max(a.abs())).component(0);
            if !(row.len() == n && scale > zero && scale.is_finite()) {
                return false;
            }
            self.scales.push(scale);
            self.factors.extend(row.iter().map(|&a| a / scale));
        }
        for column in 0..n {
            let size = |row: usize| self.factors[row * n + column].abs();
            let larger = |best: usize, row: usize| if size(row) > size(best) { row } else { best };
            let pivot = (column..n).fold(column, larger);
            // NaN cannot be a pivot either.
            let usable = size(pivot) > zero;
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
            let pivot_row = &above[column * n..];
            for row in below.chunks_exact_mut(n) {
                let factor = row[column] / pivot_row[column];
                row[column] = factor;
                // A derivative may not be zero where its value is.
                if !same(factor, T::zero()) {
                    let rest = column + 1..n;
                    for (a, &pivot) in row[rest.clone()].iter_mut().zip(&pivot_row[rest]) {
                        *a -= factor * pivot;
                    }
                }
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
