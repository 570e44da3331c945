//! Conditions on points that become a profile.

use super::Fit;
use crate::Real;
use crate::numerics::ascending;
use crate::rounded::{apart, six, span};
use std::cmp::Ordering;
use thiserror::Error;

/// Number of points to either side of a point from which the scale of the distances there is
/// estimated.
const SCALE_POINTS: usize = 10;

/// Smallest number of points among which an outlier can be found.
const FEWEST: usize = 12;

/// Standard deviation of a normal distribution, in units of the median of its absolute values.
const BY_MEDIAN: f64 = 1.4826;

/// Largest part of the distance of an outlier that it leaves unexplained in a row beside its own.
/// A jump of the curvature leaves 0.67 of it or more; two outliers side by side, or a step, 0.33.
const UNEXPLAINED: f64 = 0.35;

/// Reason why points do not make a profile. Rows are counted from 1, as in a file with a point on
/// each line.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SplineError<T: Real> {
    /// There are too few points.
    #[error("{points} points: a spline needs four or more")]
    TooFew {
        /// Number of points.
        points: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("row {row}: the point [{}, {}] is not finite: remove the row", six(*x), six(*y))]
    NotFinite {
        /// Row of the point.
        row: usize,
        /// x of the point.
        x: T,
        /// y of the point.
        y: T,
    },
    /// Two neighbours have equal x, or x so close that their distance is lost.
    #[error("row {row}: x = {} as in the row before: keep one of the two, or their mean", six(*x))]
    Duplicate {
        /// Row of the second point.
        row: usize,
        /// x of both points.
        x: T,
    },
    /// x falls from one point to the next.
    #[error(
        "row {row}: x = {x} after {before}: sort the points by x, or reverse them",
        x = apart(*x, &[*before]), before = apart(*before, &[*x])
    )]
    Unsorted {
        /// Row of the second point.
        row: usize,
        /// x of the second point.
        x: T,
        /// x of the row before.
        before: T,
    },
    /// A point is off the curve through its neighbours.
    #[error(
        "row {row}: y = {y} at x = {x}, where its neighbours suggest {expected}: {deviations} \
         standard deviations off. Remove the row, level the points if a period begins or ends there, or set Fit::outliers to None if the body has a \
         corner there, or its curvature changes from point to point",
        y = apart(*y, &[*expected]), x = six(*x), expected = apart(*expected, &[*y]),
        deviations = six(*deviations)
    )]
    Outlier {
        /// Row of the point, the one that is furthest off.
        row: usize,
        /// x of the point.
        x: T,
        /// y of the point.
        y: T,
        /// `Y` at this x on the cubic through its four neighbours.
        expected: T,
        /// Distance of the point from this cubic, in standard deviations.
        deviations: T,
    },
    /// A period is not a positive finite number, or its end is not behind the last point, or far
    /// behind it: a part of the period is not measured.
    #[error(
        "the period {} from the first point, x = {}, must end behind the last one, x = {last}, by a step \
         like theirs: leave out the points from its end on, the first one repeated, too, or give all of a period", six(*period), six(*first), last = apart(*last, &[*first])
    )]
    Period {
        /// Period as given; 0 of a body that is turned.
        period: T,
        /// x of the first point.
        first: T,
        /// x of the last point.
        last: T,
    },
    /// The limit for outliers is not positive.
    #[error("Fit::outliers is {}: give a number of standard deviations, or None", six(*deviations))]
    Limit {
        /// The limit as given.
        deviations: T,
    },
    /// The curve up to a point is beyond the range of the number type.
    #[error(
        "row {row}: the numbers of the curve from x = {} overflow, or vanish. Give \
         the points in a unit of their own size", span(*before, *x)
    )]
    Overflow {
        /// Row of the point.
        row: usize,
        /// x of the point.
        x: T,
        /// x of the row before.
        before: T,
    },
}

/// Refuses points that are not in order, stand out, or do not make a period.
pub(super) fn check<T: Real>(points: &[[T; 2]], fit: Fit<T>) -> Result<(), SplineError<T>> {
    check_order(points)?;
    let Some(period) = fit.period else {
        return fit.outliers.map_or(Ok(()), |most| check_outliers(points, most, points.len()));
    };
    let (first, last) = (points[0][0], points[points.len() - 1][0]);
    let (left, rounding) =
        (first + period - last, T::of(64.0) * T::epsilon() * (first.abs() + period));
    let step = points.windows(2).fold(T::zero(), |most, pair| most.max(pair[1][0] - pair[0][0]));
    // One point may be left out there; of more a part is not measured.
    if !(left > rounding && left <= T::of(2.0) * step + rounding) {
        return Err(SplineError::Period { period, first, last });
    }
    // A jump where the period closes stands out between this one and the next.
    let next = points.iter().map(|&[x, y]| [x + period, y]);
    let closed: Vec<_> = points.iter().copied().chain(next).collect();
    fit.outliers.map_or(Ok(()), |most| check_outliers(&closed, most, points.len()))
}

/// Refuses points that are too few, not finite or not in order.
fn check_order<T: Real>(points: &[[T; 2]]) -> Result<(), SplineError<T>> {
    let mut before = None;
    for (i, &[x, y]) in points.iter().enumerate() {
        let row = i + 1;
        if !(x.is_finite() && y.is_finite()) {
            return Err(SplineError::NotFinite { row, x, y });
        }
        match before {
            Some(before) if x < before => return Err(SplineError::Unsorted { row, x, before }),
            Some(before) if x == before => return Err(SplineError::Duplicate { row, x }),
            _ => before = Some(x),
        }
    }
    if points.len() < 4 {
        return Err(SplineError::TooFew { points: points.len() });
    }
    Ok(())
}

