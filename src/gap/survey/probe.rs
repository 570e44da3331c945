//! Features narrower than the distance between the points of a panel.
//!
//! A bump of a full width w at half its height has the share `exp(-2.77 (d/w)²)` of its height at a
//! distance d from its top: 1.5e-5 at d = 2 w. Points no further apart than 4 w see it, if the
//! series between them is as accurate. It may rise over any known height: what is promised within a
//! half-width of a contact is looked for there, however wide the gap is as it is known.

use super::body::{Body, Scratch};
use super::lows::segment;
use super::panel::{Missed, Panel};
use super::{Cost, Node, Survey};
use crate::gap::{Gap, Surface};
use crate::numerics::ascending;
use crate::real::same;
use crate::{ContactError, Fallible, Interval, Real};

/// Default distance of points, in widths of the narrowest feature to be seen.
const PROBE_SPACING: f64 = 4.0;

/// Factor of the load for which features are sought: a load larger by a few per cent needs no more
/// points.
const LOAD_AHEAD: f64 = 1.05;

/// Largest uncertainty of panels for which the foot of a bump is to be seen, as a share of F/κ.
/// With points 4 w apart, 1 of 4 704 bumps and dents is missed; 13 are with 3e-4.
const MAX_AT_FOOT: f64 = 1e-4;

/// Largest uncertainty of panels next to a contact, and largest distance of points from them, as a
/// share of F/κ: crests of this height may hide.
pub(crate) const MAX_NEAR_UNCERTAINTY: f64 = 0.1;

/// Largest distance of a point from a panel that does not count as missed, as a multiple of its
/// uncertainty.
const MAX_MISMATCH: f64 = 8.0;

/// Largest number of searches of stretches, each on the panels that the one before has refined.
const MAX_ROUNDS: usize = 40;

/// Largest number of points for one load by default. Where a load reaches too far for this number,
/// as between steps of narrow flanks, the points are further apart.
const MAX_PROBES: usize = 1 << 10;

/// Largest number of halvings in search of the place where the gap leaves the reach of a load.
const MAX_REACH_HALVES: usize = 60;

/// Span of x outside the contacts between two points of the survey, and the distance of points
/// required there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch<T> {
    x: [T; 2],
    apart: T,
    /// True if a point there is missed.
    is_missed: bool,
}

/// Adds a stretch to those on its left. It continues the last one if it borders on it and is
/// sampled alike.
fn add<T: Real>(stretches: &mut Vec<Stretch<T>>, next: Stretch<T>) {
    match stretches.last_mut() {
        Some(last)
            if last.x[1] == next.x[0]
                && last.apart == next.apart
                && last.is_missed == next.is_missed =>
        {
            last.x[1] = next.x[1];
        }
        _ => stretches.push(next),
    }
}

/// Point to be evaluated: the numbers of its stretch and its panel, its place t and its parameter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Probe<T> {
    stretch: usize,
    panel: usize,
    t: T,
    k: T,
}

impl<T: Real> Stretch<T> {
    /// Tells whether another stretch covers this one with points at least as close.
    fn is_seen_by(&self, other: &Self) -> bool {
        let [from, to] = other.x;
        from <= self.x[0] && to >= self.x[1] && other.apart <= self.apart
    }
}

impl<T: Real> Survey<T> {
    /// Tells whether narrow features were sought under a load that is no lighter: next to its
    /// contacts a lighter load touches nothing.
    pub fn is_resolved(&self, gap: &Gap<'_, T>, load: T) -> bool {
        self.resolved.is_some_and(|[most, tilt]| load <= most && same(tilt, gap.tilt()))
    }

