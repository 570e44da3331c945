//! Regions next to contacts, and what is known of the gap there.

use super::SignoriniCheck;
use crate::gap::Survey;
use crate::solve::exterior_field::ExteriorFields;
use crate::{Interval, Real, Side};

/// Share of a contact's half-width beyond its limits that is sampled with it: there the pressure
/// inside shows that the gap opens.
const SAMPLED_BEYOND: f64 = 0.002;

/// Region between two contacts, or beyond the outermost ones.
#[derive(Clone, Copy)]
pub(super) struct Beside<T> {
    /// Number of the contact on its right.
    pub next: usize,
    pub room: Interval<T>,
    /// Limit from which heights are counted.
    pub edge: T,
    /// Distances from the left and the right limit within which the gap opens by the pressure
    /// inside.
    pub near: [T; 2],
    /// Distances from both within which the pressures themselves are asked, as a hollow corner is
    /// nearer: behind it the gap may close again.
    pub hollow: [T; 2],
    /// Distances from both within which nothing is known.
    pub blind: [T; 2],
    /// Height of the gap at this limit, its uncertainty, and the potential there.
    pub height: T,
    pub hidden: T,
    pub taken: T,
    /// Uncertainty of the potentials in the region, as a height: a bound, and the part by contacts
    /// with corners, by which the potentials are indeed off.
    pub doubt: T,
    pub at_corners: T,
}

impl<T: Real> Beside<T> {
    /// Returns the part of a span that lies in the region.
    pub fn within(&self, [left, right]: [T; 2]) -> [T; 2] {
        [left.max(self.room.left), right.min(self.room.right)]
    }

    /// Tells whether part of a span in the region is next to a hollow corner at a limit.
    pub fn is_beside_hollow(&self, span: [T; 2]) -> bool {
        let [left, right] = self.hollow;
        span.iter().any(|&x| x - self.room.left < left || self.room.right - x < right)
    }

    /// Tells whether a place is closer to a corner that holds a limit than the limit is known.
    pub fn is_blind(&self, x: T) -> bool {
        x - self.room.left < self.blind[0] || self.room.right - x < self.blind[1]
    }

    /// Tells whether a place is so close to a limit that the pressure inside decides about the gap.
    pub fn is_near(&self, x: T) -> bool {
        x - self.room.left < self.near[0] || self.room.right - x < self.near[1]
    }
}

/// Verdict on the gap between the loaded bodies.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Verdict {
    Apart,
    /// Overlap, if any, within the uncertainty of the series of the pressures.
    Unresolved,
    /// Overlap, if any, within the uncertainty of the survey.
    Hidden,
    Overlap,
}

impl<T: Real> SignoriniCheck<'_, T> {
    /// Describes the region next to a contact: before one of them, or beyond the last.
    pub(super) fn beside(
        &self,
        fields: &ExteriorFields<T>,
        look: &Survey<T>,
        next: usize,
    ) -> Beside<T> {
        let (contacts, [from, to]) = (self.contacts, self.gap.range());
        let (contact, side) = match next.checked_sub(1) {
            None => (0, Side::Left),
            Some(before) => (before, Side::Right),
        };
        let edge = contacts[contact][side];
        let at = self.gap.nearest(edge);
        let (height, hidden) = match self.panels.several() {
            Some(several) => (several.height(contact, side), T::zero()),
            None => (self.height_at(look, at), look.doubt_at(at)),
        };
        let left = next.checked_sub(1).map_or(from, |i| contacts[i].right);
        let right = contacts.get(next).map_or(to, |on| on.left);
        let room = Interval { left, right };
        let sampled = T::of(SAMPLED_BEYOND) * contacts[contact].half_width();
        let limits = [
            next.checked_sub(1).map(|before| (before, Side::Right)),
            Some((next, Side::Left)).filter(|_| next < contacts.len()),
        ];
        let mut near = limits.map(|limit| limit.map_or(T::zero(), |_| sampled));
        let mut hollow = [T::zero(); 2];
        for (i, limit) in limits.into_iter().enumerate() {
            let Some(away) = limit.and_then(|limit| self.hollow_beside(limit, sampled)) else {
                continue;
            };
            (near[i], hollow[i]) = (away, sampled);
        }
        // A corner holds the limit in place of one just beyond it.
        let held = limits.map(|limit| limit.filter(|&limit| !self.is_free(limit)));
        let blind = held.map(|on| on.map_or(T::zero(), |(i, _)| self.found.blind(contacts[i])));
        let taken = fields.potential(edge);
        // On both sides of a region the gap is closed: what the potentials leave of it is their
        // error.
        let [left_out, at_corners] = fields.doubt_in(room).map(|doubt| doubt / self.kappa);
        let several = self.panels.several().filter(|_| limits.iter().all(Option::is_some));
        let doubt = several.map_or(left_out, |several| {
            let rise = several.height(next, Side::Left) - height;
            left_out.max((rise - (fields.potential(room.right) - taken) / self.kappa).abs())
        });
        Beside { next, edge, room, near, hollow, blind, height, hidden, taken, doubt, at_corners }
    }

    /// Tells whether a limit, given by the number of its contact and the side, is free.
    fn is_free(&self, (contact, side): (usize, Side)) -> bool {
        self.panels.free_of(contact, self.found.free)[side]
    }

    /// Returns the distance from a limit to a hollow corner that lies beyond it, up to a distance:
    /// behind it the gap may close again.
    fn hollow_beside(&self, (contact, side): (usize, Side), within: T) -> Option<T> {
        let limit = self.contacts[contact][side];
        let next = match side {
            Side::Left => self.gap.breakpoint_before(limit),
            Side::Right => self.gap.breakpoint_after(limit),
        };
        let corner = if self.gap.is_breakpoint(limit) { limit } else { next? };
        let (away, opens) = ((corner - limit).abs(), self.gap.jump(corner)[0] >= T::zero());
        // A jump that is no number may be one down.
        (away <= within && !opens).then_some(away)
    }
}
