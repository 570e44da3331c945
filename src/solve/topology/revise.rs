//! The table by which a fault of one set of contacts says which set is next.
//!
//! | fault | next set of contacts |
//! |---|---|
//! | tension in spans | the contacts are parted there |
//! | overlap in dips | one more contact in each dip |
//! | gaps that close | the contacts next to them become one |
//! | contacts that vanish | the other contacts |
//! | a limit that passes a corner, or an end where the load for one is sought | the limit is put there |
//! | anything else, or the set before the last again | the set of the cells |
//! | of one contact | the lowest gap, if it was not looked for; the set of the cells |
//! | an end of the bodies is passed, and the cells are no help | none: the load may be too large |
//!
//! All faults of a kind are mended at once.

use super::super::active_set::{Coarse, NotFound, Scene, active_set};
use super::super::newton::Stop;
use super::super::newton::several::put;
use super::{Conditions, FIRST_CELLS, Search, Tried, Work, Workspace, asked_by};
use crate::solution::{Outcome, Start};
use crate::{ContactError, Edge, Ends, Interval, Real, Side, SolveError};

/// Largest uncertainty of heights, as a share of F/κ, to show by themselves where the bodies
/// touch: with 400 contacts a twelfth of the load of one.
const MAX_UNCERTAINTY: f64 = 2e-4;

/// Doublings of the cells: 2 112 of them separate contacts a thousandth of the bodies apart.
const MAX_DOUBLINGS: usize = 6;

/// Share of a contact's half-width by which a limit leaves a corner that does not hold it. Its
/// square is the first half-width of a contact put at an overlap, as a share of the bodies.
const CORNER_STEP: f64 = 0.01;

/// Reason why a set of contacts is not the solution.
pub(in super::super) enum Fault<T: Real> {
    /// Tension inside the contacts, with its spans in the workspace.
    Tension(ContactError<T>),
    /// Overlap outside the contacts, with its dips in the workspace.
    Overlap(ContactError<T>),
    /// Contacts that vanish, and contacts with a gap after them that closes.
    Gone { vanished: Vec<bool>, closed: Vec<bool> },
    /// Corner, or end of the bodies for which the load is sought, that a limit passes.
    Reaches(Side),
    /// End of the bodies that a limit passes.
    Beyond(Side),
    /// Limits that are not found, with the error of a search that says why.
    Stuck(Option<ContactError<T>>),
}

impl<T: Real> Fault<T> {
    fn outcome(&self) -> Outcome {
        match self {
            Self::Tension(_) => Outcome::Tension,
            Self::Overlap(_) => Outcome::Overlap,
            Self::Gone { closed, .. } if closed.contains(&true) => Outcome::Merged,
            Self::Gone { .. } => Outcome::Lost,
            Self::Reaches(_) => Outcome::ReachedCorner,
            Self::Beyond(_) | Self::Stuck(_) => Outcome::NotFound,
        }
    }
}