    /// Looks for narrow features that the load F/κ may press on outside the contacts, and refines
    /// panels that miss one.
    ///
    /// # Errors
    /// As [`take`](Self::take).
    pub fn resolve(
        &mut self,
        gap: &Gap<'_, T>,
        load: T,
        contacts: &[Interval<T>],
        cost: &mut Cost,
    ) -> Result<(), ContactError<T>> {
        if self.is_resolved(gap, load) {
            return Ok(());
        }
        let mut stretches = std::mem::take(&mut self.stretches);
        let found = self.resolve_stretches(gap, load, contacts, &mut stretches, cost);
        self.stretches = stretches;
        // A search that was broken off has seen nothing.
        self.resolved = found.is_ok().then(|| [T::of(LOAD_AHEAD) * load, gap.tilt()]);
        found
    }

    fn resolve_stretches(
        &mut self,
        gap: &Gap<'_, T>,
        load: T,
        contacts: &[Interval<T>],
        stretches: &mut Vec<Stretch<T>>,
        cost: &mut Cost,
    ) -> Fallible<T, ()> {
        for _ in 0..MAX_ROUNDS {
            self.list_stretches(gap, T::of(LOAD_AHEAD) * load, contacts, stretches);
            let is_seen =
                |stretch: &_| self.seen.iter().any(|seen| Stretch::is_seen_by(stretch, seen));
            stretches.retain(|stretch| !is_seen(stretch));
            if stretches.is_empty() {
                break;
            }
            self.check_points(gap, stretches, *cost)?;
            if self.refine_stretches(gap, stretches, load, cost)? {
                continue;
            }
            for (body, surface) in self.bodies.iter_mut().zip(&gap.bodies) {
                body.probe(gap, surface, stretches, load, &mut cost.heights);
            }
            for stretch in stretches.iter().filter(|stretch| !stretch.is_missed) {
                self.seen.retain(|seen| !(seen.is_seen_by(stretch) && stretch.apart <= seen.apart));
                add(&mut self.seen, *stretch);
            }
            stretches.retain(|stretch| stretch.is_missed);
            if stretches.is_empty() {
                break;
            }
            (self.stretch, self.is_one, self.known) = (None, false, None);
            let mut marked = std::mem::take(&mut self.marked);
            marked[0].clear();
            marked[0].extend(stretches.iter().map(|stretch| stretch.x));
            let vague = T::of(MAX_NEAR_UNCERTAINTY / MAX_MISMATCH) * load;
            let refined = self.refine_at(gap, [&marked[0]; 2], vague, cost);
            self.marked = marked;
            if !refined? {
                break;
            }
        }
        Ok(())
    }

