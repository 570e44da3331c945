//! Points of a curve *near* given abscissae.
//!
//! An interpolant does not need its nodes at exact places: points near the Chebyshev points are as
//! good. So nothing is inverted. The parameter of each target is read off the cubic `k(x)` through
//! the two known points around it (`dk/dx = 1/X'` is known there too), and the point of the curve
//! at this parameter is the node. On a range that the curve crosses evenly this takes one
//! evaluation a node, all of them in one batch. A target that is missed by more than a tenth of the
//! distance to its neighbours is approached by a few steps of Newton's rule, as is the first target
//! where only the far ends of a piece are known. If they do not succeed, the user's strategy
//! searches for the target and is stopped as soon as it is near, by the value zero there. Where the
//! [survey](super::survey) knows the piece, its series serve for a first estimate, without
//! evaluations, and aim at the first targets.

mod curve_samples;
mod inverse_hermite;

pub(crate) use curve_samples::CurveSample;

use super::survey::Series;
use super::{Cost, Gap};
use crate::profile::{Noise, Piece, first_turn};
use crate::real::is_finite;
use crate::search::{Bracket, SearchError, try_find_with_slope};
use crate::{Body, ContactError, Fallible, InputError, ProfileError, Real, Side, SolveError};
use curve_samples::CurveSamples;
use inverse_hermite::{InverseHermite, is_between, newton};

/// Largest number of targets at a time.
const MAX_TARGETS: usize = 32;

/// Largest number of steps of Newton's rule to a target, before the user's strategy takes over.
const NEAR_STEPS: usize = 4;

/// Points of one body that were sampled last, from left to right.
#[derive(Clone, Debug)]
pub(crate) struct SampleCache<T> {
    /// Number of the piece they lie on.
    piece: Option<usize>,
    curve_samples: CurveSamples<T>,
    /// Approximate series of some pieces, for first estimates.
    pub guides: Vec<(usize, Series<T>)>,
    /// True if `X(k) = x` needs no solving: then there is no `Y`, and the samples are exactly at
    /// their targets.
    pub direct: bool,
}

impl<T: Real> SampleCache<T> {
    pub fn new() -> Self {
        Self { piece: None, curve_samples: CurveSamples::new(), guides: Vec::new(), direct: false }
    }

    /// Forgets the samples, for another body.
    pub fn clear(&mut self) {
        self.piece = None;
        self.guides.clear();
    }

    /// Returns the last points, one for each target.
    pub fn curve_samples(&self) -> &[CurveSample<T>] {
        self.curve_samples.inner()
    }

    /// Returns the two ends of the piece.
    pub fn ends(&self) -> [CurveSample<T>; 2] {
        self.curve_samples.ends()
    }

    /// Returns the larger `|Y|` at the ends of the piece.
    pub fn height(&self) -> T {
        let [left, right] = self.curve_samples.ends();
        left.y.abs().max(right.y.abs())
    }
}

