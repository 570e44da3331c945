//! Limits, load and tilt of a solution.

use super::Solution;
use crate::{Interval, Real};

impl<T: Real> Solution<'_, T> {
    /// Returns the limit `a`.
    pub fn a(&self) -> T {
        self.found.interval.right
    }

    /// Returns the limit `b`; the contact starts at `-b`, so `b` is negative if the whole contact
    /// lies at positive `x`.
    pub fn b(&self) -> T {
        -self.found.interval.left
    }

    /// Returns the interval from the first limit to the last, `[-b, a]`: the contact, if there is
    /// only one, and [`half_width`](Interval::half_width) is its half-width L.
    pub fn hull(&self) -> Interval<T> {
        self.found.interval
    }

    /// Returns the intervals in which the bodies touch, from left to right.
    pub fn intervals(&self) -> &[Interval<T>] {
        self.solved().contacts()
    }

    /// Tells whether no load presses the bodies together: they touch in a point, or are apart by
    /// their [`separation`](Self::separation). There are then no [`intervals`](Self::intervals) and
    /// no pressure, and the limits `-b` and `a` are both the place where the bodies touch first, as
    /// far as the heights of their first samples tell: [`certify`](Self::certify) looks closer.
    #[must_use]
    pub fn is_apart(&self) -> bool {
        self.found.apart.is_some()
    }

    /// Returns the least distance of the bodies along y, a length: the approach asked for, if it
    /// was negative, with the other sign; otherwise 0.
    #[must_use]
    pub fn separation(&self) -> T {
        self.found.apart.unwrap_or(T::zero())
    }

    /// Returns the load per unit length F, of all contacts.
    pub fn load(&self) -> T {
        self.found.load
    }

    /// Returns the tilt τ, the angle by which body 2 has turned counter-clockwise (or body 1
    /// clockwise) so that the load acts where [`Control::Moment`](crate::Control::Moment) or
    /// [`Control::CentreOfPressure`](crate::Control::CentreOfPressure) puts it; 0 with all other
    /// controls.
    ///
    /// The angle is small: the slope of the gap is larger by τ, its height at x by τ x. All results
    /// of the solution are for the turned bodies, with rates at a fixed tilt.
    pub fn tilt(&self) -> T {
        self.found.tilt
    }
}
