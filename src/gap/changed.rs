//! Bodies that are changed on their way into a gap: bent by the pressure, or repeated.

use super::{Gap, Shape};
use crate::kernel::Bend;
use crate::{CurvePoint, ParametricProfile, Piece, ProfileError, Real};
use std::sync::Arc;

/// Body with a change; it has pieces, be it only one, so that its ends are known.
pub(crate) struct Changed<'b, T: Real> {
    parts: Vec<Part<'b, T>>,
    /// Number of parts of each copy of a repeated body.
    each: usize,
    /// Both bodies before they are bent.
    before: Option<Gap<'b, T>>,
}

/// Smooth piece of a changed body.
#[derive(Clone)]
struct Part<'b, T: Real> {
    shape: Shape<'b, T>,
    /// Number of the piece in a body of several.
    index: Option<usize>,
    change: Change<'b, T>,
    k: [T; 2],
    ends: [CurvePoint<T>; 2],
}

/// Change of a curve.
#[derive(Clone)]
enum Change<'b, T: Real> {
    /// A bend, times a factor, is added to the heights.
    Bend(Arc<Bend<'b, T>>, T),
    /// The curve is shifted along x.
    Shift(T),
}

impl<T: Real> Change<'_, T> {
    fn point(&self, point: CurvePoint<T>) -> CurvePoint<T> {
        let CurvePoint { x, y, dx, dy } = point;
        match self {
            Self::Bend(bend, scale) => {
                let [slope, height] = bend.both(x);
                CurvePoint { x, y: y + *scale * height, dx, dy: dy + *scale * slope * dx }
            }
            Self::Shift(shift) => CurvePoint { x: x + *shift, y, dx, dy },
        }
    }
}

impl<'b, T: Real> Changed<'b, T> {
    /// Bends a body by a multiple of a bend.
    pub fn bent(
        shape: &Shape<'b, T>,
        before: &Gap<'b, T>,
        bend: &Arc<Bend<'b, T>>,
        scale: T,
    ) -> Result<Self, ProfileError<T>> {
        let parts = parts(shape, &Change::Bend(bend.clone(), scale))?;
        Ok(Self { each: parts.len(), parts, before: Some(before.clone()) })
    }

    /// Repeats a body, with these shifts from left to right.
    pub fn repeated(shape: &Shape<'b, T>, shifts: &[T]) -> Result<Self, ProfileError<T>> {
        let copies = shifts.iter().map(|&shift| parts(shape, &Change::Shift(shift)));
        let parts = copies.collect::<Result<Vec<_>, _>>()?.concat();
        Ok(Self { each: parts.len() / shifts.len(), parts, before: None })
    }

    /// Returns both bodies before they are bent.
    pub fn before(&self) -> Option<&Gap<'b, T>> {
        self.before.as_ref()
    }

    pub fn bend(&self) -> Option<&Bend<'b, T>> {
        match &self.parts[0].change {
            Change::Bend(bend, _) => Some(bend),
            Change::Shift(_) => None,
        }
    }
}

/// Returns all pieces of a body, changed.
fn parts<'b, T: Real>(
    shape: &Shape<'b, T>,
    change: &Change<'b, T>,
) -> Result<Vec<Part<'b, T>>, ProfileError<T>> {
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
        ends.iter_mut().for_each(|point| *point = change.point(*point));
        Ok(Part { shape: shape.clone(), index, change: change.clone(), k, ends })
    };
    (0..=last).map(part).collect()
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
        self.change.point(self.curve(|curve| curve.at(k)))
    }

    fn slope_at(&self, x: T) -> Option<T> {
        match &self.change {
            Change::Bend(bend, scale) => {
                let slope = self.curve(|curve| curve.slope_at(x))?;
                Some(slope + *scale * bend.slope(x))
            }
            Change::Shift(shift) => self.curve(|curve| curve.slope_at(x - *shift)),
        }
    }

    fn at_many(&self, k: &[T], points: &mut [CurvePoint<T>]) {
        self.curve(|curve| curve.at_many(k, points));
        points.iter_mut().for_each(|point| *point = self.change.point(*point));
    }

    fn slope_deviation(&self, x: &[T], weights: &[T]) -> Option<T> {
        let shift = if let Change::Shift(shift) = self.change { shift } else { T::zero() };
        let x: Vec<T> = x.iter().map(|&x| x - shift).collect();
        self.shape.profile().slope_deviation(&x, weights)
    }
}

impl<T: Real> ParametricProfile<T> for Changed<'_, T> {
    fn domain(&self) -> [T; 2] {
        self.parts[0].domain()
    }

    fn at(&self, k: T) -> CurvePoint<T> {
        self.parts[0].at(k)
    }

    fn slope_deviation(&self, x: &[T], weights: &[T]) -> Option<T> {
        let copies = self.parts.chunks(self.each);
        copies.enumerate().try_fold(T::zero(), |sum, (i, copy)| {
            let start = copy[0].ends[0].x;
            let end = self.parts.get((i + 1) * self.each).map(|next| next.ends[0].x);
            let is_own = |x: T| (i == 0 || x > start) && end.is_none_or(|end| x <= end);
            let own = x.iter().zip(weights).filter(|(x, _)| is_own(**x));
            let (x, weights): (Vec<T>, Vec<T>) = own.unzip();
            Some(sum.hypot(copy[0].slope_deviation(&x, &weights)?))
        })
    }

    fn pieces(&self) -> usize {
        self.parts.len()
    }

    fn piece(&self, index: usize) -> Option<Piece<'_, T>> {
        let Part { k, ends, .. } = self.parts.get(index)?;
        Some(Piece { curve: &self.parts[index], k: *k, ends: *ends })
    }
}
