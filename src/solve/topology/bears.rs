//! Load that the bodies bear in any number of contacts.
//!
//! The contacts grow with the load, until a limit reaches an end of the bodies, or the loaded gap
//! closes there first. The load is raised from one that the bodies bear: the gap at an end shrinks
//! at the rate g/κ, with Green's function g of the region outside the contacts, which decreases as
//! they grow. So the gap is a convex function of the load, and no secant through two loads passes
//! the load under which it closes. Where it shrinks fast, the first case is tried: a condition of
//! Newton's method, with the load as one more unknown.

use super::super::active_set::FIRST_CELLS;
use super::super::capacity::Capacity;
use super::super::edges::{Conditions, Given};
use super::revise::is_lost;
use super::{Contact, Search, Work, Workspace, settle};
use crate::quadrature::LoadCase;
use crate::solution::{ContactState, Solved, Start, largest_pressure};
use crate::{ContactError, Ends, Fallible, Interval, Real, Side, SolveError};

/// Ratio of the loads that enclose the one under which cells reach an end of the bodies.
const BRACKET_RATIO: f64 = 1.25;

/// Load fractions tried (¼, then each squared) until the contacts reach no end of the bodies, and
/// the largest number of them.
const FIRST_FRACTION: f64 = 0.25;
const MAX_SHARES: usize = 6;

/// First step of the load, as a share of it.
const FIRST_STEP: f64 = 1.0 / 64.0;

/// Loads tried. (If a limit reaches the end, the gap shrinks as the power 3/2 of the load left: 60
/// secants to rounding.)
const MAX_LOADS: usize = 100;

/// Halvings of the way from the middle of the bodies to a place where the load cannot act.
const MAX_PLACE_HALVES: usize = 14;

/// Share of the bodies left beyond a contact that cannot be moved any further.
const LEAST_LEFT: f64 = 0.01;

/// Last step of the load, as a share of it, in units of rounding.
const LAST_STEP: f64 = 1e4;

/// Contacts under all of a load, or those under the part of it that the bodies bear.
type Borne<T> = Result<ContactState<T>, Capacity<T>>;

