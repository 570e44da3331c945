//! Heights of the gap, each as accurate as a load requires: branch and bound over both bodies.
//!
//! Each body is a row of [panels](panel) in its own parameter, where it is smooth, and no
//! `X(k) = x` is solved for it. Each panel has an uncertainty of its heights. The bodies may touch
//! under a load F where the lowest height that a panel allows exceeds the lowest known one by less
//! than
//!
//! ```text
//! (F/κ) (1 + ln(2 W/L))        W the width of the bodies, L the expected half-width
//! ```
//!
//! There panels are refined until their uncertainty is at most a share of F/κ; all others are left
//! as they are. A panel far longer than the requested span gets a window cut out, a smooth one gets
//! three times as many points, others are halved, and [runs of pieces](pieces) are divided. A
//! heavier load continues from the panels of a lighter one, and a tilt adds a straight line.
//!
//! A gap whose slope rises from point to point by far more than its uncertainty, and at joints, is
//! [convex](convex): where it is convex as far as a load reaches, the bodies touch in one interval.

mod body;
mod check;
mod convex;
mod lows;
mod panel;
mod pieces;
mod probe;
mod segment;
mod series;
#[cfg(test)]
mod tests;

use super::{Cost, Gap};
use crate::numerics::ascending;
use crate::{Body as Which, ContactError, Fallible, InputError, Interval, ProfileError, Real};
use body::Body;
use convex::{Stretch, convex_stretches};
pub(crate) use lows::{LowPoint, crossing};
use panel::Panel;
pub(crate) use probe::MAX_NEAR_UNCERTAINTY;
use series::BodyPoint;
pub(super) use series::Series;

/// Largest number of rounds of halving, and of evaluations, for one load.
const MAX_ROUNDS: usize = 40;
const MAX_HEIGHTS: usize = 1 << 14;

/// Heights and slopes of two bodies.
#[derive(Clone, Debug)]
pub(crate) struct Survey<T> {
    bodies: [Body<T>; 2],
    /// Range of x that both bodies cover.
    range: [T; 2],
    /// Gap at all points of either body and at places of its bend, by rising x: of bodies that are
    /// bent, but not turned.
    nodes: Vec<Node<T>>,
    /// Number of the bend, if the bodies are bent.
    bend: Option<u64>,
    /// Nodes before panels were refined last.
    before: Vec<Node<T>>,
    /// Buffer for the rates at which slopes rise between two points.
    rates: Vec<T>,
    /// Place of the lowest gap; its middle where it is a span.
    pub lowest: T,
    /// Load, as F/κ, and the approximate half-width that it reaches around the lowest place.
    reach: Option<[T; 2]>,
    /// Stretch where the gap was last seen to be convex.
    stretch: Option<Stretch<T>>,
    /// True if the bodies seem to touch in one interval under the load of the last refinement.
    is_one: bool,
    /// Number of evaluations since the first look began.
    spent: usize,
    /// Quantity, share of F/κ and tilt of the last refinement.
    known: Option<(Asked<T>, T, T)>,
    /// Spans outside contacts that have been sampled more closely.
    seen: Vec<probe::Stretch<T>>,
    /// Heaviest load that these spans serve, as F/κ, and the tilt.
    pub resolved: Option<[T; 2]>,
    /// Buffers for spans to be refined of either body, and for spans that a load requires.
    marked: [Vec<[T; 2]>; 2],
    stretches: Vec<probe::Stretch<T>>,
}

/// Quantity prescribed for a contact, forces over κ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Asked<T> {
    Load(T),
    /// Load under which the bodies turn.
    Turning(T),
    HalfWidth(T),
    Peak(T),
}

/// Gap at an abscissa, with its slope on the left and on the right.
#[derive(Clone, Copy, Debug)]
struct Node<T> {
    x: T,
    height: T,
    /// Largest |Y| of both bodies.
    size: T,
    slopes: [T; 2],
    /// Uncertainties of the slopes of either body beyond rounding.
    doubts: [T; 2],
    /// Uncertainty of the heights up to the next node, the width of the narrowest panel around
    /// them, and a flag: a piece in between is known only by its ends.
    after: T,
    panel: T,
    is_open: bool,
    /// True if points of the curve before the next node are missed.
    is_void: bool,
}

impl<T: Real> Node<T> {
    /// Returns the uncertainty of the slopes beyond rounding.
    fn doubt(&self) -> T {
        self.doubts[0] + self.doubts[1]
    }

