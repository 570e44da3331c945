//! Contact under a load that acts at a given place: the bodies turn until it does.
//!
//! The tilt is one more unknown of every search: for one interval it is
//! [eliminated](super::newton::single), for [several](super::newton::several) it joins the limits,
//! and for the [active set](super::active_set) the forces. A change of the tilt needs no samples.

use super::edges::{Conditions, Given};
use super::topology;
use super::{Contact, Work};
use crate::contact::check_finite;
use crate::solution::ContactState;
use crate::{Fallible, InputError, Interval, Real, SolveError};

/// Line of action of a load.
#[derive(Clone, Copy)]
pub(super) struct LineOfLoad<T> {
    load: T,
    at: T,
    /// Uncertainty of `at` due to rounding.
    rounding: T,
}

impl<T: Real> LineOfLoad<T> {
    pub fn of_moment(load: T, moment: T, about: T) -> Fallible<T, Self> {
        check_finite("moment", moment)?;
        check_finite("place that the moment is about", about)?;
        let arm = moment / load;
        let rounding = T::epsilon() * (about.abs() + arm.abs());
        Ok(Self { rounding, ..Self::through(load, about + arm)? })
    }

    pub fn through(load: T, at: T) -> Fallible<T, Self> {
        super::check_positive("load", load)?;
        check_finite("centre of pressure", at)?;
        Ok(Self { load, at, rounding: T::epsilon() * at.abs() })
    }
}

/// Finds the contact under a load along a given line, with the tilt of its bodies.
pub(super) fn find<T: Real>(
    contact: &Contact<'_, T>,
    line: LineOfLoad<T>,
    work: &mut Work<'_, T>,
) -> Fallible<T, ContactState<T>> {
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
    let ends = contact.ends();
    // Otherwise all pressure would lie on one side of the line.
    if edges.are_sought() && !(at > ends.left && at < ends.right) {
        return Err(SolveError::LoadBeyondBodies { load, at, ends }.into());
    }
    let mut found = topology::find(contact, conditions, work)?;
    let contacts = work.integrator.contacts(&found.interval);
    let narrowest = contacts.iter().map(Interval::half_width).reduce(|one, other| one.min(other));
    let doubt = rounding / narrowest.unwrap_or(T::one());
    found.error = found.error.map(|error| error + doubt);
    Ok(found)
}
