//! One body of a survey: a row of panels, each as fine as it has been asked for.

use super::panel::{NODES, POINTS, Row, Series};
use super::segment::Segment;
use crate::gap::Surface;
use crate::numerics::chebyshev::Table;
use crate::profile::{Convexity, Piece, first_turn};
use crate::{CurvePoint, ProfileError, Real, Side};

/// Pieces of a joined body below which each is sampled at once; of more, where bodies may touch.
const FEW_PIECES: usize = 16;

/// Windows by which a long body is narrowed to the other one.
const MOST_WINDOWS: usize = 8;

/// Halvings in a row after which a panel that is as uncertain as before is taken for noise: a wave that is finer than
/// that, of some 300 in the body, is seen before.
const MOST_IN_VAIN: usize = 10;

/// The share of the distance by which a point was missed that may be left of it: a series that is closer has seen the
/// feature, not only its foot.
const LEFT: f64 = 0.01;

/// The share of its uncertainty that halving leaves at most of a panel that resolves the body: of a series of eight
/// terms 1/256 or less.
const GAIN: f64 = 0.125;

/// The share of a panel up to which what is asked for of it is cut out of it; of more it is halved.
const WINDOW: f64 = 0.25;

/// A body, as it is known by now.
#[derive(Clone, Debug)]
pub(super) struct Body<T> {
    pub panels: Vec<Panel<T>>,
    pub series: Vec<Series<T>>,
    /// All points inside the common range and the ends of pieces, by rising x.
    pub rows: Vec<Row<T>>,
    /// The spans of x of the panels that are new since the points were last joined with those of the other body.
    pub fresh: Vec<[T; 2]>,
    /// Points of the curve that a series has missed.
    pub missed: Vec<Missed<T>>,
    pub scratch: Scratch<T>,
}

/// A point of a piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct Missed<T> {
    pub piece: usize,
    pub k: T,
    pub point: CurvePoint<T>,
    /// The distance by which it was missed, a length.
    pub by: T,
    /// The distance of points at which it was found, along x.
    pub apart: T,
}

/// A stretch of a smooth piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct Panel<T> {
    pub piece: usize,
    pub k: [T; 2],
    /// The points at both ends, of which those inside a piece are not among the rows.
    ends: [Row<T>; 2],
    is_inside: [bool; 2],
    /// Its number among the series; without one it is the cubic between its ends.
    pub series: Option<usize>,
    /// Uncertainty of the heights, a length.
    pub doubt: T,
    /// Whether anything but the ends has been looked at.
    pub is_sampled: bool,
    /// Halvings in a row that have left it as uncertain.
    pub vain: usize,
    /// Whether it misses points of the curve that are known.
    pub is_void: bool,
    /// Uncertainty of the panel that it is a half of; infinite if there is none.
    before: T,
}

impl<T: Real> Panel<T> {
    pub fn x(&self) -> [T; 2] {
        self.ends.map(|end| end.x)
    }

    /// Tells whether more points may leave it less uncertain than by a tolerance.
    pub fn may_gain(&self, tolerance: T) -> bool {
        !self.is_sampled || self.doubt > tolerance && self.vain < MOST_IN_VAIN
    }

    /// Tells whether its halving has brought it much nearer to being known.
    pub fn converges(&self) -> bool {
        self.doubt <= T::of(GAIN) * self.before
    }
}

#[derive(Clone, Debug)]
pub(super) struct Scratch<T> {
    pub probes: Vec<super::probe::Probe<T>>,
    pub k: Vec<T>,
    pub points: Vec<CurvePoint<T>>,
    panels: Vec<Panel<T>>,
    /// Panels to be sampled.
    wanted: Vec<usize>,
}

fn row<T: Real>(end: CurvePoint<T>) -> Row<T> {
    Row { x: end.x, y: end.y, slope: end.dy / end.dx, doubt: T::zero() }
}

impl<T: Real> Body<T> {
    pub fn new() -> Self {
        let scratch = Scratch {
            probes: Vec::new(),
            k: Vec::new(),
            points: Vec::new(),
            panels: Vec::new(),
            wanted: Vec::new(),
        };
        let (panels, series, rows) = (Vec::new(), Vec::new(), Vec::new());
        Self { panels, series, rows, fresh: Vec::new(), missed: Vec::new(), scratch }
    }