impl<T: Real> Search<'_, '_, '_, T> {
    /// Enters an attempt in the report.
    pub(in super::super) fn enter(&mut self, start: Start, tried: Tried<T>) -> Tried<T> {
        let passed = match self.contact.single_interval {
            true => Outcome::Unchecked,
            false => Outcome::Passed,
        };
        let outcome =
            |tried: &Result<_, Fault<T>>| tried.as_ref().map_or_else(Fault::outcome, |_| passed);
        let attempt = tried.map(|tried| (outcome(&tried), tried));
        self.work.workspace.report.end(start, attempt)
    }

    /// Returns the fault of a set whose limits were not found.
    pub(super) fn fault_of(&mut self, stop: Stop<T>) -> Fault<T> {
        let at_corner = self.corners();
        let newton = &self.work.workspace.newton;
        match stop {
            Stop::Gone if newton.on.len() > 1 => {
                let contacts = 0..newton.on.len();
                let closed: Vec<bool> = contacts.clone().map(|i| newton.is_gone(i, true)).collect();
                let vanished = contacts.clone().map(|i| newton.is_gone(i, false)).collect();
                let of_rounding = contacts.filter(|&i| closed[i] && newton.is_nothing(i));
                self.closed.extend(of_rounding.map(|i| newton.closed_gap(i)));
                Fault::Gone { vanished, closed }
            }
            Stop::Beyond { side, .. } if at_corner[side] || self.end.is_some() => {
                Fault::Reaches(side)
            }
            Stop::Beyond { side, .. } => Fault::Beyond(side),
            Stop::Gone | Stop::Failed => Fault::Stuck(None),
        }
    }

    /// Makes the next set of contacts at the fault of the last one, and returns its start; or the
    /// error if there is none.
    pub(in super::super) fn revise(
        &mut self,
        fault: Fault<T>,
        start: Start,
    ) -> Result<Start, ContactError<T>> {
        if self.is_of_one {
            return self.after_one(fault, start);
        }
        let (ends, at_corner) = (self.contact.ends(), self.corners());
        let Workspace { newton, before, .. } = &mut *self.work.workspace;
        let on = &mut newton.on;
        // The limits at which a search has stopped say little.
        if !matches!(fault, Fault::Tension(_) | Fault::Overlap(_)) {
            on.clone_from(before);
        }
        let mut next = Start::Attempt;
        match fault {
            Fault::Tension(error) | Fault::Overlap(error) => {
                self.error = Some(error);
                next = self.mend();
            }
            Fault::Gone { vanished, closed } => {
                for i in (0..on.len()).rev() {
                    if closed[i] {
                        on[i].right = on.remove(i + 1).right;
                    } else if vanished[i] && on.len() > 1 && !(i > 0 && closed[i - 1]) {
                        on.remove(i);
                    }
                }
            }
            Fault::Reaches(side) if at_corner[side] => put(on, side, ends[side]),
            // This end is reached under a smaller load.
            Fault::Reaches(side) => self.end = Some(side),
            Fault::Beyond(_) | Fault::Stuck(_) => {
                // After a revision, the cells start from the last contacts; otherwise those say
                // nothing.
                if start != Start::Attempt {
                    on.clear();
                }
                match fault {
                    Fault::Beyond(side) => self.runs_out = Some(side),
                    Fault::Stuck(error) => self.error = error.or(self.error.take()),
                    _ => {}
                }
                next = Start::ActiveSet;
            }
        }
        // This revision undoes the one before. Unlike the cells, tension is exact.
        let Workspace { newton, before, .. } = &*self.work.workspace;
        if is_alike(&newton.on, &self.earlier) {
            next = Start::ActiveSet;
        }
        self.earlier.clear();
        if start != Start::ActiveSet {
            self.earlier.clone_from(before);
        }
        // More cells find no contact under more load than the bodies bear.
        if next == Start::ActiveSet
            && self.runs_out.is_some()
            && std::mem::replace(&mut self.has_run_out, true)
        {
            return Err(self.not_found());
        }
        Ok(next)
    }

    /// Returns the start after a fault of one contact, or its error if any number of contacts would
    /// have it.
    fn after_one(&mut self, fault: Fault<T>, start: Start) -> Result<Start, ContactError<T>> {
        match fault {
            Fault::Tension(error) | Fault::Overlap(error) => self.error = Some(error),
            Fault::Stuck(Some(error)) => {
                let is_lost =
                    matches!(error, ContactError::Solve(SolveError::NoEquilibrium { .. }));
                // The first search had no survey of the bodies.
                if start == Start::Middle
                    && is_lost
                    && self.contact.gap.is_convex()
                    && !self.contact.single_interval
                {
                    return Ok(Start::LowestGap);
                }
                if self.contact.single_interval || self.is_of_any_number(&error)? {
                    return Err(error);
                }
                self.of_one = Some(error);
            }
            _ => {}
        }
        self.start_of_several()
    }

    /// Tells whether a search for several contacts would fail with the error of this search for
    /// one.
    fn is_of_any_number(&mut self, error: &ContactError<T>) -> Result<bool, ContactError<T>> {
        match error {
            ContactError::Solve(SolveError::Tension { .. } | SolveError::Overlap { .. }) => {
                return Ok(false);
            }
            // If the bodies turn, more contacts may press at the corner.
            ContactError::Solve(SolveError::LiftsOff { .. }) => {
                return Ok(self.is_convex() || !self.turns());
            }
            _ => {}
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
        let is_lost = matches!(error, ContactError::Solve(SolveError::NoEquilibrium { .. }));
        let is_convex = self.is_convex() && !self.corrects_survey()? && !self.has_corners()?;
        Ok(!self.turns() && (is_convex || !is_lost && self.look()?.bulges()))
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
        }
        let half = T::of(0.5);
        let aside = T::of(CORNER_STEP * CORNER_STEP) * (ends.right - ends.left);
        for &[x, _] in &overlaps.dips {
            let at = on.partition_point(|on| on.right < x);
            let left = if at == 0 { ends.left } else { on[at - 1].right };
            let right = on.get(at).map_or(ends.right, |next| next.left);
            let seed = Interval {
                left: (x - aside).max(half * (x + left)),
                right: (x + aside).min(half * (x + right)),
            };
            if seed.left < seed.right {
                on.insert(at, seed);
            }
        }
        if on.is_empty() || on == before { Start::ActiveSet } else { Start::Attempt }
    }

    /// Returns the sides at which a corner may hold the contacts.
    pub(super) fn corners(&self) -> Ends<bool> {
        let mut corners =
            self.contact.edges.map(|edge| matches!(edge, Edge::Fixed(_) | Edge::FreeUntil(_)));
        if let Some(side) = self.end {
            corners[side] = false;
        }
        corners
    }

    /// Takes the contacts from a coarse active set, with more cells after each failure.
    pub(super) fn take_cells(&mut self) -> Result<(), ContactError<T>> {
        self.show_panels()?;
        // This number of cells has not failed yet.
        let cells = self.cells;
        self.cells = (cells + cells).min(FIRST_CELLS << MAX_DOUBLINGS);
        let coarse = self.coarse(&self.conditions.clone(), cells)?;
        self.runs_out = self.end_reached(&coarse);
        let tilt = self.contact.gap.tilt() + coarse.tilt;
        let newton = &mut self.work.workspace.newton;
        (newton.on, newton.tilt) = (coarse.intervals, tilt);
        Ok(())
    }

    pub(super) fn coarse(
        &mut self,
        conditions: &Conditions<T>,
        cells: usize,
    ) -> Result<Coarse<T>, ContactError<T>> {
        let (gap, ends) = (&self.contact.gap, self.contact.ends());
        let Work { workspace, cost, .. } = &mut *self.work;
        workspace.take(gap, cost)?;
        workspace.look.refine(gap, asked_by(conditions), T::of(MAX_UNCERTAINTY), cost)?;
        let Workspace { look, newton, cell_work, .. } = &mut **workspace;
        let (kappa, load) = (conditions.kappa, conditions.load());
        let turned = look.heights(gap);
        let range = [ends.left, ends.right];
        let (at, known, start) = (conditions.at(), &turned[..], &newton.on[..]);
        let scene = Scene { kappa, load, at, range, cells, known, start };
        let mut height = |x: T| Ok(gap.turned(x, look.height(gap.nearest(x))));
        active_set(&scene, cell_work, &mut height).map_err(|error| match error {
            NotFound::Height(error) => error,
            _ => ContactError::Solve(SolveError::NoEquilibrium {
                half_width: T::of(0.5) * (ends.right - ends.left),
                near: look.lowest(),
            }),
        })
    }

    /// Returns the end of the bodies that contacts reach with no corner to hold them.
    pub(super) fn end_reached(&self, coarse: &Coarse<T>) -> Option<Side> {
        let at_corner = self.corners();
        Side::BOTH.into_iter().find(|&side| coarse.reaches[side] && !at_corner[side])
    }
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
