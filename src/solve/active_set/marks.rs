//! Cells in which contacts are not yet resolved, and the contacts that cells show.

use super::{ActiveSet, Coarse, MAX_OF_KERNEL};
use crate::{Ends, Interval, Real};

/// Least width of the cells at a narrow gap in a contact, as a share of the contact.
const FINEST_CELL: f64 = 1.0 / 40.0;

/// Least width of a cell that is cut for known heights, as a share of their spacing.
const LEAST_CUT: f64 = 1.0 / 16.0;

/// Least gap between two runs, as a share of the wider one; closer runs are one.
const LEAST_GAP_OF_CELLS: f64 = 1e-3;

impl<T: Real> ActiveSet<'_, T> {
    /// Returns the first and last cell of each run of loaded cells.
    pub(super) fn runs(&self) -> Vec<[usize; 2]> {
        let mut runs: Vec<[usize; 2]> = Vec::new();
        for (i, _) in self.cells.iter().enumerate().filter(|(_, cell)| cell.loaded) {
            match runs.last_mut() {
                Some(run) if run[1] + 1 == i => run[1] = i,
                _ => runs.push([i, i]),
            }
        }
        runs
    }

    /// Marks the cells in which the contact is not yet resolved.
    pub(super) fn marks(&self, known: &[[T; 2]]) -> Vec<bool> {
        let n = self.cells.len();
        let mut marks = vec![false; n];
        let width = |[from, to]: [usize; 2]| self.cells[to].right - self.cells[from].left;
        let mut mark = |from: usize, to: usize| marks[from..=to.min(n - 1)].fill(true);
        let runs = self.runs();
        let widths = runs.iter().map(|&run| width(run)).fold(T::zero(), |sum, width| sum + width);
        let too_many = widths / T::count(MAX_OF_KERNEL);
        for &run in &runs {
            let [from, to] = run;
            if let Some(length) = self.length {
                let coarse = from.saturating_sub(1)..=(to + 1).min(n - 1);
                let is_wide = |&i: &usize| self.cells[i].width() > length.max(too_many);
                coarse.filter(is_wide).for_each(|i| mark(i, i));
            }
            if to + 1 - from < self.cells_of_a_run {
                mark(from.saturating_sub(1), to + 1);
            }
            // A valley of the pressure may be a gap.
            for i in from + 1..to {
                let [before, at, after] = [i - 1, i, i + 1].map(|i| self.cells[i].pressure());
                let deep = T::of(3.0) * at < before.min(after);
                if deep && self.cells[i].width() > T::of(FINEST_CELL) * width(run) {
                    mark(i - 1, i + 1);
                }
            }
        }
        for pair in runs.windows(2) {
            let [left, right] = [pair[0], pair[1]];
            let (from, to) = (left[1] + 1, right[0] - 1);
            let narrower = width(left).min(width(right));
            if from == to && self.cells[from].width() > T::of(FINEST_CELL) * narrower {
                mark(from - 1, to + 1);
            }
        }
        // A minimum of the open gap that may close: it is lower than its rise to a neighbour, which
        // is more than the last solve leaves uncertain.
        let gap = |i: usize| self.gap(i);
        for i in (0..n).filter(|&i| !self.cells[i].loaded) {
            let beside = [i.checked_sub(1), Some(i + 1).filter(|&next| next < n)];
            let beside = beside.map(|j| j.map(|j| (j, gap(j), self.cells[j].loaded)));
            let minimum = |&(_, there, loaded): &(usize, T, bool)| !loaded && there >= gap(i);
            let highest = beside.iter().flatten().fold(gap(i), |high, there| high.max(there.1));
            let (rise, least) = (highest - gap(i), gap(i).max(self.uncertainty));
            if !beside.iter().flatten().all(minimum) || rise < least {
                continue;
            }
            // In a wider neighbour the gap may be lower than in its middle.
            let others = beside.iter().flatten().map(|there| there.0);
            let times = |j: usize| self.cells[j].width() / self.cells[i].width();
            if others.clone().filter(|&j| times(j) > T::of(1.5)).map(|j| mark(j, j)).count() == 0 {
                let lower =
                    others.reduce(|one, other| if gap(other) < gap(one) { other } else { one });
                lower.into_iter().for_each(|j| mark(i.min(j), i.max(j)));
            }
        }
        self.mark_by(known, &mut marks);
        marks
    }

    /// Marks cells whose centres miss features of the known heights inside.
    fn mark_by(&self, known: &[[T; 2]], marks: &mut [bool]) {
        let Some(lowest) = self.lowest().map(|lowest| self.cells[lowest].height) else { return };
        let [first, end] = self.range;
        let (mut i, mut before) = (0, None);
        for (k, &[x, height]) in known.iter().enumerate() {
            let [x, height] = [x, height].map(|value| value.component(0));
            if !(x > first && x < end) {
                continue;
            }
            while i + 1 < self.cells.len() && self.cells[i].right <= x {
                i += 1;
            }
            let cell = &self.cells[i];
            // Heights say nothing of cells much shorter than their spacing.
            let beside = known[(k + 1).min(known.len() - 1)][0] - known[k.saturating_sub(1)][0];
            if cell.width() < T::of(LEAST_CUT) * beside.component(0) {
                continue;
            }
            let sunk = self.level + self.slope * self.arm(x) - self.potential_at(x, i);
            let gap = self.rise_of(height, lowest) - sunk;
            let around = &self.cells[i.saturating_sub(1)..(i + 2).min(self.cells.len())];
            let pressure = around.iter().fold(T::zero(), |most, cell| most.max(cell.pressure()));
            if !cell.loaded {
                marks[i] |= gap < -T::of(0.1) * pressure * cell.width();
                before = None;
                continue;
            }
            // The gap is closed at the centre.
            for (there, gap_there) in before.into_iter().chain([(cell.centre(), T::zero())]) {
                let (along, rise) = ((x - there).abs(), (gap - gap_there).abs());
                // A wave of this slope has pressures of up to 1/π of it.
                marks[i] |= along > cell.width() / T::of(64.0)
                    && rise > T::of(0.5) * T::pi() * pressure * along;
            }
            if before.is_none_or(|(there, _)| x - there > cell.width() / T::of(64.0)) {
                before = Some((x, gap));
            }
        }
    }

    /// Returns the potential at a place in a cell, linear between the centres.
    fn potential_at(&self, x: T, i: usize) -> T {
        let aside = x - self.cells[i].centre();
        let beside = if aside < T::zero() { i.checked_sub(1) } else { Some(i + 1) };
        match beside.and_then(|j| Some((j, self.cells.get(j)?))) {
            Some((j, other)) => {
                let share = aside / (other.centre() - self.cells[i].centre());
                self.potential[i] + share * (self.potential[j] - self.potential[i])
            }
            None => self.potential[i],
        }
    }

    /// Returns the contacts found.
    pub(super) fn found(&self) -> Coarse<T> {
        let (intervals, runs) = (self.intervals(), self.runs());
        let last = self.cells.len().saturating_sub(1);
        let reaches = Ends {
            left: runs.first().is_some_and(|run| run[0] == 0),
            right: runs.last().is_some_and(|run| run[1] == last),
        };
        let tilt = -self.slope * self.load / (self.kappa * (self.range[1] - self.range[0]));
        Coarse { intervals, tilt, reaches }
    }

    /// Returns the runs as intervals.
    pub(super) fn intervals(&self) -> Vec<Interval<T>> {
        let runs = self.runs();
        let last = self.cells.len().saturating_sub(1);
        let interval = |&[from, to]: &[usize; 2]| {
            let run = &self.cells[from..=to];
            let left = if from == 0 {
                self.range[0]
            } else {
                -edge(run.iter().map(|cell| [-cell.right, -cell.left, cell.force]))
            };
            let right = if to == last {
                self.range[1]
            } else {
                edge(run.iter().rev().map(|cell| [cell.left, cell.right, cell.force]))
            };
            Interval { left, right }
        };
        let mut intervals: Vec<_> = runs.iter().map(interval).collect();
        // An edge lies at most a third of the way to the next run.
        for (i, pair) in runs.windows(2).enumerate() {
            let [from, to] = [self.cells[pair[0][1]].right, self.cells[pair[1][0]].left];
            let third = (to - from) / T::of(3.0);
            intervals[i].right = intervals[i].right.min(from + third);
            intervals[i + 1].left = intervals[i + 1].left.max(to - third);
        }
        // Where the pressure nearly vanishes, rounding parts cells: runs this close are one.
        let mut apart: Vec<Interval<T>> = Vec::with_capacity(intervals.len());
        let is_close = |before: &Interval<T>, on: &Interval<T>| {
            let wider = (on.right - on.left).max(before.right - before.left);
            on.left - before.right < T::of(LEAST_GAP_OF_CELLS) * wider
        };
        for mut on in intervals {
            // A wide one takes in all that are close to it, on either side.
            while let Some(before) = apart.pop_if(|before| is_close(before, &on)) {
                on.left = before.left;
            }
            apart.push(on);
        }
        apart
    }
}

/// Returns the right edge of a run, from its cells `[left, right, force]` from right to left: the
/// load of the cells beyond a place grows as the power 3/2 of its distance from the edge. Cells of
/// constant pressure deviate a little: for Hertz's contact the edge is at a quarter of the
/// outermost cell and three quarters of this distance.
fn edge<T: Real>(mut cells: impl Iterator<Item = [T; 3]>) -> T {
    let Some([near, right, outermost]) = cells.next() else { return T::zero() };
    let Some([far, _, next]) = cells.next() else { return right };
    let ratio = (outermost / (outermost + next)).powf(T::of(2.0 / 3.0));
    let extrapolated = (near - far) * ratio / (T::one() - ratio);
    let edge = near + T::of(0.25) * (right - near) + T::of(0.75) * extrapolated;
    // The edge is in the outermost cell, or not far into the next one, which is open.
    let furthest = right + T::of(0.5) * (right - near);
    if edge.is_finite() { edge.max(near).min(furthest) } else { right }
}
