//! The regular part of the pressure on panels too short for their series to be continued over the
//! contact, for example next to a square root that nobody declared.
//!
//! The closed form of `hilbert_transform.rs`, in the panel's own variable, is used on the panel
//! that holds x and around it, as far as the polynomial can be continued without losing digits.
//! From further away the panel is summed by Gauss's rule, and from far away many panels at once
//! (`treecode.rs`).

use super::cauchy_transform::{WithDerivative, inverse, length, ln, sqrt};
use super::half_angle::{Arc, HalfAngle};
use super::hilbert_transform::{Breakpoint, Rounding};
use super::panel::{Panel, spans};
use super::treecode::{Group, REACH, group};
use crate::numerics::CompensatedSum;
use crate::numerics::chebyshev::{Coeffs, MAX_SIZE, values};
use crate::numerics::gauss_legendre::GaussLegendre;
use crate::{Interval, Real};
use nalgebra::Complex;

/// Distance from the middle of its panel, in half-lengths, up to which a polynomial is used
/// whatever its terms. Closer by, the finest Gauss rule, of 64 nodes, would leave more than
/// rounding: at this distance it leaves 1.32^-128 of the integral.
const LEAST_REACH: f64 = 1.04;

/// Distances up to which a polynomial may be used, in half-lengths; the last without loss of digits
/// is taken.
const REACHES: [f64; 7] = [1.1, 1.3, 1.6, 3.0, 8.0, 13.0, 18.0];

/// Such a distance from which on Gauss's rule suffices. Polynomials are used no farther off the
/// surface, where their terms cancel, nor in contacts that they do not reach all over.
const GAUSS_REACH: f64 = 3.0;

/// Place of the points from which the panels are seen.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Seen {
    /// Inside the contact.
    Inside,
    /// On the surface outside the contact, no closer to a panel than the ends of the contact.
    Outside,
    /// Anywhere below the surface.
    Below,
}

/// Panels of a contact, one by one and in groups.
#[derive(Clone)]
pub(super) struct NearFarSum<T> {
    parts: Vec<FarPanel<T>>,
    /// Distances of the nodes from the start of their part, and the slope there times the weight.
    nodes: Vec<[T; 2]>,
    groups: Vec<Group<T>>,
}

/// Panel, or its part in the contact.
#[derive(Clone)]
pub(super) struct FarPanel<T> {
    pub panel: Panel<T>,
    breakpoint: Breakpoint<T>,
    /// Factors of the `b_k`, in position `k - 1`.
    integrals: Coeffs<T>,
    reach: T,
    pub nodes: std::ops::Range<usize>,
}

impl<T: Real> NearFarSum<T> {
    pub fn new() -> Self {
        Self { parts: Vec::new(), nodes: Vec::new(), groups: Vec::new() }
    }

    /// Prepares the sum for the panels of a contact.
    pub fn set(&mut self, panels: &[Panel<T>], on: Interval<T>, seen: Seen) {
        self.parts.clear();
        self.nodes.clear();
        for (panel, x) in spans(panels, on) {
            self.parts.push(FarPanel::new(clip(panel, x), on, seen, &mut self.nodes));
        }
        self.groups.clear();
        let is_far = |x: [T; 2]| seen == Seen::Outside && x[0] >= on.left && x[1] <= on.right;
        group(&mut self.groups, &self.parts, 0..self.parts.len(), &self.nodes, &is_far);
    }

    /// Returns the cosine series of all panels, from the group of all; empty without groups.
    pub fn cosines(&self) -> (Coeffs<T>, usize) {
        self.groups.first().map_or(([T::zero(); MAX_SIZE], 0), Group::cosines)
    }

