//! The contact under a load that acts at a given place: the bodies turn until it does.
//!
//! A contact in one interval is found by Newton's method on its limits, from which the tilt has been
//! [eliminated](super::newton). Several contacts, and one that is not found like this, are found through
//! contacts of bodies turned by trial values of the tilt; where a trial has several contacts, Newton's method
//! takes over with all limits and the tilt as unknowns. The load then acts the further to the left the
//! more body 2 is turned counter-clockwise: without adhesion the place x̄ falls with τ, as a derivative of a
//! convex energy does. So τ is the one root of a falling function. A change of τ samples nothing.

use super::edges::{Conditions, Edge, Given};
use super::several::Outcome;
use super::single::Single;
use super::topology::{self, Sought, Workspace};
use super::{Contact, Found};
use crate::gap::Cost;
use crate::quadrature::{Engine, panels};
use crate::solution::{Start, Verdict};
use crate::{ContactError, Interval, Real};

/// Contacts of turned bodies before the search is given up.
const MOST_TRIALS: usize = 100;

/// Of these so many may fail: beyond some tilt the contact leaves the bodies.
const MOST_FAILURES: usize = 24;

/// Of several contacts, attempts to find the tilt with all limits.
const MOST_TOGETHER: usize = 8;

/// By how much one step may be longer than the one before.
const MOST_GROWTH: f64 = 8.0;

/// For derivatives: steps with a slope from a difference, and the tilt for that as a share of `F/(κ L)`.
const MORE_STEPS: usize = 6;
const SHARE: f64 = 1e-4;

/// The line in which a load acts.
#[derive(Clone, Copy)]
pub(super) struct Line<T> {
    load: T,
    at: T,
    /// How far `at` may be off by rounding.
    rounding: T,
}

impl<T: Real> Line<T> {
    pub fn of_moment(load: T, moment: T, about: T) -> Result<Self, ContactError<T>> {
        if let Some(&value) = [moment, about].iter().find(|value| !value.is_finite()) {
            return Err(ContactError::Moment { value });
        }
        let arm = moment / load;
        let rounding = T::epsilon() * (about.abs() + arm.abs());
        Ok(Self { rounding, ..Self::through(load, about + arm)? })
    }

    pub fn through(load: T, at: T) -> Result<Self, ContactError<T>> {
        if !(load.is_finite() && load > T::zero()) {
            return Err(ContactError::Load { load });
        }
        if !at.is_finite() {
            return Err(ContactError::Moment { value: at });
        }
        Ok(Self { load, at, rounding: T::epsilon() * at.abs() })
    }
}

/// Finds the contact under a load in a given line, with the tilt of its bodies.
pub(super) fn find<T: Real>(
    contact: &Contact<'_, T>,
    line: Line<T>,
    engine: &mut dyn Engine<T>,
    workspace: &mut Workspace<T>,
    cost: &mut Cost,
) -> Result<Found<T>, ContactError<T>> {
    let edges = contact.checked_edges()?;
    let refuse = |why| Err(ContactError::NoTilt { why });
    if edges.iter().any(|edge| matches!(edge, Edge::Adhesive(_))) {
        return refuse("an edge is Adhesive");
    }
    if contact.search.is_some() {
        return refuse("a strategy of one's own adjusts the limits");
    }
    if !panels::is_panels(engine) {
        return refuse("the quadrature is another");
    }
    let Line { load, at, rounding } = line;
    let conditions = Conditions { kappa: contact.kappa, edges, given: Given::Centre { load, at } };
    let given = edges.iter().all(|edge| matches!(edge, Edge::Fixed(_)));
    let ends = contact.ends();
    // All that presses lies on one side of it then.
    if !(given || at > ends[0] && at < ends[1]) {
        return Err(ContactError::OutsideBodies { x: at, range: ends });
    }
    let mut first = None;
    if workspace.last().len() <= 1 {
        let last = workspace.last().first().copied();
        let start = match (last, contact.start) {
            (Some(_), _) => Start::Last,
            (None, Some(_)) => Start::Given,
            (None, None) => Start::LineOfLoad,
        };
        let (look, bears) = (None, None);
        let found = {
            let start = contact.start;
            Single { contact, conditions, start, look, engine, cost, bears }.find(last)
        };
        match found {
            Ok(mut found) => {
                let doubt = rounding / found.interval.half_width();
                found.error = found.error.map(|error| error + doubt);
                let fault = if given || contact.single_interval {
                    workspace.report.add(start, Verdict::Unchecked);
                    None
                } else {
                    let turned = turned(contact, found.tilt);
                    let fault = topology::fault(&turned, &found, engine, workspace, cost)?;
                    let verdict = fault.as_ref().map_or(Verdict::Passed, Verdict::of);
                    workspace.report.add(start, verdict);
                    fault
                };
                if fault.is_none() {
                    return Ok(found);
                }
                first = Some((found.tilt.part(0), found.interval.plain()));
            }
            Err(error) if given || !may_turn(&error) => return Err(error),
            Err(_) => workspace.report.add(start, Verdict::NotFound),
        }
    }
    let (warm, mut start) = (workspace.last().len() > 1, T::zero());
    if let Some((tilt, on)) = first {
        workspace.keep(&[on]);
        start = tilt;
    } else if warm {
        start = workspace.newton().tilt.part(0);
    }
    let mut trials = Trials { contact, line, engine, workspace, cost };
    if let Some(found) = if warm { trials.together(start)? } else { None } {
        return Ok(found);
    }
    trials.find(start)
}

