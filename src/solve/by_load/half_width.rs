//! Half-width of several contacts, whose rate `(da/dF + db/dF)/2` is never negative.

use super::{ByLoad, Quantity, Value};
use crate::gap::Asked;
use crate::solution::{ContactState, LoadRates};
use crate::solve::Contact;
use crate::solve::capacity::Capacity;
use crate::{ContactError, Ends, Fallible, Real, SolveError};

/// Half the distance from the first limit to the last.
pub(in super::super) struct HalfWidth;

impl<T: Real> Quantity<T> for HalfWidth {
    fn first_load(&self, search: &mut ByLoad<'_, '_, '_, T>) -> Fallible<T, T> {
        search.surveyed(Asked::HalfWidth(search.wanted), false)
    }

    fn at(&self, found: &ContactState<T>, search: &mut ByLoad<'_, '_, '_, T>) -> Value<T> {
        let (on, load, peak) = (found.interval, found.load, T::one() / T::zero());
        let half_width = on.half_width();
        // No load widens contacts from one end of the bodies to the other.
        let Ends { left, right } = search.contact.ends();
        if on.left <= left && on.right >= right && half_width < search.wanted {
            let widest = Capacity { half_width, end: on.right, load, peak };
            return Err(widest.too_wide(search.wanted));
        }
        let solved = search.solved(found);
        let is_held = search.kernel.is_none();
        let rates = if is_held { LoadRates::new(solved)? } else { LoadRates::of(solved)? };
        let rate = T::of(0.5) * (rates.a + rates.b);
        // The load moves a limit at a corner by less than x is rounded.
        let rounding = T::of(4.0) * T::epsilon() * on.left.abs().max(on.right.abs());
        if (half_width - search.wanted).abs() <= rounding && rate * load <= rounding {
            return Err(SolveError::LoadUnknown { half_width: search.wanted, load }.into());
        }
        Ok([half_width, rate, T::zero()])
    }

    fn may_fall(&self, _: &Contact<'_, T>) -> bool {
        false
    }

    fn of_widest(&self, wanted: T, widest: &Capacity<T>) -> Option<(T, ContactError<T>)> {
        Some((widest.half_width, widest.too_wide(wanted)))
    }

    fn none(&self, search: &ByLoad<'_, '_, '_, T>) -> Option<ContactError<T>> {
        let (widest, _) = search.widest().filter(|_| search.kernel.is_some())?;
        Some(widest.too_wide(search.wanted))
    }
}
