//! Newton's method on one contact: both limits, and its load if sought.
//!
//! A step is halved if the next one by the same Jacobian would be longer (the natural monotonicity
//! test: P. Deuflhard, *Newton Methods for Nonlinear Problems*, 2004, §3.3), as across a jump of
//! the slope, whose two sides differ in stiffness; and where the limits do not act on the slope, as
//! on a flat. A contact that carries too little, and would carry less if wider, as under adhesion,
//! is widened until it grows with its load. A step that would leave the bodies goes half the way to
//! their end.

use super::super::edges::Conditions;
use super::super::single_contact::MAX_DOUBT;
use super::linearised::{Linearised, Step, doubtful, moved};
use super::{Progress, Stop, crosses_breakpoint};
use crate::quadrature::{Integrator, Moments};
use crate::{Ends, Fallible, Gap, Interval, Real, Side};

/// Trials before the search is given up: for an initial guess, and in full. An initial guess that
/// takes long has no contact.
const MAX_TRIALS: [usize; 2] = [16, 200];

/// Largest number of steps beyond an end of the bodies: in an initial guess, before another is
/// made; in full, before the capacity is computed. (Each goes half the way: a contact may come as
/// close to an end as 1e-7 of its width.)
const MAX_AT_END: [usize; 2] = [2, 24];

/// Largest number of steps in full that are longer than half of the half-width.
const MAX_LONG: usize = 8;

/// Least share of a step that is taken.
const LEAST_STEP_SHARE: f64 = 1e-12;

/// Longest last step of a guess, in half-widths.
const MAX_GUESS_STEP: f64 = 0.03;

/// Share of its start below which a guess is too narrow, and is sought again in a closer span.
const NARROW: f64 = 1e-6;

/// A contact that meets its conditions.
#[derive(Clone, Copy)]
pub(in super::super) struct Converged<T> {
    pub on: Interval<T>,
    pub load: T,
    /// Estimated error of the limits relative to the half-width.
    pub error: T,
    /// Load that corresponds to this error.
    pub load_error: T,
}

/// Limits found, or the reason for none.
pub(in super::super) type Verdict<T> = Result<Converged<T>, Stop<T>>;

/// Accuracy to which a contact has to meet its conditions.
#[derive(Clone, Copy, PartialEq)]
pub(in super::super) enum Effort {
    /// A few hundredths of the width; the search also ends once the contact is much narrower than
    /// its start.
    Guess,
    /// Rounding.
    Full,
}

/// Search for the limits of one contact.
pub(in super::super) struct NewtonSingle<'s, 'b, T: Real> {
    pub integrator: &'s mut dyn Integrator<T>,
    pub gap: &'s Gap<'b, T>,
    pub conditions: &'s Conditions<T>,
    pub effort: Effort,
}

/// Last trial of a search, and the step that led to it.
struct Trial<T: Real> {
    /// Interval from which the search started.
    start: Interval<T>,
    on: Interval<T>,
    load: T,
    last: Option<Step<T>>,
    progress: Progress<T>,
    /// Numbers of steps so far that led beyond an end of the bodies, and of long ones.
    at_end: usize,
    long: usize,
}

impl<T: Real> NewtonSingle<'_, '_, T> {
    /// Finds the limits from a start nearby.
    pub fn converge(&mut self, start: Interval<T>) -> Fallible<T, Verdict<T>> {
        let (conditions, progress) = (self.conditions, Progress::new());
        let (on, load) = (conditions.with_given(start, self.gap.range()), conditions.load());
        let mut trial = Trial { start, on, load, last: None, progress, at_end: 0, long: 0 };
        for _ in 0..MAX_TRIALS[usize::from(self.effort == Effort::Full)] {
            let half_width = trial.on.half_width();
            if !(half_width > T::zero() && half_width.is_finite()) {
                break;
            }
            let m = self.integrator.moments(self.gap, trial.on)?;
            let Some(system) = Linearised::new(conditions, trial.on, trial.load, &m) else { break };
            let step = system.step(trial.on, trial.load, conditions.kappa * half_width * m.m1);
            if self.shortens(&mut trial, &system, step.as_ref()) {
                continue;
            }
            let from = trial.on;
            let ended = match step.filter(|_| self.leads(&system)) {
                Some(step) => {
                    (trial.on, trial.load) = step.end(conditions);
                    trial.last = Some(step);
                    match self.limit(&mut trial, from, step.size()) {
                        Ok(true) => None,
                        Ok(false) => self.accept(&mut trial, &system, &step, &m)?,
                        Err(verdict) => Some(verdict),
                    }
                }
                None => self.widen(&mut trial, &system).err().map(Err),
            };
            if let Some(verdict) = ended {
                return Ok(verdict);
            }
            if trial.long > MAX_LONG {
                break;
            }
        }
        Ok(Err(Stop::Failed))
    }

