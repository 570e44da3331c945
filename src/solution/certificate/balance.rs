//! Check of the limits by the conditions at the edges.

use crate::quadrature::panels::{Several, System};
use crate::solution::ContactState;
use crate::{Fallible, Real, Side, SolveError};

/// Checks with the cells that the limits are where they were found: the remaining Newton steps, as
/// strengths at the limits, must be within the error estimated by the solver and the uncertainty of
/// the cells.
pub(super) fn balanced<T: Real>(
    kappa: T,
    found: &ContactState<T>,
    cells: &Several<T>,
    system: &mut System<T>,
    doubt: T,
) -> Fallible<T, ()> {
    let n = system.residual.len();
    let (mut steps, mut open) = (Vec::new(), vec![T::zero(); n]);
    if system.factor() {
        let mut unit = vec![T::zero(); n];
        for k in 0..n {
            unit.fill(T::zero());
            unit[k] = system.open[k];
            system.solve(&unit, &mut steps);
            open.iter_mut().zip(&steps).for_each(|(open, step)| *open += step.abs());
        }
        system.step(&mut steps);
    } else {
        // Infinite steps exceed any tolerance.
        steps.resize(n, T::one() / T::zero());
    }
    let contacts = cells.contacts();
    let limits = (0..contacts.len()).flat_map(|i| Side::BOTH.map(|side| (i, side)));
    let is_free = |&(i, side): &(usize, Side)| !cells.held()[i][side];
    let limits = limits.filter(is_free);
    let by_limit = |(i, side): (usize, Side)| kappa * cells.strength_by_limit(system, i, side);
    // The rounding of one limit moves the tilt, and with it the strengths at all.
    let rounding = limits.clone().fold(T::zero(), |most: T, (i, side)| {
        let (on, x) = (contacts[i], contacts[i][side]);
        let rounding = T::of(64.0) * T::epsilon() * (x.abs() + on.half_width());
        most.max(by_limit((i, side)) * rounding)
    });
    let mut fault = Ok(());
    for (((i, side), step), open) in limits.zip(steps).zip(open) {
        let on = contacts[i];
        let x = on[side];
        let said = T::of(10.0) * found.error.unwrap_or(T::zero()) * on.half_width();
        let by_limit = by_limit((i, side));
        let strength = by_limit * step.abs();
        // An estimate may be wrong by this factor; a tolerance is met.
        let allowed = by_limit * (said + T::of(16.0) * open) + rounding + kappa * doubt;
        let met = strength <= allowed;
        // Of several failing limits, the error names the rightmost.
        if !met {
            fault = Err(SolveError::Unbalanced { x, strength, allowed }.into());
        }
    }
    fault
}
