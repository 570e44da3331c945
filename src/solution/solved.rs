//! A solved contact, without its cost and report.

use super::ContactState;
use crate::gap::Gap;
use crate::quadrature::Integrator;
use crate::quadrature::panels::{self, Several};
use crate::{Interval, Real};

/// Contact with all data of its pressure, prepared.
#[derive(Clone, Copy)]
pub(crate) struct Solved<'s, T: Real> {
    pub gap: &'s Gap<'s, T>,
    pub integrator: &'s dyn Integrator<T>,
    pub kappa: T,
    pub found: &'s ContactState<T>,
}

impl<'s, T: Real> Solved<'s, T> {
    /// Returns the contacts on their panels, if they are several.
    pub fn several(&self) -> Option<&'s Several<T>> {
        panels::several(self.integrator)
    }

    /// Returns the slope of the gap in a contact on its panels, and its uncertainty; `None` without
    /// panels.
    pub fn sampled_slope(&self, contact: usize, x: T) -> Option<(T, T)> {
        let (panels, _) = self.integrator.panels()?.contact(contact);
        Some((panels.slope(x)?, panels.doubt(x)?))
    }

    /// Returns the contacts, from left to right.
    pub fn contacts(&self) -> &'s [Interval<T>] {
        self.several().map_or(std::slice::from_ref(&self.found.interval), Several::contacts)
    }
}
