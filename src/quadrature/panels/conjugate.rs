//! The regular part of the pressure, from the panels.
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
//! Λ vanishes at the edges of the contact, so one panel alone has no logarithm. If `b_k` are the
//! numbers that Clenshaw's recurrence passes through on its way to p(x), then in the panel's own
//! variable s, from -1 to 1,
//!
//! ```text
//! (p(s') - p(s))/(s' - s) = b₁ + 2 Σ_{k≥1} b_{k+1} T_k(s')
//! ```
//!
//! so that the integral of q costs one more multiplication a coefficient, once the integrals of
//! the T_k by θ are at hand. This is used on the panel that holds x and around it, as far as the
//! polynomial can be continued without losing digits; from further away the panel is summed up by
//! Gauss's rule.
//!
//! All of it has the factor w, or one that goes to zero like w, from the distances of x to the
//! edges: R keeps its relative accuracy up to a free edge.

use super::angles::{Arc, Gauss, HalfAngle};
use super::chebyshev::{MOST, Row, Table, evaluate, value_at};
use super::panel::Panel;
use crate::real::Sum;
use crate::{Interval, Real};

/// Points treated together.
pub(super) const LANES: usize = 16;

/// How far beyond its panel, in half-lengths, a polynomial may be used.
const REACHES: [f64; 5] = [1.6, 3.0, 8.0, 13.0, 18.0];

/// Points by their distances to the two edges, and `sqrt((x + b)(a - x))`.
pub(super) struct Edges<T> {
    pub left: [T; LANES],
    pub right: [T; LANES],
    pub root: [T; LANES],
}

impl<T: Real> Edges<T> {
    #[inline(always)]
    pub fn of(on: Interval<T>, x: &[T; LANES]) -> Self {
        let width = on.right - on.left;
        let share = T::one() / width;
        let left = x.map(|x| x - on.left);
        let right = x.map(|x| on.right - x);
        // In shares of the width, whose product neither overflows nor underflows.
        let root = std::array::from_fn(|i| width * ((left[i] * share) * (right[i] * share)).sqrt());
        Self { left, right, root }
    }
}

/// The coefficients of artanh(r)/r in r².
const ARTANH: [f64; 9] = [
    1.0,
    1.0 / 3.0,
    1.0 / 5.0,
    1.0 / 7.0,
    1.0 / 9.0,
    1.0 / 11.0,
    1.0 / 13.0,
    1.0 / 15.0,
    1.0 / 17.0,
];

/// A contact on its panels.
pub(super) struct Conjugate<T> {
    pub on: Interval<T>,
    /// Of which the first `used` are.
    parts: Vec<Part<T>>,
    used: usize,
    /// Distances from the start of their part, and the slope there times the weight.
    nodes: Vec<[T; 2]>,
    /// Every part's polynomial may be used at every point of the contact.
    near: bool,
    /// The largest slope.
    size: T,
    /// The largest jump that the series may have where there is only a kink.
    kink: T,
}

/// A panel, or what of it lies in the contact.
struct Part<T> {
    panel: Panel<T>,
    /// The reciprocal of its length.
    share: T,
    /// `b_k` is multiplied by `integrals[k - 1]`.
    integrals: Row<T>,
    reach: T,
    nodes: std::ops::Range<usize>,
    /// Square roots of the distances from the start of the part to the two edges.
    roots: [T; 2],
}

impl<T: Real> Conjugate<T> {
    pub fn new() -> Self {
        let on = Interval { left: T::zero(), right: T::zero() };
        Self {
            on,
            parts: Vec::new(),
            used: 0,
            nodes: Vec::new(),
            near: true,
            size: T::zero(),
            kink: T::zero(),
        }
    }

