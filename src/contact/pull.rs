//! Adhesive contacts that are pulled at.

use super::approach::{contact_of, in_full, with_edges};
use super::capacity::capacity;
use super::edges::{Conditions, Given};
use super::{Contact, Found};
use crate::gap::Cost;
use crate::quadrature::Engine;
use crate::{ContactError, Interval, Real};

/// Steps before the pull is given up: the first may be far longer than the last.
const MOST_STEPS: usize = 200;

/// Pulls at an adhesive contact: from no load on, or from the widest that there is room for, in
/// steps, each starting from the contact before. The contact gives way where its width no longer
/// falls with the load, but all at once.
pub(super) fn find<T: Real>(
    contact: &Contact<'_, T>,
    conditions: &Conditions<T>,
    engine: &mut dyn Engine<T>,
    warm: Option<Interval<T>>,
    cost: &mut Cost,
) -> Result<Found<T>, ContactError<T>> {
    let load = conditions.load();
    let under = |load: T| Conditions { given: Given::Load(load), ..*conditions };
    let attempt = |engine: &mut dyn Engine<T>, load: T, from: Interval<T>| {
        let conditions = under(load);
        match in_full(contact, &conditions, engine, (from, T::of(0.02)))? {
            Some(settled) => contact_of(contact, &conditions, engine, settled).map(Some),
            None => Ok(None),
        }
    };
    if let Some(warm) = warm
        && let Some(found) = attempt(engine, load, warm)?
    {
        return Ok(found);
    }
    let mut fault = None;
    let (mut least, mut last) = match with_edges(contact, &under(T::zero()), engine, None, cost) {
        Ok(found) if load.is_zero() => return Ok(found),
        Ok(found) => (T::zero(), found.interval),
        // Those of a contact that does not fit.
        Err(
            error @ (ContactError::TooShort { .. }
            | ContactError::NoBalance { .. }
            | ContactError::Overflow { .. }),
        ) => {
            let widest = capacity(contact, conditions, contact.ends(), cost).ok_or(error)?;
            let too_short = widest.too_short(load);
            if widest.load <= load {
                return Err(too_short);
            }
            // Unless it grows with its load, the one to be found is wider.
            fault = Some(too_short);
            (widest.load, widest.on)
        }
        Err(error) => return Err(error),
    };
    // Narrower contacts bear less than this. Where a step leads astray, half of it may not; what is
    // left of the pull in the end is less than a thousandth of it.
    let [pull_b, pull_a] = conditions.pull(last.half_width());
    let least_of_all = T::of(-2.0) * (pull_a + pull_b);
    let mut step = (load - least).max(least_of_all - least.max(T::zero()));
    for _ in 0..MOST_STEPS {
        let next = (least + step).max(load);
        match attempt(engine, next, last)? {
            Some(found) if next <= load => return Ok(found),
            Some(found) => (least, last, fault) = (next, found.interval, None),
            None if step.abs() <= T::of(1e-3) * least.abs() => break,
            None => step *= T::of(0.5),
        }
    }
    Err(fault.unwrap_or(ContactError::PullOff { load, least }))
}
