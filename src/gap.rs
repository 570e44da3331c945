//! Two bodies as one function of x: the slope of the gap between them.
//!
//! This is the only place that calls the user's curves:
//!
//! ```text
//! g(x) = Y₂'(k₂)/X₂'(k₂) - Y₁'(k₁)/X₁'(k₁)   where X₁(k₁) = X₂(k₂) = x      (4, 5, 8)
//! ```
//!
//! There are two ways to compute it. A [`Sampler`] inverts `X(k) = x` at any `x`, starting from its
//! last point. The panels ([`quadrature`](crate::quadrature)) need the slope only *near* given
//! abscissae, and take points close to them: see `sample_near.rs`.

mod noise;
mod periodic;
mod repeated;
mod resolution;
mod sample_near;
mod sampler;
mod survey;

use repeated::Repeated;
pub(crate) use sample_near::{CurveSample, SampleCache, sample_near};
pub use sampler::Sampler;
pub(crate) use survey::{Asked, LowPoint, MAX_NEAR_UNCERTAINTY, Survey, crossing};

use crate::kernel::Bend;
use crate::profile::{Convexity, Piece};
use crate::real::same;
use crate::search::LimitSearch;
use crate::{
    Body, CurvePoint, Fallible, InputError, ParametricProfile, ProfileError, Real, Side, SolveError,
};
use std::borrow::Cow;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Function with which a user watches a solve: see [`Contact::watch`](crate::Contact::watch).
pub(crate) type Watch<'b, T> = &'b (dyn Fn(Cost, crate::Interval<T>) -> ControlFlow<()> + Sync);

/// Number of evaluations of smooth bodies after which a search gives up: thousands of times the
/// usual number.
const MAX_EVALUATIONS: usize = 1 << 20;

/// Number of further evaluations for each piece.
const MAX_FOR_A_PIECE: usize = 1 << 10;

/// Slope of the gap between two bodies, not yet sampled. A clone is the same gap, and costs no
/// allocation.
#[derive(Clone)]
pub struct Gap<'b, T: Real> {
    bodies: [Surface<'b, T>; 2],
    inversion: &'b dyn LimitSearch<T>,
    range: [T; 2],
    /// Number of this gap, different from every other that was made.
    number: u64,
    convex: bool,
    /// Counter-clockwise tilt of body 2, as a slope: added to the slope of the gap, and times x to
    /// its height.
    tilt: T,
    /// Bend of the bodies, 1/κ, and a number that no other bend has: taken from the gap.
    bend: Option<(Arc<Bend<'b, T>>, T, u64)>,
    watch: Option<Watch<'b, T>>,
    /// Length of the narrowest feature to be seen, if the user gives one.
    resolution: Option<T>,
    /// Period of both bodies.
    period: Option<T>,
}

/// Identity of a gap, the same for all clones, whose samples are the same: its number, and the
/// period and where it begins, if the bodies are repeated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct GapId<T> {
    number: u64,
    cut: Option<[T; 2]>,
}

/// Tilt and bend of a gap, the bend by its number.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Added<T> {
    tilt: T,
    pub bend: Option<u64>,
}

impl<T: Real> Added<T> {
    pub fn nothing() -> Self {
        Self { tilt: T::zero(), bend: None }
    }

    pub fn is(&self, other: &Self) -> bool {
        same(self.tilt, other.tilt) && self.bend == other.bend
    }
}

/// Body, lent by the user or owned. (An owned body holds no references: otherwise a contact would
/// have to be dropped before its referents, instead of only not being used any more.)
#[derive(Clone)]
pub(crate) enum Shape<'b, T: Real> {
    Lent(&'b dyn ParametricProfile<T>),
    Owned(Arc<dyn ParametricProfile<T>>),
    Repeated(Arc<Repeated<'b, T>>),
}

impl<T: Real> Shape<'_, T> {
    pub fn profile(&self) -> &dyn ParametricProfile<T> {
        match self {
            Self::Lent(profile) => *profile,
            Self::Owned(profile) => &**profile,
            Self::Repeated(body) => &**body,
        }
    }
}

