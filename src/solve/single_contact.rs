//! One contact, from a start to the limits with as few samples as possible.
//!
//! First a span in which the contact is expected is sampled with four nodes a panel, and Newton's method
//! finds the contact of this guess; if that is much narrower than the span, or beside it, a span
//! around it is sampled anew for the next guess. Then a span a little wider than the contact is sampled in full, and
//! Newton's method finds the limits on that. Where it goes astray it starts again where the bodies [touch
//! first](super::first_contact), with a width that may bear the load. Where that finds no contact either, or leads to
//! an end of the bodies time and again, it is asked what they [bear](super::capacity). The [nested
//! search](super::nested) serves strategies of the user's, and quadratures that know no derivatives.

use super::Contact;
use super::capacity::{Capacity, capacity};
use super::edges::{Conditions, Edge, Given};
use super::equations::{Equations, relative_error};
use super::first_contact::first_contact;
use super::nested;
use super::newton::Stop;
use super::newton::linearised::load_of;
use super::newton::single::{Converged, Effort, NewtonSingle, Verdict};
use crate::gap::{Cost, Sampler, Survey};
use crate::quadrature::{Integrator, panels};
use crate::solution::ContactState;
use crate::{ContactError, Ends, Interval, ProfileError, Real, Side};

/// More doubt than this, as a share of the half-width, is no contact found.
pub(super) const MOST_DOUBT: f64 = 0.03;

/// Initial guesses before the search is given up.
const MOST_GUESSES: usize = 120;

/// Steps beyond an end of the bodies in an initial guess, after which another is made; and in full, after which it is
/// asked what they bear. (Each goes half the way: a contact may come as close to an end as 1e-7 of its width.)
const MOST_AT_END: [usize; 2] = [2, 24];

/// Initial guesses that may reach for an end before it is asked what the bodies bear.
const MOST_GUESSES_AT_END: usize = 2;

/// Steps in which an adhesive contact is pulled at: the first may be far longer than the last.
const MOST_PULLS: usize = 200;

/// By how much a contact that is about right may be off, and what is sampled beyond it, as a share of its
/// width.
const ABOUT: f64 = 0.02;

/// A contact of the bodies as one interval.
pub(super) struct Single<'s, 'b, T: Real> {
    pub contact: &'s Contact<'b, T>,
    pub conditions: Conditions<T>,
    /// Where it is sought first; or else at the lowest gap, where that is known.
    pub start: Option<Interval<T>>,
    pub look: Option<&'s Survey<T>>,
    pub integrator: &'s mut dyn Integrator<T>,
    pub cost: &'s mut Cost,
    /// What the bodies bear, once looked at. Bodies that touch in several places bear more than one contact.
    pub bears: Option<Option<Capacity<T>>>,
}

/// Where one contact is sought after a search that has found none.
#[derive(Clone, Copy, PartialEq)]
enum Elsewhere {
    /// Where the gap is low, as it looks.
    Low,
    FirstContact,
    /// About the place of first contact as in a contact that leans.
    Leaning,
}

/// How far a limit lies beyond a corner on its side.
fn beyond<T: Real>(on: Interval<T>, side: Side, corner: T) -> T {
    match side {
        Side::Left => corner - on.left,
        Side::Right => on.right - corner,
    }
}

