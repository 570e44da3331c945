//! What a search has found: all that a solution is asked for follows from it.

use crate::quadrature::MomentDerivatives;
use crate::{Ends, Interval, Real};

/// A contact that was found.
#[derive(Clone, Copy)]
pub(crate) struct ContactState<T> {
    pub interval: Interval<T>,
    pub load: T,
    /// K_b and K_a.
    pub strengths: Ends<T>,
    /// Whether they vanish, being what the limits were sought by.
    pub free: Ends<bool>,
    /// Whether the bodies may pull at each other.
    pub adhesive: Ends<bool>,
    /// Estimated error of the limits relative to the half-width, where they were sought.
    pub error: Option<T>,
    /// Of several contacts, that error by about the share of the load that each bears: a narrow one whose limits are
    /// hardly known leaves little open elsewhere.
    pub error_by_load: Option<T>,
    /// The load that such an error stands for, where it is known.
    pub force: Option<T>,
    /// How the edge integrals change with the limits, where that is known.
    pub trend: Option<MomentDerivatives<T>>,
    /// By how much body 2 was turned counter-clockwise.
    pub tilt: T,
    /// Where the bodies end: at corners, or with their common range.
    pub ends: Ends<T>,
}

impl<T: Real> ContactState<T> {
    /// What is taken for nothing beside what is usual in the contacts.
    pub fn nothing(&self) -> T {
        let error = self.error_by_load.or(self.error).unwrap_or(T::zero());
        Self::rounding().max(T::of(16.0) * error).min(T::of(0.01))
    }

    /// The same without what is in doubt of the limits.
    pub fn rounding() -> T {
        T::epsilon().cbrt() * T::epsilon().cbrt()
    }
}
