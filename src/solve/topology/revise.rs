//! The table by which a fault of one set of contacts says which set is next.
//!
//! | fault | next set of contacts |
//! |---|---|
//! | tension in spans | the contacts are parted there |
//! | overlap in dips | one more contact in each dip |
//! | gaps that close | the contacts next to them become one |
//! | contacts that vanish | the other contacts |
//! | a limit that passes a corner | it is put there |
//! | anything else, or the set before the last again | the set of the cells |
//! | of one contact | the lowest gap, if it was not looked for; the set of the cells |
//! | an end of the bodies is passed, and the cells are no help | none: the load may be too large |
//!
//! All faults of a kind are mended at once.

use super::super::active_set::{Coarse, NotFound, Scene, active_set};
use super::super::fault::Fault;
use super::super::newton::several::put;
use super::super::signorini_check::Dip;
use super::{Conditions, Contact, FIRST_CELLS, Search, Work, Workspace, asked_by};
use crate::solution::{Outcome, Start};
use crate::{ContactError, Edge, Ends, Fallible, Interval, Real, Side, SolveError};

/// Largest uncertainty of heights, as a share of F/κ, to show by themselves where the bodies
/// touch: with 400 contacts a twelfth of the load of one.
const MAX_CELL_UNCERTAINTY: f64 = 2e-4;

/// Doublings of the cells: 2 112 of them separate contacts a thousandth of the bodies apart.
const MAX_DOUBLINGS: usize = 6;

/// First half-width of a contact put at an overlap, as a share of the bodies.
const SEED_WIDTH: f64 = 1e-4;

/// Next start, or the error of the search.
type Next<T> = Fallible<T, Start>;

