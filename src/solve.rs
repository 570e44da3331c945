//! Search for the contact under a control.
//!
//! Under a load the contacts are sought from a start, moved until they meet the conditions,
//! checked, and revised ([`topology`]). A half-width is one of these conditions, and so is the
//! place at which the load acts ([`moment`]); a peak pressure and an approach are sought [by the
//! load](by_load). The paper's edges, Eq. (6), and the user's own strategies and quadratures are
//! served by a [search of one limit at a time](one_by_one).

mod active_set;
mod apart;
mod bending;
mod by_load;
mod capacity;
mod equations;
mod exterior_field;
mod fault;
mod first_contact;
mod found;
mod moment;
mod newton;
mod one_by_one;
mod partial_slip;
mod signorini_check;
mod single_contact;
#[cfg(test)]
mod tests;
mod topology;

use crate::contact::{Contact, Control, EdgePressure, check, check_positive, check_within, edges};
use crate::gap::{Cost, Gap};
use crate::quadrature::{Engine, complete};
use crate::solution::{ContactState, Outcome, Report, Solution, Solved, Start, certify};
use crate::{ContactError, Edge, Ends, Fallible, InputError, Interval, Real, SolveError};
pub(crate) use apart::first_touch;
use by_load::{ByApproach, HalfWidth, Peak};
use edges::{Conditions, Given};
use equations::Equations;
use std::sync::Arc;
use topology::Search;
pub(crate) use topology::Workspace;

/// Sets of contacts tried before the search is given up.
const MAX_SETS: usize = 14;

/// Means of a search: the integrals, the state kept from one solve to the next, and the cost so
/// far.
pub(crate) struct Work<'s, T: Real> {
    pub integrator: &'s mut Engine<T>,
    pub workspace: &'s mut Workspace<T>,
    pub cost: &'s mut Cost,
}

impl<T: Real> Work<'_, T> {
    /// Tells whether several contacts can be found. The user's own quadratures and searches, and
    /// the paper's, find only one.
    fn may_find_several(&self, contact: &Contact<'_, T>) -> bool {
        let by_newton = self.integrator.panels().is_some() && contact.search.is_none();
        by_newton && !contact.edges.are_adhesive()
    }

    /// Prepares the contacts found for their pressures, and keeps them for the next search.
    fn keep(&mut self, gap: &Gap<'_, T>, hull: Interval<T>) -> Fallible<T, ()> {
        let Self { integrator, workspace, cost } = self;
        integrator.ready(gap, hull)?;
        complete(integrator, gap, hull, cost)?;
        workspace.keep(integrator.contacts(&hull));
        Ok(())
    }
}

/// Contact found, and its bodies if they are bent.
type Found<'b, T> = (ContactState<T>, Option<Box<Gap<'b, T>>>);