/// Whether a search may fail like this under one tilt, and not under another.
fn may_turn<T: Real>(error: &ContactError<T>) -> bool {
    let fails = matches!(error, ContactError::Tension { .. } | ContactError::Overlap { .. });
    fails || error.may_be_several() || matches!(error, ContactError::LimitSearch { .. })
}

fn turned<'b, T: Real>(contact: &Contact<'b, T>, tilt: T) -> Contact<'b, T> {
    Contact { gap: contact.gap.tilted(tilt), ..contact.clone() }
}

/// Contacts of bodies turned by trial values of the tilt.
struct Trials<'s, 'b, T: Real> {
    contact: &'s Contact<'b, T>,
    line: Line<T>,
    engine: &'s mut dyn Engine<T>,
    workspace: &'s mut Workspace<T>,
    cost: &'s mut Cost,
}

/// A contact of turned bodies, and how far to the right of the given place the load acts.
#[derive(Clone, Copy)]
struct Trial<T> {
    found: Found<T>,
    off: T,
}

impl<T: Real> Trial<T> {
    fn tilt(&self) -> T {
        self.found.tilt
    }
}

impl<T: Real> Trials<'_, '_, T> {
    fn at(&mut self, tilt: T) -> Result<Trial<T>, ContactError<T>> {
        let turned = turned(self.contact, tilt);
        let Line { load, at, .. } = self.line;
        let sought = Sought::By(turned.under(load)?);
        let found = topology::find(&turned, sought, self.engine, self.workspace, self.cost)?;
        let (on, by_load) = (found.interval, turned.kappa / load);
        let off = match panels::several(self.engine) {
            Some(several) => {
                self.workspace.keep(several.contacts());
                by_load * several.moment(at, load / turned.kappa)
            }
            None => {
                self.workspace.keep(&[on]);
                let m = self.engine.moments(&turned.gap, on)?;
                let (half, half_width) = (T::of(0.5), on.half_width());
                let second = m.second.unwrap_or(m.mean);
                on.centre() - at + half * by_load * half_width * half_width * (second - m.mean)
            }
        };
        if !off.is_finite() {
            return Err(ContactError::Overflow { interval: on });
        }
        Ok(Trial { found: Found { tilt, ..found }, off })
    }

    /// All limits of several contacts and the tilt at once, from the contacts last found; `None` where that fails.
    fn together(&mut self, tilt: T) -> Result<Option<Found<T>>, ContactError<T>> {
        let Line { load, at, rounding } = self.line;
        let (contact, ends) = (self.contact, self.contact.ends());
        let Some(several) = panels::several_mut(self.engine) else { return Ok(None) };
        let (corners, kappa) = (several.corners(), contact.kappa);
        let newton = self.workspace.start_from_last(tilt);
        let outcome =
            newton.settle(several, &contact.gap, load / kappa, corners, ends, Some(at))?;
        if outcome != Outcome::Found {
            return Ok(None);
        }
        let found = newton.found(several, kappa, load, corners, ends);
        let narrowest = |least: T, on: &Interval<T>| least.min(on.half_width());
        let narrowest = newton.on.iter().fold(found.interval.half_width(), narrowest);
        let error = found.error.map(|error| error + rounding / narrowest);
        let found = Found { tilt: newton.tilt, error, ..found };
        let turned = turned(contact, found.tilt);
        // A corner that pulls does not hold the contact.
        let pulls = |side: usize| corners[side] && found.strengths[side] < T::zero();
        let is_found = !pulls(0)
            && !pulls(1)
            && topology::fault(&turned, &found, self.engine, self.workspace, self.cost)?.is_none();
        if is_found {
            self.workspace.report.add(Start::Trial, Verdict::Passed);
        }
        Ok(is_found.then_some(found))
    }

    /// About how the place where the load acts moves with the tilt: exactly, where both limits are given.
    fn rate(&self, on: Interval<T>) -> T {
        let half_width = on.half_width().part(0);
        let stiffness = (self.contact.kappa * half_width).part(0);
        -T::of(0.5) * half_width * stiffness / self.line.load.part(0)
    }

