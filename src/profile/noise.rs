//! The noise of a curve: the rounding of its formula, as a length.

use super::{CurvePoint, Piece};
use crate::Real;
use crate::numerics::ascending;

/// Lengths over which the noise is measured, as shares of a piece: powers of the rounding unit.
/// Over the shortest all values may be rounded alike, as those of a cosine at 0.
const SHORTEST: f64 = 1.0 / 2.0;
const LONGER: [f64; 3] = [5.0 / 12.0, 1.0 / 3.0, 1.0 / 4.0];

/// Order of divided differences, and the factor from their median, each divided by the sum of its
/// weights, to about three standard deviations. (With even steps third differences have the weights
/// 1, 3, 3 and 1.)
const THIRD: (usize, f64) = (3, 8.0);
const FIFTH: (usize, f64) = (5, 9.0);

/// Errors of `X` and `Y`, about three standard deviations: lengths.
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Noise<T> {
    pub x: T,
    pub y: T,
}

impl<T: Real> Noise<T> {
    /// Returns zero noise.
    pub fn zero_tolerance() -> Self {
        Self { x: T::zero(), y: T::zero() }
    }

    /// Measures the noise near a parameter of a piece.
    pub fn near(piece: &Piece<'_, T>, k: T, evaluations: &mut usize) -> Self {
        Self::over::<12>(piece, k, SHORTEST, THIRD, evaluations)
    }

    /// Measures the noise more thoroughly, as the largest over several lengths. Returns `None` for
    /// a curve that gives other values at a second call, or whose noise is too large for rounding:
    /// both are faults.
    pub fn of_rounding(piece: &Piece<'_, T>, k: T, evaluations: &mut usize) -> Option<Self> {
        let mut over = |power| Self::over::<16>(piece, k, power, FIFTH, evaluations);
        let [noise, again] = [over(SHORTEST), over(SHORTEST)];
        if noise != again {
            return None;
        }
        let noise = LONGER.into_iter().fold(noise, |noise, power| noise.max(over(power)));
        let sizes = piece.ends.iter().flat_map(|end| [end.x.abs(), end.y.abs()]);
        let size = sizes.filter(|size| size.is_finite()).fold(T::zero(), T::max);
        (noise.x.max(noise.y) <= T::epsilon().cbrt() * size).then_some(noise)
    }

    /// Returns the error of the height at a given x, for a slope that may be infinite at an end.
    pub fn of_height(self, slope: T) -> T {
        if slope.is_finite() { self.y + self.x * slope.abs() } else { self.y }
    }

    /// Returns the larger errors of two, in each coordinate.
    pub fn max(self, other: Self) -> Self {
        Self { x: self.x.max(other.x), y: self.y.max(other.y) }
    }

    /// Measures the noise over a share of a piece, as the median of divided differences. Over such
    /// a short length they vanish for a smooth curve, and an undeclared kink or step affects fewer
    /// than half of them.
    fn over<const POINTS: usize>(
        piece: &Piece<'_, T>,
        k: T,
        power: f64,
        (order, scale): (usize, f64),
        evaluations: &mut usize,
    ) -> Self {
        let [from, to] = [piece.k[0].min(piece.k[1]), piece.k[0].max(piece.k[1])];
        let width = T::epsilon().powf(T::of(power)) * (to - from);
        let start = (k - T::of(0.5) * width).min(to - width).max(from);
        // The steps are uneven, as the multiples of one step may all be rounded alike.
        let share = |i: usize| T::count(i) * T::count(i).sqrt();
        let places: [T; POINTS] =
            std::array::from_fn(|i| start + width * (share(i) / share(POINTS)));
        let zero = T::zero();
        let mut points = [CurvePoint { x: zero, y: zero, dx: zero, dy: zero }; POINTS];
        piece.curve.at_many(&places, &mut points);
        *evaluations += POINTS;
        let size = |of: fn(&CurvePoint<T>) -> T| {
            let mut sizes = [zero; POINTS];
            for (first, size) in sizes[order..].iter_mut().enumerate() {
                let (mut sum, mut weights) = (zero, zero);
                for i in first..=first + order {
                    let others = (first..=first + order).filter(|&j| j != i);
                    let product = others.fold(T::one(), |all, j| all * (share(i) - share(j)));
                    sum += (of(&points[i]) - of(&points[first])).component(0) / product;
                    weights += product.abs().recip();
                }
                *size = T::of(scale) * (sum / weights).abs();
            }
            sizes.sort_by(ascending);
            let median = sizes[order + (POINTS - order) / 2];
            if median.is_finite() { median } else { zero }
        };
        Self { x: size(|point| point.x), y: size(|point| point.y) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Curve;
    use std::sync::atomic::{AtomicU32, Ordering};

    /// A change between calls is not rounding, however small.
    #[test]
    fn a_curve_that_changes_between_calls_has_no_noise_of_rounding() {
        let calls = AtomicU32::new(0);
        for change in [0.0, 1e-9] {
            let body = Curve::new([-1.0f64, 1.0], |k: f64| {
                let moved = change * f64::from(calls.fetch_add(1, Ordering::Relaxed) % 7);
                CurvePoint { x: k, y: k * k + moved, dx: 1.0, dy: 2.0 * k }
            });
            let piece = Piece::new(&body).unwrap();
            assert_eq!(Noise::of_rounding(&piece, 0.3, &mut 0).is_some(), change < 1e-12);
        }
    }
}
