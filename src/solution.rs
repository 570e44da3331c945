//! What comes back, and what can be asked of it: one question a file.

use crate::gap::{Cost, Gap};
use crate::material::Elasticity;
use crate::quadrature::Integrator;
use crate::quadrature::panels::{self, Several};
use crate::{Interval, Real};
use std::sync::Arc;

// In the order in which the questions show in the documentation.
mod limits;

mod pressure;

mod peak;

mod region;

mod quality;

mod steepness;

mod summary;

mod moment;

mod approach;

mod partial_slip;

mod load_rates;

mod gap_outside;

mod residual;

pub mod stress;

mod certificate;
mod contact_state;
mod display;
mod pressure_integral;
mod report;
mod solved;
mod undeformed_gap;

pub(crate) use approach::Approaching;
pub use approach::{Approach, Reference, References};
pub(crate) use certificate::certify;
pub use certificate::{Certificate, Extremum};
pub(crate) use contact_state::ContactState;
pub use load_rates::LoadRates;
pub use partial_slip::{PartialSlip, Shear, SlipStress, Traction};
pub use peak::Peak;
pub(crate) use peak::largest_pressure;
pub use pressure::Pressure;
pub use region::ContactRegion;
pub use report::{Attempt, Outcome, Report, Start};
pub(crate) use solved::Solved;
pub use steepness::STEEPEST_HALF_PLANE;
pub use summary::Summary;

/// A solved contact: its limits, and on request its pressure.
///
/// It is the contact of the bodies, in one interval or several ([`intervals`](Self::intervals)), as far as the
/// checks of the solve can see; [`report`](Self::report) says what was checked. What they cannot see is
/// narrower than the distance of the samples: [`certify`](Self::certify) looks at all of the bodies.
///
/// It lives as long as the bodies (and the strategies that were set), not the [`Contact`](crate::Contact) or the
/// [`Solver`](crate::Solver): it can be returned, kept, cloned and sent to another thread. A clone is
/// cheap.
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Contact, Control, Flat};
///
/// let body = Parabola::new(1.0f64, [-1.0, 1.0])?;
/// let solution = Contact::new(&Flat, &body)?.solve(Control::Load(0.02))?;
/// println!("{solution}"); // [-0.2, 0.2], and more
/// assert!((solution.hull().half_width() / 0.2 - 1.0).abs() < 1e-14); // L² = 2 F R/κ
/// let largest = solution.peak()?.pressure;
/// assert!((largest / (0.04 / (0.2 * std::f64::consts::PI)) - 1.0).abs() < 1e-14); // 2 F/(π L)
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct Solution<'b, T: Real> {
    gap: Gap<'b, T>,
    /// That has solved the contact.
    integrator: Arc<Box<dyn Integrator<T>>>,
    kappa: T,
    elasticity: Option<[Elasticity<T>; 2]>,
    found: ContactState<T>,
    cost: Cost,
    report: Report,
}

impl<'b, T: Real> Solution<'b, T> {
    pub(crate) fn new(
        gap: Gap<'b, T>,
        integrator: Arc<Box<dyn Integrator<T>>>,
        kappa: T,
        elasticity: Option<[Elasticity<T>; 2]>,
        found: ContactState<T>,
        cost: Cost,
        report: Report,
    ) -> Self {
        Self { gap, integrator, kappa, elasticity, found, cost, report }
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

    /// Of the bodies, where it is known.
    fn elasticity(&self) -> Option<[Elasticity<T>; 2]> {
        self.elasticity
    }

    pub(crate) fn solved(&self) -> Solved<'_, T> {
        let Self { gap, integrator, kappa, found, .. } = self;
        Solved { gap, integrator: &***integrator, kappa: *kappa, found }
    }

    pub(crate) fn found(&self) -> &ContactState<T> {
        &self.found
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
