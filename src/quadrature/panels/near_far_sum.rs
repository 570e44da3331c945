//! The regular part of the pressure on panels too short for their series to be continued over the
//! contact: about a square root that nobody declared, say.
//!
//! The closed form of `hilbert_transform.rs`, in the panel's own variable, is used on the panel that holds x and
//! around it, as far as the polynomial can be continued without losing digits; from further away the
//! panel is summed up by Gauss's rule, and from far away many panels at once (`treecode.rs`).

use super::half_angle::{Arc, HalfAngle};
use super::hilbert_transform::{Breakpoint, Rounding, shares};
use super::panel::{Panel, spans};
use super::treecode::{Group, group};
use crate::numerics::CompensatedSum;
use crate::numerics::chebyshev::{MOST, Row, value_at};
use crate::numerics::gauss_legendre::GaussLegendre;
use crate::{Interval, Real};

/// How far from the middle of its panel, in half-lengths, a polynomial is used whatever its terms: from closer by, the
/// finest Gauss rule, of 64 nodes, leaves more than rounding, 1.32^-128 of the integral here.
const LEAST_REACH: f64 = 1.04;

/// How far it may be used.
const REACHES: [f64; 7] = [1.1, 1.3, 1.6, 3.0, 8.0, 13.0, 18.0];

/// The panels of a contact.
#[derive(Clone)]
pub(super) struct NearFarSum<T> {
    parts: Vec<FarPanel<T>>,
    /// Distances from the start of their part, and the slope there times the weight.
    nodes: Vec<[T; 2]>,
    groups: Vec<Group<T>>,
}

/// A panel, or what of it lies in the contact.
#[derive(Clone)]
pub(super) struct FarPanel<T> {
    pub panel: Panel<T>,
    breakpoint: Breakpoint<T>,
    /// `b_k` is multiplied by `integrals[k - 1]`.
    integrals: Row<T>,
    reach: T,
    pub nodes: std::ops::Range<usize>,
}

impl<T: Real> NearFarSum<T> {
    pub fn new() -> Self {
        Self { parts: Vec::new(), nodes: Vec::new(), groups: Vec::new() }
    }

    /// Sets it to the panels of a contact.
    pub fn set(&mut self, panels: &[Panel<T>], on: Interval<T>) {
        self.set_within(panels, on, false);
    }

    /// The same for points outside the contact: no panel is near to all of them.
    pub fn set_seen_from_outside(&mut self, panels: &[Panel<T>], on: Interval<T>) {
        self.set_within(panels, on, true);
    }

    fn set_within(&mut self, panels: &[Panel<T>], on: Interval<T>, outside: bool) {
        self.parts.clear();
        self.nodes.clear();
        for (panel, x) in spans(panels, on) {
            self.parts.push(FarPanel::new(clip(panel, x), on, outside, &mut self.nodes));
        }
        self.groups.clear();
        group(&mut self.groups, &self.parts, 0..self.parts.len(), &self.nodes);
    }

    /// The cosine series of all panels, as far as groups know it.
    pub fn cosines(&self) -> (Row<T>, usize) {
        self.groups.first().map_or(([T::zero(); MOST], 0), Group::cosines)
    }

