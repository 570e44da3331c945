//! Two bumps that merge.

use super::{ClosedForm, ReferenceError, centred, positive, root_inside};
use crate::{Interval, Real};

/// Body `D ((x/r)² - 1)²`: bumps at ±r, and between them a hollow of depth D. Up to the load
/// `2 κ D` it touches in two places, then in one. With `D = r = 1` it is `x⁴ - 2x²` and a constant.
///
/// ```text
/// F ≤ 2 κ D: β² - α² = 2 r² sqrt(F/(2 κ D)),  α² + β² = 2 r²
///            P = 4 κ D/(π r⁴) abs(x) sqrt((x² - α²)(β² - x²))
/// F ≥ 2 κ D: F = κ D (3/2 u² - 2 u),  u = L²/r²,  P = 2 κ D/(π r²) sqrt(L² - x²) (u - 2 + 2 x²/r²)
/// ```
///
/// The first is a [`PolynomialMap`](super::PolynomialMap) of Hertz's parabola with N = 2, the
/// second a [`Biquadratic`](super::Biquadratic) of negative radius. Both are
/// `4 κ D/(π r⁴) x² sqrt(2 r² - x²)` where they meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quartic<T> {
    depth: T,
    radius: T,
    on: On<T>,
}

/// Contacts, in units of r.
#[derive(Clone, Copy, Debug, PartialEq)]
enum On<T> {
    /// Contacts from α to β, and from -β to -α.
    Two { inner: T, outer: T, force: T },
    /// Contact from -L to L, with u - 2 to all digits.
    One { half_width: T, beyond: T },
}

impl<T: Real> Quartic<T> {
    /// Creates the form from the depth D, the distance r of the bumps from the middle, and the load
    /// F.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if one of them is not positive and finite.
    pub fn under_load(depth: T, radius: T, load: T, kappa: T) -> Result<Self, ReferenceError<T>> {
        positive([("the depth", depth), ("the radius", radius), ("the load", load)])?;
        positive([("κ", kappa)])?;
        let (one, two, six) = (T::one(), T::of(2.0), T::of(6.0));
        let force = load / kappa / depth;
        let on = if force <= two {
            let share = (force / two).sqrt();
            // By 2 - force, as α is a small difference near the merger.
            let rest = (two - force) / two / (one + share);
            On::Two { inner: rest.sqrt(), outer: (one + share).sqrt(), force }
        } else {
            let beyond = two * (force - two) / ((T::of(4.0) + six * force).sqrt() + T::of(4.0));
            On::One { half_width: (two + beyond).sqrt(), beyond }
        };
        Ok(Self { depth, radius, on })
    }

    /// Returns the load 2 κ D under which the two contacts become one.
    pub fn merger(&self, kappa: T) -> T {
        T::of(2.0) * kappa * self.depth
    }
}

impl<T: Real> ClosedForm<T> for Quartic<T> {
    fn limits(&self) -> Interval<T> {
        let (On::Two { outer: right, .. } | On::One { half_width: right, .. }) = self.on;
        centred(self.radius * right)
    }

    fn contacts(&self) -> Vec<Interval<T>> {
        match self.on {
            On::Two { inner, outer, .. } if inner > T::zero() => {
                let [left, right] = [self.radius * inner, self.radius * outer];
                vec![Interval { left: -right, right: -left }, Interval { left, right }]
            }
            _ => vec![self.limits()],
        }
    }

    fn load(&self, kappa: T) -> T {
        let two = T::of(2.0);
        let force = match self.on {
            On::Two { force, .. } => force,
            // 2 + 4 (u - 2) + 3/2 (u - 2)²
            On::One { beyond, .. } => two + beyond * (T::of(4.0) + T::of(1.5) * beyond),
        };
        kappa * self.depth * force
    }

    fn pressure(&self, x: T, kappa: T) -> T {
        let (x, r, two) = (x.abs(), self.radius, T::of(2.0));
        let shape = match self.on {
            On::Two { inner, outer, .. } => {
                let on = Interval { left: r * inner, right: r * outer };
                let Some(root) = root_inside(on, x) else { return T::zero() };
                let others = ((x / r + inner) * (x / r + outer)).sqrt();
                two * (x / r) * (root / r) * others
            }
            On::One { half_width, beyond } => {
                let on = centred(r * half_width);
                let Some(root) = root_inside(on, x) else { return T::zero() };
                root / r * (beyond + two * (x / r).powi(2))
            }
        };
        two * kappa / T::pi() * (self.depth / r) * shape
    }

    fn height(&self, x: T) -> T {
        let share = x / self.radius;
        self.depth * ((share - T::one()) * (share + T::one())).powi(2)
    }

    fn slope(&self, x: T) -> T {
        let share = x / self.radius;
        let fall = (share - T::one()) * (share + T::one());
        T::of(4.0) * (self.depth / self.radius) * share * fall
    }
}
