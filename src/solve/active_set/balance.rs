//! Forces that make up for what is missed of closed gaps, and add nothing to the load: what
//! conjugate gradients go by.

use super::forces::{multiples, sum};
use crate::Real;
use crate::numerics::dot;
use nalgebra::{Cholesky, DVector, Dyn};

/// The share of what is missed that may be rounding beside its level.
const ROUNDED: f64 = 1e-3;

/// How forces among loaded cells are kept to one sum, and to one moment where the bodies turn.
pub(super) struct Balance<'a, T: Real> {
    arms: &'a [T],
    /// How many neighbours have their equations solved together, and their matrix, factored.
    alone: Vec<(usize, Option<Cholesky<T, Dyn>>)>,
    /// The forces that make up for a level, and for a slope.
    even: Vec<T>,
    leaning: Vec<T>,
    /// Those of the level with the level, of either with the other, of the slope with the slope.
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

    /// Returns the forces that close the gaps missed, each group of neighbours by itself.
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

    /// Takes from forces what they have too much of: a sum, and a moment.
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

    /// Returns forces without sum and moment that close the gaps missed, and their product with
    /// those gaps.
    ///
    /// What is missed loses the level and the slope with which it makes up no forces before the
    /// rest is lost in rounding beside them (Gould, Hribar and Nocedal, *SIAM J. Sci. Comput.* 23,
    /// 2001, 1376).
    pub fn step(&self, missed: &mut [T]) -> (Vec<T>, T) {
        let forces = self.made_up(missed);
        let excess = [sum(&forces), dot(&forces, self.arms)];
        let [level, slope] = multiples(self.products, excess);
        let forces = self.less(forces, [level, slope]);
        let size = dot(missed, &forces);
        let beside = level * excess[0] + slope * excess[1];
        if T::epsilon() * beside < T::of(ROUNDED) * size {
            return (forces, size);
        }
        for (missed, &arm) in missed.iter_mut().zip(self.arms) {
            *missed -= level + slope * arm;
        }
        let size = dot(missed, &forces);
        (forces, size)
    }
}
