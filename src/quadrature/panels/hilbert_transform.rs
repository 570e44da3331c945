//! The finite Hilbert transform of the slope: the regular part of the pressure, from the panels.
//!
//! With `w = sqrt((x + b)(a - x))` it is the conjugate of the slope,
//!
//! ```text
//! R(x) = (w/π²) PV∫ g(t)/((t - x) w(t)) dt = (1/π) Σ c_k sin kθ
//! ```
//!
//! On a panel where `g` is the polynomial p, `p(t) = p(x) + (t - x) q(t)`, and the integral falls
//! into two parts known in closed form:
//!
//! ```text
//! w ∫_u^v ... = p(x) (Λ(x, u) - Λ(x, v)) + w ∫ q dθ
//! Λ(x, t) = 2 artanh(min(m, n)/max(m, n)),   m² = (a - t)(x + b),   n² = (a - x)(t + b)
//! ```
//!
//! Λ vanishes at the edges of the contact, so one panel alone has no logarithm, and where two meet
//! only the difference of their polynomials has one. If `b_k` are the numbers of Clenshaw's
//! recurrence for `p(x) = Σ c_k T_k(z)`, `x = c + L z`, then
//!
//! ```text
//! (p(z') - p(z))/(z' - z) = b₁ + 2 Σ_{k≥1} b_{k+1} T_k(z'),      b_k(z) = Σ_{l≥0} c_{k+l} U_l(z)
//! ```
//!
//! so that the integrals of q over all panels add up to one series in the `U_l`, as long as the
//! series of each panel can be continued over the contact: the pressure then takes one series, and
//! one more with a logarithm at each breakpoint. If they cannot be continued, one series may do for
//! a few panels, as for pieces of a smooth body; otherwise see `near_far_sum.rs`.
//!
//! Every term has the factor w, or one that goes to zero like w, from the distances of x to the
//! edges: R keeps its relative accuracy up to a free edge.

use super::half_angle::{HalfAngle, Sines};
use super::near_far_sum::{Distance, NearFarSum, Seen};
use super::panel::{Panel, Series, across, within};
use super::panel_set::LEAST_ULPS;
use super::reexpansion::{PanelAngles, reexpanded};
use crate::numerics::chebyshev::{Coeffs, MAX_SIZE, by_size, second_kind, size_for, values};
use crate::real::fma;
use crate::{Interval, Real};

/// Number of points evaluated together.
pub(super) const BATCH: usize = 16;

/// Largest number of changes from one panel to the next, each with its logarithm; beyond it, groups
/// of panels take less time.
const MAX_LOGARITHMS: usize = 64;

/// Distances of points to the two edges, and `sqrt((x + b)(a - x))`.
pub(super) struct Edges<T> {
    pub left: [T; BATCH],
    pub right: [T; BATCH],
    pub root: [T; BATCH],
}

impl<T: Real> Edges<T> {
    #[inline(always)]
    pub fn of(on: Interval<T>, x: &[T; BATCH]) -> Self {
        let width = on.right - on.left;
        let share = T::one() / width;
        let left = x.map(|x| x - on.left);
        let right = x.map(|x| on.right - x);
        // In shares of the width, whose product neither overflows nor underflows.
        let root = std::array::from_fn(|i| width * ((left[i] * share) * (right[i] * share)).sqrt());
        Self { left, right, root }
    }
}

/// Hilbert transform over one contact, from its panels.
#[derive(Clone)]
pub(super) struct HilbertTransform<T> {
    pub on: Interval<T>,
    /// Smooth part: the first `terms` coefficients of the `U_l`, divided by L.
    smooth: Coeffs<T>,
    terms: usize,
    /// Changes of the slope from one panel to the next.
    changes: Vec<Change<T>>,
    /// Sum over the panels, used if their series are not continued over the contact.
    far: NearFarSum<T>,
    is_far: bool,
    rounding: Rounding<T>,
}

