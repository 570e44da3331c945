//! Newton's method on all limits of the contacts at once, and on the load or the tilt if sought.
//!
//! A search goes from trial to trial. Each trial takes the equations and their Jacobian from
//! the quadrature, and makes the Newton step, cut short if it would lead too far. The search ends
//! when the next step would be below rounding, or when rounding keeps the steps from shrinking
//! further.
//!
//! [One contact](single) has its tilt eliminated and moves by the balance of its two limits;
//! [several](several) close gaps and lose contacts.

pub(super) mod linearised;
pub(super) mod several;
pub(super) mod single;

use crate::gap::Gap;
use crate::{Interval, Real};

/// Reason for a search for one contact to end without limits.
#[derive(Clone, Copy)]
pub(super) enum Stop<T> {
    /// Steps that lead beyond an end of the bodies time and again, with the last interval within
    /// them.
    Beyond(Interval<T>),
    Failed,
}

/// Longest step, as a share of a half-width, that predicts the next one.
const MAX_PREDICTING_STEP: f64 = 0.25;

/// Least ratio of a step to the one before at which rounding is taken to keep the steps from
/// shrinking.
const STALL_RATIO: f64 = 0.25;

/// Steps of a search, which predict the next one: their sizes fall quadratically.
#[derive(Clone, Copy)]
pub(super) struct Progress<T> {
    /// Sizes of the last step, as shares of a half-width: of both limits of one contact, or of all
    /// limits as one. `None` if the step was too long, or cut short.
    before: Option<[T; 2]>,
}

/// Judgement of a search by its last step.
#[derive(Clone, Copy)]
pub(super) struct Judged<T> {
    /// Predicted sizes of the next step.
    pub next: [T; 2],
    pub is_done: bool,
    pub is_stalled: bool,
}

impl<T: Real> Progress<T> {
    pub fn new() -> Self {
        Self { before: None }
    }

    /// Forgets the last step, which predicts nothing.
    pub fn forget(&mut self) {
        self.before = None;
    }

    /// Judges the search by the sizes of a step. Next to a jump of the slope, one limit may
    /// converge more slowly than the other.
    pub fn judge(&self, sizes: [T; 2]) -> Judged<T> {
        let size = sizes[0] + sizes[1];
        let next: [T; 2] = std::array::from_fn(|i| match self.before {
            Some(before) if sizes[i] < before[i] => (sizes[i] / before[i]).powi(2) * sizes[i],
            _ => sizes[i],
        });
        let rounding = T::of(0.5) * T::epsilon();
        let stalls = |[one, other]: [T; 2]| size >= T::of(STALL_RATIO) * (one + other);
        Judged {
            next,
            is_done: next[0] + next[1] <= rounding && size <= T::of(MAX_PREDICTING_STEP),
            is_stalled: self.before.is_some_and(stalls),
        }
    }

    /// Tells whether a step is no shorter than the one before.
    pub fn has_grown_to(&self, size: T) -> bool {
        self.before.is_some_and(|[one, other]| size >= one + other)
    }

    /// Records the sizes of a step.
    pub fn note(&mut self, sizes: [T; 2]) {
        self.before = Some(sizes).filter(|&[one, other]| one + other <= T::of(MAX_PREDICTING_STEP));
    }
}

/// Tells whether a limit crosses a breakpoint between two trials, or comes within rounding of one.
pub(super) fn crosses_breakpoint<T: Real>(
    gap: &Gap<'_, T>,
    from: Interval<T>,
    to: Interval<T>,
) -> bool {
    [[from.left, to.left], [from.right, to.right]].into_iter().any(|[one, other]| {
        let rounding = T::of(4.0) * T::epsilon() * other.abs();
        let passed = Interval { left: one.min(other) - rounding, right: one.max(other) + rounding };
        gap.breakpoints(passed).next().is_some()
    })
}
