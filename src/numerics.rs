//! Numerical methods that know nothing of contact.

pub(crate) mod chebyshev;
mod compensated_sum;
mod far_field;
pub(crate) mod gauss_legendre;
mod linear_system;
pub(crate) mod special_functions;

pub(crate) use compensated_sum::CompensatedSum;
pub(crate) use far_field::{Combine, FarField};
pub(crate) use linear_system::LinearSystem;

use crate::Real;
use std::cmp::Ordering;

/// Returns the order of two numbers by size, NaN first: a total order, which sorting needs.
pub(crate) fn ascending<T: Real>(one: &T, other: &T) -> Ordering {
    let is_number = |value: &T| value.partial_cmp(value).is_some();
    one.partial_cmp(other).unwrap_or_else(|| is_number(one).cmp(&is_number(other)))
}

/// Returns `Σ a b`, in four sums that a machine can add up at once.
pub(crate) fn dot<T: Real>(a: &[T], b: &[T]) -> T {
    let mut sums = [T::zero(); 4];
    let (a4, b4) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest = a4.remainder().iter().zip(b4.remainder());
    let total = rest.fold(T::zero(), |sum, (&a, &b)| sum + a * b);
    for (a, b) in a4.zip(b4) {
        for i in 0..4 {
            sums[i] += a[i] * b[i];
        }
    }
    sums.into_iter().fold(total, |total, sum| total + sum)
}
