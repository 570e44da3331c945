//! Smooth pieces joined to one profile.

use super::piece::Scanned;
use super::{
    Convexity, CurvePoint, ParametricProfile, Piece, Placed, Placement, ProfileError, finite_at,
};
use crate::Real;
use crate::rounded::{apart, endless, six};
use thiserror::Error;

/// Smooth profiles joined end to end, from left to right.
///
/// Each piece has a parameter and a range of its own, over which `X` may rise or fall: a formula
/// that holds "for x ≤ 0" usually has several branches in `k`, and the range selects one. Where two
/// pieces meet the slope may jump; `X` and `Y` may not. The solver inverts each piece on its own
/// range and splits its integrals at the breakpoints.
///
/// As a profile of its own it has the parameter `i + s` on piece `i`, with `s` from 0 at its left
/// end to 1 at its right, for drawing.
///
/// Pieces of different types go in as `Box<dyn ParametricProfile<T>>`.
///
/// ```
/// use linecontact::{Contact, Control, Curve, CurvePoint, Flat, Piecewise};
/// use std::f64::consts::PI;
///
/// // A wedge, blunt on the left.
/// let face = |slope: f64| move |k: f64| CurvePoint { x: k, y: slope * k, dx: 1.0, dy: slope };
/// let wedge = Piecewise::new(vec![
///     Curve::new([-1.0, 0.0], face(-0.1)),
///     Curve::new([0.0, 1.0], face(0.4)),
/// ])?;
/// let solution = Contact::new(&Flat, &wedge)?.solve(Control::Load(0.02))?;
/// // The tip lies where the slopes balance, at θ = π/5; L = 2 π F/(κ sin θ).
/// let exact = 0.04 * PI / (0.2 * PI).sin();
/// assert!((solution.hull().half_width() / exact - 1.0).abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Piecewise<T, P> {
    parts: Vec<P>,
    tolerance: T,
    /// Parameters and points at the left and right end of each part.
    ends: Vec<([T; 2], [CurvePoint<T>; 2])>,
    /// Smooth pieces: the part, and the piece of that part where it has several.
    smooth: Vec<(usize, usize)>,
    convexity: Convexity,
}

/// Check of a part.
type Check<T> = for<'a> fn(&'a dyn ParametricProfile<T>) -> Result<Scanned<'a, T>, ProfileError<T>>;

/// Rounding of `X`, and default tolerance of a joint, in units in the last place of the extent or
/// of the distance from 0: a few sums and products, each off by half a unit.
const JOINT_ROUNDING: f64 = 64.0;

impl<T: Real, P: ParametricProfile<T>> Piecewise<T, P> {
    /// Joins pieces, left to right, that meet to within rounding: 64 units in the last place of the
    /// larger of their extent and their distance from 0, in `X` and in `Y`. Where the pieces are
    /// steep, `Y` may also jump by the rise over such a rounding of `X`.
    ///
    /// # Errors
    /// Errors of [`Piece::new`], as [`PiecewiseError::InPiece`]; [`PiecewiseError::Gap`],
    /// [`PiecewiseError::Overlap`], [`PiecewiseError::Jump`] at a breakpoint;
    /// [`PiecewiseError::NoPieces`].
    pub fn new(parts: Vec<P>) -> Result<Self, PiecewiseError<T>> {
        Self::with_tolerance(parts, T::of(JOINT_ROUNDING) * T::epsilon())
    }

