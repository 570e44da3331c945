//! Places where the gap is low, from the points of a survey.

use super::segment::Segment;
use super::{Asked, Node, Survey};
use crate::gap::Gap;
use crate::{Interval, Real};

/// Cosines of the angles `(i + 1/2) π/8` up to a right angle: the places of the slopes from which
/// the load of a contact is estimated.
const COSINES: [f64; 4] = [
    0.980_785_280_403_230_4,
    0.831_469_612_302_545_2,
    0.555_570_233_019_602_2,
    0.195_090_322_016_128_3,
];

/// Largest apparent fall of a slope, as a share of the steepest slope.
const SHARE_OF_SLOPES: f64 = 1e-3;

/// Largest slope at the lowest gap, as a share of the rise of the slope between two points; at a
/// kink it is larger.
const SHARE_OF_RISE: f64 = 0.01;

/// Largest number of steps from the lowest place of a cubic to the lowest gap.
const MAX_POLISHES: usize = 6;

/// Largest number of halvings of an interval in search of a width or a place.
const MAX_BISECTIONS: usize = 200;

/// Height of the gap at x, or the approximate lowest one between two places, `[x, h, h']`, and its
/// uncertainty.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LowPoint<T> {
    pub x: T,
    pub height: T,
    pub between: Option<[[T; 3]; 2]>,
    pub doubt: T,
}

/// Returns the approximate lowest place of a function in a span, as a share of the span, and its
/// largest depth below the chord, per unit of the span: the crossing of the tangents at its ends,
/// given the slopes by which they leave the chord. No convex function is lower. A cubic that turns
/// may be lower, but not lower than its tangents at a third and at two thirds of the way.
pub(crate) fn crossing<T: Real>([first, second]: [T; 2]) -> Option<[T; 2]> {
    let (zero, third) = (T::zero(), T::of(1.0 / 3.0));
    if !(first > zero || second > zero) {
        return None;
    }
    let t = second.max(zero) / (first.max(zero) + second.max(zero));
    let t = t.max(third).min(third + third);
    Some([t, (first * t).max(second * (T::one() - t))])
}

pub(super) fn segment<T: Real>(from: &Node<T>, to: &Node<T>) -> Segment<T> {
    Segment::new([from.x, from.height], [to.x, to.height], [from.slopes[1], to.slopes[0]])
}

impl<T: Real> Survey<T> {
    /// Returns the height of the gap `Y₂ - Y₁` of the bodies as described at x, as far as it is
    /// known.
    pub fn height_as_described(&self, x: T) -> T {
        let [lower, upper] = self.bodies.each_ref().map(|body| body.at(body.panels_at(x)[1], x).y);
        upper - lower
    }

    /// Returns the height of the gap at x, of bodies that are not turned. Where the gap bulges, its
    /// points leave less room than a vague series takes.
    pub fn height(&self, gap: &Gap<'_, T>, x: T) -> T {
        let height = self.height_as_described(x) + gap.bend_at([1], x)[0];
        let doubts = self.bodies.iter().map(|body| body.panels[body.panels_at(x)[1]].doubt);
        let (room, doubt) = (self.around(x)[0].after, doubts.fold(T::zero(), |sum, a| sum + a));
        let [by_points, _] = if room < doubt { self.near(x) } else { [height; 2] };
        if (height - by_points).abs() > room { by_points } else { height }
    }

    /// Returns the uncertainty of the height at x, including the rounding of x; at a breakpoint, on
    /// its flatter side, whose land a steep wall does not move.
    pub fn doubt_at(&self, x: T) -> T {
        let doubt = |body: &super::Body<T>| {
            let [left, right] = body.panels_at(x).map(|panel| {
                let at = body.at(panel, x);
                let slope = if at.slope.is_finite() { at.slope.abs() } else { T::zero() };
                let rounding = T::epsilon() * (at.y.abs() + x.abs() * slope);
                body.panels[panel].doubt + T::of(8.0) * rounding
            });
            left.min(right)
        };
        self.bodies.iter().fold(T::zero(), |sum, body| sum + doubt(body))
    }

