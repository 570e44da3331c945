//! The integrator of a solve, and the one place that tells panels from another quadrature.

use super::panels::{PanelIntegrator, Several};
use super::{Integrator, Panels, Quadrature};
use crate::gap::{Cost, Gap};
use crate::{ContactError, Ends, Interval, Real};
use std::borrow::Cow;
use std::ops::{Deref, DerefMut};

/// Integrator of a solve: panels, which know of several contacts, or that of another quadrature,
/// which knows of one.
pub(crate) enum Engine<T: Real> {
    Panels(Box<PanelIntegrator<T>>),
    Other(Box<dyn Integrator<T>>),
}

impl<T: Real> Engine<T> {
    /// Creates the integrator of a quadrature.
    pub fn new(quadrature: &dyn Quadrature<T>) -> Result<Self, ContactError<T>> {
        Ok(match quadrature.panels() {
            Some(rule) => Self::Panels(rule.prepared()?),
            None => Self::Other(quadrature.integrator()?),
        })
    }

    /// Tells whether the integrator belongs to a quadrature with its settings.
    pub fn is_of(&self, quadrature: &dyn Quadrature<T>) -> bool {
        match (self, quadrature.panels()) {
            (Self::Panels(own), rule) => rule == Some(own.rule),
            (Self::Other(own), rule) => rule.is_none() && quadrature.serves(&**own),
        }
    }

    /// Returns the panels, if the integrator works on them.
    pub fn panels(&self) -> Option<&PanelIntegrator<T>> {
        let Self::Panels(own) = self else { return None };
        Some(own)
    }

    pub fn panels_mut(&mut self) -> Option<&mut PanelIntegrator<T>> {
        let Self::Panels(own) = self else { return None };
        Some(own)
    }

    /// Returns the contacts on their panels, if they are several.
    pub fn several(&self) -> Option<&Several<T>> {
        self.panels()?.several()
    }

    /// Returns the contacts, given the only one.
    pub fn contacts<'i>(&'i self, one: &'i Interval<T>) -> &'i [Interval<T>] {
        self.several().map_or(std::slice::from_ref(one), Several::contacts)
    }

    /// Returns the free limits of a contact, given those of the only one.
    pub fn free_of(&self, contact: usize, of_one: Ends<bool>) -> Ends<bool> {
        self.panels().map_or(of_one, |own| own.free_of(contact, of_one))
    }

    /// Prepares the contacts found for their pressures. (Several are prepared as they are found.)
    pub fn ready(&mut self, gap: &Gap<'_, T>, one: Interval<T>) -> Result<(), ContactError<T>> {
        if self.several().is_none() { self.prepare(gap, one) } else { Ok(()) }
    }

    /// Takes the samples still missing for the pressure, and returns their cost; panels miss none.
    pub fn complete(&self, gap: &Gap<'_, T>) -> Result<Cost, ContactError<T>> {
        let Self::Other(own) = self else { return Ok(Cost::default()) };
        own.complete(gap)
    }

    /// Returns the panels of the contacts last prepared. Without any, panels are sampled on the
    /// same contact.
    ///
    /// # Errors
    /// Those of sampling the gap.
    pub fn panels_over(
        &self,
        gap: &Gap<'_, T>,
        on: Interval<T>,
    ) -> Result<Cow<'_, Box<PanelIntegrator<T>>>, ContactError<T>> {
        if let Self::Panels(own) = self {
            return Ok(Cow::Borrowed(own));
        }
        let mut own = Panels::FULL.prepared()?;
        own.prepare(gap, on)?;
        Ok(Cow::Owned(own))
    }
}

impl<T: Real> Clone for Engine<T> {
    fn clone(&self) -> Self {
        match self {
            Self::Panels(own) => Self::Panels(own.clone()),
            Self::Other(own) => Self::Other(own.fork()),
        }
    }
}

impl<T: Real> Deref for Engine<T> {
    type Target = dyn Integrator<T>;

    fn deref(&self) -> &Self::Target {
        match self {
            Self::Panels(own) => &**own,
            Self::Other(own) => &**own,
        }
    }
}

impl<T: Real> DerefMut for Engine<T> {
    fn deref_mut(&mut self) -> &mut Self::Target {
        match self {
            Self::Panels(own) => &mut **own,
            Self::Other(own) => &mut **own,
        }
    }
}