/// Samples a body near the targets, which rise and lie on one piece of it. Each may be missed by
/// its `room`. Afterwards the cache has one sample for each target, rising too. A first estimate
/// is content with the series of the survey, where it has them; otherwise they show where to
/// evaluate the first points of a piece.
// As a call that is not inlined it costs a bare solve 2 % more instructions.
#[inline(always)]
pub(crate) fn sample_near<const N: usize, T: Real>(
    gap: &Gap<'_, T>,
    body: Body,
    targets: &[T; N],
    room: &[T; N],
    cache: &mut SampleCache<T>,
    is_estimate: bool,
    cost: &mut Cost,
) -> Fallible<T, ()> {
    const { assert!(N <= MAX_TARGETS) };
    let (index, piece) = gap.piece_with(body, targets[N / 2], Side::Left)?;
    if let Some(slope) = piece.curve.slope_at(targets[0]) {
        (cache.direct, cache.piece) = (true, None);
        let zero = T::zero();
        let mut curve_samples =
            targets.map(|x| CurveSample { k: zero, x, y: zero, dx: zero, slope });
        for sample in &mut curve_samples {
            sample.slope = piece.curve.slope_at(sample.x).unwrap_or(slope);
            if !sample.slope.is_finite() {
                return Err(not_finite(body, "slope_at(x)", sample.x, sample.slope));
            }
        }
        cache.curve_samples.set([curve_samples[0], curve_samples[N - 1]], &curve_samples);
        return Ok(());
    }
    cache.direct = false;
    if cache.piece != Some(index) {
        let ends = [0, 1].map(|i| {
            let slope = piece.end_slope(i, &mut cost.evaluations);
            CurveSample { slope, ..CurveSample::new(piece.k[i], piece.ends[i]) }
        });
        cache.piece = Some(index);
        cache.curve_samples.set(ends, &[]);
    }
    let (ends, rises) = (cache.curve_samples.ends(), piece.k[0] < piece.k[1]);
    let batch = TargetBatch { gap, body, piece, ends, rises, targets, room };
    let (known, guides) = (&mut cache.curve_samples, cache.guides.iter());
    // A series has no exact derivatives: dual numbers need points of the curve.
    let serves = |of: usize| T::COMPONENTS == 1 && of == index;
    let mut own = guides.filter(|(of, _)| serves(*of)).map(|(_, guide)| guide);
    if is_estimate {
        if let Some(samples) = own.find_map(|guide| batch.by_series(guide)) {
            known.set(ends, &samples);
            known.are_guessed = true;
            return Ok(());
        }
    } else if known.len() == 0
        && let Some(sample) = own.find_map(|guide| guide.sample_near(targets[N / 2]))
    {
        known.set(ends, &[sample]);
        known.are_guessed = true;
    }
    batch.take(known, cost).map_err(|error| turns(piece, error))
}

/// Places near which samples are wanted.
struct TargetBatch<'s, const N: usize, T: Real> {
    gap: &'s Gap<'s, T>,
    body: Body,
    piece: Piece<'s, T>,
    /// Ends of the piece, with slopes where the curve itself has none.
    ends: [CurveSample<T>; 2],
    rises: bool,
    targets: &'s [T; N],
    /// Largest distance of each sample from its target.
    room: &'s [T; N],
}

