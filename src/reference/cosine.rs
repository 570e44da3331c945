//! One crest of a cosine.

use super::{ClosedForm, ReferenceError, centred, check, positive, root_inside};
use crate::numerics::special_functions::series;
use crate::{Interval, Real};

/// One crest of a wavy surface by itself, `A (1 - cos q x)` with q = 2π/λ and the amplitude A, as
/// long as its neighbours do not touch: unlike [`Westergaard`](super::Westergaard), the form does
/// not include their pressures.
///
/// With z = q L and the Bessel functions J₀, J₁
///
/// ```text
/// F = κ A z J₁(z),   P = 2 κ q A/π Σ (-1)ʲ J_(2j+1)(z) sin (2j+1)θ = κ q A/π sin θ u(z)
/// u(z) = ∫ cos((z - s) cos θ) J₀(s) ds,   0 < s < z
/// ```
///
/// by the same steps as for [`Exponential`](super::Exponential); u solves
/// `u'' = -cos² θ u - J₁(z)`, `u(0) = 0`, `u'(0) = 1`. As `F'(L) = κ A q² L J₀(q L)`, the load is
/// largest, and the pressure about to turn negative at the edges, at the first zero of J₀, where L
/// = 0.3827 λ: larger contacts are refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cosine<T> {
    amplitude: T,
    wavelength: T,
    half_width: T,
}

impl<T: Real> Cosine<T> {
    /// Creates the form from the amplitude A, the wavelength λ and the half-width L.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if one of them is not positive and finite, or L is more than
    /// 0.3827 λ.
    pub fn new(amplitude: T, wavelength: T, half_width: T) -> Result<Self, ReferenceError<T>> {
        positive([("the amplitude", amplitude), ("the wavelength", wavelength)])?;
        positive([("the half-width", half_width)])?;
        let form = Self { amplitude, wavelength, half_width };
        let carries = form.wavenumber() * half_width <= T::of(2.404825557695773);
        check("the half-width", half_width, carries, "at most 0.3827 wavelengths")?;
        Ok(form)
    }

    fn wavenumber(&self) -> T {
        T::two_pi() / self.wavelength
    }
}

impl<T: Real> ClosedForm<T> for Cosine<T> {
    fn limits(&self) -> Interval<T> {
        centred(self.half_width)
    }

    fn load(&self, kappa: T) -> T {
        let z = self.wavenumber() * self.half_width;
        let square = T::of(0.25) * z * z;
        let j1 = T::of(0.5) * series(z, |k| -square / (k * (k + T::one())));
        kappa * self.amplitude * z * j1
    }

    fn pressure(&self, x: T, kappa: T) -> T {
        let Some(root) = root_inside(self.limits(), x) else { return T::zero() };
        let (q, one, two) = (self.wavenumber(), T::one(), T::of(2.0));
        let square = (q * self.half_width).powi(2);
        let cosine = x / self.half_width;
        // The terms of J₀(z) and of u(z)/z.
        let (mut bessel, mut term, mut sum) = (one, one, one);
        for m in 1..100 {
            let m = T::count(m);
            bessel *= -square / (T::of(4.0) * m * m);
            let odd = two * m + one;
            term = (two * m * bessel - square * cosine * cosine * term) / (two * m * odd);
            sum += term;
            if bessel.abs().max(term.abs()) <= T::of(0.25) * T::epsilon() * sum.abs() {
                break;
            }
        }
        kappa / T::pi() * (q * self.amplitude) * (q * root) * sum
    }

    fn height(&self, x: T) -> T {
        T::of(2.0) * self.amplitude * (T::of(0.5) * self.wavenumber() * x).sin().powi(2)
    }

    fn slope(&self, x: T) -> T {
        let q = self.wavenumber();
        q * self.amplitude * (q * x).sin()
    }
}
