//! From a start, or from nothing, to the limits with as few samples as possible.
//!
//! First the contact is [sketched](super::sketch). Then a stretch a little wider than that is sampled in
//! full, and Newton's method finds the limits on it. The nested search ([`limits`](super::limits))
//! takes over where this goes astray, and is used throughout where the user has chosen a strategy or
//! the quadrature knows no derivatives; it ends on panels made for the contact, too. Where neither finds
//! a contact it is asked what the bodies [bear](super::capacity).

use super::capacity::{Capacity, capacity};
use super::edges::{Conditions, Edge, Given};
use super::goal::{Goal, relative_error};
use super::limits::{self, Nested};
use super::newton::{Effort, Settled, load_of, settle};
use super::sketch::{sketch, start};
use super::stretch::{around, beyond, with_corners};
use super::{Contact, Found, pull};
use crate::gap::Cost;
use crate::quadrature::{Engine, Moments};
use crate::{ContactError, Interval, Real};

/// More doubt than this, as a share of the half-width, is no contact found.
pub(super) const MOST_DOUBT: f64 = 0.03;

/// Finds the contact that meets the conditions.
pub(super) fn find<T: Real>(
    contact: &Contact<'_, T>,
    conditions: Conditions<T>,
    engine: &mut dyn Engine<T>,
    warm: Option<Interval<T>>,
    cost: &mut Cost,
) -> Result<Found<T>, ContactError<T>> {
    let mut conditions = conditions;
    let corners = conditions.edges;
    // A corner holds the contact as long as it presses there; a width may be had without it, unless
    // it held the last one. It cannot hold both edges.
    let range = contact.gap.range();
    let by_load = !matches!(conditions.given, Given::HalfWidth(_));
    let mut one_held = false;
    for (i, edge) in conditions.edges.iter_mut().enumerate() {
        if let Edge::UpTo(x) = *edge {
            if !(x >= range[0] && x <= range[1]) {
                return Err(ContactError::OutsideBodies { x, range });
            }
            let touched = warm.map(|on| [on.left, on.right][i] == x);
            let held = touched.unwrap_or(by_load) && (by_load || !one_held);
            one_held |= held;
            *edge = if held { Edge::Fixed(x) } else { Edge::Free };
        }
    }
    let mut found = match attempt(contact, &conditions, engine, warm, cost) {
        Err(error) if conditions.edges != corners => {
            // A corner that is far off may not be held at all.
            for (edge, corner) in conditions.edges.iter_mut().zip(&corners) {
                if let Edge::UpTo(_) = corner {
                    *edge = Edge::Free;
                }
            }
            attempt(contact, &conditions, engine, warm, cost).map_err(|_| error)?
        }
        found => found?,
    };
    for _ in 0..4 {
        let on = found.interval;
        let mut changed = false;
        for (i, corner) in corners.iter().enumerate() {
            let Edge::UpTo(x) = *corner else { continue };
            let beyond = if i == 0 { on.left < x } else { on.right > x };
            if conditions.edges[i].is_free() && beyond {
                conditions.edges[i] = Edge::Fixed(x);
                changed = true;
            } else if !conditions.edges[i].is_free() && found.strengths[i] < T::zero() {
                conditions.edges[i] = Edge::Free;
                changed = true;
            }
        }
        if !changed {
            break;
        }
        found = attempt(contact, &conditions, engine, Some(on), cost)?;
    }
    let on = found.interval;
    for (i, corner) in corners.iter().enumerate() {
        let Edge::UpTo(x) = *corner else { continue };
        let beyond = if i == 0 { x - on.left } else { on.right - x };
        // Neither held by the corner nor within it.
        if beyond > T::of(8.0) * T::epsilon() * (x.abs() + on.half_width()) {
            return Err(ContactError::NoBalance { half_width: on.half_width(), near: x });
        }
    }
    Ok(found)
}

