//! A flat with rounded edges.

use super::angles::{Angle, bend};
use super::{ClosedForm, ReferenceError, centred, check, positive};
use crate::numerics::special_functions::{convex_root, minus_atan, minus_sin};
use crate::{Interval, Real};

/// Punch that is flat for abs(x) ≤ d, with the parabola `(abs(x) - d)²/(2R)` on either side
/// (Ciavarella, Hills and Monno, *Proc. Instn Mech. Engrs C* 212, 1998, 319).
///
/// ```text
/// F = κ L²/(π R) (φ - sin φ cos φ),   cos φ = d/L
/// P = κ/(π² R) [ (x - d) Λ(x, d) - (x + d) Λ(x, -d) + 2 φ sqrt(L² - x²) ]
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoundedPunch<T> {
    flat: T,
    radius: T,
    half_width: T,
    end: Angle<T>,
}

impl<T: Real> RoundedPunch<T> {
    /// Creates the form from the half-width d of the flat part, the radius R of its edges and the
    /// half-width L of the contact.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if one of them is not positive and finite, or L is not more
    /// than d.
    pub fn new(flat: T, radius: T, half_width: T) -> Result<Self, ReferenceError<T>> {
        positive([("the half-width of the flat part", flat), ("the radius", radius)])?;
        check("the half-width", half_width, half_width > flat, "more than that of the flat part")?;
        let end = Angle::of(centred(half_width), flat);
        Ok(Self { flat, radius, half_width, end })
    }

    /// Creates the form from the half-width d of the flat part, the radius R and the load F. It
    /// solves, by Newton's method, `(1 + τ²) atan τ - τ = π R F/(κ d²)` for τ = tan φ.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if one of them is not positive and finite, or the load is so
    /// small that the contact cannot be told from the flat part.
    pub fn under_load(flat: T, radius: T, load: T, kappa: T) -> Result<Self, ReferenceError<T>> {
        positive([("the half-width of the flat part", flat), ("the radius", radius)])?;
        positive([("the load", load), ("κ", kappa)])?;
        let (one, two) = (T::one(), T::of(2.0));
        let wanted = T::pi() * (radius / flat) * (load / kappa / flat);
        // Behaves like 2/3 τ³ for small τ, like π/2 τ² for large τ.
        let start = (wanted * T::of(1.5)).cbrt().max((wanted / T::frac_pi_2()).sqrt());
        let tau = convex_root(start, |tau| {
            let value = tau * tau * tau.atan() - minus_atan(tau) - wanted;
            [value, two * tau * tau.atan()]
        });
        let secant = (one + tau * tau).sqrt();
        let half_width = flat * secant;
        check("the load", load, half_width > flat, "enough to bring an edge into contact")?;
        // By τ, as L - d has fewer digits.
        let cos = ((one + secant) / (two * secant)).sqrt();
        let end = Angle { sin: tau / (two * secant * cos), cos };
        Ok(Self { flat, radius, half_width, end })
    }
}

impl<T: Real> ClosedForm<T> for RoundedPunch<T> {
    fn limits(&self) -> Interval<T> {
        centred(self.half_width)
    }

    fn load(&self, kappa: T) -> T {
        // 2φ - sin 2φ = 2 (φ - sin φ cos φ)
        let part = T::of(0.5) * minus_sin(T::of(2.0) * self.end.angle());
        kappa * self.half_width * (self.half_width / self.radius) * part / T::pi()
    }

    fn pressure(&self, x: T, kappa: T) -> T {
        let (l, phi) = (self.half_width, self.end.angle());
        let Some(theta) = Angle::inside(self.limits(), x) else { return T::zero() };
        let right = bend(theta, self.end, phi, (x - self.flat) / l);
        let left = bend(theta.mirrored(), self.end, phi, (-x - self.flat) / l);
        kappa / T::pi().powi(2) * (l / self.radius) * (right + left)
    }

    fn height(&self, x: T) -> T {
        let beyond = (x.abs() - self.flat).max(T::zero());
        T::of(0.5) * beyond * (beyond / self.radius)
    }

    fn slope(&self, x: T) -> T {
        let beyond = (x.abs() - self.flat).max(T::zero()) / self.radius;
        if x < T::zero() { -beyond } else { beyond }
    }

    fn breakpoints(&self) -> Vec<T> {
        vec![-self.flat, self.flat]
    }
}
