//! Peak pressure, whose rate ∂P/∂F at its place, a flat punch on the contacts, is never negative.

use super::{ByLoad, Quantity, Value};
use crate::gap::Asked;
use crate::solution::{ContactState, Solved};
use crate::solve::capacity::Capacity;
use crate::solve::{Contact, topology};
use crate::{
    ContactError, Edge, Ends, EvaluationError, Fallible, InputError, Interval, Real, SolveError,
};

/// Largest pressure of all contacts.
pub(in super::super) struct Peak;

impl Peak {
    /// Checks the edges: a corner on the bodies may end them; at any other edge that is not free
    /// the pressure is infinite.
    pub fn new<T: Real>(contact: &Contact<'_, T>) -> Fallible<T, Self> {
        let edges = contact.checked_edges()?;
        if let Ends { left: Edge::Fixed(left), right: Edge::Fixed(right) } = edges {
            return Err(InputError::BothLimitsGiven { interval: Interval { left, right } }.into());
        }
        match edges.into_iter().find(|edge| !edge.is_free()) {
            Some(edge) => Err(InputError::PeakEdge { edge }.into()),
            None => Ok(Self),
        }
    }
}

impl<T: Real> Quantity<T> for Peak {
    fn first_load(&self, search: &mut ByLoad<'_, '_, '_, T>) -> Fallible<T, T> {
        search.surveyed(Asked::Peak(search.wanted / search.contact.kappa), true)
    }

    fn at(&self, found: &ContactState<T>, search: &mut ByLoad<'_, '_, '_, T>) -> Value<T> {
        let ByLoad { contact, kernel, gap, work, .. } = search;
        let (kappa, load) = (contact.kappa, found.load);
        let solved = Solved { gap, integrator: &*work.integrator, kappa, found };
        let peak = solved.peak_with_rate(kernel.is_none(), work.cost);
        let Err(ContactError::Evaluation(EvaluationError::Singular { .. })) = peak else {
            return peak;
        };
        match topology::up_to_corner(contact, &contact.under(load)?, found.free, work) {
            Some(widest) => Err(widest.too_short(load)),
            None => Ok([T::one() / T::zero(), T::zero(), T::zero()]),
        }
    }

    fn may_fall(&self, _: &Contact<'_, T>) -> bool {
        false
    }

    fn of_widest(&self, wanted: T, widest: &Capacity<T>) -> Option<(T, ContactError<T>)> {
        Some((widest.peak, widest.too_high(wanted)))
    }

    fn none(&self, search: &ByLoad<'_, '_, '_, T>) -> Option<ContactError<T>> {
        let (wanted, half_width) = (search.wanted, search.hull().half_width());
        if let Some((widest, peak)) = search.widest().filter(|_| search.kernel.is_some()) {
            return Some(Capacity { peak, ..widest }.too_high(wanted));
        }
        // It is too large under any load.
        let found = search.high.map_or(T::of(f64::NAN), |high| high.value);
        let none = search.fault.is_none() && search.low.is_none();
        none.then(|| SolveError::NoPeak { wanted, half_width, found }.into())
    }
}
