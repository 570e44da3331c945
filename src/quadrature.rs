//! Edge strengths and pressure from the slope of the gap.
//!
//! With κ = 1 and `g` the slope of the gap, a contact `[-b, a]` of half-width `L` and centre
//! `c` carries, for every pair of edge conditions,
//!
//! ```text
//! P(x) = (C - I(x)) / (π² sqrt((x + b)(a - x))),   C = π F
//! I(x) = PV ∫ sqrt((s + b)(a - s)) g(s)/(x - s) ds  over [-b, a]
//! ```
//!
//! (Eq. (7) of the paper with the sign that satisfies its Eq. (3)), and the strengths of the
//! inverse-square-root singularities of `P` at the two edges, in `x = c + L cos θ`, are
//!
//! ```text
//! K_b = (F/L - (m₁ - m₀))/π      K_a = (F/L - (m₁ + m₀))/π
//! m₀ = (1/π) ∫ g dθ              m₁ = (1/π) ∫ g cos θ dθ      θ from 0 to π
//! ```
//!
//! A [`Quadrature`] provides `m₀`, `m₁` and the pressure. It knows a gap, but neither profiles nor
//! the search for limits. There are two: [`Panels`], the default, and the paper's rule,
//! [`Midpoint`]. They share no code, and each checks the other.

mod engine;
mod midpoint;
pub(crate) mod panels;

pub(crate) use engine::Engine;
pub use midpoint::{Exponents, Midpoint};
pub use panels::Panels;

use crate::gap::{Cost, Gap};
use crate::{Ends, Fallible, Interval, Real};
use std::any::Any;

/// Factor on the budget of a search whose quadrature keeps no samples.
const UNCACHED_FACTOR: usize = 16;

/// Number of times, beyond its budget, that a search may take all samples for a pressure.
const MAX_PRESSURES: usize = 4096;

/// Takes the samples still missing for the pressure, as part of a search that has spent `cost`.
pub(crate) fn complete<T: Real>(
    integrator: &Engine<T>,
    gap: &Gap<'_, T>,
    on: Interval<T>,
    cost: &mut Cost,
) -> Fallible<T, ()> {
    let more = integrator.complete(gap)?;
    *cost += more;
    let pressures = more.evaluations.max(more.samples).saturating_mul(MAX_PRESSURES);
    if pressures > 0 { gap.check_budget(*cost, UNCACHED_FACTOR, pressures, on) } else { Ok(()) }
}

/// Method to integrate the slope of a gap.
pub trait Quadrature<T: Real>: Send + Sync {
    /// Creates an integrator with these settings.
    ///
    /// # Errors
    /// [`InputError::InvalidSegments`](crate::InputError::InvalidSegments),
    /// [`InputError::InvalidTolerance`](crate::InputError::InvalidTolerance) for settings that
    /// cannot be used.
    fn integrator(&self) -> Fallible<T, Box<dyn Integrator<T>>>;

    /// Tells whether an integrator belongs to this quadrature with these settings, so that a
    /// [`Solver`](crate::Solver) may reuse it. By default none does, and each solve creates a new
    /// one.
    ///
    /// An integrator is recognised by its type:
    /// `(integrator as &dyn Any).downcast_ref::<MyIntegrator>()`.
    fn serves(&self, _integrator: &dyn Integrator<T>) -> bool {
        false
    }

    /// Returns the panels, if this quadrature is them or stands for them: a solve then works on
    /// panels with these settings, finds several contacts too, and asks nothing else of the
    /// quadrature. By default `None`: it has an integrator of its own, for one contact.
    fn panels(&self) -> Option<Panels> {
        None
    }
}

/// A [`Quadrature`] at work. It holds numbers only, receives the gap with each request, and may
/// keep samples from one request to the next.
pub trait Integrator<T: Real>: Any + Send + Sync {
    /// Copies the integrator with all its numbers: a solver goes on while a solution is kept.
    fn fork(&self) -> Box<dyn Integrator<T>>;

    /// Starts a new problem: counts costs from zero and, unless the bodies are the same, forgets
    /// all samples.
    fn reset(&mut self, same_bodies: bool);

    /// Takes samples over a span of x in which the contact is expected, in place of earlier ones:
    /// in full or, if `coarse`, only a few for a first estimate of the limits. Returns the
    /// approximate error left in the slope, as a fraction of the slope. `None` (the default) means
    /// that this integrator samples each interval on request.
    ///
    /// # Errors
    /// Those of sampling the gap.
    fn sample_over(
        &mut self,
        _gap: &Gap<'_, T>,
        _on: Interval<T>,
        _coarse: bool,
    ) -> Fallible<T, Option<T>> {
        Ok(None)
    }