    /// Returns the slopes at both ends if the gap is the same wherever either body was sampled, to
    /// the rounding of the highest place, as a formula may have added terms of its size: as far as
    /// it is known, and by its own heights. They are zero, unless the heights are too small to have
    /// a rounding.
    pub fn level_slopes(&self, gap: &Gap<'_, T>, mut height: impl FnMut(T) -> T) -> Option<[T; 2]> {
        let nodes = &self.nodes;
        let [size, doubt] = nodes.iter().fold([T::zero(); 2], |[size, doubt], node| {
            [size.max(node.size), doubt.max(node.after)]
        });
        let rounding = T::of(64.0) * T::epsilon() * size;
        let known = |node: &Node<T>| gap.turned(node.x, node.height);
        let may_be = |node| (known(node) - known(&nodes[0])).abs() <= rounding + doubt;
        nodes.iter().all(may_be).then_some(())?;
        let first = height(nodes[0].x);
        nodes.iter().all(|node| (height(node.x) - first).abs() <= rounding).then_some(())?;
        let slope = |node: &Node<T>| if rounding.is_zero() { node.slopes[1] } else { T::zero() };
        Some([&nodes[0], &nodes[nodes.len() - 1]].map(slope))
    }

    /// Returns the slope of the gap at x, of bodies that are not turned, as far as it is known; at
    /// a breakpoint the slope on its right.
    pub fn slope(&self, gap: &Gap<'_, T>, x: T) -> T {
        let slope = |body: &super::Body<T>| body.at(body.panels_at(x)[1], x).slope;
        let [lower, upper] = self.bodies.each_ref().map(slope);
        upper - lower + gap.bend_at([0], x)[0]
    }

    /// Returns the gap wherever either body was sampled, `[x, h]` by rising x.
    pub fn heights(&self, gap: &Gap<'_, T>) -> Vec<[T; 2]> {
        self.nodes.iter().map(|node| [node.x, gap.turned(node.x, node.height)]).collect()
    }

    /// Returns the place of the lowest gap between a node and the next: where their tangents
    /// [cross](crossing), or else the middle.
    pub(super) fn low_between(&self, i: usize) -> Option<LowPoint<T>> {
        let chord = |i: usize| {
            let [from, to] = [self.nodes.get(i)?, self.nodes.get(i + 1)?];
            Some((to.height - from.height) / (to.x - from.x))
        };
        let (from, to, over) = (self.nodes[i], self.nodes.get(i + 1)?, chord(i)?);
        let width = to.x - from.x;
        let [first, second] = [over - from.slopes[1], to.slopes[0] - over];
        // An end that is nearly upright, or a kink, tells nothing about the span.
        let leap = |beside: Option<T>| beside.map_or(T::zero(), |beside| (over - beside).abs());
        let [before, behind] = [i.checked_sub(1).and_then(chord), chord(i + 1)].map(leap);
        let within = |bend: T, other: T, leap: T| bend.min(leap.max(other + other));
        let [first, second] = [within(first, second, before), within(second, first, behind)];
        let half = T::of(0.5);
        let (t, height) = match crossing([first, second]) {
            Some([t, below]) => (t, from.height + width * (t * over - below)),
            None => (half, segment(&from, to).at(half)[0]),
        };
        let ends = [(&from, from.slopes[1]), (to, to.slopes[0])];
        let ends = ends.map(|(node, slope)| [node.x, node.height, slope]);
        let x = from.x + t * width;
        Some(LowPoint { x, height, between: Some(ends), doubt: from.after })
    }

    /// Returns all places where the gap may be low: the nodes, and one place between each two.
    pub fn low_points(&self) -> impl Iterator<Item = LowPoint<T>> {
        let both = move |(i, &Node { x, height, .. }): (usize, &Node<T>)| {
            [Some(LowPoint { x, height, between: None, doubt: T::zero() }), self.low_between(i)]
        };
        self.nodes.iter().enumerate().flat_map(both).flatten()
    }

