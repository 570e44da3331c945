//! A first look at two bodies: heights and slopes of both, without solving `X(k) = x`.
//!
//! Each body is sampled evenly in its parameter, and what lies between two samples is a cubic through
//! both heights with the slopes there (Hermite's), which knows the height to the fourth power of their
//! distance. So one look at the bodies serves every question of where the gap is low, at any x.

use super::{Cost, Gap, Surface};
use crate::profile::{Piece, first_turn};
use crate::real::same;
use crate::{Body, ContactError, CurvePoint, Interval, ProfileError, Real};
use std::borrow::Cow;

/// Samples of a smooth body, its ends included.
const OF_A_BODY: usize = 64;

/// Samples of a piece of a joined body, its ends included.
const OF_A_PIECE: usize = 4;

/// Looks at a fifth of the way each, to come from a long body to where the other one is.
const MOST_ZOOMS: usize = 5;

/// Pieces from which on their ends, which are known, tell enough.
const MANY_PIECES: usize = 64;

/// Pieces up to which each is looked at; of more, as many of them evenly.
const MOST_PIECES: usize = 1 << 16;

/// Angles at which a slope is looked at for what a contact would bear.
const ANGLES: usize = 8;

/// How often an interval is halved in search of a width or of a place.
const MOST_HALVES: usize = 200;

/// Heights and slopes of two bodies.
#[derive(Clone, Debug)]
pub(crate) struct CoarseHeights<T> {
    bodies: [Vec<BodyRow<T>>; 2],
    /// Where both bodies are.
    range: [T; 2],
    /// The gap wherever either body was sampled, by rising x.
    nodes: Vec<GapNode<T>>,
    heights: Vec<[T; 2]>,
    lowest: T,
    bulges: bool,
    scratch: Scratch<T>,
}

/// A height of the gap, or between two of them about how low it may be, and by how much lower it might be
/// if they hide a wave.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LowPoint<T> {
    pub x: T,
    pub height: T,
    pub between: Option<[T; 2]>,
    pub doubt: T,
}

/// Where a piece is looked at: parameters, the points there, and those found beside a short range on the
/// right, from right to left.
#[derive(Clone, Debug)]
struct Scratch<T> {
    k: Vec<T>,
    points: Vec<CurvePoint<T>>,
    right: Vec<(T, CurvePoint<T>)>,
}

/// A sample. Where two pieces meet there is one for the slope on either side.
#[derive(Clone, Copy, Debug)]
struct BodyRow<T> {
    x: T,
    y: T,
    /// May be infinite, or NaN where `Y'/X'` is 0/0.
    slope: T,
}

/// The gap at an abscissa, with its slope on the left and on the right.
#[derive(Clone, Copy, Debug)]
struct GapNode<T> {
    x: T,
    height: T,
    slopes: [T; 2],
    /// How far off they may be by rounding.
    doubt: T,
    /// By how much a cubic from the node before to the one after misses the height here.
    missed: T,
}

impl<T: Real> CoarseHeights<T> {
    /// Looks at both bodies. Values that are not finite matter only inside the range of x that both
    /// cover.
    ///
    /// # Errors
    /// [`ContactError::Profile`] with [`ProfileError::NotFinite`], [`ProfileError::TurnsBack`] or
    /// [`ProfileError::Pieces`].
    pub fn take(&mut self, gap: &Gap<'_, T>, cost: &mut Cost) -> Result<(), ContactError<T>> {
        self.range = gap.range();
        for body in [Body::Lower, Body::Upper] {
            let surface = &gap.bodies[body as usize];
            let rows = &mut self.bodies[body as usize];
            rows.clear();
            let mut samples = Samples { rows, range: self.range, scratch: &mut self.scratch };
            let found = samples.look_at(surface, cost).and_then(|()| match samples.rows.len() {
                0 => {
                    let (k, value) = (surface.piece(0).k[0], T::of(f64::NAN));
                    Err(ProfileError::NotFinite { quantity: "Y", k, value })
                }
                _ => Ok(()),
            });
            found.map_err(|source| ContactError::Profile { body, source })?;
        }
        let mut nodes = std::mem::take(&mut self.nodes);
        self.find_knots(&mut nodes);
        self.heights.clear();
        self.heights.reserve(nodes.capacity());
        self.heights.extend(nodes.iter().map(|node| [node.x, node.height]));
        (self.lowest, self.bulges) = (self.find_lowest(&nodes), Self::find_bulging(&nodes));
        self.nodes = nodes;
        Ok(())
    }

    /// Not taken yet.
    pub fn new() -> Self {
        let zero = T::zero();
        Self {
            bodies: [Vec::new(), Vec::new()],
            range: [zero; 2],
            nodes: Vec::new(),
            heights: Vec::new(),
            lowest: zero,
            bulges: false,
            scratch: Scratch { k: Vec::new(), points: Vec::new(), right: Vec::new() },
        }
    }