    /// Sets it to a contact that the panels cover.
    pub fn set(&mut self, panels: &[Panel<T>], on: Interval<T>, size: T, tolerance: T) {
        (self.on, self.size) = (on, size);
        let tail = panels.iter().fold(T::zero(), |max, panel| max.max(panel.tail));
        let rounding = T::epsilon().sqrt().max(T::of(64.0) * tolerance);
        self.kink = size * rounding + T::of(64.0) * tail;
        self.used = 0;
        self.nodes.clear();
        self.near = true;
        let first = panels.partition_point(|panel| panel.x[1] <= on.left);
        let last = panels.partition_point(|panel| panel.x[0] < on.right).max(first + 1);
        let within = &panels[first.min(panels.len() - 1)..last.min(panels.len())];
        for (i, panel) in within.iter().enumerate() {
            let from = if i == 0 { on.left } else { panel.x[0] };
            let to = if i + 1 == within.len() { on.right } else { panel.x[1] };
            if self.parts.len() == self.used {
                self.parts.push(Part::new());
            }
            let part = &mut self.parts[self.used];
            self.used += 1;
            part.clip(panel, from, to);
            if within.len() == 1 {
                part.integrals[0] = T::pi() / part.panel.half();
                (part.reach, part.nodes) = (T::zero(), 0..0);
            } else {
                part.roots = [(from - on.left).sqrt(), (on.right - from).sqrt()];
                part.integrate(on, &mut self.nodes, &mut self.near);
            }
        }
    }

    /// `π² R` at some points strictly inside the contact. Infinite where the slope jumps.
    #[inline(always)]
    pub fn at(&self, x: &[T; LANES], edges: &Edges<T>) -> [T; LANES] {
        if let [part] = &self.parts[..self.used] {
            let sines = part.sines(x);
            return std::array::from_fn(|i| edges.root[i] * sines[i]);
        }
        if !self.near {
            return x.map(|x| self.at_one(x));
        }
        let roots = [edges.left.map(|x| x.sqrt()), edges.right.map(|x| x.sqrt())];
        let mut sum = [T::zero(); LANES];
        let mut log = sum;
        let mut before = sum;
        for (j, part) in self.parts[..self.used].iter().enumerate() {
            let (regular, value) = part.regular(x);
            for i in 0..LANES {
                sum[i] += regular[i];
            }
            if j > 0 {
                let jump = std::array::from_fn(|i| value[i] - before[i]);
                let jumps = self.jumps(part, jump, x, &roots);
                for i in 0..LANES {
                    log[i] += jumps[i];
                }
            }
            before = value;
        }
        std::array::from_fn(|i| edges.root[i] * sum[i] + log[i])
    }

    /// The same at one point that is far from some of the panels.
    fn at_one(&self, x: T) -> T {
        let (mut sum, mut log, mut before) = (Sum::new(), Sum::new(), None);
        let roots = [[(x - self.on.left).sqrt()], [(self.on.right - x).sqrt()]];
        for (j, part) in self.parts[..self.used].iter().enumerate() {
            let s = part.panel.local(x);
            let value = if s.abs() <= part.reach {
                let (regular, value) = part.regular_at(s);
                sum.add(regular);
                Some(value)
            } else {
                let offset = part.panel.x[0] - x;
                let nodes = &self.nodes[part.nodes.clone()];
                let term = |sum, &[along, weighted]: &[T; 2]| sum + weighted / (offset + along);
                sum.add(nodes.iter().fold(T::zero(), term));
                None
            };
            if j > 0 && (value.is_some() || before.is_some()) {
                let zero = T::zero();
                let jump = value.unwrap_or(zero) - before.unwrap_or(zero);
                log.add(self.jumps(part, [jump], &[x], &roots)[0]);
            }
            before = value;
        }
        self.on.edge_root(x) * sum.value() + log.value()
    }

