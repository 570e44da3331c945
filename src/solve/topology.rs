//! Intervals in which the bodies touch: the set of contacts at hand, and how its limits are found.
//!
//! The loop over sets of contacts is [`settle`](super::settle). It begins with one contact, around
//! the last one or at the lowest gap, or with several if the gap has several valleys. A set is
//! moved until it is in equilibrium ([one contact](super::single_contact), [all
//! limits](super::newton::several) at once), with limits [held at corners](corners); it is
//! [checked](check); and its fault says which set is [next](revise). If a search leads to an end of
//! the bodies, the load that they [bear](bears) is sought. Without adhesion a contact problem has
//! one solution: a set that passes the checks is this solution, however it was found.

mod bears;
mod check;
mod corners;
mod revise;
mod workspace;

use super::active_set::FIRST_CELLS;
use super::edges::{Conditions, Given};
use super::fault::Fault;
use super::newton::several::{self, Besides, NewtonSeveral, put};
use super::single_contact::Single;
use super::{Contact, Work, settle};
use crate::gap::{Asked, Sampler, Survey};
use crate::solution::{ContactState, Start};
use crate::{ContactError, Edge, Ends, Fallible, Interval, Real, Side, SolveError};
pub(super) use bears::up_to_corner;
pub(crate) use workspace::Workspace;

/// Largest number of times that the limits of a set are sought, held or let go.
const MAX_HELD_ROUNDS: usize = 200;

/// Square of the relative change of the load, times the number of contacts, up to which the last
/// contacts are the start: beyond, contacts that are born and vanish take more attempts than it
/// saves (measured with 2 to 300 contacts).
const MAX_CHANGE: f64 = 0.5;

/// Finds the contacts of two bodies, or the load that they bear.
pub(super) fn find<T: Real>(
    contact: &Contact<'_, T>,
    conditions: Conditions<T>,
    work: &mut Work<'_, T>,
) -> Fallible<T, ContactState<T>> {
    contact.checked_edges()?;
    work.workspace.look_for_features(&contact.gap);
    let mut search = Search::new(contact, conditions, work);
    let found = settle(&mut search).or_else(|error| search.explain(error))?;
    let holds = |side: Side| !found.free[side] && contact.edges[side] == Edge::Free;
    work.workspace.is_held = Side::BOTH.into_iter().any(holds);
    Ok(found)
}

/// Search for the contacts.
pub(super) struct Search<'s, 'w, 'b, T: Real> {
    contact: &'s Contact<'b, T>,
    conditions: Conditions<T>,
    work: &'s mut Work<'w, T>,
    /// Start of this attempt.
    start: Start,
    /// Flag: several contacts are sought first, as the gap has several valleys; one may be left.
    has_valleys: bool,
    /// Number of samples of the gap before the search.
    samples: usize,
    /// Number of cells of the next active set.
    cells: usize,
    /// Set before the last revision of one.
    earlier: Vec<Interval<T>>,
    /// Limits found free in the last set, if it is revised where it has a fault, and the ends of
    /// the spans of tension at which it is parted.
    free: Vec<T>,
    /// Single contacts in which a feature was lost to the panels.
    lost: Vec<Interval<T>>,
    /// Errors of the search for one contact, and of the last set.
    of_one: Option<ContactError<T>>,
    error: Option<ContactError<T>>,
    /// End of the bodies that contacts reach with no corner to hold them.
    runs_out: Option<Side>,
    /// End of the bodies that the contacts are to reach, if the load for it is sought.
    end: Option<Side>,
}

impl<'s, 'w, 'b, T: Real> Search<'s, 'w, 'b, T> {
    fn new(
        contact: &'s Contact<'b, T>,
        conditions: Conditions<T>,
        work: &'s mut Work<'w, T>,
    ) -> Self {
        let samples = work.integrator.cost().samples;
        Self {
            contact,
            conditions,
            work,
            start: Start::Middle,
            has_valleys: false,
            samples,
            cells: FIRST_CELLS,
            earlier: Vec::new(),
            free: Vec::new(),
            lost: Vec::new(),
            of_one: None,
            error: None,
            runs_out: None,
            end: None,
        }
    }