    /// The height of the gap `Y₂ - Y₁` at x, as it looks; beyond the bodies along their last tangents.
    pub fn height(&self, x: T) -> T {
        let [lower, upper] = self.bodies.each_ref().map(|rows| at(rows, x, true)[0]);
        upper - lower
    }

    /// The slope of the gap at x, as it looks; at a breakpoint that on its right.
    pub fn slope(&self, x: T) -> T {
        let [lower, upper] = self.bodies.each_ref().map(|rows| at(rows, x, true)[1]);
        upper - lower
    }

    /// The height of the gap wherever either body was sampled, `[x, h]` by rising x.
    pub fn heights(&self, gap: &Gap<'_, T>) -> Cow<'_, [[T; 2]]> {
        if same(gap.tilt(), T::zero()) {
            return Cow::Borrowed(&self.heights);
        }
        Cow::Owned(self.heights.iter().map(|&[x, height]| [x, gap.turned(x, height)]).collect())
    }

    /// Where the gap may be low: each sample, and between two the place where their tangents cross, than which no
    /// convex piece of the gap is lower. A cubic that turns may be: it is no lower than its tangents at a third and at
    /// two thirds of the way. Elsewhere the middle, if it is in doubt.
    pub fn low_points(&self) -> impl Iterator<Item = LowPoint<T>> {
        let (zero, third) = (T::zero(), T::of(1.0 / 3.0));
        let chord = |i: usize| {
            let [from, to] = [self.nodes.get(i)?, self.nodes.get(i + 1)?];
            Some((to.height - from.height) / (to.x - from.x))
        };
        let after = move |i: usize| {
            let (from, to, over) = (self.nodes[i], self.nodes.get(i + 1)?, chord(i)?);
            let width = to.x - from.x;
            let [first, second] = [over - from.slopes[1], to.slopes[0] - over];
            // An end that is all but upright, or a kink, says nothing of what is between.
            let leap = |beside: Option<T>| beside.map_or(zero, |beside| (over - beside).abs());
            let [before, behind] = [i.checked_sub(1).and_then(chord), chord(i + 1)].map(leap);
            let within = |bend: T, other: T, leap: T| bend.min(leap.max(other + other));
            let [first, second] = [within(first, second, before), within(second, first, behind)];
            let inside = first > zero || second > zero;
            let doubt = from.missed + to.missed;
            let (t, height) = if inside {
                let crossing = second.max(zero) / (first.max(zero) + second.max(zero));
                let t = crossing.max(third).min(third + third);
                let below = (first * t).max(second * (T::one() - t));
                (t, from.height + width * (t * over - below))
            } else {
                let half = T::of(0.5);
                (half, Segment::new(from, *to).at(half)[0])
            };
            let (x, between) = (from.x + t * width, Some([from.x, to.x]));
            (inside || doubt > zero).then_some(LowPoint { x, height, between, doubt })
        };
        let both = move |(i, &[x, height]): (usize, &[T; 2])| {
            [Some(LowPoint { x, height, between: None, doubt: T::zero() }), after(i)]
        };
        self.heights.iter().enumerate().flat_map(both).flatten()
    }

    /// The place of the lowest gap; the middle of it where that is a span.
    pub fn lowest(&self) -> T {
        self.lowest
    }

    /// Whether the slope of the gap rises all along, as it looks and up to rounding: then nothing that
    /// is seen speaks against a single contact.
    pub fn bulges(&self) -> bool {
        self.bulges
    }

    /// Whether the gap falls all the way to its lowest place and rises from there, as it looks.
    pub fn is_one_valley(&self) -> bool {
        self.nodes.windows(2).all(|pair| {
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

    /// An interval about the lowest gap, somewhat wider than what would bear a load, that is F/κ, as it looks.
    pub fn around_lowest(&self, load: Option<T>) -> Interval<T> {
        let (x, half) = (self.lowest, T::of(0.5));
        let [from, to] = self.range;
        // F = (L/π) ∫ g cos θ dθ
        let borne = |reach: T| {
            let term = |sum: T, i: usize| {
                let cosine = (T::pi() * (T::count(i) + half) / T::count(ANGLES)).cos();
                sum + cosine * self.slope(x + reach * cosine)
            };
            reach * (0..ANGLES).fold(T::zero(), term) / T::count(ANGLES)
        };
        let mut reach = half * half * (to - from);
        if let Some(load) = load {
            for _ in 0..MOST_HALVES {
                if borne(half * reach) < load {
                    break;
                }
                reach *= half;
            }
        }
        // No further than half the way to an end, where the slope may be infinite.
        let room = [half * (x - from), half * (to - x)].map(|room| reach.min(room));
        let least = T::of(64.0) * T::epsilon() * (from.abs() + to.abs());
        Interval {
            left: (x - room[0].max(least)).max(from),
            right: (x + room[1].max(least)).min(to),
        }
    }

    /// The interval about the lowest gap in which it rises by less than so much, as it looks; to an end of the bodies,
    /// where the slope may be infinite, half the way.
    pub fn below(&self, rise: T) -> Interval<T> {
        let (x, [from, to]) = (self.lowest, self.range);
        let heights = self.bodies.each_ref().map(|rows| at(rows, x, true)[0].abs());
        let rounding = T::of(8.0) * T::epsilon() * (heights[0] + heights[1]);
        let level = self.height(x) + rise.max(rounding);
        let (left, right) = self.nodes.split_at(self.nodes.partition_point(|node| node.x < x));
        Interval {
            left: self.rises_to(level, left.iter().rev(), from),
            right: self.rises_to(level, right.iter(), to),
        }
    }

    /// Where the gap rises to a level, over samples from the lowest gap outward.
    fn rises_to<'n>(&self, level: T, outward: impl Iterator<Item = &'n GapNode<T>>, end: T) -> T
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
        for _ in 0..MOST_HALVES {
            if (high - low).abs() <= T::of(0.125) * (low - from).abs() {
                break;
            }
            let middle = half * low + half * high;
            *(if self.height(middle) > level { &mut high } else { &mut low }) = middle;
        }
        high
    }

    /// The interval of a half-width about the lowest gap at whose two ends that is as high, as it looks, if there is
    /// room for it.
    pub fn level(&self, half_width: T) -> Interval<T> {
        let (x, half, [from, to]) = (self.lowest, T::of(0.5), self.range);
        let mut left = (x - half_width).max(from + half_width);
        let mut right = (x + half_width).min(to - half_width);
        for _ in 0..MOST_HALVES {
            let middle = half * left + half * right;
            if !(left < middle && middle < right) {
                break;
            }
            let rises = self.height(middle + half_width) > self.height(middle - half_width);
            *(if rises { &mut right } else { &mut left }) = middle;
        }
        let centre = half * left + half * right;
        Interval { left: centre - half_width, right: centre + half_width }
    }

    fn find_lowest(&self, nodes: &[GapNode<T>]) -> T {
        // Heights far off may be so large that all of the others are nothing beside their rounding.
        let rounding = |one: T, other: T| T::of(8.0) * T::epsilon() * (one.abs() + other.abs());
        let mut lowest: Option<(T, [T; 2])> = None;
        let mut consider = |x: T, height: T| match &mut lowest {
            // Next to the last that was as low.
            Some((least, on)) if (height - *least).abs() <= rounding(height, *least) => {
                on[1] = x;
            }
            Some((least, _)) if height > *least => {}
            lowest => *lowest = Some((height, [x, x])),
        };
        for (i, from) in nodes.iter().enumerate() {
            consider(from.x, from.height);
            let Some(to) = nodes.get(i + 1) else { break };
            let segment = Segment::new(*from, *to);
            if let Some(t) = segment.minimum() {
                consider(from.x + t * segment.width, segment.at(t)[0]);
            }
        }
        let [from, to] = lowest.map_or(self.range, |(_, on)| on);
        let middle = T::of(0.5) * from + T::of(0.5) * to;
        // As low at two places apart: the first of them.
        let [least, height] = [self.height(from), self.height(middle)];
        if height <= least + rounding(height, least) { middle } else { from }
    }

    /// Tells whether the slopes rise from sample to sample, and the chord between two is no less steep than the one
    /// and no steeper than the other: the slopes of a wave as long as the samples are apart rise as those of no wave,
    /// its heights do not.
    fn find_bulging(nodes: &[GapNode<T>]) -> bool {
        let mut before: Option<(T, T)> = None;
        for (slope, doubt) in
            nodes.iter().flat_map(|node| [0, 1].map(|i| (node.slopes[i], node.doubt)))
        {
            let rises = |(last, other): (T, T)| slope >= last - doubt - other;
            if !before.is_none_or(rises) {
                return false;
            }
            before = Some(match before {
                Some((last, other)) if last > slope => (last, other),
                _ => (slope, doubt),
            });
        }
        nodes.windows(2).all(|pair| {
            let [from, to] = [&pair[0], &pair[1]];
            let (rise, width) = (to.height - from.height, to.x - from.x);
            let doubt = from.doubt + to.doubt;
            rise >= (from.slopes[1] - doubt) * width && rise <= (to.slopes[0] + doubt) * width
        })
    }

    /// The gap where either body was sampled, in the range of both and with its ends.
    fn find_knots(&self, nodes: &mut Vec<GapNode<T>>) {
        nodes.clear();
        // As many as there may be for these bodies, wherever they are moved.
        nodes.reserve((self.bodies[0].len() + self.bodies[1].len()).max(2 * OF_A_BODY) + 2);
        let [first, last] = self.range;
        let mut add = |x: T| {
            if nodes.last().is_some_and(|node| x <= node.x) {
                return;
            }
            let [lower, upper] =
                self.bodies.each_ref().map(|rows| [false, true].map(|right| at(rows, x, right)));
            let slopes = [0, 1].map(|side| upper[side][1] - lower[side][1]);
            let doubt = [lower, upper].iter().flatten().fold(T::zero(), |sum, at| sum + at[2]);
            let (height, missed) = (upper[1][0] - lower[1][0], T::zero());
            nodes.push(GapNode { x, height, slopes, doubt, missed });
        };
        add(first);
        let [mut lower, mut upper] = self.bodies.each_ref().map(|rows| {
            rows.iter().map(|row| row.x).filter(move |&x| x > first && x < last).peekable()
        });
        loop {
            let next = match (lower.peek(), upper.peek()) {
                (Some(&one), Some(&other)) if other < one => upper.next(),
                (Some(_), _) => lower.next(),
                (None, _) => upper.next(),
            };
            match next {
                Some(x) => add(x),
                None => break,
            }
        }
        add(last);
        for i in 1..nodes.len().saturating_sub(1) {
            let [before, here, after] = [nodes[i - 1], nodes[i], nodes[i + 1]];
            let over = Segment::new(before, after);
            let missed = (over.at((here.x - before.x) / over.width)[0] - here.height).abs();
            // At a breakpoint, where there are two samples, the slope may leap.
            let is_breakpoint = |rows: &Vec<BodyRow<T>>| {
                let i = rows.partition_point(|row| row.x < here.x);
                rows.get(i + 1).is_some_and(|next| next.x <= here.x)
            };
            if missed.is_finite() && !self.bodies.iter().any(is_breakpoint) {
                nodes[i].missed = missed;
            }
        }
    }
}

/// The samples of a body, by rising x.
struct Samples<'s, T> {
    rows: &'s mut Vec<BodyRow<T>>,
    range: [T; 2],
    scratch: &'s mut Scratch<T>,
}

impl<T: Real> Samples<'_, T> {
    fn look_at(
        &mut self,
        surface: &Surface<'_, T>,
        cost: &mut Cost,
    ) -> Result<(), ProfileError<T>> {
        let (count, range) = (surface.len(), self.range);
        if surface.joined.is_none() {
            return self.add(&surface.piece(0), OF_A_BODY, cost);
        }
        let first = surface.index_at(range[0], crate::Side::Left);
        let last = surface.index_at(range[1], crate::Side::Right);
        let stride = 1 + (last.max(first) - first) / MOST_PIECES;
        let count_here = last.max(first) - first + 1;
        // Of a body in a few pieces as many as of a smooth one.
        let each =
            if count_here < MANY_PIECES { (OF_A_BODY / count_here).max(OF_A_PIECE) } else { 2 };
        let mut before: Option<T> = None;
        for index in (first..=last).step_by(stride) {
            let piece = surface.piece(index);
            let [from, to] = piece.x();
            // As where it is sampled.
            let allowed = T::of(0.5) * (to - from).max(from.abs()).max(to.abs());
            let apart =
                |end: T| if stride == 1 { (from - end).abs() >= allowed } else { from < end };
            if from >= to || before.is_some_and(apart) {
                return Err(ProfileError::Pieces { count, index });
            }
            before = Some(to);
            self.add(&piece, each, cost)?;
        }
        Ok(())
    }

