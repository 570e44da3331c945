//! A stretch of a body: its uncertainty, and whether more points reduce it.

use super::series::{BodyPoint, Series};
use crate::{CurvePoint, Real};

/// Share of a panel at which a part of equal uncertainty is taken for noise: a wave finer than
/// this, with some 300 in the body, is seen before.
const NOISE: f64 = 1.0 / 1024.0;

/// Largest error of a series at a missed point, as a share of the distance by which it was missed:
/// a more accurate series has seen the feature, not only its foot.
const MAX_REMAINING: f64 = 0.01;

/// Largest share of its uncertainty that halving leaves of a panel that resolves the body: a series
/// of eight terms leaves 1/256 or less. Likewise the share that a panel without a wall has of that
/// of the next one with it.
pub(super) const MAX_HALVING_RATIO: f64 = 0.125;

/// Point of a piece that a series has missed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Missed<T> {
    pub piece: usize,
    pub k: T,
    pub point: CurvePoint<T>,
    /// Distance by which it was missed, a length; infinite if within the uncertainty.
    pub by: T,
    /// Distance of the points with which it was found, along x.
    pub apart: T,
}

/// Stretch of a smooth piece, or run of pieces.
#[derive(Clone, Copy, Debug)]
pub(super) struct Panel<T> {
    /// Numbers of its piece and of the last piece of a run.
    pub piece: usize,
    pub last: usize,
    pub k: [T; 2],
    /// Points at both ends; those inside a piece are left out.
    pub ends: [BodyPoint<T>; 2],
    pub is_inside: [bool; 2],
    /// Number of its series, which may reach beyond it; without a series it is the cubic between
    /// its ends.
    pub series: Option<usize>,
    /// Uncertainty of the heights, a length.
    pub doubt: T,
    /// True if more than the ends of its pieces is known.
    pub is_sampled: bool,
    /// Range of k of the panel, among those it was cut out of, at which the uncertainty last fell;
    /// infinite where no more can be gained.
    pub since: T,
    /// True if it misses known points of the curve.
    pub is_void: bool,
    /// Uncertainty of the panel of which it is a part; infinite if there is none.
    pub before: T,
}

impl<T: Real> Panel<T> {
    pub fn x(&self) -> [T; 2] {
        self.ends.map(|end| end.x)
    }

    /// Tells whether it is not sampled, or is more uncertain than a tolerance and more points may
    /// help.
    pub fn may_gain(&self, tolerance: T) -> bool {
        let is_noise = || (self.k[1] - self.k[0]).abs() <= T::of(NOISE) * self.since;
        !self.is_sampled || self.doubt > tolerance && (self.is_run() || !is_noise())
    }

    /// Makes it unknown, as it misses the curve.
    pub fn void(&mut self) {
        (self.doubt, self.since, self.is_void) = (T::one() / T::zero(), T::zero(), true);
    }

    /// Tells whether more points along all of it are better than two halves, given its series.
    pub fn may_be_closer(&self, series: &Series<T>) -> bool {
        series.may_be_closer && !self.is_void && series.k == self.k
    }

    /// Tells whether it consists of several pieces.
    pub fn is_run(&self) -> bool {
        self.last > self.piece
    }

    /// Tells whether its halving has much reduced its uncertainty.
    pub fn converges(&self) -> bool {
        self.doubt <= T::of(MAX_HALVING_RATIO) * self.before
    }
}

pub(super) fn row<T: Real>(end: CurvePoint<T>) -> BodyPoint<T> {
    BodyPoint { x: end.x, y: end.y, slope: end.dy / end.dx, doubt: T::zero() }
}

/// Returns the largest distance of a known point of a panel from its series; infinite if the series
/// misses a feature.
pub(super) fn missed_by<T: Real>(series: &Series<T>, panel: &Panel<T>, known: &[Missed<T>]) -> T {
    let [left, right] = panel.x();
    let own = known.iter().filter(|missed| missed.piece == panel.piece);
    own.fold(T::zero(), |most, missed| {
        let t = series.t(missed.k);
        let off = series.miss(t, &missed.point);
        let is_met = series.doubt.max(off) <= T::of(MAX_REMAINING) * missed.by;
        // A shorter panel has points all over the feature.
        let counts = t.abs() <= T::one() && right - left > T::of(0.5) * missed.apart;
        let by = if is_met { off } else { T::one() / T::zero() };
        if counts { most.max(by) } else { most }
    })
}
