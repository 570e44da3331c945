//! One smooth piece of a profile, checked.

use super::{CurvePoint, Noise, ParametricProfile, ProfileError, finite_at, interval};
use crate::Real;
use std::fmt;

/// Number of steps in `k` at which the check evaluates `X` and `X'`.
const CHECK_STEPS: usize = 32;

/// Piece with the points along it at which it was evaluated.
pub(super) type Scanned<'a, T> = (Piece<'a, T>, [CurvePoint<T>; CHECK_STEPS + 1]);

/// Smooth curve and its two ends, from left to right.
#[derive(Clone, Copy)]
pub struct Piece<'a, T> {
    /// The curve.
    pub curve: &'a dyn ParametricProfile<T>,
    /// Parameters at the left and at the right end; falling where `X` falls with `k`.
    pub k: [T; 2],
    /// Points at both ends; `X` is finite and rises from the first to the second.
    pub ends: [CurvePoint<T>; 2],
}

impl<T: fmt::Debug> fmt::Debug for Piece<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { k, ends, .. } = self;
        f.debug_struct("Piece").field("k", k).field("ends", ends).finish_non_exhaustive()
    }
}

impl<'a, T: Real> Piece<'a, T> {
    /// Returns `x` at the left and at the right end, rising.
    pub fn x(&self) -> [T; 2] {
        [self.ends[0].x, self.ends[1].x]
    }

    /// Returns `Y'/X'` at an end. Where both are zero, as with `X = k²` from `k = 0`, it is the
    /// limit, by a parabola in `k` through three points inside, which are added to the evaluations.
    pub(crate) fn end_slope(&self, end: usize, evaluations: &mut usize) -> T {
        let CurvePoint { dx, dy, .. } = self.ends[end];
        if !(dx.is_zero() && dy.is_zero()) {
            return dy / dx;
        }
        *evaluations += 3;
        // Its third power is negligible, even where the curve is a thousand times longer than its
        // features.
        let step = (self.k[1 - end] - self.k[end]) * T::of(16.0) * T::epsilon().sqrt();
        let slope = |steps: f64| {
            let CurvePoint { dx, dy, .. } = self.curve.at(self.k[end] + step * T::of(steps));
            dy / dx
        };
        (T::of(8.0) * slope(1.0) - T::of(6.0) * slope(2.0) + slope(4.0)) / T::of(3.0)
    }

    /// Creates the piece of a smooth curve, evaluated only at the two ends of its domain.
    ///
    /// # Errors
    /// [`ProfileError::Domain`], [`ProfileError::NotFinite`] where `X` is not finite,
    /// [`ProfileError::TurnsBack`] where `X` is equal at both ends, or runs the wrong way at both.
    pub fn new(curve: &'a dyn ParametricProfile<T>) -> Result<Self, ProfileError<T>> {
        let k = interval(curve.domain())?;
        let nowhere = T::of(f64::NAN);
        let mut ends = [CurvePoint { x: nowhere, y: nowhere, dx: nowhere, dy: nowhere }; 2];
        curve.at_many(&k, &mut ends);
        for (k, end) in k.into_iter().zip(ends) {
            finite_at("X", k, end.x)?;
        }
        Self::between(curve, k, ends)
    }

    /// Returns the number of pieces of a compound profile and the first piece; `None` for a profile
    /// that is smooth itself.
    ///
    /// # Errors
    /// [`ProfileError::Pieces`] where `pieces()` and `piece()` disagree. The inner pieces are
    /// checked where they are used: there may be very many.
    pub(crate) fn first_of(
        profile: &'a dyn ParametricProfile<T>,
    ) -> Result<Option<(usize, Self)>, ProfileError<T>> {
        let count = profile.pieces();
        let fault = |index| Err(ProfileError::Pieces { count, index });
        if profile.piece(count).is_some() {
            return fault(count);
        }
        let Some(last) = count.checked_sub(1) else { return Ok(None) };
        match [profile.piece(0), profile.piece(last)] {
            [Some(first), Some(end)] if first.x()[0] < end.x()[1] => Ok(Some((count, first))),
            [None, _] => fault(0),
            _ => fault(last),
        }
    }

