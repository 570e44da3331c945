//! One contact, from a start to the limits with as few samples as possible.
//!
//! First, a span in which the contact is expected is sampled with four nodes a panel, and Newton's
//! method finds the contact of this guess. If it is much narrower than the span, or outside it, a
//! span around it is sampled anew for the next guess. Then a span a little wider than the contact
//! is sampled in full, and Newton's method finds the limits on it. If it goes astray, it starts
//! again at the [first contact](super::first_contact) of the bodies, with a width that may bear the
//! load. If it finds no contact from there either, or leads to an end of the bodies time and again,
//! their [capacity](super::capacity) is computed. The [nested search](super::one_by_one) serves the
//! user's own strategies, and quadratures that know no derivatives.

mod guess;
mod pull;
mod start;

use super::Contact;
use super::capacity::capacity;
use super::edges::{Conditions, Given};
use super::equations::{Equations, relative_error};
use super::newton::linearised::load_of;
use super::newton::single::{Converged, Effort, NewtonSingle, Verdict};
use super::one_by_one;
use crate::gap::{Cost, Survey};
use crate::quadrature::{Engine, Moments};
use crate::solution::ContactState;
use crate::{ContactError, Fallible, InputError, Interval, ProfileError, Real, SolveError};

/// Largest uncertainty of a contact, as a share of the half-width, to count as found.
pub(super) const MAX_DOUBT: f64 = 0.03;

/// Initial guesses before the search is given up.
const MAX_GUESSES: usize = 120;

/// Uncertainty of a contact that is about right, and margin sampled beyond it, as a share of its
/// width.
const ROUGH_UNCERTAINTY: f64 = 0.02;

/// Search for the contact of the bodies as one interval.
pub(super) struct Single<'s, 'b, T: Real> {
    pub contact: &'s Contact<'b, T>,
    pub conditions: Conditions<T>,
    /// Interval of the first search; if `None`, the lowest gap, if known.
    pub start: Option<Interval<T>>,
    pub look: Option<&'s Survey<T>>,
    pub integrator: &'s mut Engine<T>,
    pub cost: &'s mut Cost,
    /// Flag: the only contact. Otherwise it may be one of several: bodies that touch in several
    /// places bear more than one contact does, and another start belongs to another contact.
    pub is_alone: bool,
}

/// Start of another search after one that has found no contact.
#[derive(Clone, Copy, PartialEq)]
enum Elsewhere {
    /// Low places of the gap in the survey.
    Low,
    FirstContact,
    /// Place of first contact, with the limits around it as in a leaning contact.
    Leaning,
}

impl<T: Real> Single<'_, '_, T> {
    /// Finds the contact with edges that are each either fixed or not, first around the last one.
    pub fn find(&mut self, last: Option<Interval<T>>) -> Fallible<T, ContactState<T>> {
        let Conditions { edges, given, .. } = self.conditions;
        let pulled = matches!(given, Given::Load(load) if load <= T::zero());
        let adhesive = edges.are_adhesive();
        let is_pulled = pulled && adhesive && edges.are_sought();
        let mut found = if is_pulled { self.pull(last) } else { self.press(last) }?;
        // The bodies were turned before the search.
        found.tilt += self.contact.gap.tilt();
        Ok(found)
    }

    /// Finds the contact under a load that presses, with edges that are each either fixed or not.
    fn press(&mut self, last: Option<Interval<T>>) -> Fallible<T, ContactState<T>> {
        let (gap, range) = (&self.contact.gap, self.contact.gap.range());
        if let Some(on) = self.conditions.both_limits() {
            return self.given(on);
        }
        self.integrator.prescribe_limits(gap, self.conditions.limits());
        let last = last.filter(|on| on.left >= range[0] && on.right <= range[1]);
        // A search of one limit at a time knows no tilt.
        let turns = matches!(self.conditions.given, Given::Centre { .. });
        if !turns && (self.contact.search.is_some() || self.integrator.panels().is_none()) {
            return self.by_nested_search().map_err(|error| self.because(error));
        }
        if let Some(converged) = self.by_newton(last).map_err(|error| self.because(error))? {
            return self.contact_of(converged);
        }
        self.may_bear()?;
        let half_width = match self.conditions.given {
            Given::HalfWidth(half_width) => half_width,
            _ => self.start().half_width(),
        };
        if !self.is_alone {
            let near = self.start().centre();
            return Err(SolveError::NoEquilibrium { half_width, near }.into());
        }
        let rounding = T::epsilon() * (range[1] - range[0]);
        // From another start, or on a far wider span, the way to the contact may be blocked.
        for from in [Elsewhere::Low, Elsewhere::FirstContact, Elsewhere::Leaning] {
            let start = self.elsewhere(from);
            // Next to an end at x = 0 a start may be as narrow as any number.
            let is_narrow = match &start {
                Ok(start) => start.is_some_and(|on| on.half_width() <= rounding),
                Err(error) => matches!(error, ContactError::Solve(SolveError::Overflow { .. })),
            };
            if let Some(error) = if is_narrow { self.nothing() } else { None } {
                return Err(error);
            }
            let Some(start) = start? else { continue };
            self.start = Some(start);
            if let Some(converged) = self.by_newton(None).map_err(|error| self.because(error))? {
                return self.contact_of(converged);
            }
        }
        Err(SolveError::NoEquilibrium { half_width, near: self.start().centre() }.into())
    }

