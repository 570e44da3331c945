//! Row of panels that covers a span of x: sampled once, extended on demand.

mod candidate;
mod declared;
mod derivative_check;
mod probing;
mod sampling;

pub(crate) use derivative_check::Rises;

use super::panel::Panel;
use crate::gap::{Added, Cost, Gap, SampleCache, Sampler, Survey};
use crate::numerics::chebyshev::{Coeffs, MAX_SIZE, size_for};
use crate::profile::Noise;
use crate::{Body, ContactError, Ends, Fallible, Interval, Real, Side};
use candidate::{Candidate, FALL_OF_A_ROOT, FEW_ULPS, LEVELS_OF_A_WAVE, MAX_AT_JUMP, is_long};
use num_traits::ToPrimitive;
use sampling::{LEVELS_OF_A_STEP, SampledBody};

/// Fewest nodes of a panel after the first estimate. On a span a little wider than a contact, the
/// outermost of eight nodes lie beyond the limits; of four they would not.
pub(super) const MIN_NODES: usize = 8;

/// Lowest tolerance, in units in the last place.
pub(super) const LEAST_ULPS: f64 = 16.0;

/// Most splits of a span between two breakpoints.
const MAX_SPLITS: usize = 4096;

/// Level of halving from which large noise counts as noise: before, it may be a wave that is not
/// resolved yet.
const NOISY_LEVEL: usize = 4;

/// Share of an error that both halves keep where halving does not help; the noise is then measured.
const NO_GAIN: f64 = 0.25;

/// Number of panels beyond twice the first number at which the next solve covers the span anew.
/// (Each extension adds one or more, and every panel costs time in each evaluation.)
const MAX_ADDED: usize = 6;

/// Share of a span, from its left end, at which it is split if its heights contradict its slopes: a
/// step may lie in the middle.
const SPLIT_OFF_CENTRE: f64 = 0.46;

/// Share of a panel on which an unresolved wave is smooth and noise is not.
const SHARE_OF_A_WAVE: f64 = 1.0 / 4096.0;

/// Slope of the gap next to a given limit, where a row of panels ends.
#[derive(Clone, Copy)]
pub(crate) struct EndProbe<T> {
    pub limit: T,
    /// Point as close to the limit as rounding can tell apart, and the slope there.
    x: T,
    slope: T,
}

/// Row of panels, from left to right without gaps.
#[derive(Clone)]
pub(crate) struct PanelSet<T> {
    pub panels: Vec<Panel<T>>,
    /// Number of panels when the span was first covered, or covered anew.
    at_first: usize,
    /// True if the next extension covers the whole span anew.
    is_cut_up: bool,
    /// Candidates still to be accepted or split, the leftmost last.
    waiting: Vec<Candidate<T>>,
    traces: [SampleCache<T>; 2],
    /// Noise of both bodies on the span last resolved, if more than rounding, and the number of its
    /// measurements there.
    noise: Option<[Noise<T>; 2]>,
    measured: usize,
    /// Largest slope of the gap on spans before any halving.
    pub size: T,
    /// Smallest sum of the slopes of both bodies at any node if all panels find the bodies much
    /// steeper than the gap; otherwise zero.
    pub least: T,
    /// Number of nodes to start a panel with.
    pub initial: usize,
    /// Flag: only a first estimate is wanted, with four nodes whatever the coefficients.
    pub coarse: bool,
    pub tolerance: T,
    pub cost: Cost,
    /// Cost of the same search on other contacts.
    pub spent: Cost,
    /// Slopes sampled beforehand at given limits.
    pub held: Ends<Option<EndProbe<T>>>,
    /// Findings on the last panel in each derivative of dual numbers; `derivative_sizes` has the
    /// largest slopes of the first.
    derivatives: Vec<SampledBody<T>>,
    /// Slopes of both bodies at the nodes of the last panel.
    slopes: [Coeffs<T>; 2],
    derivative_sizes: Vec<T>,
    /// Tilt and bend of every panel, and the panels of the bodies as described, if there is either.
    added: Added<T>,
    described: Vec<Panel<T>>,
}