/// Thresholds that tell a jump of the slope from the rounding at a kink.
#[derive(Clone, Copy)]
pub(super) struct Rounding<T> {
    /// Rounding of the slopes.
    pub slope: T,
    /// Largest jump that the series may have at a mere kink.
    pub kink: T,
}

impl<T: Real> Rounding<T> {
    /// Returns the thresholds where two series with these errors meet.
    pub fn between(self, [left, right]: [T; 2]) -> Self {
        let error = left.max(right);
        Self { slope: self.slope + T::of(8.0) * error, kink: self.kink + T::of(64.0) * error }
    }
}

/// Difference of the series of two neighbouring panels, over the contact.
#[derive(Clone)]
struct Change<T> {
    breakpoint: Breakpoint<T>,
    series: Coeffs<T>,
    terms: usize,
    /// Errors of both.
    errors: [T; 2],
}

impl<T: Real> HilbertTransform<T> {
    pub fn new() -> Self {
        let (zero, row) = (T::zero(), [T::zero(); MAX_SIZE]);
        Self {
            on: Interval { left: zero, right: zero },
            smooth: row,
            terms: 0,
            changes: Vec::new(),
            far: NearFarSum::new(),
            is_far: false,
            rounding: Rounding { slope: zero, kink: zero },
        }
    }

    /// Prepares the transform for a contact that the panels cover, with slopes up to `size`. `over`
    /// is the series if one panel holds the whole contact.
    pub fn set(
        &mut self,
        panels: &[Panel<T>],
        over: Option<&Series<T>>,
        on: Interval<T>,
        size: T,
        tolerance: T,
    ) {
        self.on = on;
        let panels = within(panels, on);
        let kink = size * T::epsilon().sqrt().max(T::of(64.0) * tolerance);
        self.rounding = Rounding { slope: T::of(16.0) * T::epsilon() * size, kink };
        self.is_far = panels.len() > MAX_LOGARITHMS
            || !(self.reexpanded(panels, over, on) || self.merged(panels, on));
        if self.is_far {
            self.far.set(panels, on, Seen::Inside);
        }
    }

    /// Continues the series over the contact; `false` if one of several grows too much on the way,
    /// as where a panel reaches far beyond the contact.
    fn reexpanded(
        &mut self,
        panels: &[Panel<T>],
        over: Option<&Series<T>>,
        on: Interval<T>,
    ) -> bool {
        let zero = T::zero();
        (self.smooth, self.terms) = ([zero; MAX_SIZE], 1);
        self.changes.clear();
        if let Some((series, terms)) = over {
            self.set_whole(&series[..*terms], on);
            return true;
        }
        let mut before = ([zero; MAX_SIZE], 0, zero);
        let every = reexpanded(panels, on, |span| {
            let PanelAngles { panel, series, terms, integrals, .. } = span;
            if !span.is_first {
                let (last, last_terms, error) = before;
                self.changes.push(Change {
                    breakpoint: Breakpoint::new(panel, span.start),
                    series: std::array::from_fn(|k| series[k] - last[k]),
                    terms: last_terms.max(*terms),
                    errors: [error, panel.error],
                });
            }
            self.terms = self.terms.max(terms - 1);
            let smooth = &mut self.smooth;
            by_size!(size_for(*terms), N => add_smooth::<N, T>(smooth, series, integrals));
            before = (*series, *terms, panel.error);
        });
        let share = T::one() / on.half_width();
        self.smooth = self.smooth.map(|coefficient| coefficient * share);
        every
    }

    /// Sets the smooth part from a series over the whole contact, where only `cos 0θ` has an
    /// integral.
    fn set_whole(&mut self, series: &[T], on: Interval<T>) {
        let share = T::pi() / on.half_width();
        self.terms = series.len() - 1;
        for (smooth, &coefficient) in self.smooth.iter_mut().zip(&series[1..]) {
            *smooth = share * coefficient;
        }
    }

