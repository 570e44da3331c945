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

use super::series_bounds::{above, below, integral, least, truncation_error};
use super::{Extremum, undecided};
use crate::gap::{Cost, Gap, Sampler};
use crate::numerics::chebyshev::Table;
use crate::numerics::gauss_legendre::GaussLegendre;
use crate::quadrature::panels::{Panel, PanelSet, Rises};
use crate::{ContactError, Ends, Interval, Real, Side};

/// Nodes of a cell.
const NODES: usize = 24;
/// How often a panel is halved.
const MOST_LEVELS: usize = 40;
/// Cells on one side.
const MOST_CELLS: usize = 1 << 16;

/// A contact as seen from beside it, without the strengths of its edges.
pub(super) trait OpeningRate<T: Real> {
    fn on(&self) -> Interval<T>;

    /// Beyond these, on the left and on the right, the slope of the bodies is one at which the gap grows
    /// outward.
    fn slopes(&self) -> [T; 2];

    /// The largest slope in the contact.
    fn steepest(&self) -> T;

    /// What the pressure takes off the slope of the gap at a distance from an edge.
    fn pull(&self, distance: T, side: Side) -> T;

    /// What it leaves of a slope g there.
    fn left_of(&self, g: T, distance: T, side: Side) -> T {
        g - self.pull(distance, side)
    }
}

/// One side of the contact.
pub(super) struct OutsideOf<'o, T: Real> {
    pub view: &'o dyn OpeningRate<T>,
    side: Side,
    /// π/κ times the strength of this edge, and of the other.
    strengths: [T; 2],
    /// Overlaps up to this are none.
    pub allowed: T,
    /// By how much the gap between the bodies, before they are loaded, rises towards larger x over what was followed.
    risen: T,
    /// The height of the gap at `y`, and what the slopes of the bodies have added since.
    height: T,
    y: T,
    pending: T,
    /// Whether the gap has been open: a least gap of nothing at the edge itself is none.
    open: bool,
    cells: usize,
    /// The deepest overlap, and the least gap from which on the bodies part again.
    pub worst: Option<Extremum<T>>,
    pub closest: Option<Extremum<T>>,
    /// Where the last cell ends, if the bodies come closer up to there.
    pub falling: Option<Extremum<T>>,
}

impl<'o, T: Real> OutsideOf<'o, T> {
    /// With π/κ times the strengths of both edges.
    pub fn new(view: &'o dyn OpeningRate<T>, side: Side, strengths: Ends<T>, allowed: T) -> Self {
        let strengths = match side {
            Side::Left => [strengths.left, strengths.right],
            Side::Right => [strengths.right, strengths.left],
        };
        let zero = T::zero();
        let (risen, height, y, pending) = (zero, zero, zero, zero);
        let (open, cells) = (false, 0);
        let (worst, closest, falling) = (None, None, None);
        Self {
            view,
            side,
            strengths,
            allowed,
            risen,
            height,
            y,
            pending,
            open,
            cells,
            worst,
            closest,
            falling,
        }
    }

    fn sign(&self) -> T {
        match self.side {
            Side::Left => -T::one(),
            Side::Right => T::one(),
        }
    }

    fn edge(&self) -> T {
        self.view.on()[self.side]
    }

    fn distance(&self, x: T) -> T {
        (self.sign() * (x - self.edge())).max(T::zero())
    }

