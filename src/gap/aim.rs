//! Points of a curve *near* given abscissae.
//!
//! An interpolant does not need its nodes to be anywhere in particular: near the Chebyshev points
//! is as good as at them. So nothing is inverted. The parameter of each target is read off the
//! cubic `k(x)` through the two known points around it (`dk/dx = 1/X'` is known there too), and
//! where the curve then turns out to be is where the node is. On a range that the curve crosses
//! evenly this takes one evaluation a node, all of them in one batch. A target that is missed by
//! more than a tenth of the distance to its neighbours is searched for with the user's strategy,
//! which is stopped as soon as it is near.

use super::{Cost, Gap, Side};
use crate::profile::{Piece, turning_point};
use crate::search::{Bracket, SearchError};
use crate::{Body, ContactError, CurvePoint, ProfileError, Real};

/// The most targets at a time.
const MOST: usize = 24;

/// By how much of the distance to the next target a node may miss its own.
const NEAR: f64 = 0.1;

/// A known point of a curve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Knot<T> {
    pub k: T,
    pub x: T,
    pub y: T,
    dx: T,
    /// `Y'/X'`
    pub slope: T,
}

impl<T: Real> Knot<T> {
    fn new(k: T, point: CurvePoint<T>) -> Self {
        Self { k, x: point.x, y: point.y, dx: point.dx, slope: point.dy / point.dx }
    }
}

/// The points of one body that were sampled last, from left to right.
#[derive(Clone, Debug)]
pub(crate) struct Trace<T> {
    /// The piece they lie on.
    piece: Option<usize>,
    len: usize,
    knots: [Knot<T>; MOST],
    /// Where `X(k) = x` needs no solving there is no `Y`, and the knots are at their targets.
    pub direct: bool,
}

impl<T: Real> Trace<T> {
    pub fn new() -> Self {
        let nil = T::zero();
        let knot = Knot { k: nil, x: nil, y: nil, dx: nil, slope: nil };
        Self { piece: None, len: 0, knots: [knot; MOST], direct: false }
    }

    /// Forgets what was sampled: the body is another.
    pub fn clear(&mut self) {
        (self.piece, self.len) = (None, 0);
    }

    pub fn knots(&self) -> &[Knot<T>] {
        &self.knots[..self.len]
    }
}

/// Samples a body near the targets, which rise and lie on one piece of it. Afterwards the trace has
/// one knot for each, rising too.
pub(crate) fn aim<T: Real>(
    gap: &Gap<'_, T>,
    body: Body,
    targets: &[T],
    trace: &mut Trace<T>,
    cost: &mut Cost,
) -> Result<(), ContactError<T>> {
    let n = targets.len();
    let (index, piece) = gap.piece_at(body, targets[n / 2], Side::Left);
    if trace.piece != Some(index) {
        (trace.piece, trace.len) = (Some(index), 0);
    }
    if let Some(slope) = piece.curve.slope_at(targets[0]) {
        trace.direct = true;
        trace.len = n;
        for (i, (knot, &x)) in trace.knots.iter_mut().zip(targets).enumerate() {
            let slope = if i == 0 { slope } else { piece.curve.slope_at(x).unwrap_or(slope) };
            if !slope.is_finite() {
                return Err(not_finite(body, "slope_at(x)", x, slope));
            }
            *knot = Knot { k: x, x, y: T::zero(), dx: T::one(), slope };
        }
        return Ok(());
    }
    trace.direct = false;
    let mut shot = Shot {
        body,
        rises: piece.k[0] < piece.k[1],
        ends: [0, 1].map(|i| Knot::new(piece.k[i], piece.ends[i])),
        knots: trace.knots,
        found: 0,
    };
    let shots = shot.batch(piece, targets, trace.knots(), cost);
    shots.map_err(|error| shot.turning_point(piece, error))?;
    for i in 0..n {
        let x = shot.knots[i].x;
        if (x - targets[i]).abs() > tolerance(targets, i) {
            let found = shot.search(gap, piece, targets, i, trace.knots(), cost);
            shot.knots[i] = found.map_err(|error| shot.turning_point(piece, error))?;
        }
    }
    trace.knots = shot.knots;
    trace.len = n;
    Ok(())
}

fn tolerance<T: Real>(targets: &[T], i: usize) -> T {
    let before = i.checked_sub(1).map(|j| targets[i] - targets[j]);
    let after = targets.get(i + 1).map(|&next| next - targets[i]);
    let distance = match (before, after) {
        (Some(before), Some(after)) => before.min(after),
        (before, after) => before.or(after).unwrap_or_else(T::zero),
    };
    T::of(NEAR) * distance
}

struct Shot<T> {
    body: Body,
    rises: bool,
    ends: [Knot<T>; 2],
    knots: [Knot<T>; MOST],
    /// How many of the knots are at hand.
    found: usize,
}

impl<T: Real> Shot<T> {
    /// Takes one shot at each target that no known point is near to.
    fn batch(
        &mut self,
        piece: Piece<'_, T>,
        targets: &[T],
        known: &[Knot<T>],
        cost: &mut Cost,
    ) -> Result<(), ContactError<T>> {
        let zero = T::zero();
        let nowhere = CurvePoint { x: zero, y: zero, dx: zero, dy: zero };
        let (mut asked, mut k) = ([0; MOST], [zero; MOST]);
        let (mut count, mut next) = (0, 0);
        for (i, &target) in targets.iter().enumerate() {
            while next < known.len() && known[next].x <= target {
                next += 1;
            }
            let left = if next > 0 { known[next - 1] } else { self.ends[0] };
            let right = if next < known.len() { known[next] } else { self.ends[1] };
            let nearer = if target - left.x < right.x - target { left } else { right };
            let near = (nearer.x - target).abs() <= tolerance(targets, i);
            if near && nearer.slope.is_finite() {
                self.knots[i] = nearer;
            } else {
                (asked[count], k[count]) = (i, predict(left, right, target));
                count += 1;
            }
        }
        let mut points = [nowhere; MOST];
        piece.curve.at_many(&k[..count], &mut points[..count]);
        cost.evaluations += count;
        for j in 0..count {
            self.knots[asked[j]] = self.accept(k[j], points[j])?;
        }
        self.found = targets.len();
        Ok(())
    }

