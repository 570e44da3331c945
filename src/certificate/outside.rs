//! No overlap outside.
//!
//! At the distance d outside an edge the deformed gap opens with the slope
//!
//! ```text
//! (w/π) ∫ (g(x) - g(t))/(x - t) dθ - (π/κ) (K (1 + d/2L) - K' d/2L)/sqrt(d/L (2 + d/L))
//! ```
//!
//! w² = d (d + 2L), t = c + L cos θ, K of this edge and K' of the other. In y = √d its integral is
//! smooth up to the edge. Where g is larger than anywhere in the contact, the gap grows: there
//! the slope itself is not computed, and what the pressure adds to the height is made up for
//! only where the gap stops growing.

use super::series::{above, below, integral, least, tail};
use super::{Place, undecided};
use crate::gap::{Cost, Gap};
use crate::quadrature::panels::angles::Gauss;
use crate::quadrature::panels::chebyshev::Table;
use crate::quadrature::panels::{Cover, Panel};
use crate::{ContactError, Interval, Real};

/// Nodes of a cell.
const NODES: usize = 24;
/// How often a panel is halved.
const MOST_LEVELS: usize = 40;
/// Cells on one side.
const MOST_CELLS: usize = 1 << 16;
/// Halvings of the half-turn towards each edge.
const GRADES: usize = 26;

/// A point of the contact in the integral.
struct Node<T> {
    /// Its distances from -b and a.
    from: [T; 2],
    g: T,
    weight: T,
}

/// The contact as seen from outside.
pub(super) struct Outside<T> {
    on: Interval<T>,
    near: Vec<Node<T>>,
    /// Fewer, for points a half-width away.
    far: Vec<Node<T>>,
    /// The least and largest slope in the contact.
    slopes: [T; 2],
}

/// One side of the contact.
pub(super) struct Side<'o, T: Real> {
    pub outside: &'o Outside<T>,
    pub right: bool,
    /// π/κ times the strength of this edge, and of the other.
    pub strengths: [T; 2],
    /// Overlaps up to this are none.
    pub allowed: T,
    /// The height of the gap at `y`, and what the slopes of the bodies have added since.
    height: T,
    y: T,
    pending: T,
    /// Whether the gap has been open: a least gap of nothing at the edge itself is none.
    open: bool,
    cells: usize,
    /// The deepest overlap, and the least gap at which the bodies come closer again.
    pub worst: Option<Place<T>>,
    pub closest: Option<Place<T>>,
}

impl<T: Real> Outside<T> {
    /// From the panels of the contact.
    pub fn new(panels: &[Panel<T>], on: Interval<T>) -> Self {
        let nodes = |grades| {
            let mut nodes = Vec::new();
            let half = T::of(0.5);
            for panel in panels {
                let [from, to] = [panel.x[0].max(on.left), panel.x[1].min(on.right)];
                if from >= to {
                    continue;
                }
                // Each half-turn by its own edge, with the angle counted from there.
                for edge in [0, 1] {
                    let angle = |x: T| {
                        let [here, there] = if edge == 0 {
                            [x - on.left, on.right - x]
                        } else {
                            [on.right - x, x - on.left]
                        };
                        T::of(2.0) * here.sqrt().atan2(there.sqrt())
                    };
                    let [one, other] = [angle(from), angle(to)];
                    let (low, high) = (one.min(other), one.max(other));
                    let mut top = T::frac_pi_2();
                    for grade in 0..grades {
                        let bottom = if grade + 1 == grades { T::zero() } else { half * top };
                        let (start, end) = (low.max(bottom), high.min(top));
                        if start < end {
                            arc(&mut nodes, panel, on, edge, [start, end]);
                        }
                        top = bottom;
                    }
                }
            }
            nodes
        };
        let bound = |least: [T; 2], panel: &Panel<T>| {
            let [from, to] = [panel.x[0].max(on.left), panel.x[1].min(on.right)];
            if from >= to {
                return least;
            }
            let (series, n) = panel.over(Interval { left: from, right: to });
            [least[0].min(below(&series[..n])), least[1].max(above(&series[..n]))]
        };
        let infinite = T::one() / T::zero();
        let slopes = panels.iter().fold([infinite, -infinite], bound);
        Self { on, near: nodes(GRADES), far: nodes(3), slopes }
    }

