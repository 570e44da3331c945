//! One panel: sampled with the number of nodes that it needs, and judged.

use super::candidate::Candidate;
use super::{EndProbe, MIN_NODES, PanelSet};
use crate::gap::{CurveSample, Gap, sample_near};
use crate::numerics::chebyshev::{SIZES, Table, by_size};
use crate::profile::Noise;
use crate::quadrature::panels::interpolation::{at_nodes, left_open, missed_at_ends};
use crate::quadrature::panels::panel::{Panel, Resolution, judge};
use crate::{Body, Fallible, Interval, Real, Side};

/// Largest offset of a point from its node, as a share of the distance to the nearest other node:
/// normally, and for a first estimate.
const MAX_OFFSETS: [f64; 2] = [0.1, 0.45];

/// Most halvings of a span to resolve a tip, which shows only in the slope at the end of a piece.
/// (A formula may be wrong there, as signum is at 0.)
const LEVELS_OF_A_TIP: usize = 40;

/// Most halvings of a span to resolve a feature that shows only in the heights. The rest is a step.
pub(super) const LEVELS_OF_A_STEP: usize = 12;

/// Most halvings of a span for derivatives alone, which may have a kink where the slope has none.
const DERIVATIVE_LEVELS: usize = 12;

/// Most measurements of noise on a span where heights contradict the slopes, after a first one.
const MAX_MEASURED: usize = 4;

/// Ratio of the bodies' slopes to the slope of the gap above which their rounding may exceed the
/// tolerance.
const MAX_CANCELLATION: f64 = 4.0;

/// Findings on a sampled panel, in one component of its numbers.
#[derive(Clone, Copy)]
pub(super) struct SampledBody<T> {
    /// Largest slope of the gap.
    slope: T,
    /// Largest sum of the slopes of the two bodies.
    bodies: T,
    /// Error of the slope by the rounding of x, or the noise of X, where the bodies bend sharply.
    noise: T,
    /// Error of the slope by the noise of X alone, where it was measured.
    measured: T,
    /// Error of the bodies' series where their points are not at the nodes. A part that both bodies
    /// share does not show in the series of the gap.
    off: T,
    /// Error of the bodies' series at the ends of their pieces, where the slopes are known.
    missed: T,
}

impl<T: Real> PanelSet<T> {
    /// Samples a panel with the number of nodes that it needs, or marks it to be split.
    pub(super) fn try_out(
        &mut self,
        gap: &Gap<'_, T>,
        trial: &mut Candidate<T>,
    ) -> Fallible<T, ()> {
        let [left, right] = trial.panel.x;
        gap.check_budget(self.spent + self.cost, 1, 0, Interval { left, right })?;
        let first = if trial.sparse && trial.may_be_halved() { MIN_NODES } else { self.initial };
        let mut nodes = Some(if self.coarse { 4 } else { first });
        while let Some(n) = nodes {
            let seen = by_size!(n, N => self.sample_panel::<N>(gap, &mut trial.panel))?;
            nodes = self.judge(trial, &seen);
            if self.coarse {
                // The series of a short panel may be continued a long way.
                trial.panel.drop_noise(T::epsilon() * seen.bodies);
                (trial.split, nodes) = (false, None);
            } else if nodes.is_none() && !trial.split {
                trial.split = self.hides(gap, trial, seen.bodies)?;
                trial.hides = trial.split;
            }
        }
        Ok(())
    }

