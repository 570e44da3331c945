//! Search for the limits, one at a time.
//!
//! Two conditions, one at each edge, fix two unknowns. They are taken as a *balance* (their
//! difference, which decides where a contact of given width sits) inside a *load* (their sum, which
//! decides how wide it is). If the slope of the gap rises with x, both are monotone, each has one
//! root, and each is a problem of one unknown for any [`LimitSearch`]:
//!
//! ```text
//! outer:  half-width L        spread(L, u(L)) = 0
//! inner:  distance u          shift(L, u) = 0,     a = x₀ + u,  -b = x₀ + u - 2L
//!                                             or   -b = x₀ - u,  a = x₀ - u + 2L
//! ```
//!
//! The distance u belongs to the edge closer to `x₀`, which may be a millionth of the width away:
//! so u keeps its digits. `x₀` is a point of first contact, where the slope of the gap passes
//! through zero. Every contact contains it, so `u` and the half-width are positive lengths of the
//! contact's own size, and a relative tolerance means the same on either side and for any origin.
//!
//! Both searches get a narrow bracket: the inner one steps out from the place of the last width,
//! the outer one from the start, by factors for a round body.

mod centre;
mod derivatives;
mod width;

use super::Contact;
use super::edges::{Conditions, Given};
use super::equations::{Equations, Residual};
use super::first_contact::first_contact;
use crate::gap::{Cost, Gap, Sampler};
use crate::quadrature::Engine;
use crate::search::{Bracket, LimitSearch, try_find};
use crate::{ContactError, Ends, Fallible, Interval, Real, SolveError};
use centre::Centred;
use derivatives::differentiate;

/// Largest ratio of the width of the panels to that of a contact tried on them: a tip of the bodies
/// that is as much narrower would fall between the nodes.
const MAX_WIDTH_RATIO: f64 = 16.0;

/// Contacts tried side by side for one that is pulled away from the point of first contact. (A
/// parabola that is pulled at one edge presses at the other up to two half-widths away.)
const MAX_BESIDE: usize = 16;

/// Limits that meet the conditions at the edges.
pub(super) struct Nested<T> {
    pub on: Interval<T>,
    /// Estimated error of the limits relative to the half-width.
    pub error: T,
}

/// Finds the limits that meet the conditions, with or without a start.
pub(super) fn find<T: Real>(
    contact: &Contact<'_, T>,
    equations: Equations<T>,
    integrator: &mut Engine<T>,
    start: Option<Interval<T>>,
    cost: &mut Cost,
) -> Fallible<T, Nested<T>> {
    let gap = &contact.gap;
    let range = gap.range();
    if let Equations::Strength {
        conditions: Conditions { given: Given::HalfWidth(width), .. },
        ..
    } = equations
    {
        return place(contact, equations, integrator, width, start, cost);
    }
    equations.check(range)?;
    let origin = match equations.limits() {
        Ends { left: Some(given), .. } | Ends { right: Some(given), .. } => given,
        Ends { left: None, right: None } => {
            let mut sampler = Sampler::default();
            let first = first_contact(&mut sampler, gap, start);
            *cost += sampler.cost;
            first?
        }
    };
    let half_width = match (start, equations.limits()) {
        (Some(start), _) => start.half_width(),
        (None, Ends { left: Some(_), .. }) => T::of(0.125) * (range[1] - origin),
        (None, Ends { right: Some(_), .. }) => T::of(0.125) * (origin - range[0]),
        (None, _) => T::of(0.25) * (origin - range[0]).min(range[1] - origin),
    };
    let mut search = NestedSearch::new(contact, equations, integrator, origin, cost);
    let trial = search.widen(half_width)?;
    if let Equations::Pressure { wanted, .. } = equations {
        wanted.met(trial.on, [trial.residual.at_a, trial.residual.at_b])?;
    }
    // The error of the quadrature, and the residual that the search has left.
    let Residual { at_a, at_b, size, .. } = trial.residual;
    let missed = T::of(0.5) * (at_a.abs() + at_b.abs()) / size;
    let on = differentiate(&equations, gap, search.integrator, trial.on, None, search.cost)?;
    Ok(Nested { on, error: trial.residual.error + missed })
}

