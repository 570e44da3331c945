//! One body of a survey: a row of panels, each as fine as it has been asked for.

mod check;
mod fine;
mod known;

pub(crate) use fine::Rise;

use super::panel::{NODES, POINTS, Row, Series};
use super::segment::Segment;
use crate::gap::Surface;
use crate::profile::Convexity;
use crate::{CurvePoint, ProfileError, Real, Side};
use check::check;
use known::{bulge, settled};

/// Pieces of a joined body below which each is sampled at once; of more, where bodies may touch.
const FEW_PIECES: usize = 16;

/// Windows by which a long body is narrowed to the other one.
const MOST_WINDOWS: usize = 8;

/// Halvings in a row after which a panel that is as uncertain as before is taken for noise: a wave that is finer than
/// that, of some 300 in the body, is seen before.
const MOST_IN_VAIN: usize = 10;

/// The x-length of a body beyond that of the common range from which on it is narrowed.
const LONG: f64 = 4.0;

/// A body, as it is known by now.
#[derive(Clone, Debug)]
pub(super) struct Body<T> {
    pub panels: Vec<Panel<T>>,
    series: Vec<Series<T>>,
    /// All points inside the common range and the ends of pieces, by rising x.
    pub rows: Vec<Row<T>>,
    scratch: Scratch<T>,
}

/// A stretch of a smooth piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct Panel<T> {
    piece: usize,
    k: [T; 2],
    /// The points at both ends, of which those inside a piece are not among the rows.
    ends: [Row<T>; 2],
    is_inside: [bool; 2],
    /// Its number among the series; without one it is the cubic between its ends.
    series: Option<usize>,
    /// Uncertainty of the heights, a length.
    pub doubt: T,
    /// Whether anything but the ends has been looked at.
    pub is_sampled: bool,
    /// Halvings in a row that have left it as uncertain.
    vain: usize,
}

impl<T: Real> Panel<T> {
    pub fn x(&self) -> [T; 2] {
        self.ends.map(|end| end.x)
    }

    /// Tells whether more points may leave it less uncertain than by a tolerance.
    pub fn may_gain(&self, tolerance: T) -> bool {
        !self.is_sampled || self.doubt > tolerance && self.vain < MOST_IN_VAIN
    }
}

#[derive(Clone, Debug)]
struct Scratch<T> {
    k: Vec<T>,
    points: Vec<CurvePoint<T>>,
    panels: Vec<Panel<T>>,
    /// Panels to be sampled.
    wanted: Vec<usize>,
}

fn row<T: Real>(end: CurvePoint<T>) -> Row<T> {
    Row { x: end.x, y: end.y, slope: end.dy / end.dx, doubt: T::zero() }
}

impl<T: Real> Body<T> {
    pub fn new() -> Self {
        let scratch =
            Scratch { k: Vec::new(), points: Vec::new(), panels: Vec::new(), wanted: Vec::new() };
        Self { panels: Vec::new(), series: Vec::new(), rows: Vec::new(), scratch }
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
            });
        }
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
        let ask = |panel: &Panel<T>, _: Option<&Series<T>>, cuts: &mut Vec<T>| {
            cuts.extend(panel.is_sampled.then_some(T::zero()));
            is_marked(panel)
        };
        self.split(surface, range, ask, heights)
    }

    /// Splits the panels that `ask` wants at the places t that it names; looks into those without.
    fn split(
        &mut self,
        surface: &Surface<'_, T>,
        range: [T; 2],
        ask: impl Fn(&Panel<T>, Option<&Series<T>>, &mut Vec<T>) -> bool,
        heights: &mut usize,
    ) -> Result<bool, ProfileError<T>> {
        let mut old = std::mem::take(&mut self.scratch.panels);
        std::mem::swap(&mut old, &mut self.panels);
        self.panels.clear();
        self.scratch.wanted.clear();
        let (mut changes, mut cuts) = (false, Vec::new());
        for panel in &old {
            cuts.clear();
            if !ask(panel, panel.series.map(|number| &self.series[number]), &mut cuts) {
                self.panels.push(*panel);
                continue;
            }
            changes = true;
            if cuts.is_empty() {
                let settled = settled(surface, panel);
                if settled.is_none() {
                    self.scratch.wanted.push(self.panels.len());
                }
                self.panels.push(Panel { is_sampled: true, ..settled.unwrap_or(*panel) });
                continue;
            }
            let mut rest = *panel;
            for &t in &cuts {
                let (k, at) = self.place(panel, t);
                let mut part = rest;
                (part.k[1], part.ends[1], part.is_inside[1]) = (k, at, true);
                (rest.k[0], rest.ends[0], rest.is_inside[0]) = (k, at, true);
                rest.series = None;
                self.scratch.wanted.push(self.panels.len());
                self.panels.push(part);
            }
            self.scratch.wanted.push(self.panels.len());
            self.panels.push(rest);
        }
        old.clear();
        self.scratch.panels = old;
        self.sample(surface, range, heights)?;
        if changes {
            self.list(range);
        }
        Ok(changes)
    }

    /// Returns the parameter and the point at a place t of a panel.
    fn place(&self, panel: &Panel<T>, t: T) -> (T, Row<T>) {
        let (one, half, [from, to]) = (T::one(), T::of(0.5), panel.x());
        let k = half * (one - t) * panel.k[0] + half * (one + t) * panel.k[1];
        let even = half * (one - t) * from + half * (one + t) * to;
        let at = panel.series.map_or(Row { x: even, ..panel.ends[0] }, |number| {
            let [x, y, slope] = self.series[number].at_end(t);
            Row { x: if x > from && x < to { x } else { even }, y, slope, doubt: T::zero() }
        });
        (k, at)
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
                let series = Series::new(panel.k, points);
                let is_vain = panel.is_sampled && !(series.doubt <= T::of(0.5) * panel.doubt);
                panel.vain = match is_vain {
                    _ if series.is_exact => MOST_IN_VAIN,
                    true => panel.vain + 1,
                    false => 0,
                };
                (panel.doubt, panel.is_sampled) = (series.doubt, true);
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
            let inner = panel.series.map(|number| &self.series[number].rows[..]).unwrap_or(&[]);
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
            let after = self.rows.partition_point(|row| row.x < x);
            start = after.checked_sub(1).map_or(start, |before| self.rows[before]);
            end = self.rows.get(after).copied().unwrap_or(end);
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
