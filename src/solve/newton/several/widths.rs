//! Widths of contacts and of the gaps between them, and limits on their change in one step.

use super::{MAX_CUT, MAX_CUT_STEPS, NewtonSeveral, Width};
use crate::numerics::LinearSystem;
use crate::{Interval, Real};
use std::cmp::Ordering;

/// Least share of its width that a contact or a gap keeps in one step.
const LEAST_LEFT: f64 = 0.3;

/// Largest factor by which a width may grow in one step.
const MAX_GROWTH: f64 = 4.0;

/// Width below which a gap counts as closed, in units of rounding of x.
const CLOSED_WIDTH: f64 = 64.0;

impl<T: Real> NewtonSeveral<T> {
    /// Holds each width that the step would take below its least at the least, moves all other
    /// limits accordingly, and lists these widths. For each, one condition is left open: the one
    /// that a pressure in the gap would violate, or the height of the contact above the others.
    pub(super) fn hold(&mut self) {
        self.widths.clear();
        let (mut full, mut responses) = (Vec::new(), Vec::new());
        let (mut linear, mut matrix) = (LinearSystem::new(), Vec::new());
        let (mut excess, mut open) = (Vec::new(), Vec::new());
        while let Some(width) = self.furthest().filter(|width| !self.widths.contains(width)) {
            if self.widths.is_empty() {
                full.clone_from(&self.step);
            }
            self.widths.push(width);
            if !self.leave_open(width) {
                break;
            }
            let mut response = Vec::new();
            self.linear.solve(&self.unit, &mut response);
            responses.push(response);
            matrix.clear();
            excess.clear();
            for &i in &self.widths {
                // In `advance` the square of a width changes in proportion to the step.
                let least = self.least(i);
                let most = T::of(0.5) * (T::one() - least * least) * self.width(i);
                excess.push(self.narrows(&full, i) - most);
                matrix.extend(responses.iter().map(|response| self.narrows(response, i)));
            }
            if !linear.factor(&matrix, excess.len()) {
                break;
            }
            linear.solve(&excess, &mut open);
            if !open.iter().all(|open| open.is_finite()) {
                break;
            }
            self.step.copy_from_slice(&full);
            for (response, &open) in responses.iter().zip(&open) {
                for (step, &by_open) in self.step.iter_mut().zip(response) {
                    *step -= open * by_open;
                }
            }
            self.set_moves();
        }
    }

    /// Returns the width that the step takes furthest below its least, if any.
    fn furthest(&self) -> Option<Width> {
        let mut worst: Option<(T, Width)> = None;
        for i in 0..self.moves.len() - 1 {
            let share = (self.moves[i + 1] - self.moves[i]) / self.width(i);
            let (square, least) = (T::one() + share + share, self.least(i));
            if square < least * least && worst.is_none_or(|(least, _)| square < least) {
                worst = Some((square, i));
            }
        }
        worst.map(|(_, i)| i)
    }

    /// Sets the right-hand side that leaves the condition of a width open. Tells whether there is
    /// one.
    fn leave_open(&mut self, i: Width) -> bool {
        let contact = i / 2;
        self.unit.clear();
        self.unit.resize(self.step.len(), T::zero());
        if i % 2 == 1 {
            self.unit[self.system.row_of_gap(contact)] = T::one();
            return true;
        }
        if let Some(before) = contact.checked_sub(1) {
            self.unit[self.system.row_of_closing(before)] = T::one();
        }
        if contact + 1 < self.on.len() {
            self.unit[self.system.row_of_closing(contact)] = -T::one();
        }
        self.on.len() > 1
    }

    /// Returns the length by which a step makes a width narrower.
    fn narrows(&self, step: &[T], i: Width) -> T {
        let free = self.free();
        let at = |limit: usize| match free.contains(&limit) {
            true => step[limit - free.start],
            false => T::zero(),
        };
        at(i + 1) - at(i)
    }

    /// Returns the least share of a width that a step leaves. A width that was kept from shrinking
    /// may shrink faster.
    fn least(&self, i: Width) -> T {
        T::of(LEAST_LEFT.powi(self.cut[i] + 1))
    }

