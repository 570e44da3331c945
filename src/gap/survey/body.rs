//! One body of a survey: a row of panels, each as fine as required so far.

use super::check::check;
use super::hull_in;
use super::panel::{MAX_HALVING_RATIO, Missed, Panel, missed_by};
use super::segment::Segment;
use super::series::{BodyPoint, FURTHER, SAMPLES, Series, TESTED};
use crate::gap::Surface;
use crate::profile::Piece;
use crate::{CurvePoint, ProfileError, Real, Side};

/// Largest number of pieces of a joined body that are all sampled at once; of more pieces, only
/// those where bodies may touch.
const FEW_PIECES: usize = 16;

/// Largest number of runs into which the pieces of a body are grouped at first.
const MAX_RUNS: usize = 256;

/// Number of parts of a piece for which room is reserved.
const PARTS_RESERVED: usize = 16;

/// Largest number of windows by which a long body is narrowed to the other one.
const MAX_WINDOWS: usize = 8;

/// Number of series of a body after which no panel of it is refined: tens of megabytes.
const MAX_SERIES: usize = 1 << 15;

/// Largest share of a panel that is cut out of it as a window; for a larger share it is halved.
const LARGEST_WINDOW: f64 = 0.25;

/// Margins of a window, as shares of it and of the panel: the error of X(k) = x by a series.
const WINDOW_MARGIN: f64 = 0.25;
const LEAST_MARGIN: f64 = 5e-4;

/// Body as far as it is known.
#[derive(Clone, Debug)]
pub(super) struct Body<T> {
    pub panels: Vec<Panel<T>>,
    pub series: Vec<Series<T>>,
    /// Points inside the common range and the ends of pieces, by rising x.
    pub points: Vec<BodyPoint<T>>,
    /// Spans of x of the panels that are new since the points of both bodies were last joined.
    pub fresh: Vec<[T; 2]>,
    /// Points of the curve that a series has missed.
    pub missed: Vec<Missed<T>>,
    pub scratch: Scratch<T>,
}

