//! Intervals in which the bodies touch: start, converge, check, revise.
//!
//! A contact is first sought as one interval, around the last one or at the lowest gap; if the gap
//! has several valleys, several contacts are sought at once. A solution is [checked](check):
//! corners press, no tension inside, no overlap outside. A failed search or check [revises](revise)
//! the set of contacts, from which [all limits](super::newton::several) are sought anew; if it says
//! too little, a coarse [active set](super::active_set) locates the contacts roughly. A search that
//! leads to an end of the bodies computes the load that they [bear](bears). Without adhesion a
//! contact problem has one solution: a set that passes the checks is this solution, however it was
//! found.

mod bears;
mod check;
mod corners;
mod revise;
mod workspace;

use super::active_set::FIRST_CELLS;
use super::edges::{Conditions, Given};
use super::signorini_check::step_of_heights;
use super::single_contact::Single;
use super::{Contact, Work};
use crate::gap::{Asked, Survey};
use crate::solution::{ContactState, Outcome, Start};
use crate::{ContactError, Interval, Real, Side, SolveError};
pub(super) use bears::{Borne, bears, up_to_corner};
pub(crate) use workspace::Workspace;

/// Finds the contacts of two bodies.
pub(super) fn find<T: Real>(
    contact: &Contact<'_, T>,
    conditions: Conditions<T>,
    work: &mut Work<'_, T>,
) -> Result<ContactState<T>, ContactError<T>> {
    contact.checked_edges()?;
    work.workspace.look_for_features(&contact.gap);
    let found = Search::new(contact, conditions, work).find();
    found.map_err(|error| match error {
        // A step of the heights that no slope shows is not a crest that could be pressed flat.
        ContactError::Solve(SolveError::Overlap { x, interval, .. }) => {
            step_of_heights(&contact.gap, interval, x).unwrap_or(error)
        }
        _ => error,
    })
}

/// Contact found, or the reason why not.
type Found<T> = Result<ContactState<T>, ContactError<T>>;

/// Search for the contacts.
struct Search<'s, 'w, 'b, T: Real> {
    contact: &'s Contact<'b, T>,
    conditions: Conditions<T>,
    work: &'s mut Work<'w, T>,
    /// Number of samples of the gap before the search.
    samples: usize,
    /// Number of cells of the next active set.
    cells: usize,
    /// Corners that hold limits, each with the side of its contact.
    held: Vec<(T, Side)>,
    /// Places where gaps have closed.
    closed: Vec<Interval<T>>,
    /// Single contacts in which a feature was lost to the panels.
    lost: Vec<Interval<T>>,
    /// End of the bodies that contacts reach with no corner to hold them.
    runs_out: Option<Side>,
    /// True if the load that the bodies bear has been sought.
    has_run_out: bool,
    /// End of the bodies that the contacts are to reach, if the load for it is sought.
    end: Option<Side>,
}

impl<'s, 'w, 'b, T: Real> Search<'s, 'w, 'b, T> {
    fn new(
        contact: &'s Contact<'b, T>,
        conditions: Conditions<T>,
        work: &'s mut Work<'w, T>,
    ) -> Self {
        let (cells, has_run_out, [closed, lost]) = (FIRST_CELLS, false, [Vec::new(), Vec::new()]);
        let held = Vec::new();
        let (runs_out, end, samples) = (None, None, work.integrator.cost().samples);
        Self {
            contact,
            conditions,
            work,
            samples,
            cells,
            held,
            closed,
            lost,
            runs_out,
            has_run_out,
            end,
        }
    }

    fn find(&mut self) -> Result<ContactState<T>, ContactError<T>> {
        if self.contact.single_interval {
            let start = self.start_of_one(false);
            let found = self.one(start, false);
            let attempt = found.map(|found| (Outcome::Unchecked, found));
            return self.work.workspace.report.end(start, attempt);
        }
        if self.work.workspace.last.len() > 1 {
            return self.several(None);
        }
        // If the gap has several valleys, heights show at less cost why a search for one contact
        // fails.
        let (start, has_valleys) = (self.start_of_one(true), self.has_valleys());
        // The survey is the beginning of an attempt.
        if has_valleys.or_else(|error| self.work.workspace.report.end(start, Err(error)))? {
            match self.several(None) {
                Err(error)
                    if !matches!(error, ContactError::Solve(SolveError::DomainTooShort { .. })) => {
                }
                found => return found,
            }
        }
        match self.one_checked()? {
            Ok(found) => Ok(found),
            Err(fault) => self.several(Some(fault)),
        }
    }

