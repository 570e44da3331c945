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
//! K_a = (F/L - (m₁ + m₀))/π      K_b = (F/L - (m₁ - m₀))/π
//! m₀ = (1/π) ∫ g dθ              m₁ = (1/π) ∫ g cos θ dθ      θ from 0 to π
//! ```
//!
//! A [`Quadrature`] provides `I(x)` and `m₀`, `m₁`. It knows a gap, but neither profiles nor
//! loads nor how limits are found.

mod midpoint;
mod moments;

pub use midpoint::{Exponents, Midpoint};

use crate::gap::{Cost, Gap};
use crate::{ContactError, Interval, Real};

/// A way to integrate the slope of a gap.
pub trait Quadrature<T: Real>: Send + Sync {
    /// Sets it to work on one gap.
    ///
    /// # Errors
    /// [`ContactError::Segments`] for settings that cannot be used.
    fn prepare<'g>(&self, gap: &'g Gap<'g, T>) -> Result<Box<dyn Engine<T> + 'g>, ContactError<T>>;
}

/// A [`Quadrature`] at work on one gap. It may keep samples from one interval to the next.
pub trait Engine<T: Real>: Send + Sync {
    /// The edge integrals over an interval.
    ///
    /// # Errors
    /// Those of sampling the gap.
    fn moments(&mut self, on: Interval<T>) -> Result<Moments<T>, ContactError<T>>;

    /// The Cauchy integral over an interval, ready for any number of points.
    ///
    /// # Errors
    /// Those of sampling the gap.
    fn transform<'e>(
        &'e self,
        on: Interval<T>,
        cost: &mut Cost,
    ) -> Result<Box<dyn Transform<T> + 'e>, ContactError<T>>;

    /// What the edge integrals have cost so far.
    fn cost(&self) -> Cost;
}

/// The Cauchy integral `I(x)` over one interval.
pub trait Transform<T: Real>: Send + Sync {
    /// `I(x)` for `x` inside the interval, adding to `cost` what it takes.
    ///
    /// # Errors
    /// Those of sampling the gap.
    fn at(&self, x: T, cost: &mut Cost) -> Result<Estimate<T>, ContactError<T>>;
}

/// A value and how far it can be trusted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate<T> {
    /// The value.
    pub value: T,
    /// Estimated absolute error.
    pub error: T,
}

/// The integrals of the gap slope that decide on the edges of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments<T> {
    /// `m₀ = (1/π) ∫ g dθ`, zero where the two edges are equally strong.
    pub mean: T,
    /// `m₁ = (1/π) ∫ g cos θ dθ`; `L m₁` is the load of a contact with two free edges.
    pub first: T,
    /// `(1/π) ∫ |g| dθ`, against which the rounding of the other two is measured.
    pub size: T,
    /// Estimated error of the first two.
    pub error: T,
    /// The largest `|X(k) - x|` that the inversions have left; a length.
    pub inversion: T,
}
