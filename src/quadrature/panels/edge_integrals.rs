//! The edge integrals of a row of panels, and their derivatives by the two limits.
//!
//! A polynomial over the contact is a sum of cosines, and so is its derivative: a panel adds a sum
//! of differences of `sin kθ/k`. If panels are too short for their series to be continued over the
//! contact, each is a span of θ for Gauss's rule.

use super::half_angle::{Arc, HalfAngle, Sines};
use super::panel::{Panel, Series, spans, within};
use super::reexpansion::{PanelAngles, reexpanded};
use super::treecode::GroupMoments;
use crate::numerics::CompensatedSum;
use crate::numerics::chebyshev::{
    MAX_SIZE, by_size, derivative, evaluate, moved, size_for, values,
};
use crate::numerics::gauss_legendre::GaussLegendre;
use crate::quadrature::{MomentDerivatives, Moments};
use crate::{Interval, Real};

/// Number of nodes treated together.
const W: usize = 8;

/// Integrals `∫ g cos iθ dθ`, `∫ |g| dθ` and `∫ g' cosⁱθ dθ`, all divided by π, and the error of g.
#[derive(Clone, Copy)]
pub(super) struct EdgeSums<T> {
    g: [CompensatedSum<T>; 3],
    size: T,
    slope: [T; 3],
    error: T,
}

impl<T: Real> EdgeSums<T> {
    pub fn new() -> Self {
        let zero = T::zero();
        Self { g: [CompensatedSum::new(); 3], size: zero, slope: [zero; 3], error: zero }
    }

    /// Adds `∫ g cos iθ dθ`, and `∫ g' cosⁱθ dθ` with the derivative by z, given 1/L.
    #[inline(always)]
    fn add(&mut self, g: [T; 3], slope: [T; 3], by_x: T) {
        for i in 0..3 {
            self.g[i].add(g[i]);
            self.slope[i] += by_x * slope[i];
        }
    }

    fn scale(&mut self, share: T) {
        self.g = self.g.map(|sum| CompensatedSum::of(sum.value() * share));
        self.slope = self.slope.map(|sum| sum * share);
        self.size *= share;
        self.error *= share;
    }

    pub fn moments(self, on: Interval<T>) -> Moments<T> {
        // A formula of a few terms is exact to a few units in the last place.
        let rounding = T::of(16.0) * T::epsilon() * self.size;
        let [by_0, by_1, by_2] = self.slope;
        let derivatives = Some(MomentDerivatives { by_0, by_1, by_2 });
        Moments {
            m0: self.g[0].value(),
            m1: self.g[1].value(),
            m2: Some(self.g[2].value()),
            l1_norm: self.size,
            error: self.error.max(rounding),
            inversion: T::zero(),
            derivatives: derivatives.filter(|_| on.half_width() > T::zero()),
        }
    }
}

/// Largest number of coefficients that are expanded anew as fast as they are moved.
const FEW: usize = 8;

/// Returns the edge integrals over a contact that the panels cover. If one panel holds the whole
/// contact, `over` becomes its [series](Panel::over). If `from` is given, it is the series of the
/// same panel over that contact, often one nearby.
pub(super) fn moments<T: Real>(
    panels: &[Panel<T>],
    on: Interval<T>,
    over: &mut Option<Series<T>>,
    from: Option<Interval<T>>,
) -> Moments<T> {
    let within = within(panels, on);
    let mut sums = EdgeSums::new();
    if let [panel] = within {
        let over = over.get_or_insert(([T::zero(); MAX_SIZE], 0));
        let is_moved = from.filter(|_| over.1 > FEW).is_some_and(|from| {
            let share = T::one() / from.half_width();
            let ends = [(on.left - from.left) * share, (on.right - from.right) * share];
            by_size!(size_for(over.1), N => moved::<N, T>(&mut over.0, ends))
        });
        if !is_moved {
            *over = panel.over(on);
        }
        whole(&mut sums, over, panel.error, on);
    } else {
        *over = None;
        if !by_cosines(&mut sums, within, on) {
            sums = EdgeSums::new();
            by_gauss(&mut sums, within, on);
        }
    }
    sums.moments(on)
}

/// Tells whether the slope rises over the contact: by how much its derivative may be negative, by
/// its coefficients and the errors of the panels, and what jumps go down, is no more than an error
/// of size `allowed`. It counts once for all panels, as many small falls may be a wave.
pub(crate) fn rise<T: Real>(panels: &[Panel<T>], on: Interval<T>, allowed: T) -> bool {
    // What is no number counts as a fall.
    let falls = |by: T| if by <= T::zero() { T::zero() } else { by };
    let (mut before, mut fall, mut longest) = (None, T::zero(), 1);
    for panel in within(panels, on) {
        let mut series = [T::zero(); MAX_SIZE];
        series[..panel.length].copy_from_slice(panel.coefficients());
        let slopes = by_size!(size_for(panel.length), N => derivative::<N, T>(&series));
        let others = slopes[2..=panel.length].iter().fold(T::zero(), |sum, a| sum + a.abs());
        let [left, right] = panel.at_ends();
        // Markov's inequality bounds the derivative of an error.
        let error = panel.error * T::count(panel.length);
        fall += falls(others - T::of(0.5) * slopes[1] + error);
        fall += before.map_or(T::zero(), |before: T| falls(before - left));
        (before, longest) = (Some(right), longest.max(panel.length));
    }
    fall <= allowed * T::count(longest)
}

