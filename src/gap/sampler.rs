//! The slope of the gap at any x, by inverting `X(k) = x`.
//!
//! Each value costs one inversion for each body that needs one. The inversion starts from the last
//! point of the curve, moved on by Newton's rule, so that neighbouring abscissae cost two or three
//! evaluations each.

use super::{Cost, Gap};
use crate::profile::Piece;
use crate::search::{Bracket, SearchError, try_find_with_slope};
use crate::{
    Body, ContactError, CurvePoint, Fallible, InputError, ProfileError, Real, Side, SolveError,
};

/// Source of values of the slope of the gap, with their cost.
///
/// It holds numbers only; the gap is passed with each abscissa, and must be the same gap.
#[derive(Clone, Debug)]
pub struct Sampler<T: Real> {
    near: [Option<Near<T>>; 2],
    /// Cost so far.
    pub cost: Cost,
    /// Largest `|X(k) - x|` after the inversions.
    pub(crate) missed: T,
    /// Largest |Y| of either body among the heights taken.
    pub(crate) highest: T,
}

/// Last point of a curve, from which the next inversion starts.
#[derive(Clone, Copy, Debug)]
struct Near<T> {
    piece: usize,
    k: T,
    point: CurvePoint<T>,
}

impl<T: Real> Default for Sampler<T> {
    fn default() -> Self {
        Self { near: [None; 2], cost: Cost::default(), missed: T::zero(), highest: T::zero() }
    }
}

impl<T: Real> Sampler<T> {
    /// Returns the largest `|X(k) - x|` after the inversions so far, a length: for an integrator
    /// that uses this sampler, [`Moments::inversion`](crate::quadrature::Moments::inversion).
    pub fn missed(&self) -> T {
        self.missed
    }

    /// Returns the slope of the gap `f₂' - f₁'` at `x`. A breakpoint belongs to the piece on its
    /// left.
    ///
    /// # Errors
    /// [`SolveError::OutsideBodies`], [`SolveError::Inversion`],
    /// [`InputError::Profile`].
    pub fn slope(&mut self, gap: &Gap<'_, T>, x: T) -> Result<T, ContactError<T>> {
        self.slope_from(gap, x, Side::Left)
    }

    pub(crate) fn slope_from(&mut self, gap: &Gap<'_, T>, x: T, side: Side) -> Fallible<T, T> {
        Ok(self.slope_as_described(gap, x, side)? + gap.added_slope(x))
    }

    /// Returns the slope of the bodies as described.
    pub(crate) fn slope_as_described(
        &mut self,
        gap: &Gap<'_, T>,
        x: T,
        side: Side,
    ) -> Fallible<T, T> {
        let range = gap.range();
        if !(x >= range[0] && x <= range[1]) {
            return Err(SolveError::OutsideBodies { x, range }.into());
        }
        self.cost.samples += 1;
        let lower = self.body_slope(gap, Body::Lower, x, side)?;
        let upper = self.body_slope(gap, Body::Upper, x, side)?;
        Ok(upper - lower)
    }

    /// Returns the slope at the place of the last height, without evaluations; NaN at a cusp.
    pub(crate) fn slope_again(&self, gap: &Gap<'_, T>, x: T) -> T {
        let [lower, upper] = self.near.map(|near| match near {
            Some(Near { point, .. }) if (point.x - x).abs() <= self.missed => point.dy / point.dx,
            // Level bodies are not looked at for their height.
            _ => T::zero(),
        });
        upper - lower + gap.added_slope(x)
    }

    /// Returns the height of the gap `Y₂ - Y₁` at `x`, on both bodies, before they are loaded.
    pub(crate) fn height(&mut self, gap: &Gap<'_, T>, x: T) -> Fallible<T, T> {
        Ok(gap.with_added(x, self.height_as_described(gap, x)?))
    }

    /// Returns the height of the bodies as described.
    pub(crate) fn height_as_described(&mut self, gap: &Gap<'_, T>, x: T) -> Fallible<T, T> {
        let lower = self.body_height(gap, Body::Lower, x)?;
        let upper = self.body_height(gap, Body::Upper, x)?;
        self.highest = self.highest.max(lower.abs()).max(upper.abs());
        Ok(upper - lower)
    }

    /// Returns the height of one of the bodies.
    pub(crate) fn body_height(&mut self, gap: &Gap<'_, T>, body: Body, x: T) -> Fallible<T, T> {
        let (index, piece) = gap.piece_with(body, x, Side::Left)?;
        let Near { k, point, .. } = self.invert(gap, body, index, piece, x)?;
        // Corrects for the residual of the inversion, which may be left at an end, too.
        let missed = x - point.x;
        let height = point.y + if missed.is_zero() { missed } else { missed * point.dy / point.dx };
        if height.is_finite() {
            return Ok(height);
        }
        let source = ProfileError::NotFinite { quantity: "Y", k, value: height };
        Err(InputError::Profile { body, source }.into())
    }