    /// Returns the first start.
    pub(super) fn first(&mut self) -> Fallible<T, Start> {
        if self.contact.single_interval {
            return Ok(self.start_of_one());
        }
        if self.last_is_set() {
            return self.start_of_several();
        }
        let start = self.start_of_one();
        // If the gap has several valleys, heights show at less cost why a search for one contact
        // fails.
        let has_valleys = self.has_valleys();
        // The survey is the beginning of an attempt.
        self.has_valleys =
            has_valleys.or_else(|error| self.work.workspace.report.end(start, Err(error)))?;
        if self.has_valleys { self.start_of_several() } else { Ok(start) }
    }

    /// Returns the start of a search for one contact after one for several that has failed without
    /// it, or the error.
    fn start_anew(&mut self, error: ContactError<T>) -> Fallible<T, Start> {
        let is_known = matches!(error, ContactError::Solve(SolveError::DomainTooShort { .. }));
        if !std::mem::take(&mut self.has_valleys) || is_known {
            return Err(error);
        }
        Ok(self.start_of_one())
    }

    /// Returns the start of a search for one contact: the last contact, the user's start, or the
    /// lowest gap; without a survey, the line of the load or the middle of the bodies.
    fn start_of_one(&self) -> Start {
        let Contact { gap, start, edges, single_interval, .. } = self.contact;
        match (self.work.workspace.last.first(), start) {
            (Some(_), _) => Start::Last,
            (_, Some(_)) => Start::Given,
            _ if self.turns() => Start::LineOfLoad,
            _ if *single_interval || gap.is_convex() || !edges.are_sought() => Start::Middle,
            _ => Start::LowestGap,
        }
    }

    /// Returns the start of a search for any number of contacts.
    fn start_of_several(&mut self) -> Fallible<T, Start> {
        if !self.may_be_several() {
            return Err(self.error.take().or(self.of_one.take()).unwrap_or(self.no_balance()));
        }
        let Workspace { last, newton, .. } = &mut *self.work.workspace;
        let change = self.conditions.load() / self.conditions.kappa / newton.load - T::one();
        if last.len() > 1 && T::count(last.len()) * change * change > T::of(MAX_CHANGE) {
            last.clear();
        }
        newton.on.clone_from(last);
        Ok(if self.last_is_set() { Start::Last } else { Start::ActiveSet })
    }

    /// Tells whether the contacts last found are sought as a set: several, or one that a corner
    /// inside the bodies holds.
    fn last_is_set(&self) -> bool {
        let Workspace { last, is_held, .. } = &*self.work.workspace;
        last.len() > 1 || *is_held && !last.is_empty() && self.may_be_several()
    }

    /// Moves the contacts from a start until they are in equilibrium.
    pub(super) fn equilibrium(&mut self, start: Start) -> Result<ContactState<T>, Fault<T>> {
        self.start = start;
        if self.is_of_one() {
            let Workspace { last, newton, .. } = &mut *self.work.workspace;
            newton.on.clear();
            newton.on.extend(last.first().filter(|_| start == Start::Last));
        } else {
            let [left, right] = self.contact.gap.range();
            self.contact.gap.check_watch(*self.work.cost, Interval { left, right })?;
        }
        match start {
            Start::LowestGap => _ = self.look()?,
            Start::ActiveSet => self.take_cells().map_err(Fault::Final)?,
            _ => {}
        }
        self.converge()
    }

    /// Tells whether one contact is sought, from a start, instead of the set at hand.
    fn is_of_one(&self) -> bool {
        match self.start {
            Start::Attempt | Start::ActiveSet => false,
            Start::Last => {
                self.contact.single_interval || !self.last_is_set() && self.end.is_none()
            }
            _ => true,
        }
    }