    /// Looks at a piece, at so many parameters.
    fn add(
        &mut self,
        piece: &Piece<'_, T>,
        count: usize,
        cost: &mut Cost,
    ) -> Result<(), ProfileError<T>> {
        let [from, to] = piece.x();
        // As many as there may be, so that bodies that move allocate nothing.
        self.rows.reserve(OF_A_BODY + 2);
        let Scratch { k, points, right } = &mut *self.scratch;
        k.reserve((OF_A_BODY + 2).saturating_sub(k.len()));
        points.reserve((OF_A_BODY + 2).saturating_sub(points.len()));
        right.reserve((4 * MOST_ZOOMS).saturating_sub(right.len()));
        self.scratch.k.clear();
        self.scratch.k.push(piece.k[0]);
        self.scratch.points.clear();
        self.scratch.points.push(piece.ends[0]);
        // Of a body without ends, such as a flat, all samples but one would lie far away.
        let endless = T::max_value().is_some_and(|most| to - from > T::of(0.125) * most);
        let mut inside = if endless { 0 } else { count - 2 };
        let long = count == OF_A_BODY
            && !endless
            && to - from > T::of(4.0) * (self.range[1] - self.range[0]);
        self.scratch.right.clear();
        if long {
            for _ in 0..MOST_ZOOMS {
                inside -= 4;
                cost.heights = cost.heights.saturating_add(4);
                if !self.zoom(piece) {
                    break;
                }
            }
        }
        let start = self.scratch.k.len() - 1;
        let first = self.scratch.k[start];
        let span = self.scratch.right.last().map_or(piece.k[1], |&(k, _)| k) - first;
        self.scratch
            .k
            .extend((1..=inside).map(|i| first + span * (T::count(i) / T::count(inside + 1))));
        self.scratch.points.resize(self.scratch.k.len(), piece.ends[0]);
        piece.curve.at_many(&self.scratch.k[start + 1..], &mut self.scratch.points[start + 1..]);
        cost.heights = cost.heights.saturating_add(inside);
        while let Some((k, point)) = self.scratch.right.pop() {
            self.scratch.k.push(k);
            self.scratch.points.push(point);
        }
        self.scratch.k.push(piece.k[1]);
        self.scratch.points.push(piece.ends[1]);
        self.keep(piece)
    }

