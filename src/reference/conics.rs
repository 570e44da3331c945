//! Ellipse, circle and hyperbola.

use super::{ClosedForm, ReferenceError, centred, check, positive, root_inside};
use crate::numerics::special_functions::elliptic;
use crate::{Interval, Real};

/// Ellipse with the semi-axes A along the contact and B across it, `B (1 - sqrt(1 - x²/A²))`; the
/// circle, A = B, is exact and not replaced by a parabola.
///
/// With k = L/A and the complete elliptic integrals K, E and Π
///
/// ```text
/// F = 2 κ B/π (K(k) - E(k)),   P = 2 κ B/(π² A²) sqrt(L² - x²) Π(x²/A², k)
/// ```
///
/// from the representations of the [module](super): `∫ sin² φ/sqrt(1 - k² sin² φ) dφ` is
/// `(K - E)/k²`, and the principal value is `K(k) - Π(L²/x², k)`, for which see Abramowitz and
/// Stegun, 17.7.7. For L much less than A it is Hertz with R = A²/B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse<T> {
    along: T,
    across: T,
    half_width: T,
}

impl<T: Real> Ellipse<T> {
    /// Creates the form from the semi-axes A, along the contact, and B, and the half-width L.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if one of them is not positive and finite, or L is not less
    /// than A.
    pub fn new(along: T, across: T, half_width: T) -> Result<Self, ReferenceError<T>> {
        positive([("the semi-axis along the contact", along)])?;
        positive([("the semi-axis across it", across), ("the half-width", half_width)])?;
        check("the half-width", half_width, half_width < along, "less than the semi-axis")?;
        Ok(Self { along, across, half_width })
    }

    /// Creates the circle from the radius R and the half-width L.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if either is not positive and finite, or L is not less than R.
    pub fn circle(radius: T, half_width: T) -> Result<Self, ReferenceError<T>> {
        Self::new(radius, radius, half_width)
    }

    /// Returns `sqrt(1 - x²/A²)`.
    fn cosine(&self, x: T) -> T {
        (T::one() - x / self.along).sqrt() * (T::one() + x / self.along).sqrt()
    }
}

impl<T: Real> ClosedForm<T> for Ellipse<T> {
    fn limits(&self) -> Interval<T> {
        centred(self.half_width)
    }

    fn load(&self, kappa: T) -> T {
        let (zero, one) = (T::zero(), T::one());
        let k = self.half_width / self.along;
        let integral = elliptic(self.cosine(self.half_width), one, zero, one);
        T::of(2.0) * kappa * self.across * k * k * integral / T::pi()
    }

    fn pressure(&self, x: T, kappa: T) -> T {
        let Some(root) = root_inside(self.limits(), x) else { return T::zero() };
        let one = T::one();
        let integral = elliptic(self.cosine(self.half_width), self.cosine(x).powi(2), one, one);
        let [root, steep] = [root, self.across].map(|length| length / self.along);
        T::of(2.0) * kappa * steep * root * integral / T::pi().powi(2)
    }

    fn height(&self, x: T) -> T {
        let z = x / self.along;
        self.across * z * (z / (T::one() + self.cosine(x)))
    }

    fn slope(&self, x: T) -> T {
        self.across / self.along * (x / self.along / self.cosine(x))
    }
}

/// Wedge with a rounded tip: the hyperbola `m (sqrt(ρ² + x²) - ρ)`, with the slopes ±m far away and
/// the radius ρ/m at the tip.
///
/// With `S = sqrt(ρ² + L²)`, `k = L/S`, and the complete elliptic integrals of modulus k
///
/// ```text
/// F = 2 κ m S/π (E - (ρ/S)² K)
/// P = 2 κ m/(π² S) sqrt(L² - x²) ∫ sqrt(1 - k² sin² φ)/(1 - N sin² φ) dφ,   N = (L² - x²)/S²
/// ```
///
/// with φ from 0 to π/2. It is the [`Ellipse`] with an imaginary axis, A = iρ; the transformed
/// principal value and K are combined into one positive integral.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hyperbola<T> {
    slope: T,
    tip: T,
    half_width: T,
}

impl<T: Real> Hyperbola<T> {
    /// Creates the form from the slope m, the length ρ of the tip, and the half-width L.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if one of them is not positive and finite.
    pub fn new(slope: T, tip: T, half_width: T) -> Result<Self, ReferenceError<T>> {
        positive([("the slope", slope), ("the length of the tip", tip)])?;
        positive([("the half-width", half_width)])?;
        Ok(Self { slope, tip, half_width })
    }
}

impl<T: Real> ClosedForm<T> for Hyperbola<T> {
    fn limits(&self) -> Interval<T> {
        centred(self.half_width)
    }

    fn load(&self, kappa: T) -> T {
        let (zero, one, l) = (T::zero(), T::one(), self.half_width);
        let scale = self.tip.hypot(l);
        let integral = elliptic(self.tip / scale, one, one, zero);
        T::of(2.0) * kappa * self.slope * l * (l / scale) * integral / T::pi()
    }

    fn pressure(&self, x: T, kappa: T) -> T {
        let Some(root) = root_inside(self.limits(), x) else { return T::zero() };
        let scale = self.tip.hypot(self.half_width);
        let complement = self.tip / scale;
        let p = (self.tip.hypot(x) / scale).powi(2);
        let integral = elliptic(complement, p, T::one(), complement * complement);
        T::of(2.0) * kappa * self.slope * (root / scale) * integral / T::pi().powi(2)
    }

    fn height(&self, x: T) -> T {
        self.slope * x * (x / (self.tip + self.tip.hypot(x)))
    }

    fn slope(&self, x: T) -> T {
        self.slope * (x / self.tip.hypot(x))
    }
}