    pub(super) fn width(&self, i: Width) -> T {
        let on = &self.on[i / 2];
        if i.is_multiple_of(2) { on.right - on.left } else { self.on[i / 2 + 1].left - on.right }
    }

    /// Takes the step. The square of each width, of contacts and of gaps, changes as the step
    /// prescribes: both the load of a round body and the load left until a gap closes are linear in
    /// this square.
    pub(super) fn advance(&mut self) {
        let (zero, one, two) = (T::zero(), T::one(), T::of(2.0));
        let count = self.moves.len();
        let mut order = std::mem::take(&mut self.order);
        order.clear();
        order.extend(0..count - 1);
        // The narrowest first: their limits may move by more than the width.
        let by_width = |&one: &usize, &other: &usize| {
            self.width(one).partial_cmp(&self.width(other)).unwrap_or(Ordering::Equal)
        };
        order.sort_unstable_by(by_width);
        for &i in &order {
            let width = self.width(i);
            let change = self.moves[i + 1] - self.moves[i];
            let least = self.least(i) * width;
            let square = (width * (width + two * change)).max(least * least);
            let next = square.sqrt().min(T::of(MAX_GROWTH) * width);
            let correction = next - (width + change);
            // Both limits share the correction, but a narrow neighbour has no room for it, and a
            // corner stays.
            let room = |beside: Option<Width>, corner: bool| match beside {
                Some(beside) => width.min(self.width(beside)),
                None if corner => zero,
                None => width,
            };
            let left = room(i.checked_sub(1), self.held.left);
            let right = room((i + 2 < count).then_some(i + 1), self.held.right);
            // Both limits are held.
            if (left + right).is_zero() {
                continue;
            }
            let share = right / (left + right);
            self.moves[i] -= (one - share) * correction;
            self.moves[i + 1] += share * correction;
        }
        self.order = order;
        // A correction good for one width may be too much for the next.
        let mut share = one;
        for i in 0..count - 1 {
            let (width, less) = (self.width(i), self.moves[i] - self.moves[i + 1]);
            let most = (one - T::of(0.5 * LEAST_LEFT.powi(MAX_CUT))) * width;
            if less > most {
                share = share.min(most / less);
            }
        }
        for (on, moves) in self.on.iter_mut().zip(self.moves.chunks_exact(2)) {
            on.left += share * moves[0];
            on.right += share * moves[1];
        }
    }

    /// Tells whether a gap is as narrow as rounding.
    pub(super) fn is_closed(&self) -> bool {
        (0..self.on.len() - 1).any(|i| self.is_nothing(i))
    }

    /// Tells whether a contact has vanished, or the gap after it has closed.
    pub(in super::super::super) fn is_gone(&self, i: usize, is_gap: bool) -> bool {
        let is_cut = |i: Width| self.cut[i] >= MAX_CUT_STEPS;
        match is_gap {
            true => i + 1 < self.on.len() && (is_cut(2 * i + 1) || self.is_nothing(i)),
            false => is_cut(2 * i) || self.on[i].left >= self.on[i].right,
        }
    }

    /// Tells whether the gap after a contact is as narrow as rounding.
    pub(in super::super::super) fn is_nothing(&self, i: usize) -> bool {
        self.gap(i) <= self.rounding(i)
    }

    /// Returns the width below which the gap after a contact counts as closed, from the rounding of
    /// x.
    fn rounding(&self, i: usize) -> T {
        let size = self.on[i].left.abs().max(self.on[i + 1].right.abs());
        T::of(CLOSED_WIDTH) * T::epsilon() * size
    }

    /// Returns the width of the gap after a contact.
    fn gap(&self, i: usize) -> T {
        self.on[i + 1].left - self.on[i].right
    }

    /// Returns a closed gap, widened by the rounding of both contacts to cover the uncertainty of
    /// its place.
    pub(in super::super::super) fn closed_gap(&self, i: usize) -> Interval<T> {
        let rounding = self.rounding(i);
        Interval { left: self.on[i].right - rounding, right: self.on[i + 1].left + rounding }
    }
}