    /// Looks at four places between the last on the left and the last on the right, and moves on to
    /// those closest around the range; whether that has brought them closer together by half.
    fn zoom(&mut self, piece: &Piece<'_, T>) -> bool {
        let first = self.scratch.k[self.scratch.k.len() - 1];
        let span = self.scratch.right.last().map_or(piece.k[1], |&(k, _)| k) - first;
        let (mut on_left, mut on_right) = (0, 5);
        let k = [1, 2, 3, 4].map(|i| first + span * (T::count(i) / T::of(5.0)));
        let mut points = [piece.ends[0]; 4];
        piece.curve.at_many(&k, &mut points);
        for (i, point) in (1..).zip(&points) {
            if point.x <= self.range[0] {
                on_left = i;
            } else if point.x >= self.range[1] {
                on_right = on_right.min(i);
            }
        }
        let probes = [0, 1, 2, 3].map(|i| (k[i], points[i]));
        for (k, point) in &probes[..on_left] {
            self.scratch.k.push(*k);
            self.scratch.points.push(*point);
        }
        self.scratch.right.extend(probes[on_left.max(on_right - 1)..].iter().rev());
        on_right.saturating_sub(on_left) <= 2
    }

    /// Keeps what is seen of a piece.
    fn keep(&mut self, piece: &Piece<'_, T>) -> Result<(), ProfileError<T>> {
        let [from, to] = piece.x();
        let rounding = T::of(8.0) * T::epsilon() * from.abs().max(to.abs());
        let mut reached = from;
        for (i, &CurvePoint { x, y, dx, dy }) in self.scratch.points.iter().enumerate() {
            let next =
                || self.scratch.points[i..].iter().map(|point| point.x).find(|x| x.is_finite());
            let fault =
                |quantity, value| ProfileError::NotFinite { quantity, k: self.scratch.k[i], value };
            if !x.is_finite() {
                if reached < self.range[1] && next().is_none_or(|next| next > self.range[0]) {
                    return Err(fault("X", x));
                }
                continue;
            }
            if x < reached - rounding || x > to + rounding {
                // X turns where X' changes its sign, which may be far from where it first runs the wrong way.
                let turns = |&j: &usize| {
                    self.scratch.points[j].dx * self.scratch.points[j + 1].dx < T::zero()
                };
                let j = (0..self.scratch.k.len() - 1).find(turns).unwrap_or(i.saturating_sub(1));
                let [k, next] = [self.scratch.k[j], self.scratch.k[j + 1]];
                return Err(first_turn(piece.curve, piece.k, [k, next]));
            }
            if !y.is_finite() {
                if x > self.range[0] && x < self.range[1] {
                    return Err(fault("Y", y));
                }
                continue;
            }
            // X may stand still for its rounding, where a body is all but upright.
            if i == 0 || x > reached {
                self.rows.push(BodyRow { x, y, slope: dy / dx });
                reached = x;
            }
        }
        self.check_slopes(piece)
    }