    fn between(
        curve: &'a dyn ParametricProfile<T>,
        k: [T; 2],
        ends: [CurvePoint<T>; 2],
    ) -> Result<Self, ProfileError<T>> {
        // If X runs backwards at both ends it turns between them, as on a closed curve. Where X
        // stands still at an end, X' may be rounded.
        let slope = (ends[1].x - ends[0].x) / (k[1] - k[0]);
        let back = |end: &CurvePoint<T>| end.dx / slope < -T::epsilon().sqrt();
        if ends.iter().all(back) {
            return Err(first_turn(curve, k, [k[0]; 2]));
        }
        if ends[0].x < ends[1].x {
            Ok(Self { curve, k, ends })
        } else if ends[0].x > ends[1].x {
            Ok(Self { curve, k: [k[1], k[0]], ends: [ends[1], ends[0]] })
        } else {
            let (domain, k) = (k, T::of(0.5) * k[0] + T::of(0.5) * k[1]);
            Err(ProfileError::TurnsBack { k, x: curve.x(k), domain })
        }
    }

    /// Creates the piece after a check of the whole domain: 39 evaluations. For profiles just
    /// written, and for the pieces that [`Piecewise`](super::Piecewise) joins.
    ///
    /// A fold narrower than a thirty-second of the domain can pass; it is reported when the
    /// solver comes upon it.
    ///
    /// # Errors
    /// [`ProfileError::Domain`], [`ProfileError::NotFinite`] where `X` or `X'` is not
    /// finite (`X'` may be at the very ends), [`ProfileError::TurnsBack`],
    /// [`ProfileError::Derivative`].
    pub fn checked(curve: &'a dyn ParametricProfile<T>) -> Result<Self, ProfileError<T>> {
        Self::checked_points(curve).map(|(piece, _)| piece)
    }

    /// Checks a curve as [`checked`](Self::checked) does, and returns the points too.
    pub(super) fn checked_points(
        curve: &'a dyn ParametricProfile<T>,
    ) -> Result<Scanned<'a, T>, ProfileError<T>> {
        let (piece, points) = Self::scanned(curve)?;
        piece.check_factors(&points)?;
        Ok((piece, points))
    }

    /// Compares the derivatives with differences at two places, given some points: a wrong sign or
    /// factor is found.
    pub(crate) fn check_factors(&self, points: &[CurvePoint<T>]) -> Result<(), ProfileError<T>> {
        let [from, to] = self.k;
        let mut places = [0.2763, 0.7236].into_iter();
        places.try_for_each(|place| {
            check_derivatives(self, points, from + (to - from) * T::of(place))
        })
    }

    /// Checks everything but the derivatives, for a curve made from a checked one: its heights may
    /// now be little but rounding.
    pub(super) fn scanned(
        curve: &'a dyn ParametricProfile<T>,
    ) -> Result<Scanned<'a, T>, ProfileError<T>> {
        let [from, to] = interval(curve.domain())?;
        let step = (to - from) / T::count(CHECK_STEPS);
        let k = |i| if i == CHECK_STEPS { to } else { from + step * T::count(i) };
        let zero = T::zero();
        let mut points = [CurvePoint { x: zero, y: zero, dx: zero, dy: zero }; CHECK_STEPS + 1];
        curve.at_many(&std::array::from_fn::<T, { CHECK_STEPS + 1 }, _>(k), &mut points);
        for (i, point) in points.iter().enumerate() {
            finite_at("X", k(i), point.x)?;
            if i > 0 && i < CHECK_STEPS {
                finite_at("X'", k(i), point.dx)?;
            }
        }
        let rising = points[CHECK_STEPS].x > points[0].x;
        let forward = |change: T| if rising { change } else { -change };
        for i in 0..CHECK_STEPS {
            let turned = i > 0 && forward(points[i].dx) < T::zero();
            if turned || forward(points[i + 1].x - points[i].x) <= T::zero() {
                // X turns where X' changes its sign, which may be far from the first step in the
                // wrong direction.
                let turns = |&j: &usize| points[j].dx * points[j + 1].dx < T::zero();
                let j = (0..CHECK_STEPS).find(turns).unwrap_or(i);
                return Err(first_turn(curve, [from, to], [k(j), k(j + 1)]));
            }
        }
        Ok((Self::between(curve, [from, to], [points[0], points[CHECK_STEPS]])?, points))
    }
}

