//! Contact with a given value of a quantity that no equation of the contact prescribes.
//!
//! Each [`Quantity`] has a file: its value, its rate and the load to begin with. Newton's method on
//! ln q over ln F finds the load, between loads that are too small and too large; for a power law
//! it takes one step. Short steps follow the cubic through two points with their rates. Each trial
//! is a solve by load, and its samples serve the next. A quantity may jump: the half-width when a
//! contact is born outside the others, the peak when a corner is reached. A value inside a jump has
//! no load. Between such loads a step that is not less than half of the last but one gives way to
//! the middle, so that the loads close in (Brent's rule).
//!
//! A quantity that may fall can have a value under several loads. The one sought lies on the branch
//! from first touch, where the quantity rises: a load under which it falls is too large. It is
//! followed from a light load, in steps so short that the rates at both ends agree with the rise in
//! between.

mod approach;
mod half_width;
mod peak;
#[cfg(test)]
mod tests;

use super::capacity::Capacity;
use super::edges::{Conditions, Given};
use super::{Contact, Control, Work, bending, check_positive, topology};
use crate::gap::{Asked, Gap};
use crate::kernel::Kernel;
use crate::search::SearchError;
use crate::solution::{ContactState, Report, Solved};
use crate::{ContactError, Ends, Fallible, InputError, Interval, Real, SolveError};
pub(super) use approach::ByApproach;
pub(super) use half_width::HalfWidth;
pub(super) use peak::Peak;
use std::ops::ControlFlow;

/// Loads tried before the search is given up.
const MAX_LOADS: usize = 100;

/// Largest factor between the loads of two trials.
const MAX_STEP: f64 = 1e3;

/// Load from which a quantity is followed, as a share of the load expected.
const FIRST_TOUCH: f64 = 1e-6;

/// Shortest step by which it is followed, a factor: between its ends no fall is looked for.
const LEAST_STEP: f64 = 1.001;

/// Largest load of a row of contacts that is tried, by that of complete contact: there the gap of
/// waves is 2 % of the period.
const LARGEST_SHARE: f64 = 0.999;

/// Factor from a load that bodies with a kernel bear to one that they do not, up to which a value
/// may be out of reach.
const NEARLY_ALL: f64 = 1.02;

/// Largest factor between a load and the first one while the load is not enclosed.
const MAX_FACTOR: f64 = 1e12;

/// Value of a quantity, its derivative by the load, and its relative error from other sources than
/// the limits.
type Value<T> = Fallible<T, [T; 3]>;

/// Conclusion from a failed trial: the widest contact, which has the wanted value, or an estimate.
type Bound<T> = Fallible<T, ControlFlow<ContactState<T>, Point<T>>>;

