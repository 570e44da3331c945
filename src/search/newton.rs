//! Newton's method, kept inside the bracket.

use super::bracket_state::BracketState;
use super::{Bracket, LimitSearch, Root, SearchError, StoppingCriteria};
use crate::Real;

strategy! {
    /// Newton's method with the slope that comes with the value, kept inside the sign change.
    ///
    /// If the function gives no slope, the chord through the last two points stands in for it (a
    /// safeguarded secant). A step that would leave the sign change, or that did not halve the step
    /// before last, is replaced by a halving of the bracket.
    ///
    /// The value of a function that cancels large terms has noise, and near the root the steps then
    /// stop shrinking long before they reach the tolerance. The search ends there. (It looks for
    /// noise only if the slope is known, for a chord shows no such regularity.) A step counts as
    /// noise if the steps have shrunk a hundredfold at once, as they do close to a simple root, and
    /// it then fails to shrink though it is tiny: below the square root of the rounding unit
    /// compared with `x`, or with a value at the rounding of both values at the ends of the
    /// bracket. A value of that size counts as noise, too, if it stays the same where the slope
    /// says that it should change.
    Newton
}

impl<T: Real> LimitSearch<T> for Newton {
    fn find(
        &self,
        f: &mut dyn FnMut(T) -> T,
        bracket: &Bracket<T>,
    ) -> Result<Root<T>, SearchError<T>> {
        self.run(&mut |x| (f(x), None), bracket)
    }

    fn find_with_slope(
        &self,
        f: &mut dyn FnMut(T) -> (T, T),
        bracket: &Bracket<T>,
    ) -> Result<Root<T>, SearchError<T>> {
        let with_slope = |(value, slope)| (value, Some(slope));
        self.run(&mut |x| with_slope(f(x)), bracket)
    }
}

impl Newton {
    fn run<T: Real>(
        &self,
        f: &mut dyn FnMut(T) -> (T, Option<T>),
        bracket: &Bracket<T>,
    ) -> Result<Root<T>, SearchError<T>> {
        let mut state = BracketState::new(f, bracket, self.tolerance)?;
        // Last two steps since the last halving, and a flag: they shrank as they should.
        let (mut last, mut before_last, mut converging) = (None, None, false);
        let mut at = state.last;
        let mut chord = state.chord();
        while !state.done() {
            let step = -at.f / at.slope.unwrap_or(chord);
            let next = at.x + step;
            // A slope that is zero or infinite says nothing about the place of the root.
            let usable = step.is_finite() && !step.is_zero();
            if usable && state.negligible(step, at.x) {
                if at.slope.is_some() && (last.is_some() || at.f.abs() <= state.rounding) {
                    break;
                }
                // A chord over a steep end makes any step small, and so does a slope that is
                // steep only here, or wrong: then only a closed bracket is proof.
                let before = state.half_width();
                state.close_in()?;
                if !state.halve_since(before)? {
                    break;
                }
                chord = state.chord();
                (before_last, last, at) = (None, None, state.best());
                continue;
            }
            let halves = |before: T| step.abs() <= T::of(0.5) * before.abs();
            // Each step is a multiple of the square of the one before, and so is the next.
            let left = at.slope.and(last).map(|last| step * (step / last).powi(2));
            if usable && left.is_some_and(|left| state.negligible(left, next)) && halves(at.x) {
                state.visit(next)?;
                break;
            }
            converging |= last.is_some_and(|last| step.abs() < T::of(0.01) * last.abs());
            let tiny = |last: T| {
                last.abs() <= T::epsilon().sqrt() * at.x.abs() || at.f.abs() <= state.rounding
            };
            let stalled = |last: T| tiny(last) && step.abs() >= T::of(0.25) * last.abs();
            if at.slope.is_some() && usable && converging && last.is_some_and(stalled) {
                break;
            }
            let good = usable && before_last.is_none_or(halves);
            let seen = if good { state.visit(next)? } else { None };
            (before_last, last, converging) = match seen {
                Some(seen) => (last, Some(seen.x - at.x), converging),
                None if state.halve()? => (None, None, false),
                None => break,
            };
            let next = state.last;
            // The slope says that the value should have changed, but it has not.
            let due = at.slope.map_or(T::zero(), |slope| slope * (next.x - at.x)).abs();
            let same = next.f == at.f && next.f.abs() <= state.rounding;
            if same && due >= T::of(0.5) * next.f.abs() {
                break;
            }
            chord = (next.f - at.f) / (next.x - at.x);
            at = next;
        }
        Ok(state.root())
    }
}