    /// Tells whether the slope rises from point to point, and the slope of every chord lies between
    /// the slopes at its ends. The uncertainty of the panels and cancellation in formulas are
    /// allowed for up to a share of all slopes: a larger allowance would hide waves.
    pub fn bulges(&self) -> bool {
        let slopes = self.nodes.iter().flat_map(|node| node.slopes);
        let steepest = slopes.filter(|a| a.is_finite()).map(|a| a.abs()).fold(T::zero(), T::max);
        let most = T::of(SHARE_OF_SLOPES) * steepest;
        let highest = self.nodes.iter().fold(T::zero(), |most, node| most.max(node.size));
        let cancelled = T::of(64.0) * T::epsilon() * highest;
        let jumps_down = |node: &Node<T>| node.slopes[1] < node.slopes[0] - node.rounding(node);
        self.bend.is_none()
            && !self.nodes.iter().any(jumps_down)
            && !self.nodes.windows(2).any(|pair| {
                let [from, to] = [&pair[0], &pair[1]];
                let width = to.x - from.x;
                let chord = (to.height - from.height) / width;
                let doubt =
                    from.doubt() + to.doubt() + (T::of(8.0) * from.after + cancelled) / width;
                let allowed = from.chord_rounding(to) + doubt.min(most);
                // Pieces that meet within rounding have no chord. A slope at an end may be NaN.
                from.is_open
                    || from.is_void
                    || to.slopes[0] < from.slopes[1] - (from.rounding(to) + doubt.min(most))
                    || chord < from.slopes[1] - allowed
                    || chord > to.slopes[0] + allowed
            })
    }

    /// Tells whether the gap seems to fall all the way to its lowest place and to rise from there,
    /// as far as the load of the last refinement reaches.
    pub fn is_one_valley(&self) -> bool {
        self.is_one
            || self.nodes.windows(2).all(|pair| {
                let [one, other] = [&pair[0], &pair[1]];
                let rise = other.height - one.height;
                let rounding = T::of(8.0) * T::epsilon() * (one.height.abs() + other.height.abs());
                if other.x <= self.lowest {
                    rise <= rounding
                } else {
                    one.x < self.lowest || rise >= -rounding
                }
            })
    }

    /// Returns the approximate load, as F/κ, of a contact of a half-width around the lowest gap:
    /// `F = (L/π) ∫ g cos θ dθ`.
    fn borne(&self, half_width: T) -> T {
        let sum = COSINES.iter().fold(T::zero(), |sum, &cosine| {
            let (cosine, aside) = (T::of(cosine), T::of(cosine) * half_width);
            let [left, right] = [self.lowest - aside, self.lowest + aside].map(|x| self.near(x)[1]);
            sum + cosine * (right - left)
        });
        half_width * sum / T::count(2 * COSINES.len())
    }

    /// Returns the approximate height and slope of the gap at x, from the points around it.
    pub(super) fn near(&self, x: T) -> [T; 2] {
        let [from, to] = self.around(x);
        let segment = segment(from, to);
        segment.at(((x - from.x) / segment.width).max(T::zero()).min(T::one()))
    }

    /// Returns the points before and after x, or the two that are nearest to it.
    pub(super) fn around(&self, x: T) -> [&Node<T>; 2] {
        let after = self.nodes.partition_point(|node| node.x <= x).max(1).min(self.nodes.len() - 1);
        [&self.nodes[after - 1], &self.nodes[after]]
    }

