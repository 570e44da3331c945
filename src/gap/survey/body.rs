//! One body of a survey: a row of panels, each as fine as it has been asked for.

use super::check::check;
use super::panel::{MOST_IN_VAIN, Missed, Panel, bulge, missed_by, row, settled};
use super::segment::Segment;
use super::series::{NODES, POINTS, Row, Series};
use crate::gap::Surface;
use crate::profile::Convexity;
use crate::{CurvePoint, ProfileError, Real, Side};

/// Pieces of a joined body below which each is sampled at once; of more, where bodies may touch.
const FEW_PIECES: usize = 16;

/// Windows by which a long body is narrowed to the other one.
const MOST_WINDOWS: usize = 8;

/// The x-length of a body beyond that of the common range from which on it is narrowed.
const LONG: f64 = 4.0;

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

#[derive(Clone, Debug)]
pub(super) struct Scratch<T> {
    pub probes: Vec<super::probe::Probe<T>>,
    pub k: Vec<T>,
    pub points: Vec<CurvePoint<T>>,
    panels: Vec<Panel<T>>,
    /// Panels to be sampled.
    wanted: Vec<usize>,
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
        for i in 0..self.panels.len() {
            self.narrow(i, surface, range, heights)?;
        }
        self.list(range);
        Ok(())
    }

    /// Brings a panel that is far longer than the common range to where that is.
    fn narrow(
        &mut self,
        i: usize,
        surface: &Surface<'_, T>,
        range: [T; 2],
        heights: &mut usize,
    ) -> Result<(), ProfileError<T>> {
        for _ in 0..MOST_WINDOWS {
            let panel = self.panels[i];
            let ([from, to], Some(number)) = (panel.x(), panel.series) else { return Ok(()) };
            let series = &self.series[number];
            if !(to - from > T::of(LONG) * (range[1] - range[0]) && series.doubt.is_finite()) {
                return Ok(());
            }
            let [left, right] = range.map(|x| series.parameter(x, [from, to]));
            let (one, half) = (T::one(), T::of(0.5));
            let margin = half * half * (right - left) + T::of(1e-3);
            let [left, right] = [(left - margin).max(-one), (right + margin).min(one)];
            let at = |t: T| half * (one - t) * panel.k[0] + half * (one + t) * panel.k[1];
            let mut next = Panel { k: [at(left), at(right)], ..panel };
            for (end, t) in [left, right].into_iter().enumerate() {
                if t.abs() < one {
                    let [x, y, slope] = series.at_end(t);
                    next.ends[end] = Row { x, y, slope, doubt: T::zero() };
                    next.is_inside[end] = true;
                }
            }
            self.panels[i] = next;
            self.scratch.wanted.clear();
            self.scratch.wanted.push(i);
            self.sample(surface, range, heights)?;
            let next = &mut self.panels[i];
            let series = next.series.map(|number| &self.series[number]);
            for (end, t) in [-one, one].into_iter().enumerate() {
                if let Some(series) = series.filter(|_| next.is_inside[end]) {
                    next.ends[end].x = series.at_end(t)[0];
                }
            }
            let [from, to] = next.x();
            if !(from <= range[0] && to >= range[1]) {
                // The window has missed the range.
                self.panels[i] = panel;
                self.scratch.wanted.clear();
                self.scratch.wanted.push(i);
                return self.sample(surface, range, heights);
            }
        }
        Ok(())
    }

    /// Returns the evaluations that it may take to refine the panels that are marked.
    pub fn cost(&self, surface: &Surface<'_, T>, is_marked: impl Fn(&Panel<T>) -> bool) -> usize {
        let batches = |panel: &Panel<T>| match panel.series {
            Some(_) => 2,
            None => usize::from(!panel.is_sampled && settled(surface, panel).is_none()),
        };
        POINTS * self.panels.iter().filter(|panel| is_marked(panel)).map(batches).sum::<usize>()
    }

    /// Refines the panels that are marked: halves those that are sampled, and looks into the others.
    pub fn refine(
        &mut self,
        surface: &Surface<'_, T>,
        range: [T; 2],
        is_marked: impl Fn(&Panel<T>) -> bool,
        heights: &mut usize,
    ) -> Result<bool, ProfileError<T>> {
        let half = T::of(0.5);
        let mut old = std::mem::take(&mut self.scratch.panels);
        std::mem::swap(&mut old, &mut self.panels);
        self.panels.clear();
        self.scratch.wanted.clear();
        let mut changes = false;
        for panel in &old {
            if !is_marked(panel) {
                self.panels.push(*panel);
                continue;
            }
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
            let middle = half * panel.k[0] + half * panel.k[1];
            let [from, to] = panel.x();
            let centre = half * from + half * to;
            let at = panel.series.map_or(panel.ends[0], |number| {
                let [x, y, slope] = self.series[number].at_end(T::zero());
                Row { x: if x > from && x < to { x } else { centre }, y, slope, doubt: T::zero() }
            });
            let (mut left, mut right) = (*panel, *panel);
            (left.k[1], left.ends[1], left.is_inside[1]) = (middle, at, true);
            (right.k[0], right.ends[0], right.is_inside[0]) = (middle, at, true);
            right.series = None;
            for part in [left, right] {
                self.scratch.wanted.push(self.panels.len());
                self.panels.push(part);
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
                match panel.series {
                    Some(number) => self.series[number] = series,
                    None => {
                        panel.series = Some(self.series.len());
                        self.series.push(series);
                    }
                }
            }
            for &i in batch {
                self.meet(i);
            }
        }
        self.scratch.wanted = wanted;
        Ok(())
    }

    /// Sets the place where a panel and the one before it meet, inside a piece, by what both say.
    fn meet(&mut self, i: usize) {
        let Some(before) = i.checked_sub(1) else { return };
        let [left, right] = [self.panels[before], self.panels[i]];
        let both = left
            .series
            .zip(right.series)
            .filter(|_| right.is_inside[0] && left.piece == right.piece);
        let Some((one, other)) = both else { return };
        let (one, other) = (&self.series[one], &self.series[other]);
        let ([x, y, slope], [after, ..]) = (one.at_end(T::one()), other.at_end(-T::one()));
        let between = [one.rows[NODES - 1].x, other.rows[0].x];
        let half = T::of(0.5);
        let mut at = half * x + half * after;
        if !(at >= between[0] && at <= between[1]) {
            at = half * between[0] + half * between[1];
        }
        let end = Row { x: at, y, slope, doubt: T::zero() };
        (self.panels[before].ends[1], self.panels[i].ends[0]) = (end, end);
    }

    /// Lists all points.
    fn list(&mut self, [first, last]: [T; 2]) {
        self.panels.retain(|panel| panel.ends[1].x >= first && panel.ends[0].x <= last);
        self.rows.clear();
        for panel in &self.panels {
            let inner = panel.series.map_or(&[][..], |number| &self.series[number].rows[..]);
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
                let [y, slope] = series.at(x, panel.x());
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
