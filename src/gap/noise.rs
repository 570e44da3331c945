//! The noise of the bodies.

use super::Gap;
use crate::profile::{Noise, Piece};
use crate::{Body, Real};

impl<T: Real> Gap<'_, T> {
    /// Measures the noise of a body near a point of one of its pieces. The noise of heights is at
    /// least the rounding of the highest one, as a formula may have added terms of its size.
    pub(crate) fn noise(
        &self,
        body: Body,
        piece: &Piece<'_, T>,
        k: T,
        evaluations: &mut usize,
    ) -> Noise<T> {
        let surface = &self.bodies[body as usize];
        let ends = [surface.piece(0).ends[0].y, surface.piece(surface.len() - 1).ends[1].y];
        let highest = ends.map(|y| y.abs()).into_iter().filter(|y| y.is_finite());
        let y = T::of(2.0) * T::epsilon() * highest.fold(T::zero(), T::max);
        let measured = Noise::of_rounding(piece, k, evaluations);
        measured.map_or(Noise::zero_tolerance(), |noise| noise.max(Noise { x: T::zero(), y }))
    }
}