    /// Joins pieces as [`new`](Self::new) does, if they meet only to within `tolerance` times the
    /// larger of their extent and their distance from 0, such as measured ones. A step of `Y` that
    /// is let pass is taken for none; a certificate refuses it, as does a solve where it matters.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_tolerance(parts: Vec<P>, tolerance: T) -> Result<Self, PiecewiseError<T>> {
        if !(tolerance.is_finite() && tolerance >= T::zero()) {
            return Err(PiecewiseError::Tolerance { tolerance });
        }
        Self::joined(parts, tolerance, |part| Piece::checked_points(part))
    }

    fn joined(parts: Vec<P>, tolerance: T, check: Check<T>) -> Result<Self, PiecewiseError<T>> {
        let mut scans = Vec::with_capacity(parts.len());
        let mut smooth = Vec::with_capacity(parts.len());
        for (piece, part) in parts.iter().enumerate() {
            let fault = PiecewiseError::in_piece(piece);
            scans.push(Scan::new(check(part).map_err(fault)?));
            let inner = Piece::first_of(part).map_err(fault)?.map_or(1, |(count, _)| count);
            smooth.extend((0..inner).map(|inner| (piece, inner)));
        }
        if parts.is_empty() {
            return Err(PiecewiseError::NoPieces);
        }
        let ends: Vec<_> = scans.iter().map(|scan| (scan.piece.k, scan.piece.ends)).collect();
        let mut convexity = parts[0].convexity();
        for (breakpoint, pair) in ends.windows(2).enumerate() {
            let meet = |within: T| {
                Scan::meet(breakpoint + 1, [&scans[breakpoint], &scans[breakpoint + 1]], within)
            };
            meet(tolerance)?;
            let [before, after] = [pair[0].1[1], pair[1].1[0]].map(|end| end.dy / end.dx);
            // Slopes that are equal to rounding make no corner; 0/0 is unknown, and so is a step.
            let size = T::of(64.0) * T::epsilon() * (before.abs() + after.abs());
            let change = match after - before {
                _ if meet(T::of(JOINT_ROUNDING) * T::epsilon()).is_err() => Convexity::Unknown,
                change if change.abs() <= size => Convexity::Straight,
                change if change.abs() > size => Convexity::of_sign(change),
                _ => Convexity::Unknown,
            };
            convexity = convexity.joined(parts[breakpoint + 1].convexity(), change);
        }
        Ok(Self { parts, tolerance, ends, smooth, convexity })
    }

    /// Places the whole body. Its pieces are joined again, to within the same tolerance, and in
    /// reverse order where the placement requires it.
    ///
    /// # Errors
    /// Errors of [`Placed::new`], as [`PiecewiseError::InPiece`], with
    /// [`ProfileError::Joined`](super::ProfileError) for a piece that is joined itself, and
    /// [`ProfileError::TurnsBack`](super::ProfileError) for a wall that overhangs. As
    /// [`new`](Self::new) where a placed piece turns back in `X`.
    pub fn placed(
        self,
        placement: Placement<T>,
    ) -> Result<Piecewise<T, Placed<T, P>>, PiecewiseError<T>> {
        let tolerance = self.tolerance;
        let rises = |part: &dyn ParametricProfile<T>| {
            let [from, to] = part.domain();
            part.x(from) < part.x(to)
        };
        let place = |(i, part): (usize, P)| {
            let rose = rises(&part);
            let part = Placed::new(part, placement).map_err(PiecewiseError::in_piece(i))?;
            if (rises(&part) != rose) == placement.reverses() {
                return Ok(part);
            }
            let [k, to] = part.domain();
            let turned = ProfileError::TurnsBack { k, x: part.x(k), domain: [k, to] };
            Err(PiecewiseError::in_piece(i)(turned))
        };
        let parts = self.parts.into_iter().enumerate().map(place);
        let mut parts = parts.collect::<Result<Vec<_>, _>>()?;
        if placement.reverses() {
            parts.reverse();
        }
        Piecewise::joined(parts, tolerance, |part| Piece::scanned(part))
    }
}

/// Part with its checked points.
struct Scan<'p, T> {
    piece: Piece<'p, T>,
    /// Extents of `X` and of `Y`: the range of their values and 0.
    extents: [T; 2],
    /// Steepness at the left and at the right end: of the chord to the next point, so that an
    /// upright end hides no step.
    steepness: [T; 2],
}

