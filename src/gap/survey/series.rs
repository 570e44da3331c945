//! A stretch of a smooth curve as two series in its parameter, made from few of its points.
//!
//! A call of a curve gives a point and its rates. The rates X'(k), Y'(k) at Chebyshev's nodes make
//! two series; their integrals are compared with X and Y there, which are independent data. The
//! mismatch and the last coefficients measure the error of the series: a wave too fine for them
//! shows in the mismatch.

use crate::gap::CurveSample;
use crate::numerics::chebyshev::{Table, evaluate, primitive, values};
use crate::profile::{Noise, Piece};
use crate::{CurvePoint, Real};
use std::array::from_fn;

/// Number of Chebyshev nodes of a stretch.
pub(super) const SAMPLES: usize = 8;

/// Number of points of a stretch: one more than the nodes, which the series must meet. A Chebyshev
/// polynomial that vanishes at all nodes does not vanish there.
pub(super) const TESTED: usize = SAMPLES + 1;

/// Place of the additional point, as t.
const PROBE: f64 = 0.086;

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
    k: [T; 2],
    between: [T; 2],
    x: [T; SAMPLES + 1],
    y: [T; SAMPLES + 1],
    /// Points that it is made from, by rising x.
    pub(super) points: [BodyPoint<T>; SAMPLES],
    /// Uncertainty of the heights, a length; infinite where a point is not finite.
    pub doubt: T,
    /// True if the uncertainty of the heights is rounding.
    pub is_exact: bool,
}

impl<T: Real> Series<T> {
    /// Returns the parameters of the points from which a series on a range of k is made.
    pub fn parameters([left, right]: [T; 2]) -> [T; TESTED] {
        let (half, table) = (T::of(0.5), Table::of(SAMPLES));
        let (middle, reach) = (half * left + half * right, half * right - half * left);
        from_fn(|j| middle + reach * T::of(if j < SAMPLES { table.z[j] } else { PROBE }))
    }

    /// Makes the series on a range of k.
    pub fn new([left, right]: [T; 2], points: &[CurvePoint<T>; TESTED]) -> Self {
        let (zero, reach) = (T::zero(), T::of(0.5) * right - T::of(0.5) * left);
        let x = Primitive::new(points.map(|at| at.x), points.map(|at| at.dx * reach));
        let y = Primitive::new(points.map(|at| at.y), points.map(|at| at.dy * reach));
        let steep =
            ((points[SAMPLES - 1].y - points[0].y) / (points[SAMPLES - 1].x - points[0].x)).abs();
        let slopes: [T; SAMPLES] = from_fn(|j| points[j].dy / points[j].dx);
        // A point of the series lies next to the curve; its distance along y counts.
        let missed = (0..TESTED).fold(zero, |most, j| {
            let slope = points[j].dy / points[j].dx;
            let slope = if slope.is_finite() { slope } else { steep };
            most.max((y.missed[j] - slope * x.missed[j]).abs())
        });
        let error = y.error + if x.error.is_zero() { zero } else { steep * x.error };
        // The next coefficients of the heights are half those of the rates, divided by their
        // number.
        let rounding = y.rounding + if x.rounding.is_zero() { zero } else { steep * x.rounding };
        let doubt = missed + error / T::count(SAMPLES);
        let points = from_fn(|j| {
            let along = if slopes[j].is_finite() { slopes[j].abs() } else { zero };
            let error = T::count(SAMPLES) * missed + y.error + along * x.error;
            let beyond = error - (y.rounding + along * x.rounding);
            let rate = (points[j].dx * reach).abs();
            let doubt = if beyond > zero { beyond / rate } else { zero };
            BodyPoint { x: points[j].x, y: points[j].y, slope: slopes[j], doubt }
        });
        // Where X stands still between points the curve is unknown.
        let length = points[SAMPLES - 1].x - points[0].x;
        let astray = x.missed.iter().fold(zero, |most, missed| most.max(missed.abs()));
        let known = doubt.is_finite() && astray <= T::of(0.1) * length;
        let is_exact = known && doubt <= rounding;
        let doubt = if known { doubt } else { T::one() / zero };
        let (k, between) = ([left, right], x.ends());
        Self { k, between, x: x.series, y: y.series, points, doubt, is_exact }
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
        self.doubt <= T::of(MAX_NOISE) * noise.of_height(self.points[SAMPLES / 2].slope)
    }

