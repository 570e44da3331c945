//! Sums and products over many intervals, seen from places between and on them.
//!
//! A tree halves the places. Each of its nodes takes the intervals that lie far from all its
//! places, but not from all those of the node above. It adds their contributions to those of the
//! node above, as one Chebyshev series. A place then sees the few intervals near to it one by one,
//! and all others through the series of its node. For N intervals and places, the series cost
//! O(N log N) contributions.

use super::chebyshev::{Coeffs, MAX_SIZE, Table, by_size, values};
use crate::{Interval, Real};
use std::ops::Range;

/// Least distance of a far interval, as a share of the length of the places: its singularities lie
/// at 2.5 half-lengths from the middle, so that coefficient n of a contribution falls as 4.79⁻ⁿ.
const FAR_FROM_PLACES: f64 = 0.75;

/// Numbers of coefficients that leave rounding of f64, 4.79⁻²⁴, and half its digits, 4.79⁻¹².
const COEFFICIENTS: usize = 24;
const FEW_COEFFICIENTS: usize = 12;

/// Smallest number of far intervals that make a series worth its cost.
const LEAST_FAR: usize = 3;

/// Way in which contributions make up the whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Combine {
    Sum,
    Product,
}

impl Combine {
    fn of<T: Real>(self, one: T, other: T) -> T {
        if self == Self::Sum { one + other } else { one * other }
    }

    fn nothing<T: Real>(self) -> T {
        if self == Self::Sum { T::zero() } else { T::one() }
    }
}

/// Contributions of the far intervals, for each group of places.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FarField<T> {
    combine: Combine,
    /// Flag: half the digits of f64 suffice, or are all.
    pub is_coarse: bool,
    nodes: Vec<Node<T>>,
    /// Number of the node of each place.
    of: Vec<usize>,
    /// Room for the places.
    places: Vec<Interval<T>>,
}

#[derive(Clone, Debug, PartialEq)]
struct Node<T> {
    /// Numbers of the intervals that are not in the series.
    near: Range<usize>,
    places: Interval<T>,
    series: Coeffs<T>,
    /// Number of coefficients; 0 if nothing is far.
    terms: usize,
}

impl<T: Real> Node<T> {
    fn values<const W: usize>(&self, x: [T; W], nothing: T) -> [T; W] {
        if self.terms == 0 {
            return [nothing; W];
        }
        let Interval { left, right } = self.places;
        values(&self.series[..self.terms], &x.map(|x| ((x - left) - (right - x)) / (right - left)))
    }
}

impl<T: Real> FarField<T> {
    pub fn new(combine: Combine) -> Self {
        Self { combine, is_coarse: false, nodes: Vec::new(), of: Vec::new(), places: Vec::new() }
    }

    /// Takes intervals and the places from which they will be seen, both from left to right, and
    /// the contribution of an interval, by its number, at a far x. For a coarse field half the
    /// digits of f64 suffice.
    pub fn set(
        &mut self,
        intervals: &[Interval<T>],
        places: impl Iterator<Item = Interval<T>>,
        is_coarse: bool,
        contribution: &dyn Fn(usize, T) -> T,
    ) {
        self.is_coarse = is_coarse || T::epsilon() > T::of(1e-10);
        let (near, series, zero) = (0..intervals.len(), [T::zero(); MAX_SIZE], T::zero());
        self.nodes.clear();
        self.of.clear();
        let nowhere = Interval { left: zero, right: zero };
        self.nodes.push(Node { near, places: nowhere, series, terms: 0 });
        // A place has some interval near.
        if intervals.len() <= LEAST_FAR {
            self.of.extend(places.map(|_| 0));
            return;
        }
        let mut all = std::mem::take(&mut self.places);
        all.clear();
        all.extend(places);
        self.divide(intervals, &all, 0, contribution);
        self.places = all;
    }

    /// Adds the nodes of some places, below a node.
    fn divide(
        &mut self,
        intervals: &[Interval<T>],
        places: &[Interval<T>],
        above: usize,
        contribution: &dyn Fn(usize, T) -> T,
    ) {
        let hull = Interval { left: places[0].left, right: places[places.len() - 1].right };
        let mut near = self.nodes[above].near.clone();
        let apart = T::of(FAR_FROM_PLACES) * (hull.right - hull.left);
        while !near.is_empty() && hull.left - intervals[near.start].right >= apart {
            near.start += 1;
        }
        while !near.is_empty() && intervals[near.end - 1].left - hull.right >= apart {
            near.end -= 1;
        }
        let mut number = above;
        if self.nodes[above].near.len() - near.len() >= LEAST_FAR {
            number = self.nodes.len();
            self.nodes.push(self.node(near, hull, above, contribution));
        }
        if let [_] = places {
            self.of.push(number);
            return;
        }
        let (left, right) = places.split_at(places.len() / 2);
        self.divide(intervals, left, number, contribution);
        self.divide(intervals, right, number, contribution);
    }