impl<T: Real> Single<'_, '_, T> {
    /// Finds the contact, first around the last one.
    pub fn find(&mut self, last: Option<Interval<T>>) -> Result<ContactState<T>, ContactError<T>> {
        let corners = self.conditions.edges;
        // A corner holds the contact as long as it presses there; a width may be had without it, unless
        // it held the last one. It cannot hold both edges.
        let by_load = !matches!(self.conditions.given, Given::HalfWidth(_));
        let mut one_held = false;
        for side in Side::BOTH {
            let edge = &mut self.conditions.edges[side];
            if let Edge::FreeUntil(x) = *edge {
                let touched = last.map(|on| on[side] == x);
                let held = touched.unwrap_or(by_load) && (by_load || !one_held);
                one_held |= held;
                *edge = if held { Edge::Fixed(x) } else { Edge::Free };
            }
        }
        let mut found = match self.between_edges(last) {
            Err(error) if self.conditions.edges != corners => {
                // A corner that is far off may not be held at all.
                let let_go =
                    |edge| if matches!(edge, Edge::FreeUntil(_)) { Edge::Free } else { edge };
                self.conditions.edges = corners.map(let_go);
                self.between_edges(last).map_err(|_| error)?
            }
            found => found?,
        };
        for _ in 0..4 {
            let on = found.interval;
            let mut changed = false;
            for side in Side::BOTH {
                let Edge::FreeUntil(x) = corners[side] else { continue };
                let edge = &mut self.conditions.edges[side];
                if edge.is_free() && beyond(on, side, x) > T::zero() {
                    (*edge, changed) = (Edge::Fixed(x), true);
                } else if !edge.is_free() && found.strengths[side] < T::zero() {
                    (*edge, changed) = (Edge::Free, true);
                }
            }
            if !changed {
                break;
            }
            found = self.between_edges(Some(on))?;
        }
        let on = found.interval;
        for side in Side::BOTH {
            let Edge::FreeUntil(x) = corners[side] else { continue };
            // Neither held by the corner nor within it.
            if beyond(on, side, x) > T::of(8.0) * T::epsilon() * (x.abs() + on.half_width()) {
                return Err(ContactError::NoEquilibrium { half_width: on.half_width(), near: x });
            }
        }
        // What the bodies were turned by before.
        found.tilt += self.contact.gap.tilt();
        Ok(found)
    }

    /// The same for edges of which each is either fixed or not.
    fn between_edges(
        &mut self,
        last: Option<Interval<T>>,
    ) -> Result<ContactState<T>, ContactError<T>> {
        let Conditions { edges, given, .. } = self.conditions;
        let pulled = matches!(given, Given::Load(load) if load <= T::zero());
        let adhesive = edges.are_adhesive();
        if pulled && adhesive && edges.are_sought() { self.pull(last) } else { self.press(last) }
    }

    /// The same for a load that presses.
    fn press(&mut self, last: Option<Interval<T>>) -> Result<ContactState<T>, ContactError<T>> {
        let (gap, range) = (&self.contact.gap, self.contact.gap.range());
        if let Some(on) = self.conditions.both_limits() {
            return self.given(on);
        }
        self.integrator.prescribe_limits(gap, self.conditions.limits());
        let last = last.filter(|on| on.left >= range[0] && on.right <= range[1]);
        // A search of one limit at a time knows no tilt.
        let turns = matches!(self.conditions.given, Given::Centre { .. });
        if !turns && (self.contact.search.is_some() || !panels::is_panels(self.integrator)) {
            return self.by_nested_search().map_err(|error| self.because(error));
        }
        let is_one_of_several = matches!(self.bears, Some(None));
        if let Some(converged) = self.by_newton(last).map_err(|error| self.because(error))? {
            return self.contact_of(converged);
        }
        self.check()?;
        let half_width = match self.conditions.given {
            Given::HalfWidth(half_width) => half_width,
            _ => self.start().half_width(),
        };
        if is_one_of_several {
            return Err(ContactError::NoEquilibrium { half_width, near: self.start().centre() });
        }
        // From elsewhere, or on a span far wider, the way there may be blocked.
        for from in [Elsewhere::Low, Elsewhere::FirstContact, Elsewhere::Leaning] {
            let Some(start) = self.elsewhere(from)? else { continue };
            self.start = Some(start);
            if let Some(converged) = self.by_newton(None).map_err(|error| self.because(error))? {
                return self.contact_of(converged);
            }
        }
        Err(ContactError::NoEquilibrium { half_width, near: self.start().centre() })
    }

