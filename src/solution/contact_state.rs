//! Result of a search: a solution works out everything from it.

use crate::quadrature::MomentDerivatives;
use crate::{Ends, Interval, Real, SolveError};

/// Largest relative error of a pressure or a gap, in multiples of the estimated error of the
/// limits.
const ERRORS: f64 = 16.0;

/// Largest share of a usual value in the contacts that counts as zero.
const MAX_TOLERANCE: f64 = 0.01;

/// Distance from a corner within which a limit held there proves nothing, in errors of the limit:
/// more than 16/π² beyond a jump, as beyond a wall that bends.
const BLIND: f64 = 8.0;

/// Contact that a search has found.
#[derive(Clone, Copy)]
pub(crate) struct ContactState<T> {
    pub interval: Interval<T>,
    pub load: T,
    /// K_b and K_a.
    pub strengths: Ends<T>,
    /// Flags: the strength is zero, a condition by which the limit was found.
    pub free: Ends<bool>,
    /// Flags: the bodies may pull at each other at this edge.
    pub adhesive: Ends<bool>,
    /// Estimated error of the limits relative to the half-width, if they were unknown.
    pub error: Option<T>,
    /// Error of several contacts, weighted by about the share of the load that each bears: a narrow
    /// contact with inaccurate limits has little effect elsewhere.
    pub error_by_load: Option<T>,
    /// Load error that corresponds to the error of the limits, if it is known.
    pub load_error: Option<T>,
    /// Derivatives of the edge integrals by the limits, if they are known.
    pub moment_derivatives: Option<MomentDerivatives<T>>,
    /// Angle by which body 2 was turned counter-clockwise.
    pub tilt: T,
    /// Ends of the bodies: corners, or the ends of their common range.
    pub ends: Ends<T>,
    /// Distance of bodies that are not pressed together, where they touch first: there the interval
    /// has no width.
    pub apart: Option<T>,
}

impl<T: Real> ContactState<T> {
    /// Returns the state of bodies that no load presses together, at a distance where they touch
    /// first.
    pub fn apart(place: T, load: T, separation: T, ends: Ends<T>) -> Self {
        Self {
            interval: Interval { left: place, right: place },
            load,
            strengths: Ends::both(T::zero()),
            free: Ends::both(true),
            adhesive: Ends::both(false),
            error: Some(T::zero()),
            error_by_load: None,
            load_error: None,
            moment_derivatives: None,
            tilt: T::zero(),
            ends,
            apart: Some(separation),
        }
    }

    /// Returns the height by which two places of bodies over a range must differ to tell which
    /// touches first: half the digits of the range.
    pub fn least_height([from, to]: [T; 2]) -> T {
        T::epsilon().sqrt() * (to - from)
    }

    /// Returns the share of a usual value in the contacts below which a value counts as zero.
    pub fn zero_tolerance(&self) -> T {
        Self::rounding().max(self.open()).min(T::of(MAX_TOLERANCE))
    }

    /// Returns the largest fall of the slope in one contact that counts as none beside the steepest
    /// slope: κ/π times it counts as zero beside the mean pressure, too.
    pub fn negligible_fall(&self, kappa: T, steepest: T) -> T {
        let mean = T::frac_pi_2() * self.load / (kappa * self.interval.half_width());
        // A mean that is no number allows nothing.
        self.zero_tolerance() * if steepest < mean { steepest } else { mean }
    }

    /// Tells whether the error of the limits exceeds all tolerances, so that no check can decide: a
    /// search has stopped early, or a quadrature is coarse.
    pub fn is_doubtful(&self) -> bool {
        // NaN is doubtful too.
        let is_sure = self.open() <= T::of(MAX_TOLERANCE);
        !is_sure
    }

    /// Returns the relative uncertainty of a pressure that the errors of the limits cause.
    fn open(&self) -> T {
        T::of(ERRORS) * self.error_by_load.or(self.error).unwrap_or(T::zero())
    }

    /// Returns the relative uncertainty that rounding alone causes.
    pub fn rounding() -> T {
        T::epsilon().cbrt() * T::epsilon().cbrt()
    }

    /// Returns the distance from a limit held at a corner of a contact within which nothing is
    /// proved.
    pub fn blind(&self, on: Interval<T>) -> T {
        T::of(BLIND) * self.error.unwrap_or(T::zero()) * on.half_width()
    }

    /// Returns the error for a place with tension.
    pub fn tension(&self, x: T, pressure: T) -> SolveError<T> {
        let Self { interval, load, .. } = *self;
        SolveError::Tension { x, pressure, interval, load }
    }

    /// Returns the error for a place where the bodies overlap.
    pub fn overlap(&self, x: T, gap: T) -> SolveError<T> {
        let Self { interval, load, .. } = *self;
        SolveError::Overlap { x, gap, interval, load }
    }
}