    /// Whether the slopes that a curve gives by x, if it does, are those of its points. (At its ends they may be
    /// infinite.)
    fn check_slopes(&self, piece: &Piece<'_, T>) -> Result<(), ProfileError<T>> {
        let Scratch { k, points, .. } = &*self.scratch;
        let slope = |i: usize| points[i].dy / points[i].dx;
        for (i, at) in points.iter().enumerate().take(points.len() - 1).skip(1) {
            let Some(given) = piece.curve.slope_at(at.x) else { return Ok(()) };
            let difference = slope(i);
            let changes = (slope(i + 1) - slope(i - 1)).abs();
            let allowed =
                T::epsilon().cbrt() * (given.abs() + difference.abs()) + T::of(1e-3) * changes;
            if (given - difference).abs() > allowed {
                let quantity = "slope_at(x)";
                return Err(ProfileError::Derivative { quantity, k: k[i], given, difference });
            }
        }
        Ok(())
    }
}

/// Height and slope of a body at x, and how far off the slope may be by rounding; at a breakpoint those on its
/// right or on its left.
fn at<T: Real>(rows: &[BodyRow<T>], x: T, right: bool) -> [T; 3] {
    let (zero, Some(last)) = (T::zero(), rows.len().checked_sub(1)) else {
        return [T::zero(); 3];
    };
    // The first row beyond x, and with it the segment.
    let index = rows.partition_point(|row| if right { row.x <= x } else { row.x < x });
    let index = index.clamp(1, last.max(1));
    let [Some(from), Some(to)] = [index - 1, index].map(|i| rows.get(i)) else {
        return [rows[0].y, zero, zero];
    };
    let node = |row: &BodyRow<T>| GapNode {
        x: row.x,
        height: row.y,
        slopes: [row.slope; 2],
        doubt: zero,
        missed: zero,
    };
    let segment = Segment::new(node(from), node(to));
    if segment.width <= zero {
        return [from.y, zero, zero];
    }
    let t = (x - from.x) / segment.width;
    let [height, slope] = segment.at(t.max(zero).min(T::one()));
    let own = [from, to].into_iter().find(|row| row.x == x && row.slope.is_finite());
    let slope = own.map_or(slope, |row| row.slope);
    let beyond = x - x.min(to.x).max(from.x);
    let size = (from.y.abs() + to.y.abs()) / segment.width + segment.chord.abs() + slope.abs();
    let doubt = T::of(32.0) * T::epsilon() * size;
    [if beyond.is_zero() { height } else { height + beyond * slope }, slope, doubt]
}

