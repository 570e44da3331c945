//! Bisection.

use super::bracket_state::BracketState;
use super::{Bracket, LimitSearch, Root, SearchError, StoppingCriteria};
use crate::Real;

/// Halves the bracket: one bit of `x` for each evaluation, whatever the function.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct Bisection {
    /// When to stop.
    pub tolerance: StoppingCriteria,
}

impl Bisection {
    /// All digits.
    pub const DEFAULT: Self = Self { tolerance: StoppingCriteria::FULL };
}

impl<T: Real> LimitSearch<T> for Bisection {
    fn find(
        &self,
        f: &mut dyn FnMut(T) -> T,
        bracket: &Bracket<T>,
    ) -> Result<Root<T>, SearchError<T>> {
        let mut f = |x| (f(x), None);
        let mut state = BracketState::new(&mut f, bracket, self.tolerance)?;
        while !state.done() && state.halve()? {}
        Ok(state.root())
    }
}
