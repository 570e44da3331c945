//! Stress below the surface of either body.
//!
//! To the equations each body is an elastic half-plane. At a distance y below its surface, which is
//! y = 0, the pressure P and a traction q = μ P along the surface leave
//!
//! ```text
//! σ_x  = -2/π (A₂ + μ A₃),   σ_y  = -2/π (A₀ + μ A₁),   τ_xy = -2/π (A₁ + μ A₂)
//! A_k  = ∫ P(s) y³⁻ᵏ (x - s)ᵏ/((x - s)² + y²)² ds
//! ```
//!
//! (Johnson, *Contact Mechanics*, 1985, Eqs. 2.23a to c). Tension is positive, y points into the
//! body, and q acts on the surface in the direction of positive x. At y = 0 inside the contact
//! `σ_y = -P` and `τ_xy = -μ P`.
//!
//! **Either body.** Without friction both bodies have the same stress at the same depth. With it the
//! traction on the other body is opposite: where the upper body slides towards positive x over the
//! lower one, the lower has μ, and the upper -μ. That such a traction leaves the pressure as it is
//! holds for like bodies, or where μ is small (Johnson, §7.2).
//!
//! **Accuracy.** None of the A is a difference of large numbers, and the panels that they are
//! integrated on shrink towards x as far as y asks for. So the stress is good to some units in the
//! last place of the pressure however small y is, with three exceptions. Where the slope of a body has
//! a kink it is good to about 1e-11 of the pressure. Below a jump of the slope it is no better than the
//! rounding of x as a share of y. At a distance d from a free edge, what rounding leaves open of the
//! limits adds `sqrt(L/d)` units. A value takes some tens of microseconds.
//!
//! ```
//! use linecontact::{Contact, Curve, CurvePoint, Flat, Load};
//!
//! let parabola = Curve::new([-1.0, 1.0], |k: f64| CurvePoint { x: k, y: k * k / 2.0, dx: 1.0, dy: k });
//! let contact = Contact::new(&Flat, &parabola)?;
//! let solution = contact.solve(Load::ToHalfWidth(0.1))?;
//! let peak = solution.peak()?.pressure;
//!
//! // The greatest shear lies below the surface (Johnson, Eq. 4.47).
//! let largest = solution.subsurface()?.max_shear()?;
//! assert!((largest.value / peak - 0.3002831).abs() < 1e-7);
//! assert!((largest.depth / 0.1 - 0.7861514).abs() < 1e-6);
//! # Ok::<(), linecontact::ContactError<f64>>(())
//! ```

mod search;

use crate::integral::Integrals;
use crate::{ContactError, Interval, Real, Solution};

/// Stress in plane strain: a pressure; tension is positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stress<T> {
    /// σ_x, along the surface.
    pub sigma_x: T,
    /// σ_y, across it.
    pub sigma_y: T,
    /// τ_xy, with y into the body.
    pub tau_xy: T,
}

impl<T: Real> Stress<T> {
    /// The principal stresses in the plane, the larger one first.
    pub fn principal(&self) -> [T; 2] {
        let mean = T::of(0.5) * (self.sigma_x + self.sigma_y);
        let radius = self.max_shear();
        [mean + radius, mean - radius]
    }

    /// The largest shear stress in the plane, half the difference of the principal stresses.
    pub fn max_shear(&self) -> T {
        (T::of(0.5) * (self.sigma_x - self.sigma_y)).hypot(self.tau_xy)
    }

    /// σ_z = ν (σ_x + σ_y), the stress that keeps the strain plane.
    ///
    /// # Errors
    /// [`ContactError::PoissonRatio`] for ν outside [0, 1/2], or NaN.
    pub fn sigma_z(&self, poisson: T) -> Result<T, ContactError<T>> {
        Ok(checked_ratio(poisson)? * (self.sigma_x + self.sigma_y))
    }

