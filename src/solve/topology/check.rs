//! Check of a solution: narrow features, corners, tension inside and overlap outside.

use super::super::signorini_check::{SignoriniCheck, Under};
use super::{Fault, Search, Work, Workspace, asked_by};
use crate::gap::Gap;
use crate::quadrature::Integrator;
use crate::solution::{ContactState, Outcome};
use crate::{ContactError, Ends, Fallible, Real, SolveError};
use std::borrow::Cow;

impl<T: Real> Search<'_, '_, '_, T> {
    /// Looks for narrow features in the contacts found; tells whether the panels missed one. Fails
    /// if a search for one contact leads back to where they did.
    pub(super) fn misses(&mut self, found: &ContactState<T>) -> Fallible<T, bool> {
        let (contact, on) = (self.contact, found.interval);
        if contact.single_interval || contact.gap.is_convex() {
            return Ok(false);
        }
        contact.gap.check_resolution(on.left.abs().max(on.right.abs()))?;
        let (gap, load) = (&contact.gap.tilted(found.tilt), found.load.abs() / contact.kappa);
        // Under a lighter load the samples at hand need no more probes.
        let is_known = self.samples == self.work.integrator.cost().samples
            && self.work.workspace.survey_of(gap).is_some_and(|look| look.is_resolved(gap, load));
        let Some(panels) = self.work.integrator.panels_mut() else { return Ok(false) };
        if is_known || !panels.probe(gap, on)? {
            return Ok(false);
        }
        let is_one = panels.several().is_none();
        // No single contact balances with the feature, and the search has begun anew without it.
        if is_one && self.lost.iter().any(|last| last.is_same(&on)) {
            let (half_width, near) = (on.half_width(), on.centre());
            return Err(SolveError::NoEquilibrium { half_width, near }.into());
        }
        self.lost.push(on);
        Ok(true)
    }

    /// Checks a solution, unless that is not asked for, and reports it if it has no fault.
    pub(in super::super) fn check(&mut self, found: &ContactState<T>) -> Result<(), Fault<T>> {
        let single = self.contact.single_interval;
        self.work.workspace.overlaps.clear();
        match if single { None } else { self.checked(found)? } {
            None => {
                let outcome = match self.work.workspace.overlaps.is_untold {
                    _ if single => Outcome::Unchecked,
                    false => Outcome::Passed,
                    true => Outcome::Doubtful,
                };
                self.work.workspace.report.add(self.start, outcome);
                Ok(())
            }
            Some(error) => Err(match Outcome::of(&error) {
                Outcome::Tension => Fault::Tension(error),
                Outcome::Overlap => Fault::Overlap(error),
                _ if self.is_of_one() => Fault::Error(error),
                _ => Fault::Final(error),
            }),
        }
    }

    /// Returns the fault of a solution, if it has any.
    fn checked(&mut self, found: &ContactState<T>) -> Fallible<T, Option<ContactError<T>>> {
        // More contacts may press at a corner not reached yet.
        let (edges, lifts_off) = (self.contact.edges, found.lifts_off(self.contact.edges));
        let is_said = self.contact.gap.is_convex();
        if is_said || lifts_off.is_some() && found.reaches(edges) == Ends::both(true) {
            return Ok(lifts_off);
        }
        self.resolve(found)?;
        let gap = &self.contact.gap.tilted(found.tilt);
        // A search for one contact finds that of a convex gap: after a revised set the gap is not
        // known to be convex, whatever the survey has seen.
        let is_proved = self.is_of_one() && (self.is_convex() || self.touches_once(gap, found)?);
        if is_proved && !self.corrects_survey()? {
            return Ok(lifts_off);
        }
        Ok(self.fault(gap, found)?.or(lifts_off))
    }

    /// Returns the tension inside the contacts, or the overlap outside, by which a solution fails.
    fn fault(
        &mut self,
        gap: &Gap<'_, T>,
        found: &ContactState<T>,
    ) -> Fallible<T, Option<ContactError<T>>> {
        let (kappa, covers) = (self.contact.kappa, self.covers(found));
        let (interval, load) = (found.interval, found.load);
        // If the integrator has no panels, some are made for the check of the contact.
        if self.work.integrator.panels().is_some() {
            self.work.integrator.ready(gap, interval)?;
        }
        let panels = &self.work.integrator.panels_over(gap, interval)?;
        let Workspace { look, fields, tension_spans, passed, overlaps, .. } =
            &mut *self.work.workspace;
        let under = [load / kappa, found.tilt];
        let on = Under { under, samples: panels.cost().samples };
        let contacts = self.work.integrator.contacts(&interval);
        // A gap open under a heavier load is open under a lighter one; a place pressed under a
        // lighter load is pressed under a heavier one.
        let (widest, pressed) = (passed.under_more(under), passed.under_less(on, contacts));
        let engine = &self.work.integrator;
        let check = SignoriniCheck { gap, panels, engine, contacts, kappa, found, widest, pressed };
        fields.each.clear();
        if let Some([x, pressure]) = check.tension(fields, tension_spans)? {
            if pressure.partial_cmp(&pressure).is_none() {
                return Err(SolveError::Overflow { interval }.into());
            }
            return Ok(Some(found.tension(x, pressure).into()));
        }
        // A contact from end to end leaves nothing outside.
        if !covers {
            check.overlap(fields, overlaps, look, self.contact.ends(), self.work.cost)?;
        }
        let overlap = overlaps.worst();
        // A rough solution may overlap a little: other loads take nothing from it.
        let is_exact = found.zero_tolerance() <= T::epsilon().sqrt();
        if overlap.is_none() && is_exact && found.adhesive == Ends::both(false) {
            passed.keep(on, contacts);
            overlaps.closed_before.reserve(1 + 2 * contacts.len());
        }
        if let Cow::Owned(own) = panels {
            self.work.cost.heights += own.cost().evaluations;
        }
        Ok(overlap.map(|dip| found.overlap(dip.x, dip.gap).into()))
    }

    /// Looks for narrow features next to the contacts found.
    fn resolve(&mut self, found: &ContactState<T>) -> Fallible<T, ()> {
        let gap = &self.contact.gap.tilted(found.tilt);
        self.work.workspace.take(gap, self.work.cost)?;
        if self.contact.is_trial {
            return Ok(());
        }
        let contacts = self.work.integrator.contacts(&found.interval);
        let load = found.load.abs() / self.contact.kappa;
        self.work.workspace.look.resolve(gap, load, contacts, self.work.cost)
    }

    /// Tells whether the panels have found a feature that a convex survey has missed, and shows it
    /// to the survey.
    pub(super) fn corrects_survey(&mut self) -> Fallible<T, bool> {
        let falls = self.work.integrator.panels().is_some_and(|panels| panels.falls());
        if falls {
            self.show_panels()?;
        }
        Ok(falls)
    }

    /// Shows the survey what the panels of the contacts see, over their whole span.
    pub(super) fn show_panels(&mut self) -> Fallible<T, ()> {
        let gap = &self.contact.gap;
        let Work { integrator, workspace, cost } = &mut *self.work;
        let load = workspace.about(gap, asked_by(&self.conditions), cost)?;
        let rises = integrator.panels().map(|panels| panels.rises_between()).unwrap_or_default();
        workspace.look.learn(gap, &rises, load, cost)
    }

    /// Tells whether one contact covers the bodies from end to end.
    fn covers(&self, found: &ContactState<T>) -> bool {
        let (on, ends) = (found.interval, self.contact.ends());
        let is_one = self.work.integrator.several().is_none();
        is_one && on.left <= ends.left && on.right >= ends.right
    }

    /// Tells whether the gap is convex around one contact as far as its load reaches.
    fn touches_once(&mut self, gap: &Gap<'_, T>, found: &ContactState<T>) -> Fallible<T, bool> {
        if found.adhesive != Ends::both(false) || self.covers(found) {
            return Ok(false);
        }
        let load = found.load / self.contact.kappa;
        self.work.workspace.look.prove(gap, found.interval, load, self.work.cost)
    }
}