/// Body as a row of smooth pieces.
#[derive(Clone)]
struct Surface<'b, T: Real> {
    shape: Shape<'b, T>,
    /// Number of pieces of a compound profile; `None` for one that is smooth itself.
    joined: Option<usize>,
    /// Range of k and ends of the first piece. (The piece itself may belong to the shape.)
    k: [T; 2],
    ends: [CurvePoint<T>; 2],
}

impl<'b, T: Real> Surface<'b, T> {
    fn new(body: Body, shape: Shape<'b, T>) -> Fallible<T, Self> {
        let profile = shape.profile();
        let pieces = match Piece::first_of(profile) {
            Ok(Some((count, first))) => Ok((Some(count), first)),
            Ok(None) => Piece::new(profile).map(|piece| (None, piece)),
            Err(source) => Err(source),
        };
        match pieces {
            Ok((joined, Piece { k, ends, .. })) => Ok(Self { shape, joined, k, ends }),
            Err(source) => Err(InputError::Profile { body, source }.into()),
        }
    }

    fn len(&self) -> usize {
        self.joined.unwrap_or(1)
    }

    #[inline(always)]
    fn piece(&self, index: usize) -> Piece<'_, T> {
        let profile = self.shape.profile();
        let piece = self.joined.and_then(|_| profile.piece(index));
        // A missing piece is noticed where it is used: the first is not in its place.
        piece.unwrap_or(Piece { curve: profile, k: self.k, ends: self.ends })
    }

    /// Tells whether a body has no ends.
    fn is_endless(&self) -> bool {
        let [first, last] = self.extent();
        T::max_value().is_some_and(|most| last - first > T::of(0.125) * most)
    }

    fn extent(&self) -> [T; 2] {
        [self.piece(0).ends[0].x, self.piece(self.len() - 1).ends[1].x]
    }

    /// Returns the first piece that does not end before `x` (from the left) or at it (from the
    /// right).
    fn index_at(&self, x: T, side: Side) -> usize {
        let (mut low, mut high) = (0, self.len() - 1);
        while low < high {
            let middle = (low + high) / 2;
            let end = self.piece(middle).ends[1].x;
            let before = match side {
                Side::Left => end < x,
                Side::Right => end <= x,
            };
            if before { low = middle + 1 } else { high = middle }
        }
        low
    }

    /// Returns the pieces on both sides of a breakpoint.
    fn pieces_at(&self, x: T) -> Option<[Piece<'_, T>; 2]> {
        let (index, last) = (self.index_at(x, Side::Left), self.len() - 1);
        let left = self.piece(index);
        if index == last || left.ends[1].x > x {
            return None;
        }
        let mut after = (index + 1..last).map(|i| self.piece(i));
        let right = after.find(|piece| piece.ends[1].x > x);
        Some([left, right.unwrap_or(self.piece(last))])
    }

    /// Returns the first breakpoint to the right of `x`.
    fn breakpoint_after(&self, x: T) -> Option<T> {
        self.joined?;
        let index = self.index_at(x, Side::Right);
        let end = self.piece(index).ends[1].x;
        (index + 1 < self.len() && end > x).then_some(end)
    }

    /// Returns the last breakpoint to the left of `x`.
    fn breakpoint_before(&self, x: T) -> Option<T> {
        self.joined?;
        let index = self.index_at(x, Side::Left);
        let start = index.checked_sub(1).map(|before| self.piece(before).ends[1].x);
        start.filter(|&start| start < x)
    }
}

/// Cost of sampling the gap.
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Contact, Control, Flat};
///
/// let body = Parabola::new(1.0f64, [-1.0, 1.0])?;
/// let solution = Contact::new(&Flat, &body)?.solve(Control::Load(0.02))?;
/// // The slope of a parabola is known: no curve is evaluated.
/// assert_eq!(solution.cost().evaluations, 0);
/// assert!(solution.cost().samples > 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Cost {
    /// Number of values of the gap slope `g(x)`.
    pub samples: usize,
    /// Number of evaluations of the users' curves while solving: points taken one by one with
    /// [`ParametricProfile::at`] or in a batch with [`ParametricProfile::at_many`].
    pub evaluations: usize,
    /// Number of further evaluations of the users' curves, for questions about the bodies as a
    /// whole: for their heights, including the inversion of `X(k) = x` there, and for checks of the
    /// result of another quadrature.
    pub heights: usize,
    /// Number of searches by [`Contact::inversion`](crate::Contact::inversion) and
    /// [`Contact::limit_search`](crate::Contact::limit_search), besides those for heights. Panels
    /// invert only where a few of Newton's steps are not enough.
    pub searches: usize,
    /// Number of values of a function taken in these searches.
    pub search_values: usize,
}