impl<'b, T: Real> Contact<'b, T> {
    /// Finds the contact under a control: its limits, and the load or the tilt if not given.
    /// [`Solution::pressure`] computes the pressure.
    ///
    /// # Errors
    /// [`InputError::InvalidLoad`], [`InputError::InvalidKappa`],
    /// [`InputError::InvalidModulus`], [`InputError::InvalidLimits`],
    /// [`InputError::InvalidAdhesion`], [`InputError::InvalidEdgePressure`],
    /// [`InputError::EdgePressureLoad`], [`InputError::BothLimitsGiven`],
    /// [`InputError::PeakEdge`], [`InputError::InvalidSegments`],
    /// [`InputError::InvalidTolerance`], [`InputError::InvalidResolution`] for invalid
    /// settings; [`InputError::NotConvex`] for a false declaration;
    /// [`SolveError::NoFirstContact`], [`SolveError::DomainTooShort`],
    /// [`SolveError::HalfWidthTooLarge`], [`SolveError::PeakTooHigh`],
    /// [`SolveError::NoEquilibrium`], [`SolveError::OutsideBodies`], [`SolveError::PullOff`]
    /// for bodies and loads that do not go together; [`InputError::Profile`],
    /// [`SolveError::Inversion`] from sampling the bodies; [`SolveError::LimitSearch`],
    /// [`SolveError::EdgePressureNotMet`], [`SolveError::Overflow`], [`SolveError::NoPeak`],
    /// [`SolveError::InJump`], [`SolveError::LoadUnknown`], [`SolveError::BudgetSpent`],
    /// [`InputError::InconsistentHeights`] from the search; [`InputError::InvalidMoment`],
    /// [`InputError::TiltNotSupported`], [`SolveError::TiltNotFound`] with a given moment;
    /// [`InputError::InvalidYoungsModulus`], [`InputError::InvalidPoissonRatio`],
    /// [`InputError::BothRigid`] for materials; [`InputError::NoMaterials`],
    /// [`InputError::InvalidReference`], [`SolveError::ApproachTooLarge`],
    /// [`SolveError::Falls`],
    /// [`EvaluationError::NoLoadDerivative`](crate::EvaluationError::NoLoadDerivative) with a given
    /// approach; the errors of [`Solution::certify`] if [`certified`](Self::certified).
    pub fn solve(&self, control: Control<T>) -> Result<Solution<'b, T>, ContactError<T>> {
        T::solve(self, control)
    }

    pub(crate) fn solve_cold(&self, control: Control<T>) -> Fallible<T, Solution<'b, T>> {
        let (mut integrator, mut workspace) = (Engine::new(self.quadrature)?, Workspace::new());
        let mut cost = Cost::default();
        let mut work =
            Work { integrator: &mut integrator, workspace: &mut workspace, cost: &mut cost };
        let (found, bent) = find(self, control, &mut work)?;
        Ok(self.solution(Arc::new(integrator), found, cost, workspace.report, bent))
    }

    /// Returns the solution from the contact found.
    pub(crate) fn solution(
        &self,
        integrator: Arc<Engine<T>>,
        found: ContactState<T>,
        cost: Cost,
        report: Report,
        bent: Option<Box<Gap<'b, T>>>,
    ) -> Solution<'b, T> {
        let gap = bent.as_deref().unwrap_or(&self.gap).tilted(found.tilt).into_owned();
        let (kappa, has_default_stiffness) = (self.kappa, self.has_default_stiffness());
        let elasticity = self.elasticity().ok().flatten();
        Solution { gap, integrator, kappa, has_default_stiffness, elasticity, found, cost, report }
    }
}

/// Finds the limits with an integrator that has been reset, from the contacts in the workspace. The
/// cost is added whether the search succeeds or not.
pub(crate) fn find<'b, T: Real>(
    contact: &Contact<'b, T>,
    control: Control<T>,
    work: &mut Work<'_, T>,
) -> Fallible<T, Found<'b, T>> {
    let found = contact.check(control).and_then(|()| find_checked(contact, control, work));
    *work.cost += work.integrator.cost();
    found.map_err(|error| error.with_stiffness(contact.has_default_stiffness()))
}

/// Finds the contact of a checked scene, ready for its pressures.
fn find_checked<'b, T: Real>(
    contact: &Contact<'b, T>,
    control: Control<T>,
    work: &mut Work<'_, T>,
) -> Fallible<T, Found<'b, T>> {
    (work.workspace.report, work.workspace.cell_work) = (Report::new(), 0);
    let kernel = bending::kernel(contact, control)?;
    let repeated = contact.repeated(work.cost)?;
    let contact = repeated.as_deref().unwrap_or(contact);
    if let Some(found) = apart::find(contact, control, work)? {
        certified(contact, &contact.gap, &found, work.integrator)?;
        return Ok((found, repeated.map(|row| Box::new(row.gap.clone()))));
    }
    let (mut found, bent) = match kernel {
        None => (find_under(contact, control, work)?, None),
        Some(kernel) => {
            let (found, gap) = bending::find(contact, &kernel, control, work)?;
            (found, Some(Box::new(gap)))
        }
    };
    // A width may be less than the rounding of x, and its load less than any number.
    check(found.interval)?;
    if found.strengths.into_iter().any(|strength| !strength.is_finite()) {
        return Err(SolveError::Overflow { interval: found.interval }.into());
    }
    let known = found.error.is_none_or(|error| error >= T::zero());
    if !known && found.adhesive == Ends::both(false) {
        return Err(SolveError::Overflow { interval: found.interval }.into());
    }
    found.ends = contact.ends_of(bent.as_deref().unwrap_or(&contact.gap));
    let gap = bent.as_deref().unwrap_or(&contact.gap).tilted(found.tilt);
    let integrator = &mut *work.integrator;
    integrator.ready(&gap, found.interval)?;
    if found.is_doubtful() {
        work.workspace.report.doubt();
    }
    certified(contact, &gap, &found, integrator)?;
    Ok((found, bent))
}