    /// The equivalent stress of von Mises in plane strain,
    ///
    /// ```text
    /// sqrt( (1 - ν + ν²)(σ_x + σ_y)² - 3 (σ_x σ_y - τ_xy²) ).
    /// ```
    ///
    /// # Errors
    /// [`ContactError::PoissonRatio`] for ν outside [0, 1/2], or NaN.
    pub fn von_mises(&self, poisson: T) -> Result<T, ContactError<T>> {
        // The same as a sum of squares.
        let share = T::of(0.5) - checked_ratio(poisson)?;
        let sum = self.sigma_x + self.sigma_y;
        Ok((share * sum).hypot(T::of(3.0).sqrt() * self.max_shear()))
    }
}

fn checked_ratio<T: Real>(ratio: T) -> Result<T, ContactError<T>> {
    if ratio >= T::zero() && ratio <= T::of(0.5) {
        Ok(ratio)
    } else {
        Err(ContactError::PoissonRatio { ratio })
    }
}

/// The stress below a contact: [`Solution::subsurface`].
pub struct Subsurface<'p, T: Real> {
    integrals: Integrals<'p, T>,
    friction: T,
    /// K_a and K_b, zero where the limits were sought by that.
    strengths: [T; 2],
    /// Mean pressure.
    mean: T,
}

/// A largest stress and its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StressPeak<T> {
    /// Abscissa.
    pub x: T,
    /// Depth below the surface.
    pub depth: T,
    /// How large it is.
    pub value: T,
}

impl<T: Real> Solution<'_, T> {
    /// Makes ready for stress below the surface.
    ///
    /// # Errors
    /// Those of [`pressure`](Self::pressure).
    pub fn subsurface(&self) -> Result<Subsurface<'_, T>, ContactError<T>> {
        let found = self.found();
        let at = |i: usize| if found.free[i] { T::zero() } else { found.strengths[i] };
        let (strengths, friction, mean) = ([at(0), at(1)], T::zero(), self.mean_pressure());
        Ok(Subsurface { integrals: Integrals::new(self)?, friction, strengths, mean })
    }
}

impl<T: Real> Subsurface<'_, T> {
    /// The same with a traction μ P on the surface of this body, in the direction of positive x; of
    /// either sign. Default 0.
    ///
    /// # Errors
    /// [`ContactError::Friction`] if μ is not finite.
    pub fn friction(self, coefficient: T) -> Result<Self, ContactError<T>> {
        if !coefficient.is_finite() {
            return Err(ContactError::Friction { coefficient });
        }
        Ok(Self { friction: coefficient, ..self })
    }

    /// The stress at any x, at a positive depth.
    ///
    /// # Errors
    /// [`ContactError::AboveSurface`] for a depth that is not positive, and what is not finite;
    /// [`ContactError::Integral`]; those of sampling the gap.
    pub fn at(&self, x: T, depth: T) -> Result<Stress<T>, ContactError<T>> {
        if !(x.is_finite() && depth.is_finite() && depth > T::zero()) {
            return Err(ContactError::AboveSurface { x, depth });
        }
        let moments = self.integrals.over(x, |distance, strength| {
            let radius = distance.hypot(depth);
            let (along, down) = (distance / radius, depth / radius);
            let share = strength / radius;
            let [both, across] = [along * down * share, down * down * share];
            [down * across, along * across, along * both, along * along * along * share]
        })?;
        let [a0, a1, a2, a3] = moments.map(|moment| -T::of(2.0) * T::frac_1_pi() * moment);
        let mu = self.friction;
        Ok(Stress { sigma_x: a2 + mu * a3, sigma_y: a0 + mu * a1, tau_xy: a1 + mu * a2 })
    }

    /// The contact.
    pub fn interval(&self) -> Interval<T> {
        self.integrals.pressure.interval()
    }
}

impl<T: Real> std::fmt::Debug for Subsurface<'_, T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut debug = f.debug_struct("Subsurface");
        debug.field("interval", &self.interval()).field("friction", &self.friction);
        debug.finish_non_exhaustive()
    }
}