    fn find(&mut self, start: T) -> Result<Found<T>, ContactError<T>> {
        let (zero, half) = (T::zero(), T::of(0.5));
        let mut tilt = start;
        // The nearest to the root on either side: the load acts too far to the right, or to the left.
        let mut sides: [Option<Trial<T>>; 2] = [None; 2];
        let mut best: Option<Trial<T>> = None;
        let mut before: Option<Trial<T>> = None;
        let mut together = 0;
        let (mut failures, mut poor, mut last_step) = (0, 0, None::<T>);
        // A tilt under which there is no contact, beyond the best.
        let mut wall: Option<T> = None;
        for _ in 0..MOST_TRIALS {
            let trial = match self.at(tilt) {
                Ok(trial) => trial,
                Err(error) if may_turn(&error) => {
                    failures += 1;
                    let Some(good) = best else {
                        if failures > 1 || tilt.is_zero() {
                            return Err(error);
                        }
                        self.workspace.forget();
                        tilt = zero;
                        continue;
                    };
                    wall = Some(tilt);
                    let next = half * (good.tilt() + tilt);
                    if failures > MOST_FAILURES || next == tilt || next == good.tilt() {
                        break;
                    }
                    last_step = Some((next - good.tilt()).abs());
                    tilt = next;
                    continue;
                }
                Err(error) => return Err(error),
            };
            if panels::several(self.engine).is_some() && together < MOST_TOGETHER {
                together += 1;
                if let Some(found) = self.together(tilt)? {
                    return Ok(found);
                }
            }
            let (on, off) = (trial.found.interval, trial.off);
            let known = best.map(|best| best.off.abs());
            let better = known.is_none_or(|known| off.abs() < known);
            poor = if known.is_none_or(|known| off.abs() < half * known) { 0 } else { poor + 1 };
            if better {
                best = Some(trial);
            }
            let close = off.abs() <= T::epsilon().sqrt() * on.half_width();
            let done = off.abs() <= self.floor(on) || close && poor > 1;
            sides[usize::from(off < zero)] = Some(trial);
            // By the chord, as long as that falls.
            let chord = before.map(|before| (off - before.off) / (tilt - before.tilt()));
            let rate = chord.filter(|&rate| rate < zero).unwrap_or_else(|| self.rate(on));
            let mut step = -off / rate;
            if let Some(last) = last_step.filter(|_| sides.iter().any(Option::is_none)) {
                let most = T::of(MOST_GROWTH) * last;
                step = step.max(-most).min(most);
            }
            let mut next = tilt + step;
            if let [Some(low), Some(high)] = sides {
                let [from, to] = [low.tilt(), high.tilt()];
                if poor > 1 || !(next > from && next < to) {
                    next = half * (from + to);
                    poor = 0;
                }
            }
            if let Some(wall) = wall.filter(|&wall| (wall - tilt) * (wall - next) <= zero) {
                next = half * (tilt + wall);
            }
            if done || next == tilt || before.is_some_and(|before| next == before.tilt()) {
                break;
            }
            last_step = Some((next - tilt).abs());
            (before, tilt) = (Some(trial), next);
        }
        let Some(best) = best else {
            let ([left, right], near) = (self.contact.ends(), self.line.at);
            let half_width = Interval { left, right }.half_width();
            return Err(ContactError::NoBalance { half_width, near });
        };
        let found = &best.found;
        let met = best.off.abs() <= T::epsilon().sqrt() * found.interval.half_width();
        if !met {
            let Line { load, at, .. } = self.line;
            let (reached, tilt, ends) = (at + best.off, best.tilt(), self.contact.ends());
            return Err(ContactError::TooTilted { load, at, reached, tilt, ends });
        }
        self.further(best)
    }

    /// How well the place where the load acts can be known.
    fn floor(&self, on: Interval<T>) -> T {
        T::of(4.0) * T::epsilon() * (on.half_width() + on.left.abs().max(on.right.abs()))
    }

    /// The contact of the best trial, once more if it was not the last; and for derivatives, a few steps with
    /// a fixed slope, each of which gains as many digits as that has.
    fn further(&mut self, best: Trial<T>) -> Result<Found<T>, ContactError<T>> {
        let on = best.found.interval;
        let mut trial = self.at(best.tilt())?;
        if T::MORE_STEPS > 0 {
            let by_tilt = self.line.load / (self.contact.kappa * on.half_width());
            let aside = T::of(SHARE) * by_tilt.part(0);
            let there = self.at(best.tilt().part(0) + aside)?;
            let rate = (there.off.part(0) - trial.off.part(0)) / aside;
            for _ in 0..MORE_STEPS {
                trial = self.at(trial.tilt() - trial.off / rate)?;
            }
        }
        let Trial { mut found, off } = trial;
        let doubt = (off.abs() + self.line.rounding) / found.interval.half_width();
        found.error = found.error.map(|error| error + doubt);
        Ok(found)
    }
}
