//! Numbers as they are shown: with their significant digits.

use crate::{Interval, Real};
use num_traits::ToPrimitive;
use std::fmt::{Display, Formatter, Result};

/// Number of digits shown, unless a precision asks for more or another number must be told apart.
pub(crate) const DIGITS: usize = 6;

/// Number of digits that distinguish every `f64` from its neighbours.
const ALL_DIGITS: usize = 17;

/// Number and its count of significant digits; trailing zeros are dropped.
pub(crate) struct Rounded(pub f64, pub usize);

impl Rounded {
    fn value(&self) -> f64 {
        let Self(value, digits) = *self;
        format!("{value:.*e}", digits.max(1) - 1).parse().unwrap_or(value)
    }
}

impl Display for Rounded {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let rounded = self.value();
        let size = rounded.abs();
        if size != 0.0 && !(1e-3..1e6).contains(&size) && size.is_finite() {
            write!(f, "{rounded:e}")
        } else {
            write!(f, "{rounded}")
        }
    }
}

/// Rounds a number in a message to six digits; the fields of the error have all of them.
pub(crate) fn six<T: Real>(value: T) -> Rounded {
    Rounded(value.to_subset_unchecked(), DIGITS)
}

/// Rounds a place in an interval: with more digits than others by as many as the interval is
/// shorter than it is far from 0.
pub(crate) fn within<T: Real>(x: T, on: &Interval<T>, digits: usize) -> Rounded {
    let far = on.left.abs().max(on.right.abs()) / (on.right - on.left);
    let more: f64 = far.log10().floor().max(T::zero()).component(0).to_subset_unchecked();
    Rounded(x.to_subset_unchecked(), ALL_DIGITS.min(digits + more.to_usize().unwrap_or(0)))
}

/// Rounds a number in a message that names others too: with more digits if six do not tell them
/// apart.
pub(crate) fn apart<T: Real>(value: T, others: &[T]) -> Rounded {
    let value: f64 = value.to_subset_unchecked();
    let others = || others.iter().map(|other| other.to_subset_unchecked());
    let told = |digits: &usize| {
        let shown = Rounded(value, *digits).value();
        others().all(|other: f64| other == value || Rounded(other, *digits).value() != shown)
    };
    Rounded(value, (DIGITS..ALL_DIGITS).find(told).unwrap_or(ALL_DIGITS))
}

/// Makes the ends of a flat, which has none, infinite.
pub(crate) fn endless<T: Real>(x: T) -> T {
    if (x * T::of(8.0)).is_finite() { x } else { x * T::of(f64::INFINITY) }
}

/// Range from one number to another.
pub(crate) struct Span(Rounded, Rounded);

pub(crate) fn span<T: Real>(from: T, to: T) -> Span {
    Span(apart(from, &[to]), apart(to, &[from]))
}

impl Display for Span {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write!(f, "{} to {}", self.0, self.1)
    }
}

/// Share of a half-width in the rounding of x from which on no contact can be found, as its limits
/// have an error of a few roundings.
const LOST: f64 = 1e-3;

/// Tells whether the rounding of x is the error of a contact.
pub(crate) fn is_far<T: Real>(near: T, half_width: T) -> bool {
    T::epsilon() * near.abs() > T::of(LOST) * half_width
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_tell_something() {
        assert_eq!(six(5.4150623612943445).to_string(), "5.41506");
        assert_eq!(six(0.1f32).to_string(), "0.1");
        assert_eq!(six(-1.5e-18).to_string(), "-1.5e-18");
        assert_eq!(six(f64::NAN).to_string(), "NaN");
        assert_eq!(six(f64::INFINITY).to_string(), "inf");
        assert_eq!(apart(0.5, &[0.500_000_012_3]).to_string(), "0.5");
        assert_eq!(apart(0.500_000_012_3, &[0.5]).to_string(), "0.50000001");
        assert_eq!(apart(0.1, &[0.1]).to_string(), "0.1");
        assert_eq!(apart(f64::NAN, &[f64::NAN]).to_string(), "NaN");
        assert_eq!(span(1e6, 1e6 + 0.25).to_string(), "1e6 to 1.0000002e6");
        assert_eq!(apart(1.0, &[1.0 + f64::EPSILON]).to_string(), "1");
        let next = apart(1.0 + f64::EPSILON, &[1.0]).to_string();
        assert_eq!(next.parse::<f64>(), Ok(1.0 + f64::EPSILON));
    }
}
