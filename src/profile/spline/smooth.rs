//! Smoothing of measured points, with the noise estimated from the points themselves.
//!
//! The curve is a cubic spline on even knots, `Y(x) = Σ c_j B_j(x)`, that minimises
//!
//! ```text
//! D = Σ (Y(xᵢ) - yᵢ)² + α ∫ Y'''² dx
//! ```
//!
//! (Eilers and Marx, *Statist. Sci.* 11, 1996, 89). A parabola is free, so that round bodies are
//! smoothed over their whole length. In Bayesian terms the penalty is a prior of the curve, and the
//! noise and α are those under which the points are most probable (restricted maximum likelihood:
//! Wood, *J. R. Stat. Soc. B* 73, 2011, 3): α minimises
//!
//! ```text
//! (N - 3) ln D + ln |BᵀB + αS| - K ln α,     σ² = D/(N - 3)
//! ```
//!
//! for N points and K spans between knots. The knots are halved until the smoothing reaches over
//! several spans and neighbouring points do not share what it leaves; then they do not matter any
//! more.
//!
//! The least squares are solved by rotations, from left to right, in time and memory proportional
//! to the number of points: the normal equations have the square of the condition number.

use crate::Real;

/// Number of spans between the first knots.
const FIRST_SPANS: usize = 8;

/// Reach of the smoothing, in spans, from which on finer knots change nothing.
const RESOLVED: f64 = 1.5;

/// Least reach of the smoothing, in spans: the curve follows the points.
const LEAST_SMOOTHING: f64 = 0.05;

/// Correlation of neighbouring points, by that of independent noise, that makes waves of them.
const SHARED: f64 = 3.0;

/// Ratio of successive reaches tried, for the most likely and for the least of the likely ones.
const REACH_RATIO: f64 = 1.5;
const FINE_STEP: f64 = 1.05;

/// Rise of -2 ln L from its minimum within which a reach is likely: 95 % of the probability, by χ²
/// with one degree of freedom.
const LIKELY: f64 = 3.84;

/// Number of steps of the golden section; the likelihood is flat, and a thousandth is enough.
const SECTIONS: usize = 12;

/// Number of parameters of a curve without penalty, a parabola.
const FREE_PARAMETERS: usize = 3;

/// Third derivative in a span, by its four coefficients and in units of the span.
const THIRD: [f64; 4] = [-1.0, 3.0, -3.0, 1.0];

/// Row of the equations: four neighbouring coefficients, and the right side.
type Row<T> = [T; 5];

/// Equations in triangular form: each row starts one coefficient after the row before.
#[derive(Clone, Debug)]
struct Triangle<T> {
    rows: Vec<Row<T>>,
    /// Sum of the squares that are left of the right side.
    rest: T,
}

impl<T: Real> Triangle<T> {
    fn new(count: usize) -> Self {
        Self { rows: vec![[T::zero(); 5]; count], rest: T::zero() }
    }

    /// Adds a row that starts at a coefficient, by plane rotations. Rows come from left to right.
    fn insert(&mut self, start: usize, mut row: Row<T>) {
        for kept in self.rows.iter_mut().skip(start).take(4) {
            if !row[0].is_zero() {
                let length = kept[0].hypot(row[0]);
                let (cos, sin) = (kept[0] / length, row[0] / length);
                for (kept, new) in kept.iter_mut().zip(&mut row) {
                    (*kept, *new) = (cos * *kept + sin * *new, cos * *new - sin * *kept);
                }
            }
            row = [row[1], row[2], row[3], T::zero(), row[4]];
        }
        self.rest += row[4] * row[4];
    }

    /// Returns the coefficients.
    fn solve(&self) -> Vec<T> {
        let count = self.rows.len();
        let mut all = vec![T::zero(); count + FREE_PARAMETERS];
        for (i, row) in self.rows.iter().enumerate().rev() {
            let known = row[4] - row[1] * all[i + 1] - row[2] * all[i + 2] - row[3] * all[i + 3];
            all[i] = known / row[0];
        }
        all.truncate(count);
        all
    }

    /// Returns the variance of a sum of coefficients, each times a weight, for points with a
    /// variance of 1: `|u|²` with `Rᵀ u = weights`.
    fn variance(&self, mut weights: Vec<T>) -> T {
        let mut sum = T::zero();
        for (i, row) in self.rows.iter().enumerate() {
            let u = weights[i] / row[0];
            for (weight, &entry) in weights[i + 1..].iter_mut().zip(&row[1..4]) {
                *weight -= entry * u;
            }
            sum += u * u;
        }
        sum
    }
}