impl<T: Real> PanelSet<T> {
    pub fn new(tolerance: T) -> Self {
        Self {
            panels: Vec::new(),
            at_first: 0,
            is_cut_up: false,
            waiting: Vec::new(),
            traces: [SampleCache::new(), SampleCache::new()],
            noise: None,
            measured: 0,
            size: T::zero(),
            least: T::one() / T::zero(),
            initial: MIN_NODES,
            coarse: false,
            tolerance,
            cost: Cost::default(),
            spent: Cost::default(),
            held: Ends::both(None),
            derivatives: Vec::new(),
            slopes: [[T::zero(); MAX_SIZE]; 2],
            derivative_sizes: Vec::new(),
            added: Added::nothing(),
            described: Vec::new(),
        }
    }

    /// Forgets the panels; keeps the curves' last points if the bodies are the same.
    pub fn clear(&mut self, same_bodies: bool) {
        self.panels.clear();
        self.described.clear();
        self.added = Added::nothing();
        (self.is_cut_up, self.initial) = (false, MIN_NODES);
        (self.size, self.least) = (T::zero(), T::one() / T::zero());
        self.derivative_sizes.clear();
        if !same_bodies {
            self.traces.iter_mut().for_each(SampleCache::clear);
            self.held = Ends::both(None);
        }
    }

    /// Takes guides to the parameters of either body from a survey, for an interval.
    pub fn guide(&mut self, look: &Survey<T>, on: Interval<T>) {
        for (body, trace) in [Body::Lower, Body::Upper].into_iter().zip(&mut self.traces) {
            look.guide(body, on, &mut trace.guides);
        }
    }

    /// Decides, before the next solve with the same bodies, whether to cover the span anew.
    pub fn look_back(&mut self) {
        self.is_cut_up = self.as_described().len() > 2 * self.at_first + MAX_ADDED;
    }

    /// Samples the slope next to a given limit, unless it is at the end of a piece, where more is
    /// known.
    pub fn look_at(&mut self, gap: &Gap<'_, T>, end: Side, limit: T) -> Option<EndProbe<T>> {
        let [from, to] = gap.range();
        if !(limit > from && limit < to) || gap.is_breakpoint(limit) {
            return None;
        }
        // At the limit itself the user's formula may already be the one for the far side.
        let fine = T::of(4.0) * T::epsilon();
        let inward = fine * limit.abs().max((to - from).min(T::one() / fine));
        let x = match end {
            Side::Left => limit + inward,
            Side::Right => limit - inward,
        };
        // A point beyond a breakpoint says nothing about the limit.
        if gap.breakpoint_after(x.min(limit)).is_some_and(|next| next < x.max(limit)) {
            return None;
        }
        let mut sampler = Sampler::default();
        let slope = sampler.slope_as_described(gap, x, Side::Left);
        self.cost += sampler.cost;
        slope.ok().map(|slope| EndProbe { limit, x, slope })
    }

    /// Returns the covered interval.
    pub fn interval(&self) -> Option<Interval<T>> {
        let (first, last) = (self.panels.first()?, self.panels.last()?);
        Some(Interval { left: first.x[0], right: last.x[1] })
    }

    pub fn covers(&self, on: Interval<T>) -> bool {
        self.interval().is_some_and(|have| have.left <= on.left && have.right >= on.right)
    }

    /// Tells whether an outermost panel that starts at a breakpoint is much longer than its part
    /// inside an interval.
    pub fn overshoots(&self, gap: &Gap<'_, T>, on: Interval<T>) -> bool {
        let panels = self.as_described();
        let [Some(first), Some(last)] = [panels.first(), panels.last()] else { return false };
        let much = T::of(1.25);
        let beside = |breakpoint: T, reach: T, needed: T| {
            reach > much * needed && gap.is_breakpoint(breakpoint)
        };
        beside(first.x[1], first.x[1] - first.x[0], first.x[1] - on.left)
            || beside(last.x[0], last.x[1] - last.x[0], on.right - last.x[0])
    }

    /// Returns the slope at `x`, from the nearest panel.
    pub fn slope(&self, x: T) -> Option<T> {
        self.panel_at(x).map(|panel| panel.value(x))
    }

    /// Returns the uncertainty of the slope at `x`.
    pub fn doubt(&self, x: T) -> Option<T> {
        self.panel_at(x).map(|panel| panel.error + self.tolerance * self.size)
    }