    /// Returns the length of its range of the parameter as a share of the range of another series.
    pub fn share_of(&self, other: &Self) -> T {
        ((self.k[1] - self.k[0]) / (other.k[1] - other.k[0])).abs()
    }

    /// Returns the point of the series at x; `None` outside its range.
    pub fn sample_near(&self, x: T) -> Option<CurveSample<T>> {
        let [from, to] = self.between;
        if !(self.doubt.is_finite() && x > from && x < to) {
            return None;
        }
        let t = self.parameter(x);
        let ([x], [dx]) = evaluate(&self.x, &[t]);
        let ([y], [dy]) = evaluate(&self.y, &[t]);
        let by_k = T::of(2.0) / (self.k[1] - self.k[0]);
        let (k, slope) = (self.k(t), dy / dx);
        slope.is_finite().then_some(CurveSample { k, x, y, dx: by_k * dx, slope })
    }

    /// Returns x, height and slope at t.
    pub fn at_t(&self, t: T) -> [T; 3] {
        let ([x], [dx]) = evaluate(&self.x, &[t]);
        let ([y], [dy]) = evaluate(&self.y, &[t]);
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
            let ([at], [rate]) = evaluate(&self.x, &[t]);
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

    /// Returns an approximate solution of X(t) = x, by the points around x.
    fn guess(&self, x: T) -> T {
        let (one, [from, to]) = (T::one(), self.between);
        let after = self.points.partition_point(|row| row.x <= x);
        let place = |i: usize| (T::of(Table::of(SAMPLES).z[i]), self.points[i].x);
        let (start, x0) = after.checked_sub(1).map_or((-one, from), place);
        let (end, x1) = if after < SAMPLES { place(after) } else { (one, to) };
        let t = start + (end - start) * ((x - x0) / (x1 - x0));
        if t > -one && t < one { t } else { T::zero() }
    }
}

/// Series of one coordinate, from its rates.
struct Primitive<T> {
    series: [T; SAMPLES + 1],
    /// Values less the series.
    missed: [T; TESTED],
    /// Size of the last two coefficients of the rates, and of the mismatch at the additional point.
    error: T,
    rounding: T,
}

impl<T: Real> Primitive<T> {
    /// Returns the values of the series at both ends.
    fn ends(&self) -> [T; 2] {
        let even = self.series.iter().step_by(2).fold(T::zero(), |sum, &term| sum + term);
        let odd = self.series[1..].iter().step_by(2).fold(T::zero(), |sum, &term| sum + term);
        [even - odd, even + odd]
    }

    fn new(at: [T; TESTED], rates: [T; TESTED]) -> Self {
        let (zero, table) = (T::zero(), Table::of(SAMPLES));
        let c = table.coefficients(&from_fn::<T, SAMPLES, _>(|j| rates[j]));
        let primitive = primitive(&c);
        let mut series: [T; SAMPLES + 1] = from_fn(|k| primitive[k]);
        let places = from_fn(|j| T::of(if j < SAMPLES { table.z[j] } else { PROBE }));
        let integral: [T; TESTED] = values(&series, &places);
        let rest: [T; TESTED] = from_fn(|j| at[j] - integral[j]);
        let mean = rest.iter().fold(zero, |sum, &rest| sum + rest) / T::count(TESTED);
        series[0] = mean;
        let [rate] = values(&c, &[places[SAMPLES]]);
        let size = at.iter().chain(&c).fold(zero, |sum, value| sum + value.abs());
        Self {
            series,
            missed: rest.map(|rest| rest - mean),
            error: c[SAMPLES - 1].abs() + c[SAMPLES - 2].abs() + (rates[SAMPLES] - rate).abs(),
            rounding: T::of(SERIES_ROUNDING) * T::epsilon() * size,
        }
    }
}
