//! The gap between the loaded bodies beside the contact.
//!
//! With `h(x)` the gap before loading and `e` the nearer edge, the two elastic surfaces leave between
//! them
//!
//! ```text
//! gap(x)  = h(x) - h(e) - 1/κ ∫ P(s) ln((x - s)/(e - s)) ds
//! gap'(x) = g(x) - 1/κ ∫ P(s)/(x - s) ds
//! ```
//!
//! (Johnson, *Contact Mechanics*, 1985, Eqs. 2.24 and 2.25 for one half-plane, added up for two).

use crate::gap::Sampler;
use crate::integral::Integrals;
use crate::{ContactError, Interval, Real, Solution};

impl<T: Real> Solution<'_, T> {
    /// The distance between the loaded bodies at `x` outside the contact, measured along y: a length,
    /// zero at both edges. Negative where the bodies would overlap.
    ///
    /// Next to an edge it is a small difference: its absolute error is rounding of the heights Y of
    /// the bodies, and of `F/κ`.
    ///
    /// # Errors
    /// [`ContactError::Misplaced`] strictly inside the contact; [`ContactError::OutsideBodies`] beyond
    /// either body, and for NaN; those of [`pressure`](Self::pressure), of sampling the gap, and
    /// [`ContactError::Integral`].
    pub fn gap_at(&self, x: T) -> Result<T, ContactError<T>> {
        let (edge, outward) = self.edge_before(x)?;
        if outward.is_zero() {
            return Ok(T::zero());
        }
        let mut sampler = Sampler::default();
        let [from, to] = self.gap().range();
        let at_edge = sampler.height(self.gap(), edge.max(from).min(to))?;
        let bodies = sampler.height(self.gap(), x)? - at_edge;
        let [pushed] = Integrals::new(self)?
            .over(edge, |distance, strength| [strength * (outward / distance.abs()).ln_1p()])?;
        Ok(bodies - pushed / self.scale())
    }

    /// The slope of that gap: how fast it opens towards larger x. Zero at a free edge, infinite at one
    /// where the pressure is.
    ///
    /// # Errors
    /// As [`gap_at`](Self::gap_at), and [`ContactError::Singular`] at an edge that is not free.
    pub fn gap_slope(&self, x: T) -> Result<T, ContactError<T>> {
        let (edge, outward) = self.edge_before(x)?;
        let Interval { right, .. } = self.interval();
        if outward.is_zero() {
            let free = self.found().free[usize::from(edge == right)];
            return if free { Ok(T::zero()) } else { Err(ContactError::Singular { x }) };
        }
        let bodies = Sampler::default().slope(self.gap(), x)?;
        let pull = |distance: T, strength: T| [strength / distance];
        let [pull] = Integrals::new(self)?.over(x, pull)?;
        Ok(bodies - pull / self.scale())
    }

    /// The edge nearest to a point outside the contact, and how far the point is from it.
    fn edge_before(&self, x: T) -> Result<(T, T), ContactError<T>> {
        let (interval, range) = (self.interval(), self.gap().range());
        if interval.contains(x) {
            return Err(ContactError::Misplaced { x, inside: false, interval });
        }
        let Interval { left, right } = interval;
        // An edge may have been rounded to beyond the end of a body that it lies at.
        if x != left && x != right && !(x >= range[0] && x <= range[1]) {
            return Err(ContactError::OutsideBodies { x, range });
        }
        Ok(if x >= right { (right, x - right) } else { (left, left - x) })
    }
}