#[derive(Clone, Debug)]
pub(super) struct Scratch<T> {
    pub probes: Vec<super::probe::Probe<T>>,
    pub k: Vec<T>,
    pub points: Vec<CurvePoint<T>>,
    panels: Vec<Panel<T>>,
    /// Panels to be sampled, and whether a closer series is made of them.
    wanted: Vec<(usize, bool)>,
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
        let (panels, series, points) = (Vec::new(), Vec::new(), Vec::new());
        Self { panels, series, points, fresh: Vec::new(), missed: Vec::new(), scratch }
    }

    /// Takes a first look at a surface, over the range of x that both bodies cover.
    pub fn look(
        &mut self,
        surface: &Surface<'_, T>,
        range: [T; 2],
        heights: &mut usize,
    ) -> Result<(), ProfileError<T>> {
        let is_again = !self.panels.is_empty();
        self.panels.clear();
        self.series.clear();
        self.missed.clear();
        self.scratch.wanted.clear();
        let first = surface.index_at(range[0], Side::Left);
        let last = surface.index_at(range[1], Side::Right).max(first);
        check_joints(surface, [first, last])?;
        let count = (last - first + 1).div_ceil(MAX_RUNS);
        for from in (first..=last).step_by(count) {
            let pieces = [from, (from + count - 1).min(last)];
            self.panels.push(Panel::of_pieces(surface, pieces));
        }
        if surface.is_endless() && surface.piece(first).curve.slope_at(range[0]).is_none() {
            self.panels[0].cut_to(surface, range);
        }
        if self.panels.len() <= FEW_PIECES {
            let wanted = (0..self.panels.len()).filter(|&i| !self.panels[i].is_sampled);
            self.scratch.wanted.extend(wanted.map(|i| (i, false)));
        }
        self.fresh.clear();
        self.fresh.push(range);
        self.points.clear();
        // Room to halve each panel once.
        self.points.reserve(2 * (SAMPLES + 2) * self.panels.len().min(FEW_PIECES));
        if is_again {
            self.make_room();
        }
        self.sample(surface, range, heights)?;
        self.list(range);
        let is_long = |panel: &Panel<T>| {
            let [from, to] = panel.x();
            let is_known = panel.series.is_some() && panel.doubt.is_finite();
            is_known && to - from > (range[1] - range[0]) / T::of(LARGEST_WINDOW)
        };
        for _ in 0..MAX_WINDOWS {
            if !self.refine(surface, range, &[range], is_long, heights)? {
                break;
            }
        }
        Ok(())
    }

    /// Makes room for each panel to be refined several times: bodies that move allocate nothing.
    fn make_room(&mut self) {
        let few = PARTS_RESERVED * self.panels.len().min(FEW_PIECES);
        self.points.reserve((SAMPLES + 2) * few);
        self.series.reserve(few);
        self.missed.reserve(few);
        self.panels.reserve(few);
        self.fresh.reserve(few);
        let Scratch { probes, k, points, panels, wanted } = &mut self.scratch;
        panels.reserve(few + self.panels.len());
        wanted.reserve(few);
        probes.reserve(TESTED * few);
        k.reserve(TESTED * few);
        points.reserve(TESTED * few);
    }

    /// Returns the largest number of evaluations for refining the marked panels on some spans.
    pub fn cost(
        &self,
        surface: &Surface<'_, T>,
        spans: &[[T; 2]],
        is_marked: impl Fn(&Panel<T>) -> bool,
    ) -> usize {
        let points = |panel: &Panel<T>| {
            let Some(hull) = hull_in(spans, panel).filter(|_| is_marked(panel)) else { return 0 };
            match panel.series {
                Some(number) if self.window(panel, &self.series[number], hull).is_some() => TESTED,
                Some(number) if panel.may_be_closer(&self.series[number]) => FURTHER,
                Some(_) => 2 * TESTED,
                None if panel.is_sampled || panel.settled(surface).is_some() => 0,
                None => TESTED * (panel.last - panel.piece + 1),
            }
        };
        self.panels.iter().fold(0, |sum: usize, panel| sum.saturating_add(points(panel)))
    }

    /// Refines the marked panels on some spans: samples those that are not sampled, cuts windows
    /// around the spans out of far longer panels, takes closer series where the curve is smooth,
    /// and halves the others.
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
        let (mut changes, is_full) = (false, self.series.len() > MAX_SERIES);
        for panel in &old {
            let Some(hull) = hull_in(spans, panel).filter(|_| !is_full && is_marked(panel)) else {
                self.panels.push(*panel);
                continue;
            };
            changes = true;
            self.fresh.push(panel.x());
            let settled = if panel.is_sampled { None } else { panel.settled(surface) };
            match (settled, panel.series) {
                (Some(settled), _) => self.panels.push(settled),
                (None, Some(number)) => {
                    let series = &self.series[number];
                    let window = self.window(panel, series, hull);
                    if window.is_none() && panel.may_be_closer(series) {
                        self.scratch.wanted.push((self.panels.len(), true));
                        self.panels.push(*panel);
                    } else {
                        self.split(panel, number, window);
                    }
                }
                (None, None) if panel.is_run() => self.panels.extend(panel.parts(surface)),
                (None, None) => {
                    self.scratch.wanted.push((self.panels.len(), false));
                    self.panels.push(Panel { is_sampled: true, ..*panel });
                }
            }
        }
        old.clear();
        self.scratch.panels = old;
        self.sample(surface, range, heights)?;
        if changes {
            self.list(range);
        }
        Ok(changes)
    }

    /// Returns the ends, as t, of a window around a span of x, if it is far shorter than the panel.
    fn window(&self, panel: &Panel<T>, series: &Series<T>, hull: [T; 2]) -> Option<[T; 2]> {
        let [start, end] = panel.k.map(|k| series.t(k));
        let [left, right] = hull.map(|x| series.parameter(x));
        let margin = T::of(WINDOW_MARGIN) * (right - left) + T::of(LEAST_MARGIN) * (end - start);
        let cuts = [(left - margin).max(start), (right + margin).min(end)];
        let is_short = cuts[1] - cuts[0] <= T::of(LARGEST_WINDOW) * (end - start);
        // The ends of a short panel, by the series next to it, may be the wrong way round by its
        // own.
        (series.doubt.is_finite() && is_short && cuts[0] < cuts[1]).then_some(cuts)
    }

    /// Replaces a panel by its parts: a window, given by its ends as t, and the rest on either side
    /// of it, where the old series is kept; or two halves.
    fn split(&mut self, panel: &Panel<T>, number: usize, window: Option<[T; 2]>) {
        let (series, half) = (&self.series[number], T::of(0.5));
        let [start, end] = panel.k.map(|k| series.t(k));
        let cuts = window.unwrap_or([half * (start + end), end]);
        let (mut rest, mut is_left) = (*panel, true);
        for t in cuts.into_iter().filter(|&t| t > start && t < end) {
            let series = &self.series[number];
            let ([x, y, slope], [from, to]) = (series.at_t(t), rest.x());
            let x = if x > from && x < to { x } else { half * (from + to) };
            let at = BodyPoint { x, y, slope, doubt: T::zero() };
            let mut part = rest;
            (part.k[1], part.ends[1], part.is_inside[1]) = (series.k(t), at, true);
            (rest.k[0], rest.ends[0], rest.is_inside[0]) = (part.k[1], at, true);
            is_left = window.is_some_and(|[left, _]| t == left);
            self.push_part(part, number, !is_left);
        }
        let is_wanted = window.is_none_or(|[_, right]| is_left || right >= end);
        self.push_part(rest, number, is_wanted);
    }

    /// Adds a part of a panel, to be sampled or with the old series.
    fn push_part(&mut self, part: Panel<T>, number: usize, is_wanted: bool) {
        if is_wanted {
            self.scratch.wanted.push((self.panels.len(), false));
            self.panels.push(part);
        } else {
            // Only points of its own can show that its uncertainty is noise.
            let since =
                if part.since.is_finite() { (part.k[1] - part.k[0]).abs() } else { part.since };
            let doubt = self.series[number].doubt;
            self.panels.push(Panel { doubt, since, is_void: false, ..part });
        }
    }

    /// Samples the wanted panels, those of a piece in one batch.
    fn sample(
        &mut self,
        surface: &Surface<'_, T>,
        range: [T; 2],
        heights: &mut usize,
    ) -> Result<(), ProfileError<T>> {
        let wanted = std::mem::take(&mut self.scratch.wanted);
        let mut rest = &wanted[..];
        while let [(first, _), ..] = *rest {
            let index = self.panels[first].piece;
            let is_on = |&(i, _): &(usize, bool)| self.panels[i].piece == index;
            let (batch, after) = rest.split_at(rest.partition_point(is_on));
            rest = after;
            let piece = surface.piece(index);
            let Scratch { k, points, .. } = &mut self.scratch;
            k.clear();
            for &(i, is_closer) in batch {
                match is_closer {
                    true => k.extend(Series::further(self.panels[i].k)),
                    false => k.extend(Series::parameters(self.panels[i].k)),
                }
            }
            points.clear();
            points.resize(k.len(), piece.ends[0]);
            piece.curve.at_many(k, points);
            *heights = heights.saturating_add(k.len());
            let (k, points) = (std::mem::take(k), std::mem::take(points));
            let mut from = 0;
            for &(i, is_closer) in batch {
                let (panel, points) = (&self.panels[i], &points[from..]);
                // The additional point is not in a row with the others.
                let [count, nodes] = if is_closer { [FURTHER; 2] } else { [TESTED, SAMPLES] };
                check(&piece, panel, (&k[from..][..nodes], &points[..nodes]), range, heights)?;
                match (panel.series, points.first_chunk(), points.first_chunk()) {
                    (Some(number), Some(further), _) if is_closer => {
                        self.series.push(self.series[number].closer(further));
                    }
                    (_, _, Some(first)) => self.series.push(Series::new(panel.k, first)),
                    _ => break,
                }
                self.take_series(i, &piece, heights);
                // A factor that X' and Y' share shows in no slope. A kink takes some 50 series.
                if self.series.len() == MAX_SERIES >> 8 && !self.panels[i].doubt.is_finite() {
                    piece.check_factors(points)?;
                }
                from += count;
            }
            (self.scratch.k, self.scratch.points) = (k, points);
            for &(i, _) in batch {
                self.meet(i);
                self.meet(i + 1);
            }
        }
        self.scratch.wanted = wanted;
        Ok(())
    }

    /// Takes the last series for that of a panel.
    fn take_series(&mut self, i: usize, piece: &Piece<'_, T>, heights: &mut usize) {
        let (panel, last) = (&mut self.panels[i], self.series.len() - 1);
        let (known, series) = self.series.split_at_mut(last);
        let series = &mut series[0];
        let missed = missed_by(series, panel, &self.missed);
        let is_void = !missed.is_finite();
        // An uncertainty that is no number stays so.
        if missed > series.doubt {
            series.doubt = missed;
        }
        let is_vain = panel.series.is_some_and(|number| {
            // Noise does not shrink with the length, nor do waves too fine for the points.
            let share = series.share_of(&known[number]);
            !is_void && series.doubt > share * panel.doubt
        });
        if panel.series.is_some() {
            panel.before = panel.doubt;
        }
        let is_known = !is_void && (series.is_exact || is_vain && series.is_noise(piece, heights));
        panel.since = match is_vain {
            _ if is_known => T::one() / T::zero(),
            true => panel.since,
            false => (panel.k[1] - panel.k[0]).abs(),
        };
        (panel.doubt, panel.is_sampled, panel.is_void) = (series.doubt, true, is_void);
        panel.series = Some(last);
    }

    /// Sets the common end of a panel and the one before it, inside a piece, by the less uncertain
    /// of both.
    fn meet(&mut self, i: usize) {
        let Some(before) = i.checked_sub(1).filter(|_| i < self.panels.len()) else { return };
        let [left, right] = [self.panels[before], self.panels[i]];
        let both = left
            .series
            .zip(right.series)
            .filter(|_| right.is_inside[0] && left.piece == right.piece);
        let Some((one, other)) = both else { return };
        let (one, other) = (&self.series[one], &self.series[other]);
        // Noise is as large in the next panel; a wall is not, and each halving has found it closer.
        for (own, next) in [(before, right.doubt), (i, left.doubt)] {
            let own = &mut self.panels[own];
            if next <= T::of(MAX_HALVING_RATIO) * own.doubt && own.since.is_finite() {
                own.since = (own.k[1] - own.k[0]).abs();
            }
        }
        let known = if other.doubt < one.doubt { other } else { one };
        let [x, y, slope] = known.at_t(known.t(right.k[0]));
        let from = inner(&self.series, &left).last().map_or(left.ends[0].x, |row| row.x);
        let to = inner(&self.series, &right).first().map_or(right.ends[1].x, |row| row.x);
        let x = if x >= from && x <= to { x } else { T::of(0.5) * from + T::of(0.5) * to };
        let end = BodyPoint { x, y, slope, doubt: T::zero() };
        (self.panels[before].ends[1], self.panels[i].ends[0]) = (end, end);
    }

    /// Lists all points by rising x.
    fn list(&mut self, [first, last]: [T; 2]) {
        self.panels.retain(|panel| panel.ends[1].x >= first && panel.ends[0].x <= last);
        self.points.clear();
        for panel in &self.panels {
            let inner = inner(&self.series, panel);
            let [start, end] = [0, 1].map(|i| (!panel.is_inside[i]).then_some(panel.ends[i]));
            // X may stand still within its rounding, where a body is nearly upright.
            let mut reached = None;
            for &row in start.iter().chain(inner).chain(&end) {
                if row.x.is_finite() && row.y.is_finite() && reached.is_none_or(|x| row.x > x) {
                    reached = Some(row.x);
                    self.points.push(row);
                }
            }
        }
    }

    /// Returns the numbers of the panels around x: two at a common end.
    pub fn panels_at(&self, x: T) -> [usize; 2] {
        let last = self.panels.len().saturating_sub(1);
        let after = self.panels.partition_point(|panel| panel.ends[1].x < x).min(last);
        let meets = after < last && self.panels[after].ends[1].x == x;
        [after, after + usize::from(meets)]
    }

    /// Returns height and slope at x by the series of a panel; where the series is useless, by the
    /// points around.
    pub fn at(&self, number: usize, x: T) -> BodyPoint<T> {
        let panel = &self.panels[number];
        let [mut start, mut end] = panel.ends;
        let usable = panel.series.filter(|_| panel.doubt.is_finite());
        if panel.series.is_some() && usable.is_none() {
            let beyond = self.points.partition_point(|row| row.x <= x);
            start = beyond.checked_sub(1).map_or(start, |before| self.points[before]);
            end = self.points.get(beyond).copied().unwrap_or(start);
            // The last point of all.
            if end.x <= start.x {
                return BodyPoint { x, ..start };
            }
        }
        let [y, slope, doubt] = match usable {
            Some(number) => {
                let series = &self.series[number];
                let [y, slope] = series.at(x);
                let points = series.points();
                let near = points.partition_point(|row| row.x < x).min(points.len() - 1);
                [y, slope, points[near].doubt]
            }
            None => {
                let is_cubic = panel.series.is_none() && (panel.is_sampled || panel.is_run());
                let through = if is_cubic { Segment::exact } else { Segment::new };
                let segment = through([start.x, start.y], [end.x, end.y], [start.slope, end.slope]);
                let t = (x - start.x) / segment.width;
                let [y, slope] = segment.at(t.max(T::zero()).min(T::one()));
                [y, slope, if panel.is_sampled { start.doubt } else { T::one() / T::zero() }]
            }
        };
        BodyPoint { x, y, slope, doubt }
    }
}

