//! A stretch of a smooth curve as two series in its parameter, made from few of its points.
//!
//! A call of a curve gives a point and its rates. The rates X'(k), Y'(k) at Chebyshev's nodes make
//! two series; their integrals are compared with X and Y there, which are independent data. The
//! mismatch and the last coefficients measure the error of the series: a wave too fine for them
//! shows in the mismatch.

use crate::gap::CurveSample;
use crate::numerics::chebyshev::{Table, evaluate, primitive, values};
use crate::profile::{Noise, Piece};
use crate::{CurvePoint, Interval, Real};
use std::array::from_fn;

/// Number of Chebyshev nodes of a stretch at first.
pub(super) const SAMPLES: usize = 8;

/// Number of nodes of a closer series, among them those of the first: node j is node 3 j + 1.
pub(super) const CLOSER: usize = 3 * SAMPLES;

/// Number of points of a stretch at first: one more than the nodes, which the series must meet. A
/// Chebyshev polynomial that vanishes at all nodes does not vanish there.
pub(super) const TESTED: usize = SAMPLES + 1;

/// Number of further points of a closer series.
pub(super) const FURTHER: usize = CLOSER - SAMPLES;

/// Place of the additional point, as t.
const PROBE: f64 = 0.086;

/// Largest share that the last two coefficients have of the second two where a closer series is
/// better than two halves: sixteen more coefficients leave the fourth power of it, halves 2⁻⁸.
const MOST_LEFT: f64 = 0.25;

/// Largest ratio of a fall of the coefficients to the fall before, of smooth curves; next to a kink
/// they fall more and more slowly, like a power, and the ratio is 1.5 or more.
const STEADY: f64 = 1.25;

/// Largest number of steps to the root of `X(t) = x`, each by Newton's rule or a bisection.
const MAX_ROOT_STEPS: usize = 60;

/// Rounding error of a sum of a series, in units in the last place.
const SERIES_ROUNDING: f64 = 32.0;

/// Largest uncertainty that is ascribed to noise, in units in the last place of the ends of a
/// piece.
const LARGEST_NOISE: f64 = (1 << 20) as f64;

/// Largest uncertainty of a series by noise, as a multiple of the noise of the heights; likewise
/// the largest fall of X.
pub(super) const MAX_NOISE: f64 = 8.0;

/// Point of a body as a graph over x.
#[derive(Clone, Copy, Debug)]
pub(super) struct BodyPoint<T> {
    pub x: T,
    pub y: T,
    /// Slope dY/dX; may be infinite, or NaN where `Y'/X'` is 0/0.
    pub slope: T,
    /// Uncertainty of the slopes around the point, beyond rounding.
    pub doubt: T,
}

/// Series of X and Y over a variable t from -1, the left end of a stretch, to 1.
#[derive(Clone, Debug)]
pub(crate) struct Series<T> {
    /// Range of the parameter of the curve, and X at its ends.
    pub(super) k: [T; 2],
    between: [T; 2],
    /// Number of nodes.
    n: usize,
    x: [T; CLOSER + 1],
    y: [T; CLOSER + 1],
    /// Points that it is made from, by rising x, and the rates dt/dX there.
    points: [BodyPoint<T>; CLOSER],
    rates: [T; CLOSER],
    /// Additional point.
    probe: CurvePoint<T>,
    /// True if a closer series is expected to be better than two halves.
    pub(super) may_be_closer: bool,
    /// Uncertainty of the heights, a length; infinite where a point is not finite.
    pub doubt: T,
    /// True if the uncertainty of the heights is rounding.
    pub is_exact: bool,
}

impl<T: Real> Series<T> {
    /// Returns the parameters of the points from which a series on a range of k is made.
    pub fn parameters(k: [T; 2]) -> [T; TESTED] {
        let nodes = &Table::of(SAMPLES).z;
        from_fn(|j| at_place(k, if j < SAMPLES { nodes[j] } else { PROBE }))
    }

    /// Returns the parameters of the further points of a closer series.
    pub fn further(k: [T; 2]) -> [T; FURTHER] {
        let nodes = &Table::of(CLOSER).z;
        from_fn(|j| at_place(k, nodes[3 * (j / 2) + 2 * (j % 2)]))
    }

