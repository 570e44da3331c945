//! A stretch of a smooth piece of a body, with what is known of it.

use super::segment::Segment;
use super::series::{Row, Series};
use crate::gap::Surface;
use crate::{CurvePoint, Real};

/// Halvings in a row after which a panel that is as uncertain as before is taken for noise: a wave that is finer than
/// that, of some 300 in the body, is seen before.
pub(super) const MOST_IN_VAIN: usize = 10;

/// The share of the distance by which a point was missed that may be left of it: a series that is closer has seen the
/// feature, not only its foot.
const LEFT: f64 = 0.01;

/// The share of its uncertainty that halving leaves at most of a panel that resolves the body: of a series of eight
/// terms 1/256 or less.
const GAIN: f64 = 0.125;

/// A point of a piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct Missed<T> {
    pub piece: usize,
    pub k: T,
    pub point: CurvePoint<T>,
    /// The distance by which it was missed, a length.
    pub by: T,
    /// The distance of points at which it was found, along x.
    pub apart: T,
}

/// A stretch of a smooth piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct Panel<T> {
    pub piece: usize,
    pub k: [T; 2],
    /// The points at both ends, of which those inside a piece are not among the rows.
    pub ends: [Row<T>; 2],
    pub is_inside: [bool; 2],
    /// Its number among the series; without one it is the cubic between its ends.
    pub series: Option<usize>,
    /// Uncertainty of the heights, a length.
    pub doubt: T,
    /// Whether anything but the ends has been looked at.
    pub is_sampled: bool,
    /// Halvings in a row that have left it as uncertain.
    pub vain: usize,
    /// Whether it misses points of the curve that are known.
    pub is_void: bool,
    /// Uncertainty of the panel that it is a half of; infinite if there is none.
    pub before: T,
}

impl<T: Real> Panel<T> {
    pub fn x(&self) -> [T; 2] {
        self.ends.map(|end| end.x)
    }

    /// Tells whether more points may leave it less uncertain than by a tolerance.
    pub fn may_gain(&self, tolerance: T) -> bool {
        !self.is_sampled || self.doubt > tolerance && self.vain < MOST_IN_VAIN
    }

    /// Tells whether its halving has brought it much nearer to being known.
    pub fn converges(&self) -> bool {
        self.doubt <= T::of(GAIN) * self.before
    }
}

pub(super) fn row<T: Real>(end: CurvePoint<T>) -> Row<T> {
    Row { x: end.x, y: end.y, slope: end.dy / end.dx, doubt: T::zero() }
}

/// Returns a point of a panel that its series misses, as another one has.
pub(super) fn missed_by<'m, T: Real>(
    series: &Series<T>,
    panel: &Panel<T>,
    known: &'m [Missed<T>],
) -> Option<&'m Missed<T>> {
    let ([from, to], [left, right]) = (panel.k, panel.x());
    known.iter().filter(|missed| missed.piece == panel.piece).find(|missed| {
        let t = ((missed.k - from) - (to - missed.k)) / (to - from);
        let error = series.doubt.max(series.miss(t, &missed.point));
        let is_met = error <= T::of(LEFT) * missed.by;
        // A shorter one has points all over the feature.
        t.abs() <= T::one() && right - left > T::of(0.5) * missed.apart && !is_met
    })
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
