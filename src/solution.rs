//! Solutions, and the quantities worked out from them: one a file.

use crate::Real;
use crate::gap::{Cost, Gap};
use crate::material::Elasticity;
use crate::quadrature::Engine;
use std::sync::Arc;

// In the order of the documentation.
mod limits;

mod potential;
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

mod uncertainty;

mod gap_outside;

mod residual;

pub mod stress;

mod certificate;
mod check;
mod contact_state;
mod display;
mod pressure_integral;
mod report;
mod solved;
mod undeformed_gap;

pub use approach::Approach;
pub(crate) use approach::Approaching;
pub(crate) use certificate::certify;
pub use certificate::{Certificate, Extremum};
pub(crate) use check::{CLOSED_WIDTH, Closeness, Inside, Tensions, least_width, parting};
pub(crate) use contact_state::ContactState;
pub use load_rates::LoadRates;
pub use partial_slip::{PartialSlip, Shear, SlipStress, Traction};
pub use peak::Peak;
pub(crate) use peak::largest_pressure;
pub use pressure::Pressure;
pub(crate) use pressure_integral::Integrals;
pub use region::ContactRegion;
pub use report::{Attempt, Outcome, Report, Start};
pub(crate) use solved::Solved;
pub(crate) use steepness::is_steep;
pub use steepness::{Conformity, STEEPEST_HALF_PLANE};
pub use summary::Summary;
pub use uncertainty::Uncertainty;

/// Solved contact: its limits, and on request its pressure.
///
/// It is the contact of the bodies, in one interval or several ([`intervals`](Self::intervals)), as
/// far as the checks of the solve can see; [`report`](Self::report) lists the checks. They miss
/// features that are narrower than the distance of the samples: [`certify`](Self::certify) samples
/// all of the bodies.
///
/// It lives as long as the bodies (and the strategies that were set), not the
/// [`Contact`](crate::Contact) or the [`Solver`](crate::Solver): it can be returned, kept, cloned
/// and sent to another thread. A clone is cheap.
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
    pub(crate) gap: Gap<'b, T>,
    /// Integrator that has solved the contact.
    pub(crate) integrator: Arc<Engine<T>>,
    pub(crate) kappa: T,
    /// Flag: nobody has set κ.
    pub(crate) has_default_stiffness: bool,
    /// Elasticity of the bodies, if it is known.
    pub(crate) elasticity: Option<[Elasticity<T>; 2]>,
    pub(crate) found: ContactState<T>,
    pub(crate) cost: Cost,
    pub(crate) report: Report,
}

impl<T: Real> Solution<'_, T> {
    pub(crate) fn solved(&self) -> Solved<'_, T> {
        let Self { gap, integrator, kappa, found, .. } = self;
        Solved { gap, integrator, kappa: *kappa, found }
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
