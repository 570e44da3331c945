//! Point of first contact: the slope of the gap passes there from negative to positive. Every
//! single contact of a gap whose slope rises contains it.

use crate::gap::{Gap, Sampler};
use crate::search::{Bracket, Brent, SearchError, TryFindError, try_find};
use crate::{ContactError, Fallible, Interval, Real, Side, SolveError};

/// Abscissae and the slope of the gap there.
type Signs<T> = [[T; 2]; 2];

/// Tells whether the slope passes through zero from negative to positive.
fn rises<T: Real>([[_, left], [_, right]]: Signs<T>) -> bool {
    left <= T::zero() && right >= T::zero() && left < right
}

/// Finds the point of first contact, looking first at the start, or else in the middle of the
/// bodies.
pub(super) fn first_contact<T: Real>(
    sampler: &mut Sampler<T>,
    gap: &Gap<'_, T>,
    start: Option<Interval<T>>,
) -> Fallible<T, T> {
    let mut signs = enclose(sampler, gap, start)?;
    // The slope may jump through zero at a breakpoint, as for a wedge; others narrow the bracket.
    let mut after = signs[0][0];
    while let Some(x) = gap.breakpoint_after(after).filter(|&x| x < signs[1][0]) {
        let left = sampler.slope_from(gap, x, Side::Left)?;
        let right = sampler.slope_from(gap, x, Side::Right)?;
        match [left > T::zero(), right < T::zero()] {
            [true, _] => signs[1] = [x, left],
            [_, true] => signs[0] = [x, right],
            _ => return Ok(x),
        }
        after = x;
    }
    zero(sampler, gap, signs, start.is_some())
}

/// Widens an interval until the slope is negative on the left and positive on the right, or looks
/// for such a place in it. The ends of the bodies are approached but not reached: the slope of a
/// round body may be infinite there.
fn enclose<T: Real>(
    sampler: &mut Sampler<T>,
    gap: &Gap<'_, T>,
    start: Option<Interval<T>>,
) -> Fallible<T, Signs<T>> {
    const SCAN_STEPS: usize = 32;
    let ([left, right], half) = (gap.range(), T::of(0.5));
    let whole = Interval { left, right };
    let quarter = half * whole.half_width() * half;
    let middle = Interval { left: whole.centre() - quarter, right: whole.centre() + quarter };
    let inside = |start: &Interval<T>| whole.contains(start.left) && whole.contains(start.right);
    let start = start.filter(inside).unwrap_or(middle);

    let mut at = |x| Ok::<_, ContactError<T>>([x, sampler.slope(gap, x)?]);
    let mut signs = [at(start.left)?, at(start.right)?];
    let mut step = start.half_width();
    while !rises(signs) {
        step *= T::of(2.0);
        let [[a, falls], [b, grows]] = signs;
        // Outward by the step, or half the way to the end.
        let lower = if falls >= T::zero() { (a - step).max(half * a + half * left) } else { a };
        let upper = if grows <= T::zero() { (b + step).min(half * b + half * right) } else { b };
        if [lower, upper] == [a, b] || !(whole.contains(lower) && whole.contains(upper)) {
            let mut last = at(start.left)?;
            for i in 1..=SCAN_STEPS {
                let share = T::count(i) / T::count(SCAN_STEPS);
                let next = at((start.left + (start.right - start.left) * share).min(start.right))?;
                if rises([last, next]) {
                    return Ok([last, next]);
                }
                last = next;
            }
            // One of both may be far from the ends, between which nothing is found.
            let ends = [at(left)?, at(right)?];
            let is_known = ends[0][1].is_finite() && ends[1][1].is_finite() && !rises(ends);
            let [[a, falls], [b, grows]] = if is_known { ends } else { signs };
            return Err(SolveError::NoFirstContact { x: [a, b], slope: [falls, grows] }.into());
        }
        signs = [
            if lower == a { signs[0] } else { at(lower)? },
            if upper == b { signs[1] } else { at(upper)? },
        ];
    }
    Ok(signs)
}

/// Finds the zero of the slope in the bracket. The flag tells that its ends are about those of the
/// contact.
fn zero<T: Real>(
    sampler: &mut Sampler<T>,
    gap: &Gap<'_, T>,
    [[left, falls], [right, rises]]: Signs<T>,
    is_about_contact: bool,
) -> Fallible<T, T> {
    // Near x = 0 a relative tolerance never ends the search; for the share of the bracket, plus
    // one, it does.
    let (one, by_share) = (T::one(), is_about_contact && left < T::zero() && right > T::zero());
    let at = |u: T| if by_share { left + (u - one) * (right - left) } else { u };
    let [lo, hi] = if by_share { [one, one + one] } else { [left, right] };
    let bracket = Bracket::new(lo, hi).values(falls, rises);
    match try_find(&Brent::default(), |u| sampler.slope(gap, at(u)), &bracket) {
        // Any point of a bracket this tight lies in the contact.
        Ok(root) | Err(TryFindError::Search(SearchError::Budget { best: root })) => Ok(at(root.x)),
        Err(error) => Err(error.or_else(|_| {
            SolveError::NoFirstContact { x: [left, right], slope: [falls, rises] }.into()
        })),
    }
}
