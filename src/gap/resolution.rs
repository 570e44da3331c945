//! The width of the narrowest feature of a body that is seen.

use super::{Gap, MAX_EVALUATIONS, Surface};
use crate::profile::Convexity;
use crate::real::is_finite;
use crate::{Fallible, InputError, Real};
use num_traits::ToPrimitive;

/// Full width at half height of the narrowest feature that is seen by default, as a share of the
/// width of the contact in or next to which it lies.
const NARROWEST: f64 = 0.02;

/// Distance of the points, in lengths of the narrowest feature that a user asks for. Points that
/// miss their places by a quarter of this distance are still less than half a length apart: if one
/// is at the top of a feature, where its slope vanishes, the next ones are not at its ends.
const POINT_SPACING: f64 = 0.3;

/// Least resolution, in units of rounding of x: the distance of points is then some ten of them.
const LEAST_RESOLUTION: f64 = 32.0;

impl<T: Real> Gap<'_, T> {
    /// Returns this gap with the length of the narrowest feature to be seen. The shape of the
    /// bodies is then examined whatever they declare.
    pub(crate) fn with_resolution(self, resolution: Option<T>) -> Self {
        Self { resolution, convex: self.convex && resolution.is_none(), ..self }
    }

    pub(crate) fn resolution(&self) -> Option<T> {
        self.resolution
    }

    /// Returns the distance of points that show features of the requested length anywhere.
    pub(crate) fn asked_spacing(&self) -> Option<T> {
        self.resolution.map(|length| T::of(POINT_SPACING) * length)
    }

    /// Returns the distance of points that show features in or next to a contact, given the default
    /// distance in widths of the narrowest feature.
    pub(crate) fn spacing(&self, half_width: T, widths: f64) -> T {
        let by_default = T::of(2.0 * widths * NARROWEST) * half_width;
        self.asked_spacing().map_or(by_default, |asked| by_default.min(asked))
    }

    /// Returns the number of parts of a length that are no longer than a distance: at most `most`
    /// by default.
    pub(crate) fn parts(&self, length: T, apart: T, most: usize) -> usize {
        let parts: f64 = (length / apart).to_subset_unchecked();
        // A number beyond `usize` is beyond the budget.
        let parts = parts.ceil().max(1.0).to_usize().unwrap_or(usize::MAX);
        if self.resolution.is_some() { parts } else { parts.min(most) }
    }

    /// Checks the resolution against the rounding at an abscissa, and against the number of points
    /// that all of the bodies need.
    ///
    /// # Errors
    /// [`InputError::InvalidResolution`].
    pub(crate) fn check_resolution(&self, x: T) -> Fallible<T, ()> {
        let is_curved =
            |body: &&Surface<'_, T>| body.shape.profile().convexity() != Convexity::Straight;
        let curved = self.bodies.iter().filter(is_curved).count();
        let length = T::count(curved) * (self.range[1] - self.range[0]);
        let by_budget = length / (T::of(POINT_SPACING) * T::count(MAX_EVALUATIONS));
        let rounding = T::of(LEAST_RESOLUTION) * T::epsilon() * x.abs();
        let least = if curved > 0 { rounding.max(by_budget) } else { rounding };
        match self.resolution {
            Some(resolution) if !(resolution > least && is_finite(resolution)) => {
                Err(InputError::InvalidResolution { resolution, least }.into())
            }
            _ => Ok(()),
        }
    }
}
