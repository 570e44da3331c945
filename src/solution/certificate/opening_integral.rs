//! The contact as seen from outside: the integral over it that opens the gap beside it.
//!
//! Gauss's rule on arcs of θ, graded towards both edges, so that it serves at any distance from them.

use super::outside::OpeningRate;
use super::series_bounds::{above, below};
use crate::numerics::gauss_legendre::GaussLegendre;
use crate::quadrature::panels::Panel;
use crate::{Ends, Interval, Real, Side};

/// Halvings of the half-turn towards each edge.
const GRADES: usize = 26;

/// A point of the contact in the integral.
struct Node<T> {
    /// Its distances from -b and a.
    from: Ends<T>,
    g: T,
    weight: T,
}

/// The contact as seen from outside.
pub(super) struct OpeningIntegral<T> {
    on: Interval<T>,
    near: Vec<Node<T>>,
    /// Fewer, for points a half-width away.
    far: Vec<Node<T>>,
    /// The least and largest slope in the contact.
    slopes: [T; 2],
}

impl<T: Real> OpeningIntegral<T> {
    /// From the panels of the contact, which cover it and no more.
    pub fn new(panels: &[Panel<T>], on: Interval<T>) -> Self {
        let nodes = |grades| {
            let mut nodes = Vec::new();
            let half = T::of(0.5);
            for panel in panels {
                let [from, to] = [panel.x[0].max(on.left), panel.x[1].min(on.right)];
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
        Self { on, near: nodes(GRADES), far: nodes(3), slopes: extremes(panels, on) }
    }

    /// The sum over the contact at a distance outside, of g(t) and of 1, and the root w.
    fn sums(&self, distance: T, side: Side) -> [T; 3] {
        let half_width = self.on.half_width();
        let nodes = if distance < half_width { &self.near } else { &self.far };
        let [mut with, mut without] = [T::zero(); 2];
        for node in nodes {
            let term = node.weight / (distance + node.from[side]);
            with += term * node.g;
            without += term;
        }
        let root = distance.sqrt() * (distance + half_width + half_width).sqrt();
        [with, without, root]
    }
}

impl<T: Real> OpeningRate<T> for OpeningIntegral<T> {
    fn on(&self) -> Interval<T> {
        self.on
    }

    fn slopes(&self) -> [T; 2] {
        self.slopes
    }

    fn steepest(&self) -> T {
        self.slopes[0].abs().max(self.slopes[1].abs())
    }

    fn pull(&self, distance: T, side: Side) -> T {
        let [with, _, root] = self.sums(distance, side);
        with * root * T::frac_1_pi()
    }

    fn left_of(&self, g: T, distance: T, side: Side) -> T {
        let [with, without, root] = self.sums(distance, side);
        (g * without - with) * root * T::frac_1_pi()
    }
}

/// The least and the largest slope in a contact.
pub(super) fn extremes<T: Real>(panels: &[Panel<T>], on: Interval<T>) -> [T; 2] {
    let infinite = T::one() / T::zero();
    let mut slopes = [infinite, -infinite];
    for panel in panels {
        let [left, right] = [panel.x[0].max(on.left), panel.x[1].min(on.right)];
        if left < right {
            let (series, n) = panel.over(Interval { left, right });
            slopes = [slopes[0].min(below(&series[..n])), slopes[1].max(above(&series[..n]))];
        }
    }
    slopes
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
    let rule = GaussLegendre::suited(1, T::zero());
    for i in 0..rule.n {
        let angle = half * (start + end) + half * (end - start) * T::of(rule.nodes[i]);
        let (sin, cos) = (half * angle).sin_cos();
        let (here, there) = (width * sin * sin, width * cos * cos);
        let (x, from) = if edge == 0 {
            (on.left + here, Ends { left: here, right: there })
        } else {
            (on.right - here, Ends { left: there, right: here })
        };
        let weight = half * (end - start) * T::of(rule.weights[i]);
        // Rounding of x is more than the length of a panel beside a jump that was not declared.
        let g = panel.value(x.max(panel.x[0]).min(panel.x[1]));
        nodes.push(Node { from, g, weight });
    }
}
