//! Errors of a scene, with remedies.

mod advice;
mod evaluation;
mod input;
mod reference;
mod solve;

pub(crate) use advice::is_subnormal;
pub use evaluation::EvaluationError;
pub use input::InputError;
pub use reference::ReferenceError;
pub use solve::SolveError;

use crate::profile::SplineError;
use crate::{PiecewiseError, ProfileError, Real};
use std::fmt;
use thiserror::Error;

/// One of the two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {
    /// Body 1, below.
    Lower,
    /// Body 2, above.
    Upper,
}

impl fmt::Display for Body {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Lower => "lower",
            Self::Upper => "upper",
        })
    }
}

/// Reason why a contact could not be solved, or a question to its solution not be answered, by who
/// is at fault: the input, the solve, or the question.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ContactError<T: Real> {
    /// A body, edge, load or setting is invalid.
    #[error(transparent)]
    Input(#[from] InputError<T>),
    /// No contact was found, or the result is not a contact.
    #[error(transparent)]
    Solve(#[from] SolveError<T>),
    /// The contact is known, but the quantity asked for is not available there.
    #[error(transparent)]
    Evaluation(#[from] EvaluationError<T>),
}

/// Result of a step of a solve.
pub(crate) type Fallible<T, R> = Result<R, ContactError<T>>;

/// Makes the errors of bodies and closed forms errors of the input.
macro_rules! of_the_input {
    ($($error:ident)*) => {$(
        impl<T: Real> From<$error<T>> for ContactError<T> {
            fn from(error: $error<T>) -> Self {
                Self::Input(error.into())
            }
        }
    )*};
}
of_the_input! { ProfileError PiecewiseError SplineError ReferenceError }

impl<T: Real> ContactError<T> {
    /// Returns this error, marked with whether κ is the default.
    pub(crate) fn with_stiffness(mut self, is_default: bool) -> Self {
        use SolveError::{DomainTooShort, HalfWidthTooLarge, PeakTooHigh};
        if let Self::Solve(
            DomainTooShort { kappa_is_default, .. }
            | HalfWidthTooLarge { kappa_is_default, .. }
            | PeakTooHigh { kappa_is_default, .. },
        ) = &mut self
        {
            *kappa_is_default = is_default;
        }
        self
    }

    /// Tells whether a search for one contact may end with this error because the bodies touch in
    /// several places.
    pub(crate) fn may_be_several(&self) -> bool {
        matches!(
            self,
            Self::Solve(
                SolveError::NoFirstContact { .. }
                    | SolveError::DomainTooShort { .. }
                    | SolveError::NoEquilibrium { .. }
                    | SolveError::OutsideBodies { .. }
                    | SolveError::Overflow { .. }
                    | SolveError::LiftsOff { .. }
            )
        )
    }
}