impl std::fmt::Display for Cost {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { samples, evaluations, heights, searches, search_values } = self;
        write!(f, "{samples} samples by {evaluations} evaluations, and {heights} for heights")?;
        if *searches > 0 {
            write!(f, "; {searches} searches with {search_values} values")?;
        }
        Ok(())
    }
}

impl std::ops::Add for Cost {
    type Output = Self;
    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl std::ops::AddAssign for Cost {
    fn add_assign(&mut self, other: Self) {
        self.samples = self.samples.saturating_add(other.samples);
        self.evaluations = self.evaluations.saturating_add(other.evaluations);
        self.heights = self.heights.saturating_add(other.heights);
        self.searches = self.searches.saturating_add(other.searches);
        self.search_values = self.search_values.saturating_add(other.search_values);
    }
}

impl<'b, T: Real> Gap<'b, T> {
    pub(crate) fn new(
        lower: Shape<'b, T>,
        upper: Shape<'b, T>,
        inversion: &'b dyn LimitSearch<T>,
    ) -> Fallible<T, Self> {
        let convexity = [&lower, &upper].map(|shape| shape.profile().convexity());
        let convex = Convexity::gap_is_convex(convexity[0], convexity[1]);
        let bodies = [Surface::new(Body::Lower, lower)?, Surface::new(Body::Upper, upper)?];
        let [lower, upper] = [bodies[0].extent(), bodies[1].extent()];
        let range = [lower[0].max(upper[0]), lower[1].min(upper[1])];
        if range[0] >= range[1] {
            return Err(InputError::NoCommonRange { lower, upper }.into());
        }
        let (number, tilt, bend) = (number(), T::zero(), None);
        let (watch, resolution, period) = (None, None, None);
        Ok(Self { bodies, inversion, range, number, convex, tilt, bend, watch, resolution, period })
    }

    /// Returns the standard deviation that noise of measurements leaves in a sum of slopes of the
    /// gap, each times a weight; `None` if it is not known.
    pub(crate) fn slope_deviation(&self, x: &[T], weights: &[T]) -> Option<T> {
        self.bodies.iter().try_fold(T::zero(), |sum, body| {
            Some(sum.hypot(body.shape.profile().slope_deviation(x, weights)?))
        })
    }

    pub(crate) fn with_inversion(self, inversion: &'b dyn LimitSearch<T>) -> Self {
        Self { inversion, ..self }
    }

    pub(crate) fn with_watch(self, watch: Watch<'b, T>) -> Self {
        Self { watch: Some(watch), ..self }
    }

    /// Reports the progress of the solve to the watching function, and stops the solve if it asks
    /// for this.
    #[inline]
    pub(crate) fn check_watch(&self, cost: Cost, last: crate::Interval<T>) -> Fallible<T, ()> {
        match self.watch {
            Some(watch) if watch(cost, last).is_break() => {
                Err(SolveError::Cancelled { evaluations: cost.evaluations + cost.heights, last }
                    .into())
            }
            _ => Ok(()),
        }
    }

    /// Returns the same bodies with this tilt; samples are valid for both.
    pub(crate) fn tilted(&self, tilt: T) -> Cow<'_, Self> {
        match same(tilt, self.tilt) {
            true => Cow::Borrowed(self),
            false => Cow::Owned(Self { tilt, ..self.clone() }),
        }
    }

    /// Returns the same bodies with the slope of the gap lowered by a bend over κ; samples are
    /// valid for both.
    pub(crate) fn bent(&self, bend: Bend<'b, T>, kappa: T) -> Self {
        // Convexity that the bodies declare says nothing of the bent ones.
        let bend = Some((Arc::new(bend), kappa.recip(), number()));
        Self { bend, convex: false, ..self.clone() }
    }

