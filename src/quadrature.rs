//! From the slope of the gap to edge strengths and pressure.
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
//! how limits are found. There are two: [`Panels`], the default, and the paper's rule,
//! [`Midpoint`]. They share no code, and either checks the other.

mod midpoint;
pub(crate) mod panels;

pub use midpoint::{Exponents, Midpoint};
pub use panels::Panels;

use crate::gap::{Cost, Gap};
use crate::{ContactError, Ends, Interval, Real};
use panels::PanelIntegrator;
use std::any::Any;

/// How many times the budget of a search may be spent where no samples are kept.
const UNKEPT: usize = 16;

/// How often in one search all may be sampled for a pressure.
const MOST_PRESSURES: usize = 4096;

/// Samples what is still missing for the pressure, as part of a search that has cost so much.
pub(crate) fn complete<T: Real>(
    integrator: &dyn Integrator<T>,
    gap: &Gap<'_, T>,
    on: Interval<T>,
    cost: &mut Cost,
) -> Result<(), ContactError<T>> {
    let more = integrator.complete(gap)?;
    *cost += more;
    let pressures = more.evaluations.max(more.samples).saturating_mul(MOST_PRESSURES);
    if pressures > 0 { gap.check_budget(*cost, UNKEPT, pressures, on) } else { Ok(()) }
}

/// A way to integrate the slope of a gap.
pub trait Quadrature<T: Real>: Send + Sync {
    /// Sets it up for work.
    ///
    /// # Errors
    /// [`ContactError::InvalidSegments`], [`ContactError::InvalidTolerance`] for settings that cannot be used.
    fn integrator(&self) -> Result<Box<dyn Integrator<T>>, ContactError<T>>;

    /// Whether an integrator is one of this quadrature, with these settings, so that a
    /// [`Solver`](crate::Solver) may go on with it. By default none is, and each solve takes a new one.
    ///
    /// An integrator is known by its type: `(integrator as &dyn Any).downcast_ref::<MyIntegrator>()`.
    fn serves(&self, _integrator: &dyn Integrator<T>) -> bool {
        false
    }
}

/// A [`Quadrature`] at work. It holds numbers only, is handed the gap with each request, and may
/// keep samples from one to the next.
pub trait Integrator<T: Real>: Any + Send + Sync {
    /// A copy, with all that this one has: for a solver that goes on while a solution is kept.
    fn fork(&self) -> Box<dyn Integrator<T>>;

    /// What follows is a new problem: costs are counted from zero, and unless the bodies are the
    /// same all samples are forgotten.
    fn reset(&mut self, same_bodies: bool);

    /// Takes samples over a span of x in which the contact is expected, in place of those that
    /// it has: as many as it takes, or (`coarse`) only a few, for a first estimate of the limits.
    /// Returns about how large an error of the slope is left, as a fraction of it; `None` (the
    /// default) says that this integrator samples each interval as it comes.
    ///
    /// # Errors
    /// Those of sampling the gap.
    fn sample_over(
        &mut self,
        _gap: &Gap<'_, T>,
        _on: Interval<T>,
        _coarse: bool,
    ) -> Result<Option<T>, ContactError<T>> {
        Ok(None)
    }