    /// Learns from others how much the gap of the bodies as described rises over some spans, and
    /// refines panels that contradict them: no feature that the panels of a contact have seen is
    /// missing.
    ///
    /// # Errors
    /// As [`take`](Self::take).
    pub fn learn(
        &mut self,
        gap: &Gap<'_, T>,
        rises: &[([T; 2], T)],
        load: T,
        cost: &mut Cost,
    ) -> Result<(), ContactError<T>> {
        // Spans whose panels have changed since the rises there were compared.
        let mut changed = vec![self.range];
        loop {
            let mut marked = std::mem::take(&mut self.marked);
            marked[0].clear();
            // Only noise excuses a panel.
            let noise = |x: T| {
                let panels = self.bodies.iter().map(|body| &body.panels[body.panels_at(x)[1]]);
                let noisy = panels.filter(|panel| !panel.may_gain(T::zero()));
                noisy.fold(T::zero(), |sum, panel| sum + panel.doubt)
            };
            let is_off = |&&([from, to], rise): &&([T; 2], T)| {
                let height = |x: T| self.height_as_described(x);
                let off = (height(to) - height(from) - rise).abs();
                off > T::of(MAX_AT_FOOT) * load + noise(from) + noise(to)
            };
            let is_open = |&&([from, to], _): &&([T; 2], T)| {
                let on = changed.get(changed.partition_point(|on| on[1] < from));
                on.is_some_and(|on| on[0] <= to)
            };
            marked[0].extend(rises.iter().filter(is_open).filter(is_off).map(|(span, _)| *span));
            changed.clear();
            // A flat surface has no features, and one panel that is as wide as all.
            let may_miss = |(_, surface): &(_, &Surface<'_, T>)| !surface.is_endless();
            for (body, _) in self.bodies.iter_mut().zip(&gap.bodies).filter(may_miss) {
                for &[from, to] in &marked[0] {
                    let [first, last] = [from, to].map(|x| body.panels_at(x));
                    let on = &mut body.panels[first[1]..=last[0].max(first[1])];
                    changed.push([on[0].x()[0], on[on.len() - 1].x()[1]]);
                    // A shorter panel has points of its own there.
                    let is_long = |panel: &&mut Panel<T>| panel.x()[1] - panel.x()[0] > to - from;
                    on.iter_mut().filter(is_long).for_each(Panel::void);
                }
            }
            changed.sort_by(|one, other| ascending(&one[0], &other[0]));
            changed.dedup_by(|next, on| {
                let meets = next[0] <= on[1];
                on[1] = if meets { on[1].max(next[1]) } else { on[1] };
                meets
            });
            // The void panels.
            let most = T::max_value().unwrap_or(T::one() / T::epsilon());
            let refined = self.refine_at(gap, [&marked[0]; 2], most, cost);
            self.marked = marked;
            if !refined? {
                return Ok(());
            }
            (self.is_one, self.known) = (false, None);
        }
    }

    /// Refines panels on some stretches until they are as accurate as the load F/κ requires, or
    /// noise; tells whether there were any.
    fn refine_stretches(
        &mut self,
        gap: &Gap<'_, T>,
        stretches: &[Stretch<T>],
        load: T,
        cost: &mut Cost,
    ) -> Fallible<T, bool> {
        let tolerance = T::of(MAX_AT_FOOT) * load;
        let mut is_finer = false;
        for _ in 0..MAX_ROUNDS {
            let mut marked = std::mem::take(&mut self.marked);
            marked[0].clear();
            marked[0].extend(stretches.iter().map(|stretch| stretch.x));
            let refined = self.refine_bodies(gap, [&marked[0]; 2], tolerance, cost);
            self.marked = marked;
            if !refined? {
                break;
            }
            is_finer = true;
        }
        if is_finer {
            self.join(gap);
        }
        Ok(is_finer)
    }

    /// Lists the spans between points and contacts where the gap may be within reach of a load, and
    /// where points are further apart than required.
    fn list_stretches(
        &self,
        gap: &Gap<'_, T>,
        load: T,
        contacts: &[Interval<T>],
        found: &mut Vec<Stretch<T>>,
    ) {
        found.clear();
        // Before first touch nothing is near a contact.
        let (ends, infinite) = (contacts.first().zip(contacts.last()), T::one() / T::zero());
        let hull = ends.map_or(infinite, |(on, last)| T::of(0.5) * (last.right - on.left));
        let nodes = self.nodes.iter().map(|node| [node.x, node.height]);
        let limits = contacts.iter().map(|on| on.left).chain([self.lowest]);
        let heights = nodes.chain(limits.map(|x| [x, self.near(x)[0]]));
        let heights = heights.map(|[x, height]| gap.turned(x, height));
        let lowest = heights.fold(infinite, |least: T, height| least.min(height));
        let ratio = (self.range[1] - self.range[0]) / hull;
        let level = lowest + load * (T::one() + ratio.max(T::one()).ln());
        let (asked, mut next) = (gap.asked_spacing(), 0);
        for pair in self.nodes.windows(2) {
            let [mut from, to] = [pair[0].x, pair[1].x];
            while from < to {
                while contacts.get(next).is_some_and(|on| on.right <= from) {
                    next += 1;
                }
                let on = contacts.get(next);
                let end = on.map_or(to, |on| to.min(on.left));
                let beside = contacts[next.saturating_sub(1)..].iter().take(2);
                let narrow = beside.clone().fold(hull, |least, on| least.min(on.half_width()));
                let near = gap.spacing(narrow, PROBE_SPACING);
                // A limit of a contact is not a point.
                let is_beside = from > pair[0].x || end < to;
                let share = if is_beside { T::of(0.5) } else { T::one() };
                let is_wide = |[from, to]: [T; 2], apart: T| to - from > share * apart;
                let promised = beside.filter_map(|on| promised(on, near, [from, end]));
                let is_due = asked.is_some() || is_wide([from, end], near);
                let reached = || within(gap, pair, [from, end], level + pair[0].after);
                let reached = promised.chain(is_due.then(reached).flatten());
                let x = reached.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]).unwrap_or([end; 2]);
                let parts = [([from, x[0]], asked), (x, Some(near)), ([x[1], end], asked)];
                for (x, apart) in parts {
                    // A point of one body need not be a point of the other.
                    let is_due = |&apart: &T| is_wide(x, apart) || asked.is_some() && x[1] > x[0];
                    let Some(apart) = apart.filter(is_due) else { continue };
                    // A void panel must be refined first.
                    let is_missed = !pair[0].after.is_finite();
                    let next = Stretch { x, apart, is_missed };
                    // A long stretch gets points of its own; short ones are merged.
                    if is_wide(x, apart) { found.push(next) } else { add(found, next) }
                }
                from = on.map_or(to, |on| end.max(on.right));
            }
        }
        if asked.is_none() {
            spread(found);
        }
    }

    /// Checks that the budget allows the points on some stretches.
    fn check_points(
        &self,
        gap: &Gap<'_, T>,
        stretches: &[Stretch<T>],
        cost: Cost,
    ) -> Fallible<T, ()> {
        let [Some(first), Some(last)] = [stretches.first(), stretches.last()] else {
            return Ok(());
        };
        let known = stretches.iter().filter(|stretch| !stretch.is_missed);
        let points = known.fold(0, |sum: usize, Stretch { x, apart, .. }| {
            sum.saturating_add(gap.parts(x[1] - x[0], *apart, MAX_PROBES))
        });
        let evaluations = cost.heights.saturating_add(points);
        let span = Interval { left: first.x[0], right: last.x[1] };
        gap.check_budget(Cost { evaluations, ..Cost::default() }, 1, 0, span)
    }
}