/// The same for edges of which each is either fixed or not, under any load.
fn attempt<T: Real>(
    contact: &Contact<'_, T>,
    conditions: &Conditions<T>,
    engine: &mut dyn Engine<T>,
    warm: Option<Interval<T>>,
    cost: &mut Cost,
) -> Result<Found<T>, ContactError<T>> {
    let pulled = matches!(conditions.given, Given::Load(load) if load <= T::zero());
    let adhesive = conditions.edges.iter().any(|edge| matches!(edge, Edge::Adhesive(_)));
    if pulled && adhesive && conditions.edges.iter().any(|edge| edge.limit().is_none()) {
        pull::find(contact, conditions, engine, warm, cost)
    } else {
        with_edges(contact, conditions, engine, warm, cost)
    }
}

/// The same for a load that presses.
pub(super) fn with_edges<T: Real>(
    contact: &Contact<'_, T>,
    conditions: &Conditions<T>,
    engine: &mut dyn Engine<T>,
    warm: Option<Interval<T>>,
    cost: &mut Cost,
) -> Result<Found<T>, ContactError<T>> {
    let gap = &contact.gap;
    let limits = conditions.edges.map(|edge| edge.limit());
    let range = gap.range();
    if let Some(on) = conditions.both_limits() {
        return given(contact, conditions, engine, on);
    }
    for limit in limits.into_iter().flatten() {
        if !(limit >= range[0] && limit <= range[1]) {
            return Err(ContactError::OutsideBodies { x: limit, range });
        }
    }
    engine.hold(gap, limits);
    let (mut settled, mut refused) = (None, Refused { contact, conditions, bears: None });
    let warm = warm.filter(|on| on.left >= range[0] && on.right <= range[1]);
    if contact.search.is_none() {
        let guess = match warm {
            Some(warm) => Some((warm, T::of(0.02))),
            None => sketch(contact, conditions, engine, &mut refused, cost)?,
        };
        // What was sampled for the last load serves for the next.
        if let (Some((guess, _)), Some(covered)) = (guess, engine.covered()) {
            let again = settle(engine, gap, conditions, guess, Effort::Full);
            settled = again
                .unwrap_or(None)
                .filter(|settled| settled.on.half_width() >= T::of(0.3) * covered.half_width());
        }
        if settled.is_none() {
            refused.check_if_close(engine.covered(), cost)?;
            let guess = guess.unwrap_or_else(|| (start(contact, conditions), T::of(0.02)));
            settled = match in_full(contact, conditions, engine, guess) {
                // About the contact of another scene.
                Err(_) if warm.is_some() => None,
                settled => settled?,
            };
            if settled.is_none() {
                refused.check_if_close(engine.covered(), cost)?;
            }
        }
    }
    if settled.is_none() && warm.is_some() {
        // The last contact was no help.
        engine.forget();
        return with_edges(contact, conditions, engine, None, cost);
    }
    if let (None, Given::Centre { at, .. }) = (settled, conditions.given) {
        // A search of one limit at a time knows no tilt.
        let half_width = start(contact, conditions).half_width();
        return Err(ContactError::NoBalance { half_width, near: at });
    }
    if settled.is_none() {
        engine.forget();
        let found = nested(contact, conditions, engine, contact.start, cost);
        let (mut nested, mut load) = found.map_err(|error| refused.because(error, cost))?;
        // Panels much wider than the contact are not as good as they look: search again on new ones.
        for _ in 0..3 {
            let covered = engine.covered().map(|on| on.half_width());
            let wide = |covered: T| covered > T::of(1.25) * nested.on.half_width();
            if contact.search.is_none() || !covered.is_some_and(wide) {
                break;
            }
            let [left, right] = beyond(contact, nested.on, T::of(0.02));
            let stretch = Interval { left: left.max(range[0]), right: right.min(range[1]) };
            engine.cover(gap, with_corners(conditions, stretch.plain()), false)?;
            let start = Some(nested.on);
            (nested, load) = self::nested(contact, conditions, engine, start, cost)?;
        }
        if contact.search.is_none() {
            settled = in_full(contact, conditions, engine, (nested.on, T::zero()))?;
        }
        if settled.is_none() {
            let m = engine.moments(gap, nested.on)?;
            let carried = || conditions.balance(nested.on, &m);
            let load = load.or_else(carried).unwrap_or_else(|| conditions.load());
            // A strategy and a rule of one's own are as good as one has asked for.
            let own = contact.search.is_some() || m.trend.is_none();
            let much = |error: T| error > T::of(MOST_DOUBT);
            let error = strength_error(conditions, &nested, load, &m);
            let error = error.filter(|&error| own || !much(error));
            let Some(error) = error else {
                let half_width = nested.on.half_width();
                let error = ContactError::NoBalance { half_width, near: nested.on.centre() };
                return Err(refused.because(error, cost));
            };
            if much(error) || (!own && error > T::epsilon().sqrt()) {
                refused.check(cost)?;
            }
            return Ok(Found::new(conditions, nested.on, load, Some(error), &m));
        }
    }
    match settled {
        Some(settled) => contact_of(contact, conditions, engine, settled),
        None => unreachable!("one of the two ways has been taken"),
    }
}

