//! Mean pressure, moment and centre of pressure.

use super::Solved;
use super::pressure_integral::{Density, Integrals};
use crate::contact::check_given;
use crate::{ContactError, Interval, Pressure, Real, Solution, SolveError};

impl<T: Real> Solution<'_, T> {
    /// Returns the mean pressure: F over the widths of all contacts, `F/(a + b)` for a single one;
    /// zero if the bodies are [apart](Self::is_apart).
    pub fn mean_pressure(&self) -> T {
        if self.is_apart() {
            return T::zero();
        }
        let half = |sum: T, on: &Interval<T>| sum + on.half_width();
        self.load() / (T::of(2.0) * self.intervals().iter().fold(T::zero(), half))
    }

    /// Returns the moment of the pressure about x = 0, `∫ x P dx`: a force. Its error is the
    /// rounding of F times the largest x of the contact; of several contacts with kinks of the
    /// slope some 1e-12 of F L, and more next to a corner: F L times the share by which x rounds
    /// the distance of a limit from it. With [`Midpoint`](crate::Midpoint), whose pressures
    /// between its points are good to a thousandth, it is some 1e-3 of F L.
    ///
    /// # Errors
    /// Those of [`pressure`](Self::pressure);
    /// [`EvaluationError::Integral`](crate::EvaluationError::Integral); [`SolveError::Overflow`].
    pub fn moment(&self) -> Result<T, ContactError<T>> {
        let interval = self.hull();
        let moment = interval.half_width() * T::moment(self)?;
        if moment.is_finite() { Ok(moment) } else { Err(SolveError::Overflow { interval }.into()) }
    }

    /// Returns the centre of pressure, `∫ x P dx/F`, where the load acts.
    ///
    /// # Errors
    /// Those of [`pressure`](Self::pressure);
    /// [`EvaluationError::Integral`](crate::EvaluationError::Integral);
    /// [`InputError::InvalidLoad`](crate::InputError::InvalidLoad) if F is zero.
    pub fn centre_of_pressure(&self) -> Result<T, ContactError<T>> {
        let load = self.load();
        check_given("load", load, !load.is_zero(), "not zero")?;
        Ok(self.hull().half_width() * (T::moment(self)? / load))
    }
}

impl<T: Real> Solved<'_, T> {
    /// Returns the moment over the half-width, a force per unit length: the moment may overflow
    /// where the centre of pressure does not.
    pub fn moment_by_half_width(&self) -> Result<T, ContactError<T>> {
        if self.found.apart.is_some() {
            return Ok(T::zero());
        }
        let on = self.found.interval;
        let (centre, half_width) = (on.centre(), on.half_width());
        let has_panels = self.integrator.panels().is_some();
        let one = if has_panels { Pressure::new(*self)?.potential()? } else { None };
        let about_centre = match one {
            Some(one) => one.moment(),
            None => {
                let share = |distance: T, strength: T| [-(distance / half_width) * strength];
                let [moment] = Integrals::new(*self)?.over(centre, share)?;
                moment
            }
        };
        Ok(centre / half_width * self.found.load + about_centre)
    }
}
