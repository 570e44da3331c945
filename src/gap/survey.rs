//! Heights of the gap, each as exact as a load asks for: branch and bound over both bodies.
//!
//! Each body is a row of [panels](panel) in its own parameter, where it is smooth, and no `X(k) = x` is
//! solved for it. A panel tells how uncertain its heights are. Where the bodies may touch under a load F,
//! that is where the lowest height that a panel leaves open is less than the lowest one known by
//!
//! ```text
//! (F/κ) (1 + ln(2 W/L))        W the width of the bodies, L the half-width to expect
//! ```
//!
//! panels are halved until they are uncertain by no more than a share of F/κ; all others are never looked
//! at again. A heavier load goes on where a lighter one has stopped, and a tilt adds a straight line.
//!
//! A gap whose slope rises from point to point by far more than the slopes are uncertain, and at
//! joints, is convex: the bodies touch in one interval under any load and tilt.

mod body;
mod fine;
mod lows;
mod panel;
mod segment;

use super::{Cost, Gap};
use crate::{Body as Which, ContactError, ProfileError, Real};
pub(crate) use body::Rise;
use body::{Body, Panel};
pub(crate) use lows::LowPoint;
use panel::Row;

/// Halvings after which a panel is as fine as it gets, and evaluations for one load.
const MOST_ROUNDS: usize = 40;
const MOST_HEIGHTS: usize = 1 << 14;

/// Spans on either side of one that must bulge like it.
const IN_A_ROW: usize = 2;

/// Evaluations beyond which no proof that the gap is convex is sought before a load asks for more.
const MOST_FOR_PROOF: usize = 54;

/// The share of the rise of a slope from one point to the next by which both may be uncertain in a proof. A wave
/// that hides in it has a length of about this share of the distance of the points.
const PROOF: f64 = 1e-3;

/// Heights and slopes of two bodies.
#[derive(Clone, Debug)]
pub(crate) struct Survey<T> {
    bodies: [Body<T>; 2],
    /// The range of x that both bodies cover.
    range: [T; 2],
    /// The gap at all points of either body, by rising x.
    nodes: Vec<Node<T>>,
    heights: Vec<[T; 2]>,
    lowest: T,
    convex: bool,
    /// What it was refined for last, to which share of F/κ, and the tilt.
    known: Option<(Asked<T>, T, T)>,
}

/// What a contact is asked to have, forces over κ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Asked<T> {
    Load(T),
    HalfWidth(T),
    Peak(T),
}

/// The gap at an abscissa before it is tilted, with its slope on the left and on the right.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node<T> {
    pub x: T,
    pub height: T,
    /// The largest |Y|.
    size: T,
    pub slopes: [T; 2],
    /// Uncertainty of the slopes beyond rounding.
    pub doubt: T,
    /// Uncertainty of the heights up to the next node, and whether a piece is there of which only the ends are known.
    after: T,
    is_open: bool,
}

impl<T: Real> Node<T> {
    /// Returns what slopes and chords up to another node may be off by rounding.
    fn rounding(&self, next: &Self) -> T {
        let slopes = self.slopes[1].abs() + next.slopes[0].abs();
        let width = next.x - self.x;
        let heights = if width.is_zero() { T::zero() } else { (self.size + next.size) / width };
        T::of(64.0) * T::epsilon() * (slopes + heights)
    }
}

impl<T: Real> Survey<T> {
    /// A survey of nothing yet.
    pub fn new() -> Self {
        let zero = T::zero();
        Self {
            bodies: [Body::new(), Body::new()],
            range: [zero; 2],
            nodes: Vec::new(),
            heights: Vec::new(),
            lowest: zero,
            convex: false,
            known: None,
        }
    }

    /// Takes a first look at both bodies, and proves that the gap is convex where that is soon done.
    ///
    /// # Errors
    /// [`ContactError::Profile`] with [`ProfileError::NotFinite`] inside the common range,
    /// [`ProfileError::TurnsBack`], [`ProfileError::Pieces`] or [`ProfileError::Derivative`].
    pub fn take(&mut self, gap: &Gap<'_, T>, cost: &mut Cost) -> Result<(), ContactError<T>> {
        self.range = gap.range();
        self.known = None;
        let before = cost.heights;
        for which in [Which::Lower, Which::Upper] {
            let (surface, body) = (&gap.bodies[which as usize], &mut self.bodies[which as usize]);
            let found = body.look(surface, self.range, &mut cost.heights);
            let found = found.and_then(|()| match body.rows.len() {
                0 => {
                    let (k, value) = (surface.piece(0).k[0], T::of(f64::NAN));
                    Err(ProfileError::NotFinite { quantity: "Y", k, value })
                }
                _ => Ok(()),
            });
            found.map_err(|source| ContactError::Profile { body: which, source })?;
        }
        self.join();
        self.prove(gap, before, cost)
    }