    /// Announces prescribed limits, at -b and at a, before samples are taken up to there: a feature
    /// between the last sample and such a limit would go unseen. Default: no-op.
    fn prescribe_limits(&mut self, _gap: &Gap<'_, T>, _limits: Ends<Option<T>>) {}

    /// Returns the interval over which samples are at hand; `None` (the default) if none are kept.
    fn sampled_interval(&self) -> Option<Interval<T>> {
        None
    }

    /// Returns the slope of the gap at `x` from the samples at hand; `None` (the default) without
    /// any.
    fn slope(&self, _x: T) -> Option<T> {
        None
    }

    /// Forgets the samples, but not the cost.
    fn clear_samples(&mut self) {}

    /// Returns the edge integrals over an interval.
    ///
    /// # Errors
    /// Those of sampling the gap.
    fn moments(&mut self, gap: &Gap<'_, T>, on: Interval<T>) -> Fallible<T, Moments<T>>;

    /// Prepares pressures over an interval from the samples at hand.
    ///
    /// # Errors
    /// Those of sampling the gap.
    fn prepare(&mut self, gap: &Gap<'_, T>, on: Interval<T>) -> Fallible<T, ()>;

    /// Takes the samples still missing for the pressure, and returns their cost. Default: no-op.
    ///
    /// # Errors
    /// Those of sampling the gap.
    fn complete(&self, _gap: &Gap<'_, T>) -> Fallible<T, Cost> {
        Ok(Cost::default())
    }

    /// Returns the pressure at a point strictly inside the interval last prepared and completed,
    /// with an estimate of the quadrature's error, and adds its cost to `cost`.
    ///
    /// # Errors
    /// Those of sampling the gap.
    fn estimate(
        &self,
        gap: &Gap<'_, T>,
        load_case: &LoadCase<T>,
        x: T,
        cost: &mut Cost,
    ) -> Fallible<T, Estimate<T>>;

    /// Computes the pressure at any number of points, by default one by one.
    ///
    /// # Errors
    /// As [`estimate`](Self::estimate).
    fn pressures(
        &self,
        gap: &Gap<'_, T>,
        load_case: &LoadCase<T>,
        x: &[T],
        pressures: &mut [T],
        cost: &mut Cost,
    ) -> Fallible<T, ()> {
        for (pressure, &x) in pressures.iter_mut().zip(x) {
            *pressure = self.estimate(gap, load_case, x, cost)?.value;
        }
        Ok(())
    }

    /// Returns the cost of the work since the last [`reset`](Self::reset).
    fn cost(&self) -> Cost;
}

/// Load on a contact, and the conditions at its edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadCase<T> {
    /// Scale κ, a pressure.
    pub kappa: T,
    /// Load per unit length F.
    pub load: T,
    /// True at a free edge: `K_b` or `K_a` vanishes there.
    pub free: Ends<bool>,
}

/// Value with its estimated error.
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Contact, Control, Flat};
///
/// let body = Parabola::new(1.0f64, [-1.0, 1.0])?;
/// let solution = Contact::new(&Flat, &body)?.solve(Control::Load(0.02))?;
/// let estimate = solution.pressure()?.with_error(0.1)?;
/// println!("{estimate}"); // the value ± its error
/// let exact = (0.04f64 - 0.01).sqrt() / std::f64::consts::PI; // κ/(π R) sqrt(L² - x²)
/// assert!(estimate.error < 1e-14 && (estimate.value - exact).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Estimate<T> {
    /// The value.
    pub value: T,
    /// Estimated absolute error.
    pub error: T,
}

impl<T: Real> Estimate<T> {
    /// Tells whether the error is at most a third of the value.
    pub(crate) fn is_resolved(&self) -> bool {
        T::of(3.0) * self.error <= self.value.abs()
    }
}

/// Integrals of the gap slope that determine the strengths at the edges of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments<T> {
    /// `m₀ = (1/π) ∫ g dθ`, zero where the two edges are equally strong.
    pub m0: T,
    /// `m₁ = (1/π) ∫ g cos θ dθ`; `L m₁` is the load of a contact with two free edges.
    pub m1: T,
    /// `m₂ = (1/π) ∫ g cos 2θ dθ`, where known: the moment of the pressure about the centre is
    /// `κ L² (m₂ - m₀)/2`.
    pub m2: Option<T>,
    /// `(1/π) ∫ |g| dθ`, the scale for the rounding of `m₀` and `m₁`.
    pub l1_norm: T,
    /// Estimated error of `m₀` and `m₁`.
    pub error: T,
    /// Largest `|X(k) - x|` left by the inversions; a length.
    pub inversion: T,
    /// Derivatives with respect to the limits, where known.
    pub derivatives: Option<MomentDerivatives<T>>,
}

/// Integrals `(1/π) ∫ g'(x) cosⁱθ dθ`. With centre c and half-width L, `∂m₀/∂c` is the first,
/// `∂m₀/∂L` and `∂m₁/∂c` are the second, and `∂m₁/∂L` is the third.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentDerivatives<T> {
    /// i = 0.
    pub by_0: T,
    /// i = 1.
    pub by_1: T,
    /// i = 2.
    pub by_2: T,
}
