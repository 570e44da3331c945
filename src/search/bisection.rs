//! Bisection.

use super::SearchError;
use super::bracket_state::BracketState;
use crate::Real;

pub(super) fn bisect<T: Real>(state: &mut BracketState<'_, T>) -> Result<(), SearchError<T>> {
    while !state.done() && state.halve()? {}
    Ok(())
}