    /// Takes a first look at a surface, over the range of x that both bodies cover.
    pub fn look(
        &mut self,
        surface: &Surface<'_, T>,
        range: [T; 2],
        heights: &mut usize,
    ) -> Result<(), ProfileError<T>> {
        let count = surface.len();
        self.panels.clear();
        self.series.clear();
        self.missed.clear();
        self.scratch.wanted.clear();
        let first = surface.index_at(range[0], Side::Left);
        let last = surface.index_at(range[1], Side::Right).max(first);
        let few = last - first < FEW_PIECES;
        let mut before: Option<T> = None;
        for index in first..=last {
            let piece = surface.piece(index);
            let [from, to] = piece.x();
            // As where it is sampled.
            let allowed = T::of(0.5) * (to - from).max(from.abs()).max(to.abs());
            let apart = |end: T| (from - end).abs() >= allowed;
            if surface.joined.is_some() && (from >= to || before.is_some_and(apart)) {
                return Err(ProfileError::Pieces { count, index });
            }
            before = Some(to);
            let ends = piece.ends.map(row);
            // A body without ends is known by them.
            let endless = T::max_value().is_some_and(|most| to - from > T::of(0.125) * most);
            let straight = piece.curve.convexity() == Convexity::Straight;
            let is_sampled = endless || straight;
            let doubt = if is_sampled { T::zero() } else { bulge(&ends) };
            if few && !is_sampled {
                self.scratch.wanted.push(self.panels.len());
            }
            let (k, is_inside, series) = (piece.k, [false; 2], None);
            self.panels.push(Panel {
                piece: index,
                k,
                ends,
                is_inside,
                series,
                doubt,
                is_sampled,
                vain: 0,
                is_void: false,
                before: T::one() / T::zero(),
            });
        }
        // Room for each to be halved once.
        self.fresh.clear();
        self.fresh.push(range);
        self.rows.clear();
        self.rows.reserve(2 * (NODES + 2) * self.panels.len().min(FEW_PIECES));
        self.sample(surface, range, heights)?;
        self.list(range);
        for _ in 0..MOST_WINDOWS {
            let is_long = |panel: &Panel<T>| {
                let [from, to] = panel.x();
                panel.series.is_some()
                    && panel.doubt.is_finite()
                    && to - from > (range[1] - range[0]) / T::of(WINDOW)
            };
            if !self.refine(surface, range, &[range], is_long, heights)? {
                break;
            }
        }
        Ok(())
    }

    /// Returns the evaluations that it may take to refine the panels on some spans that are marked.
    pub fn cost(
        &self,
        surface: &Surface<'_, T>,
        spans: &[[T; 2]],
        is_marked: impl Fn(&Panel<T>) -> bool,
    ) -> usize {
        let batches = |panel: &Panel<T>| {
            let Some(hull) = hull_in(spans, panel).filter(|_| is_marked(panel)) else { return 0 };
            match panel.series {
                Some(number) if self.window(panel, &self.series[number], hull).is_some() => 1,
                Some(_) => 2,
                None => usize::from(!panel.is_sampled && settled(surface, panel).is_none()),
            }
        };
        POINTS * self.panels.iter().map(batches).sum::<usize>()
    }

    /// Returns where to cut a panel that is far longer than a span of x: on either side of that, as its series has it.
    fn window(&self, panel: &Panel<T>, series: &Series<T>, hull: [T; 2]) -> Option<[T; 2]> {
        let [start, end] = panel.k.map(|k| series.t(k));
        let [left, right] = hull.map(|x| series.parameter(x));
        let margin = T::of(0.25) * (right - left) + T::of(5e-4) * (end - start);
        let cuts = [(left - margin).max(start), (right + margin).min(end)];
        let is_short = cuts[1] - cuts[0] <= T::of(WINDOW) * (end - start);
        (series.doubt.is_finite() && is_short).then_some(cuts)
    }

    /// Refines the panels on some spans that are marked: cuts out of those that are far longer what is on them, halves
    /// others that are sampled, and looks into the rest.
    pub fn refine(
        &mut self,
        surface: &Surface<'_, T>,
        range: [T; 2],
        spans: &[[T; 2]],
        is_marked: impl Fn(&Panel<T>) -> bool,
        heights: &mut usize,
    ) -> Result<bool, ProfileError<T>> {
        let mut old = std::mem::take(&mut self.scratch.panels);
        std::mem::swap(&mut old, &mut self.panels);
        self.panels.clear();
        self.scratch.wanted.clear();
        let mut changes = false;
        for panel in &old {
            let Some(hull) = hull_in(spans, panel).filter(|_| is_marked(panel)) else {
                self.panels.push(*panel);
                continue;
            };
            changes = true;
            self.fresh.push(panel.x());
            if !panel.is_sampled {
                let settled = settled(surface, panel);
                if settled.is_none() {
                    self.scratch.wanted.push(self.panels.len());
                }
                self.panels.push(Panel { is_sampled: true, ..settled.unwrap_or(*panel) });
                continue;
            }
            self.split(panel, hull);
        }
        old.clear();
        self.scratch.panels = old;
        self.sample(surface, range, heights)?;
        if changes {
            self.list(range);
        }
        Ok(changes)
    }