/// The contact between limits that are both known. What is not given is the load.
fn given<T: Real>(
    contact: &Contact<'_, T>,
    conditions: &Conditions<T>,
    engine: &mut dyn Engine<T>,
    on: Interval<T>,
) -> Result<Found<T>, ContactError<T>> {
    let (gap, range) = (&contact.gap, contact.gap.range());
    super::check(on)?;
    let sought = conditions.edges.iter().any(|edge| edge.limit().is_none());
    if !sought && matches!(conditions.given, Given::HalfWidth(_)) {
        return Err(ContactError::Control { interval: on });
    }
    let rounding = T::of(8.0) * T::epsilon() * (on.left.abs() + on.right.abs());
    super::check_within(on, range, if sought { rounding } else { T::zero() })?;
    let on = Interval { left: on.left.max(range[0]), right: on.right.min(range[1]) };
    engine.hold(gap, conditions.edges.map(|edge| edge.limit()));
    // What was sampled for the last load serves for the next.
    let serves = |covered: Interval<T>| {
        let within = covered.left <= on.left && covered.right >= on.right;
        within && on.half_width() >= T::of(0.3) * covered.half_width()
    };
    if !engine.covered().is_some_and(serves) {
        engine.cover(gap, around(contact, conditions, on, T::of(0.02)), false)?;
    }
    let m = engine.moments(gap, on)?;
    let Some(load) = conditions.balance(on, &m) else {
        return Ok(Found::new(conditions, on, conditions.load(), None, &m));
    };
    let error = Some(relative_error(on, &m, m.first.abs() + m.mean.abs()));
    Ok(Found::new(conditions, on, load, error, &m))
}

/// The error of limits that the nested search has found, by what it says itself and by what is left at
/// the free edges on the panels that it has ended with, which may have changed under way. `None` where
/// load and adhesion are less than the rounding of the forces: any interval would do.
fn strength_error<T: Real>(
    conditions: &Conditions<T>,
    nested: &Nested<T>,
    load: T,
    m: &Moments<T>,
) -> Option<T> {
    let on = nested.on;
    let stiffness = conditions.kappa * on.half_width();
    let [pull_b, pull_a] = conditions.pull(on.half_width());
    let lost = T::epsilon() * stiffness * m.size > load.abs() + pull_a + pull_b;
    let by_load = matches!(conditions.given, Given::Load(_));
    if lost && by_load && conditions.edges.iter().any(|edge| edge.is_free()) {
        return None;
    }
    let size = load.abs() + stiffness * m.size;
    let mut error = nested.error;
    for (edge, sign) in conditions.edges.iter().zip([-T::one(), T::one()]) {
        let missed = (load - stiffness * (m.first + sign * m.mean)).abs() / size;
        if edge.is_free() && missed > error {
            error = missed;
        }
    }
    Some(error)
}

/// A load or a width for which no contact is found.
pub(super) struct Refused<'s, T: Real> {
    contact: &'s Contact<'s, T>,
    conditions: &'s Conditions<T>,
    /// What the bodies bear, once looked at.
    bears: Option<Option<Capacity<T>>>,
}

