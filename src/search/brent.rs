//! Brent's method.

use super::roots_adapter::{Method, run};
use super::{Bracket, LimitSearch, Root, SearchError, StoppingCriteria};
use crate::Real;

/// Brent's method: inverse quadratic interpolation where it converges, halving where not.
///
/// Brent, *Algorithms for Minimization without Derivatives* (1973), chapter 4, as
/// implemented by the `roots` crate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct Brent {
    /// When to stop.
    pub tolerance: StoppingCriteria,
}

impl Brent {
    /// All digits.
    pub const DEFAULT: Self = Self { tolerance: StoppingCriteria::FULL };
}

impl<T: Real> LimitSearch<T> for Brent {
    fn find(
        &self,
        f: &mut dyn FnMut(T) -> T,
        bracket: &Bracket<T>,
    ) -> Result<Root<T>, SearchError<T>> {
        run(Method::Brent, f, bracket, self.tolerance)
    }
}