    /// Finds the contact by Newton's method; `None` if it goes astray.
    fn by_newton(&mut self, last: Option<Interval<T>>) -> Fallible<T, Option<Converged<T>>> {
        if let Some(last) = last {
            // Samples of the last load serve for the next one, but not for a contact elsewhere,
            // which cells have found. Around the contact of another scene an error means nothing,
            // unless it is that the bodies bear less.
            let known = |result| match result {
                Err(
                    error @ ContactError::Solve(
                        SolveError::DomainTooShort { .. } | SolveError::HalfWidthTooLarge { .. },
                    ),
                ) => Err(error),
                result => Ok(result.unwrap_or(None)),
            };
            let is_near = |on: &Interval<T>| on.left < last.right && on.right > last.left;
            if let Some(covered) = self.integrator.sampled_interval().filter(is_near) {
                let wide = |converged: &Converged<T>| {
                    converged.on.half_width() >= T::of(0.3) * covered.half_width()
                };
                if let Some(converged) =
                    known(self.converge(last, Effort::Full).map(Result::ok))?.filter(wide)
                {
                    return Ok(Some(converged));
                }
            }
            if let Some(converged) = known(self.in_full(last, T::of(ROUGH_UNCERTAINTY)))? {
                return Ok(Some(converged));
            }
            // The last contact was no help.
            self.integrator.clear_samples();
        } else if let Some(look) = self.look {
            let start = self.start();
            if let Some(panels) = self.integrator.panels_mut() {
                panels.panel_set.guide(look, start);
            }
        }
        let (guess, doubt) = match self.initial_guess()? {
            Some(guess) => guess,
            None => (self.start(), T::of(ROUGH_UNCERTAINTY)),
        };
        self.in_full(guess, doubt)
    }

    /// Runs Newton's method on the samples at hand.
    fn converge(&mut self, from: Interval<T>, effort: Effort) -> Fallible<T, Verdict<T>> {
        let (integrator, gap, conditions) =
            (&mut **self.integrator, &self.contact.gap, &self.conditions);
        NewtonSingle { integrator, gap, conditions, effort }.converge(from)
    }

    /// Finds the contact by one limit at a time.
    fn by_nested_search(&mut self) -> Fallible<T, ContactState<T>> {
        self.integrator.clear_samples();
        let (contact, conditions, gap) = (self.contact, self.conditions, &self.contact.gap);
        let (equations, start) = (Equations::Strength(conditions), self.start_if_known());
        let (on, error) = one_by_one::find(contact, equations, self.integrator, start, self.cost)?;
        let m = self.integrator.moments(gap, on)?;
        let load = match conditions.given {
            Given::HalfWidth(_) => {
                let load = conditions.balance(on, &m).unwrap_or(T::zero());
                self.known(on, load, &m)?
            }
            Given::Load(load) | Given::Centre { load, .. } => load,
        };
        if error > T::of(MAX_DOUBT) {
            self.may_bear()?;
        }
        Ok(ContactState::new(&conditions, on, load, Some(error), &m))
    }

    /// Returns the contact between two known limits. The load is sought unless given.
    fn given(&mut self, on: Interval<T>) -> Fallible<T, ContactState<T>> {
        let (gap, range, conditions) =
            (&self.contact.gap, self.contact.gap.range(), &self.conditions);
        super::check(on)?;
        let sought = conditions.edges.are_sought();
        if !sought && matches!(conditions.given, Given::HalfWidth(_)) {
            return Err(InputError::BothLimitsGiven { interval: on }.into());
        }
        let rounding = T::of(8.0) * T::epsilon() * (on.left.abs() + on.right.abs());
        super::check_within(on, range.into(), if sought { rounding } else { T::zero() })?;
        let on = Interval { left: on.left.max(range[0]), right: on.right.min(range[1]) };
        self.integrator.prescribe_limits(gap, conditions.limits());
        // Samples of the last load serve for the next one.
        let serves = |covered: Interval<T>| {
            let within = covered.left <= on.left && covered.right >= on.right;
            within && on.half_width() >= T::of(0.3) * covered.half_width()
        };
        if !self.integrator.sampled_interval().is_some_and(serves) {
            let span = self.around(on, T::of(ROUGH_UNCERTAINTY));
            self.integrator.sample_over(gap, span, false)?;
        }
        let m = self.integrator.moments(gap, on)?;
        let conditions = &self.conditions;
        let Some(load) = conditions.balance(on, &m) else {
            return Ok(ContactState::new(conditions, on, conditions.load(), None, &m));
        };
        let error = Some(relative_error(on, &m, m.m1.abs() + m.m0.abs()));
        Ok(ContactState::new(conditions, on, load, error, &m))
    }

