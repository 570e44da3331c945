//! What comes back.

use crate::certificate::{Certificate, certify};
use crate::contact::{ContactState, peak};
use crate::gap::{Cost, Gap};
use crate::quadrature::panels::{self, Several};
use crate::quadrature::{Integrator, Estimate, LoadCase};
use crate::{ContactError, Interval, Real};
use std::sync::Arc;

mod region;
mod report;

pub use region::ContactRegion;
pub use report::{Report, Start, Trial, Verdict};

/// A solved contact: its limits, and on request its pressure.
///
/// It is the contact of the bodies, in one interval or several ([`intervals`](Self::intervals)), as far as the
/// checks of the solve can see; [`report`](Self::report) says what was checked. What they cannot see is
/// narrower than the distance of the samples: [`certify`](Self::certify) looks at all of the bodies.
///
/// It lives as long as the bodies (and the strategies that were set), not the [`Contact`](crate::Contact) or the
/// [`Solver`](crate::Solver): it can be returned, kept, cloned and sent to another thread. A clone is
/// cheap.
#[derive(Clone)]
pub struct Solution<'b, T: Real> {
    gap: Gap<'b, T>,
    /// That has solved the contact.
    integrator: Arc<Box<dyn Integrator<T>>>,
    kappa: T,
    found: ContactState<T>,
    cost: Cost,
    report: Report,
}

impl<'b, T: Real> Solution<'b, T> {
    pub(crate) fn new(
        gap: Gap<'b, T>,
        integrator: Arc<Box<dyn Integrator<T>>>,
        kappa: T,
        found: ContactState<T>,
        cost: Cost,
        report: Report,
    ) -> Self {
        Self { gap, integrator, kappa, found, cost, report }
    }

    /// The limit `a`.
    pub fn a(&self) -> T {
        self.found.interval.right
    }

    /// The limit `b`; the contact runs from `-b`, so `b` is negative where the whole contact
    /// lies at positive `x`.
    pub fn b(&self) -> T {
        -self.found.interval.left
    }

    /// From the first limit to the last, `[-b, a]`: the contact, if it is one.
    pub fn hull(&self) -> Interval<T> {
        self.found.interval
    }

    /// The intervals in which the bodies touch, from left to right.
    pub fn intervals(&self) -> &[Interval<T>] {
        self.several().map_or(std::slice::from_ref(&self.found.interval), Several::contacts)
    }

    /// Load per unit length F, of all contacts.
    pub fn load(&self) -> T {
        self.found.load
    }

    /// The tilt τ, an angle: by how much body 2 has been turned counter-clockwise (or body 1 clockwise) for the
    /// load to act where [`Control::Moment`](crate::Control::Moment) or
    /// [`Control::CentreOfPressure`](crate::Control::CentreOfPressure) has it; 0 with all other controls.
    ///
    /// The angle is small: the slope of the gap is larger by τ, its height at x by τ x. All that is asked of
    /// the solution is answered for the turned bodies, rates at a fixed tilt.
    pub fn tilt(&self) -> T {
        self.found.tilt
    }

    /// Estimated error of the limits, relative to the half-width, where they were sought: what
    /// rounding, the noise of the profiles' formulas and the quadrature leave open of the
    /// conditions at the edges. `None` where both limits were given.
    ///
    /// It is a few units in the last place where the slope of the gap is analytic between the
    /// breakpoints. Much more says that a profile is noisy or has a kink not declared as a breakpoint.
    pub fn limits_error(&self) -> Option<T> {
        self.found.error
    }

    /// `[K_b, K_a]`, the strengths of the singularities at -b and at a, pressures: near `a`,
    /// `P ≈ K_a/sin θ` with `x = c + L cos θ`. Zero to rounding for free edges; at a fixed edge
    /// a negative strength means that the body lifts off there. Of several contacts these are the
    /// outermost limits, c and L those of the contact there.
    pub fn edge_singularities(&self) -> [T; 2] {
        self.found.strengths
    }

    /// Proves that this is a contact, and not only a solution of the equations: no tension inside, and
    /// no overlap on either side up to the ends of the bodies. For that the gap is sampled anew, all of
    /// it: see [`Certificate`] for what is proved, and what it takes.
    ///
    /// A body ends at a sharp corner ([`Edge::Fixed`](crate::Edge::Fixed),
    /// [`Edge::FreeUntil`](crate::Edge::FreeUntil)), however far its curve goes on. Between adhesive edges the
    /// bodies may pull at each other, and only the outside is looked at.
    ///
    /// # Errors
    /// [`ContactError::FeatureMissed`] where the panels do not know of something in the contact;
    /// [`ContactError::Unbalanced`] where its samples leave more at a free edge than
    /// [`limits_error`](Self::limits_error) stands for; [`ContactError::Profile`] for heights that are not finite;
    /// [`ContactError::Tension`] at the least pressure, [`ContactError::Overlap`] at the deepest
    /// overlap, [`ContactError::Undecided`]; those of sampling the gap.
    pub fn certify(&self) -> Result<Certificate<T>, ContactError<T>> {
        certify(&self.gap, self.kappa, &self.found, &**self.integrator)
    }