/// Integrates over a contact on one panel: over half a turn every cosine vanishes.
fn whole<T: Real>(sums: &mut EdgeSums<T>, (series, length): &Series<T>, error: T, on: Interval<T>) {
    let half = T::of(0.5);
    let slopes = by_size!(size_for(*length), N => derivative::<N, T>(series));
    let by_x = half / on.half_width();
    let g = [series[0], half * series[1], half * series[2]];
    sums.add(g, [slopes[1], slopes[2], half * (slopes[1] + slopes[3])], by_x);
    let squares = series[1..*length].iter().fold(T::zero(), |sum, &a| sum + a * a);
    sums.size = (series[0] * series[0] + half * squares).sqrt();
    sums.error = error;
}

/// Integrates over several panels by continuing their series over the contact; `false` if it
/// cannot.
fn by_cosines<T: Real>(sums: &mut EdgeSums<T>, panels: &[Panel<T>], on: Interval<T>) -> bool {
    let half = T::of(0.5);
    let mut before = [T::zero(); 2];
    let every = reexpanded(panels, on, |span| {
        let PanelAngles { panel, series, integrals, ends: [from, to], .. } = span;
        if !span.is_first {
            let [before, error] = before;
            jump(sums, [before, *from], error + panel.error, span.start, on);
        }
        by_size!(size_for(span.terms), N => span_of::<N, T>(sums, series, integrals, on));
        sums.size += half * (from.abs() + to.abs()) * integrals[0];
        sums.error += (panel.error + T::epsilon() * span.bulk) * integrals[0];
        before = [*to, panel.error];
    });
    sums.scale(T::frac_1_pi());
    every
}

/// Adds the integrals of a series over a span, given the integrals of cos kθ over it.
#[inline(always)]
fn span_of<const N: usize, T: Real>(
    sums: &mut EdgeSums<T>,
    series: &[T; MAX_SIZE],
    integrals: &Sines<T>,
    on: Interval<T>,
) {
    let (half, by_x) = (T::of(0.5), T::one() / on.half_width());
    let mut slopes = derivative::<N, T>(series);
    slopes[1] *= half;
    let (mut g, mut h) = ([T::zero(); 3], [T::zero(); 3]);
    for k in 0..N {
        // Times cos θ, and times cos 2θ.
        let once = half * (integrals[k.abs_diff(1)] + integrals[k + 1]);
        g[0] += series[k] * integrals[k];
        g[1] += series[k] * once;
        let twice = half * (integrals[k.abs_diff(2)] + integrals[k + 2]);
        g[2] += series[k] * twice;
        if k + 1 < N {
            h[0] += slopes[k + 1] * integrals[k];
            h[1] += slopes[k + 1] * once;
            h[2] += slopes[k + 1] * half * (integrals[k] + twice);
        }
    }
    sums.add(g, h, by_x);
}

/// Integrates over several panels, some of them too short for their series to be continued.
fn by_gauss<T: Real>(sums: &mut EdgeSums<T>, panels: &[Panel<T>], on: Interval<T>) {
    let width = on.right - on.left;
    let mut left = HalfAngle::of(on, on.left);
    let mut before: Option<&Panel<T>> = None;
    for (panel, [from, to]) in spans(panels, on) {
        if let Some(before) = before {
            let error = before.error + panel.error;
            jump(sums, [before.at_ends()[1], panel.at_ends()[0]], error, left, on);
        }
        let right = HalfAngle::of(on, to);
        span(sums, panel, from, Arc::new(to - from, left, right, width));
        left = right;
        before = Some(panel);
    }
    sums.scale(T::frac_1_pi());
}

/// Returns the slope as a cosine series, and a flag: all of it, not only the terms that count from
/// afar.
pub(super) fn cosines<T: Real>(panels: &[Panel<T>], on: Interval<T>) -> (Series<T>, bool) {
    if let [panel] = panels {
        return (panel.over(on), true);
    }
    let (mut sums, mut left) =
        (GroupMoments::new(on.left, on.half_width()), HalfAngle::of(on, on.left));
    for (panel, [from, to]) in spans(panels, on) {
        let right = HalfAngle::of(on, to);
        let arc = Arc::new(to - from, left, right, on.right - on.left);
        let rule = GaussLegendre::suited(panel.length, arc.tangent);
        let (start, by_x) = (panel.local(from), T::one() / panel.half());
        let share = arc.tangent * T::of(2.0) * T::frac_1_pi();
        for block in 0..rule.n / W {
            let [y, weight] = arc.nodes::<W>(rule, block);
            let along = y.map(|y| y - arc.to_left);
            let g = values(panel.coefficients(), &along.map(|y| start + y * by_x));
            sums.add(from, &std::array::from_fn(|i| [along[i], share * weight[i] * g[i]]));
        }
        left = right;
    }
    let (mut series, sums) = ([T::zero(); MAX_SIZE], sums.values());
    series[..sums.len()].copy_from_slice(&sums);
    series[0] *= T::of(0.5);
    ((series, sums.len()), false)
}

