//! Angles of a contact, and the pressures of a jump and of a bend of the slope.
//!
//! For κ = π² and L = 1: the pressure at θ of a jump or a bend at φ, by the two representations in
//! the documentation of the module above.

use super::outside;
use crate::numerics::special_functions::{artanh_minus, minus_atan};
use crate::{Interval, Real};

/// Sine and cosine of θ/2, with `x = c + L cos θ`: the square roots of the distances of x from the
/// two limits, each with all its digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Angle<T> {
    pub sin: T,
    pub cos: T,
}

impl<T: Real> Angle<T> {
    pub fn of(limits: Interval<T>, x: T) -> Self {
        let width = limits.right - limits.left;
        let root = |distance: T| (distance / width).sqrt();
        Self { sin: root(limits.right - x), cos: root(x - limits.left) }
    }

    /// Returns the sine and cosine at x inside the limits, `None` outside.
    pub fn inside(limits: Interval<T>, x: T) -> Option<Self> {
        (!outside(limits, x)).then(|| Self::of(limits, x))
    }

    /// Returns the angle π - θ.
    pub fn mirrored(self) -> Self {
        Self { sin: self.cos, cos: self.sin }
    }

    pub fn angle(self) -> T {
        T::of(2.0) * self.sin.atan2(self.cos)
    }

    /// Returns sin θ.
    pub fn sine(self) -> T {
        T::of(2.0) * self.sin * self.cos
    }
}

/// Returns Λ, the pressure of a slope that jumps by one at φ. `offset` is cos θ - cos φ, which only
/// the caller knows to all digits.
pub(super) fn jump<T: Real>(theta: Angle<T>, phi: Angle<T>, offset: T) -> T {
    // sin((θ + φ)/2)/sin((θ - φ)/2) = (m + n)/(m - n), and m² - n² = offset/2.
    let (m, n) = (phi.sin * theta.cos, theta.sin * phi.cos);
    T::of(2.0) * (m.min(n) / (T::of(0.5) * offset.abs()).sqrt()).asinh()
}

/// Returns `offset Λ + φ sin θ`, the pressure of a slope that is level up to φ and rises by one
/// from there to θ = 0. It is positive; φ is also given as the number `angle`.
pub(super) fn bend<T: Real>(theta: Angle<T>, phi: Angle<T>, angle: T, offset: T) -> T {
    let [two, four] = [2.0, 4.0].map(T::of);
    if offset == T::zero() {
        return angle * theta.sine();
    }
    let log = jump(theta, phi, offset);
    if offset > T::zero() || phi.sin >= phi.cos {
        return offset * log + angle * theta.sine();
    }
    // Beside a short bend the two terms all but cancel. With u = tan(φ/2), z = u/tan(θ/2), φ = 2 (u
    // - (u - atan u)), Λ = 2 (z + (artanh z - z)), the terms linear in u cancel exactly.
    let u = phi.sin / phi.cos;
    let cotangent = theta.cos / theta.sin;
    let z = u * cotangent;
    let rest = if z <= T::of(0.5) { artanh_minus(z) } else { T::of(0.5) * log - z };
    four * u * phi.sin * phi.sin * cotangent - two * minus_atan(u) * theta.sine()
        + two * offset * rest
}