    /// Estimates the error of a panel; accepts it, marks it to be split, or returns more nodes to
    /// try.
    fn judge(&mut self, trial: &mut Candidate<T>, seen: &SampledBody<T>) -> Option<usize> {
        let (panel, level) = (&mut trial.panel, trial.level);
        let SampledBody { slope, bodies, noise, measured, off, missed } = *seen;
        if level == 0 {
            self.size = self.size.max(slope);
        }
        let (counts, [from, to]) = (level < LEVELS_OF_A_TIP, panel.at_ends());
        // Of an upright end there is no slope to be met.
        let is_upright = T::epsilon().sqrt() * missed > self.size;
        trial.rise = (to - from).abs().max(if is_upright { T::zero() } else { missed });
        let at_limit = if counts { self.missed_at_limits(panel, |_| T::zero()) } else { T::zero() };
        // Next to a singularity the slope may be larger, or noisier, than all that counts
        // elsewhere.
        let allowed = (self.tolerance * self.size.max(slope)).max(noise);
        let rounded = (T::epsilon() * bodies).max(measured);
        let verdict = judge(panel.n, &panel.series, allowed, rounded);
        // More than the noise at a breakpoint: a tip is much narrower than the panel.
        let missed = missed.max(at_limit) - T::epsilon().sqrt() * self.size;
        trial.has_tip = false;
        let (error, mut next, mut split) = match verdict {
            // The first sign of a tip looks like noise.
            Resolution::Good(error) | Resolution::Noise(error)
                if counts && missed > T::of(64.0) * allowed.max(error) =>
            {
                trial.has_tip = true;
                (error, None, true)
            }
            Resolution::Good(error) if off > allowed => (error.max(off), more_than(panel.n), true),
            Resolution::Good(error) => (error.max(off), None, false),
            Resolution::Noise(size) => {
                panel.drop_noise(size);
                (size, None, false)
            }
            Resolution::Take(next, error) => (error, Some(next), true),
            Resolution::Split(error) => (error, None, true),
        };
        (panel.error, panel.noise, trial.derivatives) = (error, noise, T::zero());
        // More nodes do not help the derivatives on a panel that must be split anyway.
        if T::COMPONENTS > 1 && (next.is_some() || !split) {
            let noisy = matches!(verdict, Resolution::Noise(_));
            let (more, off) = self.judge_derivatives(panel, level);
            next = next.max(more);
            if next.is_none() && !noisy && level < DERIVATIVE_LEVELS && off > T::zero() {
                (split, trial.derivatives) = (true, off);
            }
        }
        (trial.allowed, trial.split) = (allowed, split);
        next
    }

    /// Tells whether the heights contradict the slopes by more than their noise, because a feature
    /// is too narrow for the nodes. The noise is measured only after a contradiction.
    fn hides(
        &mut self,
        gap: &Gap<'_, T>,
        trial: &mut Candidate<T>,
        steepest: T,
    ) -> Fallible<T, bool> {
        let panel = &mut trial.panel;
        let heights = self.beside_noise(
            gap,
            |row| by_size!(panel.n, N => row.check_heights::<N>(panel, steepest)),
        );
        // Next to a step in the heights any difference is large.
        if heights.is_err() && !trial.hides {
            self.check_slopes(gap)?;
        }
        let hides = heights.is_err();
        if trial.level >= LEVELS_OF_A_STEP { heights.map(|()| false) } else { Ok(hides) }
    }

    /// Repeats a failed check of heights with the noise measured.
    pub(super) fn beside_noise(
        &mut self,
        gap: &Gap<'_, T>,
        mut check: impl FnMut(&Self) -> Fallible<T, ()>,
    ) -> Fallible<T, ()> {
        let mut heights = check(self);
        for by_rounding in [false, true] {
            if heights.is_err() && self.measure_noise(gap, by_rounding) {
                heights = check(self);
            }
        }
        heights
    }

    /// Raises the error estimates of accepted panels. They may miss the slope at a given limit; and
    /// if a loose tolerance accepts them, the next coefficients may fall more slowly, as for a root
    /// hidden behind a smooth part. (Only after neighbours have been compared: larger errors would
    /// hide a mismatch.)
    pub fn own_up(&mut self, gap: &Gap<'_, T>) {
        let is_loose = self.is_loose();
        if !is_loose && self.held.into_iter().all(|held| held.is_none()) {
            return;
        }
        for i in 0..self.panels.len() {
            let at_limit = self.missed_at_limits(&self.panels[i], |x| gap.added_slope(x));
            let panel = &mut self.panels[i];
            if at_limit > T::of(64.0) * panel.error {
                panel.error = at_limit;
            }
            if let ([.., before, last], true) = (&panel.series[..panel.n], is_loose) {
                panel.error = panel.error.max(T::of(0.25) * before.abs().max(last.abs()));
            }
        }
    }

    /// Returns the error of a panel's slope at given limits, with the slope added by tilt and bend.
    fn missed_at_limits(&self, panel: &Panel<T>, added: impl Fn(T) -> T) -> T {
        let at_end = |(held, end): (Option<EndProbe<T>>, T)| {
            let held = held.filter(|held| held.limit == end && !self.coarse)?;
            Some((panel.value(held.x) - added(held.x) - held.slope).abs())
        };
        self.held.into_iter().zip(panel.x).filter_map(at_end).fold(T::zero(), T::max)
    }