    /// Makes the series on a range of k.
    pub fn new(k: [T; 2], points: &[CurvePoint<T>; TESTED]) -> Self {
        let nodes: [CurvePoint<T>; SAMPLES] = from_fn(|j| points[j]);
        Self::with(k, &nodes, points[SAMPLES])
    }

    /// Makes a closer series with further points.
    pub fn closer(&self, further: &[CurvePoint<T>; FURTHER]) -> Self {
        let reach = T::of(0.5) * self.k[1] - T::of(0.5) * self.k[0];
        let known = |j: usize| {
            let BodyPoint { x, y, slope, .. } = self.points[j];
            let dx = (self.rates[j] * reach).recip();
            CurvePoint { x, y, dx, dy: slope * dx }
        };
        let nodes: [CurvePoint<T>; CLOSER] = from_fn(|j| match j % 3 {
            1 => known(j / 3),
            beside => further[2 * (j / 3) + beside / 2],
        });
        Self::with(self.k, &nodes, self.probe)
    }

    fn with<const N: usize>(
        [left, right]: [T; 2],
        nodes: &[CurvePoint<T>; N],
        probe: CurvePoint<T>,
    ) -> Self {
        let (zero, reach) = (T::zero(), T::of(0.5) * right - T::of(0.5) * left);
        let x = Primitive::new(nodes.map(|at| [at.x, at.dx * reach]), [probe.x, probe.dx * reach]);
        let y = Primitive::new(nodes.map(|at| [at.y, at.dy * reach]), [probe.y, probe.dy * reach]);
        let steep = ((nodes[N - 1].y - nodes[0].y) / (nodes[N - 1].x - nodes[0].x)).abs();
        // A point of the series lies next to the curve; its distance along y counts.
        let missed = nodes.iter().chain([&probe]).enumerate().fold(zero, |most, (j, at)| {
            let slope = at.dy / at.dx;
            let slope = if slope.is_finite() { slope } else { steep };
            most.max((y.missed[j] - slope * x.missed[j]).abs())
        });
        let along = |of_x: T| if of_x.is_zero() { zero } else { steep * of_x };
        let error = y.error + along(x.error);
        // The next coefficients of the heights are half those of the rates, divided by their
        // number.
        let rounding = y.rounding + along(x.rounding);
        let doubt = missed + error / T::count(N);
        let mut points = [BodyPoint { x: zero, y: zero, slope: zero, doubt: zero }; CLOSER];
        let mut rates = [zero; CLOSER];
        for ((point, of), at) in points.iter_mut().zip(&mut rates).zip(nodes) {
            let slope = at.dy / at.dx;
            let along = if slope.is_finite() { slope.abs() } else { zero };
            let error = T::count(N) * missed + y.error + along * x.error;
            let beyond = error - (y.rounding + along * x.rounding);
            *of = (at.dx * reach).recip();
            let doubt = if beyond > zero { beyond * of.abs() } else { zero };
            *point = BodyPoint { x: at.x, y: at.y, slope, doubt };
        }
        // Where X stands still between points the curve is unknown.
        let length = nodes[N - 1].x - nodes[0].x;
        let astray = x.missed.iter().fold(zero, |most, missed| most.max(missed.abs()));
        let known = doubt.is_finite() && astray <= T::of(0.1) * length;
        let is_exact = known && doubt <= rounding;
        let [before, middle, last]: [T; 3] = from_fn(|i| y.pairs[i] + along(x.pairs[i]));
        let falls =
            last <= T::of(MOST_LEFT) * before && last * before <= T::of(STEADY) * middle * middle;
        let may_be_closer = N == SAMPLES && known && falls;
        let doubt = if known { doubt } else { T::one() / zero };
        let (k, between) = ([left, right], x.ends());
        Self {
            k,
            between,
            n: N,
            x: x.series,
            y: y.series,
            points,
            rates,
            probe,
            may_be_closer,
            doubt,
            is_exact,
        }
    }

