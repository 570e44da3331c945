//! A body that the pressure bends.

use super::{Gap, Shape};
use crate::kernel::Bend;
use crate::{CurvePoint, ParametricProfile, Piece, ProfileError, Real};
use std::sync::Arc;

/// Body with a bend added to its heights; it has pieces, be it only one, so that its ends are
/// known.
pub(crate) struct Bent<'b, T: Real> {
    parts: Vec<Part<'b, T>>,
    /// Both bodies before.
    before: Gap<'b, T>,
}

/// Smooth piece of a bent body.
struct Part<'b, T: Real> {
    shape: Shape<'b, T>,
    /// Number of the piece in a body of several.
    index: Option<usize>,
    bend: Arc<Bend<'b, T>>,
    /// Factor of the bend.
    scale: T,
    k: [T; 2],
    ends: [CurvePoint<T>; 2],
}

impl<'b, T: Real> Bent<'b, T> {
    /// Bends a body by a multiple of a bend.
    pub fn new(
        shape: &Shape<'b, T>,
        before: &Gap<'b, T>,
        bend: &Arc<Bend<'b, T>>,
        scale: T,
    ) -> Result<Self, ProfileError<T>> {
        let profile = shape.profile();
        let count = Piece::first_of(profile)?.map(|(count, _)| count);
        let last = count.map_or(0, |count| count - 1);
        let part = |i: usize| {
            let index = count.map(|_| i);
            let piece = match index {
                Some(index) => {
                    profile.piece(index).ok_or(ProfileError::Pieces { count: last + 1, index })?
                }
                None => Piece::new(profile)?,
            };
            let Piece { k, mut ends, .. } = piece;
            ends.iter_mut().for_each(|point| *point = bent(*point, bend, scale));
            Ok(Part { shape: shape.clone(), index, bend: bend.clone(), scale, k, ends })
        };
        let parts = (0..=last).map(part).collect::<Result<_, _>>()?;
        Ok(Self { parts, before: before.clone() })
    }

    /// Returns both bodies before.
    pub fn before(&self) -> &Gap<'b, T> {
        &self.before
    }

    pub fn bend(&self) -> &Bend<'b, T> {
        &self.parts[0].bend
    }
}

/// Returns a point of a curve after the bend.
fn bent<T: Real>(point: CurvePoint<T>, bend: &Bend<'_, T>, scale: T) -> CurvePoint<T> {
    let CurvePoint { x, y, dx, dy } = point;
    let [slope, height] = bend.both(x);
    CurvePoint { x, y: y + scale * height, dx, dy: dy + scale * slope * dx }
}

impl<T: Real> Part<'_, T> {
    fn curve<R>(&self, ask: impl FnOnce(&dyn ParametricProfile<T>) -> R) -> R {
        let profile = self.shape.profile();
        match self.index.and_then(|index| profile.piece(index)) {
            Some(piece) => ask(piece.curve),
            None => ask(profile),
        }
    }
}

impl<T: Real> ParametricProfile<T> for Part<'_, T> {
    fn domain(&self) -> [T; 2] {
        [self.k[0].min(self.k[1]), self.k[0].max(self.k[1])]
    }

    fn at(&self, k: T) -> CurvePoint<T> {
        let point = self.curve(|curve| curve.at(k));
        bent(point, &self.bend, self.scale)
    }

    fn slope_at(&self, x: T) -> Option<T> {
        let slope = self.curve(|curve| curve.slope_at(x))?;
        Some(slope + self.scale * self.bend.slope(x))
    }

    fn at_many(&self, k: &[T], points: &mut [CurvePoint<T>]) {
        self.curve(|curve| curve.at_many(k, points));
        for point in points {
            *point = bent(*point, &self.bend, self.scale);
        }
    }

    fn slope_deviation(&self, x: &[T], weights: &[T]) -> Option<T> {
        self.shape.profile().slope_deviation(x, weights)
    }
}

impl<T: Real> ParametricProfile<T> for Bent<'_, T> {
    fn domain(&self) -> [T; 2] {
        self.parts[0].domain()
    }

    fn at(&self, k: T) -> CurvePoint<T> {
        self.parts[0].at(k)
    }

    fn slope_deviation(&self, x: &[T], weights: &[T]) -> Option<T> {
        self.parts[0].slope_deviation(x, weights)
    }

    fn pieces(&self) -> usize {
        self.parts.len()
    }

    fn piece(&self, index: usize) -> Option<Piece<'_, T>> {
        let Part { k, ends, .. } = self.parts.get(index)?;
        Some(Piece { curve: &self.parts[index], k: *k, ends: *ends })
    }
}
