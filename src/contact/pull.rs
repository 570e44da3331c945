//! Adhesive contacts that are pulled at.

use super::approach::{contact_of, in_full, with_edges};
use super::edges::{Conditions, Control};
use super::{Contact, Found};
use crate::gap::Cost;
use crate::quadrature::Engine;
use crate::{ContactError, Interval, Real};

/// Pulls at an adhesive contact: from no load on, in steps, each starting from the contact before.
/// The contact gives way where its width no longer falls with the load, but all at once.
pub(super) fn find<T: Real>(
    contact: &Contact<'_, T>,
    conditions: &Conditions<T>,
    engine: &mut dyn Engine<T>,
    warm: Option<Interval<T>>,
    cost: &mut Cost,
) -> Result<Found<T>, ContactError<T>> {
    const STEPS: usize = 16;
    let load = conditions.load();
    let under = |load: T| Conditions { control: Control::Load(load), ..*conditions };
    let mut last = match warm {
        Some(warm) => warm,
        None => with_edges(contact, &under(T::zero()), engine, None, cost)?.interval,
    };
    let attempt = |engine: &mut dyn Engine<T>, load: T, from: Interval<T>| {
        let conditions = under(load);
        match in_full(contact, &conditions, engine, (from, T::of(0.02)))? {
            Some(settled) => contact_of(contact, &conditions, engine, settled).map(Some),
            None => Ok(None),
        }
    };
    if let Some(found) = attempt(engine, load, last)? {
        return Ok(found);
    }
    if warm.is_some() {
        last = with_edges(contact, &under(T::zero()), engine, None, cost)?.interval;
    }
    let mut found = None;
    let mut least = T::zero();
    for i in 1..=STEPS {
        let step = load * T::count(i) / T::count(STEPS);
        found = attempt(engine, step, last)?;
        match &found {
            Some(found) => (least, last) = (step, found.interval),
            None => break,
        }
    }
    found.ok_or(ContactError::PullOff { load, least })
}