    pub(super) fn is_closer(&self) -> bool {
        self.n == CLOSER
    }

    /// Tells whether X runs about evenly in an interval and half a width beside it: nowhere four
    /// times as fast as elsewhere.
    pub(super) fn is_even(&self, on: Interval<T>) -> bool {
        let beside = on.half_width();
        let is_near = |row: &BodyPoint<T>| row.x > on.left - beside && row.x < on.right + beside;
        let rates = self.points().iter().zip(&self.rates).filter(|(row, _)| is_near(row));
        let [least, most] = rates.fold([T::one() / T::zero(), T::zero()], |[least, most], at| {
            [least.min(*at.1), most.max(*at.1)]
        });
        least >= T::of(0.25) * most
    }

    /// Returns the largest rate of Y by k that may be mere rounding: a first estimate needs two
    /// digits.
    pub fn unknown_rate(&self) -> T {
        let rate = |(row, by_x): (&BodyPoint<T>, &T)| (row.slope / *by_x).abs();
        let largest = self.points().iter().zip(&self.rates).map(rate).fold(T::zero(), T::max);
        T::of(200.0 * SERIES_ROUNDING) * T::epsilon() * largest / (self.k[1] - self.k[0]).abs()
    }

    /// Returns the points that it is made from, by rising x, and their places as t.
    pub(super) fn points(&self) -> &[BodyPoint<T>] {
        &self.points[..self.n]
    }

