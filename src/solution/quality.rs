//! Accuracy of a solution, its checks, and its cost.

use super::{Certificate, Report, Solution};
use crate::gap::Cost;
use crate::{ContactError, Ends, Real};

impl<T: Real> Solution<'_, T> {
    /// Returns the estimated error of the limits relative to the half-width: the uncertainty of the
    /// conditions at the edges from rounding, from the noise of the profiles' formulas and from the
    /// quadrature. `None` if both limits were given.
    ///
    /// It is a few units in the last place where the slope of the gap is analytic between the
    /// breakpoints. A much larger error means that a profile is noisy, or has a kink not declared
    /// as a breakpoint.
    pub fn limits_error(&self) -> Option<T> {
        self.found.error
    }

    /// Returns K_b and K_a, the strengths of the singularities at -b and at a, pressures: near `a`,
    /// `P ≈ K_a/sin θ` with `x = c + L cos θ`. They are zero to rounding at free edges; a negative
    /// strength at a fixed edge means that the body lifts off there. With several contacts the
    /// strengths are those at the outermost limits, and c and L belong to the contact there.
    pub fn edge_singularities(&self) -> Ends<T> {
        self.found.strengths
    }

    /// Returns the starts that the solve has tried, and the results of the checks.
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// Proves that the solution is a contact, and not only a solution of the equations: no tension
    /// inside, and no overlap on either side up to the ends of the bodies. For this it samples all
    /// of the gap anew: see [`Certificate`] for the proof and its cost.
    ///
    /// A body ends at a sharp corner ([`Edge::Fixed`](crate::Edge::Fixed),
    /// [`Edge::FreeUntil`](crate::Edge::FreeUntil)), however far its curve goes on. Between
    /// adhesive edges the bodies may pull at each other, and only the outside is checked.
    ///
    /// # Errors
    /// [`SolveError::FeatureMissed`](crate::SolveError::FeatureMissed) where the panels have missed
    /// a feature in the contact; [`SolveError::Unbalanced`](crate::SolveError::Unbalanced) if the
    /// samples give a free edge a larger residual than [`limits_error`](Self::limits_error) allows
    /// for; [`InputError::Profile`](crate::InputError::Profile) for heights that are not finite;
    /// [`SolveError::Tension`](crate::SolveError::Tension) at the least pressure,
    /// [`SolveError::Overlap`](crate::SolveError::Overlap) at the deepest overlap,
    /// [`SolveError::Undecided`](crate::SolveError::Undecided), also for an outcome that is
    /// [doubtful](crate::Outcome::Doubtful); those of sampling the gap.
    pub fn certify(&self) -> Result<Certificate<T>, ContactError<T>> {
        T::certify(self)
    }

    /// Returns the cost of finding the limits, including the pressures taken for
    /// [`Control::PeakPressure`](crate::Control::PeakPressure).
    pub fn cost(&self) -> Cost {
        self.cost
    }
}
