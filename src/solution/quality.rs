//! How far a solution can be trusted, and what it took.

use super::{Certificate, Report, Solution, certify};
use crate::gap::Cost;
use crate::{ContactError, Ends, Real};

impl<T: Real> Solution<'_, T> {
    /// Estimated error of the limits, relative to the half-width, where they were sought: what
    /// rounding, the noise of the profiles' formulas and the quadrature leave open of the
    /// conditions at the edges. `None` where both limits were given.
    ///
    /// It is a few units in the last place where the slope of the gap is analytic between the
    /// breakpoints. Much more says that a profile is noisy or has a kink not declared as a breakpoint.
    pub fn limits_error(&self) -> Option<T> {
        self.found.error
    }

    /// K_b and K_a, the strengths of the singularities at -b and at a, pressures: near `a`,
    /// `P ≈ K_a/sin θ` with `x = c + L cos θ`. Zero to rounding for free edges; at a fixed edge
    /// a negative strength means that the body lifts off there. Of several contacts these are the
    /// outermost limits, c and L those of the contact there.
    pub fn edge_singularities(&self) -> Ends<T> {
        self.found.strengths
    }

    /// The starts that the solve has tried, and what the checks say of the solution.
    pub fn report(&self) -> &Report {
        &self.report
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
        certify(self.solved())
    }

    /// What finding the limits has cost, the pressures that [`Control::PeakPressure`](crate::Control::PeakPressure) takes
    /// for it included.
    pub fn cost(&self) -> Cost {
        self.cost
    }
}