    fn panel_at(&self, x: T) -> Option<&Panel<T>> {
        let last = self.panels.len().checked_sub(1)?;
        Some(&self.panels[self.panels.partition_point(|panel| panel.x[1] < x).min(last)])
    }

    /// Returns the panels of the bodies as described.
    pub fn as_described(&self) -> &[Panel<T>] {
        if self.described.is_empty() { &self.panels } else { &self.described }
    }

    /// Turns and bends the panels with the bodies, which costs no sample; tells whether anything
    /// has changed.
    pub fn add(&mut self, gap: &Gap<'_, T>) -> bool {
        let added = gap.added();
        if self.added.is(&added) {
            return false;
        }
        self.take_off();
        if !added.is(&Added::nothing()) {
            std::mem::swap(&mut self.panels, &mut self.described);
            for panel in &self.described {
                panel.push_with_added(gap, &mut self.panels);
            }
        }
        self.added = added;
        true
    }

    /// Takes off tilt and bend.
    fn take_off(&mut self) {
        if !self.described.is_empty() {
            std::mem::swap(&mut self.panels, &mut self.described);
            self.described.clear();
        }
        self.added = Added::nothing();
    }

    /// Covers an interval, sampling only what is missing.
    pub fn extend(&mut self, gap: &Gap<'_, T>, on: Interval<T>) -> Result<(), ContactError<T>> {
        let [from, to] = gap.range();
        let on = Interval { left: on.left.max(from), right: on.right.min(to) };
        if !self.covers(on) {
            self.take_off();
            self.extend_as_described(gap, on)?;
            self.check_declared(gap)?;
        }
        self.add(gap);
        Ok(())
    }

    fn extend_as_described(&mut self, gap: &Gap<'_, T>, on: Interval<T>) -> Fallible<T, ()> {
        let Some(have) = self.interval() else {
            self.sample(gap, on, 0, None)?;
            self.at_first = self.panels.len();
            return Ok(());
        };
        // Extend by a sliver at least, but at most half-way to the end of the bodies.
        let ([from, to], half, sliver) = (gap.range(), T::of(0.5), T::of(0.0625));
        let further = |left: T, right: T| {
            let left = if on.left < have.left { on.left.min(left) } else { have.left };
            let right = if on.right > have.right { on.right.max(right) } else { have.right };
            let left = left.max(half * on.left.min(have.left) + half * from);
            Interval { left, right: right.min(half * on.right.max(have.right) + half * to) }
        };
        if self.is_cut_up {
            let more = sliver * (have.right - have.left);
            return self.sample_anew(gap, further(on.left - more, on.right + more));
        }
        let (first, last) = (self.panels[0], self.panels[self.panels.len() - 1]);
        let more = |panel: &Panel<T>| sliver * (panel.x[1] - panel.x[0]);
        let Interval { left, right } = further(have.left - more(&first), have.right + more(&last));
        let enough = |panel: &Panel<T>| size_for(panel.length / 2).max(MIN_NODES);
        // A feature beyond the last node of the outermost panel shows at the new neighbour, unless
        // a breakpoint lies between them.
        if right > have.right {
            self.initial = enough(&last);
            let apart = gap.breakpoint_after(last.x[0]) == Some(have.right);
            let known = self.panels.len() - usize::from(!apart);
            self.sample(gap, Interval { left: have.right, right }, known, None)?;
        }
        if left < have.left {
            self.initial = enough(&first);
            let apart = gap.breakpoint_before(first.x[1]) == Some(have.left);
            let neighbour = (!apart).then(|| self.panels.remove(0));
            let known = self.panels.len();
            self.sample(gap, Interval { left, right: have.left }, known, neighbour)?;
            self.panels.rotate_left(known);
        }
        Ok(())
    }

    /// Covers an interval alone, with [`MIN_NODES`] nodes or more between two breakpoints.
    pub fn sample_anew(
        &mut self,
        gap: &Gap<'_, T>,
        on: Interval<T>,
    ) -> Result<(), ContactError<T>> {
        self.clear(true);
        self.extend(gap, on)
    }

