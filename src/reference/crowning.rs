//! Logarithmic relief.

use super::{ClosedForm, ReferenceError, centred, check, positive, root_inside};
use crate::profile::relief;
use crate::{Interval, Real};

/// Logarithmic (Lundberg) relief, the body `-C ln(1 - x²/l²)` of
/// [`profile::Crowning`](crate::profile::Crowning).
///
/// The slope is `C (1/(l - x) - 1/(l + x))`, so that all integrals of the [module](super) follow
/// from `∫ dt/((l ± t) sqrt(L² - t²)) = π/S`, with `S = sqrt(l² - L²)`:
///
/// ```text
/// F = 2 κ C (l/S - 1),   P = 2 κ C l sqrt(L² - x²)/(π S (l² - x²))
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crowning<T> {
    depth: T,
    half_length: T,
    half_width: T,
}

impl<T: Real> Crowning<T> {
    /// Creates the form from the depth C, the half-length l and the half-width L.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if one of them is not positive and finite, or L is not less
    /// than l.
    pub fn new(depth: T, half_length: T, half_width: T) -> Result<Self, ReferenceError<T>> {
        positive([("the depth", depth), ("the half-length", half_length)])?;
        positive([("the half-width", half_width)])?;
        check("the half-width", half_width, half_width < half_length, "less than the half-length")?;
        Ok(Self { depth, half_length, half_width })
    }

    /// Creates the form from the depth C, the half-length l and the load F.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if one of them is not positive and finite, or the load is so
    /// large that the contact cannot be told from the whole length.
    pub fn under_load(
        depth: T,
        half_length: T,
        load: T,
        kappa: T,
    ) -> Result<Self, ReferenceError<T>> {
        positive([("the depth", depth), ("the half-length", half_length), ("the load", load)])?;
        positive([("κ", kappa)])?;
        // l/S - 1
        let (one, two) = (T::one(), T::of(2.0));
        let share = load / kappa / depth / two;
        let half_width =
            half_length * (share / (one + share)).sqrt() * ((two + share) / (one + share)).sqrt();
        check("the load", load, half_width < half_length, "so small that the ends stay free")?;
        Self::new(depth, half_length, half_width)
    }

    /// Returns `sqrt(l² - x²)`.
    fn root(&self, x: T) -> T {
        (self.half_length - x).sqrt() * (self.half_length + x).sqrt()
    }
}

impl<T: Real> ClosedForm<T> for Crowning<T> {
    fn limits(&self) -> Interval<T> {
        centred(self.half_width)
    }

    fn load(&self, kappa: T) -> T {
        // l/S - 1 = L²/(S (l + S))
        let (root, width) = (self.root(self.half_width), self.half_width);
        let share = (width / root) * (width / (self.half_length + root));
        T::of(2.0) * kappa * self.depth * share
    }

    fn pressure(&self, x: T, kappa: T) -> T {
        let Some(root) = root_inside(self.limits(), x) else { return T::zero() };
        let [root, length] =
            [root / self.root(self.half_width), self.half_length / (self.half_length - x)];
        T::of(2.0) * kappa / T::pi() * (self.depth / (self.half_length + x)) * (root * length)
    }

    fn height(&self, x: T) -> T {
        relief::height(self.depth, self.half_length, x)
    }

    fn slope(&self, x: T) -> T {
        relief::slope(self.depth, self.half_length, x)
    }
}