    /// Refines both bodies until no place that the load may touch is uncertain by more than a share of F/κ.
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
        if self.convex || self.known == Some((asked, share, gap.tilt())) {
            return Ok(());
        }
        let before = cost.heights;
        for _ in 0..MOST_ROUNDS {
            let lowest = self.nodes.iter().map(|node| gap.turned(node.x, node.height));
            let lowest = lowest.fold(T::one() / T::zero(), |least, height| least.min(height));
            let load = self.load_of(asked);
            if !(load > T::zero()) {
                break;
            }
            let tolerance = share * load;
            let narrow = self.around_lowest(Some(load)).half_width();
            let ratio = (self.range[1] - self.range[0]) / narrow;
            let level = lowest + load * (T::one() + ratio.max(T::one()).ln());
            let wanted = self.wanted(gap, level, tolerance);
            if wanted.is_empty() || cost.heights - before > MOST_HEIGHTS {
                break;
            }
            if !self.refine_at(gap, &wanted, Some(tolerance), cost)? {
                break;
            }
        }
        self.known = Some((asked, share, gap.tilt()));
        Ok(())
    }

    /// Returns the spans between two nodes where the gap may be below a level and is uncertain.
    fn wanted(&self, gap: &Gap<'_, T>, level: T, tolerance: T) -> Vec<[T; 2]> {
        let mut wanted = Vec::new();
        for i in 0..self.nodes.len() {
            let Some(low) = self.low_between(i) else { continue };
            let ends = [&self.nodes[i], &self.nodes[i + 1]];
            let least = ends.map(|node| gap.turned(node.x, node.height));
            let least = least[0].min(least[1]).min(gap.turned(low.x, low.height));
            if (low.doubt > tolerance || self.nodes[i].is_open) && !(least - low.doubt >= level) {
                wanted.push(ends.map(|node| node.x));
            }
        }
        wanted
    }

    /// Refines the panels of both bodies that are more uncertain than half a tolerance, or without one all, in any of
    /// some spans; whether there were any.
    pub fn refine_at(
        &mut self,
        gap: &Gap<'_, T>,
        wanted: &[[T; 2]],
        tolerance: Option<T>,
        cost: &mut Cost,
    ) -> Result<bool, ContactError<T>> {
        let mut changes = false;
        for which in [Which::Lower, Which::Upper] {
            let (surface, body) = (&gap.bodies[which as usize], &mut self.bodies[which as usize]);
            let gains = |panel: &Panel<T>| {
                tolerance.is_none_or(|tolerance| panel.may_gain(T::of(0.5) * tolerance))
            };
            let is_marked = |panel: &Panel<T>| is_in(wanted, panel) && gains(panel);
            let found = body.refine(surface, self.range, is_marked, &mut cost.heights);
            changes |= found.map_err(|source| ContactError::Profile { body: which, source })?;
        }
        if changes {
            self.join();
        }
        Ok(changes)
    }

    /// Returns the evaluations that it takes to refine the panels in some spans: all of them, or those that are more
    /// uncertain than a tolerance.
    fn cost_at(&self, gap: &Gap<'_, T>, wanted: &[[T; 2]], tolerance: Option<T>) -> usize {
        let may_gain = |panel: &Panel<T>| tolerance.is_none_or(|most| panel.may_gain(most));
        let is_marked = |panel: &Panel<T>| is_in(wanted, panel) && may_gain(panel);
        let both = self.bodies.iter().zip(&gap.bodies);
        both.map(|(body, surface)| body.cost(surface, is_marked)).sum()
    }

    /// Halves panels as long as more points may prove the gap convex, and none tells that it is not.
    fn prove(
        &mut self,
        gap: &Gap<'_, T>,
        before: usize,
        cost: &mut Cost,
    ) -> Result<(), ContactError<T>> {
        let mut open = Vec::new();
        loop {
            open.clear();
            let may_be_convex = self.may_be_convex(&mut open);
            self.convex = may_be_convex && open.is_empty();
            if self.convex || !may_be_convex {
                return Ok(());
            }
            if cost.heights - before + self.cost_at(gap, &open, None) > MOST_FOR_PROOF {
                return Ok(());
            }
            if !self.refine_at(gap, &open, Some(T::zero()), cost)? {
                return Ok(());
            }
        }
    }

    /// Tells whether no slope falls, as far as is known; `open` takes the spans that are not known well enough.
    fn may_be_convex(&self, open: &mut Vec<[T; 2]>) -> bool {
        for (i, node) in self.nodes.iter().enumerate() {
            if node.slopes[1] < node.slopes[0] - (node.doubt + node.doubt + node.rounding(node)) {
                return false;
            }
            let Some(next) = self.nodes.get(i + 1) else { break };
            let width = next.x - node.x;
            let (rise, doubt) = (next.slopes[0] - node.slopes[1], node.doubt + next.doubt);
            let chord = (next.height - node.height) / width;
            let rounding = node.rounding(next);
            let most = doubt + rounding + T::of(8.0) * node.after / width;
            if rise < -most || chord < node.slopes[1] - most || chord > next.slopes[0] + most {
                return false;
            }
            let is_known = rise >= -rounding && doubt <= T::of(PROOF) * rise.max(T::zero());
            if node.is_open || !is_known {
                open.push([node.x, next.x]);
            }
        }
        true
    }

    /// Lists the gap at all points of either body, in the range of both and with its ends.
    fn join(&mut self) {
        let mut nodes = std::mem::take(&mut self.nodes);
        nodes.clear();
        let [first, last] = self.range;
        let mut next = [0; 2];
        let mut x = first;
        loop {
            let [lower, upper] = [0, 1].map(|i| at(&self.bodies[i], x, &mut next[i]));
            nodes.push(Node {
                x,
                height: upper[1].y - lower[1].y,
                size: upper[1].y.abs().max(lower[1].y.abs()),
                slopes: [0, 1].map(|side| upper[side].slope - lower[side].slope),
                doubt: upper[0].doubt.max(upper[1].doubt) + lower[0].doubt.max(lower[1].doubt),
                after: T::zero(),
                is_open: false,
            });
            if x >= last {
                break;
            }
            let beyond = [0, 1].map(|i| self.bodies[i].rows.get(next[i]).map_or(last, |row| row.x));
            x = beyond[0].min(beyond[1]).min(last);
        }
        for i in 1..nodes.len() {
            let between = [nodes[i - 1].x, nodes[i].x];
            let mut is_open = false;
            let mut doubt = |body: &Body<T>| {
                let [first, last] = between.map(|x| body.panels_at(x));
                let panels = &body.panels[first[1]..=last[0].max(first[1])];
                is_open |= panels.iter().any(|panel| !panel.is_sampled);
                panels.iter().fold(
                    T::zero(),
                    |most, panel| if most > panel.doubt { most } else { panel.doubt },
                )
            };
            let after = self.bodies.iter().fold(T::zero(), |sum, body| sum + doubt(body));
            (nodes[i - 1].after, nodes[i - 1].is_open) = (after, is_open);
        }
        convex_stretches(&mut nodes);
        self.heights.clear();
        self.heights.extend(nodes.iter().map(|node| [node.x, node.height]));
        self.lowest = self.find_lowest(&nodes);
        self.nodes = nodes;
    }
}