    /// Samples an interval and appends its panels. They should meet the panels from number `known`
    /// on, and the neighbour on the right, which is appended after them.
    fn sample(
        &mut self,
        gap: &Gap<'_, T>,
        on: Interval<T>,
        known: usize,
        neighbour: Option<Panel<T>>,
    ) -> Fallible<T, ()> {
        let (mut left, mut known) = (on.left, known);
        loop {
            let breakpoint = gap.breakpoint_after(left).filter(|&breakpoint| breakpoint < on.right);
            let right = breakpoint.unwrap_or(on.right);
            let neighbour = neighbour.filter(|_| breakpoint.is_none());
            self.resolve(gap, [left, right], known, neighbour)?;
            if breakpoint.is_none() {
                return Ok(());
            }
            (left, known) = (right, self.panels.len());
        }
    }

    /// Samples a span without breakpoints.
    fn resolve(
        &mut self,
        gap: &Gap<'_, T>,
        x: [T; 2],
        begin: usize,
        neighbour: Option<Panel<T>>,
    ) -> Fallible<T, ()> {
        self.waiting.clear();
        // The noise measured last belongs to other pieces, or to other parts of these.
        (self.noise, self.measured) = (None, 0);
        let mut trial = Candidate::new(x);
        self.try_out(gap, &mut trial)?;
        if let Some(panel) = neighbour {
            let allowed = self.tolerance * self.size;
            self.waiting.push(Candidate { panel, allowed, ..Candidate::new(panel.x) });
        }
        let mut splits = 0;
        loop {
            let [left, right] = trial.panel.x;
            // A step in the heights may well lie in the middle, where neither half would show it.
            let share = T::of(if trial.hides { SPLIT_OFF_CENTRE } else { 0.5 });
            let middle = (T::one() - share) * left + share * right;
            let may =
                splits < MAX_SPLITS && trial.may_be_halved() && is_long(trial.panel.x, self.noise);
            if trial.split && may {
                splits += 1;
                let level = trial.level + 1;
                let Candidate { wave, hides, .. } = trial;
                let sparse = trial.sparse || !self.is_loose() && trial.has_kink();
                let rose = [trial.rise, trial.rose[0]];
                let half = |x| Candidate { level, wave, hides, sparse, rose, ..Candidate::new(x) };
                let [mut one, mut other] = [half([left, middle]), half([middle, right])];
                self.try_out(gap, &mut one)?;
                self.try_out(gap, &mut other)?;
                for half in [&mut one, &mut other] {
                    let less = T::of(FALL_OF_A_ROOT) * trial.panel.error;
                    half.falls = half.panel.error <= less || half.panel.n != trial.panel.n;
                    half.sparse |= half.split && half.panel.error >= T::of(2.0) * trial.panel.error;
                }
                // Noise is as large in both halves. So is a wave that is not resolved yet, as long
                // as it is not faint.
                let faint = trial.panel.error <= T::of(1e-6) * self.size || level >= NOISY_LEVEL;
                let is_stuck = |half: &Candidate<T>| {
                    half.split
                        && !half.has_tip
                        && half.panel.error >= T::of(NO_GAIN) * trial.panel.error
                };
                if faint && is_stuck(&one) && is_stuck(&other) && self.measure_noise(gap, false) {
                    self.try_out(gap, &mut trial)?;
                    continue;
                }
                // A much larger error is not noise: a half with fewer nodes was given up earlier,
                // or the whole has missed a feature.
                let as_much = |half: &Candidate<T>| {
                    let ratio = half.panel.error / trial.panel.error;
                    let by_value = ratio >= T::of(0.8) && ratio <= T::of(64.0);
                    let by_derivative = half.derivatives >= T::of(0.8) * trial.derivatives;
                    let derived = half.derivatives > T::zero();
                    half.split
                        && !half.hides
                        && !half.has_tip
                        && if derived { by_derivative } else { by_value }
                };
                if faint && as_much(&one) && as_much(&other) {
                    let derived = one.derivatives > T::zero() || other.derivatives > T::zero();
                    let wave = !derived && level < LEVELS_OF_A_WAVE;
                    let wave = wave && (trial.wave || !self.is_noisy(gap, &trial.panel)?);
                    (one.wave, other.wave) = (wave, wave);
                    (one.split, other.split) = (wave, wave);
                }
                self.waiting.push(other);
                trial = one;
                continue;
            }
            if trial.split && !is_long(trial.panel.x, self.noise) {
                trial.panel.straighten();
            }
            // A feature between the last node and the end of a panel shows at its neighbour.
            let before = (self.panels.len() > begin).then(|| self.panels[self.panels.len() - 1]);
            let step = match &before {
                Some(before) if !self.coarse => {
                    self.beside_noise(gap, |row| row.check_between(before, &trial.panel))
                }
                _ => Ok(()),
            };
            let apart = |before: &Panel<T>| {
                step.is_err() || !self.meets(before, &trial.panel, trial.allowed)
            };
            if let Some(before) = before.filter(apart) {
                // The longer one has been halved less often.
                let longer: f64 = (before.half() / trial.panel.half()).to_subset_unchecked();
                let level = trial.level.saturating_sub(longer.log2().to_usize().unwrap_or(0));
                let finer = trial.level < MAX_AT_JUMP
                    && trial.may_be_halved()
                    && (is_long(trial.panel.x, self.noise) || is_long(before.x, self.noise))
                    && (level < LEVELS_OF_A_STEP || step.is_ok());
                if finer && splits < MAX_SPLITS && !self.coarse {
                    self.panels.pop();
                    self.waiting.push(Candidate { split: true, ..trial });
                    trial = Candidate { panel: before, level, split: true, ..trial };
                    continue;
                }
                step?;
            }
            if trial.is_given_up(self.tolerance * self.size) {
                trial.own_up();
            }
            if let Some(mut before) = before {
                self.own_up_to([&mut before, &mut trial.panel], trial.allowed);
                let last = self.panels.len() - 1;
                self.panels[last].error = before.error;
            }
            self.panels.push(trial.panel);
            let Some(next) = self.waiting.pop() else { return Ok(()) };
            trial = next;
        }
    }

