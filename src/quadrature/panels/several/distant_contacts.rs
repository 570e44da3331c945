//! What contacts make of something over an interval: those next to it one by one, all others of many together
//! as a Chebyshev series, since they are far off.

use super::super::panel::Panel;
use super::one_of_several::multiply;
use crate::{Interval, Real};
use std::ops::Range;

/// Contacts from which on the far ones are taken together.
const MANY: usize = 8;

#[derive(Clone)]
pub(super) struct DistantContacts<T> {
    /// The numbers of those taken one by one.
    pub near: Range<usize>,
    far: Option<Panel<T>>,
}

impl<T: Real> DistantContacts<T> {
    /// All one by one.
    pub fn near(count: usize) -> Self {
        Self { near: 0..count, far: None }
    }

    /// All but those near by together, unless they are few, or not smooth.
    pub fn new(
        near: Range<usize>,
        count: usize,
        on: Interval<T>,
        tolerance: T,
        far: impl Fn(T) -> T,
    ) -> Self {
        if count < MANY {
            return Self::near(count);
        }
        let mut one = Panel::new([on.left, on.right]);
        // From sixteen nodes on.
        (one.series[0], one.counting) = (T::one(), 10);
        let (far, resolved, moved) = multiply(&one, one.x, &far, tolerance);
        if resolved && moved { Self { near, far: Some(far) } } else { Self::near(count) }
    }

    /// What those together make, or nothing.
    pub fn far(&self, x: T, nothing: T) -> T {
        self.far.as_ref().map_or(nothing, |far| far.value(x))
    }
}
