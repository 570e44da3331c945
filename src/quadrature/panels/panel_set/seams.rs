//! Continuity of neighbouring panels: a feature between the last nodes of either shows only there.

use super::{FINEST, PanelSet};
use crate::Real;
use crate::numerics::chebyshev::value_at;
use crate::quadrature::panels::panel::Panel;

impl<T: Real> PanelSet<T> {
    /// Tells whether two neighbours have the same slope where they meet.
    pub fn meets(&self, left: &Panel<T>, right: &Panel<T>, allowed: T) -> bool {
        missed(left, right) <= self.tolerated(left, right, allowed, T::one())
    }

    /// Raises the errors of two neighbours to their mismatch if only a loose tolerance accepts it:
    /// a feature lies between their last nodes.
    pub(super) fn own_up(&self, [left, right]: [&mut Panel<T>; 2], allowed: T) {
        let finest = T::of(FINEST) * T::epsilon() / self.tolerance;
        let missed = missed(left, right);
        let [least, most] =
            [finest, T::one()].map(|share| self.tolerated(left, right, allowed, share));
        if missed > least && missed <= most {
            left.error = left.error.max(missed);
            right.error = right.error.max(missed);
        }
    }

    /// Returns the allowed mismatch of two neighbours, given a share of the allowed error.
    fn tolerated(&self, left: &Panel<T>, right: &Panel<T>, allowed: T, share: T) -> T {
        let allowed = share * allowed.max(self.tolerance * self.size);
        T::of(16.0) * (left.error + right.error + allowed)
    }
}

/// Returns the difference of the slopes of two neighbours where they meet.
fn missed<T: Real>(left: &Panel<T>, right: &Panel<T>) -> T {
    let [from, to] =
        [(left, T::one()), (right, -T::one())].map(|(panel, s)| value_at(panel.coefficients(), s));
    (from - to).abs()
}