    /// Replaces a few panels by one series over the contact; `false` if it differs from one of them
    /// by more than rounding anywhere.
    fn merged(&mut self, panels: &[Panel<T>], on: Interval<T>) -> bool {
        let Rounding { slope, .. } = self.rounding;
        let is_same = |whole: &Panel<T>, missed: T, _| {
            (0..T::COMPONENTS).all(|part| {
                let sizes = whole.coefficients().iter().map(|a| a.component(part).abs());
                let rounding = || T::of(LEAST_ULPS) * T::epsilon() * sizes.fold(T::zero(), T::max);
                missed.component(part).abs() <= if part == 0 { slope } else { rounding() }
            })
        };
        let (whole, mut others) = across::<MAX_SIZE, T>(panels, on, is_same);
        if others.next().is_some() {
            return false;
        }
        self.changes.clear();
        self.smooth = [T::zero(); MAX_SIZE];
        self.set_whole(whole.coefficients(), on);
        true
    }

    /// Returns `π² R` at the first `count` points, strictly inside the contact; infinite where the
    /// slope jumps.
    #[inline(always)]
    pub fn at(&self, x: &[T; BATCH], count: usize, edges: &Edges<T>) -> [T; BATCH] {
        if self.is_far {
            let mut sums = [T::zero(); BATCH];
            for (sum, &x) in sums.iter_mut().zip(&x[..count]) {
                *sum = self.far.at(x, self.on, self.rounding);
            }
            return sums;
        }
        let share = T::one() / (self.on.right - self.on.left);
        let z: [T; BATCH] = std::array::from_fn(|i| (edges.left[i] - edges.right[i]) * share);
        let [smooth, _] = second_kind(&self.smooth[..self.terms], &z);
        let mut sum: [T; BATCH] = std::array::from_fn(|i| edges.root[i] * smooth[i]);
        if self.changes.is_empty() {
            return sum;
        }
        let roots = [edges.left, edges.right].map(|side| side.map(|x| (x * share).sqrt()));
        for Change { breakpoint, series, terms, errors } in &self.changes {
            let change = values(&series[..*terms], &z);
            let rounding = self.rounding.between(*errors);
            let logs = breakpoint.logarithms(change, x, &roots, self.on, rounding);
            for i in 0..BATCH {
                sum[i] += logs[i];
            }
        }
        sum
    }

    /// Estimates the error of `π² R` at a point from the errors of the series.
    pub fn error(&self, panels: &[Panel<T>], x: T) -> T {
        let on = self.on;
        let width = on.right - on.left;
        let sine = T::of(2.0) * on.chebyshev_weight(x) / width;
        let [mut sum, mut here] = [T::zero(); 2];
        let mut add = |panel: &Panel<T>| {
            let [from, to] = [panel.x[0].max(on.left), panel.x[1].min(on.right)];
            let length = to - from;
            let away = (from - x).max(x - to).max(T::zero());
            if away <= length {
                let near = T::one().min(T::count(panel.n) * sine * width / length);
                // Next to a breakpoint the error has a logarithm.
                let beside = (x - from).abs().min((to - x).abs()).max(T::of(1e-6) * length);
                let log = T::of(3.0) + T::of(0.5) * (length / beside).ln();
                here = here.max(panel.error * log * near);
            } else {
                sum += panel.error * sine * length / away;
            }
        };
        let mut of_groups = T::zero();
        if self.is_far {
            self.far.seen_from(x, |seen| match seen {
                Distance::FarPanel(_, part) => add(&part.panel),
                Distance::Group(group) => of_groups += sine * group.doubt(x),
            });
        } else {
            within(panels, on).iter().for_each(add);
        }
        // The noise of the formulas is known from a few coefficients only.
        T::of(8.0) * (sum + here + of_groups) + self.spike(panels, x)
    }