    /// Measures the noise of the height of the gap at the place nearest to `x`.
    pub(crate) fn noise_of_height(&mut self, gap: &Gap<'_, T>, x: T) -> Fallible<T, T> {
        let (x, mut sum) = (gap.nearest(x), T::zero());
        for body in [Body::Lower, Body::Upper] {
            let (index, piece) = gap.piece_with(body, x, Side::Left)?;
            let Near { k, point, .. } = self.invert(gap, body, index, piece, x)?;
            let noise = gap.noise(body, &piece, k, &mut self.cost.evaluations);
            sum += noise.of_height(point.dy / point.dx);
        }
        Ok(sum)
    }

    /// Returns the slope of one of the bodies.
    pub(crate) fn body_slope(
        &mut self,
        gap: &Gap<'_, T>,
        body: Body,
        x: T,
        side: Side,
    ) -> Fallible<T, T> {
        let (index, piece) = gap.piece_with(body, x, side)?;
        let fault = |quantity, k, value| {
            let source = ProfileError::NotFinite { quantity, k, value };
            Err(InputError::Profile { body, source }.into())
        };
        if let Some(slope) = piece.curve.slope_at(x) {
            // Such a body is given by x itself.
            return if slope.is_finite() { Ok(slope) } else { fault("slope_at(x)", x, slope) };
        }
        let Near { k, point, .. } = self.invert(gap, body, index, piece, x)?;
        let slope = match piece.k.iter().position(|&end| end == k) {
            Some(end) => piece.end_slope(end, &mut self.cost.evaluations),
            None => point.dy / point.dx,
        };
        if slope.is_finite() { Ok(slope) } else { fault("the slope Y'/X'", k, slope) }
    }

    /// Solves `X(k) = x` on a piece.
    fn invert(
        &mut self,
        gap: &Gap<'_, T>,
        body: Body,
        index: usize,
        piece: Piece<'_, T>,
        x: T,
    ) -> Fallible<T, Near<T>> {
        let ends = piece.x();
        let guess = match self.near[body as usize].filter(|near| near.piece == index) {
            Some(Near { k, point, .. }) => k + (x - point.x) / point.dx,
            None => piece.k[0] + (x - ends[0]) / (ends[1] - ends[0]) * (piece.k[1] - piece.k[0]),
        };
        let rises = piece.k[0] < piece.k[1];
        let turns =
            |near: &Near<T>| (near.point.dx < T::zero()) == rises && !near.point.dx.is_zero();
        let mut at = |k: T| {
            self.cost.evaluations += 1;
            Near { piece: index, k, point: piece.curve.at(k) }
        };
        let (mut last, mut turned) = (None, None);
        let k = if x <= ends[0] {
            piece.k[0]
        } else if x >= ends[1] {
            piece.k[1]
        } else {
            let order = if rises { [0, 1] } else { [1, 0] };
            let [(lo, f_lo), (hi, f_hi)] = order.map(|i| (piece.k[i], ends[i] - x));
            self.cost.searches += 1;
            let function = |k: T| {
                self.cost.search_values += 1;
                let here = at(k);
                last = Some(here);
                turned = turned.or(last.filter(turns));
                Ok((here.point.x - x, here.point.dx))
            };
            let bracket = Bracket::new(lo, hi).values(f_lo, f_hi).guess(guess);
            let root = try_find_with_slope(gap.inversion(), function, &bracket);
            root.map_err(|error| error.or_else(|source| not_inverted(body, x, source)))?.x
        };
        let mut found = last.filter(|last| last.k == k).unwrap_or_else(|| at(k));
        for _ in 0..T::DERIVATIVE_ORDER {
            let step = (x - found.point.x) / found.point.dx;
            if step.is_finite() {
                found = at(found.k + step);
            }
        }
        if let Some(Near { k, point, .. }) = turned.or(Some(found).filter(turns)) {
            let source = ProfileError::TurnsBack { k, x: point.x, domain: piece.k };
            return Err(InputError::Profile { body, source }.into());
        }
        let missed = found.point.x - x;
        // The residual of a strategy shows in the estimates, unless it is nearly as large as the
        // piece.
        if missed.abs() > T::of(0.1) * (ends[1] - ends[0]) {
            let source = SearchError::NotConverged { x: k, residual: missed };
            return Err(SolveError::Inversion { body, x, source }.into());
        }
        self.missed = self.missed.max(missed.abs());
        self.near[body as usize] = Some(found);
        Ok(found)
    }
}

/// Makes the error of an inversion.
fn not_inverted<T: Real>(body: Body, x: T, source: SearchError<T>) -> ContactError<T> {
    match source {
        SearchError::NotFinite { x: k, value } => {
            let source = ProfileError::NotFinite { quantity: "X", k, value };
            ContactError::Input(InputError::Profile { body, source })
        }
        source => ContactError::Solve(SolveError::Inversion { body, x, source }),
    }
}