    /// Returns the rounding error of the slopes on its right and on the left of the next node: that
    /// of heights over the width of their panel, however near to each other the nodes are. (Between
    /// pieces that meet within rounding the slope jumps.)
    fn rounding(&self, next: &Self) -> T {
        self.rounding_over(next, self.panel)
    }

    /// Returns the rounding error of the chord up to the next node, and of the slopes there.
    fn chord_rounding(&self, next: &Self) -> T {
        self.rounding_over(next, self.panel.min(next.x - self.x))
    }

    fn rounding_over(&self, next: &Self, width: T) -> T {
        let slopes = self.slopes[1].abs() + next.slopes[0].abs();
        T::of(64.0) * T::epsilon() * (slopes + (self.size + next.size) / width)
    }
}

impl<T: Real> Survey<T> {
    /// Creates an empty survey.
    pub fn new() -> Self {
        let zero = T::zero();
        Self {
            bodies: [Body::new(), Body::new()],
            range: [zero; 2],
            nodes: Vec::new(),
            bend: None,
            before: Vec::new(),
            rates: Vec::new(),
            lowest: zero,
            reach: None,
            stretch: None,
            is_one: false,
            spent: 0,
            known: None,
            seen: Vec::new(),
            resolved: None,
            marked: [Vec::new(), Vec::new()],
            stretches: Vec::new(),
        }
    }

    /// Takes a first look at both bodies.
    ///
    /// # Errors
    /// [`InputError::Profile`] with [`ProfileError::NotFinite`] inside the common range,
    /// [`ProfileError::TurnsBack`], [`ProfileError::Pieces`] or [`ProfileError::Derivative`].
    pub fn take(&mut self, gap: &Gap<'_, T>, cost: &mut Cost) -> Result<(), ContactError<T>> {
        let is_again = !self.nodes.is_empty();
        self.range = gap.range();
        (self.known, self.is_one) = (None, false);
        self.seen.clear();
        self.resolved = None;
        let before = cost.heights;
        for which in [Which::Lower, Which::Upper] {
            let (surface, body) = (&gap.bodies[which as usize], &mut self.bodies[which as usize]);
            let found = body.look(surface, self.range, &mut cost.heights);
            let found = found.and_then(|()| match body.points.len() {
                0 => {
                    let (k, value) = (surface.piece(0).k[0], T::of(f64::NAN));
                    Err(ProfileError::NotFinite { quantity: "Y", k, value })
                }
                _ => Ok(()),
            });
            found.map_err(|source| InputError::Profile { body: which, source })?;
        }
        self.spent = cost.heights - before;
        self.bend = gap.added().bend;
        self.join(gap);
        // Bodies that move allocate nothing.
        if is_again {
            for spans in &mut self.marked {
                spans.clear();
                spans.reserve(self.nodes.capacity());
            }
            self.seen.reserve(self.nodes.capacity());
            self.stretches.clear();
            self.stretches.reserve(self.nodes.capacity());
        }
        Ok(())
    }

    /// Tells whether the bodies are bent as the gap is.
    pub fn is_bent_as(&self, gap: &Gap<'_, T>) -> bool {
        self.bend == gap.added().bend
    }

    /// Bends the bodies, which costs no evaluation.
    pub fn bend(&mut self, gap: &Gap<'_, T>) {
        self.bend = gap.added().bend;
        (self.known, self.is_one, self.resolved) = (None, false, None);
        self.bodies[0].fresh.push(self.range);
        self.join(gap);
    }

    /// Refines both bodies until the uncertainty at all places that the load may touch is at most a
    /// share of F/κ.
    ///
    /// # Errors
    /// As [`take`](Self::take).
    pub fn refine(
        &mut self,
        gap: &Gap<'_, T>,
        asked: Asked<T>,
        share: T,
        cost: &mut Cost,
    ) -> Result<(), ContactError<T>> {
        if self.known == Some((asked, share, gap.tilt())) {
            return Ok(());
        }
        let before = cost.heights;
        for _ in 0..MAX_ROUNDS {
            let load = self.load_of(gap, asked);
            let presses = load > T::zero();
            if !presses {
                break;
            }
            self.reach = Some([load, self.reach_of(load)]);
            let on = self.around_lowest(Some(load));
            // Bodies that turn may touch anywhere.
            let touched = match asked {
                Asked::Turning(_) => Interval { left: self.range[0], right: self.range[1] },
                _ => on,
            };
            self.is_one = self.sees_one(gap, touched, load, cost)?;
            if self.is_one {
                break;
            }
            let lowest = self.nodes.iter().map(|node| gap.turned(node.x, node.height));
            let lowest = lowest.fold(T::one() / T::zero(), |least, height| least.min(height));
            let tolerance = share * load;
            let ratio = (self.range[1] - self.range[0]) / on.half_width();
            let level = lowest + load * (T::one() + ratio.max(T::one()).ln());
            let mut wanted = std::mem::take(&mut self.marked);
            self.list_wanted(gap, level, tolerance, &mut wanted[0]);
            let is_dear = cost.heights - before > MAX_HEIGHTS;
            let refined = match wanted[0].is_empty() || is_dear {
                true => Ok(false),
                false => self.refine_at(gap, [&wanted[0]; 2], tolerance, cost),
            };
            self.marked = wanted;
            if !refined? {
                break;
            }
        }
        self.lowest = self.polished(gap, self.lowest);
        self.known = Some((asked, share, gap.tilt()));
        Ok(())
    }