    /// Puts the parts of a sampled panel in its place.
    fn split(&mut self, panel: &Panel<T>, hull: [T; 2]) {
        let Some(series) = panel.series.map(|number| &self.series[number]) else {
            return self.panels.push(*panel);
        };
        let (half, [start, end]) = (T::of(0.5), panel.k.map(|k| series.t(k)));
        let window = self.window(panel, series, hull);
        let cuts = window.unwrap_or([half * (start + end), end]);
        let (mut parts, mut rest) = ([None; 3], *panel);
        for (part, &t) in parts.iter_mut().zip(&cuts) {
            let k = series.k(t);
            if t <= start || t >= end || k <= rest.k[0] || k >= panel.k[1] {
                continue;
            }
            let ([x, y, slope], [from, to]) = (series.at_t(t), rest.x());
            let x = if x > from && x < to { x } else { half * (from + to) };
            let at = Row { x, y, slope, doubt: T::zero() };
            let mut before = rest;
            (before.k[1], before.ends[1], before.is_inside[1]) = (k, at, true);
            (rest.k[0], rest.ends[0], rest.is_inside[0]) = (k, at, true);
            *part = Some(before);
        }
        // No parameter lies between its ends.
        if parts.iter().all(Option::is_none) {
            return self.panels.push(Panel {
                vain: MOST_IN_VAIN,
                doubt: series.doubt,
                is_void: false,
                ..*panel
            });
        }
        // Of a window that reaches to the end there is no rest.
        let last = if parts[1].is_none() { 1 } else { 2 };
        parts[last] = Some(rest);
        let doubt = series.doubt;
        for (i, part) in parts.into_iter().enumerate() {
            let Some(part) = part else { continue };
            // On either side of a window the series is as good as it was.
            if window.is_some() && i != 1 {
                self.panels.push(Panel { doubt, is_void: false, ..part });
            } else {
                self.scratch.wanted.push(self.panels.len());
                self.panels.push(Panel { series: None, ..part });
            }
        }
    }

    /// Samples the panels that are wanted, those of a piece in one batch.
    fn sample(
        &mut self,
        surface: &Surface<'_, T>,
        range: [T; 2],
        heights: &mut usize,
    ) -> Result<(), ProfileError<T>> {
        let wanted = std::mem::take(&mut self.scratch.wanted);
        let mut rest = &wanted[..];
        while let [first, ..] = *rest {
            let index = self.panels[first].piece;
            let batch;
            (batch, rest) = rest.split_at(rest.partition_point(|&i| self.panels[i].piece == index));
            let piece = surface.piece(index);
            let Scratch { k, points, .. } = &mut self.scratch;
            k.clear();
            k.extend(batch.iter().flat_map(|&i| Series::parameters(self.panels[i].k)));
            points.clear();
            points.resize(k.len(), piece.ends[0]);
            piece.curve.at_many(k, points);
            *heights = heights.saturating_add(k.len());
            for (&i, points) in batch.iter().zip(points.as_chunks::<POINTS>().0) {
                let panel = &mut self.panels[i];
                let mut series = Series::new(panel.k, points);
                for (end, t) in [-T::one(), T::one()].into_iter().enumerate() {
                    let outer = panel.ends[end].x;
                    series.between[end] =
                        if panel.is_inside[end] { series.at_t(t)[0] } else { outer };
                }
                let missed = missed_by(&series, panel, &self.missed);
                let is_void = missed.is_some();
                if is_void {
                    series.doubt = T::one() / T::zero();
                }
                let is_better = series.doubt <= T::of(0.5) * panel.doubt;
                let is_vain = panel.is_sampled && !is_better && !is_void;
                panel.vain = match is_vain {
                    _ if series.is_exact && !is_void => MOST_IN_VAIN,
                    true => panel.vain + 1,
                    false => 0,
                };
                if panel.is_sampled {
                    panel.before = panel.doubt;
                }
                (panel.doubt, panel.is_sampled, panel.is_void) = (series.doubt, true, is_void);
                check(&piece, panel, points, range)?;
                panel.series = Some(self.series.len());
                self.series.push(series);
            }
            for &i in batch {
                self.meet(i);
                self.meet(i + 1);
            }
        }
        self.scratch.wanted = wanted;
        Ok(())
    }