    pub(super) fn places(&self) -> &'static [f64] {
        &Table::of(self.n).z[..self.n]
    }

    /// Returns the parameter of the curve at t.
    pub fn k(&self, t: T) -> T {
        let half = T::of(0.5);
        half * (T::one() - t) * self.k[0] + half * (T::one() + t) * self.k[1]
    }

    /// Returns t at a parameter of the curve.
    pub fn t(&self, k: T) -> T {
        let [from, to] = self.k;
        ((k - from) - (to - k)) / (to - from)
    }

    /// Tells whether the uncertainty is noise of the curve, which is measured only for small
    /// uncertainties.
    pub fn is_noise(&self, piece: &Piece<'_, T>, evaluations: &mut usize) -> bool {
        let sizes = piece.ends.iter().flat_map(|end| [end.x.abs(), end.y.abs()]);
        let size = sizes.filter(|size| size.is_finite()).fold(T::zero(), T::max);
        if self.doubt > T::of(LARGEST_NOISE) * T::epsilon() * size {
            return false;
        }
        let middle = T::of(0.5) * self.k[0] + T::of(0.5) * self.k[1];
        let noise = Noise::near(piece, middle, evaluations);
        self.doubt <= T::of(MAX_NOISE) * noise.of_height(self.points[self.n / 2].slope)
    }

    /// Returns the distance of its points in the parameter as a share of that of another series.
    pub fn share_of(&self, other: &Self) -> T {
        let length = |series: &Self| (series.k[1] - series.k[0]).abs() / T::count(series.n);
        length(self) / length(other)
    }

    /// Returns the point of the series at x; `None` outside its range.
    pub fn sample_near(&self, x: T) -> Option<CurveSample<T>> {
        let [from, to] = self.between;
        if !(self.doubt.is_finite() && x > from && x < to) {
            return None;
        }
        let t = self.parameter(x);
        let [x, dx] = self.evaluated(&self.x, t);
        let [y, dy] = self.evaluated(&self.y, t);
        let by_k = T::of(2.0) / (self.k[1] - self.k[0]);
        let (k, slope) = (self.k(t), dy / dx);
        slope.is_finite().then_some(CurveSample { k, x, y, dx: by_k * dx, slope })
    }

    /// Returns one of both series and its rate at t.
    #[inline(always)]
    fn evaluated(&self, series: &[T; CLOSER + 1], t: T) -> [T; 2] {
        // Of a length known to the compiler.
        let ([value], [rate]) = match self.n {
            SAMPLES => evaluate(&series[..=SAMPLES], &[t]),
            _ => evaluate(series, &[t]),
        };
        [value, rate]
    }

    /// Returns x, height and slope at t.
    #[inline(always)]
    pub fn at_t(&self, t: T) -> [T; 3] {
        let [x, dx] = self.evaluated(&self.x, t);
        let [y, dy] = self.evaluated(&self.y, t);
        [x, y, dy / dx]
    }

    /// Returns the distance of the series from a point of the curve at t, along y and beyond
    /// rounding.
    pub fn miss(&self, t: T, point: &CurvePoint<T>) -> T {
        let [x, y, _] = self.at_t(t);
        let slope = point.dy / point.dx;
        let missed = (point.y - y - slope * (point.x - x)).abs();
        let size = point.y.abs() + (slope * point.x).abs();
        (missed - T::of(SERIES_ROUNDING) * T::epsilon() * size).max(T::zero())
    }

    /// Returns height and slope at x.
    pub fn at(&self, x: T) -> [T; 2] {
        let [_, y, slope] = self.at_t(self.parameter(x));
        [y, slope]
    }

    /// Solves `X(t) = x`.
    pub fn parameter(&self, x: T) -> T {
        let [from, to] = self.between;
        let (one, half) = (T::one(), T::of(0.5));
        let [mut low, mut high] = [-one, one];
        if x <= from || x >= to {
            return if x <= from { low } else { high };
        }
        let mut t = self.guess(x);
        // Newton's rule squares the error.
        let small = T::of(0.125) * T::epsilon().sqrt();
        let mut more = T::DERIVATIVE_ORDER;
        for _ in 0..MAX_ROOT_STEPS {
            let [at, rate] = self.evaluated(&self.x, t);
            *(if at > x { &mut high } else { &mut low }) = t;
            let newton = t + (x - at) / rate;
            let is_inside = newton >= low && newton <= high;
            let next = if is_inside { newton } else { half * (low + high) };
            let step = (next - t).abs();
            t = next;
            if step <= small {
                if more == 0 {
                    break;
                }
                more -= 1;
            }
        }
        t
    }

    /// Returns an approximate solution of X(t) = x: by the cubic t(x) through the points around x
    /// with the rates there, or by the straight line if a rate is not known or the cubic turns.
    fn guess(&self, x: T) -> T {
        let (one, three, [from, to]) = (T::one(), T::of(3.0), self.between);
        let after = self.points().partition_point(|row| row.x <= x);
        let place = |i: usize| (T::of(self.places()[i]), self.points[i].x, self.rates[i]);
        let (start, x0, first) = after.checked_sub(1).map_or((-one, from, T::zero()), place);
        let (end, x1, last) = if after < self.n { place(after) } else { (one, to, T::zero()) };
        let (width, rise) = (x1 - x0, end - start);
        let share = (x - x0) / width;
        let [first, last] = [first, last].map(|rate| rate * width);
        let is_even = |slope: T| slope > T::zero() && slope <= three * rise;
        let line = start + rise * share;
        let t = if is_even(first) && is_even(last) {
            // The bulge over the line has the right slopes at both ends.
            let rest = one - share;
            line + share * rest * ((first - rise) * rest + (rise - last) * share)
        } else {
            line
        };
        if t > -one && t < one { t } else { T::zero() }
    }
}

/// Returns the parameter at a place t of a range.
fn at_place<T: Real>([left, right]: [T; 2], t: f64) -> T {
    let half = T::of(0.5);
    let (middle, reach) = (half * left + half * right, half * right - half * left);
    middle + reach * T::of(t)
}

/// Series of one coordinate, from its rates.
struct Primitive<T> {
    series: [T; CLOSER + 1],
    /// Values less the series, of the additional point last.
    missed: [T; CLOSER + 1],
    /// Size of the last two coefficients of the rates, and of the mismatch at the additional point.
    error: T,
    rounding: T,
    /// Sizes of the last three pairs of coefficients but for a first one.
    pairs: [T; 3],
}

impl<T: Real> Primitive<T> {
    /// Returns the values of the series at both ends.
    fn ends(&self) -> [T; 2] {
        let even = self.series.iter().step_by(2).fold(T::zero(), |sum, &term| sum + term);
        let odd = self.series[1..].iter().step_by(2).fold(T::zero(), |sum, &term| sum + term);
        [even - odd, even + odd]
    }

