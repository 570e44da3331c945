//! A stretch of a body: its uncertainty, and where more points lessen it.

use super::series::{Row, Series};
use crate::{CurvePoint, Real};

/// The share of a panel at which a part that is as uncertain is taken for noise: a wave that is finer than that, of
/// some 300 in the body, is seen before.
const NOISE: f64 = 1.0 / 1024.0;

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

/// A stretch of a smooth piece, or a run of pieces.
#[derive(Clone, Copy, Debug)]
pub(super) struct Panel<T> {
    /// The numbers of its piece, and of the last one of a run.
    pub piece: usize,
    pub last: usize,
    pub k: [T; 2],
    /// The points at both ends, of which those inside a piece are not among the rows.
    pub ends: [Row<T>; 2],
    pub is_inside: [bool; 2],
    /// The number of its series, which may reach beyond it; without one it is the cubic between its ends.
    pub series: Option<usize>,
    /// Uncertainty of the heights, a length.
    pub doubt: T,
    /// Whether anything but the ends of its pieces has been looked at.
    pub is_sampled: bool,
    /// The range of k of the panel that it was cut out of when that was last found to be less uncertain than before;
    /// infinite where no more is to be gained.
    pub since: T,
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
        let is_noise = || (self.k[1] - self.k[0]).abs() <= T::of(NOISE) * self.since;
        !self.is_sampled || self.doubt > tolerance && (self.is_run() || !is_noise())
    }

    /// Tells whether it is several pieces.
    pub fn is_run(&self) -> bool {
        self.last > self.piece
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
    let [left, right] = panel.x();
    known.iter().filter(|missed| missed.piece == panel.piece).find(|missed| {
        let t = series.t(missed.k);
        let error = series.doubt.max(series.miss(t, &missed.point));
        let is_met = error <= T::of(LEFT) * missed.by;
        // A shorter one has points all over the feature.
        t.abs() <= T::one() && right - left > T::of(0.5) * missed.apart && !is_met
    })
}
