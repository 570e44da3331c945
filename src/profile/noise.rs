//! The noise of a curve: what the rounding of its formula leaves of it.

use crate::{CurvePoint, ParametricProfile, Real};

/// Points by which the noise over one way is measured.
const POINTS: usize = 12;

/// The ways over which it is measured, as powers of the rounding unit: a third difference over any of them is
/// less than rounding. Over the shortest all values may be rounded alike, as those of a cosine at 0.
const WAYS: [f64; 3] = [1.0 / 2.0, 5.0 / 12.0, 1.0 / 3.0];

/// How far values of `X` and `Y` may be off, by about three standard deviations: lengths.
#[derive(Clone, Copy)]
pub(crate) struct Noise<T> {
    pub x: T,
    pub y: T,
}

impl<T: Real> Noise<T> {
    /// Measures the noise near a parameter of a curve that is smooth between two, as the largest over several short
    /// ways.
    pub fn near(
        curve: &dyn ParametricProfile<T>,
        ends: [T; 2],
        k: T,
        evaluations: &mut usize,
    ) -> Self {
        let nothing = Self { x: T::zero(), y: T::zero() };
        *evaluations += WAYS.len() * POINTS;
        let shares = WAYS.map(|power| T::epsilon().powf(T::of(power)));
        shares.iter().fold(nothing, |noise, &share| noise.max(Self::over(curve, ends, k, share)))
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
    fn over(curve: &dyn ParametricProfile<T>, [one, other]: [T; 2], k: T, share: T) -> Self {
        let [from, to] = [one.min(other), one.max(other)];
        let width = share * (to - from);
        let start = (k - T::of(0.5) * width).min(to - width).max(from);
        // Unevenly, as multiples of one step may all be rounded alike.
        let share = |i: usize| T::count(i) * T::count(i).sqrt();
        let places: [T; POINTS] =
            std::array::from_fn(|i| start + width * (share(i) / share(POINTS)));
        let zero = T::zero();
        let mut points = [CurvePoint { x: zero, y: zero, dx: zero, dy: zero }; POINTS];
        curve.at_many(&places, &mut points);
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
            let median = sizes[sizes.len() / 2];
            if median.is_finite() { median } else { zero }
        };
        Self { x: size(|point| point.x), y: size(|point| point.y) }
    }
}
