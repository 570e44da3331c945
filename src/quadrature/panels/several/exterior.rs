//! Quantities that a certificate needs outside several contacts: the slope due to the pressure, and
//! the strength at a displaced limit.

use super::one_of_several::OneOfSeveral;
use super::{Several, System};
use crate::quadrature::panels::PanelSet;
use crate::{Real, Side};

impl<T: Real> Several<T> {
    /// Creates contacts on panel sets that were sampled elsewhere, one contact for each.
    pub fn sampled(panel_sets: Vec<PanelSet<T>>) -> Self {
        let mut several = Self::new(panel_sets[0].tolerance);
        several.parts = panel_sets.into_iter().map(OneOfSeveral::on_panels).collect();
        several
    }

    /// Sets up the conditions of contacts with right limits for a load, given as F/κ: open are only
    /// the residues at the poles of p, on which the conditions depend linearly.
    pub fn bear(&mut self, load: T, system: &mut System<T>) {
        let mut residues = vec![T::zero(); self.poles()];
        self.carry(load, &residues);
        self.system(load, system);
        if !residues.is_empty() && system.factor() {
            let mut step = Vec::new();
            system.step(&mut step);
            let steps = &step[system.free.len()..];
            residues.iter_mut().zip(steps).for_each(|(residue, &step)| *residue -= step);
            self.carry(load, &residues);
            self.system(load, system);
        }
    }

    /// Returns `Φ/κ`, the part of the gap's slope that the pressure takes off, at a distance beyond
    /// a limit of a contact and no further than in the next gap. `system` holds the conditions on
    /// these contacts.
    pub fn pull(&self, system: &System<T>, contact: usize, side: Side, distance: T) -> T {
        let on = self.parts[contact].on;
        let sign = if side == Side::Left { -T::one() } else { T::one() };
        let place = |distance: T| on[side] + sign * distance;
        let x = place(distance);
        let value = |distance| {
            self.outside(0..self.parts.len(), place(distance), Some((contact, distance)))
        };
        let in_gap = match side {
            Side::Left => contact.checked_sub(1),
            Side::Right => Some(contact).filter(|k| k + 1 < self.parts.len()),
        };
        let Some(k) = in_gap else {
            let value = value(distance) + self.terms.at(x);
            return -self.weight.beyond(side, x, distance) * value / T::pi();
        };
        let width = self.parts[k + 1].on.left - self.parts[k].on.right;
        let mut distances = [distance, width - distance];
        if side == Side::Left {
            distances.reverse();
        }
        // At the zero itself the quotient is a derivative: take it at a place next to the zero, so
        // far that the rounding of x is a hundredth of the distance.
        let rounding = T::of(64.0) * T::epsilon() * x.abs();
        let aside = (T::epsilon().sqrt() * width).max(rounding.min(T::of(0.25) * width));
        let is_at_zero = self.weight.zero(k).is_some_and(|(_, zero)| (x - zero).abs() < aside);
        let distance = if is_at_zero { distance + aside } else { distance };
        let without = self.without_zero(k, system, place(distance), value(distance));
        -self.weight.in_gap(k, x, distances) * without / T::pi()
    }

    /// Returns the strength `K/κ` of a limit displaced by a length, divided by that length.
    /// `system` holds the conditions on these contacts.
    pub fn strength_by_limit(&self, system: &System<T>, contact: usize, side: Side) -> T {
        let limit = self.parts[contact].on[side];
        let value = system.at_ends[2 * contact + usize::from(side == Side::Right)];
        (value / (T::pi() * T::pi() * self.weight.on_contact(contact, [limit])[0])).abs()
    }
}