    /// Tells whether two neighbours have the same slope where they meet. (A feature between their
    /// last nodes shows only there.)
    pub fn meets(&self, left: &Panel<T>, right: &Panel<T>, allowed: T) -> bool {
        let open = left.error + right.error + allowed.max(self.tolerance * self.size);
        (left.at_ends()[1] - right.at_ends()[0]).abs() <= T::of(16.0) * open
    }

    /// Raises the errors of two neighbours to their mismatch if only a loose tolerance accepts it:
    /// a feature lies between their last nodes. Likewise if they are too short
    /// to be halved: at a tip the slope would rise about as much in each of the halvings to come.
    fn own_up_to(&self, [left, right]: [&mut Panel<T>; 2], allowed: T) {
        let missed = (left.at_ends()[1] - right.at_ends()[0]).abs();
        let is_explained = missed <= T::of(16.0) * (left.error + right.error);
        let rise = |panel: &Panel<T>| (panel.at_ends()[1] - panel.at_ends()[0]).abs();
        let is_jump = missed > T::count(MAX_AT_JUMP) * rise(left).max(rise(right));
        let short = T::of(FEW_ULPS) * T::epsilon() * right.x[1].abs();
        let is_tip = !is_jump && right.x[1] - left.x[0] < short;
        if !is_explained && (is_tip || self.is_loose() && self.meets(left, right, allowed)) {
            left.error = left.error.max(missed);
            right.error = right.error.max(missed);
        }
    }

    /// Tells whether the tolerance is not the lowest.
    fn is_loose(&self) -> bool {
        self.tolerance > T::of(LEAST_ULPS) * T::epsilon()
    }

    /// Tells whether the coefficients of a panel are noise, not a wave: on a small part of the
    /// panel, noise does not fall.
    fn is_noisy(&mut self, gap: &Gap<'_, T>, panel: &Panel<T>) -> Fallible<T, bool> {
        const N: usize = 8;
        let [left, right] = panel.x;
        // Avoids the middle, where a formula may be more exact than elsewhere.
        let from = left + T::of(0.3) * (right - left);
        let mut part = Panel::new([from, from + T::of(SHARE_OF_A_WAVE) * (right - left)]);
        if !is_long(part.x, self.noise) {
            return Ok(true);
        }
        self.sample_panel::<N>(gap, &mut part)?;
        let rest = part.series[N / 2..N].iter().fold(T::zero(), |max, a| max.max(a.abs()));
        Ok(rest >= T::of(0.125) * panel.error)
    }
}