    /// Another start: from where the bodies are low, if heights of them are known, or from where they touch first.
    ///
    /// On a flat that leans a little, if only by rounding, the lowest place is at one of its ends, and what is about that
    /// end tells nothing of the other. But at the limits of a contact round bodies are F/κ apart, and wedges, which rise
    /// most, up to twice as much: up to there the flat takes part.
    fn elsewhere(&mut self, from: Elsewhere) -> Result<Option<Interval<T>>, ContactError<T>> {
        if from == Elsewhere::Low {
            let Some(look) = self.look else { return Ok(None) };
            return Ok(match self.conditions.given {
                Given::Load(load) => Some(look.below(T::of(2.0) * load / self.conditions.kappa)),
                Given::HalfWidth(half_width) => Some(look.level(half_width)),
                Given::Centre { .. } => None,
            });
        }
        let mut sampler = Sampler::default();
        let around = self.around_first_contact(&mut sampler, from == Elsewhere::Leaning);
        *self.cost += sampler.cost;
        around.map(Some)
    }

    /// Where the bodies touch first, with a width that may bear the load: with the slopes -m and n at the limits a
    /// parabola bears `F = κ L (m + n)/4`. A contact that leans has the place of first contact at the angle
    /// φ = π m/(m + n), as a wedge of these slopes has, which bears `F = κ L (m + n) sin φ/π`.
    fn around_first_contact(
        &self,
        sampler: &mut Sampler<T>,
        leans: bool,
    ) -> Result<Interval<T>, ContactError<T>> {
        let (gap, conditions, quarter) = (&self.contact.gap, &self.conditions, T::of(0.25));
        let x = first_contact(sampler, gap, self.start)?;
        let [left, right] = gap.range();
        let around = |reach: T, lean: T| Interval {
            left: x - reach * (T::one() + lean),
            right: x + reach * (T::one() - lean),
        };
        let mut reach = quarter * (x - left).min(right - x);
        let mut on = around(reach, T::zero());
        if let Given::HalfWidth(half_width) = conditions.given {
            (reach, on) = (half_width, around(half_width.min(reach), T::zero()));
        }
        for _ in 0..MOST_GUESSES {
            let falls = -sampler.slope(gap, on.left)?;
            let rise = falls + sampler.slope(gap, on.right)?;
            let stiffness = quarter * conditions.kappa * rise;
            // So little is less than any number.
            if stiffness > T::zero() && (reach * stiffness).is_zero() {
                return Err(ContactError::Overflow { interval: on });
            }
            let share =
                if leans { (falls / rise).max(T::zero()).min(T::one()) } else { T::of(0.5) };
            let (sin, cos) = (T::pi() * share).sin_cos();
            match conditions.given {
                Given::Load(load) | Given::Centre { load, .. }
                    if load > T::zero() && reach * stiffness * sin > load =>
                {
                    reach *= quarter;
                    on = around(reach, cos);
                }
                _ => break,
            }
        }
        Ok(on)
    }

    /// By Newton's method; `None` where that goes astray.
    fn by_newton(
        &mut self,
        last: Option<Interval<T>>,
    ) -> Result<Option<Converged<T>>, ContactError<T>> {
        if let Some(last) = last {
            // What was sampled for the last load serves for the next. About the contact of another scene an
            // error says nothing, but that the bodies bear less.
            let known = |result| match result {
                Err(
                    error @ (ContactError::DomainTooShort { .. }
                    | ContactError::HalfWidthTooLarge { .. }),
                ) => Err(error),
                result => Ok(result.unwrap_or(None)),
            };
            if let Some(covered) = self.integrator.sampled_interval() {
                let wide = |converged: &Converged<T>| {
                    converged.on.half_width() >= T::of(0.3) * covered.half_width()
                };
                if let Some(converged) =
                    known(self.converge(last, Effort::Full).map(Result::ok))?.filter(wide)
                {
                    return Ok(Some(converged));
                }
            }
            if let Some(converged) = known(self.in_full(last, T::of(ABOUT)))? {
                return Ok(Some(converged));
            }
            // The last contact was no help.
            self.integrator.clear_samples();
        } else if let Some(look) = self.look {
            let guides = look.guides(self.start());
            panels::guide(self.integrator, guides);
        }
        let (guess, doubt) = match self.initial_guess()? {
            Some(guess) => guess,
            None => (self.start(), T::of(ABOUT)),
        };
        self.in_full(guess, doubt)
    }

