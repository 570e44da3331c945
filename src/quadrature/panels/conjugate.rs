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
use super::chebyshev::{Row, Table, evaluate, value_at};
use super::panel::Panel;
use crate::real::Sum;
use crate::{Interval, Real};

/// Points treated together.
pub(super) const LANES: usize = 8;

/// How far beyond its panel, in half-lengths, a polynomial may be used.
const REACHES: [f64; 6] = [1.6, 3.0, 8.0, 30.0, 300.0, 1e4];

/// A contact on its panels.
pub(super) struct Conjugate<T> {
    pub on: Interval<T>,
    parts: Vec<Part<T>>,
    /// Distances from the start of their part, and the slope there times the weight.
    nodes: Vec<[T; 2]>,
    /// Every part's polynomial may be used at every point of the contact.
    near: bool,
    /// The largest slope.
    size: T,
}

/// A panel, or what of it lies in the contact.
struct Part<T> {
    panel: Panel<T>,
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
        Self { on, parts: Vec::new(), nodes: Vec::new(), near: true, size: T::zero() }
    }

    /// Sets it to a contact that the panels cover.
    pub fn set(&mut self, panels: &[Panel<T>], on: Interval<T>, size: T) {
        (self.on, self.size) = (on, size);
        self.parts.clear();
        self.nodes.clear();
        self.near = true;
        let first = panels.partition_point(|panel| panel.x[1] <= on.left);
        let last = panels.partition_point(|panel| panel.x[0] < on.right).max(first + 1);
        let within = &panels[first.min(panels.len() - 1)..last.min(panels.len())];
        for (i, panel) in within.iter().enumerate() {
            let from = if i == 0 { on.left } else { panel.x[0] };
            let to = if i + 1 == within.len() { on.right } else { panel.x[1] };
            let mut part = Part::new(clip(panel, from, to), on);
            if within.len() == 1 {
                part.integrals[0] = T::pi() / part.panel.half();
            } else {
                self.integrate(&mut part);
            }
            self.parts.push(part);
        }
    }

    /// What is needed of one part of several.
    fn integrate(&mut self, part: &mut Part<T>) {
        let (on, panel) = (self.on, &part.panel);
        let [from, to] = panel.x;
        let width = on.right - on.left;
        let arc = Arc::new(to - from, HalfAngle::of(on, from), HalfAngle::of(on, to), width);
        let farthest = panel.local(on.left).abs().max(panel.local(on.right).abs());
        part.reach = reach(panel.coefficients(), farthest);
        let is_near = part.reach >= farthest;
        let rule = if part.reach < T::of(3.0) && !is_near {
            Gauss::finest()
        } else {
            Gauss::suited(panel.n, arc.tangent)
        };
        let by_x = T::one() / panel.half();
        let start = self.nodes.len();
        for i in 0..rule.n {
            let (y, turn) = arc.beside_middle(arc.tangent * T::of(rule.nodes[i]));
            let along = y - arc.to_left;
            let s = along * by_x - T::one();
            let weight = T::of(rule.weights[i]) * turn * arc.tangent;
            let (mut t0, mut t1) = (T::one(), s);
            for k in 0..panel.n - 1 {
                part.integrals[k] += weight * t0;
                (t0, t1) = (t1, (s + s) * t1 - t0);
            }
            if !is_near {
                self.nodes.push([along, weight * value_at(panel.coefficients(), s)]);
            }
        }
        for k in 0..panel.n {
            let twice = if k == 0 { T::one() } else { T::of(2.0) };
            part.integrals[k] *= twice * by_x;
        }
        part.nodes = start..self.nodes.len();
        self.near &= is_near;
    }

    /// `π² R` at some points strictly inside the contact. Infinite where the slope jumps.
    pub fn at(&self, x: &[T; LANES]) -> [T; LANES] {
        let root = x.map(|x| self.on.edge_root(x));
        if let [part] = &self.parts[..] {
            let regular = part.regular(x).0;
            return std::array::from_fn(|i| root[i] * regular[i]);
        }
        if !self.near {
            return x.map(|x| self.at_one(x));
        }
        let mut sum = [T::zero(); LANES];
        let mut log = sum;
        let mut before = sum;
        for (j, part) in self.parts.iter().enumerate() {
            let (regular, value) = part.regular(x);
            for i in 0..LANES {
                sum[i] += regular[i];
                if j > 0 {
                    log[i] += self.jump(part, value[i] - before[i], x[i]);
                }
            }
            before = value;
        }
        std::array::from_fn(|i| root[i] * sum[i] + log[i])
    }

    /// The same at one point that is far from some of the panels.
    fn at_one(&self, x: T) -> T {
        let (mut sum, mut log, mut before) = (Sum::new(), Sum::new(), None);
        for (j, part) in self.parts.iter().enumerate() {
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
                log.add(self.jump(part, value.unwrap_or(zero) - before.unwrap_or(zero), x));
            }
            before = value;
        }
        self.on.edge_root(x) * sum.value() + log.value()
    }

    /// `jump Λ(x, t)`, t the start of a part.
    fn jump(&self, part: &Part<T>, jump: T, x: T) -> T {
        let (t, one) = (part.panel.x[0], T::one());
        let width = self.on.right - self.on.left;
        let mut distance = (x - t).abs();
        // What is rounding, or an end that the series do not resolve, has no logarithm closer than
        // the series can see.
        let rounding = T::of(16.0) * T::epsilon() * self.size;
        if jump.abs() <= rounding || (distance.is_zero() && self.is_kink(jump)) {
            distance = distance.max(part.panel.half() / T::count(part.panel.n * part.panel.n));
        }
        if distance.is_zero() {
            return jump / distance;
        }
        let m = part.roots[1] * (x - self.on.left).sqrt();
        let n = part.roots[0] * (self.on.right - x).sqrt();
        let ratio = m.min(n) / m.max(n);
        let kernel = if ratio < T::of(0.1) {
            // 2 artanh, of which the logarithm would lose the digits.
            let square = ratio * ratio;
            let term = |sum: T, i: usize| sum * square + one / T::count(2 * i + 1);
            (ratio + ratio) * (0..10).rev().fold(T::zero(), term)
        } else {
            ((m + n) * (m + n) / (distance * width)).ln()
        };
        jump * kernel
    }

    /// Whether a jump at a joint is nothing but what rounding makes of a kink.
    fn is_kink(&self, jump: T) -> bool {
        jump.abs() <= T::epsilon().sqrt() * self.size
    }

    /// Estimated error of `π² R` at a point, from what the series leave open.
    pub fn error(&self, x: T) -> T {
        let width = self.on.right - self.on.left;
        let sine = T::of(2.0) * self.on.edge_root(x) / width;
        let [mut sum, mut here] = [T::zero(); 2];
        for part in &self.parts {
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
        T::of(4.0) * (sum + here + T::of(8.0) * T::epsilon() * self.size * sine)
    }
}

