//! Bisection.

use super::tracker::Tracker;
use super::{Bracket, LimitSearch, Root, SearchError, Tolerance};
use crate::Real;

/// Halves the bracket: one bit of `x` for each evaluation, whatever the function.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bisection {
    /// When to stop.
    pub tolerance: Tolerance,
}

impl Bisection {
    /// All digits.
    pub const DEFAULT: Self = Self { tolerance: Tolerance::FULL };
}

impl<T: Real> LimitSearch<T> for Bisection {
    fn find(
        &self,
        f: &mut dyn FnMut(T) -> T,
        bracket: &Bracket<T>,
    ) -> Result<Root<T>, SearchError<T>> {
        let mut f = |x| (f(x), None);
        let mut tracker = Tracker::new(&mut f, bracket, self.tolerance)?;
        while !tracker.done() && tracker.halve()? {}
        Ok(tracker.root())
    }
}
