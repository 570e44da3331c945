//! The loop over sets of contacts, and the table by which one set is made from the last.
//!
//! | result of the search or the check | next set of contacts |
//! |---|---|
//! | tension in spans | the contacts are parted there |
//! | overlap in dips | one more contact in each dip |
//! | a gap closes | the contacts next to it become one |
//! | a contact vanishes | the other contacts |
//! | a limit passes a corner | the limit is put at the corner |
//! | a limit passes an end, where the load for the other end is sought | the limit is put there |
//! | nothing of use, or the set before the last again | the set of the cells |
//!
//! All faults of a kind are mended at once.

use super::super::active_set::{Coarse, NotFound, Scene, active_set};
use super::super::newton::Stop;
use super::super::newton::several::{self, Besides, put};
use super::{Conditions, FIRST_CELLS, Search, Single, Work, Workspace, asked_by};
use crate::solution::{ContactState, Outcome, Start};
use crate::{ContactError, Edge, Ends, Interval, Real, Side, SolveError};
use std::ops::ControlFlow;

/// Largest uncertainty of heights, as a share of F/κ, to show by themselves where the bodies
/// touch: with 400 contacts a twelfth of the load of one.
const MAX_UNCERTAINTY: f64 = 2e-4;

/// Square of the relative change of the load, times the number of contacts, up to which the last
/// contacts are the start: beyond, contacts that are born and vanish take more attempts than it
/// saves (measured with 2 to 300 contacts).
const MAX_CHANGE: f64 = 0.5;

/// Sets of contacts tried before the search is given up.
const MAX_TRIALS: usize = 12;

/// Doublings of the cells: 2 112 of them separate contacts a thousandth of the bodies apart.
const MAX_DOUBLINGS: usize = 6;

/// Share of a contact's half-width by which a limit leaves a corner that does not hold it. Its
/// square is the first half-width of a contact put at an overlap, as a share of the bodies.
const CORNER_STEP: f64 = 0.01;

/// Outcome of an attempt, with the contacts found or the next start.
type Trial<T> = (Outcome, ControlFlow<ContactState<T>, Start>);