    /// Judges the derivatives that dual numbers carry. Returns the number of nodes that they need
    /// and, if more nodes would not help, their relative error.
    fn judge_derivatives(&mut self, panel: &Panel<T>, level: usize) -> (Option<usize>, T) {
        let (mut next, mut worst) = (None, T::zero());
        self.derivative_sizes.resize(self.derivatives.len(), T::zero());
        for (i, seen) in self.derivatives.iter().enumerate() {
            let largest = &mut self.derivative_sizes[i];
            if level == 0 {
                *largest = largest.max(seen.slope);
            }
            let size = largest.max(seen.slope);
            let allowed = (self.tolerance * size).max(seen.noise);
            let series = panel.series.map(|a| a.component(i + 1));
            match judge(panel.n, &series, allowed, T::epsilon() * seen.bodies) {
                Resolution::Good(_) if seen.off > allowed => {
                    next = next.max(more_than(panel.n));
                }
                Resolution::Take(more, _) => next = next.max(Some(more)),
                Resolution::Split(error) => worst = worst.max(error / size),
                Resolution::Good(_) | Resolution::Noise(_) => {}
            }
        }
        (next, worst)
    }

    /// Samples one panel with N nodes.
    pub(super) fn sample_panel<const N: usize>(
        &mut self,
        gap: &Gap<'_, T>,
        panel: &mut Panel<T>,
    ) -> Fallible<T, SampledBody<T>> {
        let x = panel.x;
        let table = if self.coarse { Table::coarse() } else { Table::of(N) };
        let (half, zero) = (T::of(0.5), T::zero());
        let (centre, reach) = (half * x[0] + half * x[1], half * (x[1] - x[0]));
        // Never at the very end of a body, where the slope may be infinite.
        let inside = if self.coarse { zero } else { T::epsilon() };
        let [first, last] = [x[0] + inside * x[0].abs(), x[1] - inside * x[1].abs()];
        // A sliver of a few units in the last place has no inside.
        let [first, last] = if first <= last { [first, last] } else { [centre, centre] };
        let offsets: [T; N] = std::array::from_fn(|i| reach * T::of(table.z[i]));
        let nodes = offsets.map(|offset| (centre + offset).max(first).min(last));
        let near = T::of(MAX_OFFSETS[usize::from(self.coarse)]) * reach;
        let room: [T; N] = std::array::from_fn(|i| near * T::of(table.spacing[i]));
        let beside = |noise: Noise<T>| room.map(|room| room.max(noise.x));
        let rooms = self.noise.map_or([room; 2], |noise| noise.map(beside));
        let [lower, upper] = self.slopes_at(gap, x, &offsets, &nodes, &rooms)?;
        self.cost.samples += N;
        let slopes: [T; N] = std::array::from_fn(|i| upper[i] - lower[i]);
        let mut seen = self.seen(x, &nodes, reach, [&lower, &upper]);
        // Unless the bodies are much steeper than the gap, their rounding is far below the
        // tolerance.
        let steep = seen.bodies > T::of(MAX_CANCELLATION) * seen.slope;
        let sums = (0..if steep { N } else { 0 }).map(|i| upper[i].abs() + lower[i].abs());
        self.least = sums.reduce(T::min).map_or(zero, |least| least.min(self.least));
        for (kept, slopes) in self.slopes.iter_mut().zip([&lower, &upper]) {
            kept[..N].copy_from_slice(slopes);
        }
        for (slopes, trace) in [&lower, &upper].into_iter().zip(&self.traces) {
            seen.missed = seen.missed.max(missed_at_ends(x, trace, slopes, self.coarse));
        }
        panel.fall = (1..N).fold(zero, |most, i| most.max(slopes[i - 1] - slopes[i]));
        panel.series[..N].copy_from_slice(&table.coefficients(&slopes));
        panel.count(N);
        self.derivatives.clear();
        for part in 1..T::COMPONENTS {
            let [lower, upper] =
                [&lower, &upper].map(|slopes| slopes.map(|slope| slope.component(part)));
            let seen = self.seen(x, &nodes, reach, [&lower, &upper]);
            self.derivatives.push(seen);
        }
        Ok(seen)
    }