    /// Finds a point near one target with the user's strategy.
    fn search(
        &self,
        gap: &Gap<'_, T>,
        piece: Piece<'_, T>,
        targets: &[T],
        i: usize,
        known: &[Knot<T>],
        cost: &mut Cost,
    ) -> Result<Knot<T>, ContactError<T>> {
        let (target, near) = (targets[i], tolerance(targets, i));
        let [mut left, mut right] = self.ends;
        for &knot in known.iter().chain(&self.knots[..self.found]) {
            if knot.x <= target && knot.x >= left.x {
                left = knot;
            }
            if knot.x >= target && knot.x <= right.x {
                right = knot;
            }
        }
        let [lo, hi] = if self.rises { [left, right] } else { [right, left] };
        let bracket = Bracket::new(lo.k, hi.k).values(lo.x - target, hi.x - target);
        let bracket = bracket.guess(self.newton(left, right, target));
        let (mut best, mut failed) = (None, None);
        let mut f = |k: T| {
            cost.evaluations += 1;
            let point = piece.curve.at(k);
            match self.accept(k, point) {
                Ok(knot) => {
                    best = Some(knot);
                    let missed = knot.x - target;
                    (if missed.abs() <= near { T::zero() } else { missed }, knot.dx)
                }
                Err(error) => {
                    failed = Some(error);
                    (T::of(f64::NAN), point.dx)
                }
            }
        };
        let body = self.body;
        let found = if lo.k < hi.k {
            gap.inversion().find_with_slope(&mut f, &bracket)
        } else {
            // The two known points are one and the same.
            return Ok(left);
        };
        match (failed, found) {
            (Some(error), _) => Err(error),
            (None, Ok(root)) if !(root.x >= lo.k && root.x <= hi.k) => {
                let source = SearchError::Astray { x: root.x, lo: lo.k, hi: hi.k };
                Err(ContactError::Inversion { body, x: target, source })
            }
            (None, Ok(root)) => match best.filter(|best| best.k == root.x) {
                Some(knot) => Ok(knot),
                None => {
                    cost.evaluations += 1;
                    self.accept(root.x, piece.curve.at(root.x))
                }
            },
            (None, Err(source)) => Err(ContactError::Inversion { body, x: target, source }),
        }
    }

    /// A step of Newton's rule from the nearer of two points, kept between them.
    fn newton(&self, left: Knot<T>, right: Knot<T>, target: T) -> T {
        let nearer = if target - left.x < right.x - target { left } else { right };
        let k = nearer.k + (target - nearer.x) / nearer.dx;
        let inside = (k - left.k) * (right.k - k) > T::zero();
        if inside { k } else { T::of(0.5) * left.k + T::of(0.5) * right.k }
    }

    /// Says where a curve that runs the wrong way turns.
    fn turning_point(&self, piece: Piece<'_, T>, error: ContactError<T>) -> ContactError<T> {
        let ContactError::Profile { body, source: ProfileError::TurnsBack { k, .. } } = error
        else {
            return error;
        };
        let [left, _] = piece.k;
        let (k, x) = turning_point(piece.curve, left.min(k), left.max(k));
        ContactError::Profile { body, source: ProfileError::TurnsBack { k, x } }
    }

    fn accept(&self, k: T, point: CurvePoint<T>) -> Result<Knot<T>, ContactError<T>> {
        let knot = Knot::new(k, point);
        if !knot.x.is_finite() {
            return Err(not_finite(self.body, "X", k, knot.x));
        }
        if (knot.dx < T::zero()) == self.rises && !knot.dx.is_zero() {
            let source = ProfileError::TurnsBack { k, x: knot.x };
            return Err(ContactError::Profile { body: self.body, source });
        }
        if !knot.slope.is_finite() {
            return Err(not_finite(self.body, "the slope Y'/X'", k, knot.slope));
        }
        Ok(knot)
    }
}

/// The parameter at a target between two points: the cubic `k(x)` through both with their
/// slopes, or the straight line where that cubic is not monotone.
fn predict<T: Real>(left: Knot<T>, right: Knot<T>, target: T) -> T {
    let width = right.x - left.x;
    let along = (target - left.x) / width;
    let rise = right.k - left.k;
    let (at_left, at_right) = (width / left.dx, width / right.dx);
    let three = T::of(3.0) * rise.abs();
    let even = |slope: T| slope * rise > T::zero() && slope.abs() <= three;
    let k = if even(at_left) && even(at_right) {
        let (twice, sum) = (rise + rise, at_left + at_right);
        let bend = rise + twice - at_left - sum + (sum - twice) * along;
        left.k + along * (at_left + along * bend)
    } else {
        left.k + along * rise
    };
    let [lo, hi] = if left.k < right.k { [left.k, right.k] } else { [right.k, left.k] };
    k.max(lo).min(hi)
}

fn not_finite<T: Real>(body: Body, quantity: &'static str, k: T, value: T) -> ContactError<T> {
    ContactError::Profile { body, source: ProfileError::NotFinite { quantity, k, value } }
}