    /// Returns a node for some places, below another.
    fn node(
        &self,
        near: Range<usize>,
        places: Interval<T>,
        above: usize,
        contribution: &dyn Fn(usize, T) -> T,
    ) -> Node<T> {
        let above = &self.nodes[above];
        let terms = if self.is_coarse { FEW_COEFFICIENTS } else { COEFFICIENTS };
        let (half, mut series) = (places.half_width(), [T::zero(); MAX_SIZE]);
        by_size!(terms, N => {
            let table = Table::of(N);
            let x: [T; N] = std::array::from_fn(|j| places.left + half * T::of(1.0 + table.z[j]));
            let mut values = above.values(x, self.combine.nothing());
            for i in (above.near.start..near.start).chain(near.end..above.near.end) {
                for (value, &x) in values.iter_mut().zip(&x) {
                    *value = self.combine.of(*value, contribution(i, x));
                }
            }
            series[..N].copy_from_slice(&table.coefficients(&values));
        });
        Node { near, places, series, terms }
    }

    /// Returns the numbers of the intervals to be seen one by one from a place, by its number.
    pub fn near(&self, place: usize) -> Range<usize> {
        self.nodes[self.of[place]].near.clone()
    }

    /// Returns the contribution of all other intervals at each x in that place.
    pub fn far<const W: usize>(&self, place: usize, x: [T; W]) -> [T; W] {
        self.nodes[self.of[place]].values(x, self.combine.nothing())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Intervals of very different widths, with gaps as different between them.
    fn graded(n: usize) -> Vec<Interval<f64>> {
        let mut left = -3.0;
        let mut interval = |i: usize| {
            let [width, gap] = [0.37, 0.83].map(|rate| (6.0 * (rate * i as f64).sin()).exp());
            left += gap;
            left += width;
            Interval { left: left - width, right: left }
        };
        (0..n).map(&mut interval).collect()
    }

    #[test]
    fn sums_and_products_are_those_of_all_intervals() {
        let on = graded(300);
        let gaps: Vec<_> = on
            .windows(2)
            .map(|pair| Interval { left: pair[0].right, right: pair[1].left })
            .collect();
        let sizes = |i: usize| on[i].half_width();
        let sum = |i: usize, x: f64| sizes(i) / (x - on[i].centre());
        let product = |i: usize, x: f64| (x - on[i].left) / (x - on[i].right);
        for combine in [Combine::Sum, Combine::Product] {
            let contribution = |i: usize, x: f64| match combine {
                Combine::Sum => sum(i, x),
                Combine::Product => product(i, x),
            };
            let mut field = FarField::new(combine);
            let seen = std::cell::Cell::new(0);
            field.set(&on, gaps.iter().copied(), false, &|i, x| {
                seen.set(seen.get() + 1);
                contribution(i, x)
            });
            // Of 300 × 299 × 24 if each gap had a series of its own.
            assert!(seen.get() < 200_000, "{} contributions", seen.get());
            let nothing = combine.nothing();
            for (k, gap) in gaps.iter().enumerate() {
                let near = field.near(k);
                assert!(near.contains(&k) && near.contains(&(k + 1)));
                for share in [0.01, 0.3, 0.8, 0.99] {
                    let x = gap.left + share * (gap.right - gap.left);
                    let of = |i: Range<usize>| {
                        i.fold(nothing, |all, i| combine.of(all, contribution(i, x)))
                    };
                    let scale = match combine {
                        Combine::Sum => (0..on.len()).map(|i| contribution(i, x).abs()).sum(),
                        Combine::Product => of(0..on.len()),
                    };
                    let found = combine.of(of(near.clone()), field.far(k, [x])[0]);
                    let error = (found - of(0..on.len())).abs() / scale;
                    // In a narrow gap the rounding of the nodes counts.
                    let rounding = f64::EPSILON * x.abs() / gap.half_width();
                    assert!(error < 1e-14 + rounding, "gap {k}: {error:.1e}, {rounding:.1e}");
                }
            }
        }
    }
}