    /// Sets the place where a panel and the one before it meet, inside a piece, by what the better known of both says.
    fn meet(&mut self, i: usize) {
        let Some(before) = i.checked_sub(1).filter(|_| i < self.panels.len()) else { return };
        let [left, right] = [self.panels[before], self.panels[i]];
        let both = left
            .series
            .zip(right.series)
            .filter(|_| right.is_inside[0] && left.piece == right.piece);
        let Some((one, other)) = both else { return };
        let (one, other) = (&self.series[one], &self.series[other]);
        let known = if other.doubt < one.doubt { other } else { one };
        let [x, y, slope] = known.at_t(known.t(right.k[0]));
        let from = inner(&self.series, &left).last().map_or(left.ends[0].x, |row| row.x);
        let to = inner(&self.series, &right).first().map_or(right.ends[1].x, |row| row.x);
        let x = if x >= from && x <= to { x } else { T::of(0.5) * from + T::of(0.5) * to };
        let end = Row { x, y, slope, doubt: T::zero() };
        (self.panels[before].ends[1], self.panels[i].ends[0]) = (end, end);
    }

    /// Lists all points.
    fn list(&mut self, [first, last]: [T; 2]) {
        self.panels.retain(|panel| panel.ends[1].x >= first && panel.ends[0].x <= last);
        self.rows.clear();
        for panel in &self.panels {
            let inner = inner(&self.series, panel);
            let [start, end] = [0, 1].map(|i| (!panel.is_inside[i]).then_some(panel.ends[i]));
            // X may stand still for its rounding, where a body is all but upright.
            let mut reached = None;
            for &row in start.iter().chain(inner).chain(&end) {
                if row.x.is_finite() && row.y.is_finite() && reached.is_none_or(|x| row.x > x) {
                    reached = Some(row.x);
                    self.rows.push(row);
                }
            }
        }
    }

    /// Returns the numbers of the panels around x: two at a place where two meet.
    pub fn panels_at(&self, x: T) -> [usize; 2] {
        let last = self.panels.len().saturating_sub(1);
        let after = self.panels.partition_point(|panel| panel.ends[1].x < x).min(last);
        let meets = after < last && self.panels[after].ends[1].x == x;
        [after, after + usize::from(meets)]
    }

    /// Returns height and slope at x, as a panel has it; where its series is of no use, by the points around.
    pub fn at(&self, number: usize, x: T) -> Row<T> {
        let panel = &self.panels[number];
        let [mut start, mut end] = panel.ends;
        let usable = panel.series.filter(|_| panel.doubt.is_finite());
        if panel.series.is_some() && usable.is_none() {
            let beyond = self.rows.partition_point(|row| row.x <= x);
            start = beyond.checked_sub(1).map_or(start, |before| self.rows[before]);
            end = self.rows.get(beyond).copied().unwrap_or(start);
            // The last point of all.
            if end.x <= start.x {
                return Row { x, ..start };
            }
        }
        let [y, slope, doubt] = match usable {
            Some(number) => {
                let series = &self.series[number];
                let [y, slope] = series.at(x);
                let near = series.rows.partition_point(|row| row.x < x).min(NODES - 1);
                [y, slope, series.rows[near].doubt]
            }
            None => {
                let is_cubic = panel.series.is_none() && panel.is_sampled;
                let through = if is_cubic { Segment::exact } else { Segment::new };
                let segment = through([start.x, start.y], [end.x, end.y], [start.slope, end.slope]);
                let t = (x - start.x) / segment.width;
                let [y, slope] = segment.at(t.max(T::zero()).min(T::one()));
                [y, slope, if panel.is_sampled { T::zero() } else { T::one() / T::zero() }]
            }
        };
        Row { x, y, slope, doubt }
    }
}

/// Returns the points inside a panel.
fn inner<'s, T: Real>(series: &'s [Series<T>], panel: &Panel<T>) -> &'s [Row<T>] {
    let Some(series) = panel.series.map(|number| &series[number]) else { return &[] };
    let [from, to] = panel.k.map(|k| series.t(k));
    let nodes = &Table::of(NODES).z[..NODES];
    let first = nodes.partition_point(|&node| T::of(node) < from);
    let last = nodes.partition_point(|&node| T::of(node) <= to);
    &series.rows[first..last.max(first)]
}