    /// Returns the largest number of steps beyond an end of the bodies.
    fn most_at_end(&self) -> usize {
        MAX_AT_END[usize::from(self.effort == Effort::Full)]
    }

    /// Tells whether a step leads to the contact sought.
    fn leads(&self, system: &Linearised<T>) -> bool {
        !system.is_open() || system.is_stable(self.conditions)
    }

    /// Halves the last step if the next one shows that it led too far.
    fn shortens(&self, trial: &mut Trial<T>, next: &Linearised<T>, step: Option<&Step<T>>) -> bool {
        let Some(last) = &mut trial.last else { return false };
        if last.share <= T::of(LEAST_STEP_SHARE) || step.is_some() && !last.grew_to(next, trial.on)
        {
            return false;
        }
        last.share *= T::of(0.5);
        (trial.on, trial.load) = last.end(self.conditions);
        trial.on = self.before_ends(last.from, trial.on);
        trial.progress.forget();
        true
    }

    /// Widens a contact that carries less than the load, and would carry still less if wider: a
    /// much wider one grows with its load.
    fn widen(&self, trial: &mut Trial<T>, system: &Linearised<T>) -> Result<(), Stop<T>> {
        let one = T::one();
        let wider = moved(self.conditions, trial.on, system.lean(), [-one, one], one);
        let next = self.before_ends(trial.on, wider);
        trial.at_end += usize::from(next != wider);
        if trial.at_end > self.most_at_end() {
            return Err(Stop::Beyond(next));
        }
        if !system.is_open() || next.is_same(&trial.on) {
            return Err(Stop::Failed);
        }
        (trial.on, trial.last) = (next, None);
        trial.progress.forget();
        Ok(())
    }

    /// Keeps a step within the bodies; tells whether it was cut. A guess much narrower than its
    /// start ends the search.
    fn limit(&self, trial: &mut Trial<T>, from: Interval<T>, size: T) -> Result<bool, Verdict<T>> {
        let Trial { on, load, .. } = *trial;
        if self.effort == Effort::Guess
            && on.half_width() < T::of(NARROW) * trial.start.half_width()
        {
            return Err(Ok(Converged { on, load, error: size.max(T::one()), load_error: size }));
        }
        let range = self.gap.range();
        if on.left >= range[0] && on.right <= range[1] {
            return Ok(false);
        }
        trial.on = rounded_within(on, range);
        let next = self.before_ends(from, trial.on);
        if next == trial.on {
            return Ok(false);
        }
        trial.at_end += 1;
        if trial.at_end > self.most_at_end() || next.is_same(&from) {
            return Err(Err(Stop::Beyond(next)));
        }
        trial.on = next;
        trial.progress.forget();
        Ok(true)
    }

