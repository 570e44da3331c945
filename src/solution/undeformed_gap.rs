//! The heights of the gap before loading over a contact, from its slopes alone.
//!
//! With `x = c + L cos θ` and h the height above the left limit,
//!
//! ```text
//! h(x) = ∫ g dx from the left limit to x      (1/π) ∫ h dθ = (1/π) ∫ g θ dx      θ from 0 to π
//! ```
//!
//! The second is the first after integration by parts: θ/π is the share of the angles to the right
//! of x. The 16-point Gauss rule is used on spans of θ that are halved until it agrees with the sum
//! over the halves.

use super::pressure_integral::add;
use super::solved::Solved;
use crate::gap::Sampler;
use crate::numerics::gauss_legendre::GaussLegendre;
use crate::search::{Bracket, Brent, SearchError, StoppingCriteria, TryFindError, try_find};
use crate::{ContactError, EvaluationError, Interval, Real};

/// Largest number of spans of θ beyond those between the breakpoints, before an integral is given
/// up.
const MAX_SPANS: usize = 20_000;

/// Number of nodes on a span.
const NODES: usize = 16;

/// Heights above the left limit of a contact.
#[derive(Clone, Copy)]
pub(super) struct UndeformedGap<T> {
    /// Mean height over θ.
    pub mean: T,
    /// Least height.
    pub least: T,
    /// Height at a given place, if it is in this contact.
    pub at: Option<T>,
}

/// Span of θ, from its left end in x.
struct Span<T> {
    /// θ at the left end in x, and at the right end.
    theta: [T; 2],
    /// `∫ g dx` and `∫ g θ dx`, and in `size` the integrals of the absolute values.
    sum: [T; 2],
    size: [T; 2],
    /// x and g at the nodes.
    nodes: [[T; 2]; NODES],
}

/// Slope of the gap before loading, in one contact.
struct Slopes<'s, T: Real> {
    solved: Solved<'s, T>,
    contact: usize,
    on: Interval<T>,
    sampler: Sampler<T>,
}

impl<T: Real> Slopes<'_, T> {
    /// Returns the slope from the samples of the solve if they cover x, otherwise from the curves.
    fn at(&mut self, x: T) -> Result<T, ContactError<T>> {
        let known = self.solved.sampled_slope(self.contact, x);
        known.map_or_else(|| self.sampler.slope(self.solved.gap, x), Ok)
    }

    fn span(&mut self, theta: [T; 2]) -> Result<Span<T>, ContactError<T>> {
        let zero = T::zero();
        let rule = GaussLegendre::sixteen();
        let (half, middle) =
            (T::of(0.5) * (theta[0] - theta[1]), T::of(0.5) * (theta[0] + theta[1]));
        let mut span = Span { theta, sum: [zero; 2], size: [zero; 2], nodes: [[zero; 2]; NODES] };
        for (i, node) in span.nodes.iter_mut().enumerate() {
            let angle = middle - half * T::of(rule.nodes[i]);
            let x = self.on.at_angle(angle);
            let slope = self.at(x)?;
            *node = [x, slope];
            // dx = L sin θ dθ.
            let term = T::of(rule.weights[i]) * half * self.on.half_width() * angle.sin() * slope;
            for (k, term) in [term, term * angle].into_iter().enumerate() {
                span.sum[k] += term;
                span.size[k] += term.abs();
            }
        }
        Ok(span)
    }

    /// Returns x and the slope at a limit, or `None` if the slope is not finite.
    fn at_limit(&mut self, x: T) -> Option<[T; 2]> {
        self.at(x).ok().filter(|slope| slope.is_finite()).map(|slope| [x, slope])
    }

    /// Lowers `found.least` to the height at the place between two nodes where the slope rises
    /// through zero, if it is lower; `height` is given at the angle `start` close by.
    fn dip(
        &mut self,
        found: &mut UndeformedGap<T>,
        nodes: [Option<[T; 2]>; 2],
        height: T,
        start: T,
    ) -> Result<(), ContactError<T>> {
        let [Some([from, falls]), Some([to, rises])] = nodes else { return Ok(()) };
        if !(falls < T::zero() && rises >= T::zero() && from < to) {
            return Ok(());
        }
        let bracket = Bracket::new(from, to).values(falls, rises);
        // The height is off by the square of the slope that is left.
        let residual = (T::epsilon().sqrt() * (rises - falls)).to_subset_unchecked();
        let brent = Brent { tolerance: StoppingCriteria { residual, ..StoppingCriteria::FULL } };
        let lowest = match try_find(&brent, |x| self.at(x), &bracket) {
            Ok(root) | Err(TryFindError::Search(SearchError::Budget { best: root })) => root.x,
            Err(TryFindError::Function(error)) => return Err(error),
            // The bracket is two neighbouring numbers: either will do.
            Err(TryFindError::Search(_)) => from,
        };
        let least = height + self.span([start, self.on.angle(lowest)])?.sum[0];
        found.least = found.least.min(least);
        Ok(())
    }
}

impl<T: Real> UndeformedGap<T> {
    pub fn new(solved: Solved<'_, T>, contact: usize, at: T) -> Result<Self, ContactError<T>> {
        let (zero, on) = (T::zero(), solved.contacts()[contact]);
        let stop = (at >= on.left && at <= on.right).then(|| on.angle(at));
        let mut slopes = Slopes { solved, contact, on, sampler: Sampler::default() };
        let mut angles = vec![T::pi()];
        angles.extend(solved.gap.breakpoints(on).map(|x| on.angle(x)));
        angles.push(zero);
        // The leftmost span is the last, to be taken first.
        let mut pending = Vec::new();
        let mut size = [zero; 2];
        for ends in angles.windows(2).rev().filter(|ends| ends[0] > ends[1]) {
            let span = slopes.span([ends[0], ends[1]])?;
            add(&mut size, &span.size);
            pending.push(span);
        }
        let tolerance = T::epsilon().powf(T::of(0.75));
        let (mut left, mut height, mut mean) = (MAX_SPANS, zero, zero);
        let mut found = Self { mean, least: zero, at: None };
        let mut before = slopes.at_limit(on.left);
        while let Some(span) = pending.pop() {
            let [from, to] = span.theta;
            let middle = T::of(0.5) * (from + to);
            let halves = [slopes.span([from, middle])?, slopes.span([middle, to])?];
            let agrees = |k: usize| {
                let refined = halves[0].sum[k] + halves[1].sum[k];
                (refined - span.sum[k]).abs() <= tolerance * size[k]
            };
            if !(agrees(0) && agrees(1)) {
                if left == 0 {
                    return Err(
                        EvaluationError::Integral { x: on.centre(), panels: MAX_SPANS }.into()
                    );
                }
                left -= 1;
                pending.extend(halves.into_iter().rev());
                continue;
            }
            for half in halves {
                let [start, end] = half.theta;
                if let Some(stop) = stop.filter(|&stop| stop <= start && stop >= end) {
                    found.at = Some(height + slopes.span([start, stop])?.sum[0]);
                }
                // A Gauss rule lists its nodes from right to left.
                for node in half.nodes.into_iter().rev() {
                    slopes.dip(&mut found, [before, Some(node)], height, start)?;
                    before = Some(node);
                }
                height += half.sum[0];
                mean += half.sum[1];
                found.least = found.least.min(height);
            }
        }
        let last = slopes.at_limit(on.right);
        slopes.dip(&mut found, [before, last], height, zero)?;
        Ok(Self { mean: mean / T::pi(), ..found })
    }
}
