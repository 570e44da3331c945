//! The smoothest curve at a given distance from the points.
//!
//! For a given α the natural cubic spline minimises `Σ (Y(xᵢ) - yᵢ)² + α ∫ Y''² dX`. In its heights
//! and slopes at the knots this is a least-squares problem, in which an interval of length h
//! between `[Y₀, Y₀']` and `[Y₁, Y₁']` has two rows,
//!
//! ```text
//! ∫ Y''² dX = (Y₁' - Y₀')²/h + 12/h ((Y₀' + Y₁')/2 - (Y₁ - Y₀)/h)²
//! ```
//!
//! It is solved by rotations, from left to right, in time and memory proportional to the number of
//! points. (Reinsch's own equations, the normal ones, have the square of its condition number: the
//! eighth power of the number of points that the smoothing reaches over, instead of the fourth.)

use super::SplineError;
use crate::Real;
use crate::search::{Bracket, Brent, LimitSearch, SearchError, StoppingCriteria};
use nalgebra::Matrix2;

/// Row of the equations: the height and the slope at two neighbouring knots, and the right side.
type Row<T> = [T; 5];

/// Weight of the uncertainty of a curve in its [`risk`](Fitting::risk). One is right for heights.
/// Two halved the error of pressures, which follow the curvature, and tolerates a noise given at
/// half its true size.
const UNCERTAINTY_WEIGHT: f64 = 2.0;

/// Ratio of successive reaches tried.
const STEP: f64 = 1.5;

/// Returns height and slope at each knot of the smoothest spline that Reinsch allows for the noise,
/// with up to `N + sqrt(2 N)` for the sum of the squared distances in units of the noise. Returns a
/// smoother spline where it is expected to be nearer to the true curve, as where the given noise is
/// too small.
pub(super) fn smooth<T: Real>(points: &[[T; 2]], noise: T) -> Result<Vec<[T; 2]>, SplineError<T>> {
    let count = T::count(points.len());
    let [least, most] = [T::of(1e-3), T::of(3.0) * count];
    let allowed = T::one() + (T::of(2.0) / count).sqrt();
    let mut fitting = Fitting::new(points, noise);
    let line_off = fitting.fit(most);
    if !line_off.is_finite() {
        let source = SearchError::NotFinite { x: most, value: line_off };
        return Err(SplineError::Smoothing { source });
    }
    let nothing_left = SplineError::NothingLeft { noise, line: line_off.sqrt() * noise };
    if line_off <= allowed {
        return Err(nothing_left);
    }
    // Both in logarithms; the floor is a millionth of the distance sought.
    let floor = T::of(1e-12);
    let mut off = |reach: T| (fitting.fit(reach).max(floor) / allowed).ln();
    let near = off(least);
    let reach = if near < T::zero() {
        let bracket = Bracket::new(least.ln(), most.ln()).values(near, (line_off / allowed).ln());
        search(&mut |reach: T| off(reach.exp()), &bracket)?
    } else {
        least
    };
    let reach = fitting.least_risk(reach, most)?;
    if reach >= most {
        return Err(nothing_left);
    }
    fitting.fit(reach);
    Ok(fitting.knots())
}

/// Finds the zero of a function of the logarithm of the reach, and returns the reach.
fn search<T: Real>(
    function: &mut dyn FnMut(T) -> T,
    bracket: &Bracket<T>,
) -> Result<T, SplineError<T>> {
    let brent = Brent { tolerance: StoppingCriteria { residual: 1e-4, ..StoppingCriteria::FULL } };
    let found =
        brent.find(function, bracket).map_err(|source| SplineError::Smoothing { source })?;
    Ok(found.x.exp())
}

/// Points, and the curve that was fitted to them last.
struct Fitting<T> {
    /// Points with the mean spacing as the unit of x, less the line from the first to the last: the
    /// line is not penalised, and there is less to round.
    points: Vec<[T; 2]>,
    noise: T,
    spacing: T,
    first: T,
    chord: T,
    triangle: Vec<[Row<T>; 2]>,
    curve: Vec<[T; 2]>,
}

impl<T: Real> Fitting<T> {
    fn new(points: &[[T; 2]], noise: T) -> Self {
        let [first, last] = [points[0], points[points.len() - 1]];
        let spacing = (last[0] - first[0]) / T::count(points.len() - 1);
        let chord = (last[1] - first[1]) / T::count(points.len() - 1);
        let rest = |&[x, y]: &[T; 2]| {
            let x = (x - first[0]) / spacing;
            [x, y - (first[1] + chord * x)]
        };
        Self {
            points: points.iter().map(rest).collect(),
            noise,
            spacing,
            first: first[1],
            chord,
            triangle: Vec::with_capacity(points.len()),
            curve: vec![[T::zero(); 2]; points.len()],
        }
    }

    /// Fits the curve that smooths over `reach` points, `α = reach⁴ spacing³`, and returns the mean
    /// square of its distances from the points, in units of the noise, so that no square of a small
    /// number vanishes.
    fn fit(&mut self, reach: T) -> T {
        penalised(&self.points, reach * reach, &mut self.triangle, &mut self.curve);
        let pairs = self.points.iter().zip(&self.curve);
        let square =
            |(point, knot): (&[T; 2], &[T; 2])| ((point[1] - knot[0]) / self.noise).powi(2);
        pairs.fold(T::zero(), |sum, pair| sum + square(pair)) / T::count(self.points.len())
    }