    /// Samples both bodies near places in a panel, and returns their slopes there. `offsets` are
    /// the places relative to the middle of the panel, before rounding.
    #[inline(always)]
    pub(super) fn slopes_at<const N: usize>(
        &mut self,
        gap: &Gap<'_, T>,
        x: [T; 2],
        offsets: &[T; N],
        places: &[T; N],
        rooms: &[[T; N]; 2],
    ) -> Fallible<T, [[T; N]; 2]> {
        let bodies = [Body::Lower, Body::Upper].into_iter().zip(rooms);
        for ((body, room), trace) in bodies.zip(&mut self.traces) {
            sample_near(gap, body, places, room, trace, self.coarse, &mut self.cost)?;
        }
        let reach = T::of(0.5) * (x[1] - x[0]);
        let wanted = offsets.map(|offset| reach + offset);
        Ok([0, 1].map(|i| at_nodes(&wanted, &self.traces[i], x[0], reach)))
    }

    /// Measures the noise of both bodies where they were last sampled, unless it was measured often
    /// enough. Tells whether it exceeds rounding and earlier measurements.
    pub(super) fn measure_noise(&mut self, gap: &Gap<'_, T>, by_rounding: bool) -> bool {
        if self.measured > if by_rounding { MAX_MEASURED } else { 0 } {
            return false;
        }
        self.measured += 1;
        let halves = if by_rounding { 0..=2 } else { 1..=1 };
        let mut noise = self.noise.unwrap_or([Noise::zero_tolerance(); 2]);
        let mut counts = false;
        for (i, body) in [Body::Lower, Body::Upper].into_iter().enumerate() {
            let samples = self.traces[i].curve_samples();
            if self.traces[i].direct || samples.is_empty() {
                continue;
            }
            for half in halves.clone() {
                let CurveSample { k, x, y, .. } =
                    samples[(half * samples.len() / 2).min(samples.len() - 1)];
                let (_, piece) = gap.piece_at(body, x, Side::Left);
                let evaluations = &mut self.cost.evaluations;
                let measured = if by_rounding {
                    gap.noise(body, &piece, k, evaluations)
                } else {
                    Noise::near(&piece, k, evaluations)
                };
                let beyond_rounding = |noise: T, value: T| {
                    let is_more = noise > T::of(4.0) * T::epsilon() * value.abs();
                    if is_more { noise } else { T::zero() }
                };
                let measured =
                    Noise { x: beyond_rounding(measured.x, x), y: beyond_rounding(measured.y, y) };
                counts |= measured.x > noise[i].x || measured.y > noise[i].y;
                noise[i] = noise[i].max(measured);
            }
        }
        if counts {
            self.noise = Some(noise);
        }
        counts
    }

    /// Returns the findings from the slopes of both bodies at the nodes.
    fn seen<const N: usize>(
        &self,
        x: [T; 2],
        nodes: &[T; N],
        reach: T,
        [lower, upper]: [&[T; N]; 2],
    ) -> SampledBody<T> {
        let zero = T::zero();
        let off = [(lower, 0), (upper, 1)]
            .map(|(slopes, i)| left_open(nodes, &self.traces[i], reach, slopes, self.coarse));
        let off = off[0].max(off[1]);
        let (slope, bodies, noise, measured, missed) = (zero, zero, zero, zero, zero);
        let mut seen = SampledBody { slope, bodies, noise, measured, off, missed };
        for i in 0..N {
            seen.slope = seen.slope.max((upper[i] - lower[i]).abs());
            seen.bodies = seen.bodies.max(upper[i].abs() + lower[i].abs());
        }
        let bend = |slopes: &[T; N]| (slopes[N - 1] - slopes[0]).abs();
        let rounded = T::epsilon() * x[0].abs().max(x[1].abs());
        let length = nodes[N - 1] - nodes[0];
        if let Some([of_lower, of_upper]) = self.noise {
            seen.measured = (of_lower.x * bend(lower) + of_upper.x * bend(upper)) / length;
        }
        seen.noise = (rounded * (bend(lower) + bend(upper)) / length).max(seen.measured);
        seen
    }
}

/// Returns the next larger number of nodes.
fn more_than(n: usize) -> Option<usize> {
    SIZES.into_iter().find(|&more| more > n)
}
