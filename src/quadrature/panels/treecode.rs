//! A treecode: groups of panels, each seen as one from far enough away.
//!
//! From a distance of twice its length and more, `1/(t - x)` over a group is a polynomial in t of
//! degree 15 to rounding. The integral over the group is therefore a sum over 16 Chebyshev points,
//! whatever the number of panels: with ℓ_m the polynomial that is 1 at the m-th point and 0 at the
//! others,
//!
//! ```text
//! ∫ g(t)/(t - x) dθ = Σ_m W_m/(t_m - x),      W_m = ∫ g ℓ_m dθ
//! ```
//!
//! Groups are halved until few panels are left. The time for a pressure then grows with the
//! logarithm of the number of panels (the idea of tree codes: Barnes and Hut, *Nature* 324 (1986)
//! 446).

use super::near_far_sum::FarPanel;
use crate::Real;
use crate::numerics::chebyshev::{Coeffs, MAX_SIZE, Table};
use std::ops::Range;

/// Number of points that stand for a group.
const PROXIES: usize = 16;

/// Distance of a place from the middle of a group, in half-lengths, from which on these suffice:
/// coefficient n of `1/(t - x)` is 9.9⁻ⁿ of the first.
pub(super) const REACH: f64 = 5.0;

/// Largest number of panels in a group that is not divided.
const MAX_UNDIVIDED: usize = 5;

/// Group of neighbouring panels.
#[derive(Clone)]
pub(super) struct Group<T> {
    /// Numbers of the panels.
    pub parts: Range<usize>,
    /// Span of the surface from which the parts are to be looked at one by one.
    near: [T; 2],
    /// Left end, and half the length.
    left: T,
    half: T,
    /// Weights `W_m`.
    weights: [T; PROXIES],
    /// Sum of the errors of the panels, each times its length.
    error: T,
    /// Number of the next group outside this one.
    pub next: usize,
}

/// Groups parts, given the nodes `[t - t_left, g dθ]` of Gauss's rule on each; every group is
/// followed by its two halves. A group is not divided if all places to be seen are far from it.
pub(super) fn group<T: Real>(
    groups: &mut Vec<Group<T>>,
    parts: &[FarPanel<T>],
    numbers: Range<usize>,
    nodes: &[[T; 2]],
    is_far: &impl Fn([T; 2]) -> bool,
) {
    let within = &parts[numbers.clone()];
    let [Some(first), Some(last)] = [within.first(), within.last()] else { return };
    let (left, right) = (first.panel.x[0], last.panel.x[1]);
    let half = T::of(0.5) * (right - left);
    let (middle, reach) = (left + half, T::of(REACH) * half);
    let (mut near, mut error) = ([middle - reach, middle + reach], T::zero());
    for part in within {
        error += part.panel.error * (part.panel.half() + part.panel.half());
        let [from, to] = part.reached();
        near = [near[0].min(from), near[1].max(to)];
    }
    let (number, weights) = (groups.len(), [T::zero(); PROXIES]);
    let (parts_of, next) = (numbers.clone(), number + 1);
    groups.push(Group { parts: parts_of, near, left, half, weights, error, next });
    let mut sums = GroupMoments::new(left, half);
    if numbers.len() <= MAX_UNDIVIDED || is_far(near) {
        for part in within {
            for nodes in nodes[part.nodes.clone()].as_chunks().0 {
                sums.add(part.panel.x[0], nodes);
            }
        }
    } else {
        let middle = numbers.start + numbers.len() / 2;
        for numbers in [numbers.start..middle, middle..numbers.end] {
            let half = groups.len();
            group(groups, parts, numbers, nodes, is_far);
            let half = &groups[half];
            let points = half.points();
            let nodes: [_; PROXIES] = std::array::from_fn(|m| [points[m], half.weights[m]]);
            for nodes in nodes.as_chunks().0 {
                sums.add(half.left, nodes);
            }
        }
    }
    let next = groups.len();
    let group = &mut groups[number];
    (group.weights, group.next) = (Table::of(PROXIES).shares(&sums.values()), next);
}

/// Nodes treated together: numbers of nodes are multiples of this.
const W: usize = 8;

/// Integrals `∫ g T_k dθ` over a group, in lanes.
pub(super) struct GroupMoments<T> {
    left: T,
    by_half: T,
    lanes: [[T; W]; PROXIES],
}

impl<T: Real> GroupMoments<T> {
    /// Prepares the sums for a group with this left end and half of its length.
    pub fn new(left: T, half: T) -> Self {
        Self { left, by_half: T::one() / half, lanes: [[T::zero(); W]; PROXIES] }
    }

    /// Adds nodes, given by their distances from `from`.
    pub fn add(&mut self, from: T, nodes: &[[T; 2]; W]) {
        let offset = from - self.left;
        let s: [T; W] = std::array::from_fn(|i| (offset + nodes[i][0]) * self.by_half - T::one());
        let mut t0 = nodes.map(|[_, weighted]| weighted);
        let mut t1: [T; W] = std::array::from_fn(|i| t0[i] * s[i]);
        for lanes in &mut self.lanes {
            for i in 0..W {
                lanes[i] += t0[i];
                (t0[i], t1[i]) = (t1[i], (s[i] + s[i]) * t1[i] - t0[i]);
            }
        }
    }

    pub fn values(&self) -> [T; PROXIES] {
        self.lanes.map(|lanes| lanes.into_iter().fold(T::zero(), |sum, lane| sum + lane))
    }
}

impl<T: Real> Group<T> {
    /// Returns the points that stand for the group, as distances from its left end.
    fn points(&self) -> [T; PROXIES] {
        let z = &Table::of(PROXIES).z;
        std::array::from_fn(|m| self.half * T::of(1.0 + z[m]))
    }

    /// Returns both ends.
    pub fn ends(&self) -> [T; 2] {
        [self.left, self.left + (self.half + self.half)]
    }

    /// Lists the points that stand for the group, as distances from its left end, each with its
    /// share of the integral of g.
    pub fn charges(&self) -> impl Iterator<Item = [T; 2]> + use<'_, T> {
        self.points().into_iter().zip(self.weights).map(|(along, weight)| [along, weight])
    }

    /// Tells whether the parts are to be looked at one by one from a place on the surface.
    pub fn is_near(&self, x: T) -> bool {
        x > self.near[0] && x < self.near[1]
    }

    /// Returns a bound on the error of the integral by the errors of the panels, without the factor
    /// of dθ.
    pub fn doubt(&self, x: T) -> T {
        let [left, right] = self.ends();
        self.error / (left - x).max(x - right)
    }

    /// Returns the cosine series of g and its number of terms, if the group is a whole contact.
    pub fn cosines(&self) -> (Coeffs<T>, usize) {
        let (mut series, share) = ([T::zero(); MAX_SIZE], T::count(PROXIES) * T::frac_1_pi());
        series[..PROXIES].copy_from_slice(&Table::of(PROXIES).coefficients(&self.weights));
        (series.map(|a| share * a), PROXIES)
    }

    /// Returns `∫ g(t)/(t - x) dθ`.
    pub fn integral(&self, x: T) -> T {
        let (offset, points) = (self.left - x, self.points());
        let terms: [T; PROXIES] = std::array::from_fn(|m| self.weights[m] / (offset + points[m]));
        terms.into_iter().fold(T::zero(), |sum, term| sum + term)
    }
}
