//! Checks of the points that a survey takes.

use super::panel::Panel;
use super::series::MAX_NOISE;
use crate::profile::{Noise, Piece, first_turn};
use crate::{CurvePoint, ProfileError, Real};

/// Refuses points where X or Y is not finite inside the common range, or where X turns, and slopes
/// by x that differ from the slopes of the points.
pub(super) fn check<T: Real>(
    piece: &Piece<'_, T>,
    panel: &Panel<T>,
    (k, points): (&[T], &[CurvePoint<T>]),
    range: [T; 2],
    evaluations: &mut usize,
) -> Result<(), ProfileError<T>> {
    let ([from, to], count) = (panel.x(), points.len());
    let [first, last] = piece.x();
    let (mut reached, mut noise) = (from, None);
    for (i, point) in points.iter().enumerate() {
        let fault = |quantity, value| Err(ProfileError::NotFinite { quantity, k: k[i], value });
        let CurvePoint { x, y, .. } = *point;
        if !x.is_finite() {
            let next = points[i..].iter().map(|point| point.x).find(|x| x.is_finite());
            if reached < range[1] && next.unwrap_or(to) > range[0] {
                return fault("X", x);
            }
            continue;
        }
        // An end inside a piece is known only approximately, by the series.
        let least = if i > 0 { reached.max(first) } else { first };
        let back = (least - x).max(x - last);
        // No curve turns by its noise, which is measured only where X seems to turn.
        let mut measured = || Noise::of_rounding(piece, k[i], evaluations);
        let allowed = || measured().map_or(T::zero(), |noise| T::of(MAX_NOISE) * noise.x);
        if back > T::zero() && back > *noise.get_or_insert_with(allowed) {
            let back = |&j: &usize| points[j].dx * points[j + 1].dx < T::zero();
            let j = (0..count - 1).find(back).unwrap_or(i.saturating_sub(1));
            let met = [k[j], k[(j + 1).min(count - 1)]];
            return Err(first_turn(piece.curve, piece.k, met));
        }
        if !y.is_finite() && x > range[0] && x < range[1] {
            return fault("Y", y);
        }
        reached = if i == 0 { x } else { reached.max(x) };
    }
    check_slopes(piece, k, points)
}

/// Compares the slopes that a curve gives by x, if it does, with the slopes of its points.
fn check_slopes<T: Real>(
    piece: &Piece<'_, T>,
    k: &[T],
    points: &[CurvePoint<T>],
) -> Result<(), ProfileError<T>> {
    let slope = |i: usize| points[i].dy / points[i].dx;
    for i in 1..points.len() - 1 {
        let Some(given) = piece.curve.slope_at(points[i].x) else { return Ok(()) };
        let difference = slope(i);
        let changes = (slope(i + 1) - slope(i - 1)).abs();
        let allowed =
            T::epsilon().cbrt() * (given.abs() + difference.abs()) + T::of(1e-3) * changes;
        if (given - difference).abs() > allowed {
            let quantity = "slope_at(x)";
            return Err(ProfileError::Derivative { quantity, k: k[i], given, difference });
        }
    }
    Ok(())
}