/// Moves the points on some stretches apart until there are no more than by default.
fn spread<T: Real>(found: &mut Vec<Stretch<T>>) {
    let points =
        found.iter().fold(T::zero(), |sum, Stretch { x, apart, .. }| sum + (x[1] - x[0]) / *apart);
    let times = points / T::count(MAX_PROBES);
    if times > T::one() {
        found.iter_mut().for_each(|stretch| stretch.apart *= times);
        found.retain(|Stretch { x, apart, .. }| x[1] - x[0] > *apart);
    }
}

/// Returns the part of a span within a half-width of a contact, and points around its end.
fn promised<T: Real>(on: &Interval<T>, near: T, [from, to]: [T; 2]) -> Option<[T; 2]> {
    let reach = on.half_width() + T::of(0.5) * near;
    let x = [from.max(on.left - reach), to.min(on.right + reach)];
    (x[0] < x[1]).then_some(x)
}

/// Cuts a span between two points at about the place where the gap rises to a level, if an end is
/// above it.
fn within<T: Real>(gap: &Gap<'_, T>, pair: &[Node<T>], x: [T; 2], level: T) -> Option<[T; 2]> {
    let curve = segment(&pair[0], &pair[1]);
    let is_below = |x: T| gap.turned(x, curve.at((x - pair[0].x) / curve.width)[0]) < level;
    let (from, mut low, mut high) = match x.map(is_below) {
        [true, true] => return Some(x),
        [true, false] => (x[0], x[0], x[1]),
        [false, true] => (x[1], x[1], x[0]),
        [false, false] => return None,
    };
    for _ in 0..MAX_REACH_HALVES {
        if (high - low).abs() <= T::of(0.125) * (low - from).abs() {
            break;
        }
        let middle = T::of(0.5) * (low + high);
        *(if is_below(middle) { &mut low } else { &mut high }) = middle;
    }
    Some([from.min(high), from.max(high)])
}