    /// Returns the approximate load for a prescribed quantity, as F/κ: of a round body the gap at
    /// the limits of the contact, above the lowest. On unlike sides of the lowest gap it lies on
    /// the flatter one.
    pub fn load_of(&self, gap: &Gap<'_, T>, asked: Asked<T>) -> T {
        let borne = |half_width: T| {
            let Interval { left, right } = self.level(gap, half_width);
            self.height(gap, left).min(self.height(gap, right)) - self.height(gap, self.lowest)
        };
        match asked {
            Asked::Load(load) | Asked::Turning(load) => load,
            Asked::HalfWidth(half_width) => borne(half_width),
            Asked::Peak(pressure) => {
                // P = 2 F/(π L) of a round body; the widest contact may have less.
                let hertz = |reach: T| T::frac_pi_2() * reach * pressure;
                let mut reach = T::of(0.25) * (self.range[1] - self.range[0]);
                let mut load = self.borne(reach);
                for _ in 0..MAX_BISECTIONS {
                    if borne(reach) <= hertz(reach) {
                        break;
                    }
                    reach *= T::of(0.5);
                    load = borne(reach);
                }
                load
            }
        }
    }

    /// Returns an interval around the lowest gap, somewhat wider than one that carries a load F/κ:
    /// the last that carries it, of intervals each half as wide as the one before.
    pub fn around_lowest(&self, load: Option<T>) -> Interval<T> {
        let (half, quarter, [from, to]) = (T::of(0.5), T::of(0.25), self.range);
        let around = |reach: T| {
            // At most half the way to an end, where the slope may be infinite.
            let x = self.lowest;
            let room = [half * (x - from), half * (to - x)].map(|room| reach.min(room));
            let least = T::of(64.0) * T::epsilon() * (from.abs() + to.abs());
            Interval {
                left: (x - room[0].max(least)).max(from),
                right: (x + room[1].max(least)).min(to),
            }
        };
        let Some(load) = load.filter(|&load| load > T::zero()) else {
            return around(quarter * (to - from));
        };
        match self.reach {
            Some([known, reach]) if known == load => around(reach),
            _ => around(self.reach_of(load)),
        }
    }

    /// Returns the half-width of the narrowest interval around the lowest gap that carries a load,
    /// of intervals each half as wide as the one before.
    pub(super) fn reach_of(&self, load: T) -> T {
        let half = T::of(0.5);
        let mut reach = T::of(0.25) * (self.range[1] - self.range[0]);
        for _ in 0..MAX_BISECTIONS {
            // NaN where the slope is unknown.
            let bears = self.borne(half * reach) >= load;
            if !bears {
                break;
            }
            reach *= half;
        }
        reach
    }

    /// Returns the interval around the lowest gap in which the gap seems to rise by less than
    /// `rise`. Towards an end of the bodies, where the slope may be infinite, it reaches half the
    /// way from the last node.
    pub fn below(&self, gap: &Gap<'_, T>, rise: T) -> Interval<T> {
        let (x, [from, to]) = (self.lowest, self.range);
        let heights = self.bodies.each_ref().map(|body| body.at(body.panels_at(x)[1], x).y.abs());
        let rounding = T::of(8.0) * T::epsilon() * (heights[0] + heights[1]);
        let level = self.height(gap, x) + rise.max(rounding);
        let (left, right) = self.nodes.split_at(self.nodes.partition_point(|node| node.x < x));
        Interval {
            left: self.rises_to(gap, level, left.iter().rev(), from),
            right: self.rises_to(gap, level, right.iter(), to),
        }
    }