    /// The largest pressure and its place, as far as a grid of 64 points in each contact and the breakpoints
    /// show which maximum is the largest. The pressure is flat there: its value has all digits, its place half
    /// of them.
    ///
    /// Where the pressure of an edge goes to minus infinity, as at an adhesive one, the peak is that
    /// inside.
    ///
    /// It takes about a hundred pressures for each contact, which cost evaluations with [`Midpoint`](crate::Midpoint)
    /// only; they are not in [`cost`](Self::cost).
    ///
    /// # Errors
    /// [`ContactError::Singular`] where the pressure is infinite: at a fixed edge, or where the
    /// slope of the gap jumps up ([`contacts`](Self::contacts) has the peaks of the others); those of
    /// sampling the gap.
    pub fn peak(&self) -> Result<Peak<T>, ContactError<T>> {
        self.integrator.complete(&self.gap)?;
        let last = self.intervals().len() - 1;
        let mut best = self.peak_in(last)?;
        for i in (0..last).rev() {
            let peak = self.peak_in(i)?;
            if peak.pressure >= best.pressure {
                best = peak;
            }
        }
        Ok(best)
    }

    /// That of one contact, by its number.
    fn peak_in(&self, contact: usize) -> Result<Peak<T>, ContactError<T>> {
        let contacts = self.intervals();
        let (on, last) = (contacts[contact], contacts.len() - 1);
        let (x, Estimate { value: pressure, .. }) =
            peak(&**self.integrator, &self.gap, &self.load_case(), on, &mut Cost::default())?;
        if !pressure.is_finite() {
            return Err(ContactError::Singular { x });
        }
        let ContactState { strengths, free, .. } = self.found;
        let rounding = T::of(64.0) * T::epsilon() * pressure.abs();
        // Where both edges are at fault it is the right one that is named.
        for (i, outermost, x) in [(1, contact == last, on.right), (0, contact == 0, on.left)] {
            if outermost && !free[i] && strengths[i] > rounding {
                return Err(ContactError::Singular { x });
            }
        }
        Ok(Peak { x, pressure })
    }

    /// What finding the limits has cost, the pressures that [`Control::PeakPressure`](crate::Control::PeakPressure) takes
    /// for it included.
    pub fn cost(&self) -> Cost {
        self.cost
    }

    /// The starts that the solve has tried, and what the checks say of the solution.
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// Makes ready for pressures anywhere. With [`Panels`](crate::Panels) nothing is sampled for
    /// them.
    ///
    /// # Errors
    /// Those of sampling the gap.
    pub fn pressure(&self) -> Result<Pressure<'_, T>, ContactError<T>> {
        let cost = self.integrator.complete(&self.gap)?;
        let (gap, ContactState { interval: on, load, error, force, .. }) = (&self.gap, self.found);
        let error = error.unwrap_or(T::zero());
        let force = force.unwrap_or(T::of(3.0) * load.abs() * error);
        let ContactState { strengths, adhesive, .. } = self.found;
        let held = |i: usize| if adhesive[i] { strengths[i].abs() * error } else { T::zero() };
        let held = [held(0), held(1)];
        let load_case = self.load_case();
        let (integrator, contacts) = (&**self.integrator, self.intervals());
        Ok(Pressure { gap, integrator, load_case, on, contacts, force, held, cost })
    }

    /// The contact in which a place lies.
    pub(crate) fn contact_with(&self, x: T) -> Option<Interval<T>> {
        let contacts = self.intervals();
        let first = contacts.partition_point(|on| on.right <= x);
        contacts.get(first).copied().filter(|on| on.contains(x))
    }

    /// The contacts on their panels, if they are several.
    pub(crate) fn several(&self) -> Option<&Several<T>> {
        panels::several(&**self.integrator)
    }

    pub(crate) fn gap(&self) -> &Gap<'b, T> {
        &self.gap
    }

    pub(crate) fn scale(&self) -> T {
        self.kappa
    }

    pub(crate) fn found(&self) -> &ContactState<T> {
        &self.found
    }

    fn load_case(&self) -> LoadCase<T> {
        let ContactState { load, free, .. } = self.found;
        LoadCase { kappa: self.kappa, load, free }
    }
}

/// A largest pressure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak<T> {
    /// Where it is.
    pub x: T,
    /// How large it is.
    pub pressure: T,
}

/// The pressure over a contact.
pub struct Pressure<'p, T: Real> {
    gap: &'p Gap<'p, T>,
    integrator: &'p dyn Integrator<T>,
    load_case: LoadCase<T>,
    /// From the first to the last limit.
    on: Interval<T>,
    contacts: &'p [Interval<T>],
    /// The load that stands for the error of the limits.
    force: T,
    /// That error times the strengths of the edges at -b and a, with adhesion.
    held: [T; 2],
    cost: Cost,
}