    /// Newton's method on the samples at hand. Where it leads to an end of the bodies time and again that is
    /// perhaps more than they bear.
    fn converge(
        &mut self,
        from: Interval<T>,
        effort: Effort,
    ) -> Result<Verdict<T>, ContactError<T>> {
        let most_at_end = match (effort, self.bears) {
            (Effort::Guess, _) => MOST_AT_END[0],
            (Effort::Full, Some(Some(_))) => usize::MAX,
            (Effort::Full, _) => MOST_AT_END[1],
        };
        let (gap, conditions) = (&self.contact.gap, self.conditions);
        let find = |integrator: &mut dyn Integrator<T>, most_at_end| {
            let conditions = &conditions;
            NewtonSingle { integrator, gap, conditions, effort, most_at_end }.converge(from)
        };
        let verdict = find(self.integrator, most_at_end)?;
        let is_at_end = matches!(verdict, Err(Stop::Beyond { .. }));
        if effort == Effort::Full && is_at_end && self.may_bear()? {
            return find(self.integrator, usize::MAX);
        }
        Ok(verdict)
    }

    /// By one limit at a time.
    fn by_nested_search(&mut self) -> Result<ContactState<T>, ContactError<T>> {
        self.integrator.clear_samples();
        let (contact, conditions, gap) = (self.contact, self.conditions, &self.contact.gap);
        let equations = Equations::Strength { conditions, load: conditions.load() };
        let start = self.start_if_known();
        let nested = nested::find(contact, equations, self.integrator, start, self.cost)?;
        let on = nested.on;
        let m = self.integrator.moments(gap, on)?;
        let load = match conditions.given {
            Given::HalfWidth(_) => conditions.balance(on, &m).unwrap_or(T::zero()),
            Given::Load(load) | Given::Centre { load, .. } => load,
        };
        let error = nested.error;
        if error > T::of(MOST_DOUBT) {
            self.check()?;
        }
        Ok(ContactState::new(&conditions, on, load, Some(error), &m))
    }

    /// The contact between limits that are both known. What is not given is the load.
    fn given(&mut self, on: Interval<T>) -> Result<ContactState<T>, ContactError<T>> {
        let (gap, range, conditions) =
            (&self.contact.gap, self.contact.gap.range(), &self.conditions);
        super::check(on)?;
        let sought = conditions.edges.are_sought();
        if !sought && matches!(conditions.given, Given::HalfWidth(_)) {
            return Err(ContactError::BothLimitsGiven { interval: on });
        }
        let rounding = T::of(8.0) * T::epsilon() * (on.left.abs() + on.right.abs());
        super::check_within(on, range.into(), if sought { rounding } else { T::zero() })?;
        let on = Interval { left: on.left.max(range[0]), right: on.right.min(range[1]) };
        self.integrator.prescribe_limits(gap, conditions.limits());
        // What was sampled for the last load serves for the next.
        let serves = |covered: Interval<T>| {
            let within = covered.left <= on.left && covered.right >= on.right;
            within && on.half_width() >= T::of(0.3) * covered.half_width()
        };
        if !self.integrator.sampled_interval().is_some_and(serves) {
            self.integrator.sample_over(gap, self.around(on, T::of(ABOUT)), false)?;
        }
        let m = self.integrator.moments(gap, on)?;
        let conditions = &self.conditions;
        let Some(load) = conditions.balance(on, &m) else {
            return Ok(ContactState::new(conditions, on, conditions.load(), None, &m));
        };
        let error = Some(relative_error(on, &m, m.m1.abs() + m.m0.abs()));
        Ok(ContactState::new(conditions, on, load, error, &m))
    }

    /// The contact that Newton's method has converged on.
    fn contact_of(&mut self, converged: Converged<T>) -> Result<ContactState<T>, ContactError<T>> {
        let (Converged { on, load, error, force }, conditions) = (converged, &self.conditions);
        let m = self.integrator.moments(&self.contact.gap, on)?;
        let load = match conditions.given {
            Given::Load(_) | Given::Centre { .. } => load,
            Given::HalfWidth(_) => load_of(conditions, on, load, &m),
        };
        Ok(ContactState {
            force: Some(force),
            ..ContactState::new(conditions, on, load, Some(error), &m)
        })
    }

