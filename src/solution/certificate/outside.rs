//! Proof that the bodies do not overlap outside the contacts.
//!
//! From each limit the gap is followed to the end of the bodies, or half the way to the next
//! contact. There the pressure reduces the slope of the gap by Φ/κ. The integral of the reduced
//! slope is smooth up to the limit as a function of y = √d, d the distance from it. Where P ≥ 0, Φ
//! falls outward: where the bodies are steeper than anywhere in the contact the gap grows, and the
//! reduced slope is not computed. The share of the pressure in the height is then added only where
//! the gap stops growing.

use super::cells::Cells;
use super::{ContactState, Extremum, undecided};
use crate::gap::Cost;
use crate::numerics::chebyshev::{Table, primitive, value_at};
use crate::numerics::gauss_legendre::GaussLegendre;
use crate::quadrature::panels::{Panel, Several, System};
use crate::solution::check::{bounds, extremes, least, nearer, truncation_error};
use crate::{ContactError, Fallible, Interval, Real, Side};

/// Number of nodes of a cell.
const CELL_NODES: usize = 24;
/// Largest number of halvings of a panel.
const MAX_LEVELS: usize = 40;
/// Largest number of cells on one side.
const MAX_CELLS: usize = 1 << 16;

/// Truncation error from which on cells resolve nothing, as a share of the rise at the largest
/// slope.
const MAX_OF_RISE: f64 = 1e-2;

/// Contacts under load, or the place of first touch of bodies that are apart.
pub(super) struct Loaded<'c, T: Real> {
    pub found: &'c ContactState<T>,
    pub contacts: &'c [Interval<T>],
    /// Pressures of the contacts; `None` of bodies that are apart.
    pub pressed: Option<(&'c Several<T>, &'c System<T>)>,
    /// Least and largest slope of the bodies in each contact.
    pub slopes: &'c [[T; 2]],
    /// Largest overlap that counts as zero.
    pub allowed: T,
}

/// One side of a contact, and the gap followed there so far.
pub(super) struct OutsideOf<'o, T: Real> {
    of: &'o Loaded<'o, T>,
    contact: usize,
    side: Side,
    /// True if Φ falls outward.
    falls: bool,
    /// Distance up to which nothing is proved: at a corner that holds the limit in place of one
    /// just beyond it, the bodies overlap up to 16/π² of the distance between the two, beyond a
    /// jump.
    blind: T,
    /// Height of the gap at `y`; `pending` is the height that the slopes of the bodies have added
    /// since.
    height: T,
    y: T,
    pending: T,
    /// True once the gap has been open: a least gap of zero at the edge itself does not count.
    open: bool,
    cells: usize,
    /// Deepest overlap, and in `closest` the least gap from which on the bodies part again.
    pub worst: Option<Extremum<T>>,
    pub closest: Option<Extremum<T>>,
    /// End of the last cell, if the bodies come closer up to there.
    pub falling: Option<Extremum<T>>,
}