/// Certifies the contact found, if that was asked for.
fn certified<T: Real>(
    contact: &Contact<'_, T>,
    gap: &Gap<'_, T>,
    found: &ContactState<T>,
    integrator: &Engine<T>,
) -> Fallible<T, ()> {
    if contact.certified {
        certify(Solved { gap, integrator, kappa: contact.kappa, found })?;
    }
    Ok(())
}

/// Finds the contact that meets a control.
fn find_under<T: Real>(
    contact: &Contact<'_, T>,
    control: Control<T>,
    work: &mut Work<'_, T>,
) -> Fallible<T, ContactState<T>> {
    match (control, contact.edge_pressure) {
        (Control::Load(load), Some(wanted)) => {
            let found = by_edge_pressure(contact, wanted, load, work);
            let start = contact.start.map_or(Start::Middle, |_| Start::Given);
            work.workspace.report.end(start, found.map(|found| (Outcome::Unchecked, found)))
        }
        (Control::Load(load), None) => topology::find(contact, contact.under(load)?, work),
        (Control::HalfWidth(half_width), _) => {
            check_positive("half-width", half_width)?;
            let (kappa, edges) = (contact.kappa, contact.checked_edges()?);
            let conditions = Conditions { kappa, edges, given: Given::HalfWidth(half_width) };
            match topology::find(contact, conditions, work) {
                Err(error) if may_have_several(contact, &error, work) => {
                    by_load::find(contact, &HalfWidth, ("half-width", half_width), work)
                }
                found => found,
            }
        }
        (Control::PeakPressure(wanted), _) => {
            by_load::find(contact, &Peak::new(contact)?, ("peak pressure", wanted), work)
        }
        (Control::Approach { approach: wanted, references }, _) => {
            let bodies = contact.elasticity()?.ok_or(InputError::NoMaterials)?;
            by_load::find(contact, &ByApproach { references, bodies }, ("approach", wanted), work)
        }
        (Control::Moment { load, moment, about }, _) => {
            moment::find(contact, moment::LineOfLoad::of_moment(load, moment, about)?, work)
        }
        (Control::CentreOfPressure { load, at }, _) => {
            moment::find(contact, moment::LineOfLoad::through(load, at)?, work)
        }
    }
}

/// Finds the contacts that meet some conditions: limits in equilibrium, a check, and another set of
/// contacts at its fault, until there is none.
fn settle<T: Real>(search: &mut Search<'_, '_, '_, T>) -> Fallible<T, ContactState<T>> {
    let mut start = search.first()?;
    for _ in 0..MAX_SETS {
        let fault = match search.equilibrium(start) {
            Ok(found) => match search.check(&found) {
                Ok(()) => return Ok(found),
                Err(fault) => fault,
            },
            Err(fault) => fault,
        };
        start = search.revise(fault)?;
    }
    Err(search.not_found())
}

/// Tells whether a half-width may belong to several contacts, or to none as the width jumps at
/// corners, by the error of the search for one.
fn may_have_several<T: Real>(
    contact: &Contact<'_, T>,
    error: &ContactError<T>,
    work: &Work<'_, T>,
) -> bool {
    use SolveError::{HalfWidthTooLarge, NoEquilibrium, NoFirstContact, Overlap, Tension};
    let ContactError::Solve(error) = error else { return false };
    let may_jump = matches!(error, NoEquilibrium { .. } | NoFirstContact { .. });
    let may_be_wider = matches!(error, Overlap { .. } | Tension { .. } | HalfWidthTooLarge { .. });
    let is_one = contact.single_interval || contact.gap.is_convex();
    (may_jump || may_be_wider && !is_one) && work.may_find_several(contact)
}

/// Finds the contact with edges by the paper's Eq. (6), under a given load.
fn by_edge_pressure<T: Real>(
    contact: &Contact<'_, T>,
    wanted: EdgePressure<T>,
    load: T,
    work: &mut Work<'_, T>,
) -> Fallible<T, ContactState<T>> {
    let (kappa, range) = (contact.kappa, contact.gap.range());
    wanted.check(range[1] - range[0])?;
    check_positive("load", load)?;
    let equations = Equations::Pressure { kappa, load, wanted };
    let (on, error) =
        one_by_one::find(contact, equations, work.integrator, contact.start, work.cost)?;
    let m = work.integrator.moments(&contact.gap, on)?;
    let (edges, given) = (Ends::both(Edge::Fixed(load)), Given::Load(load));
    let conditions = Conditions { kappa, edges, given };
    Ok(ContactState::new(&conditions, on, load, Some(error), &m))
}
