//! The bend of a body: what the regular kernel adds to the gap.
//!
//! Over the contacts r and its integral are Chebyshev series on panels, each made when it is asked
//! for; outside them they are summed directly.

use super::Kernel;
use super::spread::{Spread, loads, places, series};
use crate::numerics::chebyshev::{MAX_SIZE, value_at};
use crate::{Interval, Real};
use num_traits::ToPrimitive;
use std::sync::OnceLock;

/// Width of the panels over several contacts, in units of the distance of the nearest singularity:
/// there a series of [`MAX_SIZE`] terms leaves an error of 1e-16.
const WIDTH: f64 = 1.4;

/// Distance beside the contacts that belongs to the panels, in the same units: the contacts of the
/// next step, and the samples beside them, lie there.
const MARGIN: f64 = 0.25;

/// Distance of the places between which the bend is about a cubic, by the distances of the nearest
/// singularity and of the contacts.
const BETWEEN: [f64; 2] = [0.25, 0.5];

/// Bend by the pressures in some intervals.
pub(crate) struct Bend<'b, T: Real> {
    kernel: Kernel<'b, T>,
    /// Pressures as loads at places.
    loads: Vec<[T; 2]>,
    /// Interval of the panels.
    on: Interval<T>,
    rows: Vec<OnceLock<Row<T>>>,
}

/// Series of r and of its integral on a panel.
type Row<T> = [Vec<T>; 2];

impl<'b, T: Real> Bend<'b, T> {
    /// Creates the bend by these pressures, at least one.
    pub fn new(kernel: &Kernel<'b, T>, spreads: &[Spread<T>]) -> Self {
        let ends = spreads.iter().map(|spread| spread.on);
        let margin = T::of(MARGIN) * kernel.distance();
        let hull = Interval {
            left: ends.clone().fold(T::max_value().unwrap_or(T::one()), |x, on| x.min(on.left))
                - margin,
            right: ends.fold(T::min_value().unwrap_or(T::zero()), |x, on| x.max(on.right)) + margin,
        };
        // A period is short, and all of it is as far from the next contacts.
        let period = kernel.row.as_ref().map(|row| row.range);
        let on = period.map_or(hull, |[left, right]| Interval { left, right });
        // Over one contact a single series converges with the root of its width.
        let cells = ((on.right - on.left) / (T::of(WIDTH) * kernel.distance())).component(0);
        let is_short = spreads.len() == 1 && period.is_none();
        let count = if is_short { 1 } else { super::at_least(cells).max(1) };
        let rows = (0..count).map(|_| OnceLock::new()).collect();
        let loads = loads(kernel.distance(), spreads);
        Self { kernel: kernel.clone(), loads, on, rows }
    }

    /// Returns the kernel.
    pub fn kernel_of_bodies(&self) -> &Kernel<'b, T> {
        &self.kernel
    }

    /// Returns the mean of `∫ r dx` of loads at places over an interval, with the weight
    /// `1/(π sqrt((x + b)(a - x)))`.
    pub fn mean_height(&self, loads: &[[T; 2]], on: Interval<T>) -> T {
        let [_, count, _] = self.kernel.terms(on);
        let heights = places(on, count).map(|[x, _]| self.kernel.sums([1], x, loads)[0]);
        heights.fold(T::zero(), |sum, height| sum + height) / T::count(count)
    }

    /// Returns the number of terms of a series of r on an interval.
    pub fn terms(&self, on: Interval<T>) -> usize {
        super::terms_of_bend(self.kernel.distance(), on)
    }

    /// Lists places over a range, by rising x, between which the bend is about a cubic.
    pub fn places(&self, [from, to]: [T; 2]) -> impl Iterator<Item = T> + use<'_, T> {
        let on = self.on;
        let least = T::of(BETWEEN[0]) * self.kernel.distance().min(on.half_width());
        let width = move |x: T| least.max(T::of(BETWEEN[1]) * (on.left - x).max(x - on.right));
        // Outward from the panels.
        let left = std::iter::successors(Some(on.left), move |&x| Some(x - width(x)));
        let mut left: Vec<T> = left.take_while(|&x| x > from).collect();
        left.reverse();
        let right = std::iter::successors(Some(on.left + least), move |&x| Some(x + width(x)));
        left.into_iter().chain(right.take_while(move |&x| x < to)).filter(move |&x| x > from)
    }

    /// Returns r at x.
    pub fn slope(&self, x: T) -> T {
        self.values([0], x)[0]
    }

    /// Returns `∫ r dx` at x, up to a constant.
    pub fn height(&self, x: T) -> T {
        self.values([1], x)[0]
    }

    /// Returns r (0) or `∫ r dx` (1) at x.
    pub fn values<const N: usize>(&self, which: [usize; N], x: T) -> [T; N] {
        match self.row(x) {
            Some((row, z)) => which.map(|of| value_at(&row[of], z)),
            None => self.kernel.sums(which, x, &self.loads),
        }
    }

    /// Returns the panel that contains x, and the place in it.
    fn row(&self, x: T) -> Option<(&Row<T>, T)> {
        let Interval { left, right } = self.on;
        if !(x >= left && x <= right) {
            return None;
        }
        let count = self.rows.len();
        let width = (right - left) / T::count(count);
        let at: f64 = ((x - left) / width).component(0).to_subset_unchecked();
        let i = at.to_usize().unwrap_or(0).min(count - 1);
        let left = left + width * T::count(i);
        let on = Interval { left, right: left + width };
        let row = self.rows[i].get_or_init(|| self.made(on));
        Some((row, (x - on.centre()) / on.half_width()))
    }

    fn made(&self, on: Interval<T>) -> Row<T> {
        let terms = if self.rows.len() == 1 { self.kernel.terms(on)[1] } else { MAX_SIZE };
        let values: Vec<T> =
            places(on, terms).map(|[x, _]| self.kernel.sums([0], x, &self.loads)[0]).collect();
        let mut slope = series(&values);
        let largest = slope.iter().fold(T::zero(), |most, a| most.max(a.abs()));
        let counts = |a: &T| a.abs() > T::of(0.125) * T::epsilon() * largest;
        slope.truncate(slope.iter().rposition(counts).map_or(1, |last| last + 1));
        // 2 ∫ T_k ds = T_{k+1}/(k+1) - T_{k-1}/(k-1), but T₁ of T₀, and T₂/4 of T₁.
        let of = |k: usize| slope.get(k).map_or(T::zero(), |&a| if k == 0 { a + a } else { a });
        let term = |k: usize| on.half_width() * (of(k - 1) - of(k + 1)) / T::count(2 * k);
        let terms = (1..=slope.len()).map(term);
        let mut height: Vec<T> = std::iter::once(T::zero()).chain(terms).collect();
        let [middle] = self.kernel.sums([1], on.centre(), &self.loads);
        height[0] = middle - value_at(&height, T::zero());
        [slope, height]
    }
}
