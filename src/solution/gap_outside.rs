//! The gap between the loaded bodies outside the contact.
//!
//! With `h(x)` the gap before loading and `e` the nearer edge, the distance between the two elastic
//! surfaces is
//!
//! ```text
//! gap(x)  = h(x) - h(e) - 1/κ ∫ P(s) ln((x - s)/(e - s)) ds
//! gap'(x) = g(x) - 1/κ ∫ P(s)/(x - s) ds
//! ```
//!
//! (Johnson, *Contact Mechanics*, 1985, Eqs. 2.24 and 2.25 for one half-plane, added up for two).

use super::Solved;
use super::pressure_integral::{Integrals, MAX_PANELS};
use crate::gap::Sampler;
use crate::{
    ContactError, EvaluationError, Fallible, Interval, Pressure, Real, Solution, SolveError,
};

impl<T: Real> Solution<'_, T> {
    /// Returns the distance between the loaded bodies at `x` outside the contact, measured along y:
    /// a length, zero at both edges. Negative where the bodies would overlap.
    ///
    /// Each place takes an integral of the pressure: about 0.1 ms, up to some tens of milliseconds
    /// for bodies with corners. Next to an edge the gap is a small difference: its absolute error
    /// is the rounding of the heights Y of the bodies, and of `F/κ`.
    ///
    /// # Errors
    /// [`EvaluationError::InvalidPosition`] strictly inside the contact;
    /// [`SolveError::OutsideBodies`] beyond either body, and for NaN; those of
    /// [`pressure`](Self::pressure), of sampling the gap, and [`EvaluationError::Integral`].
    pub fn gap_at(&self, x: T) -> Result<T, ContactError<T>> {
        T::gap_at(self, x)
    }

    /// Returns the slope of the gap between the loaded bodies, positive where it opens towards
    /// larger x. Zero at a free edge, infinite at an edge of infinite pressure.
    ///
    /// # Errors
    /// As [`gap_at`](Self::gap_at), and [`EvaluationError::Singular`] at an edge that is not free.
    pub fn gap_slope(&self, x: T) -> Result<T, ContactError<T>> {
        T::gap_slope(self, x)
    }
}

impl<T: Real> Solved<'_, T> {
    /// Returns the distance between the loaded bodies at a place outside the contacts.
    pub fn gap_at(&self, x: T) -> Result<T, ContactError<T>> {
        self.gap_up_to(MAX_PANELS, x)
    }

    /// Returns the distance by integrals that are given up after a number of panels.
    pub fn gap_up_to(&self, panels: usize, x: T) -> Fallible<T, T> {
        let x = self.gap.folded(x);
        let (edge, _) = self.nearest_edge(x)?;
        let separation = self.found.apart.unwrap_or(T::zero());
        let beyond = x - edge;
        if beyond.is_zero() {
            return Ok(separation);
        }
        let mut sampler = Sampler::default();
        let [from, to] = self.gap.range();
        let at_edge = sampler.height(self.gap, edge.max(from).min(to))?;
        let bodies = sampler.height(self.gap, x)? - at_edge;
        if self.found.apart.is_some() {
            return Ok(bodies + separation);
        }
        let integrals = Integrals::new(*self)?.up_to(panels);
        let [pushed] =
            integrals.over(edge, |distance, strength| [strength * (beyond / distance).ln_1p()])?;
        Ok(bodies - pushed / self.kappa)
    }

    pub fn gap_slope(&self, x: T) -> Result<T, ContactError<T>> {
        let x = self.gap.folded(x);
        let (edge, free) = self.nearest_edge(x)?;
        if x == edge {
            return if free { Ok(T::zero()) } else { Err(EvaluationError::Singular { x }.into()) };
        }
        let bodies = Sampler::default().slope(self.gap, x)?;
        if self.found.apart.is_some() {
            return Ok(bodies);
        }
        let pull = Pressure::new(*self)?.cauchy_transform()?.at(x, T::zero())[0].re;
        Ok(bodies - pull / self.kappa)
    }

    /// Returns the edge nearest to a point outside the contacts, with a flag: the edge is free.
    fn nearest_edge(&self, x: T) -> Fallible<T, (T, bool)> {
        let (contacts, range) = (self.contacts(), self.gap.range());
        let (next, inside) = Interval::find(contacts, x);
        if let Some(interval) = inside {
            return Err(EvaluationError::InvalidPosition { x, inside: false, interval }.into());
        }
        let Interval { left, right } = self.found.interval;
        // A rounded edge may lie beyond the end of a body.
        if x != left && x != right && !(x >= range[0] && x <= range[1]) {
            return Err(SolveError::OutsideBodies { x, range }.into());
        }
        let before = next.checked_sub(1).map(|i| (contacts[i].right, self.free(i).right));
        let after = contacts.get(next).map(|on| (on.left, self.free(next).left));
        Ok(match (before, after) {
            (Some(before), Some(after)) if x - before.0 <= after.0 - x => before,
            (Some(before), None) => before,
            (_, after) => after.unwrap_or((left, self.found.free.left)),
        })
    }
}
