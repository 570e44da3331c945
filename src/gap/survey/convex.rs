//! Stretches where the gap is seen to be convex, and the reach of a load beyond them.
//!
//! In a contact Γ from -b to a the gap h differs from the potential `V = (1/κ) ∫ P(s) ln|x - s| ds`
//! by a constant. The constant is the mean of h, weighted by `1/(π sqrt((x + b)(a - x)))`, less
//! `(F/κ) ln(L/2)`, as the mean of `ln|x - s|` is `ln(L/2)` for every s in Γ. The mean of a convex
//! h is at most `(h(-b) + h(a))/2`. No place is further than W from any point of Γ, so that nothing
//! is touched where
//!
//! ```text
//! h(x) > (h(-b) + h(a))/2 + (F/κ) ln(2 W/L)
//! ```
//!
//! Between two places that a load touches, a convex gap is closed everywhere: otherwise h - V would
//! be convex there, and zero at both ends. So one interval in a convex stretch is the contact, if
//! the gap beyond the stretch is higher than this bound.

use super::panel::Panel;
use super::{Node, Survey, hull_in};
use crate::gap::{Cost, Gap};
use crate::real::same;
use crate::{ContactError, Fallible, Interval, Real};

/// Number of evaluations beyond which no more are taken for a proof alone.
const MAX_FOR_PROOF: usize = 81;

/// Largest uncertainty of two neighbouring slopes in a proof, as a share of the rise between them.
/// A wave that hides in it has a length of about this share of the distance of the points.
const MAX_SLOPE_UNCERTAINTY: f64 = 1e-3;

/// Number of spans on either side of a span that must bulge like it.
const IN_A_ROW: usize = 2;

/// Stretch between two points on which the gap is convex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch<T> {
    /// Numbers of its first and its last point.
    nodes: [usize; 2],
    /// Tilt of the bodies, and the approximate lowest gap elsewhere; infinite if there is no
    /// elsewhere.
    tilt: T,
    beyond: T,
}

/// Shape of the gap between two points, as far as it is known.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Shape {
    Convex,
    Open,
    Bent,
}

impl<T: Real> Survey<T> {
    /// Tells whether the bodies touch in one interval under any load: the gap is seen to be convex
    /// everywhere.
    pub fn is_convex(&self) -> bool {
        let whole = [0, self.nodes.len() - 1];
        self.bend.is_none() && self.stretch.is_some_and(|stretch| stretch.nodes == whole)
    }

    /// Tells whether a load F/κ that presses the bodies together on an interval provably touches
    /// nothing else. Between its places a bend is known, but not within bounds.
    ///
    /// # Errors
    /// As [`take`](Self::take).
    pub fn prove(
        &mut self,
        gap: &Gap<'_, T>,
        on: Interval<T>,
        load: T,
        cost: &mut Cost,
    ) -> Result<bool, ContactError<T>> {
        Ok(self.bend.is_none() && self.sees_one(gap, on, load, cost)?)
    }

    /// Tells whether a load F/κ that presses the bodies together on an interval seems to touch
    /// nothing else, because the gap is convex around it. Halves panels as long as more points may
    /// show it.
    pub(super) fn sees_one(
        &mut self,
        gap: &Gap<'_, T>,
        on: Interval<T>,
        load: T,
        cost: &mut Cost,
    ) -> Fallible<T, bool> {
        loop {
            let level = self.level_reached(gap, on, load);
            if self.is_untouched_beyond(gap, on, level) {
                return Ok(true);
            }
            let mut open = std::mem::take(&mut self.marked);
            let refined = match self.open_below(gap, on, level, &mut open) {
                true => self.refine_for_proof(gap, open.each_ref().map(|open| &open[..]), cost),
                false => Ok(false),
            };
            self.marked = open;
            if !refined? {
                return Ok(false);
            }
        }
    }