    /// Returns the extra error at a panel boundary, where rounding cannot be told from a jump: the
    /// mismatch times a logarithm. (At a jump the pressure is infinite.)
    fn spike(&self, panels: &[Panel<T>], x: T) -> T {
        let width = self.on.right - self.on.left;
        let close = T::epsilon() * width;
        let before = panels.partition_point(|panel| panel.x[1] < x - close);
        let [left, right, ..] = &panels[before..] else { return T::zero() };
        let distance = (left.x[1] - x).abs();
        if distance > close {
            return T::zero();
        }
        let jump = (right.at_ends()[0] - left.at_ends()[1]).abs();
        if jump > self.rounding.between([left.error, right.error]).kink {
            return T::zero();
        }
        let distance = if distance.is_zero() { close } else { distance };
        jump * (width / distance).ln()
    }
}

/// Adds the integral of q over a span to the coefficients.
#[inline(always)]
fn add_smooth<const N: usize, T: Real>(smooth: &mut Coeffs<T>, q: &Coeffs<T>, sines: &Sines<T>) {
    for m in 1..N {
        let integral = sines[m - 1] * T::of(if m == 1 { 1.0 } else { 2.0 });
        for l in 0..N - m {
            smooth[l] = fma(integral, q[m + l], smooth[l]);
        }
    }
}

/// Start of a panel, as the place of a logarithm.
#[derive(Clone)]
pub(super) struct Breakpoint<T> {
    x: T,
    /// The roots of its distances to the two edges, as shares of the width.
    at: HalfAngle<T>,
    /// Smallest distance that the series resolves.
    closest: T,
}

/// Coefficients of artanh(r)/r in r².
#[rustfmt::skip]
const ARTANH: [f64; 9] =
    [1.0, 1.0 / 3.0, 1.0 / 5.0, 1.0 / 7.0, 1.0 / 9.0, 1.0 / 11.0, 1.0 / 13.0, 1.0 / 15.0, 1.0 / 17.0];

impl<T: Real> Breakpoint<T> {
    pub fn new(panel: &Panel<T>, at: HalfAngle<T>) -> Self {
        Self { x: panel.x[0], at, closest: panel.half() / T::count(panel.n * panel.n) }
    }

    /// Returns `change Λ(x, t)` at points, with t the breakpoint. `left` and `right` are the square
    /// roots of their distances to the edges, as shares of the width.
    #[inline(always)]
    pub fn logarithms<const W: usize>(
        &self,
        change: [T; W],
        x: &[T; W],
        [left, right]: &[[T; W]; 2],
        on: Interval<T>,
        rounding: Rounding<T>,
    ) -> [T; W] {
        let width = on.right - on.left;
        // Mere rounding, or an end that the series do not resolve, has no logarithm closer than the
        // series resolve.
        let distance: [T; W] = std::array::from_fn(|i| {
            let distance = (x[i] - self.x).abs();
            let change = change[i].abs();
            let kink = distance.is_zero() && change <= rounding.kink;
            if kink || change <= rounding.slope { distance.max(self.closest) } else { distance }
        });
        let m = left.map(|left| self.at.sin * left);
        let n = right.map(|right| self.at.cos * right);
        let quotient: [T; W] =
            std::array::from_fn(|i| (m[i] + n[i]) * (m[i] + n[i]) * (width / distance[i]));
        let comparable = |i: usize| m[i].min(n[i]) >= T::of(0.1) * m[i].max(n[i]);
        // Usually all points take the plain form.
        if (0..W).fold(true, |all, i| all & comparable(i) & !distance[i].is_zero()) {
            return std::array::from_fn(|i| change[i] * quotient[i].ln());
        }
        std::array::from_fn(|i| {
            if distance[i].is_zero() {
                return change[i] / distance[i];
            }
            if comparable(i) {
                return change[i] * quotient[i].ln();
            }
            // 2 artanh by its series, because the logarithm would lose digits.
            let ratio = m[i].min(n[i]) / m[i].max(n[i]);
            let square = ratio * ratio;
            let series = ARTANH.iter().rev().fold(T::zero(), |sum, &c| sum * square + T::of(c));
            change[i] * (ratio + ratio) * series
        })
    }
}