    /// Samples a span around a contact that is nearly right, and finds the limits on that.
    fn in_full(
        &mut self,
        guess: Interval<T>,
        doubt: T,
    ) -> Result<Option<Converged<T>>, ContactError<T>> {
        let gap = &self.contact.gap;
        let (mut guess, mut best) = (guess.plain(), None);
        for _ in 0..3 {
            let span = self.around(guess, T::of(ABOUT) + doubt);
            if self.integrator.sample_over(gap, span, false)?.is_none() {
                return Ok(None);
            }
            let Ok(converged) = self.converge(guess, Effort::Full)? else {
                return Ok(None);
            };
            // Panels much wider than the contact are not as good as they look.
            let covered = self.integrator.sampled_interval().unwrap_or(span);
            if converged.on.half_width() >= T::of(0.8) * covered.half_width() {
                return Ok(Some(converged));
            }
            (guess, best) = (converged.on.plain(), Some(converged));
        }
        Ok(best)
    }

    /// A first estimate of the contact, and how far it is in doubt as a share of its half-width; `None` where
    /// guesses lead nowhere.
    fn initial_guess(&mut self) -> Result<Option<(Interval<T>, T)>, ContactError<T>> {
        let gap = &self.contact.gap;
        let range = gap.range();
        let inside =
            |on: &Interval<T>| on.left >= range[0] && on.right <= range[1] && on.left < on.right;
        let mut span = self.start();
        let mut on: Option<Interval<T>> = None;
        let mut at_end = 0;
        for _ in 0..MOST_GUESSES {
            if !inside(&span) {
                return Ok(None);
            }
            let Some(doubt) = self.integrator.sample_over(gap, span, true)? else {
                return Ok(None);
            };
            let begin = on.unwrap_or(span);
            let (guess, error) = match self.converge(begin, Effort::Guess)? {
                Ok(Converged { on, error, .. }) => (on, error),
                Err(Stop::Beyond { reached, .. }) => {
                    let before = std::mem::replace(&mut span, self.up_to_corners(reached.plain()));
                    at_end += 1;
                    if span.is_same(&before) || at_end == MOST_GUESSES_AT_END && !self.may_bear()? {
                        return Ok(None);
                    }
                    on = None;
                    continue;
                }
                Err(_) => return Ok(None),
            };
            let guess = guess.plain();
            on = Some(guess);
            let within = guess.left >= span.left && guess.right <= span.right;
            let share = guess.half_width() / span.half_width();
            // A breakpoint inside is where it is, and only the width is in doubt.
            let breakpointed =
                gap.breakpoint_after(guess.left).is_some_and(|breakpoint| breakpoint < guess.right);
            let comparable = share >= T::of(0.4);
            let doubt = if breakpointed && !comparable { doubt.sqrt() } else { doubt };
            let relative = if breakpointed { doubt } else { doubt / share };
            let sure = T::of(if breakpointed { 0.1 } else { 0.02 });
            // Outside, the doubt grows with the powers that the guess has left out.
            let apart = (guess.centre() - span.centre()).abs() / span.half_width();
            let reached = share.max(apart).max(T::one());
            if !within && relative * reached.powi(5) <= T::of(1e-3) && error <= sure {
                return Ok(Some((guess, sure * T::of(0.5))));
            }
            if within && error <= T::of(0.1) && (comparable || relative <= sure) {
                return Ok(Some((guess, relative.min(T::of(0.1)))));
            }
            // Around it, as closely as its place is known.
            let rounding = T::of(64.0) * T::epsilon();
            let largest = span.left.abs().max(span.right.abs());
            let doubt = if breakpointed { T::zero() } else { (doubt + doubt).min(T::of(0.3)) };
            let reach = (doubt * span.half_width()).max(rounding * largest);
            let [left, right] = self.beyond(guess, T::of(0.125));
            // What lies outside was guessed from the outermost panel, which may be a short one.
            let guessed = |by: T| T::of(1.0 / 64.0) * by.max(T::zero());
            let next = Interval {
                left: left.min(guess.left - reach - guessed(span.left - guess.left)),
                right: right.max(guess.right + reach + guessed(guess.right - span.right)),
            };
            // Half the way to an end, where the slope may be infinite.
            let half_way = |x: T, from: T, end: T, is_beyond: bool| {
                if is_beyond { T::of(0.5) * from + T::of(0.5) * end } else { x }
            };
            let is_beyond = [next.left <= range[0], next.right >= range[1]];
            span = self.up_to_corners(Interval {
                left: half_way(next.left, guess.left, range[0], is_beyond[0]),
                right: half_way(next.right, guess.right, range[1], is_beyond[1]),
            });
            at_end += usize::from(is_beyond[0] || is_beyond[1]);
            if at_end == MOST_GUESSES_AT_END && !self.may_bear()? {
                return Ok(None);
            }
        }
        Ok(None)
    }