    /// `jump Λ(x, t)`, t the start of a part, at points with the roots of the distances from the
    /// edges to them.
    #[inline(always)]
    fn jumps<const W: usize>(
        &self,
        part: &Part<T>,
        jump: [T; W],
        x: &[T; W],
        [left, right]: &[[T; W]; 2],
    ) -> [T; W] {
        let (t, one) = (part.panel.x[0], T::one());
        let share = one / (self.on.right - self.on.left);
        // What is rounding, or an end that the series do not resolve, has no logarithm closer than
        // the series can see.
        let rounding = T::of(16.0) * T::epsilon() * self.size;
        let closest = part.panel.half() / T::count(part.panel.n * part.panel.n);
        let distance: [T; W] = std::array::from_fn(|i| {
            let distance = (x[i] - t).abs();
            let kink = jump[i].abs() <= rounding || (distance.is_zero() && self.is_kink(jump[i]));
            if kink { distance.max(closest) } else { distance }
        });
        let m = left.map(|left| part.roots[1] * left);
        let n = right.map(|right| part.roots[0] * right);
        let quotient: [T; W] =
            std::array::from_fn(|i| (m[i] + n[i]) * (m[i] + n[i]) * share / distance[i]);
        std::array::from_fn(|i| {
            if distance[i].is_zero() {
                return jump[i] / distance[i];
            }
            if m[i].min(n[i]) >= T::of(0.1) * m[i].max(n[i]) {
                return jump[i] * quotient[i].ln();
            }
            // 2 artanh, of which the logarithm would lose the digits.
            let ratio = m[i].min(n[i]) / m[i].max(n[i]);
            let square = ratio * ratio;
            let series = ARTANH.iter().rev().fold(T::zero(), |sum, &c| sum * square + T::of(c));
            jump[i] * (ratio + ratio) * series
        })
    }

    /// Whether a jump at a joint is nothing but what rounding makes of a kink.
    fn is_kink(&self, jump: T) -> bool {
        jump.abs() <= self.kink
    }

    /// Estimated error of `π² R` at a point, from what the series leave open.
    pub fn error(&self, x: T) -> T {
        let width = self.on.right - self.on.left;
        let sine = T::of(2.0) * self.on.edge_root(x) / width;
        let [mut sum, mut here] = [T::zero(); 2];
        for part in &self.parts[..self.used] {
            let [from, to] = part.panel.x;
            let length = to - from;
            let away = (from - x).max(x - to).max(T::zero());
            if away <= length {
                let n = T::count(part.panel.n);
                here = here
                    .max(part.panel.tail * T::of(3.0) * T::one().min(n * sine * width / length));
            } else {
                sum += part.panel.tail * sine * length / away;
            }
        }
        T::of(12.0) * (sum + here)
    }
}

impl<T: Real> Part<T> {
    fn new() -> Self {
        let (zero, row) = (T::zero(), [T::zero(); MOST]);
        let panel = Panel::new([zero; 2], 0, row);
        Self { panel, share: zero, integrals: row, reach: zero, nodes: 0..0, roots: [zero; 2] }
    }

    /// Takes the part of a panel between two points, expanded anew.
    fn clip(&mut self, panel: &Panel<T>, from: T, to: T) {
        const W: usize = 4;
        self.share = T::one() / (to - from);
        if panel.x == [from, to] {
            self.panel = *panel;
            return;
        }
        let half = T::of(0.5);
        let table = Table::of(panel.n);
        let (left, right) = (panel.local(from), panel.local(to));
        let (middle, reach) = (half * (left + right), half * (right - left));
        let mut values = [T::zero(); MOST];
        for block in 0..panel.n / W {
            let s: [T; W] = std::array::from_fn(|i| middle + reach * T::of(table.z[block * W + i]));
            let (g, _) = evaluate::<W, T>(panel.coefficients(), &s);
            values[block * W..][..W].copy_from_slice(&g);
        }
        let clipped = Panel::new([from, to], panel.n, table.coefficients(panel.n, &values));
        self.panel = Panel { tail: panel.tail, ..clipped };
    }