impl<'p, T: Real> Scan<'p, T> {
    fn new((piece, points): Scanned<'p, T>) -> Self {
        let extent = |of: fn(&CurvePoint<T>) -> T| {
            let values = points.iter().map(of).filter(|value| value.is_finite());
            let (low, high) = values.fold((T::zero(), T::zero()), |(low, high), value| {
                (low.min(value), high.max(value))
            });
            high - low
        };
        let chord = |[end, next]: [usize; 2]| {
            let [end, next] = [points[end], points[next]];
            let steepness = ((next.y - end.y) / (next.x - end.x)).abs();
            if steepness.is_finite() { steepness } else { T::zero() }
        };
        let last = points.len() - 1;
        let mut steepness = [[0, 1], [last, last - 1]].map(chord);
        if points[last].x < points[0].x {
            steepness.reverse();
        }
        Self { piece, extents: [extent(|point| point.x), extent(|point| point.y)], steepness }
    }

    /// Checks that two neighbours meet.
    fn meet(
        breakpoint: usize,
        [before, after]: [&Self; 2],
        tolerance: T,
    ) -> Result<(), PiecewiseError<T>> {
        let [extent, height] = [0, 1].map(|i| before.extents[i].max(after.extents[i]));
        let [left, right] = [before.piece.ends[1], after.piece.ends[0]];
        let mismatch = right.x - left.x;
        if mismatch.abs() > tolerance * extent {
            let (left, right, share) = (left.x, right.x, mismatch.abs() / extent);
            return Err(if mismatch > T::zero() {
                PiecewiseError::Gap { breakpoint, left, right, share }
            } else {
                PiecewiseError::Overlap { breakpoint, left, right, share }
            });
        }
        before.check_heights(breakpoint)?;
        after.check_heights(breakpoint + 1)?;
        let jump = (right.y - left.y).abs();
        let steep = before.steepness[1] * before.extents[0] + after.steepness[0] * after.extents[0];
        let rounding = tolerance.min(T::of(JOINT_ROUNDING) * T::epsilon());
        if jump > tolerance * height + rounding * steep {
            let (x, left, right, share) = (left.x, left.y, right.y, jump / height);
            return Err(PiecewiseError::Jump { breakpoint, x, left, right, share });
        }
        Ok(())
    }

    /// Refuses a part whose `Y` is not finite at one of its ends.
    fn check_heights(&self, piece: usize) -> Result<(), PiecewiseError<T>> {
        for (&k, &CurvePoint { y: value, .. }) in self.piece.k.iter().zip(&self.piece.ends) {
            finite_at("Y", k, value).map_err(|source| PiecewiseError::InPiece { piece, source })?;
        }
        Ok(())
    }
}

impl<T: Real, P: ParametricProfile<T>> ParametricProfile<T> for Piecewise<T, P> {
    fn domain(&self) -> [T; 2] {
        [T::zero(), T::count(self.parts.len())]
    }

    fn at(&self, k: T) -> CurvePoint<T> {
        let (mut i, mut last) = (0, self.parts.len() - 1);
        while i < last {
            let middle = (i + last) / 2;
            if k <= T::count(middle + 1) { last = middle } else { i = middle + 1 }
        }
        let ([from, to], _) = self.ends[i];
        let scale = to - from;
        let point = self.parts[i].at(from + (k - T::count(i)) * scale);
        CurvePoint { dx: point.dx * scale, dy: point.dy * scale, ..point }
    }

    fn convexity(&self) -> Convexity {
        self.convexity
    }

    fn slope_deviation(&self, x: &[T], weights: &[T]) -> Option<T> {
        let mut parts = self.parts.iter().zip(&self.ends);
        // Measured independently of each other.
        parts.try_fold(T::zero(), |deviation, (part, (_, ends))| {
            let is_inside = |x: T| x > ends[0].x && x <= ends[1].x;
            let own = x.iter().zip(weights).filter(|(x, _)| is_inside(**x));
            let (x, weights): (Vec<T>, Vec<T>) = own.unzip();
            Some(deviation.hypot(part.slope_deviation(&x, &weights)?))
        })
    }

    fn pieces(&self) -> usize {
        self.smooth.len()
    }