impl<T: Real> Search<'_, '_, '_, T> {
    /// Makes the next set of contacts at the fault of the last one; returns its start, or the error
    /// if there is none.
    pub(in super::super) fn revise(&mut self, fault: Fault<T>) -> Next<T> {
        let (outcome, next) = match self.is_of_one() {
            true => self.after_one(fault),
            false => self.after_set(fault),
        };
        self.work.workspace.report.add(self.start, outcome);
        next.or_else(|error| self.start_anew(error))
    }

    /// Returns the outcome of a set, and the next start.
    fn after_set(&mut self, fault: Fault<T>) -> (Outcome, Next<T>) {
        let (ends, at_corner) = (self.contact.ends(), self.corners());
        let Workspace { newton, before, .. } = &mut *self.work.workspace;
        let on = &mut newton.on;
        if matches!(fault, Fault::Tension(_) | Fault::Overlap(_)) {
            self.free.clear();
            let both = on.iter().zip(&newton.held);
            let free = both.flat_map(|(on, held)| Side::BOTH.map(|side| (!held[side], on[side])));
            self.free.extend(free.filter_map(|(is_free, x)| is_free.then_some(x)));
        } else {
            // The limits at which a search has stopped say little.
            on.clone_from(before);
        }
        let (outcome, next) = match fault {
            Fault::Tension(error) | Fault::Overlap(error) => {
                let outcome = Outcome::of(&error);
                self.error = Some(error);
                (outcome, self.mend())
            }
            Fault::Gone { vanished, closed } => {
                let mut outcome = Outcome::Lost;
                for i in (0..on.len()).rev() {
                    if closed[i] {
                        on[i].right = on.remove(i + 1).right;
                        outcome = Outcome::Merged;
                    } else if vanished[i] && on.len() > 1 && !(i > 0 && closed[i - 1]) {
                        on.remove(i);
                    }
                }
                (outcome, Start::Attempt)
            }
            Fault::Beyond(side) if at_corner[side] => {
                put(on, side, ends[side]);
                (Outcome::ReachedCorner, Start::Attempt)
            }
            Fault::Final(error) => return (Outcome::NotFound, Err(error)),
            Fault::Error(error) if !error.may_be_several() => {
                return (Outcome::NotFound, Err(error));
            }
            fault => {
                // After a revision, the cells start from the last contacts; otherwise those say
                // nothing.
                if self.start != Start::Attempt {
                    on.clear();
                }
                match fault {
                    Fault::Beyond(side) => self.runs_out = Some(side),
                    Fault::Error(error) => self.error = Some(error),
                    _ => {}
                }
                (Outcome::NotFound, Start::ActiveSet)
            }
        };
        (outcome, self.unless_undone(next))
    }

    /// Returns the next start, unless the revision of a set has undone the one before, or there is
    /// no other start.
    fn unless_undone(&mut self, mut next: Start) -> Next<T> {
        // Unlike the cells, tension is exact.
        let Workspace { newton, before, .. } = &*self.work.workspace;
        if is_alike(&newton.on, &self.earlier) {
            next = Start::ActiveSet;
        }
        self.earlier.clear();
        if self.start != Start::ActiveSet {
            self.earlier.clone_from(before);
        }
        // More cells find no contact under more load than the bodies bear.
        if next == Start::ActiveSet && self.runs_out.is_some() {
            Err(self.not_found())
        } else {
            Ok(next)
        }
    }

    /// Returns the outcome of a search for one contact, and the next start; or its error if any
    /// number of contacts would have it.
    fn after_one(&mut self, fault: Fault<T>) -> (Outcome, Next<T>) {
        let error = match fault {
            Fault::Tension(error) | Fault::Overlap(error) => {
                let outcome = Outcome::of(&error);
                self.error = Some(error);
                let overlaps = outcome == Outcome::Overlap && self.may_be_several();
                let next = if overlaps { self.beside_one() } else { self.start_of_several() };
                return (outcome, next);
            }
            Fault::Error(error) | Fault::Final(error) => error,
            _ => self.no_balance(),
        };
        let Contact { gap, single_interval, .. } = self.contact;
        if *single_interval {
            return (Outcome::NotFound, Err(error));
        }
        // The first search had no survey of the bodies.
        if self.start == Start::Middle && gap.is_convex() && is_lost(&error) {
            return (Outcome::NotFound, Ok(Start::LowestGap));
        }
        let next = match self.is_of_any_number(&error) {
            Ok(true) => Err(error),
            Ok(false) => {
                self.of_one = Some(error);
                self.start_of_several()
            }
            Err(error) => Err(error),
        };
        (Outcome::NotFound, next)
    }

    /// Returns the next start after one contact beside which the bodies would overlap: cells, or
    /// where these tell nothing one more contact, if the first is not at the lowest gap. The load
    /// moves heights by up to F/κ times the logarithm of a distance in half-widths, and is less
    /// than heights are uncertain.
    fn beside_one(&mut self) -> Next<T> {
        let conditions = self.conditions;
        if !self.cells_tell(&conditions)? {
            let Workspace { look, overlaps, .. } = &*self.work.workspace;
            let moved = T::epsilon().ln().abs() * look.doubt_at(look.lowest);
            if overlaps.dips.iter().any(|dip| -dip.gap > moved) {
                return Ok(self.mend());
            }
        }
        self.start_of_several()
    }

    /// Tells whether a search for several contacts would fail with the error of this search for
    /// one.
    fn is_of_any_number(&mut self, error: &ContactError<T>) -> Fallible<T, bool> {
        // If the bodies turn, more contacts may press at the corner.
        if let ContactError::Solve(SolveError::LiftsOff { .. }) = error {
            return Ok(self.is_convex() || !self.turns());
        }
        if !self.contact.edges.are_sought() || !error.may_be_several() {
            return Ok(true);
        }
        let is_shut = matches!(error, ContactError::Solve(SolveError::NoFirstContact { .. }));
        if is_shut && self.end_touched_first().is_some() {
            return Ok(true);
        }
        // If the bodies turn, one contact may be hard to find, too; likewise at corners, and among
        // waves not yet seen.
        let is_convex = self.is_convex() && !self.corrects_survey()? && !self.has_corners()?;
        Ok(!self.turns() && (is_convex || !is_lost(error) && self.look()?.bulges()))
    }

    pub(super) fn no_balance(&self) -> ContactError<T> {
        let [near, to] = self.contact.gap.range();
        SolveError::NoEquilibrium { half_width: T::of(0.5) * (to - near), near }.into()
    }

    /// Returns the error of a search whose sets have all failed.
    pub(in super::super) fn not_found(&mut self) -> ContactError<T> {
        // The error of one contact alone says more, unless it is the load that one contact would
        // bear.
        let says = |fault: &ContactError<T>| match fault {
            ContactError::Solve(SolveError::NoEquilibrium { .. }) => false,
            ContactError::Solve(SolveError::DomainTooShort { .. }) => self.runs_out.is_none(),
            _ => true,
        };
        let error = self.of_one.clone().filter(says).or(self.error.clone().filter(says));
        error.unwrap_or(self.no_balance())
    }

    /// Parts the contacts at hand where there is tension, or puts new ones where the bodies would
    /// overlap. Returns the next start.
    fn mend(&mut self) -> Start {
        let ends = self.contact.ends();
        let Workspace { newton, before, tension_spans, overlaps, .. } = &mut *self.work.workspace;
        let on = &mut newton.on;
        for span in &tension_spans.spans {
            let apart = |on: Interval<T>| {
                let left = Interval { right: on.right.min(span.left), ..on };
                let right = Interval { left: on.left.max(span.right), ..on };
                [left, right].into_iter().filter(|on| on.left < on.right)
            };
            *on = on.drain(..).flat_map(apart).collect();
            // These ends are exact: no corner further away than the span is wide holds them.
            self.free.extend([span.left, span.right]);
        }
        let half = T::of(0.5);
        let aside = T::of(SEED_WIDTH) * (ends.right - ends.left);
        for &Dip { x, lean, width, .. } in &overlaps.dips {
            let at = on.partition_point(|on| on.right < x);
            let left = if at == 0 { ends.left } else { on[at - 1].right };
            let right = on.get(at).map_or(ends.right, |next| next.left);
            let aside = aside.min(width);
            let seed = Interval {
                left: (x - aside * (T::one() + lean)).max(half * (x + left)),
                right: (x + aside * (T::one() - lean)).min(half * (x + right)),
            };
            if seed.left < seed.right {
                on.insert(at, seed);
            }
        }
        if on.is_empty() || on == before { Start::ActiveSet } else { Start::Attempt }
    }

    /// Returns the sides at which a corner may hold the contacts.
    pub(super) fn corners(&self) -> Ends<bool> {
        self.contact.edges.map(|edge| matches!(edge, Edge::Fixed(_) | Edge::FreeUntil(_)))
    }

    /// Takes the contacts from a coarse active set, with more cells after each failure.
    pub(super) fn take_cells(&mut self) -> Fallible<T, ()> {
        self.check_parallel()?;
        self.show_panels()?;
        // This number of cells has not failed yet.
        let (cells, conditions) = (self.cells, self.conditions);
        self.cells = (cells + cells).min(FIRST_CELLS << MAX_DOUBLINGS);
        let coarse = self.coarse(&conditions, cells)?;
        self.runs_out = self.end_reached(&coarse);
        let tilt = self.contact.gap.tilt() + coarse.tilt;
        let parted = self.parted_at_slits(coarse.intervals)?;
        let newton = &mut self.work.workspace.newton;
        (newton.on, newton.tilt) = (parted, tilt);
        Ok(())
    }

    /// Surveys the bodies for cells. Tells whether these tell anything: they go by heights, which
    /// must be known to F/κ.
    fn cells_tell(&mut self, conditions: &Conditions<T>) -> Fallible<T, bool> {
        let (gap, Work { workspace, cost, .. }) = (&self.contact.gap, &mut *self.work);
        workspace.take(gap, cost)?;
        workspace.look.refine(gap, asked_by(conditions), T::of(MAX_CELL_UNCERTAINTY), cost)?;
        let look = &workspace.look;
        Ok(conditions.load().abs() >= conditions.kappa * look.doubt_at(look.lowest))
    }

    pub(super) fn coarse(
        &mut self,
        conditions: &Conditions<T>,
        cells: usize,
    ) -> Fallible<T, Coarse<T>> {
        let tell = self.cells_tell(conditions)?;
        let (gap, Ends { left, right }) = (&self.contact.gap, self.contact.ends());
        let Work { workspace, cost, .. } = &mut *self.work;
        let Workspace { look, newton, cell_work, .. } = &mut **workspace;
        let (kappa, load) = (conditions.kappa, conditions.load());
        let half_width = T::of(0.5) * (right - left);
        let nothing = SolveError::NoEquilibrium { half_width, near: look.lowest }.into();
        if !tell {
            return Err(nothing);
        }
        let (turned, range) = (look.heights(gap), [left, right]);
        let (at, known, start) = (conditions.at(), &turned[..], &newton.on[..]);
        let (watch, kernel) = (&|| gap.check_watch(**cost, Interval { left, right }), None);
        let scene = Scene { kappa, load, at, range, cells, known, start, kernel, watch };
        let mut height = |x: T| Ok(gap.turned(x, look.height(gap, gap.nearest(x))));
        active_set(&scene, cell_work, &mut height).map_err(|error| match error {
            NotFound::Height(error) => error,
            _ => nothing,
        })
    }

    /// Returns the end of the bodies that contacts reach with no corner to hold them.
    pub(super) fn end_reached(&self, coarse: &Coarse<T>) -> Option<Side> {
        let at_corner = self.corners();
        Side::BOTH.into_iter().find(|&side| coarse.reaches[side] && !at_corner[side])
    }
}

/// Tells whether a search has found nothing.
pub(super) fn is_lost<T: Real>(error: &ContactError<T>) -> bool {
    matches!(error, ContactError::Solve(SolveError::NoEquilibrium { .. }))
}

/// Tells whether two sets have the same number of contacts, and each contact and each gap between
/// two overlaps its counterpart: a gap elsewhere may be the right one.
fn is_alike<T: Real>(one: &[Interval<T>], other: &[Interval<T>]) -> bool {
    let limits =
        |on: &[Interval<T>]| -> Vec<T> { on.iter().flat_map(|on| [on.left, on.right]).collect() };
    let (one, other) = (limits(one), limits(other));
    let meet = |i: usize| one[i - 1] < other[i] && other[i - 1] < one[i];
    one.len() == other.len() && (1..one.len()).all(meet)
}