/// Finds the balanced contact of a given half-width.
fn place<T: Real>(
    contact: &Contact<'_, T>,
    equations: Equations<T>,
    integrator: &mut Engine<T>,
    half_width: T,
    start: Option<Interval<T>>,
    cost: &mut Cost,
) -> Fallible<T, Nested<T>> {
    let gap = &contact.gap;
    let mut sampler = Sampler::default();
    let first = first_contact(&mut sampler, gap, start);
    *cost += sampler.cost;
    let (origin, range) = (first?, gap.range());
    // The unknown load does not tell how well the contact has to be balanced.
    let unbalance = Residual::shift;
    let mut search = NestedSearch {
        unbalance,
        ..NestedSearch::new(contact, equations, integrator, origin, cost)
    };
    for _ in 0..MAX_BESIDE {
        match search.centre(half_width)? {
            Centred::At(trial) => {
                let Residual { at_a, at_b, size, error, .. } = trial.residual;
                let missed = T::of(0.5) * (at_a - at_b).abs() / size;
                let width = Some(half_width);
                let on = differentiate(
                    &equations,
                    gap,
                    search.integrator,
                    trial.on,
                    width,
                    search.cost,
                )?;
                return Ok(Nested { on, error: error + missed });
            }
            Centred::Beyond(end) => {
                let x = [search.origin - half_width, search.origin + half_width][end];
                return Err(SolveError::OutsideBodies { x, range }.into());
            }
            // If one edge is pulled more than the other, the contact may sit further on.
            Centred::Adrift(on) if equations.is_lopsided() => {
                let before = search.origin;
                search.origin = if on.left < before { on.left } else { on.right };
            }
            Centred::Adrift(_) => break,
        }
    }
    Err(search.no_balance(half_width))
}

/// Trial contact, and the residual of its conditions.
#[derive(Clone, Copy)]
struct TrialContact<T> {
    on: Interval<T>,
    residual: Residual<T>,
}

struct NestedSearch<'s, T: Real> {
    equations: Equations<T>,
    gap: &'s Gap<'s, T>,
    integrator: &'s mut Engine<T>,
    cost: &'s mut Cost,
    strategy: &'s dyn LimitSearch<T>,
    /// Point of first contact.
    origin: T,
    range: [T; 2],
    /// Number of the edge whose distance from the origin is sought: left (0) or right (1).
    near: usize,
    /// Last share of the width between this edge and the origin.
    share: T,
    /// Last decrease of the shift per unit of length moved to the right.
    stiffness: Option<T>,
    /// Residual that vanishes at the place of a contact of given width.
    unbalance: fn(&Residual<T>) -> T,
}

impl<'s, T: Real> NestedSearch<'s, T> {
    fn new(
        contact: &'s Contact<'s, T>,
        equations: Equations<T>,
        integrator: &'s mut Engine<T>,
        origin: T,
        cost: &'s mut Cost,
    ) -> Self {
        Self {
            equations,
            gap: &contact.gap,
            integrator,
            cost,
            strategy: contact.strategy(),
            origin,
            range: contact.gap.range(),
            near: 1,
            share: T::of(0.5),
            stiffness: None,
            unbalance: Residual::rough_shift,
        }
    }

    fn attempt(&mut self, on: Interval<T>) -> Fallible<T, TrialContact<T>> {
        // Panels much wider than the contact are less accurate than they seem.
        let covered =
            self.integrator.sampled_interval().map_or(T::zero(), |covered| covered.half_width());
        if covered > T::of(MAX_WIDTH_RATIO) * on.half_width() {
            self.integrator.clear_samples();
        }
        let residual = self.equations.residual(self.gap, on, self.integrator, self.cost)?;
        if !residual.is_finite() {
            return Err(SolveError::Overflow { interval: on }.into());
        }
        Ok(TrialContact { on, residual })
    }

    /// Runs the user's strategy on one of the conditions and returns the best trial met.
    fn run(
        &mut self,
        bracket: &Bracket<T>,
        best: &mut TrialContact<T>,
        condition: fn(&Residual<T>) -> T,
        mut attempt: impl FnMut(&mut Self, T) -> Fallible<T, TrialContact<T>>,
    ) -> Fallible<T, TrialContact<T>> {
        let strategy = self.strategy;
        let resolution = self.resolution();
        let falls = bracket.values.is_some_and(|[at_lo, _]| at_lo > T::zero());
        let [mut lo, mut hi] = [bracket.lo, bracket.hi];
        self.cost.searches += 1;
        let function = |unknown| {
            self.cost.search_values += 1;
            let trial = attempt(self, unknown)?;
            *best = nearer(trial, *best, condition);
            let value = condition(&trial.residual);
            *(if (value > T::zero()) == falls { &mut lo } else { &mut hi }) = unknown;
            Ok(if hi - lo <= resolution { T::zero() } else { value })
        };
        match try_find(strategy, function, bracket) {
            Ok(_) => Ok(*best),
            Err(error) => {
                Err(error
                    .or_else(|source| SolveError::LimitSearch { best: best.on, source }.into()))
            }
        }
    }

    /// Returns the distance below which contacts far from x = 0 are the same numbers.
    fn resolution(&self) -> T {
        T::of(2.0) * T::epsilon() * self.origin.abs()
    }

    /// Returns the distances that a contact can reach to the left and to the right of the origin.
    fn room(&self) -> [T; 2] {
        [self.origin - self.range[0], self.range[1] - self.origin]
    }

    fn no_balance(&self, half_width: T) -> ContactError<T> {
        ContactError::Solve(SolveError::NoEquilibrium { half_width, near: self.origin })
    }
}

fn nearer<T: Real>(
    one: TrialContact<T>,
    other: TrialContact<T>,
    condition: fn(&Residual<T>) -> T,
) -> TrialContact<T> {
    if condition(&other.residual).abs() < condition(&one.residual).abs() { other } else { one }
}
