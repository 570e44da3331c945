//! The parabola with adhesion.

use super::{ClosedForm, ReferenceError, centred, check, positive, root_inside};
use crate::numerics::special_functions::convex_root;
use crate::{Edge, Interval, Real};

/// Line contact of Johnson, Kendall and Roberts: the parabola `x²/(2R)` with the work of adhesion
/// w, energy per area (Barquins, *J. Adhesion* 26, 1988, 1).
///
/// ```text
/// F = κ L²/(2R) - 2 sqrt(κ w L),   P = κ/(π R) sqrt(L² - x²) - 2 sqrt(κ w L)/(π sqrt(L² - x²))
/// ```
///
/// The tensile load is largest at `L₀³ = R² w/κ`, where `F = -3 κ L₀²/(2R)`; narrower contacts are
/// not stable under a given load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jkr<T> {
    radius: T,
    work: T,
    half_width: T,
}

impl<T: Real> Jkr<T> {
    /// Creates the form from the radius of curvature R, the work of adhesion w and the half-width
    /// L.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if one of them is not positive and finite.
    pub fn new(radius: T, work: T, half_width: T) -> Result<Self, ReferenceError<T>> {
        positive([("the radius", radius), ("the work of adhesion", work)])?;
        positive([("the half-width", half_width)])?;
        Ok(Self { radius, work, half_width })
    }

    /// Creates the stable contact from the radius of curvature R, the work of adhesion w and the
    /// load F, negative in tension. It solves, by Newton's method, `y⁴ - 4 y = 2 F R/(κ L₀²)` for
    /// `y² = L/L₀`.
    ///
    /// # Errors
    /// [`ReferenceError::PullOff`] if no such contact exists; [`ReferenceError::Parameter`] if the
    /// load is not finite, or another parameter is not positive and finite.
    pub fn under_load(radius: T, work: T, load: T, kappa: T) -> Result<Self, ReferenceError<T>> {
        positive([("the radius", radius), ("the work of adhesion", work), ("κ", kappa)])?;
        check("the load", load, true, "finite")?;
        let [three, four, six] = [3.0, 4.0, 6.0].map(T::of);
        let narrowest = radius * (work / kappa / radius).cbrt();
        let unit = T::of(0.5) * kappa * (narrowest / radius) * narrowest;
        let excess = load / unit + three;
        if excess < T::zero() {
            return Err(ReferenceError::PullOff { load, least: -three * unit });
        }
        // y = 1 + d: 6 d² + 4 d³ + d⁴ = excess.
        let start = (excess / six).sqrt().min(excess.sqrt().sqrt());
        let d = convex_root(start, |d| {
            let value = d * d * (six + d * (four + d)) - excess;
            [value, four * d * (three + d * (three + d))]
        });
        Self::new(radius, work, narrowest * (T::one() + d).powi(2))
    }

    /// Returns `2 sqrt(κ w L)`.
    fn pull(&self, kappa: T) -> T {
        T::of(2.0) * kappa.sqrt() * self.work.sqrt() * self.half_width.sqrt()
    }
}

impl<T: Real> ClosedForm<T> for Jkr<T> {
    fn limits(&self) -> Interval<T> {
        centred(self.half_width)
    }

    fn load(&self, kappa: T) -> T {
        T::of(0.5) * kappa * (self.half_width / self.radius) * self.half_width - self.pull(kappa)
    }

    /// Returns the pressure, negative next to the edges, and minus infinity there.
    fn pressure(&self, x: T, kappa: T) -> T {
        let Some(root) = root_inside(self.limits(), x) else { return T::zero() };
        (kappa * (root / self.radius) - self.pull(kappa) / root) / T::pi()
    }

    fn height(&self, x: T) -> T {
        T::of(0.5) * x * (x / self.radius)
    }

    fn slope(&self, x: T) -> T {
        x / self.radius
    }

    fn edges(&self) -> [Edge<T>; 2] {
        [Edge::Adhesive(self.work); 2]
    }
}
