//! Search for the limits, one at a time.
//!
//! Two conditions, one at each edge, fix two unknowns. They are taken as a *balance* (their
//! difference, which decides where a contact of given width sits) inside a *load* (their sum, which
//! decides how wide it is). If the slope of the gap rises with x, each has one root, and each is a
//! problem of one unknown for any [`LimitSearch`](crate::LimitSearch). Both are monotone, but for
//! the load beside a limit that is given: tension may grow there before any load is carried.
//!
//! ```text
//! outer:  half-width L        deficit(L, u(L)) = 0,     as ln L
//! inner:  distance u          shift(L, u) = 0,     a = x₀ + u,  -b = x₀ + u - 2L
//!                                             or   -b = x₀ - u,  a = x₀ - u + 2L
//! ```
//!
//! The distance u belongs to the edge closer to `x₀`, which may be a millionth of the width away:
//! so u keeps its digits. `x₀` is a limit that is given, or a point of first contact, where the
//! slope of the gap passes through zero. Every contact contains it, so `u` and the half-width are
//! positive lengths of the contact's own size, and a relative tolerance means the same on either
//! side and for any origin. (With unequal adhesion at its edges a contact may lie beside it.)
//!
//! Either search [steps out](bracketing) until its root is enclosed: the inner one from the place
//! of the last width, the outer one from the start.

mod bracketing;
mod derivatives;

use super::Contact;
use super::equations::{Equations, Residual};
use super::first_contact::first_contact;
use crate::gap::{Cost, Sampler};
use crate::quadrature::Engine;
use crate::{ContactError, Ends, Fallible, Interval, Real, Side, SolveError};
use bracketing::{Missed, Unknown};
use derivatives::differentiate;

/// Widths by which a contact may lie beside the point of first contact if it is pulled more at one
/// edge. (A parabola that is pulled at one edge presses at the other up to two half-widths away.)
const MOST_BESIDE: f64 = 16.0;

/// Finds the limits that meet the conditions, with or without a start, and their estimated error
/// relative to the half-width.
pub(super) fn find<T: Real>(
    contact: &Contact<'_, T>,
    equations: Equations<T>,
    integrator: &mut Engine<T>,
    start: Option<Interval<T>>,
    cost: &mut Cost,
) -> Fallible<T, (Interval<T>, T)> {
    let (gap, limits) = (&contact.gap, equations.limits());
    let origin = match limits.left.or(limits.right) {
        Some(given) => given,
        None => {
            let mut sampler = Sampler::default();
            let first = first_contact(&mut sampler, gap, start);
            *cost += sampler.cost;
            first?
        }
    };
    let reach = Ends::from(gap.range()).map(|end| (end - origin).abs());
    let room = Ends::from_fn(|side| if limits[side].is_some() { T::zero() } else { reach[side] });
    let (near, share, stiffness) = (Side::Right, T::of(0.5), T::zero());
    let mut search =
        NestedSearch { contact, equations, integrator, cost, origin, room, near, share, stiffness };
    let half_width = equations.half_width();
    let trial = match half_width {
        Some(half_width) => search.centre(half_width)?.ok_or_else(|| search.no_balance(half_width)),
        None => {
            let guess = start.map_or(T::of(0.125) * (room.left + room.right), |on| on.half_width());
            search.widen(guess)
        }
    }?;
    // The error of the quadrature, and the residual that the search has left.
    let Residual { at_a, at_b, size, error, .. } = trial.residual;
    let missed = match half_width {
        Some(_) => (at_a - at_b).abs(),
        None => at_a.abs() + at_b.abs(),
    };
    let on = differentiate(&equations, gap, search.integrator, trial.on, search.cost)?;
    Ok((on, error + T::of(0.5) * missed / size))
}

/// Trial contact, and the residual of its conditions.
#[derive(Clone, Copy)]
struct Trial<T> {
    on: Interval<T>,
    residual: Residual<T>,
}

