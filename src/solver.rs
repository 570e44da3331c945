//! Repeated solves: the next load, the next time step.

use crate::contact::Control;
use crate::gap::{Cost, GapId, Sampler};
use crate::quadrature::Engine;
use crate::solution::{PartialSlip, Shear, Solution};
use crate::solve::{Work, Workspace, find, first_touch};
use crate::{Contact, ContactError, Fallible, InputError, Real, SolveError};
use std::sync::Arc;

/// A solver with a workspace of its own, which starts from the last contact it has found.
///
/// The same scene under another load is solved from the samples at hand; the curves are called
/// again only where the contact grows beyond them. Another scene, such as the same bodies a time
/// step later, is sampled anew, but only around its last contact. Once the workspace has grown to
/// the size of the scenes, solving allocates nothing, provided that each solution is dropped before
/// the next solve. A solution that is kept keeps its samples, and the solver goes on with a copy.
///
/// If the search from the last contact fails, with any error but [`SolveError::Cancelled`], the
/// solver forgets its state and searches from scratch, as [`Contact::solve`] does: it refuses the
/// same scenes. The [cost](Solution::cost) is the sum of both searches.
///
/// Results depend on the calls made and on nothing else. One solver serves one thread, and may be
/// sent to another.
///
/// ```
/// use linecontact::{Contact, ContactError, Control, Curve, CurvePoint, Flat, Solver};
///
/// // A cam that turns: its lowest point moves.
/// let cam = |angle: f64| {
///     Curve::new([-1.0, 1.0], move |k: f64| {
///         let x = k - 0.1 * angle.sin();
///         CurvePoint { x: k, y: x * x / 2.0, dx: 1.0, dy: x }
///     })
/// };
/// let mut solver = Solver::new();
/// for step in 0..10 {
///     let angle = 0.1 * f64::from(step);
///     let body = cam(angle);
///     let contact = Contact::new(&Flat, &body)?;
///     let solution = solver.solve(&contact, Control::Load(0.02))?;
///     assert!((solution.a() - 0.2 - 0.1 * angle.sin()).abs() < 1e-14);
/// }
/// # Ok::<(), ContactError<f64>>(())
/// ```
pub struct Solver<T: Real> {
    integrator: Option<Arc<Engine<T>>>,
    workspace: Workspace<T>,
    /// Number of the gap last solved; its contacts are in the workspace.
    last: Option<(GapId<T>, Option<T>)>,
}

impl<T: Real> Solver<T> {
    /// Creates a solver that has not solved anything yet.
    #[must_use]
    pub fn new() -> Self {
        Self { integrator: None, workspace: Workspace::new(), last: None }
    }

