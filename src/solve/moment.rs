//! Contact under a load that acts at a given place: the bodies turn until it does.
//!
//! The tilt is one more unknown of every search: for one interval it is
//! [eliminated](super::newton::single), for [several](super::newton::several) it joins the limits,
//! and for the [active set](super::active_set) the forces. A change of the tilt needs no samples.

use super::edges::{Conditions, Given};
use super::topology::{self, Borne};
use super::{Contact, Work};
use crate::solution::ContactState;
use crate::{ContactError, InputError, Interval, Real, SolveError};

/// Halvings of the way from the middle of the bodies to a place where the load cannot act.
const MAX_HALVES: usize = 14;

/// Share of the bodies left beyond a contact that cannot be moved any further.
const LEAST_LEFT: f64 = 0.01;

/// Line of action of a load.
#[derive(Clone, Copy)]
pub(super) struct LineOfLoad<T> {
    load: T,
    at: T,
    /// Uncertainty of `at` due to rounding.
    rounding: T,
}

impl<T: Real> LineOfLoad<T> {
    pub fn of_moment(load: T, moment: T, about: T) -> Result<Self, ContactError<T>> {
        if let Some(&value) = [moment, about].iter().find(|value| !value.is_finite()) {
            return Err(InputError::InvalidMoment { value }.into());
        }
        let arm = moment / load;
        let rounding = T::epsilon() * (about.abs() + arm.abs());
        Ok(Self { rounding, ..Self::through(load, about + arm)? })
    }

    pub fn through(load: T, at: T) -> Result<Self, ContactError<T>> {
        super::check_positive("load", load)?;
        if !at.is_finite() {
            return Err(InputError::InvalidMoment { value: at }.into());
        }
        Ok(Self { load, at, rounding: T::epsilon() * at.abs() })
    }
}

/// Finds the contact under a load along a given line, with the tilt of its bodies.
pub(super) fn find<T: Real>(
    contact: &Contact<'_, T>,
    line: LineOfLoad<T>,
    work: &mut Work<'_, T>,
) -> Result<ContactState<T>, ContactError<T>> {
    let edges = contact.checked_edges()?;
    let refuse = |why| Err(InputError::TiltNotSupported { why }.into());
    if edges.are_adhesive() {
        return refuse("an edge is Adhesive");
    }
    if contact.search.is_some() {
        return refuse("a strategy of one's own adjusts the limits");
    }
    if work.integrator.panels().is_none() {
        return refuse("the quadrature is another");
    }
    let LineOfLoad { load, at, rounding } = line;
    let conditions = Conditions { kappa: contact.kappa, edges, given: Given::Centre { load, at } };
    let given = !edges.are_sought();
    let ends = contact.ends();
    // Otherwise all pressure would lie on one side of the line.
    if !(given || at > ends.left && at < ends.right) {
        let range = [ends.left, ends.right];
        return Err(SolveError::OutsideBodies { x: at, range }.into());
    }
    let mut found = match topology::find(contact, conditions, work) {
        Err(error) if !given && may_be_beyond(&error) => {
            match topology::bears(contact, &conditions, work) {
                Some(Borne::All(found)) => found,
                bears => {
                    let error = match bears {
                        Some(Borne::UpTo(widest)) => widest.too_short(load),
                        _ => error,
                    };
                    return Err(nearest(contact, conditions, work).unwrap_or(error));
                }
            }
        }
        found => found?,
    };
    let contacts = work.integrator.contacts(&found.interval);
    let narrowest = contacts.iter().map(Interval::half_width).reduce(|one, other| one.min(other));
    let doubt = rounding / narrowest.unwrap_or(T::one());
    found.error = found.error.map(|error| error + doubt);
    Ok(found)
}

/// Tells whether a search may have failed with this error because the contact would leave the
/// bodies.
fn may_be_beyond<T: Real>(error: &ContactError<T>) -> bool {
    use SolveError::{LiftsOff, Overlap, Tension};
    let ContactError::Solve(failed) = error else { return false };
    let fails = matches!(failed, Tension { .. } | Overlap { .. });
    fails || error.may_be_several() && !matches!(failed, LiftsOff { .. })
}

/// Returns the error with the nearest place where the load can act, between `at` and the middle of
/// the bodies. `None` if it cannot act in the middle, either, or if no limit is near an end.
fn nearest<T: Real>(
    contact: &Contact<'_, T>,
    conditions: Conditions<T>,
    work: &mut Work<'_, T>,
) -> Option<ContactError<T>> {
    let (load, at, ends) = (conditions.load(), conditions.at()?, contact.ends());
    let mut find = |given| {
        let conditions = Conditions { given, ..conditions };
        topology::find(contact, conditions, work)
    };
    let half = T::of(0.5);
    let (mut reached, mut beyond) = (half * ends.left + half * ends.right, at);
    let mut found = find(Given::Centre { load, at: reached }).ok()?;
    for _ in 0..MAX_HALVES {
        let at = half * reached + half * beyond;
        match find(Given::Centre { load, at }) {
            Ok(nearer) => (reached, found) = (at, nearer),
            Err(_) => beyond = at,
        }
    }
    let ContactState { tilt, interval: Interval { left, right }, .. } = found;
    let room = (left - ends.left).min(ends.right - right);
    let is_at_end = room <= T::of(LEAST_LEFT) * (ends.right - ends.left);
    is_at_end.then(|| SolveError::TiltNotFound { load, at, reached, tilt, ends }.into())
}
