//! The contact with a given approach of the bodies.
//!
//! The approach grows with the load, and slower the larger it is: the contact grows, and with it the stiffness. So
//! Newton's method on the load, with the exact rate, comes from below and needs no bracket but for the ends of the
//! bodies. The samples of one trial serve the next.

use super::Contact;
use super::topology::{self, Sought as Contacts, Workspace};
use crate::gap::Cost;
use crate::material::Elasticity;
use crate::quadrature::panels::{self, Several};
use crate::quadrature::{Integrator, complete};
use crate::search::SearchError;
use crate::solution::{Approaching, ContactState, References, Report, Solved};
use crate::{ContactError, Ends, Interval, Real};

/// Loads tried before the approach is given up.
const MOST_LOADS: usize = 100;

/// The first load as a share of `κ δ`: that of a contact a millionth as wide as the bodies is a twentieth.
const FIRST: f64 = 0.05;

/// By how much the load changes at most from one trial to the next.
const MOST_STEP: f64 = 16.0;

/// The approach that is wanted, and what it depends on.
pub(super) struct Sought<T> {
    pub approach: T,
    pub references: References<T>,
    pub bodies: Option<[Elasticity<T>; 2]>,
}

/// Finds the contact with a given approach.
pub(super) fn find<T: Real>(
    contact: &Contact<'_, T>,
    sought: &Sought<T>,
    integrator: &mut dyn Integrator<T>,
    workspace: &mut Workspace<T>,
    cost: &mut Cost,
) -> Result<ContactState<T>, ContactError<T>> {
    let &Sought { approach: wanted, references, bodies } = sought;
    if bodies.is_none() {
        return Err(ContactError::NoMaterials);
    }
    super::check_positive("approach", wanted)?;
    let mut at = |load: T| {
        workspace.report = Report::new();
        let sought = Contacts::By(contact.under(load)?);
        let found = topology::find(contact, sought, integrator, workspace, cost)?;
        if panels::several(integrator).is_none() {
            integrator.prepare(&contact.gap, found.interval)?;
        }
        complete(integrator, &contact.gap, found.interval, cost)?;
        let one = std::slice::from_ref(&found.interval);
        workspace.keep(panels::several(integrator).map_or(one, Several::contacts));
        let (gap, kappa) = (&contact.gap, contact.kappa);
        let solved = Solved { gap, integrator, kappa, found: &found };
        let [approach, rate] = Approaching::new(solved, bodies, &references)?.with_rate()?;
        Ok((found, approach, rate))
    };
    let mut load = T::of(FIRST) * contact.kappa * wanted;
    // Loads that are too small and too large, and what the bodies bear at most: the load, and the largest approach
    // that was seen.
    let (mut low, mut high, mut most) = (None, None, None);
    let mut largest = None;
    // Steps that are still to be made without a look at them, once the next squares what is left.
    let mut last_steps = None;
    let mut last_error = None;
    let Ends { left, right } = contact.ends();
    let mut best = (Interval { left, right }, wanted);
    for _ in 0..MOST_LOADS {
        match at(load) {
            Ok((found, approach, rate)) => {
                if !(rate > T::zero() && rate.is_finite()) {
                    return Err(ContactError::ApproachFalls { load, rate });
                }
                best = (found.interval, wanted - approach);
                let step = (wanted - approach) / rate.component(0);
                let size = step.abs() / load;
                last_steps = match last_steps {
                    Some(0) => {
                        let error = found.error.map(|error| error + size);
                        return Ok(ContactState { error, ..found });
                    }
                    Some(left) => Some(left - 1),
                    None => (size <= T::epsilon().sqrt()).then_some(T::DERIVATIVE_ORDER),
                };
                let next = load + step;
                if last_steps.is_some() {
                    load = next;
                    continue;
                }
                if approach < wanted {
                    (low, largest) = (Some(load), Some((approach, load)));
                } else {
                    high = Some(load);
                }
                let step = T::of(MOST_STEP);
                load = inside(next.min(load * step).max(load / step), low, high);
            }
            // Of what is too large it is not known how much nearer the bodies would come.
            Err(
                error @ (ContactError::DomainTooShort { .. } | ContactError::EndReached { .. }),
            ) => {
                let carried = match error {
                    ContactError::DomainTooShort { carried, .. } => carried.min(load),
                    _ => load,
                };
                (high, most) = (Some(carried), Some(carried));
                load = inside(load, low, high);
                last_error = Some(error);
            }
            // A corner does not hold so small a load.
            Err(error @ ContactError::LiftsOff { .. }) => {
                low = Some(load);
                load = inside(load * T::of(MOST_STEP), low, high);
                last_error = Some(error);
            }
            Err(error) => return Err(error),
        }
        let is_narrow = |high: T| high - low.unwrap_or(T::zero()) <= T::epsilon().sqrt() * high;
        if high.is_some_and(is_narrow) {
            break;
        }
    }
    Err(match (largest, last_error) {
        (Some((approach, load)), _) if most == high => {
            ContactError::ApproachTooLarge { wanted, approach, load }
        }
        (_, Some(error)) => error,
        _ => {
            let (best, residual) = best;
            let source = SearchError::NotConverged { x: load, residual };
            ContactError::LimitSearch { best, source }
        }
    })
}

/// A load that is not known to be too small or too large: this one, or one half-way.
fn inside<T: Real>(load: T, low: Option<T>, high: Option<T>) -> T {
    let half = T::of(0.5);
    let is_known = low.is_some_and(|low| load <= low) || high.is_some_and(|high| load >= high);
    match high {
        Some(high) if is_known => half * low.unwrap_or(T::zero()) + half * high,
        _ => load,
    }
}
