//! Where the bodies touch, and what presses them together.

use super::Solution;
use crate::{Interval, Real};

impl<T: Real> Solution<'_, T> {
    /// The limit `a`.
    pub fn a(&self) -> T {
        self.found.interval.right
    }

    /// The limit `b`; the contact runs from `-b`, so `b` is negative where the whole contact
    /// lies at positive `x`.
    pub fn b(&self) -> T {
        -self.found.interval.left
    }

    /// From the first limit to the last, `[-b, a]`: the contact, if it is one.
    pub fn hull(&self) -> Interval<T> {
        self.found.interval
    }

    /// The intervals in which the bodies touch, from left to right.
    pub fn intervals(&self) -> &[Interval<T>] {
        self.solved().contacts()
    }

    /// Load per unit length F, of all contacts.
    pub fn load(&self) -> T {
        self.found.load
    }

    /// The tilt τ, an angle: by how much body 2 has been turned counter-clockwise (or body 1 clockwise) for the
    /// load to act where [`Control::Moment`](crate::Control::Moment) or
    /// [`Control::CentreOfPressure`](crate::Control::CentreOfPressure) has it; 0 with all other controls.
    ///
    /// The angle is small: the slope of the gap is larger by τ, its height at x by τ x. All that is asked of
    /// the solution is answered for the turned bodies, rates at a fixed tilt.
    pub fn tilt(&self) -> T {
        self.found.tilt
    }
}