    /// Ends the search if the last step was short enough.
    fn accept(
        &mut self,
        trial: &mut Trial<T>,
        system: &Linearised<T>,
        step: &Step<T>,
        m: &Moments<T>,
    ) -> Fallible<T, Option<Verdict<T>>> {
        let (on, load, size) = (trial.on, trial.load, step.size());
        let tilt = || self.conditions.tilt(step.from, m);
        let sizes = step.limits.map(|step| step.abs());
        if self.effort == Effort::Guess {
            let guessed = Converged { on, load, error: size, load_error: size };
            trial.progress.note(sizes);
            return Ok((size <= T::of(MAX_GUESS_STEP)).then(|| {
                if self.is_sound(system, on, tilt()) { Ok(guessed) } else { Err(Stop::Failed) }
            }));
        }
        let judged = trial.progress.judge(sizes);
        // A step across a kink is as much too long as the one before it was.
        let crossed = judged.is_done
            && size > T::of(4.0) * T::epsilon()
            && crosses_breakpoint(self.gap, step.from, on);
        let done = judged.is_done && !crossed;
        if done || judged.is_stalled {
            let noise = system.error(&step.inverse, m);
            let rounding = [on.left, on.right].map(|x| T::epsilon() * x.abs() / on.half_width());
            let least = noise[0].max(noise[1]) + rounding[0].max(rounding[1]);
            let stalled =
                judged.is_stalled && size <= doubtful(least) && system.is_met(m, rounding);
            if done || stalled {
                if !self.is_sound(system, on, tilt()) || least > T::of(MAX_DOUBT) {
                    return Ok(Some(Err(Stop::Failed)));
                }
                let left_over = if stalled { sizes } else { judged.next };
                // The noise is known from a few coefficients only.
                let errors = std::array::from_fn(|i| {
                    T::of(4.0) * (noise[i] + rounding[i]) + T::of(0.5) * left_over[i]
                });
                let (load_error, error) = (system.force(errors), errors[0].max(errors[1]));
                let (on, load) = self.derivative_steps(on, load)?;
                return Ok(Some(Ok(Converged { on, load, error, load_error })));
            }
        }
        trial.progress.note(sizes);
        if crossed {
            trial.progress.forget();
        }
        // Each long step takes samples; so far off, the start was no guess.
        trial.long += usize::from(size > T::of(0.5));
        Ok(None)
    }

    /// Tells whether the bodies, turned, open at the free edges of a contact that grows with its
    /// load.
    fn is_sound(&self, system: &Linearised<T>, on: Interval<T>, tilt: T) -> bool {
        let edges = self.conditions.edges;
        let opens = |side: Side| {
            let outward = if side == Side::Left { -T::one() } else { T::one() };
            let slope = self.integrator.slope(on[side]);
            slope.is_none_or(|slope| (slope + tilt) * outward >= T::zero())
        };
        // Under adhesion the bodies need not open at the other edge, either.
        let open = edges.are_adhesive()
            || Side::BOTH.into_iter().all(|side| !edges[side].is_free() || opens(side));
        open && system.is_stable(self.conditions)
    }

    /// Takes steps beyond the convergence of the value: each makes one more derivative exact.
    fn derivative_steps(
        &mut self,
        mut on: Interval<T>,
        mut load: T,
    ) -> Fallible<T, (Interval<T>, T)> {
        let conditions = self.conditions;
        for _ in 0..T::DERIVATIVE_ORDER {
            let m = self.integrator.moments(self.gap, on)?;
            let Some(system) = Linearised::new(conditions, on, load, &m) else { break };
            let Some([left, right, force]) = system.last_step() else { break };
            load += force;
            on = moved(conditions, on, system.lean(), [left, right], T::one());
        }
        Ok((on, load))
    }

    /// Replaces a step that would leave the bodies by one that goes half the way to their end,
    /// where the slope may be infinite; cuts an interval that is still too wide.
    fn before_ends(&self, from: Interval<T>, to: Interval<T>) -> Interval<T> {
        let range = self.gap.range();
        if to.left >= range[0] && to.right <= range[1] {
            return to;
        }
        let half = T::of(0.5);
        let ends = [half * (from.left + range[0]), half * (from.right + range[1])];
        let Ends { left, right } = self.conditions.limits();
        let back = (to.right - ends[1]).max(T::zero());
        let on = (ends[0] - to.left).max(T::zero());
        Interval {
            left: left.unwrap_or((to.left - back).max(ends[0])),
            right: right.unwrap_or((to.right + on).min(ends[1])),
        }
    }
}

/// Puts a contact that fills the bodies, and was rounded beyond them, within them.
fn rounded_within<T: Real>(on: Interval<T>, range: [T; 2]) -> Interval<T> {
    let rounded = |x: T, end: T, beyond: T| {
        let rounding = T::of(8.0) * T::epsilon() * (end.abs() + on.half_width());
        if beyond > T::zero() && beyond <= rounding { end } else { x }
    };
    Interval {
        left: rounded(on.left, range[0], range[0] - on.left),
        right: rounded(on.right, range[1], on.right - range[1]),
    }
}