/// Lowers the uncertainty of heights where the gap is seen to bulge at several points in a row.
///
/// Slopes that rise at a rate c leave room for waves of a height c d²/2 over a distance d and no more, as the slopes of
/// a higher one would fall somewhere. What a series in the parameter may miss is often far more: far up a steep
/// flank, or where X is no polynomial.
fn convex_stretches<T: Real>(nodes: &mut [Node<T>]) {
    let rate = |from: &Node<T>, to: &Node<T>| {
        let (width, rise) = (to.x - from.x, to.slopes[0] - from.slopes[1]);
        let chord = (to.height - from.height) / width;
        let bulges = chord >= from.slopes[1] && chord <= to.slopes[0] && rise.is_finite();
        if bulges { rise / width } else { T::one() / T::zero() }
    };
    let rates: Vec<T> = nodes.windows(2).map(|pair| rate(&pair[0], &pair[1])).collect();
    for i in 0..rates.len() {
        let around = &rates[i.saturating_sub(IN_A_ROW)..(i + IN_A_ROW + 1).min(rates.len())];
        if around.iter().all(|rate| rate.is_finite()) {
            let width = nodes[i + 1].x - nodes[i].x;
            let least = around.iter().fold(rates[i], |least, &rate| least.min(rate));
            nodes[i].after = nodes[i].after.min(T::of(0.5) * least * width * width);
        }
    }
}

/// Tells whether a panel overlaps one of some spans, in rising order.
fn is_in<T: Real>(spans: &[[T; 2]], panel: &Panel<T>) -> bool {
    overlaps(spans, panel.x())
}

/// Tells whether a stretch of x has a part of some spans, in rising order.
fn overlaps<T: Real>(spans: &[[T; 2]], [from, to]: [T; 2]) -> bool {
    let first = spans.partition_point(|span| span[1] <= from);
    spans.get(first).is_some_and(|span| span[0] < to)
}

/// Returns a body at x, on its left and on its right, and moves `next` to the first point beyond.
fn at<T: Real>(body: &Body<T>, x: T, next: &mut usize) -> [Row<T>; 2] {
    let start = *next;
    while body.rows.get(*next).is_some_and(|row| row.x <= x) {
        *next += 1;
    }
    let own = body.rows[start..*next].iter().rev().take_while(|row| row.x == x);
    let mut found = [None; 2];
    for row in own {
        found = [Some(*row), found[1].or(Some(*row))];
    }
    let [before, after] = body.panels_at(x);
    [found[0].unwrap_or_else(|| body.at(before, x)), found[1].unwrap_or_else(|| body.at(after, x))]
}
