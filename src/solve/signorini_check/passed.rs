//! Solutions that have passed the check, and their consequences for other loads.
//!
//! Let a pressure P₁ on contacts Γ₁ under a load F₁ have passed, and let P₂ solve the equations on
//! contacts Γ₂ that contain Γ₁, under no less load.
//!
//! - Outside Γ₂ the bodies do not touch under F₁, as contacts grow with the load: under a lighter
//!   load only the spans that a heavier one has closed need a check.
//! - If P₂ ≥ 0 on the part of Γ₂ beyond Γ₁, then also on Γ₁. The potential U of P₂ - P₁ is a
//!   constant c on Γ₁, and at most c on the rest of Γ₂, where the gap under F₁ was open. Off the
//!   places with P₂ > P₁, U is subharmonic; on these it is at most c, and far away it falls without
//!   end. So U < c off them (the maximum principle), and no place is left where P₂ < P₁, as U = c
//!   there.

use crate::real::same;
use crate::{Interval, Real};

/// Largest difference of equal limits, as a share of the half-width of the contact.
const EQUAL_LIMITS: f64 = 1e-12;

/// Solutions for two bodies that have passed, under the heaviest load and under the lightest.
#[derive(Clone, Debug)]
pub(in crate::solve) struct Passed<T> {
    heaviest: Checked<T>,
    lightest: Checked<T>,
}

/// Solution that has passed.
#[derive(Clone, Debug)]
struct Checked<T> {
    /// `None` before anything has passed.
    on: Option<Under<T>>,
    contacts: Vec<Interval<T>>,
}

impl<T: Real> Passed<T> {
    pub fn new() -> Self {
        let nothing = Checked { on: None, contacts: Vec::new() };
        Self { heaviest: nothing.clone(), lightest: nothing }
    }

    /// Forgets both solutions, for other bodies. Keeps room for one contact.
    pub fn clear(&mut self) {
        for solution in [&mut self.heaviest, &mut self.lightest] {
            solution.on = None;
            solution.contacts.clear();
            solution.contacts.reserve(1);
        }
    }

    /// Returns the contacts under no less load, F/κ, at the same tilt; empty if none has passed.
    pub fn under_more(&self, [load, tilt]: [T; 2]) -> &[Interval<T>] {
        let Checked { on, contacts } = &self.heaviest;
        let is_less = |Under { under: [most, at], .. }| load <= most && same(tilt, at);
        if on.is_some_and(is_less) { contacts } else { &[] }
    }

    /// Returns the contacts of a solution under no more load at the same tilt, from the same
    /// samples and inside the contacts at hand; empty if there is no such solution.
    pub fn under_less(&self, on: Under<T>, contacts: &[Interval<T>]) -> &[Interval<T>] {
        let both = [&self.heaviest, &self.lightest];
        let inside = both.into_iter().find(|solution| solution.is_inside(on, contacts));
        inside.map_or(&[], |solution| &solution.contacts)
    }

    /// Keeps a solution that has passed.
    pub fn keep(&mut self, on: Under<T>, contacts: &[Interval<T>]) {
        if self.under_more(on.under).is_empty() {
            self.heaviest.set(on, contacts);
        }
        if !self.lightest.is_inside(on, contacts) {
            self.lightest.set(on, contacts);
        }
    }
}

/// Load, F/κ, with the tilt of the bodies, and the number of samples of the gap so far.
#[derive(Clone, Copy, Debug)]
pub(in crate::solve) struct Under<T> {
    pub under: [T; 2],
    pub samples: usize,
}

impl<T: Real> Checked<T> {
    fn set(&mut self, on: Under<T>, contacts: &[Interval<T>]) {
        self.on = Some(on);
        self.contacts.clear();
        self.contacts.extend_from_slice(contacts);
    }

    fn is_inside(&self, on: Under<T>, contacts: &[Interval<T>]) -> bool {
        let ([load, tilt], samples) = (on.under, on.samples);
        let is_more = |known: Under<T>| {
            let [least, at] = known.under;
            load >= least && same(tilt, at) && samples == known.samples
        };
        let is_in_one = |own: &Interval<T>| {
            let on = contacts.get(contacts.partition_point(|on| on.right < own.centre()));
            on.is_some_and(|on| {
                let apart = T::of(EQUAL_LIMITS) * on.half_width();
                on.left <= own.left + apart && on.right >= own.right - apart
            })
        };
        self.on.is_some_and(is_more) && self.contacts.iter().all(is_in_one)
    }
}
