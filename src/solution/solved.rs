//! A solved contact, without its cost and report.

use super::ContactState;
use crate::gap::Gap;
use crate::quadrature::Engine;
use crate::quadrature::panels::Several;
use crate::{ContactError, Ends, EvaluationError, Interval, Real, Side};

/// Contact with all data of its pressure, prepared.
#[derive(Clone, Copy)]
pub(crate) struct Solved<'s, T: Real> {
    pub gap: &'s Gap<'s, T>,
    pub integrator: &'s Engine<T>,
    pub kappa: T,
    pub found: &'s ContactState<T>,
}

impl<'s, T: Real> Solved<'s, T> {
    /// Refuses a quantity whose formula is for half-planes, if the bodies are not.
    pub fn of_half_planes(&self, quantity: &'static str) -> Result<(), ContactError<T>> {
        if self.gap.bend().is_none() {
            return Ok(());
        }
        Err(EvaluationError::HalfPlanesOnly { quantity }.into())
    }

    /// Returns the contacts on their panels, if they are several.
    pub fn several(&self) -> Option<&'s Several<T>> {
        self.integrator.several()
    }

    /// Returns the slope of the gap in a contact on its panels, and its uncertainty; `None` without
    /// panels.
    pub fn sampled_slope(&self, contact: usize, x: T) -> Option<(T, T)> {
        let (panels, _) = self.integrator.panels()?.contact(contact);
        Some((panels.slope(x)?, panels.doubt(x)?))
    }

    /// Returns the free limits of a contact.
    pub fn free(&self, contact: usize) -> Ends<bool> {
        self.integrator.free_of(contact, self.found.free)
    }

    /// Returns the strengths of the singularities at the limits of a contact.
    pub fn strengths(&self, contact: usize) -> Ends<T> {
        self.several().map_or(self.found.strengths, |several| {
            Ends::from_fn(|side| self.kappa * several.strength(contact, side))
        })
    }

    /// Lists the limits that are not free, from right to left: the contact, the side and the
    /// strength of the singularity.
    pub fn held_limits(&self) -> impl Iterator<Item = (usize, Side, T)> {
        let limits =
            (0..self.contacts().len()).rev().flat_map(|i| [(i, Side::Right), (i, Side::Left)]);
        let held = limits.filter(|&(i, side)| !self.free(i)[side]);
        held.map(|(i, side)| (i, side, self.strengths(i)[side]))
    }

    /// Tells whether a place is a limit that is not free.
    pub fn is_held(&self, x: T) -> bool {
        self.held_limits().any(|(i, side, _)| self.contacts()[i][side] == x)
    }

    /// Returns the contacts, from left to right.
    pub fn contacts(&self) -> &'s [Interval<T>] {
        match self.found.apart {
            Some(_) => &[],
            None => self.integrator.contacts(&self.found.interval),
        }
    }
}