impl<T: Real> Pressure<'_, T> {
    /// `P(x)`. Zero outside the contact and at a free edge.
    ///
    /// # Errors
    /// [`ContactError::Unresolved`] where, between free edges, the estimated error is more than
    /// a third of what the quadrature gives, as it becomes very close to an edge;
    /// [`ContactError::Singular`] where the pressure is infinite; [`ContactError::OutsideBodies`]
    /// beyond either body, and for NaN; those of sampling the gap at `x`.
    pub fn at(&self, x: T) -> Result<T, ContactError<T>> {
        let Estimate { value: pressure, error } = self.estimate(x, &mut Cost::default())?;
        // Elsewhere a pressure may pass through zero, and an absolute error is all there is.
        let free = self.load_case.free == [true; 2];
        if free && T::of(3.0) * error > pressure.abs() && self.on.contains(x) {
            Err(ContactError::Unresolved { x, pressure, error })
        } else {
            Ok(pressure)
        }
    }

    /// `P(x)` at any number of points, in any order: cheaper than one by one. What
    /// [`at`](Self::at) refuses as unresolved is returned as it is.
    ///
    /// # Errors
    /// As [`estimate`](Self::estimate). The points before the one at fault have been done.
    /// [`ContactError::LengthMismatch`] if the two slices are not of the same length.
    pub fn at_many(&self, x: &[T], pressures: &mut [T]) -> Result<(), ContactError<T>> {
        if x.len() != pressures.len() {
            return Err(ContactError::LengthMismatch { x: x.len(), pressures: pressures.len() });
        }
        let mut cost = Cost::default();
        // Without a way out of the loops, for speed.
        if x.iter().fold(true, |all, &x| all & self.on.contains(x)) {
            self.integrator.pressures(self.gap, &self.load_case, x, pressures, &mut cost)?;
            let finite = |pressure: &T| pressure.is_finite();
            if pressures.iter().fold(true, |all, pressure| all & finite(pressure)) {
                return Ok(());
            }
        }
        for (&x, pressure) in x.iter().zip(pressures) {
            *pressure = self.estimate(x, &mut cost)?.value;
        }
        Ok(())
    }

    /// `P(x)`, however doubtful, with its estimated error, adding to `cost` what this point takes:
    /// nothing with [`Panels`](crate::Panels); with [`Midpoint`](crate::Midpoint) nothing on the
    /// grid of the rule, one sample of the gap elsewhere, seven next to one of its points.
    ///
    /// The error is that of the quadrature, and what the error of the limits makes of it.
    ///
    /// # Errors
    /// As [`at`](Self::at), without [`ContactError::Unresolved`].
    pub fn estimate(&self, x: T, cost: &mut Cost) -> Result<Estimate<T>, ContactError<T>> {
        let range = self.gap.range();
        if !(x >= range[0] && x <= range[1]) {
            return Err(ContactError::OutsideBodies { x, range });
        }
        let [free_b, free_a] = self.load_case.free;
        let first = self.contacts.partition_point(|on| on.right <= x);
        let Some(on) = self.contacts.get(first).filter(|on| on.contains(x)) else {
            let singular = (x == self.on.left && !free_b) || (x == self.on.right && !free_a);
            return if singular {
                Err(ContactError::Singular { x })
            } else {
                Ok(Estimate { value: T::zero(), error: T::zero() })
            };
        };
        let mut estimate = self.integrator.estimate(self.gap, &self.load_case, x, cost)?;
        if !estimate.value.is_finite() {
            return Err(ContactError::Singular { x });
        }
        // With the limits P changes as with the load that would move them, by 1/(π w) for each unit
        // of it. The load is what it is: so the change is of second order, but for points so close
        // to an edge that they might lie on its other side.
        let change = self.force / (T::pi() * on.chebyshev_weight(x));
        let share = change / estimate.value.abs();
        estimate.error += if share < T::of(0.1) { change * share } else { change };
        // An adhesive edge that moves takes its singularity along: `P ≈ K sqrt(L/2d)`.
        let [held_b, held_a] = self.held;
        for (held, distance) in [(held_a, self.on.right - x), (held_b, x - self.on.left)] {
            let share = self.on.half_width() / distance;
            estimate.error += T::of(0.5) * held * share * share.sqrt();
        }
        Ok(estimate)
    }

    /// `P(x)` strictly inside the contact as it comes, infinite where a slope jumps.
    pub(crate) fn values(&self, x: &[T], pressures: &mut [T]) -> Result<(), ContactError<T>> {
        self.integrator.pressures(self.gap, &self.load_case, x, pressures, &mut Cost::default())
    }

    /// What making ready has cost.
    pub fn cost(&self) -> Cost {
        self.cost
    }
}

impl<T: Real> std::fmt::Debug for Solution<'_, T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { found: ContactState { interval, load, .. }, kappa, cost, .. } = self;
        let mut debug = f.debug_struct("Solution");
        debug.field("interval", interval).field("load", load).field("kappa", kappa);
        debug.field("cost", cost).finish_non_exhaustive()
    }
}

impl<T: Real> std::fmt::Debug for Pressure<'_, T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { on, load_case, cost, .. } = self;
        let mut debug = f.debug_struct("Pressure");
        debug.field("on", on).field("load_case", load_case);
        debug.field("cost", cost).finish_non_exhaustive()
    }
}