    /// Refines the panels of either body on some spans, if the cost is small; tells whether there
    /// were any.
    fn refine_for_proof(
        &mut self,
        gap: &Gap<'_, T>,
        open: [&[[T; 2]]; 2],
        cost: &mut Cost,
    ) -> Fallible<T, bool> {
        let (mut more, mut converges) = (0, true);
        for (body, (surface, open)) in self.bodies.iter().zip(gap.bodies.iter().zip(open)) {
            more += body.cost(surface, open, |panel| panel.may_gain(T::zero()));
            let mut marked = body.panels.iter().filter(|panel| hull_in(open, panel).is_some());
            converges &= marked.all(Panel::converges);
        }
        let is_dear = self.spent + more > MAX_FOR_PROOF || !converges;
        Ok(!is_dear && self.refine_at(gap, open, T::zero(), cost)?)
    }

    /// Returns the height up to which a load on an interval of a convex gap may reach.
    fn level_reached(&self, gap: &Gap<'_, T>, on: Interval<T>, load: T) -> T {
        let [from, to] = self.range;
        let farthest = (on.right - from).max(to - on.left);
        // On the chords between the points around the limits.
        let height = |x: T| {
            let [before, after] = self.around(x);
            let share = (x - before.x) / (after.x - before.x);
            gap.turned(x, before.height + share * (after.height - before.height))
        };
        let mean = T::of(0.5) * (height(on.left) + height(on.right));
        mean + load * ((farthest + farthest) / on.half_width()).ln()
    }

    pub(super) fn is_untouched_beyond(
        &mut self,
        gap: &Gap<'_, T>,
        on: Interval<T>,
        level: T,
    ) -> bool {
        let holds = |stretch: &Stretch<T>| {
            let [first, last] = stretch.nodes;
            same(stretch.tilt, gap.tilt())
                && self.nodes[first].x <= on.left
                && on.right <= self.nodes[last].x
        };
        let stretch = match self.stretch.filter(holds) {
            Some(stretch) => stretch,
            None => *self.stretch.insert(self.stretch_around(gap, on)),
        };
        let [first, last] = stretch.nodes.map(|i| self.nodes[i].x);
        first <= on.left && on.right <= last && stretch.beyond >= level
    }

    /// Finds the longest stretch around the middle of an interval on which the gap is convex.
    fn stretch_around(&self, gap: &Gap<'_, T>, on: Interval<T>) -> Stretch<T> {
        let (end, centre) = (self.nodes.len() - 1, on.centre());
        let start = self.nodes.partition_point(|node| node.x <= centre).max(1) - 1;
        let convex = |i: usize| self.shape_after(i) == Shape::Convex;
        let kinks_up = |i: usize| !self.nodes[i].falls();
        let (mut first, mut last) = (start, start);
        while last < end && convex(last) && (last == start || kinks_up(last)) {
            last += 1;
        }
        while last > start && first > 0 && kinks_up(first) && convex(first - 1) {
            first -= 1;
        }
        let elsewhere = (0..first).chain(last..end);
        let beyond = elsewhere.map(|i| self.floor(gap, i)).fold(T::one() / T::zero(), T::min);
        Stretch { nodes: [first, last], tilt: gap.tilt(), beyond }
    }

    /// Returns the approximate lowest gap between a point and the next; minus infinity where it is
    /// unknown.
    fn floor(&self, gap: &Gap<'_, T>, i: usize) -> T {
        // A NaN replaces the number before it; the lowest place has one if an end has.
        let least = |low: T, x: T, height: T| {
            let height = gap.turned(x, height);
            if low < height { low } else { height }
        };
        let [from, to] = [&self.nodes[i], &self.nodes[i + 1]];
        let ends = least(gap.turned(from.x, from.height), to.x, to.height);
        let known = self.low_between(i).filter(|_| !from.is_open);
        let floor = known.map(|low| least(ends, low.x, low.height) - low.doubt);
        floor.filter(|floor| floor.is_finite()).unwrap_or(-T::one() / T::zero())
    }

