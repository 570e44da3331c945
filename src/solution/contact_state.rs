//! What a search has found: all that a solution is asked for follows from it.

use crate::quadrature::MomentDerivatives;
use crate::{Ends, Interval, Real};

/// By how many of the estimated errors of the limits a pressure or a gap may be missed, as a share
/// of its size.
const ERRORS: f64 = 16.0;

/// The largest share of what is usual in the contacts that is taken for nothing.
const MOST: f64 = 0.01;

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
        Self::rounding().max(self.open()).min(T::of(MOST))
    }

    /// Whether the limits leave more open than any check allows for, so that none says anything: a
    /// search has stopped early, or a quadrature is coarse.
    pub fn is_doubtful(&self) -> bool {
        // NaN is in doubt too.
        let is_sure = self.open() <= T::of(MOST);
        !is_sure
    }

    /// The share of a pressure that the errors of the limits leave open.
    fn open(&self) -> T {
        T::of(ERRORS) * self.error_by_load.or(self.error).unwrap_or(T::zero())
    }

    /// The same without what is in doubt of the limits.
    pub fn rounding() -> T {
        T::epsilon().cbrt() * T::epsilon().cbrt()
    }
}