    /// What the strengths add to the slope of the gap, times 2 √d.
    fn singular(&self, distance: T) -> T {
        let half_width = self.view.on().half_width();
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
        panel_set: &mut PanelSet<T>,
        most: usize,
    ) -> Result<(), ContactError<T>> {
        let half_width = self.view.on().half_width();
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
            panel_set.sample_anew(gap, Interval { left, right })?;
            let breakpoint = if self.side == Side::Right { left } else { right };
            if let Some(before) = self.edge_of(&waiting, breakpoint) {
                // What happens between the last node and the end of a cell shows at its neighbour.
                let after = self.edge_of(&panel_set.panels, breakpoint).unwrap_or(before);
                let size = panel_set.size.max(before[0].abs());
                let doubt = before[1] + after[1] + panel_set.tolerance * size;
                let apart = (before[0] - after[0]).abs() > T::of(16.0) * doubt;
                if apart && !gap.is_breakpoint(breakpoint) {
                    let ends = waiting.iter().flat_map(|panel| panel.x);
                    let [left, right] =
                        ends.fold([left, right], |[from, to], x| [from.min(x), to.max(x)]);
                    panel_set.sample_anew(gap, Interval { left, right })?;
                    waiting.clear();
                }
            }
            if panel_set.cost.evaluations > most || panel_set.cost.samples > most {
                return Err(undecided(breakpoint, panel_set.cost));
            }
            for panel in waiting.drain(..) {
                self.take(&panel, &mut left_out, panel_set.cost)?;
            }
            waiting.extend_from_slice(&panel_set.panels);
            if self.side == Side::Left {
                waiting.reverse();
            }
        }
        // Short of the last cell: at the end of a body the slope may be infinite.
        if let Some(panel) = waiting.first() {
            let place = panel.x[usize::from(self.side == Side::Left)];
            let mut sampler = Sampler::default();
            let heights = [gap.nearest(edge), place].map(|x| sampler.height(gap, x));
            let [at_edge, at_place] = heights;
            let rises = Rises {
                between: [edge, place],
                by_heights: at_place? - at_edge?,
                by_slopes: sign * self.risen,
                highest: sampler.highest,
                open: left_out,
            };
            let compared = rises.compare_beside_noise(gap, &mut sampler);
            panel_set.cost.heights += sampler.cost.evaluations;
            compared?;
        }
        for panel in waiting {
            self.take(&panel, &mut left_out, panel_set.cost)?;
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
        self.risen += panel.rise(panel.x[0], panel.x[1]);
        let rounding = T::of(16.0) * T::epsilon();
        *left_out += length * (panel.tail + rounding * panel.series[0].abs());
        let series = panel.coefficients();
        let [own, other] = self.strengths;
        // A straight flank is as steep as in the contact.
        let slack = rounding * self.view.steepest();
        let growing = if self.side == Side::Right {
            below(series) >= self.view.slopes()[1] - slack
        } else {
            above(series) <= self.view.slopes()[0] + slack
        };
        let [one, two] = panel.x.map(|x| self.distance(x));
        let [from, to] = [one.min(two).sqrt(), one.max(two).sqrt()];
        if growing && own <= T::zero() && own <= other {
            let sum = integral(series).iter().fold(T::zero(), |sum, &a| sum + a);
            self.pending += self.sign() * sum * panel.half();
            self.part_again();
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
        let (half, rule) = (T::of(0.5), GaussLegendre::suited(1, T::zero()));
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
                let pull = (y + y) * self.sign() * self.view.pull(distance, self.side);
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
                // Rounding of x is more than the length of a panel that ends beside a breakpoint.
                let g = panel.value(x.max(panel.x[0]).min(panel.x[1]));
                let opens = sign * self.view.left_of(g, distance, self.side);
                let lost = T::of(0.125) * (x.abs() + distance) * bend;
                terms = terms.max((y + y) * (g.abs() + lost) * reach);
                *value = ((y + y) * opens + self.singular(distance)) * reach;
            }
            let rate = &table.coefficients(&values);
            let left_out = truncation_error(rate);
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
            if known {
                self.falling = None;
            } else if below(rate) < T::zero() {
                // To what counts, and no further than rounding.
                let rounding = heights.iter().fold(T::zero(), |sum, a| sum + a.abs());
                let rounding = T::of(16.0) * T::epsilon() * rounding;
                let enough = (T::of(1e-3) * allowed).max(rounding).max(T::of(1e-9) * lowest);
                let [s, value] = least(&heights, enough);
                let y = middle + s * reach;
                let here = Extremum { x: self.edge() + sign * y * y, value };
                if value < -(allowed + left_out)
                    && self.worst.is_none_or(|than: Extremum<T>| value < than.value)
                {
                    self.worst = Some(here);
                }
                let turns = s > -T::one() && (self.open || value.abs() > allowed);
                if s <= -T::one() {
                    self.part_again();
                } else if turns {
                    self.falling = Some(here);
                    if s < T::one() {
                        self.part_again();
                    }
                }
            } else {
                self.part_again();
            }
            self.height = heights.iter().fold(T::zero(), |sum, &a| sum + a);
            if !self.height.is_finite() {
                return Err(undecided(self.edge() + sign * to * to, cost));
            }
            self.open |= self.height > allowed;
        }
        Ok(())
    }

    /// Where the bodies have come closer up to now, they part from here on, or end.
    pub fn part_again(&mut self) {
        let Some(here) = self.falling.take() else { return };
        if self.closest.is_none_or(|than| here.value < than.value) {
            self.closest = Some(here);
        }
    }
}
