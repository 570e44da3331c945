//! The bend of a body: what the regular kernel adds to the gap.
//!
//! Over the contacts r and its integral are Chebyshev series on panels, each made when it is asked
//! for; outside them they are summed directly.

use super::Kernel;
use super::spread::{Loads, Spread, places, series};
use crate::numerics::chebyshev::{MAX_SIZE, value_at};
use crate::{Ends, Interval, Real, Side};
use std::sync::OnceLock;

/// Width of the panels over several contacts, in units of the distance of the nearest singularity:
/// there a series of [`MAX_SIZE`] terms leaves an error of 1e-16.
const WIDTH: f64 = 1.4;

/// Distance beside the contacts that belongs to the panels, in the same units: the contacts of the
/// next step, and the samples beside them, lie there.
const MARGIN: f64 = 0.25;

/// Bend by the pressures in some intervals.
pub(crate) struct Bend<'b, T: Real> {
    kernel: Kernel<'b, T>,
    loads: Loads<T>,
    /// Interval of the panels.
    on: Interval<T>,
    rows: Vec<OnceLock<Row<T>>>,
    /// Steps of the height from direct sums to the panels, at their ends.
    steps: Ends<OnceLock<T>>,
}

/// r and its integral on a panel.
struct Row<T> {
    slope: Vec<T>,
    height: Vec<T>,
}

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
        let loads = Loads::of(kernel.distance(), spreads);
        let steps = Ends::from_fn(|_| OnceLock::new());
        Self { kernel: kernel.clone(), loads, on, rows, steps }
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

    /// Returns r at x.
    pub fn slope(&self, x: T) -> T {
        match self.row(x) {
            Some((row, z)) => value_at(&row.slope, z),
            None => self.loads.slope(&self.kernel, x),
        }
    }

    /// Returns `∫ r dx` at x, up to a constant.
    pub fn height(&self, x: T) -> T {
        match self.row(x) {
            Some((row, z)) => value_at(&row.height, z),
            None => self.loads.height(&self.kernel, x) + self.step(x),
        }
    }

    /// Returns r and `∫ r dx` at x.
    pub fn both(&self, x: T) -> [T; 2] {
        match self.row(x) {
            Some((row, z)) => [value_at(&row.slope, z), value_at(&row.height, z)],
            None => {
                let [slope, height] = self.loads.both(&self.kernel, x);
                [slope, height + self.step(x)]
            }
        }
    }

    /// Returns what the height outside the panels lacks, so that it has no step at their end.
    fn step(&self, x: T) -> T {
        let side = if x < self.on.left { Side::Left } else { Side::Right };
        *self.steps[side].get_or_init(|| {
            let end = self.on[side];
            let known = self.row(end).map(|(row, z)| value_at(&row.height, z));
            known.map_or(T::zero(), |known| known - self.loads.height(&self.kernel, end))
        })
    }

    /// Returns the panel that contains x, and the place in it.
    fn row(&self, x: T) -> Option<(&Row<T>, T)> {
        let Interval { left, right } = self.on;
        if !(x >= left && x <= right) {
            return None;
        }
        let count = self.rows.len();
        let width = (right - left) / T::count(count);
        let mut i = 0;
        while i + 1 < count && x > left + width * T::count(i + 1) {
            i += 1;
        }
        let on =
            Interval { left: left + width * T::count(i), right: left + width * T::count(i + 1) };
        let row = self.rows[i].get_or_init(|| self.made(on));
        Some((row, (x - on.centre()) / on.half_width()))
    }

    fn made(&self, on: Interval<T>) -> Row<T> {
        let terms = if self.rows.len() == 1 { self.kernel.terms(on)[1] } else { MAX_SIZE };
        let values: Vec<T> =
            places(on, terms).map(|[x, _]| self.loads.slope(&self.kernel, x)).collect();
        let mut slope = series(&values);
        let largest = slope.iter().fold(T::zero(), |most, a| most.max(a.abs()));
        let counts = |a: &T| a.abs() > T::of(0.125) * T::epsilon() * largest;
        slope.truncate(slope.iter().rposition(counts).map_or(1, |last| last + 1));
        // 2 ∫ T_k ds = T_{k+1}/(k+1) - T_{k-1}/(k-1), but T₁ of T₀, and T₂/4 of T₁.
        let of = |k: usize| slope.get(k).map_or(T::zero(), |&a| if k == 0 { a + a } else { a });
        let term = |k: usize| on.half_width() * (of(k - 1) - of(k + 1)) / T::count(2 * k);
        let terms = (1..=slope.len()).map(term);
        let mut height: Vec<T> = std::iter::once(T::zero()).chain(terms).collect();
        let middle = self.loads.height(&self.kernel, on.centre());
        height[0] = middle - value_at(&height, T::zero());
        Row { slope, height }
    }
}