/// Quantity that is given instead of the load.
pub(super) trait Quantity<T: Real> {
    /// Returns the load to try first.
    fn first_load(&self, search: &mut ByLoad<'_, '_, '_, T>) -> Fallible<T, T>;

    /// Returns the value in a contact found.
    fn at(&self, found: &ContactState<T>, search: &mut ByLoad<'_, '_, '_, T>) -> Value<T>;

    /// Tells whether the quantity may fall between first touch and a load under which it rises.
    fn may_fall(&self, contact: &Contact<'_, T>) -> bool;

    /// Returns the value in the widest contact, and the error for a larger one, if they are known.
    fn of_widest(&self, _wanted: T, _: &Capacity<T>) -> Option<(T, ContactError<T>)> {
        None
    }

    /// Returns the error for a value that occurs under no load, if it has one of its own.
    fn none(&self, _: &ByLoad<'_, '_, '_, T>) -> Option<ContactError<T>> {
        None
    }
}

/// Quantity under a load.
#[derive(Clone, Copy)]
struct Point<T> {
    load: T,
    value: T,
    rate: T,
    /// Half-width of the contacts; NaN if they were not found.
    half_width: T,
}

impl<T: Real> Point<T> {
    /// Returns the exponent of the load as a power of the quantity, infinite where corners hold the
    /// contacts; `None` if it is not known.
    fn power(&self) -> Option<T> {
        let power = self.value / (self.load * self.rate);
        (power.abs() >= T::zero()).then_some(power)
    }

    /// Tells whether the quantity rises up to another point about like a power of the load: the
    /// exponents at both ends are within half of the mean one.
    fn rises_to(&self, to: &Self) -> bool {
        let mean = (to.value / self.value).ln() / (to.load / self.load).ln();
        let off = |at: &Self| (at.rate * at.load / at.value - mean).abs();
        off(self).max(off(to)) <= T::of(0.5) * mean
    }
}

/// Search for the load under which a quantity has the wanted value.
pub(super) struct ByLoad<'s, 'w, 'b, T: Real> {
    contact: &'s Contact<'b, T>,
    kernel: Option<&'s Kernel<'b, T>>,
    /// Bodies of the contact found last: bent, with a kernel.
    gap: Gap<'b, T>,
    quantity: &'s dyn Quantity<T>,
    name: &'static str,
    wanted: T,
    work: &'s mut Work<'w, T>,
    /// True if the quantity has to be followed from first touch.
    follows: bool,
    /// Loads that are too small and too large.
    low: Option<Point<T>>,
    high: Option<Point<T>>,
    /// Last two steps between such loads, as logarithms, and the point of the last trial.
    steps: [T; 2],
    last: Option<Point<T>>,
    /// Reason why a load is too large or too small, if it is not the quantity.
    fault: Option<ContactError<T>>,
}

/// Finds the contact with a value of the quantity of this name.
pub(super) fn find<T: Real>(
    contact: &Contact<'_, T>,
    quantity: &dyn Quantity<T>,
    asked: (&'static str, T),
    work: &mut Work<'_, T>,
) -> Fallible<T, ContactState<T>> {
    find_of(contact, None, quantity, asked, work).map(|(found, _)| found)
}

/// Finds the contact of bodies with a kernel, if any, and returns it with the bent bodies.
pub(super) fn find_of<'b, T: Real>(
    contact: &Contact<'b, T>,
    kernel: Option<&Kernel<'b, T>>,
    quantity: &dyn Quantity<T>,
    (name, wanted): (&'static str, T),
    work: &mut Work<'_, T>,
) -> Fallible<T, (ContactState<T>, Gap<'b, T>)> {
    check_positive(name, wanted)?;
    let (follows, low, high, last, fault) = (quantity.may_fall(contact), None, None, None, None);
    let steps = [T::one() / T::zero(); 2];
    let gap = contact.gap.clone();
    let mut search = ByLoad {
        contact,
        kernel,
        gap,
        quantity,
        name,
        wanted,
        work,
        follows,
        low,
        high,
        steps,
        last,
        fault,
    };
    let found = search.run()?;
    Ok((found, search.gap))
}

impl<T: Real> ByLoad<'_, '_, '_, T> {
    fn run(&mut self) -> Fallible<T, ContactState<T>> {
        let mut first = self.quantity.first_load(self)?;
        first *= if self.follows { T::of(FIRST_TOUCH) } else { T::one() };
        let mut load = first;
        // Number of steps left without a check, once the next one squares the error.
        let mut last_steps: Option<usize> = None;
        for _ in 0..MAX_LOADS {
            // So small a number has no digits left.
            if !load.is_finite() || (load * T::epsilon()).is_zero() {
                return Err(SolveError::Overflow { interval: self.whole() }.into());
            }
            let (found, at) = match self.at(load) {
                Ok((found, at)) => {
                    let step = (self.wanted - at.value) / at.rate.component(0);
                    let size = step.abs() / load;
                    let is_near = size <= T::epsilon().sqrt();
                    let off = (self.wanted - at.value).abs();
                    let least = T::of(2.0) * T::epsilon() * self.wanted;
                    let is_there = T::DERIVATIVE_ORDER == 0 && off <= least;
                    last_steps = last_steps.filter(|_| is_near);
                    if last_steps == Some(0) || is_there {
                        let error = found.error.map(|error| error + size);
                        return Ok(ContactState { error, ..found });
                    }
                    // The rate of a peak is known to only half the digits.
                    let all = is_near.then_some(2 * T::DERIVATIVE_ORDER);
                    last_steps = last_steps.map(|left| left - 1).or(all);
                    if last_steps.is_some() {
                        load = at.load + step;
                        continue;
                    }
                    self.fault = self.fault.take().filter(|_| at.value < self.wanted);
                    (Some(found), at)
                }
                Err(error) => match self.bound(&error, load)? {
                    ControlFlow::Break(widest) => return Ok(widest),
                    ControlFlow::Continue(at) => {
                        // The capacity of the bodies is a better estimate than the first guess.
                        first = if at.load < load { at.load } else { first };
                        self.fault = Some(error);
                        (None, at)
                    }
                },
            };
            *(if at.value < self.wanted { &mut self.low } else { &mut self.high }) = Some(at);
            load = self.inside(self.next(at), at.load);
            self.last = Some(at);
            let is_closed = match (self.low, self.high) {
                (Some(low), Some(high)) if self.is_out_of_reach(low, high) => true,
                (Some(low), Some(high)) => high.load <= low.load * (T::one() + T::epsilon().sqrt()),
                _ => load > first * T::of(MAX_FACTOR) || load < first / T::of(MAX_FACTOR),
            };
            if is_closed {
                return found.ok_or_else(|| self.none()).and_then(|found| self.across(found));
            }
        }
        let residual = self.high.map_or(self.wanted, |high| high.value - self.wanted);
        let source = SearchError::NotConverged { x: load, residual };
        Err(SolveError::LimitSearch { best: self.hull(), source }.into())
    }

    /// Returns a contact found between loads that have closed in, if the quantity does not jump
    /// there. (Next to corners the rounding of x changes the approach by some √ε.)
    fn across(&mut self, found: ContactState<T>) -> Fallible<T, ContactState<T>> {
        let ends = self.low.zip(self.high);
        let jump = ends.map(|(low, high)| (high.value - low.value) / self.wanted);
        let jump = jump.filter(|&jump| jump <= T::epsilon().cbrt()).ok_or_else(|| self.none())?;
        Ok(ContactState { error: found.error.map(|error| error + jump), ..found })
    }

    /// Returns this load, or one between the known ones if it is known to be too small or too
    /// large, or if the steps from the `last` load do not become shorter.
    fn inside(&mut self, load: T, last: T) -> T {
        let step = T::of(MAX_STEP);
        match [self.low, self.high].map(|end| end.map(|end| end.load)) {
            [Some(low), Some(high)] => {
                let length = |load: T| (load / last).ln().abs();
                let is_short = length(load) < T::of(0.5) * self.steps[0];
                let is_inside = load > low && load < high;
                let load = if is_inside && is_short { load } else { low.sqrt() * high.sqrt() };
                self.steps = [self.steps[1], length(load)];
                load
            }
            [Some(low), None] if load <= low => low * step,
            [None, Some(high)] if load >= high || self.follows => high / step,
            _ => load,
        }
    }

    /// Returns the load for a request by the survey of the bodies. If that is zero, or a start or
    /// convexity make Hertz good enough, the load is that of a contact as wide as the start.
    fn surveyed(&mut self, asked: Asked<T>, or_hertz: bool) -> Fallible<T, T> {
        let (Contact { gap, kappa, start, .. }, work) = (self.contact, &mut *self.work);
        let ([left, right], start) = (gap.range(), work.workspace.hull().or(*start));
        let half_width = start.map_or(T::of(1.0 / 64.0) * (right - left), |on| on.half_width());
        let hertz = T::frac_pi_2() * self.wanted * half_width;
        if or_hertz && (start.is_some() || gap.is_convex()) {
            return Ok(hertz);
        }
        let load = *kappa * work.workspace.about(gap, asked, work.cost)?;
        Ok(if load > T::zero() { load } else { hertz })
    }

    /// Returns a contact found, with all data of its pressure.
    fn solved<'f>(&'f self, found: &'f ContactState<T>) -> Solved<'f, T> {
        let (gap, kappa) = (&self.gap, self.contact.kappa);
        Solved { gap, integrator: &*self.work.integrator, kappa, found }
    }

    /// Finds the contact under a load, and the quantity: if that is followed, under a load up to
    /// which it rises.
    fn at(&mut self, mut load: T) -> Fallible<T, (ContactState<T>, Point<T>)> {
        loop {
            let found = self.solve(self.contact.under(load)?)?;
            let [value, rate, doubt] = self.quantity.at(&found, self)?;
            let half_width = found.interval.half_width();
            let at = Point { load, value, rate, half_width };
            let low = self.low.filter(|low| self.follows && low.load < load);
            let is_close = |low: &Point<T>| load <= low.load * T::of(LEAST_STEP);
            let mean = |low: Point<T>| (value - low.value) / (load - low.load);
            let least = low.filter(is_close).map_or(rate, |low| rate.min(mean(low)));
            if self.follows && !(least > T::zero() && rate.is_finite()) {
                return Err(SolveError::Falls { quantity: self.name, load, rate: least }.into());
            }
            let Some(low) = low.filter(|low| !is_close(low) && !low.rises_to(&at)) else {
                // The half-width follows from the peak, and is known no better.
                let error = found.error.map(|error| error + doubt);
                return Ok((ContactState { error, ..found }, at));
            };
            load = low.load.sqrt() * load.sqrt();
        }
    }

    /// Finds the contacts under some conditions, ready for their pressures.
    fn solve(&mut self, conditions: Conditions<T>) -> Fallible<T, ContactState<T>> {
        let Self { contact, work, .. } = self;
        if let Some(kernel) = self.kernel {
            let control = Control::Load(conditions.load());
            let (found, gap) = bending::find(contact, kernel, control, work)?;
            self.gap = gap;
            return Ok(found);
        }
        work.workspace.report = Report::new();
        let found = topology::find(contact, conditions, work)?;
        work.keep(&contact.gap, found.interval)?;
        Ok(found)
    }

    /// Returns the next load by Newton's method for the logarithms, within its trusted range. If
    /// the step is shorter than the last one, it follows the cubic through both points, unless the
    /// quantity may fall between them.
    fn next(&self, at: Point<T>) -> T {
        // The exponent of a round body, if the rate is not known.
        let power = at.power().unwrap_or(T::of(2.0));
        let ahead = (self.wanted / at.value).ln();
        let last = self.last.filter(|_| !self.follows && power.is_finite());
        let last =
            last.and_then(|last| Some((last, last.power().filter(|power| power.is_finite())?)));
        let bend = last.map_or(T::zero(), |(last, other)| {
            let [back, fell] = [last.value / at.value, last.load / at.load].map(|by| by.ln());
            let (mean, share) = (fell / back, ahead / back);
            let cubic = power + other - mean - mean;
            let bend = (mean - power - cubic + share * cubic) * share * ahead;
            if share.abs() < T::one() { bend } else { T::zero() }
        });
        let step = (power * ahead + bend).exp();
        let largest = T::of(MAX_STEP);
        let step = if step.is_finite() && at.value > T::zero() { step } else { largest };
        at.load.component(0) * step.component(0).min(largest).max(largest.recip())
    }

    /// Returns the conclusion from a failed trial on its load.
    fn bound(&mut self, error: &ContactError<T>, load: T) -> Bound<T> {
        use SolveError::{
            Bending, CompleteContact, DomainTooShort, Falls, LiftsOff, NoEquilibrium,
            NoFirstContact, Overlap, Tension,
        };
        let (wanted, infinite) = (self.wanted, T::one() / T::zero());
        let nan = T::of(f64::NAN);
        let unknown = |load: T, value: T| Point { load, value, rate: nan, half_width: nan };
        if self.kernel.is_some() {
            // What half-planes, or bodies with the bend of another load, bear is no bound.
            match *error {
                ContactError::Solve(Bending { .. } | DomainTooShort { .. })
                | ContactError::Input(InputError::LayerTooThin { .. }) => {
                    return Ok(ControlFlow::Continue(unknown(load, infinite)));
                }
                // Nearer to complete contact nothing is solved.
                ContactError::Solve(CompleteContact { complete, .. })
                    if self.low.is_none_or(|low| low.load < T::of(LARGEST_SHARE) * complete) =>
                {
                    return Ok(ControlFlow::Continue(unknown(load.min(complete), infinite)));
                }
                _ => {}
            }
        }
        Ok(ControlFlow::Continue(match *error {
            ContactError::Solve(DomainTooShort { end, carried, half_width, peak, .. }) => {
                let widest = Capacity { half_width, end, load: carried, peak };
                // A quantity that may fall may have had the value before.
                let known = self.quantity.of_widest(wanted, &widest);
                let known = known.filter(|_| !self.follows);
                let (value, too_large) = known.unwrap_or((infinite, error.clone()));
                let is_widest = (value - wanted).abs() <= T::of(8.0) * T::epsilon() * wanted;
                if is_widest {
                    let given = Given::HalfWidth(half_width);
                    let conditions = Conditions { given, ..self.contact.under(carried)? };
                    // Where corners hold the contacts, smaller loads have the same width.
                    if let Ok(found) = self.solve(conditions) {
                        return Ok(ControlFlow::Break(found));
                    }
                }
                // Bodies that touch first at an end bear nothing.
                if value < wanted && !is_widest || carried.is_zero() {
                    return Err(too_large);
                }
                unknown(carried.min(load), value.max(wanted))
            }
            ContactError::Solve(Falls { load, .. }) => unknown(load, infinite),
            // Parallel bodies touch all along under any load.
            ContactError::Solve(NoFirstContact { slope, .. })
                if slope.iter().all(|slope| slope.is_zero()) =>
            {
                return Err(error.clone());
            }
            // Far too large a first load fails anyhow; bodies bear a smaller one.
            ContactError::Solve(Tension { .. } | Overlap { .. })
                if self.last.is_none() && self.contact.edges.are_sought() =>
            {
                unknown(load, infinite)
            }
            ContactError::Solve(NoEquilibrium { .. } | NoFirstContact { .. } | LiftsOff { .. }) => {
                let is_large = self.is_too_large(load, error);
                unknown(load, if is_large { infinite } else { T::zero() })
            }
            _ => return Err(error.clone()),
        }))
    }

    /// Tells whether a load that finds nothing is too large. A small one is not held by a corner,
    /// does not close a hollow, or leaves no height to tell; unless a smaller one has been borne,
    /// or it is the first, and heights tell it.
    fn is_too_large(&self, load: T, error: &ContactError<T>) -> bool {
        let Contact { gap, kappa, edges, .. } = self.contact;
        let look = self.work.workspace.survey_of(gap);
        let is_told = look.is_none_or(|look| load >= *kappa * look.doubt_at(look.lowest));
        let is_borne = |at: &Point<T>| at.value > T::zero() && at.load <= load;
        let is_nothing = matches!(error, ContactError::Solve(SolveError::NoEquilibrium { .. }));
        let is_first = is_nothing && self.last.is_none() && edges.are_sought();
        is_told && (is_first || self.low.iter().chain(&self.high).any(is_borne))
    }

    /// Returns the error for a value that occurs under no load.
    fn none(&mut self) -> ContactError<T> {
        let (wanted, near, half_width) =
            (self.wanted, self.whole().left, self.whole().half_width());
        let own = self.quantity.none(self).or(self.fault.take());
        own.unwrap_or_else(|| match self.high {
            Some(Point { load, value: above, .. }) => {
                let below = self.low.map_or(T::zero(), |low| low.value);
                SolveError::InJump { wanted, load, below, above }.into()
            }
            None => SolveError::NoEquilibrium { half_width, near }.into(),
        })
    }

    /// Tells whether bodies with a kernel bear less than the value takes, by its rate under nearly
    /// all that they bear.
    fn is_out_of_reach(&self, low: Point<T>, high: Point<T>) -> bool {
        let ratio = high.load / low.load;
        let is_close = self.kernel.is_some() && ratio <= T::of(NEARLY_ALL);
        is_close && !high.value.is_finite() && self.next(low) > ratio * high.load
    }

    /// Returns the widest contacts found, and the value there, if wider ones leave the bodies.
    fn widest(&self) -> Option<(Capacity<T>, T)> {
        let Point { load, value, half_width, .. } = self.low.filter(|low| low.value > T::zero())?;
        let Some(ContactError::Solve(SolveError::DomainTooShort { end, .. })) = self.fault else {
            return None;
        };
        Some((Capacity { half_width, end, load, peak: T::of(f64::NAN) }, value))
    }

    /// Returns the interval of the contacts found last, or that of the bodies.
    fn hull(&self) -> Interval<T> {
        self.work.workspace.hull().unwrap_or(self.whole())
    }

    fn whole(&self) -> Interval<T> {
        let Ends { left, right } = self.contact.ends();
        Interval { left, right }
    }
}