impl<T: Real> Refused<'_, T> {
    /// Refuses more than the bodies bear.
    pub fn check(&mut self, cost: &mut Cost) -> Result<(), ContactError<T>> {
        let Self { contact, conditions, .. } = *self;
        // Turned, they bear another load.
        if !contact.bears_as_one || matches!(conditions.given, Given::Centre { .. }) {
            return Ok(());
        }
        let range = contact.gap.range();
        let bears = self.bears.get_or_insert_with(|| capacity(contact, conditions, range, cost));
        match (conditions.given, bears) {
            (Given::Load(load), Some(bears)) if load > bears.load => Err(bears.too_short(load)),
            (Given::HalfWidth(wanted), Some(bears))
                if wanted > bears.on.half_width() * (T::one() + T::of(8.0) * T::epsilon()) =>
            {
                Err(bears.too_wide(wanted))
            }
            _ => Ok(()),
        }
    }

    /// The same after Newton's method, which close to an end is perhaps on its way beyond.
    fn check_if_close(
        &mut self,
        covered: Option<Interval<T>>,
        cost: &mut Cost,
    ) -> Result<(), ContactError<T>> {
        let range = self.contact.gap.range();
        let close = |on: Interval<T>| {
            let away = (on.left - range[0]).min(range[1] - on.right);
            away < T::of(1e-3) * on.half_width()
        };
        if covered.is_some_and(close) { self.check(cost) } else { Ok(()) }
    }

    /// That, where it is the reason for an error of a search.
    fn because(&mut self, error: ContactError<T>, cost: &mut Cost) -> ContactError<T> {
        match error {
            ContactError::NoBalance { .. }
            | ContactError::OutsideBodies { .. }
            | ContactError::Overflow { .. } => self.check(cost).err().unwrap_or(error),
            _ => error,
        }
    }
}

/// The contact that Newton's method has settled on.
pub(super) fn contact_of<T: Real>(
    contact: &Contact<'_, T>,
    conditions: &Conditions<T>,
    engine: &mut dyn Engine<T>,
    Settled { on, load, error, force }: Settled<T>,
) -> Result<Found<T>, ContactError<T>> {
    let m = engine.moments(&contact.gap, on)?;
    let load = match conditions.given {
        Given::Load(_) | Given::Centre { .. } => load,
        Given::HalfWidth(_) => load_of(conditions, on, load, &m),
    };
    Ok(Found { force: Some(force), ..Found::new(conditions, on, load, Some(error), &m) })
}

/// Samples a stretch around a contact that is nearly right, and finds the limits on that.
pub(super) fn in_full<T: Real>(
    contact: &Contact<'_, T>,
    conditions: &Conditions<T>,
    engine: &mut dyn Engine<T>,
    (guess, doubt): (Interval<T>, T),
) -> Result<Option<Settled<T>>, ContactError<T>> {
    let gap = &contact.gap;
    let (mut guess, mut best) = (guess.plain(), None);
    for _ in 0..3 {
        let stretch = around(contact, conditions, guess, T::of(0.02) + doubt);
        if engine.cover(gap, stretch, false)?.is_none() {
            return Ok(None);
        }
        let Some(settled) = settle(engine, gap, conditions, guess, Effort::Full)? else {
            return Ok(None);
        };
        // Panels much wider than the contact are not as good as they look.
        let covered = engine.covered().unwrap_or(stretch);
        if settled.on.half_width() >= T::of(0.8) * covered.half_width() {
            return Ok(Some(settled));
        }
        (guess, best) = (settled.on.plain(), Some(settled));
    }
    Ok(best)
}

/// The nested search.
fn nested<T: Real>(
    contact: &Contact<'_, T>,
    conditions: &Conditions<T>,
    engine: &mut dyn Engine<T>,
    start: Option<Interval<T>>,
    cost: &mut Cost,
) -> Result<(Nested<T>, Option<T>), ContactError<T>> {
    let load = conditions.load();
    let goal = Goal::Strength { conditions: *conditions, load };
    match conditions.given {
        Given::Load(load) | Given::Centre { load, .. } => {
            let nested = limits::find(contact, load, goal, engine, start, cost)?;
            Ok((nested, Some(load)))
        }
        Given::HalfWidth(half_width) => {
            Ok((limits::place(contact, goal, engine, half_width, cost)?, None))
        }
    }
}