/// A cubic between two nodes, by the share t of the way.
struct Segment<T> {
    width: T,
    height: T,
    chord: T,
    /// By how much the chord is steeper than the curve at its start, and the curve at its end than the
    /// chord.
    bends: [T; 2],
}

impl<T: Real> Segment<T> {
    fn new(from: GapNode<T>, to: GapNode<T>) -> Self {
        let width = to.x - from.x;
        let chord = (to.height - from.height) / width;
        let [first, second] = [chord - from.slopes[1], to.slopes[0] - chord];
        // Beyond twice the other one the cubic would leave the triangle of the tangents, and an end that
        // is all but upright, or a kink, would make it swing.
        let within = |bend: T, other: T| {
            let most = T::of(2.0) * other.abs();
            // Not a number where the slope is not known: as on a parabola.
            if bend.partial_cmp(&bend).is_some() { bend.max(-most).min(most) } else { other }
        };
        let bends = [within(first, second), within(second, first)];
        let usable = |bend: T| if bend.is_finite() { bend } else { T::zero() };
        Self { width, height: from.height, chord, bends: bends.map(usable) }
    }

    /// Height and slope.
    fn at(&self, t: T) -> [T; 2] {
        let ([first, second], two) = (self.bends, T::of(2.0));
        let u = T::one() - t;
        // The chord, less a bulge that has the right slopes at both ends.
        let bulge = t * u * (first * u + second * t);
        let slope = first * u * (u - two * t) + second * t * (two * u - t);
        [self.height + self.width * (t * self.chord - bulge), self.chord - slope]
    }

