//! The bend of a body: what the regular kernel adds to the gap.
//!
//! r and its integral are Chebyshev series on panels: even ones over the contacts, and outside them
//! panels that double with the distance. On each of them the kernel is as smooth as on the others.
//! A panel is made when it is asked for.

use super::wavenumbers::{Harmonics, LEVELS, Levels, Spread, Transform};
use super::{Formula, Kernel};
use super::correction::expanded;
use crate::numerics::chebyshev::{MAX_SIZE, value_at};
use crate::{Interval, Real, Side};
use std::sync::{Arc, OnceLock};

/// Width of the panels over the contacts, in units of the distance of the nearest singularity:
/// there a series of [`MAX_SIZE`] terms leaves an error of 1e-16.
const WIDTH: f64 = 1.4;

/// Bend by the pressures in some intervals.
pub(crate) struct Bend<'b, T: Real> {
    kernel: Kernel<'b, T>,
    spreads: Vec<Spread<T>>,
    hull: Interval<T>,
    /// Distance of the nearest singularity of the kernel.
    distance: T,
    inner: Vec<OnceLock<Row<T>>>,
    outer: [Vec<OnceLock<Row<T>>>; 2],
    transforms: Vec<OnceLock<Transform<T>>>,
}

/// r and its integral on a panel.
struct Row<T> {
    centre: T,
    half_width: T,
    slope: Vec<T>,
    height: Vec<T>,
}

impl<'b, T: Real> Bend<'b, T> {
    /// Creates the bend by these pressures, from left to right.
    pub fn new(kernel: &Kernel<'b, T>, spreads: Vec<Spread<T>>) -> Self {
        let hull = spreads.iter().map(|spread| spread.on).reduce(|one, other| Interval {
            left: one.left.min(other.left),
            right: one.right.max(other.right),
        });
        let hull = hull.unwrap_or(Interval { left: T::zero(), right: T::zero() });
        let distance = kernel.distance();
        let cells = ((hull.right - hull.left) / (T::of(WIDTH) * distance)).component(0);
        let is_one = spreads.len() == 1 && kernel.formula.is_none();
        let mut count = 1;
        while T::count(count) < cells && !is_one {
            count += 1;
        }
        let rows = |count| (0..count).map(|_| OnceLock::new()).collect();
        let transforms = (0..LEVELS).map(|_| OnceLock::new()).collect();
        let outer = [rows(LEVELS), rows(LEVELS)];
        Self { kernel: kernel.clone(), spreads, hull, distance, inner: rows(count), outer, transforms }
    }

    /// Returns the pressures that make this bend.
    pub fn spreads(&self) -> &[Spread<T>] {
        &self.spreads
    }

    /// Returns P̂ by the first rule of a kernel, if it is at hand.
    pub fn whole(&self, kernel: &Kernel<'b, T>) -> Option<&Transform<T>> {
        let is_same = match (&self.kernel.levels, &kernel.levels) {
            (Some(own), Some(other)) => Arc::ptr_eq(own, other),
            _ => false,
        };
        self.transforms[0].get().filter(|_| is_same)
    }

    /// Returns `∫ r dx`, up to a constant, and r at x.
    pub fn at(&self, x: T) -> [T; 2] {
        let row = self.row(x);
        let z = (x - row.centre) / row.half_width;
        [value_at(&row.height, z), value_at(&row.slope, z)]
    }

    /// Returns r at x.
    pub fn slope(&self, x: T) -> T {
        let row = self.row(x);
        value_at(&row.slope, (x - row.centre) / row.half_width)
    }

    /// Returns the same as [`at`](Self::at) without a panel: for a single point, far away.
    pub fn at_once(&self, x: T) -> [T; 2] {
        let (_, _, level) = self.beyond(x);
        let mut sum = [T::zero(); 2];
        if let Some(levels) = &self.kernel.levels {
            let (rule, of) = (levels.rule(level), self.transform(levels, level));
            sum = [rule.height(of, x), rule.slope(of, x)];
        }
        if let Some(formula) = &self.kernel.formula {
            let [height, slope] = formula.over(&self.spreads, x);
            sum = [sum[0] + height, sum[1] + slope];
        }
        sum
    }