    /// What is needed of one part of several.
    fn integrate(&mut self, on: Interval<T>, nodes: &mut Vec<[T; 2]>, near: &mut bool) {
        let panel = &self.panel;
        let [from, to] = panel.x;
        let width = on.right - on.left;
        let arc = Arc::new(to - from, HalfAngle::of(on, from), HalfAngle::of(on, to), width);
        let farthest = panel.local(on.left).abs().max(panel.local(on.right).abs());
        self.reach = reach(panel.coefficients(), farthest);
        let is_near = self.reach >= farthest;
        let rule = if self.reach < T::of(3.0) && !is_near {
            Gauss::finest()
        } else {
            Gauss::suited(panel.counting, arc.tangent)
        };
        const W: usize = 8;
        let by_x = T::one() / panel.half();
        let start = nodes.len();
        self.integrals = [T::zero(); MOST];
        for block in 0..rule.n / W {
            let (mut along, mut weight) = ([T::zero(); W], [T::zero(); W]);
            for i in 0..W {
                let node = block * W + i;
                let (y, turn) = arc.beside_middle(arc.tangent * T::of(rule.nodes[node]));
                along[i] = y - arc.to_left;
                weight[i] = T::of(rule.weights[node]) * turn * arc.tangent;
            }
            let s = along.map(|along| along * by_x - T::one());
            let (mut t0, mut t1) = ([T::one(); W], s);
            for integral in &mut self.integrals[..panel.counting] {
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
        for (k, integral) in self.integrals[..panel.counting].iter_mut().enumerate() {
            let twice = if k == 0 { T::one() } else { T::of(2.0) };
            *integral *= twice * by_x;
        }
        self.nodes = start..nodes.len();
        *near &= is_near;
    }

    /// The places of some points in the panel.
    #[inline(always)]
    fn local<const W: usize>(&self, x: &[T; W]) -> [T; W] {
        let [left, right] = self.panel.x;
        let share = self.share;
        x.map(|x| ((x - left) - (right - x)) * share)
    }

    /// `∫ q dθ` where the part is the whole contact: `π/L` times the sum of the `c_k U_{k-1}`.
    #[inline(always)]
    fn sines<const W: usize>(&self, x: &[T; W]) -> [T; W] {
        let s = self.local(x);
        let twice: [T; W] = std::array::from_fn(|i| s[i] + s[i]);
        let (mut b1, mut b2) = ([T::zero(); W], [T::zero(); W]);
        for &a in self.panel.coefficients()[1..].iter().rev() {
            for i in 0..W {
                let b = twice[i] * b1[i] + (a - b2[i]);
                (b2[i], b1[i]) = (b1[i], b);
            }
        }
        b1.map(|b| self.integrals[0] * b)
    }

    /// `∫ q dθ` and the polynomial itself at some points.
    #[inline(always)]
    fn regular<const W: usize>(&self, x: &[T; W]) -> ([T; W], [T; W]) {
        self.continued(&self.local(x))
    }

    fn regular_at(&self, s: T) -> (T, T) {
        let ([regular], [value]) = self.continued(&[s]);
        (regular, value)
    }

    #[inline(always)]
    fn continued<const W: usize>(&self, s: &[T; W]) -> ([T; W], [T; W]) {
        let series = self.panel.coefficients();
        let zero = [T::zero(); W];
        let (mut b1, mut b2, mut sum) = (zero, zero, zero);
        let twice: [T; W] = std::array::from_fn(|i| s[i] + s[i]);
        for k in (1..series.len()).rev() {
            let (a, integral) = (series[k], self.integrals[k - 1]);
            for i in 0..W {
                let b = twice[i] * b1[i] + (a - b2[i]);
                sum[i] += integral * b;
                (b2[i], b1[i]) = (b1[i], b);
            }
        }
        (sum, std::array::from_fn(|i| s[i] * b1[i] + (series[0] - b2[i])))
    }
}

/// How far from its panel a polynomial may be used: while its terms are no larger than the values
/// that it has on the panel.
fn reach<T: Real>(series: &[T], farthest: T) -> T {
    let largest = series.iter().fold(T::zero(), |max, a| max.max(a.abs()));
    let mut reach = T::of(REACHES[0]);
    for further in REACHES {
        let further = T::of(further).min(farthest);
        let growth = further + further;
        let size = series[1..].iter().rev().fold(T::zero(), |sum, a| (sum + a.abs()) * growth);
        if size > T::of(40.0) * largest.max(series[0].abs()) {
            break;
        }
        reach = reach.max(further);
    }
    reach
}
