//! A flat with sharp edges.

use super::{ClosedForm, ReferenceError, centred, check, outside, positive};
use crate::{Edge, Interval, Real};

/// Flat punch with sharp edges at x = ±H, upright or with the slope m (Johnson, §2.8).
///
/// It rests on both edges if F > κ abs(m) H; otherwise, for m > 0, on the left one alone:
///
/// ```text
/// P = (F - κ m x)/(π sqrt(H² - x²))
/// P = κ m/π sqrt((a - x)/(x + H)),   F = κ m L,   a = 2L - H
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatPunch<T> {
    half_width: T,
    slope: T,
    limits: Interval<T>,
    /// Half-width L of the contact, which cannot be had from the limits to all digits.
    contact: T,
    /// Load in excess of κ abs(m) H, if the punch rests on both edges.
    excess: Option<T>,
}

impl<T: Real> FlatPunch<T> {
    /// Creates the form from the half-width H, the slope m, and the load F.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if H or F is not positive and finite, or m is not finite.
    pub fn under_load(
        half_width: T,
        slope: T,
        load: T,
        kappa: T,
    ) -> Result<Self, ReferenceError<T>> {
        positive([("the half-width", half_width)])?;
        check("the slope", slope, true, "finite")?;
        positive([("the load", load), ("κ", kappa)])?;
        let excess = load - kappa * slope.abs() * half_width;
        let excess = Some(excess).filter(|&excess| excess > T::zero());
        let contact = excess.map_or(load / kappa / slope.abs(), |_| half_width);
        let (mut limits, width) = (centred(half_width), contact + contact);
        if excess.is_none() && slope > T::zero() {
            limits.right = half_width.min(limits.left + width);
        } else if excess.is_none() {
            limits.left = (-half_width).max(limits.right - width);
        }
        Ok(Self { half_width, slope, limits, contact, excess })
    }
}

impl<T: Real> ClosedForm<T> for FlatPunch<T> {
    fn limits(&self) -> Interval<T> {
        self.limits
    }

    fn load(&self, kappa: T) -> T {
        kappa * self.slope.abs() * self.contact + self.excess.unwrap_or(T::zero())
    }

    fn pressure(&self, x: T, kappa: T) -> T {
        let limits = self.limits;
        if outside(limits, x) {
            return T::zero();
        }
        // Distances from the edge under the higher pressure and from the other.
        let mut distances = [x - limits.left, limits.right - x];
        if self.slope < T::zero() {
            distances.reverse();
        }
        let [from, to] = distances;
        let steep = kappa * self.slope.abs();
        match self.excess {
            None => steep * (to / from).sqrt() / T::pi(),
            Some(excess) => (excess + steep * to) / (T::pi() * from.sqrt() * to.sqrt()),
        }
    }

    fn height(&self, x: T) -> T {
        self.slope * x
    }

    fn slope(&self, _x: T) -> T {
        self.slope
    }

    fn edges(&self) -> [Edge<T>; 2] {
        let sharp = [-self.half_width, self.half_width].map(Edge::Fixed);
        match self.excess {
            Some(_) => sharp,
            None if self.slope > T::zero() => [sharp[0], Edge::Free],
            None => [Edge::Free, sharp[1]],
        }
    }
}