/// Returns the widest contacts that just reach a corner, if it holds the contacts under a given
/// load.
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
    /// Returns the contacts after all, or an error that says what the bodies bear, if the search
    /// has led to an end of them.
    pub(super) fn explain(&mut self, error: ContactError<T>) -> Fallible<T, ContactState<T>> {
        self.check_parallel()?;
        // Of a single interval, no cells show that bodies that turn are too short.
        let is_blind = self.contact.single_interval && self.turns();
        let lifts_off = matches!(error, ContactError::Solve(SolveError::LiftsOff { .. }));
        let is_nowhere = error.may_be_several() && !lifts_off;
        let flat = if is_lost(&error) { self.end_of_flat() } else { None };
        let may_run_out = self.runs_out.is_some() || is_blind && is_nowhere || flat.is_some();
        if !may_run_out {
            return Err(error);
        }
        let (ends, conditions) = (self.contact.ends(), self.conditions);
        let mut is_at_end = false;
        let borne = match self.end_touched_first().or(flat) {
            Some(side) => Some(Err(Capacity::nothing(ends[side]))),
            None => self.under_some_load(&conditions).or_else(|| {
                let side = self.end_that_supports(conditions.at()?)?;
                is_at_end = true;
                Some(Err(Capacity::nothing(ends[side])))
            }),
        };
        let error = match borne {
            Some(Ok(found)) => return Ok(found),
            Some(Err(widest)) => widest.exceeded(&conditions),
            None => error,
        };
        Err(self.nearest(is_at_end).unwrap_or(error))
    }

    /// Returns the error with the nearest place where the load can act, between that given and the
    /// middle of the bodies. `None` if it cannot act in the middle, either, or if no limit is near
    /// an end and none supports the load.
    fn nearest(&mut self, is_at_end: bool) -> Option<ContactError<T>> {
        let (conditions, ends, half) = (self.conditions, self.contact.ends(), T::of(0.5));
        let (load, at) = (conditions.load(), conditions.at()?);
        let mut find = |at: T| {
            let conditions = Conditions { given: Given::Centre { load, at }, ..conditions };
            settle(&mut Search::new(self.contact, conditions, &mut *self.work)).ok()
        };
        let (mut reached, mut beyond) = (half * ends.left + half * ends.right, at);
        let mut found = find(reached)?;
        for _ in 0..MAX_PLACE_HALVES {
            let at = half * reached + half * beyond;
            match find(at) {
                Some(nearer) => (reached, found) = (at, nearer),
                None => beyond = at,
            }
        }
        let (tilt, room) = (found.tilt, self.room(found.interval));
        let is_near = room.left.min(room.right) <= T::of(LEAST_LEFT) * (ends.right - ends.left);
        (is_near || is_at_end)
            .then(|| SolveError::TiltNotFound { load, at, reached, tilt, ends }.into())
    }

    /// Returns the end of the bodies at which the gap is lowest: they bear no load then, unless
    /// they turn.
    pub(super) fn end_touched_first(&mut self) -> Option<Side> {
        let (ends, at_corner) = (self.contact.ends(), self.corners());
        if self.turns() {
            return None;
        }
        let lowest = self.look().ok()?.lowest;
        Side::BOTH.into_iter().find(|&side| lowest == ends[side] && !at_corner[side])
    }

    /// Returns an end of the bodies, not declared to be a corner, up to which the lowest gap is
    /// flat: its lowest place is elsewhere, and as low.
    fn end_of_flat(&mut self) -> Option<Side> {
        let (gap, ends, at_corner) = (&self.contact.gap, self.contact.ends(), self.corners());
        if self.turns() {
            return None;
        }
        let look = self.look().ok()?;
        let is_flat = |x: T| {
            let height = look.height(gap, gap.nearest(x));
            x != look.lowest && height == look.height(gap, look.lowest)
        };
        Side::BOTH.into_iter().find(|&side| !at_corner[side] && is_flat(ends[side]))
    }

    /// Returns the part of the load that the bodies bear, if it is not zero.
    fn under_some_load(&mut self, conditions: &Conditions<T>) -> Option<Borne<T>> {
        let low = self.reaches_no_end(conditions);
        // The contacts last found may be far from those sought.
        self.work.workspace.keep(&[]);
        self.until_closed(conditions, low)
    }

    /// Returns an end of the bodies that is one of the two supports of a light load acting at `at`.
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
        // Each chord is lower at `at` than the one before.
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

    /// Returns the contacts under the load that puts a limit at an end of the bodies, by Newton's
    /// method from the contacts found last.
    fn up_to_end(&mut self, conditions: &Conditions<T>, end: Side) -> Option<Capacity<T>> {
        // Bodies that turn bear another load.
        if conditions.at().is_some() {
            return None;
        }
        let mut search = Search::new(self.contact, *conditions, &mut *self.work);
        search.end = Some(end);
        let Workspace { newton, last, .. } = &mut *search.work.workspace;
        newton.on.clone_from(last);
        let found = search.equilibrium(Start::Last).ok()?;
        search.check(&found).ok()?;
        let (on, room) = (found.interval, self.room(found.interval));
        // A single contact as wide as the widest balanced one may be a different one.
        if room[lower(room)] > T::epsilon().sqrt() * on.half_width() {
            return None;
        }
        self.capacity(&found, lower(room))
    }

    /// Raises the load from one that leaves the gap open at the ends of the bodies, until it closes
    /// there or the required load is reached.
    fn until_closed(&mut self, conditions: &Conditions<T>, low: T) -> Option<Borne<T>> {
        let (half, asked) = (T::of(0.5), conditions.load());
        let closes = |load: T, gaps: Ends<T>| {
            gaps[lower(gaps)] <= T::epsilon().sqrt() * load / conditions.kappa
        };
        let shares = std::iter::successors(Some(low), |&load| Some(T::of(FIRST_FRACTION) * load));
        let (mut load, mut gaps) = shares
            .take(MAX_SHARES)
            .find_map(|load| Some((load, self.gaps_at_ends(&conditions.under(load))?.1)))?;
        let mut step = T::of(FIRST_STEP) * load;
        for _ in 0..MAX_LOADS {
            if step <= T::of(LAST_STEP) * T::epsilon() * load {
                break;
            }
            let next = conditions.under((load + step).min(asked));
            let Some((found, closer)) = self.gaps_at_ends(&next) else {
                step = half * (next.load() - load);
                continue;
            };
            if next.load() >= asked {
                return Some(Ok(found));
            }
            let side = lower(closer);
            if closer[side] < half * gaps[side]
                && let Some(exact) = self.up_to_end(&next, side).filter(|exact| exact.load < asked)
            {
                return Some(Err(exact));
            }
            let further = secant(gaps.left, closer.left).min(secant(gaps.right, closer.right));
            step = further * (next.load() - load);
            (load, gaps) = (next.load(), closer);
            // The rest of the gap is rounding.
            if further > T::one() && closes(load, gaps) {
                break;
            }
        }
        let (found, gaps) = self.gaps_at_ends(&conditions.under(load))?;
        // If the gap stays open, the search has failed for another reason.
        if closes(load, gaps) { Some(Err(self.capacity(&found, lower(gaps))?)) } else { None }
    }

    /// Finds the contacts under a load, and the gap left at each end of the bodies; infinite at a
    /// corner.
    fn gaps_at_ends(&mut self, conditions: &Conditions<T>) -> Option<(ContactState<T>, Ends<T>)> {
        let mut search = Search::new(self.contact, *conditions, &mut *self.work);
        let found = settle(&mut search).ok()?;
        let (gap, ends, at_corner) =
            (&self.contact.gap.tilted(found.tilt), self.contact.ends(), self.corners());
        self.work.keep(gap, found.interval).ok()?;
        let integrator = &*self.work.integrator;
        let solved = Solved { gap, integrator, kappa: conditions.kappa, found: &found };
        let gap_at = |side: Side| match at_corner[side] {
            true => Ok(T::one() / T::zero()),
            // The contact reaches the end by rounding.
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

    /// Returns the contacts found as the capacity of the bodies.
    fn capacity(&mut self, found: &ContactState<T>, side: Side) -> Option<Capacity<T>> {
        let ContactState { interval: on, load, free, .. } = *found;
        let (integrator, gap) = (&*self.work.integrator, &self.contact.gap.tilted(found.tilt));
        let contacts = integrator.contacts(&on);
        let load_case = LoadCase { kappa: self.contact.kappa, load, free };
        let mut peak = if free == Ends::both(true) { T::zero() } else { T::one() / T::zero() };
        for contact in contacts.iter().copied().enumerate() {
            let (_, largest) =
                largest_pressure(integrator, gap, &load_case, contact, self.work.cost).ok()?;
            peak = peak.max(largest.value);
        }
        let (half_width, end) = (on.half_width(), self.contact.ends()[side]);
        Some(Capacity { half_width, end, load, peak })
    }

    /// Returns a load under which cells reach no end of the bodies, not much less than one under
    /// which they do; the least one that cells tell if they always do, as next to an end.
    fn reaches_no_end(&mut self, conditions: &Conditions<T>) -> T {
        let mut is_free = |load: T| {
            let coarse = self.coarse(&conditions.under(load), FIRST_CELLS).ok()?;
            Some(self.end_reached(&coarse).is_none())
        };
        let (mut low, mut high, mut share) = (conditions.load(), None, T::of(FIRST_FRACTION));
        for _ in 0..=MAX_SHARES {
            match is_free(low) {
                Some(true) => break,
                Some(false) => (low, high) = (share * conditions.load(), Some(low)),
                None => return high.unwrap_or(low),
            }
            share *= share;
        }
        while let Some(above) = high.filter(|&above| above > T::of(BRACKET_RATIO) * low) {
            let load = low.sqrt() * above.sqrt();
            if is_free(load) == Some(true) { low = load } else { high = Some(load) }
        }
        low
    }
}

/// Returns the side at which the gap is lower.
fn lower<T: Real>(gaps: Ends<T>) -> Side {
    if gaps.right < gaps.left { Side::Right } else { Side::Left }
}

/// Returns the number of further steps like the last one that close a gap.
fn secant<T: Real>(before: T, closer: T) -> T {
    let fall = before - closer;
    if fall > T::zero() { closer / fall } else { T::one() / T::epsilon() }
}
