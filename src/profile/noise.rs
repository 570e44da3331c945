//! The noise of a curve: what the rounding of its formula leaves of it.

use super::{CurvePoint, Piece};
use crate::Real;

/// Points by which the noise over one way is measured.
const POINTS: usize = 12;

/// The ways over which it is measured, as powers of the rounding unit: a third difference over any of them is
/// less than rounding. Over the shortest all values may be rounded alike, as those of a cosine at 0.
const SHORTEST: f64 = 1.0 / 2.0;
const LONGER: [f64; 2] = [5.0 / 12.0, 1.0 / 3.0];

/// How far values of `X` and `Y` may be off, by about three standard deviations: lengths.
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Noise<T> {
    pub x: T,
    pub y: T,
}

impl<T: Real> Noise<T> {
    pub fn nothing() -> Self {
        Self { x: T::zero(), y: T::zero() }
    }

    /// Measures the noise near a parameter of a piece.
    pub fn near(piece: &Piece<'_, T>, k: T, evaluations: &mut usize) -> Self {
        Self::over(piece, k, SHORTEST, evaluations)
    }

    /// The same more thoroughly, as the largest over several ways. A curve that is another when it is asked again
    /// has none: that is a fault, and no rounding.
    pub fn of_rounding(piece: &Piece<'_, T>, k: T, evaluations: &mut usize) -> Self {
        let mut over = |power| Self::over(piece, k, power, evaluations);
        let [noise, again] = [over(SHORTEST), over(SHORTEST)];
        if noise != again {
            return Self::nothing();
        }
        LONGER.into_iter().fold(noise, |noise, power| noise.max(over(power)))
    }

    /// How far the height at an x may be off where the curve has this slope, which may be infinite at an end.
    pub fn of_height(self, slope: T) -> T {
        if slope.is_finite() { self.y + self.x * slope.abs() } else { self.y }
    }

    /// The larger of each.
    pub fn max(self, other: Self) -> Self {
        Self { x: self.x.max(other.x), y: self.y.max(other.y) }
    }

    /// Measures it over a share of the curve, as the median of divided third differences. Of what is smooth they are
    /// nothing over so short a way, and an undeclared kink is in three of them.
    fn over(piece: &Piece<'_, T>, k: T, power: f64, evaluations: &mut usize) -> Self {
        let [from, to] = [piece.k[0].min(piece.k[1]), piece.k[0].max(piece.k[1])];
        let width = T::epsilon().powf(T::of(power)) * (to - from);
        let start = (k - T::of(0.5) * width).min(to - width).max(from);
        // Unevenly, as multiples of one step may all be rounded alike.
        let share = |i: usize| T::count(i) * T::count(i).sqrt();
        let places: [T; POINTS] =
            std::array::from_fn(|i| start + width * (share(i) / share(POINTS)));
        let zero = T::zero();
        let mut points = [CurvePoint { x: zero, y: zero, dx: zero, dy: zero }; POINTS];
        piece.curve.at_many(&places, &mut points);
        *evaluations += POINTS;
        let size = |of: fn(&CurvePoint<T>) -> T| {
            let mut sizes: [T; POINTS - 3] = std::array::from_fn(|first| {
                let (mut sum, mut weights) = (zero, zero);
                for i in first..first + 4 {
                    let others = (first..first + 4).filter(|&j| j != i);
                    let product = others.fold(T::one(), |all, j| all * (share(i) - share(j)));
                    sum += (of(&points[i]) - of(&points[first])).component(0) / product;
                    weights += product.abs().recip();
                }
                // As of even steps, whose weights are 1, 3, 3 and 1.
                T::of(8.0) * (sum / weights).abs()
            });
            sizes.sort_by(|one, other| one.partial_cmp(other).unwrap_or(std::cmp::Ordering::Equal));
            let fourth = sizes[sizes.len() - 4];
            if fourth.is_finite() { fourth } else { zero }
        };
        Self { x: size(|point| point.x), y: size(|point| point.y) }
    }
}
