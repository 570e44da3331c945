//! The smoothest curve at a given distance from the points.
//!
//! For a given α the natural cubic spline minimises `Σ (Y(xᵢ) - yᵢ)² + α ∫ Y''² dX`. By its heights
//! and slopes at the knots this is a problem of least squares, in which an interval of length h
//! between `[Y₀, Y₀']` and `[Y₁, Y₁']` has two rows,
//!
//! ```text
//! ∫ Y''² dX = (Y₁' - Y₀')²/h + 12/h ((Y₀' + Y₁')/2 - (Y₁ - Y₀)/h)²
//! ```
//!
//! It is solved by rotations, from left to right, in time and memory of the order of the number of
//! points. (Reinsch's own equations, the normal ones, have the square of its condition number: the
//! eighth power of the number of points that the smoothing reaches over, in place of the fourth.)

use super::SplineError;
use crate::Real;
use crate::search::{Bracket, Brent, LimitSearch, SearchError, StoppingCriteria};

/// A row of the equations: the height and the slope at two neighbouring knots, and the right side.
type Row<T> = [T; 5];

/// Height and slope at each knot of the spline with the root mean square distance `noise` from the
/// points.
pub(super) fn smooth<T: Real>(points: &[[T; 2]], noise: T) -> Result<Vec<[T; 2]>, SplineError<T>> {
    let count = T::count(points.len());
    let [first, last] = [points[0], points[points.len() - 1]];
    let chord = (last[1] - first[1]) / (last[0] - first[0]);
    // Without the line from the first point to the last, which is not penalised, there is less to round.
    let line = |x: T| first[1] + chord * (x - first[0]);
    let rest: Vec<[T; 2]> = points.iter().map(|&[x, y]| [x - first[0], y - line(x)]).collect();
    let spacing = (last[0] - first[0]) / (count - T::one());

    let mut scratch = Vec::with_capacity(points.len());
    let mut knots = vec![[T::zero(); 2]; points.len()];
    // In units of the noise, so that no square of a small number vanishes. The reach of the smoothing is
    // in points: α = reach⁴ spacing³.
    let mut distance = |reach: T, knots: &mut Vec<[T; 2]>| {
        let stiffness = reach * reach * spacing * spacing.sqrt();
        penalised(&rest, stiffness, &mut scratch, knots);
        let off = |(point, knot): (&[T; 2], &[T; 2])| (point[1] - knot[0]) / noise;
        let square = |sum: T, pair| sum + off(pair).powi(2);
        (rest.iter().zip(knots.iter()).fold(T::zero(), square) / count).sqrt()
    };
    let [least, most] = [T::of(1e-3), T::of(3.0) * count];
    let line_off = distance(most, &mut knots);
    if !line_off.is_finite() {
        let source = SearchError::NotFinite { x: most, value: line_off };
        return Err(SplineError::Smoothing { source });
    }
    if line_off <= T::one() {
        return Err(SplineError::NothingLeft { noise, line: line_off * noise });
    }
    // Both in logarithms, and nothing below a millionth of what is sought.
    let mut off = |reach: T, knots: &mut Vec<[T; 2]>| distance(reach, knots).max(T::of(1e-6)).ln();
    let near = off(least, &mut knots);
    if near < T::zero() {
        let bracket = Bracket::new(least.ln(), most.ln()).values(near, line_off.ln());
        let search = Brent { tolerance: StoppingCriteria { residual: 1e-4, ..StoppingCriteria::FULL } };
        let found = search.find(&mut |reach: T| off(reach.exp(), &mut knots), &bracket);
        let reach = found.map_err(|source| SplineError::Smoothing { source })?.x.exp();
        off(reach, &mut knots);
    }
    for (knot, point) in knots.iter_mut().zip(points) {
        *knot = [knot[0] + line(point[0]), knot[1] + chord];
    }
    Ok(knots)
}

/// Height and slope at each knot, for the square root of α.
fn penalised<T: Real>(
    points: &[[T; 2]],
    stiffness: T,
    scratch: &mut Vec<[Row<T>; 2]>,
    knots: &mut [[T; 2]],
) {
    let (zero, one, half) = (T::zero(), T::one(), T::of(0.5));
    scratch.clear();
    // Rows 0 and 1 start with the left knot of an interval, 2 and 3 with the right.
    let mut rows = [[zero; 5]; 4];
    for pair in points.windows(2) {
        let h = pair[1][0] - pair[0][0];
        let [level, bent] = [stiffness / h.sqrt(), stiffness * (T::of(12.0) / h).sqrt()];
        insert(&mut rows, [one, zero, zero, zero, pair[0][1]]);
        insert(&mut rows, [bent / h, half * bent, -bent / h, half * bent, zero]);
        insert(&mut rows, [zero, -level, zero, level, zero]);
        scratch.push([rows[0], rows[1]]);
        let next = |row: Row<T>| [row[2], row[3], zero, zero, row[4]];
        rows = [next(rows[2]), next(rows[3]), [zero; 5], [zero; 5]];
    }
    let n = points.len();
    insert(&mut rows, [one, zero, zero, zero, points[n - 1][1]]);
    scratch.push([rows[0], rows[1]]);
    let mut after = [zero; 2];
    for (knot, [upper, lower]) in knots.iter_mut().zip(scratch.iter()).rev() {
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