    /// Moves the contacts at hand until they bear the load, held at corners or let go; repeats as
    /// long as their panels miss narrow features.
    fn converge(&mut self) -> Result<ContactState<T>, Fault<T>> {
        let may_be_held = self.hold()?;
        let (mut fault, mut passed) = (None, Vec::new());
        for _ in 0..MAX_HELD_ROUNDS {
            let mut found = match self.converge_once() {
                Ok(found) => found,
                // With limits held the contact is wider, and may need more than the bodies have, or
                // may not reach so far; and limits that face each other may be held at one corner,
                // between them, that holds neither.
                Err(other) if may_be_held && fault.is_none() && self.lets_all_go() => {
                    fault = Some(other);
                    continue;
                }
                Err(other) => return Err(fault.unwrap_or(other)),
            };
            if self.misses(&found)? {
                continue;
            }
            if !may_be_held || !self.passes(&found, &mut passed)? && !self.lets_go(&mut found)? {
                return Ok(found);
            }
        }
        Err(fault.unwrap_or(Fault::Failed))
    }

    /// Moves the contacts at hand once, with some limits held.
    fn converge_once(&mut self) -> Result<ContactState<T>, Fault<T>> {
        if self.work.workspace.newton.on.len() <= 1 && self.end.is_none() {
            return self.one();
        }
        let (contact, conditions, ends) = (self.contact, self.conditions, self.contact.ends());
        let Work { integrator, workspace, .. } = &mut *self.work;
        let newton = &mut workspace.newton;
        if let Some(side) = self.end {
            put(&mut newton.on, side, ends[side]);
        }
        let Some(panels) = integrator.panels_mut() else { return Err(Fault::Failed) };
        let several = panels.several_mut();
        let besides = conditions.at().map(Besides::Tilt).or(self.end.map(Besides::Load));
        let load = conditions.load() / conditions.kappa;
        let sought = several::Conditions { gap: &contact.gap, load, ends, besides };
        newton.converge(several, &sought)?;
        let load = match self.end {
            Some(_) => newton.load * conditions.kappa,
            None => conditions.load(),
        };
        Ok(newton.found(several, conditions.kappa, load, &sought))
    }

    /// Moves the only contact of a set, or one whose place is not yet known.
    fn one(&mut self) -> Result<ContactState<T>, Fault<T>> {
        let (contact, mut conditions) = (self.contact, self.conditions);
        let is_alone = self.is_of_one();
        let looks = is_alone && self.start != Start::Middle && !self.turns();
        if !self.work.workspace.newton.held.is_empty() {
            conditions.edges = self.edges_of_one();
        }
        let Work { integrator, workspace, cost } = &mut *self.work;
        let last = workspace.newton.on.first().copied();
        let start = if is_alone { contact.start } else { last };
        let look = workspace.survey_of(&contact.gap).filter(|_| looks);
        let found =
            Single { contact, conditions, start, look, integrator, cost, is_alone }.find(last)?;
        let NewtonSeveral { on, tilt, .. } = &mut workspace.newton;
        match on.first_mut() {
            Some(on) => *on = found.interval,
            None => on.push(found.interval),
        }
        *tilt = found.tilt;
        Ok(found)
    }

    /// Tells whether the gap has several valleys, and no other start is known.
    fn has_valleys(&mut self) -> Fallible<T, bool> {
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
    fn look(&mut self) -> Fallible<T, &Survey<T>> {
        let asked = asked_by(&self.conditions);
        self.work.workspace.look(&self.contact.gap, asked, self.work.cost)
    }

    /// Refuses bodies that are parallel all along, to rounding: no free contact ends there.
    pub(super) fn check_parallel(&mut self) -> Fallible<T, ()> {
        let Contact { gap, edges, .. } = self.contact;
        let (mut sampler, x) = (Sampler::default(), gap.range());
        let may_be = *edges == Ends::both(Edge::Free) && !gap.is_repeated();
        let height = |x| sampler.height(gap, x).unwrap_or(T::of(f64::NAN));
        let slopes = if may_be { self.look()?.level_slopes(gap, height) } else { None };
        self.work.cost.heights += sampler.cost.evaluations;
        slopes.map_or(Ok(()), |slope| Err(SolveError::NoFirstContact { x, slope }.into()))
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
