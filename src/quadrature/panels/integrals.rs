//! The edge integrals of a row of panels, and their derivatives by the two limits.
//!
//! One panel that holds the whole contact needs no angles: the Chebyshev points of the contact
//! itself integrate it exactly. Of several, each is a stretch of θ for Gauss's rule.

use super::angles::{Arc, Gauss, HalfAngle};
use super::chebyshev::{Table, evaluate};
use super::panel::Panel;
use crate::quadrature::{Moments, Trend};
use crate::real::Sum;
use crate::{Interval, Real};

/// `∫ g cosⁱθ dθ`, `∫ |g| dθ` and `∫ g' cosⁱθ dθ`, all divided by π, and the error of g.
#[derive(Clone, Copy)]
struct Sums<T> {
    g: [Sum<T>; 2],
    size: T,
    slope: [T; 3],
    error: T,
}

impl<T: Real> Sums<T> {
    fn new() -> Self {
        let zero = T::zero();
        Self { g: [Sum::new(); 2], size: zero, slope: [zero; 3], error: zero }
    }
}

/// The edge integrals over a contact that the panels cover, or sketch.
pub(super) fn moments<T: Real>(panels: &[Panel<T>], on: Interval<T>, sketch: bool) -> Moments<T> {
    let mut sums = Sums::new();
    let first = panels.partition_point(|panel| panel.x[1] <= on.left);
    let last = panels.partition_point(|panel| panel.x[0] < on.right).max(first + 1);
    let within = &panels[first.min(panels.len() - 1)..last.min(panels.len())];
    let share = if let [panel] = within {
        whole(&mut sums, panel, on);
        T::one()
    } else {
        several(&mut sums, within, on, sketch);
        T::one() / T::pi()
    };
    // A formula of a few terms is good to a few units in the last place.
    let rounding = T::of(16.0) * T::epsilon() * sums.size;
    let half_width = on.half_width();
    let [by_0, by_1, by_2] = sums.slope;
    Moments {
        mean: sums.g[0].value() * share,
        first: sums.g[1].value() * share,
        size: sums.size,
        error: sums.error.max(rounding),
        inversion: T::zero(),
        trend: Some(Trend { by_0, by_1, by_2 }).filter(|_| half_width > T::zero()),
    }
}

/// One panel holds the contact.
fn whole<T: Real>(sums: &mut Sums<T>, panel: &Panel<T>, on: Interval<T>) {
    match panel.n {
        4 => chebyshev::<4, 1, T>(sums, panel, on),
        8 => chebyshev::<8, 1, T>(sums, panel, on),
        12 => chebyshev::<4, 3, T>(sums, panel, on),
        _ => chebyshev::<8, 3, T>(sums, panel, on),
    }
    sums.error = panel.tail;
}

/// With B blocks of W nodes.
#[inline(always)]
fn chebyshev<const W: usize, const B: usize, T: Real>(
    sums: &mut Sums<T>,
    panel: &Panel<T>,
    on: Interval<T>,
) {
    let table = Table::of(W * B);
    let half = T::of(0.5);
    let (left, right) = (panel.local(on.left), panel.local(on.right));
    let (middle, reach) = (half * (left + right), half * (right - left));
    let mut lanes = [[T::zero(); W]; 6];
    for block in 0..B {
        let z: [T; W] = std::array::from_fn(|i| T::of(table.z[block * W + i]));
        let s: [T; W] = std::array::from_fn(|i| middle + reach * z[i]);
        let (g, slope) = evaluate::<W, T>(panel.coefficients(), &s);
        for i in 0..W {
            let turned = z[i] * slope[i];
            lanes[0][i] += g[i];
            lanes[1][i] += z[i] * g[i];
            lanes[2][i] += g[i].abs();
            lanes[3][i] += slope[i];
            lanes[4][i] += turned;
            lanes[5][i] += z[i] * turned;
        }
    }
    let share = T::one() / T::count(W * B);
    let total = |lane: [T; W]| lane.into_iter().fold(T::zero(), |sum, term| sum + term) * share;
    let [g0, g1, size, h0, h1, h2] = lanes.map(total);
    let by_x = T::one() / panel.half();
    sums.g[0].add(g0);
    sums.g[1].add(g1);
    sums.size = size;
    sums.slope = [h0 * by_x, h1 * by_x, h2 * by_x];
}

