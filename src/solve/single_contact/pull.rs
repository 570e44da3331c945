//! Adhesive contacts under tension.

use super::super::capacity::capacity;
use super::super::edges::Given;
use super::{ROUGH_UNCERTAINTY, Single};
use crate::solution::ContactState;
use crate::{ContactError, Fallible, Interval, Real, SolveError};

/// Largest number of steps of a pull: the first may be far longer than the last.
const MAX_PULLS: usize = 200;

impl<T: Real> Single<'_, '_, T> {
    /// Pulls at an adhesive contact: from zero load, or from the widest contact on the bodies, in
    /// steps that each start from the contact before. The contact gives way where its width no
    /// longer falls steadily with the load, but all at once.
    pub(super) fn pull(&mut self, last: Option<Interval<T>>) -> Fallible<T, ContactState<T>> {
        let load = self.conditions.load();
        if let Some(last) = last
            && let Some(found) = self.pulled(load, last)?
        {
            return Ok(found);
        }
        self.conditions.given = Given::Load(T::zero());
        let mut fault = None;
        let (mut least, mut last) = match self.press(None) {
            Ok(found) if load.is_zero() => return Ok(found),
            Ok(found) => (T::zero(), found.interval),
            // Errors of a contact that does not fit.
            Err(
                error @ ContactError::Solve(
                    SolveError::DomainTooShort { .. }
                    | SolveError::NoEquilibrium { .. }
                    | SolveError::Overflow { .. },
                ),
            ) => {
                let ends = self.contact.ends();
                let widest = capacity(self.contact, &self.conditions, ends, self.cost);
                let (on, widest) = widest.ok_or(error)?;
                let too_short = widest.too_short(load);
                if widest.load <= load {
                    return Err(too_short);
                }
                // Unless this contact grows with its load, the one sought is wider.
                fault = Some(too_short);
                (widest.load, on)
            }
            Err(error) => return Err(error),
        };
        // Narrower contacts bear less tension than this. If a step leads astray, half of it may
        // not; the pull left in the end is less than a thousandth of the load.
        let pulls = self.conditions.edge_strengths(last.half_width());
        let least_of_all = T::of(-2.0) * (pulls.right + pulls.left);
        let mut step = (load - least).max(least_of_all - least.max(T::zero()));
        for _ in 0..MAX_PULLS {
            let next = (least + step).max(load);
            match self.pulled(next, last)? {
                Some(found) if next <= load => return Ok(found),
                Some(found) => (least, last, fault) = (next, found.interval, None),
                None if step.abs() <= T::of(1e-3) * least.abs() => break,
                None => step *= T::of(0.5),
            }
        }
        Err(fault.unwrap_or(ContactError::Solve(SolveError::PullOff { load, least })))
    }

    /// Finds the contact under a load, from one nearby.
    fn pulled(&mut self, load: T, from: Interval<T>) -> Fallible<T, Option<ContactState<T>>> {
        self.conditions.given = Given::Load(load);
        let converged = self.in_full(from, T::of(ROUGH_UNCERTAINTY))?;
        converged.map(|converged| self.contact_of(converged)).transpose()
    }
}