    /// The largest slope in the contact.
    pub fn steepest(&self) -> T {
        self.slopes[0].abs().max(self.slopes[1].abs())
    }

    /// The sum over the contact at a distance outside, of g(t) and of 1, and the root w.
    fn sums(&self, distance: T, right: bool) -> [T; 3] {
        let half_width = self.on.half_width();
        let nodes = if distance < half_width { &self.near } else { &self.far };
        let [mut with, mut without] = [T::zero(); 2];
        let i = usize::from(right);
        for node in nodes {
            let term = node.weight / (distance + node.from[i]);
            with += term * node.g;
            without += term;
        }
        let root = distance.sqrt() * (distance + half_width + half_width).sqrt();
        [with, without, root]
    }
}

/// Gauss's rule on an arc, whose angles count from one of the edges.
fn arc<T: Real>(
    nodes: &mut Vec<Node<T>>,
    panel: &Panel<T>,
    on: Interval<T>,
    edge: usize,
    [start, end]: [T; 2],
) {
    let (half, width) = (T::of(0.5), on.right - on.left);
    let rule = Gauss::suited(1, T::zero());
    for i in 0..rule.n {
        let angle = half * (start + end) + half * (end - start) * T::of(rule.nodes[i]);
        let (sin, cos) = (half * angle).sin_cos();
        let (here, there) = (width * sin * sin, width * cos * cos);
        let (x, from) = if edge == 0 {
            (on.left + here, [here, there])
        } else {
            (on.right - here, [there, here])
        };
        let weight = half * (end - start) * T::of(rule.weights[i]);
        // Rounding of x is more than the length of a panel beside a jump that was not declared.
        let g = panel.value(x.max(panel.x[0]).min(panel.x[1]));
        nodes.push(Node { from, g, weight });
    }
}

impl<'o, T: Real> Side<'o, T> {
    pub fn new(outside: &'o Outside<T>, right: bool, strengths: [T; 2], allowed: T) -> Self {
        let zero = T::zero();
        let (worst, closest) = (None, None);
        let (height, y, pending) = (zero, zero, zero);
        let (open, cells) = (false, 0);
        Self { outside, right, strengths, allowed, height, y, pending, open, cells, worst, closest }
    }

    fn sign(&self) -> T {
        if self.right { T::one() } else { -T::one() }
    }

    fn edge(&self) -> T {
        if self.right { self.outside.on.right } else { self.outside.on.left }
    }

    fn distance(&self, x: T) -> T {
        (self.sign() * (x - self.edge())).max(T::zero())
    }

    /// What the strengths add to the slope of the gap, times 2 √d.
    fn singular(&self, distance: T) -> T {
        let half_width = self.outside.on.half_width();
        let share = T::of(0.5) * distance / half_width;
        let [own, other] = self.strengths;
        let by_root = T::of(2.0) * (half_width / (T::of(2.0) + share + share)).sqrt();
        -(own * (T::one() + share) - other * share) * by_root
    }