    /// Lists the spans between two nodes where the gap may be below a level and is uncertain.
    fn list_wanted(&self, gap: &Gap<'_, T>, level: T, tolerance: T, wanted: &mut Vec<[T; 2]>) {
        wanted.clear();
        for i in 0..self.nodes.len() {
            let Some(low) = self.low_between(i) else { continue };
            let ends = [&self.nodes[i], &self.nodes[i + 1]];
            let least = ends.map(|node| gap.turned(node.x, node.height));
            let least = least[0].min(least[1]).min(gap.turned(low.x, low.height));
            let is_above = least - low.doubt >= level;
            if (low.doubt > tolerance || self.nodes[i].is_open) && !is_above {
                wanted.push(ends.map(|node| node.x));
            }
        }
    }

    /// Refines the panels of either body that are more uncertain than half a tolerance in any of
    /// its spans; tells whether there were any.
    pub fn refine_at(
        &mut self,
        gap: &Gap<'_, T>,
        wanted: [&[[T; 2]]; 2],
        tolerance: T,
        cost: &mut Cost,
    ) -> Result<bool, ContactError<T>> {
        let changes = self.refine_bodies(gap, wanted, tolerance, cost)?;
        if changes {
            self.join(gap);
        }
        Ok(changes)
    }

    /// Refines both bodies as [`refine_at`](Self::refine_at) does, without joining their points.
    fn refine_bodies(
        &mut self,
        gap: &Gap<'_, T>,
        wanted: [&[[T; 2]]; 2],
        tolerance: T,
        cost: &mut Cost,
    ) -> Fallible<T, bool> {
        let mut changes = false;
        gap.check_watch(*cost, Interval { left: self.range[0], right: self.range[1] })?;
        for which in [Which::Lower, Which::Upper] {
            let (surface, body) = (&gap.bodies[which as usize], &mut self.bodies[which as usize]);
            let is_marked = |panel: &Panel<T>| panel.may_gain(T::of(0.5) * tolerance);
            let (before, spans) = (cost.heights, wanted[which as usize]);
            let found = body.refine(surface, self.range, spans, is_marked, &mut cost.heights);
            self.spent += cost.heights - before;
            changes |= found.map_err(|source| InputError::Profile { body: which, source })?;
        }
        Ok(changes)
    }

    /// Takes the series of a body around both ends of an interval for guides, with the numbers of
    /// their pieces. A closer series reaches further: next to an upright end its four points for a
    /// first estimate promise a contact that needs the whole body, whose capacity takes a thousand.
    pub fn guide(&self, body: Which, on: Interval<T>, guides: &mut Vec<(usize, Series<T>)>) {
        let body = &self.bodies[body as usize];
        guides.clear();
        let [left, right] = [on.left, on.right].map(|x| body.panels_at(x)[1]);
        let ends = std::iter::once(left).chain((right != left).then_some(right));
        guides.extend(ends.filter_map(|i| {
            let panel = &body.panels[i];
            let series = &body.series[panel.series?];
            let serves = !series.is_closer() || series.is_even(on);
            serves.then(|| (panel.piece, series.clone()))
        }));
    }