    /// Whether the bodies bear as much, where that can be told.
    fn may_bear(&mut self) -> Result<bool, ContactError<T>> {
        self.check()?;
        Ok(!matches!(self.bears, Some(None)))
    }

    /// The start, or the lowest gap.
    fn start_if_known(&self) -> Option<Interval<T>> {
        let Conditions { edges, given, kappa } = self.conditions;
        // Beside what adhesion adds a load tells nothing.
        let adhesive = edges.are_adhesive();
        let load = match given {
            Given::Load(load) if !adhesive => Some(load / kappa),
            _ => None,
        };
        self.start.or_else(|| Some(self.look?.around_lowest(load)))
    }

    /// Where the first guess is: the start, or the middle half of the bodies; where the load acts at a given
    /// place, around that.
    fn start(&self) -> Interval<T> {
        let [left, right] = self.contact.gap.range();
        let (whole, half) = (Interval { left, right }, T::of(0.5));
        let quarter = half * whole.half_width();
        let (centre, reach) = match self.conditions.given {
            Given::Centre { at, .. } => {
                let at = at.component(0);
                let reach = quarter.min(half * (at - left).min(right - at));
                if reach > T::zero() { (at, reach) } else { (whole.centre(), quarter) }
            }
            _ => (whole.centre(), quarter),
        };
        let middle = Interval { left: centre - reach, right: centre + reach };
        let inside = |on: &Interval<T>| on.left >= left && on.right <= right;
        let start = self.start_if_known().filter(inside).unwrap_or(middle);
        let on = self.conditions.with_given_limits(start);
        // A given limit may be closer to the end of the bodies than that is wide.
        Interval {
            left: if on.left < left { half * left + half * on.right } else { on.left },
            right: if on.right > right { half * on.left + half * right } else { on.right },
        }
    }

    /// Both limits moved outward by a share of what lies between them and the next breakpoint inside. (A
    /// body may be a thousand times as steep on the other side of a breakpoint.)
    fn beyond(&self, on: Interval<T>, share: T) -> [T; 2] {
        let gap = &self.contact.gap;
        let first = gap.breakpoint_after(on.left).filter(|&breakpoint| breakpoint < on.right);
        let last = gap.breakpoint_before(on.right).filter(|&breakpoint| breakpoint > on.left);
        let [right_end, left_end] = [first.unwrap_or(on.right), last.unwrap_or(on.left)];
        [on.left - share * (right_end - on.left), on.right + share * (on.right - left_end)]
    }

    /// A span a little wider than a contact, by no more than half the way to the ends of the bodies.
    fn around(&self, on: Interval<T>, share: T) -> Interval<T> {
        let (half, range) = (T::of(0.5), self.contact.gap.range());
        let [left, right] = self.beyond(on, share);
        self.up_to_corners(Interval {
            left: left.max(half * on.left + half * range[0]),
            right: right.min(half * on.right + half * range[1]),
        })
    }