    /// Announces prescribed limits, at -b and at a, before samples are taken up to there: what the bodies do
    /// between the last sample and such a limit would go unseen. Default: no-op.
    fn prescribe_limits(&mut self, _gap: &Gap<'_, T>, _limits: Ends<Option<T>>) {}

    /// The interval over which samples are at hand. `None` (the default) if none are kept.
    fn sampled_interval(&self) -> Option<Interval<T>> {
        None
    }

    /// The slope of the gap at `x` by the samples at hand; `None` (the default) without any.
    fn slope(&self, _x: T) -> Option<T> {
        None
    }

    /// The error that [`slope`](Self::slope) may have there.
    fn doubt(&self, _x: T) -> Option<T> {
        None
    }

    /// Forgets the samples, but not the cost.
    fn clear_samples(&mut self) {}

    /// The edge integrals over an interval.
    ///
    /// # Errors
    /// Those of sampling the gap.
    fn moments(&mut self, gap: &Gap<'_, T>, on: Interval<T>)
    -> Result<Moments<T>, ContactError<T>>;

    /// Prepares pressures over an interval from the samples at hand.
    ///
    /// # Errors
    /// Those of sampling the gap.
    fn prepare(&mut self, gap: &Gap<'_, T>, on: Interval<T>) -> Result<(), ContactError<T>>;

    /// Samples what is still missing for the pressure, and returns what that has cost: by default
    /// nothing is.
    ///
    /// # Errors
    /// Those of sampling the gap.
    fn complete(&self, _gap: &Gap<'_, T>) -> Result<Cost, ContactError<T>> {
        Ok(Cost::default())
    }

    /// The pressure at a point strictly inside the interval last prepared and completed, with an estimate of what
    /// the quadrature leaves open of it, adding to `cost` what it takes.
    ///
    /// # Errors
    /// Those of sampling the gap.
    fn estimate(
        &self,
        gap: &Gap<'_, T>,
        load_case: &LoadCase<T>,
        x: T,
        cost: &mut Cost,
    ) -> Result<Estimate<T>, ContactError<T>>;

    /// The pressure at any number of points. By default one by one.
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
    ) -> Result<(), ContactError<T>> {
        for (pressure, &x) in pressures.iter_mut().zip(x) {
            *pressure = self.estimate(gap, load_case, x, cost)?.value;
        }
        Ok(())
    }

    /// What the work has cost since the last [`reset`](Self::reset).
    fn cost(&self) -> Cost;

    /// The panels that it works on, if it does: they know of several contacts.
    #[doc(hidden)]
    fn panels(&self) -> Option<&PanelIntegrator<T>> {
        None
    }

    #[doc(hidden)]
    fn panels_mut(&mut self) -> Option<&mut PanelIntegrator<T>> {
        None
    }

    /// The paper's rule, if it is at work.
    #[doc(hidden)]
    fn midpoint(&self) -> Option<&Midpoint> {
        None
    }
}

/// What presses on a contact, and what is known of its edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadCase<T> {
    /// The scale κ, a pressure.
    pub kappa: T,
    /// Load per unit length F.
    pub load: T,
    /// Whether the edges are free: `K_b` and `K_a` vanish there.
    pub free: Ends<bool>,
}

/// A value and how far it can be trusted.
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Contact, Control, Cost, Flat};
///
/// let body = Parabola::new(1.0f64, [-1.0, 1.0])?;
/// let solution = Contact::new(&Flat, &body)?.solve(Control::Load(0.02))?;
/// let estimate = solution.pressure()?.estimate(0.1, &mut Cost::default())?;
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
    /// Whether the error is at most a third of the value.
    pub(crate) fn is_resolved(&self) -> bool {
        T::of(3.0) * self.error <= self.value.abs()
    }
}

/// The integrals of the gap slope that decide on the edges of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments<T> {
    /// `m₀ = (1/π) ∫ g dθ`, zero where the two edges are equally strong.
    pub m0: T,
    /// `m₁ = (1/π) ∫ g cos θ dθ`; `L m₁` is the load of a contact with two free edges.
    pub m1: T,
    /// `m₂ = (1/π) ∫ g cos 2θ dθ`, where that is known: the moment of the pressure about the centre is
    /// `κ L² (m₂ - m₀)/2`.
    pub m2: Option<T>,
    /// `(1/π) ∫ |g| dθ`, against which the rounding of the other two is measured.
    pub l1_norm: T,
    /// Estimated error of the first two.
    pub error: T,
    /// The largest `|X(k) - x|` that the inversions have left; a length.
    pub inversion: T,
    /// How they change with the limits, where that is known.
    pub derivatives: Option<MomentDerivatives<T>>,
}

/// `(1/π) ∫ g'(x) cosⁱθ dθ`: with centre c and half-width L, `∂m₀/∂c` is the first, `∂m₀/∂L` and
/// `∂m₁/∂c` are the second, and `∂m₁/∂L` is the third.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentDerivatives<T> {
    /// i = 0.
    pub by_0: T,
    /// i = 1.
    pub by_1: T,
    /// i = 2.
    pub by_2: T,
}