    /// Solves a scene, as [`Contact::solve`] does. If its quadrature differs from that of the last
    /// scene ([`Quadrature::serves`](crate::quadrature::Quadrature::serves)), it is solved from
    /// scratch.
    ///
    /// # Errors
    /// The errors of [`Contact::solve`]. After an error the next scene is solved from scratch.
    pub fn solve<'b>(
        &mut self,
        contact: &Contact<'b, T>,
        control: Control<T>,
    ) -> Result<Solution<'b, T>, ContactError<T>> {
        T::solve_next(self, contact, control)
    }

    pub(crate) fn solve_next<'b>(
        &mut self,
        contact: &Contact<'b, T>,
        control: Control<T>,
    ) -> Fallible<T, Solution<'b, T>> {
        let serves = |integrator: &Arc<Engine<T>>| integrator.is_of(contact.quadrature);
        let mut is_warm = self.last.is_some() && self.integrator.as_ref().is_some_and(serves);
        let mut spent = Cost::default();
        loop {
            match self.search(contact, control, is_warm, &mut spent) {
                // The last contact may be the cause of the failure.
                Err(error)
                    if is_warm
                        && !matches!(error, ContactError::Solve(SolveError::Cancelled { .. })) =>
                {
                    is_warm = false;
                }
                found => return found,
            }
        }
    }

    /// Returns the place where two bodies would touch first, and the gap there before loading.
    pub(crate) fn first_touch(&mut self, contact: &Contact<'_, T>) -> Fallible<T, [T; 2]> {
        let x = first_touch(contact, &mut self.workspace, &mut Cost::default())?;
        Ok([x, Sampler::default().height(&contact.gap, x)?])
    }

    /// Searches once, from the last contact or from scratch. Adds the cost of the search to
    /// `spent`.
    fn search<'b>(
        &mut self,
        contact: &Contact<'b, T>,
        control: Control<T>,
        is_warm: bool,
        spent: &mut Cost,
    ) -> Fallible<T, Solution<'b, T>> {
        if !is_warm {
            *self = Self::new();
        }
        let integrator = match &mut self.integrator {
            Some(integrator) => integrator,
            none => none.insert(Arc::new(Engine::new(contact.quadrature)?)),
        };
        // A kept solution keeps its integrator.
        let own = Arc::make_mut(integrator);
        let bodies = contact.bodies();
        own.reset(self.last.take() == Some(bodies));
        let mut cost = Cost::default();
        let mut work = Work { integrator: own, workspace: &mut self.workspace, cost: &mut cost };
        let found = find(contact, control, &mut work);
        *spent += cost;
        let (found, bent) = found?;
        self.workspace.keep(integrator.contacts(&found.interval));
        self.last = Some(bodies);
        Ok(contact.solution(integrator.clone(), found, *spent, self.workspace.report, bent))
    }
}

impl<T: Real> Solver<T> {
    /// Solves a scene with a tangential force that friction carries, as [`Contact::partial_slip`]
    /// does. The next solve starts from the stick zones.
    ///
    /// # Errors
    /// The errors of [`Contact::partial_slip`].
    pub fn partial_slip<'b>(
        &mut self,
        contact: &Contact<'b, T>,
        control: Control<T>,
        shear: Shear<T>,
    ) -> Result<PartialSlip<'b, T>, ContactError<T>> {
        contact.check_shear(&shear)?;
        let normal = self.solve(contact, control)?;
        let (sticking, load) = contact.sticking(&normal, &shear)?;
        let stick = self.solve(&sticking, Control::Load(load)).map_err(|error| {
            if shear.tension.is_zero() || !matches!(error, ContactError::Solve(_)) {
                return error;
            }
            let why =
                "the tension is so large that the bodies would stick off each other; lower it";
            ContactError::Input(InputError::SlipNotSupported { why })
        })?;
        PartialSlip::new(normal, stick, shear)
    }
}

impl<T: Real> Default for Solver<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real> std::fmt::Debug for Solver<T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Solver").field("last", &self.last).finish_non_exhaustive()
    }
}

impl<'b, T: Real> Contact<'b, T> {
    /// Finds the contact, and its stick zones under a tangential force that friction carries: see
    /// [`Shear`]. The bodies must be alike, or both incompressible; this is assumed of bodies whose
    /// materials are unknown. A corner that is [`Edge::Fixed`](crate::Edge::Fixed) may slip.
    ///
    /// # Errors
    /// The errors of [`solve`](Self::solve); [`InputError::InvalidSlipFriction`],
    /// [`InputError::InvalidShear`], [`SolveError::SlipsEverywhere`],
    /// [`SolveError::SticksEverywhere`], [`SolveError::ReversedSlip`],
    /// [`InputError::UnlikeBodies`]; [`InputError::SlipNotSupported`] with adhesion, and with
    /// edges by the paper's Eq. (6).
    pub fn partial_slip(
        &self,
        control: Control<T>,
        shear: Shear<T>,
    ) -> Result<PartialSlip<'b, T>, ContactError<T>> {
        Solver::new().partial_slip(self, control, shear)
    }
}