/// Compares the derivatives at `k` with central differences.
fn check_derivatives<T: Real>(
    piece: &Piece<'_, T>,
    points: &[CurvePoint<T>],
    k: T,
) -> Result<(), ProfileError<T>> {
    let (curve, length) = (piece.curve, (piece.k[1] - piece.k[0]).abs());
    let largest = |of: fn(&CurvePoint<T>) -> T| {
        points.iter().map(of).fold(T::zero(), |max, value| max.max(value.abs()))
    };
    let scales = [largest(|point| point.x), largest(|point| point.y)];
    let at = curve.at(k);
    let compared = |noise: [T; 2], share: f64| {
        let h = T::epsilon().cbrt() * length * T::of(share);
        let (before, after) = (curve.at(k - h), curve.at(k + h));
        let changes = [("X'", at.dx, after.x - before.x), ("Y'", at.dy, after.y - before.y)];
        for ((quantity, given, change), noise) in changes.into_iter().zip(noise) {
            let difference = change / (T::of(2.0) * h);
            // A tenth detects a wrong sign or factor, not a formula that is merely hard to
            // evaluate.
            let allowed = T::of(0.1) * given.abs().max(difference.abs()) + noise / h;
            if (given - difference).abs() > allowed {
                return Err(ProfileError::Derivative { quantity, k, given, difference });
            }
        }
        Ok(())
    };
    let rounding = scales.map(|scale| T::of(1e3) * T::epsilon() * scale);
    // The cube root of the rounding unit balances truncation and rounding of the difference. Where
    // a wave or a kink is finer than this step, a shorter one decides.
    compared(rounding, 1.0).or_else(|_| compared(rounding, 1.0 / 32.0)).or_else(|_| {
        // The heights may be rounded as differences of larger terms.
        let noise = Noise::of_rounding(piece, k, &mut 0);
        let Noise { x, y } = noise.unwrap_or(Noise::zero_tolerance());
        compared([rounding[0].max(x), rounding[1].max(y)], 1.0)
    })
}

/// Finds the first place, outward from the middle of the domain, where `X'` changes its sign: the
/// curve between this place and the middle can be used. A fold too narrow for these steps is
/// reported where it was `met`.
pub(crate) fn first_turn<T: Real>(
    curve: &dyn ParametricProfile<T>,
    domain: [T; 2],
    met: [T; 2],
) -> ProfileError<T> {
    const FINE_STEPS: usize = 2048;
    let rising = |[one, other]: [T; 2]| [one.min(other), one.max(other)];
    let [from, to] = rising(domain);
    let half = T::of(0.5);
    let (middle, step) = (half * from + half * to, half * (to - from) / T::count(FINE_STEPS));
    let back = |k: T| curve.dx(k) < T::zero();
    let side = back(middle);
    let mut last = [middle; 2];
    for i in 1..=FINE_STEPS {
        let reach = step * T::count(i);
        let next = [(middle - reach).max(from), (middle + reach).min(to)];
        for (last, next) in last.iter_mut().zip(next) {
            if back(next) != side {
                return turns_back(curve, [from, to], rising([*last, next]));
            }
            *last = next;
        }
    }
    turns_back(curve, [from, to], rising(met))
}

/// Names the place where `X'` changes its sign between two others; the middle where it does not
/// change.
fn turns_back<T: Real>(
    curve: &dyn ParametricProfile<T>,
    domain: [T; 2],
    [mut lo, mut hi]: [T; 2],
) -> ProfileError<T> {
    let (half, falls) = (T::of(0.5), |k: T| curve.dx(k) < T::zero());
    let (mut k, side) = (half * lo + half * hi, falls(lo));
    if falls(hi) != side {
        while k > lo && k < hi {
            *(if falls(k) == side { &mut lo } else { &mut hi }) = k;
            k = half * lo + half * hi;
        }
    }
    ProfileError::TurnsBack { k, x: curve.x(k), domain }
}
