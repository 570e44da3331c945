//! Contributions of contacts to a quantity over an interval: neighbours one by one; the others, if
//! there are many, together as a Chebyshev series, since they are far off.

use super::super::panel::Panel;
use super::one_of_several::multiply;
use crate::{Interval, Real};
use std::ops::Range;

/// Number of contacts from which on the far ones are taken together.
const MANY: usize = 8;

#[derive(Clone)]
pub(super) struct DistantContacts<T> {
    /// Numbers of the contacts taken one by one.
    pub near: Range<usize>,
    far: Option<Panel<T>>,
}

impl<T: Real> DistantContacts<T> {
    /// Takes all contacts one by one.
    pub fn near(count: usize) -> Self {
        Self { near: 0..count, far: None }
    }

    /// Takes all contacts but the near ones together, unless they are few, or their sum is not
    /// smooth.
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
        // Starts with sixteen nodes.
        (one.series[0], one.counting) = (T::one(), 10);
        let (far, resolved, moved) = multiply(&one, one.x, &far, tolerance);
        if resolved && moved { Self { near, far: Some(far) } } else { Self::near(count) }
    }

    /// Returns the contribution of the far contacts, or `nothing` if all are taken one by one.
    pub fn far(&self, x: T, nothing: T) -> T {
        self.far.as_ref().map_or(nothing, |far| far.value(x))
    }
}
