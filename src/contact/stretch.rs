//! The stretch of x that is sampled around a contact.

use super::Contact;
use super::edges::Conditions;
use crate::{Interval, Real};

/// Both limits moved outward by a share of what lies between them and the next joint inside. (A
/// body may be a thousand times as steep on the other side of a joint.)
pub(super) fn beyond<T: Real>(contact: &Contact<'_, T>, on: Interval<T>, share: T) -> [T; 2] {
    let gap = &contact.gap;
    let first = gap.joint_after(on.left).filter(|&joint| joint < on.right);
    let last = gap.joint_before(on.right).filter(|&joint| joint > on.left);
    let [right_end, left_end] = [first.unwrap_or(on.right), last.unwrap_or(on.left)];
    [on.left - share * (right_end - on.left), on.right + share * (on.right - left_end)]
}

/// A stretch a little wider than a contact, by no more than half the way to the ends of the bodies.
pub(super) fn around<T: Real>(
    contact: &Contact<'_, T>,
    conditions: &Conditions<T>,
    on: Interval<T>,
    share: T,
) -> Interval<T> {
    let (half, range) = (T::of(0.5), contact.gap.range());
    let [left, right] = beyond(contact, on, share);
    let stretch = Interval {
        left: left.max(half * on.left + half * range[0]),
        right: right.min(half * on.right + half * range[1]),
    };
    with_corners(conditions, stretch.plain())
}

/// A stretch need not go beyond a fixed edge.
pub(super) fn with_corners<T: Real>(conditions: &Conditions<T>, on: Interval<T>) -> Interval<T> {
    let [left, right] = conditions.edges.map(|edge| edge.limit());
    Interval { left: left.unwrap_or(on.left), right: right.unwrap_or(on.right) }
}
