//! Newton's method on all limits of the contacts at once, and on the load or the tilt where that is sought.
//!
//! A search goes from trial to trial. Each states the equations and their exact Jacobian, which come from the
//! quadrature, and takes the step by them, cut short where it would lead too far. The search ends where the next step
//! would be less than rounding, or where rounding keeps the steps from falling any further.
//!
//! [One contact](single) has its tilt eliminated and moves by the balance of its two limits; [several](several) close
//! gaps and lose contacts.

pub(super) mod linearised;
pub(super) mod several;
pub(super) mod single;

use crate::gap::Gap;
use crate::{Interval, Real, Side};

/// Why a search has ended without limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Stop<T> {
    /// The gap after this contact closes.
    Closed(usize),
    /// This contact vanishes.
    Lost(usize),
    /// Step after step leads beyond an end of the bodies; how far they went.
    Beyond {
        side: Side,
        reached: Interval<T>,
    },
    Failed,
}

/// The longest step, as a share of a half-width, that tells of the next one.
const TELLING: f64 = 0.25;

/// The share of the step before that a step has at least where rounding keeps it from falling.
const STALLED: f64 = 0.25;

/// The steps of a search, by which the next one is foretold: their sizes fall by squares.
#[derive(Clone, Copy)]
pub(super) struct Progress<T> {
    /// The sizes of the step before, of both limits of a contact or of all limits as one, as shares of a half-width;
    /// unless it was too long, or cut short.
    before: Option<[T; 2]>,
}

/// The judgement of a search by its last step.
#[derive(Clone, Copy)]
pub(super) struct Judged<T> {
    /// The sizes of the next step.
    pub next: [T; 2],
    pub is_done: bool,
    pub is_stalled: bool,
}

impl<T: Real> Progress<T> {
    pub fn new() -> Self {
        Self { before: None }
    }

    /// Forgets the last step, which tells nothing of the next.
    pub fn forget(&mut self) {
        self.before = None;
    }

    /// Judges the search by the sizes of a step. Beside a jump of the slope one limit may close in slower than the other.
    pub fn judge(&self, sizes: [T; 2]) -> Judged<T> {
        let size = sizes[0] + sizes[1];
        let next: [T; 2] = std::array::from_fn(|i| match self.before {
            Some(before) if sizes[i] < before[i] => (sizes[i] / before[i]).powi(2) * sizes[i],
            _ => sizes[i],
        });
        let rounding = T::of(0.5) * T::epsilon();
        let stalls = |[one, other]: [T; 2]| size >= T::of(STALLED) * (one + other);
        Judged {
            next,
            is_done: next[0] + next[1] <= rounding && size <= T::of(TELLING),
            is_stalled: self.before.is_some_and(stalls),
        }
    }

    /// Takes note of a step.
    pub fn note(&mut self, sizes: [T; 2]) {
        self.before = Some(sizes).filter(|&[one, other]| one + other <= T::of(TELLING));
    }
}

/// Tells whether a limit passes a breakpoint from one trial to the next, or comes as close to one as rounding.
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
