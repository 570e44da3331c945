//! Derivatives of limits found by a search of one unknown at a time.
//!
//! Such a search ends when the values of the limits have converged, whatever their derivatives. A
//! few steps with a fixed Jacobian, from finite differences, supply the derivatives: each step
//! reduces their error by a factor as small as the relative error of the differences. Plain numbers
//! need no steps.

use crate::gap::{Cost, Gap};
use crate::quadrature::Engine;
use crate::solve::equations::{Equations, Residual};
use crate::{Ends, Fallible, Interval, Real, SolveError};
use nalgebra::{Matrix2, Vector2};

/// Number of steps; each gains three to five digits.
const DERIVATIVE_STEPS: usize = 6;

/// Step of the differences, as a share of the half-width.
const STEP_SHARE: f64 = 1e-5;

/// Returns the limits that meet the conditions, with their derivatives.
pub(super) fn differentiate<T: Real>(
    equations: &Equations<T>,
    gap: &Gap<'_, T>,
    integrator: &mut Engine<T>,
    found: Interval<T>,
    cost: &mut Cost,
) -> Fallible<T, Interval<T>> {
    if T::DERIVATIVE_ORDER == 0 {
        return Ok(found);
    }
    let (start, given) = (found.plain(), equations.limits());
    // The conditions at both edges, or one of them or their difference and what is given.
    let mut missed = |on: Interval<T>| -> Fallible<T, Vector2<T>> {
        let Residual { at_a, at_b, .. } = equations.residual(gap, on, integrator, cost)?;
        Ok(match (equations.half_width(), given) {
            (Some(wanted), _) => Vector2::new(on.half_width() - wanted, at_a - at_b),
            (None, Ends { left: Some(left), .. }) => Vector2::new(on.left - left, at_a),
            (None, Ends { right: Some(right), .. }) => Vector2::new(at_b, on.right - right),
            (None, _) => Vector2::new(at_b, at_a),
        })
    };
    // Inward, to stay on the bodies.
    let size = start.half_width();
    let (step, at_start) = (T::of(STEP_SHARE) * size, missed(start)?);
    let by_left = (missed(Interval { left: start.left + step, ..start })? - at_start) / step;
    let by_right = (at_start - missed(Interval { right: start.right - step, ..start })?) / step;
    let jacobian = Matrix2::from_columns(&[by_left, by_right]).map(|rate| rate.component(0));
    let inverse = jacobian.try_inverse().unwrap_or(jacobian);
    let mut on = start;
    for _ in 0..DERIVATIVE_STEPS {
        let step = inverse * missed(on)?;
        on = Interval { left: on.left - step[0], right: on.right - step[1] };
    }
    let Interval { left, right } = on;
    let on = Interval { left: given.left.unwrap_or(left), right: given.right.unwrap_or(right) };
    // The result must still be the contact that the search has found, within its tolerance.
    let shift = (on.left - found.left).abs().max((on.right - found.right).abs());
    if shift <= T::of(0.25) * size {
        Ok(on)
    } else {
        Err(SolveError::NoEquilibrium { half_width: size, near: found.centre() }.into())
    }
}
