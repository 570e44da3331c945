//! Points of a curve *near* given abscissae.
//!
//! An interpolant does not need its nodes to be anywhere in particular: near the Chebyshev points
//! is as good as at them. So nothing is inverted. The parameter of each target is read off the
//! cubic `k(x)` through the two known points around it (`dk/dx = 1/X'` is known there too), and
//! where the curve then turns out to be is where the node is. On a range that the curve crosses
//! evenly this takes one evaluation a node, all of them in one batch. A target that is missed by
//! more than a tenth of the distance to its neighbours is searched for with the user's strategy,
//! which is stopped as soon as it is near: it meets a zero there.

use super::{Cost, Gap, Side};
use crate::profile::{Piece, turning_point};
use crate::search::{Bracket, SearchError};
use crate::{Body, ContactError, CurvePoint, ProfileError, Real};

/// The most targets at a time.
const MOST: usize = 24;

/// By how much of the distance to the next target a node may miss its own, and for a sketch.
const NEAR: [f64; 2] = [0.1, 0.45];

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
    /// The knots, and room for the next; which of them changes.
    rows: [[Knot<T>; MOST]; 2],
    current: usize,
    /// Where `X(k) = x` needs no solving there is no `Y`, and the knots are at their targets.
    pub direct: bool,
    /// The largest `|Y|` at the ends of the piece.
    pub height: T,
}

impl<T: Real> Trace<T> {
    pub fn new() -> Self {
        let nil = T::zero();
        let knot = Knot { k: nil, x: nil, y: nil, dx: nil, slope: nil };
        Self {
            piece: None,
            len: 0,
            rows: [[knot; MOST]; 2],
            current: 0,
            direct: false,
            height: nil,
        }
    }

    /// Forgets what was sampled: the body is another.
    pub fn clear(&mut self) {
        (self.piece, self.len) = (None, 0);
    }

    pub fn knots(&self) -> &[Knot<T>] {
        &self.rows[self.current][..self.len]
    }
}

/// Samples a body near the targets, which rise and lie on one piece of it. Afterwards the trace has
/// one knot for each, rising too.
pub(crate) fn aim<T: Real>(
    gap: &Gap<'_, T>,
    body: Body,
    targets: &[T],
    rough: bool,
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
        for (i, (knot, &x)) in trace.rows[trace.current].iter_mut().zip(targets).enumerate() {
            let slope = if i == 0 { slope } else { piece.curve.slope_at(x).unwrap_or(slope) };
            if !slope.is_finite() {
                return Err(not_finite(body, "slope_at(x)", x, slope));
            }
            *knot = Knot { k: x, x, y: T::zero(), dx: T::one(), slope };
        }
        return Ok(());
    }
    trace.direct = false;
    trace.height = piece.ends[0].y.abs().max(piece.ends[1].y.abs());
    let Trace { len, rows: [one, other], current, .. } = trace;
    let (knots, spare) = if *current == 0 { (one, other) } else { (other, one) };
    let mut shot = Shot {
        body,
        rises: piece.k[0] < piece.k[1],
        ends: [0, 1].map(|i| Knot::new(piece.k[i], piece.ends[i])),
        near: T::of(NEAR[usize::from(rough)]),
        knots: spare,
        found: 0,
    };
    // A range much longer than that of the targets says little of where they are: with one found,
    // the others are aimed at from there.
    let [first, last] = [targets[0], targets[n - 1]];
    let far = last - first < T::of(0.25) * (shot.ends[1].x - shot.ends[0].x);
    let beside = first <= shot.ends[0].x || last >= shot.ends[1].x;
    if *len == 0 && far && !beside {
        let found = shot.search(gap, piece, targets, n / 2, &[], cost);
        (knots[0], *len) = (found.map_err(|error| turns(piece, error))?, 1);
    }
    let known = &knots[..*len];
    shot.batch(piece, targets, known, cost).map_err(|error| turns(piece, error))?;
    for i in 0..n {
        if (shot.knots[i].x - targets[i]).abs() > shot.tolerance(targets, i) {
            let found = shot.search(gap, piece, targets, i, known, cost);
            let found = found.map_err(|error| turns(piece, error))?;
            // A strategy that stops early leaves nodes that are good for nothing.
            let missed = found.x - targets[i];
            let largest = shot.ends[0].x.abs().max(shot.ends[1].x.abs());
            let noise = T::of(1e3) * T::epsilon() * largest;
            if missed.abs() > T::of(5.0) * shot.tolerance(targets, i) + noise {
                let source = SearchError::Missed { x: found.k, residual: missed };
                return Err(ContactError::Inversion { body, x: targets[i], source });
            }
            shot.knots[i] = found;
        }
    }
    (*current, *len) = (1 - *current, n);
    Ok(())
}