    /// Seeks one contact and checks it. The inner error is one that several contacts may avoid.
    fn one_checked(&mut self) -> Result<Found<T>, ContactError<T>> {
        let (turns, is_said) = (self.turns(), self.contact.gap.is_convex());
        let looks = !is_said && !turns && self.contact.edges.are_sought();
        let mut found = self.attempt_one(looks)?;
        // The first search had no survey of the bodies.
        if is_said
            && !turns
            && matches!(found, Err(ContactError::Solve(SolveError::NoEquilibrium { .. })))
        {
            found = self.attempt_one(true)?;
        }
        match found {
            Err(error) if self.is_of_any_number(&error)? => Err(error),
            found => Ok(found),
        }
    }

    /// Makes an attempt with one contact; the inner error is that of the search, or a fault of the
    /// contact found.
    fn attempt_one(&mut self, looks: bool) -> Result<Found<T>, ContactError<T>> {
        let start = self.start_of_one(looks);
        let attempt = match self.one(start, looks) {
            Ok(found) => self.checked(&found).map(|fault| fault.map_or(Ok(found), Err)),
            Err(error) => Ok(Err(error)),
        };
        let outcome =
            |found: &Found<T>| found.as_ref().map_or_else(Outcome::of, |_| Outcome::Passed);
        let attempt = attempt.map(|found| (outcome(&found), found));
        self.work.workspace.report.end(start, attempt)
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

    /// Returns the start of a search for one contact: the last contact, the user's start, or the
    /// lowest gap; without a survey, the line of the load or the middle of the bodies.
    fn start_of_one(&self, looks: bool) -> Start {
        match (self.work.workspace.last.first(), self.contact.start) {
            (Some(_), _) => Start::Last,
            (_, Some(_)) => Start::Given,
            _ if looks => Start::LowestGap,
            _ if self.turns() => Start::LineOfLoad,
            _ => Start::Middle,
        }
    }

    /// Seeks one contact, and repeats as long as its panels miss narrow features.
    fn one(&mut self, start: Start, looks: bool) -> Result<ContactState<T>, ContactError<T>> {
        if start == Start::LowestGap {
            self.look()?;
        }
        let mut found = self.one_from(self.work.workspace.last.first().copied(), looks)?;
        while self.misses(&found)? {
            found = self.one_from(Some(found.interval), looks)?;
        }
        Ok(found)
    }

    /// Seeks one contact around the last one, if any; without it, from the survey if `looks` is
    /// set.
    fn one_from(&mut self, last: Option<Interval<T>>, looks: bool) -> Found<T> {
        let (contact, Work { integrator, workspace, cost }) = (self.contact, &mut *self.work);
        let look = workspace.survey_of(&contact.gap).filter(|_| looks);
        let (conditions, start, bears) = (self.conditions, contact.start, None);
        Single { contact, conditions, start, look, integrator, cost, bears }.find(last)
    }

    /// Tells whether the gap has several valleys, and no other start is known.
    fn has_valleys(&mut self) -> Result<bool, ContactError<T>> {
        let given = self.contact.start.is_some() || !self.contact.edges.are_sought();
        let told = given || !self.work.workspace.last.is_empty();
        if self.is_convex() || told || !self.may_be_several() {
            return Ok(false);
        }
        Ok(!self.look()?.is_one_valley() && self.end_touched_first().is_none())
    }

    /// Tells whether the gap is known to be convex, declared or proved.
    fn is_convex(&self) -> bool {
        let gap = &self.contact.gap;
        gap.is_convex() || self.work.workspace.survey_of(gap).is_some_and(Survey::is_convex)
    }

    /// Surveys the bodies as closely as the load requires.
    fn look(&mut self) -> Result<&Survey<T>, ContactError<T>> {
        let asked = asked_by(&self.conditions);
        self.work.workspace.look(&self.contact.gap, asked, self.work.cost)
    }

    /// Tells whether the bodies turn until the load acts at a given place.
    fn turns(&self) -> bool {
        self.conditions.at().is_some()
    }

    /// Tells whether several contacts can be sought.
    fn may_be_several(&self) -> bool {
        let by_load = !matches!(self.conditions.given, Given::HalfWidth(_));
        by_load && self.work.may_find_several(self.contact)
    }
}

/// Returns the request to the survey for these conditions.
fn asked_by<T: Real>(conditions: &Conditions<T>) -> Asked<T> {
    match conditions.given {
        Given::HalfWidth(half_width) => Asked::HalfWidth(half_width),
        Given::Load(load) => Asked::Load(load / conditions.kappa),
        Given::Centre { load, .. } => Asked::Turning(load / conditions.kappa),
    }
}
