//! Newton's method, kept inside the bracket.

use super::SearchError;
use super::bracket_state::BracketState;
use crate::Real;

pub(super) fn newton<T: Real>(state: &mut BracketState<'_, T>) -> Result<(), SearchError<T>> {
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
    Ok(())
}
