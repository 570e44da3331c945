//! What a certificate asks several contacts for: themselves on the panels of others, and how the pressure grows from
//! their limits.

use super::one_of_several::OneOfSeveral;
use super::{Several, System};
use crate::quadrature::panels::Panel;
use crate::{Real, Side};

impl<T: Real> Several<T> {
    /// As many contacts on panels that others have sampled, over all of each of them.
    pub fn sampled(tolerance: T, tilt: T, panels: impl Iterator<Item = Vec<Panel<T>>>) -> Self {
        let mut several = Self::new(tolerance);
        for panels in panels {
            let mut part = OneOfSeveral::new(tolerance);
            (part.panel_set.panels, part.panel_set.tilt) = (panels, tilt);
            several.parts.push(part);
        }
        several.count = several.parts.len();
        several
    }

    /// The strength `K/κ` that a limit would have if it were off by a length, by that length, given the
    /// conditions on these contacts.
    pub fn strength_by_limit(&self, system: &System<T>, contact: usize, side: Side) -> T {
        let limit = self.parts[contact].on[side];
        let value = system.at_ends[2 * contact + usize::from(side == Side::Right)];
        (value / (T::pi() * T::pi() * self.weight.on_contact(contact, limit))).abs()
    }
}
