//! The load that the bodies bear in any number of contacts.
//!
//! The contacts grow with the load, until a limit comes to an end of the bodies, or the loaded gap closes there before one
//! does. The first is a condition of Newton's method, with the load one more unknown. For the second the load is
//! raised from one that the bodies bear: the gap at an end falls at the rate g/κ, with Green's function g of what lies
//! outside the contacts, which falls as they grow. So the gap is a convex function of the load, and no secant through
//! two loads leads beyond the one under which it closes.

use super::super::active_set::FIRST_CELLS;
use super::super::capacity::Capacity;
use super::super::edges::Conditions;
use super::{Contact, Search, Work};
use crate::quadrature::LoadCase;
use crate::quadrature::panels::{self, Several};
use crate::solution::{ContactState, Solved, largest_pressure};
use crate::{ContactError, Ends, Interval, Real, Side};

/// How closely the load under which cells reach an end of the bodies is enclosed.
const NEAR: f64 = 1.25;

/// The first of the shares of a load, each the square of the one before, among which one is sought that reaches no
/// end of the bodies; and how many.
const LESS: f64 = 0.25;
const MOST_SHARES: usize = 6;

/// The first step of the load, as a share of it.
const FIRST_STEP: f64 = 1.0 / 64.0;

/// Loads tried. (Where a limit comes to the end the gap falls as the power 3/2 of what is left: 60 secants to rounding.)
const MOST_LOADS: usize = 100;

/// The last step of the load, as a share of it, in units of rounding.
const LAST_STEP: f64 = 1e4;

/// The part of a load that the bodies bear.
pub(in super::super) enum Borne<T: Real> {
    /// All of it, in these contacts.
    All(ContactState<T>),
    /// Less, in contacts that reach an end.
    UpTo(Capacity<T>),
}

/// Returns what the bodies bear of a load under which no contact was found, if that is known.
pub(in super::super) fn bears<T: Real>(
    contact: &Contact<'_, T>,
    conditions: &Conditions<T>,
    work: &mut Work<'_, T>,
) -> Option<Borne<T>> {
    Search::new(contact, *conditions, work).bears(conditions)
}

/// Returns the widest contacts that only just reach a corner, where one holds the contacts under some load.
pub(in super::super) fn up_to_corner<T: Real>(
    contact: &Contact<'_, T>,
    conditions: &Conditions<T>,
    free: Ends<bool>,
    work: &mut Work<'_, T>,
) -> Option<Capacity<T>> {
    let held = Side::BOTH.into_iter().filter(|&side| !free[side]);
    let reached = held.filter_map(|side| {
        Search::new(contact, *conditions, &mut *work).up_to_end(conditions, side)
    });
    let lighter =
        |one: Capacity<T>, other: Capacity<T>| if other.load < one.load { other } else { one };
    let is_free = |found: &Capacity<T>| found.peak.is_finite() && found.load <= conditions.load();
    reached.filter(is_free).reduce(lighter)
}

