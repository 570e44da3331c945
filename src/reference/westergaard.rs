//! A wavy surface that touches at all its crests.

use super::{ReferenceError, centred, check, outside, positive};
use crate::{Interval, Real};

/// Westergaard's wavy surface `A (1 - cos 2πx/λ)` on a flat, touching at every crest, of which one
/// is at x = 0 (Westergaard, *J. Appl. Mech.* 6, 1939, A49; Johnson, §13.2).
///
/// ```text
/// F = 2 κ A sin² ψ_a,   P = 4 κ A/λ cos ψ sqrt(sin² ψ_a - sin² ψ),   ψ = π x/λ,   ψ_a = π L/λ
/// ```
///
/// F is the load on one wavelength; with F = 2 κ A the contact is complete. The crests touch in a
/// row of contacts, which solves
///
/// ```text
/// PV∫ P(s) π/λ cot(π (x - s)/λ) ds = κ g(x)
/// ```
///
/// and is not a [`ClosedForm`](super::ClosedForm). With `ξ = tan ψ` it is a single contact: since
/// `π/λ cot(ψ - ψ') ds = dξ'/(ξ - ξ') + ξ' dξ'/(1 + ξ'²)`, of which the second part vanishes as P
/// is even, P is also the pressure of a body of the slope `4π A/λ ξ/(1 + ξ²)` between ξ = ±tan ψ_a.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Westergaard<T> {
    amplitude: T,
    wavelength: T,
    half_width: T,
}

impl<T: Real> Westergaard<T> {
    /// Creates the form from the amplitude A, half the height, the wavelength λ and the half-width
    /// L of each contact.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if one of them is not positive and finite, or L is not less
    /// than λ/2.
    pub fn new(amplitude: T, wavelength: T, half_width: T) -> Result<Self, ReferenceError<T>> {
        positive([("the amplitude", amplitude), ("the wavelength", wavelength)])?;
        positive([("the half-width", half_width)])?;
        let apart = half_width < T::of(0.5) * wavelength;
        check("the half-width", half_width, apart, "less than half the wavelength")?;
        Ok(Self { amplitude, wavelength, half_width })
    }

    /// Creates the form from the amplitude A, the wavelength λ and the load F on each wavelength.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if one of them is not positive and finite, or F is not less
    /// than 2 κ A, the load of complete contact.
    pub fn under_load(
        amplitude: T,
        wavelength: T,
        load: T,
        kappa: T,
    ) -> Result<Self, ReferenceError<T>> {
        positive([("the amplitude", amplitude), ("the wavelength", wavelength)])?;
        positive([("the load", load), ("κ", kappa)])?;
        let complete = T::of(2.0) * kappa * amplitude;
        let must = "less than 2 κ A, at which the contact is complete";
        check("the load", load, load < complete, must)?;
        // By tan² ψ_a, since sin² ψ_a is close to 1 where the contact is nearly complete.
        let angle = (load / (complete - load)).sqrt().atan();
        Self::new(amplitude, wavelength, wavelength * (angle / T::pi()))
    }

    /// Returns the contact `[-L, L]` at x = 0.
    pub fn limits(&self) -> Interval<T> {
        centred(self.half_width)
    }

    /// Returns the load on one wavelength.
    pub fn load(&self, kappa: T) -> T {
        T::of(2.0) * kappa * self.amplitude * self.sine(self.half_width).powi(2)
    }

    /// Returns the pressure `P(x)` for x from -λ/2 to λ/2: zero outside the contact.
    pub fn pressure(&self, x: T, kappa: T) -> T {
        let limits = self.limits();
        if outside(limits, x) {
            return T::zero();
        }
        // sin² ψ_a - sin² ψ = sin(ψ_a - ψ) sin(ψ_a + ψ)
        let root = self.sine(limits.right - x).sqrt() * self.sine(x - limits.left).sqrt();
        let cosine = self.sine(T::of(0.5) * self.wavelength - x.abs());
        T::of(4.0) * kappa * (self.amplitude / self.wavelength) * cosine * root
    }

    /// Returns sin(π x/λ) for 0 ≤ x ≤ λ, computed from the nearer end.
    fn sine(&self, x: T) -> T {
        (T::pi() * (x.min(self.wavelength - x) / self.wavelength)).sin()
    }
}