    /// Lists the spans, below a level or on an interval, that more points may prove to be convex,
    /// each for the body of larger uncertainty; tells whether all of them may be convex.
    fn open_below(
        &self,
        gap: &Gap<'_, T>,
        on: Interval<T>,
        level: T,
        open: &mut [Vec<[T; 2]>; 2],
    ) -> bool {
        open.iter_mut().for_each(Vec::clear);
        for (i, pair) in self.nodes.windows(2).enumerate() {
            let [from, to] = [pair[0].x, pair[1].x];
            let (is_touched, shape) = (from < on.right && on.left < to, self.shape_after(i));
            if shape == Shape::Convex && !pair[0].falls()
                || !is_touched && self.floor(gap, i) >= level
            {
                continue;
            }
            if shape == Shape::Bent || pair[0].falls() {
                return false;
            }
            let [lower, upper] = [0, 1].map(|body| pair[0].doubts[body] + pair[1].doubts[body]);
            if lower >= upper {
                open[0].push([from, to]);
            }
            if upper >= lower {
                open[1].push([from, to]);
            }
        }
        true
    }

    /// Returns the shape of the gap between a point and the next, as far as it is known.
    pub(super) fn shape_after(&self, i: usize) -> Shape {
        let [node, next] = [&self.nodes[i], &self.nodes[i + 1]];
        let width = next.x - node.x;
        let (rise, doubt) = (next.slopes[0] - node.slopes[1], node.doubt() + next.doubt());
        let chord = (next.height - node.height) / width;
        let rounding = node.rounding(next);
        let most = doubt + node.chord_rounding(next) + T::of(8.0) * node.after / width;
        if rise < -most || chord < node.slopes[1] - most || chord > next.slopes[0] + most {
            return Shape::Bent;
        }
        // An upright end tells nothing of what lies before it.
        let is_known = rise >= -rounding
            && rise.is_finite()
            && doubt <= T::of(MAX_SLOPE_UNCERTAINTY) * rise.max(T::zero());
        if node.is_open || node.is_void || !is_known { Shape::Open } else { Shape::Convex }
    }
}

impl<T: Real> Node<T> {
    /// Tells whether the slope is less on the right than on the left.
    fn falls(&self) -> bool {
        self.slopes[1] < self.slopes[0] - (T::of(2.0) * self.doubt() + self.rounding(self))
    }
}

/// Lowers the uncertainty of heights where the gap bulges at several points in a row.
///
/// Slopes that rise at a rate c leave room for waves up to a height c d²/2 over a distance d, as
/// the slopes of a higher wave would fall somewhere. The uncertainty of a series in the parameter
/// is often far larger: far up a steep flank, or where X is not a polynomial.
pub(super) fn convex_stretches<T: Real>(nodes: &mut Vec<Node<T>>, rates: &mut Vec<T>) {
    let room = nodes.capacity();
    let rate = |from: &Node<T>, to: &Node<T>| {
        let (width, rise) = (to.x - from.x, to.slopes[0] - from.slopes[1]);
        let chord = (to.height - from.height) / width;
        let bulges = chord >= from.slopes[1] && chord <= to.slopes[0] && rise.is_finite();
        if bulges { rise / width } else { T::one() / T::zero() }
    };
    rates.clear();
    rates.reserve(room);
    rates.extend(nodes.windows(2).map(|pair| rate(&pair[0], &pair[1])));
    for i in 0..rates.len() {
        let around = &rates[i.saturating_sub(IN_A_ROW)..(i + IN_A_ROW + 1).min(rates.len())];
        if !nodes[i].is_void && !nodes[i].is_open && around.iter().all(|rate| rate.is_finite()) {
            let width = nodes[i + 1].x - nodes[i].x;
            // A straight span tells nothing of those beside it.
            let bent = around.iter().copied().filter(|rate| !rate.is_zero());
            let least = bent.fold(rates[i], T::min);
            nodes[i].after = nodes[i].after.min(T::of(0.5) * least * width * width);
        }
    }
}
