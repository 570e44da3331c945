//! The known points of a curve on one of its pieces.

use super::MAX_TARGETS;
use crate::{CurvePoint, Real};

/// Known point of a curve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CurveSample<T> {
    pub k: T,
    pub x: T,
    pub y: T,
    pub dx: T,
    /// Slope `Y'/X'`.
    pub slope: T,
}

impl<T: Real> CurveSample<T> {
    pub fn new(k: T, point: CurvePoint<T>) -> Self {
        Self { k, x: point.x, y: point.y, dx: point.dx, slope: point.dy / point.dx }
    }
}

/// The two ends of a piece and the known points between them, from left to right; empty before the
/// first sample.
#[derive(Clone, Debug)]
pub(super) struct CurveSamples<T> {
    pub row: Vec<CurveSample<T>>,
    /// True if the points between the ends are on an approximate series.
    pub are_guessed: bool,
}

impl<T: Real> CurveSamples<T> {
    pub fn new() -> Self {
        Self { row: Vec::new(), are_guessed: false }
    }

    /// Returns the number of points between the ends.
    pub fn len(&self) -> usize {
        self.row.len().saturating_sub(2)
    }

    pub fn ends(&self) -> [CurveSample<T>; 2] {
        [self.row[0], self.row[self.row.len() - 1]]
    }

    /// Replaces all points.
    pub fn set(&mut self, [left, right]: [CurveSample<T>; 2], inner: &[CurveSample<T>]) {
        self.are_guessed = false;
        self.row.clear();
        self.row.reserve(MAX_TARGETS + 2);
        self.row.push(left);
        self.row.extend_from_slice(inner);
        self.row.push(right);
    }

    pub fn inner(&self) -> &[CurveSample<T>] {
        &self.row[1..=self.len()]
    }
}