/// Several panels hold it between them.
fn several<T: Real>(sums: &mut Sums<T>, panels: &[Panel<T>], on: Interval<T>, sketch: bool) {
    let width = on.right - on.left;
    let mut left = HalfAngle::of(on, on.left);
    let mut before: Option<&Panel<T>> = None;
    for (i, panel) in panels.iter().enumerate() {
        // The outermost may have to be continued a little.
        let from = if i == 0 { on.left } else { panel.x[0] };
        let to = if i + 1 == panels.len() { on.right } else { panel.x[1] };
        if let Some(before) = before {
            jump(sums, before, panel, left, on);
        }
        let right = HalfAngle::of(on, to);
        stretch(sums, panel, from, Arc::new(to - from, left, right, width), sketch);
        left = right;
        before = Some(panel);
    }
    let share = T::one() / T::pi();
    sums.slope = sums.slope.map(|sum| sum * share);
    sums.size *= share;
    sums.error *= share;
}

/// One stretch of several.
fn stretch<T: Real>(sums: &mut Sums<T>, panel: &Panel<T>, from: T, arc: Arc<T>, sketch: bool) {
    const W: usize = 8;
    let rule = if sketch { Gauss::coarsest() } else { Gauss::suited(panel.counting, arc.tangent) };
    let by_x = T::one() / panel.half();
    let from = panel.local(from);
    let by_half_width = T::of(2.0) / arc.width();
    let mut lanes = [[T::zero(); W]; 6];
    for block in 0..rule.n / W {
        let mut s = [T::zero(); W];
        let mut cosine = s;
        let mut weight = s;
        for i in 0..W {
            let node = block * W + i;
            let (y, turn) = arc.beside_middle(arc.tangent * T::of(rule.nodes[node]));
            s[i] = from + (y - arc.to_left) * by_x;
            cosine[i] = arc.cos + y * by_half_width;
            weight[i] = T::of(rule.weights[node]) * turn;
        }
        let (g, slope) = evaluate::<W, T>(panel.coefficients(), &s);
        for i in 0..W {
            let (g, slope) = (weight[i] * g[i], weight[i] * slope[i]);
            lanes[0][i] += g;
            lanes[1][i] += cosine[i] * g;
            lanes[2][i] += g.abs();
            lanes[3][i] += slope;
            lanes[4][i] += cosine[i] * slope;
            lanes[5][i] += cosine[i] * (cosine[i] * slope);
        }
    }
    let total = |lane: [T; W]| lane.into_iter().fold(T::zero(), |sum, term| sum + term);
    let [g0, g1, size, h0, h1, h2] = lanes.map(|lane| total(lane) * arc.tangent);
    sums.g[0].add(g0);
    sums.g[1].add(g1);
    sums.size += size;
    for (sum, term) in sums.slope.iter_mut().zip([h0, h1, h2]) {
        *sum += term * by_x;
    }
    sums.error += panel.tail * T::of(4.0) * arc.tangent;
}

/// Where g jumps, g' is an impulse.
fn jump<T: Real>(
    sums: &mut Sums<T>,
    left: &Panel<T>,
    right: &Panel<T>,
    at: HalfAngle<T>,
    on: Interval<T>,
) {
    let alternate = |sum: T, (i, &a): (usize, &T)| if i % 2 == 0 { sum + a } else { sum - a };
    let from = right.coefficients().iter().enumerate().fold(T::zero(), alternate);
    let to = left.coefficients().iter().fold(T::zero(), |sum, &a| sum + a);
    let impulse = (from - to) / (on.half_width() * at.sine());
    let cosine = at.cosine();
    if impulse.is_finite() {
        sums.slope[0] += impulse;
        sums.slope[1] += impulse * cosine;
        sums.slope[2] += impulse * cosine * cosine;
    }
}