impl<const N: usize, T: Real> TargetBatch<'_, N, T> {
    /// Returns the points of a series at the targets; `None` beyond its range, or where rounding
    /// counts.
    fn by_series(&self, guide: &Series<T>) -> Option<[CurveSample<T>; N]> {
        let mut samples = [self.ends[0]; N];
        for (sample, &target) in samples.iter_mut().zip(self.targets) {
            *sample = guide.sample_near(target)?;
        }
        let unknown = guide.unknown_rate();
        samples.iter().any(|at| (at.slope * at.dx).abs() > unknown).then_some(samples)
    }

    /// Replaces the known samples by samples near the targets.
    fn take(&self, known: &mut CurveSamples<T>, cost: &mut Cost) -> Fallible<T, ()> {
        let (targets, ends) = (self.targets, self.ends);
        let mut curve_samples = [ends[0]; N];
        // On a range much longer than the span of the targets their places are uncertain: one is
        // found, and the others are sought from there.
        let [first, last] = [targets[0], targets[N - 1]];
        let len = known.len();
        let [leftmost, rightmost] = [known.row[1], known.row[len]];
        let far = last - first < T::of(0.25) * (ends[1].x - ends[0].x);
        let beside = first <= ends[0].x || last >= ends[1].x;
        if known.are_guessed {
            // Good enough to aim at the targets.
        } else if len == 0 && far && !beside {
            let found = self.find(N / 2, ends, cost)?;
            known.set(ends, &[found]);
        } else if len > 0 && first > rightmost.x && !beside {
            let found = self.find(N - 1, [rightmost, ends[1]], cost)?;
            known.set(ends, &[rightmost, found]);
        } else if len > 0 && last < leftmost.x && !beside {
            let found = self.find(0, [ends[0], leftmost], cost)?;
            known.set(ends, &[found, leftmost]);
        }
        if !self.batch(known, &mut curve_samples, cost)? {
            if known.are_guessed {
                known.set(ends, &[]);
            }
            self.find_missed(known, &mut curve_samples, cost)?;
        }
        known.set(ends, &curve_samples);
        Ok(())
    }

    fn is_near(&self, i: usize, curve_sample: &CurveSample<T>) -> bool {
        (curve_sample.x - self.targets[i]).abs() <= self.room[i]
    }

    /// Evaluates one point for each target without a known point near it. Tells whether all points
    /// are near.
    fn batch(
        &self,
        known: &CurveSamples<T>,
        curve_samples: &mut [CurveSample<T>; N],
        cost: &mut Cost,
    ) -> Fallible<T, bool> {
        let (mut asked, mut k) = ([0; N], [T::zero(); N]);
        let (row, len) = (&known.row[..], known.len());
        let (mut count, mut right, mut from) = (0, 1, 0);
        let mut way = InverseHermite::new(&row[0], &row[1]);
        for (i, &target) in self.targets.iter().enumerate() {
            while right <= len && row[right].x <= target {
                right += 1;
            }
            let left = right - 1;
            let [one, other] = [&row[left], &row[right]];
            let [from_left, to_right] = [target - one.x, other.x - target];
            let nearer = if from_left < to_right { one } else { other };
            if self.is_near(i, nearer) && is_finite(nearer.slope) && !known.are_guessed {
                curve_samples[i] = *nearer;
                continue;
            }
            // Just outside the known points, the last two of them predict better than a far end.
            let pair = if left == 0 && len >= 2 && to_right <= row[2].x - other.x {
                1
            } else if left == len && len >= 2 && from_left <= one.x - row[len - 1].x {
                len - 1
            } else {
                left
            };
            if from != pair {
                (from, way) = (pair, InverseHermite::new(&row[pair], &row[pair + 1]));
            }
            (asked[count], k[count]) = (i, way.parameter(target, one, other));
            count += 1;
        }
        let mut points = [self.piece.ends[0]; N];
        if count > 0 {
            self.piece.curve.at_many(&k[..count], &mut points[..count]);
        }
        cost.evaluations += count;
        let (mut all_near, mut sound) = (true, true);
        for ((&i, &k), &point) in asked.iter().zip(&k).zip(&points[..count]) {
            let curve_sample = CurveSample::new(k, point);
            sound &= self.is_sound(&curve_sample);
            all_near &= self.is_near(i, &curve_sample);
            curve_samples[i] = curve_sample;
        }
        if !sound {
            for (i, curve_sample) in curve_samples.iter().enumerate() {
                self.check(i, curve_sample)?;
            }
        }
        Ok(all_near)
    }

    /// Finds points near the targets that were missed.
    fn find_missed(
        &self,
        known: &CurveSamples<T>,
        curve_samples: &mut [CurveSample<T>; N],
        cost: &mut Cost,
    ) -> Fallible<T, ()> {
        for (i, &target) in self.targets.iter().enumerate() {
            if self.is_near(i, &curve_samples[i]) {
                continue;
            }
            let [mut left, mut right] = self.ends;
            for &curve_sample in known.inner().iter().chain(curve_samples.iter()) {
                if curve_sample.x <= target && curve_sample.x >= left.x {
                    left = curve_sample;
                }
                if curve_sample.x >= target && curve_sample.x <= right.x {
                    right = curve_sample;
                }
            }
            let found = self.find(i, [left, right], cost)?;
            // A strategy that stops early leaves useless nodes; but none comes closer than the
            // rounding and the noise of X.
            let missed = found.x - target;
            let [from, to] = self.piece.x();
            let beyond = missed.abs() - T::of(5.0) * self.room[i];
            let rounding = T::of(1e3) * T::epsilon() * from.abs().max(to.abs());
            let mut noise = || Noise::near(&self.piece, found.k, &mut cost.evaluations).x;
            if beyond > rounding && beyond > T::of(4.0) * noise() {
                let source = SearchError::NotConverged { x: found.k, residual: missed };
                return Err(SolveError::Inversion { body: self.body, x: target, source }.into());
            }
            curve_samples[i] = found;
        }
        Ok(())
    }

    /// Finds a point near one target between two known points, by Newton's rule; if a few steps are
    /// not enough, by the user's strategy.
    fn find(
        &self,
        i: usize,
        between: [CurveSample<T>; 2],
        cost: &mut Cost,
    ) -> Fallible<T, CurveSample<T>> {
        let [left, right] = between;
        let target = self.targets[i];
        let [from_left, to_right] = [target - left.x, right.x - target];
        let beside = from_left.min(to_right) < T::of(0.25) * from_left.max(to_right);
        let mut k = if beside {
            newton(left, right, target)
        } else {
            InverseHermite::new(&left, &right).parameter(target, &left, &right)
        };
        for _ in 0..NEAR_STEPS {
            if !is_between(k, left.k, right.k) {
                break;
            }
            cost.evaluations += 1;
            let curve_sample = CurveSample::new(k, self.piece.curve.at(k));
            self.check(i, &curve_sample)?;
            if self.is_near(i, &curve_sample) {
                return Ok(curve_sample);
            }
            k = curve_sample.k + (target - curve_sample.x) / curve_sample.dx;
        }
        self.search(i, between, cost)
    }

    /// Finds a point near one target with the user's strategy.
    #[cold]
    fn search(
        &self,
        i: usize,
        [left, right]: [CurveSample<T>; 2],
        cost: &mut Cost,
    ) -> Fallible<T, CurveSample<T>> {
        let (target, body) = (self.targets[i], self.body);
        let [lo, hi] = if self.rises { [left, right] } else { [right, left] };
        // Between joints of both bodies within rounding, a target may lie beyond its piece; of
        // points within noise the order may be wrong. No search comes nearer.
        if lo.k >= hi.k || target <= left.x || target >= right.x {
            let nearer = if target - left.x < right.x - target { left } else { right };
            return self.check(i, &nearer).map(|()| nearer);
        }
        let bracket = Bracket::new(lo.k, hi.k).values(lo.x - target, hi.x - target);
        let bracket = bracket.guess(newton(left, right, target));
        let mut best = None;
        cost.searches += 1;
        let function = |k: T| {
            cost.evaluations += 1;
            cost.search_values += 1;
            let sample = CurveSample::new(k, self.piece.curve.at(k));
            self.check(i, &sample)?;
            best = Some(sample);
            let off = if self.is_near(i, &sample) { T::zero() } else { sample.x - target };
            Ok((off, sample.dx))
        };
        let root = try_find_with_slope(self.gap.inversion(), function, &bracket);
        let not_found =
            |source| ContactError::Solve(SolveError::Inversion { body, x: target, source });
        let root = root.map_err(|error| error.or_else(not_found))?;
        if let Some(sample) = best.filter(|best| best.k == root.x) {
            return Ok(sample);
        }
        cost.evaluations += 1;
        let sample = CurveSample::new(root.x, self.piece.curve.at(root.x));
        self.check(i, &sample).map(|()| sample)
    }

    #[inline(always)]
    fn is_sound(&self, curve_sample: &CurveSample<T>) -> bool {
        let onward = if self.rises { curve_sample.dx } else { -curve_sample.dx };
        curve_sample.x.is_finite() & curve_sample.slope.is_finite() & (onward >= T::zero())
    }

    /// Checks a point on the way to a target. It need not have a slope: X may have saturated there,
    /// far from the target.
    fn check(&self, i: usize, curve_sample: &CurveSample<T>) -> Fallible<T, ()> {
        let still = curve_sample.dx.is_zero()
            && curve_sample.x.is_finite()
            && !self.is_near(i, curve_sample);
        if still || self.is_sound(curve_sample) { Ok(()) } else { Err(self.fault(curve_sample)) }
    }

    #[cold]
    fn fault(&self, &CurveSample { k, x, slope, .. }: &CurveSample<T>) -> ContactError<T> {
        if !x.is_finite() {
            not_finite(self.body, "X", k, x)
        } else if !slope.is_finite() {
            not_finite(self.body, "the slope Y'/X'", k, slope)
        } else {
            let source = ProfileError::TurnsBack { k, x, domain: self.piece.k };
            ContactError::Input(InputError::Profile { body: self.body, source })
        }
    }
}

/// Replaces the error of a curve that runs the wrong way by one with the place where it turns.
fn turns<T: Real>(piece: Piece<'_, T>, error: ContactError<T>) -> ContactError<T> {
    let ContactError::Input(InputError::Profile {
        body,
        source: ProfileError::TurnsBack { k, .. },
    }) = error
    else {
        return error;
    };
    let source = first_turn(piece.curve, piece.k, [piece.k[0], k]);
    ContactError::Input(InputError::Profile { body, source })
}

fn not_finite<T: Real>(body: Body, quantity: &'static str, k: T, value: T) -> ContactError<T> {
    let source = ProfileError::NotFinite { quantity, k, value };
    InputError::Profile { body, source }.into()
}