/// Returns the hull of the spans, in rising order, that a panel overlaps, as far as it lies on it.
pub(super) fn hull_in<T: Real>(spans: &[[T; 2]], panel: &Panel<T>) -> Option<[T; 2]> {
    let [from, to] = panel.x();
    let first = spans.partition_point(|span| span[1] <= from);
    let after = spans.partition_point(|span| span[0] < to);
    (first < after).then(|| [spans[first][0].max(from), spans[after - 1][1].min(to)])
}

/// Returns a point of a panel that its series misses, as another one has.
fn missed_by<'m, T: Real>(
    series: &Series<T>,
    panel: &Panel<T>,
    known: &'m [Missed<T>],
) -> Option<&'m Missed<T>> {
    let [left, right] = panel.x();
    known.iter().filter(|missed| missed.piece == panel.piece).find(|missed| {
        let t = series.t(missed.k);
        let error = series.doubt.max(series.miss(t, &missed.point));
        let is_met = error <= T::of(LEFT) * missed.by;
        // A shorter one has points all over the feature.
        t.abs() <= T::one() && right - left > T::of(0.5) * missed.apart && !is_met
    })
}

/// How far the cubic between two ends bulges from the line through both.
fn bulge<T: Real>([start, end]: &[Row<T>; 2]) -> T {
    let size = (end.slope - start.slope).abs() * (end.x - start.x);
    if size.is_finite() { size } else { (end.y - start.y).abs() }
}

/// A cubic between two ends that the slopes inside bear out, where the curve gives them by x.
fn settled<T: Real>(surface: &Surface<'_, T>, panel: &Panel<T>) -> Option<Panel<T>> {
    let piece = surface.piece(panel.piece);
    let [start, end] = panel.ends;
    let segment = Segment::exact([start.x, start.y], [end.x, end.y], [start.slope, end.slope]);
    let size = start.slope.abs() + end.slope.abs() + segment.chord.abs();
    let rounding =
        T::of(64.0) * T::epsilon() * (size + (start.y.abs() + end.y.abs()) / segment.width);
    let agrees = |share: f64| {
        let slope = segment.at(T::of(share))[1];
        let given = piece.curve.slope_at(start.x + T::of(share) * segment.width)?;
        Some((given - slope).abs() <= rounding)
    };
    let both = agrees(0.3)? && agrees(0.7)?;
    both.then_some(Panel { doubt: T::zero(), ..*panel })
}

/// Refuses points where X or Y is not finite inside the common range, where X turns, and slopes by x that are not
/// those of the points.
fn check<T: Real>(
    piece: &Piece<'_, T>,
    panel: &Panel<T>,
    points: &[CurvePoint<T>; POINTS],
    range: [T; 2],
) -> Result<(), ProfileError<T>> {
    let ([from, to], k) = (panel.x(), Series::parameters(panel.k));
    let [first, last] = piece.x();
    // That of the largest terms which X may be made of.
    let rounding = T::of(32.0) * T::epsilon() * first.abs().max(last.abs());
    let mut reached = from;
    for (i, point) in points[..NODES].iter().enumerate() {
        let fault = |quantity, value| Err(ProfileError::NotFinite { quantity, k: k[i], value });
        let CurvePoint { x, y, .. } = *point;
        if !x.is_finite() {
            let next = points[i..NODES].iter().map(|point| point.x).find(|x| x.is_finite());
            if reached < range[1] && next.unwrap_or(to) > range[0] {
                return fault("X", x);
            }
            continue;
        }
        // An end inside a piece is only about where the series has it.
        let turns = i > 0 && x < reached - rounding;
        if turns || x < first - rounding || x > last + rounding {
            let back = |&j: &usize| points[j].dx * points[j + 1].dx < T::zero();
            let j = (0..NODES - 1).find(back).unwrap_or(i.saturating_sub(1));
            let met = [k[j], k[(j + 1).min(NODES - 1)]];
            return Err(first_turn(piece.curve, piece.k, met));
        }
        if !y.is_finite() && x > range[0] && x < range[1] {
            return fault("Y", y);
        }
        reached = if i == 0 { x } else { reached.max(x) };
    }
    check_slopes(piece, &k, points)
}

/// Compares the slopes that a curve gives by x, if it does, with those of its points.
fn check_slopes<T: Real>(
    piece: &Piece<'_, T>,
    k: &[T; POINTS],
    points: &[CurvePoint<T>; POINTS],
) -> Result<(), ProfileError<T>> {
    let slope = |i: usize| points[i].dy / points[i].dx;
    for i in 1..NODES - 1 {
        let Some(given) = piece.curve.slope_at(points[i].x) else { return Ok(()) };
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