/// Equations for one set of knots, without the penalty.
struct Fitting<T> {
    points: usize,
    spans: usize,
    data: Triangle<T>,
}

impl<T: Real> Fitting<T> {
    /// Takes points by their place, from 0 to 1, and their height.
    fn new(points: &[[T; 2]], spans: usize) -> Self {
        let mut data = Triangle::new(spans + FREE_PARAMETERS);
        for &[share, y] in points {
            let (start, t) = split(share, spans);
            let [a, b, c, d] = values(t);
            data.insert(start, [a, b, c, d, y]);
        }
        Self { points: points.len(), spans, data }
    }

    /// Returns the weight α of the penalty that smooths over `reach` spans.
    fn alpha(&self, reach: T) -> T {
        reach.powi(6) * T::count(self.points) / T::count(self.spans)
    }

    fn penalised(&self, alpha: T) -> Triangle<T> {
        let [a, b, c, d] = THIRD.map(|third| alpha.sqrt() * T::of(third));
        let mut all =
            Triangle { rest: self.data.rest, ..Triangle::new(self.spans + FREE_PARAMETERS) };
        for (i, &row) in self.data.rows.iter().enumerate() {
            all.insert(i, row);
            if i < self.spans {
                all.insert(i, [a, b, c, d, T::zero()]);
            }
        }
        all
    }

    /// Returns -2 times the logarithm of the restricted likelihood, up to a constant.
    fn unlikelihood(&self, reach: T) -> T {
        let alpha = self.alpha(reach);
        let Triangle { rows, rest } = self.penalised(alpha);
        let roots = rows.iter().fold(T::zero(), |sum, row| sum + row[0].abs().ln());
        // Heights are 1 at most: less than this is rounding.
        let rest = rest.max(T::epsilon().powi(2));
        T::count(self.points - FREE_PARAMETERS) * rest.ln() + T::of(2.0) * roots
            - T::count(self.spans) * alpha.ln()
    }

    /// Tells whether neighbouring points share what this smoothing leaves of them, as waves shorter
    /// than the spans, which are no noise.
    fn leaves_waves(&self, points: &[[T; 2]], reach: T) -> bool {
        let coefficients = self.penalised(self.alpha(reach)).solve();
        let left = points.iter().map(|&[share, y]| {
            let (start, t) = split(share, self.spans);
            y - values(t)
                .iter()
                .zip(&coefficients[start..])
                .fold(T::zero(), |sum, (&b, &c)| sum + b * c)
        });
        let left: Vec<T> = left.collect();
        let shared = left.windows(2).fold(T::zero(), |sum, pair| sum + pair[0] * pair[1]);
        let all = left.iter().fold(T::zero(), |sum, &left| sum + left * left);
        // Of independent noise this is as far from zero in one of a thousand profiles.
        shared > T::of(SHARED) * all / T::count(points.len()).sqrt()
    }

    /// Finds the least of the likely reaches and the most likely, on a grid and then by golden
    /// section in its logarithm.
    fn reaches(&self) -> [T; 2] {
        let [step, fine] = [REACH_RATIO, FINE_STEP].map(T::of);
        let most = T::count(self.spans);
        let mut reach = T::of(LEAST_SMOOTHING);
        let (mut best, mut least) = (reach, self.unlikelihood(reach));
        while reach < most {
            reach = (reach * step).min(most);
            let found = self.unlikelihood(reach);
            if found < least {
                (best, least) = (reach, found);
            }
        }
        let share = T::of(0.5) * (T::of(5.0).sqrt() - T::one());
        let [mut from, mut to] = [best / step, (best * step).min(most)].map(|reach| reach.ln());
        let at = |place: T| self.unlikelihood(place.exp());
        let mut places = [to - share * (to - from), from + share * (to - from)];
        let mut found = places.map(at);
        for _ in 0..SECTIONS {
            if found[0] < found[1] {
                to = places[1];
                places = [to - share * (to - from), places[0]];
                found = [at(places[0]), found[0]];
            } else {
                from = places[0];
                places = [places[1], from + share * (to - from)];
                found = [found[1], at(places[1])];
            }
        }
        let best = (T::of(0.5) * (from + to)).exp();
        let allowed = found[0].min(found[1]) + T::of(LIKELY);
        let mut low = best;
        while low > T::of(LEAST_SMOOTHING) && self.unlikelihood(low / fine) <= allowed {
            low /= fine;
        }
        [low, best]
    }
}

