//! Residual of the integral equation.

use super::pressure_integral::{Density, Integrals};
use crate::{ContactError, EvaluationError, Interval, Real, Solution};

impl<T: Real> Solution<'_, T> {
    /// Returns the residual of the integral equation, the paper's Eq. (1), at a place strictly
    /// inside the contact: `PV∫ P(s)/(x - s) ds + ∫ K(x, s) P(s) ds - κ g(x)`, a pressure. Without
    /// a layer or another kernel K is zero, and the equation is Eq. (3).
    ///
    /// The integral uses values of P alone, by a quadrature independent of the solver's, and g
    /// comes from the curves themselves. At a breakpoint g is taken on its left side; where the
    /// slope jumps there the integral is infinite.
    ///
    /// # Errors
    /// [`EvaluationError::InvalidPosition`] for an x not strictly inside; those of
    /// [`pressure`](Self::pressure), of sampling the gap, and [`EvaluationError::Integral`].
    pub fn residual(&self, x: T) -> Result<T, ContactError<T>> {
        let x = self.gap.folded(x);
        let (_, Some(interval)) = Interval::find(self.intervals(), x) else {
            return Err(EvaluationError::InvalidPosition {
                x,
                inside: true,
                interval: self.hull(),
            }
            .into());
        };
        let integrals = Integrals::new(self.solved())?;
        let mut at_x = [T::zero()];
        integrals.density.values(&[x], &mut at_x)?;
        if !at_x[0].is_finite() {
            return Err(EvaluationError::Singular { x }.into());
        }
        let at_x = at_x[0] * interval.chebyshev_weight(x);
        // PV∫ ds/((x - s) w(s)) is zero over the contact with x, so that a constant can be
        // subtracted there; the integrals over the others are regular.
        let difference = |own, distance: T, strength: T| {
            [(if own { strength - at_x } else { strength }) / distance]
        };
        let size = at_x.abs() / interval.half_width();
        let [sum] = integrals.over_as_of(size, x, difference)?;
        let slope = crate::gap::Sampler::default().slope(&self.gap, x)?;
        // The slope of the bent bodies has r as the solve has found it.
        let bent = match self.gap.bend() {
            Some(bend) => {
                let own = bend.kernel_of_bodies();
                let kernel = |distance: T, strength: T| [strength * own.slope(x, x - distance)];
                integrals.over(x, kernel)?[0] - bend.slope(x)
            }
            None => T::zero(),
        };
        Ok(sum + bent - self.kappa * slope)
    }
}
