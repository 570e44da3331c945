//! What comes back, and what can be asked of it: one question a file.

use crate::gap::{Cost, Gap};
use crate::quadrature::panels::{self, Several};
use crate::quadrature::{Integrator, LoadCase};
use crate::{ContactError, Interval, Real};
use std::sync::Arc;

mod certificate;
mod contact_state;
mod gap_outside;
mod load_rates;
mod moment;
mod peak;
mod pressure;
mod pressure_integral;
mod region;
mod report;
mod residual;
mod steepness;
pub mod stress;

pub(crate) use certificate::certify;
pub use certificate::{Certificate, Extremum};
pub(crate) use contact_state::ContactState;
pub use load_rates::LoadRates;
pub use peak::Peak;
pub(crate) use peak::largest_pressure;
pub use pressure::Pressure;
pub use region::ContactRegion;
pub use report::{Report, Start, Trial, Verdict};
pub use steepness::STEEPEST_HALF_PLANE;

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
        self.several().map(Several::contacts).unwrap_or(std::slice::from_ref(&self.found.interval))
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

    /// What finding the limits has cost, the pressures that [`Control::PeakPressure`](crate::Control::PeakPressure) takes
    /// for it included.
    pub fn cost(&self) -> Cost {
        self.cost
    }

    /// The starts that the solve has tried, and what the checks say of the solution.
    pub fn report(&self) -> &Report {
        &self.report
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

impl<T: Real> std::fmt::Debug for Solution<'_, T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { found: ContactState { interval, load, .. }, kappa, cost, .. } = self;
        let mut debug = f.debug_struct("Solution");
        debug.field("interval", interval).field("load", load).field("kappa", kappa);
        debug.field("cost", cost).finish_non_exhaustive()
    }
}
