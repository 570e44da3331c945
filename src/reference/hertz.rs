//! The parabola of Hertz.

use super::{ClosedForm, ReferenceError, centred, positive, root_inside};
use crate::numerics::special_functions::sinh_minus;
use crate::{Interval, Real};

/// Contact of the parabola `x²/(2R)` by Hertz (Johnson, Eqs. 4.43 to 4.45).
///
/// ```text
/// F = κ L²/(2R),   P = κ/(π R) sqrt(L² - x²)
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hertz<T> {
    radius: T,
    half_width: T,
}

impl<T: Real> Hertz<T> {
    /// Creates the form from the radius of curvature R and the half-width L.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if either is not positive and finite.
    pub fn new(radius: T, half_width: T) -> Result<Self, ReferenceError<T>> {
        positive([("the radius", radius), ("the half-width", half_width)])?;
        Ok(Self { radius, half_width })
    }

    /// Creates the form from the radius of curvature R and the load F.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if one of them is not positive and finite.
    pub fn under_load(radius: T, load: T, kappa: T) -> Result<Self, ReferenceError<T>> {
        positive([("the radius", radius), ("the load", load), ("κ", kappa)])?;
        Self::new(radius, (T::of(2.0) * (load / kappa)).sqrt() * radius.sqrt())
    }

    /// Returns the gap between the loaded bodies at x, zero in the contact. Its slope outside is
    /// `g - W/κ = sqrt(x² - L²)/R`, with `W = ∫ P ds/(x - s)`, so that
    ///
    /// ```text
    /// gap = (x sqrt(x² - L²) - L² arcosh(x/L))/(2R) = L²/(4R) (sinh 2u - 2u),   x = ±L cosh u
    /// ```
    pub fn gap(&self, x: T) -> T {
        let l = self.half_width;
        if x.abs() < l {
            return T::zero();
        }
        // cosh u - 1 = 2 sinh²(u/2)
        let beyond = (x.abs() - l) / l;
        let u = T::of(2.0) * (T::of(0.5) * beyond).sqrt().asinh();
        let half = T::of(0.5);
        if u > T::of(18.0) {
            // The limit for large u, where sinh might overflow.
            let (ratio, x) = (l / x, x.abs());
            return half * x * (x / self.radius) * (T::one() - (u + half) * ratio * ratio);
        }
        l * (l / self.radius) * T::of(0.25) * sinh_minus(T::of(2.0) * u)
    }
}

impl<T: Real> ClosedForm<T> for Hertz<T> {
    fn limits(&self) -> Interval<T> {
        centred(self.half_width)
    }

    fn load(&self, kappa: T) -> T {
        T::of(0.5) * kappa * (self.half_width / self.radius) * self.half_width
    }

    fn pressure(&self, x: T, kappa: T) -> T {
        let Some(root) = root_inside(self.limits(), x) else { return T::zero() };
        kappa / T::pi() * (root / self.radius)
    }

    fn height(&self, x: T) -> T {
        T::of(0.5) * x * (x / self.radius)
    }

    fn slope(&self, x: T) -> T {
        x / self.radius
    }
}