    /// Takes in all panels of the way from the edge to an end of the bodies, in cells no longer
    /// than `spacing`.
    pub fn follow(
        &mut self,
        gap: &Gap<'_, T>,
        end: T,
        spacing: T,
        cover: &mut Cover<T>,
        most: usize,
    ) -> Result<(), ContactError<T>> {
        let half_width = self.outside.on.half_width();
        let (mut reached, reach) = (T::zero(), self.distance(end));
        let mut left_out = T::zero();
        let (edge, sign) = (self.edge(), self.sign());
        let place = |distance: T| if distance >= reach { end } else { edge + sign * distance };
        let mut x = edge;
        let mut cells = Vec::new();
        while reached < reach && cells.len() < most {
            let step = (T::of(0.5) * reached).max(T::of(0.0625) * half_width).min(spacing);
            // No sliver at the end.
            let next = if reached + T::of(1.25) * step >= reach { reach } else { reached + step };
            let to = place(next);
            if to != x {
                cells.push([x.min(to), x.max(to)]);
            }
            (x, reached) = (to, next);
        }
        let mut waiting: Vec<Panel<T>> = Vec::new();
        for [left, right] in cells {
            cover.sample_anew(gap, Interval { left, right })?;
            let joint = if self.right { left } else { right };
            if let Some(before) = self.edge_of(&waiting, joint) {
                // What happens between the last node and the end of a cell shows at its neighbour.
                let after = self.edge_of(&cover.panels, joint).unwrap_or(before);
                let size = cover.size.max(before[0].abs());
                let doubt = before[1] + after[1] + cover.tolerance * size;
                let apart = (before[0] - after[0]).abs() > T::of(16.0) * doubt;
                if apart && !gap.is_joint(joint) {
                    let ends = waiting.iter().flat_map(|panel| panel.x);
                    let [left, right] =
                        ends.fold([left, right], |[from, to], x| [from.min(x), to.max(x)]);
                    cover.sample_anew(gap, Interval { left, right })?;
                    waiting.clear();
                }
            }
            if cover.cost.evaluations > most || cover.cost.samples > most {
                return Err(undecided(joint, cover.cost));
            }
            for panel in waiting.drain(..) {
                self.take(&panel, &mut left_out, cover.cost)?;
            }
            waiting.extend_from_slice(&cover.panels);
            if !self.right {
                waiting.reverse();
            }
        }
        for panel in waiting {
            self.take(&panel, &mut left_out, cover.cost)?;
        }
        Ok(())
    }

    /// The slope and its error at a place where a row of panels ends.
    fn edge_of(&self, panels: &[Panel<T>], x: T) -> Option<[T; 2]> {
        let panel = panels.iter().find(|panel| panel.x.contains(&x))?;
        Some([panel.value(x), panel.tail])
    }

    /// The next panel outward.
    fn take(
        &mut self,
        panel: &Panel<T>,
        left_out: &mut T,
        cost: Cost,
    ) -> Result<(), ContactError<T>> {
        let length = panel.x[1] - panel.x[0];
        let rounding = T::of(16.0) * T::epsilon();
        *left_out += length * (panel.tail + rounding * panel.series[0].abs());
        let series = panel.coefficients();
        let [own, other] = self.strengths;
        // A straight flank is as steep as in the contact.
        let slack = rounding * self.outside.steepest();
        let growing = if self.right {
            below(series) >= self.outside.slopes[1] - slack
        } else {
            above(series) <= self.outside.slopes[0] + slack
        };
        let [one, two] = panel.x.map(|x| self.distance(x));
        let [from, to] = [one.min(two).sqrt(), one.max(two).sqrt()];
        if growing && own <= T::zero() && own <= other {
            let sum = integral(series).iter().fold(T::zero(), |sum, &a| sum + a);
            self.pending += self.sign() * sum * panel.half();
            return Ok(());
        }
        if self.pending != T::zero() {
            let drawn = self.drawn(self.y, from);
            self.height += self.pending - drawn;
            self.open |= self.height > self.allowed;
            self.pending = T::zero();
        }
        self.bound(panel, [from, to], self.allowed + *left_out, cost)?;
        self.y = to;
        Ok(())
    }

