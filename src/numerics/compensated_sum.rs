//! A compensated sum.

use crate::Real;

/// Sum that carries its rounding error along (Neumaier's variant of Kahan's sum).
///
/// The terms next to the pole of a Cauchy integral are large and of alternating sign; a plain sum
/// would cost the last three digits.
#[derive(Clone, Copy)]
pub(crate) struct CompensatedSum<T> {
    total: T,
    lost: T,
}

impl<T: Real> CompensatedSum<T> {
    pub fn new() -> Self {
        Self { total: T::zero(), lost: T::zero() }
    }

    pub fn of(total: T) -> Self {
        Self { total, lost: T::zero() }
    }

    pub fn add(&mut self, term: T) {
        let next = self.total + term;
        self.lost += if self.total.abs() >= term.abs() {
            (self.total - next) + term
        } else {
            (term - next) + self.total
        };
        self.total = next;
    }

    pub fn value(self) -> T {
        // The rounding error of an infinite sum is NaN.
        if self.total.is_finite() { self.total + self.lost } else { self.total }
    }
}
