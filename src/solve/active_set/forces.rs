//! Forces that close the gap in a set of loaded cells.

use super::ActiveSet;
use super::balance::Balance;
use crate::Real;
use crate::numerics::dot;
use nalgebra::{Cholesky, DMatrix, Dyn};

/// Largest number of loaded cells whose equations are all solved together.
const DENSE: usize = 120;

/// Number of neighbours whose equations are solved together in each step of conjugate gradients.
const NEIGHBOURS: usize = 32;

/// Relative tolerance of the forces from conjugate gradients.
const TOLERANCE: f64 = 1e-4;

/// Largest number of steps of conjugate gradients for one system.
const MAX_GRADIENTS: usize = 300;

impl<T: Real> ActiveSet<'_, T> {
    /// Closes the gap in the loaded cells; returns the uncertainty of the forces.
    pub(super) fn solve(&mut self) -> T {
        self.solves += 1;
        let on: Vec<_> = (0..self.cells.len()).filter(|&i| self.cells[i].loaded).collect();
        on.iter().for_each(|&i| self.matrix.load(i));
        let arms: Vec<_> = on.iter().map(|&i| self.arm(self.cells[i].centre())).collect();
        let (forces, steps) = self.iterate(&on, &arms);
        self.work += self.cells.len() * steps;
        let mut all = vec![T::zero(); self.cells.len()];
        let mut largest = T::zero();
        for (&i, &force) in on.iter().zip(&forces) {
            self.cells[i].force = force;
            all[i] = force;
            largest = largest.max(force.abs());
        }
        self.potential.clone_from(&all);
        self.matrix.of(&all, |_| true, &mut self.potential);
        let sunk: Vec<_> = on.iter().map(|&i| self.rise[i] + self.potential[i]).collect();
        [self.level, self.slope] = line(&arms, [sum(&sunk), dot(&arms, &sunk)]);
        let rounding = T::of(64.0) * T::epsilon() * (T::one() + self.level.abs());
        let is_exact = self.is_dense(on.len());
        if is_exact { rounding.min(T::of(0.1) * largest) } else { T::of(1e-3) * largest }
    }

    /// Tells whether the equations of so many loaded cells are all solved together.
    fn is_dense(&self, count: usize) -> bool {
        count <= DENSE || self.matrix.is_of_kernel()
    }

    /// Factors the matrix of some loaded cells.
    fn factor(&self, on: &[usize]) -> Option<Cholesky<T, Dyn>> {
        // The lower half suffices.
        let entry = |i, j| if i < j { T::zero() } else { self.matrix.entry(on[i], on[j]) };
        DMatrix::from_fn(on.len(), on.len(), entry).cholesky()
    }

    /// Returns the forces by conjugate gradients among forces of one sum, and of one moment if the
    /// bodies turn; and the number of steps. The preconditioner closes the gaps of each group of
    /// neighbours as if it were alone.
    fn iterate(&self, on: &[usize], arms: &[T]) -> (Vec<T>, usize) {
        let zero = T::zero();
        let mut all = vec![zero; self.cells.len()];
        let mut sunk = all.clone();
        let mut times = |forces: &[T]| -> Vec<T> {
            for (&i, &force) in on.iter().zip(forces) {
                all[i] = force;
            }
            self.matrix.of(&all, |i| self.cells[i].loaded, &mut sunk);
            on.iter().map(|&i| sunk[i]).collect()
        };
        let together = if self.is_dense(on.len()) { on.len() } else { NEIGHBOURS };
        let alone = on.chunks(together).map(|run| (run.len(), self.factor(run))).collect();
        let balance = Balance::new(arms, alone);
        let forces: Vec<_> = on.iter().map(|&i| self.cells[i].force.max(zero)).collect();
        let excess = [sum(&forces) - T::one(), dot(&forces, arms)];
        let mut forces = balance.without(forces, excess);
        let sunk = times(&forces);
        let mut missed: Vec<_> =
            on.iter().zip(sunk).map(|(&i, sunk)| -sunk - self.rise[i]).collect();
        let (mut next, mut size) = balance.step(&mut missed);
        let (mut way, mut steps) = (next.clone(), 0);
        while steps < MAX_GRADIENTS {
            steps += 1;
            if dot(&next, &next) <= T::of(TOLERANCE * TOLERANCE) * dot(&forces, &forces) {
                break;
            }
            let product = times(&way);
            let step = size / dot(&way, &product);
            if !step.is_finite() {
                break;
            }
            for i in 0..on.len() {
                forces[i] += step * way[i];
                missed[i] -= step * product[i];
            }
            let before = size;
            (next, size) = balance.step(&mut missed);
            for (way, &next) in way.iter_mut().zip(&next) {
                *way = next + size / before * *way;
            }
        }
        (forces, steps)
    }
}

pub(super) fn sum<T: Real>(values: &[T]) -> T {
    values.iter().fold(T::zero(), |sum, &value| sum + value)
}

/// Returns the level and the slope of the line through values with given sum and moment; the slope
/// is zero if all arms are.
pub(super) fn line<T: Real>(arms: &[T], of_values: [T; 2]) -> [T; 2] {
    multiples([T::count(arms.len()), sum(arms), dot(arms, arms)], of_values)
}

/// Returns the multiples of two vectors whose sum has given products with both, from the products
/// of the first with itself, of both with each other, and of the second with itself. The second may
/// be zero.
pub(super) fn multiples<T: Real>([own, with, other]: [T; 3], [first, second]: [T; 2]) -> [T; 2] {
    let share = with / own;
    let rest = other - share * with;
    let slope = if rest > T::zero() { (second - share * first) / rest } else { T::zero() };
    [(first - with * slope) / own, slope]
}