    /// What the pressure takes off the height between two places.
    fn drawn(&self, from: T, to: T) -> T {
        let (half, rule) = (T::of(0.5), Gauss::suited(1, T::zero()));
        let (mut sum, mut top) = (T::zero(), to);
        for level in 0..200 {
            let bottom = if level + 1 == 200 || (from.is_zero() && level > 20) {
                from
            } else {
                from.max(half * top)
            };
            for i in 0..rule.n {
                let y = half * (bottom + top) + half * (top - bottom) * T::of(rule.nodes[i]);
                let distance = y * y;
                let [with, _, root] = self.outside.sums(distance, self.right);
                let pull = (y + y) * self.sign() * with * root * T::frac_1_pi();
                let weight = half * (top - bottom) * T::of(rule.weights[i]);
                sum += weight * (pull - self.singular(distance));
            }
            if bottom <= from {
                break;
            }
            top = bottom;
        }
        sum
    }

    /// Bounds the gap over one panel.
    fn bound(
        &mut self,
        panel: &Panel<T>,
        whole: [T; 2],
        allowed: T,
        cost: Cost,
    ) -> Result<(), ContactError<T>> {
        let (half, table, sign) = (T::of(0.5), Table::of(NODES), self.sign());
        // How fast g changes: so much of it is lost with the rounding of x.
        let bends = panel.coefficients().iter().enumerate();
        let bend = bends.fold(T::zero(), |sum, (k, a)| sum + T::count(k) * a.abs()) / panel.half();
        let mut waiting = vec![(whole, 0)];
        while let Some(([from, to], level)) = waiting.pop() {
            let (middle, reach) = (half * (from + to), half * (to - from));
            self.cells += 1;
            if self.cells > MOST_CELLS {
                return Err(undecided(self.edge() + sign * from * from, cost));
            }
            let (mut values, mut terms) = ([T::zero(); NODES], T::zero());
            for (value, &z) in values.iter_mut().zip(&table.z) {
                let y = middle + reach * T::of(z);
                let distance = y * y;
                let x = self.edge() + sign * distance;
                let g = panel.value(x);
                let [with, without, root] = self.outside.sums(distance, self.right);
                let opens = sign * (g * without - with) * root * T::frac_1_pi();
                let lost = T::of(0.125) * (x.abs() + distance) * bend;
                terms = terms.max((y + y) * (g.abs() + lost) * reach);
                *value = ((y + y) * opens + self.singular(distance)) * reach;
            }
            let rate = &table.coefficients(&values);
            let left_out = tail(rate);
            let size = rate.iter().fold(T::zero(), |max, a| max.max(a.abs()));
            let rounding = T::of(256.0) * T::epsilon() * size.max(terms);
            let fine = left_out <= (T::of(0.125) * allowed).max(rounding);
            if !fine && level < MOST_LEVELS && middle > from && middle < to {
                waiting.extend([([middle, to], level + 1), ([from, middle], level + 1)]);
                continue;
            }
            let mut heights = integral(rate);
            heights[0] += self.height;
            let lowest = below(&heights);
            let known = lowest > allowed && self.closest.is_some_and(|than| than.value <= lowest);
            if below(rate) < T::zero() && !known {
                // To what counts, and no further than rounding.
                let rounding = heights.iter().fold(T::zero(), |sum, a| sum + a.abs());
                let rounding = T::of(16.0) * T::epsilon() * rounding;
                let enough = (T::of(1e-3) * allowed).max(rounding).max(T::of(1e-9) * lowest);
                let [s, value] = least(&heights, enough);
                let y = middle + s * reach;
                let here = Place { x: self.edge() + sign * y * y, value };
                let less = |than: &Option<Place<T>>| than.is_none_or(|than| value < than.value);
                if value < -(allowed + left_out) && less(&self.worst) {
                    self.worst = Some(here);
                }
                let turns = s > -T::one() && (self.open || value.abs() > allowed);
                if turns && less(&self.closest) {
                    self.closest = Some(here);
                }
            }
            self.height = heights.iter().fold(T::zero(), |sum, &a| sum + a);
            self.open |= self.height > allowed;
        }
        Ok(())
    }
}