impl<T: Real> Search<'_, '_, '_, T> {
    /// Seeks any number of contacts; `fault` is the error of a search for one.
    pub(super) fn several(
        &mut self,
        mut fault: Option<ContactError<T>>,
    ) -> Result<ContactState<T>, ContactError<T>> {
        if !self.may_be_several() {
            return Err(fault.unwrap_or(self.no_balance()));
        }
        let first = fault.clone().filter(|fault| Outcome::of(fault) == Outcome::NotFound);
        // A corner is known to press from the contacts found without it.
        let edges = self.contact.edges.map(Edge::let_go);
        let conditions = Conditions { edges, ..self.conditions };
        let Workspace { last, newton, .. } = &mut *self.work.workspace;
        let change = conditions.load() / conditions.kappa / newton.load - T::one();
        if self.end.is_none() && T::count(last.len()) * change * change > T::of(MAX_CHANGE) {
            last.clear();
        }
        let is_near = last.len() > 1 || self.end.is_some() && !last.is_empty();
        let mut start = if is_near { Start::Last } else { Start::ActiveSet };
        let mut earlier = Vec::new();
        newton.on.clone_from(last);
        for _ in 0..MAX_TRIALS {
            if start == Start::ActiveSet && self.runs_out.is_some() {
                // More cells find no contact under more load than the bodies bear.
                if std::mem::replace(&mut self.has_run_out, true) {
                    break;
                }
                if let Some(found) = self.borne(&conditions)? {
                    return Ok(found);
                }
            }
            let trial = self.trial(start, &conditions, &mut fault);
            let next = match self.work.workspace.report.end(start, trial)? {
                ControlFlow::Break(found) => return Ok(found),
                ControlFlow::Continue(next) => next,
            };
            let Workspace { newton, before, .. } = &*self.work.workspace;
            // This revision undoes the one before. Unlike the cells, tension is exact.
            let is_undone = is_alike(&newton.on, &earlier);
            earlier.clear();
            if start != Start::ActiveSet {
                earlier.clone_from(before);
            }
            start = if is_undone { Start::ActiveSet } else { next };
        }
        Err(self.not_found(first, fault))
    }

    pub(super) fn no_balance(&self) -> ContactError<T> {
        let [near, to] = self.contact.gap.range();
        SolveError::NoEquilibrium { half_width: T::of(0.5) * (to - near), near }.into()
    }

    /// Returns the error of a search whose trials have all failed; `first` is the error of the
    /// search for one contact.
    fn not_found(
        &self,
        first: Option<ContactError<T>>,
        fault: Option<ContactError<T>>,
    ) -> ContactError<T> {
        // The error of one contact alone says more, unless it is the load that one contact would
        // bear.
        let says = |fault: &ContactError<T>| match fault {
            ContactError::Solve(SolveError::NoEquilibrium { .. }) => false,
            ContactError::Solve(SolveError::DomainTooShort { .. }) => self.runs_out.is_none(),
            _ => true,
        };
        let fault = first.filter(says).or(fault.filter(says));
        fault.unwrap_or(self.no_balance())
    }

    /// Tries the contacts at hand, or those of the cells, and revises them if they fail.
    fn trial(
        &mut self,
        start: Start,
        conditions: &Conditions<T>,
        fault: &mut Option<ContactError<T>>,
    ) -> Result<Trial<T>, ContactError<T>> {
        let [left, right] = self.contact.gap.range();
        self.contact.gap.check_watch(*self.work.cost, Interval { left, right })?;
        if start == Start::ActiveSet {
            self.take_cells(conditions)?;
        }
        let found = match self.converge(conditions) {
            Ok(Ok(found)) => found,
            Ok(Err(stop)) => return Ok(self.revise(stop, start)),
            Err(error) if error.may_be_several() => {
                *fault = Some(error);
                return Ok((Outcome::NotFound, ControlFlow::Continue(Start::ActiveSet)));
            }
            Err(error) => return Err(error),
        };
        match self.checked(&found)? {
            None => Ok((Outcome::Passed, ControlFlow::Break(found))),
            Some(error @ ContactError::Solve(SolveError::LiftsOff { .. })) => Err(error),
            Some(error) => {
                Ok((Outcome::of(fault.insert(error)), ControlFlow::Continue(self.mend())))
            }
        }
    }

    /// Revises the contacts according to the end of the search for their limits.
    fn revise(&mut self, stop: Stop<T>, start: Start) -> Trial<T> {
        let (ends, at_corner) = (self.contact.ends(), self.corners());
        let Workspace { newton, before, .. } = &mut *self.work.workspace;
        let (mut vanished, mut closed) = (Vec::new(), Vec::new());
        if stop == Stop::Gone {
            let contacts = 0..newton.on.len();
            vanished.extend(contacts.clone().map(|i| newton.is_gone(i, false)));
            closed.extend(contacts.clone().map(|i| newton.is_gone(i, true)));
            let of_rounding = contacts.filter(|&i| closed[i] && newton.is_nothing(i));
            self.closed.extend(of_rounding.map(|i| newton.closed_gap(i)));
        }
        // The limits at which the search has stopped say little.
        newton.on.clone_from(before);
        let on = &mut newton.on;
        let outcome = match stop {
            Stop::Gone if on.len() > 1 => {
                let mut outcome = Outcome::Lost;
                for i in (0..on.len()).rev() {
                    if closed[i] {
                        on[i].right = on.remove(i + 1).right;
                        outcome = Outcome::Merged;
                    } else if vanished[i] && on.len() > 1 && !(i > 0 && closed[i - 1]) {
                        on.remove(i);
                    }
                }
                outcome
            }
            Stop::Beyond { side, .. } if at_corner[side] => {
                put(on, side, ends[side]);
                Outcome::ReachedCorner
            }
            // This end is reached under a smaller load.
            Stop::Beyond { side, .. } if self.end.is_some() => {
                self.end = Some(side);
                Outcome::ReachedCorner
            }
            _ => {
                if let Stop::Beyond { side, .. } = stop {
                    self.runs_out = Some(side);
                }
                // After a revision, the cells start from the last contacts; otherwise those say
                // nothing.
                if start != Start::Attempt {
                    on.clear();
                }
                return (Outcome::NotFound, ControlFlow::Continue(Start::ActiveSet));
            }
        };
        (outcome, ControlFlow::Continue(Start::Attempt))
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

    /// Moves the contacts at hand until they bear the load, with some limits held.
    pub(super) fn converge_once(
        &mut self,
        conditions: &Conditions<T>,
    ) -> Result<Result<ContactState<T>, Stop<T>>, ContactError<T>> {
        self.mark_held();
        if let (&[on], None) = (&self.work.workspace.newton.on[..], self.end) {
            return self.one_of_set(conditions, on, self.work.workspace.newton.held[0]);
        }
        let (contact, ends) = (self.contact, self.contact.ends());
        let Work { integrator, workspace, .. } = &mut *self.work;
        let newton = &mut workspace.newton;
        if let Some(side) = self.end {
            put(&mut newton.on, side, ends[side]);
        }
        let Some(panels) = integrator.panels_mut() else { return Ok(Err(Stop::Failed)) };
        let several = panels.several_mut();
        let besides = conditions.at().map(Besides::Tilt).or(self.end.map(Besides::Load));
        let load = conditions.load() / conditions.kappa;
        let sought = several::Conditions { gap: &contact.gap, load, ends, besides };
        if let Err(stop) = newton.converge(several, &sought)? {
            return Ok(Err(stop));
        }
        let load = match self.end {
            Some(_) => newton.load * conditions.kappa,
            None => conditions.load(),
        };
        Ok(Ok(newton.found(several, conditions.kappa, load, &sought)))
    }

    /// Moves the only contact of a set until it bears the load.
    fn one_of_set(
        &mut self,
        conditions: &Conditions<T>,
        on: Interval<T>,
        held: Ends<bool>,
    ) -> Result<Result<ContactState<T>, Stop<T>>, ContactError<T>> {
        let (contact, mut conditions, start) = (self.contact, *conditions, Some(on));
        for side in Side::BOTH.into_iter().filter(|&side| held[side]) {
            conditions.edges[side] = Edge::Fixed(on[side]);
        }
        let Work { integrator, workspace, cost } = &mut *self.work;
        let (look, bears) = (None, Some(None));
        let mut single = Single { contact, conditions, start, look, integrator, cost, bears };
        let found = single.find(start)?;
        (workspace.newton.on[0], workspace.newton.tilt) = (found.interval, found.tilt);
        Ok(Ok(found))
    }

    /// Takes the contacts from a coarse active set, with more cells after each failure.
    fn take_cells(&mut self, conditions: &Conditions<T>) -> Result<(), ContactError<T>> {
        self.show_panels()?;
        // This number of cells has not failed yet.
        let cells = self.cells;
        self.cells = (cells + cells).min(FIRST_CELLS << MAX_DOUBLINGS);
        let coarse = self.coarse(conditions, cells)?;
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