    /// Returns the side on which x lies outside the contacts, the number of the panel there, and
    /// the level of its rule.
    fn beyond(&self, x: T) -> (Option<Side>, usize, usize) {
        let Interval { left, right } = self.hull;
        let (side, away) = if x < left {
            (Some(Side::Left), left - x)
        } else {
            (Some(Side::Right).filter(|_| x > right), (x - right).max(T::zero()))
        };
        let mut panel = 0;
        while panel + 1 < LEVELS && away > self.outer_end(panel) {
            panel += 1;
        }
        (side, panel, panel.saturating_sub(1))
    }

    /// Returns the distance from the contacts at which an outer panel ends.
    fn outer_end(&self, panel: usize) -> T {
        let doublings = i32::try_from(panel + 1).unwrap_or(i32::MAX);
        self.distance * (T::of(2.0).powi(doublings) - T::one())
    }

    fn row(&self, x: T) -> &Row<T> {
        let Interval { left, right } = self.hull;
        let (side, panel, level) = self.beyond(x);
        let Some(side) = side else {
            let count = self.inner.len();
            let width = (right - left) / T::count(count);
            let mut i = 0;
            while i + 1 < count && x > left + width * T::count(i + 1) {
                i += 1;
            }
            let on = Interval {
                left: left + width * T::count(i),
                right: left + width * T::count(i + 1),
            };
            // Over one contact a series converges with the root of its width.
            let terms = if count == 1 { self.kernel.terms(on)[1] } else { MAX_SIZE };
            return self.inner[i].get_or_init(|| self.made(on, terms, 0));
        };
        let from = panel.checked_sub(1).map_or(T::zero(), |before| self.outer_end(before));
        let to = self.outer_end(panel);
        let on = match side {
            Side::Left => Interval { left: left - to, right: left - from },
            Side::Right => Interval { left: right + from, right: right + to },
        };
        self.outer[side as usize][panel].get_or_init(|| self.made(on, MAX_SIZE, level))
    }

    fn transform(&self, levels: &Levels<T>, level: usize) -> &Transform<T> {
        self.transforms[level].get_or_init(|| levels.rule(level).transform(&self.spreads))
    }

    fn made(&self, on: Interval<T>, terms: usize, level: usize) -> Row<T> {
        let (centre, half_width) = (on.centre(), on.half_width());
        let mut slope = vec![T::zero(); terms];
        let mut middle = T::zero();
        if let Some(levels) = &self.kernel.levels {
            let (rule, of) = (levels.rule(level), self.transform(levels, level));
            let series = Harmonics::new(rule, on, terms).weighted(rule).series(&of.parts);
            slope.iter_mut().zip(series).for_each(|(sum, a)| *sum += a);
            middle += rule.height(of, centre);
        }
        if let Some(formula) = &self.kernel.formula {
            let series = expanded(on, terms, |x| formula.over(&self.spreads, x)[1]);
            slope.iter_mut().zip(series).for_each(|(sum, a)| *sum += a);
            middle += formula.over(&self.spreads, centre)[0];
        }
        let largest = slope.iter().fold(T::zero(), |most, a| most.max(a.abs()));
        let counts = |a: &T| a.abs() > T::of(0.125) * T::epsilon() * largest;
        let terms = slope.iter().rposition(counts).map_or(1, |last| last + 1);
        slope.truncate(terms);
        // 2 ∫ T_k ds = T_{k+1}/(k+1) - T_{k-1}/(k-1), but T₁ of T₀, and T₂/4 of T₁.
        let of = |k: usize| slope.get(k).map_or(T::zero(), |&a| if k == 0 { a + a } else { a });
        let term = |k: usize| half_width * (of(k - 1) - of(k + 1)) / T::count(2 * k);
        let mut height: Vec<T> = std::iter::once(T::zero()).chain((1..=terms).map(term)).collect();
        height[0] = middle - value_at(&height, T::zero());
        Row { centre, half_width, slope, height }
    }
}

impl<T: Real> Formula<'_, T> {
    /// Returns the integrals of the height and of the slope of the kernel over some pressures.
    pub fn over(&self, spreads: &[Spread<T>], x: T) -> [T; 2] {
        let mut sum = [T::zero(); 2];
        for spread in spreads {
            for [s, weight] in spread.nodes() {
                sum[0] += weight * self.kernel().height(x, s);
                sum[1] += weight * self.kernel().slope(x, s);
            }
        }
        sum
    }
}
