//! A first estimate of the contact.
//!
//! The stretch in which it is expected is sampled with four nodes a panel, and Newton's method finds the
//! contact of this sketch; if that is much narrower than the stretch, or beside it, a stretch around it
//! is sketched anew.

use super::Contact;
use super::approach::Refused;
use super::edges::{Conditions, Given};
use super::newton::{Effort, Settled, settle};
use super::stretch::{beyond, with_corners};
use crate::gap::Cost;
use crate::quadrature::Engine;
use crate::{ContactError, Interval, Real};

/// Sketches before the approach is given up.
const MOST_SKETCHES: usize = 120;

/// Of which so many may reach for an end of the bodies before it is asked what these bear.
const MOST_AT_END: usize = 40;

/// The start, or the middle half of the bodies; where the load acts at a given place, around that.
pub(super) fn start<T: Real>(contact: &Contact<'_, T>, conditions: &Conditions<T>) -> Interval<T> {
    let [left, right] = contact.gap.range();
    let whole = Interval { left, right };
    let quarter = T::of(0.5) * whole.half_width();
    let (centre, reach) = match conditions.given {
        Given::Centre { at, .. } => {
            let at = at.part(0);
            let reach = quarter.min(T::of(0.5) * (at - left).min(right - at));
            if reach > T::zero() { (at, reach) } else { (whole.centre(), quarter) }
        }
        _ => (whole.centre(), quarter),
    };
    let middle = Interval { left: centre - reach, right: centre + reach };
    let inside = |on: &Interval<T>| on.left >= left && on.right <= right;
    let on = conditions.with_given_limits(contact.start.filter(inside).unwrap_or(middle));
    // A given limit may be closer to the end of the bodies than that is wide.
    let half = T::of(0.5);
    Interval {
        left: if on.left < left { half * left + half * on.right } else { on.left },
        right: if on.right > right { half * on.left + half * right } else { on.right },
    }
}

/// A first estimate of the contact, from sketches, and how far it is in doubt as a share of its
/// half-width; `None` where they lead nowhere.
pub(super) fn sketch<T: Real>(
    contact: &Contact<'_, T>,
    conditions: &Conditions<T>,
    engine: &mut dyn Engine<T>,
    refused: &mut Refused<'_, T>,
    cost: &mut Cost,
) -> Result<Option<(Interval<T>, T)>, ContactError<T>> {
    let gap = &contact.gap;
    let range = gap.range();
    let inside =
        |on: &Interval<T>| on.left >= range[0] && on.right <= range[1] && on.left < on.right;
    let mut stretch = start(contact, conditions);
    let mut on: Option<Interval<T>> = None;
    let mut at_end = 0;
    for _ in 0..MOST_SKETCHES {
        if !inside(&stretch) {
            return Ok(None);
        }
        let Some(doubt) = engine.cover(gap, stretch, true)? else { return Ok(None) };
        let begin = on.unwrap_or(stretch);
        let Some(guess) = settle(engine, gap, conditions, begin, Effort::Sketch)? else {
            return Ok(None);
        };
        let guess = Settled { on: guess.on.plain(), ..guess };
        on = Some(guess.on);
        let on = guess.on;
        let within = on.left >= stretch.left && on.right <= stretch.right;
        let share = on.half_width() / stretch.half_width();
        // A joint inside is where it is, and only the width is in doubt.
        let jointed = gap.joint_after(on.left).is_some_and(|joint| joint < on.right);
        let comparable = share >= T::of(0.4);
        let doubt = if jointed && !comparable { doubt.sqrt() } else { doubt };
        let relative = if jointed { doubt } else { doubt / share };
        let sure = T::of(if jointed { 0.1 } else { 0.02 });
        // Outside, the doubt grows with the powers that the sketch has left out.
        let reached = share.max((on.centre() - stretch.centre()).abs() / stretch.half_width());
        if !within && relative * reached.max(T::one()).powi(5) <= T::of(1e-3) && guess.error <= sure
        {
            return Ok(Some((on, sure * T::of(0.5))));
        }
        if within && guess.error <= T::of(0.1) && (comparable || relative <= sure) {
            return Ok(Some((on, relative.min(T::of(0.1)))));
        }
        // Around it, as closely as its place is known.
        let rounding = T::of(64.0) * T::epsilon();
        let largest = stretch.left.abs().max(stretch.right.abs());
        let doubt = if jointed { T::zero() } else { (doubt + doubt).min(T::of(0.3)) };
        let reach = (doubt * stretch.half_width()).max(rounding * largest);
        let [left, right] = beyond(contact, on, T::of(0.125));
        // What lies outside was guessed from the outermost panel, which may be a short one.
        let guessed = |by: T| T::of(1.0 / 64.0) * by.max(T::zero());
        let next = Interval {
            left: left.min(on.left - reach - guessed(stretch.left - on.left)),
            right: right.max(on.right + reach + guessed(on.right - stretch.right)),
        };
        // Half the way to an end, where the slope may be infinite.
        stretch = Interval {
            left: inward(next.left, on.left, range[0]),
            right: -inward(-next.right, -on.right, -range[1]),
        };
        // One that comes to an end again and again is perhaps more than the bodies bear.
        at_end += usize::from(next.left <= range[0] || next.right >= range[1]);
        if at_end == MOST_AT_END {
            refused.check(cost)?;
        }
        stretch = with_corners(conditions, stretch.plain());
    }
    Ok(None)
}

/// A left end of a stretch, or half the way to the end of the bodies.
fn inward<T: Real>(x: T, contact: T, end: T) -> T {
    if x <= end { T::of(0.5) * contact + T::of(0.5) * end } else { x }
}