/// Curve fitted to points, and the uncertainty that their noise leaves in it.
#[derive(Clone, Debug)]
pub(super) struct Smooth<T> {
    ends: [T; 2],
    spans: usize,
    /// Equations with the least penalty that is likely: a stronger one could hide how the body
    /// departs from a parabola.
    triangle: Triangle<T>,
    /// Standard deviation of the heights.
    pub noise: T,
}

impl<T: Real> Smooth<T> {
    /// Fits the curve to points; returns it with the height and the slope at each knot.
    pub fn new(points: &[[T; 2]]) -> (Self, Vec<[T; 2]>) {
        let [[from, start], [to, end]] = [points[0], points[points.len() - 1]];
        let length = to - from;
        // Heights are taken from the line between the ends, which is not penalised.
        let mut rest: Vec<[T; 2]> = points
            .iter()
            .map(|&[x, y]| ((x - from) / length, y))
            .map(|(share, y)| [share, (y - start) - (end - start) * share])
            .collect();
        let size = rest.iter().fold(T::zero(), |size, point| size.max(point[1].abs()));
        let size = if size.is_zero() { T::one() } else { size };
        rest.iter_mut().for_each(|point| point[1] /= size);
        let mut fitting = Fitting::new(&rest, FIRST_SPANS.min(points.len() - 1));
        let mut reaches = fitting.reaches();
        while fitting.spans < points.len()
            && (reaches[0] < T::of(RESOLVED) || fitting.leaves_waves(&rest, reaches[1]))
        {
            fitting = Fitting::new(&rest, 2 * fitting.spans);
            reaches = fitting.reaches();
        }
        let spans = fitting.spans;
        let [triangle, best] = reaches.map(|reach| fitting.penalised(fitting.alpha(reach)));
        let span = length / T::count(spans);
        let noise = size * (best.rest / T::count(points.len() - FREE_PARAMETERS)).sqrt();
        let knot = |(i, c): (usize, &[T])| {
            let height = size * ((c[0] + T::of(4.0) * c[1] + c[2]) / T::of(6.0));
            let line = start + (end - start) * (T::count(i) / T::count(spans));
            let slope = size * (T::of(0.5) * (c[2] - c[0]));
            [height + line, (slope + (end - start) / T::count(spans)) / span]
        };
        let knots = best.solve().windows(3).enumerate().map(knot).collect();
        (Self { ends: [from, to], spans, triangle, noise }, knots)
    }

    /// Returns x of a knot.
    pub fn place(&self, knot: usize) -> T {
        let [from, to] = self.ends;
        if knot == self.spans {
            to
        } else {
            from + (to - from) * (T::count(knot) / T::count(self.spans))
        }
    }

    /// Returns the standard deviation of `Σ wᵢ dY/dX(xᵢ)`.
    pub fn slope_deviation(&self, x: &[T], weights: &[T]) -> T {
        let [from, to] = self.ends;
        let mut sums = vec![T::zero(); self.spans + FREE_PARAMETERS];
        for (&x, &weight) in x.iter().zip(weights) {
            let (start, t) = split((x - from) / (to - from), self.spans);
            for (sum, slope) in sums[start..].iter_mut().zip(slopes(t)) {
                *sum += weight * slope;
            }
        }
        self.triangle.variance(sums).sqrt() * self.noise * (T::count(self.spans) / (to - from))
    }
}

/// Returns the span in which a place from 0 to 1 lies, and the place in it, from 0 to 1.
fn split<T: Real>(share: T, spans: usize) -> (usize, T) {
    let place = share * T::count(spans);
    let (mut start, mut step) = (0, spans.next_power_of_two());
    while step > 0 {
        if start + step < spans && T::count(start + step) <= place {
            start += step;
        }
        step /= 2;
    }
    (start, place - T::count(start))
}

/// Returns the four B-splines of a span.
fn values<T: Real>(t: T) -> [T; 4] {
    let s = T::one() - t;
    let inner = |t: T| T::of(4.0) + t * t * (T::of(3.0) * t - T::of(6.0));
    [s * s * s, inner(t), inner(s), t * t * t].map(|value| value / T::of(6.0))
}

/// Returns the derivatives of the four B-splines of a span.
fn slopes<T: Real>(t: T) -> [T; 4] {
    let (half, s) = (T::of(0.5), T::one() - t);
    let inner = |t: T| t * (T::of(1.5) * t - T::of(2.0));
    [-half * s * s, inner(t), -inner(s), half * t * t]
}
