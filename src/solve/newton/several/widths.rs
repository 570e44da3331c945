//! Widths of contacts and of the gaps between them, and limits on their change in one step.

use super::super::super::fault::Fault;
use super::{MAX_CUT, MAX_CUT_STEPS, NewtonSeveral, Width};
use crate::Real;
use crate::gap::Gap;
use crate::numerics::ascending;
use crate::solution::CLOSED_WIDTH;

/// Least share of its width that a contact or a gap keeps in one step.
const LEAST_WIDTH_LEFT: f64 = 0.3;

impl<T: Real> NewtonSeveral<T> {
    /// Shortens the moves of the limits: two neighbours leave at least a share of the width between
    /// them, and a limit moves outward by no more than the width of its contact, inward by no more
    /// than would narrow a gap as wide as that behind. Lists the widths that would have become too
    /// narrow.
    pub(super) fn shorten(&mut self) {
        self.widths.clear();
        let (half, last) = (T::of(0.5), self.moves.len() - 1);
        for i in 0..=last {
            if !self.moves_freely(i) {
                continue;
            }
            let beside = [i.checked_sub(1), Some(i).filter(|&i| i < last)];
            let [behind, ahead] = if self.moves[i] < T::zero() { [1, 0] } else { [0, 1] };
            let narrowed = |i: Width| (half * (T::one() - self.least(i)) * self.width(i), Some(i));
            // Next to a wall the pressure changes within less than the gap.
            let share = |i: Width| T::of([1.0, 0.5 * (1.0 - LEAST_WIDTH_LEFT)][i % 2]);
            let widened = |i: Width| (share(i) * self.width(i), None);
            let both = [beside[ahead].map(narrowed), beside[behind].map(widened)];
            let least = both
                .into_iter()
                .flatten()
                .reduce(|one, other| if other.0 <= one.0 { other } else { one });
            let Some((most, narrowed)) = least else { continue };
            if self.moves[i].abs() > most {
                self.moves[i] = most * self.moves[i].signum();
                self.widths.extend(narrowed);
            }
        }
    }

    /// Returns the least share of a width that a step leaves. A width that was cut may shrink
    /// faster.
    fn least(&self, i: Width) -> T {
        T::of(LEAST_WIDTH_LEFT.powi(self.cut[i] + 1))
    }

    pub(super) fn width(&self, i: Width) -> T {
        let on = &self.on[i / 2];
        if i.is_multiple_of(2) { on.right - on.left } else { self.on[i / 2 + 1].left - on.right }
    }

    /// Takes the step. The square of each width, of contacts and of gaps, changes as the step
    /// prescribes: both the load of a round body and the load left until a gap closes are linear in
    /// this square.
    pub(super) fn advance(&mut self, gap: &Gap<'_, T>) {
        let (zero, one, two) = (T::zero(), T::one(), T::of(2.0));
        let count = self.moves.len();
        let mut order = std::mem::take(&mut self.order);
        order.clear();
        order.extend(0..count - 1);
        // The narrowest first: their limits may move by more than the width.
        order.sort_unstable_by(|&one, &other| ascending(&self.width(one), &self.width(other)));
        for &i in &order {
            let width = self.width(i);
            let change = self.moves[i + 1] - self.moves[i];
            let least = self.least(i) * width;
            let square = (width * (width + two * change)).max(least * least);
            let correction = square.sqrt() - (width + change);
            // Both limits share the correction, but a narrow neighbour has no room for it, and a
            // corner stays.
            let room = |limit: usize, beside: Option<Width>| {
                if !self.moves_freely(limit) {
                    return zero;
                }
                beside.map_or(width, |beside| width.min(self.width(beside)))
            };
            let left = room(i, i.checked_sub(1));
            let right = room(i + 1, (i + 2 < count).then_some(i + 1));
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
            let most = (one - T::of(0.5 * LEAST_WIDTH_LEFT.powi(MAX_CUT))) * width;
            if less > most {
                share = share.min(most / less);
            }
        }
        // Between two contacts with a hollow corner, no gap beside it is one.
        for i in (1..count - 1).step_by(2) {
            let [left, right] = [self.on[i / 2].right, self.on[i / 2 + 1].left];
            let [first, last] = [gap.breakpoint_after(left), gap.breakpoint_before(right)];
            for (i, x, z) in [(i, left, first), (i + 1, right, last)] {
                let hollow = z.filter(|&z| z > left && z < right && gap.jump(z)[0] < zero);
                let (due, most) = (self.moves[i], hollow.map(|z| (z - x) / (share * two)));
                self.moves[i] = most.filter(|&most| due / most > one).unwrap_or(due);
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

    /// Returns the contacts that vanish and the gaps that close, if there are several contacts.
    pub(super) fn gone(&self) -> Fault<T> {
        let last = self.on.len() - 1;
        if last == 0 {
            return Fault::Failed;
        }
        let is_cut = |i: Width| self.cut[i] >= MAX_CUT_STEPS;
        let closes = |i: usize| i < last && (is_cut(2 * i + 1) || self.is_nothing(i));
        let vanishes = |i: usize| is_cut(2 * i) || self.on[i].left >= self.on[i].right;
        Fault::Gone {
            vanished: (0..=last).map(vanishes).collect(),
            closed: (0..=last).map(closes).collect(),
        }
    }

    /// Tells whether the gap after a contact is as narrow as rounding: it counts as closed.
    fn is_nothing(&self, i: usize) -> bool {
        let size = self.on[i].left.abs().max(self.on[i + 1].right.abs());
        self.width(2 * i + 1) <= T::of(CLOSED_WIDTH) * T::epsilon() * size
    }
}
