//! Parabola with different radii on its two sides.

use super::angles::{Angle, bend};
use super::{ClosedForm, ReferenceError, positive};
use crate::numerics::special_functions::{convex_root, minus_sin, sin_minus_cos};
use crate::{Interval, Real};

/// Body `x²/(2R)` with one radius R₁ for x < 0 and another, R₂, for x > 0, touching at x = 0: in
/// closed form except for the angle φ of x = 0, which depends on the radii alone.
///
/// ```text
/// R₁ (sin φ - φ cos φ) = R₂ (sin φ₁ - φ₁ cos φ₁),   φ₁ = π - φ
/// a = L (1 - cos φ),   b = L (1 + cos φ)
/// F = κ L²/(2π) [ (φ - sin φ cos φ)/R₂ + (φ₁ - sin φ₁ cos φ₁)/R₁ ]
/// P = κ/π² [ sqrt((a - x)(x + b)) (φ/R₂ + φ₁/R₁) + x Λ(x, 0) (1/R₂ - 1/R₁) ]
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnequalRadii<T> {
    left: T,
    right: T,
    half_width: T,
    /// φ₁ and φ.
    angles: [T; 2],
    tip: Angle<T>,
}

impl<T: Real> UnequalRadii<T> {
    /// Creates the form from R₁ on the left, R₂ on the right, and the half-width L.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if one of them is not positive and finite.
    pub fn new(left: T, right: T, half_width: T) -> Result<Self, ReferenceError<T>> {
        positive([("the radius on the left", left), ("the radius on the right", right)])?;
        positive([("the half-width", half_width)])?;
        let smaller = smaller_angle(left.min(right) / left.max(right));
        let larger = T::pi() - smaller;
        let (sin, cos) = (T::of(0.5) * smaller).sin_cos();
        let (angles, tip) = if right < left {
            ([larger, smaller], Angle { sin, cos })
        } else {
            ([smaller, larger], Angle { sin: cos, cos: sin })
        };
        Ok(Self { left, right, half_width, angles, tip })
    }

    /// Creates the form from R₁ on the left, R₂ on the right, and the load F.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if one of them is not positive and finite.
    pub fn under_load(left: T, right: T, load: T, kappa: T) -> Result<Self, ReferenceError<T>> {
        let scale = left.min(right);
        let unit = Self::new(left, right, scale)?;
        positive([("the load", load), ("κ", kappa)])?;
        Self::new(left, right, scale * (load / unit.load(kappa)).sqrt())
    }
}

/// Returns φ ≤ π/2 with `h(φ) = r h(π - φ)`, `h = sin φ - φ cos φ`, r ≤ 1.
fn smaller_angle<T: Real>(ratio: T) -> T {
    let other = |phi: T| T::pi() - phi;
    let start = (T::of(3.0) * T::pi() * ratio).cbrt().min(T::frac_pi_2());
    convex_root(start, |phi| {
        let value = sin_minus_cos(phi) - ratio * sin_minus_cos(other(phi));
        [value, phi.sin() * (phi + ratio * other(phi))]
    })
}

impl<T: Real> ClosedForm<T> for UnequalRadii<T> {
    fn limits(&self) -> Interval<T> {
        let width = T::of(2.0) * self.half_width;
        Interval { left: -width * self.tip.cos.powi(2), right: width * self.tip.sin.powi(2) }
    }

    fn load(&self, kappa: T) -> T {
        let l = self.half_width;
        let part = |angle: T, radius: T| l / radius * minus_sin(T::of(2.0) * angle);
        let parts = part(self.angles[0], self.left) + part(self.angles[1], self.right);
        kappa * l * parts / (T::of(4.0) * T::pi())
    }

    fn pressure(&self, x: T, kappa: T) -> T {
        let l = self.half_width;
        let Some(theta) = Angle::inside(self.limits(), x) else { return T::zero() };
        let right = bend(theta, self.tip, self.angles[1], x / l);
        let left = bend(theta.mirrored(), self.tip.mirrored(), self.angles[0], -x / l);
        kappa / T::pi().powi(2) * (right * (l / self.right) + left * (l / self.left))
    }

    fn height(&self, x: T) -> T {
        T::of(0.5) * x * self.slope(x)
    }

    fn slope(&self, x: T) -> T {
        x / if x < T::zero() { self.left } else { self.right }
    }

    fn breakpoints(&self) -> Vec<T> {
        vec![T::zero()]
    }
}
