//! Point of first contact: the slope of the gap passes there from negative to positive. Every
//! single contact of a gap whose slope rises contains it.

use crate::gap::{Gap, Sampler};
use crate::search::{Bracket, Brent, SearchError, TryFindError, try_find};
use crate::{ContactError, Fallible, Interval, Real, Side, SolveError};

/// Two abscissae and the slope of the gap there.
struct Signs<T> {
    x: [T; 2],
    slope: [T; 2],
}

/// Finds the point of first contact, looking first at the start, or else in the middle of the
/// bodies.
pub(super) fn first_contact<T: Real>(
    sampler: &mut Sampler<T>,
    gap: &Gap<'_, T>,
    start: Option<Interval<T>>,
) -> Fallible<T, T> {
    let range = gap.range();
    let mut signs = widen(sampler, gap, Interval { left: range[0], right: range[1] }, start)?;
    match jump(sampler, gap, &mut signs)? {
        Some(breakpoint) => Ok(breakpoint),
        None => zero(sampler, gap, signs, start.is_some()),
    }
}

/// Widens an interval until the slope is negative on the left and positive on the right. The ends
/// of the bodies are approached but not reached: the slope of a round body may be infinite there.
fn widen<T: Real>(
    sampler: &mut Sampler<T>,
    gap: &Gap<'_, T>,
    whole: Interval<T>,
    start: Option<Interval<T>>,
) -> Fallible<T, Signs<T>> {
    let (zero, half) = (T::zero(), T::of(0.5));
    let quarter = T::of(0.25) * whole.half_width();
    let middle = Interval { left: whole.centre() - quarter, right: whole.centre() + quarter };
    let inside = |start: &Interval<T>| whole.contains(start.left) && whole.contains(start.right);
    let start = start.filter(inside).unwrap_or(middle);

    let (mut x, mut step) = ([start.left, start.right], start.half_width());
    let mut slope = [sampler.slope(gap, x[0])?, sampler.slope(gap, x[1])?];
    while !(slope[0] <= zero && slope[1] >= zero && slope[0] < slope[1]) {
        let before = x;
        step *= T::of(2.0);
        // Outward by the step, or half the way to the end.
        if slope[0] >= zero {
            x[0] = (x[0] - step).max(half * x[0] + half * whole.left);
        }
        if slope[1] <= zero {
            x[1] = (x[1] + step).min(half * x[1] + half * whole.right);
        }
        if x == before || !(whole.contains(x[0]) && whole.contains(x[1])) {
            let fault = SolveError::NoFirstContact { x: before, slope };
            return scan(sampler, gap, start, fault.into());
        }
        for i in 0..2 {
            if x[i] != before[i] {
                slope[i] = sampler.slope(gap, x[i])?;
            }
        }
    }
    Ok(Signs { x, slope })
}

/// Looks for the change of sign between the ends of the start, if none was found outside it.
fn scan<T: Real>(
    sampler: &mut Sampler<T>,
    gap: &Gap<'_, T>,
    start: Interval<T>,
    not_found: ContactError<T>,
) -> Fallible<T, Signs<T>> {
    const SCAN_STEPS: usize = 32;
    let step = (start.right - start.left) / T::count(SCAN_STEPS);
    let mut left = (start.left, sampler.slope(gap, start.left)?);
    for i in 1..=SCAN_STEPS {
        let x = start.left + step * T::count(i);
        let right = (x.min(start.right), sampler.slope(gap, x.min(start.right))?);
        if left.1 <= T::zero() && right.1 >= T::zero() && left.1 < right.1 {
            return Ok(Signs { x: [left.0, right.0], slope: [left.1, right.1] });
        }
        left = right;
    }
    Err(not_found)
}

/// Returns the breakpoint at which the slope jumps through zero, as for a wedge; other breakpoints
/// narrow the bracket.
fn jump<T: Real>(
    sampler: &mut Sampler<T>,
    gap: &Gap<'_, T>,
    Signs { x, slope }: &mut Signs<T>,
) -> Fallible<T, Option<T>> {
    let mut after = x[0];
    while let Some(breakpoint) = gap.breakpoint_after(after).filter(|&breakpoint| breakpoint < x[1])
    {
        after = breakpoint;
        let left = sampler.slope_from(gap, breakpoint, Side::Left)?;
        let right = sampler.slope_from(gap, breakpoint, Side::Right)?;
        if left > T::zero() {
            (x[1], slope[1]) = (breakpoint, left);
        } else if right < T::zero() {
            (x[0], slope[0]) = (breakpoint, right);
        } else {
            return Ok(Some(breakpoint));
        }
    }
    Ok(None)
}

/// Finds the zero of the slope in the bracket. The flag tells that its ends are about those of the
/// contact.
fn zero<T: Real>(
    sampler: &mut Sampler<T>,
    gap: &Gap<'_, T>,
    Signs { x, slope }: Signs<T>,
    is_about_contact: bool,
) -> Fallible<T, T> {
    // Near x = 0 a relative tolerance never ends the search; for the share of the bracket, plus
    // one, it does.
    let [one, width] = [T::one(), x[1] - x[0]];
    let by_share = is_about_contact && x[0] < T::zero() && x[1] > T::zero();
    let at = |u: T| if by_share { x[0] + (u - one) * width } else { u };
    let ends = if by_share { [one, one + one] } else { x };
    let bracket = Bracket::new(ends[0], ends[1]).values(slope[0], slope[1]);
    match try_find(&Brent::default(), |u| sampler.slope(gap, at(u)), &bracket) {
        // Any point of a bracket this tight lies in the contact.
        Ok(root) | Err(TryFindError::Search(SearchError::Budget { best: root })) => Ok(at(root.x)),
        Err(error) => Err(error.or_else(|_| SolveError::NoFirstContact { x, slope }.into())),
    }
}
