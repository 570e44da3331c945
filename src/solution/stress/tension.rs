//! Largest tension along the surface.

use super::super::peak::{narrow, rises};
use super::Subsurface;
use crate::numerics::ascending;
use crate::{ContactError, EvaluationError, Extremum, Fallible, Interval, Real, Side};

impl<T: Real> Subsurface<'_, T> {
    /// Finds the largest tension along the surface, the largest σ_x at depth 0, and its place. This
    /// stress opens cracks.
    ///
    /// A body that is pulled towards positive x is stretched most at the left limit of a contact:
    /// with sliding friction by 2 μ p₀ under Hertz's pressure (Johnson, §7.1). The tension may be
    /// larger inside a contact, where the pressure nearly vanishes. Without friction it is zero on
    /// a half-plane, outside the contacts; a coating is stretched where it bends.
    ///
    /// # Errors
    /// [`EvaluationError::Singular`] where the tension is infinite: at an adhesive edge, and at an
    /// edge of infinite pressure from which the traction pulls; those of [`at`](Self::at);
    /// [`SolveError::Cancelled`](crate::SolveError::Cancelled) by the function that
    /// [watches](crate::Contact::watch).
    pub fn max_tension(&self) -> Result<Extremum<T>, ContactError<T>> {
        T::largest_tension(self)
    }

    pub(crate) fn largest_tension(&self) -> Fallible<T, Extremum<T>> {
        let zero = T::zero();
        let is_stretched = |side, x, strength| {
            let stick = self.stick.as_ref().and_then(|stick| {
                let solved = stick.solution.solved();
                solved.held_limits().find(|&(i, side, _)| stick.solution.intervals()[i][side] == x)
            });
            let pull = self.friction * (strength - stick.map_or(zero, |(.., strength)| strength));
            match side {
                Side::Left => pull > zero,
                Side::Right => pull < zero,
            }
        };
        self.check_edges(|side, x, strength| strength < zero || is_stretched(side, x, strength))?;
        let mut best = Extremum { x: self.hull().left, value: zero };
        for (contact, &on) in self.solution.intervals().iter().enumerate() {
            // Beside a contact of half-planes σ_x rises towards a limit, as the traction has one
            // sign.
            let mut grid = Vec::new();
            for x in [self.wide_grid(contact, on), self.limits(on)].concat() {
                grid.push([x, self.tension(x, on)?]);
            }
            grid.sort_by(|[one, _], [other, _]| ascending(one, other));
            for rise in rises(&grid) {
                if rise.bound <= best.value {
                    break;
                }
                let top = narrow(rise.bracket, |places, values| {
                    for (&x, value) in places.iter().zip(values) {
                        *value = self.tension(x, on)?;
                    }
                    Ok(())
                })?;
                for x in [rise.highest, top] {
                    let value = self.tension(x, on)?;
                    if value > best.value {
                        best = Extremum { x, value };
                    }
                }
            }
        }
        Ok(best)
    }

    /// Returns σ_x on the surface; minus infinity where the pressure is infinite.
    fn tension(&self, x: T, on: Interval<T>) -> Fallible<T, T> {
        self.solution.gap.check_watch(self.solution.cost(), on)?;
        match self.stress(x, T::zero()) {
            Ok(stress) => Ok(stress.sigma_x),
            Err(ContactError::Evaluation(EvaluationError::Singular { .. })) => {
                Ok(T::of(f64::NEG_INFINITY))
            }
            Err(error) => Err(error),
        }
    }
}