    /// A span need not go beyond a fixed edge.
    fn up_to_corners(&self, on: Interval<T>) -> Interval<T> {
        let Ends { left, right } = self.conditions.limits();
        Interval { left: left.unwrap_or(on.left), right: right.unwrap_or(on.right) }.plain()
    }

    /// Pulls at an adhesive contact: from no load on, or from the widest that there is room for, in
    /// steps, each starting from the contact before. The contact gives way where its width no longer
    /// falls with the load, but all at once.
    fn pull(&mut self, last: Option<Interval<T>>) -> Result<ContactState<T>, ContactError<T>> {
        let load = self.conditions.load();
        if let Some(last) = last
            && let Some(found) = self.pulled(load, last)?
        {
            return Ok(found);
        }
        self.conditions.given = Given::Load(T::zero());
        let mut fault = None;
        let (mut least, mut last) = match self.press(None) {
            Ok(found) if load.is_zero() => return Ok(found),
            Ok(found) => (T::zero(), found.interval),
            // Those of a contact that does not fit.
            Err(
                error @ (ContactError::DomainTooShort { .. }
                | ContactError::NoEquilibrium { .. }
                | ContactError::Overflow { .. }),
            ) => {
                let ends = self.contact.ends();
                let widest = capacity(self.contact, &self.conditions, ends, self.cost);
                let widest = widest.ok_or(error)?;
                let too_short = widest.too_short(load);
                if widest.load <= load {
                    return Err(too_short);
                }
                // Unless it grows with its load, the one to be found is wider.
                fault = Some(too_short);
                (widest.load, widest.on)
            }
            Err(error) => return Err(error),
        };
        // Narrower contacts bear less than this. Where a step leads astray, half of it may not; what is
        // left of the pull in the end is less than a thousandth of it.
        let pulls = self.conditions.edge_strengths(last.half_width());
        let least_of_all = T::of(-2.0) * (pulls.right + pulls.left);
        let mut step = (load - least).max(least_of_all - least.max(T::zero()));
        for _ in 0..MOST_PULLS {
            let next = (least + step).max(load);
            match self.pulled(next, last)? {
                Some(found) if next <= load => return Ok(found),
                Some(found) => (least, last, fault) = (next, found.interval, None),
                None if step.abs() <= T::of(1e-3) * least.abs() => break,
                None => step *= T::of(0.5),
            }
        }
        Err(fault.unwrap_or(ContactError::PullOff { load, least }))
    }

    /// The contact under a load, from one nearby.
    fn pulled(
        &mut self,
        load: T,
        from: Interval<T>,
    ) -> Result<Option<ContactState<T>>, ContactError<T>> {
        self.conditions.given = Given::Load(load);
        let converged = self.in_full(from, T::of(ABOUT))?;
        converged.map(|converged| self.contact_of(converged)).transpose()
    }

    /// Refuses more than the bodies bear.
    fn check(&mut self) -> Result<(), ContactError<T>> {
        let Self { contact, conditions, cost, .. } = self;
        // Turned, they bear another load.
        if matches!(conditions.given, Given::Centre { .. }) {
            return Ok(());
        }
        let range = contact.gap.range();
        let bears =
            self.bears.get_or_insert_with(|| capacity(contact, conditions, range.into(), cost));
        let room = T::one() + T::of(8.0) * T::epsilon();
        match (conditions.given, bears) {
            (Given::Load(load), Some(bears)) if load > bears.load => Err(bears.too_short(load)),
            (Given::HalfWidth(wanted), Some(bears)) if wanted > bears.on.half_width() * room => {
                Err(bears.too_wide(wanted))
            }
            _ => Ok(()),
        }
    }

    /// That, where it is the reason for an error of a search.
    fn because(&mut self, error: ContactError<T>) -> ContactError<T> {
        match error {
            ContactError::NoEquilibrium { .. }
            | ContactError::OutsideBodies { .. }
            | ContactError::Overflow { .. }
            // As at an end of the bodies.
            | ContactError::Profile { source: ProfileError::NotFinite { .. }, .. } => self.check().err().unwrap_or(error),
            _ => error,
        }
    }
}