struct NestedSearch<'s, T: Real> {
    contact: &'s Contact<'s, T>,
    equations: Equations<T>,
    integrator: &'s mut Engine<T>,
    cost: &'s mut Cost,
    /// Point of first contact, or a limit that is given.
    origin: T,
    /// Distances that a contact can reach from it.
    room: Ends<T>,
    /// Edge whose distance from the origin is sought.
    near: Side,
    /// Last share of the width between this edge and the origin.
    share: T,
    /// Last decrease of the shift per unit of length moved to the right; zero if it is not known.
    stiffness: T,
}

impl<T: Real> NestedSearch<'_, T> {
    /// Finds the contact of the width at which the deficit vanishes, starting from a guess.
    fn widen(&mut self, guess: T) -> Fallible<T, Trial<T>> {
        let most = T::of(0.5) * (self.room.left + self.room.right);
        let from = guess.max(T::of(0.75) * self.equations.least_width()).min(T::of(0.5) * most);
        // The load of a round body is proportional to the square of the width.
        let (ends, slope, longest) = ([T::zero(), most], T::of(2.0), None);
        let mut unknown = Unknown { from, ends, slope, longest };
        let deficit = |trial: &Trial<T>| trial.residual.deficit();
        let found = self.root(&mut unknown, deficit, |search, width| search.centre(width))?;
        let last = found.as_ref().map_or_else(|missed| missed.last, |&trial| Some(trial));
        if let (Equations::Pressure { wanted, .. }, Some(trial)) = (self.equations, last) {
            wanted.met(trial.on, [trial.residual.at_a, trial.residual.at_b])?;
        }
        found.map_err(|missed| self.no_balance(missed.at))
    }

    /// Finds the balanced contact of a given half-width, if there is one.
    fn centre(&mut self, half_width: T) -> Fallible<T, Option<Trial<T>>> {
        let Self { equations, near, room, share, stiffness: slope, .. } = *self;
        let (width, [first, last]) = (half_width + half_width, self.contact.gap.range());
        let beside = if equations.is_lopsided() { T::of(MOST_BESIDE) * width } else { T::zero() };
        let ends = [(width - room[near.other()]).max(-beside), (width + beside).min(room[near])];
        // Closer than this, both limits are the same number.
        let least = equations.least_width().max(ulps::<T>() * self.origin.abs());
        let rounding = ulps::<T>() * (first.abs() + last.abs());
        if width <= least || ends[0] - ends[1] > rounding {
            return Ok(None);
        }
        // An unknown load does not tell how well the contact has to be balanced.
        let is_placed = equations.half_width().is_some();
        let outward = |Trial { residual, .. }: &Trial<T>| {
            let shift = if is_placed { residual.shift() } else { residual.rough_shift() };
            if near == Side::Right { shift } else { -shift }
        };
        let (from, longest) = (share * width, Some(T::of(1.0 / 16.0) * width));
        let mut unknown = Unknown { from, ends, slope, longest };
        let found = self.root(&mut unknown, outward, |search, reach| {
            let Self { contact, origin, near, .. } = *search;
            let on = match near {
                Side::Left => Interval { left: origin - reach, right: origin + (width - reach) },
                Side::Right => Interval { left: origin + (reach - width), right: origin + reach },
            };
            let on = Interval { left: on.left.max(first), right: on.right.min(last) };
            let residual = equations.residual(&contact.gap, on, search.integrator, search.cost)?;
            Ok(Some(Trial { on, residual }))
        })?;
        self.stiffness = unknown.slope;
        let trial = match (found, equations) {
            (Ok(trial), _) => trial,
            // The unbalanced contact still tells whether to widen, and a wider one may be balanced.
            // If not, the pressures at its edges show it.
            (Err(Missed { last: Some(trial), .. }), Equations::Pressure { .. }) => trial,
            (Err(_), _) => return Ok(None),
        };
        let Interval { left, right } = trial.on;
        let reaches = Ends { left: self.origin - left, right: right - self.origin };
        if reaches[near.other()] < T::of(0.125) * reaches[near] {
            self.near = near.other();
        }
        self.share = reaches[self.near] / width;
        Ok(Some(trial))
    }

    fn no_balance(&self, half_width: T) -> ContactError<T> {
        SolveError::NoEquilibrium { half_width, near: self.origin }.into()
    }
}

/// Returns a relative step that is certain to change a number.
fn ulps<T: Real>() -> T {
    T::of(8.0) * T::epsilon()
}
