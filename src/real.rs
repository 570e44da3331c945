//! The scalar type of the crate.

use crate::compiled::*;
use nalgebra::RealField;
use num_traits::FromPrimitive;

/// Real number that the solver can work in: `f32`, `f64`, with the feature `autodiff` dual numbers,
/// and any other `Copy` type that is a [`nalgebra::RealField`], by an empty `impl`.
///
/// A dual number must override [`COMPONENTS`](Self::COMPONENTS),
/// [`DERIVATIVE_ORDER`](Self::DERIVATIVE_ORDER) and [`component`](Self::component). The solver
/// decides by the value, and stops when all components have converged.
#[diagnostic::on_unimplemented(
    message = "the solver does not work in numbers of type `{Self}`",
    label = "not a `Real`",
    note = "use `f64` or `f32` (write `1.0`, not `1`), or with the feature `autodiff` dual numbers",
    note = "for a `nalgebra::RealField` of your own: `impl linecontact::Real for YourType {{}}`"
)]
pub trait Real: RealField + Copy {
    /// Number of plain numbers in it: 1, and for a dual number one more for each derivative.
    const COMPONENTS: usize = 1;

    /// Number of Newton steps that a solution takes after its value has converged, so that the
    /// derivatives converge: the order of the highest derivative.
    const DERIVATIVE_ORDER: usize = 0;

    /// Returns one of the [`COMPONENTS`](Self::COMPONENTS), as a number without derivatives. The
    /// first is the value.
    #[must_use]
    fn component(self, _index: usize) -> Self {
        self
    }

    /// Returns the number of this type nearest to `value`.
    #[must_use]
    fn of(value: f64) -> Self {
        nalgebra::convert(value)
    }

    /// Returns a count as a number of this type.
    #[must_use]
    fn count(n: usize) -> Self {
        FromPrimitive::from_usize(n).unwrap_or_else(|| Self::of(n as f64))
    }

    /// Returns the distance from 1 to the next larger number of this type.
    #[must_use]
    fn epsilon() -> Self {
        Self::default_epsilon()
    }

    entries!(doc(hidden));
}

impl Real for f32 {}
impl Real for f64 {
    // Unit tests ask for little of the solver.
    #[cfg(not(test))]
    entries!(inline(never));
}

/// Tells whether two numbers agree in all components. (Dual numbers compare by their values.)
pub(crate) fn same<T: Real>(a: T, b: T) -> bool {
    (0..T::COMPONENTS).all(|i| a.component(i) == b.component(i))
}

/// Tells whether a number is finite in all components.
pub(crate) fn is_finite<T: Real>(a: T) -> bool {
    (0..T::COMPONENTS).all(|i| a.component(i).is_finite())
}

/// Returns `a b + c`, with one rounding where the processor has an instruction for it. (Without
/// one, the exact result would take a hundred times as long.)
#[inline(always)]
pub(crate) fn fma<T: Real>(a: T, b: T, c: T) -> T {
    if cfg!(any(target_feature = "fma", target_arch = "aarch64")) {
        a.mul_add(b, c)
    } else {
        a * b + c
    }
}
