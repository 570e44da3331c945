//! Preconditioner of the conjugate gradients: forces that close the remaining gaps and add nothing
//! to the load.

use super::forces::{multiples, sum};
use crate::Real;
use crate::numerics::dot;
use nalgebra::{Cholesky, DVector, Dyn};

/// Largest share of rounding in the product of gaps and forces, before level and slope are taken
/// off the gaps.
const MAX_ROUNDING: f64 = 1e-3;

/// Constraint on the forces of loaded cells: one sum, and one moment if the bodies turn.
pub(super) struct Balance<'a, T: Real> {
    arms: &'a [T],
    /// Groups of neighbours whose equations are solved together: their number, and their factored
    /// matrix.
    alone: Vec<(usize, Option<Cholesky<T, Dyn>>)>,
    /// Forces that close a level gap, and a sloped one.
    even: Vec<T>,
    leaning: Vec<T>,
    /// Products of level with level, of level with slope, of slope with slope.
    products: [T; 3],
}

impl<'a, T: Real> Balance<'a, T> {
    pub fn new(arms: &'a [T], alone: Vec<(usize, Option<Cholesky<T, Dyn>>)>) -> Self {
        let products = [T::zero(); 3];
        let mut balance = Self { arms, alone, even: Vec::new(), leaning: Vec::new(), products };
        balance.even = balance.made_up(&vec![T::one(); arms.len()]);
        balance.leaning = balance.made_up(arms);
        let Self { even, leaning, .. } = &balance;
        balance.products = [sum(even), dot(even, arms), dot(leaning, arms)];
        balance
    }

    /// Returns the forces that close the remaining gaps, each group of neighbours by itself.
    fn made_up(&self, missed: &[T]) -> Vec<T> {
        let (mut forces, mut rest) = (Vec::with_capacity(missed.len()), missed);
        for (count, factor) in &self.alone {
            let (run, others) = rest.split_at(*count);
            match factor {
                Some(factor) => forces.extend(&factor.solve(&DVector::from_column_slice(run))),
                None => forces.extend(run),
            }
            rest = others;
        }
        forces
    }

    /// Takes an excess sum and an excess moment off forces.
    pub fn without(&self, forces: Vec<T>, excess: [T; 2]) -> Vec<T> {
        self.less(forces, multiples(self.products, excess))
    }

    fn less(&self, mut forces: Vec<T>, [level, slope]: [T; 2]) -> Vec<T> {
        let both = self.even.iter().zip(&self.leaning);
        for (force, (&even, &leaning)) in forces.iter_mut().zip(both) {
            *force -= level * even + slope * leaning;
        }
        forces
    }

    /// Returns forces without sum and moment that close the remaining gaps, and their product with
    /// these gaps.
    ///
    /// The gaps lose the level and the slope that cause no such forces before the rest is lost in
    /// rounding (Gould, Hribar and Nocedal, *SIAM J. Sci. Comput.* 23, 2001, 1376).
    pub fn step(&self, missed: &mut [T]) -> (Vec<T>, T) {
        let forces = self.made_up(missed);
        let excess = [sum(&forces), dot(&forces, self.arms)];
        let [level, slope] = multiples(self.products, excess);
        let forces = self.less(forces, [level, slope]);
        let size = dot(missed, &forces);
        let beside = level * excess[0] + slope * excess[1];
        if T::epsilon() * beside < T::of(MAX_ROUNDING) * size {
            return (forces, size);
        }
        for (missed, &arm) in missed.iter_mut().zip(self.arms) {
            *missed -= level + slope * arm;
        }
        let size = dot(missed, &forces);
        (forces, size)
    }
}
