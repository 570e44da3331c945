//! The one scalar bound of the crate.

use nalgebra::RealField;
use num_traits::FromPrimitive;

/// A real number the solver can work in: `f32`, `f64`, and any other `Copy` type that
/// is a [`nalgebra::RealField`].
///
/// Implemented for every such type; there is nothing to write.
pub trait Real: RealField + Copy {
    /// The number of this type nearest to `value`.
    fn of(value: f64) -> Self {
        nalgebra::convert(value)
    }

    /// A count as a number of this type.
    fn count(n: usize) -> Self {
        FromPrimitive::from_usize(n).unwrap_or_else(|| Self::of(n as f64))
    }

    /// Distance from 1 to the next larger number of this type.
    fn epsilon() -> Self {
        Self::default_epsilon()
    }
}

impl<T: RealField + Copy> Real for T {}

/// `a b + c`, with one rounding where the processor has an instruction for it. (Without one, the exact
/// result would take a hundred times as long.)
#[inline(always)]
pub(crate) fn fma<T: Real>(a: T, b: T, c: T) -> T {
    if cfg!(any(target_feature = "fma", target_arch = "aarch64")) {
        a.mul_add(b, c)
    } else {
        a * b + c
    }
}

/// A sum that carries its rounding error along (Neumaier's variant of Kahan's sum).
///
/// The terms next to the pole of a Cauchy integral are large and of alternating sign;
/// summed plainly they would cost the last three digits.
#[derive(Clone, Copy)]
pub(crate) struct Sum<T> {
    total: T,
    lost: T,
}

impl<T: Real> Sum<T> {
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
        // What an infinite sum has lost is NaN.
        if self.total.is_finite() { self.total + self.lost } else { self.total }
    }
}