/// Refuses the point that is furthest off the curve through its neighbours, if it is off by more
/// than `most` standard deviations. After `rows` points they repeat.
fn check_outliers<T: Real>(points: &[[T; 2]], most: T, rows: usize) -> Result<(), SplineError<T>> {
    // Refuses NaN, too.
    if most.partial_cmp(&T::zero()) != Some(Ordering::Greater) {
        return Err(SplineError::Limit { deviations: most });
    }
    if rows < FEWEST {
        return Ok(());
    }
    let all: Vec<T> = (0..points.len()).map(|i| deviation(points, i).abs()).collect();
    let mut sorted = Vec::with_capacity(points.len());
    let everywhere = median(&all, &mut sorted);
    let size = points.iter().fold(T::zero(), |size, point| size.max(point[1].abs()));
    let rounded = T::of(64.0) * T::epsilon() * size;
    let mut floor = rounded;
    if everywhere <= rounded {
        // Most points are exactly in line: heights without noise, or rounded to steps.
        let steps = points.windows(2).map(|pair| (pair[1][1] - pair[0][1]).abs());
        let step = steps.filter(|step| !step.is_zero()).reduce(|least, step| least.min(step));
        floor = floor.max(step.unwrap_or(rounded));
    }
    let mut scale_at = |i: usize| {
        let start =
            i.saturating_sub(SCALE_POINTS).min(all.len().saturating_sub(2 * SCALE_POINTS + 1));
        let around = &all[start..(start + 2 * SCALE_POINTS + 1).min(all.len())];
        T::of(BY_MEDIAN) * median(around, &mut sorted).max(everywhere)
    };
    let mut worst: Option<(usize, T)> = None;
    for (i, &off) in all.iter().enumerate() {
        let far = off > floor && off > most * T::of(BY_MEDIAN) * everywhere;
        let is_worst =
            far && off > most * scale_at(i) && worst.is_none_or(|(_, worst)| off > worst);
        if is_worst && explains(points, i) && stays(points, i) {
            worst = Some((i, off));
        }
    }
    let Some((i, off)) = worst else { return Ok(()) };
    let deviations = off / scale_at(i).max(floor / most);
    let i = culprit(points, i);
    let ([x, _], [_, y]) = (points[i % rows], points[i]);
    let (expected, _) = foretold(5, points, i);
    Err(SplineError::Outlier { row: i % rows + 1, x, y, expected, deviations })
}

/// Returns true if an error of one point explains the distances in the three rows of five around
/// it: at an outlier they alternate in sign. A jump of the curvature, between arcs of
/// three points or more, is no outlier.
fn explains<T: Real>(points: &[[T; 2]], i: usize) -> bool {
    let first = i.clamp(3, points.len() - 4) - 3;
    let near = &points[first..first + 7];
    let alone: Vec<_> =
        (0..7).map(|j| [near[j][0], T::count(usize::from(first + j == i))]).collect();
    let own = (i - first).clamp(2, 4);
    let error = deviation(near, own) / deviation(&alone, own);
    let left = |row| (deviation(near, row) - error * deviation(&alone, row)).abs();
    (2..5).all(|row| left(row) <= T::of(UNEXPLAINED) * deviation(near, own).abs())
}

/// Tells whether a point is about as far off the curve of the fifth degree through six neighbours.
/// Exact points lie far closer to it than to a cubic, however uneven their places are.
fn stays<T: Real>(points: &[[T; 2]], i: usize) -> bool {
    let [cubic, quintic] = [5, 7].map(|row| (points[i][1] - foretold(row, points, i).0).abs());
    quintic >= T::of(UNEXPLAINED) * cubic
}

/// Returns the faulty point near one that is off: the point without which the others are smoothest.
/// (At an end the same five points predict three of them, and all three are equally far off.)
fn culprit<T: Real>(points: &[[T; 2]], i: usize) -> usize {
    let near = i.saturating_sub(8)..(i + 9).min(points.len());
    let rough = |left_out: &usize| {
        let rest: Vec<_> = near.clone().filter(|j| j != left_out).map(|j| points[j]).collect();
        (0..rest.len()).fold(T::zero(), |sum, j| sum + deviation(&rest, j).abs())
    };
    let candidates = i.saturating_sub(2)..(i + 3).min(points.len());
    candidates.min_by(|a, b| ascending(&rough(a), &rough(b))).unwrap_or(i)
}

/// Returns the distance of a point from the cubic through its neighbours, scaled to the error of a
/// single height where all heights have equal errors.
fn deviation<T: Real>(points: &[[T; 2]], i: usize) -> T {
    let (expected, weights) = foretold(5, points, i);
    (points[i][1] - expected) / (T::one() + weights).sqrt()
}

/// Returns the height at a point by the polynomial through the nearest others of a row of points,
/// and the sum of the squares of their weights.
fn foretold<T: Real>(row: usize, points: &[[T; 2]], i: usize) -> (T, T) {
    let start = i.saturating_sub(row / 2).min(points.len() - row);
    let x = points[i][0];
    let neighbours = || (start..start + row).filter(|&j| j != i);
    let weight = |j: usize| {
        let factor = |m: usize| (x - points[m][0]) / (points[j][0] - points[m][0]);
        neighbours().filter(|&m| m != j).fold(T::one(), |product, m| product * factor(m))
    };
    neighbours().fold((T::zero(), T::zero()), |(height, squares), j| {
        let weight = weight(j);
        (height + weight * points[j][1], squares + weight * weight)
    })
}

fn median<T: Real>(values: &[T], sorted: &mut Vec<T>) -> T {
    sorted.clear();
    sorted.extend_from_slice(values);
    *sorted.select_nth_unstable_by((values.len() - 1) / 2, ascending).1
}
