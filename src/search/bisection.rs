//! Bisection.

use super::bracket_state::BracketState;
use super::{Bracket, LimitSearch, Root, SearchError, StoppingCriteria};
use crate::Real;

strategy! {
    /// Bisection: one bit of `x` for each evaluation, whatever the function.
    Bisection
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
