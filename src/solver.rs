//! Solving again: the next load, the next time step.

use crate::contact::Load;
use crate::quadrature::{Engine, Quadrature};
use crate::solution::{Solution, Worker};
use crate::{Contact, ContactError, Interval, Real};

/// A solver with a workspace of its own, which starts from the last contact it has found.
///
/// The same scene under another load is solved from the samples at hand, and the curves are
/// called again only where the contact grows beyond them. Another scene, such as the same bodies
/// a time step later, is sampled anew, but only around the contact it had before. Once its
/// workspace has grown to what the scenes need, solving allocates nothing.
///
/// Results depend on the calls made and on nothing else. One solver serves one thread, and may be
/// sent to another.
///
/// ```
/// use linecontact::{Contact, ContactError, Curve, CurvePoint, Flat, Load};
///
/// // A cam that turns: its lowest point moves.
/// let cam = |angle: f64| {
///     Curve::new([-1.0, 1.0], move |k: f64| {
///         let x = k - 0.1 * angle.sin();
///         CurvePoint { x: k, y: x * x / 2.0, dx: 1.0, dy: x }
///     })
/// };
/// let first = cam(0.0);
/// let mut solver = Contact::new(&Flat, &first)?.solver()?;
/// for step in 0..10 {
///     let angle = 0.1 * f64::from(step);
///     let body = cam(angle);
///     let contact = Contact::new(&Flat, &body)?;
///     let solution = solver.solve(&contact, Load::PerLength(0.02))?;
///     assert!((solution.a() - 0.2 - 0.1 * angle.sin()).abs() < 1e-14);
/// }
/// # Ok::<(), ContactError<f64>>(())
/// ```
pub struct Solver<T: Real> {
    engine: Box<dyn Engine<T>>,
    /// The gap last solved, by its number, and the contact found.
    last: Option<(u64, Interval<T>)>,
}

impl<T: Real> Solver<T> {
    /// A solver with a quadrature of its own, where there is no scene yet to make it from.
    ///
    /// # Errors
    /// [`ContactError::Segments`], [`ContactError::Tolerance`].
    pub fn with(quadrature: &dyn Quadrature<T>) -> Result<Self, ContactError<T>> {
        Ok(Self { engine: quadrature.engine()?, last: None })
    }

    /// Solves a scene, as [`Contact::solve`] does. The quadrature is the solver's, that of the
    /// scene it was made from.
    ///
    /// # Errors
    /// Those of [`Contact::solve`]. After an error the next scene is solved from scratch.
    pub fn solve<'s>(
        &'s mut self,
        contact: &'s Contact<'_, T>,
        load: Load<T>,
    ) -> Result<Solution<'s, T>, ContactError<T>> {
        let gap = contact.gap();
        let last = self.last.take();
        self.engine.reset(last.is_some_and(|(number, _)| number == gap.number()));
        let (found, cost) = contact.find(&mut *self.engine, last.map(|(_, on)| on), load)?;
        let worker = Worker::Lent(&*self.engine);
        let solution =
            contact.approved(Solution::new(gap, worker, contact.scale(), found, cost))?;
        self.last = Some((gap.number(), found.interval));
        Ok(solution)
    }
}

impl<T: Real> std::fmt::Debug for Solver<T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Solver").field("last", &self.last).finish_non_exhaustive()
    }
}
