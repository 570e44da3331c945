//! Panels of which the ends say all, or how little they say.

use super::{Panel, Row};
use crate::Real;
use crate::gap::Surface;
use crate::gap::survey::segment::Segment;
use crate::profile::Convexity;

/// Tells whether a panel is one of a straight body, given by x itself: its ends say all.
pub(super) fn is_straight<T: Real>(surface: &Surface<'_, T>, panel: &Panel<T>) -> bool {
    let piece = surface.piece(panel.piece);
    let is_given = || piece.curve.slope_at(piece.ends[0].x).is_some();
    piece.curve.convexity() == Convexity::Straight && is_given()
}

/// How far the cubic between two ends bulges from the line through both.
pub(super) fn bulge<T: Real>([start, end]: &[Row<T>; 2]) -> T {
    let size = (end.slope - start.slope).abs() * (end.x - start.x);
    if size.is_finite() { size } else { (end.y - start.y).abs() }
}

/// A cubic between two ends that the slopes inside bear out, where the curve gives them by x.
pub(super) fn settled<T: Real>(surface: &Surface<'_, T>, panel: &Panel<T>) -> Option<Panel<T>> {
    let piece = surface.piece(panel.piece);
    let [start, end] = panel.ends;
    let segment = Segment::exact([start.x, start.y], [end.x, end.y], [start.slope, end.slope]);
    let size = start.slope.abs() + end.slope.abs() + segment.chord.abs();
    let rounding =
        T::of(64.0) * T::epsilon() * (size + (start.y.abs() + end.y.abs()) / segment.width);
    let agrees = |share: f64| {
        let slope = segment.at(T::of(share))[1];
        let given = piece.curve.slope_at(start.x + T::of(share) * segment.width)?;
        Some((given - slope).abs() <= rounding)
    };
    let both = agrees(0.3)? && agrees(0.7)?;
    both.then_some(Panel { doubt: T::zero(), ..*panel })
}