impl<'o, T: Real> OutsideOf<'o, T> {
    pub fn new(of: &'o Loaded<'o, T>, contact: usize, side: Side, falls: bool) -> Self {
        let height = of.found.apart.unwrap_or(T::zero());
        let ([y, pending], [worst, closest, falling]) = ([T::zero(); 2], [None; 3]);
        let (open, cells) = (false, 0);
        let is_held = of.pressed.is_some_and(|(several, _)| several.held()[contact][side]);
        let blind = of.found.blind(of.contacts[contact]);
        let blind = if is_held { blind } else { T::zero() };
        Self {
            of,
            contact,
            side,
            falls,
            blind,
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
        if self.side == Side::Left { -T::one() } else { T::one() }
    }

    fn on(&self) -> Interval<T> {
        self.of.contacts[self.contact]
    }

    fn edge(&self) -> T {
        self.on()[self.side]
    }

    fn distance(&self, x: T) -> T {
        (self.sign() * (x - self.edge())).max(T::zero())
    }

    /// Returns the reduction of the slope of the gap by the pressure at a distance.
    fn pull(&self, distance: T) -> T {
        self.of.pressed.map_or(T::zero(), |(several, system)| {
            several.pull(system, self.contact, self.side, distance)
        })
    }

    /// Follows the gap from the edge to a place.
    pub fn follow(&mut self, end: T, cells: &mut Cells<'_, T>) -> Result<(), ContactError<T>> {
        let edge = self.edge();
        let first = if self.of.pressed.is_some() { self.on().half_width() } else { cells.spacing };
        let places = cells.places(edge, end, first);
        let mut row = cells.over(&places)?;
        // Without the last cell: at the end of a body the slope may be infinite.
        let last = places.len() - 1;
        let known = match self.side {
            Side::Left => [places[1.min(last)], edge],
            Side::Right => [edge, places[last.max(1) - 1]],
        };
        if known[0] < known[1] {
            cells.check_heights(&row, known)?;
        }
        if self.side == Side::Left {
            row.panels.reverse();
        }
        let (mut left_out, [least, most]) = (T::zero(), extremes(&row.panels));
        let vague = T::of(MAX_OF_RISE) * most.max(-least);
        for panel in &row.panels {
            self.take(panel, &mut left_out, cells.cost())?;
            if left_out > vague * self.distance(panel.x[0]).max(self.distance(panel.x[1])) {
                return Err(undecided(panel.x[0], cells.cost()));
            }
        }
        Ok(())
    }

    /// Takes the next panel outward.
    fn take(&mut self, panel: &Panel<T>, left_out: &mut T, cost: Cost) -> Fallible<T, ()> {
        let length = panel.x[1] - panel.x[0];
        let rounding = T::of(16.0) * T::epsilon();
        *left_out += length * (panel.error + rounding * panel.series[0].abs());
        // A straight flank is as steep as in the contact.
        let [least, most] = self.of.slopes[self.contact];
        let slack = rounding * least.abs().max(most.abs());
        let [below, above] = bounds(panel.coefficients());
        let growing = match self.side {
            Side::Right => below >= most - slack,
            Side::Left => above <= least + slack,
        };
        let [one, two] = panel.x.map(|x| self.distance(x));
        let [from, to] = [one.min(two).sqrt(), one.max(two).sqrt()];
        if growing && self.falls {
            self.pending += self.sign() * panel.rise(panel.x[0], panel.x[1]);
            self.part_again();
            return Ok(());
        }
        // What is pending may be zero: on a level flank.
        if self.y < from {
            let drawn = self.drawn(self.y, from);
            self.height += self.pending - drawn;
            self.open |= self.height > self.of.allowed;
            self.pending = T::zero();
        }
        self.bound(panel, [from, to], self.of.allowed + *left_out, cost)?;
        self.y = to;
        Ok(())
    }

    /// Returns the reduction of the height by the pressure between two places.
    fn drawn(&self, from: T, to: T) -> T {
        let (half, rule) = (T::of(0.5), GaussLegendre::suited(1, T::zero()));
        let (mut sum, mut top) = (T::zero(), to);
        for level in 0..200 {
            let is_last = level + 1 == 200 || (from.is_zero() && level > 20);
            let bottom = if is_last { from } else { from.max(half * top) };
            for i in 0..rule.n {
                let y = half * (bottom + top) + half * (top - bottom) * T::of(rule.nodes[i]);
                let weight = half * (top - bottom) * T::of(rule.weights[i]);
                sum += weight * (y + y) * self.sign() * self.pull(y * y);
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
    ) -> Fallible<T, ()> {
        let (half, table, sign) = (T::of(0.5), Table::of(CELL_NODES), self.sign());
        // Rate of change of g: the rounding of x costs a part of it.
        let bends = panel.coefficients().iter().enumerate();
        let bend = bends.fold(T::zero(), |sum, (k, a)| sum + T::count(k) * a.abs()) / panel.half();
        let mut waiting = vec![(whole, 0)];
        while let Some(([from, to], level)) = waiting.pop() {
            let (middle, reach) = (half * (from + to), half * (to - from));
            self.cells += 1;
            if self.cells > MAX_CELLS {
                return Err(undecided(self.edge() + sign * from * from, cost));
            }
            let (mut values, mut terms) = ([T::zero(); CELL_NODES], T::zero());
            for (value, &z) in values.iter_mut().zip(&table.z) {
                let y = middle + reach * T::of(z);
                let distance = y * y;
                let x = self.edge() + sign * distance;
                // Next to a breakpoint the rounding of x may exceed the length of a panel.
                let g = panel.value(x.max(panel.x[0]).min(panel.x[1]));
                let opens = sign * (g - self.pull(distance));
                let lost = T::of(0.125) * (x.abs() + distance) * bend;
                terms = terms.max((y + y) * (g.abs() + lost) * reach);
                *value = (y + y) * opens * reach;
            }
            let rate = &table.coefficients(&values);
            let left_out = truncation_error(rate);
            let size = rate.iter().fold(T::zero(), |max, a| max.max(a.abs()));
            let rounding = T::of(256.0) * T::epsilon() * size.max(terms);
            let fine = left_out <= (T::of(0.125) * allowed).max(rounding);
            if !fine && level < MAX_LEVELS && middle > from && middle < to {
                waiting.extend([([middle, to], level + 1), ([from, middle], level + 1)]);
                continue;
            }
            let heights = &mut primitive(rate)[..=CELL_NODES];
            heights[0] = self.height - value_at(heights, -T::one());
            let lowest = bounds(heights)[0];
            let known = lowest > allowed && self.closest.is_some_and(|than| than.value <= lowest);
            if known {
                self.falling = None;
            } else if bounds(rate)[0] < T::zero() {
                // As fine as the tolerance needs, but no finer than rounding.
                let rounding = heights.iter().fold(T::zero(), |sum, a| sum + a.abs());
                let rounding = T::of(16.0) * T::epsilon() * rounding;
                let enough = (T::of(1e-3) * allowed).max(rounding).max(T::of(1e-9) * lowest);
                let [s, value] = least(heights, enough);
                let y = middle + s * reach;
                let here = Extremum { x: self.edge() + sign * y * y, value };
                if value < -(allowed + left_out) && y * y > self.blind {
                    self.worst = nearer(Some(here), self.worst);
                }
                let turns = s > -T::one() && (self.open || value.abs() > allowed);
                if turns {
                    self.falling = Some(here);
                }
                if s <= -T::one() || (turns && s < T::one()) {
                    self.part_again();
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

    /// Records the last place of approach: from here on the bodies part, or end.
    pub fn part_again(&mut self) {
        self.closest = nearer(self.falling.take(), self.closest);
    }
}
