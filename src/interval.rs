//! The contact as an interval of x.

use crate::real::same;
use crate::{Real, Side};
use std::fmt::{Display, Formatter, LowerExp, Result};
use std::ops::Index;

/// Interval `[left, right]` of `x`: the contact `[-b, a]`, or a trial of it.
///
/// ```
/// use linecontact::Interval;
///
/// let on = Interval { left: -0.2f64, right: 0.4 };
/// assert_eq!(on.to_string(), "[-0.2, 0.4]");
/// assert!((on.half_width() - 0.3).abs() < 1e-15 && (on.centre() - 0.1).abs() < 1e-15);
/// assert!((on.chebyshev_weight(0.1) - 0.3).abs() < 1e-15);
/// assert!((on.at_angle(std::f64::consts::PI / 3.0) - 0.25).abs() < 1e-15); // c + L/2
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Interval<T> {
    /// Left end, `-b`.
    pub left: T,
    /// Right end, `a`.
    pub right: T,
}

impl<T: Real> Interval<T> {
    /// Returns the interval without derivatives, as an initial guess.
    pub(crate) fn plain(&self) -> Self {
        Self { left: self.left.component(0), right: self.right.component(0) }
    }

    /// Tells whether two intervals agree in all components of their limits.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        same(self.left, other.left) && same(self.right, other.right)
    }

    /// Returns the half-width `L = (a + b)/2`.
    pub fn half_width(&self) -> T {
        T::of(0.5) * (self.right - self.left)
    }

    /// Returns the centre `c = (a - b)/2`.
    pub fn centre(&self) -> T {
        T::of(0.5) * self.left + T::of(0.5) * self.right
    }

    /// Tells whether `x` lies strictly inside.
    pub fn contains(&self, x: T) -> bool {
        x > self.left && x < self.right
    }

    /// Finds, in intervals from left to right, the number of the first that ends beyond `x`, and
    /// the interval that contains `x`.
    pub(crate) fn find(all: &[Self], x: T) -> (usize, Option<Self>) {
        let first = all.partition_point(|on| on.right <= x);
        (first, all.get(first).copied().filter(|on| on.contains(x)))
    }

    /// Returns `sqrt((x + b)(a - x))`, computed from the distances to the two ends so that it keeps
    /// its relative accuracy next to either.
    pub fn chebyshev_weight(&self, x: T) -> T {
        // As shares of the width, so that the roots do not depend on the unit.
        let width = self.right - self.left;
        width * (((x - self.left) / width).sqrt() * ((self.right - x) / width).sqrt())
    }

    /// Returns the angle θ of `x = c + L cos θ`, from 0 at `a` to π at `-b`.
    pub fn angle(&self, x: T) -> T {
        T::of(2.0) * (self.right - x).sqrt().atan2((x - self.left).sqrt())
    }

    /// Returns the point at the angle θ, measured from the nearer end.
    pub fn at_angle(&self, theta: T) -> T {
        let half = T::of(0.5) * theta;
        let width = self.right - self.left;
        if half < T::frac_pi_4() {
            self.right - width * half.sin().powi(2)
        } else {
            self.left + width * half.cos().powi(2)
        }
    }
}

/// Returns the limit on one side.
impl<T> Index<Side> for Interval<T> {
    type Output = T;

    fn index(&self, side: Side) -> &T {
        match side {
            Side::Left => &self.left,
            Side::Right => &self.right,
        }
    }
}

macro_rules! shown {
    ($($format:ident)*) => {$(
        /// Writes `[left, right]`; a precision applies to both ends.
        impl<T: $format> $format for Interval<T> {
            fn fmt(&self, f: &mut Formatter<'_>) -> Result {
                f.write_str("[")?;
                self.left.fmt(f)?;
                f.write_str(", ")?;
                self.right.fmt(f)?;
                f.write_str("]")
            }
        }
    )*};
}
shown! { Display LowerExp }