    /// Makes the series from values and rates at nodes, and at the additional point.
    fn new<const N: usize>(at: [[T; 2]; N], [probe, rate]: [T; 2]) -> Self {
        let (zero, table) = (T::zero(), Table::of(N));
        let c = table.coefficients(&at.map(|[_, rate]| rate));
        let primitive = primitive(&c);
        let mut series: [T; CLOSER + 1] = from_fn(|k| if k <= N { primitive[k] } else { zero });
        let integral: [T; N] = values(&series[..=N], &from_fn(|j| T::of(table.z[j])));
        let place = [T::of(PROBE)];
        let mut missed = [zero; CLOSER + 1];
        for j in 0..N {
            missed[j] = at[j][0] - integral[j];
        }
        missed[N] = probe - values(&series[..=N], &place)[0];
        let missed_at = &mut missed[..=N];
        let mean = missed_at.iter().fold(zero, |sum, &rest| sum + rest) / T::count(N + 1);
        missed_at.iter_mut().for_each(|rest| *rest -= mean);
        series[0] = mean;
        let [by_series] = values(&c, &place);
        let size = at.iter().fold(probe.abs(), |sum, [value, _]| sum + value.abs());
        let size = c.iter().fold(size, |sum, a| sum + a.abs());
        let pair = |i: usize| c[i].abs() + c[i + 1].abs();
        Self {
            series,
            missed,
            error: pair(N - 2) + (rate - by_series).abs(),
            // Of as many terms as at first.
            rounding: T::of(SERIES_ROUNDING * SAMPLES as f64 / N as f64) * T::epsilon() * size,
            pairs: [pair(2), pair(4), pair(6)],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Makes the series of a curve on a range of k.
    fn series(k: [f64; 2], curve: impl Fn(f64) -> [f64; 4]) -> [Series<f64>; 2] {
        let point = |k: f64| {
            let [x, y, dx, dy] = curve(k);
            CurvePoint { x, y, dx, dy }
        };
        let first = Series::new(k, &Series::parameters(k).map(point));
        let closer = first.closer(&Series::further(k).map(point));
        [first, closer]
    }

    #[test]
    fn a_closer_series_has_all_digits_of_a_smooth_curve() {
        // A curve may run from right to left, too.
        for sign in [1.0, -1.0] {
            let circle = |k: f64| {
                let (sin, cos) = (sign * k).sin_cos();
                [sin, 1.0 - cos, sign * cos, sign * sin]
            };
            let [first, closer] = series([-1.5, 1.5].map(|k| sign * k), circle);
            assert!(first.may_be_closer && !first.is_exact && first.doubt > 1e-9);
            assert!(closer.is_exact && !closer.may_be_closer);
            for x in [-0.99, -0.3, 1e-3, 0.7] {
                let ([y, slope], root) = (closer.at(x), (1.0 - x * x).sqrt());
                assert!((y - (1.0 - root)).abs() < 1e-15 / root, "{x}: {y}");
                assert!((slope - x / root).abs() < 1e-14 / root.powi(3), "{x}: {slope}");
            }
        }
    }

    /// Halves are better where coefficients fall slowly, or ever more slowly, and where nothing is
    /// known.
    #[test]
    fn more_points_are_for_smooth_curves_only() {
        type OfK = fn(f64) -> [f64; 4];
        let not: [(&str, OfK); 4] = [
            ("a kink", |k| [k, k * k.abs(), 1.0, 2.0 * k.abs()]),
            ("a jump of the curvature", |k| {
                [k, 0.5 * k * k + k * k.max(0.0), 1.0, k + 2.0 * k.max(0.0)]
            }),
            ("a wave", |k| [k, (9.0 * k).sin(), 1.0, 9.0 * (9.0 * k).cos()]),
            ("a point that is no number", |k| [k, if k > 0.0 { f64::NAN } else { k }, 1.0, 1.0]),
        ];
        for (what, curve) in not {
            assert!(!series([-1.0, 1.0], curve)[0].may_be_closer, "{what}");
        }
    }
}
