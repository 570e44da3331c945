//! The secant method.

use super::roots_adapter::{Method, run};
use super::{Bracket, LimitSearch, Root, SearchError, StoppingCriteria};
use crate::Real;

/// The secant method of the `roots` crate, kept inside the bracket: where it would step
/// out, meets two equal values or crawls, the bracket is halved and it starts again.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct Secant {
    /// When to stop.
    pub tolerance: StoppingCriteria,
}

impl Secant {
    /// All digits.
    pub const DEFAULT: Self = Self { tolerance: StoppingCriteria::FULL };
}

impl<T: Real> LimitSearch<T> for Secant {
    fn find(
        &self,
        f: &mut dyn FnMut(T) -> T,
        bracket: &Bracket<T>,
    ) -> Result<Root<T>, SearchError<T>> {
        run(Method::Secant, f, bracket, self.tolerance)
    }
}