    /// Finds the place where the gap rises to a level, over nodes from the lowest gap outward.
    fn rises_to<'n>(
        &self,
        gap: &Gap<'_, T>,
        level: T,
        outward: impl Iterator<Item = &'n Node<T>>,
        end: T,
    ) -> T
    where
        T: 'n,
    {
        let (half, mut low, mut high) = (T::of(0.5), self.lowest, end);
        for node in outward.filter(|node| node.x != end) {
            if node.height > level {
                high = node.x;
                break;
            }
            low = node.x;
        }
        if high == end {
            return half * low + half * end;
        }
        let from = low;
        for _ in 0..MAX_BISECTIONS {
            if (high - low).abs() <= T::of(0.0625) * (low - from).abs() {
                break;
            }
            let middle = half * low + half * high;
            *(if self.height(gap, middle) > level { &mut high } else { &mut low }) = middle;
        }
        high
    }

    /// Returns the interval of a half-width around the lowest gap with apparently equal heights at
    /// both ends, if there is room for it.
    pub fn level(&self, gap: &Gap<'_, T>, half_width: T) -> Interval<T> {
        let (x, half, [from, to]) = (self.lowest, T::of(0.5), self.range);
        let mut left = (x - half_width).max(from + half_width);
        let mut right = (x + half_width).min(to - half_width);
        for _ in 0..MAX_BISECTIONS {
            let middle = half * left + half * right;
            if !(left < middle && middle < right) {
                break;
            }
            let [left_end, right_end] = [middle - half_width, middle + half_width];
            let rises = self.height(gap, right_end) > self.height(gap, left_end);
            *(if rises { &mut right } else { &mut left }) = middle;
        }
        let centre = half * left + half * right;
        Interval { left: centre - half_width, right: centre + half_width }
    }

    pub(super) fn find_lowest(&self, gap: &Gap<'_, T>) -> T {
        let nodes = &self.nodes;
        // Heights far away may be so large that all others vanish in their rounding.
        let rounding = |one: T, other: T| T::of(8.0) * T::epsilon() * (one.abs() + other.abs());
        let mut lowest: Option<(T, [T; 2])> = None;
        let mut consider = |x: T, height: T| match &mut lowest {
            // As low as the lowest so far: extends the span.
            Some((least, on)) if (height - *least).abs() <= rounding(height, *least) => {
                on[1] = x;
            }
            Some((least, _)) if height > *least => {}
            lowest => *lowest = Some((height, [x, x])),
        };
        for (i, from) in nodes.iter().enumerate() {
            consider(from.x, from.height);
            let Some(to) = nodes.get(i + 1) else { break };
            let segment = segment(from, to);
            if let Some(t) = segment.minimum() {
                consider(from.x + t * segment.width, segment.at(t)[0]);
            }
        }
        let [from, to] = lowest.map_or(self.range, |(_, on)| on);
        let middle = T::of(0.5) * from + T::of(0.5) * to;
        if from == to {
            return from;
        }
        // Two separate places are equally low: takes the first.
        let [least, height] = [self.height(gap, from), self.height(gap, middle)];
        if height <= least + rounding(height, least) { middle } else { from }
    }

    /// Returns the place between two nodes where the slope passes through zero, near the zero of a
    /// cubic.
    pub(super) fn polished(&self, gap: &Gap<'_, T>, x: T) -> T {
        let nodes = &self.nodes;
        let after = nodes.partition_point(|node| node.x < x);
        let Some(before) =
            after.checked_sub(1).filter(|_| nodes.get(after).is_some_and(|node| node.x > x))
        else {
            return x;
        };
        let (mut low, mut high) = (nodes[before].x, nodes[after].x);
        let (mut falls, mut rises) = (nodes[before].slopes[1], nodes[after].slopes[0]);
        if !(falls < T::zero() && rises > T::zero() && (rises - falls).is_finite()) {
            return x;
        }
        let rise = rises - falls;
        let mut at = x;
        for _ in 0..MAX_POLISHES {
            let slope = self.slope(gap, at);
            if slope.abs() <= T::of(64.0) * T::epsilon() * rise {
                return at;
            }
            // The slope at the other end counts half (as in the Illinois method, but at every
            // step).
            if slope > T::zero() {
                (high, rises, falls) = (at, slope, T::of(0.5) * falls);
            } else {
                (low, falls, rises) = (at, slope, T::of(0.5) * rises);
            }
            let next = low + (high - low) * (falls / (falls - rises));
            let step = (next - at).abs();
            at = next;
            if step <= T::of(1e-3) * (high - low) {
                break;
            }
        }
        if self.slope(gap, at).abs() <= T::of(SHARE_OF_RISE) * rise { at } else { x }
    }
}
