//! Solutions that have passed the check, and what they tell of other loads.
//!
//! Let a pressure P₁ on contacts Γ₁ under a load F₁ have passed, and let P₂ solve the equations on contacts Γ₂ that
//! contain Γ₁, under no less load.
//!
//! - Outside Γ₂ the bodies touch nothing under F₁, as contacts grow with the load: of a lighter load only what a
//!   heavier one has closed is open to doubt.
//! - Where P₂ ≥ 0 on what Γ₂ has beyond Γ₁, it is so on Γ₁. The potential U of P₂ - P₁ is a constant c on Γ₁, and no more on
//!   the rest of Γ₂, where the gap under F₁ was open. Off the places with P₂ > P₁, U is subharmonic; on these it is at most c,
//!   and far away it falls without end. So U < c off them (the maximum principle), and no place is left where P₂ < P₁, as
//!   U = c there.

use crate::real::same;
use crate::{Interval, Real};

/// The share of a contact by which limits that are the same may differ.
const SAME: f64 = 1e-12;

/// A solution that has passed.
#[derive(Clone, Debug)]
pub(in crate::contact) struct Passed<T> {
    /// F/κ and the tilt of the bodies; `None` before anything has passed.
    under: Option<[T; 2]>,
    /// Samples of the gap that it was found from.
    samples: usize,
    contacts: Vec<Interval<T>>,
}

impl<T: Real> Passed<T> {
    /// Nothing has passed yet.
    pub fn nothing() -> Self {
        Self { under: None, samples: 0, contacts: Vec::new() }
    }

    /// Forgets the solution: the bodies are others. Keeps room for one contact.
    pub fn clear(&mut self) {
        self.under = None;
        self.contacts.clear();
        self.contacts.reserve(1);
    }

    /// Keeps a solution.
    pub fn keep(&mut self, under: [T; 2], samples: usize, contacts: &[Interval<T>]) {
        (self.under, self.samples) = (Some(under), samples);
        self.contacts.clear();
        self.contacts.extend_from_slice(contacts);
    }

    /// Tells whether a solution passed under no less load at the same tilt.
    pub fn is_heavier(&self, [load, tilt]: [T; 2]) -> bool {
        self.under.is_some_and(|[most, at]| load <= most && same(tilt, at))
    }

    /// Tells whether a solution passed under no more load at the same tilt and on the same samples, inside contacts.
    pub fn is_inside(
        &self,
        [load, tilt]: [T; 2],
        samples: usize,
        contacts: &[Interval<T>],
    ) -> bool {
        let is_lighter = self.under.is_some_and(|[least, at]| load >= least && same(tilt, at));
        let is_in_one = |own: &Interval<T>| {
            let on = contacts.get(contacts.partition_point(|on| on.right < own.centre()));
            on.is_some_and(|on| {
                let apart = T::of(SAME) * on.half_width();
                on.left <= own.left + apart && on.right >= own.right - apart
            })
        };
        is_lighter && samples == self.samples && self.contacts.iter().all(is_in_one)
    }

    pub fn contacts(&self) -> &[Interval<T>] {
        &self.contacts
    }
}