    /// Where between its ends it is lowest, if it is.
    fn minimum(&self) -> Option<T> {
        let ([first, second], two, three) = (self.bends, T::of(2.0), T::of(3.0));
        // The slope is a + b t + c t².
        let a = self.chord - first;
        let b = two * (two * first - second);
        let c = three * (second - first);
        let root = (b * b - T::of(4.0) * a * c).sqrt();
        // Of the two zeros that where the slope rises.
        let t = if b > T::zero() { -two * a / (b + root) } else { (root - b) / (two * c) };
        (t > T::zero() && t < T::one()).then_some(t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::Shape;
    use crate::profile::{Ellipse, Parabola, Spline, rounded_punch, wedge};
    use crate::search::Newton;
    use crate::{Curve, Flat, ParametricProfile};
    use std::f64::consts::{FRAC_PI_2, PI};

    const NEWTON: Newton = Newton { tolerance: crate::search::StoppingCriteria::FULL };

    fn look<T: Real>(
        lower: &dyn ParametricProfile<T>,
        upper: &dyn ParametricProfile<T>,
    ) -> Result<(CoarseHeights<T>, Cost), ContactError<T>> {
        let mut cost = Cost::default();
        let mut look = CoarseHeights::new();
        look.take(&Gap::new(Shape::Lent(lower), Shape::Lent(upper), &NEWTON)?, &mut cost)?;
        Ok((look, cost))
    }

    fn graph(y: impl Fn(f64) -> [f64; 2] + Send + Sync) -> impl ParametricProfile<f64> {
        // The parameter is far from x.
        Curve::new([-0.9, 0.8], move |k: f64| {
            let (x, dx) = (k + 0.4 * k * k, 1.0 + 0.8 * k);
            let [y, slope] = y(x);
            CurvePoint { x, y, dx, dy: slope * dx }
        })
    }

    #[test]
    fn heights_slopes_and_the_lowest_gap() {
        let body = graph(|x| [(x - 0.1234).cosh(), (x - 0.1234).sinh()]);
        let (look, cost) = look(&Flat, &body).unwrap();
        assert_eq!(cost, Cost { heights: 62, ..Cost::default() });
        for i in 0..=100 {
            let x = -0.576 + 0.016 * f64::from(i);
            let shift = x - 0.1234;
            assert!((look.height(x) - shift.cosh()).abs() < 1e-7, "{x}");
            assert!((look.slope(x) - shift.sinh()).abs() < 2e-5, "{x}");
        }
        assert!((look.lowest() - 0.1234).abs() < 1e-5 && look.bulges());
        let all: Vec<_> = look.heights.iter().map(|&[x, _]| x).collect();
        assert!(all.len() == 64 && all.windows(2).all(|pair| pair[0] < pair[1]));
    }

    #[test]
    fn what_bulges_and_what_does_not() {
        let parabola = Parabola::new(1.0, [-1.0, 1.0]).unwrap();
        let round = Ellipse::circle(1.0, [-FRAC_PI_2, FRAC_PI_2]).unwrap();
        let v = wedge([-0.1, 0.2], 1.0).unwrap();
        let punch = rounded_punch(0.3, 0.5, 1.0).unwrap();
        let peak = wedge([0.1, -0.2], 1.0).unwrap();
        let groove = graph(|x| [x * x, 2.0 * x]);
        let wavy =
            graph(|x| [x * x / 2.0 + 6e-4 * (60.0 * x).cos(), x - 3.6e-2 * (60.0 * x).sin()]);
        let points: Vec<_> =
            (-200..=200).map(|i| 0.005 * f64::from(i)).map(|x| [x, x * x / 3.0 + 5.0]).collect();
        let spline = Spline::through(&points).unwrap();
        type Body<'a> = &'a dyn ParametricProfile<f64>;
        let cases: [(Body, Body, bool, f64); 9] = [
            (&Flat, &parabola, true, 0.0),
            (&Flat, &round, true, 0.0),
            (&Flat, &v, true, 0.0),
            (&Flat, &punch, true, 0.0),
            (&Flat, &spline, true, 0.0),
            (&Flat, &Flat, true, 0.0),
            (&Flat, &peak, false, 1.0),
            (&groove, &parabola, false, 1.0),
            (&Flat, &wavy, false, 0.033),
        ];
        for (i, (lower, upper, bulges, lowest)) in cases.into_iter().enumerate() {
            let (look, _) = look(lower, upper).unwrap();
            assert_eq!(look.bulges(), bulges, "case {i}");
            let found = look.lowest();
            // The wave has two that are as low.
            assert!((found.abs() - lowest).abs() < 2e-3, "case {i}: {found}");
        }
        // Of a spline the ends of the pieces are known.
        assert_eq!(look(&Flat, &spline).unwrap().1.heights, 0);
        assert_eq!(look(&Flat, &punch).unwrap().1.heights, 57);
    }

    #[test]
    fn steep_ends_and_kinks_do_not_swing() {
        type Body = (&'static str, Box<dyn ParametricProfile<f64>>, fn(f64) -> f64);
        let bodies: [Body; 3] = [
            ("circle", Box::new(Ellipse::circle(1.0, [-1e-8 - 1.57, 1e-8 + 1.57]).unwrap()), |x| {
                1.0 - (1.0 - x * x).sqrt()
            }),
            (
                "root",
                Box::new(Curve::new([0.0, 1.0], |k: f64| CurvePoint {
                    x: k * k,
                    y: k,
                    dx: 2.0 * k,
                    dy: 1.0,
                })),
                f64::sqrt,
            ),
            (
                "kink",
                Box::new(Curve::new([-1.0, 1.0], |k: f64| CurvePoint {
                    x: k,
                    y: (k - 0.1).max(0.0) * 50.0,
                    dx: 1.0,
                    dy: if k > 0.1 { 50.0 } else { 0.0 },
                })),
                |x| (x - 0.1).max(0.0) * 50.0,
            ),
        ];
        for (name, body, exact) in &bodies {
            let (look, _) = look(&Flat, &**body).unwrap();
            let all: Vec<_> = look.heights.iter().map(|&[x, _]| x).collect();
            for pair in all.windows(2) {
                let [low, high] = [exact(pair[0]), exact(pair[1])];
                for share in [0.1, 0.3, 0.5, 0.7, 0.9] {
                    let height = look.height(pair[0] + share * (pair[1] - pair[0]));
                    let [low, high] = [low.min(high), low.max(high)];
                    assert!(height >= low - 0.5 * (high - low) - 5e-4, "{name} {pair:?} {height}");
                    assert!(height <= high + 0.5 * (high - low) + 5e-4, "{name} {pair:?} {height}");
                }
            }
        }
    }

    /// Between two points of a rough spline, which turns there, the gap is nowhere lower than its low point above a line
    /// through both.
    #[test]
    fn no_piece_of_a_rough_spline_dips_below_its_low_point() {
        let mut state = 1u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let points: Vec<_> = (0..200).map(|i| [f64::from(i), random()]).collect();
        let spline = Spline::through(&points).unwrap();
        let (look, cost) = look(&Flat, &spline).unwrap();
        assert_eq!(cost.heights, 0);
        let (mut dips, mut below) = (0, 0);
        for pair in points.windows(2) {
            let [[from, first], [to, last]] = [pair[0], pair[1]];
            let above =
                |x: f64, height: f64| height - first - (last - first) * (x - from) / (to - from);
            let deepest = (1..100)
                .map(|i| from + (to - from) * f64::from(i) / 100.0)
                .map(|x| above(x, spline.y(x)))
                .fold(0.0, f64::min);
            let low = look.low_points().find(|low| low.between == Some([from, to]));
            let low = low.map_or(0.0, |low| above(low.x, low.height));
            dips += usize::from(deepest < -0.01);
            below += usize::from(deepest < low - 1e-12);
        }
        println!("{dips} {below}");
        assert!(dips > 50 && below == 0, "{below} of {dips}");
    }

    #[test]
    fn a_long_body_is_sampled_where_the_other_one_is() {
        for reach in [3.0f64, 100.0, 1000.0] {
            let long = Curve::new([-reach, 2.0 * reach], |k: f64| CurvePoint {
                x: k,
                y: 1e-2 * (20.0 * k).cos(),
                dx: 1.0,
                dy: -0.2 * (20.0 * k).sin(),
            });
            let short = Parabola::new(1.0, [-0.5, 0.5]).unwrap();
            for centre in [0.0, 2.5] {
                let placement = crate::profile::Placement::default().shifted(centre, 0.0);
                let short = crate::profile::Placed::new(short, placement).unwrap();
                let (look, cost) = look(&long, &short).unwrap();
                assert!(cost.heights <= 124, "{cost:?}");
                for i in 0..=20 {
                    let x = centre - 0.5 + 0.05 * f64::from(i);
                    let height = (x - centre).powi(2) / 2.0 - 1e-2 * (20.0 * x).cos();
                    assert!((look.height(x) - height).abs() < 1e-3, "{reach} {centre} {x}");
                }
                assert!(!look.bulges());
            }
        }
    }

    #[test]
    fn faults_of_curves() {
        let fault = |body: &dyn ParametricProfile<f64>| match look(&Flat, body) {
            Err(ContactError::Profile { body: Body::Upper, source }) => source,
            other => panic!("{other:?}"),
        };
        let closed = Curve::new([0.0, 6.0], |k: f64| CurvePoint {
            x: -k.cos(),
            y: -k.sin(),
            dx: k.sin(),
            dy: -k.cos(),
        });
        assert!(
            matches!(fault(&closed), ProfileError::TurnsBack { k, .. } if (k - PI).abs() < 1e-9)
        );
        let hole = |from: f64, to: f64| {
            Curve::new([-1.0, 1.0], move |k: f64| {
                let y = if k > from && k < to { f64::NAN } else { k * k };
                CurvePoint { x: k, y, dx: 1.0, dy: 2.0 * k }
            })
        };
        assert!(
            matches!(fault(&hole(0.2, 0.3)), ProfileError::NotFinite { quantity: "Y", k, .. } if k > 0.2 && k < 0.3)
        );
        let lost = Curve::new([-1.0, 1.0], |k: f64| CurvePoint {
            x: if k.abs() < 0.1 { f64::NAN } else { k },
            y: 0.0,
            dx: 1.0,
            dy: 0.0,
        });
        assert!(matches!(fault(&lost), ProfileError::NotFinite { quantity: "X", .. }));
        // Outside of the other body, and where X stands still, it does not matter.
        let short = Parabola::new(1.0, [-0.1, 0.1]).unwrap();
        assert!(look(&short, &hole(0.2, 0.3)).is_ok());
        let saturated = Curve::new([-1.0, 1.0], |k: f64| {
            let x = (20.0 * k).tanh();
            let dx = 20.0 - 20.0 * x * x;
            CurvePoint { x, y: x * x, dx, dy: 2.0 * x * dx }
        });
        assert!(look(&Flat, &saturated).unwrap().0.lowest().abs() < 1e-6);
        let infinite_at_its_end = crate::profile::Crowning::new(1.0, 1.0, [-0.9, 0.9])
            .map(|body| look(&Flat, &body).is_ok());
        assert!(infinite_at_its_end.is_ok_and(|fine| fine));
    }

    #[test]
    fn single_precision() {
        let parabola = Parabola::new(2.0f32, [-1.0, 1.0]).unwrap();
        let (look, _) = look(&Flat, &parabola).unwrap();
        assert!(look.bulges() && look.lowest().abs() < 1e-4);
    }
}
