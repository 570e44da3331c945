//! Pressures by their coefficients.

use super::Kernel;
use crate::numerics::chebyshev::value_at;
use crate::{Ends, Interval, Real};

/// Pressure in one interval, `P = Σ q_k cos kθ/(π L sin θ)` with `x = c + L cos θ`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Spread<T> {
    pub on: Interval<T>,
    pub q: Vec<T>,
}

impl<T: Real> Spread<T> {
    /// Returns the pressure at a place inside.
    pub fn at(&self, x: T) -> T {
        let z = self.on.angle(x).cos();
        T::frac_1_pi() * value_at(&self.q, z) / self.on.chebyshev_weight(x)
    }

    /// Returns the strengths of the singularities at the limits, as shares of those of the same
    /// load on a half-plane.
    pub fn strengths(&self) -> Ends<T> {
        Ends { left: value_at(&self.q, -T::one()), right: value_at(&self.q, T::one()) }
    }

    /// Returns the same pressure, multiplied by a factor.
    pub fn times(&self, factor: T) -> Self {
        Self { on: self.on, q: self.q.iter().map(|&q| factor * q).collect() }
    }

    /// Lists the nodes of a Gauss-Chebyshev rule, each with its share of the load.
    fn nodes(&self, count: usize) -> impl Iterator<Item = [T; 2]> {
        let at = move |[x, cos]: [T; 2]| [x, value_at(&self.q, cos) / T::count(count)];
        places(self.on, count).map(at)
    }
}

/// Lists the nodes of a Gauss-Chebyshev rule on an interval, with their cosines.
pub(super) fn places<T: Real>(on: Interval<T>, count: usize) -> impl Iterator<Item = [T; 2]> {
    let (centre, half_width) = (on.centre(), on.half_width());
    (0..count).map(move |i| {
        let cos = (T::pi() * (T::count(i) + T::of(0.5)) / T::count(count)).cos();
        [centre + half_width * cos, cos]
    })
}

/// Returns the Chebyshev coefficients of a polynomial, given its values at the nodes.
pub(super) fn series<T: Real>(values: &[T]) -> Vec<T> {
    let (zero, count) = (T::zero(), values.len());
    let share = T::of(2.0) / T::count(count);
    let step = T::pi() / T::count(2 * count);
    // All angles are multiples of one.
    let cosines: Vec<T> = (0..4 * count).map(|j| share * (step * T::count(j)).cos()).collect();
    let term = |k: usize| {
        let terms = values.iter().enumerate();
        terms.fold(zero, |sum, (i, &value)| sum + value * cosines[(2 * i + 1) * k % (4 * count)])
    };
    let mut series: Vec<T> = (0..count).map(term).collect();
    series[0] *= T::of(0.5);
    series
}

/// Pressures as loads at nodes.
pub(crate) struct Loads<T> {
    /// Places and their loads.
    pub nodes: Vec<[T; 2]>,
}

impl<T: Real> Loads<T> {
    pub fn of(kernel: &Kernel<'_, T>, spreads: &[Spread<T>]) -> Self {
        let nodes = |spread: &Spread<T>| spread.nodes(kernel.nodes(spread)).collect::<Vec<_>>();
        Self { nodes: spreads.iter().flat_map(nodes).collect() }
    }

    /// Returns r at x.
    pub fn slope(&self, kernel: &Kernel<'_, T>, x: T) -> T {
        kernel.sums([0], x, &self.nodes)[0]
    }

    /// Returns `∫ r dx` at x, up to a constant.
    pub fn height(&self, kernel: &Kernel<'_, T>, x: T) -> T {
        kernel.sums([1], x, &self.nodes)[0]
    }

    /// Returns both.
    pub fn both(&self, kernel: &Kernel<'_, T>, x: T) -> [T; 2] {
        kernel.sums([0, 1], x, &self.nodes)
    }
}
