//! Newton's method, kept inside the bracket.

use super::tracker::Tracker;
use super::{Bracket, LimitSearch, Root, SearchError, Tolerance};
use crate::Real;

/// Newton's method with the slope that comes with the value, kept inside the sign change.
///
/// Where the function gives no slope, the chord through the last two points stands in for
/// it (a safeguarded secant). A step that would leave the sign change, or that did not
/// halve the step before last, is replaced by a halving of the bracket.
///
/// The value of a function that cancels large terms has noise, and near the root the steps
/// then stop shrinking long before they reach the tolerance. The search ends there. It is
/// taken for noise if the steps have shrunk a hundredfold at once, as they do close to a simple
/// root, and then one fails to shrink though it is tiny: below the square root of the rounding
/// unit compared with `x`, or with a value at the rounding of those at the ends of the bracket.
/// So is a value of that size that does not change from one point to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Newton {
    /// When to stop.
    pub tolerance: Tolerance,
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
        self.run(
            &mut |x| {
                let (value, slope) = f(x);
                (value, Some(slope))
            },
            bracket,
        )
    }
}

impl Newton {
    fn run<T: Real>(
        &self,
        f: &mut dyn FnMut(T) -> (T, Option<T>),
        bracket: &Bracket<T>,
    ) -> Result<Root<T>, SearchError<T>> {
        let mut tracker = Tracker::new(f, &Bracket { guess: None, ..*bracket }, self.tolerance)?;
        let rounding = T::of(4.0) * T::epsilon() * tracker.lo.f.abs().max(tracker.hi.f.abs());
        if let Some(guess) = bracket.guess {
            tracker.visit(guess)?;
        }
        // The last two steps since the last halving, and whether they shrank as they should.
        let (mut last, mut before_last, mut converging) = (None, None, false);
        let mut at = tracker.last;
        let mut chord = (tracker.hi.f - tracker.lo.f) / (tracker.hi.x - tracker.lo.x);
        while !tracker.done() {
            let step = -at.f / at.slope.unwrap_or(chord);
            // A slope that is zero or infinite says nothing about where the root is.
            let usable = step.is_finite() && !step.is_zero();
            if usable {
                if tracker.negligible(step, at.x) {
                    break;
                }
                let left = left_after(step, last, before_last, at.slope.is_some());
                if tracker.negligible(left, at.x) {
                    tracker.visit(at.x + step)?;
                    break;
                }
                converging |= last.is_some_and(|last| step.abs() < T::of(0.01) * last.abs());
                let tiny = |last: T| {
                    last.abs() <= T::epsilon().sqrt() * at.x.abs() || at.f.abs() <= rounding
                };
                let stalled = |last: T| tiny(last) && step.abs() >= T::of(0.25) * last.abs();
                if converging && last.is_some_and(stalled) {
                    break;
                }
            }
            let shrinks = |before: T| step.abs() <= T::of(0.5) * before.abs();
            let good = usable && before_last.is_none_or(shrinks);
            let next = if good { tracker.visit(at.x + step)? } else { None };
            (before_last, last) = match next {
                Some(seen) => (last, Some(seen.x - at.x)),
                None if tracker.halve()? => {
                    converging = false;
                    (None, None)
                }
                None => break,
            };
            let next = tracker.last;
            if next.f == at.f && next.f.abs() <= rounding {
                break;
            }
            chord = (next.f - at.f) / (next.x - at.x);
            at = next;
        }
        Ok(tracker.root())
    }
}

/// The error to be expected after a step, from how the last ones have shrunk: each is a
/// multiple of the square of the one before (Newton), or of the product of the two before
/// (chord). Infinite as long as too few have been made.
fn left_after<T: Real>(step: T, last: Option<T>, before_last: Option<T>, quadratic: bool) -> T {
    match (last, before_last) {
        (Some(last), _) if quadratic => step * (step / last).powi(2),
        (Some(_), Some(before_last)) => step * (step / before_last),
        _ => T::one() / T::zero(),
    }
}
