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
    /// only one.
    pub fn hull(&self) -> Interval<T> {
        self.found.interval
    }

    /// Returns the intervals in which the bodies touch, from left to right.
    pub fn intervals(&self) -> &[Interval<T>] {
        self.solved().contacts()
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
