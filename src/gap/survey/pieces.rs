//! Pieces of a body that are known only by their ends.
//!
//! The spline of measured points is a cubic between two of them, and there may be 100 000. Where
//! the bodies cannot touch, only the distance of a run of pieces from the one cubic between its
//! ends counts: with heights that differ by d at the ends of a piece, and slopes by e, two cubics
//! of a width w differ by no more than `|d| + (4/27) w (|e₀| + |e₁|)`.

use super::panel::{Panel, row};
use super::segment::Segment;
use super::series::BodyPoint;
use crate::gap::Surface;
use crate::profile::{Convexity, Piece};
use crate::{CurvePoint, Real};

/// Largest height of a cubic that is 0 at both ends of a unit span, for a unit of its slope at one
/// end.
const CUBIC_RISE: f64 = 4.0 / 27.0;

/// Rounding error of slopes of a cubic, in units in the last place.
const ROUNDING: f64 = 64.0;

/// Places at which a piece is compared with a cubic, in shares of the way.
const CUBIC_PLACES: [f64; 2] = [0.3, 0.7];

/// Largest number of runs into which a run is divided.
const RUN_PARTS: usize = 16;

impl<T: Real> Panel<T> {
    /// Makes the panel of some pieces of a body, known only by their ends.
    pub fn of_pieces(surface: &Surface<'_, T>, [first, last]: [usize; 2]) -> Self {
        let (start, end) = (surface.piece(first), surface.piece(last));
        let ends = [row(start.ends[0]), row(end.ends[1])];
        let mut panel = Self {
            piece: first,
            last,
            k: [start.k[0], end.k[1]],
            ends,
            is_inside: [false; 2],
            series: None,
            doubt: T::zero(),
            is_sampled: false,
            since: T::zero(),
            is_void: false,
            before: T::one() / T::zero(),
        };
        if panel.is_run() {
            panel.set_doubts(surface, false);
        } else if is_known(&start) {
            panel.is_sampled = true;
        } else {
            panel.doubt = bulge(&ends);
        }
        panel
    }

    /// Cuts the panel of an endless straight body down to a range of x: between ends so far away
    /// heights have no digits.
    pub fn cut_to(&mut self, surface: &Surface<'_, T>, range: [T; 2]) {
        let (piece, half) = (surface.piece(self.piece), T::of(0.5));
        let middle = half * piece.k[0] + half * piece.k[1];
        let CurvePoint { x, dx, .. } = piece.curve.at(middle);
        self.k = range.map(|end| middle + (end - x) / dx);
        self.ends = self.k.map(|k| row(piece.curve.at(k)));
    }

    /// Returns the panel with the cubic between its ends, if the slopes that the curve gives by x
    /// show that its pieces are cubics.
    pub fn settled(&self, surface: &Surface<'_, T>) -> Option<Self> {
        let mut pieces = (self.piece..=self.last).map(|index| surface.piece(index));
        if !pieces.all(|piece| is_cubic(&piece)) {
            return None;
        }
        let mut settled = Self { is_sampled: true, doubt: T::zero(), ..*self };
        settled.set_doubts(surface, true);
        Some(settled)
    }

    /// Returns the parts of a run.
    pub fn parts(&self, surface: &Surface<'_, T>) -> impl Iterator<Item = Self> {
        let count = (self.last - self.piece + 1).div_ceil(RUN_PARTS);
        (self.piece..=self.last).step_by(count).map(move |first| {
            let part = Self::of_pieces(surface, [first, (first + count - 1).min(self.last)]);
            let mut part = Self { before: self.doubt, ..part };
            if self.is_sampled && !part.is_sampled {
                part.is_sampled = true;
                part.set_doubts(surface, true);
            }
            part
        })
    }

    /// Sets the uncertainties of the heights and of the slopes of the cubic between both ends,
    /// given whether the pieces are cubics. A slope that is off by e at the end of a piece may
    /// stand for a curvature `e/w` in the piece; over the whole run, of a width W, the same
    /// curvature makes a slope uncertain by `e W/w`.
    fn set_doubts(&mut self, surface: &Surface<'_, T>, are_cubics: bool) {
        let zero = T::zero();
        let [start, end] = self.ends;
        let cubic = Segment::exact([start.x, start.y], [end.x, end.y], [start.slope, end.slope]);
        let (mut heights, mut slopes, mut bulges) = (zero, zero, zero);
        for index in (self.piece..=self.last).filter(|_| self.is_run()) {
            let ends = surface.piece(index).ends.map(row);
            let width = ends[1].x - ends[0].x;
            let off = ends.map(|end| {
                let [y, slope] = cubic.at((end.x - start.x) / cubic.width);
                let rounding = T::of(ROUNDING) * T::epsilon();
                let beyond = |by: T, size: T| if by <= rounding * size { zero } else { by };
                let rise = (slope * (end.x - start.x)).abs();
                let height = beyond((end.y - y).abs(), end.y.abs() + start.y.abs() + rise);
                let steep = slope.abs() + (end.y.abs() + rise) / width;
                [height, beyond((end.slope - slope).abs(), steep)]
            });
            let [[d0, e0], [d1, e1]] = off;
            heights = larger(heights, d0.max(d1) + T::of(CUBIC_RISE) * width * (e0 + e1));
            slopes = larger(slopes, e0.max(e1) * (cubic.width / width));
            bulges = larger(bulges, if are_cubics { zero } else { bulge(&ends) });
        }
        self.doubt = heights + bulges;
        self.ends.iter_mut().for_each(|end| end.doubt = slopes);
    }
}

/// Returns the larger of two numbers; infinity if the second one is not finite.
fn larger<T: Real>(most: T, value: T) -> T {
    if value.is_finite() { most.max(value) } else { T::one() / T::zero() }
}

/// Tells whether a piece is known by its ends: it is straight, or endless.
fn is_known<T: Real>(piece: &Piece<'_, T>) -> bool {
    let [from, to] = piece.x();
    let is_endless = T::max_value().is_some_and(|most| to - from > T::of(0.125) * most);
    is_endless || piece.curve.convexity() == Convexity::Straight
}

/// Returns the approximate distance of the cubic between two ends from the line through both.
fn bulge<T: Real>([start, end]: &[BodyPoint<T>; 2]) -> T {
    let size = (end.slope - start.slope).abs() * (end.x - start.x);
    if size.is_finite() { size } else { (end.y - start.y).abs() }
}

/// Tells whether the slopes of a piece, where the curve gives them by x, agree with the cubic
/// between its ends.
fn is_cubic<T: Real>(piece: &Piece<'_, T>) -> bool {
    let [start, end] = piece.ends.map(row);
    let segment = Segment::exact([start.x, start.y], [end.x, end.y], [start.slope, end.slope]);
    let size = start.slope.abs() + end.slope.abs() + segment.chord.abs();
    let rounding =
        T::of(ROUNDING) * T::epsilon() * (size + (start.y.abs() + end.y.abs()) / segment.width);
    CUBIC_PLACES.iter().all(|&share| {
        let slope = segment.at(T::of(share))[1];
        let given = piece.curve.slope_at(start.x + T::of(share) * segment.width);
        given.is_some_and(|given| (given - slope).abs() <= rounding)
    })
}
