//! What a certificate asks several contacts for: what the pressure does beside them, and how it grows from
//! their limits.

use super::one_of_several::OneOfSeveral;
use super::{Several, System};
use crate::quadrature::panels::PanelSet;
use crate::{Ends, Real, Side};

impl<T: Real> Several<T> {
    /// As many contacts on panels that others have sampled, over all of each of them.
    pub fn sampled(panel_sets: Vec<PanelSet<T>>) -> Self {
        let mut several = Self::new(panel_sets[0].tolerance);
        several.parts = panel_sets.into_iter().map(OneOfSeveral::on_panels).collect();
        several.count = several.parts.len();
        several
    }

    /// Takes a load, that is F/κ, where the contacts do not say it: the only one between two corners bears any.
    pub fn bear(&mut self, load: T) {
        let is_given = self.count == 1 && self.corners() == Ends::both(true);
        self.constant = if is_given { -T::pi() * load } else { T::zero() };
    }

    /// `Φ/κ`, what the pressure takes off the slope of the gap, at a distance beyond a limit of a contact and
    /// no further than in the next gap, given the conditions on these contacts.
    pub fn pull(&self, system: &System<T>, contact: usize, side: Side, distance: T) -> T {
        let on = self.parts[contact].on;
        let sign = if side == Side::Left { -T::one() } else { T::one() };
        let place = |distance: T| on[side] + sign * distance;
        let x = place(distance);
        let value =
            |distance| self.outside(0..self.count, place(distance), Some((contact, distance)));
        let in_gap = match side {
            Side::Left => contact.checked_sub(1),
            Side::Right => Some(contact).filter(|k| k + 1 < self.count),
        };
        let Some(k) = in_gap else {
            return -self.weight.beyond(side, x, distance) * (value(distance) + self.constant)
                / T::pi();
        };
        let width = self.parts[k + 1].on.left - self.parts[k].on.right;
        let mut distances = [distance, width - distance];
        if side == Side::Left {
            distances.reverse();
        }
        // At the zero itself that is a derivative: by a place aside from it.
        let aside = T::epsilon().sqrt() * width;
        let is_close = |&zero: &T| (x - zero).abs() < aside;
        let is_at_zero = self.weight.zeros().get(k).is_some_and(is_close);
        let distance = if is_at_zero { distance + aside } else { distance };
        let without = self.without_zero(k, system, place(distance), value(distance));
        -self.weight.in_gap(k, x, distances) * without / T::pi()
    }

    /// The strength `K/κ` that a limit would have if it were off by a length, by that length, given the
    /// conditions on these contacts.
    pub fn strength_by_limit(&self, system: &System<T>, contact: usize, side: Side) -> T {
        let limit = self.parts[contact].on[side];
        let value = system.at_ends[2 * contact + usize::from(side == Side::Right)];
        (value / (T::pi() * T::pi() * self.weight.on_contact(contact, limit))).abs()
    }
}
