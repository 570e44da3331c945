//! Two straight flanks.

use super::angles::{Angle, jump};
use super::{ClosedForm, ReferenceError, positive};
use crate::{Interval, Real};

/// Wedge that touches at its tip, x = 0, with the slopes -m₁ on the left and m₂ on the right. At
/// the tip the pressure is infinite like a logarithm.
///
/// The condition at the edges puts the tip at the angle `φ = π m₁/(m₁ + m₂)`. With Λ of the
/// [module](super),
///
/// ```text
/// a = L (1 - cos φ),   b = L (1 + cos φ)
/// F = κ L (m₁ + m₂) sin φ/π,   P = κ (m₁ + m₂)/π² Λ(x, 0)
/// ```
///
/// and with one slope m, `F = 2 κ m L/π` and `P = 2 κ m/π² arcosh(L/abs(x))` (Johnson, §5.2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wedge<T> {
    left: T,
    right: T,
    half_width: T,
    tip: Angle<T>,
}

impl<T: Real> Wedge<T> {
    /// Creates the form from the slope m on both sides and the half-width L.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if either is not positive and finite.
    pub fn new(slope: T, half_width: T) -> Result<Self, ReferenceError<T>> {
        Self::unequal(slope, slope, half_width)
    }

    /// Creates the form from m₁ on the left, m₂ on the right, and the half-width L.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if one of them is not positive and finite.
    pub fn unequal(left: T, right: T, half_width: T) -> Result<Self, ReferenceError<T>> {
        positive([("the slope on the left", left), ("the slope on the right", right)])?;
        positive([("the half-width", half_width)])?;
        let share = |slope: T| (T::frac_pi_2() * (slope / (left + right))).sin();
        let tip = Angle { sin: share(left), cos: share(right) };
        Ok(Self { left, right, half_width, tip })
    }

    /// Creates the form from m₁ on the left, m₂ on the right, and the load F.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if one of them is not positive and finite.
    pub fn under_load(left: T, right: T, load: T, kappa: T) -> Result<Self, ReferenceError<T>> {
        let unit = Self::unequal(left, right, T::one())?;
        positive([("the load", load), ("κ", kappa)])?;
        Self::unequal(left, right, load / unit.load(kappa))
    }
}

impl<T: Real> ClosedForm<T> for Wedge<T> {
    fn limits(&self) -> Interval<T> {
        let width = T::of(2.0) * self.half_width;
        Interval { left: -width * self.tip.cos.powi(2), right: width * self.tip.sin.powi(2) }
    }

    fn load(&self, kappa: T) -> T {
        kappa * (self.left + self.right) * self.half_width * self.tip.sine() / T::pi()
    }

    fn pressure(&self, x: T, kappa: T) -> T {
        let Some(theta) = Angle::inside(self.limits(), x) else { return T::zero() };
        let log = jump(theta, self.tip, x / self.half_width);
        kappa * (self.left + self.right) / T::pi().powi(2) * log
    }

    fn height(&self, x: T) -> T {
        if x < T::zero() { -self.left * x } else { self.right * x }
    }

    fn slope(&self, x: T) -> T {
        if x < T::zero() { -self.left } else { self.right }
    }

    fn slope_left(&self, x: T) -> T {
        if x > T::zero() { self.right } else { -self.left }
    }

    fn breakpoints(&self) -> Vec<T> {
        vec![T::zero()]
    }
}
