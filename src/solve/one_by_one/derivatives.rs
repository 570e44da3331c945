//! Derivatives of limits found by a search of one unknown at a time.
//!
//! Such a search ends when the values of the limits have converged, whatever their derivatives. A
//! few steps with a fixed Jacobian, from finite differences, supply the derivatives: each step
//! reduces their error by a factor as small as the relative error of the differences. Plain numbers
//! need no steps.

use crate::gap::{Cost, Gap};
use crate::quadrature::Engine;
use crate::solve::equations::Equations;
use crate::{Ends, Fallible, Interval, Real, SolveError};

/// Number of steps; each gains three to five digits.
const DERIVATIVE_STEPS: usize = 6;

/// Step of the differences, as a share of the half-width.
const STEP_SHARE: f64 = 1e-5;

/// Returns the limits that meet the conditions, with their derivatives; with a given half-width,
/// only the place is sought.
pub(super) fn differentiate<T: Real>(
    equations: &Equations<T>,
    gap: &Gap<'_, T>,
    integrator: &mut Engine<T>,
    found: Interval<T>,
    half_width: Option<T>,
    cost: &mut Cost,
) -> Fallible<T, Interval<T>> {
    if T::DERIVATIVE_ORDER == 0 {
        return Ok(found);
    }
    let (zero, half) = (T::zero(), T::of(0.5));
    let size = found.half_width().component(0);
    let Ends { left: left_given, right: right_given } = equations.limits();
    let start = found.plain();
    // Start of the limits, and their directions for each unknown: inward, to stay on the bodies.
    let (start, ways): (Interval<T>, [[T; 2]; 2]) = match (half_width, left_given, right_given) {
        (Some(half_width), ..) => {
            let (left, right) = (start.centre() - half_width, start.centre() + half_width);
            (Interval { left, right }, [[-size, -size], [zero; 2]])
        }
        (None, Some(left), _) => (Interval { left, ..start }, [[zero, -size], [zero; 2]]),
        (None, _, Some(right)) => (Interval { right, ..start }, [[size, zero], [zero; 2]]),
        (None, None, None) => (start, [[size, zero], [zero, -size]]),
    };
    let moved = |on: Interval<T>, [one, other]: [T; 2]| Interval {
        left: on.left + one * ways[0][0] + other * ways[1][0],
        right: on.right + one * ways[0][1] + other * ways[1][1],
    };
    let both = ways[1] != [zero; 2];
    let mut missed = |on: Interval<T>| -> Fallible<T, [T; 2]> {
        let residual = equations.residual(gap, on, integrator, cost)?;
        let (at_a, at_b) = (residual.at_a, residual.at_b);
        Ok(match (both, half_width) {
            (true, _) => [at_b, at_a],
            (false, Some(_)) => [at_a - at_b, zero],
            (false, None) => [half * (at_a + at_b), zero],
        })
    };
    let share = T::of(STEP_SHARE);
    let at_start = missed(start)?;
    let rate = |there: [T; 2]| [0, 1].map(|i| ((there[i] - at_start[i]) / share).component(0));
    let by_one = rate(missed(moved(start, [share, zero]))?);
    let by_other = if both { rate(missed(moved(start, [zero, share]))?) } else { [zero, T::one()] };
    let determinant = by_one[0] * by_other[1] - by_other[0] * by_one[1];
    let mut on = start;
    for _ in 0..DERIVATIVE_STEPS {
        let [first, second] = missed(on)?;
        let one = (by_other[0] * second - by_other[1] * first) / determinant;
        let other = (by_one[1] * first - by_one[0] * second) / determinant;
        on = moved(on, [one, other]);
    }
    // The result must still be the contact that the search has found, within its tolerance.
    let shift = (on.left - found.left).abs().max((on.right - found.right).abs());
    if shift <= T::of(0.25) * size {
        Ok(on)
    } else {
        Err(SolveError::NoEquilibrium { half_width: size, near: found.centre() }.into())
    }
}
