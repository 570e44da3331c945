//! Bodies that are repeated on their way into a gap.

use super::Shape;
use crate::{CurvePoint, ParametricProfile, Piece, ProfileError, Real};

/// Repeated body; it has pieces, be it only one, so that its ends are known.
pub(crate) struct Repeated<'b, T: Real> {
    parts: Vec<Part<'b, T>>,
    /// Number of parts of each copy.
    each: usize,
}

/// Smooth piece of one copy, shifted along x.
#[derive(Clone)]
struct Part<'b, T: Real> {
    shape: Shape<'b, T>,
    /// Number of the piece in a body of several.
    index: Option<usize>,
    shift: T,
    k: [T; 2],
    ends: [CurvePoint<T>; 2],
}

impl<'b, T: Real> Repeated<'b, T> {
    /// Repeats a body, with these shifts from left to right.
    pub fn new(shape: &Shape<'b, T>, shifts: &[T]) -> Result<Self, ProfileError<T>> {
        let copies = shifts.iter().map(|&shift| parts(shape, shift));
        let parts = copies.collect::<Result<Vec<_>, _>>()?.concat();
        Ok(Self { each: parts.len() / shifts.len(), parts })
    }
}

/// Returns all pieces of a body, shifted.
fn parts<'b, T: Real>(shape: &Shape<'b, T>, shift: T) -> Result<Vec<Part<'b, T>>, ProfileError<T>> {
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
        ends.iter_mut().for_each(|point| point.x += shift);
        Ok(Part { shape: shape.clone(), index, shift, k, ends })
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
        let point = self.curve(|curve| curve.at(k));
        CurvePoint { x: point.x + self.shift, ..point }
    }

    fn slope_at(&self, x: T) -> Option<T> {
        self.curve(|curve| curve.slope_at(x - self.shift))
    }

    fn at_many(&self, k: &[T], points: &mut [CurvePoint<T>]) {
        self.curve(|curve| curve.at_many(k, points));
        points.iter_mut().for_each(|point| point.x += self.shift);
    }

    fn slope_deviation(&self, x: &[T], weights: &[T]) -> Option<T> {
        let x: Vec<T> = x.iter().map(|&x| x - self.shift).collect();
        self.shape.profile().slope_deviation(&x, weights)
    }
}

impl<T: Real> ParametricProfile<T> for Repeated<'_, T> {
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
