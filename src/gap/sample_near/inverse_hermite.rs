//! The parameter as a function of x, from two known points.

use super::CurveSample;
use crate::Real;

/// Parameter as a function of x from two samples: the cubic `k(x)` through both with their slopes,
/// or, where it is not monotone, the slope at the nearer one.
pub(super) struct InverseHermite<'k, T> {
    left: &'k CurveSample<T>,
    right: &'k CurveSample<T>,
    /// Reciprocal of the distance.
    share: T,
    /// Coefficients of the cubic in the share of the way, without the constant.
    cubic: Option<[T; 3]>,
}

impl<'k, T: Real> InverseHermite<'k, T> {
    pub fn new(left: &'k CurveSample<T>, right: &'k CurveSample<T>) -> Self {
        let (width, rise) = (right.x - left.x, right.k - left.k);
        let (at_left, at_right) = (width / left.dx, width / right.dx);
        let three = T::of(3.0) * rise.abs();
        let even = |slope: T| slope * rise > T::zero() && slope.abs() <= three;
        let cubic = (even(at_left) && even(at_right)).then(|| {
            let (twice, sum) = (rise + rise, at_left + at_right);
            [at_left, rise + twice - at_left - sum, sum - twice]
        });
        Self { left, right, share: T::one() / width, cubic }
    }

    /// Returns the parameter at x, which is between two other samples, or the same.
    #[inline(always)]
    pub fn parameter(&self, x: T, one: &CurveSample<T>, other: &CurveSample<T>) -> T {
        let along = (x - self.left.x) * self.share;
        let k = match self.cubic {
            Some([first, second, third]) => {
                self.left.k + along * (first + along * (second + along * third))
            }
            None => {
                let nearer = if along < T::of(0.5) { self.left } else { self.right };
                nearer.k + (x - nearer.x) / nearer.dx
            }
        };
        if is_between(k, one.k, other.k) {
            return k;
        }
        let share = (x - one.x) / (other.x - one.x);
        if share.is_finite() { one.k + share * (other.k - one.k) } else { one.k }
    }
}

/// Takes a step of Newton's rule from the nearer of two points, kept between them.
pub(super) fn newton<T: Real>(left: CurveSample<T>, right: CurveSample<T>, target: T) -> T {
    let nearer = if target - left.x < right.x - target { left } else { right };
    let k = nearer.k + (target - nearer.x) / nearer.dx;
    if is_between(k, left.k, right.k) { k } else { T::of(0.5) * left.k + T::of(0.5) * right.k }
}

pub(super) fn is_between<T: Real>(k: T, one: T, other: T) -> bool {
    (k - one) * (other - k) > T::zero()
}