    /// Returns the expected mean square error of the heights, up to a constant, in units of the
    /// noise (Mallows, *Technometrics* 15, 1973, 661): the mean square of the distances, which
    /// grows with the reach, plus the uncertainty, which falls with it.
    fn risk(&mut self, reach: T) -> T {
        let distance = self.fit(reach);
        let doubt = freedom(&self.triangle) / T::count(self.points.len());
        distance + T::of(2.0 * UNCERTAINTY_WEIGHT) * doubt
    }

    /// Finds the reach of the least risk between two reaches.
    fn least_risk(&mut self, from: T, most: T) -> Result<T, SplineError<T>> {
        let step = T::of(STEP);
        let (mut best, mut least, mut reach) = (from, self.risk(from), from);
        while reach < most {
            reach = (reach * step).min(most);
            let risk = self.risk(reach);
            if risk < least {
                (best, least) = (reach, risk);
            }
        }
        if best <= from || best >= most {
            return Ok(best);
        }
        // The risk stops falling between half a step to the left and half a step to the right.
        let half = step.ln() * T::of(0.5);
        let mut rise = |middle: T| {
            let [before, after] =
                [middle - half, middle + half].map(|reach| self.risk(reach.exp()));
            (after - before) / least
        };
        let ends = [best.ln() - half, best.ln() + half];
        let [falls, rises] = ends.map(&mut rise);
        if !(falls < T::zero() && rises > T::zero()) {
            return Ok(best);
        }
        search(&mut rise, &Bracket::new(ends[0], ends[1]).values(falls, rises))
    }

    /// Returns height and slope at each knot, with the line added.
    fn knots(self) -> Vec<[T; 2]> {
        let Self { first, chord, spacing, .. } = self;
        let knot = |(&[x, _], &[y, slope]): (&[T; 2], &[T; 2])| {
            [y + (first + chord * x), (slope + chord) / spacing]
        };
        self.points.iter().zip(&self.curve).map(knot).collect()
    }
}

/// Returns the trace of the matrix that makes the heights of the curve from those of the points:
/// the extent to which the curve follows the points. Computed from right to left, by the inverse of
/// the triangle.
fn freedom<T: Real>(triangle: &[[Row<T>; 2]]) -> T {
    // Covariance of height and slope at a knot, for points with a variance of 1.
    let mut covariance = Matrix2::zeros();
    triangle.iter().rev().fold(T::zero(), |sum, [upper, lower]| {
        let next = Matrix2::new(upper[2], upper[3], lower[2], lower[3]);
        let above = -upper[1] / (upper[0] * lower[1]);
        let inverse = Matrix2::new(upper[0].recip(), above, T::zero(), lower[1].recip());
        covariance = inverse
            * (Matrix2::identity() + next * covariance * next.transpose())
            * inverse.transpose();
        sum + covariance.m11
    })
}

/// Finds height and slope at each knot, given the square root of α.
fn penalised<T: Real>(
    points: &[[T; 2]],
    stiffness: T,
    triangle: &mut Vec<[Row<T>; 2]>,
    knots: &mut [[T; 2]],
) {
    let (zero, one, half) = (T::zero(), T::one(), T::of(0.5));
    triangle.clear();
    // Rows 0 and 1 start with the left knot of an interval, 2 and 3 with the right.
    let mut rows = [[zero; 5]; 4];
    for pair in points.windows(2) {
        let h = pair[1][0] - pair[0][0];
        let [level, bent] = [stiffness / h.sqrt(), stiffness * (T::of(12.0) / h).sqrt()];
        insert(&mut rows, [one, zero, zero, zero, pair[0][1]]);
        insert(&mut rows, [bent / h, half * bent, -bent / h, half * bent, zero]);
        insert(&mut rows, [zero, -level, zero, level, zero]);
        triangle.push([rows[0], rows[1]]);
        let next = |row: Row<T>| [row[2], row[3], zero, zero, row[4]];
        rows = [next(rows[2]), next(rows[3]), [zero; 5], [zero; 5]];
    }
    let n = points.len();
    insert(&mut rows, [one, zero, zero, zero, points[n - 1][1]]);
    triangle.push([rows[0], rows[1]]);
    let mut after = [zero; 2];
    for (knot, [upper, lower]) in knots.iter_mut().zip(triangle.iter()).rev() {
        let known = |row: &Row<T>| row[4] - row[2] * after[0] - row[3] * after[1];
        let slope = known(lower) / lower[1];
        *knot = [(known(upper) - upper[1] * slope) / upper[0], slope];
        after = *knot;
    }
}

/// Adds a row to a triangle of rows, by plane rotations.
fn insert<T: Real>(rows: &mut [Row<T>; 4], mut row: Row<T>) {
    for (i, kept) in rows.iter_mut().enumerate() {
        if row[i].is_zero() {
            continue;
        }
        let length = kept[i].hypot(row[i]);
        let (cos, sin) = (kept[i] / length, row[i] / length);
        for (kept, new) in kept.iter_mut().zip(&mut row).skip(i) {
            (*kept, *new) = (cos * *kept + sin * *new, cos * *new - sin * *kept);
        }
    }
}