impl<T: Real> Part<T> {
    fn new(panel: Panel<T>, on: Interval<T>) -> Self {
        let from = panel.x[0];
        Self {
            panel,
            integrals: [T::zero(); super::chebyshev::MOST],
            reach: T::zero(),
            nodes: 0..0,
            roots: [(from - on.left).max(T::zero()).sqrt(), (on.right - from).sqrt()],
        }
    }

    /// `∫ q dθ` and the polynomial itself at some points.
    #[inline(always)]
    fn regular<const W: usize>(&self, x: &[T; W]) -> ([T; W], [T; W]) {
        let s = x.map(|x| self.panel.local(x));
        self.continued(&s)
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

/// The part of a panel between two points, expanded anew.
fn clip<T: Real>(panel: &Panel<T>, from: T, to: T) -> Panel<T> {
    if panel.x == [from, to] {
        return *panel;
    }
    const W: usize = 4;
    let half = T::of(0.5);
    let table = Table::of(panel.n);
    let (left, right) = (panel.local(from), panel.local(to));
    let (middle, reach) = (half * (left + right), half * (right - left));
    let mut values = panel.series;
    for block in 0..panel.n / W {
        let s: [T; W] = std::array::from_fn(|i| middle + reach * T::of(table.z[block * W + i]));
        let (g, _) = evaluate::<W, T>(panel.coefficients(), &s);
        values[block * W..][..W].copy_from_slice(&g);
    }
    Panel { x: [from, to], series: table.coefficients(panel.n, &values), ..*panel }
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
        if size > T::of(16.0) * largest.max(series[0].abs()) {
            break;
        }
        reach = reach.max(further);
    }
    reach
}