struct Shot<'s, T> {
    body: Body,
    rises: bool,
    ends: [Knot<T>; 2],
    /// By how much of the distance between them a target may be missed.
    near: T,
    knots: &'s mut [Knot<T>; MOST],
    /// How many of the knots are at hand.
    found: usize,
}

impl<T: Real> Shot<'_, T> {
    /// By how much a target may be missed.
    fn tolerance(&self, targets: &[T], i: usize) -> T {
        let before = i.checked_sub(1).map(|j| targets[i] - targets[j]);
        let after = targets.get(i + 1).map(|&next| next - targets[i]);
        let distance = match (before, after) {
            (Some(before), Some(after)) => before.min(after),
            (before, after) => before.or(after).unwrap_or_else(T::zero),
        };
        self.near * distance
    }

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
        let mut between: Option<(usize, bool, Between<T>)> = None;
        for (i, &target) in targets.iter().enumerate() {
            while next < known.len() && known[next].x <= target {
                next += 1;
            }
            let left = if next > 0 { &known[next - 1] } else { &self.ends[0] };
            let right = if next < known.len() { &known[next] } else { &self.ends[1] };
            let nearer = if target - left.x < right.x - target { left } else { right };
            let near = (nearer.x - target).abs() <= self.tolerance(targets, i);
            if near && nearer.slope.is_finite() {
                self.knots[i] = *nearer;
                continue;
            }
            // Just outside what is known, its last two points say more than a far end.
            let pair = match known {
                [one, other, ..] if next == 0 => Some((one.x - target, one, other)),
                [.., one, other] if next == known.len() => Some((target - other.x, one, other)),
                _ => None,
            };
            let pair = pair.filter(|(away, one, other)| *away <= other.x - one.x);
            let (beyond, [from, to]) = match pair {
                Some((_, one, other)) => (true, [one, other]),
                None => (false, [left, right]),
            };
            let same = between.as_ref().filter(|(at, out, _)| (*at, *out) == (next, beyond));
            let guess = match same {
                Some((_, _, between)) => between.parameter(target),
                None => {
                    let fresh = Between::new(*from, *to);
                    let guess = fresh.parameter(target);
                    between = Some((next, beyond, fresh));
                    guess
                }
            };
            let inside = (guess - left.k) * (right.k - guess) > T::zero();
            let chord = || left.k + (target - left.x) / (right.x - left.x) * (right.k - left.k);
            (asked[count], k[count]) = (i, if inside { guess } else { chord() });
            count += 1;
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
        let (target, near) = (targets[i], self.tolerance(targets, i));
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

/// Says where a curve that runs the wrong way turns.
fn turns<T: Real>(piece: Piece<'_, T>, error: ContactError<T>) -> ContactError<T> {
    let ContactError::Profile { body, source: ProfileError::TurnsBack { k, .. } } = error else {
        return error;
    };
    let [left, _] = piece.k;
    let (k, x) = turning_point(piece.curve, left.min(k), left.max(k));
    ContactError::Profile { body, source: ProfileError::TurnsBack { k, x } }
}

/// The parameter as a function of x from two points: the cubic `k(x)` through both with their
/// slopes, or where that is not monotone, the slope at the nearer one.
struct Between<T> {
    left: Knot<T>,
    right: Knot<T>,
    /// The reciprocal of the distance.
    share: T,
    /// The coefficients of the cubic in the share of the way, without the constant.
    cubic: Option<[T; 3]>,
}

impl<T: Real> Between<T> {
    fn new(left: Knot<T>, right: Knot<T>) -> Self {
        let width = right.x - left.x;
        let rise = right.k - left.k;
        let (at_left, at_right) = (width / left.dx, width / right.dx);
        let three = T::of(3.0) * rise.abs();
        let even = |slope: T| slope * rise > T::zero() && slope.abs() <= three;
        let cubic = (even(at_left) && even(at_right)).then(|| {
            let (twice, sum) = (rise + rise, at_left + at_right);
            [at_left, rise + twice - at_left - sum, sum - twice]
        });
        Self { left, right, share: T::one() / width, cubic }
    }

    fn parameter(&self, x: T) -> T {
        let Self { left, right, .. } = self;
        let along = (x - left.x) * self.share;
        if let Some([first, second, third]) = self.cubic {
            return left.k + along * (first + along * (second + along * third));
        }
        let nearer = if along < T::of(0.5) { left } else { right };
        let k = nearer.k + (x - nearer.x) / nearer.dx;
        if k.is_finite() { k } else { left.k + along * (right.k - left.k) }
    }
}

fn not_finite<T: Real>(body: Body, quantity: &'static str, k: T, value: T) -> ContactError<T> {
    ContactError::Profile { body, source: ProfileError::NotFinite { quantity, k, value } }
}