    fn piece(&self, index: usize) -> Option<Piece<'_, T>> {
        let &(part, inner) = self.smooth.get(index)?;
        let (k, ends) = self.ends[part];
        let curve = &self.parts[part];
        curve.piece(inner).or(Some(Piece { curve, k, ends }))
    }
}

/// Returns the remedy for pieces that overlap between two ends.
fn how_to_part<T: Real>(ends: [T; 2], share: T) -> String {
    if ends.iter().all(|&x| endless(x).is_finite()) {
        format!(
            "give them from left to right, or join them by Piecewise::with_tolerance, above {} of their extent",
            six(share)
        )
    } else {
        "a body without ends, such as a Flat, is no piece: take a Line of slope 0".into()
    }
}

/// Reason why pieces cannot be joined.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum PiecewiseError<T: Real> {
    /// A piece is faulty by itself.
    #[error("piece {piece} from the left: {source}")]
    InPiece {
        /// Number of the piece, from 1, left to right.
        piece: usize,
        /// Fault of the piece.
        source: ProfileError<T>,
    },
    /// A segment of an [`Outline`](super::Outline) cannot be drawn.
    #[error("segment {segment} of the outline: {source}")]
    InSegment {
        /// Number of the line or arc, as drawn, from 1; of the half to which it belongs.
        segment: usize,
        /// Fault of the segment, or of the corner in front of it.
        source: ProfileError<T>,
    },
    /// The tolerance is negative, NaN or infinite.
    #[error("tolerance {} is out of range: use a finite number >= 0", six(*tolerance))]
    Tolerance {
        /// The tolerance as given.
        tolerance: T,
    },
    /// There are no pieces.
    #[error("a piecewise profile needs at least one piece")]
    NoPieces,
    /// Two neighbours do not meet: `x` between them belongs to neither.
    #[error(
        "gap of {} between pieces {breakpoint} and {} from the left: at x = {left} the one ends, at {right} \
         the other starts; close it, or join them by Piecewise::with_tolerance, above {} of their extent",
        six(*right - *left), breakpoint + 1, six(*share), left = apart(*left, &[*right]), right = apart(*right, &[*left])
    )]
    Gap {
        /// Number of the breakpoint, 1 between the first two pieces.
        breakpoint: usize,
        /// Right end of the left piece.
        left: T,
        /// Left end of the right piece.
        right: T,
        /// Their difference, as a share of what the tolerance is one of.
        share: T,
    },
    /// Two neighbours overlap: `x` between them belongs to both. Pieces in the wrong order overlap
    /// too.
    #[error(
        "overlap of {} between pieces {breakpoint} and {} from the left: at x = {} the one ends, at {} the other starts; {}",
        six(endless(*left - *right)), breakpoint + 1, apart(endless(*left), &[*right]), apart(endless(*right), &[*left]),
        how_to_part([*left, *right], *share)
    )]
    Overlap {
        /// Number of the breakpoint, 1 between the first two pieces.
        breakpoint: usize,
        /// Right end of the left piece.
        left: T,
        /// Left end of the right piece.
        right: T,
        /// Their difference, as a share of what the tolerance is one of.
        share: T,
    },
    /// Two neighbours meet at different heights.
    #[error(
        "jump of {} between pieces {breakpoint} and {} from the left, at x = {x}: Y = {left} on its left, \
         {right} on its right; move one of them, or join them by Piecewise::with_tolerance, above {} of their extent",
        six(*right - *left), breakpoint + 1, six(*share), x = six(*x), left = apart(*left, &[*right]),
        right = apart(*right, &[*left])
    )]
    Jump {
        /// Number of the breakpoint, 1 between the first two pieces.
        breakpoint: usize,
        /// Abscissa of the breakpoint.
        x: T,
        /// `Y` at the end of the left piece.
        left: T,
        /// `Y` at the start of the right piece.
        right: T,
        /// Their difference, as a share of what the tolerance is one of.
        share: T,
    },
}

impl<T: Real> PiecewiseError<T> {
    pub(super) fn in_piece(piece: usize) -> impl Fn(ProfileError<T>) -> Self + Copy {
        move |source| Self::InPiece { piece: piece + 1, source }
    }
}