    /// Returns the contact on which Newton's method has converged.
    fn contact_of(&mut self, converged: Converged<T>) -> Fallible<T, ContactState<T>> {
        let (Converged { on, load, error, load_error }, conditions) = (converged, &self.conditions);
        let m = self.integrator.moments(&self.contact.gap, on)?;
        let load = match conditions.given {
            Given::Load(_) | Given::Centre { .. } => load,
            Given::HalfWidth(_) => self.known(on, load_of(conditions, on, load, &m), &m)?,
        };
        Ok(ContactState {
            load_error: Some(load_error),
            ..ContactState::new(conditions, on, load, Some(error), &m)
        })
    }

    /// Returns the load of a contact of given width, if rounding of the limits changes it by less
    /// than its own size: on a flat, such a contact lies anywhere and bears nothing.
    fn known(&self, on: Interval<T>, load: T, m: &Moments<T>) -> Fallible<T, T> {
        let (half_width, stiffness) = (on.half_width(), self.conditions.kappa * on.half_width());
        let rate = m.derivatives.map(|rates| rates.by_1.abs() + rates.by_2.abs());
        let rounding = T::epsilon() * on.left.abs().max(on.right.abs());
        let unknown = stiffness * rate.unwrap_or(T::zero()) * rounding;
        if load.abs() <= unknown && !self.conditions.edges.are_adhesive() {
            return Err(SolveError::NoEquilibrium { half_width, near: on.centre() }.into());
        }
        Ok(load)
    }

    /// Samples a span around a contact that is nearly right, and finds the limits on it.
    fn in_full(&mut self, guess: Interval<T>, doubt: T) -> Fallible<T, Option<Converged<T>>> {
        let gap = &self.contact.gap;
        let (mut guess, mut best) = (guess.plain(), None);
        for _ in 0..3 {
            let span = self.around(guess, T::of(ROUGH_UNCERTAINTY) + doubt);
            if self.integrator.sample_over(gap, span, false)?.is_none() {
                return Ok(None);
            }
            let Ok(converged) = self.converge(guess, Effort::Full)? else {
                return Ok(None);
            };
            // Panels much wider than the contact are less accurate than they seem.
            let covered = self.integrator.sampled_interval().unwrap_or(span);
            if converged.on.half_width() >= T::of(0.8) * covered.half_width() {
                return Ok(Some(converged));
            }
            (guess, best) = (converged.on.plain(), Some(converged));
        }
        Ok(best)
    }

    /// Tells whether the bodies bear the load or width; false if that is unknown, or if they touch
    /// first at an end: another contact may be asked for. Fails if it is too large.
    fn may_bear(&mut self) -> Fallible<T, bool> {
        // One of several contacts bears part of the load, and bodies that turn another one.
        if !self.is_alone || self.conditions.at().is_some() {
            return Ok(self.is_alone);
        }
        let Self { contact, conditions, cost, .. } = self;
        let ends = contact.gap.range().into();
        let bears = capacity(contact, conditions, ends, cost).map(|(_, bears)| bears);
        let Some(bears) = bears.filter(|bears| !bears.load.is_zero()) else { return Ok(false) };
        let room = T::one() + T::of(8.0) * T::epsilon();
        match conditions.given {
            Given::Load(load) if load > bears.load => Err(bears.too_short(load)),
            Given::HalfWidth(wanted) if wanted > bears.half_width * room => {
                Err(bears.too_wide(wanted))
            }
            _ => Ok(true),
        }
    }

    /// Returns the error of bodies that touch first at an end, if they do.
    fn nothing(&mut self) -> Option<ContactError<T>> {
        let Self { contact, conditions, cost, .. } = self;
        let ends = contact.gap.range().into();
        let turns = conditions.at().is_some();
        let bears = if turns { None } else { capacity(contact, conditions, ends, cost) };
        let nothing = bears.filter(|(_, bears)| bears.load.is_zero());
        nothing.map(|(_, bears)| bears.exceeded(conditions))
    }

    /// Replaces an error of the search by the exceeded capacity that caused it, if any.
    fn because(&mut self, error: ContactError<T>) -> ContactError<T> {
        use SolveError::{NoEquilibrium, OutsideBodies, Overflow};
        match error {
            ContactError::Solve(NoEquilibrium { .. } | OutsideBodies { .. } | Overflow { .. })
            | ContactError::Input(InputError::Profile {
                // Occurs at an end of the bodies.
                source: ProfileError::NotFinite { .. },
                ..
            }) => self.may_bear().err().unwrap_or(error),
            _ => error,
        }
    }
}
