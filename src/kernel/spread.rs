//! Pressures by their coefficients.

use crate::numerics::chebyshev::value_at;
use crate::numerics::dot;
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
    fn nodes(&self, [count, terms]: [usize; 2]) -> impl Iterator<Item = [T; 2]> {
        let at = move |[x, cos]: [T; 2]| [x, value_at(&self.q[..terms], cos) / T::count(count)];
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
pub(crate) fn series<T: Real>(values: &[T]) -> Vec<T> {
    let count = values.len();
    let cosines = cosines(count);
    let term = |k: usize| {
        let terms = values.iter().enumerate();
        let sum = terms.fold(T::zero(), |sum, (i, &value)| {
            sum + value * cosines[(2 * i + 1) * k % (4 * count)]
        });
        sum * T::of(if k == 0 { 1.0 } else { 2.0 }) / T::count(count)
    };
    (0..count).map(term).collect()
}

/// Returns the cosines of all multiples of π/2n, from which those of all orders at the nodes are.
fn cosines<T: Real>(count: usize) -> Vec<T> {
    let step = T::pi() / T::count(2 * count);
    let quarter: Vec<T> = (0..=count).map(|j| (step * T::count(j)).cos()).collect();
    let cosine = |j: usize| match j.min(4 * count - j) {
        j if j > count => -quarter[2 * count - j],
        j => quarter[j],
    };
    (0..4 * count).map(cosine).collect()
}

/// Nodes of a Gauss-Chebyshev rule on an interval.
pub(super) struct Nodes<T> {
    pub x: Vec<T>,
    /// `cos kθ` over the number of nodes, by rows of one node.
    shares: Vec<T>,
}

impl<T: Real> Nodes<T> {
    pub fn new(on: Interval<T>, count: usize) -> Self {
        let x = places(on, count).map(|[x, _]| x).collect();
        let cosines: Vec<T> =
            cosines::<T>(count).iter().map(|&cos| cos / T::count(count)).collect();
        let row = |node: usize| (0..count).map(move |k| (2 * node + 1) * k % (4 * count));
        Self { x, shares: (0..count).flat_map(row).map(|j| cosines[j]).collect() }
    }

    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// Returns the coefficients of `Σ q_k cos kθ`, given its values at the nodes.
    pub fn coefficients(&self, values: impl Iterator<Item = T>) -> Vec<T> {
        let mut sums = vec![T::zero(); self.len()];
        for (value, shares) in values.zip(self.shares.chunks(self.len())) {
            sums.iter_mut().zip(shares).for_each(|(sum, &share)| *sum += value * share);
        }
        sums[1..].iter_mut().for_each(|q| *q += *q);
        sums
    }

    /// Adds a sum of multiples of the coefficients to a row for the values at the nodes.
    pub fn add_terms(&self, terms: impl Iterator<Item = T>, row: &mut [T]) {
        let twice = |(k, term): (usize, T)| if k == 0 { term } else { term + term };
        let terms: Vec<T> = terms.take(self.len()).enumerate().map(twice).collect();
        for (value, shares) in row.iter_mut().zip(self.shares.chunks(self.len())) {
            *value += dot(&terms, shares);
        }
    }
}

/// Returns pressures as loads at nodes, each with its place, for a kernel with its nearest
/// singularity at a distance.
pub(crate) fn loads<T: Real>(distance: T, spreads: &[Spread<T>]) -> Vec<[T; 2]> {
    spreads.iter().flat_map(|spread| spread.nodes(super::nodes(distance, spread))).collect()
}
