//! An exponential less its tangent.

use super::{ClosedForm, ReferenceError, check, positive, root_inside};
use crate::numerics::special_functions::{exp_minus, series};
use crate::{Interval, Real};

/// Body `ℓ²/R (e^(x/ℓ) - 1 - x/ℓ)`, with the radius R at its lowest point x = 0: smooth, but not
/// symmetric.
///
/// With z = L/ℓ and the modified Bessel functions I₀, I₁
///
/// ```text
/// c = -ℓ ln I₀(z),   F = κ ℓ L/R I₁(z)/I₀(z),   x = c + L cos θ
/// P = 2 κ ℓ/(π R I₀(z)) S
/// S = Σ I_k(z) sin kθ = ½ sin θ ∫ e^((z - s) cos θ) I₀(s) ds,   0 < s < z
/// ```
///
/// The sum S is the conjugate of the Fourier series of `e^(z cos θ)`; it satisfies
/// `dS/dz = cos θ S + ½ sin θ I₀(z)`, hence the integral. The integral times `e^z` is summed as a
/// power series in z with positive terms only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponential<T> {
    length: T,
    radius: T,
    half_width: T,
    limits: Interval<T>,
}

impl<T: Real> Exponential<T> {
    /// Creates the form from the length ℓ, the radius R and the half-width L.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if one of them is not positive and finite, or L/ℓ is so large
    /// that exp(2L/ℓ) overflows.
    pub fn new(length: T, radius: T, half_width: T) -> Result<Self, ReferenceError<T>> {
        positive([("the length", length), ("the radius", radius)])?;
        positive([("the half-width", half_width)])?;
        let z = half_width / length;
        let fits = (z + z).exp().is_finite();
        check("the half-width", half_width, fits, "so small that exp(2L/ℓ) is finite")?;
        let square = T::of(0.25) * z * z;
        let less_one = square * series(T::one(), |k| square / ((k + T::one()) * (k + T::one())));
        let centre = -length * less_one.ln_1p();
        let limits = Interval { left: centre - half_width, right: centre + half_width };
        Ok(Self { length, radius, half_width, limits })
    }
}

impl<T: Real> ClosedForm<T> for Exponential<T> {
    fn limits(&self) -> Interval<T> {
        self.limits
    }

    fn load(&self, kappa: T) -> T {
        let z = self.half_width / self.length;
        let square = T::of(0.25) * z * z;
        let i0 = series(T::one(), |k| square / (k * k));
        let i1 = T::of(0.5) * series(z, |k| square / (k * (k + T::one())));
        kappa * self.length * (self.half_width / self.radius) * (i1 / i0)
    }

    fn pressure(&self, x: T, kappa: T) -> T {
        let Some(root) = root_inside(self.limits, x) else { return T::zero() };
        let (one, two, z) = (T::one(), T::of(2.0), self.half_width / self.length);
        // 1 + cos θ
        let rate = (x - self.limits.left) / self.half_width;
        // The terms of e^z I₀(z), and of ∫ e^((z - s) rate) e^s I₀(s) ds divided by z.
        let (mut bessel, mut bessel_sum) = (one, one);
        let (mut integral, mut integral_sum) = (one, one);
        for k in 1..5000 {
            let k = T::count(k);
            bessel *= z * (two * k - one) / (k * k);
            integral = (z * rate * integral + bessel) / (k + one);
            bessel_sum += bessel;
            integral_sum += integral;
            if bessel.max(integral) <= T::of(0.25) * T::epsilon() * integral_sum {
                break;
            }
        }
        let share = integral_sum / bessel_sum;
        kappa / T::pi() * (root / self.radius) * share
    }

    fn height(&self, x: T) -> T {
        self.length * (self.length / self.radius) * exp_minus(x / self.length)
    }

    fn slope(&self, x: T) -> T {
        self.length / self.radius * (x / self.length).exp_m1()
    }
}