/// Returns the points of the series of a panel that lie inside it.
fn inner<'s, T: Real>(series: &'s [Series<T>], panel: &Panel<T>) -> &'s [BodyPoint<T>] {
    let Some(series) = panel.series.map(|number| &series[number]) else { return &[] };
    let [from, to] = panel.k.map(|k| series.t(k));
    let nodes = series.places();
    let first = nodes.partition_point(|&node| T::of(node) < from);
    let after = nodes.partition_point(|&node| T::of(node) <= to);
    &series.points()[first..after.max(first)]
}

/// Refuses pieces that do not rise, or do not meet.
fn check_joints<T: Real>(
    surface: &Surface<'_, T>,
    [first, last]: [usize; 2],
) -> Result<(), ProfileError<T>> {
    let (count, mut before) = (surface.len(), None);
    for index in first..=last {
        let [from, to] = surface.piece(index).x();
        // Tolerance as in `Gap::piece_with`.
        let allowed = T::of(0.5) * (to - from).max(from.abs()).max(to.abs());
        let is_apart = before.is_some_and(|end: T| (from - end).abs() >= allowed);
        if surface.joined.is_some() && (from >= to || is_apart) {
            return Err(ProfileError::Pieces { count, index });
        }
        before = Some(to);
    }
    Ok(())
}
