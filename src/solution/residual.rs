//! By how much a solution fails the integral equation.

use super::pressure_integral::{Density, Integrals};
use crate::{ContactError, Interval, Real, Solution};

impl<T: Real> Solution<'_, T> {
    /// `PV∫ P(s)/(x - s) ds - κ g(x)` at a place strictly inside the contact: by how much the
    /// pressure fails the integral equation, the paper's Eq. (3). A pressure.
    ///
    /// The integral is taken from values of P alone, by a quadrature that has nothing in common
    /// with those that gave them, and g from the curves themselves. At a breakpoint g is that of its left
    /// side; where a slope jumps there the integral is infinite.
    ///
    /// # Errors
    /// [`ContactError::InvalidPosition`] for an x not strictly inside; those of
    /// [`pressure`](Self::pressure), of sampling the gap, and [`ContactError::Integral`].
    pub fn residual(&self, x: T) -> Result<T, ContactError<T>> {
        let (_, Some(interval)) = Interval::find(self.intervals(), x) else {
            return Err(ContactError::InvalidPosition { x, inside: true, interval: self.hull() });
        };
        let integrals = Integrals::new(self.solved())?;
        let mut at_x = [T::zero()];
        integrals.density.values(&[x], &mut at_x)?;
        if !at_x[0].is_finite() {
            return Err(ContactError::Singular { x });
        }
        let at_x = at_x[0] * interval.chebyshev_weight(x);
        // PV∫ ds/((x - s) w(s)) is zero.
        // In the contact with x only: the others are regular.
        let difference = |own, distance: T, strength: T| {
            [(if own { strength - at_x } else { strength }) / distance]
        };
        let size = at_x.abs() / interval.half_width();
        let [sum] = integrals.over_as_of(size, x, difference)?;
        let slope = crate::gap::Sampler::default().slope(&self.gap, x)?;
        Ok(sum - self.kappa * slope)
    }
}
