//! Bodies that no load presses together: they touch in a point, or are apart.
//!
//! A follower that lifts off bears no force, which is an answer and not a fault: under no load, or
//! at an approach of zero or less, there are no limits to be sought, only the place where the
//! bodies would touch first.

use super::first_contact::first_contact;
use super::{Contact, Control, Work, Workspace};
use crate::gap::{Asked, Cost, Gap, Sampler};
use crate::real::same;
use crate::solution::{Approaching, ContactState, Outcome, Solved, Start};
use crate::{ContactError, Edge, EvaluationError, Fallible, Interval, Real, SolveError};

/// Returns the state of bodies that are not pressed together under a control; `None` if they are,
/// or if an edge may pull or is held.
#[inline]
pub(super) fn find<T: Real>(
    contact: &Contact<'_, T>,
    control: Control<T>,
    work: &mut Work<'_, T>,
) -> Fallible<T, Option<ContactState<T>>> {
    let zero = T::zero();
    // A difference has no negative zero.
    let at = match control {
        Control::Load(load) if load.is_zero() => [zero - load, zero],
        Control::Moment { load, moment, about }
            if load.is_zero() && same(moment, zero) && about.is_finite() =>
        {
            [zero - load, zero]
        }
        Control::Approach { approach, .. } if approach <= zero && approach.is_finite() => {
            [zero, zero - approach]
        }
        _ => return Ok(None),
    };
    lifted(contact, control, at, work)
}

/// Returns the state under this load and at this distance, unless an edge may pull or is held.
#[cold]
fn lifted<T: Real>(
    contact: &Contact<'_, T>,
    control: Control<T>,
    [load, separation]: [T; 2],
    work: &mut Work<'_, T>,
) -> Fallible<T, Option<ContactState<T>>> {
    let edges = contact.checked_edges()?;
    let may_lift = |edge| matches!(edge, Edge::Free | Edge::FreeUntil(_));
    if contact.edge_pressure.is_some() || !edges.into_iter().all(may_lift) {
        return Ok(None);
    }
    if (1..T::COMPONENTS).any(|i| !load.component(i).is_zero()) {
        let why = "without load the bodies touch in a point, whose width rises at once";
        return Err(EvaluationError::NoLoadDerivative { why }.into());
    }
    let place = first_touch(contact, work.workspace, work.cost)?;
    let found = ContactState::apart(place, load, separation, contact.ends());
    if let Control::Approach { references, .. } = control {
        let (gap, kappa, integrator) = (&contact.gap, contact.kappa, &*work.integrator);
        let solved = Solved { gap, integrator, kappa, found: &found };
        Approaching::new(solved, contact.elasticity()?.as_ref(), &references)?;
    }
    work.workspace.report.end(Start::LowestGap, Ok((Outcome::Apart, Some(found))))
}

/// Finds the place where the bodies touch first. Of two that are as low as the heights tell, it is
/// either.
pub(crate) fn first_touch<T: Real>(
    contact: &Contact<'_, T>,
    workspace: &mut Workspace<T>,
    cost: &mut Cost,
) -> Fallible<T, T> {
    let (gap, ends) = (&contact.gap, contact.ends());
    // Heights as close as under a load that would flatten half the digits of the bodies.
    let aside = ContactState::least_height(gap.range());
    gap.check_resolution(T::zero())?;
    if gap.resolution().is_some() {
        workspace.look_for_features(gap);
        workspace.look(gap, Asked::Load(aside), cost)?;
        workspace.look.resolve(gap, aside, &[], cost)?;
    }
    let look = workspace.look(gap, Asked::Load(aside), cost)?;
    let (mut lowest, mut sampler) = (look.lowest, Sampler::default());
    if !(ends.left..=ends.right).contains(&lowest) {
        // The body ends at a corner before.
        let mut places = look.heights(gap);
        for x in ends {
            places.push([x, sampler.height(gap, x)?]);
        }
        let inside = places.into_iter().filter(|[x, _]| (ends.left..=ends.right).contains(x));
        let lower = |one: [T; 2], other: [T; 2]| if other[1] < one[1] { other } else { one };
        lowest = inside.reduce(lower).map_or(ends.left, |[x, _]| x);
    }
    let around = Interval { left: lowest - aside, right: lowest + aside };
    // At the end of a body, or a corner, no slope passes through zero.
    if !(around.left > ends.left && around.right < ends.right) {
        return Ok(lowest);
    }
    let found = match first_contact(&mut sampler, gap, Some(around)) {
        // The middle of a flat will do.
        Err(ContactError::Solve(SolveError::NoFirstContact { .. })) => Ok(lowest),
        Ok(place) if !gap.is_breakpoint(place) => differentiated(&mut sampler, gap, place, aside),
        found => found,
    };
    *cost += sampler.cost;
    found
}

/// Returns a zero of the slope with its derivatives, by a step of Newton's method for each order.
fn differentiated<T: Real>(
    sampler: &mut Sampler<T>,
    gap: &Gap<'_, T>,
    mut place: T,
    aside: T,
) -> Fallible<T, T> {
    for _ in 0..T::DERIVATIVE_ORDER {
        let x = place.component(0);
        let rise = sampler.slope(gap, x + aside)? - sampler.slope(gap, x - aside)?;
        // The middle of a flat has none.
        if rise.component(0) > T::zero() {
            place -= sampler.slope(gap, place)? * (aside + aside) / rise.component(0);
        }
    }
    Ok(place)
}
