//! Approach of the bodies, whose rate is 1/stiffness.
//!
//! It falls where a reference is a length and the contact is large, which
//! [`Approaching::with_rate`] refuses; but where it rises it has risen from first touch, as the
//! rate never grows. Towards a depth d the rate is, up to a factor, the sum over the bodies of
//! `2 G - d ∂G/∂d/(1 - ν)`, with Green's function G of the region outside the contacts. As they
//! grow, G decreases by a positive harmonic function h, for which `d ∂h/∂d ≤ h`. For a disc or a
//! length, the logarithm of their capacity is subtracted, which grows. (Of layers this is not
//! proved: the load that is found need not be the only one with its approach.)

use super::{ByLoad, Capacity, Quantity, Value};
use crate::material::Elasticity;
use crate::solution::{Approaching, ContactState};
use crate::solve::Contact;
use crate::{ContactError, Fallible, Real, References, SolveError};

/// First load, as a share of `κ δ`: a third is right twenty half-widths above the references, and
/// less further off. The samples of a contact serve a narrower one, but not a wider one.
const FIRST_LOAD: f64 = 0.4;

/// Approach to given references.
pub(in super::super) struct ByApproach<T> {
    pub references: References<T>,
    pub bodies: [Elasticity<T>; 2],
}

impl<T: Real> Quantity<T> for ByApproach<T> {
    fn first_load(&self, search: &mut ByLoad<'_, '_, '_, T>) -> Fallible<T, T> {
        Ok(T::of(FIRST_LOAD) * search.contact.kappa * search.wanted)
    }

    fn at(&self, found: &ContactState<T>, search: &mut ByLoad<'_, '_, '_, T>) -> Value<T> {
        let at = Approaching::new(search.solved(found), Some(&self.bodies), &self.references)?;
        let [value, rate] = at.with_rate()?;
        Ok([value, rate, T::zero()])
    }

    fn may_fall(&self, _: &Contact<'_, T>) -> bool {
        false
    }

    fn none(&self, search: &ByLoad<'_, '_, '_, T>) -> Option<ContactError<T>> {
        let (Capacity { load, .. }, approach) = search.widest()?;
        Some(SolveError::ApproachTooLarge { wanted: search.wanted, approach, load }.into())
    }
}