    /// Shows what a point sees of the panels, from left to right.
    pub fn seen_from(&self, x: T, mut show: impl FnMut(Distance<'_, T>)) {
        let mut number = 0;
        while let Some(group) = self.groups.get(number) {
            if !group.is_near(x) {
                show(Distance::Group(group));
                number = group.next;
                continue;
            }
            if group.is_few() {
                group.parts.clone().for_each(|j| show(Distance::FarPanel(j, &self.parts[j])));
            }
            number += 1;
        }
    }

    /// `π² R` at a point.
    pub fn at(&self, x: T, on: Interval<T>, rounding: Rounding<T>) -> T {
        let (zero, mut sum, mut log) = (T::zero(), CompensatedSum::new(), CompensatedSum::new());
        let roots = shares(on, x).map(|share| [share.sqrt()]);
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
                log.add(breakpoint.logarithms([change], &[x], &roots, on, rounding)[0]);
            }
            before = value;
        });
        on.chebyshev_weight(x) * sum.value() + log.value()
    }

    /// `∫ g(t)/((t - x) w(t)) dt` at a point outside the contact, at a distance from its nearer end.
    ///
    /// What the logarithm is inside an arcus tangent is outside:
    ///
    /// ```text
    /// ∫_{-b}^{t} ds/((s - x) w(s)) = -(2/r) arctan sqrt((x - a)(t + b)/((x + b)(a - t)))   for x > a
    /// ```
    ///
    /// with `r = sqrt((x - a)(x + b))`, and likewise on the left.
    pub fn outside(&self, x: T, distance: T, on: Interval<T>) -> T {
        let right = x > on.centre();
        let far = distance + (on.right - on.left);
        let [to_left, to_right] = if right { [far, distance] } else { [distance, far] };
        let root = to_left.sqrt() * to_right.sqrt();
        let angle = |t: T| {
            // At an end it stays nothing wherever the end moves: a root has no derivative there.
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
}

/// What a point sees: panels one by one, by their numbers, or many as one.
pub(super) enum Distance<'f, T> {
    FarPanel(usize, &'f FarPanel<T>),
    Group(&'f Group<T>),
}

/// The part of a panel between two points, expanded anew.
fn clip<T: Real>(panel: &Panel<T>, x: [T; 2]) -> Panel<T> {
    let (series, _) = panel.over(Interval { left: x[0], right: x[1] });
    let mut clipped = Panel { series, tail: panel.tail, ..Panel::new(x) };
    clipped.count(panel.n);
    clipped
}

impl<T: Real> FarPanel<T> {
    fn new(panel: Panel<T>, on: Interval<T>, outside: bool, nodes: &mut Vec<[T; 2]>) -> Self {
        const W: usize = 8;
        let [from, to] = panel.x;
        let width = on.right - on.left;
        let arc = Arc::new(to - from, HalfAngle::of(on, from), HalfAngle::of(on, to), width);
        let farthest = panel.local(on.left).abs().max(panel.local(on.right).abs());
        let reach = reach(panel.coefficients(), farthest);
        let is_near = reach >= farthest && !outside;
        // From outside no point comes closer than the ends of the contact.
        let closest = (-panel.local(on.left)).min(panel.local(on.right));
        let closest = if outside { closest } else { T::one() };
        let rule = if reach < T::of(3.0) && !is_near && closest < T::of(3.0) {
            GaussLegendre::finest()
        } else {
            GaussLegendre::suited(panel.counting, arc.tangent)
        };
        let by_x = T::one() / panel.half();
        let counting = if reach < closest { 0 } else { panel.counting };
        let start = nodes.len();
        let mut integrals = [T::zero(); MOST];
        for block in 0..rule.n / W {
            let [y, weight] = arc.nodes::<W>(rule, block);
            let (along, weight) = (y.map(|y| y - arc.to_left), weight.map(|by| by * arc.tangent));
            let s = along.map(|along| along * by_x - T::one());
            let (mut t0, mut t1) = ([T::one(); W], s);
            for integral in &mut integrals[..counting] {
                for i in 0..W {
                    *integral += weight[i] * t0[i];
                    (t0[i], t1[i]) = (t1[i], (s[i] + s[i]) * t1[i] - t0[i]);
                }
            }
            if !is_near {
                for i in 0..W {
                    nodes.push([along[i], weight[i] * value_at(panel.coefficients(), s[i])]);
                }
            }
        }
        for (k, integral) in integrals[..panel.counting].iter_mut().enumerate() {
            let twice = if k == 0 { T::one() } else { T::of(2.0) };
            *integral *= twice * by_x;
        }
        let breakpoint = Breakpoint::new(&panel, on, from);
        Self { panel, breakpoint, integrals, reach, nodes: start..nodes.len() }
    }

    /// The span on which its polynomial is used.
    pub fn reached(&self) -> [T; 2] {
        let [from, to] = self.panel.x;
        // Without nodes it is used everywhere, however x is rounded.
        let reach = if self.nodes.is_empty() { self.reach + self.reach } else { self.reach };
        let beyond = (reach - T::one()) * self.panel.half();
        [from - beyond, to + beyond]
    }

    /// `∫ q dθ` and the polynomial itself at a place near the panel; of one far off, all of the integral.
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
}

/// Returns how far from the middle of its panel, in half-lengths, a polynomial may be used: while its terms are no
/// larger than the values that it has on the panel.
fn reach<T: Real>(series: &[T], farthest: T) -> T {
    let largest = series.iter().fold(T::zero(), |max, a| max.max(a.abs()));
    let mut reach = T::of(LEAST_REACH).min(farthest).max(T::one());
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
