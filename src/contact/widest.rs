//! The widest contact that there is room for.

use super::Contact;
use super::edges::Conditions;
use super::first_contact::first_contact;
use super::goal::Goal;
use crate::gap::{Cost, Sampler};
use crate::quadrature::Engine;
use crate::search::{Bracket, Brent, LimitSearch};
use crate::{Interval, Real};

/// The contact in balance that reaches to one end of the bodies, or to a corner; `None` where that
/// cannot be told, as where the slope is infinite at the end.
pub(super) fn widest<T: Real>(
    contact: &Contact<'_, T>,
    conditions: Conditions<T>,
    engine: &mut dyn Engine<T>,
    cost: &mut Cost,
) -> Option<Interval<T>> {
    // Whatever was tried before may have led to panels of any size.
    engine.forget();
    let gap = &contact.gap;
    let goal = Goal::Strength { conditions, load: T::zero() };
    let [left, right] = contact.ends();
    let whole = Interval { left, right };
    let mut shift = |on| goal.excess(gap, on, engine, &mut Cost::default()).ok().map(|e| e.shift());
    let at_whole = shift(whole)?;
    if at_whole == T::zero() {
        return Some(whole);
    }
    // One edge stays at the end towards which all of the bodies would shift, the other moves in.
    let mut sampler = Sampler::default();
    let first = first_contact(&mut sampler, gap, contact.start);
    *cost += sampler.cost;
    let (first, rightward) = (first.ok()?, at_whole > T::zero());
    let on = |x| if rightward { Interval { left: x, right } } else { Interval { left, right: x } };
    let bracket = if rightward { Bracket::new(left, first) } else { Bracket::new(first, right) };
    let mut f = |x| shift(on(x)).unwrap_or(T::of(f64::NAN));
    Brent::DEFAULT.find(&mut f, &bracket).ok().map(|root| on(root.x))
}