/// Adds the integrals over one of several spans.
fn span<T: Real>(sums: &mut EdgeSums<T>, panel: &Panel<T>, from: T, arc: Arc<T>) {
    let rule = GaussLegendre::suited(panel.length, arc.tangent);
    let by_x = T::one() / panel.half();
    let from = panel.local(from);
    let by_half_width = T::of(2.0) / arc.width;
    let mut lanes = [[T::zero(); W]; 7];
    for block in 0..rule.n / W {
        let [y, weight] = arc.nodes::<W>(rule, block);
        let s = y.map(|y| from + (y - arc.to_left) * by_x);
        let cosine = y.map(|y| arc.cos + y * by_half_width);
        let (g, slope) = evaluate::<W, T>(panel.coefficients(), &s);
        for i in 0..W {
            let (g, slope) = (weight[i] * g[i], weight[i] * slope[i]);
            lanes[0][i] += g;
            lanes[1][i] += cosine[i] * g;
            lanes[2][i] += g.abs();
            lanes[3][i] += slope;
            lanes[4][i] += cosine[i] * slope;
            lanes[5][i] += cosine[i] * (cosine[i] * slope);
            lanes[6][i] += cosine[i] * (cosine[i] * g);
        }
    }
    let total = |lane: [T; W]| lane.into_iter().fold(T::zero(), |sum, term| sum + term);
    let [g0, g1, size, h0, h1, h2, square] = lanes.map(|lane| total(lane) * arc.tangent);
    sums.add([g0, g1, square + square - g0], [h0, h1, h2], by_x);
    sums.size += size;
    sums.error += panel.error * T::of(4.0) * arc.tangent;
}

/// Adds the impulse of g' where g jumps. A jump within the errors of the two series, in each
/// component of its numbers, is ignored: next to an edge it would outweigh all the rest.
fn jump<T: Real>(
    sums: &mut EdgeSums<T>,
    [before, after]: [T; 2],
    error: T,
    at: HalfAngle<T>,
    on: Interval<T>,
) {
    let jump = after - before;
    let error = error + T::of(4.0) * T::epsilon() * (before.abs() + after.abs());
    if (0..T::COMPONENTS).all(|part| jump.component(part).abs() <= error) {
        return;
    }
    let impulse = jump / (on.half_width() * at.sine());
    let cosine = at.cosine();
    if impulse.is_finite() {
        sums.slope[0] += impulse;
        sums.slope[1] += impulse * cosine;
        sums.slope[2] += impulse * cosine * cosine;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns panels of equal length over [-1, 1], each from one slope to another.
    fn panels(slopes: &[[f64; 2]]) -> Vec<Panel<f64>> {
        let width = 2.0 / slopes.len() as f64;
        let of = |(i, &[left, right]): (usize, &[f64; 2])| {
            let start = -1.0 + width * i as f64;
            let mut panel = Panel { n: 8, ..Panel::new([start, start + width]) };
            (panel.series[0], panel.series[1], panel.length) =
                (0.5 * (left + right), 0.5 * (right - left), 2);
            panel
        };
        slopes.iter().enumerate().map(of).collect()
    }

    /// A slope rises only where each panel, and each seam, is known to rise.
    #[test]
    fn a_slope_rises_only_where_it_is_known_to() {
        let on = Interval { left: -0.9, right: 0.9 };
        let rising = [[-1.0, -0.5], [-0.5, 0.0], [0.0, 0.7], [0.7, 1.0]];
        let rises = |panels: &[Panel<f64>]| rise(panels, on, 1e-9);
        assert!(rises(&panels(&rising)));
        // A coefficient, or an error, that is unknown or too large.
        for unknown in [f64::NAN, f64::INFINITY, 1.0] {
            let mut all = panels(&rising);
            (all[2].series[2], all[2].length) = (unknown, 3);
            assert!(!rises(&all), "{unknown}");
            let mut all = panels(&rising);
            all[2].error = unknown;
            assert!(!rises(&all), "error {unknown}");
        }
        // A jump down from one panel to the next.
        assert!(!rises(&panels(&[[-1.0, 0.0], [-1e-6, 1.0]])));
        // A tolerance counts once, not once a cell.
        let falling: Vec<_> = (0..400).map(|i| [-2e-9 * f64::from(i); 2]).collect();
        assert!(!rises(&panels(&falling)));
    }
}
