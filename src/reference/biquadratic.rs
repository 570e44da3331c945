//! Parabola with a term of fourth degree.

use super::{ClosedForm, ReferenceError, centred, check, positive, root_inside};
use crate::{Interval, Real};

/// Body `x²/(2R) + B x⁴`, from `F'(l) = κ (l/R + 6 B l³)` (Johnson, §5.3, for each of the two
/// terms).
///
/// ```text
/// F = κ (L²/(2R) + 3/2 B L⁴),   P = κ/π sqrt(L² - x²) (1/R + 2 B (L² + 2 x²))
/// ```
///
/// B may be negative as long as the load still grows with the contact, `1/R + 6 B L² > 0`: then the
/// pressure is positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Biquadratic<T> {
    radius: T,
    quartic: T,
    half_width: T,
}

impl<T: Real> Biquadratic<T> {
    /// Creates the form from the radius of curvature R, the coefficient B, a length to the power
    /// -3, and the half-width L.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if R or L is not positive and finite, B is not finite, or L is
    /// too large for a negative B.
    pub fn new(radius: T, quartic: T, half_width: T) -> Result<Self, ReferenceError<T>> {
        positive([("the radius", radius)])?;
        check("the coefficient of x⁴", quartic, true, "finite")?;
        positive([("the half-width", half_width)])?;
        let grows = T::one() + T::of(6.0) * quartic * radius * half_width * half_width > T::zero();
        check("the half-width", half_width, grows, "so small that 1/R + 6 B L² > 0")?;
        Ok(Self { radius, quartic, half_width })
    }

    /// Creates the form from the radius of curvature R, the coefficient B and the load F.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if R or F is not positive and finite, B is not finite, or F is
    /// more than the body can carry.
    pub fn under_load(radius: T, quartic: T, load: T, kappa: T) -> Result<Self, ReferenceError<T>> {
        positive([("the radius", radius)])?;
        check("the coefficient of x⁴", quartic, true, "finite")?;
        positive([("the load", load), ("κ", kappa)])?;
        // v + v² 6 B R · (F R/κ) = 1 for v = κ L²/(2 F R).
        let (one, two, pressed) = (T::one(), T::of(2.0), load / kappa);
        let root = one + T::of(24.0) * quartic * radius * pressed * radius;
        check("the load", load, root > T::zero(), "no more than -κ/(24 B R²)")?;
        Self::new(radius, quartic, two * (pressed / (one + root.sqrt())).sqrt() * radius.sqrt())
    }
}

impl<T: Real> ClosedForm<T> for Biquadratic<T> {
    fn limits(&self) -> Interval<T> {
        centred(self.half_width)
    }

    fn load(&self, kappa: T) -> T {
        let l = self.half_width;
        T::of(0.5) * kappa * l * (l / self.radius + T::of(3.0) * self.quartic * l * l * l)
    }

    fn pressure(&self, x: T, kappa: T) -> T {
        let Some(root) = root_inside(self.limits(), x) else { return T::zero() };
        let (l, two) = (self.half_width, T::of(2.0));
        let quartic = self.quartic * root * l * l + two * self.quartic * root * x * x;
        kappa / T::pi() * (root / self.radius + two * quartic)
    }

    fn height(&self, x: T) -> T {
        x * (T::of(0.5) * x / self.radius + self.quartic * x * x * x)
    }

    fn slope(&self, x: T) -> T {
        x / self.radius + T::of(4.0) * self.quartic * x * x * x
    }
}