    /// Lists the gap at all points of either body within their common range, and at the ends of
    /// this range. Nodes where no panel is new are kept.
    fn join(&mut self, gap: &Gap<'_, T>) {
        std::mem::swap(&mut self.nodes, &mut self.before);
        let (nodes, before) = (&mut self.nodes, &self.before);
        for body in &mut self.bodies {
            body.fresh.sort_by(|one, other| ascending(&one[0], &other[0]));
        }
        nodes.clear();
        nodes.reserve(2 + self.bodies.iter().map(|body| body.points.capacity()).sum::<usize>());
        let [first, last] = self.range;
        let (mut next, mut fresh, mut known) = ([0; 2], [0; 2], 0);
        let bends = gap.bend().into_iter().flat_map(|bend| bend.places(self.range));
        let mut bends = bends.peekable();
        let mut x = first;
        loop {
            let mut is_fresh = false;
            let mut own = [&[][..]; 2];
            for (i, body) in self.bodies.iter().enumerate() {
                let start = next[i];
                advance(&mut next[i], &body.points, |row| row.x <= x);
                own[i] = &body.points[start..next[i]];
                advance(&mut fresh[i], &body.fresh, |span| span[1] < x);
                is_fresh |= body.fresh.get(fresh[i]).is_some_and(|span| span[0] <= x);
            }
            advance(&mut known, before, |node| node.x < x);
            let same = before.get(known).filter(|node| !is_fresh && node.x == x);
            nodes.push(match same {
                Some(node) => Node { is_open: false, is_void: false, ..*node },
                None => {
                    node([0, 1].map(|i| at(&self.bodies[i], x, own[i])), x, gap.bend_at([0, 1], x))
                }
            });
            if x >= last {
                break;
            }
            let beyond = [0, 1].map(|i| self.bodies[i].points.get(next[i]).map_or(last, |at| at.x));
            while bends.next_if(|&at| at <= x).is_some() {}
            x = beyond[0].min(beyond[1]).min(bends.peek().map_or(last, |&at| at.min(last)));
        }
        self.measure();
        convex_stretches(&mut self.nodes, &mut self.rates);
        self.lowest = self.find_lowest(gap);
        self.bodies.iter_mut().for_each(|body| body.fresh.clear());
        (self.stretch, self.reach) = (None, None);
    }

    /// Sets the uncertainty of the gap between each node and the next.
    fn measure(&mut self) {
        let (nodes, [first, last], mut panels) = (&mut self.nodes, self.range, [[0; 2]; 2]);
        for i in 1..nodes.len() {
            let [from, to] = [nodes[i - 1].x, nodes[i].x];
            let node = &mut nodes[i - 1];
            (node.after, node.panel) = (T::zero(), last - first);
            for (body, [start, end]) in self.bodies.iter().zip(&mut panels) {
                let inner = &body.panels[..body.panels.len() - 1];
                advance(start, inner, |panel| panel.x()[1] <= from);
                advance(end, inner, |panel| panel.x()[1] < to);
                let mut most = T::zero();
                for panel in &body.panels[*start..=*end.max(start)] {
                    node.is_open |= !panel.is_sampled;
                    node.is_void |= panel.is_void;
                    node.panel = node.panel.min(panel.x()[1] - panel.x()[0]);
                    // A NaN replaces the number before it.
                    most = if most > panel.doubt { most } else { panel.doubt };
                }
                node.after += most;
            }
        }
    }
}

/// Moves an index on past items.
fn advance<I>(index: &mut usize, items: &[I], is_before: impl Fn(&I) -> bool) {
    while items.get(*index).is_some_and(&is_before) {
        *index += 1;
    }
}

/// Makes a node of both bodies at x, on its left and on its right, with the slope and the height
/// that a bend adds.
fn node<T: Real>([lower, upper]: [[BodyPoint<T>; 2]; 2], x: T, bend: [T; 2]) -> Node<T> {
    Node {
        x,
        height: upper[1].y - lower[1].y + bend[1],
        size: upper[1].y.abs().max(lower[1].y.abs()),
        slopes: [0, 1].map(|side| upper[side].slope - lower[side].slope + bend[0]),
        doubts: [lower, upper].map(|[left, right]| left.doubt.max(right.doubt)),
        after: T::zero(),
        panel: T::one() / T::zero(),
        is_open: false,
        is_void: false,
    }
}

/// Returns the hull of the spans, in rising order, that a panel overlaps, limited to the panel.
fn hull_in<T: Real>(spans: &[[T; 2]], panel: &Panel<T>) -> Option<[T; 2]> {
    let [from, to] = panel.x();
    let first = spans.partition_point(|span| span[1] <= from);
    let after = spans.partition_point(|span| span[0] < to);
    (first < after).then(|| [spans[first][0].max(from), spans[after - 1][1].min(to)])
}

/// Returns a body at x, on its left and on its right, given its points up to x.
fn at<T: Real>(body: &Body<T>, x: T, own: &[BodyPoint<T>]) -> [BodyPoint<T>; 2] {
    let mut found = [None; 2];
    for row in own.iter().rev().take_while(|row| row.x == x) {
        found = [Some(*row), found[1].or(Some(*row))];
    }
    if let [Some(left), Some(right)] = found {
        return [left, right];
    }
    body.panels_at(x).map(|panel| body.at(panel, x))
}