    /// Returns the bend of the bodies, if they are bent.
    pub(crate) fn bend(&self) -> Option<&Bend<'b, T>> {
        self.bend.as_ref().map(|(bend, ..)| &**bend)
    }

    /// Returns the bodies as they are described, neither turned nor bent.
    pub(crate) fn as_described(&self) -> Self {
        Self { tilt: T::zero(), bend: None, ..self.clone() }
    }

    pub(crate) fn tilt(&self) -> T {
        self.tilt
    }

    /// Returns the tilt, and the number of the bend.
    pub(crate) fn added(&self) -> Added<T> {
        Added { tilt: self.tilt, bend: self.bend.as_ref().map(|(.., number)| *number) }
    }

    /// Returns the part of a bend in the slope (0) or in the height (1) of the gap at x.
    pub(crate) fn bend_at<const N: usize>(&self, which: [usize; N], x: T) -> [T; N] {
        let Some((bend, share, _)) = &self.bend else { return [T::zero(); N] };
        bend.values(which, x).map(|of| -*share * of)
    }

    /// Returns the slope added to the bodies as described by their tilt and their bend.
    pub(crate) fn added_slope(&self, x: T) -> T {
        self.tilt + self.bend_at([0], x)[0]
    }

    /// Returns the height of the gap at x, given the height between the bodies as described.
    pub(crate) fn with_added(&self, x: T, height: T) -> T {
        self.turned(x, height + self.bend_at([1], x)[0])
    }

    /// Returns the height of the gap at x after the tilt, given the height before. (A body may have
    /// no end.)
    pub(crate) fn turned(&self, x: T, height: T) -> T {
        if same(self.tilt, T::zero()) { height } else { height + self.tilt * x }
    }

    /// Tells whether the bodies declare that the gap between them is convex, and are believed: they
    /// touch in one interval.
    pub(crate) fn is_convex(&self) -> bool {
        self.convex
    }

    /// Returns the place nearest to `x` that both bodies cover.
    pub(crate) fn nearest(&self, x: T) -> T {
        x.max(self.range[0]).min(self.range[1])
    }

    /// Returns the range of `x` that both bodies cover.
    pub fn range(&self) -> [T; 2] {
        self.range
    }

    /// Returns the first place to the right of `x`, and on both bodies, where either profile passes
    /// from one piece to the next.
    pub fn breakpoint_after(&self, x: T) -> Option<T> {
        let x = x.max(self.range[0]);
        let breakpoints = self.bodies.iter().filter_map(|body| body.breakpoint_after(x));
        breakpoints.reduce(T::min).filter(|&breakpoint| breakpoint < self.range[1])
    }

    /// Returns the last place to the left of `x`, and on both bodies, where either profile passes
    /// from one piece to the next.
    pub fn breakpoint_before(&self, x: T) -> Option<T> {
        let x = x.min(self.range[1]);
        let breakpoints = self.bodies.iter().filter_map(|body| body.breakpoint_before(x));
        breakpoints.reduce(T::max).filter(|&breakpoint| breakpoint > self.range[0])
    }

    /// Tells whether either profile passes from one piece to the next at `x`.
    pub(crate) fn is_breakpoint(&self, x: T) -> bool {
        self.bodies.iter().any(|body| body.pieces_at(x).is_some())
    }

    /// Returns the breakpoints strictly inside an interval, rising.
    pub fn breakpoints(&self, on: crate::Interval<T>) -> impl Iterator<Item = T> {
        let first = self.breakpoint_after(on.left);
        std::iter::successors(first, |&breakpoint| self.breakpoint_after(breakpoint))
            .take_while(move |&breakpoint| breakpoint < on.right)
    }

    /// Returns the breakpoints strictly inside an interval where the slope jumps in the direction
    /// of `sign`, so that the pressure is infinite, and about `most` of the others, evenly.
    /// (Pressures at all of very many breakpoints would take longer than all else.)
    pub(crate) fn telling_breakpoints(
        &self,
        on: crate::Interval<T>,
        sign: T,
        most: usize,
    ) -> impl Iterator<Item = T> {
        let stride = 1 + self.breakpoints(on).count() / most;
        let telling = move |&(i, breakpoint): &(usize, T)| {
            let [jump, ..] = self.jump(breakpoint);
            i % stride == 0 || sign * jump > T::zero() || !jump.is_finite()
        };
        self.breakpoints(on).enumerate().filter(telling).map(|(_, breakpoint)| breakpoint)
    }

    /// Returns the jump of the slope at a breakpoint, from the known ends of the pieces, zero where
    /// it is rounding, and the step of the height, which the tolerance of a joint may let pass.
    pub(crate) fn jump(&self, breakpoint: T) -> [T; 2] {
        let [mut jump, mut size, mut step] = [T::zero(); 3];
        for (body, sign) in [(Body::Lower, -T::one()), (Body::Upper, T::one())] {
            if let Some([left, right]) = self.bodies[body as usize].pieces_at(breakpoint) {
                step += sign * (right.ends[0].y - left.ends[1].y);
                let [left, right] =
                    [(left, 1), (right, 0)].map(|(piece, end)| piece.end_slope(end, &mut 0));
                jump += sign * (right - left);
                size += left.abs() + right.abs();
            }
        }
        let is_told = jump.abs() > T::epsilon().sqrt() * size || !size.is_finite();
        [if is_told { jump } else { T::zero() }, step]
    }

    /// Returns the smooth piece of a body to the left or right of `x`, and its number.
    #[inline(always)]
    pub(crate) fn piece_at(&self, body: Body, x: T, side: Side) -> (usize, Piece<'_, T>) {
        let surface = &self.bodies[body as usize];
        let index = surface.index_at(x, side);
        (index, surface.piece(index))
    }

    /// Returns the piece at `x` for an evaluation of its curve, after a check that it contains `x`.
    pub(crate) fn piece_with(
        &self,
        body: Body,
        x: T,
        side: Side,
    ) -> Fallible<T, (usize, Piece<'_, T>)> {
        let (index, piece) = self.piece_at(body, x, side);
        let surface = &self.bodies[body as usize];
        let (count, [from, to]) = (surface.len(), piece.x());
        // Ends may miss each other by a tolerance that only the profile knows.
        let allowed = T::of(0.5) * (to - from).max(from.abs()).max(to.abs());
        let apart = |before: usize| from - surface.piece(before).x()[1] >= allowed;
        let misses = x < from && index.checked_sub(1).is_some_and(apart);
        if from >= to || misses || (x > to && index + 1 < count) {
            let source = ProfileError::Pieces { count, index };
            return Err(InputError::Profile { body, source }.into());
        }
        Ok((index, piece))
    }

    /// Returns the slope of a body at one of its points, by a central difference over a share of
    /// its piece.
    pub(crate) fn difference(&self, body: Body, x: T, k: T, share: T) -> T {
        let (_, piece) = self.piece_at(body, x, Side::Left);
        let [from, to] = [piece.k[0].min(piece.k[1]), piece.k[0].max(piece.k[1])];
        let step = share * (to - from);
        let [one, other] = [(k - step).max(from), (k + step).min(to)].map(|k| piece.curve.at(k));
        (other.y - one.y) / (other.x - one.x)
    }

    pub(crate) fn inversion(&self) -> &dyn LimitSearch<T> {
        self.inversion
    }

    /// Checks that the cost of a search is within its budget, or several times the budget, given
    /// the span sampled last.
    pub(crate) fn check_budget(
        &self,
        cost: Cost,
        times: usize,
        more: usize,
        last: crate::Interval<T>,
    ) -> Fallible<T, ()> {
        self.check_watch(cost, last)?;
        let evaluations = cost.evaluations.max(cost.samples);
        if evaluations <= MAX_EVALUATIONS {
            return Ok(());
        }
        let pieces: usize = self.bodies.iter().map(Surface::len).sum();
        let each = MAX_EVALUATIONS.saturating_add(MAX_FOR_A_PIECE.saturating_mul(pieces));
        let budget = each.saturating_mul(times).saturating_add(more);
        if evaluations <= budget {
            Ok(())
        } else {
            Err(SolveError::BudgetSpent { evaluations, budget, last }.into())
        }
    }

    /// Returns the identity of the bodies as described.
    pub(crate) fn id(&self) -> GapId<T> {
        let cut = self.period.map(|period| [period, self.range[0]]);
        GapId { number: self.number, cut }
    }
}

/// Returns a number that no other gap, or bend, has.
fn number() -> u64 {
    static MADE: AtomicU64 = AtomicU64::new(1);
    MADE.fetch_add(1, Ordering::Relaxed)
}

impl<T: Real> std::fmt::Debug for Gap<'_, T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Gap").field("range", &self.range).finish_non_exhaustive()
    }
}