impl<T: Real> Body<T> {
    /// Evaluates points on some stretches, those of a piece in one batch, and voids panels that
    /// miss them. A stretch is missed, too, if a panel is off by as much as a crest under the load
    /// F/κ. A point further off than a foot, but within the uncertainty of its panel, is kept: the
    /// next panels there may seem more exact, and miss it.
    fn probe(
        &mut self,
        gap: &Gap<'_, T>,
        surface: &Surface<'_, T>,
        stretches: &mut [Stretch<T>],
        load: T,
        heights: &mut usize,
    ) {
        let [foot, near] = [MAX_AT_FOOT, MAX_NEAR_UNCERTAINTY].map(|share| T::of(share) * load);
        let mut probes = std::mem::take(&mut self.scratch.probes);
        probes.clear();
        let known = stretches.iter_mut().enumerate().filter(|(_, stretch)| !stretch.is_missed);
        for (i, stretch) in known {
            self.place_probes(gap, i, stretch, &mut probes);
        }
        let mut rest = &probes[..];
        while let [first, ..] = *rest {
            let piece = self.panels[first.panel].piece;
            let count = rest.partition_point(|probe| self.panels[probe.panel].piece == piece);
            let batch;
            (batch, rest) = rest.split_at(count);
            let curve = surface.piece(piece);
            let Scratch { k, points, .. } = &mut self.scratch;
            k.clear();
            k.extend(batch.iter().map(|probe| probe.k));
            points.clear();
            points.resize(count, curve.ends[0]);
            curve.curve.at_many(k, points);
            *heights = heights.saturating_add(count);
            for (&Probe { stretch, panel, t, k }, &point) in batch.iter().zip(&*points) {
                let (stretch, panel) = (&mut stretches[stretch], &mut self.panels[panel]);
                let Some(number) = panel.series else { continue };
                let (by, doubt) = (self.series[number].miss(t, &point), self.series[number].doubt);
                let is_met = by <= T::of(MAX_MISMATCH) * doubt;
                if !is_met || by > foot {
                    let by = if is_met { T::one() / T::zero() } else { by };
                    self.missed.push(Missed { piece, k, point, by, apart: stretch.apart });
                }
                // Only noise excuses a panel that is off by as much as a crest may hide.
                let may_hide = by > near && panel.may_gain(near / T::of(MAX_MISMATCH));
                stretch.is_missed |= !is_met || may_hide;
                if !is_met {
                    panel.void();
                }
            }
        }
        self.scratch.probes = probes;
    }

    /// Places points on a stretch.
    fn place_probes(
        &self,
        gap: &Gap<'_, T>,
        number: usize,
        stretch: &mut Stretch<T>,
        probes: &mut Vec<Probe<T>>,
    ) {
        let half = T::of(0.5);
        let [first, last] = stretch.x.map(|x| self.panels_at(x));
        for i in first[1]..=last[0].max(first[1]) {
            let panel = &self.panels[i];
            let Some(series) = panel.series.map(|number| &self.series[number]) else { continue };
            if !panel.doubt.is_finite() {
                stretch.is_missed = true;
                continue;
            }
            let between = panel.x();
            let [from, to] = [stretch.x[0].max(between[0]), stretch.x[1].min(between[1])];
            let count = gap.parts(to - from, stretch.apart, MAX_PROBES);
            let ends = [from, to].map(|x| series.parameter(x));
            probes.extend((0..count).map(|j| {
                let share = (T::count(j) + half) / T::count(count);
                // Even spacing in t is nearly even in x.
                let t = match gap.resolution() {
                    Some(_) => series.parameter(from + share * (to - from)),
                    None => ends[0] + share * (ends[1] - ends[0]),
                };
                Probe { stretch: number, panel: i, t, k: series.k(t) }
            }));
        }
    }
}