    /// Shows the panels and groups seen from a point of the surface, from left to right.
    pub fn seen_from(&self, x: T, show: impl FnMut(Distance<'_, T>)) {
        self.show(|group| group.is_near(x), show);
    }

    /// Shows the parts of groups that are near, and the other groups, from left to right.
    fn show(&self, is_near: impl Fn(&Group<T>) -> bool, mut show: impl FnMut(Distance<'_, T>)) {
        let mut number = 0;
        while let Some(group) = self.groups.get(number) {
            if !is_near(group) {
                show(Distance::Group(group));
                number = group.next;
                continue;
            }
            // A group that is not divided.
            if group.next == number + 1 {
                group.parts.clone().for_each(|j| show(Distance::FarPanel(j, &self.parts[j])));
            }
            number += 1;
        }
    }

    /// Returns `π² R` at a point.
    pub fn at(&self, x: T, on: Interval<T>, rounding: Rounding<T>) -> T {
        let (zero, mut sum, mut log) = (T::zero(), CompensatedSum::new(), CompensatedSum::new());
        let HalfAngle { cos, sin } = HalfAngle::of(on, x);
        let mut before = None;
        self.seen_from(x, |seen| {
            let (number, value) = match seen {
                Distance::Group(group) => {
                    sum.add(group.integral(x));
                    (group.parts.start, None)
                }
                Distance::FarPanel(number, part) => {
                    let (regular, value) = part.seen_from(x, &self.nodes);
                    sum.add(regular);
                    (number, value)
                }
            };
            if number > 0 && (value.is_some() || before.is_some()) {
                let change = value.unwrap_or(zero) - before.unwrap_or(zero);
                let breakpoint = &self.parts[number].breakpoint;
                let errors = [number - 1, number].map(|i| self.parts[i].panel.error);
                let rounding = rounding.between(errors);
                log.add(breakpoint.logarithms([change], &[x], &[[cos], [sin]], on, rounding)[0]);
            }
            before = value;
        });
        on.chebyshev_weight(x) * sum.value() + log.value()
    }

    /// Returns `∫ g(t)/((t - x) w(t)) dt` at a point outside the contact, at a distance from its
    /// nearer end.
    ///
    /// The logarithm inside becomes an arctangent outside:
    ///
    /// ```text
    /// ∫_{-b}^{t} ds/((s - x) w(s)) = -(2/r) arctan sqrt((x - a)(t + b)/((x + b)(a - t))), x > a
    /// ```
    ///
    /// with `r = sqrt((x - a)(x + b))`, and likewise on the left.
    pub fn outside(&self, x: T, distance: T, on: Interval<T>) -> T {
        let right = x > on.centre();
        let far = distance + (on.right - on.left);
        let [to_left, to_right] = if right { [far, distance] } else { [distance, far] };
        let root = to_left.sqrt() * to_right.sqrt();
        let angle = |t: T| {
            // At an end the root stays zero wherever the end moves: it has no derivative there.
            let root = |from: T, along: T| {
                if along > T::zero() { from.sqrt() * along.sqrt() } else { T::zero() }
            };
            let [y, x] = [root(to_right, t - on.left), root(to_left, on.right - t)];
            if y <= x { y.atan2(x) } else { T::frac_pi_2() - x.atan2(y) }
        };
        let sign = if right { -T::of(2.0) } else { T::of(2.0) } / root;
        let mut sum = CompensatedSum::new();
        self.seen_from(x, |seen| match seen {
            Distance::Group(group) => sum.add(group.integral(x)),
            Distance::FarPanel(_, part) => {
                let (regular, value) = part.seen_from(x, &self.nodes);
                sum.add(regular);
                if let Some(value) = value {
                    let [from, to] = part.panel.x.map(angle);
                    sum.add(value * sign * (to - from));
                }
            }
        });
        sum.value()
    }

    /// Returns `∫ g(t)/(t - ζ) dθ` below the surface, with its derivative by ζ. `place(t)` is
    /// `(ζ - t)/width`, and the result is in units of the width.
    pub fn in_plane(
        &self,
        place: &impl Fn(T) -> Complex<T>,
        on: Interval<T>,
        width: T,
    ) -> WithDerivative<T> {
        let zero = Complex::new(T::zero(), T::zero());
        let (by_width, mut sum) = (T::one() / width, [zero; 2]);
        let mut add = |term: WithDerivative<T>| sum = [0, 1].map(|j| sum[j] + term[j]);
        // No part reaches further than a group does.
        let reaches = |[from, to]: [T; 2], reach: T| {
            (length(place(from)) + length(place(to))) * width <= reach * (to - from)
        };
        self.show(
            |group| reaches(group.ends(), T::of(REACH)),
            |seen| match seen {
                Distance::Group(group) => {
                    add(pulls(place(group.ends()[0]), group.charges(), by_width));
                }
                Distance::FarPanel(_, part) => {
                    if reaches(part.panel.x, part.reach) {
                        add(part.below(place, on, width));
                    } else {
                        let nodes = self.nodes[part.nodes.clone()].iter().copied();
                        add(pulls(place(part.panel.x[0]), nodes, by_width));
                    }
                }
            },
        );
        sum
    }
}

/// Returns `Σ g/(t - ζ)` over nodes `[t - t_left, g]`, with its derivative; `from` is the distance
/// of ζ from t_left.
fn pulls<T: Real>(
    from: Complex<T>,
    nodes: impl Iterator<Item = [T; 2]>,
    by_width: T,
) -> WithDerivative<T> {
    let zero = Complex::new(T::zero(), T::zero());
    let square = from.im * from.im;
    nodes.fold([zero; 2], |[sum, slope], [along, weighted]| {
        let distance = along * by_width - from.re;
        let share = T::one() / (distance * distance + square);
        let pull = Complex::new(distance * share, from.im * share);
        let weighted = pull * weighted;
        [sum + weighted, slope + weighted * pull]
    })
}

/// Panel, with its number, or group of panels, as seen from a point.
pub(super) enum Distance<'f, T> {
    FarPanel(usize, &'f FarPanel<T>),
    Group(&'f Group<T>),
}

/// Returns the part of a panel between two points, expanded anew.
fn clip<T: Real>(panel: &Panel<T>, x: [T; 2]) -> Panel<T> {
    let (series, _) = panel.over(Interval { left: x[0], right: x[1] });
    let mut clipped = Panel { series, error: panel.error, ..Panel::new(x) };
    clipped.count(panel.n);
    clipped
}

impl<T: Real> FarPanel<T> {
    fn new(panel: Panel<T>, on: Interval<T>, seen: Seen, nodes: &mut Vec<[T; 2]>) -> Self {
        const W: usize = 8;
        let [from, to] = panel.x;
        let width = on.right - on.left;
        let [start, end] = panel.x.map(|x| HalfAngle::of(on, x));
        let arc = Arc::new(to - from, start, end, width);
        let farthest = panel.local(on.left).abs().max(panel.local(on.right).abs());
        let most = if seen == Seen::Below { T::of(GAUSS_REACH) } else { farthest };
        let reach = reach(panel.coefficients(), most);
        let reach = if reach >= farthest { reach } else { reach.min(T::of(GAUSS_REACH)) };
        let is_near = reach >= farthest && seen == Seen::Inside;
        // From outside no point comes closer than the ends of the contact.
        let closest = (-panel.local(on.left)).min(panel.local(on.right));
        let closest = if seen == Seen::Outside { closest } else { T::one() };
        let rule = if reach < T::of(GAUSS_REACH) && !is_near && closest < T::of(GAUSS_REACH) {
            GaussLegendre::finest()
        } else {
            GaussLegendre::suited(panel.length, arc.tangent)
        };
        let by_x = T::one() / panel.half();
        let length = if reach < closest { 0 } else { panel.length };
        let first_node = nodes.len();
        let mut integrals = [T::zero(); MAX_SIZE];
        for block in 0..rule.n / W {
            let [y, weight] = arc.nodes::<W>(rule, block);
            let (along, weight) = (y.map(|y| y - arc.to_left), weight.map(|by| by * arc.tangent));
            let s = along.map(|along| along * by_x - T::one());
            let (mut t0, mut t1) = ([T::one(); W], s);
            for integral in &mut integrals[..length] {
                for i in 0..W {
                    *integral += weight[i] * t0[i];
                    (t0[i], t1[i]) = (t1[i], (s[i] + s[i]) * t1[i] - t0[i]);
                }
            }
            if !is_near {
                let g = values(panel.coefficients(), &s);
                nodes.extend((0..W).map(|i| [along[i], weight[i] * g[i]]));
            }
        }
        for (k, integral) in integrals[..panel.length].iter_mut().enumerate() {
            let twice = if k == 0 { T::one() } else { T::of(2.0) };
            *integral *= twice * by_x;
        }
        let breakpoint = Breakpoint::new(&panel, start);
        Self { panel, breakpoint, integrals, reach, nodes: first_node..nodes.len() }
    }

    /// Returns the span of the surface on which the polynomial is used.
    pub fn reached(&self) -> [T; 2] {
        let [from, to] = self.panel.x;
        // Without nodes the polynomial is used everywhere, however x is rounded.
        let reach = if self.nodes.is_empty() { self.reach + self.reach } else { self.reach };
        let beyond = (reach - T::one()) * self.panel.half();
        [from - beyond, to + beyond]
    }

    /// Returns `∫ q dθ` and the polynomial at a place near the panel; from far off, the whole
    /// integral and `None`.
    fn seen_from(&self, x: T, nodes: &[[T; 2]]) -> (T, Option<T>) {
        let s = self.panel.local(x);
        if s.abs() > self.reach {
            let offset = self.panel.x[0] - x;
            let term = |sum, &[along, weighted]: &[T; 2]| sum + weighted / (offset + along);
            return (nodes[self.nodes.clone()].iter().fold(T::zero(), term), None);
        }
        let series = self.panel.coefficients();
        let (mut b1, mut b2, mut sum) = (T::zero(), T::zero(), T::zero());
        for k in (1..series.len()).rev() {
            (b1, b2) = ((s + s) * b1 + (series[k] - b2), b1);
            sum += self.integrals[k - 1] * b1;
        }
        (sum, Some(s * b1 + (series[0] - b2)))
    }

    /// Returns the whole integral at a place near the panel but below the surface, with its
    /// derivative.
    fn below(
        &self,
        place: &impl Fn(T) -> Complex<T>,
        on: Interval<T>,
        width: T,
    ) -> WithDerivative<T> {
        let zero = Complex::new(T::zero(), T::zero());
        let (one, half) = (Complex::new(T::one(), T::zero()), T::of(0.5));
        let by_half = width / self.panel.half();
        let [from, to] = self.panel.x;
        let (s, series) = ((place(from) + place(to)) * (half * by_half), self.panel.coefficients());
        // The numbers b and the polynomial, with their derivatives by s.
        let ([mut b1, mut b2, mut c1, mut c2], mut smooth) = ([zero; 4], [zero; 2]);
        for k in (1..series.len()).rev() {
            let twice = s + s;
            (c1, c2) = (twice * c1 + (b1 + b1) - c2, c1);
            (b1, b2) = (twice * b1 + (one * series[k] - b2), b1);
            smooth[0] += b1 * self.integrals[k - 1];
            smooth[1] += c1 * self.integrals[k - 1];
        }
        let value = [s * b1 + (one * series[0] - b2), (b1 + s * c1 - c2) * by_half];
        let smooth = [smooth[0] * width, smooth[1] * (width * by_half)];
        let limits = [on.left, on.right].map(place);
        let [a, b] = limits.map(sqrt);
        let by_root = inverse(a) * inverse(b);
        // Λ, and w/(ζ - t), at both ends.
        let [from, to] = [from, to].map(|t| {
            let root = |from: T, to: T| {
                if to > from { ((to - from) / width).sqrt() } else { T::zero() }
            };
            let [to_left, to_right] = [root(on.left, t), root(t, on.right)];
            let (m, n) = (a * to_right, b * to_left);
            let log = ln(Complex::new(m.re + n.im, m.im - n.re));
            [log + log - ln(place(t)), inverse(place(t)) * (to_left * to_right)]
        });
        let turn = to[0] - from[0];
        let arc = Complex::new(turn.im, -turn.re) * by_root;
        let bend = (inverse(limits[0]) + inverse(limits[1])) * half;
        let by_arc = -(arc * bend) - (to[1] - from[1]) * by_root * by_root;
        [smooth[0] + value[0] * arc, smooth[1] + value[1] * arc + value[0] * by_arc]
    }
}

/// Returns the distance from the middle of its panel, in half-lengths, up to which a polynomial may
/// be used: its terms must not much exceed its values on the panel.
fn reach<T: Real>(series: &[T], farthest: T) -> T {
    let largest = series.iter().fold(T::zero(), |max, a| max.max(a.abs()));
    let mut reach = T::of(LEAST_REACH);
    for further in REACHES {
        let further = T::of(further).min(farthest).max(T::one());
        // T_k grows like a power of this.
        let growth = further + (further * further - T::one()).sqrt();
        let size = series[1..].iter().rev().fold(T::zero(), |sum, a| (sum + a.abs()) * growth);
        if size > T::of(40.0) * largest.max(series[0].abs()) {
            break;
        }
        reach = reach.max(further);
    }
    reach
}