impl<T: Real> Search<'_, '_, '_, T> {
    /// Returns the contacts under a load that the bodies bear, where that is known.
    pub(super) fn borne(
        &mut self,
        conditions: &Conditions<T>,
    ) -> Result<Option<ContactState<T>>, ContactError<T>> {
        // Turned, they bear another load.
        if self.end.is_some() || self.turns() {
            return Ok(None);
        }
        match self.bears(conditions) {
            Some(Borne::UpTo(widest)) => Err(widest.too_short(conditions.load())),
            Some(Borne::All(found)) => Ok(Some(found)),
            None => Ok(None),
        }
    }

    /// Returns what the bodies bear of a load under which cells reach an end of them.
    pub(super) fn bears(&mut self, conditions: &Conditions<T>) -> Option<Borne<T>> {
        let ends = self.contact.ends();
        if let Some(side) = self.end_touched_first() {
            return Some(Borne::UpTo(Capacity::nothing(ends[side])));
        }
        self.under_some_load(conditions).or_else(|| {
            let side = self.end_that_supports(conditions.at()?)?;
            Some(Borne::UpTo(Capacity::nothing(ends[side])))
        })
    }

    /// Returns the end of the bodies at which the gap is lowest: nothing is borne then, unless they turn.
    pub(super) fn end_touched_first(&mut self) -> Option<Side> {
        let (ends, at_corner) = (self.contact.ends(), self.corners());
        if self.turns() {
            return None;
        }
        let lowest = self.look().ok()?.lowest();
        Side::BOTH.into_iter().find(|&side| lowest == ends[side] && !at_corner[side])
    }

    /// Returns what the bodies bear, where that is not nothing.
    fn under_some_load(&mut self, conditions: &Conditions<T>) -> Option<Borne<T>> {
        let (low, high) = self.end_reached_by(conditions)?;
        // What was found last may be far from there.
        self.work.workspace.keep(&[]);
        let exact = high.and_then(|(load, side)| self.up_to_end(&conditions.under(load), side));
        let exact = exact.filter(|exact| exact.load < conditions.load());
        exact.map(Borne::UpTo).or_else(|| self.until_closed(conditions, low))
    }

    /// Returns the end of the bodies at which one of the two places lies that hold up a light load that acts at `at`.
    fn end_that_supports(&mut self, at: T) -> Option<Side> {
        let (ends, at_corner) = (self.contact.ends(), self.corners());
        let gap = &self.contact.gap;
        let heights = self.look().ok()?.heights(gap);
        let middle = heights.partition_point(|&[x, _]| x < at);
        let (left, right) = heights.split_at(middle);
        let lowest = |heights: &[[T; 2]], slope: T| {
            let lower = |one: [T; 2], other: [T; 2]| {
                if other[1] - slope * other[0] < one[1] - slope * one[0] { other } else { one }
            };
            heights.iter().copied().reduce(lower)
        };
        // Each chord is lower at that place than the one before.
        let mut slope = T::zero();
        for _ in 0..heights.len() {
            let [from, to] = [lowest(left, slope)?, lowest(right, slope)?];
            let next = (to[1] - from[1]) / (to[0] - from[0]);
            if next == slope {
                let places = Ends { left: from[0], right: to[0] };
                let held = |&side: &Side| places[side] == ends[side] && !at_corner[side];
                return Side::BOTH.into_iter().find(held);
            }
            slope = next;
        }
        None
    }

    /// Returns the contacts under the load that puts a limit at an end of the bodies.
    fn up_to_end(&mut self, conditions: &Conditions<T>, end: Side) -> Option<Capacity<T>> {
        // Turned, the bodies bear another load.
        if conditions.at().is_some() {
            return None;
        }
        let mut search = Search::new(self.contact, *conditions, &mut *self.work);
        search.end = Some(end);
        let found = search.several(None).ok()?;
        let (on, room) = (found.interval, self.room(found.interval));
        let side = if room.right < room.left { Side::Right } else { Side::Left };
        // A single contact as wide as the widest in balance may be another one.
        if room[side] > T::epsilon().sqrt() * on.half_width() {
            return None;
        }
        self.capacity(&found, side)
    }

    /// Raises the load from one that leaves the gap open at the ends of the bodies, until it is closed there or the load is
    /// the one that is asked for.
    fn until_closed(&mut self, conditions: &Conditions<T>, low: T) -> Option<Borne<T>> {
        let (half, asked) = (T::of(0.5), conditions.load());
        let shares = std::iter::successors(Some(low), |&load| Some(T::of(LESS) * load));
        let (mut load, mut gaps) = shares
            .take(MOST_SHARES)
            .find_map(|load| Some((load, self.gaps_at_ends(&conditions.under(load))?.1)))?;
        let mut step = T::of(FIRST_STEP) * load;
        for _ in 0..MOST_LOADS {
            if step <= T::of(LAST_STEP) * T::epsilon() * load {
                break;
            }
            let next = conditions.under((load + step).min(asked));
            let Some((found, closer)) = self.gaps_at_ends(&next) else {
                step = half * (next.load() - load);
                continue;
            };
            if next.load() >= asked {
                return Some(Borne::All(found));
            }
            step = (next.load() - load)
                * secant(gaps.left, closer.left).min(secant(gaps.right, closer.right));
            (load, gaps) = (next.load(), closer);
        }
        let (found, gaps) = self.gaps_at_ends(&conditions.under(load))?;
        let side = lower(gaps);
        // Where it stays open it is something else that the search ends by.
        let closes = gaps[side] <= T::epsilon().sqrt() * load / conditions.kappa;
        if closes { Some(Borne::UpTo(self.capacity(&found, side)?)) } else { None }
    }

    /// Finds the contacts under a load, with the gap that is left at each end of the bodies; infinite at a corner.
    fn gaps_at_ends(&mut self, conditions: &Conditions<T>) -> Option<(ContactState<T>, Ends<T>)> {
        let mut search = Search::new(self.contact, *conditions, &mut *self.work);
        // Nothing more is asked of what the bodies bear.
        search.has_run_out = true;
        let found = search.find().ok()?;
        let (gap, ends, at_corner) =
            (&self.contact.gap.tilted(found.tilt), self.contact.ends(), self.corners());
        self.work.keep(gap, found.interval).ok()?;
        let integrator = &*self.work.integrator;
        let solved = Solved { gap, integrator, kappa: conditions.kappa, found: &found };
        let gap_at = |side: Side| match at_corner[side] {
            true => Ok(T::one() / T::zero()),
            // By rounding.
            false if found.interval.contains(ends[side]) => Ok(T::zero()),
            false => solved.gap_at(ends[side]),
        };
        let [left, right] = [gap_at(Side::Left).ok()?, gap_at(Side::Right).ok()?];
        Some((found, Ends { left, right }))
    }

    /// Returns the room between the outermost limits and the ends of the bodies.
    fn room(&self, on: Interval<T>) -> Ends<T> {
        let ends = self.contact.ends();
        Ends { left: on.left - ends.left, right: ends.right - on.right }
    }

    /// Returns the contacts found as what the bodies bear.
    fn capacity(&mut self, found: &ContactState<T>, side: Side) -> Option<Capacity<T>> {
        let ContactState { interval: on, load, free, .. } = *found;
        let (integrator, gap) = (&*self.work.integrator, &self.contact.gap.tilted(found.tilt));
        let several = panels::several(integrator).map(Several::contacts);
        let contacts = several.unwrap_or(std::slice::from_ref(&on));
        let load_case = LoadCase { kappa: self.contact.kappa, load, free };
        let mut peak = if free == Ends::both(true) { T::zero() } else { T::one() / T::zero() };
        for contact in contacts.iter().copied().enumerate() {
            let (_, largest) =
                largest_pressure(integrator, gap, &load_case, contact, self.work.cost).ok()?;
            peak = peak.max(largest.value);
        }
        Some(Capacity { on, end: self.contact.ends()[side], load, peak })
    }

    /// Returns a load under which cells reach no end of the bodies, and one not much larger under which they do, with the
    /// end. The latter is not known where the first look at cells reaches none.
    fn end_reached_by(&mut self, conditions: &Conditions<T>) -> Option<(T, Option<(T, Side)>)> {
        let mut end_reached = |load: T| {
            let coarse = self.coarse(&conditions.under(load), FIRST_CELLS).ok()?;
            Some(self.end_reached(&coarse))
        };
        let (mut load, mut share, mut high) = (conditions.load(), T::of(LESS), None);
        let mut low = None;
        for _ in 0..=MOST_SHARES {
            match end_reached(load)? {
                Some(end) => high = Some((load, end)),
                None => {
                    low = Some(load);
                    break;
                }
            }
            load = share * conditions.load();
            share *= share;
        }
        // Not even under so little.
        let Some(mut low) = low else { return Some((load, high)) };
        while let Some((above, _)) = high
            && above > T::of(NEAR) * low
        {
            let load = low.sqrt() * above.sqrt();
            match end_reached(load)? {
                Some(end) => high = Some((load, end)),
                None => low = load,
            }
        }
        Some((low, high))
    }
}

/// Returns the side at which the gap is lower.
fn lower<T: Real>(gaps: Ends<T>) -> Side {
    if gaps.right < gaps.left { Side::Right } else { Side::Left }
}

/// Returns how many more steps like the last one close a gap that this has made closer.
fn secant<T: Real>(before: T, closer: T) -> T {
    let fall = before - closer;
    if fall > T::zero() { closer / fall } else { T::one() / T::epsilon() }
}
